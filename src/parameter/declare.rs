//! One declaration for a struct of parameters and its rows.

/// Declares a struct whose fields are parameters: name, type, value where it is left out, row of the table. The first line of a field's documentation is its help.
///
/// It gets `Default`, the conversions of serde (unknown keys are errors, what is left out has its default), the rows as `PARAMETERS`, `check_ranges`, which
/// judges each field by its row, and `or`, which fills in what is left out.
macro_rules! parameters {
    (
        $(#[$attribute:meta])*
        pub struct $name:ident in $table:literal, named $prefix:literal in messages {
            $(
                $(#[doc = $help:literal])+
                $(#[serde($($serde:tt)+)])?
                $field:ident: $type:ty = $default:expr => $row:expr;
            )+
        }
    ) => {
        $(#[$attribute])*
        #[derive(Clone, Debug, PartialEq, serde::Serialize, serde::Deserialize)]
        #[serde(default, deny_unknown_fields)]
        pub struct $name {
            $(
                $(#[doc = $help])+
                #[doc = concat!("\n\nIn the table of parameters: `", stringify!($row), "`.")]
                $(#[serde($($serde)+)])?
                pub $field: $type,
            )+
        }

        impl std::default::Default for $name {
            fn default() -> Self {
                Self { $($field: $default),+ }
            }
        }

        impl $name {
            /// The rows of the table of parameters, in the order of the fields.
            pub const PARAMETERS: &'static [$crate::parameter::Parameter] = &{
                #[allow(unused_imports, reason = "not every struct has parameters of each kind")]
                use $crate::parameter::row::*;
                [$($row.named($table, stringify!($field), $crate::parameter::first_line(&[$($help),+]))),+]
            };

            /// The same with the values of `usual` where none is given.
            #[allow(dead_code, reason = "not every struct has presets")]
            pub(crate) fn or(self, usual: Self) -> Self {
                Self { $($field: $crate::parameter::Checked::or_usual(self.$field, usual.$field)),+ }
            }

            /// Judges each value by its row.
            ///
            /// # Errors
            /// [`crate::Error::Input`] that names the first parameter out of range.
            pub(crate) fn check_ranges(&self) -> $crate::Result<()> {
                let mut rows = Self::PARAMETERS.iter();
                $(
                    if let Some(row) = rows.next() {
                        $crate::parameter::Checked::check(&self.$field, row, concat!($prefix, stringify!($field)))?;
                    }
                )+
                Ok(())
            }
        }
    };
}

pub(crate) use parameters;
