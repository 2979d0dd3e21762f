//! Tilted working planes in klartext: `PLANE SPATIAL` and `PLANE RESET`.
//!
//! The origin of the plane is a datum shift (`CYCL DEF 7`) in the preset, which comes before the plane and is taken
//! back after it. Where the program orients the tool, the plane is written with `TURN`: only rotary axes move. Where it
//! does not, with `STAY`: nothing moves. `MOVE`, which moves the linear axes too, is not written.
//!
//! A plane is left with `PLANE RESET STAY`: rotary axes stay turned until the program turns them back. A program that
//! orients the tool in coordinates that are not tilted gets `PLANE RESET TURN`.

use crate::base::{Code, Finding, Result};
use crate::nc::grid::Grid;
use crate::nc::heidenhain::plane::ANGLE_DECIMALS;
use crate::nc::multi_axis::Rotaries;
use crate::nc::write::turn::SpatialPlane;
use crate::nc::write::{ToolPosition, Writer, unsupported};
use crate::program::{Move, Path, RotarySolution, Speed, State};

/// The angles of `PLANE SPATIAL`.
const SPATIAL: [&str; 3] = ["SPA", "SPB", "SPC"];

impl Writer<'_> {
    /// `Target::Orient`.
    pub(in crate::nc::write) fn klartext_orient(&mut self, motion: &Move, state: &State) -> Result<()> {
        if motion.path != Path::Line {
            return Err(unsupported("rotary axes turn to a plane straight").into());
        }
        self.uncompensated("a plane is tilted")?;
        let turn = format!("TURN {}", turn_feed(state.speed, self.feed_unit())?);
        self.klartext_tcp_off();
        self.modal.pen.leaves = self.program.in_tilted(state.frame).is_none();
        self.modal.pen.turn = Some(turn);
        let (offset, _) = self.frame_of(state)?;
        if self.modal.pen.leaves && self.modal.offset == Some(offset) {
            // The shift of the datum does not matter.
            if self.modal.turn.tilt.is_some() {
                self.turn_off()?;
            }
            self.state(state, false)?;
        } else {
            self.state(state, true)?;
        }
        // The words of the frame were in force already.
        if let Some(turn) = self.modal.pen.turn.take() {
            match self.modal.turn.tilt {
                Some(tilt) => {
                    self.modal.pen.turn = Some(turn);
                    self.klartext_plane(tilt)?;
                }
                None => self.page.block(format!("PLANE RESET {turn}")),
            }
        }
        self.modal.pen.rotary = [None; 3];
        if self.modal.turn.tilt.is_some() {
            self.modal.rotary_axes.rotaries.swing();
        } else {
            self.modal.rotary_axes.rotaries = Rotaries::default();
        }
        self.modal.pen.forget_place();
        self.place = ToolPosition::default();
        Ok(())
    }

    /// `PLANE SPATIAL`; with the turn of the rotary axes if one is wanted.
    pub(in crate::nc::write) fn klartext_plane(&mut self, tilt: SpatialPlane) -> Result<()> {
        let grid = Grid::new(ANGLE_DECIMALS, None, false)?.signed();
        let mut block = String::from("PLANE SPATIAL");
        for (name, count) in SPATIAL.into_iter().zip(tilt.angles) {
            block.push(' ');
            grid.word(&mut block, name, count);
        }
        block.push(' ');
        block.push_str(self.modal.pen.turn.take().as_deref().unwrap_or("STAY"));
        block.push_str(match tilt.branch {
            RotarySolution::Free => "",
            RotarySolution::Positive => " SEQ+",
            RotarySolution::Negative => " SEQ-",
        });
        block.push_str(" TABLE ROT");
        self.page.block(block);
        Ok(())
    }

    /// `PLANE RESET`; with the turn of the rotary axes if the plane is left by one.
    pub(in crate::nc::write) fn klartext_level(&mut self) {
        let pen = &mut self.modal.pen;
        let turn = if pen.leaves { pen.turn.take() } else { None };
        self.page.block(format!("PLANE RESET {}", turn.as_deref().unwrap_or("STAY")));
    }
}

/// The feed at which rotary axes turn to a plane, in a unit [mm/min].
fn turn_feed(speed: Speed, unit: f64) -> Result<String> {
    match speed {
        Speed::Rapid { .. } => Ok("FMAX".to_owned()),
        Speed::PerMinute(feed) if feed.is_finite() && feed > 0.0 => {
            Ok(format!("F{}", crate::nc::grid::plain(feed * 60.0 / unit)))
        }
        Speed::PerMinute(feed) => Err(Finding::error(Code::NC_STATE, "a feed move has no usable feed")
            .value(feed * 60.0, "mm/min")
            .into()),
        _ => Err(unsupported("rotary axes turn to a plane in rapid or at a feed per minute")
            .help("turn them in rapid")
            .into()),
    }
}
