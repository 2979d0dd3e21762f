//! The section of a face and the page of the verb `kinecut face`.

use super::crossings::{crossings_table, survey_table};
use super::edges::bad_edges;
use super::figure_map::{map_picture, objective, survey_charts};
use super::figure_pareto::pareto;
use super::figure_plan::{Wanted, plan_view};
use super::figure_series::series;
use super::figure_ways::ways_picture;
use super::tables::{
    alternatives_table, certificate_words, cutter_words, descents_words, edges_table, facts,
    irreducible_table, outline_words, placement_words, rule_words, sensitivity_words, toothed, toothed_words,
    ways_table, weight_words,
};
use super::{MilledFace, Simulated};
use crate::base::Finding;
use crate::facing::passes::{PassPath, path_burr};
use crate::facing::{MillingWay, Placement};
use crate::page::verb_page::VerbPage;
use crate::page::{Block, Fact, Picture, Section};

/// Rows of the table of bad edges.
const MOST_EDGES: usize = 30;

/// The section of one face; with what was simulated of it and the facts of that, in the report of a job.
pub(crate) fn face_section(face: &MilledFace<'_>, simulated: Option<&Simulated>, more: Vec<Fact>) -> Section {
    let title = if simulated.is_some() { "The chosen way, planned and simulated" } else { "The chosen way" };
    let wanted = Wanted { moving: true, teeth: true, simulated };
    let mut plans = vec![plan_view(face, face.chosen(), title, "plan", &wanted)];
    let wanted = Wanted { teeth: true, ..Wanted::default() };
    if let Some(before) = as_drawn(face) {
        plans.push(plan_view(face, &before, "Before: as drawn, cutter over the middle", "before", &wanted));
    }
    if let (None, Ok(optimum)) = (face.chosen().placement(), &face.plan.optimum) {
        let best = straight(face, optimum.placement, "best straight pass");
        plans.push(plan_view(face, &best, "The best straight pass, to compare", "straight", &wanted));
    }
    let mut section = section(face, more, plans);
    section.blocks.extend(objective(face).into_iter().flat_map(|map| {
        let charts = survey_charts(face, &map).into_iter().map(Block::from);
        std::iter::once(map_picture(face, &map).into()).chain(charts)
    }));
    section.blocks.extend(series(face, face.chosen()).map(Block::from));
    section
}

/// A face in words and numbers, with what the paper's program does and the crossings of the teeth where they are known.
pub(crate) fn face_words(face: &MilledFace<'_>) -> Section {
    let mut section = section(face, Vec::new(), Vec::new());
    section.blocks.extend(survey_table(face).into_iter().chain(crossings_table(face)).map(Block::from));
    section
}

/// Blocks that page and terminal share; on a page it has `plans`, and so all other pictures and the findings.
fn section(face: &MilledFace<'_>, more: Vec<Fact>, plans: Vec<Picture>) -> Section {
    let drawn = !plans.is_empty();
    let mut section = Section::new(face.title);
    let mut put = |block: Block| section.blocks.push(block);
    put(Block::Facts(facts(face).into_iter().chain(more).collect()));
    put(Block::Text(sentence(&rule_words(face))));
    let mut list =
        vec![format!("Outline: {}.", outline_words(face)), format!("Cutter: {}.", cutter_words(face))];
    list.extend(weight_words(face).map(|w| format!("Weights of edges: {w}.")));
    list.extend(face.notes.iter().map(|n| sentence(n)));
    let set_up = placement_words(face);
    list.push(format!("Set-up: {}.", set_up.join("; ")));
    list.push(format!("Proof: {}.", certificate_words(face)));
    list.extend(sensitivity_words(face).map(|w| format!("Errors of set-up: {w}.")));
    if let Some(t) = toothed(face) {
        list.extend(toothed_words(&t).iter().map(|w| format!("Teeth: {w}.")));
    }
    list.extend(face.findings.iter().filter(|_| drawn).map(finding));
    put(Block::List(list));
    plans.into_iter().for_each(|plan| put(plan.into()));
    put(edges_table(&bad_edges(face, face.chosen()), MOST_EDGES).into());
    put(Block::Heading("Ways and their price".to_owned()));
    put(ways_table(face).into());
    if drawn && face.plan.ways.len() > 1 {
        put(pareto(face).into());
    }
    if let Some(picture) = ways_picture(face).filter(|_| drawn) {
        put(picture.into());
    }
    put(Block::Heading("One straight pass: all placements".to_owned()));
    if let Some(table) = alternatives_table(face) {
        put(table.into());
    }
    if let Some(words) = descents_words(face) {
        put(Block::Text(sentence(&words)));
    }
    if let Some(table) = irreducible_table(face) {
        put(table.into());
    }
    section
}

/// The straight pass over the part as drawn, as a way.
fn as_drawn(face: &MilledFace<'_>) -> Option<MillingWay> {
    let placement = face.plan.as_drawn?;
    (face.chosen().placement() != Some(placement)).then(|| straight(face, placement, "as drawn"))
}

/// One straight pass of a placement, as a way.
pub(super) fn straight(face: &MilledFace<'_>, placement: Placement, name: &str) -> MillingWay {
    let case = &face.plan.case;
    let path = PassPath::straight(placement, case.outline.extent(placement.feed_in_part()), case.radius);
    let burr = path_burr(case, &path);
    let feed_length = path.feed_length();
    MillingWay {
        name: name.to_owned(),
        angle: Some(placement.angle),
        offset: Some(placement.offset),
        bad: burr.bad,
        guarded: path_burr(&face.plan.guarded, &path).bad,
        burr,
        feed_length,
        time: feed_length / face.feed,
        unreached: None,
        unbeaten: false,
        path,
    }
}

/// With a capital and a full stop.
fn sentence(text: &str) -> String {
    let mut chars = text.chars();
    let first: String = chars.next().into_iter().flat_map(char::to_uppercase).collect();
    let rest = chars.as_str();
    let stop = if rest.ends_with('.') { "" } else { "." };
    format!("{first}{rest}{stop}")
}

/// A finding as a sentence with its word and code.
fn finding(f: &Finding) -> String {
    format!("{} {}: {f}", f.severity.word(), f.code)
}

/// The page of the verb: one HTML file without any reference to a network.
pub(crate) fn face_page(faces: &[MilledFace<'_>]) -> String {
    let title = match faces {
        [one] => one.title.to_owned(),
        _ => format!("{} faces", faces.len()),
    };
    VerbPage {
        maker: "kinecut face",
        title: &title,
        moves: true,
        caution: "A burr on a model does not replace the trial cut.",
        sections: &faces.iter().map(|f| face_section(f, None, Vec::new())).collect::<Vec<_>>(),
        ..VerbPage::default()
    }
    .html()
}
