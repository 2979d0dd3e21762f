//! Distance from an endless prism over a polygon: a rack, a broach.

use glam::{DVec2, DVec3};

use super::Distance;
use crate::base::{Code, Finding, Result};

/// The points over a closed polygon in the XY plane, endless along Z.
#[derive(Clone, Debug, PartialEq)]
pub struct Prism {
    corners: Vec<DVec2>,
}

impl Prism {
    /// A prism over these corners [mm], in either sense.
    ///
    /// # Errors
    /// `KC1131` for fewer than three corners, or a number that is not finite.
    pub fn new(corners: Vec<DVec2>) -> Result<Prism> {
        if corners.len() < 3 || corners.iter().any(|c| !c.is_finite()) {
            return Err(Finding::error(
                Code::GENERATION_INPUT,
                "a polygon has too few corners or a number that is not finite",
            )
            .value(corners.len() as f64, "corners")
            .bound(3.0, "corners")
            .help("give three corners or more")
            .into());
        }
        Ok(Prism { corners })
    }
}

impl Distance for Prism {
    fn signed(&self, p: DVec3) -> f64 {
        let p = p.truncate();
        let (mut squared, mut inside) = (f64::INFINITY, false);
        let mut a = self.corners[self.corners.len() - 1];
        for &b in &self.corners {
            let (along, to) = (b - a, p - a);
            let length = along.length_squared();
            let share = if length > 0.0 { (to.dot(along) / length).clamp(0.0, 1.0) } else { 0.0 };
            squared = squared.min((to - along * share).length_squared());
            // The half-open rule counts a corner once.
            if (a.y > p.y) != (b.y > p.y) && p.x < a.x + along.x * (p.y - a.y) / along.y {
                inside = !inside;
            }
            a = b;
        }
        if inside { -squared.sqrt() } else { squared.sqrt() }
    }
}
