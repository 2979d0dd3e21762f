//! Ways that a machine may take in a rapid move of several axes: each axis at its own speed until it has arrived.

use glam::DVec3;

use crate::geom::Line;

/// The ways of a rapid of linear axes: at the same speed and, where they are known, at their own speeds. Empty when all are the
/// straight line.
pub(super) fn ways(start: DVec3, end: DVec3, speeds: Option<DVec3>) -> Vec<Line> {
    let line = |speeds: DVec3| -> Vec<Line> {
        legs(&start.to_array(), &end.to_array(), &speeds.to_array())
            .into_iter()
            .map(|[a, b]| Line { start: DVec3::from_array(a), end: DVec3::from_array(b) })
            .collect()
    };
    let mut all = line(DVec3::ONE);
    let own = speeds.filter(|s| s.min_element() < s.max_element()).map(line);
    all.extend(own.into_iter().flatten());
    all
}

/// The legs of a path on which each axis runs at its speed until it has arrived; empty when that is the straight line.
pub(super) fn legs<const N: usize>(from: &[f64; N], to: &[f64; N], speeds: &[f64; N]) -> Vec<[[f64; N]; 2]> {
    /// Rest of a coordinate that went through a chain of axes and back [mm, rad].
    const ROUNDING: f64 = 1e-9;
    let mut needed = [0.0; N];
    for i in 0..N {
        let way = (to[i] - from[i]).abs();
        needed[i] = if way > ROUNDING { way / speeds[i] } else { 0.0 };
    }
    let mut times: Vec<f64> = needed.iter().copied().filter(|t| *t > 0.0).collect();
    times.sort_by(f64::total_cmp);
    // Times that differ by rounding are one.
    times.dedup_by(|later, earlier| *later <= *earlier * (1.0 + 1e-12));
    let at = |t: f64| -> [f64; N] {
        std::array::from_fn(|i| {
            if needed[i] <= t { to[i] } else { from[i] + (to[i] - from[i]) * (t / needed[i]) }
        })
    };
    let mut legs = Vec::new();
    let mut start = *from;
    for (k, t) in times.iter().enumerate() {
        let end = if k + 1 == times.len() { *to } else { at(*t) };
        legs.push([start, end]);
        start = end;
    }
    if legs.len() > 1 { legs } else { Vec::new() }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_rapid_axis_by_axis_first_runs_diagonally_then_along_the_longer_axis() {
        let legs = ways(DVec3::ZERO, DVec3::new(30.0, -10.0, 0.0), None);
        assert_eq!(legs.len(), 2);
        assert_eq!(legs[0].end, DVec3::new(10.0, -10.0, 0.0));
        assert_eq!(legs[1].end, DVec3::new(30.0, -10.0, 0.0));
        assert!(ways(DVec3::ZERO, DVec3::new(5.0, 5.0, 0.0), None).is_empty());
        assert!(ways(DVec3::ZERO, DVec3::Z, None).is_empty());
    }

    #[test]
    fn axes_of_different_speeds_run_another_way_too() {
        let speeds = Some(DVec3::new(10.0, 10.0, 5.0));
        let legs = ways(DVec3::ZERO, DVec3::new(20.0, 0.0, 20.0), speeds);
        // At the same speed it is the straight line; at their own X arrives when Z is half way.
        assert_eq!(legs.len(), 2);
        assert_eq!(legs[0].end, DVec3::new(20.0, 0.0, 10.0));
        assert_eq!(ways(DVec3::ZERO, DVec3::new(20.0, 0.0, 30.0), speeds).len(), 4);
    }
}
