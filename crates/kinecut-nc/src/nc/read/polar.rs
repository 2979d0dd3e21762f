//! Polar coordinates of FANUC: `G16`, `G15`.
//!
//! The first word of the plane is a radius, the second an angle against the clock from the first axis. Under G90 the pole is the
//! zero of the work; of a block with `G16` under G91 it is the present position, and an angle or radius under G91 adds to the one
//! before.

use crate::base::Result;
use crate::nc::dialect::{AXES, Code};

use super::block::{Word, WordMode};
use super::reader::Reader;

/// Polar coordinates in force; mm, degrees.
#[derive(Clone, Copy, Debug)]
pub(super) struct Polar {
    pole: [f64; 2],
    radius: f64,
    angle: f64,
}

impl<'s> Reader<'s> {
    /// Puts Cartesian words in the place of polar ones.
    pub(super) fn polar_words(&mut self, words: &mut Vec<Word<'s>>) -> Result<()> {
        if self.polar.is_none() && self.code(|c| matches!(c, Code::Polar { .. })).is_none() {
            return Ok(());
        }
        let absolute = match self.code(|c| matches!(c, Code::Absolute(_))) {
            Some((Code::Absolute(yes), _)) => yes,
            _ => self.modal.absolute,
        };
        let plane = match self.code(|c| matches!(c, Code::Plane(_))) {
            Some((Code::Plane(plane), _)) => plane,
            _ => self.modal.plane,
        };
        let [a, b, _] = plane.axes();
        match self.code(|c| matches!(c, Code::Polar { .. })) {
            Some((Code::Polar { on: true }, bytes)) => {
                let pole = match (absolute, self.modal.position[a], self.modal.position[b]) {
                    (true, _, _) => [0.0; 2],
                    (false, Some(x), Some(y)) => [x, y],
                    _ => {
                        let what =
                            "polar coordinates about the present position, which the program has not set";
                        return Err(self.lacks(&bytes, what).help("move there first").into());
                    }
                };
                self.polar = Some(Polar { pole, radius: 0.0, angle: 0.0 });
            }
            Some(_) => self.polar = None,
            None => {}
        }
        let Some(mut polar) = self.polar else { return Ok(()) };
        let moves = self.code(|c| {
            matches!(
                c,
                Code::Scale { .. }
                    | Code::Mirror { .. }
                    | Code::MachineFrame
                    | Code::Reference
                    | Code::FurtherReference
                    | Code::LocalShift
                    | Code::Dwell
                    | Code::Rotation { .. }
            )
        });
        let find = |axis: usize| words.iter().position(|w| !w.used && w.is(AXES[axis]));
        let (radius, angle) = (find(a), find(b));
        if moves.is_some() || radius.is_none() && angle.is_none() {
            return Ok(());
        }
        let value = |at: Option<usize>| at.and_then(|i| words[i].value);
        let unit = self.modal.length_unit;
        let next = |given: Option<f64>, unit: f64, before: f64| match given {
            Some(value) if absolute => value * unit,
            Some(value) => before + value * unit,
            None => before,
        };
        polar.radius = next(value(radius), unit, polar.radius);
        polar.angle = next(value(angle), 1.0, polar.angle);
        self.polar = Some(polar);
        let rotation = crate::nc::turn::rotation(polar.angle);
        let first = words[radius.or(angle).unwrap_or_default()].clone();
        for (i, (axis, at)) in [(a, radius), (b, angle)].into_iter().enumerate() {
            let end = polar.pole[i] + rotation.x_axis[i] * polar.radius;
            let word =
                Word { name: AXES[axis], value: Some(end / unit), way: WordMode::Absolute, ..first.clone() };
            match at {
                Some(at) => words[at] = Word { bytes: words[at].bytes.clone(), ..word },
                None => words.push(word),
            }
        }
        Ok(())
    }
}
