//! Units of a file: a number is written in the unit of the trade and kept in the unit of the program.
//!
//! `#[serde(with = "Deg")]` on an angle: degrees in the file, radians in the type; `MmPerMin` on a feed. What is read is
//! written back as it was: an angle up to nine decimals and 10^5 degrees (two conversions change it by less than four parts
//! in 10^16, so that the nearest multiple of 10^-9 degrees is the one that was written), a feed up to fifteen digits.

use std::f64::consts::TAU;
use std::marker::PhantomData;

use schemars::{JsonSchema, Schema, SchemaGenerator};
use serde::{Deserialize, Deserializer, Serialize, Serializer};

/// Decimals of a degree that are written.
const DECIMALS: f64 = 1e9;
/// Largest angle that is rounded [deg]: above it the decimals are beyond the digits of a number.
const ROUNDED: f64 = 1e5;

/// A value that is converted number by number.
pub trait Each {
    /// The value with each of its numbers converted.
    fn each(&self, convert: fn(f64) -> f64) -> Self;
}

impl Each for f64 {
    fn each(&self, convert: fn(f64) -> f64) -> f64 {
        convert(*self)
    }
}

impl<T: Each> Each for Option<T> {
    fn each(&self, convert: fn(f64) -> f64) -> Option<T> {
        self.as_ref().map(|v| v.each(convert))
    }
}

impl<T: Each, const N: usize> Each for [T; N] {
    fn each(&self, convert: fn(f64) -> f64) -> [T; N] {
        self.each_ref().map(|v| v.each(convert))
    }
}

/// A unit of a file: its type, and the two conversions of a number.
macro_rules! unit {
    ($(#[$doc:meta])* $unit:ident, $read:expr, $written:expr) => {
        $(#[$doc])*
        pub struct $unit<T = f64>(PhantomData<T>);

        impl<T: Each + Serialize> $unit<T> {
            /// Writes the unit of the file.
            ///
            /// # Errors
            /// Those of the serializer.
            pub fn serialize<S: Serializer>(value: &T, serializer: S) -> Result<S::Ok, S::Error> {
                value.each($written).serialize(serializer)
            }
        }

        impl<'de, T: Each + Deserialize<'de>> $unit<T> {
            /// Reads the unit of the file.
            ///
            /// # Errors
            /// Those of the deserializer.
            pub fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<T, D::Error> {
                T::deserialize(deserializer).map(|v| v.each($read))
            }
        }

        impl<T: JsonSchema> JsonSchema for $unit<T> {
            fn inline_schema() -> bool {
                true
            }

            fn schema_name() -> std::borrow::Cow<'static, str> {
                T::schema_name()
            }

            fn json_schema(generator: &mut SchemaGenerator) -> Schema {
                T::json_schema(generator)
            }
        }
    };
}

unit! {
    /// Degrees in a file of a value in radians: `f64`, `Option<f64>` or a list `[f64; N]`.
    Deg, f64::to_radians, in_degrees
}

unit! {
    /// Millimetres in a minute in a file of a value in mm/s: `f64` or `Option<f64>`.
    MmPerMin, |feed| feed / 60.0, in_mm_per_min
}

/// An angle of whole degrees [rad]: the default of a key.
pub fn degrees<const DEG: u16>() -> f64 {
    f64::from(DEG).to_radians()
}

/// An angle [rad] in degrees, as it was written.
pub fn in_degrees(radians: f64) -> f64 {
    let degrees = radians.to_degrees();
    if degrees.abs() < ROUNDED { (degrees * DECIMALS).round() / DECIMALS } else { degrees }
}

/// Writes an angle [rad] in degrees, with all digits of the conversion: an angle that was computed.
///
/// # Errors
/// Those of the serializer.
pub fn computed_degrees<S: Serializer>(radians: &f64, serializer: S) -> Result<S::Ok, S::Error> {
    serializer.serialize_f64(radians.to_degrees())
}

/// A turn [rad] in degrees from 0 to less than 360.
pub fn turn_in_degrees(radians: f64) -> f64 {
    let turned = radians.rem_euclid(TAU).to_degrees();
    if turned < 360.0 { turned } else { 0.0 }
}

/// Writes a turn [rad] in degrees from 0 to less than 360.
///
/// # Errors
/// Those of the serializer.
pub fn turn_degrees<S: Serializer>(radians: &f64, serializer: S) -> Result<S::Ok, S::Error> {
    serializer.serialize_f64(turn_in_degrees(*radians))
}

/// A feed [mm/s] in mm/min, as it was written: two conversions change it by less than four parts in 10^16, so that the
/// nearest number of fifteen digits is the one that was written.
fn in_mm_per_min(feed: f64) -> f64 {
    let feed = 60.0 * feed;
    format!("{feed:.14e}").parse().unwrap_or(feed)
}

/// The key of a variant as a file has it: `twist` for `{ twist = { .. } }` and for `"twist"`.
pub fn variant_key(value: &impl Serialize) -> String {
    match serde_json::to_value(value) {
        Ok(serde_json::Value::Object(table)) => {
            table.into_iter().next().map_or(String::new(), |(key, _)| key)
        }
        Ok(serde_json::Value::String(key)) => key,
        _ => String::new(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    #[derive(Debug, PartialEq, Serialize, Deserialize)]
    #[serde(rename_all = "kebab-case")]
    enum Angles {
        TwoOf {
            #[serde(with = "Deg")]
            one: f64,
            #[serde(default, with = "Deg::<Option<f64>>")]
            other: Option<f64>,
        },
        Nothing,
    }

    fn again(text: &str) -> String {
        let read: f64 = text.parse().unwrap();
        in_degrees(read.to_radians()).to_string()
    }

    #[test]
    fn thousandths_of_a_degree_are_written_as_they_were_read() {
        for n in -720_000..=720_000 {
            let degrees = f64::from(n) / 1000.0;
            assert_eq!(in_degrees(degrees.to_radians()).to_bits(), degrees.to_bits(), "{degrees}");
        }
    }

    proptest! {
        #![proptest_config(kinecut_cases::property(4096))]
        #[test]
        fn nine_decimals_are_written_as_they_were_read(whole in -99_999i32..100_000, part in 0u32..1_000_000_000, places in 0usize..=9) {
            let text = format!("{whole}.{}", &format!("{part:09}")[..places.max(1)]);
            prop_assert_eq!(again(&text), text.parse::<f64>().unwrap().to_string());
        }
    }

    proptest! {
        #![proptest_config(kinecut_cases::property(4096))]
        #[test]
        fn fifteen_digits_of_a_feed_are_written_as_they_were_read(digits in 1u64..1_000_000_000_000_000, power in -20i32..10) {
            let feed: f64 = format!("{digits}e{power}").parse().unwrap();
            prop_assert_eq!(in_mm_per_min(feed / 60.0).to_bits(), feed.to_bits());
        }
    }

    #[test]
    fn keys_and_options_are_those_of_the_file() {
        let text = r#"{"two-of":{"one":118.0,"other":0.1}}"#;
        let read: Angles = serde_json::from_str(text).unwrap();
        assert_eq!(read, Angles::TwoOf { one: 118f64.to_radians(), other: Some(0.1f64.to_radians()) });
        assert_eq!(serde_json::to_string(&read).unwrap(), text);
        assert_eq!(
            (variant_key(&read), variant_key(&Angles::Nothing)),
            ("two-of".to_owned(), "nothing".to_owned())
        );
        assert_eq!(in_degrees(f64::MAX.to_radians()), f64::MAX.to_radians().to_degrees());
        assert_eq!(degrees::<180>(), std::f64::consts::PI);
    }
}
