//! Arcs about a pole, by radius and tangent, and helices by their angle.

use glam::{DVec2, DVec3};

use crate::base::{Code, CountBound, Finding, Result};
use crate::nc::arc_fit::{fit, pieces};
use crate::nc::dialect::AXES;
use crate::nc::heidenhain::CIRCLE_TOLERANCE;
use crate::nc::heidenhain::polar::turned;
use crate::program::{Path, Speed};

use super::Reader;
use super::motion::{INCREMENTS, has_axis};
use super::statement::Word;

/// Angle below which start and end of an arc are the same point [rad]: incremental positions are sums.
const FULL_CIRCLE: f64 = 1e-6;
/// Sine of the angle between a tangent and the chord below which a tangent arc is a line.
const TANGENT: f64 = 1e-9;
/// Excess of half the chord over a radius that is forgiven [mm]: rounding to three decimals.
const SHORT_RADIUS: f64 = 0.001;

/// Turns of a helix, as on the other controls.
const TURNS: CountBound = CountBound {
    what: "turns of an arc",
    most: 999.0,
    bytes: 1000,
    code: Code::NC_ARC,
    help: "write fewer turns, or several blocks",
};

impl<'s> Reader<'s> {
    /// `CC`: the pole; without coordinates the present position.
    pub(super) fn pole(&mut self, words: &mut [Word<'s>]) -> Result<()> {
        if !has_axis(words) {
            self.modal.pole = Some(self.start()?.truncate());
            return Ok(());
        }
        let end = self.end(words)?;
        let named = |axis: usize| words.iter().any(|w| w.is(AXES[axis]) || w.is(INCREMENTS[axis]));
        match end {
            [Some(x), Some(y), _] if named(0) && named(1) && !named(2) => {
                self.modal.pole = Some(DVec2::new(x, y));
                Ok(())
            }
            _ => Err(self
                .place
                .not_understood(
                    &self.here,
                    "a pole is read with X and Y, in the plane of the tool axis Z only",
                )
                .into()),
        }
    }

    /// `C`: an arc about the pole.
    pub(super) fn arc(&mut self, words: &mut [Word<'s>]) -> Result<()> {
        let functions = self.before(words)?;
        let speed = self.speed(words)?;
        let ccw = self.sense(words)?;
        let (start, to) = self.flat_end(words)?;
        let from = start.truncate();
        let centre = self.known_pole()?;
        let (r1, r2) = ((from - centre).length(), (to - centre).length());
        if (r1 - r2).abs() > CIRCLE_TOLERANCE {
            let message = format!(
                "the start of an arc is {r1:.5} mm from its centre, the end {r2:.5} mm: the difference is too large"
            );
            let finding = self.no_fit(&message).value_mm((r1 - r2).abs()).bound_mm(CIRCLE_TOLERANCE);
            return Err(finding.into());
        }
        self.radius_difference = self.radius_difference.max((r1 - r2).abs());
        let full = (to - from).length() <= FULL_CIRCLE * r1;
        self.turn(start, if full { from } else { to }, centre, ccw, speed)?;
        self.after(functions)
    }

    /// `CR`: an arc by its radius; a negative one is more than half a turn.
    pub(super) fn arc_by_radius(&mut self, words: &mut [Word<'s>]) -> Result<()> {
        let functions = self.before(words)?;
        let speed = self.speed(words)?;
        let ccw = self.sense(words)?;
        let Some((radius, bytes)) = self.take(words, "R")? else {
            return Err(self.no_fit("an arc without its radius").help("program R").into());
        };
        let radius = radius * self.modal.unit;
        let (start, to) = self.flat_end(words)?;
        let from = start.truncate();
        let half = 0.5 * (to - from);
        let length = half.length();
        if length == 0.0 || length - radius.abs() > SHORT_RADIUS {
            let why = "the radius of an arc does not reach from its start to its end";
            let finding = self.place.error(Code::NC_ARC, &bytes, why).help("program CC and C");
            return Err(finding.value_mm(radius).bound_mm(length).into());
        }
        let height = ((radius.abs() - length) * (radius.abs() + length)).clamp(0.0, f64::INFINITY).sqrt();
        let left = if ccw == (radius > 0.0) { height } else { -height };
        let centre = from + half + half.perp() / length * left;
        self.turn(start, to, centre, ccw, speed)?;
        self.after(functions)
    }

    /// `CT`: an arc tangent to the block before.
    pub(super) fn tangent_arc(&mut self, words: &mut [Word<'s>]) -> Result<()> {
        let functions = self.before(words)?;
        let speed = self.speed(words)?;
        let (start, to) = self.flat_end(words)?;
        let from = start.truncate();
        let Some(direction) = self.modal.direction else {
            return Err(self.no_fit("a tangent arc after a block without a direction in the plane").into());
        };
        let chord = to - from;
        let across = chord.dot(direction.perp());
        if across.abs() <= TANGENT * chord.length() {
            if chord.dot(direction) <= 0.0 {
                return Err(self.no_fit("a tangent arc cannot lead straight back").into());
            }
            self.straight([Some(to.x), Some(to.y), Some(start.z)], speed)?;
        } else {
            let radius = chord.length_squared() / (2.0 * across);
            let centre = from + direction.perp() * radius;
            self.turn(start, to, centre, radius > 0.0, speed)?;
        }
        self.after(functions)
    }

    /// `CP`: an arc or helix by its angle; `IPA` may be many turns.
    pub(super) fn polar_arc(&mut self, words: &mut [Word<'s>]) -> Result<()> {
        let functions = self.before(words)?;
        let speed = self.speed(words)?;
        let ccw = self.sense(words)?;
        let speed = self.known_speed(speed)?;
        let start = self.start()?;
        let (from, pole) = (start.truncate(), self.known_pole()?);
        let degrees = match (self.take(words, "PA")?, self.take(words, "IPA")?) {
            (None, Some((angle, bytes))) => {
                if angle == 0.0 || (angle > 0.0) != ccw {
                    let why = "the sign of IPA and the sense DR contradict each other";
                    return Err(self.place.malformed(&bytes, why).into());
                }
                angle
            }
            (Some((angle, _)), None) => {
                let turn = (angle - (from - pole).to_angle().to_degrees()).rem_euclid(360.0);
                match (ccw, turn > FULL_CIRCLE.to_degrees() && turn < 360.0 - FULL_CIRCLE.to_degrees()) {
                    (true, true) => turn,
                    (false, true) => turn - 360.0,
                    (true, false) => 360.0,
                    (false, false) => -360.0,
                }
            }
            _ => return Err(self.lacks(&self.here, "a polar arc without its angle PA or IPA").into()),
        };
        if (from - pole).length() == 0.0 {
            return Err(self.no_fit("an arc with radius zero").into());
        }
        let turns = degrees.abs() / 360.0;
        TURNS.check(turns).map_err(|e| self.place.located(&self.here, e))?;
        let to = turned(from, pole, degrees);
        let end = self.end(words)?;
        if end[0] != Some(start.x) || end[1] != Some(start.y) {
            return Err(self.place.malformed(&self.here, "a polar arc has no X or Y").into());
        }
        let height = end[2].unwrap_or(start.z);
        let path = Path::Arc {
            centre: pole.extend(start.z),
            axis: DVec3::Z,
            sweep: degrees.to_radians(),
            rise: height - start.z,
        };
        self.push_tip([Some(to.x), Some(to.y), Some(height)], path, speed);
        self.modal.direction = tangent(to - pole, ccw);
        self.after(functions)
    }

    /// Start and end of an arc that stays at its height.
    pub(super) fn flat_end(&mut self, words: &mut [Word<'s>]) -> Result<(DVec3, DVec2)> {
        let start = self.start()?;
        if words.iter().any(|w| w.is("Z") || w.is("IZ")) {
            let why = "arcs that change their height are read as polar arcs (CP) only";
            return Err(self.place.not_understood(&self.here, why).into());
        }
        let end = self.end(words)?;
        Ok((start, DVec2::new(end[0].unwrap_or(start.x), end[1].unwrap_or(start.y))))
    }

    /// The arc of a block, at the height of its start.
    pub(super) fn turn(
        &mut self,
        start: DVec3,
        to: DVec2,
        centre: DVec2,
        ccw: bool,
        speed: Option<Speed>,
    ) -> Result<()> {
        let speed = self.known_speed(speed)?;
        let from = start.truncate();
        let parts = pieces(from, to, centre, ccw, 0);
        if (from - centre).length() == 0.0 || parts.iter().any(|p| p.centre == from) {
            return Err(self.no_fit("an arc with radius zero").into());
        }
        let total: f64 = parts.iter().map(|p| p.sweep).sum();
        for part in parts {
            let end = part.end.unwrap_or(to);
            let speed = speed.of_part(part.sweep / total);
            let path = Path::Arc {
                centre: part.centre.extend(start.z),
                axis: DVec3::Z,
                sweep: part.sweep,
                rise: 0.0,
            };
            self.push_tip([Some(end.x), Some(end.y), Some(start.z)], path, speed);
        }
        self.modal.direction = tangent(to - fit(from, to, centre, ccw).0, ccw);
        Ok(())
    }

    pub(super) fn known_pole(&self) -> Result<DVec2> {
        self.modal.pole.ok_or_else(|| self.no_fit("an arc without a pole").help("program CC").into())
    }

    pub(super) fn no_fit(&self, message: &str) -> Finding {
        self.place.error(Code::NC_ARC, &self.here, message)
    }

    /// `DR+` is counter-clockwise.
    pub(super) fn sense(&self, words: &mut [Word<'s>]) -> Result<bool> {
        let mut sense = None;
        for word in words.iter_mut().filter(|w| w.is("DR")) {
            word.used = true;
            if sense.is_some() {
                return Err(self.twice(&word.bytes).into());
            }
            sense =
                Some(word.sign.ok_or_else(|| self.place.malformed(&word.bytes, "a sense is DR+ or DR-"))?);
        }
        sense.ok_or_else(|| self.no_fit("an arc without its sense DR+ or DR-").into())
    }
}

/// Unit tangent of an arc where its radius vector is `arm`.
fn tangent(arm: DVec2, ccw: bool) -> Option<DVec2> {
    (if ccw { arm.perp() } else { -arm.perp() }).try_normalize()
}
