//! Can this machine make this surface with this tool?
//!
//! The split of a surface gives the motion of the tool's frame over two variables. The joints of the machine that must
//! move for it are looked for among all choices of joints, few first (the others stay at home): each pose is solved,
//! one continuous branch is followed over the domain, whole turns are chosen to stay in the travel. The laws of the
//! joints tell what is a setting, what is forming, and what is linked. If no choice works, the obstacle of the one that
//! came nearest is reported.

mod follow;
mod interpolate;
mod law;
mod nearest;
mod obstacle;
mod rank;
mod search;
mod solve;
mod task;

pub use law::{JointLaw, LinkedJoints, VariableLaw};
pub use nearest::{Alternative, Nearest, nearest_machines};
pub use obstacle::Obstacle;
pub use task::{Hold, Task};

use glam::DVec3;
use rayon::prelude::*;

use crate::base::{Code, Finding, Progress, Result};
use crate::geom::Rigid;
use crate::machine::{JointValues, Kinematics, Machine};
use search::{Attempt, Search, choices};

/// Grid, tool, held axes and tolerance for a task.
#[derive(Clone, Debug, PartialEq)]
pub struct FeasibleOptions {
    /// Cells of the grid over the two variables.
    pub cells: [usize; 2],
    /// Length of the tool in front of the gauge point [mm].
    pub tool_length: f64,
    /// Axes that are held, with their positions [mm or rad].
    pub held: Vec<(char, f64)>,
    /// Largest distance of the wanted surface from the generated one that still counts as reached [mm].
    pub tolerance: f64,
}

impl Default for FeasibleOptions {
    fn default() -> FeasibleOptions {
        FeasibleOptions { cells: [24, 12], tool_length: 0.0, held: Vec::new(), tolerance: REACHED }
    }
}

/// A way in which a machine does a task.
#[derive(Clone, Debug, PartialEq)]
pub struct TaskMotion {
    /// Laws of all joints, in the order of the code.
    pub laws: Vec<JointLaw>,
    /// Joints that follow others.
    pub links: Vec<LinkedJoints>,
    /// Greatest error of the tip between the nodes by the laws that are settings or affine [mm].
    pub tip_error: f64,
    /// Greatest error of the direction or the frame there [rad].
    pub turn_error: f64,
    /// Nodes of the grid of each variable.
    pub nodes: [usize; 2],
    /// Positions at the nodes, the second variable running faster [mm or rad].
    pub positions: Vec<JointValues>,
    names: [String; 2],
    domain: [[f64; 2]; 2],
    /// Angle between the tool's frame and that of the task at the lower ends [rad], though it need not matter.
    astray: f64,
}

impl TaskMotion {
    /// The laws in words, one joint or link a line: `X is set to 30 mm`, `Z follows C, 6 mm/rev`.
    pub fn lines(&self) -> Vec<String> {
        law::lines(&self.laws, &self.links, &self.names)
    }

    /// The law of an axis.
    pub fn law(&self, letter: char) -> Option<&JointLaw> {
        self.laws.iter().find(|law| law.letter == letter)
    }

    /// Smaller is better: few moving joints, few laws that are not affine, few rotations; then a frame of the tool
    /// turned as the task says even where it does not matter (a lathe's X stays positive), then positions near home,
    /// both at the lower ends of the variables.
    fn is_better(&self, other: &TaskMotion) -> bool {
        let near = |way: &TaskMotion| {
            let squares = way.laws.iter().zip(way.positions[0].iter()).map(|(law, value)| {
                let unit = if law.rotary { 1.0 } else { NEAR_HOME };
                (value / unit).powi(2)
            });
            squares.sum::<f64>()
        };
        let astray = |way: &TaskMotion| (way.astray / SAME_FRAME).round();
        let order = self.cost().cmp(&other.cost()).then(astray(self).total_cmp(&astray(other)));
        order.then(near(self).total_cmp(&near(other))).is_lt()
    }

    fn cost(&self) -> (usize, usize, usize) {
        let forming = self.laws.iter().filter(|l| l.is_forming());
        let count = |what: fn(&JointLaw) -> bool| forming.clone().filter(|l| what(l)).count();
        (count(|_| true), count(|l| l.law == VariableLaw::Sampled), count(|l| l.rotary))
    }
}

/// Whether a machine can do a task, and how or why not.
///
/// ```
/// # use kinecut_machine as kinecut;
/// use kinecut::base::Silent;
/// use kinecut::geom::Rigid;
/// use kinecut::machine::generation::{can_make, FeasibleOptions, Hold, Task};
/// use kinecut::machine::{CoordinateCode, Elementary, Machine};
/// use glam::DVec3;
/// // A thread of pitch 6 by a point tool: 6(phi) 3(6 phi / 2 pi) 1(r), on a lathe with C, X and Z.
/// let thread = |[phi, r]: [f64; 2]| {
///     let along = Elementary::Z.motion(6.0 * phi / std::f64::consts::TAU, DVec3::Z);
///     Elementary::C.motion(phi, DVec3::Z).after(&along).after(&Elementary::X.motion(r, DVec3::X))
/// };
/// let task = Task::new(&thread, [[0.0, 12.0], [10.0, 12.0]], ["phi", "r"], Hold::Point);
/// let lathe = Machine::of_code(CoordinateCode::parse("6031").unwrap());
/// let way = can_make(&lathe, &task, &FeasibleOptions::default(), &Silent).unwrap().unwrap();
/// assert!(way.lines().contains(&"Z follows C, 6 mm/rev".to_owned()));
/// ```
///
/// # Errors
/// `KC1131` for ranges or a motion that cannot be used, `KC0703` for a held axis that the machine does not have or a held
/// position that is not finite, those of [`Machine::check`]; `KC0009` when cancelled.
pub fn can_make(
    machine: &Machine,
    task: &Task<'_>,
    options: &FeasibleOptions,
    progress: &dyn Progress,
) -> Result<std::result::Result<TaskMotion, Obstacle>> {
    task.check()?;
    machine.check()?;
    let mut home = JointValues::zero(machine.joints.len());
    for (value, joint) in home.iter_mut().zip(&machine.joints) {
        if let Some([least, most]) = joint.travel {
            *value = 0f64.clamp(least, most);
        }
    }
    let mut free: Vec<usize> = (0..home.len()).collect();
    for &(letter, position) in &options.held {
        let Some((place, _)) = machine.joint(letter) else {
            return Err(Finding::error(
                Code::MACHINE_AXIS,
                format!("axis {letter} is held, but the machine {} has none", machine.code),
            )
            .help("hold only axes of the machine")
            .into());
        };
        if !position.is_finite() {
            return Err(Finding::error(
                Code::MACHINE_AXIS,
                format!("axis {letter} is held where it cannot be"),
            )
            .value(position, "")
            .help("hold an axis at a finite position")
            .into());
        }
        if let Some(slot) = home.get_mut(place) {
            *slot = position;
        }
        free.retain(|&j| j != place);
    }
    let tip = Rigid::from_translation(DVec3::Z * -options.tool_length + task.control);
    let chain = Kinematics::new(&machine.joints, machine.work, machine.spindle.after(&tip));
    let search = Search::new(machine, &chain, task, home, task.nodes(options.cells));
    let mut nearest: Option<(Obstacle, Vec<usize>)> = None;
    for count in 0..=free.len().min(task.hold.conditions()) {
        let choices = choices(&free, count);
        let tried: Vec<Option<Vec<Attempt>>> =
            choices.par_iter().map(|moving| (!progress.cancelled()).then(|| search.ways(moving))).collect();
        let mut best: Option<TaskMotion> = None;
        for (tried, moving) in tried.into_iter().zip(&choices) {
            let Some(tried) = tried else {
                return Err(Finding::error(Code::CANCELLED, "the search was cancelled").into());
            };
            for attempt in tried {
                match attempt {
                    Ok(way) => {
                        if best.as_ref().is_none_or(|b| way.is_better(b)) {
                            best = Some(way);
                        }
                    }
                    Err(obstacle) => {
                        let nearer = nearest.as_ref().is_none_or(|(other, with)| {
                            // A miss counts with as many joints as may help.
                            let key = |o: &Obstacle, count: usize| {
                                let (class, distance) = o.distance(search.arm);
                                (class, if class == 2 { usize::MAX - count } else { 0 }, distance)
                            };
                            key(&obstacle, moving.len()) < key(other, with.len())
                        });
                        if nearer {
                            nearest = Some((obstacle, moving.clone()));
                        }
                    }
                }
            }
        }
        if let Some(way) = best {
            return Ok(Ok(way));
        }
    }
    let Some((obstacle, moving)) = nearest else {
        return Err(Finding::error(Code::GENERATION_INPUT, "the machine has no way to try").into());
    };
    Ok(Err(search.worst(obstacle, &moving)))
}

/// Ten micrometres.
const REACHED: f64 = 0.01;
/// Angles between frames that are one [rad]: a thousand times what a pose is solved to.
const SAME_FRAME: f64 = 1e-6;
/// Length that is as far from home as one radian [mm].
const NEAR_HOME: f64 = 1e3;
