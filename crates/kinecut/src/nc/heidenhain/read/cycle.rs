//! Cycles: datum shift, dwell, tolerance, preset, drilling and reaming.
//!
//! Drilling (200) and reaming (201) run at each call (`CYCL CALL`, `M99`): `FMAX` to the set-up clearance above the
//! surface, in steps counted from the surface, back to the second clearance. Drilled in one go it is the drilling
//! cycle of the program, in steps it is single moves: the program's own pecking counts from another height.

use crate::base::{Error, Result};
use crate::nc::heidenhain::{LONGEST_DWELL, offset};
use crate::nc::read::place::Bytes;
use crate::program::{Blend, Cycle, Frame, Path, SetupId, Speed};

use super::statement::Word;
use super::{RAPID, Reader};

/// A drilling or reaming cycle that was defined; lengths [mm], heights above the datum.
#[derive(Clone, Copy, Debug)]
pub(super) struct Drilling {
    surface: f64,
    clearance: f64,
    second: f64,
    /// Below the surface, positive.
    depth: f64,
    step: f64,
    feed: Speed,
    /// Feed out; `None` is rapid.
    out: Option<Speed>,
    dwell_top: f64,
    dwell_bottom: f64,
}

/// Most steps of a hole.
const MOST_STEPS: f64 = 10_000.0;
/// Remainder of a hole that is no step of its own, against the step: rounding of sums.
const WHOLE_STEP: f64 = 1e-9;

impl<'s> Reader<'s> {
    pub(super) fn cycle(&mut self, words: &mut [Word<'s>]) -> Result<()> {
        let Some(kind) = words.get_mut(1) else {
            return Err(self.place.malformed(&self.here, "a cycle is defined or called").into());
        };
        kind.used = true;
        let bytes = kind.bytes.clone();
        if kind.is("CALL") && kind.value.is_none() {
            self.modal_call(words)?;
            return Ok(());
        }
        let (Some(number), true) = (kind.value, kind.is("DEF")) else {
            return Err(self.place.not_understood(&bytes, "a cycle is defined or called").into());
        };
        let tenths = (number * 10.0).round();
        if tenths < 0.0 || (tenths - number * 10.0).abs() > WHOLE_STEP * tenths.max(1.0) {
            return Err(self.place.malformed(&bytes, "this is no number of a cycle").into());
        }
        let (cycle, part) = ((tenths / 10.0).floor() as u32, tenths as u32 % 10);
        match (cycle, part) {
            (7 | 9 | 32, 0) => names(words),
            (7, _) => {
                self.uncompensated("the datum is moved")?;
                self.shift(words)?;
            }
            (9, _) => self.dwell(words)?,
            (32, 1) => self.tolerance(words)?,
            (32, _) => {
                self.note(
                    "the mode and the rotary tolerance of CYCL DEF 32 are not followed: they move no axis",
                );
                words.iter_mut().for_each(|w| w.used = true);
            }
            (247, 0) => self.preset(words, &bytes)?,
            (200 | 201, 0) => self.define(words, cycle == 200)?,
            _ => {
                return Err(self.place.not_understood(&bytes, "this cycle is not read yet").into());
            }
        }
        Ok(())
    }

    /// `CYCL CALL`, with the M functions of its block.
    fn modal_call(&mut self, words: &mut [Word<'s>]) -> Result<()> {
        let functions = self.before(words)?;
        self.drill()?;
        self.finish_functions(&functions);
        Ok(())
    }

    /// `CYCL DEF 7.1 X+10`: where the coordinates count from, beside the preset.
    fn shift(&mut self, words: &mut [Word<'s>]) -> Result<()> {
        for (axis, (name, more)) in [("X", "IX"), ("Y", "IY"), ("Z", "IZ")].into_iter().enumerate() {
            if let Some((value, _)) = self.take(words, name)? {
                self.modal.shift[axis] = value * self.modal.unit;
            }
            if let Some((value, _)) = self.take(words, more)? {
                self.modal.shift[axis] += value * self.modal.unit;
            }
        }
        Ok(())
    }

    fn dwell(&mut self, words: &mut [Word<'s>]) -> Result<()> {
        let Some(word) = words.iter_mut().find(|w| !w.used && w.value.is_some()) else {
            return Err(self.lacks(&self.here, "a dwell without a time").into());
        };
        word.used = true;
        let seconds = word.value.unwrap_or(0.0);
        if !(0.0..=LONGEST_DWELL).contains(&seconds) {
            let finding = self.place.malformed(&word.bytes, "a dwell is 0 to 3600 s");
            return Err(finding.value(seconds, "s").bound(LONGEST_DWELL, "s").into());
        }
        names(words);
        self.push_dwell(seconds);
        Ok(())
    }

    fn push_dwell(&mut self, seconds: f64) {
        self.program.push_dwell(seconds, &self.state(RAPID), self.origin);
    }

    fn tolerance(&mut self, words: &mut [Word<'s>]) -> Result<()> {
        self.modal.blend = match self.take(words, "T")? {
            Some((path, bytes)) if path < 0.0 => {
                return Err(self.place.malformed(&bytes, "a tolerance is not negative").into());
            }
            Some((path, _)) if path > 0.0 => Blend::Tolerance { path: path * self.modal.unit, angle: 0.0 },
            _ => Blend::Continuous,
        };
        Ok(())
    }

    fn preset(&mut self, words: &mut [Word<'s>], bytes: &Bytes) -> Result<()> {
        names(words);
        let Some(word) = words.iter_mut().find(|w| w.parameter == Some(339)) else {
            return Err(self.lacks(bytes, "a preset without its number Q339").into());
        };
        word.used = true;
        let at = word.bytes.clone();
        let number = self.count(word.value.unwrap_or(0.0), &at, "a preset")?;
        let Some(offset) = offset(number) else {
            return Err(self.place.not_understood(&at, "presets 1 to 99 are read").into());
        };
        self.modal.shift = [0.0; 3];
        if self.modal.offset.replace(offset) == Some(offset) {
            return Ok(());
        }
        self.uncompensated("the preset changes")?;
        self.modal.position = [None; 3];
        self.modal.direction = None;
        self.modal.pole = None;
        self.modal.frame = self.program.add_frame(Frame::Work(offset));
        let has = |i: usize| self.program.setups.get(i).is_some_and(|s| s.work_offsets.contains_key(&offset));
        let now = self.modal.setup.0 as usize;
        let count = self.program.setups.len();
        // The present clamping if it has the preset, otherwise the next one that has.
        if let Some(found) = (now..count).chain(0..now).find(|i| has(*i)) {
            self.modal.setup = SetupId(found as u32);
        }
        Ok(())
    }

    /// `CYCL DEF 200` or `201`.
    fn define(&mut self, words: &mut [Word<'s>], drilling: bool) -> Result<()> {
        names(words);
        let unit = self.modal.unit;
        let mut value = |number: u32| -> Option<f64> {
            let word = words.iter_mut().find(|w| w.parameter == Some(number))?;
            word.used = true;
            word.value
        };
        let parts = [200, 201, 206, 203].map(&mut value);
        let [Some(clearance), Some(depth), Some(feed), Some(surface)] = parts else {
            let why = "a drilling cycle needs Q200, Q201, Q206 and Q203";
            return Err(self.lacks(&self.here, why).into());
        };
        let (second, bottom) = (value(204).unwrap_or(clearance), value(211).unwrap_or(0.0));
        let (step, top) = if drilling { (value(202), value(210).unwrap_or(0.0)) } else { (None, 0.0) };
        let back = if drilling { None } else { value(208).filter(|f| *f > 0.0) };
        // Q395, the reference of the depth, at the tip.
        let tip = value(395).unwrap_or(0.0);
        let usable =
            depth < 0.0 && feed > 0.0 && clearance >= 0.0 && top >= 0.0 && bottom >= 0.0 && tip == 0.0;
        let step = step.unwrap_or(f64::INFINITY);
        let many = -depth / step >= MOST_STEPS;
        if !usable || step <= 0.0 || many {
            let why = "a drilling cycle needs a depth below zero, a feed and steps that are positive";
            return Err(self.lacks(&self.here, why).into());
        }
        self.modal.drilling = Some(Drilling {
            surface: surface * unit + self.modal.shift[2],
            clearance: clearance * unit,
            second: second * unit,
            depth: -depth * unit,
            step: step * unit,
            feed: self.feed(feed),
            // Q208 = 0 is the feed in.
            out: (!drilling).then(|| self.feed(back.unwrap_or(feed))),
            dwell_top: top,
            dwell_bottom: bottom,
        });
        Ok(())
    }

    /// Runs the cycle at the present position.
    pub(super) fn drill(&mut self) -> Result<()> {
        self.uncompensated("a cycle is called")?;
        let Some(cycle) = self.modal.drilling else {
            return Err(self.lacks(&self.here, "a cycle is called that was not defined").into());
        };
        let [Some(x), Some(y), _] = self.modal.position else {
            self.start()?;
            return Ok(());
        };
        let go = |reader: &mut Self, height: f64, speed: Speed| {
            reader.push_tip([Some(x), Some(y), Some(height)], Path::Line, speed);
        };
        let (top, bottom) = (cycle.surface + cycle.clearance, cycle.surface - cycle.depth);
        if cycle.step >= cycle.depth && cycle.out.is_none() {
            let retract = cycle.surface + cycle.second.max(cycle.clearance);
            let drill = Cycle::Drill { reference: top, bottom, retract, dwell: cycle.dwell_bottom };
            let state = self.state(cycle.feed);
            let located = |e: Error| e.0.at(self.place.sources.locate(self.place.span(&self.here)));
            self.program.push_cycle(drill, &state, self.origin).map_err(located)?;
            self.modal.position[2] = Some(retract);
            self.modal.direction = None;
            return Ok(());
        }
        go(self, top, RAPID);
        let steps = (cycle.depth / cycle.step - WHOLE_STEP).ceil().max(1.0) as u32;
        for i in 1..=steps {
            let depth = if i == steps { bottom } else { cycle.surface - cycle.step * f64::from(i) };
            go(self, depth, cycle.feed);
            if i == steps && cycle.dwell_bottom > 0.0 {
                self.push_dwell(cycle.dwell_bottom);
            }
            if i < steps || cycle.out.is_some() {
                go(self, top, cycle.out.unwrap_or(RAPID));
            }
            if i < steps {
                if cycle.dwell_top > 0.0 {
                    self.push_dwell(cycle.dwell_top);
                }
                go(self, (depth + cycle.clearance).min(top), RAPID);
            }
        }
        if cycle.out.is_none() || cycle.second > cycle.clearance {
            go(self, cycle.surface + cycle.second.max(cycle.clearance), RAPID);
        }
        self.modal.direction = None;
        Ok(())
    }
}

/// The name of a cycle says nothing more.
fn names(words: &mut [Word<'_>]) {
    for word in words.iter_mut().filter(|w| w.value.is_none() && w.parameter.is_none()) {
        word.used = true;
    }
}
