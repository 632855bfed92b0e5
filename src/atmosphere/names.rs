//! Choices that users spell as words: one list serves Rust, Python, JSON and the command line.

/// Gives an enum `ALL`, `name()`, `FromStr` and the conversions that serde needs. Reading an unknown word is an
/// [`crate::Error::Input`] that names `$parameter` and lists the words.
macro_rules! words {
    ($type:ident, $parameter:literal, { $($variant:ident => $word:literal $(| $alias:literal)*),+ $(,)? }) => {
        impl $type {
            /// All choices.
            pub const ALL: &[Self] = &[$(Self::$variant),+];

            /// The word used in Python, JSON and on the command line.
            pub fn name(self) -> &'static str {
                match self {
                    $(Self::$variant => $word),+
                }
            }
        }

        impl std::str::FromStr for $type {
            type Err = $crate::Error;

            fn from_str(text: &str) -> $crate::Result<Self> {
                match text {
                    $($word $(| $alias)* => Ok(Self::$variant),)+
                    _ => {
                        let words: Vec<&str> = Self::ALL.iter().map(|choice| choice.name()).collect();
                        Err($crate::Error::input($parameter, format!("{text:?}"), format!("one of {}", words.join(", "))))
                    }
                }
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
