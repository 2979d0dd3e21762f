//! The entry of a compensation: the move on which the tool goes from the place where it is to the parallel.
//!
//! Straight on all controls. LinuxCNC takes an arc too (`convert_arc_comp1` of `interp_convert.cc`): it ends where the parallel of
//! the programmed arc does, in its direction there, and begins where the tool is, so that its radius is another. With P the end,
//! S the start and u the direction from P to the programmed centre, the new centre is P + u c, c = |S - P| / (2 cos(S - P, u)).

use std::f64::consts::TAU;

use glam::DVec2;

use crate::base::{Error, Finding, Result};

use super::flat::{Flat, Shape};
use super::{CompStart, Programmed, refused};

/// Cosine below which LinuxCNC finds no arc through both places (`TOLERANCE_EQUAL`).
const SQUARE: f64 = 1e-4;
/// Part of a turn that is rounding.
const WHOLE: f64 = 1e-9;

/// Checks the entry of a compensation of `d`.
pub(super) fn check(entry: &Programmed, d: f64, start: CompStart) -> Result<()> {
    let length = match Flat::of(&entry.curve) {
        // The way as the crow flies.
        Shape::Flat(Flat::Arc { start: from, centre, sweep }) if start == CompStart::AtEntry => {
            from.distance(Flat::Arc { start: from, centre, sweep }.end().0)
        }
        _ => straight(entry, "the start of a compensation")?,
    };
    if length <= d.abs() {
        return Err(refused(entry.item, "the entry of a compensation is not longer than the radius")
            .value_mm(length)
            .bound_mm(d.abs())
            .help("enter by a longer move, or use a smaller radius register")
            .into());
    }
    Ok(())
}

/// Length in the plane of a move that must be straight there [mm].
pub(super) fn straight(programmed: &Programmed, what: &str) -> Result<f64> {
    match Flat::of(&programmed.curve) {
        Shape::Flat(Flat::Line { start, end }) => Ok(start.distance(end)),
        _ => Err(Error::from(
            refused(programmed.item, format!("{what} must be a straight move in the plane"))
                .help("program G0 or G1 with an axis of the plane in this block"),
        )),
    }
}

/// The arc on which the tool enters: from the start of a programmed arc to the end of its parallel.
pub(super) fn arc(item: usize, programmed: &Flat, parallel: &Flat) -> Result<Flat> {
    let (Flat::Arc { start, centre, sweep }, end) = (*programmed, parallel.end().0) else {
        return Ok(*parallel);
    };
    let inward = (centre - end).normalize_or_zero();
    let chord = start - end;
    let cosine = chord.normalize_or_zero().dot(inward);
    // A centre on the other side would turn the tool round.
    if cosine < SQUARE {
        return Err(no_arc(item).into());
    }
    let centre = end + inward * (0.5 * chord.length() / cosine);
    let turned = angle(start - centre, end - centre, sweep.signum());
    let turns = (sweep.abs() / TAU - WHOLE).floor();
    Ok(Flat::Arc { start, centre, sweep: sweep.signum() * (turned + TAU * turns) })
}

/// Angle from one direction to another in a sense, within a turn [rad].
fn angle(from: DVec2, to: DVec2, sense: f64) -> f64 {
    let turned = (sense * from.angle_to(to)).rem_euclid(TAU);
    if turned == 0.0 { TAU } else { turned }
}

fn no_arc(item: usize) -> Finding {
    refused(item, "no arc leads from the start of the entry of a compensation to the parallel of its end")
        .help("enter by a straight move, or by an arc that is far from a full circle")
}
