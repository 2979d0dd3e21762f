//! The question: layouts to search, conditions, sizes and criteria.

use super::{Attitude, Criterion, LayoutKind, LinkErrors, Masses, Search, Sizes};
use crate::base::{Code, Finding, MAX_LENGTH, Result};
use crate::machine::Elementary;

/// A question about layouts.
#[derive(Clone, Debug, PartialEq)]
pub struct Query {
    /// The set of layouts to search.
    pub search: Search,
    /// Attitudes of the spindle; each layout is listed once for each.
    pub attitudes: Vec<Attitude>,
    /// Counts layouts once that differ by a quarter turn of a machine with a vertical spindle (X and Y, A and B change
    /// places).
    pub quarter_turns_are_one: bool,
    /// Conditions.
    pub conditions: Conditions,
    /// Sizes.
    pub sizes: Sizes,
    /// Masses.
    pub masses: Masses,
    /// Errors of the links.
    pub errors: LinkErrors,
    /// Criteria that count, with their weights.
    pub weights: Vec<(Criterion, f64)>,
    /// So many of the best get what takes longer: cover of directions and workspace.
    pub listed: usize,
    /// Whether workspaces are measured.
    pub workspaces: bool,
}

/// Largest mass, error or weight: larger ones leave no digits of the others in a score.
const LARGEST: f64 = 1e9;

impl Query {
    /// A question without conditions, with the usual sizes and weights.
    pub fn new(search: Search) -> Query {
        Query {
            search,
            attitudes: vec![Attitude::Vertical],
            quarter_turns_are_one: false,
            conditions: Conditions::default(),
            sizes: Sizes::default(),
            masses: Masses::default(),
            errors: LinkErrors::default(),
            weights: Criterion::USUAL.to_vec(),
            listed: 24,
            workspaces: true,
        }
    }

    /// Checks the numbers.
    ///
    /// # Errors
    /// `KC1122` for a number that is not finite or has the wrong sign, or a range that is reversed.
    pub fn check(&self) -> Result<()> {
        // The value in the unit in which it is asked for.
        let within = |name: &str, value: f64, zero: bool, (most, unit): (f64, &str)| {
            if value <= most && (value > 0.0 || zero && value == 0.0) {
                return Ok(());
            }
            let bound = if value > most { most } else { 0.0 };
            let what = if bound > 0.0 { "is out of range" } else { "must be positive" };
            let finding = Finding::error(Code::LAYOUT_QUERY, format!("{name} {what}"));
            let finding = finding.value(value, unit).bound(bound, unit).key(name.to_owned());
            Err(crate::base::Error::from(finding.help(format!("write a number from 0 to {most}"))))
        };
        let length = |name: &str, value: f64, zero: bool| within(name, value, zero, (MAX_LENGTH, "mm"));
        let positive = |name: &str, value: f64, zero: bool| within(name, value, zero, (LARGEST, ""));
        for (letter, stroke) in ["x", "y", "z"].iter().zip(self.sizes.stroke) {
            length(&format!("stroke.{letter}"), stroke, false)?;
        }
        for (letter, size) in ["x", "y", "z"].iter().zip(self.sizes.part.unwrap_or([1.0; 3])) {
            length(&format!("part.{letter}"), size, false)?;
        }
        length("tool-length", self.sizes.tool_length, true)?;
        for (name, mass) in
            [("link", self.masses.link), ("work", self.masses.work), ("tool", self.masses.tool)]
        {
            positive(&format!("mass.{name}"), mass, true)?;
        }
        for mass in self.masses.own.iter().flatten() {
            positive("mass", *mass, true)?;
        }
        positive("errors.shift", self.errors.shift, true)?;
        positive("errors.turn", self.errors.turn, true)?;
        for (criterion, weight) in &self.weights {
            positive(&format!("weight.{}", criterion.name()), *weight, true)?;
        }
        if let Some(tilt) = self.conditions.tilt {
            within("tilt", tilt.to_degrees(), true, (180.0, "deg"))?;
        }
        for (range, letter) in self.sizes.rotary.iter().zip(["A", "B", "C", "7", "8", "9"]) {
            if let Some([low, high]) = range
                && !(low.is_finite() && high.is_finite() && low < high)
            {
                let what = format!("the range of {letter} is reversed or not finite");
                let finding = Finding::error(Code::LAYOUT_QUERY, what).key(format!("range.{letter}"));
                return Err(finding
                    .value(low.to_degrees(), "degrees")
                    .bound(high.to_degrees(), "degrees")
                    .into());
            }
        }
        if self.sizes.spindle.try_normalize().is_none() {
            let what = "the direction of the spindle has no length";
            return Err(Finding::error(Code::LAYOUT_QUERY, what).key("spindle").into());
        }
        for (direction, digit) in self.sizes.inclined.iter().zip(7..) {
            if direction.try_normalize().is_none() {
                let what = format!("the direction of the inclined rotation {digit} has no length");
                return Err(Finding::error(Code::LAYOUT_QUERY, what).key("inclined").into());
            }
        }
        Ok(())
    }
}

/// Conditions; those that are not given hold for all layouts.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Conditions {
    /// The rank modulo the spin of the tool is the number of axes, or 5 when there are more.
    pub full_mobility: bool,
    /// The translations stay at right angles whatever the rotary axes do.
    pub regular: bool,
    /// Most axes that carry the work; 0 or 1 for a heavy part.
    pub most_work_links: Option<usize>,
    /// The only motions allowed on the work side; `None`: all.
    pub work_motions: Option<Vec<Elementary>>,
    /// The only motions allowed on the tool side; `None`: all.
    pub tool_motions: Option<Vec<Elementary>>,
    /// Kinds of layouts.
    pub kinds: Option<Vec<LayoutKind>>,
    /// Limit of the translations that are stacked on the tool side.
    pub stacking: Option<Stacking>,
    /// The tool's axis is brought to every direction within this angle of its direction at home [rad].
    pub tilt: Option<f64>,
    /// The strokes that part and tool need are within those given.
    pub within_stroke: bool,
}

/// A bound on stacked translations.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Stacking {
    /// Most translations on the tool side,
    pub most: usize,
    /// where the longest of their strokes is above this [mm].
    pub above: f64,
}
