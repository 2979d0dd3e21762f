//! Can this machine make this surface with this tool?
//!
//! The split of a surface gives the motion of the tool's frame over two variables. The joints of the machine that must
//! move for it are looked for among all choices of joints, few first (the others stand at home): each pose is solved,
//! one continuous branch is followed over the domain, whole turns are chosen to stay in the travel. The laws of the joints
//! tell what is a setting, what is forming, and what is linked. If no choice works, the obstacle of the one that came
//! nearest is told.

mod follow;
mod interpolate;
mod law;
mod nearest;
mod obstacle;
mod rank;
mod solve;
mod task;

pub use law::{JointLaw, Law, LinkedJoints};
pub use nearest::{Alternative, nearest_machines};
pub use obstacle::Obstacle;
pub use task::{Hold, Task};

use glam::DVec3;
use rayon::prelude::*;

use crate::base::{Code, Finding, Progress, Result};
use crate::geom::Rigid;
use crate::machine::{JointValues, Kinematics, Machine};
use follow::{Branch, follow, unreached};
use solve::Mover;

/// How closely a task is looked at.
#[derive(Clone, Debug, PartialEq)]
pub struct FeasibleOptions {
    /// Cells of the grid over the two variables.
    pub cells: [usize; 2],
    /// Length of the tool in front of the gauge point [mm].
    pub tool_length: f64,
    /// Axes that are held, with their positions [mm or rad].
    pub held: Vec<(char, f64)>,
}

impl Default for FeasibleOptions {
    fn default() -> FeasibleOptions {
        FeasibleOptions { cells: [24, 12], tool_length: 0.0, held: Vec::new() }
    }
}

/// A way in which a machine does a task.
#[derive(Clone, Debug, PartialEq)]
pub struct Way {
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
}

impl Way {
    /// The laws in words, one joint or link a line: `X is set to 30 mm`, `Z follows C, 6 mm/rev`.
    pub fn lines(&self) -> Vec<String> {
        law::lines(&self.laws, &self.links, &self.names)
    }

    /// The law of an axis.
    pub fn law(&self, letter: char) -> Option<&JointLaw> {
        self.laws.iter().find(|law| law.letter == letter)
    }

    /// Smaller is better: few moving joints, few laws that are not affine, few rotations; then positions near home at
    /// the lower ends of both variables.
    fn is_better(&self, other: &Way) -> bool {
        let near = |way: &Way| {
            let squares = way.laws.iter().zip(way.positions[0].iter()).map(|(law, value)| {
                let unit = if law.rotary { 1.0 } else { NEAR_HOME };
                (value / unit).powi(2)
            });
            squares.sum::<f64>()
        };
        self.cost().cmp(&other.cost()).then(near(self).total_cmp(&near(other))).is_lt()
    }

    fn cost(&self) -> (usize, usize, usize) {
        let forming = self.laws.iter().filter(|l| l.is_forming());
        let count = |what: fn(&JointLaw) -> bool| forming.clone().filter(|l| what(l)).count();
        (count(|_| true), count(|l| l.law == Law::Sampled), count(|l| l.rotary))
    }
}

/// Whether a machine can do a task, and how or why not.
///
/// ```
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
/// `KC1131` for ranges or a motion that cannot be used, `KC0703` for a held axis that the machine does not have; `KC0009`
/// when cancelled.
pub fn can_make(
    machine: &Machine,
    task: &Task<'_>,
    options: &FeasibleOptions,
    progress: &dyn Progress,
) -> Result<std::result::Result<Way, Obstacle>> {
    task.check()?;
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
            .cure("hold only axes of the machine")
            .into());
        };
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
        let mut best: Option<Way> = None;
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

type Attempt = std::result::Result<Way, Obstacle>;

/// What all choices of joints share.
struct Search<'a> {
    machine: &'a Machine,
    chain: &'a Kinematics,
    task: &'a Task<'a>,
    home: JointValues,
    rotary: Vec<bool>,
    nodes: [usize; 2],
    /// Length by which angles are weighed against lengths [mm].
    arm: f64,
}

impl<'a> Search<'a> {
    fn new(
        machine: &'a Machine,
        chain: &'a Kinematics,
        task: &'a Task<'a>,
        home: JointValues,
        nodes: [usize; 2],
    ) -> Search<'a> {
        let rotary = machine.joints.iter().map(|j| j.motion.is_rotation()).collect();
        let reach = [[0, 0], [0, 1], [1, 0], [1, 1]]
            .map(|[i, j]| task.pose([task.domain[0][i], task.domain[1][j]]).translation.length());
        let arm = reach.into_iter().fold(LEAST_ARM, f64::max);
        Search { machine, chain, task, home, rotary, nodes, arm }
    }

    fn mover<'b>(&'b self, moving: &'b [usize]) -> Mover<'b> {
        Mover { chain: self.chain, hold: self.task.hold, moving, rotary: &self.rotary, arm: self.arm }
    }

    /// All ways in which these joints alone do the task, or what keeps them from it.
    fn ways(&self, moving: &[usize]) -> Vec<Attempt> {
        let mover = self.mover(moving);
        let [nu, nv] = self.nodes;
        // The middle, where the branch begins, then two corners, so that most choices are put aside at once.
        let corners =
            [[nu / 2, nv / 2], [0, 0], [nu - 1, nv - 1]].map(|[i, j]| self.task.node(self.nodes, i, j));
        let mut roots = Vec::new();
        for (n, &u) in corners.iter().enumerate() {
            let found = mover.reach_all(&self.task.pose(u), &self.home);
            match found.first() {
                Some(first) if first.is_exact() => {}
                Some(first) => return vec![Err(unreached(&mover, self.task, u, first))],
                None => return Vec::new(),
            }
            if n == 0 {
                roots = found;
            }
        }
        let follow = |root: &solve::Reached| -> Attempt {
            let mut branch = follow(&mover, self.task, &root.values, self.nodes)?;
            self.wind(&mut branch)?;
            Ok(self.way(branch, moving))
        };
        roots.iter().map(follow).collect()
    }

    /// Shifts rotations by whole turns into their travel, and checks the travel of all joints.
    fn wind(&self, branch: &mut Branch) -> std::result::Result<(), Obstacle> {
        use std::f64::consts::TAU;
        for (joint, axis) in self.machine.joints.iter().enumerate() {
            let values = || branch.values.iter().enumerate().map(|(n, q)| (q[joint], n));
            let (Some(least), Some(most)) =
                (values().min_by(|a, b| a.0.total_cmp(&b.0)), values().max_by(|a, b| a.0.total_cmp(&b.0)))
            else {
                continue;
            };
            let start = branch.values[0][joint];
            let mut shift = if self.rotary[joint] { -(start / TAU).round() * TAU } else { 0.0 };
            if let Some([from, to]) = axis.travel {
                if self.rotary[joint] && (least.0 + shift < from || most.0 + shift > to) {
                    // The turn at which the middle of the range is nearest to that of the travel is the best there is.
                    shift = ((0.5 * (from + to) - 0.5 * (least.0 + most.0)) / TAU).round() * TAU;
                }
                let (under, over) = (from - least.0 - shift, most.0 + shift - to);
                if under > SLACK || over > SLACK {
                    let ((value, node), bound) = if under > over { (least, from) } else { (most, to) };
                    let at = self.task.node(branch.nodes, node / branch.nodes[1], node % branch.nodes[1]);
                    let point = self.task.pose(at).translation;
                    return Err(Obstacle::Travel { joint, value: value + shift, bound, at, point });
                }
            }
            if shift != 0.0 {
                for q in &mut branch.values {
                    q[joint] += shift;
                }
            }
        }
        Ok(())
    }

    fn way(&self, branch: Branch, moving: &[usize]) -> Way {
        let laws = law::laws(self.machine, self.task, &branch);
        let links = law::links(&laws);
        let (tip_error, turn_error) = self.between(&branch, &laws, moving);
        let Branch { nodes, values } = branch;
        Way {
            laws,
            links,
            tip_error,
            turn_error,
            nodes,
            positions: values,
            names: self.task.names.clone(),
            domain: self.task.domain,
        }
    }

    /// Errors of the laws in the middles of the cells: what is sampled is solved anew, the rest follows its law.
    fn between(&self, branch: &Branch, laws: &[JointLaw], moving: &[usize]) -> (f64, f64) {
        let sampled: Vec<usize> = moving.iter().copied().filter(|&j| laws[j].law == Law::Sampled).collect();
        let mover = self.mover(&sampled);
        let (mut tip, mut turn) = (0.0f64, 0.0f64);
        let [nu, nv] = branch.nodes;
        for i in 0..nu.max(2) - 1 {
            for j in 0..nv.max(2) - 1 {
                let (a, b) = (
                    self.task.node(branch.nodes, i, j),
                    self.task.node(branch.nodes, (i + 1).min(nu - 1), (j + 1).min(nv - 1)),
                );
                let u = [0.5 * (a[0] + b[0]), 0.5 * (a[1] + b[1])];
                let mut q = branch.values[i * nv + j];
                for (value, law) in q.iter_mut().zip(laws) {
                    match law.law {
                        Law::Setting(set) => *value = set,
                        Law::Affine { at_start, slopes } => {
                            let by = |k: usize| slopes[k] * (u[k] - self.task.domain[k][0]);
                            *value = at_start + by(0) + by(1);
                        }
                        Law::Sampled => {}
                    }
                }
                let miss = mover.reach(&self.task.pose(u), &q).miss;
                tip = tip.max(miss.shift.length());
                turn = turn.max(miss.turn.length());
            }
        }
        (tip, turn)
    }

    /// An unreached pose is replaced by the one that is farthest out of reach.
    fn worst(&self, obstacle: Obstacle, moving: &[usize]) -> Obstacle {
        let Obstacle::Unreached { .. } = obstacle else { return obstacle };
        let mover = self.mover(moving);
        let mut worst = obstacle;
        for n in 0..25 {
            let at = |k: usize, i: usize| {
                let [from, to] = self.task.domain[k];
                from + (to - from) * i as f64 / 4.0
            };
            let u = [at(0, n / 5), at(1, n % 5)];
            let found = mover.reach_all(&self.task.pose(u), &self.home);
            if let Some(first) = found.first().filter(|f| !f.is_exact()) {
                let other = unreached(&mover, self.task, u, first);
                // Not by rounding: places that are equally bad keep the first.
                if other.distance(self.arm).1 > worst.distance(self.arm).1 * (1.0 + SAME) {
                    worst = other;
                }
            }
        }
        worst
    }
}

/// All choices of `count` of the joints, in their order.
fn choices(joints: &[usize], count: usize) -> Vec<Vec<usize>> {
    let masks = 0u32..1 << joints.len().min(31);
    let chosen = masks.filter(|mask| mask.count_ones() as usize == count).map(|mask| {
        (0..joints.len()).filter(|&i| mask >> i & 1 == 1).map(|i| joints[i]).collect::<Vec<usize>>()
    });
    let mut all: Vec<Vec<usize>> = chosen.collect();
    all.sort();
    all
}

/// Length that is as far from home as one radian [mm].
const NEAR_HOME: f64 = 1e3;
/// Shortest length by which angles are weighed [mm].
const LEAST_ARM: f64 = 10.0;
/// How far beyond its travel a joint may be by rounding [mm or rad].
const SLACK: f64 = 1e-9;
/// Relative difference of two misses that are one.
const SAME: f64 = 1e-6;
