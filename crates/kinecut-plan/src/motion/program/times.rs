//! The time of a program: each path under the limits of all axes, and what the control waits for.

use rayon::prelude::*;

use super::super::{AxisLimit, SCurve, TimeLaw, WithoutJerk};
use super::axis_limits;
use super::joint::{AXES, Joint, Step, Tolerance};
use super::run::{Piece, Run, derivatives};
use super::straight::{along, axis_by_axis, straight};
use crate::base::{Finding, Result};
use crate::machine::{Interpolator, Machine, Rapids};
use crate::program::{Blend, Item, Program};
use crate::trace::{Segment, SegmentPace, Trace};

/// Distance by which a control leaves the path at a corner where neither program nor machine says one [mm].
const USUAL_TOLERANCE: f64 = 0.01;
/// The same for rotary axes [rad].
const USUAL_TURN_TOLERANCE: f64 = 0.05 * std::f64::consts::PI / 180.0;

/// Time of a program on a machine.
#[derive(Clone, Debug, PartialEq)]
pub struct ProgramTime {
    /// Time of each segment of the trace under the law [s]; 0 for ways that the machine may take instead.
    pub segments: Vec<f64>,
    /// All moves [s].
    pub moves: f64,
    /// All moves where jerk has no limit [s]: no run is faster.
    pub without_jerk: f64,
    /// Waits that the program asks for [s].
    pub dwells: f64,
    /// Tool changes: their number, and their time where the machine says it [s].
    pub tool_changes: (usize, Option<f64>),
    /// Starts, stops and changes of the spindle's speed: their number, and their time where the machine says it [s].
    pub spindle_changes: (usize, Option<f64>),
    /// Joints of moves.
    pub smoothing: Smoothing,
    /// Largest factor by which a run was slowed so that every limit holds.
    pub dilation: f64,
    /// Moves that count with their programmed time, because the law of their stretch was refused: their number, and the
    /// item of the first with the reason.
    pub refused: (usize, Option<(u32, Finding)>),
}

/// Joints of moves at feed.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Smoothing {
    /// Joints at which the path goes on with two derivatives.
    pub smooth: usize,
    /// Joints that the control smooths.
    pub smoothed: usize,
    /// Joints at which the tool stops.
    pub stops: usize,
    /// Largest distance from the programmed path at smoothed joints, of linear axes [mm].
    pub farthest: f64,
}

impl ProgramTime {
    /// Time of the program [s]: moves, waits, and what is known of tool changes and spindle.
    pub fn total(&self) -> f64 {
        self.moves + self.dwells + self.tool_changes.1.unwrap_or(0.0) + self.spindle_changes.1.unwrap_or(0.0)
    }

    /// Time below which no run of the program can be [s].
    pub fn least(&self) -> f64 {
        self.total() - self.moves + self.without_jerk
    }
}

/// The time of a program that was followed on a machine; `None` if an axis that moves has no rapid speed or no acceleration.
///
/// Each stretch of feed between stops is run as fast as the axes allow ([`TimeLaw`]); at joints the control stops or leaves
/// the path by its tolerance, whichever is faster. Rapids and straight moves from stop to stop are exact.
pub fn program_time(program: &Program, trace: &Trace, machine: &Machine) -> Option<ProgramTime> {
    let limits = axis_limits(machine);
    let setting = Setting::new(machine, limits);
    let mut runs: Vec<Stretch> = Vec::new();
    for (i, segment) in trace.segments.iter().enumerate() {
        if segment.alternative {
            continue;
        }
        match runs.last_mut() {
            Some(run) if goes_on(program, trace, run, i) => run.segments.push(i),
            _ => runs.push(Stretch { segments: vec![i] }),
        }
    }
    let done: Vec<Result<Option<Done>>> =
        runs.par_iter().with_max_len(1).map(|run| setting.run(program, trace, run)).collect();
    let mut time = ProgramTime {
        segments: vec![0.0; trace.segments.len()],
        moves: 0.0,
        without_jerk: 0.0,
        dwells: trace.dwells.iter().map(|d| d.1).sum(),
        tool_changes: (0, None),
        spindle_changes: (0, None),
        smoothing: Smoothing::default(),
        dilation: 1.0,
        refused: (0, None),
    };
    for (run, done) in runs.iter().zip(done) {
        let done = match done {
            Ok(done) => done?,
            Err(refused) => {
                let item = run.segments.first().map(|i| trace.segments[*i].item);
                time.refused.0 += run.segments.len();
                time.refused.1 = time.refused.1.or(item.map(|item| (item, *refused.0)));
                run.as_programmed(trace)
            }
        };
        for (i, t) in run.segments.iter().zip(&done.times) {
            time.segments[*i] = *t;
            time.moves += t;
        }
        time.without_jerk += done.without_jerk;
        time.smoothing.add(&done.smoothing);
        time.dilation = time.dilation.max(done.dilation);
    }
    setting.changes(program, &mut time);
    Some(time)
}

/// Consecutive moves at feed, or a rapid.
struct Stretch {
    segments: Vec<usize>,
}

impl Stretch {
    /// Its moves in the time that the program gives them.
    fn as_programmed(&self, trace: &Trace) -> Done {
        let times = self.segments.iter().map(|i| trace.segments[*i].duration.unwrap_or(0.0)).collect();
        Done { times, without_jerk: 0.0, smoothing: Smoothing::default(), dilation: 1.0 }
    }
}

/// What a stretch takes.
struct Done {
    times: Vec<f64>,
    without_jerk: f64,
    smoothing: Smoothing,
    dilation: f64,
}

impl Smoothing {
    fn add(&mut self, other: &Smoothing) {
        self.smooth += other.smooth;
        self.smoothed += other.smoothed;
        self.stops += other.stops;
        self.farthest = self.farthest.max(other.farthest);
    }
}

/// True if segment `next` may follow a run without a stop: both at feed, in place, and nothing but text between them.
fn goes_on(program: &Program, trace: &Trace, run: &Stretch, next: usize) -> bool {
    /// Distance of two ends that are one place [mm].
    const SAME: f64 = 1e-6;
    let Some(last) = run.segments.last() else { return false };
    let (before, after) = (&trace.segments[*last], &trace.segments[next]);
    let at_feed = |s: &Segment| matches!(s.motion, SegmentPace::Feed(_));
    if !(at_feed(before) && at_feed(after) && before.setup == after.setup) {
        return false;
    }
    if (before.curve.end() - after.curve.start()).length() > SAME {
        return false;
    }
    // Steps of a cycle stop, and so does what is between items.
    let item = |i: u32| program.items.get(i as usize);
    if matches!(item(after.item), Item::Cycle(..)) || matches!(item(before.item), Item::Cycle(..)) {
        return false;
    }
    (before.item + 1..after.item).all(|i| matches!(item(i), Item::Text(_) | Item::Move(_)))
}

/// Machine and control.
struct Setting<'a> {
    machine: &'a Machine,
    limits: [Option<AxisLimit>; AXES],
}

impl<'a> Setting<'a> {
    fn new(machine: &'a Machine, limits: [Option<AxisLimit>; AXES]) -> Setting<'a> {
        Setting { machine, limits }
    }

    /// Distance by which the control may leave the path at the end of an item; zero for an exact stop.
    fn tolerance(&self, program: &Program, item: u32) -> Tolerance {
        let control = &self.machine.control;
        if control.interpolator == Some(Interpolator::ExactStop) {
            return Tolerance { way: 0.0, turn: 0.0 };
        }
        let way = control.tolerance.unwrap_or(USUAL_TOLERANCE);
        let turn = control.turn_tolerance.unwrap_or(USUAL_TURN_TOLERANCE);
        match program.state(item as usize).blend {
            Blend::Stop => Tolerance { way: 0.0, turn: 0.0 },
            Blend::Continuous => Tolerance { way, turn },
            Blend::Tolerance { path, angle } => {
                Tolerance { way: path, turn: if angle > 0.0 { angle } else { turn } }
            }
        }
    }

    fn run(&self, program: &Program, trace: &Trace, stretch: &Stretch) -> Result<Option<Done>> {
        let mut pieces: Vec<Option<Piece>> = Vec::with_capacity(stretch.segments.len());
        for i in &stretch.segments {
            let segment = &trace.segments[*i];
            let Some(path) = segment.axis_path() else { return Ok(None) };
            let length = path.length();
            let feed = match (segment.motion, segment.duration) {
                (SegmentPace::Rapid, _) => f64::INFINITY,
                (_, Some(duration)) if duration > 0.0 => length / duration,
                (SegmentPace::Feed(feed), _) if feed > 0.0 => feed,
                _ => f64::INFINITY,
            };
            // A move of no length takes no time.
            pieces.push((length > 1e-9).then_some(Piece { path, feed }));
        }
        let mut done = Done {
            times: vec![0.0; pieces.len()],
            without_jerk: 0.0,
            smoothing: Smoothing::default(),
            dilation: 1.0,
        };
        let pieces: Vec<(usize, Piece)> =
            pieces.into_iter().enumerate().filter_map(|(k, piece)| Some((k, piece?))).collect();
        let tolerance =
            |i: usize| self.tolerance(program, trace.segments[stretch.segments[pieces[i].0]].item);
        let joints: Vec<Between> = (1..pieces.len())
            .map(|i| Between {
                step: Step::between(
                    &derivatives(&pieces[i - 1].1.path, pieces[i - 1].1.path.length()),
                    &derivatives(&pieces[i].1.path, 0.0),
                ),
                tolerance: tolerance(i - 1),
            })
            .collect();
        let passings = self.passings(&pieces, &joints);
        // Moves between two stops.
        let mut leg = Leg::default();
        for ((k, piece), end) in pieces.into_iter().zip(passings.into_iter().chain([End::Stop])) {
            leg.pieces.push((k, piece));
            match end {
                End::Passed(joint, allowed) => {
                    match joint {
                        Some(_) => done.smoothing.smoothed += 1,
                        None => done.smoothing.smooth += 1,
                    }
                    leg.joints.push(joint);
                    leg.allowed.push(allowed);
                }
                End::Stop => {
                    done.smoothing.stops += 1;
                    if !self.leg(std::mem::take(&mut leg), &mut done)? {
                        return Ok(None);
                    }
                }
            }
        }
        done.smoothing.stops = done.smoothing.stops.saturating_sub(1);
        Ok(Some(done))
    }

    /// For each joint: a stop, or the way in which it is passed.
    fn passings(&self, pieces: &[(usize, Piece)], joints: &[Between]) -> Vec<End> {
        // Way from each joint to the next one at which the tool may have to be slow, backward and forward.
        let length = |i: usize| pieces[i].1.path.length();
        let mut back = vec![0.0; joints.len()];
        let mut way = 0.0;
        for (i, joint) in joints.iter().enumerate() {
            way += length(i);
            back[i] = way;
            if joint.step.is_sharp() {
                way = 0.0;
            }
        }
        let mut ends = Vec::with_capacity(joints.len());
        let mut way = 0.0;
        for (i, joint) in joints.iter().enumerate().rev() {
            way += length(i + 1);
            ends.push(self.passing([&pieces[i].1, &pieces[i + 1].1], joint, [back[i], way]));
            if joint.step.is_sharp() {
                way = 0.0;
            }
        }
        ends.reverse();
        ends
    }

    fn passing(&self, pieces: [&Piece; 2], joint: &Between, ways: [f64; 2]) -> End {
        /// Share of the limits that a joint may use up at the feed: the path beside it needs some, too.
        const SHARE: f64 = 0.5;
        let Between { step, tolerance } = joint;
        if step.is_none() {
            return End::Passed(None, tolerance.way);
        }
        let along = pieces.map(|piece| self.at_feed(piece));
        let feed = along[0].velocity.max(along[1].velocity);
        let half = step.longest(*tolerance).min(step.needed(feed, SHARE, &self.limits));
        if !(half > 0.0) {
            return End::Stop;
        }
        let passed = End::Passed(Some(Joint { at: 0.0, half, step: *step }), tolerance.way);
        let crossing = step.crossing(half, &self.limits);
        let loss = |speed: f64, half: f64| -> f64 {
            along.iter().zip(ways).map(|(along, way)| lost(along, 0.5 * way, speed, half)).sum()
        };
        if loss(crossing, half) < loss(0.0, 0.0) { passed } else { End::Stop }
    }

    /// Limits of the parameter in the middle of a move.
    fn at_feed(&self, piece: &Piece) -> AxisLimit {
        let rates = derivatives(&piece.path, 0.5 * piece.path.length()).map(|d| d[0]);
        along(&rates, &self.limits, piece.feed)
    }

    /// The moves between two stops; false if an axis that moves has no limits.
    fn leg(&self, leg: Leg, done: &mut Done) -> Result<bool> {
        let Leg { pieces, joints, allowed } = leg;
        if let [(k, piece)] = &pieces[..]
            && let Some(rates) = straight(&piece.path)
        {
            if rates.iter().zip(&self.limits).any(|(rate, limit)| *rate != 0.0 && limit.is_none()) {
                return Ok(false);
            }
            let length = piece.path.length();
            let apart = piece.feed.is_infinite() && self.machine.rapids == Some(Rapids::AxisByAxis);
            let time = |limits: &[Option<AxisLimit>; AXES]| {
                if apart {
                    axis_by_axis(&rates, length, limits)
                } else {
                    SCurve::new(length, along(&rates, limits, piece.feed)).duration()
                }
            };
            let no_jerk = self.limits.map(|l| Some(AxisLimit { jerk: f64::INFINITY, ..l? }));
            done.times[*k] = time(&self.limits);
            done.without_jerk += time(&no_jerk);
            return Ok(true);
        }
        let (places, pieces): (Vec<usize>, Vec<Piece>) = pieces.into_iter().unzip();
        let run = Run::new(pieces, joints, &allowed);
        done.smoothing.farthest = done.smoothing.farthest.max(run.farthest());
        match run.moving()[..] {
            [] => Ok(true),
            [a] => self.law(&run, [a], &places, done),
            [a, b] => self.law(&run, [a, b], &places, done),
            [a, b, c] => self.law(&run, [a, b, c], &places, done),
            [a, b, c, d] => self.law(&run, [a, b, c, d], &places, done),
            [a, b, c, d, e] => self.law(&run, [a, b, c, d, e], &places, done),
            _ => self.law(&run, [0, 1, 2, 3, 4, 5], &places, done),
        }
    }

    fn law<const A: usize>(
        &self,
        run: &Run,
        axes: [usize; A],
        places: &[usize],
        done: &mut Done,
    ) -> Result<bool> {
        let mut limits = [AxisLimit { velocity: 0.0, acceleration: 0.0, jerk: 0.0 }; A];
        for (limit, axis) in limits.iter_mut().zip(axes) {
            match self.limits[axis] {
                Some(given) => *limit = given,
                None => return Ok(false),
            }
        }
        let course = run.over(axes);
        let mut note = |moment: &dyn Fn(f64) -> f64| {
            let mut before = 0.0;
            for (k, end) in places.iter().zip(&run.starts()[1..]) {
                let moment = moment(*end);
                done.times[*k] = moment - before;
                before = moment;
            }
        };
        let limited = limits.iter().all(|l| l.jerk.is_finite())
            && self.machine.control.interpolator != Some(Interpolator::Trapezoid);
        if limited {
            let law = TimeLaw::new(&course, &limits)?;
            note(&|s| law.speed().moment(s));
            done.without_jerk += law.without_jerk();
            done.dilation = done.dilation.max(law.dilation());
        } else {
            let law = WithoutJerk::new(&course, &limits)?;
            note(&|s| law.moment(s));
            done.without_jerk += law.duration();
        }
        Ok(true)
    }

    /// Tool changes and changes of the spindle's speed.
    fn changes(&self, program: &Program, time: &mut ProgramTime) {
        let control = &self.machine.control;
        let (mut tool, mut rate) = (None, 0.0);
        let (mut changes, mut ramps, mut ramped) = (0, 0, 0.0);
        for i in 0..program.items.len() {
            match program.items.get(i) {
                Item::Tool { id, .. } if tool != Some(id) => {
                    changes += 1;
                    tool = Some(id);
                }
                Item::Move(_) | Item::Cycle(..) => {
                    let next = program.state(i).spindle.signed_rate();
                    if next != rate {
                        ramps += 1;
                        ramped += (next - rate).abs();
                        rate = next;
                    }
                }
                _ => {}
            }
        }
        time.tool_changes = (changes, control.tool_change.map(|t| t * changes as f64));
        let full = control.spindle_ramp.zip(control.max_speed).map(|(ramp, most)| ramp / most);
        time.spindle_changes = (ramps, full.map(|per| per * ramped));
    }
}

/// Joint of two moves.
struct Between {
    step: Step,
    tolerance: Tolerance,
}

/// End of a move.
enum End {
    /// Passed on the way, smoothed where something steps, with the distance by which the path may be left [mm].
    Passed(Option<Joint>, f64),
    Stop,
}

/// Moves between two stops; the joints between them, and how far the path may be left there [mm].
#[derive(Default)]
struct Leg<'a> {
    pieces: Vec<(usize, Piece<'a>)>,
    joints: Vec<Option<Joint>>,
    allowed: Vec<f64>,
}

/// Time that a path loses when a place of it is passed at `speed` [mm/s] over `half` [mm], against passing it at its feed;
/// `way`: what is there to get from one to the other [mm].
fn lost(along: &AxisLimit, way: f64, speed: f64, half: f64) -> f64 {
    let (a, j) = (along.acceleration, along.jerk);
    let reached = along.velocity.min((way * way * j).cbrt()).min((2.0 * a * way).sqrt());
    let slower = (reached - speed).max(0.0);
    let ramp = if slower * j < a * a { 2.0 * (slower / j).sqrt() } else { slower / a + a / j };
    let crossing = if half > 0.0 && slower > 0.0 { half * (1.0 / speed - 1.0 / reached) } else { 0.0 };
    ramp * slower / (2.0 * reached) + crossing
}
