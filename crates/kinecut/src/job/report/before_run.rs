//! Section on what a person has to make sure of before the program runs.

use crate::job::ToEnsure;
use crate::page::{Cell, Row, Section, Table};

/// The section; none where there is nothing.
pub(super) fn section(list: &[ToEnsure]) -> Option<Section> {
    if list.is_empty() {
        return None;
    }
    let row = |one: &ToEnsure| {
        let room = one.room.clone().unwrap_or_default();
        Row::new([one.what.clone(), one.value.clone(), room].map(Cell::new).to_vec())
    };
    let rooms = list.iter().any(|one| one.room.is_some());
    let table = Table::new("", "Item; As the run took it; May be off by").rows(list.iter().map(row));
    let note = "Up to the first contact of bodies that are given; the stock is not counted.";
    Some(Section::new("Before the run").with(if rooms { table.note(note) } else { table }))
}
