//! Shifted and turned coordinates as numbers of a text: a shift [mm] and an angle about Z [deg], and the motion that maps
//! the turned coordinates into those of the work offset.
//!
//! For writer and reader, so that both find the same motion to the last bit.
//!
//! ```text
//! TRANS X.. Y.. Z.. / AROT RPL=a        p' = shift + R(a) p
//! G52 X.. Y.. Z.. / G68 X0 Y0 Ra        p' = shift + R(a) p
//! CYCL DEF 7 / CYCL DEF 10 ROT a        p' = shift + R(a) p
//! G10 L2 P. Ra / G52 X.. Y.. Z..        p' = R(a) (p + shift)
//! ```

use glam::{DMat3, DVec2, DVec3};

use crate::geom::Rigid;
use crate::program::moved;

use super::dialect::TurnWord;

/// The rotation by an angle about Z [deg], exact for quarter turns.
pub(super) fn rotation(degrees: f64) -> DMat3 {
    let part = degrees.rem_euclid(360.0);
    let quarters = (part / 90.0).round();
    let rest = DVec2::from_angle((part - 90.0 * quarters).to_radians());
    let x = match quarters as u8 % 4 {
        0 => rest,
        1 => rest.perp(),
        2 => -rest,
        _ => -rest.perp(),
    };
    // Positive zeros: equal motions are compared as numbers, but printed alike too.
    let x = x + DVec2::ZERO;
    DMat3::from_cols(x.extend(0.0), (x.perp() + DVec2::ZERO).extend(0.0), DVec3::Z)
}

/// The motion of a shift [mm] and an angle [deg] under the rule of a control.
pub(super) fn motion(word: TurnWord, shift: DVec3, degrees: f64) -> Rigid {
    let rotation = rotation(degrees);
    let translation = match word {
        TurnWord::Offset => rotation * shift,
        _ => shift,
    };
    Rigid { rotation, translation }
}

/// The shift of a motion under the rule of a control [mm].
pub(super) fn shift(word: TurnWord, motion: &Rigid) -> DVec3 {
    match word {
        TurnWord::Offset => motion.rotation.transpose() * motion.translation,
        _ => motion.translation,
    }
}

/// A place known in part, given in coordinates moved by `before`, in coordinates moved by `motion`.
pub(super) fn restated(place: [Option<f64>; 3], before: &Rigid, motion: &Rigid) -> [Option<f64>; 3] {
    let known = DVec3::from_array(place.map(|v| v.unwrap_or(f64::NAN)));
    let there = moved(&motion.inverse(), moved(before, known));
    there.to_array().map(|v| Some(v).filter(|v| !v.is_nan()))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn quarter_turns_are_exact_and_the_sense_is_against_the_clock() {
        assert_eq!(rotation(90.0) * DVec3::X, DVec3::Y);
        assert_eq!(rotation(-90.0) * DVec3::new(1.0, 2.0, 3.0), DVec3::new(2.0, -1.0, 3.0));
        assert_eq!(rotation(360.0), DMat3::IDENTITY);
        let p = rotation(30.0) * DVec3::X;
        assert!((p - DVec3::new(0.75f64.sqrt(), 0.5, 0.0)).length() < 1e-15);
    }

    #[test]
    fn linuxcnc_turns_its_shift_too() {
        let shifted = DVec3::new(10.0, 0.0, 3.0);
        assert_eq!(motion(TurnWord::Offset, shifted, 90.0).point(DVec3::ZERO), DVec3::new(0.0, 10.0, 3.0));
        for word in [TurnWord::Offset, TurnWord::Local] {
            let there = motion(word, shifted, 33.0);
            assert!((shift(word, &there) - shifted).length() < 1e-14);
        }
    }
}
