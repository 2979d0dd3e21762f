//! The way of a tip: a straight line, an arc, a helix.

use glam::DVec3;

use super::TipTable;
use crate::base::bounded::MAX_LENGTH;
use crate::base::{Code, Finding, Result};
use crate::geom::{Arc, Curve, Line};

/// Largest angle that is taken [degrees]: a thousand turns.
const MOST_DEGREES: f64 = 360_000.0;

/// The curve of a table, and what it is in words.
pub(crate) fn curve(table: &TipTable) -> Result<(Curve, &'static str)> {
    let from = place("from", table.from)?;
    let of_arc = [
        ("centre", table.centre.is_some()),
        ("turn", table.turn.is_some()),
        ("rise", table.rise.is_some()),
        ("about", table.about.is_some()),
    ];
    match (table.to, table.centre, table.turn) {
        (Some(to), _, _) => {
            if let Some((key, _)) = of_arc.iter().find(|k| k.1) {
                let what = format!("`to` ends a straight line, and `{key}` belongs to an arc");
                return Err(shape(what, key, "give to, or centre and turn"));
            }
            let to = place("to", to)?;
            let what = if from == to { "the tip stays" } else { "the tip goes along a straight line" };
            Ok((Line { start: from, end: to }.into(), what))
        }
        (None, Some(centre), Some(turn)) => {
            let centre = place("centre", centre)?;
            let turn = angle("turn", turn)?;
            let rise = length("rise", table.rise.unwrap_or(0.0))?;
            let about = direction("about", table.about.unwrap_or([0.0, 0.0, 1.0]))?;
            let arc = Arc::new(from, centre, about, turn, rise).map_err(|e| e.under("centre"))?;
            let what = if rise == 0.0 { "the tip goes along an arc" } else { "the tip goes along a helix" };
            Ok((arc.into(), what))
        }
        (None, Some(_), None) => Err(shape("an arc has no angle".to_owned(), "turn", "give turn in degrees")),
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

fn shape(what: String, key: &str, help: &str) -> crate::base::Error {
    Finding::error(Code::JOB_SHAPE, what).key(key).help(help).into()
}

fn value(key: String, v: f64, bound: f64, unit: &str) -> crate::base::Error {
    Finding::error(Code::JOB_VALUE, "a number is not finite or out of all measure")
        .value(v, unit)
        .bound(bound, unit)
        .key(key)
        .into()
}

/// Three coordinates [mm].
pub(crate) fn place(key: &str, v: [f64; 3]) -> Result<DVec3> {
    match v.iter().position(|c| !(c.abs() <= MAX_LENGTH)) {
        Some(i) => Err(value(format!("{key}[{i}]"), v[i], MAX_LENGTH, "mm")),
        None => Ok(DVec3::from(v)),
    }
}

/// A length [mm].
pub(crate) fn length(key: &str, v: f64) -> Result<f64> {
    if v.abs() <= MAX_LENGTH { Ok(v) } else { Err(value(key.to_owned(), v, MAX_LENGTH, "mm")) }
}

/// An angle [rad].
pub(crate) fn angle(key: &str, degrees: f64) -> Result<f64> {
    if degrees.abs() <= MOST_DEGREES {
        Ok(degrees.to_radians())
    } else {
        Err(value(key.to_owned(), degrees, MOST_DEGREES, "degrees"))
    }
}

/// A direction, of any length but zero.
pub(crate) fn direction(key: &str, v: [f64; 3]) -> Result<DVec3> {
    place(key, v)?.try_normalize().ok_or_else(|| {
        Finding::error(Code::MOVE_NOT_POSSIBLE, "a direction has no length")
            .value_mm(0.0)
            .key(key)
            .help("give a vector such as [0, 0, 1]")
            .into()
    })
}
