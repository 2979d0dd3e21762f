//! State and dwells in klartext: `CYCL DEF 32`, `247` and `9`.

use crate::base::{Code, Finding, Result};
use crate::nc::dialect::AXES;
use crate::nc::grid::plain;
use crate::nc::heidenhain::{LONGEST_DWELL, preset};
use crate::nc::write::{Writer, unsupported};
use crate::program::{Blend, Comp, State, Tcp, WorkOffset};

impl Writer<'_> {
    /// Changes of the state.
    pub(in crate::nc::write) fn klartext_state(&mut self, state: &State, in_work: bool) -> Result<()> {
        self.modal.pen.wanted = Some(match state.comp {
            Comp::Off => "R0",
            Comp::Left(_) => "RL",
            Comp::Right(_) => "RR",
        });
        self.path_tolerance(state.blend)?;
        if in_work {
            if state.tcp != Tcp::Off && self.program.in_tilted(state.frame).is_some() {
                return Err(unsupported(
                    "control of the tool centre point within a tilted plane is not written",
                )
                .help("give the points in the work offset")
                .into());
            }
            if !self.stays_in_frame(state)? {
                self.klartext_tcp_off();
            }
            self.frame(state)?;
            self.klartext_tcp(state.tcp)?;
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

    /// `CYCL DEF 247`.
    pub(in crate::nc::write) fn klartext_preset(&mut self, offset: WorkOffset) {
        // The offsets of this control were asked for by the caller.
        let number = preset(offset).unwrap_or(0);
        self.page.block("CYCL DEF 247 DATUM SETTING ~".to_owned());
        self.page.line(format!("    Q339=+{number} ;DATUM NUMBER"));
        self.modal.pen.forget_place();
    }

    /// `CYCL DEF 7`; `shift` in steps.
    pub(in crate::nc::write) fn klartext_shift(&mut self, shift: [i64; 3]) {
        self.page.block("CYCL DEF 7.0 DATUM SHIFT".to_owned());
        for (axis, count) in shift.into_iter().enumerate() {
            let mut word = String::new();
            self.grid.word(&mut word, AXES[axis], count);
            self.page.block(format!("CYCL DEF 7.{} {word}", axis + 1));
        }
    }

    /// `CYCL DEF 10`; `word` with its angle.
    pub(in crate::nc::write) fn klartext_rotation(&mut self, word: &str) {
        self.page.block("CYCL DEF 10.0 ROTATION".to_owned());
        self.page.block(format!("CYCL DEF 10.1 {word}"));
    }

    /// `CYCL DEF 32`; an exact stop is refused where it would matter, in a feed move.
    fn path_tolerance(&mut self, blend: Blend) -> Result<()> {
        let blend = self.dialect.blend(blend);
        self.modal.pen.stop = matches!(blend, Blend::Stop | Blend::Exact);
        if self.modal.pen.stop || self.modal.pen.blend == Some(blend) {
            return Ok(());
        }
        self.modal.pen.blend = Some(blend);
        let value = match blend {
            Blend::Tolerance { path, .. } if path.is_finite() && path > 0.0 => {
                format!(" T{}", self.grid.length(path))
            }
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
