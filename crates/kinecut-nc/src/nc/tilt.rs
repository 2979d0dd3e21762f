//! Tilted planes as numbers of a text: angles of successive rotations [deg], and the motion that they make.
//!
//! For writer and reader, so that both find the same motion to the last bit.
//!
//! ```text
//! G68.2 X.. Y.. Z.. I.. J.. K..     p' = origin + Rz(I) Rx(J) Rz(K) p
//! G68.2 P1 Q123 X.. .. K..          p' = origin + Rz(K) Ry(J) Rx(I) p        (fixed axes, in the order of Q)
//! CYCLE800(.., 57, X0, Y0, Z0, A, B, C, X1, Y1, Z1, ..)
//!                                   p' = (X0,Y0,Z0) + Rx(A) Ry(B) Rz(C) ((X1,Y1,Z1) + p)
//! ```

use glam::{DMat3, DVec2};

/// Axes of three successive rotations about axes that turn along.
pub(super) type Order = [usize; 3];

/// FANUC's Euler angles.
pub(super) const ZXZ: Order = [2, 0, 2];
/// The order of SINUMERIK's mode 57.
pub(super) const XYZ: Order = [0, 1, 2];

/// Sine of the middle angle (cosine, where all three axes differ) below which the first and last rotation are about one
/// line: the rounding of an angle in degrees with six decimals is ten times larger.
const ONE_LINE: f64 = 1e-9;

/// The rotation about X, Y or Z (0, 1, 2) by an angle [deg], exact for quarter turns.
pub(super) fn about(axis: usize, degrees: f64) -> DMat3 {
    let part = degrees.rem_euclid(360.0);
    let quarters = (part / 90.0).round();
    let rest = DVec2::from_angle((part - 90.0 * quarters).to_radians());
    let turned = match quarters as u8 % 4 {
        0 => rest,
        1 => rest.perp(),
        2 => -rest,
        _ => -rest.perp(),
    };
    // Positive zeros: equal motions are printed alike.
    let (cos, sin) = (turned.x + 0.0, turned.y + 0.0);
    let mut columns = [[0.0; 3]; 3];
    let (next, last) = ((axis + 1) % 3, (axis + 2) % 3);
    columns[axis % 3][axis % 3] = 1.0;
    columns[next][next] = cos;
    columns[next][last] = sin;
    columns[last][next] = 0.0 - sin;
    columns[last][last] = cos;
    DMat3::from_cols_array_2d(&columns)
}

/// The product of rotations about axes that turn along [deg].
pub(super) fn turning(order: Order, degrees: [f64; 3]) -> DMat3 {
    let [a, b, c] = [0, 1, 2].map(|i| about(order[i], degrees[i]));
    exact(a * b * c)
}

/// The product of rotations about fixed axes, `order[0]` first; `degrees` by axis.
pub(super) fn standing(order: Order, degrees: [f64; 3]) -> DMat3 {
    let [a, b, c] = order.map(|axis| about(axis, degrees[axis]));
    exact(c * b * a)
}

/// Positive zeros throughout.
fn exact(matrix: DMat3) -> DMat3 {
    let mut columns = matrix.to_cols_array();
    for value in &mut columns {
        *value += 0.0;
    }
    DMat3::from_cols_array(&columns)
}

/// The angles of a rotation in an order [ticks of `1 / scale` deg], for [`ZXZ`] and [`XYZ`]; the last one is zero
/// where the first and the last rotation are about one line.
pub(super) fn ticks(order: Order, rotation: &DMat3, scale: f64) -> [i64; 3] {
    let m = |row: usize, column: usize| rotation.col(column)[row];
    let tick = |radians: f64| {
        let ticks = (radians.to_degrees() * scale).round();
        // Half a turn has two signs.
        (if ticks == -180.0 * scale { -ticks } else { ticks }) as i64
    };
    let (tilt, alone) = match order {
        ZXZ => (m(0, 2).hypot(m(1, 2)).atan2(m(2, 2)), m(1, 0).atan2(m(0, 0))),
        _ => (m(0, 2).atan2(m(0, 0).hypot(m(0, 1))), m(2, 1).atan2(m(1, 1))),
    };
    let [middle, half, quarter] = [tick(tilt), (180.0 * scale) as i64, (90.0 * scale) as i64];
    let one_line = match order {
        ZXZ => tilt.sin().abs() < ONE_LINE || middle == 0 || middle == half,
        _ => tilt.cos().abs() < ONE_LINE || middle.abs() == quarter,
    };
    match (one_line, order) {
        (true, _) => [tick(alone), middle, 0],
        (false, ZXZ) => {
            let [first, last] = [tick(m(0, 2).atan2(-m(1, 2))), tick(m(2, 0).atan2(m(2, 1)))];
            // The same plane tilted to the other side, where that takes smaller turns, as a hand would write it.
            let other = |ticks: i64| if ticks > 0 { ticks - half } else { ticks + half };
            match first.abs() + last.abs() > half {
                true => [other(first), -middle, other(last)],
                false => [first, middle, last],
            }
        }
        _ => [tick((-m(1, 2)).atan2(m(2, 2))), middle, tick((-m(0, 1)).atan2(m(0, 0)))],
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::{DQuat, DVec3};
    use proptest::prelude::*;

    /// Rotations by quaternions, which share nothing with the matrices above.
    fn quaternion(axis: usize, degrees: f64) -> DQuat {
        DQuat::from_axis_angle([DVec3::X, DVec3::Y, DVec3::Z][axis], degrees.to_radians())
    }

    fn apart(a: &DMat3, b: &DMat3) -> f64 {
        a.to_cols_array().iter().zip(b.to_cols_array()).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max)
    }

    #[test]
    fn quarter_turns_are_exact_and_right_handed() {
        assert_eq!(about(0, 90.0) * DVec3::Y, DVec3::Z);
        assert_eq!(about(1, 90.0) * DVec3::Z, DVec3::X);
        assert_eq!(about(2, -90.0) * DVec3::X, DVec3::NEG_Y);
        assert_eq!(turning(ZXZ, [0.0, 90.0, 0.0]) * DVec3::Z, DVec3::NEG_Y);
    }

    #[test]
    fn standing_axes_are_those_of_the_work_offset() {
        // First about X by 90 deg: Z goes to -Y; then about Z by 90 deg: -Y goes to X.
        let r = standing(XYZ, [90.0, 0.0, 90.0]);
        assert!((r * DVec3::Z - DVec3::X).length() < 1e-15);
    }

    proptest! {
        #![proptest_config(kinecut_cases::property(256))]
        #[test]
        fn products_are_those_of_quaternions(a in -400.0..400.0f64, b in -400.0..400.0f64, c in -400.0..400.0f64) {
            for order in [ZXZ, XYZ, [1, 0, 2], [2, 1, 0]] {
                let by = quaternion(order[0], a) * quaternion(order[1], b) * quaternion(order[2], c);
                prop_assert!(apart(&turning(order, [a, b, c]), &DMat3::from_quat(by)) < 1e-14);
            }
            let by = quaternion(1, b) * quaternion(2, c) * quaternion(0, a);
            prop_assert!(apart(&standing([0, 2, 1], [a, b, c]), &DMat3::from_quat(by)) < 1e-14);
        }

        /// Any rotation comes back within the rounding, wherever the first and last axis are one line.
        #[test]
        fn angles_give_the_rotation_back(
            a in -180.0..180.0f64,
            b in prop_oneof![-180.0..180.0f64, Just(0.0), Just(90.0), Just(180.0), Just(-90.0), Just(1e-7), Just(89.9999999)],
            c in -180.0..180.0f64,
        ) {
            for (order, scale) in [(ZXZ, 1e3), (XYZ, 1e3), (ZXZ, 1e6), (XYZ, 1e6)] {
                let r = turning(order, [a, b, c]);
                let said = ticks(order, &r, scale).map(|t| t as f64 / scale);
                // Three angles, each rounded by half a tick.
                let bound = 1.5 * (1.0f64 / scale).to_radians() + 1e-14;
                prop_assert!(apart(&turning(order, said), &r) < bound, "{order:?} {said:?}");
                // Written angles are written again with the same digits.
                prop_assert_eq!(ticks(order, &turning(order, said), scale), ticks(order, &r, scale));
            }
        }
    }
}
