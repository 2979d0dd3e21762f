//! A point of the part: in material or not, the surfaces about it, and the line of the program that cut them.

use glam::DVec3;
use serde::Serialize;

use super::super::Outcome;
use super::super::setup_outcome::block_of_cut;
use crate::base::Result;
use crate::geom::{MeshCrossing, MeshDistance};

/// Place of a point.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Place {
    /// In the material.
    Material,
    /// Outside of it.
    Outside,
    /// Nearer to its surface than distances are known: on which side is open.
    Surface,
}

/// Maker of a piece of surface.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum CutBy {
    /// The raw stock, which no move has touched here.
    RawStock,
    /// A hole that the stock had before, or a core that was taken out.
    NoMove,
    /// A block of a program.
    Line {
        /// File of the program.
        program: String,
        /// Line, from 1.
        line: u32,
        /// Line in all programs together, from 0.
        #[serde(skip)]
        of_all: u32,
    },
}

/// The surface in a direction from a point.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Facing {
    /// `-X` to `+Z`, or `nearest`.
    pub towards: &'static str,
    /// Distance from the point [mm].
    pub distance: f64,
    /// The place of the surface [mm].
    pub at: [f64; 3],
    /// Its maker.
    pub cut_by: CutBy,
}

/// A point of the part.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct InspectedPoint {
    /// The point [mm].
    pub at: [f64; 3],
    /// Its place.
    pub place: Place,
    /// Nearest surface first, then those in the directions of the axes; a direction without surface is left out.
    pub surfaces: Vec<Facing>,
}

/// The points of an outcome's part.
///
/// # Errors
/// `KC0602` when the surface of the part is not closed.
pub(super) fn inspected(outcome: &Outcome, within: f64, points: &[DVec3]) -> Result<Vec<InspectedPoint>> {
    if points.is_empty() {
        return Ok(Vec::new());
    }
    let distance = MeshDistance::new(&outcome.part)?;
    Ok(points.iter().map(|p| one(outcome, &distance, within, *p)).collect())
}

fn one(outcome: &Outcome, distance: &MeshDistance, within: f64, p: DVec3) -> InspectedPoint {
    let nearest = distance.nearest(p);
    let place = match nearest {
        Some(n) if n.distance.abs() <= within => Place::Surface,
        Some(n) if n.distance < 0.0 => Place::Material,
        _ => Place::Outside,
    };
    let mut surfaces = Vec::with_capacity(7);
    if let Some(n) = nearest {
        surfaces.push(Facing {
            towards: "nearest",
            distance: n.distance.abs(),
            at: n.point.to_array(),
            cut_by: cut_by(outcome, n.triangle),
        });
    }
    for (axis, [back, on]) in [["-X", "+X"], ["-Y", "+Y"], ["-Z", "+Z"]].into_iter().enumerate() {
        let crossings = outcome.part.crossings(axis, p);
        let here = crossings.partition_point(|c| c.at < p[axis]);
        let facing = |towards, c: &MeshCrossing| {
            let mut at = p;
            at[axis] = c.at;
            let distance = (c.at - p[axis]).abs();
            Facing { towards, distance, at: at.to_array(), cut_by: cut_by(outcome, c.triangle) }
        };
        surfaces.extend(crossings[..here].last().map(|c| facing(back, c)));
        surfaces.extend(crossings.get(here).map(|c| facing(on, c)));
    }
    InspectedPoint { at: p.to_array(), place, surfaces }
}

/// The maker of a triangle of the part.
pub(super) fn cut_by(outcome: &Outcome, triangle: u32) -> CutBy {
    let cut = outcome.part_cuts.get(triangle as usize).copied().unwrap_or(0);
    if cut == 0 {
        return CutBy::RawStock;
    }
    let block = block_of_cut(&outcome.setups, &outcome.simulation, cut);
    let line = block.and_then(|(setup, item)| {
        let setups = &outcome.setups;
        let line = setups[setup].lines.get(item as usize).copied().flatten()?;
        let before = setups[..setup].iter().map(|s| s.posted.text.lines().count() as u32).sum::<u32>();
        Some(CutBy::Line { program: setups[setup].file.clone(), line: line + 1, of_all: before + line })
    });
    line.unwrap_or(CutBy::NoMove)
}
