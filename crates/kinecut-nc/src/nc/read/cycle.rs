//! Canned drilling cycles of the RS274/NGC family in the XY plane.
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
use crate::program::{Cycle, Path, Speed, Spindle, State, Tapping, Tcp};

use super::lex::Word;
use super::reader::{Kind, Reader, Value, take};

/// Said of the cycles whose short distance a program does not know.
const BY_PARAMETER: &str =
    "the lift of G73 and the clearance of G83 are parameters of the machine (5114, 5115): 1 mm is assumed";
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
        if self.modal.plane != Plane::Xy {
            return Err(self.place.not_understood(&here, "cycles are read in G17 only").into());
        }
        let Native::Canned(canned) = self.dialect.native else {
            return Err(self.place.not_understood(&here, "this control has no such cycles").into());
        };
        if canned.by_parameter && matches!(kind, CycleKind::Peck | CycleKind::ChipBreak) {
            self.note(BY_PARAMETER);
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
        let [x, y, z] = self.modal.position;
        // The block may say where the hole is.
        let says = |name: &str| self.modal.absolute && words.iter().any(|w| w.is(name));
        let Some(z) = z.filter(|_| (x.is_some() || says(AXES[0])) && (y.is_some() || says(AXES[1]))) else {
            self.start()?;
            return Ok(());
        };
        let unit = self.modal.length_unit;
        let lengths = |words: &mut [Word<'s>], name| take(words, name).map(|v: Value| v.value * unit);
        let (reference, bottom) = (lengths(words, "R"), lengths(words, "Z"));
        let sticky = &mut self.modal.sticky;
        let begun = *sticky.begun.get_or_insert(z);
        match (self.dialect.series, self.modal.absolute) {
            (SeriesRule::Interpreter, _) | (SeriesRule::Fanuc, true) => {
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
        let p = self.dialect.dwell_words.iter().find(|w| w.0 == "P").map_or(1.0, |w| w.1);
        sticky.dwell = take(words, "P").map(|v| v.value * p).or(sticky.dwell);
        let sticky = *sticky;
        if let CycleKind::Tap(_) = kind {
            self.plain_thread(sticky.step, sticky.dwell)?;
        }
        let lacks = |what: &str| self.lacks(&here, what);
        let (Some(reference), Some(bottom)) = (sticky.reference, sticky.bottom) else {
            return Err(lacks("a cycle needs R and Z").into());
        };
        let repeats = match take(words, self.dialect.repeats) {
            Some(word) => self.count(&word, "a number of repetitions")?,
            None => 1,
        };
        if !(1..=MOST_REPEATS).contains(&repeats) {
            return Err(self
                .lacks(&here, "the number of repetitions is out of range")
                .value(f64::from(repeats), "")
                .into());
        }
        let dwell = match (kind, sticky.dwell) {
            (CycleKind::DrillDwell, None) => return Err(lacks("this cycle needs a dwell P").into()),
            (CycleKind::DrillDwell, Some(p)) => p,
            _ => 0.0,
        };
        let step = match (kind, sticky.step) {
            (CycleKind::Peck | CycleKind::ChipBreak, None) => {
                return Err(lacks("this cycle needs a step Q").into());
            }
            (_, step) => step.unwrap_or(0.0),
        };
        let moves = [take(words, AXES[0]), take(words, AXES[1])].map(|w| w.map(|v| v.value * unit));
        let (reference, bottom) = match (self.dialect.series, self.modal.absolute) {
            (SeriesRule::Interpreter, false) => (begun + reference, begun + reference + bottom),
            (SeriesRule::Fanuc, _) | (SeriesRule::Interpreter, true) => (reference, bottom),
        };
        let retract = if self.modal.return_to_start && begun > reference { begun } else { reference };
        self.repeated.add(&REPEATS, f64::from(repeats - 1)).map_err(|e| self.place.located(&here, e))?;
        let cycle = match kind {
            CycleKind::Drill | CycleKind::DrillDwell => Cycle::Drill { reference, bottom, retract, dwell },
            CycleKind::Peck => Cycle::Peck { reference, bottom, retract, step, clearance: canned.clearance },
            CycleKind::ChipBreak => Cycle::ChipBreak { reference, bottom, retract, step, lift: canned.lift },
            CycleKind::Tap(hand) => {
                let Speed::PerRevolution(pitch) = speed else { return Ok(()) };
                Cycle::Tap(Tapping { reference, bottom, retract, pitch, hand })
            }
        };
        if !canned.runs_as_told(&cycle) {
            self.note(BEYOND);
        }
        for repetition in 0..repeats {
            let way = match self.dialect.series {
                SeriesRule::Fanuc => [reference.max(self.height()); 2],
                // The first hole is at the present height only if that is above R.
                SeriesRule::Interpreter => {
                    let rises = if begun < reference { reference } else { self.height() };
                    [rises, if repetition == 0 && rises > reference { rises } else { retract }]
                }
            };
            // In absolute coordinates this is the same hole again, as on the control.
            self.drill(cycle, moves, way, speed, spindle)?;
        }
        Ok(())
    }

    /// Height at which the tool is, where a cycle is read [mm].
    fn height(&self) -> f64 {
        self.modal.position[2].unwrap_or_default()
    }

    /// The way to a hole and the cycle: first to one height, then to the hole at another [mm].
    fn drill(
        &mut self,
        cycle: Cycle,
        moves: [Option<f64>; 2],
        [first, height]: [f64; 2],
        speed: Speed,
        spindle: Spindle,
    ) -> Result<()> {
        let [_, _, retract] = cycle.heights();
        let rapid = Speed::Rapid { linear: self.dialect.straight_rapid };
        let [mut x, mut y, z] = self.modal.position;
        if z != Some(first) {
            self.push_tip([x, y, Some(first)], Path::Line, rapid);
        }
        let go = |from: &mut Option<f64>, to: Option<f64>| {
            if let Some(to) = to {
                *from = Some(if self.modal.absolute { to } else { from.unwrap_or(0.0) + to });
            }
        };
        go(&mut x, moves[0]);
        go(&mut y, moves[1]);
        self.push_tip([x, y, Some(height)], Path::Line, rapid);
        self.flush(Kind::Tip);
        let state = State { spindle, ..self.state(speed) };
        let located = |e: crate::base::Error| e.0.at(self.place.sources.locate(self.place.span(&self.here)));
        self.program.push_cycle(cycle, &state, self.origin).map_err(located)?;
        self.modal.position[2] = Some(retract);
        Ok(())
    }
}
