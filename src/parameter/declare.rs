//! The declaration of settings.

use super::{TableShape, Value};

/// Settings of which each parameter is said once, by `settings!`.
pub trait Settings: Copy + Default + PartialEq {
    /// The name of the table of the scene file that holds them.
    const NAME: &'static str;
    /// Its keys: the parameters.
    const TABLE: &'static TableShape;

    /// The settings of which some values are said; the others have their defaults.
    fn from_values(said: &dyn Fn(&str) -> Option<Value>) -> Self;

    /// The values of all parameters by their names, in the order of the table.
    fn values(&self) -> Vec<(&'static str, Value)>;
}

/// A struct of settings, each parameter a row: what it means; where the paper speaks of it; name, type and default as in Rust; what its
/// values look like, where that is narrower than the type.
///
/// ```text
/// settings! {
///     /// Parameters of inverse projection.
///     pub struct Settings of "inverse-projection" {
///         /// n: n x n samples in each P pixel.
///         "She 3.4" samples: u32 = 3, Shape::Integer(1, 64);
///     }
/// }
/// ```
///
/// makes `struct Settings { pub samples: u32 }`, its `Default` and its [`Settings`]: the table of keys, and the way from and to plain values.
macro_rules! settings {
    (
        $(#[$about:meta])*
        pub struct $name:ident of $table:literal {
            $($(#[doc = $doc:literal])+ $($section:literal)? $field:ident: $type:ty = $default:expr $(, $shape:expr)?;)+
        }
    ) => {
        $(#[$about])*
        #[derive(Debug, Clone, Copy, PartialEq)]
        pub struct $name {
            $($(#[doc = $doc])+ $(#[doc = concat!("\n\n", $section, ".")])? pub $field: $type,)+
        }

        impl Default for $name {
            fn default() -> Self {
                Self { $($field: $default),+ }
            }
        }

        const _: () = {
            use $crate::parameter::{self, Setting as _};

            impl parameter::Settings for $name {
                const NAME: &'static str = $table;
                const TABLE: &'static parameter::TableShape = &parameter::TableShape {
                    keys: &[$(parameter::Key {
                        name: stringify!($field),
                        shape: parameter::settings!(@shape $type $(, $shape)?),
                        required: false,
                        doc: concat!($($doc),+).trim_ascii(),
                        section: [$(Some($section),)? None][0],
                        default: Some(|| {
                            Self::default().$field.to_value(&parameter::settings!(@shape $type $(, $shape)?))
                        }),
                    }),+],
                    rules: &[],
                };

                fn from_values(said: &dyn Fn(&str) -> Option<parameter::Value>) -> Self {
                    let mut settings = Self::default();
                    $(if let Some(value) = said(stringify!($field)) {
                        let shape = parameter::settings!(@shape $type $(, $shape)?);
                        settings.$field = <$type>::from_value(&value, &shape).unwrap_or(settings.$field);
                    })+
                    settings
                }

                fn values(&self) -> Vec<(&'static str, parameter::Value)> {
                    vec![$((
                        stringify!($field),
                        self.$field.to_value(&parameter::settings!(@shape $type $(, $shape)?)),
                    )),+]
                }
            }
        };
    };
    // What values look like: as the row says, else as the type does.
    (@shape $type:ty) => { <$type as parameter::Setting>::SHAPE };
    (@shape $type:ty, $shape:expr) => { $shape };
}
pub(crate) use settings;
