//! Feeds against what the axes can hold: lowered in a planned program, found in others.

use super::check::Job;
use super::plan::SetupPlan;
use super::setup_outcome::SetupOutcome;
use crate::base::{Code, Finding};
use crate::machine::Machine;
use crate::motion::{AxisBound, FeedBeyond, feeds_beyond, lowered};
use crate::program::{Item, Speed};
use crate::trace::{SegmentPace, Trace};

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

/// A note about lowered feeds, at the item of the text with the lowest one.
pub(super) fn lowered_note(done: &SetupOutcome) -> Option<Finding> {
    let lowest = done
        .trace
        .segments
        .iter()
        .filter_map(|segment| {
            let SegmentPace::Feed(feed) = segment.motion else { return None };
            let asked = done.planned.lowered.get(&done.planned_item(segment.item)?)?;
            Some((segment.item, feed, *asked))
        })
        .collect::<Vec<_>>();
    let (item, feed, asked) = lowest.iter().copied().min_by(|a, b| a.1.total_cmp(&b.1))?;
    let mut items: Vec<u32> = lowest.iter().map(|(item, ..)| *item).collect();
    items.dedup();
    let blocks = match items.len() {
        1 => "in one block".to_owned(),
        more => format!("in {more} blocks; here most"),
    };
    let what = format!("the feed is lowered to what the axes can hold, {blocks}");
    Some(in_mm_per_min(Finding::note(Code::FEED_BEYOND, what), [feed, asked]).item(item))
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
        more => format!(", nor in {} other blocks", more - 1),
    };
    let what = format!("{} does not hold the feed within its {name} here{further}", worst.axis);
    Some(
        in_mm_per_min(Finding::warning(Code::FEED_BEYOND, what), [feed * worst.share, feed])
            .item(segment.item)
            .help("lower the feed there to the value, or give the path larger radii"),
    )
}

/// A finding with a feed and its bound [mm/s], in mm/min.
fn in_mm_per_min(finding: Finding, [value, bound]: [f64; 2]) -> Finding {
    let minute = |feed: f64| (feed * 600.0).round() / 10.0;
    finding.value(minute(value), "mm/min").bound(minute(bound), "mm/min")
}
