//! Drilling (200), reaming (201), universal drilling (203) and universal pecking (205).
//!
//! They run at each call (`CYCL CALL`, `M99`): `FMAX` to the set-up clearance above the surface, down in steps counted
//! from the surface, back to the second clearance. Between two steps the tool withdraws to the set-up clearance and
//! comes back by `FMAX` to a distance above the last depth: the set-up clearance (200, 203) or the advanced stop distance
//! (205); with chip breaking (203, `Q213` times in a row) it lifts by `Q256` only. `Q212` shortens each step, down to
//! `Q205`. The depth is that of the tip (`Q395` 0).
//!
//! A hole becomes a cycle of the program if all but the steps is in rapid, otherwise single moves. *From memory*: the
//! feed out is `Q206` if `Q208` is 0, and rapid if it is 99999 (`FMAX`) or left out; the lift to break the chip is made
//! like the way out.

use crate::base::{Error, Result};
use crate::program::{Between, Cycle, CycleStep, DeepHole, Path, Shortening, Speed};

use super::cycle::names;
use super::statement::Word;
use super::{Hole, RAPID, Reader};

/// A drilling or reaming cycle that was defined; lengths [mm], heights above the datum.
#[derive(Clone, Copy, Debug)]
pub(super) struct Drilling {
    surface: f64,
    clearance: f64,
    second: f64,
    /// Below the surface, positive.
    depth: f64,
    step: f64,
    /// Reduction from step to step, and the least step.
    decrement: f64,
    least: f64,
    /// Lifts in a row in place of withdrawing, and their height.
    breaks: u32,
    lift: f64,
    /// Above the last depth, on the way back.
    back: f64,
    feed: Speed,
    /// Feed out; `None` is rapid.
    out: Option<Speed>,
    dwell_top: f64,
    dwell_bottom: f64,
}

/// Most steps of a hole.
const MOST_STEPS: f64 = 10_000.0;
/// `FMAX` where a cycle wants a number.
const FMAX: f64 = 99_999.0;

impl<'s> Reader<'s> {
    /// `CYCL DEF 200`, `201`, `203` or `205`.
    pub(super) fn define(&mut self, words: &mut [Word<'s>], cycle: u32) -> Result<()> {
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
        let step = if cycle == 201 { None } else { value(202) };
        let top = if matches!(cycle, 200 | 203) { value(210).unwrap_or(0.0) } else { 0.0 };
        let back = if cycle == 200 { None } else { value(208) };
        let stepped = matches!(cycle, 203 | 205);
        let mut optional = |number: u32, has: bool| if has { value(number).unwrap_or(0.0) } else { 0.0 };
        let (decrement, least) = (optional(212, stepped), optional(205, stepped));
        let (breaks, lift) = (optional(213, cycle == 203), optional(256, stepped));
        let (upper, lower) = (optional(258, cycle == 205), optional(259, cycle == 205));
        let breaking = optional(257, cycle == 205);
        // Q253 is the feed to a deepened start.
        let (start, _) = (optional(379, cycle == 205), optional(253, cycle == 205));
        // Q395, the reference of the depth, at the tip.
        let tip = optional(395, true);
        let usable =
            depth < 0.0 && feed > 0.0 && clearance >= 0.0 && top >= 0.0 && bottom >= 0.0 && tip == 0.0;
        let step = step.unwrap_or(f64::INFINITY);
        let many = -depth / step >= MOST_STEPS;
        let steps = [decrement, least, lift, upper].iter().all(|v| *v >= 0.0)
            && breaks >= 0.0
            && breaks.fract() == 0.0;
        if !usable || step <= 0.0 || many || !steps {
            let why = "a drilling cycle needs a depth below zero, a feed and steps that are positive";
            return Err(self.lacks(&self.here, why).into());
        }
        let one_go = step >= -depth;
        for (said, what) in [
            (start != 0.0, "a deepened start (Q379) is not read yet"),
            (breaking != 0.0, "chip breaking within the steps of cycle 205 (Q257) is not read yet"),
            (upper != lower && !one_go, "advanced stop distances that differ (Q258, Q259) are not read yet"),
        ] {
            if said {
                return Err(self.place.not_understood(&self.here, what).into());
            }
        }
        let out = match (cycle, back) {
            (200, _) | (205, None) => None,
            (_, Some(feed)) if feed >= FMAX => None,
            // Q208 = 0 is the feed in.
            (_, feed_out) => Some(self.feed(feed_out.filter(|f| *f > 0.0).unwrap_or(feed))),
        };
        if breaks > 0.0 && !one_go {
            self.note(
                "the lifts that break the chip in cycle 203 are taken at the speed of the way out (Q208)",
            );
        }
        self.modal.hole = Some(Hole::Drilling(Drilling {
            surface: surface * unit,
            clearance: clearance * unit,
            second: second * unit,
            depth: -depth * unit,
            step: step * unit,
            decrement: decrement * unit,
            least: least * unit,
            breaks: breaks as u32,
            lift: lift * unit,
            back: if cycle == 205 { upper * unit } else { clearance * unit },
            feed: self.feed(feed),
            out,
            dwell_top: top,
            dwell_bottom: bottom,
        }));
        Ok(())
    }

    /// Runs the cycle at the present position.
    pub(super) fn drill(&mut self) -> Result<()> {
        self.uncompensated("a cycle is called")?;
        self.unambiguous()?;
        let cycle = match self.modal.hole {
            Some(Hole::Drilling(cycle)) => cycle,
            Some(Hole::Pecking(pecking)) => return self.peck(pecking),
            Some(Hole::Tapping(tapping)) => return self.tap(tapping),
            None => return Err(self.lacks(&self.here, "a cycle is called that was not defined").into()),
        };
        let [Some(x), Some(y), _] = self.modal.position else {
            self.start()?;
            return Ok(());
        };
        let located =
            |reader: &Self, e: Error| e.0.at(reader.place.sources.locate(reader.place.span(&reader.here)));
        let hole = cycle.hole();
        self.modal.direction = None;
        if cycle.out.is_none() && (cycle.breaks == 0 || cycle.step >= cycle.depth) {
            let state = self.state(cycle.feed);
            let retract = cycle.retract();
            let pushed = self.program.push_cycle(hole, &state, self.origin);
            pushed.map_err(|e| located(self, e))?;
            self.modal.position[2] = Some(retract);
            return Ok(());
        }
        let steps = hole.expansion().map_err(|e| located(self, e))?;
        let depths: Vec<f64> =
            steps.iter().filter_map(|s| if let CycleStep::Feed(z) = s { Some(*z) } else { None }).collect();
        let top = cycle.surface + cycle.clearance;
        let out = cycle.out.unwrap_or(RAPID);
        let go = |reader: &mut Self, height: f64, speed: Speed| {
            reader.push_tip([Some(x), Some(y), Some(height)], Path::Line, speed);
        };
        go(self, top, RAPID);
        let mut lifts = 0;
        for (i, depth) in depths.iter().copied().enumerate() {
            go(self, depth, cycle.feed);
            if i + 1 == depths.len() {
                if cycle.dwell_bottom > 0.0 {
                    self.push_dwell(cycle.dwell_bottom);
                }
            } else if lifts < cycle.breaks {
                lifts += 1;
                go(self, (depth + cycle.lift).min(top), out);
            } else {
                lifts = 0;
                go(self, top, out);
                if cycle.dwell_top > 0.0 {
                    self.push_dwell(cycle.dwell_top);
                }
                go(self, (depth + cycle.back).min(top), RAPID);
            }
        }
        if cycle.out.is_some() {
            go(self, top, out);
        }
        if cycle.out.is_none() || cycle.second > cycle.clearance {
            go(self, cycle.retract(), RAPID);
        }
        Ok(())
    }
}

impl Drilling {
    fn retract(&self) -> f64 {
        self.surface + self.second.max(self.clearance)
    }

    /// The cycle, as if all but the steps were in rapid and no chip were broken.
    fn hole(&self) -> Cycle {
        let (reference, bottom) = (self.surface + self.clearance, self.surface - self.depth);
        let retract = self.retract();
        if self.step >= self.depth {
            return Cycle::Drill { reference, bottom, retract, dwell: self.dwell_bottom };
        }
        let shortening = match self.decrement {
            0.0 => Shortening::None,
            decrement => Shortening::By { decrement, least: self.least },
        };
        Cycle::DeepHole(DeepHole {
            reference,
            first: self.surface - self.step,
            bottom,
            retract,
            step: (self.step - self.decrement).max(self.least.min(self.step)),
            shortening,
            between: Between::Withdraw { clearance: self.back, dwell: self.dwell_top },
            first_feed: 1.0,
            dwell: 0.0,
            dwell_bottom: self.dwell_bottom,
        })
    }
}
