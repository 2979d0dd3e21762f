//! A spiral as tangent arcs, for compensation: the parallel of a spiral has no exact form here.
//!
//! Only planned programs have spirals; no control has a block for them, a posted text has arcs. Cubics are treated
//! alike. Biarcs with equal tangents between points of the spiral, halved until they leave it by at most [`ERROR`]; the
//! error of a biarc falls with the third power of its length. Source: Bolton 1975 (biarcs).

use glam::{DVec2, DVec3};

use crate::geom::{Arc, Curve, Line};

/// Largest distance of the arcs from the spiral [mm]: a hundredth of the finest resolution of a control.
const ERROR: f64 = 1e-5;
/// Largest angle that a biarc turns at first [rad]: below a half turn it always exists.
const FIRST_TURN: f64 = 1.0;
/// Most halvings: enough to come from metres to nanometres; a cusp ends there.
const DEEPEST: u32 = 30;

/// The arcs and lines of a curve in a plane parallel to XY that turns by `turn` in all [rad].
pub(super) fn arcs(curve: &Curve, turn: f64) -> Vec<Curve> {
    let length = curve.length();
    let first = (turn.abs() / FIRST_TURN).ceil().clamp(1.0, 1e6) as usize;
    let mut pieces = Vec::new();
    for i in 0..first {
        let at = |i: usize| length * i as f64 / first as f64;
        halve(curve, [at(i), at(i + 1)], 0, &mut pieces);
    }
    pieces
}

fn halve(curve: &Curve, [from, to]: [f64; 2], depth: u32, pieces: &mut Vec<Curve>) {
    let middle = 0.5 * (from + to);
    let pair = biarc(curve, from, to);
    let off = [0.2, 0.4, 0.6, 0.8].iter().fold(0.0, |most: f64, share| {
        let p = curve.at(from + share * (to - from)).p.truncate();
        let near = pair
            .iter()
            .flatten()
            .map(|c| distance(c, p))
            .fold(f64::INFINITY, |a, b| if b < a { b } else { a });
        if near <= most { most } else { near }
    });
    if depth < DEEPEST && (off > ERROR || pair.iter().any(Option::is_none)) {
        halve(curve, [from, middle], depth + 1, pieces);
        halve(curve, [middle, to], depth + 1, pieces);
    } else if pair.iter().all(Option::is_some) {
        pieces.extend(pair.into_iter().flatten());
    } else {
        pieces.push(Line { start: curve.at(from).p, end: curve.at(to).p }.into());
    }
}

/// Two arcs, or lines, with a common tangent in between; `None` where a piece has no length or direction.
fn biarc(curve: &Curve, from: f64, to: f64) -> [Option<Curve>; 2] {
    let (a, b) = (curve.at(from), curve.at(to));
    let flat = |d: DVec3| d.truncate().normalize_or_zero();
    let (p, q, t, u) = (a.p.truncate(), b.p.truncate(), flat(a.d1), flat(b.d1));
    let chord = q - p;
    let along = chord.dot(t + u);
    let bent = 2.0 * (1.0 - t.dot(u)) * chord.length_squared();
    let reach = chord.length_squared() / (along + (along * along + bent).sqrt());
    if !(reach.is_finite() && reach > 0.0) {
        return [None, None];
    }
    let joint = 0.5 * (p + t * reach + q - u * reach);
    let z = 0.5 * (a.p.z + b.p.z);
    let first = tangent_arc(p, t, joint, [a.p.z, z]);
    // The second from its end, then turned round.
    let second = tangent_arc(q, -u, joint, [b.p.z, z]).map(|c| c.reversed());
    [first, second]
}

/// The arc that leaves `p` in direction `t` and comes to `q`, between two heights.
fn tangent_arc(p: DVec2, t: DVec2, q: DVec2, [from, to]: [f64; 2]) -> Option<Curve> {
    let chord = q - p;
    if chord == DVec2::ZERO || t == DVec2::ZERO {
        return None;
    }
    let (along, across) = (t.dot(chord), t.perp_dot(chord));
    let radius = chord.length_squared() / (2.0 * across);
    // An arc flatter than rounding is a line.
    if !radius.is_finite() || across.abs() < f64::EPSILON * chord.length() {
        return Some(Line { start: p.extend(from), end: q.extend(to) }.into());
    }
    let centre = (p + t.perp() * radius).extend(from);
    let sweep = 2.0 * across.atan2(along);
    Some(Arc { start: p.extend(from), centre, axis: DVec3::Z, sweep, rise: to - from }.into())
}

/// Distance of a point from the whole circle or line that a piece is part of [mm].
fn distance(piece: &Curve, p: DVec2) -> f64 {
    let (start, t) = (piece.at(0.0).p.truncate(), piece.at(0.0).d1.truncate());
    match piece.kind() {
        crate::geom::CurveKind::Arc(arc) => (p.distance(arc.centre.truncate()) - arc.radius()).abs(),
        _ => t.normalize_or_zero().perp_dot(p - start).abs(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geom::InvoluteRecord;

    #[test]
    fn the_arcs_are_tangent_and_on_the_curve() {
        // An involute in place of a spiral: its points are known.
        for (from, to) in [(4.0, 30.0), (0.0, 12.0)] {
            let r = 2.0;
            let record =
                InvoluteRecord::new(0.5 * (to * to - from * from) / r, [1.0, 2.0], 0.3, from, to).unwrap();
            let curve = Curve::involute(record, -3.0, 1.0);
            let pieces = arcs(&curve, record.turn(record.length()));
            assert!(pieces.len() > 20 && pieces.len() < 3000, "{}", pieces.len());
            let (first, last) = (&pieces[0], &pieces[pieces.len() - 1]);
            assert!((first.start() - curve.start()).length() < 1e-12);
            assert!((last.end() - curve.end()).length() < 1e-12);
            for w in pieces.windows(2) {
                let (a, b) = (w[0].at(w[0].length()), w[1].at(0.0));
                assert!((a.p - b.p).length() < 1e-11);
                // One of its biarcs may hold the cusp.
                assert!((a.d1 - b.d1).truncate().length() < 1e-6, "{} {}", a.d1, b.d1);
            }
            let turned: f64 = record.turn(record.length());
            for i in 0..=60 {
                let s = record.length_at_turn(turned * f64::from(i) / 60.0);
                let p = record.at(s).p;
                let near = pieces.iter().map(|c| {
                    let line = c.polyline(1e-6);
                    line.windows(2)
                        .map(|w| {
                            let (a, d) = (w[0].truncate(), (w[1] - w[0]).truncate());
                            let u = ((p - a).dot(d) / d.length_squared()).clamp(0.0, 1.0);
                            (a + d * u).distance(p)
                        })
                        .fold(f64::INFINITY, f64::min)
                });
                assert!(near.fold(f64::INFINITY, f64::min) < 1.3e-5, "{s}");
            }
        }
    }
}
