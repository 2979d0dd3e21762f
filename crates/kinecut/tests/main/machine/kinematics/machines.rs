//! Random machines.

use glam::{DMat3, DVec3};
use kinecut::geom::Rigid;
use kinecut::machine::{Joint, Kinematics, Word};

use crate::common::random::Random;

/// A unit vector turned by about `size` [rad] at random.
fn tilted(random: &mut Random, direction: DVec3, size: f64) -> DVec3 {
    (direction + random.vector(size)).normalize_or_zero()
}

/// The 48 classes of X, Y, Z and two rotary axes that reach all poses of a cutter that stands along Z, one word each.
pub(crate) fn classes() -> Vec<Word> {
    let mut classes: Vec<Word> = Vec::new();
    for pair in ["45", "54", "64", "65"] {
        let mut digits: Vec<char> = "123".chars().chain(pair.chars()).collect();
        digits.sort_unstable();
        permutations(&digits, &mut String::new(), &mut |word| {
            let rotary: String = word.chars().filter(|c| *c > '3').collect();
            let canonical = Word::parse(word).unwrap().canonical();
            if rotary == pair && !classes.contains(&canonical) {
                classes.push(canonical);
            }
        });
    }
    classes
}

fn permutations(left: &[char], word: &mut String, each: &mut impl FnMut(&str)) {
    if left.is_empty() {
        each(word);
    }
    for (i, c) in left.iter().enumerate() {
        word.push(*c);
        permutations(&[&left[..i], &left[i + 1..]].concat(), word, each);
        word.pop();
    }
}

/// A machine of a class: random points and senses, a work frame turned and shifted, and, if `inclined`, all axes and the
/// spindle inclined at random.
pub(crate) struct RandomMachine {
    pub(crate) joints: Vec<Joint>,
    pub(crate) work: Rigid,
    pub(crate) tool: Rigid,
}

impl RandomMachine {
    pub(crate) fn new(word: &Word, inclined: bool, random: &mut Random) -> RandomMachine {
        let lean = if inclined { 0.3 } else { 0.0 };
        let joint = |motion, random: &mut Random| {
            let standard = Joint::standard(motion);
            Joint {
                direction: tilted(random, standard.direction, lean),
                point: random.vector(200.0),
                sense: if random.unit() > 0.0 { 1.0 } else { -1.0 },
                ..standard
            }
        };
        let joints = word.0.iter().map(|&motion| joint(motion, random)).collect();
        let turn = random.vector(1.5);
        let work = Rigid {
            rotation: DMat3::from_axis_angle(turn.try_normalize().unwrap_or(DVec3::X), turn.length()),
            translation: random.vector(100.0),
        };
        let z = tilted(random, DVec3::Z, lean);
        let y = z.cross(DVec3::X).try_normalize().unwrap();
        let tool = Rigid { rotation: DMat3::from_cols(y.cross(z), y, z), translation: random.vector(150.0) };
        RandomMachine { joints, work, tool }
    }

    pub(crate) fn chain(&self) -> Kinematics {
        Kinematics::new(&self.joints, self.work, self.tool)
    }

    /// Random positions: rotary axes all around.
    pub(crate) fn positions(&self, random: &mut Random) -> Vec<f64> {
        let joints = self.joints.iter();
        joints.map(|j| random.unit() * if j.motion.is_rotation() { 3.0 } else { 300.0 }).collect()
    }
}
