//! Straight motion: lines, polar lines, moves in machine coordinates, and the end that axis words name.

use glam::{DVec2, DVec3};

use crate::base::Result;
use crate::nc::dialect::AXES;
use crate::nc::heidenhain::polar::turned;
use crate::nc::read::place::Bytes;
use crate::program::{Move, Path, Speed, Target, Tcp, ToolAxis};

use super::Reader;
use super::settings::Functions;
use super::statement::Word;

/// Addresses of increments.
pub(super) const INCREMENTS: [&str; 3] = ["IX", "IY", "IZ"];

impl<'s> Reader<'s> {
    pub(super) fn line(&mut self, words: &mut [Word<'s>]) -> Result<()> {
        let functions = self.before(words)?;
        let speed = self.speed(words)?;
        let before = self.modal.comp;
        self.side(words)?;
        if let Some(machine) = &functions.machine {
            self.switched(before, None)?;
            self.machine_move(words, machine, speed)?;
            return self.after(functions);
        }
        if self.computed(words)? {
            self.switched(before, None)?;
            self.uncompensated("a rotary axis moves")?;
            self.computed_turn(speed)?;
            return self.after(functions);
        }
        let said = self.rotary(words)?;
        if said != [None; 3] {
            self.switched(before, None)?;
            if let Some(bytes) = &functions.retract {
                return Err(self.twice(bytes).into());
            }
            self.turning(words, said, speed)?;
            return self.after(functions);
        }
        let axes = has_axis(words);
        let end = self.end(words)?;
        self.switched(before, axes.then_some(end))?;
        if axes {
            if let Some(bytes) = &functions.retract {
                return Err(self.twice(bytes).into());
            }
            self.straight(end, speed)?;
        }
        self.after(functions)
    }

    pub(super) fn straight(&mut self, end: [Option<f64>; 3], speed: Option<Speed>) -> Result<()> {
        let speed = self.known_speed(speed)?;
        if !matches!(speed, Speed::Rapid { .. }) {
            self.start()?;
        }
        let from = self.modal.position;
        self.push_tip(end, Path::Line, speed);
        if let ([Some(a), Some(b), _], [Some(x), Some(y), _]) = (from, end) {
            let way = DVec2::new(x - a, y - b);
            self.modal.direction = way.try_normalize().or(self.modal.direction);
        } else {
            self.modal.direction = None;
        }
        Ok(())
    }

    pub(super) fn machine_move(
        &mut self,
        words: &mut [Word<'s>],
        bytes: &Bytes,
        speed: Option<Speed>,
    ) -> Result<()> {
        let speed = self.known_speed(speed)?;
        self.uncompensated("a move in machine coordinates comes")?;
        if self.modal.tcp != Tcp::Off {
            let message = "a move in machine coordinates while the tool centre point is controlled";
            return Err(self.lacks(bytes, message).help("switch it off (M129) first").into());
        }
        let mut joints = [None; 6];
        for axis in 0..3 {
            if let Some((value, _)) = self.take(words, AXES[axis])? {
                joints[axis] = Some(value * self.modal.unit);
                self.modal.position[axis] = None;
            }
        }
        let [a, b, c] = self.rotary(words)?;
        (joints[3], joints[4], joints[5]) = (a, b, c);
        if self.modal.tilt.is_some() {
            self.unplace();
        }
        if self.modal.degrees != 0.0 && (joints[0].is_some() || joints[1].is_some()) {
            self.modal.position = [None, None, self.modal.position[2]];
        }
        if joints == [None; 6] {
            return Err(self.lacks(bytes, "machine coordinates without an axis").into());
        }
        self.modal.direction = None;
        let motion = Move { end: Target::Joints(joints), path: Path::Line };
        self.program.push_move(motion, &self.state(speed), self.origin);
        Ok(())
    }

    /// `LP`: a line to a polar position.
    pub(super) fn polar_line(&mut self, words: &mut [Word<'s>]) -> Result<()> {
        let functions = self.before(words)?;
        let speed = self.speed(words)?;
        let before = self.modal.comp;
        self.side(words)?;
        let pole = self.known_pole()?;
        let unit = self.modal.unit;
        let here = match self.modal.position {
            [Some(x), Some(y), _] => Some(DVec2::new(x, y) - pole),
            _ => None,
        };
        let radius = match (self.take(words, "PR")?, self.take(words, "IPR")?, here) {
            (Some((r, _)), None, _) => r * unit,
            (None, Some((r, _)), Some(arm)) => arm.length() + r * unit,
            (None, None, Some(arm)) => arm.length(),
            _ => return Err(self.lacks(&self.here, "a polar line without its radius PR").into()),
        };
        let angle = match (self.take(words, "PA")?, self.take(words, "IPA")?, here) {
            (Some((a, _)), None, _) => a,
            (None, Some((a, _)), Some(arm)) => arm.to_angle().to_degrees() + a,
            (None, None, Some(arm)) => arm.to_angle().to_degrees(),
            _ => return Err(self.lacks(&self.here, "a polar line without its angle PA").into()),
        };
        let to = turned(pole + DVec2::new(radius, 0.0), pole, angle);
        let mut end = self.end(words)?;
        (end[0], end[1]) = (Some(to.x), Some(to.y));
        self.switched(before, Some(end))?;
        self.straight(end, speed)?;
        self.after(functions)
    }

    /// The end that the axis words name; an axis that is neither said nor known stays `None`.
    pub(super) fn end(&mut self, words: &mut [Word<'s>]) -> Result<[Option<f64>; 3]> {
        self.unambiguous()?;
        let mut end = self.modal.position;
        for axis in 0..3 {
            match (self.take(words, AXES[axis])?, self.take(words, INCREMENTS[axis])?) {
                (None, None) => {}
                (Some((value, _)), None) => {
                    end[axis] = Some(value * self.modal.unit);
                }
                (None, Some((value, bytes))) => match end[axis] {
                    Some(before) => end[axis] = Some(before + value * self.modal.unit),
                    None => {
                        let finding =
                            self.lacks(&bytes, "an increment from a position that the program has not set");
                        return Err(finding.help("move this axis to an absolute position first").into());
                    }
                },
                (Some(_), Some((_, bytes))) => return Err(self.twice(&bytes).into()),
            }
        }
        Ok(end)
    }

    /// The known position.
    pub(super) fn start(&self) -> Result<DVec3> {
        let [x, y, z] = self.modal.position;
        let (Some(x), Some(y), Some(z)) = (x, y, z) else {
            let missing: Vec<&str> =
                (0..3).filter(|i| self.modal.position[*i].is_none()).map(|i| AXES[i]).collect();
            let message = format!("a feed move starts where the program has not set {}", missing.join(", "));
            return Err(self.lacks(&self.here, &message).help("move there by FMAX first").into());
        };
        Ok(DVec3::new(x, y, z))
    }

    /// Appends a move of the tip.
    pub(super) fn push_tip(&mut self, end: [Option<f64>; 3], path: Path, speed: Speed) {
        self.push_axis(end, self.kept_axis(), path, speed);
    }

    /// Appends a move of the tip with its tool axis.
    pub(super) fn push_axis(&mut self, end: [Option<f64>; 3], axis: ToolAxis, path: Path, speed: Speed) {
        let here = self.here.clone();
        if self.modal.offset.is_none() {
            let message = "no preset (CYCL DEF 247) before the first move: preset 1, G54, is assumed";
            match self.program.setups.iter().all(|setup| setup.work_offsets.len() < 2) {
                true => self.assume(message),
                false => self.warn(&here, message),
            }
        }
        if !self.modal.unit_said {
            self.warn(&here, "no BEGIN PGM with a unit before the first move: mm is assumed");
        }
        self.modal.position = end;
        let point = DVec3::from_array(end.map(|v| v.unwrap_or(f64::NAN)));
        let motion = Move { end: Target::Tip { point, axis }, path };
        self.program.push_move(motion, &self.state(speed), self.origin);
    }

    /// Acts on the M functions that take effect after the movement of their block.
    pub(super) fn after(&mut self, functions: Functions) -> Result<()> {
        if functions.call {
            self.drill()?;
        }
        self.finish_functions(&functions)
    }
}

/// Whether a block names an axis.
pub(super) fn has_axis(words: &[Word<'_>]) -> bool {
    words.iter().any(|w| AXES.iter().chain(&INCREMENTS).any(|a| w.is(a)))
}
