//! Planned milled threads as the report shows them: facts, and the helices of the first place.

use super::PlannedThreadMilling;
use crate::operations::Shown;
use crate::page::{Block, Cell, Column, Fact, Row, Section, Table, fixed, trimmed};
use crate::threading::{MillProfile, ThreadRun, ThreadSide};

/// The section of an operation.
pub(super) fn section(plan: &PlannedThreadMilling, of: &Shown<'_>) -> Section {
    let mut section = Section::new(of.title());
    section.blocks.push(Block::Facts(facts(plan, of)));
    section.with(table(plan))
}

fn mm(length: f64) -> String {
    format!("{} mm", trimmed(length, 3))
}

fn facts(plan: &PlannedThreadMilling, of: &Shown<'_>) -> Vec<Fact> {
    let (spec, thread, mill, made) = (&plan.spec, &plan.of.thread, &plan.of.mill, &plan.plan);
    let oversize =
        if spec.oversize == 0.0 { String::new() } else { format!(", oversize {}", mm(spec.oversize)) };
    let mut facts = vec![Fact::new("Thread", plan.of.thread_name()).note(format!(
        "{} full, pitch diameter {}{oversize}",
        mm(spec.depth),
        mm(thread.pitch_diameter())
    ))];
    if let Some(deviation) = plan.deviation {
        let um = fixed((deviation * 1e4).ceil() * 0.1, 1);
        let with_wear = match spec.wear {
            Some(_) => format!(", with {} in the wear register", mm(plan.wear_value())),
            None => String::new(),
        };
        facts.push(
            Fact::new("Pitch diameter in the text", format!("up to {um} \u{b5}m off"))
                .note(format!("by the helix that was read back and the envelope of the flanks{with_wear}")),
        );
    }
    if thread.taper > 0.0 {
        let angle = trimmed(thread.taper_angle().to_degrees(), 4);
        facts.push(
            Fact::new("Taper", format!("1 in {}", trimmed(1.0 / thread.taper, 3)))
                .note(format!("{angle}\u{b0}, {} on the radius in a turn", mm(thread.radius_per_turn()))),
        );
    }
    let at_bottom = if thread.taper > 0.0 { ", at the bottom" } else { "" };
    facts.push(match spec.side {
        ThreadSide::Inside => {
            Fact::new("Core hole", mm(thread.minor_diameter())).note("the minor diameter of the thread")
        }
        ThreadSide::Outside => Fact::new("Root", mm(2.0 * plan.crest_radius())).note(format!(
            "the diameter that the crests of the tool leave{at_bottom}; that of the standard is {}",
            mm(thread.root_diameter())
        )),
    });
    let [nominal, radius] = made.radii;
    facts.push(Fact::new("Path", format!("radius {}", mm(radius))).note(match spec.cutter.profile {
        MillProfile::Standard => format!(
            "{} less the overcut of the flanks, {} radially (second order {}): the pitch diameter is right, the wall of the crests is at diameter {}",
            fixed(nominal, 4),
            fixed(made.gain[0], 4),
            fixed(made.gain[1], 4),
            fixed(2.0 * plan.crest_radius(), 3)
        )
        .replace(" less ", if spec.side == ThreadSide::Inside { " less " } else { " more by " }),
        MillProfile::Corrected => {
            "not corrected: the profile of the tool is, by its maker for this thread".to_owned()
        }
    }));
    let way = if made.travel.counter_clockwise { "counter-clockwise" } else { "clockwise" };
    let climb = if made.travel.upwards { "upwards" } else { "downwards" };
    let rows =
        if mill.rows == 1 { "1 row of teeth".to_owned() } else { format!("{} rows of teeth", mill.rows) };
    facts.push(Fact::new("Direction", format!("{way}, {climb}")).note(rows));
    let per_minute = |feed: f64| format!("{} mm/min", trimmed(feed * 60.0, 1));
    facts.push(Fact::new("Feed", per_minute(spec.feed)).note(format!(
        "of the edge; {} of the centre at full depth, on a slope of {}\u{b0}",
        per_minute(made.feed),
        fixed(made.slope.to_degrees(), 1)
    )));
    facts.push(
        Fact::new("Lowest point", format!("Z {}", trimmed(made.lowest, 3)))
            .note("half a pitch of the lowest tooth, and the way in or out"),
    );
    let measured = of.walls.iter().filter(|m| m.wall[0] <= m.wall[1]);
    if let Some(worst) = measured.map(|m| m.worst()).max_by(f64::total_cmp) {
        facts.push(
            Fact::new(
                "Wall of the crests",
                format!("up to {} \u{b5}m off", fixed((worst * 1e4).ceil() * 0.1, 1)),
            )
            .note("in the simulated part, where the tool is the cylinder of its crests"),
        );
    }
    facts
}

fn table(plan: &PlannedThreadMilling) -> Table {
    let mut table = Table {
        caption: "Helices of the first thread".to_owned(),
        columns: vec![
            Column::number("Depth", "%"),
            Column::number("Radius", "mm"),
            Column::number("From Z", "mm"),
            Column::number("To Z", "mm"),
            Column::number("Turns", ""),
            Column::number("Feed", "mm/min"),
        ],
        notes: vec![
            "Feed of the tool's centre. Z of the middle of the lowest tooth, half a pitch above the tip of the tool.".to_owned(),
            "The form of the flanks is not simulated: the helix is compared in the posted text.".to_owned(),
        ],
        ..Table::default()
    };
    let row = |run: &ThreadRun| {
        let [from, to] = run.radii;
        let radius =
            if from == to { fixed(from, 4) } else { format!("{} to {}", fixed(from, 4), fixed(to, 4)) };
        Row::new(vec![
            Cell::new(trimmed(run.share * 100.0, 1)),
            Cell::new(radius),
            Cell::new(fixed(run.heights[0], 3)),
            Cell::new(fixed(run.heights[1], 3)),
            Cell::new(trimmed(run.turns, 3)),
            Cell::new(trimmed(run.feed * 60.0, 1)),
        ])
    };
    table.rows.extend(plan.plan.runs.iter().filter(|run| run.place == 0).map(row));
    if plan.spec.places.len() > 1 {
        table.notes.push("The others are alike; all are in plan.json.".to_owned());
    }
    table
}
