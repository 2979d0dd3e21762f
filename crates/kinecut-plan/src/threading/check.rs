//! Whether a thread can be milled with a tool.

use super::thread::shown;
use super::{Thread, ThreadMillSpec, ThreadSide, coarse_pitch};
use crate::base::{Code, CountBound, Finding, Result};

/// Diameter by which the tool is at least smaller than the hole [mm].
const PASSES: f64 = 0.2;
/// Largest share of a thread's diameter that a tool should have: coarse and fine threads.
const LARGEST: [f64; 2] = [0.7, 0.8];
/// Difference of two pitches [mm] and angles [rad] that is rounding.
const SAME: f64 = 1e-6;

/// Turns of a thread.
const TURNS: CountBound = CountBound {
    what: "turns of a thread",
    most: 10_000.0,
    bytes: 1000,
    code: Code::PLAN_VALUE,
    help: "use a larger pitch, or less depth",
};

/// Moves of all helices of all places, turns by themselves: each turn is compared at 64 points.
const MOVES: CountBound = CountBound {
    what: "moves and turns of milled threads",
    most: 1e6,
    bytes: 2000,
    code: Code::PLAN_VALUE,
    help: "mill fewer threads in one operation, or with fewer passes",
};

/// Way by which a major diameter below nominal is said [mm].
const SHORT: f64 = 0.02;

/// Radial passes, with spring passes.
const MOST_PASSES: usize = 20;

impl ThreadMillSpec {
    /// Checks the thread, the tool and the passes; the radii of the path at the bottom and at the mouth [mm].
    ///
    /// # Errors
    /// `KC0404` for values that make no thread, `KC0412` for a tool that does not fit it.
    pub(super) fn check(&self) -> Result<[f64; 2]> {
        self.check_numbers()?;
        self.check_teeth()?;
        self.check_bore()?;
        let (Some(low), Some(high)) = (self.centre_radius(self.depth), self.centre_radius(0.0)) else {
            return Err(self.too_steep());
        };
        for (radius, depth) in [(low, self.depth), (high, 0.0)] {
            // Beyond its crest the tool has no flank.
            let contact = self.flank().contact(radius, self.pitch_radius(depth));
            if contact.is_none_or(|c| c > self.thread.crest_height(self.side)) {
                return Err(self.too_steep());
            }
        }
        let slack = match self.side {
            ThreadSide::Inside => (1.0 - self.infeed[0]) * self.thread.height(self.side),
            ThreadSide::Outside => 0.0,
        };
        let least = if low < high { low } else { high };
        if least - slack <= SAME {
            return Err(refused(
                "the first pass is so shallow that the tool does not cut",
                self.infeed[0],
                1.0,
            )
            .help("begin with a larger share")
            .key("infeed[0]")
            .into());
        }
        self.check_engagement(low)?;
        super::neck::check(self, [low, high])?;
        MOVES.check(self.move_count()).map_err(|e| e.under("points"))?;
        Ok([low, high])
    }

    /// Whether each pass of a cylindrical thread reaches the wall of its core hole, or its boss; `full`: radius of the path at full
    /// depth.
    fn check_engagement(&self, full: f64) -> Result<()> {
        if self.thread.taper > 0.0 {
            return Ok(());
        }
        let tool = 0.5 * self.cutter.mill.diameter;
        let deep = match self.side {
            ThreadSide::Inside => full + tool - 0.5 * self.thread.minor_diameter(),
            ThreadSide::Outside => 0.5 * self.thread.diameter - (full - tool),
        };
        if !(deep > 0.0) {
            return Err(self.too_steep());
        }
        let least = 1.0 - deep / self.thread.height(self.side);
        let Some(i) = self.infeed.iter().position(|share| *share <= least) else { return Ok(()) };
        let what = match self.side {
            ThreadSide::Inside => "a radial pass does not reach the wall of the hole",
            ThreadSide::Outside => "a radial pass does not reach the boss",
        };
        let what = format!("{what}: the correction for the overcut of the flanks takes it back");
        let finding = Finding::error(Code::PLAN_VALUE, what).value(self.infeed[i], "of the depth");
        Err(finding
            .bound(least, "of the depth")
            .help(format!("write more than {}", shown((least * 1e3).ceil() / 1e3)))
            .key(format!("infeed[{i}]"))
            .into())
    }

    /// Moves of all threads, about; of a helix its turns, on a cone its quarters of a turn.
    fn move_count(&self) -> f64 {
        /// Moves to a helix and away from it.
        const WAYS: f64 = 8.0;
        let pieces = if self.thread.taper > 0.0 { 4.0 } else { 1.0 } * self.turns().ceil();
        let passes = self.infeed.len() + self.spring_passes as usize;
        self.places.len() as f64 * passes as f64 * self.steps().len() as f64 * (WAYS + pieces)
    }

    fn check_numbers(&self) -> Result<()> {
        let Thread { diameter, pitch, taper, .. } = self.thread;
        let positive = |key: &str, what: &str, value: f64| match value.is_finite() && value > 0.0 {
            true => Ok(()),
            false => Err(refused(&format!("{what} must be positive"), value, 0.0).key(key)),
        };
        positive("diameter", "the diameter of a thread", diameter)?;
        positive("pitch", "the pitch of a thread", pitch)?;
        positive("depth", "the depth of a thread", self.depth)?;
        positive("feed", "the feed", self.feed)?;
        if !(self.thread.root_diameter() > 0.5 * diameter) {
            let most = 0.5 * diameter / (diameter - self.thread.root_diameter()) * pitch;
            let finding = refused("the pitch is too large for this diameter", pitch, most);
            return Err(finding.key("pitch").into());
        }
        if !(self.oversize.abs() <= 0.5 * pitch) {
            return Err(refused("the oversize is no tolerance of this thread", self.oversize, 0.5 * pitch)
                .key("oversize")
                .into());
        }
        if !(0.0..=0.25).contains(&taper) {
            let finding = Finding::error(Code::PLAN_VALUE, "the taper is out of range").value(taper, "");
            return Err(finding.bound(0.25, "").help("write 16 for 1 in 16").key("taper").into());
        }
        TURNS.check(self.depth / pitch).map_err(|e| e.under("depth"))?;
        self.check_passes()
    }

    fn check_passes(&self) -> Result<()> {
        let passes = self.infeed.len() + self.spring_passes as usize;
        if self.infeed.is_empty() || passes > MOST_PASSES {
            let finding = Finding::error(Code::PLAN_VALUE, "the number of passes is out of range");
            let finding = finding.value(passes as f64, "").bound(MOST_PASSES as f64, "");
            return Err(finding.help("write shares of the depth: infeed = [0.7, 1.0]").key("infeed").into());
        }
        let mut last = 0.0;
        for (i, share) in self.infeed.iter().enumerate() {
            if !(*share > last && *share <= 1.0) {
                let finding =
                    Finding::error(Code::PLAN_VALUE, "a radial pass is not deeper than the one before");
                let finding = finding.value(*share, "of the depth").bound(last, "of the depth");
                return Err(finding
                    .help("write ascending shares of the thread's depth up to 1: infeed = [0.7, 1.0]")
                    .key(format!("infeed[{i}]"))
                    .into());
            }
            last = *share;
        }
        if last < 1.0 {
            let finding =
                Finding::error(Code::PLAN_VALUE, "the last radial pass does not cut the full depth");
            let finding = finding.value(last, "of the depth").bound(1.0, "of the depth");
            return Err(finding
                .help("end with 1.0")
                .key(format!("infeed[{}]", self.infeed.len() - 1))
                .into());
        }
        Ok(())
    }

    /// Whether pitch, angle and rows of the tool are those of the thread.
    fn check_teeth(&self) -> Result<()> {
        let mill = &self.cutter.mill;
        let wrong = |what: String, value: f64, bound: f64, unit: &str, help: &str| {
            let finding = Finding::error(Code::THREAD_TOOL, what).value(value, unit).bound(bound, unit);
            Err(finding.help(help).key("tool").into())
        };
        if (mill.pitch - self.thread.pitch).abs() > SAME {
            let what = format!(
                "the teeth have a pitch of {}, the thread {}",
                shown(mill.pitch),
                shown(self.thread.pitch)
            );
            return wrong(what, mill.pitch, self.thread.pitch, "mm", "take the thread mill of this pitch");
        }
        let half_angle = self.thread.form.half_angle();
        if (mill.half_angle - half_angle).abs() > SAME {
            let [own, wanted] = [mill.half_angle, half_angle].map(f64::to_degrees);
            let what = format!(
                "the flanks of the teeth lean by {} degrees, those of the thread by {}",
                shown(own),
                shown(wanted)
            );
            return wrong(
                what,
                own,
                wanted,
                "deg",
                "take the thread mill of this profile, or say the form of the thread",
            );
        }
        if self.thread.taper > 0.0 && mill.rows > 1 {
            let what = "a taper thread is milled with a single row of teeth".to_owned();
            return wrong(what, f64::from(mill.rows), 1.0, "rows", "take a thread mill with rows = 1");
        }
        let least = 2.0 * self.thread.height(self.side);
        if mill.diameter <= least {
            let what = "the tool is thinner than its own teeth are high".to_owned();
            return wrong(what, mill.diameter, least, "mm", "correct its diameter or its pitch");
        }
        Ok(())
    }

    /// Whether the tool passes the hole.
    fn check_bore(&self) -> Result<()> {
        if self.side == ThreadSide::Outside {
            return Ok(());
        }
        let narrowest = self.thread.minor_diameter() + 2.0 * self.thread.widening(self.side, self.depth);
        let (diameter, most) = (self.cutter.mill.diameter, narrowest - PASSES);
        if diameter < most {
            return Ok(());
        }
        let message = format!(
            "the thread mill of {} does not pass the hole of {}: {}",
            shown(diameter),
            shown(narrowest),
            self.thread.name()
        );
        let help = if most > 0.0 { format!("take one below {}", shown(most)) } else { "tap it".to_owned() };
        Err(Finding::error(Code::THREAD_TOOL, message)
            .value_mm(diameter)
            .bound_mm(most)
            .help(help)
            .key("tool")
            .into())
    }

    fn too_steep(&self) -> crate::base::Error {
        let message = format!(
            "the thread mill of {} runs on so small a helix that it cuts away the flanks of {}",
            shown(self.cutter.mill.diameter),
            self.thread.name()
        );
        let finding = Finding::error(Code::THREAD_TOOL, message).value_mm(self.cutter.mill.diameter);
        let most = LARGEST[0] * self.thread.diameter;
        finding.bound_mm(most).help(format!("take {} or less", shown(most))).key("tool").into()
    }

    /// A warning about a tool so large that its flanks overcut much, by `gain` radially, or a note about the major diameter alone,
    /// which is `short` of the nominal one [mm].
    pub(super) fn overcut(&self, gain: f64, short: f64) -> Option<Finding> {
        let (tool, thread) = (self.cutter.mill.diameter, &self.thread);
        let fine = coarse_pitch(thread.diameter).is_some_and(|coarse| thread.pitch < coarse - SAME);
        let most = LARGEST[usize::from(fine)] * thread.diameter;
        let standard = self.cutter.profile == super::MillProfile::Standard;
        if self.side == ThreadSide::Outside || !standard {
            return None;
        }
        let pair = format!("thread mill {} for {}", shown(tool), thread.name());
        if tool > most + SAME {
            let major = if short > 0.0 {
                format!(", and the major diameter is {short:.3} mm too small")
            } else {
                String::new()
            };
            let message = format!(
                "{pair} overcuts the flanks by {gain:.3} radially: the path is corrected for it, the form of the flanks is not{major}"
            );
            let help = format!("take {} or less, or say profile = \"corrected\"", shown(most));
            let finding = Finding::warning(Code::THREAD_OVERCUT, message);
            return Some(finding.value_mm(tool).bound_mm(most).help(help).key("tool"));
        }
        (short > SHORT).then(|| {
            let message = format!(
                "{pair}: the major diameter is {short:.3} mm below nominal, since the path is corrected for the overcut of the flanks"
            );
            let help = "gauge it; a smaller cutter leaves less, one whose maker corrected the profile for this thread nothing";
            Finding::note(Code::THREAD_OVERCUT, message).value_mm(short).bound_mm(SHORT).help(help).key("tool")
        })
    }
}

fn refused(what: &str, value: f64, bound: f64) -> Finding {
    Finding::error(Code::PLAN_VALUE, what).value_mm(value).bound_mm(bound)
}
