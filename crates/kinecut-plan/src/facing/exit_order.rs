//! The order in which the corners of an insert leave the part over an edge.
//!
//! Hashimura, Hassamontr and Dornfeld (1999) name exits by the corner that leaves last, where the burr stays. Here is
//! the geometry of it only. With the exit angle psi, a corner `radial` farther out and `ahead` farther along the
//! velocity than the tooth's reference lies radial cos(psi) + ahead sin(psi) farther along the edge's normal, on which
//! the tooth goes sin(psi) per travel: it leaves earlier by ahead + radial cot(psi). Height plays no part: the walls of
//! the outline are upright.

use std::f64::consts::PI;

use crate::base::{Code, Finding, Result};

/// A corner of an insert against the point that cuts the finished outline.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct InsertCorner {
    /// Farther from the cutter's axis by this [mm].
    pub radial: f64,
    /// Farther in the direction of the tooth's velocity by this [mm]: what rake and lead angles make of the height.
    pub ahead: f64,
    /// Over the finished plane by this [mm].
    pub height: f64,
}

/// Exit of a corner: the travel at which it leaves.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CornerExit {
    /// Index of the corner.
    pub corner: usize,
    /// Travel of the tooth after the reference point has left [mm].
    pub travel: f64,
}

/// The corners in the order in which they leave over an edge, those that leave together in their own order; the burr
/// stays at the last. First order: the tooth's way is straight over the size of an insert.
///
/// ```
/// # use kinecut_plan as kinecut;
/// use kinecut::facing::{InsertCorner, exit_order};
/// let toe = InsertCorner { radial: 0.0, ahead: 0.0, height: 0.0 };
/// // The upper end of the edge of a 45 degree lead angle, 1 mm up.
/// let upper = InsertCorner { radial: 1.0, ahead: 0.0, height: 1.0 };
/// let last = |psi: f64| exit_order(psi.to_radians(), &[toe, upper]).map(|o| o[1].corner);
/// assert_eq!(last(60.0)?, 0);
/// assert_eq!(last(120.0)?, 1);
/// # Ok::<(), kinecut::base::Error>(())
/// ```
///
/// # Errors
/// `KC1001` for an exit angle that is not between 0 and pi.
pub fn exit_order(exit_angle: f64, corners: &[InsertCorner]) -> Result<Vec<CornerExit>> {
    if !(exit_angle > 0.0 && exit_angle < PI) {
        return Err(Finding::error(Code::FACE_CASE, "a tooth leaves at an angle between 0 and 180 degrees")
            .value(exit_angle.to_degrees(), "deg")
            .bound(180.0, "deg")
            .into());
    }
    let (sin, cos) = exit_angle.sin_cos();
    let exits = corners.iter().enumerate();
    let mut exits: Vec<CornerExit> =
        exits.map(|(corner, c)| CornerExit { corner, travel: -(c.ahead + c.radial * cos / sin) }).collect();
    exits.sort_by(|a, b| a.travel.total_cmp(&b.travel));
    Ok(exits)
}

#[cfg(test)]
mod tests {
    use glam::{DVec2, dvec2};

    use super::*;

    #[test]
    fn corners_leave_as_on_their_straight_ways() {
        let corners = [(0.0, 0.0), (0.7, -0.3), (-1.1, 0.2), (0.4, 1.0)]
            .map(|(radial, ahead)| InsertCorner { radial, ahead, height: 0.0 });
        for k in 1..18 {
            // The edge runs along +x with the material below it: its normal is +y.
            let psi = 10f64.to_radians() * f64::from(k);
            let velocity = DVec2::from_angle(psi);
            // The spindle turns clockwise: the axis lies on the right of the velocity.
            let outward = dvec2(-velocity.y, velocity.x);
            let leaves = |c: &InsertCorner| {
                let start = c.radial * outward + c.ahead * velocity;
                -start.y / velocity.y
            };
            let order = exit_order(psi, &corners).unwrap();
            assert!(order.windows(2).all(|w| w[0].travel <= w[1].travel));
            for exit in order {
                assert!((exit.travel - leaves(&corners[exit.corner])).abs() < 1e-12);
            }
        }
        assert!(exit_order(0.0, &corners).is_err() && exit_order(f64::NAN, &corners).is_err());
    }
}
