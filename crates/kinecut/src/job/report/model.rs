//! Everything a report shows, as plain data without a planner's types: made by the job layer, drawn by
//! [`html`](super::html) and [`text`](super::text), serialisable for other front ends.

use rayon::prelude::*;
use serde::{Deserialize, Serialize};

use super::PathPiece;
use crate::base::Finding;
use crate::geom::Mesh;
use crate::job::{Judgement, ToEnsure, Unchecked};
use crate::page::draw::Facets;
use crate::page::{Fact, Section, serde_gap};
use crate::stock::cut::PlayedSurface;

/// The whole report. Lines of the program are counted from 0 here and shown from 1.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Report {
    /// Heading of the page: what was made.
    pub title: String,
    /// Name of the job file as the user gave it; may be empty.
    pub job_file: String,
    /// Version of kinecut that made the report.
    pub version: String,
    /// Safe or not, and why.
    pub verdict: ReportVerdict,
    /// Time [s], if it is known.
    pub time: Option<f64>,
    /// The cut part.
    pub part: Option<PartView>,
    /// Distance of the lines that it is drawn from [mm], where these are not all lines of the stock model.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub drawn_step: Option<f64>,
    /// The surface of the stock over time; [`PathPiece::done`] is its time.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub playback: Option<PlayedSurface>,
    /// Clamps and fixtures.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub fixtures: Vec<FixtureView>,
    /// The machine, where it has bodies and the positions of its axes are known all along the path.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub machine: Option<MachineView>,
    /// The path of the tool in order.
    pub path: Vec<PathPiece>,
    /// The program text that was proven.
    pub program: Option<ProgramView>,
    /// Tools in order of use.
    pub tools: Vec<ToolView>,
    /// Sections that planners add, shown in this order.
    pub sections: Vec<Section>,
    /// All findings.
    pub findings: Vec<Finding>,
    /// Whether sections, facts and findings are in inches; the view of the part, charts, plans and drawings are in mm always.
    #[serde(default, skip_serializing_if = "std::ops::Not::not")]
    pub inches: bool,
}

impl Report {
    /// A report with a verdict and nothing else yet.
    pub fn new(title: impl Into<String>, verdict: ReportVerdict) -> Report {
        Report {
            title: title.into(),
            job_file: String::new(),
            version: env!("CARGO_PKG_VERSION").to_owned(),
            verdict,
            time: None,
            part: None,
            drawn_step: None,
            playback: None,
            fixtures: Vec::new(),
            machine: None,
            path: Vec::new(),
            program: None,
            tools: Vec::new(),
            sections: Vec::new(),
            findings: Vec::new(),
            inches: false,
        }
    }
}

/// The answer of the run.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct ReportVerdict {
    /// The outcome.
    pub outcome: Judgement,
    /// One sentence that gives the reason, without a full stop.
    pub headline: String,
    /// Subjects of the outcome, and inputs that nobody gave: sentences without a full stop.
    pub scope: Vec<String>,
    /// The whole verdict in a line: outcome with counts, reason, scope.
    pub sentence: String,
    /// The few numbers that a shop person wants first.
    pub facts: Vec<Fact>,
    /// Claims proven, each with the bound below which something can have been missed.
    pub proven: Vec<String>,
    /// Findings, in words.
    pub found: Vec<String>,
    /// Items that nobody checked.
    pub not_checked: Vec<Unchecked>,
    /// What a person has to make sure of before the run.
    pub to_ensure: Vec<ToEnsure>,
    /// SHA-256 of the program's bytes, hexadecimal; may be empty.
    pub sha256: String,
}

impl ReportVerdict {
    /// A verdict with its reason and empty lists.
    pub fn new(outcome: Judgement, headline: impl Into<String>) -> ReportVerdict {
        let headline = headline.into();
        ReportVerdict {
            outcome,
            sentence: format!("{outcome}. {headline}."),
            headline,
            scope: Vec::new(),
            facts: Vec::new(),
            proven: Vec::new(),
            found: Vec::new(),
            not_checked: Vec::new(),
            to_ensure: Vec::new(),
            sha256: String::new(),
        }
    }
}

/// The cut part as a mesh, with its deviation from the wanted surface.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct PartView {
    /// Vertices [mm].
    pub vertices: Vec<[f32; 3]>,
    /// Triangles, counter-clockwise seen from outside. A triangle with an index beyond the vertices is not shown.
    pub triangles: Vec<[u32; 3]>,
    /// Deviation at each vertex [mm]: positive where stock is left, negative where the wanted surface is gouged,
    /// NaN (`null` in JSON) where there is nothing to compare with. Empty: nothing was compared.
    #[serde(with = "serde_gap::numbers")]
    pub deviation: Vec<f32>,
    /// Allowed deviation to both sides [mm].
    pub tolerance: f32,
    /// Whether surfaces have tolerances of their own: then `deviation` counts in tolerances, and `tolerance` is 1.
    #[serde(default)]
    pub relative: bool,
}

impl PartView {
    /// The view of a mesh; `deviation` as in the field.
    pub fn new(mesh: &Mesh, deviation: Vec<f32>, tolerance: f64) -> PartView {
        let vertices = || mesh.vertices.par_iter().map(|v| v.as_vec3().to_array()).collect();
        let (vertices, triangles) = rayon::join(vertices, || mesh.triangles.clone());
        let tolerance = tolerance as f32;
        PartView { vertices, triangles, deviation, tolerance, relative: false }
    }
}

/// A body as a mesh.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct BodyView {
    /// Its name.
    pub name: String,
    /// Vertices [mm].
    pub vertices: Vec<[f32; 3]>,
    /// Triangles, counter-clockwise seen from outside.
    pub triangles: Vec<[u32; 3]>,
}

impl BodyView {
    /// The view of faces.
    pub(super) fn new(name: &str, facets: &Facets) -> BodyView {
        let fan = |face: &Vec<u32>| {
            let pairs = face.windows(2).skip(1);
            pairs.map(|pair| [face[0], pair[0], pair[1]]).collect::<Vec<_>>()
        };
        BodyView {
            name: name.to_owned(),
            vertices: facets.corners.iter().map(|c| c.as_vec3().to_array()).collect(),
            triangles: facets.faces.iter().flat_map(fan).collect(),
        }
    }
}

/// A body of a clamp or fixture.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct FixtureView {
    /// Lines of the programs in which it is there: from the first to before the last.
    pub lines: [u32; 2],
    /// The body, in part coordinates.
    pub body: BodyView,
}

/// A machine with bodies: their places follow from [`PathPiece::joints`].
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct MachineView {
    /// Joints from the work to the tool.
    pub joints: Vec<JointView>,
    /// Number of joints before the bed: those carry the work.
    pub bed: usize,
    /// Place of the part in each setup.
    pub setups: Vec<MachineSetup>,
    /// Bodies at home in the frame of the machine, each with the joint that moves its link; of the bed none.
    pub bodies: Vec<(Option<usize>, BodyView)>,
}

/// A joint of a machine.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct JointView {
    /// It turns about an axis; else it moves along a direction.
    pub rotary: bool,
    /// Direction for values that grow, unit.
    pub direction: [f64; 3],
    /// A point of the axis [mm].
    pub point: [f64; 3],
}

/// Place of the part on a machine.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct MachineSetup {
    /// Lines of the programs: from the first to before the last.
    pub lines: [u32; 2],
    /// Part coordinates in the frame of the machine at home: columns of the rotation, then the translation [mm].
    pub part: [f64; 12],
}

/// The program text.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct ProgramView {
    /// File name.
    pub file: String,
    /// Name of the control.
    pub control: String,
    /// Lines without their ends; of several programs one after the other.
    pub lines: Vec<String>,
    /// The programs of several setups, in their order: each with its own line numbers. Empty: it is one program.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub parts: Vec<ProgramPart>,
    /// Time of each line [s]; may be shorter than `lines`.
    pub time: Vec<f32>,
    /// Length of the path of each line [mm]; may be shorter than `lines`.
    pub length: Vec<f32>,
}

/// One program of several that are shown together.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct ProgramPart {
    /// File name.
    pub file: String,
    /// Its first line among those of all programs, from 0.
    pub first: u32,
}

impl ProgramView {
    /// The programs, each with its file, its first line and the line after its last one among those of all.
    pub(super) fn programs(&self) -> Vec<(&str, usize, usize)> {
        if self.parts.is_empty() {
            return vec![(&self.file, 0, self.lines.len())];
        }
        let all = self.lines.len();
        let starts = self.parts.iter().map(|p| (p.first as usize).min(all));
        let ends = starts.clone().skip(1).chain([all]);
        let files = self.parts.iter().map(|p| p.file.as_str());
        files.zip(starts.zip(ends)).map(|(file, (from, to))| (file, from, to.max(from))).collect()
    }

    /// Name of a line among those of all programs: its number in its own program, with the file if there are several.
    pub(super) fn line_name(&self, line: u32) -> String {
        let all = self.programs();
        let own = all.iter().rfind(|(_, from, _)| *from <= line as usize);
        match own {
            Some((file, from, _)) if all.len() > 1 => format!("{file} line {}", line as usize - from + 1),
            _ => format!("line {}", line + 1),
        }
    }
}

/// One tool.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct ToolView {
    /// Number in the program.
    pub number: u32,
    /// Name or type.
    pub name: String,
    /// Diameter [mm].
    pub diameter: f64,
    /// Corner radius [mm].
    pub corner: f64,
    /// Cutting length [mm].
    pub flute_length: f64,
    /// Length out of the holder [mm], if known.
    pub stickout: Option<f64>,
    /// Teeth; 0 when unknown.
    pub teeth: u32,
    /// Time at feed [s].
    pub time: f64,
    /// Length of path at feed [mm].
    pub length: f64,
    /// Remarks ("no holder given").
    pub note: String,
    /// Half outline (radius, height above the tip) from the tip upwards [mm], holder included; empty: a cylinder
    /// with the numbers above.
    pub outline: Vec<[f32; 2]>,
}

impl ToolView {
    /// A tool with its main dimensions [mm].
    pub fn new(number: u32, name: impl Into<String>, diameter: f64, flute_length: f64) -> ToolView {
        ToolView {
            number,
            name: name.into(),
            diameter,
            corner: 0.0,
            flute_length,
            stickout: None,
            teeth: 0,
            time: 0.0,
            length: 0.0,
            note: String::new(),
            outline: Vec::new(),
        }
    }

    /// The outline to draw: the given one, or a cylinder.
    pub(super) fn drawn_outline(&self) -> Vec<[f32; 2]> {
        if self.outline.len() > 1 {
            return self.outline.clone();
        }
        let r = (self.diameter / 2.0) as f32;
        let h = self.stickout.unwrap_or(self.flute_length).max(self.flute_length) as f32;
        vec![[0.0, 0.0], [r, 0.0], [r, h], [0.0, h]]
    }
}
