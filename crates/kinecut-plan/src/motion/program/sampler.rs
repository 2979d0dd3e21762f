//! Samples of the moves and rests of a program, one after the other.

use rayon::prelude::*;

use super::joint::AXES;
use super::motion::{AxisMoment, Motion};
use super::samples::{FinerSamples, MotionSample, SampledMotion};
use super::stretch::{Stretch, StretchTime};
use super::waits::Wait;
use crate::base::{Code, Finding, Progress, Result};
use crate::trace::Trace;

/// Samples that are computed together.
const TOGETHER: u64 = 8192;

/// Multiples of a cycle before a moment [s].
pub(super) fn multiples(time: f64, cycle: f64) -> f64 {
    /// Part of a cycle by which a sample may lie beside the end of a move and still be that of the next one.
    const NEAR: f64 = 1e-6;
    (time / cycle - NEAR).ceil().max(0.0)
}

/// Samples up to a moment.
pub(super) struct Sampler<'a> {
    trace: &'a Trace,
    cycle: f64,
    finer: Option<FinerSamples>,
    progress: &'a dyn Progress,
    sink: &'a mut dyn FnMut(&MotionSample) -> Result<()>,
    /// Multiple of the cycle at which the next sample lies.
    next: u64,
    /// Positions of the axes at this moment, once they are known [mm, rad].
    at: Option<[f64; AXES]>,
    item: u32,
    extent: SampledMotion,
}

impl<'a> Sampler<'a> {
    pub(super) fn new(
        trace: &'a Trace,
        (cycle, finer): (f64, Option<FinerSamples>),
        progress: &'a dyn Progress,
        sink: &'a mut dyn FnMut(&MotionSample) -> Result<()>,
    ) -> Sampler<'a> {
        let extent = SampledMotion::default();
        Sampler { trace, cycle, finer, progress, sink, next: 0, at: None, item: 0, extent }
    }

    /// A stretch comes next: where nothing was followed before, the axes stand at its start.
    pub(super) fn begin(&mut self, stretch: &Stretch) {
        if self.at.is_none() {
            let first = stretch.segments.first().and_then(|i| self.trace.segments[*i].axis_path());
            self.at = first.map(|path| path.at(0.0).map(|jet| jet.q));
        }
    }

    pub(super) fn moves(&mut self, solved: &StretchTime) -> Result<()> {
        solved.motions.iter().try_for_each(|motion| self.motion(motion))
    }

    fn motion(&mut self, motion: &Motion) -> Result<()> {
        /// Distance of two positions that are one [mm, rad].
        const SAME: f64 = 1e-4;
        let (start, duration) = (self.extent.time, motion.duration());
        let ends = [0.0, duration].map(|time| motion.at(time));
        let positions = ends.map(|end| end.map(|all| all.axes.map(|axis| axis.position)));
        if let [Some(from), Some(_)] = positions {
            let before = self.at.unwrap_or(from);
            self.extent.jumps += usize::from(before.iter().zip(from).any(|(a, b)| (a - b).abs() > SAME));
        }
        let trace = self.trace;
        self.samples(start + duration, |time| {
            let all = motion.at((time - start).max(0.0))?;
            let (item, segment) = (trace.segments[all.segment].item, Some(all.segment as u32));
            Some(MotionSample { time, item, segment, feed: all.feed, axes: all.axes })
        })?;
        if let [_, Some(end)] = ends {
            self.item = trace.segments[end.segment].item;
        }
        self.at = positions[1].or(self.at);
        Ok(())
    }

    pub(super) fn rest(&mut self, wait: &Wait) -> Result<()> {
        self.item = wait.item;
        let (at, item) = (self.at, wait.item);
        self.samples(self.extent.time + wait.time, |time| {
            Some(MotionSample { time, item, segment: None, feed: 0.0, axes: resting(at?) })
        })
    }

    /// Leaves the time of a stretch without samples.
    pub(super) fn leave_out(&mut self, stretch: &Stretch) {
        let time = stretch.as_programmed(self.trace).times.iter().sum::<f64>();
        self.extent.left_out += stretch.segments.len();
        self.extent.left_out_time += time;
        self.extent.time += time;
        self.next = multiples(self.extent.time, self.cycle) as u64;
        let last = stretch.segments.last().map(|i| &self.trace.segments[*i]);
        self.at = last.and_then(|s| s.axis_path()).map(|path| path.at(path.length()).map(|jet| jet.q));
    }

    /// The samples before a moment [s], which is then the present one.
    fn samples(&mut self, end: f64, at: impl Fn(f64) -> Option<MotionSample> + Sync) -> Result<()> {
        let last = multiples(end, self.cycle) as u64;
        if let Some(finer) = self.finer {
            return self.finer_samples(finer, [end, last as f64], &at);
        }
        let cycle = self.cycle;
        while self.next < last {
            if self.progress.cancelled() {
                return Err(Finding::error(Code::CANCELLED, "the run was cancelled").into());
            }
            let (first, count) = (self.next, (last - self.next).min(TOGETHER));
            let one = |k: u64| at((first + k) as f64 * cycle);
            let some: Vec<Option<MotionSample>> =
                (0..count as u32).into_par_iter().with_min_len(128).map(|k| one(u64::from(k))).collect();
            for sample in some.iter().flatten() {
                (self.sink)(sample)?;
                self.extent.count += 1;
            }
            self.next += count;
        }
        self.extent.time = end;
        Ok(())
    }

    /// The samples up to a moment [s] with its end, and with more where the motion changes; `last`: multiples of the cycle
    /// before that moment.
    fn finer_samples(
        &mut self,
        finer: FinerSamples,
        [end, last]: [f64; 2],
        at: &(impl Fn(f64) -> Option<MotionSample> + Sync),
    ) -> Result<()> {
        let (start, cycle, last) = (self.extent.time, self.cycle, last as u64);
        if !(end > start) {
            return Ok(());
        }
        let mut before = at(start);
        if let Some(first) = &before {
            (self.sink)(first)?;
            self.extent.count += 1;
        }
        loop {
            if self.progress.cancelled() {
                return Err(Finding::error(Code::CANCELLED, "the run was cancelled").into());
            }
            let (first, count) = (self.next, last.saturating_sub(self.next).min(TOGETHER));
            let is_end = first + count >= last;
            let mut times: Vec<f64> = (first..first + count).map(|k| k as f64 * cycle).collect();
            if is_end {
                times.push(end);
            }
            times.retain(|time| *time > start);
            let some: Vec<Option<MotionSample>> =
                times.par_iter().with_min_len(128).map(|time| at(*time)).collect();
            let pairs: Vec<_> = std::iter::once(&before).chain(&some).zip(&some).collect();
            let finer_of = |(a, b): &(&Option<MotionSample>, &Option<MotionSample>)| {
                let mut out = Vec::new();
                if let (Some(a), Some(b)) = (a, b) {
                    halve([a, b], &finer, at, &mut out);
                }
                out.extend(**b);
                out
            };
            let all: Vec<Vec<MotionSample>> = pairs.par_iter().with_min_len(32).map(finer_of).collect();
            for sample in all.iter().flatten() {
                (self.sink)(sample)?;
                self.extent.count += 1;
            }
            before = some.last().copied().flatten().or(before);
            self.next += count;
            if is_end {
                break;
            }
        }
        self.extent.time = end;
        Ok(())
    }

    /// The last sample.
    pub(super) fn end(mut self) -> Result<SampledMotion> {
        if let Some(at) = self.at {
            (self.sink)(&MotionSample {
                time: self.extent.time,
                item: self.item,
                segment: None,
                feed: 0.0,
                axes: resting(at),
            })?;
            self.extent.count += 1;
        }
        Ok(self.extent)
    }
}

/// Adds the samples between two that differ too much.
fn halve(
    [a, b]: [&MotionSample; 2],
    finer: &FinerSamples,
    at: &impl Fn(f64) -> Option<MotionSample>,
    out: &mut Vec<MotionSample>,
) {
    let size =
        |s: &MotionSample| s.axes[..3].iter().map(|axis| axis.acceleration.powi(2)).sum::<f64>().sqrt();
    let changes = a.segment != b.segment
        || (a.feed - b.feed).abs() > finer.speed
        || (size(a) - size(b)).abs() > finer.acceleration;
    if !changes || b.time - a.time <= finer.cycle {
        return;
    }
    let Some(middle) = at(0.5 * (a.time + b.time)) else { return };
    halve([a, &middle], finer, at, out);
    out.push(middle);
    halve([&middle, b], finer, at, out);
}

fn resting(at: [f64; AXES]) -> [AxisMoment; AXES] {
    at.map(|position| AxisMoment { position, ..AxisMoment::default() })
}
