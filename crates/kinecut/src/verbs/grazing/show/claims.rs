//! The gallery: the paper's statements on the grazing curve, marked by what was computed, with pictures.

use super::page::{CAUTION, grazing_svg, sentence};
use super::{plane, tool};
use crate::page::verb_page::VerbPage;
use crate::page::{Block, Cell, Chart, Column, Row, Section, Table, fixed};
use crate::verbs::grazing::{GalleryGroup, PaperVerdict};

/// Sentences in a table begin on one line, and keep room on a narrow screen, where the table is shifted; a verdict is not broken.
const SENTENCES: &str = "\
.table tbody :is(th,td):not(.number){vertical-align:top;min-width:7em}\
.table td:not(.number):nth-child(2){min-width:14em}\
.table td:not(.number):nth-child(4){min-width:20em}\
.table :is(.wrong,.right){white-space:nowrap}";

/// The gallery in words and numbers; on a page with its pictures.
pub(crate) fn gallery_sections(groups: &[GalleryGroup], on_page: bool) -> Vec<Section> {
    let intro = "Statements of the paper on the grazing curve of a tool of arbitrary shape (NCManager), each beside what the closed \
                 form gives. Every number here was computed for this page; none is copied from the paper, whose figures are not at hand.";
    let mut sections =
        vec![Section::new("The statements").with(Block::Text(intro.to_owned())).with(statements(groups))];
    for (g, group) in groups.iter().enumerate() {
        let mut section = Section::new(group.title);
        for claim in &group.claims {
            let words = format!(
                "The paper: {} \u{2014} {}: {}",
                claim.says,
                claim.verdict.word(),
                sentence(&claim.found)
            );
            section.blocks.push(Block::Text(words));
        }
        for (i, case) in group.cases.iter().enumerate() {
            section.blocks.push(Block::Heading(format!("{}: {}", case.name, case.found)));
            if !on_page {
                continue;
            }
            let id = format!("case-{}-{}", g + 1, i + 1);
            section.blocks.push(tool::figure(&case.sheet, &format!("{id}-tool"), &case.name).into());
            section.blocks.push(plane::figure(&case.sheet, &format!("{id}-plane"), &case.name).into());
        }
        if !group.cones.is_empty() {
            section.blocks.push(cones_table(group).into());
            section.blocks.extend(on_page.then(|| Block::from(cones_chart(group))));
        }
        sections.push(section);
    }
    sections
}

/// The gallery as one HTML file.
pub fn gallery_html(groups: &[GalleryGroup]) -> String {
    VerbPage {
        maker: "kinecut grazing --gallery",
        title: "The grazing curve: the paper's cases",
        style: SENTENCES,
        caution: CAUTION,
        sections: &gallery_sections(groups, true),
        ..VerbPage::default()
    }
    .html()
}

/// Each case as an SVG file: name and content, in the order of the gallery. The name is that of the case in small letters,
/// digits and hyphens; one that another case has already is numbered.
pub fn gallery_svgs(groups: &[GalleryGroup]) -> Vec<(String, String)> {
    let mut files: Vec<(String, String)> = Vec::new();
    for case in groups.iter().flat_map(|g| &g.cases) {
        let stem = file_stem(&case.name);
        let named = |n: usize| if n < 2 { format!("{stem}.svg") } else { format!("{stem}-{n}.svg") };
        // As many files as there are, and one more name: one of them is free.
        let free = (1..=files.len() + 1).map(named).find(|name| files.iter().all(|f| f.0 != *name));
        files.extend(free.map(|name| (name, grazing_svg(&case.sheet))));
    }
    files
}

/// A name of a file of a title.
fn file_stem(title: &str) -> String {
    let plain: String =
        title.chars().map(|c| if c.is_ascii_alphanumeric() { c.to_ascii_lowercase() } else { ' ' }).collect();
    let words: Vec<&str> = plain.split_whitespace().collect();
    if words.is_empty() { "case".to_owned() } else { words.join("-") }
}

fn cell(verdict: PaperVerdict) -> Cell {
    match verdict {
        PaperVerdict::Holds => Cell::right(verdict.word()),
        PaperVerdict::Corrected => Cell::wrong(verdict.word()),
        PaperVerdict::Unneeded => Cell::new(verdict.word()),
    }
}

fn statements(groups: &[GalleryGroup]) -> Table {
    let mut table =
        Table::new("The paper's statements, and what is so", "about; the paper says; verdict; computed");
    for group in groups {
        for claim in &group.claims {
            table.rows.push(Row::new(vec![
                group.title.into(),
                claim.says.into(),
                cell(claim.verdict),
                claim.found.clone().into(),
            ]));
        }
    }
    table
}

fn cones_table(group: &GalleryGroup) -> Table {
    let mut table =
        Table::new("Largest distance of the chain's grazing curve from the exact one", "cones []");
    table.columns.extend(group.cases.iter().map(|c| Column::number(c.name.clone(), "mm")));
    let rows = group.cones.first().map_or(0, Vec::len);
    for i in 0..rows {
        let mut cells: Vec<Cell> = vec![group.cones[0][i].cones.to_string().into()];
        cells.extend(group.cones.iter().filter_map(|c| c.get(i)).map(|c| Cell::from(fixed(c.distance, 5))));
        table.rows.push(Row::new(cells));
    }
    table
}

fn cones_chart(group: &GalleryGroup) -> Chart {
    let x = ("number of cones, as a power of 2", "");
    let mut chart = Chart::new("Error of the chain of cones", x, ("log10 of the distance in mm", ""));
    for (case, errors) in group.cases.iter().zip(&group.cones) {
        let points = errors.iter().map(|e| [(e.cones as f64).log2(), e.distance.log10()]).collect();
        chart = chart.series(case.name.clone(), points);
    }
    chart
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_of_files_are_plain_letters() {
        assert_eq!(file_stem("Torus R = 4, r = 2.5: \u{3b1} < 90\u{b0}"), "torus-r-4-r-2-5-90");
        assert_eq!(file_stem("../\u{3b1}"), "case");
    }
}
