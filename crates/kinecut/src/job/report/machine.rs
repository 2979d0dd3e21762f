//! Section of a report on the bodies of the machine: an answer for each, and a picture of each pair that meets.

use std::fmt::Write;

use glam::{DVec3, Vec3};

use super::{BodyView, JointView, MachineSetup, MachineView, PathPiece};
use crate::contact::{MachineMeeting, Party};
use crate::geom::{Rigid, Solid};
use crate::job::check::{Job, JobSetup};
use crate::job::contacts::LOOK;
use crate::job::contacts::machine::{BodyKind, ComparedBody, MachineContacts};
use crate::job::machine::write::link_name;
use crate::job::{Outcome, SetupOutcome};
use crate::machine::{Body, Joint, JointValues, Link, Machine};
use crate::page::draw::{Cover, FacePiece, Facets, View, put_faces};
use crate::page::{Cell, Colour, Ink, Picture, Row, Section, Table, Tint, Width, fixed};
use crate::program::Setup;
use crate::tool::Tool;
use crate::trace::Segment;

/// Most pictures of contacts of a setup.
const MOST_DRAWN: usize = 3;
/// Most triangles of the meshes of a picture beside the two bodies that meet.
const MOST_TRIANGLES: usize = 6000;
/// Size of a picture [px].
const SIZE: [f64; 2] = [620.0, 420.0];
/// Room about what it shows [px].
const AROUND: f64 = 12.0;
/// Directions from which a contact is looked at: the first from which it is not hidden, as azimuths [degrees].
const AZIMUTHS: [f64; 6] = [-50.0, 40.0, -130.0, 130.0, -90.0, 90.0];
/// Elevations of the viewer [degrees].
const ELEVATIONS: [f64; 2] = [24.0, 6.0];

/// The section, for a page with its pictures; none where the machine has no bodies.
pub(super) fn section(outcome: &Outcome, first_lines: &[u32], page: bool) -> Option<Section> {
    let machine = outcome.job.machine.as_ref()?;
    let mut section = Section::new("Bodies of the machine");
    for (i, done) in outcome.setups.iter().enumerate() {
        let Some(contacts) = outcome.simulation.machine[i].as_ref().filter(|c| !c.bodies.is_empty()) else {
            continue;
        };
        let setup = &outcome.job.setups[i].clamping.setup;
        let of = if outcome.setups.len() > 1 { format!(", {}", setup.name) } else { String::new() };
        let first_line = first_lines[i];
        let shown = Shown { job: &outcome.job, machine, setup, done, contacts, first_line };
        for (number, meeting) in shown.first_contacts().into_iter().filter(|_| page).enumerate() {
            let id = format!("machine-contact-{}-{}", i + 1, number + 1);
            section = section.with(shown.picture(id, meeting)?);
        }
        section = section.with(shown.table(&of));
    }
    (!section.blocks.is_empty()).then_some(section)
}

/// The machine for the 3-D view; none where it has no bodies, or where the positions of its axes are not known along the whole `path`. The
/// programs have so many `lines` together.
pub(super) fn view(job: &Job, path: &[PathPiece], first_lines: &[u32], lines: u32) -> Option<MachineView> {
    let machine = job.machine.as_ref().filter(|machine| !machine.bodies.is_empty())?;
    let count = machine.joints.len();
    let known = |piece: &PathPiece| {
        piece.joints.len() == count * piece.points.len() && piece.joints.iter().all(|q| q.is_finite())
    };
    if !path.iter().all(known) {
        return None;
    }
    let joint = |joint: &Joint| JointView {
        rotary: joint.motion.is_rotation(),
        direction: (joint.direction * joint.sense).to_array(),
        point: joint.point.to_array(),
    };
    let body = |body: &Body| {
        let link = match body.link {
            Link::Bed => None,
            Link::Axis(joint) => Some(joint),
        };
        (link, BodyView::new(&body.name, &Facets::of(&body.solid, &body.place)))
    };
    let ends = first_lines.iter().copied().skip(1).chain([lines]);
    let setups = job.setups.iter().zip(first_lines.iter().copied().zip(ends));
    let setup = |(setup, lines): (&JobSetup, (u32, u32))| {
        let part = machine.work.after(&setup.clamping.setup.part_on_table);
        let mut columns = [0.0; 12];
        columns[..9].copy_from_slice(&part.rotation.to_cols_array());
        columns[9..].copy_from_slice(&part.translation.to_array());
        MachineSetup { lines: lines.into(), part: columns }
    };
    Some(MachineView {
        joints: machine.joints.iter().map(joint).collect(),
        bed: machine.code.bed(),
        setups: setups.map(setup).collect(),
        bodies: machine.bodies.iter().map(body).collect(),
    })
}

/// Positions of the joints of a machine at points of a segment [mm or rad]; nothing where they are not known.
pub(super) fn joints(machine: &Machine, segment: &Segment, points: &[[f32; 3]]) -> Vec<f32> {
    let gap = |pair: &[[f32; 3]]| f64::from(Vec3::from(pair[0]).distance(Vec3::from(pair[1])));
    let length: f64 = points.windows(2).map(gap).sum();
    let mut done = 0.0;
    let mut all = Vec::with_capacity(points.len() * machine.joints.len());
    for (i, _) in points.iter().enumerate() {
        done += if i > 0 { gap(&points[i - 1..=i]) } else { 0.0 };
        // Of a move on the spot the last point is its end.
        let t = if length > 0.0 {
            done / length
        } else if i > 0 {
            1.0
        } else {
            0.0
        };
        let Some(axes) = segment.joints(t.min(1.0)) else { return Vec::new() };
        all.extend(
            machine.joints.iter().map(|joint| "XYZABC".find(joint.letter).map_or(0.0, |k| axes[k] as f32)),
        );
    }
    all
}

/// A setup on a machine with bodies.
struct Shown<'a> {
    job: &'a Job,
    machine: &'a Machine,
    setup: &'a Setup,
    done: &'a SetupOutcome,
    contacts: &'a MachineContacts,
    first_line: u32,
}

impl Shown<'_> {
    fn line(&self, meeting: &MachineMeeting) -> Option<u32> {
        let item = self.done.trace.segments[meeting.watched as usize].item;
        self.done.lines.get(item as usize).copied().flatten().map(|line| line + self.first_line)
    }

    /// The first contact of each pair, as many as are drawn.
    fn first_contacts(&self) -> Vec<&MachineMeeting> {
        let mut all: Vec<&MachineMeeting> = Vec::new();
        for meeting in self.contacts.met.meetings.iter().filter(|m| m.contact.is_some()) {
            let same = |m: &&MachineMeeting| (m.moving, m.standing) == (meeting.moving, meeting.standing);
            if all.len() < MOST_DRAWN && !all.iter().any(same) {
                all.push(meeting);
            }
        }
        all
    }

    /// The answer for each body.
    fn table(&self, of: &str) -> Table {
        // The stock at that moment is listed where it is met, or has cleared all.
        let listed = |(body, compared): &(u32, &ComparedBody)| {
            let meets = || self.contacts.met.meetings.iter().any(|m| m.standing == *body);
            // Where a doubt is left the raw one says it.
            compared.kind != BodyKind::StockThen || meets() || !self.contacts.meets_stock()
        };
        let rows = (0..).zip(&self.contacts.bodies).filter(listed).map(|(body, compared)| {
            let own = || {
                let is_own = move |m: &&MachineMeeting| m.standing == body || m.moving == Party::Body(body);
                self.contacts.met.meetings.iter().filter(is_own)
            };
            let mut lines: Vec<_> = own().filter(|m| m.is_certain()).map(|m| self.line(m)).collect();
            lines.dedup();
            let mut may: Vec<_> = own().filter(|m| m.contact.is_some()).map(|m| self.line(m)).collect();
            may.dedup();
            let near = own().min_by(|a, b| a.distance.total_cmp(&b.distance));
            let touching = self.contacts.touching.iter().find(|pair| pair.contains(&body));
            // What the stock at that moment has cleared is no pass of the raw one.
            let then = self.contacts.stock_then.filter(|_| compared.kind == BodyKind::Stock);
            let near = near.filter(|_| then.is_none() || !may.is_empty());
            let (answer, at) = match (lines.first(), touching, near) {
                (Some(first), ..) => {
                    let blocks = if lines.len() == 1 { "block brings" } else { "blocks bring" };
                    (Cell::wrong(format!("{} {blocks} it into contact", lines.len())), *first)
                }
                (None, Some([standing, moving]), _) => {
                    let other = if *standing == body { moving } else { standing };
                    let other = &self.contacts.bodies[*other as usize].name;
                    (Cell::wrong(format!("touches {other} where the program begins")), None)
                }
                (None, None, Some(near)) if !may.is_empty() => {
                    let blocks = if may.len() == 1 { "block" } else { "blocks" };
                    let text = format!(
                        "{} {blocks} may bring it into contact, {:.2} mm apart",
                        may.len(),
                        near.distance
                    );
                    (Cell::wrong(text), self.line(near))
                }
                (None, None, Some(near)) => {
                    (Cell::new(format!("passed at {:.2} mm", near.distance)), self.line(near))
                }
                (None, None, None) if then.is_some() => (Cell::new("see the stock at that moment"), None),
                (None, None, None) => {
                    let stock = matches!(compared.kind, BodyKind::Stock | BodyKind::StockThen);
                    (free(stock, self.contacts.is_for_all_moves()), None)
                }
            };
            let link = match compared.kind {
                BodyKind::Machine(i) => link_name(self.machine, self.machine.bodies[i].link),
                BodyKind::Fixture(_) | BodyKind::Stock | BodyKind::StockThen => "work".to_owned(),
            };
            let name = match compared.kind {
                BodyKind::Stock if self.contacts.stock_then.is_some() => format!("{}, raw", compared.name),
                BodyKind::StockThen => format!("{} at that moment", compared.name),
                _ => compared.name.clone(),
            };
            let row = Row::new(vec![Cell::new(name), Cell::new(link), answer]);
            at.map_or(row.clone(), |line| row.at(line))
        });
        let caption = format!("Bodies that the axes move against one another{of}");
        let stock = match self.contacts.stock_then {
            None => "The stock counts as before the first cut, and not against the tool.".to_owned(),
            Some(then) => {
                let contacts = if then.cleared == 1 { "contact" } else { "contacts" };
                format!(
                    "The stock does not count against the tool. Where bodies come to the raw stock they are compared with the stock at that moment too, by lines {} mm apart: {} {contacts} with the raw stock cleared.",
                    fixed(then.step, 2),
                    then.cleared
                )
            }
        };
        let guided = "Two bodies of the machine on neighbouring links are not compared, as one is guided by the other.";
        Table::new(caption, "Body; Carried by; Answer").rows(rows).note(format!("{guided} {stock}"))
    }

    /// All bodies at the moment at which two of them begin to touch.
    fn picture(&self, id: String, meeting: &MachineMeeting) -> Option<Picture> {
        let segment = &self.done.trace.segments[meeting.watched as usize];
        let t = meeting.contact.as_ref()?.from;
        let axes = segment.joints(t)?;
        let position = |letter: char| "XYZABC".find(letter).map_or(0.0, |i| axes[i]);
        let q: Vec<f64> = self.machine.joints.iter().map(|joint| position(joint.letter)).collect();
        let q = JointValues::new(&q);
        let mut drawn: Vec<(Facets, Tint)> = Vec::new();
        let (mut budget, mut left_out) = (MOST_TRIANGLES, 0);
        // The stock at that moment is drawn as the raw one.
        let kind = |body: u32| self.contacts.bodies[body as usize].kind;
        let of_stock = kind(meeting.standing) == BodyKind::StockThen;
        let meets = |body: u32| {
            body == meeting.standing
                || meeting.moving == Party::Body(body)
                || of_stock && kind(body) == BodyKind::Stock
        };
        let at_work = self.machine.link(self.machine.work_link(), &q).after(&self.machine.work);
        for (body, compared) in (0..).zip(&self.contacts.bodies) {
            let (solid, place): (&Solid, Rigid) = match compared.kind {
                BodyKind::Machine(i) => {
                    let body = &self.machine.bodies[i];
                    (&body.solid, self.machine.link(body.link, &q).after(&body.place))
                }
                BodyKind::Fixture(i) => {
                    let fixture = &self.setup.fixtures[i];
                    (&fixture.solid, at_work.after(&fixture.place))
                }
                BodyKind::Stock => (&self.job.stock, at_work.after(&self.setup.part_on_table)),
                BodyKind::StockThen => continue,
            };
            let tint = match compared.kind {
                _ if meets(body) => Tint::Rose,
                BodyKind::Machine(_) => Tint::Grey,
                BodyKind::Fixture(_) => Tint::Steel,
                BodyKind::Stock | BodyKind::StockThen => Tint::Sand,
            };
            if let (Solid::Mesh(mesh), false) = (solid, meets(body)) {
                match budget.checked_sub(mesh.triangles.len()) {
                    Some(rest) => budget = rest,
                    None => {
                        left_out += 1;
                        continue;
                    }
                }
            }
            drawn.push((Facets::of(solid, &place), tint));
        }
        if let Some(tool) = self.job.tools.iter().find(|tool| Some(tool.number) == segment.tool) {
            let length = tool.gauge_length.unwrap_or(0.0);
            let tip = self.machine.spindle.after(&Rigid::from_translation(DVec3::Z * -length));
            let place = self.machine.link(self.machine.tool_link(), &q).after(&tip);
            let tint = if matches!(meeting.moving, Party::Tool(_)) { Tint::Rose } else { Tint::Orange };
            drawn.extend(drums(tool).iter().map(|drum| (Facets::of(drum, &place), tint)));
        }
        let place = at_work.after(&self.setup.part_on_table).point(meeting.place);
        let one = match meeting.moving {
            Party::Tool(_) => self.contacts.party(meeting.moving),
            Party::Body(body) => self.name(body).to_owned(),
        };
        let other = self.name(meeting.standing);
        let mut picture = Picture {
            id,
            title: format!("{one} meets {other}"),
            about: self.about(meeting, axes),
            summary: format!("The machine at the moment at which {one} meets {other}"),
            size: SIZE,
            ..Picture::default()
        };
        picture.legend = vec![
            (Ink::Face(Tint::Rose, 0), "the two that meet".to_owned()),
            (Ink::Face(Tint::Grey, 0), "machine".to_owned()),
            (Ink::Face(Tint::Sand, 0), "stock".to_owned()),
        ];
        if left_out > 0 {
            let meshes =
                if left_out == 1 { "1 mesh of many triangles is" } else { "meshes of many triangles are" };
            let count = if left_out == 1 { String::new() } else { format!("{left_out} ") };
            picture.notes.push(format!("{count}{meshes} left out of the picture."));
        }
        put(&mut picture, &drawn, place);
        Some(picture)
    }

    fn name(&self, body: u32) -> &str {
        &self.contacts.bodies[body as usize].name
    }

    /// Line and positions of the axes.
    fn about(&self, meeting: &MachineMeeting, axes: [f64; 6]) -> String {
        let mut about = self.line(meeting).map_or_else(String::new, |line| format!("line {}: ", line + 1));
        for (i, letter) in "XYZABC".chars().enumerate() {
            if self.machine.joint(letter).is_some() {
                let value = if i < 3 { axes[i] } else { axes[i].to_degrees() };
                let _ = write!(about, "{letter}{value:.2} ");
            }
        }
        about.trim_end().to_owned()
    }
}

/// The answer for a body that nothing meets; it is not right where not all was compared.
fn free(stock: bool, all: bool) -> Cell {
    match (stock, all) {
        (true, true) => Cell::right("nothing meets it"),
        (true, false) => Cell::new("nothing meets it in the moves compared"),
        (false, true) => Cell::right(format!("nothing nearer than {LOOK} mm")),
        (false, false) => Cell::new(format!("nothing nearer than {LOOK} mm in the moves compared")),
    }
}

/// Bodies on paper, seen from where a place is not hidden, with a mark at that place.
fn put(picture: &mut Picture, drawn: &[(Facets, Tint)], place: DVec3) {
    let within = [AROUND, AROUND, SIZE[0] - 2.0 * AROUND, SIZE[1] - 2.0 * AROUND];
    let seen_from = |azimuth: f64, elevation: f64| {
        let corners = drawn.iter().flat_map(|(facets, _)| facets.corners.iter().copied());
        let view = View::from(azimuth.to_radians(), elevation.to_radians()).fitting(corners, within);
        let mut pieces = Vec::new();
        for (body, (facets, _)) in drawn.iter().enumerate() {
            pieces.extend(facets.seen(view.viewer).into_iter().map(|(_, face)| FacePiece { face, body }));
        }
        (view, pieces)
    };
    let ways = ELEVATIONS.into_iter().flat_map(|e| AZIMUTHS.into_iter().map(move |a| (a, e)));
    let open = |&(azimuth, elevation): &(f64, f64)| {
        let (view, pieces) = seen_from(azimuth, elevation);
        // A place on a surface is not hidden by that surface.
        !Cover::new(view, &pieces, view.mm(6.0)).hides(place)
    };
    let (azimuth, elevation) = ways.clone().find(open).unwrap_or((AZIMUTHS[0], ELEVATIONS[0]));
    let (view, pieces) = seen_from(azimuth, elevation);
    put_faces(picture, &view, pieces, |body| drawn[body].1);
    let mark = view.px(place);
    picture.circle(Ink::line(Colour::Bad, Width::Thick), mark, 9.0);
}

/// A tool as cylinders, in its own coordinates.
fn drums(tool: &Tool) -> Vec<Solid> {
    let profiles = tool.profiles().unwrap_or_default();
    let drum = |(profile, above): &(crate::geom::Profile, f64)| Solid::Cylinder {
        base: DVec3::Z * *above,
        radius: profile.max_radius(),
        height: profile.top(),
    };
    profiles.iter().map(drum).collect()
}
