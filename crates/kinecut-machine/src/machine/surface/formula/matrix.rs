//! Matrices of elementary motions with formulas as entries.

use glam::DVec3;

use crate::machine::Elementary;
use crate::machine::formula::Expression;

/// A point or direction of three formulas.
pub type Vector = [Expression; 3];

/// A homogeneous matrix of four rows, acting on columns.
#[derive(Clone, Debug, PartialEq)]
pub struct Matrix(pub [[Expression; 4]; 4]);

fn number(value: f64) -> Expression {
    Expression::number(value)
}

/// A number from a cosine of a direction, without the rounding of a unit vector that a reader should not see.
pub(super) fn component(value: f64) -> Expression {
    /// Rounding of a direction that was made a unit vector.
    const ROUNDING: f64 = 1e-15;
    let whole = value.round();
    number(if (value - whole).abs() < ROUNDING { whole } else { value })
}

impl Matrix {
    /// The identity.
    pub fn identity() -> Matrix {
        Matrix(std::array::from_fn(|i| std::array::from_fn(|k| number(if i == k { 1.0 } else { 0.0 }))))
    }

    /// The motion by a law [mm or rad], right-handed; a rotation about an inclined axis turns about the unit vector
    /// `inclined` (Rodrigues).
    pub fn of(motion: Elementary, law: &Expression, inclined: DVec3) -> Matrix {
        let mut matrix = Matrix::identity();
        let rows = &mut matrix.0;
        if !motion.is_rotation() {
            let axis = usize::from(motion.digit()) - 1;
            rows[axis][3] = law.simplified();
            return matrix;
        }
        let (cos, sin) = (law.cos().simplified(), law.sin().simplified());
        match motion.direction() {
            Some(direction) => {
                let axis = if direction.x == 1.0 {
                    0
                } else if direction.y == 1.0 {
                    1
                } else {
                    2
                };
                let (i, k) = ((axis + 1) % 3, (axis + 2) % 3);
                rows[i][i] = cos.clone();
                rows[k][k] = cos;
                rows[i][k] = (-&sin).simplified();
                rows[k][i] = sin;
            }
            None => {
                let a: Vec<Expression> = inclined.to_array().map(component).into();
                let rest = number(1.0) - cos.clone();
                for i in 0..3 {
                    for k in 0..3 {
                        let both = &a[i] * &a[k] * rest.clone();
                        // The cross product with the direction: row i, column k.
                        let cross = match (3 + k - i) % 3 {
                            0 => cos.clone(),
                            1 => -(&a[3 - i - k] * &sin),
                            _ => &a[3 - i - k] * &sin,
                        };
                        rows[i][k] = (both + cross).simplified();
                    }
                }
            }
        }
        matrix
    }

    /// The product with a matrix on the right; entries in their shortest form.
    #[must_use]
    pub fn times(&self, other: &Matrix) -> Matrix {
        let entry = |i: usize, k: usize| {
            (0..4).fold(number(0.0), |sum, j| sum + &self.0[i][j] * &other.0[j][k]).simplest()
        };
        Matrix(std::array::from_fn(|i| std::array::from_fn(|k| entry(i, k))))
    }

    /// The point to which a point is moved; simplified, not multiplied out.
    pub fn point(&self, p: &Vector) -> Vector {
        std::array::from_fn(|i| {
            let turned = (0..3).fold(number(0.0), |sum, k| sum + &p[k] * &self.0[i][k]);
            (self.0[i][3].clone() + turned).simplified()
        })
    }

    /// The direction to which a direction is turned; simplified, not multiplied out.
    pub fn vector(&self, p: &Vector) -> Vector {
        std::array::from_fn(|i| (0..3).fold(number(0.0), |sum, k| sum + &p[k] * &self.0[i][k]).simplified())
    }
}
