//! Section of a report on the cutting data that operations were given.

use std::f64::consts::TAU;

use crate::job::check::Job;
use crate::job::{DataOrigin, TakenData};
use crate::page::{Cell, Row, Section, Table, fixed, trimmed};

/// The section; none where every operation has its own.
pub(super) fn section(job: &Job) -> Option<Section> {
    let all = &job.cutting;
    if all.is_empty() {
        return None;
    }
    let columns = "Operation; Tool; Cutting speed [m/min]; S [rev/min]; Feed [mm]; From";
    let rows = all.iter().filter_map(|taken| row(job, taken));
    let table = Table::new("Speeds and feeds that operations were given", columns).rows(rows);
    let any_start = all.iter().any(TakenData::has_start);
    let note = "Values to start with are usual ones of catalogues for stable clamping and, in the full width, half the diameter deep at most; no recommendation: those of the shop are given in an operation or as [[tool.preset]].";
    Some(Section::new("Cutting data").with(if any_start { table.note(note) } else { table }))
}

fn row(job: &Job, taken: &TakenData) -> Option<Row> {
    let (setup, index) = taken.operation;
    let before: usize = job.setups[..setup].iter().map(|s| s.operations.len()).sum();
    let operation = job.setups.get(setup)?.operations.get(index)?;
    let turns = operation.milling().spindle * 60.0 / TAU;
    let speed = match (&taken.limited, &taken.speed) {
        (Some(limited), _) => limited.cutting_speed.map(|v| trimmed(v, 1)),
        (None, Some(speed)) if speed.key == "cutting_speed" => Some(trimmed(speed.value, 1)),
        _ => None,
    };
    let feed = taken.feed.as_ref().map(|feed| match feed.key {
        "feed_per_tooth" => format!("{} per tooth", trimmed(feed.value, 4)),
        "feed_per_rev" => format!("{} per revolution", trimmed(feed.value, 4)),
        _ => format!("{} in a minute", trimmed(feed.value, 1)),
    });
    let cells = [
        format!("{} {}", before + index + 1, operation.name()),
        format!("T{}", taken.tool),
        speed.unwrap_or_default(),
        fixed(turns, 0),
        feed.unwrap_or_default(),
        origin(taken),
    ];
    Some(Row::new(cells.map(Cell::new).to_vec()))
}

/// The origins of both numbers, and what changed them.
fn origin(taken: &TakenData) -> String {
    let mut parts: Vec<String> = Vec::new();
    let mut add = |part: String| {
        if !parts.contains(&part) {
            parts.push(part);
        }
    };
    for number in taken.numbers() {
        match &number.origin {
            DataOrigin::Preset { material, file } => {
                let of = file.as_ref().map(|file| format!(", {file}")).unwrap_or_default();
                add(format!("preset {material} of T{}{of}", taken.tool));
            }
            DataOrigin::Table { file, line } => add(format!("{file}, line {line}")),
            DataOrigin::Start { row, .. } => add(format!("to start with: {row}")),
        }
        if let Some(way) = number.way() {
            add(way);
        }
    }
    if let Some(limited) = &taken.limited {
        let of = if limited.of_tool { "the tool" } else { "the machine" };
        add(format!("{of} allows {:.0} of {:.0} rev/min", limited.limit, limited.wanted));
    }
    parts.join("; ")
}
