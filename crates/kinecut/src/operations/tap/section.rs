//! SetupPlan threads as the report shows them: facts, a section to scale, the holes.

use super::core::short;
use super::{PlannedTapping, PlannedThread};
use crate::operations::Shown;
use crate::page::{
    Along, Cell, Column, Drawing, Fact, Look, Row, Section, Table, area_share, duration, fixed,
};

/// Most holes that the table lists.
const LISTED: usize = 100;

/// The section of an operation.
pub(super) fn section(plan: &PlannedTapping, of: &Shown<'_>) -> Section {
    let mut section = Section::new(of.title());
    section.blocks.push(crate::page::Block::Facts(facts(plan)));
    if let Some(first) = plan.threads.first() {
        section.blocks.push(drawing(plan, first).into());
    }
    section.with(table(plan))
}

fn facts(plan: &PlannedTapping) -> Vec<Fact> {
    let (of, tap) = (&plan.of, &plan.of.tap);
    let rpm = of.milling.spindle * 60.0 / std::f64::consts::TAU;
    let [least, most] = tap.core_bounds();
    let kind = if tap.forming { "formed" } else { "cut" };
    vec![
        Fact::new("Thread", of.thread()).note(kind),
        Fact::new("Full thread", format!("{} mm", short(of.depth))),
        Fact::new("Lead", format!("{} mm", short(tap.lead * tap.pitch)))
            .note(format!("{} pitches", short(tap.lead))),
        Fact::new("Core hole", format!("{} to {} mm", fixed(least, 3), fixed(most, 3)))
            .note(format!("usual {} mm", short(tap.core_diameter()))),
        Fact::new("Feed", format!("{} mm/min", short(plan.feed() * 60.0))).note(format!(
            "{} mm at {} rev/min",
            short(tap.pitch),
            short(rpm)
        )),
        Fact::new("Time of a thread", duration(plan.time())).note("in and out, without the reversal"),
    ]
}

/// The section through the first thread.
fn drawing(plan: &PlannedTapping, thread: &PlannedThread) -> Drawing {
    let (of, tap, core) = (&plan.of, &plan.of.tap, &thread.core);
    let (top, low) = (of.table.top, of.bottom());
    let (thread_end, r, inner) = (top - of.depth, 0.5 * tap.diameter, 0.5 * core.diameter);
    let floor = if core.through { low - tap.pitch } else { core.bottom };
    let (far, below) = (2.2 * r, floor - 0.6 * r);
    let mut d = Drawing::new("Section of the first thread", [[-far, below], [far, of.reference() + 0.4 * r]]);
    for side in [-1.0, 1.0] {
        let end = if core.through { below } else { floor };
        let mut wall = vec![[side * far, top], [side * inner, top], [side * inner, end]];
        if !core.through {
            wall.push([0.0, end]);
        }
        d.line(Look::Edge, wall.clone());
        if !core.through {
            wall.push([0.0, below]);
        }
        wall.push([side * far, below]);
        d.hatched.push(wall);
        d.line(Look::Thin, vec![[side * r, top], [side * r, thread_end]]);
        d.line(Look::Hidden, vec![[side * r, thread_end], [side * inner, low]]);
    }
    d.line(
        Look::Edge,
        vec![[-r, thread_end], [-inner, thread_end], [f64::NAN; 2], [inner, thread_end], [r, thread_end]],
    );
    d.line(Look::Axis, vec![[0.0, of.reference()], [0.0, below]]);
    d.line(Look::First, vec![[-inner, low], [inner, low]]);
    d.span(Along::Above, [-r, top], [r, top], tap.name());
    d.span(Along::Below, [-inner, floor], [inner, floor], format!("core {}", short(core.diameter)));
    d.span(Along::Left, [-r, top], [-r, thread_end], format!("thread {}", short(of.depth)));
    d.span(Along::Left, [-r, thread_end], [-inner, low], format!("lead {}", short(tap.below_thread())));
    if !core.through {
        d.span(Along::Left, [-inner, top], [-inner, floor], format!("core {}", short(top - floor)));
    }
    d.level(
        [0.0, of.reference()],
        vec![format!("Z {}", short(of.reference())), "spindle and feed together".to_owned()],
    );
    d.level([0.0, low], vec![format!("Z {}", short(low)), "lowest point of the tap".to_owned()]);
    d
}

fn table(plan: &PlannedTapping) -> Table {
    let tap = &plan.of.tap;
    let mut table = Table {
        caption: "Threads in the order of tapping".to_owned(),
        columns: vec![
            Column::text("Place"),
            Column::number("Core", "mm"),
            Column::number("Full diameter to Z", "mm"),
            Column::number("Height of thread", ""),
        ],
        notes: vec![
            "The height of the thread is a share of that of the ISO profile (1.0825 P over both sides)."
                .to_owned(),
            "The thread itself is not simulated: its core hole is measured.".to_owned(),
        ],
        ..Table::default()
    };
    for thread in plan.threads.iter().take(LISTED) {
        let [x, y] = thread.at.map(short);
        let bottom = if thread.core.through { "through".to_owned() } else { fixed(thread.core.bottom, 3) };
        table.rows.push(Row::new(vec![
            Cell::new(format!("X{x} Y{y}")),
            Cell::new(short(thread.core.diameter)),
            Cell::new(bottom),
            Cell::new(area_share(tap.thread_share(thread.core.diameter))),
        ]));
    }
    let more = plan.threads.len().saturating_sub(LISTED);
    if more > 0 {
        table.notes.push(format!("{more} further threads are in plan.json."));
    }
    table
}
