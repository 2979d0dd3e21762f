//! The page of the verb `kinecut layouts`: what was asked and left out, the scores, and the layouts drawn to scale.

use maud::{Markup, html};

use super::LayoutSheet;
use super::show::layout_figure;
use crate::machine::layouts::{Layout, Sizes};
use crate::page::picture::figure;
use crate::page::verb_page::VerbPage;
use crate::page::{Block, Cell, Fact, Row, Section, Table};
use crate::verbs::surface::page::STYLE;

/// The page of the layouts that are listed: one HTML file without any reference to a network.
pub fn layouts_html(sheet: &LayoutSheet) -> String {
    let mut sections = sections(sheet);
    if !sheet.findings.is_empty() {
        let found = sheet.findings.iter().map(|f| format!("{}: {f}", f.code));
        sections[0].blocks.push(Block::List(found.collect()));
    }
    let mut figures = vec![html! {}; sections.len()];
    sections.push(Section::new("Drawings"));
    figures.push(drawings(sheet));
    VerbPage {
        maker: "kinecut layouts",
        title: &format!("Layouts of {}", sheet.of),
        style: STYLE,
        caution: "Scores compare layouts; they do not replace a design.",
        sections: &sections,
        figures: &figures,
        ..VerbPage::default()
    }
    .html()
}

/// Question, layouts left out, scores, workspaces.
pub(super) fn sections(sheet: &LayoutSheet) -> Vec<Section> {
    let mut sections = vec![asked(sheet)];
    if !sheet.layouts.is_empty() {
        sections.push(scores(sheet));
        sections.extend(workspaces(sheet));
    }
    sections
}

fn asked(sheet: &LayoutSheet) -> Section {
    let facts = vec![
        Fact::new("Layouts", sheet.enumerated.to_string()).note("orders of the axes by places of the bed"),
        Fact::new("Left", sheet.left.to_string()).note("after all conditions"),
        Fact::new("Classes", sheet.classes.to_string()).note("that position alike"),
        Fact::new("Listed", sheet.layouts.len().to_string()),
    ];
    let mut section = Section::new(format!("Layouts of {}", sheet.of)).with(Block::Facts(facts));
    if !sheet.left_out.is_empty() {
        let mut table =
            Table::new("Layouts that each condition leaves out by itself", "Condition; Leaves out [layouts]");
        for (condition, count) in &sheet.left_out {
            table.rows.push(Row::new(vec![(*condition).into(), count.to_string().into()]));
        }
        section.blocks.push(table.into());
    }
    section
}

fn scores(sheet: &LayoutSheet) -> Section {
    let mut table = Table::new(
        "Scores, the best first",
        "Code; ISO 10791; Kind; Spindle; Rank []; Regular; Carry work [axes]; Moved [mass]; \
             Lifted [mass]; Overhang [mm]; Error [mm]; Cover [%]; Tilt [deg]; Cost []",
    );
    table.rows = sheet.layouts.iter().map(row).collect();
    if sheet.left > sheet.layouts.len() {
        table.notes.push(format!("And {} more.", sheet.left - sheet.layouts.len()));
    }
    table.notes.push(
        "A star: no other layout is as good in all that counts and better in something. Cost: the scores, each from 0 for the \
         best of the list to 1 for the worst, by their weights. Masses in those of one link. Error: shift of the tip by the \
         errors of all links. Cover: share of the directions that the tool's axis reaches; tilt: up to which it reaches all."
            .to_owned(),
    );
    Section::new("Scores").with(table)
}

fn row(l: &Layout) -> Row {
    let star = if l.pareto { " ★" } else { "" };
    Row::new(vec![
        Cell::new(format!("{}{star}", l.code)),
        l.code.iso().into(),
        l.kind.name().into(),
        l.attitude.name().into(),
        l.rank.to_string().into(),
        if l.regular { "yes" } else { "no" }.into(),
        l.scores.work_links.to_string().into(),
        format!("{:.1}", l.scores.moved_mass).into(),
        format!("{:.1}", l.scores.lifted_mass).into(),
        format!("{:.0}", l.scores.overhang).into(),
        format!("{:.4}", l.scores.error_gain).into(),
        shown(l.reach.map(|r| r.cover * 100.0), 1).into(),
        shown(l.reach.map(|r| r.tilt.to_degrees()), 1).into(),
        format!("{:.3}", l.cost).into(),
    ])
}

/// Measures of the workspaces, where strokes or a part are given.
fn workspaces(sheet: &LayoutSheet) -> Option<Section> {
    let mut table = Table::new(
        "Workspaces, in the order of the scores",
        "Code; ISO 10791; Workspace [litres]; Shared [%]; Space [%]; Cube [mm]; \
             Orientation [%]; Angle [%]; Cover [%]; Tilt [deg]",
    );
    let row = |l: &Layout| {
        let w = l.workspace.as_ref()?;
        Some(Row::new(vec![
            l.code.to_string().into(),
            l.code.iso().into(),
            format!("{:.1}", w.litres()).into(),
            format!("{:.1}", 100.0 * w.utilisation).into(),
            format!("{:.1}", 100.0 * w.space_efficiency).into(),
            shown(w.largest_cube, 1).into(),
            shown(w.orientation_space.map(|s| s * 100.0), 1).into(),
            shown(w.orientation_angle.map(|s| s * 100.0), 1).into(),
            shown(l.reach.map(|r| r.cover * 100.0), 1).into(),
            shown(l.reach.map(|r| r.tilt.to_degrees()), 1).into(),
        ]))
    };
    table.rows = sheet.layouts.iter().filter_map(row).collect();
    if table.rows.is_empty() {
        return None;
    }
    table.notes.push(
        "Shared: space that work and tool both pass, of all they pass. Space: workspace in the box about all that moves. Cube: \
         the largest worked in all directions; orientation: its share of the workspace. Angle: ranges of the rotary axes, of \
         what could be of use. Cover: share of all directions. Tilt: up to which all directions are reached."
            .to_owned(),
    );
    Some(Section::new("Workspaces").with(table))
}

/// A number that not every layout has.
fn shown(value: Option<f64>, digits: usize) -> String {
    value.map_or(String::new(), |v| format!("{v:.digits$}"))
}

fn drawings(sheet: &LayoutSheet) -> Markup {
    html! {
        p { "To scale; blue carries the work (primed letters), orange the tool, grey stands on the ground." }
        div.pictures {
            @for layout in &sheet.layouts {
                @let sizes = Sizes { stroke: layout.stroke, ..sheet.sizes.clone() };
                (figure(&layout_figure(&layout.code, layout.attitude, &sizes)))
            }
        }
    }
}
