//! The check of a bore's numbers.

use std::f64::consts::TAU;

use super::spec::{BoreSpec, Entry, Finish, LeadEnd, Rough};
use super::strategy::Strategy;
use crate::base::{Code, CountBound, Error, Finding, Result};

impl BoreSpec {
    /// Checks each number on its own; whether the cutter fits shows in the levels, whether it comes down in the entry
    /// ([`super::entry::ways`]).
    ///
    /// # Errors
    /// `KC0404` with the key of the wrong number.
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
        if let Some(bottom) = self.bottom_diameter {
            positive("bottom_diameter", bottom)?;
            if bottom > self.diameter {
                return Err(out_of_range(
                    "bottom_diameter",
                    "must not exceed the diameter at the top: the cutter cannot reach behind the rim",
                    bottom,
                    self.diameter,
                ));
            }
        }
        not_negative("stock_to_leave", self.stock_to_leave[0])?;
        not_negative("stock_to_leave_floor", self.stock_to_leave[1])?;
        if self.stock_to_leave[1] >= self.depth {
            return Err(out_of_range(
                "stock_to_leave_floor",
                "must be less than the depth",
                self.stock_to_leave[1],
                self.depth,
            ));
        }
        self.check_strategy()?;
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
            let help = format!("write more than {}", self.top);
            return Err(refused("approach", "must lie above the top face", self.approach_z, self.top, help));
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
                .help("add `rough` or `finish`")
                .into());
        }
        Ok(())
    }

    fn check_strategy(&self) -> Result<()> {
        if let Strategy::Helix | Strategy::OutlineHelix = self.strategy {
            // Without roughing there is no descent.
            if let Some(pitch) = self.rough.as_ref().map_or(Some(0.0), |r| r.pitch) {
                positive("pitch", pitch)?;
            }
        }
        let on_circle = match (self.entry, &self.rough) {
            (_, Some(Rough { start: Some(_), .. })) => false,
            (entry, _) => entry != Some(Entry::Plunge),
        };
        if self.strategy == Strategy::Annular && !on_circle {
            return Err(Finding::error(
                Code::PLAN_VALUE,
                "an annular involute starts on a circle, not in a point",
            )
            .help("enter by a helix or a pre-drilled hole, or use `involute`")
            .key("strategy")
            .into());
        }
        if self.strategy == Strategy::OutlineHelix && self.breakthrough.is_none() {
            return Err(Finding::error(
                Code::PLAN_VALUE,
                "a helix along the outline alone needs a bore that goes through: in a blind one the core stays",
            )
            .help("give `breakthrough`, or clear the bore by another strategy")
            .key("strategy")
            .into());
        }
        if self.strategy.clearing().is_none() && self.bottom_diameter.is_some_and(|d| d != self.diameter) {
            return Err(Finding::error(
                Code::PLAN_VALUE,
                format!("the strategy `{}` cannot follow a conical wall", self.strategy.name()),
            )
            .help("clear a conical bore level by level: `involute`, `lens-1`, `constant-engagement`, ..")
            .key("strategy")
            .into());
        }
        Ok(())
    }

    fn check_rough(&self, rough: &Rough) -> Result<()> {
        self.check_stepover(rough)?;
        direction("touch_angle", rough.touch_angle)?;
        not_negative("allowance", rough.allowance)?;
        positive("feed", rough.feed)?;
        positive("plunge_feed", rough.plunge_feed())?;
        if let Some(angle) = rough.engagement
            && !(angle > 0.0 && angle < std::f64::consts::PI)
        {
            let rule = "must lie between 0 and 180 degrees";
            return Err(Finding::error(Code::PLAN_VALUE, format!("`engagement` {rule}"))
                .value(angle.to_degrees(), "deg")
                .bound(180.0, "deg")
                .key("engagement")
                .into());
        }
        self.axial(rough.stepdown)
    }

    fn check_stepover(&self, rough: &Rough) -> Result<()> {
        // A helix has its turns one below the other, none side by side.
        let one_turn = matches!(self.strategy, Strategy::Helix | Strategy::OutlineHelix);
        if one_turn && rough.stepover.is_none() {
            return Ok(());
        }
        if self.strategy == Strategy::ConstantEngagement && rough.engagement.is_none() {
            return Err(Finding::error(
                Code::PLAN_VALUE,
                "the strategy `constant-engagement` needs `engagement`",
            )
            .bound(180.0, "deg")
            .help("write engagement = 60, the largest engagement angle in degrees")
            .key("engagement")
            .into());
        }
        let step = self.stepover(rough)?;
        positive("stepover", step)?;
        if step > self.cutter.diameter {
            return Err(out_of_range(
                "stepover",
                "must not exceed the cutter diameter: it would leave ridges",
                step,
                self.cutter.diameter,
            ));
        }
        Ok(())
    }

    fn check_finish(&self, finish: &Finish) -> Result<()> {
        if finish.turns == 0 {
            return Err(out_of_range("turns", "must be at least one", 0.0, 1.0));
        }
        LEAD_TURNS.check(f64::from(finish.turns)).map_err(|e| e.under("turns"))?;
        positive("feed", finish.feed)?;
        for (key, end) in [("start", finish.start), ("end", finish.end)] {
            match end {
                LeadEnd::Point([x, y]) if !(x.is_finite() && y.is_finite()) => {
                    return Err(out_of_range(key, "must be finite", x + y, 0.0));
                }
                LeadEnd::Radius(r) => not_negative(&format!("{key}_radius"), r)?,
                LeadEnd::Length(l) => positive(&format!("{key}_length"), l)?,
                LeadEnd::CurvatureRadius(r) => positive(&format!("{key}_curvature_radius"), r)?,
                LeadEnd::Usual | LeadEnd::Point(_) => {}
            }
        }
        direction("touch_angle", finish.touch_angle)?;
        direction("end_touch_angle", finish.end_touch_angle)?;
        /// More spring passes than that are a slip of the pen.
        const MOST_SPRING: u32 = 20;
        if finish.spring_passes > MOST_SPRING {
            let (value, bound) = (f64::from(finish.spring_passes), f64::from(MOST_SPRING));
            return Err(Finding::error(Code::PLAN_VALUE, "`spring_passes` are too many")
                .value(value, "")
                .bound(bound, "")
                .help("write 0 to 3: more cut nothing")
                .key("spring_passes")
                .into());
        }
        if let Some(wear) = finish.wear {
            positive("wear_largest", wear.largest)?;
            if wear.register == 0 {
                return Err(out_of_range("wear_offset", "needs a register from 1 on", 0.0, 1.0));
            }
        }
        self.axial(finish.stepdown)
    }

    fn axial(&self, step: Option<f64>) -> Result<()> {
        let Some(step) = step else { return Ok(()) };
        positive("stepdown", step)?;
        if step > self.cutter.flute_length {
            return Err(out_of_range(
                "stepdown",
                "must not exceed the flute length",
                step,
                self.cutter.flute_length,
            ));
        }
        Ok(())
    }
}

/// Turns of a lead-in, of which each only lets it begin nearer to the centre.
const LEAD_TURNS: CountBound = CountBound {
    what: "turns of a lead-in",
    most: 10_000.0,
    bytes: 1000,
    code: Code::PLAN_VALUE,
    help: "write 1 to 5: more only make the way longer",
};

fn out_of_range(key: &str, rule: &str, value: f64, bound: f64) -> Error {
    let help = match value {
        v if !v.is_finite() => "write a number".to_owned(),
        v if v >= bound => format!("write less than {bound}"),
        _ => format!("write {bound} or more"),
    };
    refused(key, rule, value, bound, help)
}

fn refused(key: &str, rule: &str, value: f64, bound: f64, help: impl Into<String>) -> Error {
    Finding::error(Code::PLAN_VALUE, format!("`{key}` {rule}"))
        .value_mm(value)
        .bound_mm(bound)
        .help(help)
        .key(key)
        .into()
}

fn positive(key: &str, value: f64) -> Result<()> {
    if value > 0.0 && value.is_finite() {
        Ok(())
    } else {
        Err(refused(key, "must be positive", value, 0.0, "write a number above 0"))
    }
}

/// A direction, if there is one: within a turn either way, so that no sense is lost in whole turns.
fn direction(key: &str, angle: Option<f64>) -> Result<()> {
    /// Rounding of 360 degrees as radians.
    const SLACK: f64 = 1e-12;
    match angle {
        Some(angle) if !(angle.abs() <= TAU + SLACK) => {
            Err(Finding::error(Code::PLAN_VALUE, format!("`{key}` must lie between -360 and 360 degrees"))
                .value(angle.to_degrees(), "deg")
                .bound(360.0, "deg")
                .help("write the direction from the bore's centre, counter-clockwise from X, in degrees")
                .key(key)
                .into())
        }
        _ => Ok(()),
    }
}

fn not_negative(key: &str, value: f64) -> Result<()> {
    if value >= 0.0 && value.is_finite() {
        Ok(())
    } else {
        Err(refused(key, "must not be negative", value, 0.0, "write 0 or more"))
    }
}
