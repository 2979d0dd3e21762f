//! Threads of LinuxCNC with the feed geared to the spindle: `G33`, a straight move, and `G76`, the passes of a thread along Z.
//!
//! `G76 P Z I J R K Q H E L` begins at the drive line X, Y, Z where the tool is. P is the pitch, Z the end; the crest of the thread
//! lies I beside the drive line (negative: outside of the part), J is the depth of the first pass below the crest, K the whole
//! depth. The depth of pass n is `J n^(1/R)`; the last is K deep, and is run H times more. A pass begins
//! `(depth - |I|) tan Q` nearer to the end, for a tool that is fed along its flank. E is the length of a taper where L says so: 1 at the
//! begin, 2 at the end, 3 at both; along it the pitch is that of its slope. The tool comes back in rapid, outside of the crest by what the
//! pass lacks of the whole depth.
//!
//! `G7` and `G8`: X is a diameter, or a radius again; with `G76` also I, J and K.
//!
//! Source: G-code reference of LinuxCNC 2.9; its interpreter, `convert_threading_cycle`, run beside this.

use crate::base::Result;
use crate::nc::dialect::{AXES, Code};
use crate::program::{Comp, Path, Speed, Spindle};

use super::block::Word;
use super::reader::{Reader, take};

/// Said of a move that is geared to the spindle.
const GEARED: &str = "a thread (G33, G76) is read as a feed per revolution, and the post writes that: its passes then do not meet the same thread";
/// Most passes of a thread: a slip of the pen beyond it.
const MOST_PASSES: usize = 10_000;

/// A thread of `G76`, lengths in mm, angle in radians.
struct Thread {
    pitch: f64,
    /// From the drive line to the crest; positive inside of a bore.
    crest: f64,
    first: f64,
    whole: f64,
    degression: f64,
    flank: f64,
    springs: usize,
    taper: f64,
    /// Whether it has a taper at the begin, and at the end.
    tapers: [bool; 2],
}

impl Thread {
    /// Depths of the passes from the drive line, or `None` where they are too many.
    fn depths(&self) -> Option<Vec<f64>> {
        let crest = self.crest.abs();
        let end = crest + self.whole;
        let mut depths = Vec::new();
        for pass in 1..=MOST_PASSES {
            let depth = crest + self.first * (pass as f64).powf(1.0 / self.degression);
            if depth >= end {
                depths.resize(depths.len() + self.springs + 1, end);
                return Some(depths);
            }
            depths.push(depth);
        }
        None
    }
}

impl<'s> Reader<'s> {
    /// Words of X that are diameters become radii. The mode is that behind the codes of the block.
    pub(super) fn diameters(&mut self, words: &mut [Word<'s>]) {
        if let Some((Code::Diameters(on), bytes)) = self.code(|c| matches!(c, Code::Diameters(_))) {
            if self.modal.diameters != on && self.motion_code().is_some_and(|(code, _)| code == Code::Thread)
            {
                // The interpreter scales them where the mode changes, and again in the cycle.
                let heights = words.iter_mut().filter(|w| ["I", "J", "K"].iter().any(|name| w.is(name)));
                heights.filter_map(|w| w.value.as_mut()).for_each(|v| *v *= if on { 0.5 } else { 2.0 });
                let message = "I, J and K of a thread (G76) are scaled twice where G7 or G8 is in its block";
                self.warn(&bytes, message);
            }
            self.modal.diameters = on;
        }
        if self.modal.diameters {
            let x = words.iter_mut().filter(|w| w.is(AXES[0]));
            x.filter_map(|w| w.value.as_mut()).for_each(|value| *value /= 2.0);
        }
    }

    fn turns_for(&mut self, what: &str) -> Result<()> {
        match self.modal.spindle {
            Spindle::Clockwise(rate) | Spindle::CounterClockwise(rate) if rate > 0.0 => Ok(()),
            _ => {
                let message = format!("{what} while the spindle does not turn");
                Err(self.lacks(&self.here, &message).help("program S and M3 before it").into())
            }
        }
    }

    /// `G33`.
    pub(super) fn geared_move(&mut self, words: &mut [Word<'s>]) -> Result<()> {
        let here = self.here.clone();
        self.turns_for("G33")?;
        let Some(pitch) = take(words, "K") else {
            return Err(self.lacks(&here, "G33 without its pitch K").into());
        };
        let pitch = self.pitch(&pitch)?;
        if let Some(feed) = words.iter().find(|w| w.is("F")) {
            let finding = self.lacks(&feed.bytes, "G33 with a feed F");
            return Err(finding.help("leave F out: K is the way a revolution").into());
        }
        self.warn(&here, GEARED);
        self.straight(words, Speed::PerRevolution(pitch))
    }

    fn pitch(&self, said: &super::reader::Value) -> Result<f64> {
        if said.value <= 0.0 {
            return Err(self.place.malformed(&said.bytes, "the pitch of a thread is positive").into());
        }
        Ok(said.value * self.modal.length_unit)
    }

    /// `G76` of LinuxCNC.
    pub(super) fn thread(&mut self, words: &mut [Word<'s>]) -> Result<()> {
        let here = self.here.clone();
        self.turns_for("G76")?;
        if self.modal.comp != Comp::Off {
            let finding = self.lacks(&here, "a thread (G76) under cutter compensation");
            return Err(finding.help("program G40 before it").into());
        }
        let from = self.start()?;
        let thread = self.thread_words(words)?;
        let [Some(end_x), Some(end_y), Some(end_z)] = self.end(words)? else {
            return Err(self.lacks(&here, "a thread (G76) to a place that the program has not set").into());
        };
        let Some(depths) = thread.depths() else {
            let finding = self.lacks(&here, &format!("a thread (G76) in more than {MOST_PASSES} passes"));
            return Err(finding.help("program a larger J, or a smaller R").into());
        };
        self.warn(&here, GEARED);
        let onward = end_z > from.z;
        let sign = |v: f64| if onward { -v } else { v };
        let (slope, taper) = (sign(thread.flank).tan(), sign(thread.taper));
        let last = thread.crest.abs() + thread.whole;
        let height = |depth: f64| (depth - thread.crest.abs()) * slope;
        let target = end_z + height(last);
        let x = |out: f64| if thread.crest > 0.0 { from.x + out } else { from.x - out };
        let at = |out: f64, z: f64| [Some(x(out)), Some(from.y), Some(z)];
        let rapid = Speed::Rapid { linear: self.dialect.straight_rapid };
        let feed = Speed::PerRevolution(thread.pitch);
        let along = Speed::PerRevolution(
            thread.pitch * taper.hypot(thread.whole) / taper.abs().max(f64::MIN_POSITIVE),
        );
        let tapers = thread.tapers.map(|t| t && taper != 0.0);
        for depth in depths {
            let (begin, end) = (from.z - height(depth), target - height(depth));
            let (back, crest) = (depth - last, depth - thread.whole);
            self.push_tip(at(back, begin), Path::Line, rapid);
            if tapers[0] {
                self.push_tip(at(crest, begin), Path::Line, along);
                self.push_tip(at(depth, begin - taper), Path::Line, along);
            } else {
                self.push_tip(at(depth, begin), Path::Line, rapid);
            }
            if tapers[1] {
                self.push_tip(at(depth, end + taper), Path::Line, feed);
                self.push_tip(at(crest, end), Path::Line, along);
            } else {
                self.push_tip(at(depth, end), Path::Line, feed);
            }
            self.push_tip(at(back, end), Path::Line, rapid);
        }
        self.push_tip([Some(end_x), Some(end_y), Some(end_z)], Path::Line, rapid);
        Ok(())
    }

    fn thread_words(&mut self, words: &mut [Word<'s>]) -> Result<Thread> {
        let here = self.here.clone();
        let unit = self.modal.length_unit;
        let across = if self.modal.diameters { unit / 2.0 } else { unit };
        let mut needed = |name: &str| {
            take(words, name).ok_or_else(|| self.lacks(&here, &format!("a thread (G76) without {name}")))
        };
        let [pitch, crest, first, whole] = [needed("P")?, needed("I")?, needed("J")?, needed("K")?];
        let pitch = self.pitch(&pitch)?;
        if crest.value == 0.0 {
            let why =
                "I of a thread (G76) is not zero: negative for an outside thread, positive for an inside one";
            return Err(self.place.malformed(&crest.bytes, why).into());
        }
        if first.value <= 0.0 {
            return Err(self.place.malformed(&first.bytes, "J of a thread (G76) is positive").into());
        }
        if whole.value <= first.value {
            return Err(self.place.malformed(&whole.bytes, "K of a thread (G76) is larger than J").into());
        }
        let mut flank = 0.0;
        if let Some(q) = take(words, "Q").filter(|q| q.value != -1.0) {
            if q.value.abs() >= 90.0 {
                return Err(self
                    .place
                    .malformed(&q.bytes, "the angle of a flank is below 90 degrees")
                    .into());
            }
            flank = q.value.to_radians();
        }
        let springs = match take(words, "H") {
            Some(h) => self.count(&h, "a number of further passes")? as usize,
            None => 0,
        };
        if springs > MOST_PASSES {
            let why = format!("a thread (G76) in more than {MOST_PASSES} passes");
            return Err(self.lacks(&here, &why).help("program a smaller H").into());
        }
        let sides = match take(words, "L") {
            Some(l) => self.count(&l, "the sides of a taper")?,
            None => 0,
        };
        Ok(Thread {
            pitch,
            crest: crest.value * across,
            first: first.value * across,
            whole: whole.value * across,
            degression: take(words, "R").map_or(1.0, |r| r.value.max(1.0)),
            flank,
            springs,
            taper: take(words, "E").map_or(0.0, |e| e.value.max(0.0) * unit),
            tapers: [sides & 1 != 0, sides & 2 != 0],
        })
    }
}
