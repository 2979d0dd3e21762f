//! The section of a drilled hole or of a pattern of them, and the page of the verb.

use super::tables::{
    facts, first_contact, lengths_table, on_the_way, seconds, surface_words, times_table, trimmed, zones,
};
use super::{DrilledHole, RefusedHole, engagement, point_drawing, section_drawings};
use crate::base::Severity;
use crate::drilling::{Side, ZoneStage};
use crate::page::verb_page::VerbPage;
use crate::page::{Block, Cell, Row, Section, Table, fixed};

/// Holes of a page that are all drawn; of more only the first and the worst are.
const FEW: usize = 4;

/// Words of a table need room on a narrow screen.
const STYLE: &str = ".table td:not(.number){min-width:8.5em}";

/// The section of one hole, with its drawings and findings.
pub fn drill_section(hole: &DrilledHole) -> Section {
    section(hole, true)
}

/// The section of one hole in words and numbers.
pub fn drill_words(hole: &DrilledHole) -> Section {
    section(hole, false)
}

fn section(hole: &DrilledHole, drawn: bool) -> Section {
    let (spec, plan) = (hole.spec, hole.plan);
    let mut section = Section::new(hole.title);
    let way = match spec.end.exit() {
        Some(exit) => format!(
            "In through {}, out through {}; L {} mm.",
            surface_words(&spec.entry, Side::Entry),
            surface_words(exit, Side::Exit),
            trimmed(spec.length)
        ),
        None => {
            format!("In through {}; the hole does not go through.", surface_words(&spec.entry, Side::Entry))
        }
    };
    let sentences: Vec<String> = std::iter::once(way).chain(on_the_way(spec)).collect();
    section.blocks.push(Block::Text(sentences.join(" ")));
    section.blocks.push(Block::Facts(facts(hole)));
    if drawn && !plan.findings.is_empty() {
        section.blocks.push(Block::List(plan.findings.iter().map(finding).collect()));
    }
    section.blocks.push(zones(hole).into());
    if drawn {
        // The plan is valid, so its point and its section can be drawn; the rest is left out.
        section.blocks.extend(section_drawings(hole).into_iter().flatten().map(Block::from));
        section.blocks.extend(point_drawing(&spec.point, spec.diameter).ok().map(Block::from));
        section.blocks.push(Block::Heading("Load along the way".to_owned()));
        section.blocks.push(engagement::chart(hole).into());
    }
    section.blocks.push(lengths_table(hole).into());
    if let Some(paper) = hole.paper {
        section.blocks.push(times_table(hole, paper).into());
    }
    section
}

/// A finding as a sentence with its word and code.
fn finding(f: &crate::base::Finding) -> String {
    format!("{} {}: {f}", f.severity.word(), f.code)
}

/// A table of many holes, one row each, with those that could not be planned.
pub fn drill_table(holes: &[DrilledHole], refused: &[RefusedHole]) -> Table {
    let mut table = Table::new(
        format!("{} holes", holes.len() + refused.len()),
        "Hole; At X, Y, Z [mm]; Start [mm]; Fully in [mm]; Break-through [mm]; End [mm]; Steady [mm]; \
             Time [s]; Touches first; Findings",
    );
    for h in holes {
        let z = &h.plan.coordinates;
        let found: Vec<String> = h.plan.findings.iter().map(|f| f.code.to_string()).collect();
        let worst = h.plan.findings.iter().any(|f| f.severity == Severity::Error);
        let found = if worst { Cell::wrong(found.join(", ")) } else { Cell::new(found.join(", ")) };
        table.rows.push(Row::new(vec![
            h.title.into(),
            place(h.at).into(),
            fixed(z.entry[0], 3).into(),
            fixed(z.entry[1], 3).into(),
            fixed(z.exit.map_or(f64::NAN, |e| e[0]), 3).into(),
            fixed(z.end, 3).into(),
            fixed(h.plan.zones.iter().filter(|z| z.stage == ZoneStage::Steady).map(|z| z.length()).sum(), 3)
                .into(),
            fixed(h.plan.time, 3).into(),
            first_contact(h).into(),
            found,
        ]));
    }
    for r in refused {
        let mut cells = vec![Cell::new(r.title.clone()), Cell::new(place(r.at))];
        cells.extend((0..7).map(|_| Cell::default()));
        cells.push(Cell::wrong(finding(&r.finding)));
        table.rows.push(Row::new(cells));
    }
    let time: f64 = holes.iter().map(|h| h.plan.time).sum();
    table.notes.push(format!(
        "Z of the lowest cutting point in the frame of each entry; all at feed: {}.",
        seconds(time)
    ));
    table
}

/// Many holes for a terminal, a line each, and a sentence on each that could not be planned.
pub fn drill_list(holes: &[DrilledHole], refused: &[RefusedHole]) -> Section {
    let row = |h: &DrilledHole| {
        let z = &h.plan.coordinates;
        let codes: Vec<String> = h.plan.findings.iter().map(|f| f.code.to_string()).collect();
        let numbers = [z.entry[0], z.entry[1], z.exit.map_or(f64::NAN, |e| e[0]), z.end, h.plan.time];
        let mut cells = vec![Cell::new(h.title)];
        cells.extend(numbers.map(|v| Cell::new(fixed(v, 3))));
        cells.push(codes.join(" ").into());
        Row::new(cells)
    };
    let columns = "Hole; Start [mm]; Fully in [mm]; Breaks through [mm]; End [mm]; Time [s]; Findings";
    let table = Table::new("", columns).rows(holes.iter().map(row));
    let refused: Vec<String> =
        refused.iter().map(|r| format!("{}: {}", r.title, finding(&r.finding))).collect();
    let section = Section::new(format!("{} holes", holes.len() + refused.len()));
    let section = if holes.is_empty() { section } else { section.with(table) };
    if refused.is_empty() { section } else { section.with(Block::List(refused)) }
}

fn place(at: Option<[f64; 3]>) -> String {
    at.map_or(String::new(), |p| p.map(|v| fixed(v, 3)).join(", "))
}

/// The sections of one hole or of many under a name: a table, then the drawings of each kind of a few, of the first and the worst of
/// many. Holes alike have one section.
pub fn drill_sections(name: &str, holes: &[DrilledHole], refused: &[RefusedHole]) -> Vec<Section> {
    let mut sections = Vec::new();
    if holes.len() + refused.len() > 1 || holes.is_empty() && !refused.is_empty() {
        sections.push(Section::new(name).with(drill_table(holes, refused)));
    }
    let kinds = kinds(holes);
    if let ([first], Some(all)) = (&kinds[..], sections.first_mut()) {
        let same = if holes.len() > 1 { ", and all are alike" } else { "" };
        all.blocks.push(Block::Text(format!("Drawn below: {}{same}.", holes[*first].title)));
        all.blocks.extend(drill_section(&holes[*first]).blocks);
        return sections;
    }
    if kinds.len() <= FEW {
        sections.extend(kinds.iter().map(|&i| drill_section(&holes[i])));
        if let Some(all) = sections.first_mut().filter(|_| kinds.len() < holes.len()) {
            all.blocks.push(Block::Text("Drawn below: the first of each that are alike.".to_owned()));
        }
        return sections;
    }
    sections.push(drill_section(&holes[0]));
    let worst = worst(holes);
    if worst > 0 {
        sections.push(drill_section(&holes[worst]));
    }
    let shown = if worst > 0 { "the first and the worst" } else { "the first, which is the worst," };
    if let Some(all) = sections.first_mut() {
        all.blocks.push(Block::Text(format!("Drawn below: {shown} of these holes.")));
    }
    sections
}

/// The first of each of the holes that are alike.
fn kinds(holes: &[DrilledHole]) -> Vec<usize> {
    let mut first: Vec<usize> = Vec::new();
    for (i, hole) in holes.iter().enumerate() {
        if first.len() > FEW {
            break;
        }
        if !first.iter().any(|&k| are_alike(&holes[k], hole)) {
            first.push(i);
        }
    }
    first
}

/// Whether two holes differ in their places only.
fn are_alike(a: &DrilledHole, b: &DrilledHole) -> bool {
    /// Differences of lengths that no number of a section shows [mm].
    const SAME: f64 = 1e-6;
    let near = |a: f64, b: f64| (a - b).abs() <= SAME;
    let (p, q) = (a.plan, b.plan);
    let zones = p.zones.len() == q.zones.len()
        && p.zones.iter().zip(&q.zones).all(|(a, b)| {
            a.stage == b.stage && near(a.from, b.from) && near(a.to, b.to) && near(a.feed, b.feed)
        });
    let codes = |p: &crate::drilling::DrillPlan| p.findings.iter().map(|f| f.code).collect::<Vec<_>>();
    let radii = |t: &crate::drilling::Transient| [t.first_radius, t.last_radius];
    let [one, other] = [radii(&p.entry), radii(&q.entry)];
    zones
        && p.edge == q.edge
        && one.iter().zip(other).all(|(a, b)| near(*a, b))
        && std::mem::discriminant(&a.spec.entry) == std::mem::discriminant(&b.spec.entry)
        && near(a.spec.entry.slope(), b.spec.entry.slope())
        && a.spec.end.exit().map(std::mem::discriminant) == b.spec.end.exit().map(std::mem::discriminant)
        && codes(p) == codes(q)
        && a.spec.pre_hole == b.spec.pre_hole
        && a.spec.bores == b.spec.bores
        && a.spec.mouth == b.spec.mouth
        && a.spec.ceiling == b.spec.ceiling
        && a.paper == b.paper
}

/// The hole with the gravest finding, of equals the one whose transients are longest, of equals the first.
fn worst(holes: &[DrilledHole]) -> usize {
    let grave = |h: &DrilledHole| h.plan.findings.iter().map(|f| f.severity).max();
    let long = |h: &DrilledHole| {
        let p = h.plan;
        p.entry.first - p.entry.last + p.exit.map_or(0.0, |e| e.first - e.last)
    };
    let mut worst = 0;
    for (i, h) in holes.iter().enumerate() {
        let w = &holes[worst];
        if grave(h).cmp(&grave(w)).then(long(h).total_cmp(&long(w))).is_gt() {
            worst = i;
        }
    }
    worst
}

/// The page of the verb `kinecut drill`: one HTML file without any reference to a network.
pub fn drill_html(holes: &[DrilledHole], refused: &[RefusedHole]) -> String {
    let title = match (holes, refused) {
        ([one], []) => one.title.to_owned(),
        _ => format!("{} holes", holes.len() + refused.len()),
    };
    VerbPage {
        maker: "kinecut drill",
        title: &format!("Drilling: {title}"),
        style: STYLE,
        caution: "Zones on a model do not replace the trial cut.",
        sections: &drill_sections("All holes", holes, refused),
        ..VerbPage::default()
    }
    .html()
}
