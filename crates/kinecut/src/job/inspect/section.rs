//! The section of the part by a plane.

use glam::DVec3;
use serde::Serialize;

use super::SectionPlane;
use crate::base::Result;
use crate::geom::{Mesh, SectionOutline};
use crate::page::simplify::kept;

/// Corners that lie within this of the line through their neighbours are left out [mm]: the step in which ends of lines are kept.
const STRAIGHT: f64 = 1e-5;

/// The section of the part by a plane, of the material just below it.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct PartSection {
    /// The plane.
    pub plane: SectionPlane,
    /// Name of its picture; none where the plane does not meet the part.
    pub file: Option<String>,
    /// Area of material [mm2].
    pub area: f64,
    /// The true area is no farther from it than this [mm2]: the error of distances all along the outlines.
    pub area_bound: f64,
    /// The outlines; none where the plane does not meet the part.
    pub outlines: Vec<OutlineFigures>,
}

/// An outline of a section.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct OutlineFigures {
    /// Whether it bounds a hole in the material.
    pub hole: bool,
    /// Area within it [mm2].
    pub area: f64,
    /// Length around it [mm].
    pub length: f64,
    /// Least coordinates of its corners [mm].
    pub low: [f64; 3],
    /// Greatest coordinates of its corners [mm].
    pub high: [f64; 3],
    /// Its corners as the picture shows them, right and up [mm].
    #[serde(skip)]
    pub points: Vec<[f64; 2]>,
}

impl PartSection {
    /// The section of a part whose surface is known `within` [mm]; outlines with the largest area first.
    ///
    /// # Errors
    /// `KC0602` when the mesh is not closed.
    pub(super) fn of(part: &Mesh, within: f64, plane: SectionPlane) -> Result<PartSection> {
        let mut found = part.section(plane.normal(), plane.at)?;
        found.sort_by(|a, b| b.area.abs().total_cmp(&a.area.abs()));
        let outlines: Vec<OutlineFigures> = found.iter().map(|o| figures(o, plane)).collect();
        Ok(PartSection {
            plane,
            file: (!found.is_empty())
                .then(|| format!("section-{}{}.svg", format!("{:?}", plane.axis).to_lowercase(), plane.at)),
            area: rounded(found.iter().map(|o| o.area).sum::<f64>()),
            area_bound: rounded(within * found.iter().map(|o| o.length).sum::<f64>()),
            outlines,
        })
    }
}

fn figures(outline: &SectionOutline, plane: SectionPlane) -> OutlineFigures {
    let low = outline.points.iter().copied().fold(DVec3::INFINITY, DVec3::min);
    let high = outline.points.iter().copied().fold(DVec3::NEG_INFINITY, DVec3::max);
    let [right, up] = plane.seen();
    let mut ring: Vec<[f64; 2]> = outline.points.iter().map(|p| [p[right], p[up]]).collect();
    ring.extend(ring.first().copied());
    let mut points: Vec<[f64; 2]> = kept(&ring, STRAIGHT).into_iter().map(|i| ring[i]).collect();
    points.pop();
    OutlineFigures {
        hole: outline.area < 0.0,
        area: rounded(outline.area.abs()),
        length: rounded(outline.length),
        low: low.to_array().map(rounded),
        high: high.to_array().map(rounded),
        points,
    }
}

/// A length or area without digits that are rounding: to a millionth.
fn rounded(value: f64) -> f64 {
    (value * 1e6).round() / 1e6 + 0.0
}
