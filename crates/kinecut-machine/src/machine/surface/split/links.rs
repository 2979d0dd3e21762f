//! Linked motions: elements of the machine that follow one variable together.

use super::super::{ChainElement, GeneratedSurface};
use crate::machine::Elementary;

/// Kind of a linked motion.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum LinkKind {
    /// A rotation and the translation along its axis in proportion.
    Screw,
    /// A rotation and the translation along its axis by a law that is not linear.
    Cam,
    /// A rotation and a translation tangential to a circle about its axis in proportion.
    Rolling,
    /// A rotation and a translation across its axis in proportion.
    Spiral,
    /// Rotations only.
    Polygon,
    /// Translations only.
    Contour,
    /// Anything else.
    Ruled,
}

impl LinkKind {
    /// The name in lower case.
    pub fn name(self) -> &'static str {
        match self {
            LinkKind::Screw => "screw",
            LinkKind::Cam => "cam",
            LinkKind::Rolling => "rolling",
            LinkKind::Spiral => "spiral",
            LinkKind::Polygon => "polygon",
            LinkKind::Contour => "contour",
            LinkKind::Ruled => "ruled",
        }
    }
}

/// A complex motion: elements of the machine whose laws contain the same variable.
#[derive(Clone, Debug, PartialEq)]
pub struct LinkedMotion {
    /// The variable.
    pub variable: String,
    /// The elements in the order of the chain, two or more.
    pub elements: Vec<ChainElement>,
    /// Kind of the linked motion.
    pub kind: LinkKind,
}

/// The linked motions of the machine's part of a surface's chain, by the names of their variables.
pub(super) fn links(
    surface: &GeneratedSurface,
    machine: &[ChainElement],
    variables: &[String],
) -> Vec<LinkedMotion> {
    let linked = |variable: &String| {
        let elements: Vec<ChainElement> = machine.iter().filter(|e| e.has(variable)).cloned().collect();
        let kind = kind(surface, &elements, variable);
        (elements.len() > 1).then(|| LinkedMotion { variable: variable.clone(), elements, kind })
    };
    variables.iter().filter_map(linked).collect()
}

fn kind(surface: &GeneratedSurface, elements: &[ChainElement], variable: &str) -> LinkKind {
    let (turns, shifts): (Vec<&ChainElement>, Vec<&ChainElement>) =
        elements.iter().partition(|e| e.motion.is_rotation());
    let (turn, shift) = match (turns.as_slice(), shifts.as_slice()) {
        ([], _) => return LinkKind::Contour,
        (_, []) => return LinkKind::Polygon,
        ([turn], [shift]) => (*turn, *shift),
        _ => return LinkKind::Ruled,
    };
    let slope = |e: &ChainElement| {
        let law = surface.with_numbers(&e.law);
        law.is_affine_in(variable).and_then(|(slope, _)| slope.simplified().constant())
    };
    let slopes = slope(turn).zip(slope(shift));
    let along = turn.motion.direction().is_some() && turn.motion.direction() == shift.motion.direction();
    match (along, slopes) {
        (true, Some(_)) => LinkKind::Screw,
        (true, None) => LinkKind::Cam,
        (false, None) => LinkKind::Ruled,
        (false, Some((angle, length))) if rolls(surface, turn, shift, length / angle) => LinkKind::Rolling,
        (false, Some(_)) => LinkKind::Spiral,
    }
}

/// True if the shift unrolls a circle: the chain has a constant arm across both the axis and the shift, whose end the
/// rotation carries as fast as the shift goes, the other way.
fn rolls(surface: &GeneratedSurface, turn: &ChainElement, shift: &ChainElement, ratio: f64) -> bool {
    let arm_of = |motion: Elementary| {
        let arms = surface.chain().into_iter().filter(|e| e.motion == motion);
        arms.map(|e| surface.with_numbers(&e.law).constant()).sum::<Option<f64>>()
    };
    let axis = surface.direction(turn.motion);
    let along = surface.direction(shift.motion);
    Elementary::STANDARD[..3].iter().any(|&motion| {
        let direction = surface.direction(motion);
        let across = axis.cross(direction).dot(along);
        // Carried speed of the end of the arm per radian, along the shift.
        let carried = arm_of(motion).map(|arm| arm * across);
        across != 0.0 && carried.is_some_and(|c| c != 0.0 && (c + ratio).abs() <= ROLLING * c.abs())
    })
}

/// Relative slip of a rolling motion: rounding of constants as people write them.
const ROLLING: f64 = 1e-6;
