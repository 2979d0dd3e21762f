//! A surface that a machine makes by touching or rolling: can it, how, and how well.
//!
//! The machine is asked for the motion of the tool's frame; of a ball only the centre matters, of a body of revolution the
//! axis. By the laws of its joints the tool is then moved, and each point of the wanted surface keeps its least distance
//! from the tool: positive is stock that stays, negative a gouge.

use glam::DVec3;
use rayon::prelude::*;

use super::touch::{Stand, Touch};
use super::{
    Coverage, FeasibleOptions, FrameMotion, Hold, Left, MachineMotion, Obstacle, ParametricSurface, Task,
    TaskMotion, ToolEnvelope as Swept, can_make, coverage,
};
use crate::base::{Code, Finding, Progress, Result};
use crate::geom::Rigid;
use crate::machine::surface::{EnvelopeMethod, GeneratedSurface, Makes};
use crate::machine::{JointValues, Machine};

/// Deviation of a surface that a tool leaves by touching or rolling from the wanted one.
#[derive(Clone, Debug, PartialEq)]
pub struct LeftByTool {
    /// The least residual [mm]: negative is a gouge.
    pub least: f64,
    /// The greatest residual [mm]: positive is stock that stays.
    pub greatest: f64,
    /// Root of the mean square [mm].
    pub rms: f64,
    /// The place where it is farthest off [mm].
    pub worst: DVec3,
    /// The part of the wanted surface that is reached within the tolerance.
    pub coverage: Coverage,
}

/// A point that is touched: positions of the joints, the point and the normal out of the work's material.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Touched {
    /// Positions of the joints [mm or rad].
    pub joints: JointValues,
    /// The point in the work [mm].
    pub point: DVec3,
    /// The normal there.
    pub normal: DVec3,
}

/// Answer of a machine to an envelope.
#[derive(Clone, Debug, PartialEq)]
pub struct Enveloped {
    /// The way, or the obstacle.
    pub outcome: std::result::Result<TaskMotion, Obstacle>,
    /// The part of the tool's frame that matters.
    pub hold: Hold,
    /// The tool in words.
    pub tool: String,
    /// Names of the parameters of the motion.
    pub names: [String; 2],
    /// Mounting of the tool: maps the tip frame of the machine into the tool's frame of the envelope.
    pub mount: Rigid,
    /// Deviation from the wanted surface, or the reason why it is not known; `None` without a way.
    pub left: Option<std::result::Result<LeftByTool, Finding>>,
    /// Points of contact, for the budget of errors.
    pub contacts: Vec<Touched>,
}

/// Asks a machine for an envelope of a surface, and compares what the tool leaves with the surface.
///
/// ```
/// # use kinecut_machine as kinecut;
/// use kinecut::base::Silent;
/// use kinecut::machine::generation::{envelope_surface, FeasibleOptions};
/// use kinecut::machine::surface::{envelopes, GeneratedSurface};
/// use kinecut::machine::{CoordinateCode, Machine};
/// // Cylindrical grinding on a machine with C, X and Z: the wheel leaves nothing and takes nothing too much.
/// let shaft = GeneratedSurface::named("cylinder").unwrap();
/// let grinding = envelopes("cylinder").next().unwrap();
/// let grinder = Machine::of_code(CoordinateCode::parse("6031").unwrap());
/// let options = FeasibleOptions::default();
/// let made = envelope_surface(&shaft, grinding, &grinder, &options, &Silent).unwrap();
/// let left = made.left.unwrap().unwrap();
/// assert!(left.least > -1e-9 && left.greatest < 1e-9 && left.coverage.share == 1.0);
/// ```
///
/// # Errors
/// Those of [`can_make`] and of the chains; `KC0009` when cancelled.
pub fn envelope_surface(
    surface: &GeneratedSurface,
    envelope: &EnvelopeMethod,
    machine: &Machine,
    options: &FeasibleOptions,
    progress: &dyn Progress,
) -> Result<Enveloped> {
    let touch = Touch::new(surface, envelope)?;
    let names = touch.names.each_ref().map(String::as_str);
    let (hold, mounts, control) = match &touch.stand {
        Stand::Centre(centre) => (Hold::Point, vec![Rigid::IDENTITY], *centre),
        Stand::Axis(mounts) => (Hold::Axis, mounts.to_vec(), DVec3::ZERO),
        Stand::Frame => {
            // Mounted as in the chain, or so that the machine begins the motion with the directions that it has at
            // home.
            let wanted = touch.motion.frame(touch.domain[0][0], touch.domain[1][0]).rotation;
            let home = machine.kinematics(options.tool_length).forward(&[]).rotation;
            let turned = Rigid { rotation: wanted.transpose() * home, translation: DVec3::ZERO };
            (Hold::Frame, vec![Rigid::IDENTITY, turned], DVec3::ZERO)
        }
    };
    let mut found: Option<(std::result::Result<TaskMotion, Obstacle>, Rigid)> = None;
    for mount in mounts {
        let task = Task { mount, control, ..Task::new(&touch.motion, touch.domain, names, hold) };
        let outcome = can_make(machine, &task, options, progress)?;
        let done = outcome.is_ok();
        if done || found.is_none() {
            found = Some((outcome, mount));
        }
        if done {
            break;
        }
    }
    let Some((outcome, mount)) = found else {
        return Err(Finding::error(Code::GENERATION_INPUT, "the machine has no way to try").into());
    };
    let names = touch.names.clone();
    let tool = touch.what.clone();
    let mut made = Enveloped { outcome, hold, tool, names, mount, left: None, contacts: Vec::new() };
    let Ok(way) = &made.outcome else { return Ok(made) };
    if envelope.makes == Makes::Near {
        let why =
            "the profile of the tool is given, not derived from the surface: what it leaves is not compared";
        let help = "derive the profile of the tool from the surface, or use a split that is verified";
        made.left = Some(Err(Finding::warning(Code::GENERATION_INPUT, why).help(help)));
        return Ok(made);
    }
    let back = match hold {
        // The tip is the centre of the ball.
        Hold::Point => Rigid::from_translation(control),
        Hold::Axis | Hold::Frame => mount,
    };
    let motion = MachineMotion::new(way, machine, options.tool_length, back);
    let compared = Compare {
        surface,
        envelope,
        touch,
        motion,
        way,
        tolerance: options.tolerance,
        cells: options.cells,
        over: false,
    };
    let (compared, (left, contacts)) = compared.sided(progress)?;
    made.left = Some(left);
    made.contacts = contacts;
    if let (Some(Ok(left)), true) = (&made.left, compared.touch.open)
        && left.coverage.share < HARDLY
    {
        // A plane rolls on the convex side of a flank only: is it the other side that comes out?
        let worst = if left.greatest > -left.least { left.greatest } else { left.least };
        let (_, (other, _)) = Compare { over: true, ..compared }.sided(progress)?;
        if let Ok(other) = other
            && other.coverage.share > 1.0 - HARDLY
        {
            let why = "the tool makes the other side of the surface: with the material on this side it is off everywhere";
            let finding = Finding::warning(Code::GENERATION_RESIDUAL, why).value(worst * 1e3, "um");
            let help = "put the material on the other side (--reversed): there it is compared and reached";
            made.left = Some(Err(finding.bound(options.tolerance * 1e3, "um").help(help)));
        }
    }
    Ok(made)
}

/// A comparison.
struct Compare<'a> {
    surface: &'a GeneratedSurface,
    envelope: &'a EnvelopeMethod,
    touch: Touch,
    motion: MachineMotion<'a>,
    way: &'a TaskMotion,
    tolerance: f64,
    cells: [usize; 2],
    /// True if the material is on the other side than the surface says.
    over: bool,
}

type Answer = (std::result::Result<LeftByTool, Finding>, Vec<Touched>);
/// A wanted surface with its domain.
type Patch<'a> = (Box<dyn Fn(f64, f64) -> DVec3 + Sync + 'a>, [[f64; 2]; 2]);

impl Compare<'_> {
    /// Gives the tool its side, then compares.
    fn sided(mut self, progress: &dyn Progress) -> Result<(Self, Answer)> {
        if let Some(why) = self.face()? {
            return Ok((self, (Err(why), Vec::new())));
        }
        let answer = self.left(progress)?;
        Ok((self, answer))
    }

    /// Turns an open tool so that it faces the surface at a contact; tells why that is not possible.
    fn face(&mut self) -> Result<Option<Finding>> {
        if self.envelope.makes != Makes::Surface {
            return Ok(None);
        }
        let shape = self.surface.compiled()?;
        let middle = self.surface.variables.each_ref().map(crate::machine::surface::Variable::middle);
        let Some(normal) = shape.normal(middle[0], middle[1]) else {
            let why =
                "the surface has no normal in the middle of its domain: the side of the tool is not known";
            return Ok(Some(Finding::warning(Code::GENERATION_INPUT, why)));
        };
        let normal = if self.over { -normal } else { normal };
        let pose = self.touch.motion.pose(self.touch.at(middle));
        let q = pose.inverse().point(shape.point(middle[0], middle[1]));
        let facing = -pose.vector(self.touch.body.gradient(q)).dot(normal);
        if facing < 0.0 && self.touch.open {
            self.touch.turn_over();
        } else if facing < 0.0 {
            let why = "the tool would stand in the material";
            let help = "this envelope is for the other side of the surface";
            return Ok(Some(Finding::warning(Code::GENERATION_INPUT, why).help(help).value(facing, "")));
        }
        Ok(None)
    }

    fn left(&self, progress: &dyn Progress) -> Result<Answer> {
        let shape = self.surface.compiled()?;
        let [u, v] = &self.surface.variables;
        let whole = [[u.from, u.to], [v.from, v.to]];
        let patches = self.wanted(whole)?;
        let cells = if self.envelope.parameters.len() > 1 { CELLS_OF_TWO } else { CELLS_OF_ONE };
        let swept = Swept { tool: &self.touch.body, motion: &self.motion, domain: self.touch.domain, cells };
        let known = if self.touch.local {
            Some(ParametricSurface::new(shape, whole, FOOT_CELLS, false)?)
        } else {
            None
        };
        // One side of a tooth is looked for near the place where it must touch.
        let look = |p: DVec3| match &known {
            None => swept.left(p),
            Some(wanted) => {
                let at = self.touch.at(wanted.foot(p).0.to_array());
                let domain = [0, 1].map(|k| {
                    let [from, to] = self.touch.domain[k];
                    let near = NEAR * (to - from);
                    [(at[k] - near).max(from), (at[k] + near).min(to)]
                });
                Swept { tool: &self.touch.body, motion: &self.motion, domain, cells: CELLS_NEAR }.left(p)
            }
        };
        let mut total = LeftByTool {
            least: f64::INFINITY,
            greatest: f64::NEG_INFINITY,
            rms: 0.0,
            worst: DVec3::ZERO,
            coverage: Coverage { share: 0.0, area: 0.0, largest_gap: None },
        };
        let mut contacts = Vec::new();
        for (point, domain) in &patches {
            let at = |k: usize, i: usize| {
                let share = i as f64 / self.cells[k] as f64;
                domain[k][0] * (1.0 - share) + domain[k][1] * share
            };
            let nodes: Vec<[f64; 2]> = (0..=self.cells[0])
                .flat_map(|i| (0..=self.cells[1]).map(move |j| [i, j]))
                .map(|[i, j]| [at(0, i), at(1, j)])
                .collect();
            let points: Vec<DVec3> = nodes.iter().map(|&[u, v]| point(u, v)).collect();
            let left: Vec<Option<Left>> =
                points.par_iter().map(|&p| (!progress.cancelled()).then(|| look(p))).collect();
            let Some(left) = left.into_iter().collect::<Option<Vec<Left>>>() else {
                return Err(Finding::error(Code::CANCELLED, "the comparison was cancelled").into());
            };
            let mut squares = 0.0;
            for (p, l) in points.iter().zip(&left) {
                if l.residual.abs() > total.greatest.max(-total.least) {
                    total.worst = *p;
                }
                total.least = total.least.min(l.residual);
                total.greatest = total.greatest.max(l.residual);
                squares += l.residual * l.residual;
            }
            total.rms += squares / (points.len() * patches.len()) as f64;
            let reach = |p: DVec3| look(p).residual.abs();
            let reached = coverage(
                &|u: f64, v: f64| point(u, v),
                *domain,
                self.cells,
                [false; 2],
                reach,
                self.tolerance,
                progress,
            )?;
            let area = total.coverage.area + reached.area;
            let share = total.coverage.share * total.coverage.area + reached.share * reached.area;
            total.coverage.share = if area > 0.0 { share / area } else { 0.0 };
            total.coverage.area = area;
            let larger = reached
                .largest_gap
                .filter(|gap| total.coverage.largest_gap.is_none_or(|other| gap.area > other.area));
            total.coverage.largest_gap = larger.or(total.coverage.largest_gap);
            let step = (nodes.len() / CONTACTS).max(1);
            for (p, l) in points.iter().zip(&left).step_by(step) {
                let pose = self.motion.pose(l.at);
                let normal = -pose.vector(self.touch.body.gradient(pose.inverse().point(*p)));
                if normal != DVec3::ZERO {
                    contacts.push(Touched { joints: self.way.positions_at(l.at), point: *p, normal });
                }
            }
        }
        total.rms = total.rms.sqrt();
        Ok((Ok(total), contacts))
    }

    /// The wanted surface; or the walls on both sides of it, where the tool's normal is square to its velocity.
    fn wanted(&self, whole: [[f64; 2]; 2]) -> Result<Vec<Patch<'_>>> {
        if self.envelope.makes != Makes::Walls {
            let shape = self.surface.compiled()?;
            return Ok(vec![(Box::new(move |u, v| shape.point(u, v)), whole)]);
        }
        let contact = self.envelope.contact()?;
        let values = self.envelope.values(self.surface)?;
        let mut names: Vec<&str> = values.iter().map(|(name, _)| name.as_str()).collect();
        names.extend(self.surface.variables.iter().map(|v| v.name.as_str()));
        let numbers: Vec<f64> = values.iter().map(|(_, value)| *value).collect();
        let mut patches: Vec<Patch<'_>> = Vec::new();
        for (variable, zeros) in contact.solutions(&self.envelope.variables).into_iter().flatten() {
            for zero in zeros {
                let wall = contact.envelope(&[(variable, zero)]);
                let [x, y, z] = [&wall[0], &wall[1], &wall[2]].map(|w| w.bind(&names));
                let (bound, numbers) = ([x?, y?, z?], numbers.clone());
                patches.push((
                    Box::new(move |u, v| {
                        let mut all = numbers.clone();
                        all.extend([u, v]);
                        DVec3::from_array(bound.each_ref().map(|b| b.value(&all)))
                    }),
                    whole,
                ));
            }
        }
        Ok(patches)
    }
}

/// Cells in which the nearest place of the tool is looked for, with one parameter and with two.
const CELLS_OF_ONE: [usize; 2] = [64, 0];
const CELLS_OF_TWO: [usize; 2] = [20, 16];
/// Share of a surface that is as good as nothing.
const HARDLY: f64 = 0.02;
/// Largest distance from its contact at which one side of a tooth is looked at, as a share of the motion, and the cells
/// there.
const NEAR: f64 = 0.15;
const CELLS_NEAR: [usize; 2] = [12, 0];
/// Cells of the wanted surface for its feet.
const FOOT_CELLS: [usize; 2] = [32, 4];
/// Contacts that are kept for the budget of errors, about.
const CONTACTS: usize = 100;
