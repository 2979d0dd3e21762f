//! Convex hull of points in a plane.

use glam::DVec2;

/// Corners of the convex hull of points, against the clock (monotone chain); points on its sides are left out.
///
/// ```
/// # use kinecut_geom as kinecut;
/// use glam::DVec2;
/// use kinecut::geom::convex_hull;
/// let points = [[0.0, 0.0], [2.0, 0.0], [1.0, 0.5], [1.0, 2.0], [1.0, 0.0]].map(DVec2::from_array);
/// let corners: Vec<[f64; 2]> = convex_hull(points.to_vec()).into_iter().map(Into::into).collect();
/// assert_eq!(corners, [[0.0, 0.0], [2.0, 0.0], [1.0, 2.0]]);
/// ```
pub fn convex_hull(mut points: Vec<DVec2>) -> Vec<DVec2> {
    points.sort_by(|a, b| a.x.total_cmp(&b.x).then(a.y.total_cmp(&b.y)));
    points.dedup();
    if points.len() < 3 {
        return points;
    }
    let mut out: Vec<DVec2> = Vec::with_capacity(points.len());
    for pass in 0..2 {
        let base = out.len();
        let mut add = |p: DVec2| {
            while out.len() >= base + 2
                && (out[out.len() - 1] - out[out.len() - 2]).perp_dot(p - out[out.len() - 1]) <= 0.0
            {
                out.pop();
            }
            out.push(p);
        };
        if pass == 0 {
            points.iter().for_each(|&p| add(p));
        } else {
            points.iter().rev().for_each(|&p| add(p));
        }
        out.pop();
    }
    out
}
