//! The feed of the cutter's centre where that at the wall is meant.

/// Most and least feed of the centre, in feeds at the wall.
const RANGE: [f64; 2] = [0.1, 2.0];

/// The feed of the centre on an arc about a wall of radius `wall` [mm], for a feed at the wall, with a cutter of radius
/// `a` [mm]; `inside`: the cutter runs inside of the arc. It stays between a tenth and twice the feed at the wall.
///
/// ```
/// # use kinecut_plan as kinecut;
/// use kinecut::contouring::centre_feed;
/// // In a corner of 6 mm a cutter of 10 mm runs on a circle of 1 mm.
/// assert!((centre_feed(600.0, 6.0, 5.0, true) - 100.0).abs() < 1e-9);
/// assert!((centre_feed(600.0, 30.0, 5.0, false) - 700.0).abs() < 1e-9);
/// assert_eq!(centre_feed(600.0, 5.0, 5.0, true), 60.0);
/// ```
pub fn centre_feed(feed: f64, wall: f64, a: f64, inside: bool) -> f64 {
    let share = if inside { (wall - a) / wall } else { (wall + a) / wall };
    // About a corner the wall has no length.
    let share = if share.is_nan() { RANGE[1] } else { share };
    feed * share.clamp(RANGE[0], RANGE[1])
}
