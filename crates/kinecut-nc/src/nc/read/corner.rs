//! Corners that the control rounds or chamfers: `,R` and `,C` at the end of a move (FANUC, Haas).
//!
//! The word stands in a block with `G1`, `G2` or `G3`, and the next block is such a move too, in the plane in force; one dwell
//! may stand between and then runs behind the corner. The move is read to its programmed end, and kept as a corner: the next
//! move cuts both, so an increment still counts from the corner. It runs at the feed of the move before it. What comes instead of
//! that move is an error at the word.
//!
//! A Haas has them between straight moves only. `,C` is the distance from the corner at which the chamfer begins and ends: on an
//! arc along the chord.
//!
//! Source: operator's manual of the NCT 99M and 2000M, section 16.1 (words, `G1` to `G3`, plane, chord, errors), which follow the
//! FANUC; pages on Haas of others. The dwell between and the alarms of a FANUC are from general knowledge of its manuals.

use glam::{DVec2, DVec3};

use crate::base::{Finding, Result};
use crate::nc::corner_fit::{Joint, Leg, joined};
use crate::nc::dialect::{Code, FlowWords, Plane};
use crate::program::{Item, Move, Origin, Path, Speed, Target, Tcp, ToolAxis};

use super::block::{Block, Word};
use super::lex::{Lexer, range};
use super::place::Bytes;
use super::reader::{Reader, take};

/// Words of a corner.
const WORDS: [&str; 2] = [",R", ",C"];

/// A corner behind a move.
#[derive(Clone, Debug)]
pub(super) struct Corner {
    joint: Joint,
    bytes: Bytes,
    plane: Plane,
    /// The move before it: its item, where it starts and ends, its path, speed and origin.
    item: usize,
    start: DVec3,
    end: DVec3,
    path: Path,
    speed: Speed,
    origin: Origin,
    /// Wait behind the corner [s], and how many blocks say one.
    dwell: Option<f64>,
    waits: u32,
}

impl<'s> Lexer<'_, 's> {
    /// Whether a word of a corner begins at a byte.
    pub(super) fn is_corner(&self, at: usize, end: usize) -> bool {
        let next = self.place.text().as_bytes().get(at + 1).filter(|_| at + 1 < end);
        self.dialect.flow == FlowWords::MacroB && next.is_some_and(|b| matches!(b, b'R' | b'r' | b'C' | b'c'))
    }

    /// The word of a corner: a comma, a letter and its number.
    pub(super) fn corner_word(&self, at: usize, end: usize, block: &mut Block<'s>) -> Result<usize> {
        let before = block.words.len();
        let stop = self.letter_word(at + 1, end, block)?;
        if let Some(word) = block.words.get_mut(before) {
            word.name = &self.place.text()[at..at + 2];
            word.bytes = range(at, stop);
        }
        Ok(stop)
    }
}

impl<'s> Reader<'s> {
    /// Executes the motion of a block and the corner behind it.
    pub(super) fn motion_and_corner(&mut self, words: &mut [Word<'s>], machine: Option<Bytes>) -> Result<()> {
        if self.corner.is_none() && !words.iter().any(|w| WORDS.iter().any(|word| w.is(word))) {
            return self.motion(words, machine);
        }
        let [round, chamfer] = WORDS.map(|word| take(words, word));
        let unit = self.modal.length_unit;
        if let Some(word) = round.as_ref().or(chamfer.as_ref()) {
            self.corner_is_not_scaled(&word.bytes)?;
        }
        let next = match (round, chamfer) {
            (Some(_), Some(second)) => return Err(self.twice(&second.bytes).into()),
            (Some(word), None) => Some((Joint::Round(word.value * unit), word)),
            (None, Some(word)) => Some((Joint::Chamfer(word.value * unit), word)),
            (None, None) => None,
        };
        if let Some((_, word)) = next.as_ref().filter(|(_, word)| word.value <= 0.0) {
            return Err(self.place.malformed(&word.bytes, "the size of a corner is positive").into());
        }
        let behind = self.corner.as_ref().map(|corner| corner.bytes.clone());
        if behind.is_some() {
            self.may_end_corner(words)?;
        }
        let (item, at) = (self.program.items.len(), self.modal.position);
        let turns = self.has_rotary(words);
        self.motion(words, machine)?;
        if self.corner.as_ref().map(|corner| &corner.bytes) == behind.as_ref()
            && (self.code(|c| c == Code::Dwell).is_none()
                || self.corner.as_ref().is_some_and(|c| c.waits > 1))
        {
            self.corner_without_move()?;
        }
        match next {
            Some((_, word)) if turns => Err(self.no_corner(&word.bytes, "rotary axes turn").into()),
            Some((joint, word)) => self.begin_corner(joint, word.bytes, item, at),
            None => Ok(()),
        }
    }

    fn no_corner(&self, bytes: &Bytes, why: &str) -> Finding {
        self.lacks(bytes, &format!("`{}`: no corner is made here: {why}", self.place.shown(bytes)))
    }

    /// Refuses a corner whose next block is no move.
    pub(super) fn corner_without_move(&mut self) -> Result<()> {
        let Some(corner) = self.corner.take() else { return Ok(()) };
        let why = "the next block is no move by G1, G2 or G3 in the plane";
        Err(self.no_corner(&corner.bytes, why).help("write that move right behind it").into())
    }

    /// Keeps a wait for when the corner is made; whether it does.
    pub(super) fn waits_for_corner(&mut self, seconds: f64) -> bool {
        let Some(corner) = &mut self.corner else { return false };
        corner.waits += 1;
        corner.dwell = Some(seconds);
        true
    }

    /// Refuses what may not stand in the block behind a corner.
    fn may_end_corner(&mut self, words: &[Word<'s>]) -> Result<()> {
        let forbidden = |c: Code| {
            matches!(
                c,
                Code::Plane(_)
                    | Code::Comp { .. }
                    | Code::CompOff
                    | Code::Units { .. }
                    | Code::LengthOn
                    | Code::LengthOff
                    | Code::ToolChange
                    | Code::Work(_)
            )
        };
        let ends = self.code(forbidden).is_some() || self.has_rotary(words);
        if ends { self.corner_without_move() } else { Ok(()) }
    }

    /// Keeps the corner behind the move of the present block.
    fn begin_corner(
        &mut self,
        joint: Joint,
        bytes: Bytes,
        before: usize,
        at: [Option<f64>; 3],
    ) -> Result<()> {
        let known = |place: [Option<f64>; 3]| DVec3::from_array(place.map(|v| v.unwrap_or(f64::NAN)));
        let switched = self.code(|c| matches!(c, Code::Comp { .. } | Code::CompOff)).is_some();
        let is_move = matches!(self.modal.motion, Some(Code::Feed | Code::Arc { .. }));
        let last = self.program.items.len().checked_sub(1);
        let Some((item, path)) = last.filter(|last| *last >= before && is_move).and_then(|last| {
            let Item::Move(motion) = self.program.items.get(last) else { return None };
            matches!(motion.end, Target::Tip { axis: ToolAxis::Fixed, .. }).then_some((last, motion.path))
        }) else {
            return Err(self.no_corner(&bytes, "its block is no move by G1, G2 or G3").into());
        };
        let speed = self.program.state(item).speed;
        let why = if switched {
            Some("the cutter compensation is switched in its block")
        } else if matches!(speed, Speed::Duration(_)) {
            Some("the time of its move (G93) would be shared")
        } else if self.modal.rotary_axes.tcp != Tcp::Off {
            Some("the tool centre point is controlled")
        } else if self.dialect.haas && path != Path::Line {
            Some("this control has it between straight moves only")
        } else {
            None
        };
        if let Some(why) = why {
            return Err(self.no_corner(&bytes, why).into());
        }
        // A corner before has moved the start of this move.
        let start = (before..item).rev().find_map(|i| self.tip_of(i)).unwrap_or(known(at));
        let (end, origin) = (known(self.modal.position), self.origin);
        let plane = self.modal.plane;
        let (dwell, waits) = (None, 0);
        let corner = Corner { joint, bytes, plane, item, start, end, path, speed, origin, dwell, waits };
        self.corner = Some(corner);
        Ok(())
    }

    fn tip_of(&self, item: usize) -> Option<DVec3> {
        match self.program.items.get(item) {
            Item::Move(Move { end: Target::Tip { point, .. }, .. }) => Some(point),
            _ => None,
        }
    }

    /// Makes the corner before the move to `end`, if one waits; the path of what is left of that move.
    pub(super) fn through_corner(&mut self, end: [Option<f64>; 3], path: Path, speed: Speed) -> Result<Path> {
        let Some(corner) = self.corner.take() else { return Ok(path) };
        if matches!(speed, Speed::Rapid { .. } | Speed::Duration(_)) {
            self.corner = Some(corner);
            return self.corner_without_move().map(|()| path);
        }
        let [a, b, n] = corner.plane.axes();
        let end = DVec3::from_array(end.map(|v| v.unwrap_or(f64::NAN)));
        let heights = [corner.start, corner.end, end].map(|p| p[n]);
        let flat = heights.iter().all(|h| *h == heights[1]) || heights.iter().all(|h| h.is_nan());
        let of = |p: DVec3| DVec2::new(p[a], p[b]);
        let known = [corner.start, corner.end, end].map(of).iter().all(|p| p.is_finite());
        if !(flat && known) {
            let why =
                "its moves do not stay in the plane in force, or the program has not set where they start";
            return Err(self.no_corner(&corner.bytes, why).into());
        }
        let leg = |from: DVec3, to: DVec3, path: &Path| match *path {
            Path::Line => Some(Leg { from: of(from), to: of(to), arc: None }),
            Path::Arc { centre, sweep, .. } => {
                Some(Leg { from: of(from), to: of(to), arc: Some((of(centre), sweep)) })
            }
            _ => None,
        };
        let legs = (leg(corner.start, corner.end, &corner.path), leg(corner.end, end, &path));
        let (Some(first), Some(second)) = legs else { return Ok(path) };
        if self.dialect.haas && second.arc.is_some() {
            let why = "this control has it between straight moves only";
            return Err(self.no_corner(&corner.bytes, why).into());
        }
        if matches!(corner.joint, Joint::Chamfer(_)) && (first.arc.is_some() || second.arc.is_some()) {
            self.note("the size of a chamfer at an arc is read along the chord from the corner");
        }
        let Some((first, joint, second)) = joined(&first, &second, corner.joint) else {
            let finding = self.no_corner(&corner.bytes, "its moves are too short for it");
            return Err(finding.help("make it smaller").into());
        };
        let raised = |p: DVec2| {
            let mut point = corner.end;
            (point[a], point[b]) = (p.x, p.y);
            point
        };
        let mut axis = DVec3::ZERO;
        axis[n] = 1.0;
        let path_of = |leg: &Leg| match leg.arc {
            Some((centre, sweep)) => Path::Arc { centre: raised(centre), axis, sweep, rise: 0.0 },
            None => Path::Line,
        };
        let tip = Target::Tip { point: raised(first.to), axis: ToolAxis::Fixed };
        self.program.set_move(corner.item, Move { end: tip, path: path_of(&first) });
        if let Some(joint) = joint {
            let origin = std::mem::replace(&mut self.origin, corner.origin);
            let known = raised(joint.to).to_array().map(|v| Some(v).filter(|v| !v.is_nan()));
            self.push_tip(known, path_of(&joint), corner.speed);
            self.origin = origin;
        }
        if let Some(seconds) = corner.dwell {
            self.push_dwell(seconds);
        }
        Ok(path_of(&second))
    }
}
