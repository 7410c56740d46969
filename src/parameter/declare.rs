//! The declaration of settings.

use super::{TableShape, Value};

/// Settings of which each parameter is said once, by [`settings!`].
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

/// A struct of settings, each parameter a row: what it means; where the paper speaks of it; name, type and default as in Rust; what its values
/// look like, if that is narrower than the type.
///
/// ```ignore
/// settings! {
///     /// Parameters of stencil volumes.
///     pub struct Settings of "stencil-volume" {
///         /// n: n x n samples a pixel.
///         "Schneider & Klein 5" samples: u32 = 1, Shape::Integer(1, 16);
///     }
/// }
/// ```
///
/// makes `struct Settings { pub samples: u32 }`, its `Default` and its [`Settings`].
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

        impl $crate::parameter::Settings for $name {
            const NAME: &'static str = $table;
            const TABLE: &'static $crate::parameter::TableShape = &$crate::parameter::TableShape {
                keys: &[$($crate::parameter::Key {
                    name: stringify!($field),
                    shape: $crate::parameter::settings!(@shape $type $(, $shape)?),
                    required: false,
                    doc: concat!($($doc),+).trim_ascii(),
                    section: [$(Some($section),)? None][0],
                    default: Some(|| {
                        let shape = $crate::parameter::settings!(@shape $type $(, $shape)?);
                        $crate::parameter::Setting::to_value(&Self::default().$field, &shape)
                    }),
                }),+],
                rules: &[],
            };

            fn from_values(said: &dyn Fn(&str) -> Option<$crate::parameter::Value>) -> Self {
                let mut settings = Self::default();
                $(
                    let shape = $crate::parameter::settings!(@shape $type $(, $shape)?);
                    let value = said(stringify!($field));
                    if let Some(value) = value.and_then(|value| $crate::parameter::Setting::from_value(&value, &shape)) {
                        settings.$field = value;
                    }
                )+
                settings
            }

            fn values(&self) -> Vec<(&'static str, $crate::parameter::Value)> {
                vec![$({
                    let shape = $crate::parameter::settings!(@shape $type $(, $shape)?);
                    (stringify!($field), $crate::parameter::Setting::to_value(&self.$field, &shape))
                }),+]
            }
        }
    };
    (@shape $type:ty) => { <$type as $crate::parameter::Setting>::SHAPE };
    (@shape $type:ty, $shape:expr) => { $shape };
}
pub(crate) use settings;
