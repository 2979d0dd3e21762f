//! Shape-generation functions ready to be evaluated: points, frames, exact derivatives, normals.
//!
//! Derivatives come from the twists of the links: a link that shifts moves the point along its direction, one that
//! turns moves it by `axis x (point - place of the axis)`, each times the exact derivative of its law.

use glam::{DMat3, DVec3};

use super::{ChainElement, GeneratedSurface};
use crate::base::Result;
use crate::geom::Rigid;
use crate::machine::formula::BoundFormula;
use crate::machine::formula::Expression;

/// A chain with its laws bound to the two variables of its surface: a function from (u, v) to a frame, whose origin is
/// the point. Cheap to evaluate: constant links are multiplied out.
#[derive(Clone, Debug)]
pub struct ShapeFunction {
    steps: Vec<Step>,
    inward: bool,
}

#[derive(Clone, Debug)]
enum Step {
    Fixed(Rigid),
    Moving {
        rotation: bool,
        direction: DVec3,
        law: BoundFormula,
        by_u: Option<BoundFormula>,
        by_v: Option<BoundFormula>,
    },
}

/// Frame and point with their first derivatives by the two variables.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ShapeJet {
    /// The frame at the end of the chain; its origin is the point.
    pub frame: Rigid,
    /// Derivatives of the point by u and by v [mm per unit of the variable].
    pub tangents: [DVec3; 2],
    /// Angular velocity of the frame by u and by v [rad per unit of the variable].
    pub spins: [DVec3; 2],
}

impl ShapeJet {
    /// The point [mm].
    pub fn point(&self) -> DVec3 {
        self.frame.translation
    }

    /// Product of the derivatives by u and by v; its length is the density of area.
    pub fn area(&self) -> DVec3 {
        self.tangents[0].cross(self.tangents[1])
    }
}

impl GeneratedSurface {
    /// The shape-generation function, ready to be evaluated.
    ///
    /// # Errors
    /// `KC1102` for a name in a law that is neither a parameter nor a variable.
    pub fn compiled(&self) -> Result<ShapeFunction> {
        ShapeFunction::new(self, &self.chain())
    }
}

impl ShapeFunction {
    /// The function of a chain with the parameters, variables and inclined directions of a surface: the whole chain, or
    /// the part of it that is in the machine or in the tool.
    ///
    /// # Errors
    /// `KC1102` for a name in a law that is neither a parameter nor a variable.
    pub fn new(surface: &GeneratedSurface, chain: &[ChainElement]) -> Result<ShapeFunction> {
        let names = [surface.variables[0].name.as_str(), surface.variables[1].name.as_str()];
        let mut steps: Vec<Step> = Vec::with_capacity(chain.len());
        for element in chain {
            let law = surface.with_numbers(&element.law);
            let direction = surface.direction(element.motion);
            if let Some(value) = law.constant() {
                let motion = element.motion.motion(value, direction);
                match steps.last_mut() {
                    Some(Step::Fixed(before)) => *before = before.after(&motion),
                    _ => steps.push(Step::Fixed(motion)),
                }
                continue;
            }
            let derivative = |name: &str| -> Result<Option<BoundFormula>> {
                let derivative: Expression = law.derivative(name);
                let vanishes = derivative.constant() == Some(0.0);
                if vanishes { Ok(None) } else { derivative.bind(&names).map(Some) }
            };
            steps.push(Step::Moving {
                rotation: element.motion.is_rotation(),
                direction,
                law: law.bind(&names)?,
                by_u: derivative(names[0])?,
                by_v: derivative(names[1])?,
            });
        }
        Ok(ShapeFunction { steps, inward: surface.inward })
    }

    /// The point at (u, v) [mm].
    pub fn point(&self, u: f64, v: f64) -> DVec3 {
        self.steps.iter().rev().fold(DVec3::ZERO, |p, step| match step {
            Step::Fixed(motion) => motion.point(p),
            Step::Moving { rotation: false, direction, law, .. } => p + *direction * law.value(&[u, v]),
            Step::Moving { direction, law, .. } => turned(p, *direction, law.value(&[u, v])),
        })
    }

    /// The frame at the end of the chain at (u, v); its origin is the point.
    pub fn frame(&self, u: f64, v: f64) -> Rigid {
        self.steps.iter().fold(Rigid::IDENTITY, |frame, step| frame.after(&step.motion(u, v)))
    }

    /// Frame, point and first derivatives at (u, v), all exact.
    pub fn jet(&self, u: f64, v: f64) -> ShapeJet {
        let mut frame = Rigid::IDENTITY;
        // Angular velocity, and velocity of the point of the body that is at the origin, by u and by v.
        let (mut spins, mut shifts) = ([DVec3::ZERO; 2], [DVec3::ZERO; 2]);
        for step in &self.steps {
            if let Step::Moving { rotation, direction, by_u, by_v, .. } = step {
                let axis = frame.vector(*direction);
                for (k, rate) in [by_u, by_v].into_iter().enumerate() {
                    let Some(rate) = rate.as_ref().map(|r| r.value(&[u, v])) else { continue };
                    if *rotation {
                        spins[k] += axis * rate;
                        shifts[k] += frame.translation.cross(axis) * rate;
                    } else {
                        shifts[k] += axis * rate;
                    }
                }
            }
            frame = frame.after(&step.motion(u, v));
        }
        let tangent = |k: usize| shifts[k] + spins[k].cross(frame.translation);
        ShapeJet { frame, tangents: [tangent(0), tangent(1)], spins }
    }

    /// The unit normal out of the material at (u, v); `None` where the derivatives are parallel or vanish.
    pub fn normal(&self, u: f64, v: f64) -> Option<DVec3> {
        let jet = self.jet(u, v);
        self.normal_of(&jet)
    }

    /// The unit normal out of the material of a jet of this function; `None` where the derivatives are parallel or
    /// vanish.
    pub fn normal_of(&self, jet: &ShapeJet) -> Option<DVec3> {
        let area = jet.area();
        let least = PARALLEL * jet.tangents[0].length() * jet.tangents[1].length();
        let regular = area.length() > least;
        regular.then(|| area.try_normalize()).flatten().map(|n| if self.inward { -n } else { n })
    }
}

/// Sine of the angle between the derivatives at which their product is lost in rounding.
const PARALLEL: f64 = 1e-12;

impl Step {
    fn motion(&self, u: f64, v: f64) -> Rigid {
        match self {
            Step::Fixed(motion) => *motion,
            Step::Moving { rotation: false, direction, law, .. } => {
                Rigid::from_translation(*direction * law.value(&[u, v]))
            }
            Step::Moving { direction, law, .. } => {
                let rotation = DMat3::from_axis_angle(*direction, law.value(&[u, v]));
                Rigid { rotation, translation: DVec3::ZERO }
            }
        }
    }
}

/// A vector turned about a unit direction (Rodrigues).
fn turned(p: DVec3, direction: DVec3, angle: f64) -> DVec3 {
    let (sin, cos) = angle.sin_cos();
    let along = direction * direction.dot(p);
    along + (p - along) * cos + direction.cross(p) * sin
}
