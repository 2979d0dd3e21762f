//! The cut part against the regions of the design.

use super::super::setup_outcome::block_of_cut;
use crate::job::{Outcome, RestReach};
use crate::operations::measured::Worst;
use crate::page::{Cell, Row, Section, Table, fixed};

/// The section of a report; none where the design has no regions.
pub(super) fn section(outcome: &Outcome, first_lines: &[u32]) -> Option<Section> {
    outcome.job.design.as_ref().filter(|design| !design.regions.is_empty())?;
    let line = |worst: &Worst| {
        let (setup, item) = block_of_cut(&outcome.setups, &outcome.simulation, worst.cut)?;
        let line = outcome.setups[setup].lines.get(item as usize).copied().flatten()?;
        Some(line + first_lines[setup])
    };
    let rows = outcome.deviation.regions.iter().map(|m| {
        let name = if m.name.is_empty() { "elsewhere" } else { &m.name };
        let (answer, worst) = match (m.gouge.depth > m.gouge_limit, m.left.depth > m.rest_limit) {
            _ if m.ends == 0 => (Cell::new("not measured"), None),
            (true, false) => (Cell::wrong("cut into"), Some(&m.gouge)),
            (false, true) => (Cell::wrong("stock is left"), Some(&m.left)),
            (true, true) => (Cell::wrong("cut into, and stock is left"), Some(&m.gouge)),
            (false, false) => (Cell::right("within"), None),
        };
        let number = |value: f64, digits: usize| Cell::new(fixed(value, digits));
        let row = Row::new(vec![
            Cell::new(name),
            Cell::new(m.ends.to_string()),
            number(m.gouge.depth, 4),
            number(m.gouge_limit, 4),
            number(m.left.depth, 4),
            number(m.rest_limit, 4),
            answer,
        ]);
        worst.and_then(line).map_or(row.clone(), |line| row.at(line))
    });
    let columns =
        "Region; Line ends []; Cut into it [mm]; Allowed [mm]; Left on it [mm]; Allowed [mm]; Answer";
    let table = Table::new("The part against the regions of the design", columns)
        .rows(rows)
        .note("Each end of a line of the stock counts in the region of the face that is nearest to it.");
    Some(Section::new("Design by region").with(table))
}

/// The section on tools that come to the places where too much stock is left.
pub(super) fn rest(outcome: &Outcome) -> Option<Section> {
    let reach = outcome.deviation.reach.as_ref()?;
    let part = |count: usize| Cell::new(reach.part(count));
    let name = |number| outcome.job.tools.iter().find(|t| t.number == number).map_or("", |t| t.name.as_str());
    let tools = reach.tools.iter().map(|own| {
        let cells = [format!("{} {}", own.tool, name(own.tool)).trim_end().to_owned()].map(Cell::new);
        Row::new(cells.into_iter().chain([part(own.free), part(own.too_short)]).collect())
    });
    let tools = Table::new("Milling tools of the job, at places with too much stock", "Tool; Comes there []; Too short []")
        .rows(tools)
        .note(of_places(reach))
        .note(
            "Too short: shank or holder would meet the part. Clamps, the machine and the way to the place are not looked at.",
        );
    // Those that do better than all larger ones.
    let steps = reach.sizes.iter().enumerate().filter(|(i, size)| {
        let before = i.checked_sub(1).map_or([0; 2], |j| [reach.sizes[j].end_mill, reach.sizes[j].ball_nose]);
        size.end_mill > before[0] || size.ball_nose > before[1]
    });
    let steps = steps.map(|(_, size)| {
        Row::new(vec![Cell::new(size.diameter.to_string()), part(size.end_mill), part(size.ball_nose)])
    });
    let rows: Vec<Row> = steps.collect();
    let section = Section::new("Stock left on the design").with(tools);
    let [first, .., last] = &reach.sizes[..] else { return Some(section) };
    let sizes =
        Table::new("Cutters of any length, at the same places", "Diameter [mm]; End mill []; Ball nose []");
    let sizes = match rows.is_empty() {
        true => sizes.note(format!("No end mill or ball nose of {} mm or more comes there.", last.diameter)),
        false => sizes.rows(rows).note(format!(
            "From {} mm down to {} mm, where a diameter comes to more places than all larger ones.",
            first.diameter, last.diameter
        )),
    };
    Some(section.with(sizes))
}

/// The places that were looked at, and the directions.
fn of_places(reach: &RestReach) -> String {
    let places = match reach.places == reach.ends {
        true => format!("{} line ends with more stock than allowed", reach.ends),
        false => format!("{} of {} line ends with more stock than allowed", reach.places, reach.ends),
    };
    let directions = match (reach.directions.len(), reach.other_directions) {
        (1, 0) => "the direction in which the programs cut".to_owned(),
        (n, 0) => format!("the {n} directions in which the programs cut"),
        (n, more) => format!("{n} of {} directions in which the programs cut", n + more),
    };
    format!("{places}, from {directions}; a tool is brought as near as the limit allows.")
}
