//! Sketches of the redistributions of a surface: its mesh, the tool, the motions of the machine with arrows.
//!
//! Everything is drawn at one moment, in the middle of the domain: an element of the chain moves along or about its
//! direction in the frame of the elements before it.

use glam::DVec3;

use super::SurfaceSheet;
use super::split::{MotionRole, SketchMotion, SketchTool, SplitSketch, split_sheet};
use crate::base::Result;
use crate::geom::Rigid;
use crate::machine::surface::{
    ChainElement, GeneratedSurface, Retreat, ShapeFunction, Slide, Source, Split, ToolKind,
};

/// Lines of the mesh along each variable.
const LINES: usize = 17;
/// Lines of the mesh along each variable in numbers: closer, because places are found on it.
pub(super) const MESH: usize = 33;
/// Points of an edge.
const EDGE: usize = 49;

/// The sketches of all redistributions with a rigid tool.
///
/// # Errors
/// `KC1102` for a name in a law that is neither a parameter nor a variable.
pub fn split_sketches(sheet: &SurfaceSheet) -> Result<Vec<SplitSketch>> {
    let at = sheet.surface.variables.each_ref().map(|v| v.middle());
    split_sketches_at(sheet, at)
}

/// The same at other values of the variables.
fn split_sketches_at(sheet: &SurfaceSheet, at: [f64; 2]) -> Result<Vec<SplitSketch>> {
    let shape = sheet.surface.compiled()?;
    let valid = sheet.found.iter().filter(|split| split.is_valid());
    valid.map(|split| sketch(&sheet.surface, &shape, split, at)).collect()
}

/// The sketches on one sheet, as an SVG file, at values of the variables or in the middle of their domains.
///
/// # Errors
/// As [`split_sketches`].
pub fn surface_drawing(sheet: &SurfaceSheet, at: Option<[f64; 2]>) -> Result<String> {
    let sketches = at.map_or_else(|| split_sketches(sheet), |at| split_sketches_at(sheet, at))?;
    let columns = if sketches.len() > 4 { 3 } else { 2 };
    let title = format!("{} {}", sheet.name, sheet.code);
    Ok(split_sheet(&title, &sketches, columns))
}

fn step(i: usize, n: usize) -> f64 {
    i as f64 / (n - 1) as f64
}

/// Points of a surface over its domain: `n` rows for values of the first variable.
pub(super) fn mesh(surface: &GeneratedSurface, shape: &ShapeFunction, n: usize) -> Vec<Vec<[f64; 3]>> {
    let [u, v] = &surface.variables;
    let row = |i: usize| (0..n).map(|j| shape.point(u.at(step(i, n)), v.at(step(j, n))).to_array()).collect();
    (0..n).map(row).collect()
}

/// The sketch of a redistribution at values of the two variables.
pub(super) fn sketch(
    surface: &GeneratedSurface,
    shape: &ShapeFunction,
    split: &Split,
    [a, b]: [f64; 2],
) -> Result<SplitSketch> {
    let [u, v] = &surface.variables;
    let point = |a: f64, b: f64| shape.point(a, b).to_array();
    let tool = match split.tool_kind {
        None => SketchTool::None,
        Some(ToolKind::Point) => SketchTool::Point(point(a, b)),
        Some(ToolKind::Surface) => SketchTool::Patch(mesh(surface, shape, LINES)),
        Some(_) => {
            let first = split.tool_variables.contains(&u.name);
            let along = |i: usize| {
                let s = step(i, EDGE);
                if first { point(u.at(s), b) } else { point(a, v.at(s)) }
            };
            SketchTool::Edge((0..EDGE).map(along).collect())
        }
    };
    let mut motions = Vec::new();
    let mut frame = Rigid::IDENTITY;
    let chosen = split.setup.chosen.as_ref().filter(|_| split.setup.needed);
    for element in &split.machine {
        let direction = surface.direction(element.motion);
        let role = if !surface.is_forming(element) {
            MotionRole::Setting
        } else if split.links.iter().any(|link| link.elements.contains(element)) {
            MotionRole::Linked
        } else {
            MotionRole::Forming
        };
        let named = |name: String, role| SketchMotion {
            name,
            direction: frame.vector(direction).to_array(),
            axis_point: element.motion.is_rotation().then(|| frame.translation.to_array()),
            role,
        };
        motions.push(named(format!("{} {}", element.motion.iso(), element.law.unicode()), role));
        if let Some(candidate) = chosen
            && candidate.source == Source::SettingLink
            && let Retreat::Link { motion, forward } = candidate.retreat
            && motion == element.motion
            && role == MotionRole::Setting
        {
            let mut retreat =
                named(format!("{} {}", candidate.retreat, candidate.verdict.name()), MotionRole::SetUp);
            if !forward {
                retreat.direction = (-DVec3::from_array(retreat.direction)).to_array();
            }
            motions.push(retreat);
        }
        frame = frame.after(&element.motion.motion(value(surface, element, [a, b])?, direction));
    }
    if let Some(candidate) = chosen
        && candidate.source != Source::SettingLink
    {
        let name = format!("{} {}", candidate.retreat, candidate.verdict.name());
        let (direction, axis_point) = match candidate.retreat {
            Retreat::Link { motion, forward } => {
                let along = frame.vector(surface.direction(motion));
                (if forward { along } else { -along }, motion.is_rotation().then_some(frame.translation))
            }
            Retreat::Slide(Slide::Shift { direction }) => (direction, None),
            Retreat::Slide(Slide::Turn { axis, point, .. }) => (axis, Some(point)),
        };
        motions.push(SketchMotion {
            name,
            direction: direction.to_array(),
            axis_point: axis_point.map(|p| p.to_array()),
            role: MotionRole::SetUp,
        });
    }
    let part = |code: String| if code.is_empty() { "none".to_owned() } else { code };
    Ok(SplitSketch {
        title: format!(
            "machine {} | tool {}",
            part(split.machine_code().to_string()),
            part(split.tool_code().to_string())
        ),
        // The words in brackets are in the table; a cell of the sheet has no room for them.
        about: split.process.split(" (").next().unwrap_or_default().to_owned(),
        surface: mesh(surface, shape, LINES),
        tool,
        motions,
    })
}

/// The value of an element's law [mm or rad].
pub(super) fn value(surface: &GeneratedSurface, element: &ChainElement, at: [f64; 2]) -> Result<f64> {
    let names = surface.variables.each_ref().map(|v| v.name.as_str());
    Ok(surface.with_numbers(&element.law).bind(&names)?.value(&at))
}
