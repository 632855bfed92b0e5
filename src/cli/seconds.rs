//! Times as cameras and films write them.

/// Reads a time, such as 0.004, or a fraction of a second, such as 1/250; an `s` may follow [s].
pub fn seconds(text: &str) -> Result<f64, String> {
    let number = |text: &str| text.trim().parse::<f64>().ok().filter(|value| value.is_finite());
    let bare = text.trim();
    let bare = bare.strip_suffix('s').unwrap_or(bare);
    let value = match bare.split_once('/') {
        None => number(bare),
        Some((above, below)) => {
            number(above).zip(number(below)).map(|(above, below)| above / below).filter(|value| value.is_finite())
        }
    };
    value.ok_or_else(|| "must be a number of seconds or a fraction of one, such as 0.004 or 1/250".to_owned())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn times_are_read_as_numbers_and_as_fractions() {
        for (text, expected) in [
            ("0.004", 0.004),
            ("1/250", 0.004),
            ("1/250s", 0.004),
            (" 1 / 4 s", 0.25),
            ("2s", 2.0),
            ("30", 30.0),
            ("2.5/1e3", 0.0025),
        ] {
            assert_eq!(seconds(text).unwrap(), expected, "{text}");
        }
        for text in ["", "/", "1/", "/250", "1/0", "0/0", "1/2/3", "0,004", "1/x", "nan", "inf", "1//2", "s", "1e999"] {
            assert!(seconds(text).is_err(), "{text}");
        }
    }
}
