//! A layout as a machine: axes with standard places and the sizes of the query.

use glam::{DMat3, DQuat, DVec3};

use super::Sizes;
use crate::base::Result;
use crate::geom::Rigid;
use crate::machine::{CoordinateCode, Joint, Kinematics, Machine, Word};

impl Sizes {
    /// A machine of a code: rotary axes of a table through the zero, those of a head one tool length behind it; strokes
    /// to both sides of home. At home the tip of a tool of [`Sizes::tool_length`] is at the zero.
    ///
    /// ```
    /// # use kinecut_machine as kinecut;
    /// use kinecut::machine::{CoordinateCode, layouts::Sizes};
    /// let sizes = Sizes::default();
    /// let machine = sizes.machine(&CoordinateCode::parse("612035").unwrap()).unwrap();
    /// let tip = machine.kinematics(sizes.tool_length).forward(&[0.0, 10.0, 0.0, 0.0, 1.0]).translation;
    /// assert!((tip.x - (10.0 - 200.0 * 1f64.sin())).abs() < 1e-12); // the head swings the tip by its length
    /// ```
    ///
    /// # Errors
    /// Those of [`Machine::check`]; `KC1122` through [`super::Query::check`] is not repeated here.
    pub fn machine(&self, code: &CoordinateCode) -> Result<Machine> {
        let spindle = self.spindle();
        let mut letters: Vec<char> = code.axes().collect();
        let joints = code.word().0.iter().enumerate().map(|(i, &motion)| {
            let letter = motion.letter().unwrap_or_else(|| {
                let free =
                    ['B', 'A', 'C', 'D', 'E'].into_iter().find(|c| !letters.contains(c)).unwrap_or('E');
                letters.push(free);
                free
            });
            let travel = if motion.is_rotation() {
                self.limit(motion)
            } else {
                let half = 0.5 * self.stroke[usize::from(motion.digit()) - 1];
                Some([-half, half])
            };
            let behind = if i < code.bed() { 0.0 } else { self.tool_length };
            Joint {
                letter,
                direction: self.direction(motion),
                point: spindle * behind,
                travel,
                ..Joint::standard(motion)
            }
        });
        let machine = Machine {
            name: code.to_string(),
            joints: joints.collect(),
            spindle: Rigid { rotation: self.tool_frame(), translation: spindle * self.tool_length },
            ..Machine::of_code(code.clone())
        };
        machine.check()?;
        Ok(machine)
    }

    /// The chain of a word with all rotary axes through the zero, for what offsets do not change.
    pub(super) fn kinematics(&self, word: &Word) -> Kinematics {
        let joint = |&motion| Joint { direction: self.direction(motion), ..Joint::standard(motion) };
        let joints: Vec<Joint> = word.0.iter().map(joint).collect();
        let tool = Rigid { rotation: self.tool_frame(), translation: DVec3::ZERO };
        Kinematics::new(&joints, Rigid::IDENTITY, tool)
    }

    /// A frame whose Z is the spindle.
    fn tool_frame(&self) -> DMat3 {
        DMat3::from_quat(DQuat::from_rotation_arc(DVec3::Z, self.spindle()))
    }
}
