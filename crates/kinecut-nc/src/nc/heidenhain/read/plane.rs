//! Tilted working planes: `PLANE SPATIAL`, `EULER`, `VECTOR`, `RELATIV` and `RESET`.
//!
//! The plane's origin is the datum as it is shifted when the plane is said; a shift or rotation said within the plane
//! counts in its coordinates. `TURN` orients the tool, `STAY` moves nothing, and so does a rotary block with the angles
//! that the control has computed (`A+Q120 C+Q122`) after it: the tool is then oriented. `MOVE` and a retraction (`MB`)
//! move linear axes to where only the control knows, and are refused. `TABLE ROT` and `COORD ROT` differ in how the table
//! stands, not in the plane. `SYM` is the newer word for `SEQ`.
//!
//! The tip's position in the plane depends on the rotary axes: the program has to name all of it again.

use glam::{DMat3, DVec3};

use crate::base::Result;
use crate::nc::heidenhain::plane;
use crate::nc::multi_axis::Rotaries;
use crate::program::{Move, Path, RotarySolution, Speed, Target};

use super::statement::Word;
use super::{RAPID, Reader};

/// A plane in force.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Tilt {
    /// Its axes in the shifted coordinates of the preset.
    pub(super) rotation: DMat3,
    pub(super) branch: RotarySolution,
}

/// Definitions that are known and not read, with the reason.
const REFUSED: &[(&str, &str)] = &[
    ("PROJECTED", "planes by projected angles are not read: give spatial angles (PLANE SPATIAL)"),
    ("POINTS", "planes by three points are not read: give spatial angles (PLANE SPATIAL)"),
    ("AXIAL", "axis angles mean a plane only on one machine: give spatial angles (PLANE SPATIAL)"),
];
/// Rotary axes by what the control computed for the plane: numbers of their Q parameters.
const COMPUTED: [(&str, u32); 3] = [("A", 120), ("B", 121), ("C", 122)];

impl<'s> Reader<'s> {
    /// A statement that begins with `PLANE`.
    pub(super) fn plane(&mut self, words: &mut [Word<'s>]) -> Result<()> {
        self.uncompensated("a plane is tilted")?;
        let Some(kind) = words.get_mut(1) else {
            return Err(self.place.malformed(&self.here, "a plane without its kind").into());
        };
        kind.used = true;
        let (name, bytes) = (kind.name.to_ascii_uppercase(), kind.bytes.clone());
        if let Some((_, why)) = REFUSED.iter().find(|r| r.0 == name) {
            return Err(self.place.not_understood(&self.here, why).into());
        }
        if self.modal.tcp != crate::program::Tcp::Off {
            let why = "a plane is tilted while the tool centre point is controlled";
            return Err(self
                .lacks(&self.here, why)
                .help("switch it off (M129, FUNCTION RESET TCPM) first")
                .into());
        }
        let rotation = match name.as_str() {
            "RESET" => None,
            "SPATIAL" => {
                let [a, b, c] = self.angles(words, ["SPA", "SPB", "SPC"])?;
                Some(plane::spatial(a, b, c))
            }
            "EULER" => {
                let [precession, nutation, turned] = self.angles(words, ["EULPR", "EULNU", "EULROT"])?;
                Some(plane::euler(precession, nutation, turned))
            }
            "VECTOR" => {
                let base = DVec3::from_array(self.angles(words, ["BX", "BY", "BZ"])?);
                let normal = DVec3::from_array(self.angles(words, ["NX", "NY", "NZ"])?);
                let found = plane::of_vectors(base, normal).ok_or_else(|| {
                    let message =
                        "the base vector of a plane is not across its normal, or one of them is zero";
                    self.lacks(&self.here, message).help("give the base vector as it lies in the plane")
                })?;
                Some(found)
            }
            "RELATIV" | "RELATIVE" => Some(self.relative(words)?),
            _ => {
                let why = "kinecut does not know what the control does with it";
                return Err(self.place.not_understood(&bytes, why).into());
            }
        };
        let turn = self.positioning(words, rotation.is_none())?;
        let branch = self.branch(words)?;
        match rotation {
            Some(rotation) => self.tilt(Tilt { rotation, branch })?,
            None => self.level()?,
        }
        if let Some(speed) = turn {
            self.orient(speed);
        }
        Ok(())
    }

    /// Three numbers that a definition needs.
    fn angles(&self, words: &mut [Word<'s>], names: [&str; 3]) -> Result<[f64; 3]> {
        let mut found = [0.0; 3];
        for (value, name) in found.iter_mut().zip(names) {
            let Some((number, _)) = self.take(words, name)? else {
                let message = format!("a plane without {name}");
                return Err(self
                    .lacks(&self.here, &message)
                    .help("program all of its values, zero too")
                    .into());
            };
            *value = number;
        }
        Ok(found)
    }

    /// `PLANE RELATIV SPB-45`: one turn more, about an axis of the plane in force.
    fn relative(&self, words: &mut [Word<'s>]) -> Result<DMat3> {
        let mut turns = Vec::new();
        for (name, turn) in [
            ("SPA", plane::about_x as fn(f64) -> DMat3),
            ("SPB", plane::about_y),
            ("SPC", crate::nc::turn::rotation),
        ] {
            if let Some((angle, _)) = self.take(words, name)? {
                turns.push(turn(angle));
            }
        }
        let before = self.modal.tilt.map_or(DMat3::IDENTITY, |t| t.rotation);
        match turns.as_slice() {
            [one] => Ok(before * *one),
            _ => Err(self.lacks(&self.here, "a relative plane names one of SPA, SPB and SPC").into()),
        }
    }

    /// `TURN FMAX`, `TURN F1000` or `STAY`: the speed at which rotary axes turn, if they do.
    fn positioning(&mut self, words: &mut [Word<'s>], reset: bool) -> Result<Option<Speed>> {
        let mut found = None;
        for word in words.iter_mut().filter(|w| !w.used && w.value.is_none()) {
            let stays = word.is("STAY");
            if word.is("MOVE") || word.is("MB") {
                let why = "it moves the linear axes to where only the control knows: use TURN or STAY";
                return Err(self.place.not_understood(&word.bytes.clone(), why).into());
            }
            if stays || word.is("TURN") {
                word.used = true;
                if found.replace(stays).is_some() {
                    return Err(self.twice(&word.bytes.clone()).into());
                }
            }
        }
        if found.is_none() && !reset {
            let finding = self.lacks(&self.here, "a plane does not say what the rotary axes do");
            return Err(finding.help("program TURN or STAY").into());
        }
        // Without a word nothing moves: what older programs end with.
        if found.unwrap_or(true) {
            return Ok(None);
        }
        // The feed of the turn is not that of the blocks after it.
        let feed = self.modal.feed;
        let said = self.speed(words)?;
        let speed = self.known_speed(said);
        self.modal.feed = feed;
        speed.map(Some)
    }

    /// `SEQ+`, `SEQ-`, `SYM+`, `SYM-`, and how the table stands.
    fn branch(&self, words: &mut [Word<'s>]) -> Result<RotarySolution> {
        let mut branch = None;
        let mut stand = None;
        for at in 0..words.len() {
            if words[at].used {
                continue;
            }
            let bytes = words[at].bytes.clone();
            let twice = if words[at].is("SEQ") || words[at].is("SYM") {
                let Some(plus) = words[at].sign else {
                    return Err(self.place.malformed(&bytes, "a sign is missing").into());
                };
                words[at].used = true;
                branch
                    .replace(if plus { RotarySolution::Positive } else { RotarySolution::Negative })
                    .is_some()
            } else if (words[at].is("TABLE") || words[at].is("COORD"))
                && words.get(at + 1).is_some_and(|w| w.is("ROT"))
            {
                words[at].used = true;
                words[at + 1].used = true;
                stand.replace(at).is_some()
            } else {
                false
            };
            if twice {
                return Err(self.twice(&bytes).into());
            }
        }
        Ok(branch.unwrap_or_default())
    }

    fn tilt(&mut self, tilt: Tilt) -> Result<()> {
        if self.modal.degrees != 0.0 || self.modal.inner != [0.0; 3] {
            let message = "a plane is said within coordinates that are turned, or shifted in another plane: whether it \
                           counts in them is not certain";
            let finding = self.place.not_understood(&self.here, message);
            return Err(finding.help("take the rotation (ROT+0) and the shift back before PLANE").into());
        }
        self.modal.tilt = Some(tilt);
        self.set_frame();
        self.unplace();
        Ok(())
    }

    /// `PLANE RESET`: a shift that was said within the plane may stay or go with it.
    fn level(&mut self) -> Result<()> {
        if self.modal.tilt.is_none() {
            return Ok(());
        }
        if self.modal.degrees != 0.0 {
            let why =
                "a plane is taken back before the rotation within it: whether that stays is not certain";
            let finding = self.place.not_understood(&self.here, why);
            return Err(finding.help("take the rotation back (ROT+0) before PLANE RESET").into());
        }
        let modal = &mut self.modal;
        modal.tilt = None;
        if modal.inner != [0.0; 3] {
            modal.shift = std::mem::take(&mut modal.inner);
            modal.uncertain = Some(self.here.clone());
        } else if modal.shift == [0.0; 3] {
            modal.uncertain = None;
        }
        self.set_frame();
        self.unplace();
        Ok(())
    }

    /// The tool turns along Z of the coordinates in force.
    pub(super) fn orient(&mut self, speed: Speed) {
        match self.modal.tilt {
            Some(_) => self.modal.rotaries.swing(),
            None => self.modal.rotaries = Rotaries::default(),
        }
        self.unplace();
        let motion = Move { end: Target::Orient, path: Path::Line };
        self.program.push_move(motion, &self.state(speed), self.origin);
    }

    /// The tip is where the program has not said.
    pub(super) fn unplace(&mut self) {
        self.modal.position = [None; 3];
        self.modal.direction = None;
        self.modal.pole = None;
    }

    /// Whether a block turns rotary axes to what the control has computed for the plane; its words are then used.
    pub(super) fn computed(&self, words: &mut [Word<'s>]) -> Result<bool> {
        let mut found = false;
        for word in words.iter_mut() {
            let Some(number) = word.from else { continue };
            let known = COMPUTED.iter().any(|(name, q)| word.is(name) && *q == number);
            if !known || self.modal.tilt.is_none() || word.sign == Some(false) {
                let why =
                    "Q parameters are not read yet; A+Q120, B+Q121 and C+Q122 are read in a tilted plane";
                return Err(self.place.not_understood(&word.bytes.clone(), why).into());
            }
            word.used = true;
            found = true;
        }
        Ok(found)
    }

    /// The speed of a turn of rotary axes to a plane.
    pub(super) fn computed_turn(&mut self, speed: Option<Speed>) -> Result<()> {
        let speed = self.known_speed(speed.or(Some(self.modal.feed.unwrap_or(RAPID))))?;
        self.orient(speed);
        Ok(())
    }
}
