//! The narrowest orientation of a part, and what to say where it is too wide for every one.

use std::f64::consts::TAU;

use super::Options;
use super::domain::Domain;
use crate::base::{Code, Error, Finding};

/// Samples of the full turn among which the narrowest is sought.
const SAMPLES: f64 = 1440.0;
/// Halvings of the window around a sample: to some 1e-13 rad.
const HALVINGS: usize = 36;

/// Least width over the allowed angles, with its angle. Between the hull's edges the width is a sine's arch, which is
/// least at an end: edges' angles are tried exactly, arcs by narrowing.
pub(super) fn narrowest(domain: &Domain) -> (f64, f64) {
    let width = |angle: f64| {
        let [low, high] = domain.extent(angle);
        high - low
    };
    let mut best = (f64::INFINITY, 0.0);
    let mut step = 0.0;
    let take = |angle: f64, best: &mut (f64, f64)| {
        let width = width(angle);
        if width < best.0 {
            *best = (width, angle);
        }
    };
    for &[from, to] in &domain.angles {
        let n = ((to - from) / TAU * SAMPLES).ceil();
        let n = if n > 1.0 { n } else { 1.0 };
        step = TAU / SAMPLES;
        for i in 0..=(n as usize) {
            take(from + (to - from) * i as f64 / n, &mut best);
        }
    }
    for _ in 0..HALVINGS {
        for angle in [best.1 - step, best.1 + step].into_iter().filter(|a| domain.allows(*a)) {
            take(angle, &mut best);
        }
        step *= 0.5;
    }
    for hull in domain.hull_angles().filter(|a| domain.allows(*a)) {
        take(hull, &mut best);
    }
    best
}

/// The error where even the narrowest allowed orientation does not fit.
pub(super) fn too_wide(domain: &Domain, options: &Options, (width, angle): (f64, f64)) -> Error {
    let room = domain.reach[1] - domain.reach[0];
    if domain.angles.is_empty() {
        return Finding::error(Code::FACE_CASE, "every orientation is forbidden").into();
    }
    if width <= room {
        return Finding::error(
            Code::FACE_TOO_WIDE,
            "no centre line covers the part and keeps its distance from the middle of it",
        )
        .value_mm(options.least_off_middle)
        .bound_mm(0.5 * (room - width))
        .help("take a larger cutter or a smaller distance from the middle")
        .into();
    }
    let passes = (width / room).ceil();
    Finding::error(
        Code::FACE_TOO_WIDE,
        "the part is wider than the cutter's reach at every allowed orientation",
    )
    .value_mm(width)
    .bound_mm(room)
    .help(format!(
        "mill it in {passes} passes or take a larger cutter; it is narrowest turned by {:.3} deg",
        angle.to_degrees()
    ))
    .into()
}
