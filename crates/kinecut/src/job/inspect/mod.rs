//! Sections, points and distances of the cut part, as a user asks for them.
//!
//! All are taken from the mesh of the part, in the coordinates of the raw stock.

mod measure;
mod page;
mod plane;
mod point;
mod section;
mod svg;

use glam::DVec3;
use serde::Serialize;

use super::{Outcome, PartSurface, json_text};
use crate::base::{Code, Finding, Result};
use crate::page::Section;

pub use measure::{Measure, Stretch};
pub use plane::SectionPlane;
pub use point::{CutBy, Facing, InspectedPoint, Place};
pub use section::{OutlineFigures, PartSection};

/// Least radius of a bend for which the sag of facets is known [steps].
const LEAST_BEND: f64 = 4.0;

/// Sections, points and distances that are asked for.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct InspectWants {
    /// Planes of sections; one that comes twice is shown once.
    pub sections: Vec<SectionPlane>,
    /// Points of the part [mm].
    pub points: Vec<DVec3>,
    /// Pairs of points to be measured between [mm].
    pub measures: Vec<[DVec3; 2]>,
}

impl InspectWants {
    /// Whether nothing is asked for.
    pub fn is_empty(&self) -> bool {
        self.sections.is_empty() && self.points.is_empty() && self.measures.is_empty()
    }
}

/// Sections, points and distances of a cut part.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Inspection {
    /// Version of this form.
    format: u32,
    /// Distance of the lines of the stock [mm]: a web or slot thinner than it may be missing in the part.
    pub step: f64,
    /// Distances from the surface are within this [mm] where it bends with a radius of four steps or more: the tolerance of its
    /// mesh, and the sag of its facets.
    pub within: f64,
    /// The sections, in the order asked for.
    pub sections: Vec<PartSection>,
    /// The points, in the order asked for.
    pub points: Vec<InspectedPoint>,
    /// What lies between two points, in the order asked for.
    pub measures: Vec<Measure>,
}

impl Inspection {
    /// The sections, points and distances that are asked for; `None` if there are none of them.
    ///
    /// # Errors
    /// `KC0602` when the surface of the part is not closed; `KC0801` when none was made.
    pub fn of(outcome: &Outcome, wants: &InspectWants) -> Result<Option<Inspection>> {
        if wants.is_empty() {
            return Ok(None);
        }
        if outcome.job.part_surface == PartSurface::None || outcome.drawn_step.is_some() {
            return Err(Finding::error(
                Code::GEOMETRY,
                "sections, points and distances need the surface of the part",
            )
            .help("run the job with the full surface")
            .into());
        }
        let mut planes: Vec<SectionPlane> = Vec::new();
        for plane in &wants.sections {
            if !planes.contains(plane) {
                planes.push(*plane);
            }
        }
        let step = outcome.job.step;
        // Over the diagonal d of a cell a sphere of radius R rises by d^2 / 8 R.
        let within = outcome.job.surface.tolerance(step) + step / (4.0 * LEAST_BEND);
        let sections = planes.iter().map(|plane| PartSection::of(&outcome.part, within, *plane));
        Ok(Some(Inspection {
            format: 1,
            step,
            within,
            sections: sections.collect::<Result<_>>()?,
            points: point::inspected(outcome, within, &wants.points)?,
            measures: wants.measures.iter().map(|ends| measure::measured(outcome, within, *ends)).collect(),
        }))
    }

    /// The text of `inspection.json`; lengths in mm, areas in mm2.
    pub fn to_json(&self) -> String {
        json_text(self)
    }

    /// The pictures of the sections to the scale of the part: name and text of each.
    pub fn pictures(&self) -> impl Iterator<Item = (&str, String)> {
        self.sections.iter().filter_map(|section| Some((section.file.as_deref()?, svg::svg(section))))
    }

    /// The section of the report about them.
    pub(crate) fn shown(&self) -> Section {
        page::shown(self)
    }
}
