//! State, cycles and dwells in klartext: `CYCL DEF 32`, `247`, `200` and `9`.

use crate::base::{Code, Finding, Result};
use crate::nc::grid::plain;
use crate::nc::heidenhain::{LONGEST_DWELL, preset};
use crate::nc::write::{Writer, unsupported};
use crate::program::{Blend, Comp, Cycle, CycleStep, Speed, State, WorkOffset};

impl Writer<'_> {
    /// Changes of the state.
    pub(in crate::nc::write) fn klartext_state(&mut self, state: &State, in_work: bool) -> Result<()> {
        if state.tcp {
            return Err(unsupported("tool centre point control is not written yet").into());
        }
        self.modal.pen.wanted = Some(match state.comp {
            Comp::Off => "R0",
            Comp::Left(_) => "RL",
            Comp::Right(_) => "RR",
        });
        self.path_tolerance(state.blend)?;
        if let Some(name) = if in_work { self.work_offset(state)? } else { None } {
            // The offsets of this control were asked for by the caller.
            let number = WorkOffset::parse(&name).and_then(preset).unwrap_or(0);
            self.page.block("CYCL DEF 247 DATUM SETTING ~".to_owned());
            self.page.line(format!("    Q339=+{number} ;DATUM NUMBER"));
            self.modal.pen.pole = None;
            self.modal.pen.beside = None;
        }
        if let Some(words) = self.spindle(state.spindle)? {
            let word = match words.split_once(' ') {
                Some((speed, word)) => {
                    let rpm = speed.trim_start_matches('S');
                    if self.modal.pen.rpm.as_deref() != Some(rpm) {
                        self.page.block(format!("TOOL CALL S{rpm}"));
                        self.modal.pen.rpm = Some(rpm.to_owned());
                    }
                    word.to_owned()
                }
                None => words,
            };
            self.page.block(word);
        }
        if let Some(word) = self.coolant(state.coolant)? {
            self.page.block(word);
        }
        Ok(())
    }

    /// `CYCL DEF 32`; an exact stop is refused where it would matter, in a feed move.
    fn path_tolerance(&mut self, blend: Blend) -> Result<()> {
        self.modal.pen.stop = blend == Blend::Stop;
        if blend == Blend::Stop || self.modal.pen.blend == Some(blend) {
            return Ok(());
        }
        self.modal.pen.blend = Some(blend);
        let value = match blend {
            Blend::Tolerance { path, .. } if path.is_finite() && path > 0.0 => format!(" T{}", plain(path)),
            Blend::Tolerance { path, .. } => {
                return Err(Finding::error(
                    Code::POST_NUMBER,
                    "the tolerance of a continuous path is not usable",
                )
                .value_mm(path)
                .into());
            }
            _ => String::new(),
        };
        self.page.block("CYCL DEF 32.0 TOLERANCE".to_owned());
        self.page.block(format!("CYCL DEF 32.1{value}"));
        Ok(())
    }

    /// `CYCL DEF 200` for a hole drilled in one go; whether it was written. Everything else is written as moves.
    pub(in crate::nc::write) fn klartext_cycle(
        &mut self,
        cycle: &Cycle,
        steps: &[CycleStep],
        state: &State,
    ) -> Result<bool> {
        let (&Cycle::Drill { reference, bottom, retract, dwell }, Speed::PerMinute(feed)) =
            (cycle, state.speed)
        else {
            return Ok(false);
        };
        let known = self.place.written[0].is_some() && self.place.written[1].is_some();
        let number = plain(feed * 60.0);
        let simple = known && state.blend != Blend::Stop && state.comp == Comp::Off;
        let usable =
            feed.is_finite() && feed > 0.0 && number != "0" && (0.0..=LONGEST_DWELL).contains(&dwell);
        if !simple || !usable {
            return Ok(false);
        }
        let [top, low, up] =
            [self.grid.round(reference)?, self.grid.round(bottom)?, self.grid.round(retract)?];
        if low >= top || top > up {
            return Ok(false);
        }
        self.state(state, true)?;
        if self.place.written[0].is_none() || self.place.written[1].is_none() {
            let finding = Finding::error(Code::NC_STATE, "a cycle is called where the position is not known");
            return Err(finding.cure("move there in its work offset first").into());
        }
        // The work zero is mostly the surface; if the hole does not begin there, the reference height is.
        let surface = if low < 0 && top > 0 { 0 } else { top };
        let value = |count: i64| {
            let mut text = String::new();
            self.grid.word(&mut text, "", count);
            text
        };
        let lines = [
            "CYCL DEF 200 DRILLING ~".to_owned(),
            format!("    Q200={} ;SET-UP CLEARANCE ~", value(top - surface)),
            format!("    Q201={} ;DEPTH ~", value(low - surface)),
            format!("    Q206=+{number} ;FEED RATE FOR PLNGNG ~"),
            format!("    Q202={} ;PLUNGING DEPTH ~", value(surface - low)),
            "    Q210=+0 ;DWELL TIME AT TOP ~".to_owned(),
            format!("    Q203={} ;SURFACE COORDINATE ~", value(surface)),
            format!("    Q204={} ;2ND SET-UP CLEARANCE ~", value(up - surface)),
            format!("    Q211=+{} ;DWELL TIME AT DEPTH", plain(dwell)),
        ];
        let definition = lines.join("\n");
        if self.modal.pen.cycle.as_ref() != Some(&definition) {
            for line in lines {
                self.page.block(line);
            }
            self.modal.pen.cycle = Some(definition);
        }
        self.page.block("CYCL CALL".to_owned());
        for (count, exact) in [(top, reference), (low, bottom), (up, retract)] {
            self.notes.rounding = self.notes.rounding.max((self.grid.value(count) - exact).abs());
        }
        self.place.written[2] = Some(up);
        self.place.exact[2] = retract;
        Ok(true)
    }

    /// `CYCL DEF 9`.
    pub(in crate::nc::write) fn klartext_dwell(&mut self, seconds: f64) -> Result<()> {
        if seconds > LONGEST_DWELL {
            let finding = Finding::error(Code::POST_NUMBER, "a dwell is too long for this control");
            return Err(finding.value(seconds, "s").bound(LONGEST_DWELL, "s").into());
        }
        self.page.block("CYCL DEF 9.0 DWELL TIME".to_owned());
        self.page.block(format!("CYCL DEF 9.1 DWELL {}", plain(seconds)));
        Ok(())
    }
}
