//! Blocks of motion: lines, arcs about a pole, by radius and tangent, polar lines and helices.

use glam::{DVec2, DVec3};

use crate::base::{Code, Finding, Result};
use crate::nc::arc_fit::{fit, pieces};
use crate::nc::dialect::AXES;
use crate::nc::heidenhain::CIRCLE_TOLERANCE;
use crate::nc::heidenhain::polar::turned;
use crate::nc::read::place::Bytes;
use crate::program::{Move, Path, Speed, Target, ToolAxis};

use super::settings::Functions;
use super::statement::Word;
use super::{RAPID, Reader, Side};

/// Addresses of increments.
const INCREMENTS: [&str; 3] = ["IX", "IY", "IZ"];
/// Angle below which start and end of an arc are the same point [rad]: incremental positions are sums.
const FULL_CIRCLE: f64 = 1e-6;
/// Sine of the angle between a tangent and the chord below which a tangent arc is a line.
const TANGENT: f64 = 1e-9;
/// Excess of half the chord over a radius that is forgiven [mm]: rounding to three decimals.
const SHORT_RADIUS: f64 = 0.001;

impl<'s> Reader<'s> {
    pub(super) fn line(&mut self, words: &mut [Word<'s>]) -> Result<()> {
        let functions = self.before(words)?;
        let speed = self.speed(words)?;
        self.side(words)?;
        if let Some(machine) = &functions.machine {
            self.machine_move(words, machine, speed)?;
            return self.after(functions);
        }
        let axes = has_axis(words);
        let end = self.end(words)?;
        if axes {
            if let Some(bytes) = &functions.retract {
                return Err(self.twice(bytes).into());
            }
            self.straight(end, speed)?;
        }
        self.after(functions)
    }

    fn straight(&mut self, end: [Option<f64>; 3], speed: Option<Speed>) -> Result<()> {
        let speed = self.known_speed(speed)?;
        if !matches!(speed, Speed::Rapid { .. }) {
            self.start()?;
        }
        let from = self.modal.position;
        self.push_tip(end, Path::Line, speed);
        if let ([Some(a), Some(b), _], [Some(x), Some(y), _]) = (from, end) {
            let way = DVec2::new(x - a, y - b);
            self.modal.direction = way.try_normalize().or(self.modal.direction);
        } else {
            self.modal.direction = None;
        }
        Ok(())
    }

    fn machine_move(&mut self, words: &mut [Word<'s>], bytes: &Bytes, speed: Option<Speed>) -> Result<()> {
        let speed = self.known_speed(speed)?;
        if self.modal.comp != Side::Off {
            let finding = self.lacks(bytes, "a move in machine coordinates with radius compensation");
            return Err(finding.cure("program R0").into());
        }
        let mut joints = [None; 3];
        for axis in 0..3 {
            if let Some((value, _)) = self.take(words, AXES[axis])? {
                joints[axis] = Some(value * self.modal.unit);
                self.modal.position[axis] = None;
            }
        }
        if joints == [None; 3] {
            return Err(self.lacks(bytes, "machine coordinates without an axis").into());
        }
        self.modal.direction = None;
        let motion = Move { end: Target::Joints(joints), path: Path::Line };
        self.program.push_move(motion, &self.state(speed), self.origin);
        Ok(())
    }

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
            return Err(self.no_fit("an arc without its radius").cure("program R").into());
        };
        let radius = radius * self.modal.unit;
        let (start, to) = self.flat_end(words)?;
        let from = start.truncate();
        let half = 0.5 * (to - from);
        let length = half.length();
        if length == 0.0 || length - radius.abs() > SHORT_RADIUS {
            let why = "the radius of an arc does not reach from its start to its end";
            let finding = self.place.error(Code::NC_ARC, &bytes, why).cure("program CC and C");
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

    /// `LP`: a line to a polar position.
    pub(super) fn polar_line(&mut self, words: &mut [Word<'s>]) -> Result<()> {
        let functions = self.before(words)?;
        let speed = self.speed(words)?;
        self.side(words)?;
        let pole = self.known_pole()?;
        let unit = self.modal.unit;
        let here = match self.modal.position {
            [Some(x), Some(y), _] => Some(DVec2::new(x, y) - pole),
            _ => None,
        };
        let radius = match (self.take(words, "PR")?, self.take(words, "IPR")?, here) {
            (Some((r, _)), None, _) => r * unit,
            (None, Some((r, _)), Some(arm)) => arm.length() + r * unit,
            (None, None, Some(arm)) => arm.length(),
            _ => return Err(self.lacks(&self.here, "a polar line without its radius PR").into()),
        };
        let angle = match (self.take(words, "PA")?, self.take(words, "IPA")?, here) {
            (Some((a, _)), None, _) => a,
            (None, Some((a, _)), Some(arm)) => arm.to_angle().to_degrees() + a,
            (None, None, Some(arm)) => arm.to_angle().to_degrees(),
            _ => return Err(self.lacks(&self.here, "a polar line without its angle PA").into()),
        };
        let to = turned(pole + DVec2::new(radius, 0.0), pole, angle);
        let mut end = self.end(words)?;
        (end[0], end[1]) = (Some(to.x), Some(to.y));
        self.straight(end, speed)?;
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
    fn flat_end(&mut self, words: &mut [Word<'s>]) -> Result<(DVec3, DVec2)> {
        let start = self.start()?;
        if words.iter().any(|w| w.is("Z") || w.is("IZ")) {
            let why = "arcs that change their height are read as polar arcs (CP) only";
            return Err(self.place.not_understood(&self.here, why).into());
        }
        let end = self.end(words)?;
        Ok((start, DVec2::new(end[0].unwrap_or(start.x), end[1].unwrap_or(start.y))))
    }

    /// The arc of a block, at the height of its start.
    fn turn(
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
        for part in parts {
            let end = part.end.unwrap_or(to);
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

    /// The end that the axis words name; an axis that is neither said nor known stays `None`.
    fn end(&mut self, words: &mut [Word<'s>]) -> Result<[Option<f64>; 3]> {
        let mut end = self.modal.position;
        for axis in 0..3 {
            match (self.take(words, AXES[axis])?, self.take(words, INCREMENTS[axis])?) {
                (None, None) => {}
                (Some((value, _)), None) => {
                    end[axis] = Some(value * self.modal.unit + self.modal.shift[axis]);
                }
                (None, Some((value, bytes))) => match end[axis] {
                    Some(before) => end[axis] = Some(before + value * self.modal.unit),
                    None => {
                        let finding =
                            self.lacks(&bytes, "an increment from a position that the program has not set");
                        return Err(finding.cure("move this axis to an absolute position first").into());
                    }
                },
                (Some(_), Some((_, bytes))) => return Err(self.twice(&bytes).into()),
            }
        }
        Ok(end)
    }

    /// The known position.
    pub(super) fn start(&self) -> Result<DVec3> {
        let [x, y, z] = self.modal.position;
        let (Some(x), Some(y), Some(z)) = (x, y, z) else {
            let missing: Vec<&str> =
                (0..3).filter(|i| self.modal.position[*i].is_none()).map(|i| AXES[i]).collect();
            let message = format!("a feed move starts where the program has not set {}", missing.join(", "));
            return Err(self.lacks(&self.here, &message).cure("move there by FMAX first").into());
        };
        Ok(DVec3::new(x, y, z))
    }

    fn known_pole(&self) -> Result<DVec2> {
        self.modal.pole.ok_or_else(|| self.no_fit("an arc without a pole").cure("program CC").into())
    }

    fn no_fit(&self, message: &str) -> Finding {
        self.place.error(Code::NC_ARC, &self.here, message)
    }

    /// `DR+` is counter-clockwise.
    fn sense(&self, words: &mut [Word<'s>]) -> Result<bool> {
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

    /// Appends a move of the tip.
    pub(super) fn push_tip(&mut self, end: [Option<f64>; 3], path: Path, speed: Speed) {
        let here = self.here.clone();
        if self.modal.offset.is_none() {
            self.warn(&here, "no preset (CYCL DEF 247) before the first move: preset 1, G54, is assumed");
        }
        if !self.modal.unit_said {
            self.warn(&here, "no BEGIN PGM with a unit before the first move: mm is assumed");
        }
        self.modal.position = end;
        let point = DVec3::from_array(end.map(|v| v.unwrap_or(f64::NAN)));
        let motion = Move { end: Target::Tip { point, axis: ToolAxis::Fixed }, path };
        self.program.push_move(motion, &self.state(speed), self.origin);
    }

    /// The speed of a block that moves.
    fn known_speed(&self, speed: Option<Speed>) -> Result<Speed> {
        match speed.or(self.modal.feed) {
            Some(
                speed @ (Speed::Rapid { .. }
                | Speed::PerMinute(f64::MIN_POSITIVE..)
                | Speed::PerRevolution(f64::MIN_POSITIVE..)
                | Speed::Duration(f64::MIN_POSITIVE..)),
            ) => Ok(speed),
            Some(_) => Err(self.lacks(&self.here, "a feed move with feed zero").into()),
            None => Err(self.lacks(&self.here, "a feed move without a feed (F)").into()),
        }
    }

    /// What the block says of its speed; a feed stays, `FMAX` and `FT` hold for the block.
    fn speed(&mut self, words: &mut [Word<'s>]) -> Result<Option<Speed>> {
        let mut said = None;
        let mut stays = None;
        for at in 0..words.len() {
            let next = words.get(at + 1).map_or("", |w| w.name);
            let word = &words[at];
            if word.used || !["F", "FMAX", "FAUTO", "FU", "FT", "FZ"].iter().any(|n| word.is(n)) {
                continue;
            }
            let bytes = word.bytes.clone();
            if said.is_some() || stays.is_some() {
                return Err(self.twice(&bytes).into());
            }
            let split = word.is("F") && word.value.is_none();
            let rapid = word.is("FMAX") || split && next.eq_ignore_ascii_case("MAX");
            let auto = word.is("FAUTO") || split && next.eq_ignore_ascii_case("AUTO");
            if rapid {
                said = Some(RAPID);
            } else if auto {
                stays = Some(self.modal.tool_feed.ok_or_else(|| {
                    self.lacks(&bytes, "FAUTO without a feed in the tool call").cure("program F")
                })?);
            } else {
                let Some(value) = word.value else {
                    return Err(self.place.malformed(&bytes, "a number is missing").into());
                };
                if value < 0.0 {
                    return Err(self.place.malformed(&bytes, "a feed is not negative").into());
                }
                if word.is("FZ") {
                    let why = "a feed per tooth needs the number of teeth: program F or FU";
                    return Err(self.place.not_understood(&bytes, why).into());
                } else if word.is("FT") {
                    said = Some(Speed::Duration(value));
                } else if word.is("FU") {
                    stays = Some(Speed::PerRevolution(value * self.modal.unit));
                } else {
                    stays = Some(self.feed(value));
                }
            }
            words[at].used = true;
            if split {
                words[at + 1].used = true;
            }
        }
        self.modal.feed = stays.or(self.modal.feed);
        Ok(said)
    }

    /// The speed of an `F` word.
    pub(super) fn feed(&self, value: f64) -> Speed {
        if self.modal.per_revolution {
            Speed::PerRevolution(value * self.modal.unit)
        } else {
            Speed::PerMinute(value * self.modal.feed_unit)
        }
    }

    /// `R0`, `RL`, `RR`.
    fn side(&mut self, words: &mut [Word<'s>]) -> Result<()> {
        let mut said = false;
        for word in words.iter_mut().filter(|w| !w.used) {
            let side = match word.name.to_ascii_uppercase().as_str() {
                "R" if word.value == Some(0.0) => Side::Off,
                "RL" if word.value.is_none() => Side::Left,
                "RR" if word.value.is_none() => Side::Right,
                _ => continue,
            };
            if said {
                return Err(self.twice(&word.bytes).into());
            }
            said = true;
            word.used = true;
            self.modal.comp = side;
        }
        Ok(())
    }

    /// What M functions do after the movement of their block.
    fn after(&mut self, functions: Functions) -> Result<()> {
        if functions.call {
            self.drill()?;
        }
        self.finish_functions(&functions);
        Ok(())
    }
}

/// Unit tangent of an arc where its radius vector is `arm`.
fn tangent(arm: DVec2, ccw: bool) -> Option<DVec2> {
    (if ccw { arm.perp() } else { -arm.perp() }).try_normalize()
}

/// Whether a block names an axis.
pub(super) fn has_axis(words: &[Word<'_>]) -> bool {
    words.iter().any(|w| AXES.iter().chain(&INCREMENTS).any(|a| w.is(a)))
}
