//! Choices that users spell as words: one list serves Rust, Python, JSON and the command line.

/// What every such choice can do.
pub trait Words: Copy + 'static {
    /// The words, in the order in which they are listed to users.
    const WORDS: &'static [&'static str];

    /// The word for this choice.
    fn word(self) -> &'static str;
}

/// "a or b", "a, b or c"; more as "one of a, b, c, d".
pub(crate) fn listed(words: &[&str]) -> String {
    match words {
        [] | [_] => words.concat(),
        [first @ .., last] if words.len() < 4 => format!("{} or {last}", first.join(", ")),
        _ => format!("one of {}", words.join(", ")),
    }
}

/// Gives an enum `ALL`, `name()`, [`Words`], `FromStr`, `Display` and the conversions that serde needs (`#[serde(try_from = "String", into = "String")]`). Reading an
/// unknown word is an [`crate::Error::Input`] that names `$parameter` and lists the words.
macro_rules! words {
    ($type:ident, $parameter:literal, { $($variant:ident => $word:literal $(| $alias:literal)*),+ $(,)? }) => {
        impl $type {
            /// All choices, in the order in which they are listed to users.
            pub const ALL: [Self; [$($word),+].len()] = [$(Self::$variant),+];

            /// The word used in Python, JSON and on the command line.
            pub const fn name(self) -> &'static str {
                match self {
                    $(Self::$variant => $word),+
                }
            }
        }

        impl $crate::words::Words for $type {
            const WORDS: &'static [&'static str] = &[$($word),+];

            fn word(self) -> &'static str {
                self.name()
            }
        }

        impl std::str::FromStr for $type {
            type Err = $crate::Error;

            fn from_str(text: &str) -> $crate::Result<Self> {
                match text {
                    $($word $(| $alias)* => Ok(Self::$variant),)+
                    _ => {
                        let words = <Self as $crate::words::Words>::WORDS;
                        Err($crate::Error::input($parameter, $crate::error::quoted(text), $crate::words::listed(words)))
                    }
                }
            }
        }

        impl std::fmt::Display for $type {
            fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
                f.write_str(self.name())
            }
        }

        impl TryFrom<String> for $type {
            type Error = $crate::Error;

            fn try_from(text: String) -> $crate::Result<Self> {
                text.parse()
            }
        }

        impl From<$type> for String {
            fn from(choice: $type) -> Self {
                choice.name().to_owned()
            }
        }
    };
}

pub(crate) use words;

#[cfg(test)]
mod tests {
    use super::*;
    use serde::{Deserialize, Serialize};

    #[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
    #[serde(try_from = "String", into = "String")]
    enum Cover {
        Clear,
        Few,
    }

    words!(Cover, "cover", { Clear => "clear" | "none", Few => "few" });

    #[test]
    fn words_read_back_and_others_are_refused_by_name() {
        for cover in Cover::ALL {
            assert_eq!(cover.name().parse::<Cover>().unwrap(), cover);
            assert_eq!(serde_json::to_string(&cover).unwrap(), format!("\"{cover}\""));
        }
        assert_eq!(
            ("none".parse::<Cover>().unwrap(), Cover::WORDS, Cover::Few.word()),
            (Cover::Clear, &["clear", "few"][..], "few")
        );
        assert_eq!("full".parse::<Cover>().unwrap_err().to_string(), "cover = \"full\": must be clear or few");
        assert!(serde_json::from_str::<Cover>("\"full\"").unwrap_err().to_string().contains("must be clear or few"));
    }

    #[test]
    fn few_words_are_a_sentence_and_many_a_list() {
        assert_eq!(listed(&["a"]), "a");
        assert_eq!(listed(&["a", "b", "c"]), "a, b or c");
        assert_eq!(listed(&["a", "b", "c", "d"]), "one of a, b, c, d");
    }
}
