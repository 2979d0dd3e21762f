//! A machine as bodies that a program can draw and move: flat faces, and the motion of each link.

use serde::Serialize;

use crate::base::{Finding, Result};
use crate::geom::Rigid;
use crate::job::machine::write::link_name;
use crate::machine::layouts::Attitude;
use crate::machine::{Link, Machine};
use crate::page::draw::Facets;
use crate::verbs::fk::forward;
use crate::verbs::layouts::show::{CUTTER, PART, side, usual, usual_sizes};
use crate::verbs::poses::{AxisValues, PoseWords};

/// Numbers after the point of a corner [mm]: far below what can be seen.
const CORNER: f64 = 1e4;

/// A body with its faces.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct DrawnBody {
    /// Its name; may be empty.
    pub name: String,
    /// The link that carries it: "bed", or an axis.
    pub link: String,
    /// "part", "cutter"; or, of a link, "bed", "work", "tool".
    pub role: &'static str,
    /// Corners with all axes at zero, in the frame of the machine [mm].
    pub corners: Vec<[f64; 3]>,
    /// Corners of each face, counter-clockwise from outside.
    pub faces: Vec<Vec<u32>>,
}

/// The bodies of a machine.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Drawn {
    /// Whether they are the usual ones of its code, because it has none of its own.
    pub usual: bool,
    /// The direction that is up in the workshop.
    pub up: [f64; 3],
    /// The bodies.
    pub bodies: Vec<DrawnBody>,
}

/// Motion of a link from home.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct LinkMotion {
    /// "bed", or an axis.
    pub link: String,
    /// Three rows of a matrix: rotation, and shift [mm]; in the frame of the machine.
    pub matrix: [[f64; 4]; 3],
}

/// A machine at positions of its axes.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct MachinePose {
    /// The positions [mm or deg].
    pub joints: AxisValues,
    /// The tip in the frame of the table, as `kinecut fk` says it [mm].
    pub tip: [f64; 3],
    /// Direction of the tool, from tip to holder.
    pub axis: [f64; 3],
    /// Motions of the links of the bodies that are drawn; usual bodies turn about their own middles.
    pub links: Vec<LinkMotion>,
    /// Axes outside their travel.
    pub findings: Vec<Finding>,
}

/// A machine with the bodies that are drawn, and whether they are usual ones.
fn with_bodies(machine: &Machine, attitude: Attitude) -> (Machine, bool) {
    match machine.bodies.is_empty() {
        true => (usual(machine, attitude, &usual_sizes(machine)).0, true),
        false => (machine.clone(), false),
    }
}

/// The bodies of a machine, or the usual ones.
pub fn drawn(machine: &Machine, attitude: Attitude) -> Drawn {
    let (machine, usual) = with_bodies(machine, attitude);
    let round = |v: f64| (v * CORNER).round() / CORNER;
    let body = |body: &crate::machine::Body| {
        let facets = Facets::of(&body.solid, &body.place);
        let role = match body.name.as_str() {
            PART if usual => PART,
            CUTTER if usual => CUTTER,
            _ => side(&machine, body.link),
        };
        DrawnBody {
            name: body.name.clone(),
            link: link_name(&machine, body.link),
            role,
            corners: facets.corners.iter().map(|c| c.to_array().map(round)).collect(),
            faces: facets.faces,
        }
    };
    let up = match attitude {
        Attitude::Vertical => [0.0, 0.0, 1.0],
        Attitude::Horizontal => [0.0, 1.0, 0.0],
    };
    Drawn { usual, up, bodies: machine.bodies.iter().map(body).collect() }
}

/// A machine at positions of its axes, with a tool of a length from the gauge point [mm].
///
/// # Errors
/// Those of [`forward`].
pub fn pose(machine: &Machine, attitude: Attitude, words: &PoseWords, length: f64) -> Result<MachinePose> {
    let told = forward(machine, words, length)?;
    let q = told.joints.joints(machine)?;
    let (shown, _) = with_bodies(machine, attitude);
    let motion =
        |link: Link| LinkMotion { link: link_name(&shown, link), matrix: rows(&shown.link(link, &q)) };
    let links = (0..shown.joints.len()).map(Link::Axis);
    Ok(MachinePose {
        joints: told.joints,
        tip: told.tip,
        axis: told.axis,
        links: std::iter::once(Link::Bed).chain(links).map(motion).collect(),
        findings: told.findings,
    })
}

/// The rows of a rigid motion.
pub(crate) fn rows(motion: &Rigid) -> [[f64; 4]; 3] {
    let (r, t) = (motion.rotation, motion.translation);
    // Without negative zeros.
    [0, 1, 2].map(|i| [r.x_axis[i], r.y_axis[i], r.z_axis[i], t[i]].map(|v| v + 0.0))
}
