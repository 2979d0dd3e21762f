//! The certified bound of one box of placements: what the search believes, for others to check.

use super::Options;
use super::boxes::Boxes;
use super::domain::Domain;
use super::objective::Objective;
use super::search::{Node, Relaxation};
use super::straight::Straight;
use super::sweep::Sweep;
use crate::base::{Code, Finding, Result};
use crate::facing::{FaceCase, Placement};

/// No allowed placement whose angle lies within half of `spread[0]` [rad] of the middle's, and whose offset from the
/// middle of the part lies within half of `spread[1]` [mm] of the middle's, has a bad length less than this [mm];
/// infinite where none is allowed.
///
/// # Errors
/// `KC1001` for options that make no sense, or an angle spread that is not within 0 to 1.
pub fn box_bound(case: &FaceCase, options: &Options, middle: Placement, spread: [f64; 2]) -> Result<f64> {
    options.check(case)?;
    if !((0.0..=1.0).contains(&spread[0]) && spread[1] >= 0.0) {
        return Err(Finding::error(Code::FACE_CASE, "a box of placements spans one radian at most")
            .value(spread[0], "rad")
            .bound(1.0, "rad")
            .into());
    }
    let domain = Domain::new(case, options);
    let objective = Objective::new(case, &domain);
    let local = domain.local(middle);
    let half = [0.5 * spread[0], 0.5 * spread[1]];
    let node = Node {
        angle: [middle.angle - half[0], middle.angle + half[0]],
        offset: [local - half[1], local + half[1]],
    };
    let boxes = Boxes(&objective).bound(&node, &mut ()).lower;
    if objective.circular() {
        return Ok(boxes);
    }
    let straight = Straight::new(&objective).bound(&node, &mut Sweep::default()).lower;
    Ok(if boxes > straight { boxes } else { straight })
}
