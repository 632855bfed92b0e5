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
    use proptest::prelude::*;

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
    proptest! {
        #[test]
        fn whatever_is_written_is_a_finite_time_or_an_error(text in "\\PC*|[ +\\-0-9.eE/sna]{0,16}") {
            prop_assert!(seconds(&text).is_ok_and(f64::is_finite) || seconds(&text).is_err_and(|told| told.contains("1/250")));
        }

        #[test]
        fn fractions_are_what_they_say(above in -1e6..1e6f64, below in 1e-6..1e6f64, space in " {0,2}", unit in "s?") {
            prop_assert_eq!(seconds(&format!("{above}{space}/{space}{below}{space}{unit}")), Ok(above / below));
            prop_assert_eq!(seconds(&format!("{space}{above:e}{space}{unit}{space}")), Ok(above));
        }
    }
}
