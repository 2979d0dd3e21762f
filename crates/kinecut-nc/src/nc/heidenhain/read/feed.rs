//! Feed and radius compensation of a block of motion.

use crate::base::{Code, Finding, Result};
use crate::program::Speed;

use super::statement::Word;
use super::{RAPID, Reader, Side};

impl<'s> Reader<'s> {
    /// The speed of a block that moves.
    pub(super) fn known_speed(&self, speed: Option<Speed>) -> Result<Speed> {
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

    /// Speed that the block gives; a feed stays, `FMAX` and `FT` hold for the block.
    pub(super) fn speed(&mut self, words: &mut [Word<'s>]) -> Result<Option<Speed>> {
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
                    self.lacks(&bytes, "FAUTO without a feed in the tool call").help("program F")
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
    pub(super) fn side(&mut self, words: &mut [Word<'s>]) -> Result<()> {
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

    /// Refuses a switch of the compensation on anything but a straight move in the plane from a known place.
    pub(super) fn switched(&self, before: Side, end: Option<[Option<f64>; 3]>) -> Result<()> {
        let now = self.modal.comp;
        if before == now {
            return Ok(());
        }
        if before != Side::Off && now != Side::Off {
            return Err(self.while_on("the side of the compensation changes").into());
        }
        let from = self.modal.position;
        let moves = end.is_some_and(|end| {
            let known = (0..2).all(|k| from[k].is_some() && end[k].is_some());
            known && (from[0] != end[0] || from[1] != end[1])
        });
        if moves {
            return Ok(());
        }
        let message =
            "the compensation is switched on a move that is not straight in the plane, from a known place";
        let finding = self.place.error(Code::COMPENSATION, &self.here, message);
        Err(finding.help("enter and leave by L in X and Y").into())
    }

    /// Refuses what the control does not take while the compensation is on.
    pub(super) fn uncompensated(&self, what: &str) -> Result<()> {
        if self.modal.comp == Side::Off { Ok(()) } else { Err(self.while_on(what).into()) }
    }

    fn while_on(&self, what: &str) -> Finding {
        let message = format!("{what} while the radius compensation is on");
        self.place
            .error(Code::COMPENSATION, &self.here, message)
            .help("switch it off (R0) on a straight move first")
    }
}
