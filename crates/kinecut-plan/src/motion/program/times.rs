//! The time of a program: each path under the limits of all axes, and what the control waits for.

use std::sync::atomic::{AtomicUsize, Ordering};

use rayon::prelude::*;

use super::super::course::Stretch as Part;
use super::super::law::cells_of;
use super::super::{AxisLimit, Course, End, SCurve, TimeLaw, WithoutJerk};
use super::axis_limits;
use super::joint::{AXES, Joint, Step, Tolerance};
use super::junction::junction_times;
use super::law::Law;
use super::level::level;
use super::passing::{Between, Passing, passings};
use super::program_time::{ProgramTime, Smoothing};
use super::ramp::Ramp;
use super::run::{Piece, Run, derivatives};
use super::straight::{along, axis_by_axis, straight};
use crate::base::{Code, Finding, Progress, Result};
use crate::machine::{Interpolator, Machine, Rapids};
use crate::program::{Blend, Item, Program};
use crate::trace::{AxisPath, Segment, SegmentPace, Trace};

/// Distance by which a control leaves the path at a corner where neither program nor machine says one [mm].
const USUAL_TOLERANCE: f64 = 0.01;
/// The same for rotary axes [rad].
const USUAL_TURN_TOLERANCE: f64 = 0.05 * std::f64::consts::PI / 180.0;

/// The time of a program that was followed on a machine; `None` if an axis that moves has no rapid speed or no acceleration.
///
/// Each stretch of feed between stops is run as fast as the axes allow ([`TimeLaw`]); at joints the control stops or leaves
/// the path by its tolerance, whichever is faster. Rapids and straight moves from stop to stop are exact.
///
/// # Errors
/// `KC0009` when it was cancelled.
pub fn program_time(
    program: &Program,
    trace: &Trace,
    machine: &Machine,
    progress: &dyn Progress,
) -> Result<Option<ProgramTime>> {
    let mut setting = Setting::new(machine, progress);
    let mut runs: Vec<Stretch> = Vec::new();
    for (i, segment) in trace.segments.iter().enumerate() {
        if segment.alternative {
            continue;
        }
        match runs.last_mut() {
            Some(run) if setting.goes_on(program, trace, run, i) => run.segments.push(i),
            _ => runs.push(Stretch { segments: vec![i] }),
        }
    }
    // Many moves that are not run evenly: their cells are counted before any of them is solved.
    if trace.segments.len() > UNCOUNTED {
        setting.work = Work::Count(AtomicUsize::new(0));
        let counted: Vec<Result<Option<Done>>> =
            runs.par_iter().with_max_len(1).map(|run| setting.run(program, trace, run)).collect();
        drop(counted);
        let Work::Count(cells) = &setting.work else { return Ok(None) };
        setting.work = Work::Solve { jerk: cells.load(Ordering::Relaxed) <= MOST_CELLS };
    }
    let done: Vec<Result<Option<Done>>> =
        runs.par_iter().with_max_len(1).map(|run| setting.run(program, trace, run)).collect();
    if progress.cancelled() {
        return Err(Finding::error(Code::CANCELLED, "the run was cancelled").into());
    }
    let mut time = ProgramTime {
        segments: vec![0.0; trace.segments.len()],
        moves: 0.0,
        without_jerk: 0.0,
        dwells: trace.dwells.iter().map(|d| d.1).sum(),
        tool_changes: (0, None),
        spindle_changes: (0, None),
        smoothing: Smoothing::default(),
        dilation: 1.0,
        without_limit_of_jerk: 0,
        refused: (0, None),
    };
    for (run, done) in runs.iter().zip(done) {
        let done = match done {
            Ok(Some(done)) => done,
            Ok(None) => return Ok(None),
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
        time.without_limit_of_jerk += done.without_limit_of_jerk;
    }
    setting.changes(program, &mut time);
    Ok(Some(time))
}

/// Consecutive moves at feed, or a rapid.
struct Stretch {
    segments: Vec<usize>,
}

impl Stretch {
    /// Its moves in the time that the program gives them.
    fn as_programmed(&self, trace: &Trace) -> Done {
        let times = self.segments.iter().map(|i| trace.segments[*i].duration.unwrap_or(0.0)).collect();
        Done {
            times,
            without_jerk: 0.0,
            smoothing: Smoothing::default(),
            dilation: 1.0,
            without_limit_of_jerk: 0,
        }
    }
}

/// What a stretch takes.
struct Done {
    times: Vec<f64>,
    without_jerk: f64,
    smoothing: Smoothing,
    dilation: f64,
    without_limit_of_jerk: usize,
}

/// True if segment `next` may follow a run without a stop: in place, both at feed or `mixed`, and nothing but text between
/// them.
fn goes_on(program: &Program, trace: &Trace, run: &Stretch, next: usize, mixed: bool) -> bool {
    /// Distance of two ends that are one place [mm].
    const SAME: f64 = 1e-6;
    let Some(last) = run.segments.last() else { return false };
    let (before, after) = (&trace.segments[*last], &trace.segments[next]);
    let at_feed = |s: &Segment| mixed || matches!(s.motion, SegmentPace::Feed(_));
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

/// Segments up to which a program is solved without counting first.
const UNCOUNTED: usize = 2000;
/// Most cells, times axes, that are solved under a jerk limit: some ten seconds of work.
const MOST_CELLS: usize = 1_000_000;

/// What is done about the stretches that are not run evenly.
enum Work {
    /// Their cells are counted, times axes.
    Count(AtomicUsize),
    /// They are solved, under the limits of jerk or without.
    Solve { jerk: bool },
}

/// Machine and control.
struct Setting<'a> {
    work: Work,
    progress: &'a dyn Progress,
    machine: &'a Machine,
    limits: [Option<AxisLimit>; AXES],
}

impl<'a> Setting<'a> {
    fn new(machine: &'a Machine, progress: &'a dyn Progress) -> Setting<'a> {
        Setting { work: Work::Solve { jerk: true }, progress, machine, limits: axis_limits(machine) }
    }

    /// The joint deviation of a control that looks ahead by it [mm].
    fn junction_deviation(&self) -> Option<f64> {
        /// Grbl's setting $11.
        const USUAL: f64 = 0.01;
        let control = &self.machine.control;
        (control.interpolator == Some(Interpolator::JunctionDeviation))
            .then(|| control.junction_deviation.unwrap_or(USUAL))
    }

    fn goes_on(&self, program: &Program, trace: &Trace, run: &Stretch, next: usize) -> bool {
        goes_on(program, trace, run, next, self.junction_deviation().is_some())
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
        self.progress.advance(pieces.len() as u64);
        let mut done = Done {
            times: vec![0.0; pieces.len()],
            without_jerk: 0.0,
            smoothing: Smoothing::default(),
            dilation: 1.0,
            without_limit_of_jerk: 0,
        };
        if let Some(deviation) = self.junction_deviation() {
            return Ok(self.by_junctions(pieces, deviation));
        }
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
        let passings = passings(&pieces, &joints, &self.limits);
        // Moves between two stops.
        let mut leg = Leg::default();
        for ((k, piece), end) in pieces.into_iter().zip(passings.into_iter().chain([Passing::Stop])) {
            leg.pieces.push((k, piece));
            match end {
                Passing::Passed(joint, allowed) => {
                    match joint {
                        Some(_) => done.smoothing.smoothed += 1,
                        None => done.smoothing.smooth += 1,
                    }
                    leg.joints.push(joint);
                    leg.allowed.push(allowed);
                }
                Passing::Stop => {
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

    /// The stretch as a control runs it that looks ahead by junction deviation.
    fn by_junctions(&self, pieces: Vec<Option<Piece>>, deviation: f64) -> Option<Done> {
        let mut times = vec![0.0; pieces.len()];
        let (places, moves): (Vec<usize>, Vec<_>) = pieces
            .into_iter()
            .enumerate()
            .filter_map(|(k, piece)| piece.map(|piece| (k, (piece.path, piece.feed))))
            .unzip();
        let bound = |path: &AxisPath| {
            let rates = path.at(0.5 * path.length());
            rates.iter().zip(&self.limits).all(|(jet, limit)| jet.d1 == 0.0 || limit.is_some())
        };
        if !moves.iter().all(|(path, _)| bound(path)) {
            return None;
        }
        for (k, time) in places.iter().zip(junction_times(&moves, deviation, &self.limits)) {
            times[*k] = time;
        }
        let without_jerk = times.iter().sum();
        Some(Done {
            times,
            without_jerk,
            smoothing: Smoothing::default(),
            dilation: 1.0,
            without_limit_of_jerk: 0,
        })
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
        let end = course.length();
        let has_jerk = limits.iter().all(|l| l.jerk.is_finite())
            && self.machine.control.interpolator != Some(Interpolator::Trapezoid);
        let limited = has_jerk && !matches!(self.work, Work::Solve { jerk: false });
        // Stretches between level ones, and the level ones behind them.
        let levels = level(&course, &limits);
        let froms = std::iter::once(0.0).chain(levels.iter().map(|l| l[1]));
        let stretches: Vec<[f64; 3]> = froms
            .zip(levels.iter().copied().chain([[end, end]]))
            .map(|(from, [to, next])| [from, to, next])
            .collect();
        let solved: Vec<Result<Option<Law>>> = stretches
            .par_iter()
            .with_max_len(1)
            .map(|[from, to, _]| {
                if to <= from {
                    return Ok(None);
                }
                let state = |is_stop: bool| if is_stop { End::Rest } else { End::Even };
                let states = [state(*from == 0.0), state(*to == end)];
                let feed = course.feed(0.5 * (from + to));
                if let Some(rates) = run.straight([*from, *to]) {
                    let along = |given| along(&rates, &given, feed);
                    return Ok(Some(Law::Straight(Ramp::new(to - from, states, along, &self.limits))));
                }
                let stretch = Part::new(&course, [*from, *to]);
                if let Work::Count(cells) = &self.work {
                    if has_jerk {
                        cells.fetch_add(A * cells_of(&stretch, &limits, states)?, Ordering::Relaxed);
                    }
                    return Ok(None);
                }
                Ok(Some(if limited {
                    Law::Limited(Box::new(TimeLaw::between(&stretch, &limits, states, self.progress)?))
                } else {
                    Law::WithoutJerk(WithoutJerk::between(&stretch, &limits, states)?)
                }))
            })
            .collect();
        if matches!(self.work, Work::Count(_)) {
            return Ok(true);
        }
        // Moments of the ends of moves.
        let mut ends = run.starts()[1..].iter().copied().peekable();
        let mut moments = Vec::with_capacity(places.len());
        let mut clock = 0.0;
        for ([from, to, next], law) in stretches.into_iter().zip(solved) {
            if let Some(law) = law? {
                if has_jerk && matches!(law, Law::WithoutJerk(_)) {
                    let starts = run.starts();
                    let moves =
                        starts.partition_point(|s| *s < to) - starts.partition_point(|s| *s <= from) + 1;
                    done.without_limit_of_jerk += moves;
                }
                while let Some(s) = ends.next_if(|s| *s <= to) {
                    moments.push(clock + law.moment(s - from));
                }
                clock += law.duration();
                done.without_jerk += law.without_jerk();
                done.dilation = done.dilation.max(law.dilation());
            }
            if next > to {
                let feed = course.feed(0.5 * (to + next));
                while let Some(s) = ends.next_if(|s| *s <= next) {
                    moments.push(clock + (s - to) / feed);
                }
                clock += (next - to) / feed;
                done.without_jerk += (next - to) / feed;
            }
        }
        let mut before = 0.0;
        for (k, moment) in places.iter().zip(moments) {
            done.times[*k] = moment - before;
            before = moment;
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

/// Moves between two stops; the joints between them, and how far the path may be left there [mm].
#[derive(Default)]
struct Leg<'a> {
    pieces: Vec<(usize, Piece<'a>)>,
    joints: Vec<Option<Joint>>,
    allowed: Vec<f64>,
}
