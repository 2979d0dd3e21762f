//! SetupPlan drillings as the report shows them.

use super::show::{DrilledHole, drill_sections};
use super::{PlannedDrilling, PlannedHole};
use crate::drilling::{End, PaperResult};
use crate::operations::Shown;
use crate::page::Section;
use crate::program::{Item, Speed};

/// Places along a hole at which the simulated share is shown.
const PLACES: u32 = 400;

/// A hole with what belongs to it, kept for the borrowing view.
pub(crate) struct ShownHole<'a> {
    pub(crate) title: String,
    pub(crate) hole: &'a PlannedHole,
    pub(crate) paper: Option<PaperResult>,
    pub(crate) simulated: Vec<[f64; 2]>,
    pub(crate) starts_at: Option<f64>,
}

impl<'a> ShownHole<'a> {
    pub(crate) fn new(title: String, hole: &'a PlannedHole) -> ShownHole<'a> {
        ShownHole { title, hole, paper: None, simulated: Vec::new(), starts_at: None }
    }

    pub(crate) fn view(&self) -> DrilledHole<'_> {
        let [x, y] = self.hole.at;
        DrilledHole {
            at: Some([x, y, self.hole.zero]),
            paper: self.paper.as_ref(),
            simulated: &self.simulated,
            starts_at: self.starts_at,
            ..DrilledHole::new(&self.title, &self.hole.spec, &self.hole.plan)
        }
    }
}

/// Of one hole what is done there; of many which one it is.
pub(crate) fn title(name: &str, hole: &PlannedHole, count: usize) -> String {
    if count == 1 {
        return capital(name);
    }
    let diameter = match hole.spec.end {
        End::Reached(diameter) => diameter,
        _ => hole.spec.diameter,
    };
    let [x, y] = hole.at.map(|v| (v * 1e3).round() / 1e3 + 0.0);
    format!("D{diameter} hole {} at X{x} Y{y}", hole.number + 1)
}

/// A name as a heading.
fn capital(name: &str) -> String {
    name[..1].to_uppercase() + &name[1..]
}

/// The sections of a job's drillings.
pub(super) fn sections(all: &[(&PlannedDrilling, &Shown<'_>)]) -> Vec<Section> {
    let mut sections = Vec::new();
    for (drilling, of) in all {
        let count = drilling.holes.len();
        let shown: Vec<ShownHole<'_>> = drilling
            .holes
            .iter()
            .enumerate()
            .map(|(i, hole)| ShownHole {
                simulated: of
                    .points
                    .get(i)
                    .map_or_else(Vec::new, |p| drilling.engagement(of, hole, p, PLACES)),
                starts_at: starts_at(of, hole),
                ..ShownHole::new(title(&of.name, hole, count), hole)
            })
            .collect();
        let views: Vec<DrilledHole<'_>> = shown.iter().map(ShownHole::view).collect();
        sections.extend(drill_sections(&capital(&of.name), &views, &[]));
    }
    sections
}

/// Time of the program when a hole starts at feed [s]; `None` for holes whose stretches are a cycle's, in which time and
/// way are not one to one.
fn starts_at(of: &Shown<'_>, hole: &PlannedHole) -> Option<f64> {
    let program = of.posted.planned;
    let at_feed = |i: &usize| !matches!(program.state(*i).speed, Speed::Rapid { .. });
    let item = (hole.first_item as usize..program.items.len()).find(at_feed)?;
    if matches!(program.items.get(item), Item::Cycle(..)) {
        return None;
    }
    let line = (of.first_line + of.posted.line_of_planned(item as u32)?) as usize;
    of.begins.get(line).copied()
}
