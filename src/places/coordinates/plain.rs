//! Coordinates as a person writes them: two halves of up to three numbers each.

use super::tokens::{Axis, Comma, Token, cut, tight_commas};
use super::{Coordinates, refuse};
use crate::error::{Error, check_range};

/// Why a reading fails: what is wrong with the text, or a number that is out of range.
enum Failure {
    Text(String),
    Number(Error),
}

/// One of the two coordinates.
struct Half {
    axis: Option<Axis>,
    value: f64,
    numbers: usize,
    has_degree_sign: bool,
}

/// Reads `text`, with commas between digits in both of their meanings where it has any.
pub(super) fn read(text: &str) -> crate::Result<Coordinates> {
    if text.trim().is_empty() {
        return Err(refuse(text, "nothing is given"));
    }
    let commas = tight_commas(text);
    let separated = read_as(text, Comma::Separator);
    let decimal = if commas > 0 && !text.contains('.') { Some(read_as(text, Comma::Decimal)) } else { None };
    let is_two_ways = |one: &Coordinates, other: &Coordinates| one != other;
    match (separated, decimal) {
        (Ok(one), Some(Ok(other))) if is_two_ways(&one, &other) => {
            Err(refuse(text, &format!("{one} and {other} are both possible: write decimal points")))
        }
        (Ok(found), _) | (Err(_), Some(Ok(found))) => Ok(found),
        (Err(_), Some(Err(_))) if commas > 1 && !text.trim().contains(char::is_whitespace) => {
            Err(refuse(text, "commas could be decimal or separate numbers: write decimal points"))
        }
        (_, Some(Err(Failure::Number(error)))) | (Err(Failure::Number(error)), _) => Err(error),
        (Err(Failure::Text(reason)), _) => Err(refuse(text, &reason)),
    }
}

fn read_as(text: &str, comma: Comma) -> Result<Coordinates, Failure> {
    let tokens = cut(text, comma).map_err(Failure::Text)?;
    let (first, second) = halves(&tokens).map_err(Failure::Text)?;
    let (first, second) = (half(first)?, half(second)?);
    let says_which = first.axis.is_some() || second.axis.is_some();
    if !says_which && first.numbers != second.numbers && !(first.has_degree_sign && second.has_degree_sign) {
        let reason = "latitude and longitude must have as many numbers each, or letters N, S, E, W";
        return Err(Failure::Text(reason.to_string()));
    }
    let is_swapped = match (first.axis, second.axis) {
        (Some(one), Some(other)) if one == other => {
            return Err(Failure::Text("one must be a latitude (N, S), the other a longitude (E, W)".to_string()));
        }
        (Some(axis), _) => axis == Axis::Longitude,
        (None, axis) => axis == Some(Axis::Latitude),
    };
    let (latitude, longitude) = if is_swapped { (second.value, first.value) } else { (first.value, second.value) };
    let order = if says_which { "" } else { ", which comes first" };
    check_range("latitude", latitude, -90.0, 90.0, &format!("degrees{order}")).map_err(Failure::Number)?;
    check_range("longitude", longitude, -180.0, 180.0, "degrees").map_err(Failure::Number)?;
    Ok(Coordinates { latitude_deg: latitude, longitude_deg: longitude })
}

/// Cuts the pieces between latitude and longitude.
fn halves(tokens: &[Token]) -> Result<(&[Token], &[Token]), String> {
    let places = |wanted: fn(&Token) -> bool| -> Vec<usize> {
        tokens.iter().enumerate().filter(|(_, token)| wanted(token)).map(|(index, _)| index).collect()
    };
    let separators = places(|token| *token == Token::Separator);
    let axes = places(|token| matches!(token, Token::Axis(..)));
    let numbers = places(|token| matches!(token, Token::Number { .. }));
    let signed = places(|token| matches!(token, Token::Number { sign: Some(_), .. }));
    let degrees = places(|token| *token == Token::Unit(0));
    match (separators.as_slice(), axes.as_slice()) {
        (&[at], _) => return Ok((&tokens[..at], &tokens[at + 1..])),
        ([], &[0, second]) => return Ok(tokens.split_at(second)),
        ([], &[first, _]) => return Ok(tokens.split_at(first + 1)),
        ([], []) => {}
        ([], _) => return Err("both or neither must have a letter N, S, E or W".to_string()),
        _ => return Err("only one comma may stand between latitude and longitude".to_string()),
    }
    if numbers.len() < 2 {
        return Err("two numbers are needed".to_string());
    }
    let by_sign = signed.iter().find(|&&at| at != numbers[0]);
    let at = match (degrees.as_slice(), by_sign) {
        // The number that the second sign of degrees follows.
        (&[_, second], _) => numbers.iter().copied().take_while(|&at| at < second).last().unwrap_or(0),
        (_, Some(&at)) => at,
        _ if numbers.len().is_multiple_of(2) => numbers[numbers.len() / 2],
        _ => return Err("where latitude ends is not clear: put a comma".to_string()),
    };
    Ok(tokens.split_at(at))
}

/// Degrees, perhaps minutes, perhaps seconds, with a letter or a name before or after them.
fn half(tokens: &[Token]) -> Result<Half, Failure> {
    let fail = |reason: &str| Err(Failure::Text(reason.to_string()));
    let mut half = Half { axis: None, value: 0.0, numbers: 0, has_degree_sign: false };
    let (mut negative, mut has_sign, mut ended) = (false, false, false);
    for (index, token) in tokens.iter().enumerate() {
        match *token {
            Token::Axis(axis, other_side) => {
                if half.axis.is_some_and(|before| before != axis || index + 1 < tokens.len())
                    || (index > 0 && index + 1 < tokens.len())
                {
                    return fail("a letter N, S, E or W stands before or after its numbers");
                }
                half.axis = Some(axis);
                if let Some(other_side) = other_side {
                    if has_sign {
                        return fail("a sign and a letter N, S, E or W exclude each other");
                    }
                    (negative, has_sign) = (other_side, true);
                }
            }
            Token::Number { size, sign, has_fraction } => {
                if ended || half.numbers == 3 {
                    return fail(
                        "only the last number may have a fraction, after degrees, minutes and seconds there is no other",
                    );
                }
                if let Some(minus) = sign {
                    if half.numbers > 0 {
                        return fail("only degrees may have a sign");
                    }
                    if has_sign {
                        return fail("a sign and a letter N, S, E or W exclude each other");
                    }
                    (negative, has_sign) = (minus, true);
                }
                if half.numbers > 0 {
                    let name = ["", "minutes", "seconds"][half.numbers];
                    if size >= 60.0 {
                        return Err(Failure::Number(Error::input(name, size, "at least 0 and less than 60")));
                    }
                }
                half.value += size / 60_f64.powi(half.numbers as i32);
                half.numbers += 1;
                ended = has_fraction;
            }
            Token::Unit(unit) => {
                let after_its_number = index > 0 && matches!(tokens[index - 1], Token::Number { .. });
                if !after_its_number || unit + 1 != half.numbers {
                    return fail("signs of degrees, minutes and seconds follow their numbers in this order");
                }
                half.has_degree_sign |= unit == 0;
            }
            Token::Separator => return fail("a comma stands only between latitude and longitude"),
        }
    }
    if half.numbers == 0 {
        return fail("two numbers are needed");
    }
    if negative {
        half.value = -half.value;
    }
    Ok(half)
}
