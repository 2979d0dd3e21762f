//! Poses and their rates as rows of matrices.

use glam::{DMat3, DVec3};

use super::number::FASTEST;
use crate::base::{Code, Finding, Result};
use crate::geom::Rigid;
use crate::machine::Twist;
use crate::sweep::twist_of;

/// Pose and twist of rows of the matrix `[R p]` and of its derivative `[R' p']` by the second [mm/s, rad/s], each with or
/// without the last row of a rigid motion; errors have the keys `pose` and `rate`.
///
/// # Errors
/// `KC1211` when there is no rate, `KC0102` for anything but three or four rows of four numbers, `KC1202` when the matrix is no
/// rotation, or its rate none of a rotation, `KC0103` for a motion out of all measure.
pub fn twist_of_rows(pose: &[Vec<f64>], rate: Option<&[Vec<f64>]>) -> Result<(Rigid, Twist)> {
    let (rotation, translation) = rows("pose", pose, 1.0)?;
    let rate = rate.ok_or_else(|| {
        Finding::error(Code::GRAZING_MOTION, "a pose without its rate is no motion")
            .key("rate")
            .help("give rate: rows of the derivative [R' p'] per second")
    })?;
    let (turning, velocity) = rows("rate", rate, 0.0)?;
    let pose = Rigid { rotation, translation };
    let twist = twist_of(&pose, turning, velocity).map_err(|e| e.under("pose"))?;
    let most = twist.turn.abs().max_element().max(twist.shift.abs().max_element());
    if most <= FASTEST {
        return Ok((pose, twist));
    }
    Err(Finding::error(Code::JOB_VALUE, "the motion is out of all measure")
        .value(most, "")
        .bound(FASTEST, "")
        .key("rate")
        .into())
}

/// Rows of `[R p]`, with or without the last row `[0 0 0 corner]`.
pub(super) fn rows(key: &str, rows: &[Vec<f64>], corner: f64) -> Result<(DMat3, DVec3)> {
    let shape = |what: &str| {
        Finding::error(Code::JOB_SHAPE, what.to_owned())
            .key(key)
            .help("give three rows of four numbers: [R p]; a fourth row [0, 0, 0, 1], of a rate [0, 0, 0, 0], may follow")
    };
    if !(3..=4).contains(&rows.len()) || rows.iter().any(|r| r.len() != 4) {
        return Err(shape("a matrix has not three or four rows of four numbers").into());
    }
    if rows.iter().flatten().any(|v| !v.is_finite()) {
        return Err(shape("a matrix has a number that is not finite").into());
    }
    if rows.get(3).is_some_and(|last| last[..] != [0.0, 0.0, 0.0, corner]) {
        return Err(shape("the last row of a matrix is not that of a rigid motion").into());
    }
    let column = |k: usize| DVec3::new(rows[0][k], rows[1][k], rows[2][k]);
    Ok((DMat3::from_cols(column(0), column(1), column(2)), column(3)))
}
