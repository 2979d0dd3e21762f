//! Round pockets of a Haas: `G12` with the clock, `G13` against it.
//!
//! `G12 I K Q Z L D F` about the present place, or X and Y of the block: down at the feed to Z in the centre, and a circle of radius I;
//! with K and Q circles of radius I, I + Q, ... and K last. D is the register of the tool radius, on the inside of the circles (`G42` for
//! `G12`, `G41` for `G13`, implied); `D0` moves the centre of the tool on them. L times, in `G91` each Z deeper. It ends in the
//! centre, at the last depth; the word does not last.
//!
//! The way between the centre and a circle is not published: straight out and back are assumed, and that is a doubt.
//!
//! Source: programming manual 96-8000 of 1999, page 237; pages on Haas of others.

use std::f64::consts::TAU;

use glam::{DVec2, DVec3};

use crate::base::Result;
use crate::nc::dialect::{AXES, Code, Plane};
use crate::program::{Comp, Path, Speed};

use super::block::{Word, WordMode};
use super::place::Bytes;
use super::reader::{Reader, Value, take, take_way};

/// Most circles, and most depths, of a pocket: a slip of the pen beyond it.
const MOST: f64 = 1000.0;
/// Said of the ways that are assumed.
const ASSUMED: &str = "the way between the centre and the circles of G12 and G13 is not published: straight out and back are assumed";

impl<'s> Reader<'s> {
    /// Executes `G12` or `G13`.
    pub(super) fn round_pocket(&mut self, words: &mut [Word<'s>], ccw: bool, bytes: &Bytes) -> Result<()> {
        if self.modal.plane != Plane::Xy {
            return Err(self.place.not_understood(bytes, "round pockets are read in G17 only").into());
        }
        if self.modal.comp != Comp::Off {
            return Err(self.while_on(bytes).into());
        }
        let radii = self.radii(words, bytes)?;
        let comp = self.inside(words, ccw, bytes)?;
        let unit = self.modal.length_unit;
        let depth = match take_way(words, AXES[2]) {
            Some((z, WordMode::Plain)) => z.value * unit,
            _ => return Err(self.lacks(bytes, "a round pocket without its depth Z").into()),
        };
        let times = match take(words, "L") {
            Some(l) if l.value >= 1.0 && l.value <= MOST => self.count(&l, "a number of depths")?,
            Some(l) => return Err(self.place.malformed(&l.bytes, "this is no number of depths").into()),
            None => 1,
        };
        let speed = self.feed_speed()?;
        let to = self.end(words)?;
        if to != self.modal.position {
            let rapid = Speed::Rapid { linear: self.dialect.straight_rapid };
            let goes_fast = self.modal.motion != Some(Code::Feed);
            self.push_tip(to, Path::Line, if goes_fast { rapid } else { speed });
        }
        let centre = self.start()?;
        self.doubt(bytes, ASSUMED, "write the circles as G2 or G3");
        let mut height = centre.z;
        for _ in 0..times {
            height = if self.modal.absolute { depth } else { height + depth };
            let at = centre.truncate().extend(height);
            let place = |p: DVec3| p.to_array().map(Some);
            self.push_tip(place(at), Path::Line, speed);
            for radius in &radii {
                let begin = place(at + DVec2::new(*radius, 0.0).extend(0.0));
                let sweep = if ccw { TAU } else { -TAU };
                self.modal.comp = comp;
                self.push_tip(begin, Path::Line, speed);
                self.push_tip(begin, Path::Arc { centre: at, axis: DVec3::Z, sweep, rise: 0.0 }, speed);
                self.modal.comp = Comp::Off;
                self.push_tip(place(at), Path::Line, speed);
            }
        }
        Ok(())
    }

    /// The tool on the inside of the circles.
    fn inside(&mut self, words: &mut [Word<'s>], ccw: bool, bytes: &Bytes) -> Result<Comp> {
        let register = match take(words, "D") {
            Some(d) => self.count(&d, "a register")?,
            None => self.modal.radius.ok_or_else(|| {
                let finding = self.lacks(bytes, "a round pocket without the register D of the tool radius");
                finding.help("program D, or D0 for the path of the tool's centre")
            })?,
        };
        self.modal.radius = Some(register);
        Ok(match (register, ccw) {
            (0, _) => Comp::Off,
            (register, true) => Comp::Left(register),
            (register, false) => Comp::Right(register),
        })
    }

    /// Radii of the circles [mm].
    fn radii(&mut self, words: &mut [Word<'s>], bytes: &Bytes) -> Result<Vec<f64>> {
        let unit = self.modal.length_unit;
        let positive = |this: &Reader<'s>, said: &Value| -> Result<f64> {
            if said.value > 0.0 {
                return Ok(said.value * unit);
            }
            let why = "the radii and the step of a round pocket are positive";
            Err(this.place.malformed(&said.bytes, why).into())
        };
        let Some(first) = take(words, "I") else {
            return Err(self.lacks(bytes, "a round pocket without its radius I").into());
        };
        let first = positive(self, &first)?;
        let (last, step) = match (take(words, "K"), take(words, "Q")) {
            (None, None) => return Ok(vec![first]),
            (Some(last), Some(step)) => (last, positive(self, &step)?),
            _ => {
                let finding = self.lacks(bytes, "a round pocket with one of K and Q");
                return Err(finding.help("program the last radius K and the step Q").into());
            }
        };
        let bytes = last.bytes.clone();
        let last = positive(self, &last)?;
        if last <= first {
            let finding = self.place.malformed(&bytes, "the last radius K is not larger than the first, I");
            return Err(finding.into());
        }
        let steps = ((last - first) / step * (1.0 - 1e-12)).ceil();
        if steps > MOST {
            let finding = self.lacks(&bytes, "a round pocket in more than 1000 circles");
            return Err(finding.help("program a larger step Q").into());
        }
        Ok((0..steps as u32).map(|i| first + step * f64::from(i)).chain([last]).collect())
    }
}
