//! The worked example of Sorokin, But, Kombarov 2013, section 6: their tables 2 and 3 computed anew, beside what was
//! printed.
//!
//! Only the printed figures stand here as text; every other number is computed by the planner's own functions.

use crate::base::Result;
use crate::geom::InvoluteRecord;
use crate::holes::clearing::turns;
use crate::holes::lead_in::lead_in;
use crate::holes::path_radius;
use crate::holes::spiral::from_centre;
use crate::page::{Block, Cell, Row, Section, Table, fixed};

/// The inputs of the paper's example: bore, cutter, largest step, allowance [mm], turns and start of the lead-in.
pub(super) const PAPER: PaperCase =
    PaperCase { bore: 200.0, cutter: 40.0, step: 4.0, allowance: 1.0, turns: 2, start: [-40.0, 40.0] };

/// Inputs of the paper's method.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct PaperCase {
    /// Diameter of the bore [mm].
    pub(super) bore: f64,
    /// Diameter of the cutter [mm].
    pub(super) cutter: f64,
    /// Largest distance of turns [mm].
    pub(super) step: f64,
    /// Allowance [mm].
    pub(super) allowance: f64,
    /// Turns of the lead-in.
    pub(super) turns: u32,
    /// Start of the lead-in from the bore's centre [mm].
    pub(super) start: [f64; 2],
}

/// The four records of the paper's method: roughing spiral, its circle, lead-in, its circle.
pub(super) fn records(case: &PaperCase) -> Result<[InvoluteRecord; 4]> {
    let rough = path_radius(case.bore, case.cutter, case.allowance)?;
    let finish = path_radius(case.bore, case.cutter, 0.0)?;
    let lead = lead_in(finish, case.turns, case.start, 0.0)?;
    Ok([
        from_centre(rough, turns(rough, case.step)?, 0.0)?,
        InvoluteRecord::circle(rough, 0.0)?,
        lead.record,
        InvoluteRecord::circle(finish, lead.psi)?,
    ])
}

/// Tables 2 and 3 as printed: six columns, one lost in every row; `None` where nothing was printed.
const PRINTED: [[Option<&str>; 6]; 4] = [
    [Some("4963.71639"), Some("0"), Some("0"), Some("0"), None, Some("79")],
    [Some("496.371639"), Some("0"), Some("-79"), Some("0"), None, Some("79")],
    [Some("242.24973"), Some("-40"), Some("40"), Some("9.04482"), Some("57.5811"), None],
    [Some("502.65483"), Some("0"), Some("-79"), Some("0.94657"), None, Some("80")],
];

/// The section.
///
/// # Errors
/// None for the paper's own inputs; those of the planner otherwise.
pub(super) fn section() -> Result<Section> {
    let records = records(&PAPER)?;
    let mut section = Section::new("The paper\u{2019}s example, corrected");
    section.blocks.push(Block::Text(format!(
        "Sorokin, But, Kombarov 2013: bore {} mm, cutter {} mm, step {} mm, allowance {} mm; finishing from ({}, {}) in {} \
         turns. Each path is two records of six numbers: arc length, start point, tangent angle at the start, radii of \
         curvature at start and end. Struck out: what was printed and is wrong or was left out.",
        PAPER.bore, PAPER.cutter, PAPER.step, PAPER.allowance, PAPER.start[0], PAPER.start[1], PAPER.turns
    )));
    section
        .blocks
        .push(table("Table 2: roughing", &records[..2], &PRINTED[..2], &["spiral", "circle"]).into());
    let mut finishing = table("Table 3: finishing", &records[2..], &PRINTED[2..], &["lead-in", "circle"]);
    finishing.notes = vec![
        "One column was lost in every row: six fields, five printed. The last digit of 502.65483 is rounded the wrong way."
            .to_owned(),
        "The start (0, -79) of the finishing circle was copied from table 2; it does not even lie on the circle of 80 mm."
            .to_owned(),
        format!(
            "9.04482 is the roll angle (and rounds to {}), while 0.94657 in the next row is a tangent angle. Taken as a \
             tangent angle it turns the lead-in about its start: it would end at radius {} instead of 80, a gouge of {} mm.",
            fixed(records[2].start_radius() / records[2].base_radius(), 5),
            fixed(misread_radius(&records[2]), 2),
            fixed(misread_radius(&records[2]) - records[2].end_radius(), 1)
        ),
        "The paper promises a lead-out and gives none; the program has one.".to_owned(),
    ];
    section.blocks.push(finishing.into());
    Ok(section)
}

/// Distance from the centre at which the lead-in ends when its roll angle is taken for its tangent angle [mm].
fn misread_radius(lead: &InvoluteRecord) -> f64 {
    let roll = lead.start_radius() / lead.base_radius();
    let misread = InvoluteRecord::new(
        lead.length(),
        lead.start().to_array(),
        roll,
        lead.start_radius(),
        lead.end_radius(),
    );
    misread.map_or(f64::NAN, |r| r.end().length())
}

fn table(caption: &str, records: &[InvoluteRecord], printed: &[[Option<&str>; 6]], names: &[&str]) -> Table {
    let rows = records.iter().zip(printed).zip(names).map(|((record, printed), name)| {
        let values = six(record);
        let cells = values.iter().zip(printed).map(|(v, p)| cell(*v, *p));
        Row::new(std::iter::once(Cell::new(*name)).chain(cells).collect())
    });
    let columns =
        "Path; L [mm]; x\u{2080} [mm]; y\u{2080} [mm]; \u{3b8}\u{2080} [rad]; R\u{2099} [mm]; R\u{2096} [mm]";
    Table::new(caption, columns).rows(rows)
}

/// The six numbers of a record.
pub(super) fn six(record: &InvoluteRecord) -> [f64; 6] {
    let start = record.start();
    let angle = record.start_angle();
    [record.length(), start.x, start.y, angle, record.start_radius(), record.end_radius()]
}

/// A computed value beside the printed one: right when they agree to the last printed digit.
fn cell(value: f64, printed: Option<&str>) -> Cell {
    let text = fixed(if value == 0.0 { 0.0 } else { value }, 6);
    let Some(printed) = printed else { return Cell::corrected(text, "") };
    let decimals = printed.split_once('.').map_or(0, |(_, d)| d.len()) as i32;
    let agrees = printed.parse::<f64>().is_ok_and(|p| (p - value).abs() <= 0.51 * 10f64.powi(-decimals));
    if agrees { Cell::right(text) } else { Cell::corrected(text, printed) }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::page::Mark;

    #[test]
    fn the_printed_tables_are_corrected_where_they_are_wrong_and_nowhere_else() {
        let [_, circle, lead, finish] = records(&PAPER).unwrap();
        assert!((six(&circle)[2] + 79.0).abs() < 1e-9);
        assert!((six(&lead)[3] - 9.99138208933461).abs() < 1e-10);
        assert!((six(&finish)[1] - 64.9131188336368).abs() < 1e-9);
        assert!((misread_radius(&lead) - 107.67).abs() < 0.01);
        let section = section().unwrap();
        let wrong = |block: &Block, row: usize| -> Vec<usize> {
            let Block::Table(table) = block else { panic!("a table") };
            let cells = &table.rows[row].cells;
            (0..cells.len()).filter(|&i| cells[i].printed.is_some()).collect()
        };
        assert_eq!(wrong(&section.blocks[1], 0), [5], "one field lost");
        assert_eq!(wrong(&section.blocks[1], 1), [5]);
        assert_eq!(wrong(&section.blocks[2], 0), [4, 6], "roll for tangent angle, one field lost");
        assert_eq!(
            wrong(&section.blocks[2], 1),
            [1, 2, 3, 5],
            "last digit, start copied from table 2, one field lost"
        );
        let Block::Table(table) = &section.blocks[1] else { panic!("a table") };
        assert_eq!(table.rows[0].cells[1].mark, Mark::Right);
    }
}
