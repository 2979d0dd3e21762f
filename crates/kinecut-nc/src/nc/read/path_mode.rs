//! The passage from one move to the next: exact stop, exact path, continuous path and its tolerance.
//!
//! LinuxCNC's `G64 P Q` has two distances: P is that of the planner at corners, Q that within which several lines become one
//! before it. Left out, Q is P; P left out or zero is no tolerance: the planner then rounds by up to a quarter of a move.
//! Source: `convert_control_mode` of `interp_convert.cc`, `linkable` of `emccanon.cc`, `tcFindBlendTolerance` of `tc.c`.

use crate::base::{Code as FindingCode, Finding, Result};
use crate::nc::dialect::Code;
use crate::program::Blend;

use super::block::Word;
use super::reader::{Reader, Value, take};

impl<'s> Reader<'s> {
    /// Executes the code of the path mode of a block, if it has one.
    pub(super) fn path_mode(&mut self, words: &mut [Word<'s>]) -> Result<()> {
        let is_mode = |c| matches!(c, Code::ExactStop | Code::ExactPath | Code::Continuous | Code::Rounded);
        let Some((code, _)) = self.code(is_mode) else {
            return Ok(());
        };
        self.modal.blend_said = true;
        self.modal.blend = match code {
            Code::ExactStop => Blend::Stop,
            Code::ExactPath => Blend::Exact,
            Code::Rounded => {
                if let Some(distance) = take(words, "ADIS") {
                    self.modal.rounding = self.not_negative(&distance)? * self.modal.length_unit;
                }
                Blend::within(self.modal.rounding)
            }
            _ if self.dialect.merges => self.within(words)?,
            _ => Blend::Continuous,
        };
        self.rounds_freely |= self.modal.blend == Blend::Continuous;
        Ok(())
    }

    /// The tolerance of `G64 P Q`.
    fn within(&mut self, words: &mut [Word<'s>]) -> Result<Blend> {
        let unit = self.modal.length_unit;
        let said = [take(words, "P"), take(words, "Q")];
        let mut distances = [None; 2];
        for (distance, value) in distances.iter_mut().zip(&said) {
            *distance = value.as_ref().map(|v| self.not_negative(v)).transpose()?;
        }
        let [path, merge] = distances;
        if let Some(path) = path.filter(|p| *p > 0.0) {
            return Ok(Blend::Tolerance {
                path: path * unit,
                merge: merge.unwrap_or(path) * unit,
                angle: 0.0,
            });
        }
        if let Some(word) = said[1].as_ref().filter(|merge| merge.value > 0.0) {
            let message = format!(
                "`{}` (lines that are merged on a path without a tolerance P) is not followed: the control is free there",
                self.place.shown(&word.bytes)
            );
            if self.findings.iter().all(|f| f.message != message) {
                let place = self.place.sources.locate(self.place.span(&word.bytes));
                self.findings.push(Finding::note(FindingCode::NC_WORD, message).at(place));
            }
        }
        Ok(Blend::Continuous)
    }

    fn not_negative(&self, value: &Value) -> Result<f64> {
        if value.value >= 0.0 {
            return Ok(value.value);
        }
        Err(self.place.malformed(&value.bytes, "a tolerance is not negative").into())
    }
}
