//! Numbers of a motion: finite, and not out of all measure; the error has the key.

use glam::DVec3;

use crate::base::bounded::{MAX_LENGTH, measured};
use crate::base::unit::in_degrees;
use crate::base::{Code, Finding, Result};

/// Largest angle that is taken [degrees]: a thousand turns.
const MOST_DEGREES: f64 = 360_000.0;

/// Largest number of a motion at one moment: beyond it products of velocities overflow nothing yet, and nothing moves so.
pub(super) const FASTEST: f64 = 1e12;

/// Three coordinates [mm].
pub(super) fn place(key: &str, v: [f64; 3]) -> Result<DVec3> {
    for (i, c) in v.into_iter().enumerate() {
        measured(&format!("{key}[{i}]"), c, MAX_LENGTH, "mm")?;
    }
    Ok(DVec3::from(v))
}

/// An angle [rad].
pub(super) fn angle(key: &str, radians: f64) -> Result<f64> {
    measured(key, in_degrees(radians), MOST_DEGREES, "degrees").map(|_| radians)
}

/// A direction, of any length but zero.
pub(super) fn direction(key: &str, v: [f64; 3]) -> Result<DVec3> {
    place(key, v)?.try_normalize().ok_or_else(|| {
        Finding::error(Code::MOVE_NOT_POSSIBLE, "a direction has no length")
            .value_mm(0.0)
            .key(key)
            .help("give a vector such as [0, 0, 1]")
            .into()
    })
}
