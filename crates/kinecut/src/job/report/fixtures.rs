//! Section of a report on clamps and fixtures: their places seen from above, the moves that meet them, an answer for each body.

use glam::{DVec2, DVec3};

use super::{BodyView, FixtureView};
use crate::contact::Meeting;
use crate::geom::{Rigid, Solid, convex_hull};
use crate::job::check::Job;
use crate::job::contacts::LOOK;
use crate::job::{Outcome, SetupOutcome};
use crate::operations::setting::corners;
use crate::page::draw::Facets;
use crate::page::{Cell, Colour, Ink, Plan, PlanLine, Row, Section, Table, Width};
use crate::program::{Fixture, Setup};

/// Points of a drawn circle.
const ROUND: u32 = 72;
/// Most contacts that are drawn.
const MOST_DRAWN: usize = 200;

/// The section; none where no setup has fixtures.
pub(super) fn section(outcome: &Outcome, first_lines: &[u32]) -> Option<Section> {
    let mut section = Section::new("Clamps and fixtures");
    for (i, done) in outcome.setups.iter().enumerate() {
        let clamping = &outcome.job.setups[i].clamping;
        if clamping.setup.fixtures.is_empty() {
            continue;
        }
        let shown = Shown {
            setup: &clamping.setup,
            to_work: clamping.to_work(),
            done,
            meetings: &outcome.simulation.meetings[i],
            first_line: first_lines[i],
        };
        let of = if outcome.setups.len() > 1 { format!(", {}", clamping.setup.name) } else { String::new() };
        section = section.with(shown.plan(&of, outcome)).with(shown.table(&of));
    }
    (!section.blocks.is_empty()).then_some(section)
}

/// The bodies for the 3-D view; the programs have so many `lines` together.
pub(super) fn views(job: &Job, first_lines: &[u32], lines: u32) -> Vec<FixtureView> {
    let ends = first_lines.iter().copied().skip(1).chain([lines]);
    let mut views = Vec::new();
    for (setup, lines) in job.setups.iter().zip(first_lines.iter().copied().zip(ends)) {
        let setup = &setup.clamping.setup;
        let to_part = setup.part_on_table.inverse();
        views.extend(setup.fixtures.iter().map(|fixture| {
            let facets = Facets::of(&fixture.solid, &to_part.after(&fixture.place));
            FixtureView { lines: lines.into(), body: BodyView::new(&fixture.name, &facets) }
        }));
    }
    views
}

/// A setup with fixtures.
struct Shown<'a> {
    setup: &'a Setup,
    /// From part coordinates into those of the work offset.
    to_work: Rigid,
    done: &'a SetupOutcome,
    meetings: &'a [Meeting],
    first_line: u32,
}

impl Shown<'_> {
    /// Coordinates of the work offset of a body's own.
    fn place(&self, fixture: &Fixture) -> Rigid {
        self.to_work.after(&self.setup.part_on_table.inverse()).after(&fixture.place)
    }

    fn line(&self, meeting: &Meeting) -> Option<u32> {
        let item = self.done.trace.segments[meeting.watched as usize].item;
        self.done.lines.get(item as usize).copied().flatten()
    }

    /// Stock and bodies from above, and the moves that meet a body.
    fn plan(&self, of: &str, outcome: &Outcome) -> Plan {
        let mut plan =
            Plan::new(format!("Stock and fixtures from above{of}, coordinates of the work offset"));
        let stock = corners(&outcome.job.stock.bounds(), &self.to_work);
        plan.lines.push(PlanLine::new(Ink::line(Colour::Quiet, Width::Thin), "stock", around(stock)));
        for fixture in &self.setup.fixtures {
            let ink = Ink::line(Colour::Steel, Width::Middle);
            plan.lines.push(PlanLine::new(
                ink,
                "fixture",
                around(points(&fixture.solid, &self.place(fixture))),
            ));
        }
        let mut drawn = Vec::new();
        for meeting in self.meetings.iter().filter(|m| m.contact.is_some()).take(MOST_DRAWN) {
            let place = self.to_work.point(meeting.place);
            let name = &self.setup.fixtures[meeting.body as usize].name;
            if !plan.points.iter().any(|(_, word)| word == name) {
                plan.points.push(([place.x, place.y], name.clone()));
            }
            if drawn.contains(&meeting.watched) {
                continue;
            }
            drawn.push(meeting.watched);
            let curve = &self.done.trace.segments[meeting.watched as usize].curve;
            let tip = |i: u32| {
                let p = self.to_work.point(curve.at(curve.length() * f64::from(i) / f64::from(ROUND)).p);
                [p.x, p.y]
            };
            let ink = Ink::line(Colour::Bad, Width::Middle);
            let mut way = PlanLine::new(ink, "move that meets one", (0..=ROUND).map(tip).collect());
            way.block = self.line(meeting).map(|line| line + self.first_line);
            plan.lines.push(way);
        }
        plan
    }

    /// The answer for each body.
    fn table(&self, of: &str) -> Table {
        let rows = (0..).zip(&self.setup.fixtures).map(|(body, fixture)| {
            let heights = points(&fixture.solid, &self.place(fixture)).into_iter().map(|p| p.z);
            let [low, high] =
                heights.fold([f64::INFINITY, f64::NEG_INFINITY], |[a, b], z| [a.min(z), b.max(z)]);
            let own = || self.meetings.iter().filter(move |m| m.body == body);
            let mut lines: Vec<_> = own().filter(|m| m.is_certain()).map(|m| self.line(m)).collect();
            lines.dedup();
            let mut may: Vec<_> = own().filter(|m| m.contact.is_some()).map(|m| self.line(m)).collect();
            may.dedup();
            let near = own().min_by(|a, b| a.distance.total_cmp(&b.distance));
            let (answer, at) = match (lines.first(), near) {
                (Some(first), _) => {
                    let blocks = if lines.len() == 1 { "block meets it" } else { "blocks meet it" };
                    (Cell::wrong(format!("{} {blocks}", lines.len())), *first)
                }
                (None, Some(near)) if !may.is_empty() => {
                    let blocks = if may.len() == 1 { "block" } else { "blocks" };
                    let text = format!("{} {blocks} may meet it, {:.2} mm apart", may.len(), near.distance);
                    (Cell::wrong(text), self.line(near))
                }
                (None, Some(near)) => {
                    (Cell::new(format!("passed at {:.2} mm", near.distance)), self.line(near))
                }
                (None, None) => (Cell::right(format!("nothing nearer than {LOOK} mm")), None),
            };
            let cells = vec![
                Cell::new(fixture.name.clone()),
                Cell::new(format!("{low:.2}")),
                Cell::new(format!("{high:.2}")),
                answer,
            ];
            let row = Row::new(cells);
            at.map_or(row.clone(), |line| row.at(line + self.first_line))
        });
        let caption = format!("Tools, shanks and holders past the fixtures{of}");
        let table = Table::new(caption, "Body; Z from [mm]; Z to [mm]; Answer").rows(rows);
        match self.meetings.iter().filter(|m| m.contact.is_some()).count() {
            count if count > MOST_DRAWN => {
                table.note(format!("The first {MOST_DRAWN} of {count} contacts are drawn."))
            }
            _ => table,
        }
    }
}

/// Points whose hull is that of a solid at a place.
fn points(solid: &Solid, place: &Rigid) -> Vec<DVec3> {
    match solid {
        Solid::Box(bounds) => corners(bounds, place).to_vec(),
        Solid::Cylinder { base, radius, height } => (0..2 * ROUND)
            .map(|i| {
                let angle = std::f64::consts::TAU * f64::from(i / 2) / f64::from(ROUND);
                let rim = (DVec2::from_angle(angle) * *radius).extend(if i % 2 == 0 { 0.0 } else { *height });
                place.point(*base + rim)
            })
            .collect(),
        Solid::Mesh(mesh) => mesh.vertices.iter().map(|p| place.point(*p)).collect(),
    }
}

/// The outline around points, from above.
fn around(points: impl IntoIterator<Item = DVec3>) -> Vec<[f64; 2]> {
    let corners = convex_hull(points.into_iter().map(|p| p.truncate()).collect());
    corners.iter().chain(corners.first()).map(|p| p.to_array()).collect()
}
