//! Angles of a tilted working plane: `PLANE SPATIAL`, `EULER` and `VECTOR` as rotations.
//!
//! For writer and reader, so that both find the same rotation to the last bit. Columns of a rotation are the axes of the
//! plane in the coordinates that it is tilted in.
//!
//! ```text
//! SPATIAL   R = Rz(SPC) Ry(SPB) Rx(SPA)           about the fixed axes, X first
//! EULER     R = Rz(EULPR) Rx(EULNU) Rz(EULROT)    about the turned axes
//! VECTOR    Z = N / |N|,  X = the part of B across N, as a unit vector,  Y = Z x X
//! ```
//!
//! Source: user's manuals of iTNC 530 and TNC 640, chapter "The PLANE function"; angles have four decimals, components
//! of vectors eight.

use glam::{DMat3, DVec3};

use crate::nc::turn;

/// Decimals of rotary axes and of the angles of a plane [deg].
pub(in crate::nc) const ANGLE_DECIMALS: u8 = 4;
/// Steps of an angle in a degree.
const TICKS: f64 = 1e4;
/// Sine of the angle between the plane's Z and a fixed X or its opposite below which only the sum or the difference of
/// SPA and SPC counts: far below a step of an angle (1.7e-6), far above the rounding of doubles.
const GIMBAL: f64 = 1e-9;
/// Largest deviation of a matrix from a rotation: rounding of products of many rotations.
const RIGHT: f64 = 1e-9;
/// Largest sine of the deviation of a base vector from the plane: what three decimals of its components leave.
const SQUARE: f64 = 2e-3;

/// The rotation of three spatial angles [deg], exact for quarter turns.
pub(in crate::nc) fn spatial(a: f64, b: f64, c: f64) -> DMat3 {
    turn::rotation(c) * about_y(b) * about_x(a)
}

/// The rotation of precession, nutation and rotation [deg].
pub(in crate::nc) fn euler(precession: f64, nutation: f64, rotation: f64) -> DMat3 {
    turn::rotation(precession) * about_x(nutation) * turn::rotation(rotation)
}

/// The rotation of a plane with this normal, whose X lies as near to the base vector as the plane allows; none where one
/// of them has no direction, or the base vector stands out of the plane.
pub(in crate::nc) fn of_vectors(base: DVec3, normal: DVec3) -> Option<DMat3> {
    let (base, z) = (base.try_normalize()?, normal.try_normalize()?);
    if base.dot(z).abs() > SQUARE {
        return None;
    }
    let x = base.reject_from_normalized(z).try_normalize()?;
    Some(DMat3::from_cols(x, z.cross(x), z))
}

/// A turn about X [deg].
pub(in crate::nc) fn about_x(degrees: f64) -> DMat3 {
    // The turn about Z with its axes renamed: Z becomes X, X becomes Y, Y becomes Z.
    let m = turn::rotation(degrees);
    let named = |v: DVec3| DVec3::new(v.z, v.x, v.y);
    DMat3::from_cols(named(m.z_axis), named(m.x_axis), named(m.y_axis))
}

/// A turn about Y [deg].
pub(in crate::nc) fn about_y(degrees: f64) -> DMat3 {
    let m = turn::rotation(degrees);
    let named = |v: DVec3| DVec3::new(v.y, v.z, v.x);
    DMat3::from_cols(named(m.y_axis), named(m.z_axis), named(m.x_axis))
}

/// Spatial angles in steps whose rotation is the nearest; none for a matrix that is no rotation.
///
/// Each angle is taken from what the rounded ones before it leave over, so that near SPB = +-90 deg, where SPA and SPC turn
/// about the same axis, the error of one is made good by the other.
pub(in crate::nc) fn nearest_spatial(rotation: &DMat3) -> Option<[i64; 3]> {
    let off = rotation.transpose() * *rotation - DMat3::IDENTITY;
    let is_rotation = off.to_cols_array().iter().all(|v| v.abs() <= RIGHT) && rotation.determinant() > 0.0;
    if !is_rotation {
        return None;
    }
    let x = rotation.x_axis;
    let c = if x.truncate().length() < GIMBAL { 0 } else { rounded(x.y.atan2(x.x)) };
    let rest = turn::rotation(degrees(c)).transpose() * *rotation;
    // rest = Ry(b) Rx(a): first column (cos b, 0, -sin b), second row (0, cos a, -sin a).
    let b = rounded((-rest.x_axis.z).atan2(rest.x_axis.x));
    let a = rounded((-rest.z_axis.y).atan2(rest.y_axis.y));
    Some([a, b, c])
}

/// An angle in steps as degrees.
pub(in crate::nc) fn degrees(ticks: i64) -> f64 {
    ticks as f64 / TICKS
}

/// The steps of an angle [rad].
pub(in crate::nc) fn rounded(angle: f64) -> i64 {
    let ticks = (angle.to_degrees() * TICKS).round() as i64;
    // Half a turn has two signs.
    if ticks == -1_800_000 { 1_800_000 } else { ticks }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A rotation by Rodrigues' formula.
    fn about(axis: DVec3, degrees: f64) -> impl Fn(DVec3) -> DVec3 {
        let (sin, cos) = degrees.to_radians().sin_cos();
        move |v| v * cos + axis.cross(v) * sin + axis * axis.dot(v) * (1.0 - cos)
    }

    fn same(m: &DMat3, f: impl Fn(DVec3) -> DVec3) -> bool {
        DVec3::AXES.iter().all(|v| (*m * *v - f(*v)).length() < 1e-14)
    }

    #[test]
    fn spatial_angles_turn_about_the_fixed_axes_x_first() {
        for (a, b, c) in [(90.0, 0.0, 180.0), (20.0, -35.0, 140.0), (-170.0, 80.0, -10.0), (0.0, 90.0, 30.0)]
        {
            let (x, y, z) = (about(DVec3::X, a), about(DVec3::Y, b), about(DVec3::Z, c));
            assert!(same(&spatial(a, b, c), |v| z(y(x(v)))), "{a} {b} {c}");
        }
        // The front of a part, with X to the right of who looks at it: its Z points to -Y.
        assert_eq!(spatial(90.0, 0.0, 0.0) * DVec3::Z, DVec3::NEG_Y);
    }

    #[test]
    fn euler_angles_turn_about_the_turned_axes() {
        let (p, n, r) = (25.0, 60.0, -40.0);
        let first = about(DVec3::Z, p);
        let x = first(DVec3::X);
        let second = about(x, n);
        let third = about(second(first(DVec3::Z)), r);
        assert!(same(&euler(p, n, r), |v| third(second(first(v)))));
    }

    #[test]
    fn vectors_give_the_axes_of_the_plane() {
        let m = of_vectors(DVec3::new(2.0, 0.0, -2.0), DVec3::new(3.0, 0.0, 3.0)).unwrap();
        let half = 0.5f64.sqrt();
        assert!((m.x_axis - DVec3::new(half, 0.0, -half)).length() < 1e-15);
        assert!((m.y_axis - DVec3::Y).length() < 1e-15 && (m.determinant() - 1.0).abs() < 1e-15);
        assert!(of_vectors(DVec3::X, DVec3::new(0.1, 0.0, 1.0)).is_none());
        assert!(of_vectors(DVec3::ZERO, DVec3::Z).is_none());
    }

    #[test]
    fn a_mirror_has_no_angles() {
        assert!(nearest_spatial(&DMat3::from_diagonal(DVec3::new(1.0, 1.0, -1.0))).is_none());
        assert!(nearest_spatial(&DMat3::ZERO).is_none());
        assert_eq!(nearest_spatial(&spatial(0.0, 90.0, 33.0)), Some([-330_000, 900_000, 0]));
    }
}
