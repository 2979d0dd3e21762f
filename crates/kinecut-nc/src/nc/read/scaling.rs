//! Scaled and mirrored coordinates: `G51`, `G50`, and `G51.1`, `G50.1` of FANUC.
//!
//! A programmed point is mirrored first, then scaled, then turned by `G68` and shifted by `G52`: the reader keeps its place as it is
//! programmed, and maps what it appends. An arc changes its sense and the cutter compensation its side where one axis of the plane is
//! mirrored; the angle of `G68` too, whose centre is mapped like any point. An arc whose axes have two factors is no circle: refused.
//!
//! `G51 X Y Z` says the centre in work coordinates, the present place where an axis is left out. `P` is the factor of all axes, `I J K`
//! are those of X, Y, Z; without a point a FANUC counts thousandths (or hundred-thousandths by parameter 5400 SCR), and what a Haas
//! reads then is not clear from its manual. A factor that is left out is a parameter of the machine: refused.
//!
//! While coordinates are scaled or mirrored there is no `G28`, `G30`, `G52` to `G59`, `G92`, tilted plane, rotary axis or involute. They
//! do not change within a rotation or a cutter compensation. Cycles are read where their axis is not scaled.
//!
//! Source: programming manual of the SINUMERIK 802D sl and 840D, ISO milling, 3-65 (mirror image: arcs, compensation, rotation, order,
//! codes that are forbidden), user's manual of the 30i, page 211 (`G68` within `G51`), descriptions of the 16i, page 117 (`I J`, unit),
//! Haas 96-8000, pages 136 and 161.

use glam::DVec3;

use crate::base::{Finding, Result};
use crate::nc::axis_map::AxisMap;
use crate::nc::dialect::{AXES, Code};
use crate::program::{Comp, Tcp};

use super::block::Word;
use super::place::Bytes;
use super::reader::{Reader, Value, take};

/// Scaling and mirroring in force.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Scaling {
    /// Centre [mm] and factors.
    scale: Option<(DVec3, DVec3)>,
    /// Place at which each axis is mirrored [mm].
    mirror: [Option<f64>; 3],
    /// Both together, where there is one.
    pub(super) map: Option<AxisMap>,
}

impl Scaling {
    /// A number that differs where the map does.
    pub(super) fn state(&self) -> u64 {
        let [zero, one] = [DVec3::ZERO, DVec3::ONE].map(|p| self.map.map_or(p, |map| map.point(p)));
        let numbers = zero.to_array().into_iter().chain(one.to_array());
        numbers.fold(0, |a, v| (a ^ v.to_bits()).wrapping_mul(0x0100_0000_01b3).rotate_left(17))
    }

    /// Both together.
    fn of(&self) -> Option<AxisMap> {
        let mut mirror = AxisMap::IDENTITY;
        for axis in 0..3 {
            if let Some(at) = self.mirror[axis] {
                let (mut centre, mut factor) = (DVec3::ZERO, DVec3::ONE);
                (centre[axis], factor[axis]) = (at, -1.0);
                mirror = AxisMap::about(centre, factor).after(&mirror);
            }
        }
        let all = match self.scale {
            Some((centre, factor)) => AxisMap::about(centre, factor).after(&mirror),
            None => mirror,
        };
        (all != AxisMap::IDENTITY).then_some(all)
    }
}

fn is_scaling(c: Code) -> bool {
    matches!(c, Code::Scale { .. } | Code::Mirror { .. })
}

impl<'s> Reader<'s> {
    /// Executes the codes of a block that scale or mirror.
    pub(super) fn scaling(&mut self, words: &mut [Word<'s>]) -> Result<()> {
        let Some((code, bytes)) = self.code(is_scaling) else { return self.while_scaled(words) };
        self.may_change_scaling(code, &bytes)?;
        let mut next = self.scaling;
        match code {
            Code::Scale { on: true } => next.scale = Some(self.scale(words, &bytes)?),
            Code::Scale { on: false } => next.scale = None,
            Code::Mirror { on: true } => {
                let named = self.lengths(words);
                if named == [None; 3] {
                    return Err(self.lacks(&bytes, "a mirror image without an axis").into());
                }
                if !self.modal.absolute {
                    let finding = self.lacks(&bytes, "the place of a mirror image as an increment (G91)");
                    return Err(finding.help("program G90").into());
                }
                for axis in 0..3 {
                    next.mirror[axis] = named[axis].or(next.mirror[axis]);
                }
            }
            _ => {
                let named = self.lengths(words);
                for axis in 0..3 {
                    if named == [None; 3] || named[axis].is_some() {
                        next.mirror[axis] = None;
                    }
                }
            }
        }
        next.map = next.of();
        let before = self.scaling.map.unwrap_or(AxisMap::IDENTITY);
        let after = next.map.unwrap_or(AxisMap::IDENTITY);
        if before != after {
            self.modal.position = after.place_before(before.place(self.modal.position));
        }
        self.scaling = next;
        self.modal.sticky.end();
        Ok(())
    }

    /// Refuses a change where the control takes none.
    fn may_change_scaling(&self, code: Code, bytes: &Bytes) -> Result<()> {
        let axes = &self.modal.rotary_axes;
        let mirror = matches!(code, Code::Mirror { .. });
        let why = if self.modal.turned.degrees != 0.0 {
            ("while the coordinates are turned", "program G69 first")
        } else if mirror && self.scaling.scale.is_some() {
            ("while the coordinates are scaled", "program G50 first")
        } else if self.modal.comp != Comp::Off {
            ("while the cutter compensation is on", "program G40 first")
        } else if axes.plane.is_some() || axes.tcp != Tcp::Off {
            ("in a tilted plane or under control of the tool centre point", "end that first")
        } else if self.corner.is_some() {
            ("behind a corner that waits for its move", "write the move first")
        } else {
            return Ok(());
        };
        let message = format!("`{}`: not {}", self.place.shown(bytes), why.0);
        Err(self.lacks(bytes, &message).help(why.1).into())
    }

    /// Centre [mm] and factors of `G51`.
    fn scale(&mut self, words: &mut [Word<'s>], bytes: &Bytes) -> Result<(DVec3, DVec3)> {
        let named = self.lengths(words);
        let mut centre = DVec3::ZERO;
        for axis in 0..3 {
            let Some(at) = named[axis].or(self.modal.position[axis]) else {
                let message = format!(
                    "coordinates are scaled about the present {}, which the program has not set",
                    AXES[axis]
                );
                let finding = self.lacks(bytes, &message);
                return Err(finding.help(format!("program {} of the centre", AXES[axis])).into());
            };
            centre[axis] = at;
        }
        let all = take(words, "P");
        let each = ["I", "J", "K"].map(|name| take(words, name));
        let factor = match (all, each) {
            (Some(all), [None, None, None]) => DVec3::splat(self.factor(&all, true)?),
            (None, [Some(i), Some(j), Some(k)]) => {
                DVec3::new(self.factor(&i, false)?, self.factor(&j, false)?, self.factor(&k, false)?)
            }
            _ => {
                let message =
                    "a scaling needs P, or I, J and K: what is left out is a parameter of the machine";
                return Err(self.lacks(bytes, message).help("program the factors of all axes").into());
            }
        };
        Ok((centre, factor))
    }

    fn factor(&self, value: &Value, positive: bool) -> Result<f64> {
        if value.value == 0.0 || positive && value.value < 0.0 {
            return Err(self.place.malformed(&value.bytes, "this is no factor of a scaling").into());
        }
        Ok(value.value)
    }

    /// Gives the factors of a block with `G51` their values.
    pub(super) fn factors_without_point(&mut self, words: &mut [Word<'s>]) -> Result<()> {
        for word in words.iter_mut().filter(|w| ["P", "I", "J", "K"].iter().any(|n| w.is(n))) {
            if word.computed {
                let why = "the unit of a factor that is computed is not known";
                return Err(self.place.not_understood(&word.bytes, why).into());
            }
            if word.point {
                continue;
            }
            if self.dialect.haas {
                let why = "whether a factor without a point counts thousandths is not clear from the manual";
                let finding = self.place.not_understood(&word.bytes, why);
                return Err(finding.help("write it with a point").into());
            }
            if let Some(value) = &mut word.value {
                *value *= 0.001;
            }
            self.note("a factor of G51 without a point counts thousandths (parameter 5400 SCR 0)");
        }
        Ok(())
    }

    /// Refuses what a control does not take, or what is not read, while coordinates are scaled or mirrored.
    fn while_scaled(&self, words: &[Word<'s>]) -> Result<()> {
        let Some(map) = self.scaling.map else { return Ok(()) };
        let forbidden = |c: Code| {
            matches!(
                c,
                Code::Reference
                    | Code::FurtherReference
                    | Code::MachineFrame
                    | Code::LocalShift
                    | Code::Work(_)
                    | Code::SetData
                    | Code::PresetShift
                    | Code::Tilt
                    | Code::TiltByTool
                    | Code::TipControl { .. }
                    | Code::Involute { .. }
            )
        };
        if let Some((_, bytes)) = self.code(forbidden) {
            return Err(self.not_scaled(&bytes).into());
        }
        if self.has_rotary(words) {
            return Err(self.not_scaled(&self.here).into());
        }
        if self.code(|c| c == (Code::Rotation { on: true })).is_some() && self.mirrors_by_factor() {
            let message = "a rotation within a scaling by negative factors: which way it turns is not known";
            return Err(self.lacks(&self.here, message).help("mirror by G51.1").into());
        }
        let plane = self.code(|c| matches!(c, Code::Plane(_)));
        let plane = match plane {
            Some((Code::Plane(plane), _)) => plane,
            _ => self.modal.plane,
        };
        let motion = self.motion_code().map_or(self.modal.motion, |(code, _)| Some(code));
        let moves =
            self.has_axis(words) || words.iter().any(|w| ["I", "J", "K", "R"].iter().any(|n| w.is(n)));
        if matches!(motion, Some(Code::Arc { .. })) && moves && !map.keeps_circles(plane) {
            let message = "an arc whose two axes are scaled by different factors is no circle";
            return Err(self.lacks(&self.here, message).help("program it as lines").into());
        }
        Ok(())
    }

    fn mirrors_by_factor(&self) -> bool {
        self.scaling.scale.is_some_and(|(_, factor)| factor.min_element() < 0.0)
    }

    fn not_scaled(&self, bytes: &Bytes) -> Finding {
        let message =
            format!("`{}`: not while the coordinates are scaled or mirrored", self.place.shown(bytes));
        self.lacks(bytes, &message).help("program G50 (G50.1) first")
    }

    /// Refuses a cycle whose heights, or whose step aside, would be scaled.
    pub(super) fn cycle_is_not_scaled(&self, steps_aside: bool) -> Result<()> {
        let Some(map) = self.scaling.map else { return Ok(()) };
        let [_, _, n] = self.modal.plane.axes();
        if map.keeps(n) && !steps_aside {
            return Ok(());
        }
        let message = "a cycle whose heights or step aside are scaled or mirrored: what of them is differs";
        Err(self.lacks(&self.here, message).help("leave its axis as it is, by I, J and K").into())
    }

    /// Refuses a corner in scaled coordinates.
    pub(super) fn corner_is_not_scaled(&self, bytes: &Bytes) -> Result<()> {
        match self.scaling.map {
            Some(_) => Err(self.not_scaled(bytes).into()),
            None => Ok(()),
        }
    }

    /// The place of the tip in the frame of the state.
    pub(super) fn mapped(&self, at: [Option<f64>; 3]) -> [Option<f64>; 3] {
        self.scaling.map.map_or(at, |map| map.place(at))
    }

    /// A place in the frame of the state as it is programmed.
    pub(super) fn programmed(&self, at: [Option<f64>; 3]) -> [Option<f64>; 3] {
        self.scaling.map.map_or(at, |map| map.place_before(at))
    }
}
