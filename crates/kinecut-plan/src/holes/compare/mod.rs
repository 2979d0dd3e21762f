//! All strategies that clear a hole, measured on the same hole on equal terms, and the claims of the paper checked on it.
//!
//! For the process engineer who chooses a strategy, and for whoever wants to see what a step of curvature costs. Equal
//! terms: the same wall circle, cutter, step, entry circle, feed and limits; the path in one plane, from the entry circle
//! (run in full, as at the foot of a helix) or the centre, to the circle at the wall, run in full.
//!
//! Everything comes from the exact curves: contact and steps from derivatives, times and motion from the laws of
//! [`crate::motion`] on a machine with these limits, load from all former positions of the cutter. Posted is what a control
//! would get.
//!
//! Source: Sorokin, But, Kombarov 2013, whose claims are `claims`.

mod chain;
mod claims;
mod figures;
mod joints;
mod lead;
mod limits;
mod load;
mod pass;
mod peaks;
mod posted;
mod program;
mod run;
mod runs;
#[cfg(test)]
mod tests;

use rayon::prelude::*;
use serde::Serialize;

pub use claims::{Claim, Holds};
pub use figures::Figures;
pub use joints::{JointStep, Steps};
pub use lead::LeadGrowth;
pub use limits::Limits;
pub use load::{Load, LoadSample, radial_depth};
pub use pass::{Cut, PassPeaks, PassPiece, PassRun, PassSamples, PassWay, pass_run};
pub use peaks::{AxisPeaks, Sampled, feed_cap};
pub use run::{ProfilePlace, Run, ServoError};

use super::clearing::{Clearing, Disc};
use crate::base::{Finding, Result};
use crate::geom::LensOrder;
use crate::machine::Interpolator;
use crate::motion::Servo;
use crate::nc::{Control, PostSettings};

/// The strategies that clear a hole in a plane, in the order of the table.
pub const STRATEGIES: [Clearing; 10] = [
    Clearing::Involute,
    Clearing::Lens(LensOrder::One),
    Clearing::Lens(LensOrder::Two),
    Clearing::ConstantEngagement(LensOrder::One),
    Clearing::Archimedes,
    Clearing::Poles(2),
    Clearing::Poles(4),
    Clearing::RingsRadial,
    Clearing::RingsTangent,
    Clearing::Trochoid,
];

/// Name of the path of constant engagement that takes larger steps than asked for where the engagement allows.
pub const FREE: &str = "constant-engagement-free";

/// The hole on which strategies are compared; mm, s, rad.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Terms {
    /// Radius of the path at the roughed wall [mm].
    pub wall: f64,
    /// Radius of the cutter [mm].
    pub cutter: f64,
    /// Largest step between turns [mm].
    pub step: f64,
    /// Radius of the entry circle of the cutter's centre [mm]; zero: the path starts in the centre.
    pub entry: f64,
    /// Radius of a hole drilled before [mm].
    pub drilled: Option<f64>,
    /// Largest engagement [rad], for the strategy that keeps one.
    pub engagement: f64,
    /// Allowance for finishing [mm]; the finished wall's path has the radius `wall + allowance`.
    pub allowance: f64,
    /// Turns that the finishing lead-in would have from the centre.
    pub lead_turns: u32,
    /// Feed and limits of the machine.
    pub limits: Limits,
    /// The control's way of running along a path.
    pub interpolator: Interpolator,
    /// Distance by which the control may leave the path at joints [mm]; `None`: the usual one.
    pub tolerance: Option<f64>,
    /// Junction deviation of a control that looks ahead by it [mm]; `None`: the usual one.
    pub junction_deviation: Option<f64>,
    /// Position loops of the axes.
    pub servo: Servo,
    /// Decimals of coordinates, which the posted involutes are fitted to.
    pub decimals: u8,
    /// The control that the blocks are counted for.
    #[serde(serialize_with = "control_name")]
    pub control: Control,
}

fn control_name<S: serde::Serializer>(control: &Control, s: S) -> std::result::Result<S::Ok, S::Error> {
    s.serialize_str(control.name())
}

impl Terms {
    /// Engagement limit when none is given [rad]: 60 degrees.
    pub const USUAL_ENGAGEMENT: f64 = std::f64::consts::PI / 3.0;

    /// Bandwidth of the position loops when none is given [Hz].
    pub const USUAL_BANDWIDTH: f64 = 30.0;

    /// A hole from the centre at a feed [mm/s]: engagement 60 degrees, a lead-in of two turns, the usual limits, a control
    /// that limits jerk, SINUMERIK.
    pub fn new(wall: f64, cutter: f64, step: f64, feed: f64) -> Terms {
        Terms {
            wall,
            cutter,
            step,
            entry: 0.0,
            drilled: None,
            engagement: Terms::USUAL_ENGAGEMENT,
            allowance: 0.0,
            lead_turns: 2,
            limits: Limits::usual(feed),
            interpolator: Interpolator::JerkLimited,
            tolerance: None,
            junction_deviation: None,
            servo: Servo { bandwidth: Terms::USUAL_BANDWIDTH },
            decimals: 4,
            control: Control::Sinumerik840d,
        }
    }

    fn disc(&self) -> Disc {
        Disc {
            inner: self.entry,
            inner_most: self.entry,
            outer: self.wall,
            cutter: self.cutter,
            step: self.step,
            engagement: Some(self.engagement),
            psi: 0.0,
            resolution: None,
        }
    }

    fn settings(&self) -> PostSettings {
        PostSettings { decimals: self.decimals, block_numbers: false, ..PostSettings::new(self.control) }
    }
}

/// A strategy of the table.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct ComparedStrategy {
    /// Name as in job files.
    pub strategy: &'static str,
    /// Measurements; `None` if the strategy is not possible on this hole.
    pub figures: Option<Figures>,
    /// Why it is not possible.
    pub error: Option<Finding>,
}

/// All strategies on one hole.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Comparison {
    /// Units of all numbers.
    pub units: &'static str,
    /// The hole.
    pub terms: Terms,
    /// Radius within which a circle at the feed would exceed the limits of acceleration or jerk [mm]: there the feed is
    /// lowered, the same for all.
    pub capped_radius: f64,
    /// The strategies.
    pub rows: Vec<ComparedStrategy>,
    /// The finishing lead-ins of contact G2, G4, G6; none without an allowance.
    pub lead_ins: Vec<LeadGrowth>,
    /// The paper's claims on this hole.
    pub claims: Vec<Claim>,
}

impl Comparison {
    /// The figures of a strategy by its name.
    pub fn of(&self, strategy: &str) -> Option<&Figures> {
        self.rows.iter().find(|r| r.strategy == strategy)?.figures.as_ref()
    }
}

/// Runs every strategy on one hole.
///
/// ```
/// # use kinecut_plan as kinecut;
/// use kinecut::holes::compare::{Terms, compare};
/// let all = compare(&Terms::new(16.0, 4.0, 1.5, 40.0)).unwrap();
/// let (paper, arcs) = (all.of("involute").unwrap(), all.of("arcs-2").unwrap());
/// assert_eq!((paper.closing.contact, arcs.closing.contact), ("G2", "G1"));
/// assert!((paper.path_length - std::f64::consts::PI * 11.0 * 16.0).abs() < 1e-9);
/// ```
///
/// # Errors
/// `KC0404` for terms on which nothing can be planned. What one strategy alone cannot do stands in its row.
pub fn compare(terms: &Terms) -> Result<Comparison> {
    let mut rows = shapes(terms)?;
    runs::add(&mut rows, terms)?;
    judged(terms, rows)
}

/// The strategies without their runs.
fn shapes(terms: &Terms) -> Result<Vec<ComparedStrategy>> {
    terms.limits.check()?;
    // The one strategy that is always possible, so that an error of the terms themselves is reported once.
    Clearing::Involute.path(&terms.disc())?;
    let mut tasks: Vec<(&'static str, Clearing, Terms)> =
        STRATEGIES.iter().map(|&clearing| (clearing.name(), clearing, *terms)).collect();
    let even = Clearing::ConstantEngagement(LensOrder::One);
    let after = tasks.iter().position(|t| t.1 == even).map_or(tasks.len(), |i| i + 1);
    // A step as large as the cutter allows: the engagement alone binds.
    tasks.insert(after, (FREE, even, Terms { step: 2.0 * terms.cutter, ..*terms }));
    let shape = |(strategy, clearing, terms): &(&'static str, Clearing, Terms)| match figures::figures(
        *clearing, terms,
    ) {
        Ok(figures) => ComparedStrategy { strategy, figures: Some(figures), error: None },
        Err(e) => ComparedStrategy { strategy, figures: None, error: Some(*e.0) },
    };
    Ok(tasks.par_iter().map(shape).collect())
}

/// The claims on these strategies.
fn judged(terms: &Terms, rows: Vec<ComparedStrategy>) -> Result<Comparison> {
    let lead_ins = lead::lead_ins(terms)?;
    let claims = claims::claims(terms, &rows, &lead_ins)?;
    Ok(Comparison {
        units: "mm, s, rad",
        terms: *terms,
        capped_radius: peaks::capped_radius(&terms.limits),
        rows,
        lead_ins,
        claims,
    })
}
