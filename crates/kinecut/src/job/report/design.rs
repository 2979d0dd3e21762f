//! The cut part against the regions of the design.

use super::super::setup_outcome::block_of_cut;
use crate::job::Outcome;
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
