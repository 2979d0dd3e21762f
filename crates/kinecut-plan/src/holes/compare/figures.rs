//! Everything measured of one strategy.

use serde::Serialize;

use super::chain::Chain;
use super::joints::{self, JointStep};
use super::load::{self, Load};
use super::peaks::{self, AxisPeaks, Sampled};
use super::run::{ProfilePlace, Run};
use super::{Terms, posted};
use crate::base::{Code, CountBound, Result};
use crate::geom::InvoluteRecord;
use crate::holes::clearing::Clearing;
use crate::motion::PathByLength as _;

/// The figures of a strategy on a hole.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Figures {
    /// Circle at the entry, path and circle at the wall [mm].
    pub length: f64,
    /// Circle at the entry [mm].
    pub entry_length: f64,
    /// From the entry circle or the centre to the wall [mm].
    pub path_length: f64,
    /// Circle at the wall [mm].
    pub closing_length: f64,
    /// Turns of the path.
    pub turns: f64,
    /// Largest normal step [mm].
    pub step: f64,
    /// Engagement kept [rad], for the strategy that keeps one.
    pub engagement: Option<f64>,
    /// Blocks posted.
    pub blocks: usize,
    /// Of these, the control's own involutes.
    pub involutes: u32,
    /// Characters posted.
    pub characters: usize,
    /// Joints from entry to wall.
    pub joints: Vec<JointStep>,
    /// The hardest joint.
    pub worst: Option<JointStep>,
    /// The joint at the entry circle; none from the centre, where the path starts at rest.
    pub start: Option<JointStep>,
    /// The joint with the circle at the wall.
    pub closing: JointStep,
    /// Peaks of the axes at constant feed, lowered near the centre.
    pub peaks: AxisPeaks,
    /// Acceleration [mm/s^2] and jerk [mm/s^3] at full feed one step from the centre, or the first place outside.
    pub at_step: Option<[f64; 2]>,
    /// Differences of positions around the joint with the wall circle.
    pub closing_sampled: Sampled,
    /// Load along path and wall circle.
    pub load: Load,
    /// The run at once, three and six times the feed.
    pub runs: Vec<Run>,
    /// The motion of the first of them.
    pub profile: Vec<ProfilePlace>,
    /// The whole run as drawn [mm].
    #[serde(skip)]
    pub drawing: Vec<[f64; 2]>,
    /// The whole run.
    #[serde(skip)]
    pub(super) chain: Chain,
}

/// Time step of the differences [s].
const TIME_STEP: f64 = 1e-3;
/// Heading between two drawn points [rad]: a chord is off by 1/800 of its radius.
const DRAWN_TURN: f64 = 0.1;

/// Turns of a path that is compared: its loads and times are sampled along all of it.
const TURNS: CountBound = CountBound {
    what: "turns to compare",
    most: 300.0,
    bytes: 500_000,
    code: Code::PLAN_VALUE,
    help: "choose a larger step or engagement",
};
/// Curves of a path that is compared.
const CURVES: CountBound = CountBound { what: "curves to compare", most: 5000.0, bytes: 50_000, ..TURNS };

/// The figures of a strategy but for its runs.
pub(super) fn figures(clearing: Clearing, terms: &Terms) -> Result<Figures> {
    let path = clearing.path(&terms.disc())?;
    TURNS.check(path.turns)?;
    CURVES.check(path.curves.len() as f64)?;
    let feed = terms.limits.feed;
    let entry = if path.inner > 0.0 { Some(InvoluteRecord::circle(path.inner, 0.0)?) } else { None };
    let curves = || path.curves.iter().copied().chain([path.closing.into()]);
    let cutting = Chain::new(curves().collect());
    let chain = Chain::new(entry.into_iter().map(Into::into).chain(curves()).collect());
    let joints = joints::joints(&chain, feed);
    // There is a joint with the wall circle: a path has at least one curve before it.
    let closing = joints.last().copied().ok_or_else(|| {
        crate::base::Finding::error(
            crate::base::Code::PLAN_VALUE,
            "the path has no joint with the wall circle",
        )
    })?;
    let posted = posted::posted(clearing, terms)?;
    let entry_length = entry.map_or(0.0, |c| c.length());
    Ok(Figures {
        length: chain.length(),
        entry_length,
        path_length: chain.length() - entry_length - path.closing.length(),
        closing_length: path.closing.length(),
        turns: path.turns,
        step: path.step,
        engagement: path.engagement,
        blocks: posted.blocks,
        involutes: posted.involutes,
        characters: posted.characters,
        worst: joints::worst(&joints),
        start: entry.and(joints.first().copied()),
        closing,
        peaks: peaks::axis_peaks(&chain, &terms.limits),
        at_step: peaks::at_radius(&cutting, terms.entry + path.step, feed),
        closing_sampled: peaks::sampled_at_last(&chain, feed, TIME_STEP),
        load: load::load(&cutting, terms)?,
        joints,
        runs: Vec::new(),
        profile: Vec::new(),
        drawing: chain
            .curves
            .iter()
            .flat_map(|c| c.stations(DRAWN_TURN))
            .map(|p| p.point.truncate().to_array())
            .collect(),
        chain,
    })
}
