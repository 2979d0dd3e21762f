//! Speed of the study of layouts: `cargo bench --bench layouts`.

use kinecut::machine::layouts::{Conditions, LayoutKind, Query, Search, layouts};

fn main() {
    divan::main();
}

fn motions(letters: &str) -> Search {
    Search::Motions(
        letters.chars().filter_map(|c| kinecut::machine::Elementary::from_iso(&c.to_string())).collect(),
    )
}

/// All 2 160 layouts of five axes, filtered and scored.
#[divan::bench]
fn all_2_160_layouts_of_five_axes() -> usize {
    let conditions =
        Conditions { full_mobility: true, regular: true, most_work_links: Some(3), ..Conditions::default() };
    ["XYZAB", "XYZAC", "XYZBC"]
        .iter()
        .filter_map(|letters| {
            let query = Query { conditions: conditions.clone(), listed: 0, ..Query::new(motions(letters)) };
            layouts(&query).ok()
        })
        .map(|found| found.enumerated)
        .sum()
}

/// The regular ones for a part, with strokes, tilt and the cover of those listed.
#[divan::bench]
fn regular_layouts_for_a_part() -> usize {
    let mut query = Query::new(Search::Regular);
    query.sizes.part = Some([300.0, 200.0, 150.0]);
    query.conditions.tilt = Some(1.5);
    query.conditions.kinds = Some(vec![LayoutKind::TableTable, LayoutKind::HeadTable]);
    layouts(&query).map_or(0, |found| found.layouts.len())
}
