//! Section of a report on the engagement of the tools: the greatest of each tool, and its course over the time of the program.

use super::EngagedRun;
use crate::cutting::{FORCE_SPREAD, Material, TAPPING_SPREAD};
use crate::job::engagement::{Block, Chips, Course, Deflection, blocks, course};
use crate::job::{Engagement, Outcome, SetupOutcome};
use crate::page::{Cell, Chart, Follows, Row, Section, Table, fixed};
use crate::stock::cut::MoveEngagement;
use crate::tool::{Cutter, Tool, ToolNumber};
use crate::trace::{Segment, SegmentPace};

/// The section; `begins`: for each line of all programs the time at which it begins [s]; none where engagement was not measured.
pub(super) fn section(outcome: &Outcome, begins: &[f64], first_lines: &[u32]) -> Option<Section> {
    let all = outcome.simulation.engagement.as_ref()?;
    let by_setup: Vec<Vec<Block>> = (0..outcome.setups.len()).map(|i| blocks(outcome, i)).collect();
    // Blocks with their line in the report, counted from 0.
    let blocks: Vec<(u32, &Block)> = by_setup
        .iter()
        .zip(first_lines)
        .flat_map(|(own, first)| own.iter().map(move |block| (first + block.line - 1, block)))
        .collect();
    if blocks.iter().all(|(_, block)| block.removed == 0.0) {
        return None;
    }
    let mut section = Section::new("Engagement of the tools");
    let course: Vec<Course> =
        first_lines.iter().enumerate().flat_map(|(i, first)| course(outcome, i, begins, *first)).collect();
    let chart = |title: &str, y: (&str, &str), of: fn(&Course) -> f64| {
        let points = over_time(&course, begins.last().copied().unwrap_or(0.0), of);
        Chart::new(title, ("time", "s"), y).series("", points).follows(Follows::Time, 0.0)
    };
    section = section.with(chart("Arc of contact", ("arc", "\u{b0}"), |c| c.arc)).with(chart(
        "Removal rate",
        ("rate", "cm\u{b3}/min"),
        |c| c.rate.map_or(f64::NAN, |rate| rate * PER_MINUTE),
    ));
    if course.iter().any(|c| c.chip.is_some_and(|chip| chip > 0.0)) {
        section =
            section.with(chart("Thickness of the chip", ("greatest", "mm"), |c| c.chip.unwrap_or(f64::NAN)));
    }
    let mut conditions: Vec<String> = notes(all).to_vec();
    if course.iter().any(|c| c.power.is_some_and(|power| power > 0.0)) {
        section = section.with(chart("Power of the cut", ("power", "kW"), |c| c.power.unwrap_or(f64::NAN)));
        conditions.extend(load_note(outcome));
        conditions.push(DEFLECTION.to_owned());
    }
    Some(section.with(conditions.into_iter().fold(table(outcome, &blocks), Table::note)))
}

/// Conditions of the values.
fn notes(all: &Engagement) -> [String; 3] {
    let step = fixed(all.step, 3);
    let share = 100.0 * all.told / all.taken;
    [
        format!(
            "Greatest values at feed: arc about the axis, depth along it, width across the feed and chip each over {} mm of the way, the rate over nine times that; chip and rate at the programmed feed, and the chip with the number of teeth beside it.",
            fixed(1.5 * all.step, 3)
        ),
        format!(
            "Measured on lines {step} mm apart: contact that lies between them counts as air, and a pass narrower than {step} mm may be deeper by as much."
        ),
        format!(
            "The volumes of the moves, rapid ones too, added up to {share:.1} % of what is gone from the stock, and are adjusted to it."
        ),
    ]
}

/// Conditions of the deflection.
const DEFLECTION: &str = "Deflection at the tip of blocks that cut with a quarter of the circle at most, (part) where the tool has wider ones too, under half of the cutting force, of a bar from the holder to the tip that is 0.8 of the cutter thick along its flutes: carbide where the tool does not say its material, mills above 20 mm and face mills not; the give of holder and spindle comes on top.";

/// Conditions of power and torque.
fn load_note(outcome: &Outcome) -> Option<String> {
    let material = Material::of(outcome.job.material.as_deref()?)?;
    let force = material.force?;
    let of = if material.force_is_checked { "" } else { ", a value of handbooks that was not compared" };
    Some(format!(
        "Power and torque at the edges, without the losses of the machine: Kienzle at the mean chip, {} with kc1.1 {} N/mm\u{b2} and mc {}{of}; sharp edges, \u{b1}{:.0} %. A worn edge needs 30 to 50 % more.",
        material.name,
        force.kc11,
        force.mc,
        100.0 * FORCE_SPREAD,
    ))
}

/// The course along a segment at feed for the 3-D view, from its beginning to its end; nothing of one that is in air.
pub(super) fn runs(
    setup: &SetupOutcome,
    segment: &Segment,
    moved: &MoveEngagement,
    tools: &[Tool],
) -> Vec<EngagedRun> {
    if !matches!(segment.motion, SegmentPace::Feed(_)) {
        return Vec::new();
    }
    let chips = Chips::of(setup, segment, tools);
    let chip = |advance: f64| chips.as_ref().map(|chips| chips.thickest(advance) as f32);
    let air = |to: f64| EngagedRun { to: to as f32, arc: 0.0, chip: chip(0.0) };
    let mut runs = Vec::new();
    let mut done = 0.0;
    for stretch in &moved.stretches {
        if stretch.from > done + SAME {
            runs.push(air(stretch.from));
        }
        let arc = stretch.arc.to_degrees() as f32;
        runs.push(EngagedRun { to: stretch.to as f32, arc, chip: chip(stretch.advance) });
        done = stretch.to;
    }
    if done > 0.0 && done < 1.0 - SAME {
        runs.push(air(1.0));
    }
    joined(&runs)
}

/// Fractions of a segment that are one.
const SAME: f64 = 1e-9;

/// Neighbours that are like the first of them, as one with the greatest values of all.
fn joined(runs: &[EngagedRun]) -> Vec<EngagedRun> {
    let mut all: Vec<EngagedRun> = Vec::new();
    let mut first: Option<&EngagedRun> = None;
    for run in runs {
        match (all.last_mut(), first) {
            (Some(last), Some(first)) if are_alike(first, run) => {
                let chip = last.chip.zip(run.chip).map(|(a, b)| a.max(b));
                *last = EngagedRun { to: run.to, arc: last.arc.max(run.arc), chip };
            }
            _ => {
                all.push(*run);
                first = Some(run);
            }
        }
    }
    all
}

/// Whether two runs have nearly one colour: within three degrees and a thirtieth of the thickness of the chip.
fn are_alike(a: &EngagedRun, b: &EngagedRun) -> bool {
    let chips = match (a.chip, b.chip) {
        (Some(a), Some(b)) => (a - b).abs() <= a.max(b) / 30.0,
        (a, b) => a == b,
    };
    (a.arc - b.arc).abs() <= 3.0 && (a.arc == 0.0) == (b.arc == 0.0) && chips
}

/// Cubic centimetres a minute in a cubic millimetre a second.
const PER_MINUTE: f64 = 0.06;

/// A value over the time of the program [s], in steps; zero in air.
fn over_time(course: &[Course], end: f64, of: fn(&Course) -> f64) -> Vec<[f64; 2]> {
    let mut points: Vec<[f64; 2]> = Vec::with_capacity(2 * course.len() + 2);
    let mut last = 0.0;
    for stretch in course {
        let [from, to] = stretch.time;
        // Whether there is air in less than a stretch is not known.
        if from - last > to - from || points.is_empty() {
            points.extend([[last, 0.0], [from, 0.0]]);
        }
        points.extend([[from, of(stretch)], [to, of(stretch)]]);
        last = to;
    }
    points.extend([[last, 0.0], [end.max(last), 0.0]]);
    points
}

/// A number with some decimals; one that would be shown as zero is less than the last of them.
fn least(value: f64, decimals: usize) -> String {
    let last = 10f64.powi(-(decimals as i32));
    if value > 0.0 && value < 0.5 * last {
        return format!("under {}", fixed(last, decimals));
    }
    fixed(value, decimals)
}

/// The greatest values of each tool, at the block of its greatest arc.
fn table(outcome: &Outcome, blocks: &[(u32, &Block)]) -> Table {
    let mut numbers: Vec<ToolNumber> = Vec::new();
    for number in blocks.iter().filter_map(|(_, b)| b.tool) {
        if !numbers.contains(&number) {
            numbers.push(number);
        }
    }
    let has_load = blocks.iter().any(|(_, b)| b.power.is_some());
    let rows = numbers.into_iter().map(|number| {
        let own = || blocks.iter().filter(move |(_, b)| b.tool == Some(number));
        let most = |of: fn(&Block) -> f64| own().map(|(_, b)| of(b)).fold(0.0, f64::max);
        let known = |of: fn(&Block) -> Option<f64>| own().filter_map(|(_, b)| of(b)).reduce(f64::max);
        let sum = |of: fn(&Block) -> f64| own().map(|(_, b)| of(b)).sum::<f64>();
        let tool = outcome.job.tools.iter().find(|t| t.number == number);
        let (name, teeth) = tool.map_or(("", 0), |t| (&t.name[..], t.teeth));
        let words = |value: Option<String>| value.unwrap_or_else(|| "not known".to_owned());
        let chip = known(|b| b.chip).map(|chip| format!("{} ({teeth})", fixed(chip, 3)));
        let rate = known(|b| b.rate).map(|rate| fixed(rate * PER_MINUTE, 1));
        let air = 100.0 * sum(|b| b.air) / sum(|b| b.length).max(f64::MIN_POSITIVE);
        let mut cells = vec![
            format!("{number} {name}").trim_end().to_owned(),
            fixed(most(|b| b.arc), 0),
            fixed(most(|b| b.depth), 2),
            fixed(most(|b| b.width), 2),
            words(chip),
            words(rate),
            fixed(sum(|b| b.removed) / 1000.0, 2),
            fixed(air, 0),
        ];
        if has_load {
            cells.push(words(known(|b| b.power).map(|power| least(power, 2))));
            let spread = match tool.map(|t| &t.cutter) {
                Some(Cutter::Tap(_)) => format!(" (\u{b1}{:.0} %)", 100.0 * TAPPING_SPREAD),
                _ => String::new(),
            };
            cells.push(words(known(|b| b.torque).map(|torque| least(torque, 1) + &spread)));
            // The greatest of those blocks that have one: others cut wider.
            let most = known(|b| b.deflection.known()).map(|mm| least(1000.0 * mm, 0));
            let wider = own().any(|(_, b)| b.deflection == Deflection::Wider);
            cells.push(words(most.map(|most| if wider { format!("{most} (part)") } else { most })));
        }
        let row = Row::new(cells.into_iter().map(Cell::new).collect());
        let greatest = own().max_by(|(_, a), (_, b)| a.arc.total_cmp(&b.arc));
        match greatest {
            Some((line, _)) => row.at(*line),
            None => row,
        }
    });
    let columns = "Tool; Arc [\u{b0}]; Depth [mm]; Width [mm]; Chip [mm] (teeth); Rate [cm\u{b3}/min]; Removed [cm\u{b3}]; In air [%]";
    let columns = if has_load {
        format!("{columns}; Power [kW]; Torque [N m]; Deflection [\u{b5}m]")
    } else {
        columns.to_owned()
    };
    Table::new("Greatest engagement of each tool", &columns).rows(rows)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn neighbours_that_are_alike_are_one_with_their_greatest_values() {
        let run = |to, arc, chip| EngagedRun { to, arc, chip };
        let all = [
            run(0.1, 90.0, Some(0.1)),
            run(0.2, 92.5, Some(0.102)),
            // Like the one before, but no longer like the first.
            run(0.3, 94.0, Some(0.102)),
            run(0.4, 94.0, Some(0.11)),
            run(0.5, 0.0, Some(0.0)),
            run(0.6, 2.0, Some(0.0)),
        ];
        let kept = [run(0.2, 92.5, Some(0.102)), run(0.3, 94.0, Some(0.102)), all[3], all[4], all[5]];
        assert_eq!(joined(&all), kept);
        assert_eq!(joined(&[run(0.5, 90.0, None), run(1.0, 89.0, None)]), [run(1.0, 90.0, None)]);
    }
}
