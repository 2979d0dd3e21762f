//! Cycles in klartext: `CYCL DEF 200` of holes, `CYCL DEF 207` of threads, and their calls.
//!
//! The cycle counts its steps from the surface, withdraws to the set-up clearance above it, and comes back to that
//! clearance above the last depth: holes drilled in one go, and deep holes whose clearance is that of the surface.
//! Its feed is one per minute. Everything else is written as moves; cycles 203 and 205 are not written, since what their
//! lift and their last retraction run at is not known for certain.

use crate::base::{Code, Finding, Result};
use crate::nc::grid::plain;
use crate::nc::heidenhain::LONGEST_DWELL;
use crate::nc::write::Writer;
use crate::nc::write::cycle::surface;
use crate::program::{Between, Blend, Comp, Cycle, CycleStep, DeepHole, Shortening, Speed, State, Tapping};
use crate::tool::Hand;

impl Writer<'_> {
    /// `CYCL DEF 200`, if it makes these moves; whether it was written. Everything else is written as moves.
    pub(in crate::nc::write) fn klartext_cycle(
        &mut self,
        cycle: &Cycle,
        steps: &[CycleStep],
        state: &State,
    ) -> Result<bool> {
        let Speed::PerMinute(feed) = state.speed else { return Ok(false) };
        let known = self.place.written[0].is_some() && self.place.written[1].is_some();
        let number = plain(feed * 60.0 / self.feed_unit());
        let simple = known && !matches!(state.blend, Blend::Stop | Blend::Exact) && state.comp == Comp::Off;
        let usable = feed.is_finite() && feed > 0.0 && number != "0";
        if !simple || !usable {
            return Ok(false);
        }
        let (ends, step, dwells) = match *cycle {
            Cycle::Drill { reference, bottom, retract, dwell } => {
                ([reference, bottom, retract], None, [0.0, dwell])
            }
            Cycle::DeepHole(hole) => {
                let DeepHole { reference, bottom, retract, first, step, dwell_bottom, .. } = hole;
                let Between::Withdraw { dwell, .. } = hole.between else { return Ok(false) };
                if hole.shortening != Shortening::None {
                    return Ok(false);
                }
                ([reference, bottom, retract], Some([first, step]), [dwell, dwell_bottom])
            }
            _ => return Ok(false),
        };
        let [top, low, up] = self.on_grid(ends)?;
        if low >= top || top > up || dwells.iter().any(|d| !(0.0..=LONGEST_DWELL).contains(d)) {
            return Ok(false);
        }
        let (surface, step) = match step {
            // The work zero is mostly the surface; if the hole does not begin there, the reference height is.
            None => {
                let surface = if low < 0 && top > 0 { 0 } else { top };
                (surface, surface - low)
            }
            Some([first, step]) => {
                let step = self.grid.round(step)?;
                (self.grid.round(first)? + step, step)
            }
        };
        if step <= 0 || surface > top || surface <= low {
            return Ok(false);
        }
        let [top_dwell, low_dwell] = dwells.map(plain);
        let [reference, bottom, retract] = [top, low, up].map(|c| self.grid.value(c));
        let time = |text: &str| text.parse::<f64>().unwrap_or(0.0);
        let read = if step >= surface - low {
            Cycle::Drill { reference, bottom, retract, dwell: time(&low_dwell) }
        } else {
            let clearance = self.grid.value(top - surface);
            Cycle::DeepHole(DeepHole {
                reference,
                first: self.grid.value(surface - step),
                bottom,
                retract,
                step: self.grid.value(step),
                shortening: Shortening::None,
                between: Between::Withdraw { clearance, dwell: time(&top_dwell) },
                first_feed: 1.0,
                dwell: 0.0,
                dwell_bottom: time(&low_dwell),
            })
        };
        if !self.same_moves(steps, &read) {
            return Ok(false);
        }
        self.state(state, true)?;
        if self.place.written[0].is_none() || self.place.written[1].is_none() {
            let finding = Finding::error(Code::NC_STATE, "a cycle is called where the position is not known");
            return Err(finding.help("move there in its work offset first").into());
        }
        let lines = self.drilling([top, low, up], surface, step, [&number, &top_dwell, &low_dwell]);
        self.call_defined(&lines, steps)?;
        Ok(true)
    }

    /// Defines a cycle, unless it is the one in force, and calls it.
    fn call_defined(&mut self, lines: &[String], steps: &[CycleStep]) -> Result<()> {
        let definition = lines.join("\n");
        if self.modal.pen.cycle.as_ref() != Some(&definition) {
            for line in lines {
                self.page.block(line.clone());
            }
            self.modal.pen.cycle = Some(definition);
        }
        self.page.block("CYCL CALL".to_owned());
        self.after_cycle(steps)
    }

    /// `CYCL DEF 207`, if it makes these moves; whether it was written.
    pub(in crate::nc::write) fn klartext_tap(
        &mut self,
        tapping: &Tapping,
        steps: &[CycleStep],
        state: &State,
    ) -> Result<bool> {
        let known = self.place.written[0].is_some() && self.place.written[1].is_some();
        let (read, [top, low, up], pitch) = self.thread_on_grid(tapping)?;
        let simple = known && !matches!(state.blend, Blend::Stop | Blend::Exact) && state.comp == Comp::Off;
        if !simple || low >= top || top > up || !self.same_moves(steps, &Cycle::Tap(read)) {
            return Ok(false);
        }
        self.state(state, true)?;
        if self.place.written[0].is_none() || self.place.written[1].is_none() {
            return Ok(false);
        }
        let value = |count: i64| self.grid.text(count);
        let surface = surface(top, low);
        let sign = if tapping.hand == Hand::Right { '+' } else { '-' };
        let lines = [
            "CYCL DEF 207 RIGID TAPPING ~".to_owned(),
            format!("    Q200={} ;SET-UP CLEARANCE ~", value(top - surface)),
            format!("    Q201={} ;DEPTH OF THREAD ~", value(low - surface)),
            format!("    Q239={sign}{pitch} ;THREAD PITCH ~"),
            format!("    Q203={} ;SURFACE COORDINATE ~", value(surface)),
            format!("    Q204={} ;2ND SET-UP CLEARANCE", value(up - surface)),
        ];
        self.call_defined(&lines, steps)?;
        Ok(true)
    }

    /// The blocks of `CYCL DEF 200`: heights and step in steps of the grid, feed and dwells as they are written.
    fn drilling(
        &self,
        [top, low, up]: [i64; 3],
        surface: i64,
        step: i64,
        [feed, top_dwell, low_dwell]: [&str; 3],
    ) -> [String; 9] {
        let value = |count: i64| self.grid.text(count);
        [
            "CYCL DEF 200 DRILLING ~".to_owned(),
            format!("    Q200={} ;SET-UP CLEARANCE ~", value(top - surface)),
            format!("    Q201={} ;DEPTH ~", value(low - surface)),
            format!("    Q206=+{feed} ;FEED RATE FOR PLNGNG ~"),
            format!("    Q202={} ;PLUNGING DEPTH ~", value(step)),
            format!("    Q210=+{top_dwell} ;DWELL TIME AT TOP ~"),
            format!("    Q203={} ;SURFACE COORDINATE ~", value(surface)),
            format!("    Q204={} ;2ND SET-UP CLEARANCE ~", value(up - surface)),
            format!("    Q211=+{low_dwell} ;DWELL TIME AT DEPTH"),
        ]
    }
}
