//! A layout with its scores.

use serde::{Serialize, Serializer};

use super::{Attitude, LayoutKind, Reach, Scores, Workspace};
use crate::machine::{CoordinateCode, Word};

/// A layout with what is known of it.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Layout {
    /// Axes from workpiece to tool, with the bed.
    #[serde(flatten, serialize_with = "code_and_iso")]
    pub code: CoordinateCode,
    /// The canonical word of its class: layouts of one class position alike.
    #[serde(serialize_with = "text")]
    pub class: Word,
    /// Kind, by the sides of the bed on which the rotary axes are.
    #[serde(serialize_with = "text")]
    pub kind: LayoutKind,
    /// Attitude of the spindle.
    #[serde(rename = "spindle", serialize_with = "attitude_name")]
    pub attitude: Attitude,
    /// Rank modulo the spin of the tool: 5 when it brings the tool to every place in every direction.
    pub rank: usize,
    /// True if the translations stay at right angles whatever the rotary axes do.
    pub regular: bool,
    /// Raw scores.
    #[serde(flatten)]
    pub scores: Scores,
    /// Strokes of X, Y, Z that part and tool need, or the strokes given where there is no part [mm].
    pub stroke: [f64; 3],
    /// Directions that the tool's axis reaches; for those listed.
    #[serde(flatten, serialize_with = "cover_and_tilt")]
    pub reach: Option<Reach>,
    /// Measures of the workspace; for those listed.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub workspace: Option<Workspace>,
    /// Weighted sum of the scores, each from 0 for the best to 1 for the worst of the list.
    pub cost: f64,
    /// True if no other layout is as good in all that counts and better in something.
    pub pareto: bool,
}

fn text<T: ToString, S: Serializer>(value: &T, serializer: S) -> std::result::Result<S::Ok, S::Error> {
    serializer.serialize_str(&value.to_string())
}

fn attitude_name<S: Serializer>(attitude: &Attitude, serializer: S) -> std::result::Result<S::Ok, S::Error> {
    serializer.serialize_str(attitude.name())
}

/// Digits, and the chain as ISO 10791 writes it.
fn code_and_iso<S: Serializer>(code: &CoordinateCode, serializer: S) -> std::result::Result<S::Ok, S::Error> {
    serializer.collect_map([("code", code.to_string()), ("iso", code.iso())])
}

/// Share of the directions, and the tilt in degrees.
fn cover_and_tilt<S: Serializer>(
    reach: &Option<Reach>,
    serializer: S,
) -> std::result::Result<S::Ok, S::Error> {
    let tilt = reach.map(|r| r.tilt.to_degrees());
    serializer.collect_map([("cover", reach.map(|r| r.cover)), ("tilt_deg", tilt)])
}
