//! Feeds against what the axes can hold: lowered in a planned program, found in others.

use super::check::Job;
use super::plan::SetupPlan;
use super::setup_outcome::SetupOutcome;
use crate::base::{Code, Finding};
use crate::machine::Machine;
use crate::motion::{AxisBound, FeedBeyond, feeds_beyond, lowered};
use crate::program::{Item, Speed};
use crate::trace::{Segment, SegmentPace, Trace};

/// The plan with the feeds lowered that blocks of its text cannot hold; `None` where all blocks hold theirs, or feeds are
/// written as they are.
///
/// Of moves on which the tool turns only the speeds of the axes count: at a pole the accelerations of an even run grow
/// without bound, and the feed of the whole block would have to follow.
pub(super) fn lower(job: &Job, done: &SetupOutcome) -> Option<SetupPlan> {
    let (Some(machine), Some(_)) = (&job.machine, &job.feed_limit) else { return None };
    let mut changed: Option<SetupPlan> = None;
    for beyond in feeds_beyond(&done.trace, machine) {
        let segment = &done.trace.segments[beyond.segment];
        if segment.turning.is_some() && beyond.bound != AxisBound::Velocity {
            continue;
        }
        let Some(item) = done.planned_item(segment.item) else { continue };
        let planned = &done.planned.program;
        let (Item::Move(_), Speed::PerMinute(feed)) =
            (planned.items.get(item as usize), planned.state(item as usize).speed)
        else {
            continue;
        };
        let plan = changed.get_or_insert_with(|| done.planned.clone());
        let Speed::PerMinute(now) = plan.program.state(item as usize).speed else { continue };
        // Several blocks of one item: the slowest counts.
        let wanted = lowered(feed * beyond.share);
        if wanted < now {
            plan.program.set_speed(item as usize, Speed::PerMinute(wanted));
            plan.lowered.entry(item).or_insert(feed);
        }
    }
    changed
}

/// Lowered feeds in words: the blocks, and the lowest feed with its line.
pub(crate) fn lowered_words(done: &SetupOutcome) -> Option<String> {
    let own = |segment: &Segment| {
        let SegmentPace::Feed(feed) = segment.motion else { return None };
        let asked = done.planned.lowered.get(&done.planned_item(segment.item)?)?;
        Some((segment.item, feed, *asked))
    };
    let all: Vec<(u32, f64, f64)> = done.trace.segments.iter().filter_map(own).collect();
    let (item, feed, asked) = all.iter().copied().min_by(|a, b| a.1.total_cmp(&b.1))?;
    let mut items: Vec<u32> = all.iter().map(|(item, ..)| *item).collect();
    items.dedup();
    let place = done.lines.get(item as usize).copied().flatten();
    let place = place.map_or(String::new(), |line| format!(" in line {}", line + 1));
    let [feed, asked] = [feed, asked].map(|feed| (feed * 60.0).round());
    let blocks = if items.len() == 1 { "one block".to_owned() } else { format!("{} blocks", items.len()) };
    Some(format!(
        "feed words lowered in {blocks} to what the axes hold, the lowest{place}: {feed} of {asked} mm/min"
    ))
}

/// Feeds that no even run of the axes holds within their acceleration or jerk: one warning for each of both, at the item
/// that holds the least share of its feed.
pub(crate) fn not_held(trace: &Trace, machine: &Machine) -> Vec<Finding> {
    let beyond = feeds_beyond(trace, machine);
    let bounds = [(AxisBound::Acceleration, "acceleration"), (AxisBound::Jerk, "jerk")];
    bounds.into_iter().filter_map(|(bound, name)| worst(trace, &beyond, bound, name)).collect()
}

fn worst(trace: &Trace, beyond: &[FeedBeyond], bound: AxisBound, name: &str) -> Option<Finding> {
    let own = || beyond.iter().filter(|b| b.bound == bound);
    let worst = own().min_by(|a, b| a.share.total_cmp(&b.share))?;
    let segment = &trace.segments[worst.segment];
    let SegmentPace::Feed(feed) = segment.motion else { return None };
    let mut items: Vec<u32> = own().map(|b| trace.segments[b.segment].item).collect();
    items.dedup();
    let further = match items.len() {
        1 => String::new(),
        2 => ", nor in one other block".to_owned(),
        more => format!(", nor in {} other blocks", more - 1),
    };
    let what = format!("{} does not hold the feed within its {name} here{further}", worst.axis);
    let minute = |feed: f64| (feed * 600.0).round() / 10.0;
    Some(
        Finding::warning(Code::FEED_BEYOND, what)
            .value(minute(feed * worst.share), "mm/min")
            .bound(minute(feed), "mm/min")
            .item(segment.item)
            .point(segment.curve.start().to_array())
            .help("lower the feed there to the value, or give the path larger radii"),
    )
}
