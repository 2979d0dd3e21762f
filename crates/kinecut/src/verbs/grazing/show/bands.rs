//! The surface of a tool in strips between parallel circles, each with the angles on which it enters.

use std::f64::consts::{PI, TAU};

use crate::sweep::PieceShape;
use crate::verbs::grazing::GrazingSheet;

/// Widest strip of an arc by its normal angle [rad]: smooth to the eye.
const WIDEST: f64 = PI / 36.0;
/// Most strips of a piece from its arcs.
const MOST: f64 = 60.0;
/// Part of the velocity of a strip's middle below which a circle at its end stands still.
const STILL: f64 = 1e-9;
/// Turn between the ends of a strip from which on its middle serves for both [rad].
const APART: f64 = 1.2;

/// Angles on which a strip enters.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Band {
    /// On none.
    Leaves,
    /// On all.
    Enters,
    /// From one angle to another, at the start and at the end of the strip: the ends of both intervals belong together.
    Part([[f64; 2]; 2]),
}

/// A strip of a piece.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Strip {
    /// Piece of the chain.
    pub(crate) piece: usize,
    /// Parameters at start and end.
    pub(crate) u: [f64; 2],
    /// Part of the strip that enters.
    pub(crate) band: Band,
}

/// The strips of a piece in the order of the chain; the curve in them is drawn to the tolerance [mm].
pub(crate) fn strips(sheet: &GrazingSheet, index: usize, tolerance: f64) -> Vec<Strip> {
    let piece = &sheet.chain.pieces()[index];
    let (from, to) = (piece.from, piece.to);
    let mut stops = vec![from, to];
    let steps = match piece.shape {
        PieceShape::Line { .. } => 1.0,
        PieceShape::Arc { .. } => ((to - from).abs() / WIDEST).ceil().clamp(1.0, MOST),
    };
    let mut k = 1.0;
    while k < steps {
        stops.push(from + (to - from) * k / steps);
        k += 1.0;
    }
    for span in sheet.grazing.spans.iter().filter(|s| s.piece == index) {
        let parts = sheet.chain.parts(span, tolerance);
        stops.extend(parts.iter().map(|t| sheet.chain.grazing_points(span, *t)[0].u));
        stops.extend([span.from, span.to]);
    }
    stops.sort_by(f64::total_cmp);
    stops.dedup_by(|a, b| (*a - *b).abs() <= 1e-12 * (to - from).abs());
    if to < from {
        stops.reverse();
    }
    stops
        .windows(2)
        .map(|u| Strip { piece: index, u: [u[0], u[1]], band: band(sheet, index, [u[0], u[1]]) })
        .collect()
}

fn band(sheet: &GrazingSheet, piece: usize, u: [f64; 2]) -> Band {
    let at = |u: f64| sheet.chain.normal_velocity(&sheet.twist, piece, u);
    let middle = at(0.5 * (u[0] + u[1]));
    let alpha = middle.alpha();
    if sheet.grazing.whole.contains(&piece) || alpha <= 0.0 {
        return Band::Leaves;
    }
    if alpha >= PI {
        return Band::Enters;
    }
    let psi = middle.psi();
    let ends = u.map(|u| {
        let v = at(u);
        if v.across.length() <= STILL * middle.across.length() {
            return (psi, alpha);
        }
        (psi + (v.psi() - psi + PI).rem_euclid(TAU) - PI, v.alpha())
    });
    let same = ends.iter().all(|e| (e.0 - psi).abs() < APART);
    let ends = if same { ends } else { [(psi, alpha); 2] };
    Band::Part(ends.map(|(psi, alpha)| [psi - alpha, psi + alpha]))
}
