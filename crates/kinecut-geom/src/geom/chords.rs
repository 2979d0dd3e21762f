//! An involute as chords, for controls that are given lines only, and the counts of the alternatives to it.
//!
//! The sagitta of a chord grows with the radius of curvature, so equal angles waste chords near the base circle:
//! vertices at equal parts of roll^1.5 give every chord the same error. Vertices lie on the path, hence a chord of an
//! outward path in a bore lies inside the wall.

use glam::DVec2;

use super::InvoluteRecord;
use crate::base::{Code, Finding, Result};

/// Most chords of one record: beyond it the tolerance is a slip of the pen.
const MOST: f64 = 1e7;

/// Chords with which an involute of base radius `r` [mm] between two roll angles [rad] is met within `eps` [mm]:
/// `ceil((2/3) sqrt(r/(8 eps)) |p1^1.5 - p0^1.5|)`.
///
/// ```
/// # use kinecut_geom as kinecut;
/// let r = 79.0 / (40.0 * std::f64::consts::PI);
/// assert_eq!(kinecut::geom::chords_needed(r, 0.0, 40.0 * std::f64::consts::PI, 0.01), 2633);
/// ```
pub fn chords_needed(r: f64, start_roll: f64, end_roll: f64, eps: f64) -> u64 {
    let parts = (end_roll.powf(1.5) - start_roll.powf(1.5)).abs();
    (2.0 / 3.0 * (r.abs() / (8.0 * eps)).sqrt() * parts).ceil().clamp(1.0, MOST) as u64
}

/// Biarcs (two arcs each) that meet points and tangents of an involute within `eps` [mm]:
/// `ceil(turn (r/(324 eps))^(1/3))`. For comparison: the chain of [`super::arc_chain`] needs 45 % fewer arcs.
pub fn biarcs_needed(r: f64, turn: f64, eps: f64) -> u64 {
    (turn.abs() * (r.abs() / (324.0 * eps)).cbrt()).ceil().clamp(1.0, MOST) as u64
}

/// Roll angles [rad] of the vertices of the chords between two roll angles, both included.
pub fn chord_rolls(r: f64, start_roll: f64, end_roll: f64, eps: f64) -> Vec<f64> {
    let n = chords_needed(r, start_roll, end_roll, eps);
    let (a, b) = (start_roll.powf(1.5), end_roll.powf(1.5));
    let inner = (1..n).map(|k| (a + (b - a) * k as f64 / n as f64).powf(2.0 / 3.0));
    std::iter::once(start_roll).chain(inner).chain(std::iter::once(end_roll)).collect()
}

/// The vertices of the chords of a record that leave it by at most `eps` [mm], both ends included.
///
/// ```
/// # use kinecut_geom as kinecut;
/// use kinecut::geom::{InvoluteRecord, chord_points};
/// let spiral = InvoluteRecord::new(4963.71639267187, [0.0, 0.0], 0.0, 0.0, 79.0).unwrap();
/// assert_eq!(chord_points(&spiral, 0.01).unwrap().len(), 2634);
/// ```
///
/// # Errors
/// `KC0801` when `eps` is not positive, or so small that millions of chords would be needed.
pub fn chord_points(record: &InvoluteRecord, eps: f64) -> Result<Vec<DVec2>> {
    let refuse = |what: &str, value: f64| {
        Err(Finding::error(Code::GEOMETRY, what).value_mm(value).bound_mm(0.0).into())
    };
    if !(eps > 0.0 && eps.is_finite()) {
        return refuse("the tolerance of chords must be positive", eps);
    }
    let (start, end) = (record.start(), record.end());
    let r = record.base_radius().abs();
    let (rn, rk) = (record.start_radius().abs(), record.end_radius().abs());
    if record.is_line() || record.length() == 0.0 {
        return Ok(vec![start, end]);
    }
    // A roll beyond this is a circle for every purpose: its radius changes by less than rounding.
    const CIRCLE: f64 = 1e9;
    let turn = record.turn(record.length()).abs();
    if r == 0.0 || rn / r > CIRCLE {
        let n = (turn * (rn.max(rk) / (8.0 * eps)).sqrt()).ceil().clamp(1.0, MOST);
        let inner = (1..n as u64).map(|k| record.at(record.length_at_turn(turn * k as f64 / n)).p);
        return Ok(std::iter::once(start).chain(inner).chain(std::iter::once(end)).collect());
    }
    let (p0, p1) = (rn / r, rk / r);
    if chords_needed(r, p0, p1, eps) as f64 >= MOST {
        return refuse("the tolerance is so small that the chords would be millions", eps);
    }
    let rolls = chord_rolls(r, p0, p1, eps);
    let last = rolls.len() - 1;
    let at = |(i, p): (usize, &f64)| match i {
        0 => start,
        i if i == last => end,
        _ => record.at(0.5 * r * ((p - p0) * (p + p0)).abs()).p,
    };
    Ok(rolls.iter().enumerate().map(at).collect())
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Largest distance of points of the record from the polyline, each from its nearest segment nearby.
    fn deviation(record: &InvoluteRecord, points: &[DVec2]) -> f64 {
        let mut segment = 0;
        let mut worst = 0f64;
        let n = 40 * points.len();
        for i in 0..=n {
            let p = record.at(record.length() * i as f64 / n as f64).p;
            let to = |k: usize| {
                let (a, b) = (points[k], points[k + 1]);
                let t = ((p - a).dot(b - a) / (b - a).length_squared()).clamp(0.0, 1.0);
                (a + (b - a) * t - p).length()
            };
            while segment + 2 < points.len() && to(segment + 1) < to(segment) {
                segment += 1;
            }
            worst = worst.max(to(segment));
        }
        worst
    }

    #[test]
    fn chords_leave_the_record_by_the_tolerance_and_hardly_less() {
        let out = InvoluteRecord::new(500.0, [3.0, 4.0], 0.7, 5.0, 30.0).expect("a record");
        let full = InvoluteRecord::new(500.0, [0.0, 0.0], 0.0, 0.0, 30.0).expect("a record from its cusp");
        let circle = InvoluteRecord::new(100.0, [1.0, 0.0], 0.0, -20.0, -20.0).expect("a circle");
        for record in [out, out.mirrored(), out.reversed(), full, circle] {
            for eps in [0.02, 0.001] {
                let points = chord_points(&record, eps).expect("a valid tolerance");
                let worst = deviation(&record, &points);
                assert!(worst <= eps * 1.0001, "{worst} > {eps}");
                assert!(worst > 0.8 * eps, "{worst}: too many chords for {eps}");
                assert_eq!((points[0], points[points.len() - 1]), (record.start(), record.end()));
            }
        }
        assert!(chord_points(&out, 0.0).is_err() && chord_points(&out, 1e-30).is_err());
    }
}
