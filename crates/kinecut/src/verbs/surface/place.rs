//! A place on a surface in numbers, and the sketches as points: what a program needs to draw them.

use serde::Serialize;

use super::SurfaceSheet;
use super::sketches::{MESH, mesh, sketch, value};
use super::split::{MotionRole, SketchTool};
use crate::base::{Code, Finding, Result};
use crate::geom::Rigid;
use crate::machine::formula::Expression;
use crate::machine::surface::GeneratedSurface;
use crate::verbs::machine::rows;

/// Points of a line through the place.
const LINE: usize = 65;

/// A line of the surface through a place.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct LineThrough {
    /// The variable that runs along it.
    pub variable: String,
    /// "directrix" or "generatrix": the chain that the variable is in; "both" where it is in both.
    pub line: &'static str,
    /// Its points [mm].
    pub points: Vec<[f64; 3]>,
}

/// A motion of the chain at a place.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct MotionAt {
    /// Digit of the code.
    pub digit: u8,
    /// The law as text.
    pub law: String,
    /// Its value [mm or rad].
    pub value: f64,
    /// Whether a variable is in it: it moves while the surface is made.
    pub forming: bool,
    /// Three rows of its matrix.
    pub matrix: [[f64; 4]; 3],
}

/// A place on a surface.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct SurfacePlace {
    /// Variables with their values [mm or rad].
    pub variables: Vec<(String, f64)>,
    /// The point [mm].
    pub point: [f64; 3],
    /// Unit normal out of the material; none where the surface has none.
    pub normal: Option<[f64; 3]>,
    /// The motions of the chain.
    pub motions: Vec<MotionAt>,
    /// The two lines through it.
    pub lines: Vec<LineThrough>,
}

/// A sketch of a redistribution as points.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct SketchPoints {
    /// Code of the machine's part.
    pub machine_code: String,
    /// Code of the tool's part.
    pub tool_code: String,
    /// "point", "edge", "surface".
    pub tool: &'static str,
    /// Points of the tool: one, those of the edge, or none for the surface, which is the mesh.
    pub points: Vec<[f64; 3]>,
    /// Motions of the machine.
    pub motions: Vec<MotionPoints>,
}

/// A motion of a sketch.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct MotionPoints {
    /// Its name.
    pub name: String,
    /// "forming", "linked", "setting", "set-up".
    pub role: &'static str,
    /// Direction of the translation, or of the axis of the rotation.
    pub direction: [f64; 3],
    /// A point of the axis of a rotation [mm]; none for a translation.
    pub axis_point: Option<[f64; 3]>,
}

/// A surface and its redistributions as points.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct SurfaceSketch {
    /// Values of the two variables at the lines of the mesh [mm or rad].
    pub at: [Vec<f64>; 2],
    /// Points of the surface: a row for each value of the first variable [mm].
    pub mesh: Vec<Vec<[f64; 3]>>,
    /// The sketches of the redistributions with a rigid tool.
    pub splits: Vec<SketchPoints>,
}

/// Values of the variables of a place: those given, the others in the middle of their domains.
///
/// # Errors
/// `KC1102` for a name that is no variable; `KC1101`, `KC0103` for an invalid value or one outside its domain.
pub fn place_of(surface: &GeneratedSurface, given: &[(String, String)]) -> Result<[f64; 2]> {
    let mut at = surface.variables.each_ref().map(|v| v.middle());
    for (name, text) in given {
        let Some(i) = surface.variables.iter().position(|v| v.name == *name) else {
            let known = surface.variables.each_ref().map(|v| v.name.as_str()).join(", ");
            let what = format!("surface `{}` has no variable `{name}`", surface.name);
            let finding = Finding::error(Code::EXPRESSION_NAME, what).key(name.clone());
            return Err(finding.help(format!("its variables are {known}")).into());
        };
        let number = || Expression::parse(text)?.bind(&[]).map(|law| law.value(&[]));
        let value = number().map_err(|mut e| {
            e.0.key = Some(name.clone());
            e
        })?;
        let variable = &surface.variables[i];
        // NaN is in no domain.
        let bound = if value < variable.from { variable.from } else { variable.to };
        if !(variable.from..=variable.to).contains(&value) {
            let what = format!("`{name}` is outside its domain, {} to {}", variable.from, variable.to);
            let finding = Finding::error(Code::JOB_VALUE, what).value(value, "").bound(bound, "");
            return Err(finding.help("give a value of the domain").key(name.clone()).into());
        }
        at[i] = value;
    }
    Ok(at)
}

impl SurfacePlace {
    /// A place of a surface.
    ///
    /// # Errors
    /// `KC1102` for a name in a law that is neither a parameter nor a variable.
    pub fn of(sheet: &SurfaceSheet, at: [f64; 2]) -> Result<SurfacePlace> {
        let surface = &sheet.surface;
        let shape = surface.compiled()?;
        let motion = |element: &crate::machine::surface::ChainElement| {
            let value = value(surface, element, at)?;
            let motion: Rigid = element.motion.motion(value, surface.direction(element.motion));
            Ok(MotionAt {
                digit: element.motion.digit(),
                law: element.law.to_string(),
                value,
                forming: surface.is_forming(element),
                matrix: rows(&motion),
            })
        };
        let line = |i: usize| {
            let variable = &surface.variables[i];
            let [d, g] = [&surface.directrix, &surface.generatrix]
                .map(|chain| chain.iter().any(|element| element.has(&variable.name)));
            let point = |k: usize| {
                let mut at = at;
                at[i] = variable.at(k as f64 / (LINE - 1) as f64);
                shape.point(at[0], at[1]).to_array()
            };
            LineThrough {
                variable: variable.name.clone(),
                line: if d && g {
                    "both"
                } else if d {
                    "directrix"
                } else {
                    "generatrix"
                },
                points: (0..LINE).map(point).collect(),
            }
        };
        Ok(SurfacePlace {
            variables: surface.variables.iter().map(|v| v.name.clone()).zip(at).collect(),
            point: shape.point(at[0], at[1]).to_array(),
            normal: shape.normal(at[0], at[1]).map(|n| n.to_array()),
            motions: surface.chain().iter().map(motion).collect::<Result<_>>()?,
            lines: vec![line(0), line(1)],
        })
    }
}

impl SurfaceSketch {
    /// The sketches of a surface at a place.
    ///
    /// # Errors
    /// `KC1102` for a name in a law that is neither a parameter nor a variable.
    pub fn of(sheet: &SurfaceSheet, at: [f64; 2]) -> Result<SurfaceSketch> {
        let surface = &sheet.surface;
        let shape = surface.compiled()?;
        let one = |split: &crate::machine::surface::Split| {
            let made = sketch(surface, &shape, split, at)?;
            let (tool, points) = match made.tool {
                SketchTool::None => ("none", Vec::new()),
                SketchTool::Point(p) => ("point", vec![p]),
                SketchTool::Edge(points) => ("edge", points),
                SketchTool::Patch(_) => ("surface", Vec::new()),
            };
            let motions = made.motions.into_iter().map(|m| MotionPoints {
                name: m.name,
                role: match m.role {
                    MotionRole::Forming => "forming",
                    MotionRole::Linked => "linked",
                    MotionRole::Setting => "setting",
                    MotionRole::SetUp => "set-up",
                },
                direction: m.direction,
                axis_point: m.axis_point,
            });
            Ok(SketchPoints {
                machine_code: split.machine_code().to_string(),
                tool_code: split.tool_code().to_string(),
                tool,
                points,
                motions: motions.collect(),
            })
        };
        let values = |i: usize| {
            let v = &surface.variables[i];
            (0..MESH).map(|k| v.at(k as f64 / (MESH - 1) as f64)).collect()
        };
        let valid = sheet.found.iter().filter(|split| split.is_valid());
        Ok(SurfaceSketch {
            at: [values(0), values(1)],
            mesh: mesh(surface, &shape, MESH),
            splits: valid.map(one).collect::<Result<_>>()?,
        })
    }
}
