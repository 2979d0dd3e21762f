//! Motion in klartext: `L`, `CC` and `C`, `CP`.
//!
//! A helix is written by its angle, which has four decimals of a degree and ends off the grid; the arc ends a
//! little early and a short line closes the gap. That line is as long as a chord may be that lies on the arc within
//! the rounding, so that it keeps the direction of the path.

use std::f64::consts::TAU;

use glam::{DVec2, DVec3};

use crate::base::Result;
use crate::geom::Arc;
use crate::nc::dialect::AXES;
use crate::nc::grid::{Grid, plain};
use crate::nc::heidenhain::polar::{TICKS, TURN, degrees, turned};
use crate::nc::write::arc::{FLAT, Rounded, round};
use crate::nc::write::{Writer, unsupported};
use crate::program::Speed;

/// Most turns of one helix block: 5400 degrees, the limit of the older controls (from memory).
const MOST_TURNS: i64 = 15;
/// Distance within which a polar arc ends where it was meant to [mm]: rounding of doubles at a metre.
const SAME: f64 = 1e-9;

impl Writer<'_> {
    /// A straight move.
    pub(in crate::nc::write) fn klartext_line(&mut self, axes: &str, speed: Speed) -> Result<()> {
        self.klartext_block(format!("L {axes}"), speed)
    }

    /// A straight block with its compensation and feed.
    pub(in crate::nc::write) fn klartext_block(&mut self, mut block: String, speed: Speed) -> Result<()> {
        self.modal.pen.beside = None;
        self.ending(&mut block, speed, true)?;
        self.page.block(block);
        Ok(())
    }

    /// A straight move in machine coordinates.
    pub(in crate::nc::write) fn klartext_joints(&mut self, axes: &str, speed: Speed) -> Result<()> {
        if self.modal.pen.wanted.is_some_and(|w| w != "R0") {
            return Err(unsupported("a move in machine coordinates cannot be compensated").into());
        }
        if self.place.written[0].is_none() || self.place.written[1].is_none() {
            self.modal.pen.beside = None;
        }
        let mut block = format!("L {axes}");
        self.ending(&mut block, speed, true)?;
        block.push_str(" M91");
        self.page.block(block);
        Ok(())
    }

    /// An arc in the plane; `centre` relative to its start [steps].
    pub(in crate::nc::write) fn klartext_arc(
        &mut self,
        end: [f64; 3],
        centre: [i64; 2],
        ccw: bool,
        speed: Speed,
    ) -> Result<()> {
        let pole = [self.written(0)? + centre[0], self.written(1)? + centre[1]];
        self.pole(pole);
        let mut block = String::from("C ");
        for (axis, value) in end.into_iter().enumerate() {
            self.axis(&mut block, axis, value, axis != 2)?;
        }
        self.modal.pen.beside = None;
        block.push_str(if ccw { " DR+" } else { " DR-" });
        self.ending(&mut block, speed, false)?;
        self.page.block(block);
        Ok(())
    }

    fn pole(&mut self, pole: [i64; 2]) {
        if self.modal.pen.pole.replace(pole) == Some(pole) {
            return;
        }
        let mut block = String::from("CC ");
        self.grid.word(&mut block, AXES[0], pole[0]);
        self.grid.word(&mut block, AXES[1], pole[1]);
        self.page.block(block);
    }

    /// Radius compensation and feed of a block.
    fn ending(&mut self, block: &mut String, speed: Speed, straight: bool) -> Result<()> {
        let (_, feed) = self.feed_words(speed)?;
        let rapid = matches!(speed, Speed::Rapid { .. });
        if self.modal.pen.stop && !rapid {
            return Err(unsupported("this control has no word for an exact stop at the end of a block")
                .help("ask for a continuous path within a tolerance")
                .into());
        }
        let wanted = self.modal.pen.wanted.unwrap_or("R0");
        if straight {
            if rapid || self.modal.pen.comp != Some(wanted) {
                block.push(' ');
                block.push_str(wanted);
                self.modal.pen.comp = Some(wanted);
            }
        } else if self.modal.pen.comp.unwrap_or("R0") != wanted {
            return Err(unsupported("cutter compensation begins and ends on a straight move").into());
        }
        if rapid {
            block.push_str(" FMAX");
        } else if let Some(feed) = feed {
            block.push_str(match speed {
                Speed::PerRevolution(_) => " FU",
                Speed::Duration(_) => " FT",
                _ => " F",
            });
            block.push_str(&feed_value(speed, feed));
        }
        Ok(())
    }

    /// A helix: `CP IPA`, and where its angle does not lead to a point of the grid, a short line at its end.
    ///
    /// `sweep` counter-clockwise about Z [rad].
    pub(in crate::nc::write) fn polar_arc(
        &mut self,
        arc: &Arc,
        sweep: f64,
        least_radius: f64,
        point: DVec3,
        speed: Speed,
    ) -> Result<()> {
        let ticks = (sweep.to_degrees() * TICKS).round() as i64;
        if ticks.abs() > MOST_TURNS * TURN {
            let part = MOST_TURNS as f64 * TAU / sweep.abs();
            return self.split(arc, part, true, point, speed);
        }
        let pole = [self.grid.round(arc.centre.x)?, self.grid.round(arc.centre.y)?];
        let centre = DVec2::new(self.grid.value(pole[0]), self.grid.value(pole[1]));
        let start = match self.modal.pen.beside {
            Some(beside) => beside,
            None => self.written_xy()?,
        };
        let end = point.truncate();
        let goal = [self.grid.round(end.x)?, self.grid.round(end.y)?];
        let on_grid = DVec2::new(self.grid.value(goal[0]), self.grid.value(goal[1]));
        let radius = self.grid.steps((start - centre).length());
        if ticks != 0 && radius >= least_radius {
            let there = turned(start, centre, degrees(ticks));
            let exact = (there - on_grid).length() <= SAME;
            if exact || (there - end).length() <= SAME {
                self.polar_block(pole, ticks, point, speed)?;
                self.modal.pen.beside = (!exact).then_some(there);
                return Ok(());
            }
        }
        // The last bit is a line that leaves the arc by no more than the rounding does.
        let back = (8.0 * FLAT * radius).sqrt() / radius;
        let between = (start - centre).angle_to(on_grid - centre);
        let total = between + TAU * ((sweep - between) / TAU).round();
        let steps = [goal[0] - self.written(0)?, goal[1] - self.written(1)?];
        let from = DVec2::new(self.grid.value(self.written(0)?), self.grid.value(self.written(1)?));
        let offset = (arc.centre.truncate() - from) / self.grid.unit();
        let flat = match round(steps, offset, sweep, least_radius) {
            Rounded::Straight | Rounded::Chords => true,
            Rounded::Arc { .. } | Rounded::Split { .. } => false,
        };
        if flat || radius < least_radius || total.abs() < LEAST_PARTS * back {
            return self.flat_arc(arc, point, speed);
        }
        let short = ((total.abs() - back).to_degrees() * TICKS).floor().copysign(total) as i64;
        let there = turned(start, centre, degrees(short));
        let part = degrees(short).to_radians() / total;
        let rise = point.z - self.place.exact[2];
        let mut height = self.place.exact[2] + rise * part;
        if self.grid.round(height)? == self.written(2)? {
            // A block without rise would be an arc in the plane.
            height = point.z;
        }
        self.polar_block(pole, short, there.extend(height), speed)?;
        self.modal.pen.beside = Some(there);
        self.line(point.to_array(), speed)
    }

    fn polar_block(&mut self, pole: [i64; 2], ticks: i64, end: DVec3, speed: Speed) -> Result<()> {
        let from = match self.modal.pen.beside {
            Some(beside) => beside,
            None => self.written_xy()?,
        };
        let centre = DVec2::new(self.grid.value(pole[0]), self.grid.value(pole[1]));
        let rise = self.grid.value(self.grid.round(end.z)?) - self.grid.value(self.written(2)?);
        let angle = degrees(ticks).to_radians();
        let speed = self.timed(speed, ((from - centre).length() * angle).hypot(rise));
        self.pole(pole);
        let mut block = String::from("CP ");
        Grid::new(4, None, false)?.signed().word(&mut block, "IPA", ticks);
        let mut unsaid = String::new();
        for (axis, value) in end.to_array().into_iter().enumerate() {
            let words = if axis == 2 { &mut block } else { &mut unsaid };
            self.axis(words, axis, value, axis == 2)?;
        }
        block.push_str(if ticks >= 0 { " DR+" } else { " DR-" });
        self.ending(&mut block, speed, false)?;
        self.page.block(block);
        Ok(())
    }
}

/// A helix shorter than this many of its closing lines is written as lines altogether.
const LEAST_PARTS: f64 = 3.0;

/// The number of a feed; the time of a block instead of its inverse.
fn feed_value(speed: Speed, feed: String) -> String {
    match speed {
        Speed::Duration(seconds) => plain(seconds),
        _ => feed,
    }
}
