//! Elementary motions: the digits that coordinate codes are made of.

use glam::{DMat3, DVec3};

use crate::geom::Rigid;

/// An elementary motion of the tool side relative to the work side (Danilchenko et al., the digits of a code).
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Elementary {
    /// `1`: translation along X.
    X,
    /// `2`: translation along Y.
    Y,
    /// `3`: translation along Z.
    Z,
    /// `4`: rotation about X.
    A,
    /// `5`: rotation about Y.
    B,
    /// `6`: rotation about Z.
    C,
    /// `7`, `8`, `9`: rotation about an inclined axis, whose direction is declared apart.
    Inclined(u8),
}

impl Elementary {
    /// The three translations and the three rotations about the axes of coordinates.
    pub const STANDARD: [Elementary; 6] =
        [Elementary::X, Elementary::Y, Elementary::Z, Elementary::A, Elementary::B, Elementary::C];

    /// The motion of a digit from 1 to 9.
    ///
    /// ```
    /// # use kinecut_machine as kinecut;
    /// use kinecut::machine::Elementary;
    /// assert_eq!(Elementary::from_digit(6), Some(Elementary::C));
    /// assert_eq!(Elementary::from_digit(0), None); // the bed is no motion
    /// ```
    pub fn from_digit(digit: u8) -> Option<Elementary> {
        match digit {
            1..=6 => Some(Elementary::STANDARD[digit as usize - 1]),
            7..=9 => Some(Elementary::Inclined(digit)),
            _ => None,
        }
    }

    /// The digit of the code, from 1 to 9.
    pub fn digit(self) -> u8 {
        match self {
            Elementary::X => 1,
            Elementary::Y => 2,
            Elementary::Z => 3,
            Elementary::A => 4,
            Elementary::B => 5,
            Elementary::C => 6,
            Elementary::Inclined(digit) => digit,
        }
    }

    /// The letter of ISO 841; an inclined rotation has none of its own.
    pub fn letter(self) -> Option<char> {
        match self {
            Elementary::Inclined(_) => None,
            other => Some(b"XYZABC"[other.digit() as usize - 1] as char),
        }
    }

    /// True for a rotation.
    pub fn is_rotation(self) -> bool {
        self.digit() >= 4
    }

    /// Direction along which it shifts or about which it turns; `None` for an inclined rotation.
    pub fn direction(self) -> Option<DVec3> {
        match self {
            Elementary::X | Elementary::A => Some(DVec3::X),
            Elementary::Y | Elementary::B => Some(DVec3::Y),
            Elementary::Z | Elementary::C => Some(DVec3::Z),
            Elementary::Inclined(_) => None,
        }
    }

    /// Whether two motions may change places for all values: equal ones, two translations, a translation and the
    /// rotation about the same direction. Exact also for rotary axes with offsets. Inclined rotations commute only with
    /// themselves here, because a digit does not tell their direction.
    ///
    /// ```
    /// # use kinecut_machine as kinecut;
    /// use kinecut::machine::Elementary::{A, B, X, Y};
    /// assert!(X.commutes(Y) && X.commutes(A) && A.commutes(A));
    /// assert!(!X.commutes(B) && !A.commutes(B));
    /// ```
    pub fn commutes(self, other: Elementary) -> bool {
        let both_shift = !self.is_rotation() && !other.is_rotation();
        let same_direction = self.direction().is_some() && self.direction() == other.direction();
        self == other || both_shift || same_direction
    }

    /// The motion by `q` [mm or rad], right-handed; an inclined rotation turns about `inclined`.
    ///
    /// The paper's matrix of the rotation about Y (its equation 3) is left-handed; this is the right-handed one.
    pub fn motion(self, q: f64, inclined: DVec3) -> Rigid {
        let direction = self.direction().unwrap_or(inclined);
        if self.is_rotation() {
            Rigid { rotation: DMat3::from_axis_angle(direction, q), translation: DVec3::ZERO }
        } else {
            Rigid::from_translation(direction * q)
        }
    }
}

impl std::fmt::Display for Elementary {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "{}", self.digit())
    }
}
