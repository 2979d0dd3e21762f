//! The page of the verb `kinecut surface`: formulas, redistributions with sketches, processes, and what a machine says.

use maud::{Markup, PreEscaped, html};

use super::sketches::split_sketches;
use super::split::split_figure;
use super::{EnvelopeRow, HowMade, NEARNESS, NOT_VERIFIED, OnMachine, SplitRow, SurfaceSheet};
use crate::base::Result;
use crate::machine::generation::micro;
use crate::page::picture::figure;
use crate::page::verb_page::VerbPage;
use crate::page::{Block, Cell, Fact, Row, Section, Table, visible};

/// Rules of formulas and sketches.
pub(crate) const STYLE: &str = "\
.sketches{display:grid;grid-template-columns:repeat(auto-fill,minmax(min(100%,370px),1fr));gap:14px;margin:14px 0 0}\
.formula{overflow-x:auto;padding:4px 0;font-size:16px}\
.matrices{display:flex;flex-wrap:wrap;gap:14px;margin:10px 0}\
.matrices figure{overflow-x:auto;max-width:100%}\
.matrices math,.formula math{font-size:16px}\
.matrices .matrix>mo{display:none}\
.matrices .matrix>mtable{margin:4px 1px;padding:1px 5px;border:solid currentcolor;border-width:0 1.4px;border-radius:12px/50%}\
.contact{overflow-x:auto;margin:0 0 10px;background:var(--panel);border:1px solid var(--rule);border-radius:6px;padding:8px 12px}";

/// Sentences in a table need room on a narrow screen.
const WORDS: &str = ".table td:not(.number){min-width:8.5em}";

/// The page of a surface, with the answer of a machine where one was asked: one HTML file without any reference to a
/// network.
///
/// # Errors
/// Those of [`split_sketches`].
pub fn surface_html(sheet: &SurfaceSheet, made: Option<&OnMachine>) -> Result<String> {
    let mut sections = vec![generation(sheet), splits(sheet)];
    let mut figures = vec![formulas(sheet), sketches(sheet)?];
    if has_methods(sheet) {
        sections.push(methods(sheet));
        figures.push(contacts(sheet));
    }
    sections.extend(made.into_iter().flat_map(made_sections));
    let title =
        if sheet.title.is_empty() { sheet.name.clone() } else { format!("{}: {}", sheet.name, sheet.title) };
    let style = format!("{STYLE}{WORDS}");
    Ok(VerbPage {
        maker: "kinecut surface",
        title: &title,
        style: &style,
        caution: "A model does not replace the trial cut.",
        sections: &sections,
        figures: &figures,
        ..VerbPage::default()
    }
    .html())
}

/// The same in words and numbers for a terminal: formulas and contacts as lines.
pub(super) fn sections(sheet: &SurfaceSheet, made: Option<&OnMachine>) -> Vec<Section> {
    let mut first = generation(sheet);
    first.title = format!("{}: {}", sheet.name, sheet.title).trim_end_matches([':', ' ']).to_owned();
    let mut matrices = Table::new(format!("Function of the surface: {}", sheet.product), "Matrix; Rows");
    for (element, rows) in sheet.surface.chain().iter().zip(&sheet.matrices) {
        let name = format!("A{}({})", element.motion, element.law);
        let names = std::iter::once(name).chain(std::iter::repeat(String::new()));
        matrices
            .rows
            .extend(names.zip(rows).map(|(name, row)| Row::new(vec![name.into(), row.as_str().into()])));
    }
    matrices.notes.push(format!("r0 = {}", sheet.point));
    first.blocks.push(matrices.into());
    let mut sections = vec![first, splits(sheet)];
    if has_methods(sheet) {
        let contact = |e: &EnvelopeRow| {
            let heading = format!("{} ({}): machine {}, tool {}", e.process, e.method, e.machine, e.tool);
            [Block::Heading(heading), Block::List(e.contact.lines().map(str::to_owned).collect())]
        };
        let mut section = methods(sheet);
        section.blocks.extend(sheet.envelopes.iter().flat_map(contact));
        sections.push(section);
    }
    sections.extend(made.into_iter().flat_map(made_sections));
    sections
}

fn has_methods(sheet: &SurfaceSheet) -> bool {
    !sheet.processes.is_empty() || !sheet.envelopes.is_empty()
}

/// Sections of a machine's answers.
fn made_sections(made: &OnMachine) -> [Section; 2] {
    [on_machine(made), budgets(made)]
}

fn part(code: &str) -> String {
    if code.is_empty() { "–".to_owned() } else { code.to_owned() }
}

fn generation(sheet: &SurfaceSheet) -> Section {
    let facts = vec![
        Fact::new("Primary code", sheet.code.clone()),
        Fact::new("Canonical form", sheet.canonical.clone()),
        Fact::new("Orders of the motions", sheet.orders.to_string()),
        Fact::new("Layouts with the bed", sheet.layouts.to_string()),
        Fact::new("Kind", sheet.form),
    ];
    let mut table = Table::new("Parameters and variables (mm, rad)", "Name; Value []; To []");
    for (name, value) in &sheet.parameters {
        table.rows.push(Row::new(vec![name.as_str().into(), value.to_string().into(), "".into()]));
    }
    for (name, from, to) in &sheet.variables {
        table.rows.push(Row::new(vec![name.as_str().into(), from.to_string().into(), to.to_string().into()]));
    }
    let slides = if sheet.slides.is_empty() {
        "It slides in itself by no motion.".to_owned()
    } else {
        format!("It slides in itself by: {}.", sheet.slides.join("; "))
    };
    Section::new("Generating lines")
        .with(Block::Facts(facts))
        .with(Block::Text(format!(
            "Directrix {}, generatrix {}; the chain with what they share written once: {}.",
            sheet.directrix, sheet.generatrix, sheet.chain
        )))
        .with(Block::Text(slides))
        .with(table)
}

fn formulas(sheet: &SurfaceSheet) -> Markup {
    let formula = sheet.surface.formula();
    html! {
        h3 { "Function of the surface" }
        p.formula { (visible(&formula.product_unicode())) }
        div.matrices {
            @for (element, matrix) in formula.chain().iter().zip(formula.matrices()) {
                figure {
                    figcaption { span { "A" sup { (visible(&element.motion.to_string())) } "(" (visible(&element.law.unicode())) ")" } }
                    math { (PreEscaped(matrix.mathml())) }
                }
            }
        }
        p.formula { "r₀ = " (visible(&formula.point_unicode())) }
    }
}

fn splits(sheet: &SurfaceSheet) -> Section {
    let mut table = Table::new(
        format!(
            "{} redistributions between machine and tool, {} with a rigid tool",
            sheet.splits.len(),
            sheet.splits.iter().filter(|s| s.valid).count()
        ),
        "Machine | tool; Tool is; Process; Forming, setting; Linked; Set-up",
    );
    table.rows = sheet.splits.iter().map(split).collect();
    Section::new("Redistributions").with(table)
}

fn split(s: &SplitRow) -> Row {
    let digits = |d: &[u8]| d.iter().map(u8::to_string).collect::<Vec<_>>().join(" ");
    let moves = match (digits(&s.forming), digits(&s.setting)) {
        (f, t) if t.is_empty() => f,
        (f, t) => format!("{f}; set {t}"),
    };
    let mut links: Vec<String> =
        s.links.iter().map(|l| format!("{} ({}, by {})", l.motions, l.kind, l.variable)).collect();
    if !s.built_in.is_empty() && s.built_in != "-" {
        links.push(format!("ground into the tool {}", s.built_in));
    }
    let setup = match &s.setup {
        Some(setup) if s.setup_needed => {
            format!("{} ({}), {}, margin {:.4}", setup.motion, setup.source, setup.verdict, setup.margin)
        }
        None if s.setup_needed && s.valid => "none: the tool does not come off in one piece".to_owned(),
        _ => String::new(),
    };
    let told =
        std::iter::once(&s.process).chain(&s.methods).chain(&s.remarks).filter(|text| !text.is_empty());
    let process = told.map(String::as_str).collect::<Vec<_>>().join("; ");
    let kind = s.tool_kind.map_or_else(|| Cell::wrong("not rigid"), Cell::new);
    Row::new(vec![
        format!("{} | {}", part(&s.machine_code), part(&s.tool_code)).into(),
        kind,
        process.into(),
        moves.into(),
        links.join("; ").into(),
        setup.into(),
    ])
}

fn sketches(sheet: &SurfaceSheet) -> Result<Markup> {
    let sketches = split_sketches(sheet)?;
    Ok(html! { div.sketches { @for sketch in &sketches { (figure(&split_figure(sketch))) } } })
}

fn methods(sheet: &SurfaceSheet) -> Section {
    let mut table = Table::new(
        "Known processes by the method that makes one of the lines (after Fedotenok)",
        "Method; Process; Motions",
    );
    for row in &sheet.processes {
        for (name, motions) in &row.processes {
            table.rows.push(Row::new(vec![row.method.into(), (*name).into(), (*motions).into()]));
        }
    }
    let mut section = Section::new("Methods and processes");
    if !table.rows.is_empty() {
        section.blocks.push(table.into());
    }
    section
}

fn contacts(sheet: &SurfaceSheet) -> Markup {
    html! {
        @for e in &sheet.envelopes {
            h3 { (visible(e.process)) " (" (e.method) ")" }
            p { "Machine " (visible(e.machine)) ", tool " (visible(e.tool)) "." }
            pre.contact { @for line in e.contact.lines() { (visible(line)) "\n" } }
        }
    }
}

/// Rows of what a machine answers, of both kinds.
struct Answer<'a> {
    name: String,
    process: &'a str,
    made: &'a HowMade,
    /// Why not, or why it is not verified; nearest machines.
    remarks: Vec<String>,
}

fn answers(made: &OnMachine) -> Vec<Answer<'_>> {
    let splits = made.splits.iter().map(|s| {
        let nearest = s.nearest.iter().flat_map(super::NearestRow::sentences);
        Answer {
            name: format!("{} | {}", part(&s.machine_code), part(&s.tool_code)),
            process: &s.process,
            made: &s.made,
            remarks: s.obstacle.iter().map(ToString::to_string).chain(nearest).collect(),
        }
    });
    let envelopes = made.envelopes.iter().map(|e| {
        let unverified = e.unverified.iter().map(|why| format!("not verified: {why}"));
        Answer {
            name: format!("{}: {}", e.method, e.tool),
            process: &e.process,
            made: &e.made,
            remarks: e.obstacle.iter().map(ToString::to_string).chain(unverified).collect(),
        }
    });
    splits.chain(envelopes).collect()
}

fn on_machine(made: &OnMachine) -> Section {
    let mut table = Table::new(
        format!("Surfaces that machine {} {} can make, and how well", made.code, made.machine),
        "Machine | tool; Process; Can it; Laws of the axes; Off by [um]; Covered [%]; Remarks",
    );
    for a in answers(made) {
        let off = a.made.residual.as_ref().map_or_else(Cell::default, |r| {
            let text = format!("{} .. {}, rms {}", r.least_um, r.greatest_um, r.rms_um);
            let far = r.least_um.abs().max(r.greatest_um.abs()) > made.tolerance_um;
            if far { Cell::wrong(text) } else { Cell::right(text) }
        });
        let covered = a.made.coverage.map(|c| ((c.share * 1e4).floor() / 1e2).to_string());
        let gap = a.made.coverage.and_then(|c| c.largest_gap).map(|gap| {
            let [x, y, z] = gap.point.to_array();
            format!("largest gap {:.1} mm2 at ({x:.2}, {y:.2}, {z:.2})", gap.area)
        });
        let remarks: Vec<String> = gap.into_iter().chain(a.remarks).collect();
        table.rows.push(Row::new(vec![
            a.name.into(),
            a.process.into(),
            if a.made.possible { Cell::right("yes") } else { Cell::wrong("no") },
            a.made.laws.join("; ").into(),
            off,
            covered.unwrap_or_default().into(),
            remarks.join("; ").into(),
        ]));
    }
    table.notes.push(format!("Covered: share of the wanted area within {} um.", made.tolerance_um));
    if let Some(nearest) = made.splits.iter().find_map(|s| s.nearest.as_ref()) {
        table.notes.push(format!(
            "Of {} layouts of two to five axes in {} classes that position alike: {NEARNESS}.",
            nearest.layouts, nearest.classes
        ));
    }
    Section::new(format!("On machine {}", made.code)).with(table)
}

fn budgets(made: &OnMachine) -> Section {
    let answers = answers(made);
    let axes: Vec<char> = answers
        .iter()
        .find_map(|a| a.made.budget.as_ref())
        .map_or_else(Vec::new, |b| b.axes.iter().map(|a| a.letter).collect());
    let mut section = Section::new("Errors of the axes");
    if !axes.is_empty() {
        let of = |kind: &str| axes.iter().map(|axis| format!("{axis} {kind} [um]; ")).collect::<String>();
        let columns =
            format!("Machine | tool; {}{}All independent [um]; All worst [um]", of("position"), of("guide"));
        let caption = format!("Way along its normal by which errors of {} move the surface", made.errors);
        let mut table = Table::new(caption, &columns);
        for a in &answers {
            let Some(b) = &a.made.budget else { continue };
            let shown = |mm: f64| Cell::new(format!("{:.2}", micro(mm)));
            let mut cells = vec![Cell::new(format!("{} {}", a.name, a.process))];
            cells.extend(b.axes.iter().map(|axis| shown(axis.position)));
            cells.extend(b.axes.iter().map(|axis| shown(axis.guide)));
            cells.extend([shown(b.independent), shown(b.worst)]);
            table.rows.push(Row::new(cells));
        }
        table.notes.push(
            "Position: the error along or about the axis itself. Guide: its shifts in three directions and turns about three \
             axes, as independent errors. Each figure is the greatest over the surface."
                .to_owned(),
        );
        section.blocks.push(table.into());
    }
    section.blocks.push(Block::Heading("Not in these figures".to_owned()));
    section.blocks.push(Block::List(NOT_VERIFIED.map(str::to_owned).to_vec()));
    section
}
