//! What a bore operation is: the numbers of a plan, and their check.
//!
//! Lengths mm, feeds mm/s, angles rad. Points are relative to the bore's centre. Keys of findings are those of the
//! job file's `bore` operation.

use super::spiral::path_radius;
use crate::base::{Code, Error, Finding, Result};

/// Direction of the path at the wall, for a right-handed cutter (M3).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Sense {
    /// Counter-clockwise inside a bore.
    Climb,
    /// Clockwise.
    Conventional,
}

/// What the planner needs to know of the cutter.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CutterData {
    /// Diameter [mm].
    pub diameter: f64,
    /// Whether it cuts at its centre, so that it may plunge.
    pub centre_cutting: bool,
    /// Steepest way down it can follow [rad]; `None`: not known.
    pub max_ramp_angle: Option<f64>,
    /// Length of the cutting edges [mm].
    pub flute_length: f64,
}

/// Where roughing begins.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum RoughStart {
    /// In the centre.
    Centre,
    /// In a point, relative to the centre [mm].
    Point([f64; 2]),
    /// In the centre of a hole drilled before, at least as deep as the bore.
    PreDrilled {
        /// Its diameter [mm].
        diameter: f64,
    },
}

/// How the cutter comes down to a level.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Entry {
    /// Straight down into the material.
    Plunge,
    /// Down a helix about the bore's centre, with a flat turn at its foot.
    Helix {
        /// Radius of the path [mm]; below the cutter's radius, so that no core is left.
        radius: f64,
        /// Largest descent of a turn [mm].
        pitch: f64,
    },
    /// Straight down in the hole drilled before.
    PreDrilled,
}

/// Roughing.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Rough {
    /// Largest radial step (the paper's H_max) [mm].
    pub step: f64,
    /// Material left on the wall [mm].
    pub allowance: f64,
    /// Feed [mm/s].
    pub feed: f64,
    /// Feed of plunges and helices [mm/s].
    pub plunge_feed: f64,
    /// Largest depth of a level [mm]; `None`: as deep as the flutes are long.
    pub axial_step: Option<f64>,
}

/// A correction of the bore's diameter at the machine: the control compensates the finishing path by a register.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Wear {
    /// Radius register (D) of the control; see [`crate::nc::Control::wear_register`].
    pub register: u32,
    /// Largest absolute value that the register may carry [mm]; positive values make the bore smaller, by twice as
    /// much.
    pub largest: f64,
}

/// Finishing of the wall.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Finish {
    /// Turns of the lead-in's involute, counted from the bore's centre: more are flatter and longer.
    pub turns: u32,
    /// Feed [mm/s].
    pub feed: f64,
    /// Start of the lead-in, relative to the centre [mm]; `None`: half a turn before the wall, or more where that
    /// would not be clear of it.
    pub start: Option<[f64; 2]>,
    /// End of the lead-out, relative to the centre [mm]; `None`: the mirrored lead-in.
    pub end: Option<[f64; 2]>,
    /// Largest depth of a level [mm]; `None`: the whole depth at once if the flutes allow.
    pub axial_step: Option<f64>,
    /// Wear correction by the control; `None`: the path is run as planned.
    pub wear: Option<Wear>,
}

/// A bore to be milled.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BoreSpec {
    /// Centre, in the frame of the setup [mm].
    pub centre: [f64; 2],
    /// Height of the face into which it is milled [mm].
    pub top: f64,
    /// Depth [mm].
    pub depth: f64,
    /// `Some`: a through bore, cut so much deeper than `depth` [mm]; `None`: a blind one.
    pub breakthrough: Option<f64>,
    /// Diameter [mm].
    pub diameter: f64,
    /// The cutter.
    pub cutter: CutterData,
    /// Direction.
    pub sense: Sense,
    /// Where roughing begins.
    pub start: RoughStart,
    /// How the cutter comes down.
    pub entry: Entry,
    /// Roughing, if any.
    pub rough: Option<Rough>,
    /// Finishing, if any.
    pub finish: Option<Finish>,
    /// Height of the plane on which rapids between bores are safe [mm].
    pub retract_z: f64,
    /// Height down to which the approach to the top face is rapid [mm]; as far above every lower level rapids end too.
    pub approach_z: f64,
    /// Resolution of a control with involutes [mm]: base radii become multiples of it. `None`: exact.
    pub resolution: Option<f64>,
}

impl BoreSpec {
    /// Radius of the cutter [mm].
    pub fn cutter_radius(&self) -> f64 {
        0.5 * self.cutter.diameter
    }

    /// Distance above material at which a rapid ends [mm].
    pub fn clearance(&self) -> f64 {
        self.approach_z - self.top
    }

    /// Depth to which the tip goes [mm].
    pub fn full_depth(&self) -> f64 {
        self.depth + self.breakthrough.unwrap_or(0.0)
    }

    /// Radius of the roughing path at the wall [mm].
    ///
    /// # Errors
    /// `KC0401` when the cutter does not fit.
    pub fn rough_radius(&self, rough: &Rough) -> Result<f64> {
        path_radius(self.diameter, self.cutter.diameter, rough.allowance)
    }

    /// Radius of the finishing path [mm].
    ///
    /// # Errors
    /// `KC0401` when the cutter does not fit.
    pub fn finish_radius(&self) -> Result<f64> {
        path_radius(self.diameter, self.cutter.diameter, 0.0)
    }

    /// Checks each number on its own, and that the cutter fits; what concerns the entry is checked by
    /// [`super::entry::check`].
    ///
    /// # Errors
    /// `KC0404` with the key of the wrong number, `KC0401` when the cutter does not fit.
    pub fn check(&self) -> Result<()> {
        for (key, value) in
            [("at", self.centre[0]), ("at", self.centre[1]), ("top", self.top), ("retract", self.retract_z)]
        {
            if !value.is_finite() {
                return Err(out_of_range(key, "must be a finite number", value, 0.0));
            }
        }
        positive("depth", self.depth)?;
        positive("diameter", self.diameter)?;
        positive("tool.diameter", self.cutter.diameter)?;
        positive("tool.flute_length", self.cutter.flute_length)?;
        if let Some(b) = self.breakthrough {
            not_negative("breakthrough", b)?;
        }
        if let Some(angle) = self.cutter.max_ramp_angle {
            positive("tool.max_ramp_angle", angle)?;
        }
        if let Some(u) = self.resolution {
            positive("resolution", u)?;
        }
        if !(self.approach_z > self.top && self.approach_z.is_finite()) {
            return Err(out_of_range("approach", "must lie above the top face", self.approach_z, self.top));
        }
        if self.retract_z < self.approach_z {
            return Err(out_of_range(
                "retract",
                "must not lie below the approach height",
                self.retract_z,
                self.approach_z,
            ));
        }
        if let Some(rough) = &self.rough {
            self.check_rough(rough).map_err(|e| e.under("rough"))?;
        }
        if let Some(finish) = &self.finish {
            self.check_finish(finish).map_err(|e| e.under("finish"))?;
        }
        if self.rough.is_none() && self.finish.is_none() {
            return Err(Finding::error(Code::PLAN_VALUE, "a bore needs roughing or finishing")
                .cure("add `rough` or `finish`")
                .into());
        }
        self.finish_radius().map(|_| ())
    }

    fn check_rough(&self, rough: &Rough) -> Result<()> {
        positive("step", rough.step)?;
        not_negative("allowance", rough.allowance)?;
        positive("feed", rough.feed)?;
        positive("plunge_feed", rough.plunge_feed)?;
        if rough.step > self.cutter.diameter {
            return Err(out_of_range(
                "step",
                "must not exceed the cutter diameter: it would leave ridges",
                rough.step,
                self.cutter.diameter,
            ));
        }
        self.axial(rough.axial_step)?;
        self.rough_radius(rough).map(|_| ())
    }

    fn check_finish(&self, finish: &Finish) -> Result<()> {
        if finish.turns == 0 {
            return Err(out_of_range("turns", "must be at least one", 0.0, 1.0));
        }
        positive("feed", finish.feed)?;
        for p in [("start", finish.start), ("end", finish.end)] {
            if let (key, Some([x, y])) = p
                && !(x.is_finite() && y.is_finite())
            {
                return Err(out_of_range(key, "must be finite", x + y, 0.0));
            }
        }
        if let Some(wear) = &finish.wear {
            positive("wear", wear.largest)?;
            if wear.register == 0 {
                return Err(out_of_range("wear", "needs a register from 1 on", 0.0, 1.0));
            }
        }
        self.axial(finish.axial_step)
    }

    fn axial(&self, step: Option<f64>) -> Result<()> {
        let Some(step) = step else { return Ok(()) };
        positive("axial_step", step)?;
        if step > self.cutter.flute_length {
            return Err(out_of_range(
                "axial_step",
                "must not exceed the flute length",
                step,
                self.cutter.flute_length,
            ));
        }
        Ok(())
    }
}

fn out_of_range(key: &str, rule: &str, value: f64, bound: f64) -> Error {
    Finding::error(Code::PLAN_VALUE, format!("`{key}` {rule}"))
        .value_mm(value)
        .bound_mm(bound)
        .key(key)
        .into()
}

fn positive(key: &str, value: f64) -> Result<()> {
    if value > 0.0 && value.is_finite() {
        Ok(())
    } else {
        Err(out_of_range(key, "must be positive", value, 0.0))
    }
}

fn not_negative(key: &str, value: f64) -> Result<()> {
    if value >= 0.0 && value.is_finite() {
        Ok(())
    } else {
        Err(out_of_range(key, "must not be negative", value, 0.0))
    }
}
