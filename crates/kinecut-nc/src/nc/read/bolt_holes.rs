//! Patterns of holes of a Haas: `G70` on a circle, `G71` on an arc, `G72` on a line, with the cycle in force or that of the block.
//!
//! `G70 I J L`: L holes around the circle of radius I, the first at the angle J from the first axis, against the clock, or with it where
//! L is negative. `G71 I J K L`: L holes on that circle, K degrees apart. `G72 I J L`: L holes on the line at the angle J, I apart, the
//! first where it begins. The centre, or the begin, is the present place or X and Y of the block; no hole is made there by the word
//! itself. The words last for their block.
//!
//! Source: programming manual of the YASNAC PC NC, pages 170 to 172, whose words they are; pages on Haas of others (`G71`, `L0`).

use glam::DVec2;

use crate::base::Result;
use crate::nc::dialect::{AXES, Code, Plane};
use crate::nc::turn;

use super::block::{Word, WordMode};
use super::place::Bytes;
use super::reader::{Reader, Value, take};

/// A pattern of holes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(in crate::nc) enum Pattern {
    /// `G70`.
    Circle,
    /// `G71`.
    Arc,
    /// `G72`.
    Line,
}

/// Most holes of a pattern: a slip of the pen beyond it.
const MOST_HOLES: f64 = 10_000.0;

impl<'s> Reader<'s> {
    /// Executes `G70`, `G71` or `G72`.
    pub(super) fn pattern(&mut self, words: &mut [Word<'s>], pattern: Pattern, bytes: &Bytes) -> Result<()> {
        if let Some((code, _)) = self.motion_code() {
            self.puts_in_force(code);
        }
        let Some(Code::Cycle(kind)) = self.modal.motion else {
            let finding = self.lacks(bytes, "a pattern of holes without a cycle in force");
            return Err(finding.help("program the cycle before it, or in its block").into());
        };
        if self.modal.plane != Plane::Xy {
            return Err(self.place.not_understood(bytes, "patterns of holes are read in G17 only").into());
        }
        let holes = self.holes(words, pattern, bytes)?;
        let like = Word {
            name: AXES[0],
            value: None,
            bytes: bytes.clone(),
            way: WordMode::Absolute,
            point: true,
            computed: false,
            used: false,
        };
        for (i, hole) in holes.into_iter().enumerate() {
            let place = hole / self.modal.length_unit;
            let of = |axis: usize| Word { name: AXES[axis], value: Some(place[axis]), ..like.clone() };
            // The first has the words of the cycle that the block says.
            let own = if i == 0 { words.len() } else { 0 };
            let mut all: Vec<Word<'s>> = words[..own].iter().cloned().chain([of(0), of(1)]).collect();
            self.cycle(&mut all, kind)?;
            for (word, done) in words.iter_mut().zip(&all[..own]) {
                word.used |= done.used;
            }
        }
        Ok(())
    }

    /// Places of the holes [mm].
    fn holes(&mut self, words: &mut [Word<'s>], pattern: Pattern, bytes: &Bytes) -> Result<Vec<DVec2>> {
        let unit = self.modal.length_unit;
        let mut centre = [0.0; 2];
        for (axis, at) in centre.iter_mut().enumerate() {
            let before = self.modal.position[axis];
            let said = take(words, AXES[axis]).map(|word| word.value * unit);
            let place = match (said, self.modal.absolute, before) {
                (Some(value), true, _) => Some(value),
                (Some(value), false, before) => before.map(|b| b + value),
                (None, _, before) => before,
            };
            let Some(place) = place else {
                let message =
                    format!("a pattern of holes about a {} that the program has not set", AXES[axis]);
                return Err(self.lacks(bytes, &message).help("move there first").into());
            };
            *at = place;
        }
        let centre = DVec2::from_array(centre);
        let needed = |this: &Reader<'s>, words: &mut [Word<'s>], name: &str| -> Result<Value> {
            take(words, name).ok_or_else(|| {
                let message = format!("a pattern of holes without {name}");
                this.lacks(bytes, &message).into()
            })
        };
        let size = needed(self, words, "I")?;
        let angle = needed(self, words, "J")?.value;
        let count = needed(self, words, "L")?;
        let whole = count.value.fract() == 0.0 && (1.0..=MOST_HOLES).contains(&count.value.abs());
        if !whole || count.value < 0.0 && pattern != Pattern::Circle {
            return Err(self.place.malformed(&count.bytes, "this is no number of holes").into());
        }
        if size.value <= 0.0 && pattern != Pattern::Line {
            return Err(self
                .place
                .malformed(&size.bytes, "the radius of a pattern of holes is positive")
                .into());
        }
        let step = match pattern {
            Pattern::Circle => 360.0 / count.value,
            Pattern::Arc => needed(self, words, "K")?.value,
            Pattern::Line => 0.0,
        };
        let size = size.value * unit;
        let direction = |degrees: f64| turn::rotation(degrees).x_axis.truncate();
        Ok((0..count.value.abs() as u32)
            .map(|i| match pattern {
                Pattern::Line => centre + direction(angle) * (size * f64::from(i)),
                _ => centre + direction(angle + step * f64::from(i)) * size,
            })
            .collect())
    }
}
