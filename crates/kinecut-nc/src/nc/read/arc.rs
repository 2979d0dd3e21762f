//! Arcs, helices and involutes: exact curves through both end points of a block.

use glam::{DVec2, DVec3};

use crate::base::{Code as FindingCode, Finding, Result};
use crate::geom::{InvoluteRecord, Rise, Spiral};
use crate::nc::arc_fit::pieces;
use crate::nc::arc_spiral::{APPARENT, spiral};
use crate::nc::dialect::{AXES, Mismatch, OFFSETS, Plane};
use crate::program::{Comp, Path};

use super::block::Word;
use super::place::Bytes;
use super::reader::{Reader, Value, take};

/// Angle below which start and end are taken for the same point and the arc for a full circle [rad]: the
/// controls' own fuzz; incremental positions are sums.
const FULL_CIRCLE: f64 = 1e-6;
/// Excess of half the chord over the radius of an arc in radius form that is forgiven [mm]: 0.00005 in, as measured on
/// the LinuxCNC interpreter.
const SHORT_RADIUS: f64 = 0.00127;
/// Radius that LinuxCNC takes for zero [mm]: 0.00005 in.
const ZERO_RADIUS: f64 = 0.00127;
/// Largest distance between the involutes through start and end of a block [mm]: MD21015 at its default.
const INVOLUTE_DIFFERENCE: f64 = 0.01;

impl<'s> Reader<'s> {
    pub(super) fn no_centre(&self, bytes: &Bytes) -> Finding {
        let finding = self
            .place
            .error(FindingCode::NC_ARC, bytes, "an arc without centre or radius")
            .help("program I, J, K or a radius");
        self.answers(finding, 35)
    }

    pub(super) fn arc(&mut self, words: &mut [Word<'s>], ccw: bool) -> Result<()> {
        let speed = self.feed_speed()?;
        let plane = self.modal.plane;
        let [a, b, n] = plane.axes();
        let start = self.start_of_arc(words, plane)?;
        let said = self.end(words)?;
        let end = said.map(|v| v.unwrap_or(f64::NAN));
        let flat = |p: [f64; 3]| DVec2::new(p[a], p[b]);
        let (from, to) = (flat(start.to_array()), flat(end));
        let radius = take(words, self.dialect.radius);
        let turns = match self.dialect.turns {
            Some((word, base)) => match take(words, word.trim_end_matches('=')) {
                Some(turns) => self.turns(&turns, base)?,
                None => 0,
            },
            None => 0,
        };
        let (centre, to) = match radius {
            Some(radius) => (self.centre_by_radius(&radius, from, to, ccw)?, to),
            None => {
                let centre = self.centre(words, plane, from)?;
                self.check(from, to, centre)?;
                // Within the fuzz of the controls it is a full circle.
                let apart = (to - from).length();
                (centre, if apart <= FULL_CIRCLE * (from - centre).length() { from } else { to })
            }
        };
        if let Some(spiral) = self.spiral_of(from, to, centre, ccw, turns) {
            let rise = if said[n].is_some() { end[n] - start[n] } else { 0.0 };
            self.push_tip(said, Path::Spiral { spiral, rise: Rise::even(rise) }, speed);
            return Ok(());
        }
        let parts = pieces(from, to, centre, ccw, turns);
        if parts.len() > 1 && self.modal.rotary_axes.turns_next() {
            return Err(self.lacks(&self.here, "rotary axes turn on an arc of whole turns").into());
        }
        if parts.iter().any(|p| p.centre == from) {
            return Err(self.no_fit("an arc with radius zero").into());
        }
        let mut axis = DVec3::ZERO;
        axis[n] = 1.0;
        let total: f64 = parts.iter().map(|p| p.sweep).sum();
        let rise = if said[n].is_some() { end[n] - start[n] } else { 0.0 };
        let mut done = 0.0;
        for part in parts {
            let mut middle = start;
            middle[a] = part.centre.x;
            middle[b] = part.centre.y;
            middle[n] += rise * done / total;
            done += part.sweep;
            let mut stop = said;
            if let Some(to) = part.end {
                stop[a] = Some(to.x);
                stop[b] = Some(to.y);
                stop[n] = stop[n].map(|_| start[n] + rise * done / total).filter(|v| !v.is_nan());
            }
            let rise = rise * part.sweep / total;
            let speed = speed.of_part(part.sweep / total);
            let path = Path::Arc { centre: middle, axis, sweep: part.sweep, rise };
            let path = self.through_corner(stop, path, speed)?;
            self.push_tip(stop, path, speed);
        }
        Ok(())
    }

    /// The spiral that a control runs which keeps the centre of an arc that is not round.
    fn spiral_of(&self, from: DVec2, to: DVec2, centre: DVec2, ccw: bool, turns: u32) -> Option<Spiral> {
        let difference = ((from - centre).length() - (to - centre).length()).abs();
        let plain = self.modal.plane == Plane::Xy
            && self.modal.comp == Comp::Off
            && !self.modal.rotary_axes.turns_next();
        if !(self.dialect.mismatch.keeps_centre() && plain && difference > APPARENT && from != to) {
            return None;
        }
        spiral(from, to, centre, ccw, turns).ok()
    }

    /// The start of an arc: in its plane it is known; one whose height is not known is not followed, and that is said.
    fn start_of_arc(&mut self, words: &[Word<'s>], plane: Plane) -> Result<DVec3> {
        let [a, b, n] = plane.axes();
        let at = self.modal.position;
        let flat = at[a].is_some() && at[b].is_some();
        // Words of a helix may be increments, and compensation needs its start.
        let rises = words.iter().any(|w| !w.used && w.is(AXES[n]));
        let needs_start = rises && (!self.modal.absolute || self.modal.comp != Comp::Off);
        if at[n].is_some() || !flat || needs_start {
            return self.start();
        }
        self.from_nowhere.push(self.place.span(&self.here));
        Ok(DVec3::from_array(at.map(|v| v.unwrap_or(f64::NAN))))
    }

    fn turns(&self, turns: &Value, base: u32) -> Result<u32> {
        let count = self.count(turns, "a number of turns")?;
        let extra = count.checked_sub(base).filter(|n| *n <= self.dialect.most_turns);
        extra.ok_or_else(|| {
            let finding = self.place.malformed(&turns.bytes, "the number of turns is out of range");
            finding.value(turns.value, "").bound(f64::from(self.dialect.most_turns), "").into()
        })
    }

    /// The centre from its offsets.
    fn centre(&mut self, words: &mut [Word<'s>], plane: Plane, from: DVec2) -> Result<DVec2> {
        let [a, b, _] = plane.axes();
        let unit = self.modal.length_unit;
        let offsets = [take(words, OFFSETS[a]), take(words, OFFSETS[b])];
        let here = self.here.clone();
        if self.modal.centre_absolute {
            return match offsets {
                [Some(x), Some(y)] => Ok(DVec2::new(x.value, y.value) * unit),
                _ => Err(self.no_centre(&here).into()),
            };
        }
        match offsets {
            [None, None] => Err(self.no_centre(&here).into()),
            [x, y] => {
                let value = |v: Option<Value>| v.map_or(0.0, |v| v.value) * unit;
                Ok(from + DVec2::new(value(x), value(y)))
            }
        }
    }

    /// The centre of the arc of this radius: the shorter arc, or the longer one for a negative radius.
    fn centre_by_radius(&self, word: &Value, from: DVec2, to: DVec2, ccw: bool) -> Result<DVec2> {
        let radius = word.value * self.modal.length_unit;
        let wrong = |why: &str| self.place.error(FindingCode::NC_ARC, &word.bytes, why);
        let half = 0.5 * (to - from);
        let length = half.length();
        if length == 0.0 {
            return Err(wrong("an arc by radius needs an end that differs from its start")
                .help("program I and J")
                .into());
        }
        if length - radius.abs() > SHORT_RADIUS {
            let finding = wrong("the radius of an arc is shorter than half the distance of its ends");
            return Err(self.answers(finding.value_mm(radius).bound_mm(length), 34).into());
        }
        let height = ((radius.abs() - length) * (radius.abs() + length)).clamp(0.0, f64::INFINITY).sqrt();
        let left = half.perp() / length;
        let side = if ccw == (radius > 0.0) { 1.0 } else { -1.0 };
        Ok(from + half + left * (side * height))
    }

    /// Refuses what the control refuses.
    fn check(&mut self, from: DVec2, to: DVec2, centre: DVec2) -> Result<()> {
        let (r1, r2) = ((from - centre).length(), (to - centre).length());
        let difference = (r1 - r2).abs();
        let bound = self.dialect.mismatch.bound(r1, r2, self.modal.length_unit != 1.0);
        if difference > bound {
            let message = format!(
                "the start of an arc is {r1:.5} mm from its centre, the end {r2:.5} mm: the difference is too large"
            );
            let finding = self.no_fit(&message).value_mm(difference).bound_mm(bound);
            return Err(self.answers(finding, 33).into());
        }
        let least = if matches!(self.dialect.mismatch, Mismatch::Ngc) { ZERO_RADIUS } else { 0.0 };
        if r1 <= least || r2 <= least {
            return Err(self.no_fit("an arc with radius zero").into());
        }
        self.radius_difference = self.radius_difference.max(difference);
        Ok(())
    }

    fn no_fit(&self, message: &str) -> Finding {
        let finding = self.place.error(FindingCode::NC_ARC, &self.here, message);
        match &self.points.increment {
            Some(word) => finding.help(word.clone()),
            None => finding,
        }
    }

    pub(super) fn involute(&mut self, words: &mut [Word<'s>], ccw: bool) -> Result<()> {
        let speed = self.feed_speed()?;
        let start = self.start()?;
        let here = self.here.clone();
        if self.modal.plane != Plane::Xy {
            return Err(self.place.not_understood(&here, "involutes are read in G17 only").into());
        }
        let said = self.end(words)?;
        let end = said.map(|v| v.unwrap_or(f64::NAN));
        let base = self.centre(words, Plane::Xy, start.truncate())?;
        let Some(radius) = take(words, self.dialect.radius) else {
            return Err(self
                .no_fit("an involute without the radius of its base circle")
                .help("program the radius of the base circle")
                .into());
        };
        let base_radius = radius.value * self.modal.length_unit;
        let through =
            InvoluteRecord::through([start.x, start.y], [end[0], end[1]], base.to_array(), base_radius, ccw);
        let (record, difference) =
            through.map_err(|e| e.0.at(self.place.sources.locate(self.place.span(&here))))?;
        if difference > INVOLUTE_DIFFERENCE {
            let finding = self.no_fit("the involutes through start and end lie too far apart");
            return Err(finding.value_mm(difference).bound_mm(INVOLUTE_DIFFERENCE).into());
        }
        self.involute_difference = self.involute_difference.max(difference);
        self.push_tip(said, Path::Involute { record, rise: end[2] - start.z }, speed);
        Ok(())
    }
}
