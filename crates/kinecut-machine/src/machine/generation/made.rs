//! A surface of the catalogue, one of its splits and a machine: can it, how, and how well.
//!
//! The machine's part of the split is the motion of the tool's frame, its part in the tool is the edge. The generated
//! surface, `forward(laws) * mount^-1 * edge`, is compared with the wanted surface by signed distances and by coverage.

use glam::DVec3;

use super::{
    Coverage, FeasibleOptions, FrameMotion, Hold, MachineMotion, Obstacle, ParametricSurface, Residual,
    SurfaceMap, Task, TaskMotion, Touched, VariableLaw, can_make, coverage, residual,
};
use crate::base::{Progress, Quantity, Result};
use crate::geom::Rigid;
use crate::machine::Machine;
use crate::machine::surface::{GeneratedSurface, ShapeFunction, Split, ToolKind};

impl FrameMotion for ShapeFunction {
    fn pose(&self, u: [f64; 2]) -> Rigid {
        self.frame(u[0], u[1])
    }
}

impl SurfaceMap for ShapeFunction {
    fn point(&self, u: f64, v: f64) -> DVec3 {
        ShapeFunction::point(self, u, v)
    }
}

/// Answer of a machine to a split of a surface.
#[derive(Clone, Debug, PartialEq)]
pub struct Made {
    /// The way, or the obstacle.
    pub outcome: std::result::Result<TaskMotion, Obstacle>,
    /// The part of the tool's frame that mattered.
    pub hold: Hold,
    /// Deviation of the generated surface from the wanted one; `None` without a way.
    pub residual: Option<Residual>,
    /// The reached part of the wanted surface; `None` without a way.
    pub coverage: Option<Coverage>,
    /// Points that are generated, for the budget of errors; empty without a way.
    pub touched: Vec<Touched>,
}

impl Made {
    /// The answer in words, one statement a line: the laws of the joints and what is left, or what is in the way.
    pub fn lines(&self, surface: &GeneratedSurface, machine: &Machine) -> Vec<String> {
        let names = [0, 1].map(|k| surface.variables[k].name.clone());
        match &self.outcome {
            Ok(way) => {
                let mut lines = way.lines();
                if let Some(left) = &self.residual {
                    // No negative zero.
                    let um = |mm: f64| Quantity::new((mm * 1e9).round() / 1e6 + 0.0, "um");
                    lines.push(format!(
                        "made to {} .. {} of the surface, root of the mean square {}",
                        um(left.least.distance),
                        um(left.greatest.distance),
                        um(left.rms)
                    ));
                }
                lines
            }
            Err(obstacle) => vec![obstacle.finding(machine, self.hold, &names).to_string()],
        }
    }
}

/// The part of a tool's frame that matters for a split: of a point only its tip, of an edge or a die all.
pub fn hold_of(kind: ToolKind) -> Hold {
    if kind == ToolKind::Point { Hold::Point } else { Hold::Frame }
}

/// Asks a machine for a split of a surface, with the tool mounted as the chain says (`mount` is the identity) or
/// otherwise, and compares what it generates with the surface.
///
/// ```
/// # use kinecut_machine as kinecut;
/// use kinecut::base::Silent;
/// use kinecut::geom::Rigid;
/// use kinecut::machine::generation::{make_split, FeasibleOptions};
/// use kinecut::machine::surface::GeneratedSurface;
/// use kinecut::machine::{CoordinateCode, Machine};
/// let cone = GeneratedSurface::named("cone").unwrap();
/// let splits = cone.splits().unwrap();
/// let lathe = Machine::of_code(CoordinateCode::parse("6031").unwrap());
/// let options = FeasibleOptions::default();
/// let made = make_split(&cone, &splits[0], &lathe, Rigid::IDENTITY, &options, &Silent).unwrap();
/// assert!(made.outcome.is_ok());
/// assert!(made.residual.unwrap().worst().distance.abs() < 1e-9);
/// ```
///
/// # Errors
/// Those of [`can_make`], [`residual()`] and [`ShapeFunction::new`].
pub fn make_split(
    surface: &GeneratedSurface,
    split: &Split,
    machine: &Machine,
    mount: Rigid,
    options: &FeasibleOptions,
    progress: &dyn Progress,
) -> Result<Made> {
    let Some(kind) = split.tool_kind else {
        let reason =
            split.remarks.first().cloned().unwrap_or_else(|| "machine and tool share a variable".to_owned());
        let outcome = Err(Obstacle::NotRigid { reason });
        return Ok(Made { outcome, hold: Hold::Frame, residual: None, coverage: None, touched: Vec::new() });
    };
    let hold = hold_of(kind);
    let motion = ShapeFunction::new(surface, &split.machine)?;
    let edge = ShapeFunction::new(surface, &split.tool)?;
    let whole = [0, 1].map(|k| [surface.variables[k].from, surface.variables[k].to]);
    // A variable of the tool does not move the machine.
    let moved = [0, 1].map(|k| {
        let moves = split.machine_variables.iter().any(|name| *name == surface.variables[k].name);
        if moves { whole[k] } else { [whole[k][0]; 2] }
    });
    let names = [0, 1].map(|k| surface.variables[k].name.as_str());
    let [u, v] = &surface.variables;
    // Of a point tool only the point counts, wherever in its frame that is.
    let control = match hold {
        Hold::Point => mount.inverse().point(edge.point(u.from, v.from)),
        Hold::Axis | Hold::Frame => DVec3::ZERO,
    };
    let task = Task { mount, control, ..Task::new(&motion, moved, names, hold) };
    let outcome = can_make(machine, &task, options, progress)?;
    let mut made = Made { outcome, hold, residual: None, coverage: None, touched: Vec::new() };
    if let Ok(way) = &made.outcome {
        let motion = MachineMotion::new(way, machine, options.tool_length, mount);
        let generated = Generated { motion, edge: &edge };
        // Between the nodes of a sampled law too, where its cubics are at their worst.
        let sampled = way.laws.iter().any(|l| l.law == VariableLaw::Sampled);
        let cells = options.cells.map(|n| if sampled { 2 * n } else { n });
        made.residual = Some(compare(surface, &generated, whole, cells, progress)?);
        made.coverage = Some(reached(surface, &generated, whole, options, progress)?);
        made.touched = touched(surface, way, whole)?;
    }
    Ok(made)
}

/// The part of a surface that comes out within the tolerance.
fn reached<S: SurfaceMap>(
    surface: &GeneratedSurface,
    made: &S,
    domain: [[f64; 2]; 2],
    options: &FeasibleOptions,
    progress: &dyn Progress,
) -> Result<Coverage> {
    let shape = surface.compiled()?;
    let patch = ParametricSurface::new(|u: f64, v: f64| made.point(u, v), domain, WANTED_CELLS, false)?;
    let reach = |p: DVec3| patch.foot(p).1.distance(p);
    coverage(&shape, domain, options.cells, [false; 2], reach, options.tolerance, progress)
}

/// Places of the surface with the positions of the joints there.
fn touched(surface: &GeneratedSurface, way: &TaskMotion, domain: [[f64; 2]; 2]) -> Result<Vec<Touched>> {
    let shape = surface.compiled()?;
    let at = |k: usize, i: usize| {
        let share = i as f64 / (TOUCHED - 1) as f64;
        domain[k][0] * (1.0 - share) + domain[k][1] * share
    };
    let all = (0..TOUCHED).flat_map(|i| (0..TOUCHED).map(move |j| (i, j)));
    let place = |(i, j): (usize, usize)| {
        let [u, v] = [at(0, i), at(1, j)];
        let normal = shape.normal(u, v)?;
        Some(Touched { joints: way.positions_at([u, v]), point: shape.point(u, v), normal })
    };
    Ok(all.filter_map(place).collect())
}

/// Surface that a machine generates with an edge by the laws of a way.
struct Generated<'a> {
    motion: MachineMotion<'a>,
    edge: &'a ShapeFunction,
}

impl SurfaceMap for Generated<'_> {
    fn point(&self, u: f64, v: f64) -> DVec3 {
        self.motion.pose([u, v]).point(self.edge.point(u, v))
    }
}

/// Compares generated points with the surface, whose domain reaches beyond where its laws allow.
fn compare<S: SurfaceMap>(
    surface: &GeneratedSurface,
    made: &S,
    domain: [[f64; 2]; 2],
    cells: [usize; 2],
    progress: &dyn Progress,
) -> Result<Residual> {
    let shape = surface.compiled()?;
    let beyond = domain.map(|[from, to]| [from - MARGIN * (to - from), to + MARGIN * (to - from)]);
    let wanted = ParametricSurface::new(shape.clone(), beyond, WANTED_CELLS, surface.inward)
        .or_else(|_| ParametricSurface::new(shape, domain, WANTED_CELLS, surface.inward))?;
    residual(made, domain, cells, &wanted, progress)
}

/// Share of its range by which the wanted surface is continued, so that no foot is on its border.
const MARGIN: f64 = 0.02;
/// Cells of the wanted surface.
const WANTED_CELLS: [usize; 2] = [48, 16];
/// Places of each variable for the budget of errors.
const TOUCHED: usize = 11;
