//! Surfaces and how they are made, in the units of the shop: the generating lines as read, the function of the surface
//! written out, every redistribution of its motions between machine and tool.

mod mesh;
mod on_machine;
mod on_machine_rows;
pub(crate) mod page;
mod place;
mod read;
mod sheet;
mod sketches;
mod split;
mod split_row;
mod wants;

use serde::Serialize;

use super::Answer;
use crate::base::{Finding, Result};
use crate::job::Outputs;
use crate::machine::surface::{GeneratedSurface, catalogue};
use crate::page::{Block, Fact, Row, Section, Table};
use crate::verbs::poses::triple;

pub use mesh::{FaceRow, MeshSheet, mesh_sheet};
pub use on_machine::{OnMachineWants, on_machine};
pub use on_machine_rows::{
    AlternativeRow, EnvelopedRow, HowMade, MadeRow, NearestRow, OnMachine, ResidualRow,
};
pub(crate) use on_machine_rows::{NEARNESS, NOT_VERIFIED};
pub use page::surface_html;
pub use place::{LineThrough, MotionAt, MotionPoints, SketchPoints, SurfacePlace, SurfaceSketch, place_of};
pub use read::{load_surface, set_parameter, surface};
pub use sheet::{EnvelopeRow, MethodProcesses, SurfaceSheet, surface_sheet};
pub use sketches::{split_sketches, surface_drawing};
pub use split::{
    MotionRole, SketchMotion, SketchTool, SplitSketch, split_drawing, split_figure, split_sheet,
};
pub use split_row::{LinkRow, SetupRow, SplitRow};
pub use wants::{SurfaceWants, axis_errors};

/// A surface, and what a machine says to it.
#[derive(Clone, Debug, Serialize)]
pub struct SurfaceAnswer {
    /// The surface.
    #[serde(flatten)]
    pub sheet: SurfaceSheet,
    /// A place on it, if one is asked about.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub place: Option<SurfacePlace>,
    /// Points of the sketches, if they are asked for.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub sketch: Option<SurfaceSketch>,
    /// Answers of the machine.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub on_machine: Option<OnMachine>,
}

impl Answer for SurfaceAnswer {
    fn sections(&self) -> Vec<Section> {
        let mut sections = page::sections(&self.sheet, self.on_machine.as_ref());
        sections.extend(self.place.as_ref().map(place));
        sections
    }

    fn findings(&self) -> Vec<&Finding> {
        self.sheet.findings.iter().collect()
    }

    fn is_no(&self) -> bool {
        self.on_machine.as_ref().is_some_and(|made| !made.is_possible())
    }

    fn svg(&self) -> Result<String> {
        let at = self.place.as_ref().map(|place| [0, 1].map(|i| place.variables[i].1));
        surface_drawing(&self.sheet, at)
    }

    fn files(answers: &[&SurfaceAnswer]) -> Result<Outputs> {
        let mut outputs = Outputs::default();
        for answer in answers {
            outputs.add("surface.html", surface_html(&answer.sheet, answer.on_machine.as_ref())?);
        }
        Ok(outputs)
    }
}

/// A place in words.
fn place(place: &SurfacePlace) -> Section {
    let at: Vec<String> = place.variables.iter().map(|(name, value)| format!("{name} = {value}")).collect();
    let mut facts = vec![Fact::new("Point", triple(place.point))];
    facts.extend(place.normal.map(|normal| Fact::new("Normal", triple(normal))));
    Section::new(format!("At {}", at.join(", "))).with(Block::Facts(facts))
}

/// The surfaces of the catalogue.
#[derive(Clone, Debug, Serialize)]
#[serde(transparent)]
pub struct KnownSurfaces(Vec<KnownSurface>);

#[derive(Clone, Debug, Serialize)]
struct KnownSurface {
    code: String,
    name: String,
    title: String,
}

impl KnownSurfaces {
    /// All of them.
    pub fn all() -> KnownSurfaces {
        let one = |s: &GeneratedSurface| KnownSurface {
            code: s.code().to_string(),
            name: s.name.clone(),
            title: s.title.clone(),
        };
        KnownSurfaces(catalogue().iter().map(one).collect())
    }
}

impl Answer for KnownSurfaces {
    fn sections(&self) -> Vec<Section> {
        let row = |s: &KnownSurface| [&s.name, &s.code, &s.title].map(|text| text.as_str().into()).to_vec();
        let rows = self.0.iter().map(|s| Row::new(row(s)));
        let table = Table::new("", "Name; Code; Surface").rows(rows);
        vec![Section::default().with(table)]
    }
}
