//! The moves of milled threads: for each place, pass and step down the middle, in, round, out.

use std::f64::consts::{PI, TAU};
use std::ops::Range;

use glam::{DVec2, DVec3};

use super::lead::{Lead, lead};
use super::{ThreadMillSpec, ThreadSide, ThreadTravel, room};
use crate::base::{Finding, Result};
use crate::geom::{Arc, Curve, Rise, Spiral, SpiralLaw};
use crate::holes::route::Route;
use crate::holes::{PlannedMove, ToolpathPace, ToolpathRole};

/// Planned threads [mm, mm/s].
#[derive(Clone, Debug, PartialEq)]
pub struct ThreadPlan {
    /// The moves in order, from over the first place to the height of the moves between places.
    pub moves: Vec<PlannedMove>,
    /// The helices in order.
    pub runs: Vec<ThreadRun>,
    /// The way in which they are run.
    pub travel: ThreadTravel,
    /// Radius of the path at the bottom, as the sections say and as it is run.
    pub radii: [f64; 2],
    /// Way by which the flanks would overcut radially without a correction, and the same to second order.
    pub gain: [f64; 2],
    /// Feed of the tool's centre along helix and leads at full depth, of a taper thread where the radius is the least; those of the
    /// passes are in the runs.
    pub feed: f64,
    /// Angle of the helix over the plane [rad].
    pub slope: f64,
    /// Height of the tool's lowest point.
    pub lowest: f64,
    /// Warnings.
    pub findings: Vec<Finding>,
}

/// One helix [mm].
#[derive(Clone, Debug, PartialEq)]
pub struct ThreadRun {
    /// Index of its place.
    pub place: usize,
    /// Share of the thread's depth.
    pub share: f64,
    /// Whether it is one of the last passes, at full depth.
    pub finishing: bool,
    /// Radius where it begins and where it ends.
    pub radii: [f64; 2],
    /// Height of the lowest row's middle where it begins and where it ends.
    pub heights: [f64; 2],
    /// Turns.
    pub turns: f64,
    /// Feed of the tool's centre along it and its leads [mm/s].
    pub feed: f64,
    /// Its moves.
    pub moves: Range<usize>,
}

/// Plans threads.
///
/// ```
/// # use kinecut_plan as kinecut;
/// use kinecut::threading::*;
/// use kinecut::tool::ThreadMill;
/// let mill = ThreadMill { diameter: 14.0, pitch: 2.5, rows: 1, half_angle: 30f64.to_radians(), neck: None };
/// let cutter = ThreadCutter { mill, profile: MillProfile::Standard, flute_length: 30.0, shank_diameter: 10.0, stickout: 50.0 };
/// let plan = plan_threads(&ThreadMillSpec::new(Thread::new(ThreadForm::Metric, 20.0, 2.5), 20.0, cutter, 10.0)).unwrap();
/// assert!((plan.gain[0] - 0.0538).abs() < 5e-5 && (plan.radii[0] - 3.0).abs() < 1e-12 && (plan.radii[1] - 2.9448).abs() < 5e-5);
/// assert_eq!(plan.runs[0].turns, 8.5);
/// ```
///
/// # Errors
/// `KC0404` for values out of range, `KC0412` for a tool that does not fit the thread; with value, bound, key and help.
pub fn plan_threads(spec: &ThreadMillSpec) -> Result<ThreadPlan> {
    let [low, high] = spec.check()?;
    let nominal = spec.nominal_radius(spec.depth);
    // A tool that is corrected for it overcuts as well, but on purpose.
    let gain = spec.flank().gain(spec.side, nominal, spec.tool_radius()).unwrap_or(f64::INFINITY);
    let second = spec.flank().gain_second_order(spec.side, nominal, spec.tool_radius());
    let least = if low < high { low } else { high };
    let slope = (spec.thread.pitch / (TAU * least)).atan();
    let mut maker = Maker {
        spec,
        travel: spec.travel(),
        line: room::line(spec, least)?,
        feed: 0.0,
        route: Route::new(spec.retract_z, spec.approach_z),
        runs: Vec::new(),
    };
    for (place, at) in spec.places.iter().enumerate() {
        maker.thread(place, *at)?;
    }
    maker.route.retract();
    Ok(ThreadPlan {
        travel: maker.travel,
        feed: spec.feed_on(least),
        runs: maker.runs,
        moves: maker.route.moves,
        radii: [nominal, low],
        gain: [gain, second],
        slope,
        lowest: spec.lowest(),
        findings: spec.overcut(gain, 2.0 * (nominal - low) - spec.oversize).into_iter().collect(),
    })
}

/// The moves so far.
struct Maker<'a> {
    spec: &'a ThreadMillSpec,
    travel: ThreadTravel,
    /// Length of the straight lines under compensation; 0 without.
    line: f64,
    /// Feed of the helix that is run.
    feed: f64,
    route: Route,
    runs: Vec<ThreadRun>,
}

impl Maker<'_> {
    /// The passes of one thread.
    fn thread(&mut self, place: usize, at: DVec2) -> Result<()> {
        let spec = self.spec;
        let mut steps = spec.steps();
        if !self.travel.upwards {
            steps.reverse();
        }
        let springs = (0..spec.spring_passes).map(|_| 1.0);
        let mut first = true;
        for (pass, share) in spec.infeed.iter().copied().chain(springs).enumerate() {
            self.route.level = pass as u32;
            self.route.finishing = pass + 1 >= spec.infeed.len();
            for step in &steps {
                let run = self.run(place, share, *step);
                self.around(run, at, first)?;
                first = false;
            }
        }
        Ok(())
    }

    /// A helix in numbers.
    fn run(&self, place: usize, share: f64, step: u32) -> ThreadRun {
        let spec = self.spec;
        let (pitch, turns) = (spec.thread.pitch, spec.turns());
        let low = spec.top - spec.depth + f64::from(step) * pitch;
        let high = low + turns * pitch;
        let heights = if self.travel.upwards { [low, high] } else { [high, low] };
        let finishing = self.route.finishing;
        let radii = heights.map(|z| self.radius(z, share));
        // On the least radius the edge is the fastest.
        let feed = spec.feed_on(if radii[0] < radii[1] { radii[0] } else { radii[1] });
        ThreadRun { place, share, finishing, radii, heights, turns, feed, moves: 0..0 }
    }

    /// Radius of the path where the lowest row's middle has a height, in a pass to a share of the thread's depth.
    fn radius(&self, z: f64, share: f64) -> f64 {
        let spec = self.spec;
        let depth = if spec.thread.taper > 0.0 { spec.top - z } else { 0.0 };
        let short = (1.0 - share) * spec.thread.height(spec.side);
        // That there is one was checked at the mouth and at the bottom.
        let full = spec.centre_radius(depth).unwrap_or_else(|| spec.nominal_radius(depth));
        match spec.side {
            ThreadSide::Inside => full - short,
            ThreadSide::Outside => full + short,
        }
    }

    /// To the helix, along it, and away from it.
    fn around(&mut self, mut run: ThreadRun, at: DVec2, first: bool) -> Result<()> {
        let spec = self.spec;
        let (turn, climb) = (self.travel.turn(), self.travel.climb());
        let below = 0.5 * spec.cutter.mill.pitch;
        let [r0, r1] = run.radii;
        let [z0, z1] = run.heights.map(|z| z - below);
        let outs = [DVec2::X, DVec2::from_angle(turn * TAU * run.turns)];
        let round = spec.lead_radius();
        let way_in = lead(spec.side, outs[0], r0, round, [turn, 1.0]);
        let way_out = lead(spec.side, outs[1], r1, round, [turn, -1.0]);
        let rise = |radius: f64| climb * spec.lead_rise(radius);
        let line = if run.finishing { self.line } else { 0.0 };
        self.feed = run.feed;
        let begin = at + way_in.free + line * way_in.away;
        let start = z0 - rise(r0);
        self.come(begin, start, first);
        let feed = ToolpathPace::Feed(self.feed);
        self.route.comp = line > 0.0;
        self.route.to(ToolpathRole::LeadIn, feed, (at + way_in.free).extend(start));
        self.arc(ToolpathRole::LeadIn, at, &way_in, rise(r0), (at + r0 * outs[0]).extend(z0))?;
        let from = self.route.moves.len();
        self.helix(&run, at, [z0, z1], (at + r1 * outs[1]).extend(z1))?;
        run.moves = from..self.route.moves.len();
        let end = (at + way_out.free).extend(z1 + rise(r1));
        self.arc(ToolpathRole::LeadOut, at, &way_out, rise(r1), end)?;
        self.route.comp = false;
        self.route.to(ToolpathRole::LeadOut, feed, end + (line * way_out.away).extend(0.0));
        self.runs.push(run);
        Ok(())
    }

    /// Over a place and down to a height; within a hole the tool stays in it.
    fn come(&mut self, to: DVec2, z: f64, first: bool) {
        if first || self.spec.side == ThreadSide::Outside {
            self.route.over(to);
        } else {
            let here = self.route.height();
            self.route.to(ToolpathRole::Link, ToolpathPace::Rapid, to.extend(here));
        }
        self.route.vertically(ToolpathRole::Link, ToolpathPace::Rapid, z);
    }

    /// The arc of a lead from the present place to its end.
    fn arc(&mut self, role: ToolpathRole, at: DVec2, lead: &Lead, rise: f64, end: DVec3) -> Result<()> {
        let Some(start) = self.route.place() else { return Ok(()) };
        let arc = Arc::new(start, (at + lead.centre).extend(start.z), DVec3::Z, lead.sweep, rise)?;
        self.route.along(role, ToolpathPace::Feed(self.feed), arc.into(), end);
        Ok(())
    }

    /// The turns: an arc that rises, on a cone spirals.
    fn helix(&mut self, run: &ThreadRun, at: DVec2, [z0, z1]: [f64; 2], end: DVec3) -> Result<()> {
        let [r0, r1] = run.radii;
        let sweep = self.travel.turn() * TAU * run.turns;
        let role = if run.finishing { ToolpathRole::Finish } else { ToolpathRole::Rough };
        let (pace, z_of_middle) = (ToolpathPace::Feed(self.feed), run.heights[0] - z0);
        if r0 == r1 {
            let start = (at + DVec2::new(r0, 0.0)).extend(z0);
            let arc = Arc::new(start, at.extend(z0), DVec3::Z, sweep, z1 - z0)?;
            self.route.along(role, pace, arc.into(), end);
            return Ok(());
        }
        // Heights are in proportion to the angle: by quarters of a turn they are in proportion to the length too.
        let count = (4.0 * run.turns).ceil();
        let mut before = r0;
        for i in 0..count as u32 {
            let [from, to] = [f64::from(i) / count, f64::from(i + 1) / count];
            let [za, zb] = [from, to].map(|share| z0 + (z1 - z0) * share);
            let after = if to == 1.0 { r1 } else { self.radius(zb + z_of_middle, run.share) };
            let part = quarter([before, after], sweep * from, sweep / count)?.shifted(at);
            let to = if to == 1.0 { end } else { part.end().extend(zb) };
            self.route.along(role, pace, Curve::spiral(part, za, Rise::even(zb - za)), to);
            before = after;
        }
        Ok(())
    }
}

/// A piece of a spiral about the origin between two radii, from an angle on by a sweep [rad].
fn quarter([from, to]: [f64; 2], angle: f64, sweep: f64) -> Result<Spiral> {
    let growth = (to - from).abs() / sweep.abs();
    let piece = Spiral::new(SpiralLaw::Archimedes { growth }, from / growth, to / growth)?;
    // Growing it turns counter-clockwise by itself.
    Ok(if (to > from) == (sweep > 0.0) {
        piece.rotated(angle - from / growth)
    } else {
        piece.mirrored().rotated(angle + from / growth - PI)
    })
}
