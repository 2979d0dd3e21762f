//! Words of the modal state: only what changes, in the order of the control's table.

use std::f64::consts::TAU;

use crate::base::{Code, Finding, Result};
use crate::nc::dialect::{Plane, StateWord};
use crate::nc::grid::plain;
use crate::program::{Blend, Comp, Coolant, SetupId, Speed, Spindle, State, WorkOffset};

use super::turn::Turn;
use super::{Writer, unsupported};

/// State that was written to the control; `None` if the next block must write it.
#[derive(Clone, Debug, Default)]
pub(super) struct Modal {
    pub(super) motion: Option<&'static str>,
    pub(super) plane: Option<Plane>,
    feed_mode: Option<&'static str>,
    feed: Option<String>,
    blend: Option<Blend>,
    pub(super) offset: Option<WorkOffset>,
    pub(super) spindle: Option<Spindle>,
    pub(super) coolant: Option<Coolant>,
    /// Cutter compensation in force; `None` is off.
    pub(super) comp: Option<Comp>,
    /// Its words for the next block of motion.
    pub(super) comp_word: Option<String>,
    /// Whether feeds under compensation have been said to be those of the centre.
    pub(super) centre_feed: bool,
    /// The frame in which the position is known.
    pub(super) placed_in: Option<(WorkOffset, Turn)>,
    /// Shift and turn in force.
    pub(super) turn: Turn,
    /// The clamping that each offset belongs to.
    pub(super) owners: Vec<(WorkOffset, SetupId)>,
    /// Series of canned cycles in force, and the words of the rapid move to its next hole.
    pub(super) series: Option<super::series::Series>,
    pub(super) hole: Option<String>,
    /// Rotary axes, tilted plane and control of the tip.
    pub(super) rotary_axes: super::rotary_axes::RotaryAxes,
    /// State of klartext alone.
    pub(super) pen: super::klartext::Pen,
}

impl Modal {
    /// After the blocks at the head of the program.
    pub(super) fn start(&mut self) {
        self.plane = Some(Plane::Xy);
        self.feed_mode = Some("G94");
    }

    /// After a tool change: a restart point, where every word is said again. The plane was not touched; spindle
    /// and coolant are off.
    pub(super) fn forget(&mut self) {
        *self = Modal {
            plane: self.plane,
            feed_mode: self.feed_mode,
            blend: self.blend,
            placed_in: self.placed_in,
            owners: std::mem::take(&mut self.owners),
            spindle: Some(Spindle::Off),
            coolant: Some(Coolant::Off),
            rotary_axes: self.rotary_axes.after_tool(),
            ..Modal::default()
        };
    }
}

impl Writer<'_> {
    /// Writes what differs from the state of an item; the work offset only for moves in its coordinates.
    pub(super) fn state(&mut self, state: &State, in_work: bool) -> Result<()> {
        if self.klartext() {
            return self.klartext_state(state, in_work);
        }
        if in_work {
            self.rotary_axes_for(state)?;
        }
        for word in self.dialect.order {
            let block = match word {
                StateWord::Blend => self.blend(state.blend)?,
                StateWord::WorkOffset => {
                    if in_work {
                        self.frame(state)?;
                    }
                    None
                }
                StateWord::Spindle => self.spindle(state.spindle)?,
                StateWord::Coolant => self.coolant(state.coolant)?,
            };
            if let Some(block) = block {
                self.page.block(block);
            }
        }
        Ok(())
    }

    fn blend(&mut self, blend: Blend) -> Result<Option<String>> {
        let blend = self.dialect.blend(blend);
        if self.modal.blend == Some(blend) {
            return Ok(None);
        }
        self.modal.blend = Some(blend);
        Ok(Some(match blend {
            Blend::Stop => self.dialect.exact_stop.to_owned(),
            Blend::Exact => self.dialect.exact_path.unwrap_or(self.dialect.exact_stop).to_owned(),
            Blend::Continuous => self.dialect.continuous.to_owned(),
            Blend::Tolerance { path, merge, .. } => {
                if !(path.is_finite() && path >= 0.0 && merge.is_finite() && merge >= 0.0) {
                    return Err(Finding::error(
                        Code::POST_NUMBER,
                        "the tolerance of a continuous path is not usable",
                    )
                    .value_mm(path + merge)
                    .into());
                }
                let Some([before, after]) = self.dialect.rounded else {
                    return Err(unsupported("this control has no tolerance of a continuous path").into());
                };
                let merge = if self.dialect.merges { self.grid.length(merge) } else { String::new() };
                format!("{before}{}{after}{merge}", self.grid.length(path))
            }
        }))
    }

    pub(super) fn spindle(&mut self, spindle: Spindle) -> Result<Option<String>> {
        if self.modal.spindle == Some(spindle) {
            return Ok(None);
        }
        let before = self.modal.spindle.replace(spindle);
        let (rate, word) = match spindle {
            Spindle::Off if before.is_none() => return Ok(None),
            Spindle::Off => return Ok(Some("M5".to_owned())),
            Spindle::Clockwise(rate) => (rate, "M3"),
            Spindle::CounterClockwise(rate) => (rate, "M4"),
        };
        let rpm = rate / TAU * 60.0;
        if !(rpm.is_finite() && rpm >= 0.0) {
            return Err(Finding::error(Code::POST_NUMBER, "a spindle speed is not usable")
                .value(rpm, "rev/min")
                .into());
        }
        Ok(Some(format!("S{} {word}", plain(rpm))))
    }

    pub(super) fn coolant(&mut self, coolant: Coolant) -> Result<Option<String>> {
        if self.modal.coolant == Some(coolant) {
            return Ok(None);
        }
        let title = self.settings.control.title();
        if matches!(coolant, Coolant::Mist | Coolant::Both) && !self.dialect.mist {
            return Err(unsupported(format!("{title} has no mist (M7)")).help("use flood, or none").into());
        }
        if coolant == Coolant::Both && !self.dialect.both_coolants {
            let what =
                format!("whether {title} has mist and flood on together (M7, M8) is up to the machine");
            return Err(unsupported(what).help("use one of them").into());
        }
        let before = self.modal.coolant.replace(coolant);
        let word = match coolant {
            Coolant::Off if before.is_none() => return Ok(None),
            Coolant::Off => "M9",
            // The two do not replace each other on every control.
            Coolant::Mist if matches!(before, Some(Coolant::Flood | Coolant::Both)) => "M9\nM7",
            Coolant::Flood if matches!(before, Some(Coolant::Mist | Coolant::Both)) => "M9\nM8",
            Coolant::Both if before == Some(Coolant::Flood) => "M7",
            Coolant::Both if before == Some(Coolant::Mist) => "M8",
            Coolant::Both => "M7\nM8",
            Coolant::Mist => "M7",
            Coolant::Flood => "M8",
        };
        if let Some((off, on)) = word.split_once('\n') {
            self.page.block(off.to_owned());
            return Ok(Some(on.to_owned()));
        }
        Ok(Some(word.to_owned()))
    }

    /// Unit of a written feed per minute [mm/min]: on HEIDENHAIN tenths of an inch, for its resolution.
    pub(super) fn feed_unit(&self) -> f64 {
        let units = self.settings.units;
        if units.is_inch() && self.klartext() { 0.1 * units.mm() } else { units.mm() }
    }

    /// The feed word of a block, and the word of its mode when that changes.
    pub(super) fn feed_words(&mut self, speed: Speed) -> Result<(Option<&'static str>, Option<String>)> {
        let (mode, value, unit) = match speed {
            Speed::Rapid { .. } => return Ok((None, None)),
            Speed::PerMinute(feed) => ("G94", feed * 60.0, "mm/min"),
            Speed::PerRevolution(feed) => ("G95", feed, "mm/rev"),
            Speed::Duration(seconds) => ("G93", 60.0 / seconds, "1/min"),
        };
        if matches!(speed, Speed::PerRevolution(_)) && !self.dialect.per_revolution {
            let title = self.settings.control.title();
            let finding = unsupported(format!("{title} has no feed per revolution"));
            return Err(finding.help("give the feed per minute").into());
        }
        let mut word = match speed {
            Speed::PerMinute(_) => plain(value / self.feed_unit()),
            Speed::PerRevolution(_) => self.grid.length(value),
            _ => plain(value),
        };
        if self.dialect.point && !word.contains('.') {
            word.push('.');
        }
        if !(value.is_finite() && value > 0.0) || word.trim_end_matches('.') == "0" {
            return Err(Finding::error(Code::NC_STATE, "a feed move has no usable feed")
                .value(value, unit)
                .into());
        }
        let change = (self.modal.feed_mode != Some(mode)).then_some(mode);
        if change.is_some() {
            self.modal.feed_mode = Some(mode);
            self.modal.feed = None;
        }
        // Inverse time is not modal: it is said in each block.
        if mode != "G93" && self.modal.feed.as_ref() == Some(&word) {
            return Ok((change, None));
        }
        self.modal.feed = Some(word.clone());
        Ok((change, Some(word)))
    }
}
