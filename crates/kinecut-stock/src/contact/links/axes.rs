//! The axes of a machine as a program moves them.

use glam::{DMat3, DVec3};

use crate::geom::Rigid;
use crate::machine::{JointValues, Kinematics, Machine};

/// Addresses of the axes of a program, in the order of a segment's joints.
const LETTERS: [char; 6] = ['X', 'Y', 'Z', 'A', 'B', 'C'];
/// Volume of the box of three unit directions below which they count as flat.
const FLAT: f64 = 1e-9;

/// The joints of a machine, and the linear ones among them.
#[derive(Clone, Debug)]
pub(super) struct Axes {
    /// The axis of each joint of the code, counted X Y Z A B C.
    order: Vec<usize>,
    /// The joints of X, Y and Z.
    linear: [usize; 3],
}

impl Axes {
    /// The axes of a machine with three independent linear axes; `None` for others, and where an axis has another letter than
    /// X Y Z A B C.
    pub(super) fn of(machine: &Machine) -> Option<Axes> {
        let axis = |letter: char| LETTERS.iter().position(|l| *l == letter);
        let order = machine.joints.iter().map(|joint| axis(joint.letter)).collect::<Option<Vec<usize>>>()?;
        let mut linear = [None; 3];
        for (i, joint) in machine.joints.iter().enumerate() {
            // A rotary joint with the letter of a linear one would be moved by its numbers.
            match (joint.motion.is_rotation(), order[i]) {
                (true, 3..) => {}
                (false, axis @ 0..3) => linear[axis] = Some(i),
                _ => return None,
            }
        }
        let [Some(x), Some(y), Some(z)] = linear else { return None };
        let linear = [x, y, z];
        let direction = |i: usize| machine.joints[linear[i]].direction * machine.joints[linear[i]].sense;
        let matrix = DMat3::from_cols(direction(0), direction(1), direction(2));
        if matrix.determinant().abs() <= FLAT {
            return None;
        }
        Some(Axes { order, linear })
    }

    /// Positions in the order of the code, from those of X Y Z A B C [mm, rad].
    pub(super) fn in_order(&self, positions: [f64; 6]) -> JointValues {
        let mut q = JointValues::zero(self.order.len());
        for (q, axis) in q.iter_mut().zip(&self.order) {
            *q = positions[*axis];
        }
        q
    }

    /// The axis of each joint of the code, counted X Y Z A B C.
    pub(super) fn order(&self) -> &[usize] {
        &self.order
    }

    /// The joint that is moved by Z.
    pub(super) fn upward(&self) -> Option<usize> {
        self.order.iter().position(|axis| *axis == 2)
    }

    /// Maps the tip [table frame] into positions of X, Y and Z, at the rotary positions of `q`; `None` where they are not
    /// independent there.
    pub(super) fn to_linear(&self, chain: &Kinematics, q: &JointValues) -> Option<(DMat3, DVec3)> {
        let at = |unit: Option<usize>| {
            let mut q = *q;
            self.linear.iter().for_each(|i| q[*i] = 0.0);
            if let Some(unit) = unit {
                q[self.linear[unit]] = 1.0;
            }
            chain.forward(&q).translation
        };
        let zero = at(None);
        let matrix = DMat3::from_cols(at(Some(0)) - zero, at(Some(1)) - zero, at(Some(2)) - zero);
        let back = (matrix.determinant().abs() > FLAT).then(|| matrix.inverse())?;
        Some((back, -(back * zero)))
    }
}

/// The place of a tip in front of a spindle, in the coordinates of the machine at home.
pub(super) fn tip_at_home(machine: &Machine, length: f64) -> Rigid {
    machine.spindle.after(&Rigid::from_translation(DVec3::Z * -length))
}
