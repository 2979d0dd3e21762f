//! Blocks of motion.

use glam::{DVec2, DVec3};

use crate::base::{Code, Finding, Result};
use crate::geom::{Arc, Curve};
use crate::nc::dialect::{AXES, Plane};
use crate::program::{AxisPositions, Comp, Move, Path, Speed, State, Target};

use super::klartext::rotary::{Orientation, rotary_counts};
use super::{Writer, unsupported};

impl Writer<'_> {
    pub(super) fn motion(&mut self, motion: &Move, state: &State) -> Result<()> {
        match motion.end {
            Target::Joints(joints) => self.joints(joints, motion, state),
            Target::Orient if self.klartext() => self.klartext_orient(motion, state),
            Target::Orient => self.orient(motion, state),
            Target::Tip { point, axis } => {
                // A move that vanishes in the rounding must not leave words of its state behind.
                let (modal, suspended) = (self.modal.clone(), self.length_suspended);
                let pending = self.length_pending.clone();
                let place = self.place;
                let lines = self.page.len();
                self.prepare(state)?;
                let prepared = self.page.len();
                if self.klartext() {
                    let orientation = self.klartext_orientation(motion, axis, state)?;
                    if !matches!(orientation, Orientation::Kept) {
                        return self.klartext_turning(point, &orientation, state);
                    }
                }
                if motion.path != Path::Line || state.comp != self.modal.comp.unwrap_or(Comp::Off) {
                    self.name_place(state.speed)?;
                }
                let prepared = if self.klartext() {
                    prepared
                } else {
                    let before = self.page.len();
                    self.tool_axis(axis, state)?;
                    // Words of the control of the tip are those of a state too.
                    prepared + self.page.len() - before
                };
                let enters = self.modal.comp.is_none() && state.comp != Comp::Off;
                self.compensation(motion, point, state)?;
                let before = self.page.len();
                self.turned_tip(motion, point, state)?;
                self.entered_in_one_block(motion, enters, before)?;
                if self.page.len() == prepared {
                    self.page.truncate(lines);
                    let same = self.modal.rotary_axes.same_coordinates(&modal.rotary_axes);
                    if !same || self.modal.placed_in != modal.placed_in {
                        self.place = place;
                    }
                    self.length_pending = pending;
                    (self.modal, self.length_suspended) = (modal, suspended);
                }
                Ok(())
            }
        }
    }

    /// A move along Z only, of a cycle.
    pub(super) fn axial(&mut self, height: f64, rapid: bool, state: &State) -> Result<()> {
        let [x, y, _] = self.place.exact;
        let speed = if rapid { Speed::Rapid { linear: false } } else { state.speed };
        let end = Target::Tip { point: DVec3::new(x, y, height), axis: self.kept_axis() };
        self.motion(&Move { end, path: Path::Line }, &State { speed, ..*state })
    }

    fn joints(&mut self, joints: AxisPositions, motion: &Move, state: &State) -> Result<()> {
        if motion.path != Path::Line {
            return Err(unsupported("a move in machine coordinates must be straight").into());
        }
        let rotary = rotary_counts([joints[3], joints[4], joints[5]])?;
        self.uncompensated("a move in machine coordinates comes")?;
        self.klartext_tcp_off();
        self.rotary_axes_off()?;
        self.turn_off()?;
        self.state(state, false)?;
        let [before, between, after] = self.dialect.machine_frame;
        let rapid = matches!(state.speed, Speed::Rapid { .. });
        let mut axes = String::new();
        for (axis, joint) in joints[..3].iter().enumerate() {
            if let Some(value) = joint {
                self.grid.word(&mut axes, AXES[axis], self.grid.round(*value)?);
                self.forget_axis(axis);
            }
        }
        if self.klartext() {
            self.joint_words(rotary, &mut axes)?;
        } else {
            for (letter, joint) in joints[3..].iter().enumerate() {
                if let Some(angle) = joint {
                    self.rotary(&mut axes, letter, *angle, true)?;
                }
            }
        }
        if axes.is_empty() {
            return Ok(());
        }
        self.of_length(&axes, state.speed)?;
        if joints[0].is_some() != joints[1].is_some() && self.modal.placed_in.is_some_and(|p| p.1.ticks != 0)
        {
            // Both coordinates of a turned frame change.
            self.forget_axis(0);
            self.forget_axis(1);
        }
        if self.modal.placed_in.is_some_and(|p| p.1.tilt.is_some()) {
            (0..3).for_each(|axis| self.forget_axis(axis));
        }
        if self.klartext() {
            return self.klartext_joints(&axes, state.speed);
        }
        let word = if rapid { "G0" } else { "G1" };
        self.modal.motion = Some(word);
        let (mode, feed) = self.feed_words(state.speed)?;
        let mut block = String::new();
        if let Some(mode) = mode {
            block.push_str(mode);
            block.push(' ');
        }
        block.push_str(&format!("{before}{word}{between} {axes}{after}"));
        if let Some(feed) = feed {
            block.push_str(&format!(" F{feed}"));
        }
        self.length_suspended |= self.dialect.suspends_length && self.length.is_some();
        if let (true, Some(_), Some(register)) = (self.dialect.recalls_length, joints[2], self.length) {
            self.length_pending = Some(format!("{}{register}", self.dialect.length_on));
        }
        self.page.block(block);
        Ok(())
    }

    /// Refuses a feed per minute of rotary axes alone in a program in inches: controls take it in degrees, or as if degrees were
    /// inches.
    fn of_length(&self, axes: &str, speed: Speed) -> Result<()> {
        let alone = !axes.contains(['X', 'Y', 'Z']);
        if !(alone && self.settings.units.is_inch() && matches!(speed, Speed::PerMinute(_))) {
            return Ok(());
        }
        Err(unsupported("rotary axes alone turn at a feed per minute, which is not written in inches")
            .help("post the program in millimetres, or turn them in rapid or in inverse time")
            .into())
    }

    /// The words that a move in the frame of the program needs before it.
    fn prepare(&mut self, state: &State) -> Result<()> {
        if self.length_suspended {
            let length = self.length;
            self.length_word(length)?;
        }
        self.state(state, true)
    }

    /// A move of the tip, with the words of the rotary axes in its one block.
    fn turned_tip(&mut self, motion: &Move, point: DVec3, state: &State) -> Result<()> {
        let turns = !self.modal.rotary_axes.words.is_empty();
        let before = self.page.len();
        match (state.speed, motion.path) {
            (Speed::Duration(seconds), path) if path != Path::Line => {
                self.in_shared_time(seconds, |writer| writer.tip(motion, point, state))?;
            }
            _ => self.tip(motion, point, state)?,
        }
        if turns && (self.page.len() != before + 1 || !matches!(motion.path, Path::Line | Path::Arc { .. })) {
            return Err(unsupported("a curve on which rotary axes turn does not fit into one block")
                .help("give it as straight moves")
                .into());
        }
        Ok(())
    }

    /// Appends the words of the rotary axes that wait for a block.
    pub(super) fn rotary_words(&mut self, axes: &mut String) {
        let words = std::mem::take(&mut self.modal.rotary_axes.words);
        if !words.is_empty() {
            if !axes.is_empty() {
                axes.push(' ');
            }
            axes.push_str(&words);
        }
    }

    fn tip(&mut self, motion: &Move, point: DVec3, state: &State) -> Result<()> {
        let rapid = matches!(state.speed, Speed::Rapid { .. });
        if !rapid && !point.is_finite() {
            return Err(
                Finding::error(Code::NC_STATE, "a feed move has a coordinate that is not known").into()
            );
        }
        if motion.path == Path::Line {
            let mut point = point.to_array();
            // Under words of a frame that were just said, what stays is named too.
            for (axis, value) in point.iter_mut().enumerate() {
                if value.is_nan() && self.place.written[axis].is_none() {
                    *value = self.place.exact[axis];
                }
            }
            return self.line(point, state.speed);
        }
        if rapid {
            return Err(unsupported("a rapid move must be straight").into());
        }
        let start = DVec3::from_array(self.place.exact);
        if !start.is_finite() {
            return Err(Finding::error(Code::NC_STATE, "a curve starts where the position is not known")
                .help("move to its start first")
                .into());
        }
        if !self.settings.arcs {
            if let Some(curve) = motion.curve(start) {
                self.chords(&curve, self.settings.chord_tolerance, state.speed)?;
            }
            return self.line(point.to_array(), state.speed);
        }
        match motion.path {
            Path::Line => self.line(point.to_array(), state.speed),
            Path::Arc { centre, axis, sweep, rise } => {
                self.arc(&Arc { start, centre, axis, sweep, rise }, point, state.speed)
            }
            Path::Involute { record, rise }
                if record.base_radius() != 0.0
                    && !record.is_line()
                    && self.takes_cubics(Some(rise), point)? =>
            {
                self.cubics(&record.into(), point, state.speed)
            }
            Path::Involute { record, rise } => self.involute(&record, rise, point, state.speed),
            Path::Spiral { spiral, rise } if self.spiral_as_arc(&spiral, &rise, point, state.speed)? => {
                Ok(())
            }
            Path::Spiral { spiral, rise } if self.takes_cubics(rise.is_even(), point)? => {
                self.cubics(&spiral.into(), point, state.speed)
            }
            Path::Spiral { spiral, rise } => self.spiral(&spiral, &rise, point, state.speed),
            Path::Bezier { span } => self.bezier(&span, point, state.speed),
        }
    }

    /// A straight move to `point`; coordinates that are not numbers stay. Nothing is written for no movement.
    pub(super) fn line(&mut self, point: [f64; 3], speed: Speed) -> Result<()> {
        let mut axes = String::new();
        let before = self.place.written;
        for (axis, value) in point.into_iter().enumerate() {
            // After a polar arc the control may be off the grid.
            self.axis(&mut axes, axis, value, axis != 2 && self.modal.pen.beside.is_some())?;
        }
        self.rotary_words(&mut axes);
        if axes.is_empty() {
            return Ok(());
        }
        self.of_length(&axes, speed)?;
        let speed = self.timed(speed, self.straight_length(before));
        if self.klartext() {
            return self.klartext_line(&axes, speed);
        }
        let rapid = matches!(speed, Speed::Rapid { .. });
        let word = if rapid { "G0" } else { "G1" };
        // A rapid says so in every block: it is the block a person looks for.
        let change = rapid || self.modal.motion != Some(word);
        self.modal.motion = Some(word);
        self.emit(None, change.then_some(word), &axes, speed)
    }

    /// The word of an axis, if it moves (or always), and the new place.
    pub(super) fn axis(&mut self, words: &mut String, axis: usize, value: f64, always: bool) -> Result<()> {
        if value.is_nan() {
            return Ok(());
        }
        let count = self.grid.round(value)?;
        if always || self.place.written[axis] != Some(count) {
            self.grid.word(words, AXES[axis], count);
        }
        self.place.written[axis] = Some(count);
        self.place.exact[axis] = value;
        self.notes.rounding = self.notes.rounding.max((self.grid.value(count) - value).abs());
        Ok(())
    }

    /// A block of motion with its feed.
    pub(super) fn emit(
        &mut self,
        plane: Option<Plane>,
        word: Option<&str>,
        axes: &str,
        speed: Speed,
    ) -> Result<()> {
        let (mode, feed) = self.feed_words(speed)?;
        let plane = plane.filter(|p| self.modal.plane != Some(*p));
        if plane.is_some() {
            self.uncompensated("the plane changes")?;
            self.modal.plane = plane;
        }
        // The call of a length that moves the axis goes with the axis.
        let length = if axes.contains('Z') { self.length_pending.take() } else { None };
        let comp = self.modal.comp_word.take();
        let said = [plane.map(Plane::word), comp.as_deref(), mode, length.as_deref(), word];
        let mut block = String::with_capacity(axes.len() + 24);
        for part in said.into_iter().flatten() {
            block.push_str(part);
            block.push(' ');
        }
        block.push_str(axes);
        if let Some(feed) = &feed {
            block.push_str(" F");
            block.push_str(feed);
        }
        let Some(limit) = self.line_limit() else {
            self.page.block(block);
            return Ok(());
        };
        if block.len() <= limit {
            self.page.block(block);
            return Ok(());
        }
        // Too long for one line: what stays in force goes before, and blanks say nothing.
        for part in [plane.map(Plane::word), mode].into_iter().flatten() {
            self.page.block(part.to_owned());
        }
        let inverse_time = matches!(speed, Speed::Duration(_));
        let mut block = word.unwrap_or_default().to_owned();
        block.push_str(axes);
        match feed {
            Some(feed) if inverse_time => block.push_str(&format!("F{feed}")),
            Some(feed) => self.page.block(format!("F{feed}")),
            None => {}
        }
        block.retain(|c| c != ' ');
        if block.len() > limit {
            return Err(unsupported("a block is longer than the lines of this control")
                .value(block.len() as f64, "characters")
                .bound(limit as f64, "characters")
                .help("use fewer decimals or no block numbers")
                .into());
        }
        self.page.block(block);
        Ok(())
    }

    /// Room of a block in a line, without its number.
    fn line_limit(&self) -> Option<usize> {
        /// `N99999 `.
        const NUMBER: usize = 7;
        let room = if self.settings.block_numbers { NUMBER } else { 0 };
        self.dialect.line_limit.map(|limit| limit - room)
    }

    /// A curve as straight moves that leave it by at most `chord` [mm].
    pub(super) fn chords(&mut self, curve: &Curve, chord: f64, speed: Speed) -> Result<()> {
        for point in curve.polyline(chord).iter().skip(1) {
            self.line(point.to_array(), speed)?;
        }
        Ok(())
    }

    /// Position of the control, in steps; only after all axes were written.
    pub(super) fn written(&self, axis: usize) -> Result<i64> {
        self.place.written[axis].ok_or_else(|| {
            Finding::error(Code::NC_STATE, "a curve starts where the position is not known")
                .help("move to its start first")
                .into()
        })
    }

    /// The written place in the XY plane [mm].
    pub(super) fn written_xy(&self) -> Result<DVec2> {
        Ok(DVec2::new(self.grid.value(self.written(0)?), self.grid.value(self.written(1)?)))
    }
}
