//! Laws of the joints over the variables of a surface, and which joints follow which.

use std::f64::consts::TAU;

use super::follow::Branch;
use super::task::Task;
use crate::base::Quantity;
use crate::machine::Machine;

/// Position of a joint over the two variables.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum VariableLaw {
    /// Constant: a setting [mm or rad].
    Setting(f64),
    /// `at_start + slopes . (variables - lower ends)`, exactly.
    Affine {
        /// Position at the lower ends of both variables [mm or rad].
        at_start: f64,
        /// Change for each variable [mm or rad per unit].
        slopes: [f64; 2],
    },
    /// Any other law, which is solved pose by pose.
    Sampled,
}

/// A joint and its law.
#[derive(Clone, Debug, PartialEq)]
pub struct JointLaw {
    /// Address of the axis.
    pub letter: char,
    /// True for a rotation.
    pub rotary: bool,
    /// The law.
    pub law: VariableLaw,
    /// Least and greatest position [mm or rad].
    pub range: [f64; 2],
    /// True for each variable on which the position depends.
    pub depends: [bool; 2],
}

impl JointLaw {
    /// True if it moves while the surface is made; otherwise it is a setting.
    pub fn is_forming(&self) -> bool {
        self.depends != [false, false]
    }

    /// A length or an angle of this joint as printed.
    fn quantity(&self, value: f64) -> Quantity {
        if self.rotary { Quantity::new(value.to_degrees(), "deg") } else { Quantity::mm(value) }
    }
}

/// Two joints that move together with one variable.
#[derive(Clone, Debug, PartialEq)]
pub struct LinkedJoints {
    /// Index of the variable that moves both: 0 or 1.
    pub variable: usize,
    /// Joint that leads: a rotation, if there is one that runs evenly.
    pub leader: usize,
    /// Joint that follows.
    pub follower: usize,
    /// Change of the follower for that of the leader [mm or rad per mm or rad]; `None` if it is not constant.
    pub ratio: Option<f64>,
}

/// Laws of all joints of a machine from a branch.
pub(super) fn laws(machine: &Machine, task: &Task<'_>, branch: &Branch) -> Vec<JointLaw> {
    machine
        .joints
        .iter()
        .enumerate()
        .map(|(j, joint)| law(joint.letter, joint.motion.is_rotation(), task, branch, j))
        .collect()
}

fn law(letter: char, rotary: bool, task: &Task<'_>, branch: &Branch, joint: usize) -> JointLaw {
    let [nu, nv] = branch.nodes;
    let value = |i: usize, j: usize| branch.values[i * nv + j][joint];
    let all = || (0..nu).flat_map(|i| (0..nv).map(move |j| (i, j)));
    let range = all().fold([f64::INFINITY, f64::NEG_INFINITY], |[lo, hi], (i, j)| {
        [lo.min(value(i, j)), hi.max(value(i, j))]
    });
    let flat =
        (if rotary { FLAT_ANGLE } else { FLAT_LENGTH }) * (1.0 + range[0].abs().max(range[1].abs()) * SCALE);
    let depends = [
        all().any(|(i, j)| (value(i, j) - value(0, j)).abs() > flat),
        all().any(|(i, j)| (value(i, j) - value(i, 0)).abs() > flat),
    ];
    let at_start = value(0, 0);
    if depends == [false, false] {
        return JointLaw { letter, rotary, law: VariableLaw::Setting(tidy(at_start)), range, depends };
    }
    let slope = |k: usize, there: f64| {
        let length = task.domain[k][1] - task.domain[k][0];
        if depends[k] && length > 0.0 { (there - at_start) / length } else { 0.0 }
    };
    let slopes = [slope(0, value(nu - 1, 0)), slope(1, value(0, nv - 1))];
    let fits = |(i, j): (usize, usize)| {
        let u = task.node(branch.nodes, i, j);
        let line = at_start + slopes[0] * (u[0] - task.domain[0][0]) + slopes[1] * (u[1] - task.domain[1][0]);
        (value(i, j) - line).abs() <= flat
    };
    let law = if all().all(fits) {
        VariableLaw::Affine { at_start: tidy(at_start), slopes }
    } else {
        VariableLaw::Sampled
    };
    JointLaw { letter, rotary, law, range, depends }
}

/// Without the rounding of the search: a hundredth of what a pose is solved to.
fn tidy(value: f64) -> f64 {
    let rounded = (value / ROUNDING).round() * ROUNDING;
    let whole = (value * 1e3).round() / 1e3;
    let near = if (value - whole).abs() < ROUNDING { whole } else { rounded };
    // No negative zero.
    if (value - near).abs() < ROUNDING { near + 0.0 } else { value }
}

/// Joints that follow others, for each variable that moves two or more.
pub(super) fn links(laws: &[JointLaw]) -> Vec<LinkedJoints> {
    let mut links = Vec::new();
    for variable in 0..2 {
        let moved: Vec<usize> = (0..laws.len()).filter(|&j| laws[j].depends[variable]).collect();
        let slope = |j: usize| match laws[j].law {
            VariableLaw::Affine { slopes, .. } => Some(slopes[variable]),
            _ => None,
        };
        // An even rotation leads, then an even translation, then the first joint.
        let rank = |&j: &usize| (slope(j).is_none(), !laws[j].rotary, j);
        let Some(leader) = moved.iter().copied().min_by_key(rank) else { continue };
        for &follower in moved.iter().filter(|&&j| j != leader) {
            let ratio = slope(leader).zip(slope(follower)).map(|(l, f)| f / l);
            links.push(LinkedJoints { variable, leader, follower, ratio });
        }
    }
    links
}

/// The laws in words, one joint or link a line: `X is set to 30 mm`, `Z follows C, 6 mm/rev`.
pub(super) fn lines(laws: &[JointLaw], links: &[LinkedJoints], names: &[String; 2]) -> Vec<String> {
    let mut lines = Vec::new();
    for law in laws {
        if let VariableLaw::Setting(value) = law.law {
            lines.push(format!("{} is set to {}", law.letter, law.quantity(value)));
            continue;
        }
        let with: Vec<&str> = (0..2).filter(|&k| law.depends[k]).map(|k| names[k].as_str()).collect();
        let verb = if law.rotary { "turns" } else { "moves" };
        let [from, to] = law.range.map(|v| law.quantity(tidy(v)));
        lines.push(format!("{} {verb} with {}, from {from} to {to}", law.letter, with.join(" and ")));
    }
    for link in links {
        let (leader, follower) = (&laws[link.leader], &laws[link.follower]);
        let how = match link.ratio {
            Some(ratio) => {
                let (value, unit) = match (leader.rotary, follower.rotary) {
                    (true, false) => (ratio * TAU, "mm/rev"),
                    (true, true) => (ratio, "rev/rev"),
                    (false, true) => (ratio.to_degrees(), "deg/mm"),
                    (false, false) => (ratio, "mm/mm"),
                };
                Quantity::new(value, unit).to_string()
            }
            None => "by a law of its own".to_owned(),
        };
        lines.push(format!("{} follows {}, {how}", follower.letter, leader.letter));
    }
    lines
}

/// Variation of a joint that counts as zero [mm, rad]: a hundred times the accuracy to which a pose is solved.
const FLAT_LENGTH: f64 = 1e-6;
const FLAT_ANGLE: f64 = 1e-8;
/// Growth of both with the position, for long travels.
const SCALE: f64 = 1e-3;
/// Difference of positions that is only rounding [mm or rad].
const ROUNDING: f64 = 1e-10;
