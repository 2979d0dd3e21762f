//! Canned cycles of the RS274/NGC family: along the axis that is square to the plane.
//!
//! The block may say where the hole is when that was not known before.
//!
//! R, Z, Q and P stay from block to block of a series; L repeats. First Z rises to R if it is below, then X and Y,
//! then the cycle. With G98 the tool returns to the height at which the series began (or R if that is higher), with
//! G99 to R.
//!
//! Two rules differ. Under G91 R counts from where the series began and Z from R: LinuxCNC counts them anew in each block,
//! a Fanuc control keeps the heights that they were where they were given ([`SeriesRule`]). The way to a hole is at the present
//! height; LinuxCNC goes straight to that of the return where it is not above R, up or across
//! (`interp_internal.hh`, `CYCLE_MACRO`).

use crate::base::{Code, CountBound, Result};
use crate::nc::dialect::{AXES, CycleKind, Plane, SeriesRule};
use crate::nc::native::Native;
use crate::program::{Cycle, Speed, Tapping, Tcp};

use super::block::{Word, WordMode};
use super::hole::Hole;
use super::reader::{Reader, Value, take, take_way};

/// Said of the cycles whose short distance a program does not know.
const BY_PARAMETER: &str =
    "the lift of G73 and the clearance of G83 are parameters of the machine (5114, 5115): 1 mm is assumed";
/// See [`BY_PARAMETER`].
const BY_SETTING: &str = "the lift of G73 and the clearance of G83 are setting 22 of the control, with setting 52 above R: 1 mm is \
     assumed, and nothing above R";
/// Said of cycles that the control runs with small moves more.
const BEYOND: &str = "Q is smaller than the lift of the cycle, or no binary fraction that divides the hole: the control makes \
     small moves beyond R or at the bottom that are not followed";
/// Most repetitions of a block: a slip of the pen beyond it.
const MOST_REPEATS: u32 = 10_000;

/// Repetitions of all blocks of a program together: what its own lines do not bound.
const REPEATS: CountBound = CountBound {
    what: "repetitions of cycles in one program",
    most: 100_000.0,
    bytes: 2500,
    code: Code::NC_STATE,
    help: "use smaller numbers of repetitions, or several programs",
};

impl<'s> Reader<'s> {
    pub(super) fn cycle(&mut self, words: &mut [Word<'s>], kind: CycleKind) -> Result<()> {
        let here = self.here.clone();
        let [a, b, n] = self.modal.plane.axes();
        let Native::Canned(canned) = self.dialect.native else {
            return Err(self.place.not_understood(&here, "this control has no such cycles").into());
        };
        if self.dialect.starts_at_r && !self.modal.return_said {
            self.note(
                "neither G98 nor G99 before the first cycle: cycles return to R, as the interpreter begins",
            );
        }
        if canned.by_parameter && matches!(kind, CycleKind::Peck | CycleKind::ChipBreak) {
            self.note(if self.dialect.haas { BY_SETTING } else { BY_PARAMETER });
        }
        if self.modal.rotary_axes.tcp != Tcp::Off {
            return Err(self.lacks(&here, "a cycle under control of the tool centre point").into());
        }
        let mut speed = self.feed_speed()?;
        if matches!(speed, Speed::Duration(_)) {
            return Err(self.lacks(&here, "a cycle in inverse time (G93)").into());
        }
        let mut spindle = self.modal.spindle;
        if let CycleKind::Tap(hand) = kind {
            (speed, spindle) = self.geared(speed, hand)?;
        }
        self.turns_as_it_must(kind)?;
        self.cycle_is_not_scaled(matches!(kind, CycleKind::FineBore | CycleKind::BackBore))?;
        let at = self.modal.position;
        // The block may say where the hole is.
        let says = |name: &str| self.modal.absolute && words.iter().any(|w| w.is(name));
        let placed = |axis: usize| at[axis].is_some() || says(AXES[axis]);
        // From a height that is not known the tool goes to R, and with G98 back to it: the rest is known.
        let counts_from_there = |name: &str| !self.modal.absolute && words.iter().any(|w| w.is(name));
        let kept = self.dialect.series == SeriesRule::Fanuc
            && !(counts_from_there("R") || counts_from_there(AXES[n]));
        let unknown = self.modal.plane == Plane::Xy && (self.modal.absolute || kept);
        let Some(z) = at[n].or(unknown.then_some(f64::NAN)).filter(|_| placed(a) && placed(b)) else {
            self.start()?;
            return Ok(());
        };
        let unit = self.modal.length_unit;
        let lengths = |words: &mut [Word<'s>], name| take(words, name).map(|v: Value| v.value * unit);
        let (reference, bottom) = (lengths(words, "R"), lengths(words, AXES[n]));
        let p = self.dialect.dwell_words.iter().find(|w| w.0 == "P").map_or(1.0, |w| w.1);
        let said = take(words, "P").map(|v| v.value * p);
        self.last_dwell = said.or(self.last_dwell);
        self.words_of_kind(words, kind)?;
        let sticky = &mut self.modal.sticky;
        if self.dialect.series == SeriesRule::EachBlock {
            sticky.begun = Some(z);
        }
        let begun = *sticky.begun.get_or_insert(z);
        match (self.dialect.series, self.modal.absolute) {
            (SeriesRule::Interpreter | SeriesRule::EachBlock, _) | (SeriesRule::Fanuc, true) => {
                sticky.reference = reference.or(sticky.reference);
                sticky.bottom = bottom.or(sticky.bottom);
            }
            (SeriesRule::Fanuc, false) => {
                sticky.reference = reference.map(|r| begun + r).or(sticky.reference);
                let from_reference = |z| sticky.reference.map(|r: f64| r + z);
                sticky.bottom = bottom.and_then(from_reference).or(sticky.bottom);
            }
        }
        sticky.step = lengths(words, "Q").or(sticky.step);
        sticky.dwell = said.or(sticky.dwell);
        let mut sticky = *sticky;
        if let CycleKind::Tap(_) = kind {
            self.plain_thread(sticky.step, sticky.dwell)?;
        }
        if self.dialect.haas && sticky.reference.is_none() && self.last_reference.is_some() {
            sticky.reference = self.last_reference;
            let message = "a cycle without R takes the one of the cycle before";
            self.warn(&here, message);
        }
        self.last_reference = sticky.reference.or(self.last_reference);
        let (Some(reference), Some(bottom)) = (sticky.reference, sticky.bottom) else {
            return Err(self.lacks(&here, "a cycle needs R and Z").into());
        };
        let repeats = match take(words, self.dialect.repeats) {
            Some(word) => self.count(&word, "a number of repetitions")?,
            None => 1,
        };
        if repeats == 0 && self.dialect.series == SeriesRule::Fanuc {
            return self.no_hole(words);
        }
        if !(1..=MOST_REPEATS).contains(&repeats) {
            return Err(self
                .lacks(&here, "the number of repetitions is out of range")
                .value(f64::from(repeats), "")
                .into());
        }
        let dwell = match (kind, sticky.dwell) {
            (CycleKind::DrillDwell | CycleKind::BoreDwell, None)
                if self.dialect.series == SeriesRule::Fanuc =>
            {
                self.note("a cycle with a wait has no P: it does not wait");
                0.0
            }
            (CycleKind::DrillDwell | CycleKind::BoreDwell, None) => {
                return Err(self.lacks(&here, "this cycle needs a dwell P").into());
            }
            (
                CycleKind::Peck
                | CycleKind::ChipBreak
                | CycleKind::Drill
                | CycleKind::Bore
                | CycleKind::Tap(_),
                _,
            ) => 0.0,
            // LinuxCNC keeps P beyond the series for taps.
            (CycleKind::Floating(_), p) => p.or(self.last_dwell).unwrap_or(0.0),
            (_, p) => p.unwrap_or(0.0),
        };
        let step = match (kind, sticky.step) {
            (CycleKind::Peck | CycleKind::ChipBreak, None) if sticky.pecks.is_none() => {
                return Err(self.lacks(&here, "this cycle needs a step Q").into());
            }
            (_, step) => step.unwrap_or(0.0),
        };
        let moves = [a, b].map(|axis| {
            let (word, way) = take_way(words, AXES[axis])?;
            Some((word.value * unit, way == WordMode::Absolute || self.modal.absolute))
        });
        let (reference, bottom) = match (self.dialect.series, self.modal.absolute) {
            (SeriesRule::Interpreter | SeriesRule::EachBlock, false) => {
                (begun + reference, begun + reference + bottom)
            }
            _ => (reference, bottom),
        };
        // Back boring goes up, which is checked with its step aside.
        if bottom > reference && kind != CycleKind::BackBore {
            let message = "a cycle must have its bottom below the reference height";
            let finding = self.lacks(&here, message).value_mm(bottom).bound_mm(reference);
            return Err(finding.help("R is above Z").into());
        }
        // A height that is not known stays so.
        let higher = begun > reference || begun.is_nan();
        let retract = if self.modal.return_to_start && higher { begun } else { reference };
        if retract.is_nan() {
            let message = "a cycle returns to a height that the program has not set: the ways between its holes are not followed";
            self.doubt(&here, message, "move Z to a height before the cycle");
        }
        self.repeated.add(&REPEATS, f64::from(repeats - 1)).map_err(|e| self.place.located(&here, e))?;
        let cycle = match kind {
            CycleKind::Drill | CycleKind::DrillDwell => Cycle::Drill { reference, bottom, retract, dwell },
            CycleKind::Bore
            | CycleKind::BoreStop
            | CycleKind::BoreDwell
            | CycleKind::Floating(_)
            | CycleKind::FineBore
            | CycleKind::BackBore
            | CycleKind::LeftByHand => Cycle::Drill { reference, bottom, retract, dwell },
            CycleKind::Peck => Cycle::Peck { reference, bottom, retract, step, clearance: canned.clearance },
            CycleKind::ChipBreak => Cycle::ChipBreak { reference, bottom, retract, step, lift: canned.lift },
            CycleKind::Tap(hand) => {
                let Speed::PerRevolution(pitch) = speed else { return Ok(()) };
                Cycle::Tap(Tapping { reference, bottom, retract, pitch, hand })
            }
        };
        let cycle = self.own_steps(cycle, &sticky);
        let shift = self.shift_of(kind, &sticky)?;
        if !canned.runs_as_told(&cycle) {
            self.note(BEYOND);
        }
        for repetition in 0..repeats {
            let way = match self.dialect.series {
                _ if self.modal.position[n].is_none() => [f64::NAN; 2],
                SeriesRule::Fanuc | SeriesRule::EachBlock => [reference.max(self.height()); 2],
                // The first hole is at the present height only if that is above R.
                SeriesRule::Interpreter => {
                    let rises = if begun < reference { reference } else { self.height() };
                    [rises, if repetition == 0 && rises > reference { rises } else { retract }]
                }
            };
            // In absolute coordinates this is the same hole again, as on the control.
            self.drill(&Hole { kind, cycle, moves, way, speed, spindle, dwell, shift })?;
        }
        Ok(())
    }

    /// A block with no repetitions: its words are kept for the next, and it makes no hole.
    fn no_hole(&mut self, words: &mut [Word<'s>]) -> Result<()> {
        let [a, b, _] = self.modal.plane.axes();
        for axis in [a, b] {
            if let Some((word, _)) = take_way(words, AXES[axis]) {
                let finding =
                    self.lacks(&word.bytes, "whether a cycle with no repetitions moves to its place");
                return Err(finding.help("move there before").into());
            }
        }
        Ok(())
    }
}
