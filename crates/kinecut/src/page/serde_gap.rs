//! Lists of numbers in which NaN means "no value here": JSON has no NaN, so a gap is written as `null`.

use serde::de::Deserialize;
use serde::ser::SerializeSeq;
use serde::{Deserializer, Serializer};

/// For `Vec<f32>`.
pub(crate) mod numbers {
    use super::*;

    pub(crate) fn serialize<S: Serializer>(values: &[f32], s: S) -> Result<S::Ok, S::Error> {
        let mut seq = s.serialize_seq(Some(values.len()))?;
        for v in values {
            seq.serialize_element(&v.is_finite().then_some(*v))?;
        }
        seq.end()
    }

    pub(crate) fn deserialize<'de, D: Deserializer<'de>>(d: D) -> Result<Vec<f32>, D::Error> {
        let values = Vec::<Option<f32>>::deserialize(d)?;
        Ok(values.into_iter().map(|v| v.unwrap_or(f32::NAN)).collect())
    }
}

/// For `Vec<[f64; 2]>`; a point with one gap is a gap.
pub(crate) mod points {
    use super::*;

    pub(crate) fn serialize<S: Serializer>(points: &[[f64; 2]], s: S) -> Result<S::Ok, S::Error> {
        let mut seq = s.serialize_seq(Some(points.len()))?;
        for p in points {
            seq.serialize_element(&p.iter().all(|v| v.is_finite()).then_some(*p))?;
        }
        seq.end()
    }

    pub(crate) fn deserialize<'de, D: Deserializer<'de>>(d: D) -> Result<Vec<[f64; 2]>, D::Error> {
        let points = Vec::<Option<[f64; 2]>>::deserialize(d)?;
        Ok(points.into_iter().map(|p| p.unwrap_or([f64::NAN; 2])).collect())
    }
}
