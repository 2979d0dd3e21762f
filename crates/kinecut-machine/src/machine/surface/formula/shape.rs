//! Shape-generation functions as formulas.

use glam::DVec3;

use super::super::{ChainElement, GeneratedSurface};
use super::matrix::component;
use super::{Matrix, Vector};
use crate::machine::Elementary;
use crate::machine::formula::Expression;

/// A chain with its matrices and its point as formulas in the parameters and variables of the laws.
///
/// ```
/// # use kinecut_machine as kinecut;
/// use kinecut::machine::surface::GeneratedSurface;
/// let cone = GeneratedSurface::named("cone").unwrap().formula();
/// assert_eq!(cone.product_text(), "r0 = A6(phi) A1(R) A5(-alpha) A3(z) e4");
/// assert_eq!(
///     cone.point_text(),
///     "((R - z*sin(alpha))*cos(phi), (R - z*sin(alpha))*sin(phi), z*cos(alpha))"
/// );
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct ShapeFormula {
    chain: Vec<ChainElement>,
    inclined: [DVec3; 3],
    matrices: Vec<Matrix>,
    point: Vector,
}

impl ShapeFormula {
    /// The formula of a chain. `inclined` has the directions of the motions 7, 8, 9, of any length but zero; Z where
    /// one is not declared.
    ///
    /// ```
    /// # use kinecut_machine as kinecut;
    /// use kinecut::machine::surface::{ShapeFormula, parse_chain};
    /// let unwound = ShapeFormula::new(&parse_chain("6(f) 1(rb) 2(-rb*f)").unwrap(), [None; 3]);
    /// assert_eq!(unwound.point()[0].to_string(), "rb*(cos(f) + f*sin(f))"); // the involute
    /// ```
    pub fn new(chain: &[ChainElement], inclined: [Option<DVec3>; 3]) -> ShapeFormula {
        let inclined = inclined.map(|d| d.and_then(DVec3::try_normalize).unwrap_or(DVec3::Z));
        let matrices: Vec<Matrix> =
            chain.iter().map(|e| Matrix::of(e.motion, &e.law, declared(inclined, e.motion))).collect();
        let origin: Vector = std::array::from_fn(|_| Expression::number(0.0));
        let point = matrices.iter().rev().fold(origin, |p, matrix| matrix.point(&p));
        ShapeFormula { chain: chain.to_vec(), inclined, matrices, point: point.map(|x| x.simplest()) }
    }

    /// The unit direction along which a motion shifts or about which it turns, as numbers.
    pub fn direction(&self, motion: Elementary) -> Vector {
        let direction = motion.direction().unwrap_or_else(|| declared(self.inclined, motion));
        direction.to_array().map(component)
    }

    /// The chain.
    pub fn chain(&self) -> &[ChainElement] {
        &self.chain
    }

    /// The matrices of the elements, in the order of the chain.
    pub fn matrices(&self) -> &[Matrix] {
        &self.matrices
    }

    /// The point multiplied out [mm]: the shape-generation function without its fourth coordinate, which is 1.
    pub fn point(&self) -> &Vector {
        &self.point
    }

    /// The derivative of the point by a variable [mm per unit of the variable].
    pub fn tangent(&self, variable: &str) -> Vector {
        self.point.each_ref().map(|x| x.derivative(variable).simplest())
    }

    /// The product of the derivatives by two variables: normal to the surface, its length the density of area.
    pub fn normal(&self, variables: [&str; 2]) -> Vector {
        let [a, b] = variables.map(|name| self.tangent(name));
        cross(&a, &b).map(|x| x.simplest())
    }

    /// All matrices multiplied out.
    pub fn product(&self) -> Matrix {
        let last = Matrix::identity();
        self.matrices.iter().rev().fold(last, |product, matrix| matrix.times(&product))
    }
}

/// The declared direction of an inclined motion.
fn declared(inclined: [DVec3; 3], motion: Elementary) -> DVec3 {
    let place = usize::from(motion.digit().saturating_sub(7));
    inclined.get(place).copied().unwrap_or(DVec3::Z)
}

impl GeneratedSurface {
    /// The shape-generation function of the surface as formulas in its parameters and variables.
    pub fn formula(&self) -> ShapeFormula {
        ShapeFormula::new(&self.chain(), self.inclined)
    }
}

/// The vector product; simplified by zeros and ones only.
pub(in super::super) fn cross(a: &Vector, b: &Vector) -> Vector {
    std::array::from_fn(|i| {
        let (k, l) = ((i + 1) % 3, (i + 2) % 3);
        &a[k] * &b[l] - &a[l] * &b[k]
    })
}

/// The scalar product; simplified by zeros and ones only.
pub(in super::super) fn dot(a: &Vector, b: &Vector) -> Expression {
    a.iter().zip(b).fold(Expression::number(0.0), |sum, (x, y)| sum + x * y)
}
