//! Consecutive moves without a wait between them.

use super::joint::{Step, Tolerance};
use super::junction::Chords;
use super::leg::{Leg, Task};
use super::linuxcnc::{Ending, Planned};
use super::motion::Motion;
use super::passing::{Between, Passing, passings};
use super::program_time::Smoothing;
use super::run::Piece;
use super::setting::{Setting, without_jerk};
use super::straight::straight;
use super::swing::{swing_time, swings};
use crate::base::Result;
use crate::program::{Item, Program};
use crate::trace::{Segment, SegmentPace, Trace};

/// Consecutive moves at feed, or a rapid; indices of segments.
pub(super) struct Stretch {
    pub(super) segments: Vec<usize>,
}

/// Result for a stretch.
#[derive(Default)]
pub(super) struct StretchTime<'a> {
    /// Time of each segment [s].
    pub(super) times: Vec<f64>,
    /// Time of all where jerk has no limit [s].
    pub(super) without_jerk: f64,
    pub(super) smoothing: Smoothing,
    /// Largest factor by which a part was slowed.
    pub(super) dilation: f64,
    /// Moves on which a limit of jerk does not count.
    pub(super) jerk_left_out: usize,
    /// Turns on the spot that are in the times [s].
    pub(super) swings: f64,
    /// Cells times axes, of [`Task::Count`].
    pub(super) cells: usize,
    /// Its motion, where that is kept.
    pub(super) motions: Vec<Motion<'a>>,
}

/// The segments of a trace in stretches.
pub(super) fn stretches(program: &Program, trace: &Trace, setting: &Setting) -> Vec<Stretch> {
    let mut all: Vec<Stretch> = Vec::new();
    for (i, segment) in trace.segments.iter().enumerate() {
        if segment.alternative {
            continue;
        }
        match all.last_mut() {
            Some(stretch) if stretch.goes_on(program, trace, i, setting) => stretch.segments.push(i),
            _ => all.push(Stretch { segments: vec![i] }),
        }
    }
    all
}

impl Stretch {
    /// True if a segment may follow without a stop: in place, both at feed unless the control mixes them, and nothing but text
    /// between them.
    fn goes_on(&self, program: &Program, trace: &Trace, next: usize, setting: &Setting) -> bool {
        /// Distance of two ends that are one place [mm].
        const SAME: f64 = 1e-6;
        let Some(last) = self.segments.last() else { return false };
        let (before, after) = (&trace.segments[*last], &trace.segments[next]);
        let at_feed = |s: &Segment| setting.has_own_planner() || matches!(s.motion, SegmentPace::Feed(_));
        if !(at_feed(before) && at_feed(after) && before.setup == after.setup) {
            return false;
        }
        if (before.curve.end() - after.curve.start()).length() > SAME {
            return false;
        }
        // LinuxCNC switches spindle, coolant and coordinates at rest (emctaskmain.cc, `emcTaskCheckPreconditions`).
        let [old, new] = [before, after].map(|s| program.state(s.item as usize));
        let switches = old.spindle != new.spindle || old.coolant != new.coolant || old.frame != new.frame;
        if setting.is_linuxcnc() && switches {
            return false;
        }
        // Steps of a cycle stop, and so does what is between items. LinuxCNC's planner decides for itself, but where the cycle
        // waits.
        let item = |i: u32| program.items.get(i as usize);
        let waits = |s: &Segment| trace.dwells.binary_search_by_key(&s.item, |dwell| dwell.0).is_ok();
        let decides = setting.is_linuxcnc() && !(before.item == after.item && waits(before));
        let stops = |s: &Segment| matches!(item(s.item), Item::Cycle(..)) && !decides;
        !stops(before)
            && !stops(after)
            && (before.item + 1..after.item)
                .all(|i| matches!(item(i), Item::Text(_) | Item::Message(_) | Item::Move(_)))
    }

    /// Its moves in the time that the program gives them.
    pub(super) fn as_programmed(&self, trace: &Trace) -> StretchTime<'static> {
        let times = self.segments.iter().map(|i| trace.segments[*i].duration.unwrap_or(0.0)).collect();
        StretchTime { times, ..StretchTime::default() }
    }

    /// The time of its moves; `None` if an axis that moves has no limits, or is not known.
    ///
    /// # Errors
    /// Those of [`TimeLaw::between`](super::super::TimeLaw::between).
    pub(super) fn time<'a>(
        &self,
        program: &Program,
        trace: &'a Trace,
        setting: &Setting,
        task: Task,
    ) -> Result<Option<StretchTime<'a>>> {
        /// Length of a move that takes no time [mm].
        const NONE: f64 = 1e-9;
        let mut done = StretchTime { times: vec![0.0; self.segments.len()], ..StretchTime::default() };
        // Moves with their places in the stretch.
        let mut pieces: Vec<Piece> = Vec::with_capacity(self.segments.len());
        let mut places: Vec<usize> = Vec::with_capacity(self.segments.len());
        for (k, i) in self.segments.iter().enumerate() {
            let segment = &trace.segments[*i];
            let Some(path) = segment.axis_path() else { return Ok(None) };
            let length = path.length();
            if !(length > NONE) {
                continue;
            }
            // Chords have the turns on the spot in them.
            let by_itself = segment.turning.is_some() && !setting.has_own_planner();
            let swings = if by_itself { swings(&path) } else { [None; 2] };
            for swing in swings.iter().flatten() {
                let limits = [setting.limits, without_jerk(&setting.limits)];
                let [Some(time), Some(no_jerk)] = limits.map(|limits| swing_time(swing, &limits)) else {
                    return Ok(None);
                };
                done.times[k] += time;
                done.swings += time;
                done.without_jerk += no_jerk;
            }
            places.push(k);
            let turned = swings.map(|swing| swing.is_some());
            pieces.push(Piece {
                feed: feed(segment, length),
                rates: straight(&path),
                path,
                segment: *i,
                item: segment.item,
                stands: !(segment.curve.length() > NONE),
                turned,
            });
        }
        if let Some(deviation) = setting.junction_deviation() {
            let Some(chords) = Chords::of(&pieces, deviation, &setting.limits) else { return Ok(None) };
            for (k, time) in places.iter().zip(chords.times()) {
                done.times[*k] += time;
                done.without_jerk += time;
            }
            if setting.keeps_motion {
                done.motions.push(Motion::Chords(chords));
            }
            return Ok(Some(done));
        }
        if setting.is_linuxcnc() {
            let item = |place: &usize| trace.segments[self.segments[*place]].item;
            let ending = |item: u32| (item, setting.linuxcnc_ending(program, item));
            let endings: Vec<(u32, Ending)> = places.iter().map(|place| ending(item(place))).collect();
            let Some(planned) = Planned::of(&pieces, &endings, &setting.limits) else { return Ok(None) };
            for (k, time) in places.iter().zip(planned.times()) {
                done.times[*k] += time;
                done.without_jerk += time;
            }
            if setting.keeps_motion {
                done.motions.push(Motion::LinuxCnc(planned));
            }
            return Ok(Some(done));
        }
        let joints: Vec<Between> = (1..pieces.len())
            .map(|i| {
                let before = &pieces[i - 1];
                let [item, next] = [i - 1, i].map(|i| trace.segments[self.segments[places[i]]].item);
                let tolerance = setting.tolerance(program, item);
                Between {
                    step: Step::between(
                        &before.derivatives(before.path.length()),
                        &pieces[i].derivatives(0.0),
                    ),
                    // A block of several moves is one way to the control.
                    stops: tolerance.is_none() && item != next,
                    tolerance: tolerance.unwrap_or(Tolerance::NONE),
                    on_the_spot: pieces[i - 1].turned[1] || pieces[i].turned[0],
                }
            })
            .collect();
        let passings = passings(&pieces, &joints, &setting.limits);
        done.smoothing.count(&passings);
        let mut leg = Leg::default();
        let mut places = places.into_iter();
        for (piece, end) in pieces.into_iter().zip(passings.into_iter().chain([Passing::Stop])) {
            let swing = |end: usize| {
                let wanted = setting.keeps_motion && task != Task::Count;
                wanted.then(|| Motion::swing(&piece, end, &setting.limits)).flatten()
            };
            done.motions.extend(swing(0));
            let after = swing(1);
            leg.pieces.push(piece);
            if let Passing::Passed(joint, allowed) = end {
                leg.joints.push(joint);
                leg.allowed.push(allowed);
                continue;
            }
            let Some(time) = std::mem::take(&mut leg).time(setting, task)? else { return Ok(None) };
            // The times first: they end where the places go on.
            for (time, k) in time.times.iter().zip(places.by_ref()) {
                done.times[k] += time;
            }
            done.without_jerk += time.without_jerk;
            done.jerk_left_out += time.jerk_left_out;
            done.smoothing.add_farthest(&time.farthest);
            done.dilation = done.dilation.max(time.dilation);
            done.cells += time.cells;
            done.motions.extend(time.motion);
            done.motions.extend(after);
        }
        Ok(Some(done))
    }
}

/// Rate of a move's parameter at its programmed feed [mm/s]; infinite for a rapid.
pub(super) fn feed(segment: &Segment, length: f64) -> f64 {
    match (segment.motion, segment.duration) {
        (SegmentPace::Rapid, _) => f64::INFINITY,
        (_, Some(duration)) if duration > 0.0 => length / duration,
        (SegmentPace::Feed(feed), _) if feed > 0.0 => feed,
        _ => f64::INFINITY,
    }
}
