//! A text of coordinates, cut into numbers, signs of units, letters and separators.

/// Which of the two coordinates.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Axis {
    Latitude,
    Longitude,
}

/// A piece of the text.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Token {
    Number {
        size: f64,
        /// A sign in front: whether it is a minus.
        sign: Option<bool>,
        has_fraction: bool,
    },
    /// 0 degrees, 1 minutes, 2 seconds.
    Unit(usize),
    /// A letter such as N, or a name such as "lat"; whether it says that the other half of the globe is meant.
    Axis(Axis, Option<bool>),
    /// What stands between latitude and longitude.
    Separator,
}

/// Whether a comma directly between digits belongs to a number.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Comma {
    Decimal,
    Separator,
}

/// Commas directly between digits.
pub(super) fn tight_commas(text: &str) -> usize {
    let bytes = text.as_bytes();
    bytes.windows(3).filter(|three| three[1] == b',' && three[0].is_ascii_digit() && three[2].is_ascii_digit()).count()
}

/// The pieces of `text`, or what is wrong with it.
pub(super) fn cut(text: &str, comma: Comma) -> Result<Vec<Token>, String> {
    let letters: Vec<char> = text.chars().collect();
    let mut tokens = Vec::new();
    let mut at = 0;
    while let Some(&letter) = letters.get(at) {
        let next = letters.get(at + 1).copied();
        match letter {
            '0'..='9' => {
                let (end, has_fraction) = number_end(&letters, at, comma);
                tokens.push(number(&letters[at..end], None, has_fraction)?);
                at = end;
                continue;
            }
            '+' | '-' | '−' | '–' => {
                let stands_free = at == 0 || !letters[at - 1].is_ascii_digit();
                if !stands_free || !next.is_some_and(|next| next.is_ascii_digit()) {
                    return Err(format!("a sign {letter:?} must stand in front of a number, after a blank"));
                }
                let (end, has_fraction) = number_end(&letters, at + 1, comma);
                tokens.push(number(&letters[at + 1..end], Some(letter != '+'), has_fraction)?);
                at = end;
                continue;
            }
            '°' | 'º' | '˚' => tokens.push(Token::Unit(0)),
            '\'' | '’' | '‘' | '′' | '´' | 'ʹ' | '`' => {
                let twice = next == Some(letter);
                at += usize::from(twice);
                tokens.push(Token::Unit(if twice { 2 } else { 1 }));
            }
            '"' | '”' | '“' | '″' | 'ʺ' => tokens.push(Token::Unit(2)),
            ',' | ';' | '/' | '|' => {
                let between_digits = at > 0 && letters[at - 1].is_ascii_digit() && next.is_some_and(|next| next.is_ascii_digit());
                if letter == ',' && between_digits && comma == Comma::Decimal {
                    return Err("a comma in two meanings".to_string());
                }
                tokens.push(Token::Separator);
            }
            _ if letter.is_whitespace() || matches!(letter, '(' | ')' | '[' | ']' | ':' | '=') => {}
            _ if letter.is_alphabetic() => {
                let end =
                    letters[at..].iter().position(|letter| !letter.is_alphabetic()).map_or(letters.len(), |length| at + length);
                let word: String = letters[at..end].iter().collect();
                tokens.push(word_token(&word, &tokens)?);
                at = end;
                continue;
            }
            _ => return Err(format!("{letter:?} has no meaning here")),
        }
        at += 1;
    }
    while tokens.last() == Some(&Token::Separator) {
        tokens.pop();
    }
    Ok(tokens)
}

/// Where the number that begins at `start` ends, and whether it has a decimal point or comma.
fn number_end(letters: &[char], start: usize, comma: Comma) -> (usize, bool) {
    let digits = |from: usize| letters[from..].iter().take_while(|letter| letter.is_ascii_digit()).count();
    let whole = start + digits(start);
    let is_point = |letter: char| letter == '.' || (letter == ',' && comma == Comma::Decimal);
    match letters.get(whole) {
        Some(&letter) if is_point(letter) && (letter == '.' || digits(whole + 1) > 0) => (whole + 1 + digits(whole + 1), true),
        _ => (whole, false),
    }
}

fn number(letters: &[char], sign: Option<bool>, has_fraction: bool) -> Result<Token, String> {
    let text: String = letters.iter().map(|&letter| if letter == ',' { '.' } else { letter }).collect();
    let size = text.parse().map_err(|_| format!("{text:?} is not a number"))?;
    Ok(Token::Number { size, sign, has_fraction })
}

fn word_token(word: &str, before: &[Token]) -> Result<Token, String> {
    use Axis::{Latitude, Longitude};
    // A small s after the number that follows minutes means seconds, not the south.
    let after_minutes = matches!(before, [.., Token::Unit(1), Token::Number { .. }]);
    Ok(match word.to_lowercase().as_str() {
        "s" | "sec" | "seconds" if after_minutes && word.starts_with('s') => Token::Unit(2),
        "d" | "deg" | "degree" | "degrees" => Token::Unit(0),
        "m" | "min" | "minute" | "minutes" => Token::Unit(1),
        "n" | "north" => Token::Axis(Latitude, Some(false)),
        "s" | "south" => Token::Axis(Latitude, Some(true)),
        "e" | "east" => Token::Axis(Longitude, Some(false)),
        "w" | "west" => Token::Axis(Longitude, Some(true)),
        "lat" | "latitude" => Token::Axis(Latitude, None),
        "lon" | "lng" | "long" | "longitude" => Token::Axis(Longitude, None),
        _ => return Err(format!("{word:?} has no meaning here")),
    })
}
