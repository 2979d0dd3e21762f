//! The plan view of a way: entries, good and bad exits, the cutter with its centre line, teeth on their way across the
//! part with their exit angles (figure 3 of Kryzhanivskyi and Kryzhanivska 2011).

use std::borrow::Cow;
use std::f64::consts::{FRAC_PI_2, PI};

use glam::DVec2;

use super::frame::{PictureFrame, Window, edge_on, edge_path};
use super::motion::timed;
use super::simulated::put_dots;
use super::strokes::{Kind, Stroke, strokes};
use super::{MilledFace, Simulated, Timed, looks};
use crate::facing::{CutterPosition, MillingWay, pictures};
use crate::geom::OutlineEdge;
use crate::page::draw::{BELOW, Labels, Plot, Ticks, WIDTHS, head, room_left, width};
use crate::page::px;
use crate::page::{Ink, Picture, PictureMotion, Shape, fixed};

/// Width of the picture, and the greatest height of the plan in it [px].
const WIDTH: f64 = WIDTHS[0];
const HEIGHT: f64 = 380.0;
/// Room above and at the right [px].
const ROOM: f64 = 12.0;
/// Length and half width of heads of arrows [px].
const HEAD: [f64; 2] = [11.0, 4.5];
/// Places of the cutter that are drawn.
const TEETH: u32 = 6;
/// Part of the cutter's radius that is drawn before and behind the part.
const BESIDE: f64 = 0.3;

/// Content of a plan view.
#[derive(Default)]
pub(super) struct Wanted<'a> {
    /// Whether the cutter moves.
    pub(super) moving: bool,
    /// Whether teeth are drawn on their way, with their exit angles.
    pub(super) teeth: bool,
    /// Result of the simulation.
    pub(super) simulated: Option<&'a Simulated>,
}

/// The plan view of a way.
pub(super) fn plan_view(
    face: &MilledFace<'_>,
    way: &MillingWay,
    title: &str,
    id: &str,
    wanted: &Wanted<'_>,
) -> Picture {
    // The way of the posted text, if there is one.
    let posted = wanted.simulated.map(|s| &s.chains).filter(|c| !c.is_empty());
    let chains = match posted {
        Some(posted) => Cow::Borrowed(posted),
        None => Cow::Owned(timed(face, way)),
    };
    let all = strokes(&face.plan.case, way, wanted.moving.then_some(&*chains));
    let mut picture =
        Picture { id: format!("{}-{id}", face.id), title: title.to_owned(), ..Picture::default() };
    let turned = PictureFrame::turned(way.angle.unwrap_or(0.0), face.plan.left_hand);
    let window = window(face, way, &turned);
    let left = room_left(["-123.4"]);
    let (frame, height) = turned.fitted(&window, [left, ROOM], [WIDTH - left - ROOM, HEIGHT]);
    let plot = plot(&frame, &window, left, height);
    picture.size = [WIDTH, ROOM + height + BELOW];
    let axes = match way.angle {
        Some(_) => "mm, the part turned so that the feed runs to the right",
        None => "mm, the part as drawn",
    };
    let ticks = [Ticks::new(plot.x[0], plot.x[1], 7), Ticks::new(plot.y[0], plot.y[1], 6)];
    plot.axes(&mut picture, &ticks[0], &ticks[1], axes);
    put_face(&mut picture, face, &frame);
    let mut words = Labels::new([left, ROOM, WIDTH - ROOM, ROOM + height]);
    if let Some(p) = way.placement() {
        // The centre line.
        let [_, y] = frame.of_turned(DVec2::new(0.0, p.offset));
        words.keep_off([left, y - 1.0, WIDTH, y + 1.0]);
    }
    let positions = positions(face, way, wanted);
    for (i, position) in positions.iter().enumerate() {
        tooth(&mut picture, face, way, position, &frame);
        if i == positions.len() / 2 {
            picture.circle(
                looks::CUTTER,
                frame.of_turned(DVec2::from_array(position.centre)),
                face.plan.case.radius * frame.scale(),
            );
        }
    }
    put_strokes(&mut picture, face, &frame, &all);
    picture.legend = legend(&all, !positions.is_empty());
    if let Some(simulated) = wanted.simulated {
        put_dots(&mut picture, face, &frame, &simulated.dots);
        picture.notes.push("Beside the edge: exits as simulated, where the posted text first brings the cutter to the walls of the stock.".to_owned());
    }
    put_way(&mut picture, way, &frame, &plot);
    plot.border(&mut picture);
    weights(&mut picture, face, &frame, &mut words);
    for position in &positions {
        exit_angles(&mut picture, face, position, &frame, &mut words);
    }
    if wanted.moving {
        let motion = motion(&chains, &frame, face.plan.case.radius);
        picture.motion =
            Some(PictureMotion { program: posted.and(wanted.simulated).map(|s| s.program), ..motion });
    }
    picture.about = about(face, way);
    picture.summary = format!(
        "{title}: plan view of the outline. Bad exits on {} mm, exits on {} mm, entries on {} mm. {}.",
        fixed(way.bad, 3),
        fixed(way.burr.exits, 1),
        fixed(way.burr.entries, 1),
        picture.about
    );
    picture
}

/// The way, in short.
fn about(face: &MilledFace<'_>, way: &MillingWay) -> String {
    match way.placement().map(|p| face.seen(p)) {
        Some(p) => format!(
            "bad length {} mm, turned by {}\u{b0}, centre line at Y {}",
            fixed(way.bad, 3),
            fixed(super::tables::turn(p.angle), 3),
            fixed(p.offset, 3)
        ),
        None => format!("bad length {} mm, {}", fixed(way.bad, 3), way.name),
    }
}

fn window(face: &MilledFace<'_>, way: &MillingWay, turned: &PictureFrame) -> Window {
    let mut window = Window::EMPTY;
    window.grow_edges(face.plan.case.outline.edges(), turned);
    let radius = face.plan.case.radius;
    match way.placement().map(|p| face.seen(p)) {
        Some(p) => {
            let (a, b) = (window.min.x - BESIDE * radius, window.max.x + BESIDE * radius);
            window.grow(DVec2::new(a, p.offset - radius));
            window.grow(DVec2::new(b, p.offset + radius));
        }
        None => {
            for chain in &way.path.chains {
                window.grow_edges(chain, turned);
            }
        }
    }
    let room = 0.02 * window.size().max_element();
    Window { min: window.min - room, max: window.max + room }
}

/// The plot area around a frame that was fitted.
fn plot(frame: &PictureFrame, window: &Window, left: f64, height: f64) -> Plot {
    let width = WIDTH - left - ROOM;
    let [x0, _] = frame.px(window.min);
    let scale = frame.scale();
    let x = [window.min.x - (x0 - left) / scale, window.min.x + (left + width - x0) / scale];
    Plot { corner: [left, ROOM], size: [width, height], x, y: [window.min.y, window.max.y] }
}

/// The material.
pub(super) fn put_face(picture: &mut Picture, face: &MilledFace<'_>, frame: &PictureFrame) {
    let outline = &face.plan.case.outline;
    let mut d = String::new();
    for one in outline.loops() {
        for (i, edge) in outline.edges()[one.edges.clone()].iter().enumerate() {
            if i == 0 {
                let [x, y] = frame.at(edge.start);
                d += &format!("M{} {}", px(x), px(y));
            }
            edge_on(&mut d, frame, edge, 0.0, 1.0);
        }
        d.push('Z');
    }
    picture.path(looks::FACE, d.clone());
    picture.path(looks::EDGE, d);
}

/// The outline in its strokes.
pub(super) fn put_strokes(
    picture: &mut Picture,
    face: &MilledFace<'_>,
    frame: &PictureFrame,
    all: &[Stroke],
) {
    let edges = face.plan.case.outline.edges();
    for stroke in all {
        let Some(edge) = edges.get(stroke.edge) else { continue };
        let d = edge_path(frame, edge, stroke.from, stroke.to);
        picture.shapes.push(Shape::Path { ink: stroke.kind.ink(), d, from: stroke.met });
    }
}

/// The way of the cutter's centre with arrows, links between chains.
pub(super) fn put_way(picture: &mut Picture, way: &MillingWay, frame: &PictureFrame, plot: &Plot) {
    let window =
        [plot.corner[0], plot.corner[1], plot.corner[0] + plot.size[0], plot.corner[1] + plot.size[1]];
    let inside =
        |p: [f64; 2]| p[0] >= window[0] && p[0] <= window[2] && p[1] >= window[1] && p[1] <= window[3];
    let links: String =
        way.path.links().map(|[a, b]| edge_path(frame, &OutlineEdge::line(a, b), 0.0, 1.0)).collect();
    picture.path(looks::LINK, links);
    let (mut d, mut heads) = (String::new(), String::new());
    for chain in &way.path.chains {
        for piece in chain {
            // Straight pieces end at the border of the window; others lie within it.
            let (from, to) = if piece.turn.is_none() {
                within(frame.at(piece.start), frame.at(piece.end), window)
            } else {
                (0.0, 1.0)
            };
            if to > from {
                d += &edge_path(frame, piece, from, to);
            }
            if piece.length() * (to - from) * frame.scale() > 60.0 {
                let s = from + 0.9 * (to - from);
                let at = frame.at(piece.at(s));
                if inside(at) {
                    let along = frame.along(DVec2::from_angle(piece.heading(s)));
                    heads += &head(DVec2::from_array(at) + 5.0 * along, along, HEAD);
                }
            }
        }
    }
    picture.path(looks::CENTRE, d);
    picture.path(looks::ARROW, heads);
}

/// The shares between which a straight line lies in a window.
fn within(a: [f64; 2], b: [f64; 2], window: [f64; 4]) -> (f64, f64) {
    let (mut from, mut to) = (0.0, 1.0);
    for k in 0..2 {
        let way = b[k] - a[k];
        if way == 0.0 {
            continue;
        }
        let (s, t) = ((window[k] - a[k]) / way, (window[k + 2] - a[k]) / way);
        from = f64::max(from, s.min(t));
        to = f64::min(to, s.max(t));
    }
    (from, to)
}

/// Places of the cutter of one straight pass.
fn positions(face: &MilledFace<'_>, way: &MillingWay, wanted: &Wanted<'_>) -> Vec<CutterPosition> {
    let Some(placement) = way.placement().filter(|_| wanted.teeth) else { return Vec::new() };
    let all = pictures(&face.plan.case, &[placement], TEETH);
    all.into_iter().flat_map(|p| p.positions).collect()
}

/// The way of a tooth through the material at one place of the cutter.
pub(super) fn tooth(
    picture: &mut Picture,
    face: &MilledFace<'_>,
    way: &MillingWay,
    position: &CutterPosition,
    frame: &PictureFrame,
) {
    let Some(placement) = way.placement() else { return };
    let (case, centre) = (&face.plan.case, DVec2::from_array(position.centre));
    let polar = |p: &[f64; 2]| (DVec2::from_array(*p) - centre).to_angle();
    let mut cuts: Vec<f64> = position.crossings.iter().map(|c| polar(&c.point)).collect();
    cuts.extend([-FRAC_PI_2, 0.0, FRAC_PI_2]);
    cuts.sort_by(f64::total_cmp);
    let on = |a: f64| centre + case.radius * DVec2::from_angle(a);
    let radius = px(case.radius * frame.scale());
    let mut d = String::new();
    for w in cuts.windows(2) {
        let inside = case.outline.contains(placement.in_part(on(0.5 * (w[0] + w[1]))));
        if !inside || w[1] - w[0] < 1e-6 {
            continue;
        }
        // A tooth of an M3 spindle goes clockwise.
        let ([x0, y0], [x1, y1]) = (frame.of_turned(on(w[1])), frame.of_turned(on(w[0])));
        let flag = u8::from(!frame.flipped());
        d += &format!("M{} {}A{radius} {radius} 0 0 {flag} {} {}", px(x0), px(y0), px(x1), px(y1));
    }
    picture.path(looks::TOOTH, d);
}

/// The exit angles of the teeth at one place of the cutter.
pub(super) fn exit_angles(
    picture: &mut Picture,
    face: &MilledFace<'_>,
    position: &CutterPosition,
    frame: &PictureFrame,
    words: &mut Labels,
) {
    /// From the crossing to the middle of its word [px].
    const AWAY: f64 = 17.0;
    let centre = DVec2::from_array(position.centre);
    for crossing in &position.crossings {
        if !(crossing.exit_angle > 0.0 && crossing.exit_angle < PI) {
            continue;
        }
        let point = DVec2::from_array(crossing.point);
        // The outward normal is the direction of the tooth less the exit angle.
        let normal = DVec2::from_angle((point - centre).to_angle() - crossing.exit_angle);
        let at = frame.of_turned(point);
        let beside = DVec2::from_array(frame.of_turned(point + normal)) - DVec2::from_array(at);
        let at = DVec2::from_array(at) + AWAY * beside.normalize_or_zero();
        let text = format!("{}\u{b0}", fixed(crossing.exit_angle.to_degrees(), 0));
        if words.put(picture, &text, [at.to_array()]) {
            let ink = if crossing.weight > 0.0 && face.plan.case.weights.get(crossing.edge) != Some(&0.0) {
                looks::BAD_EXIT
            } else {
                looks::POINT
            };
            picture.circle(ink, frame.of_turned(point), 2.2);
        }
    }
}

/// Weights of edges other than 1: once for each label, at its longest edge.
fn weights(picture: &mut Picture, face: &MilledFace<'_>, frame: &PictureFrame, words: &mut Labels) {
    let case = &face.plan.case;
    let mut said: Vec<(u32, f64)> = Vec::new();
    let mut order: Vec<usize> = (0..case.weights.len()).filter(|&i| case.weights[i] != 1.0).collect();
    let edges = case.outline.edges();
    order.sort_by(|&a, &b| edges[b].length().total_cmp(&edges[a].length()));
    for i in order {
        let (edge, weight) = (&edges[i], case.weights[i]);
        if said.contains(&(edge.label, weight)) {
            continue;
        }
        let name = case.outline.label(i).map(|l| format!(" {l}")).unwrap_or_default();
        let text = format!("\u{d7}{}{name}", super::tables::trimmed(weight));
        let out = frame.along(DVec2::from_angle(edge.outward(0.5)));
        // Wide words must not reach back over the edge.
        let half = 0.5 * width(&text);
        let at = DVec2::from_array(frame.at(edge.at(0.5))) + (12.0 + half * out.x.abs()) * out;
        if words.put(picture, &text, [at.to_array()]) {
            said.push((edge.label, weight));
        }
    }
}

fn motion(chains: &Timed, frame: &PictureFrame, radius: f64) -> PictureMotion {
    let place = |(p, t): &(DVec2, f64)| {
        let [x, y] = frame.at(*p);
        [x, y, *t]
    };
    PictureMotion {
        way: chains.iter().flatten().map(place).collect(),
        radius: radius * frame.scale(),
        program: None,
    }
}

fn legend(all: &[Stroke], teeth: bool) -> Vec<(Ink, String)> {
    let used = |k: &Kind| all.iter().any(|s| s.kind == *k);
    let mut legend: Vec<(Ink, String)> =
        Kind::ALL.iter().rev().filter(|k| used(k)).map(|k| (k.ink(), k.word().to_owned())).collect();
    legend.push((looks::CENTRE, "way of the cutter\u{2019}s centre".to_owned()));
    if teeth {
        legend.push((looks::TOOTH, "teeth on their way, with their exit angles".to_owned()));
    }
    legend
}
