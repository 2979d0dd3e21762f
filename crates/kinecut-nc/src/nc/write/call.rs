//! Cycles as calls with arguments: `CYCLE81`, `CYCLE82`, `CYCLE83`, and `CYCLE84` of threads.
//!
//! Depths are absolute. `CYCLE83` is written to withdraw after each step only, and with steps that divide the hole
//! without a remainder: of the rest of its motion the sources are not certain (`sinumerik::cycle`).

use std::f64::consts::TAU;

use crate::base::Result;
use crate::nc::dialect::Plane;
use crate::nc::grid::plain;
use crate::nc::sinumerik::cycle::Call;
use crate::program::{Between, Cycle, CycleStep, DeepHole, Shortening, Spindle, State, Tapping};
use crate::tool::Hand;

use super::Writer;
use super::cycle::surface;
use super::series::{Series, WORTH};

/// An argument: a height or distance on the grid, or another number.
#[derive(Clone, Copy, Debug)]
enum Argument {
    Out,
    Steps(i64),
    Number(f64),
}

impl Writer<'_> {
    /// A cycle as a call at the present position; whether it was written.
    pub(super) fn call_cycle(
        &mut self,
        index: usize,
        cycle: &Cycle,
        steps: &[CycleStep],
        state: &State,
    ) -> Result<bool> {
        if self.takes_up(cycle, state) && self.modal.hole.take().is_some() {
            // The block that moved has called it.
            self.after_cycle(steps)?;
            return Ok(true);
        }
        if !self.takes_cycle(state) {
            return Ok(false);
        }
        let Some((call, arguments)) = self.call_arguments(cycle, state.spindle)? else { return Ok(false) };
        let mut text = format!("{}(", call.name());
        for (i, argument) in arguments.iter().enumerate() {
            if i > 0 {
                text.push(',');
            }
            match *argument {
                Argument::Out => {}
                Argument::Steps(count) => text.push_str(&self.grid.text(count)),
                Argument::Number(value) => text.push_str(&plain(value)),
            }
        }
        text.push(')');
        let values: Vec<Option<f64>> = arguments
            .iter()
            .map(|a| match *a {
                Argument::Out => None,
                Argument::Steps(count) => Some(self.grid.written(count)),
                Argument::Number(value) => plain(value).parse().ok(),
            })
            .collect();
        let Ok(read) = call.read(&values, self.settings.units.mm(), None) else { return Ok(false) };
        if read.disputed.is_some() || !self.same_moves(steps, &read.cycle) {
            return Ok(false);
        }
        self.end_series();
        self.state(state, true)?;
        if self.place.written.iter().any(Option::is_none) {
            return Ok(false);
        }
        // The feed of a thread is its pitch times the speed.
        let thread = matches!(cycle, Cycle::Tap(_));
        let (mode, feed) = if thread { (None, None) } else { self.feed_words(state.speed)? };
        let plane = (self.modal.plane != Some(Plane::Xy)).then_some(Plane::Xy.word());
        self.modal.plane = Some(Plane::Xy);
        let feed = feed.map(|f| format!("F{f}"));
        let words: Vec<&str> = [plane, mode, feed.as_deref()].into_iter().flatten().collect();
        if !words.is_empty() {
            self.page.block(words.join(" "));
        }
        let modal = format!("MCALL {text}");
        self.page.block(text);
        self.after_cycle(steps)?;
        let series = Series { cycle: *cycle, state: *state, end: "MCALL" };
        if self.holes_after(index, &series, self.place.written[2])? >= WORTH {
            self.page.block(modal);
            self.modal.series = Some(series);
        }
        Ok(true)
    }

    /// Which cycle, with which arguments.
    fn call_arguments(&self, cycle: &Cycle, spindle: Spindle) -> Result<Option<(Call, Vec<Argument>)>> {
        use Argument::{Number, Out, Steps};
        let hole = match *cycle {
            Cycle::Drill { reference, bottom, retract, dwell } => {
                let [top, low, up] = self.on_grid([reference, bottom, retract])?;
                let surface = surface(top, low);
                let mut arguments = vec![Steps(up), Steps(surface), Steps(top - surface), Steps(low)];
                if dwell == 0.0 {
                    return Ok(Some((Call::Cycle81, arguments)));
                }
                arguments.extend([Out, Number(dwell)]);
                return Ok(Some((Call::Cycle82, arguments)));
            }
            Cycle::Peck { reference, bottom, retract, step, clearance } => DeepHole {
                reference,
                first: reference - step,
                bottom,
                retract,
                step,
                shortening: Shortening::None,
                between: Between::Withdraw { clearance, dwell: 0.0 },
                first_feed: 1.0,
                dwell: 0.0,
                dwell_bottom: 0.0,
            },
            Cycle::DeepHole(hole) => hole,
            Cycle::ChipBreak { .. } => return Ok(None),
            Cycle::Tap(Tapping { reference, bottom, retract, pitch, hand }) => {
                let [top, low, up] = self.on_grid([reference, bottom, retract])?;
                let surface = surface(top, low);
                let pitch = pitch / self.settings.units.mm();
                let (after, pitch) = if hand == Hand::Right { (3.0, pitch) } else { (4.0, -pitch) };
                let speed = Number(spindle.rate() / TAU * 60.0);
                let mut arguments = vec![Steps(up), Steps(surface), Steps(top - surface), Steps(low)];
                arguments.extend([Out, Out, Number(after), Out, Number(pitch), Number(0.0), speed, speed]);
                return Ok(Some((Call::Cycle84, arguments)));
            }
        };
        let Between::Withdraw { clearance, dwell: dwell_top } = hole.between else { return Ok(None) };
        let [top, low, up] = self.on_grid([hole.reference, hole.bottom, hole.retract])?;
        let [first, step, back] = self.on_grid([hole.first, hole.step, clearance])?;
        let surface = first + step;
        // No last dwell is said by the same zero as the usual one.
        let dwells = hole.dwell == 0.0 || hole.dwell_bottom > 0.0;
        if hole.shortening != Shortening::None
            || surface > top
            || step <= 0
            || back <= 0
            || !dwells
            || first <= low
        {
            return Ok(None);
        }
        let time = |seconds: f64| if seconds > 0.0 { Number(seconds) } else { Out };
        let last = if hole.dwell_bottom == hole.dwell { Out } else { time(hole.dwell_bottom) };
        let mut arguments =
            vec![Steps(up), Steps(surface), Steps(top - surface), Steps(low), Out, Steps(first), Out];
        arguments.extend([
            Number(0.0),
            time(hole.dwell),
            time(dwell_top),
            Number(hole.first_feed),
            Number(1.0),
        ]);
        arguments.extend([Out, Out, Out, last, Steps(back)]);
        Ok(Some((Call::Cycle83, arguments)))
    }

    /// Heights or distances on the grid.
    pub(super) fn on_grid(&self, values: [f64; 3]) -> Result<[i64; 3]> {
        let [a, b, c] = values;
        Ok([self.grid.round(a)?, self.grid.round(b)?, self.grid.round(c)?])
    }
}
