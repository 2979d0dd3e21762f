//! The path of a tip: a straight line, an arc, a helix.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::number::{angle, direction, place};
use crate::base::bounded::{MAX_LENGTH, measured};
use crate::base::unit::Deg;
use crate::base::{Code, Error, Finding, Result};
use crate::geom::{Arc, Curve, Line};

/// A curve of the tip: a straight line (`from`, `to`), or an arc or helix (`from`, `centre`, `turn`, `rise`, `about`).
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct TipPath {
    /// Start of the tip, mm.
    #[schemars(example = vec![0, 0, 0])]
    pub from: [f64; 3],
    /// End of a straight line, mm.
    #[serde(default)]
    pub to: Option<[f64; 3]>,
    /// A point of the axis of an arc, mm.
    #[serde(default)]
    pub centre: Option<[f64; 3]>,
    /// Angle of an arc, degrees in a file, right-handed about `about`; two turns of a helix are 720.
    #[serde(default, with = "Deg::<Option<f64>>")]
    pub turn: Option<f64>,
    /// Movement along the axis of an arc over the whole of it, mm; default 0.
    #[serde(default)]
    pub rise: Option<f64>,
    /// Direction of the axis of an arc; default [0, 0, 1].
    #[serde(default)]
    pub about: Option<[f64; 3]>,
}

impl TipPath {
    /// The curve [mm].
    ///
    /// ```
    /// # use kinecut_stock as kinecut;
    /// use kinecut::sweep::TipPath;
    /// let line = TipPath { from: [0.0; 3], to: Some([3.0, 4.0, 0.0]), centre: None, turn: None, rise: None, about: None };
    /// assert_eq!(line.curve().unwrap().length(), 5.0);
    /// let refused = TipPath { rise: Some(1.0), ..line }.curve().unwrap_err();
    /// assert_eq!(refused.0.key.as_deref(), Some("rise"));
    /// ```
    ///
    /// # Errors
    /// `KC0102` when it is neither a line nor an arc, `KC0103` for numbers out of all measure, `KC1203` for an axis without
    /// length, those of [`Arc::new`]; each with its key.
    pub fn curve(&self) -> Result<Curve> {
        let from = place("from", self.from)?;
        let of_arc = [
            ("centre", self.centre.is_some()),
            ("turn", self.turn.is_some()),
            ("rise", self.rise.is_some()),
            ("about", self.about.is_some()),
        ];
        match (self.to, self.centre, self.turn) {
            (Some(to), _, _) => {
                if let Some((key, _)) = of_arc.iter().find(|k| k.1) {
                    let what = format!("`to` ends a straight line, and `{key}` belongs to an arc");
                    return Err(shape(what, key, "give to, or centre and turn"));
                }
                Ok(Line { start: from, end: place("to", to)? }.into())
            }
            (None, Some(centre), Some(turn)) => {
                let centre = place("centre", centre)?;
                let turn = angle("turn", turn)?;
                let rise = measured("rise", self.rise.unwrap_or(0.0), MAX_LENGTH, "mm")?;
                let about = direction("about", self.about.unwrap_or([0.0, 0.0, 1.0]))?;
                Arc::new(from, centre, about, turn, rise).map(Curve::from).map_err(|e| e.under("centre"))
            }
            (None, Some(_), None) => {
                Err(shape("an arc has no angle".to_owned(), "turn", "give turn in degrees"))
            }
            (None, None, Some(_)) => {
                Err(shape("an arc has no centre".to_owned(), "centre", "give centre, a point of its axis"))
            }
            (None, None, None) => Err(shape(
                "the way of the tip has no end".to_owned(),
                "to",
                "give to for a straight line, or centre and turn for an arc",
            )),
        }
    }
}

fn shape(what: String, key: &str, help: &str) -> Error {
    Finding::error(Code::JOB_SHAPE, what).key(key).help(help).into()
}
