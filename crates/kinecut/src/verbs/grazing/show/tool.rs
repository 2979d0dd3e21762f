//! The tool with its grazing curve: what enters and what leaves, the visible part of the curve solid, the hidden one dashed,
//! velocities of the tip and of the top.

use std::f64::consts::TAU;

use glam::{DVec2, DVec3};

use super::bands::{Band, Strip, strips};
use super::hidden::Hiding;
use super::view::{extent, fitted};
use super::{kind_number, kind_words, kinds, looks};
use crate::page::draw::{View, head, line, triad};
use crate::page::{Ink, Picture};
use crate::sweep::ProfileChain;
use crate::verbs::grazing::GrazingSheet;

/// Size of the picture [px].
const SIZE: [f64; 2] = [440.0, 440.0];
/// Room around the tool for arrows and words [px].
const ROOM: f64 = 42.0;
/// Columns of the surface about the axis.
const COLUMNS: usize = 60;
/// Error of a drawn curve, and of a border of the surface, on which a curve lies [px].
const ERROR: f64 = 0.15;
const BORDER_ERROR: f64 = 0.8;
/// Least parts of a span, for the change from seen to hidden.
const PARTS: usize = 24;
/// Length of the longest arrow, and of its head [px].
const ARROW: [f64; 2] = [92.0, 10.0];
/// Length of the arms of the coordinates [px].
const ARM: f64 = 22.0;

/// The picture.
pub(crate) fn figure(sheet: &GrazingSheet, id: &str, title: &str) -> Picture {
    let view = fitted(sheet, [ROOM, ROOM, SIZE[0] - 2.0 * ROOM, SIZE[1] - 2.0 * ROOM]);
    let hiding = Hiding::new(sheet, view.viewer);
    let mut picture = Picture {
        id: id.to_owned(),
        title: title.to_owned(),
        about: "seen from the side of the motion, a little from below; hidden parts dashed".to_owned(),
        size: SIZE,
        ..Picture::default()
    };
    picture.legend =
        vec![(looks::entering(2), "enters".to_owned()), (looks::leaving(2), "leaves".to_owned())];
    let named = kinds(&sheet.grazing).into_iter();
    picture.legend.extend(named.map(|k| (looks::segment(kind_number(k)), kind_words(k).to_owned())));
    let degenerate = !(sheet.grazing.circles.is_empty() && sheet.grazing.whole.is_empty());
    if degenerate {
        picture.legend.push((looks::WHOLE, "grazes as a whole".to_owned()));
    }
    picture.legend.push((looks::FOLD, "fold".to_owned()));
    picture.summary = format!("The tool with its grazing curve, {} closed curves.", sheet.loops.len());
    surface(sheet, &view, &mut picture);
    outline(sheet, &view, &hiding, &mut picture);
    axis(sheet, &view, &mut picture);
    for &(piece, u) in &sheet.grazing.circles {
        ring(sheet, &view, &hiding, (piece, u), [looks::WHOLE, looks::HIDDEN_WHOLE], &mut picture);
    }
    for &piece in &sheet.grazing.whole {
        for u in ends(&sheet.chain, piece) {
            ring(sheet, &view, &hiding, (piece, u), [looks::WHOLE, looks::HIDDEN_WHOLE], &mut picture);
        }
    }
    curve(sheet, &view, &hiding, &mut picture);
    arrows(sheet, &view, &mut picture);
    triad(&mut picture, &view, DVec2::new(ARM + 10.0, SIZE[1] - ARM - 10.0), ARM);
    picture
}

fn ends(chain: &ProfileChain, piece: usize) -> [f64; 2] {
    let p = &chain.pieces()[piece];
    [p.from, p.to]
}

fn on_circle(x: f64, z: f64, theta: f64) -> DVec3 {
    let (sin, cos) = theta.sin_cos();
    DVec3::new(x * cos, x * sin, z)
}

/// The surface that faces the viewer, from the top of the chain to its bottom: seen from below what comes earlier is nearer.
fn surface(sheet: &GrazingSheet, view: &View, picture: &mut Picture) {
    for (index, _) in sheet.chain.pieces().iter().enumerate().rev().filter(|p| !p.1.is_fan()) {
        for strip in strips(sheet, index, view.mm(BORDER_ERROR)).iter().rev() {
            patches(sheet, view, strip, picture);
        }
    }
}

/// A border between two columns of a strip: its angles at the start and at the end.
type Border = [f64; 2];

fn patches(sheet: &GrazingSheet, view: &View, strip: &Strip, picture: &mut Picture) {
    let piece = &sheet.chain.pieces()[strip.piece];
    let rings = strip.u.map(|u| piece.point(u));
    let middle = 0.5 * (strip.u[0] + strip.u[1]);
    let normal = piece.normal(middle);
    let mut borders: Vec<Border> = (0..COLUMNS).map(|i| [TAU * i as f64 / COLUMNS as f64; 2]).collect();
    if let Band::Part(bands) = strip.band {
        borders.extend([0, 1].map(|k| wrapped([bands[0][k], bands[1][k]])));
    }
    // Angles at which the surface turns away from the viewer.
    let flat = view.viewer.truncate().length();
    let share = -normal.y * view.viewer.z / (normal.x * flat);
    if share.abs() < 1.0 {
        let azimuth = view.viewer.y.atan2(view.viewer.x);
        borders.extend([share.acos(), -share.acos()].map(|b| wrapped([azimuth + b; 2])));
    }
    borders.sort_by(|a, b| (a[0] + a[1]).total_cmp(&(b[0] + b[1])));
    let first = borders[0];
    borders.push(first.map(|a| a + TAU));
    let look = |pair: &[Border]| -> Option<Ink> {
        let theta = 0.25 * (pair[0][0] + pair[0][1] + pair[1][0] + pair[1][1]);
        let normal = on_circle(normal.x, normal.y, theta);
        if normal.dot(view.viewer) <= 0.0 {
            return None;
        }
        let enters = match strip.band {
            Band::Leaves => false,
            Band::Enters => true,
            Band::Part(b) => {
                let (low, high) = (0.5 * (b[0][0] + b[1][0]), 0.5 * (b[0][1] + b[1][1]));
                (theta - low).rem_euclid(TAU) < high - low
            }
        };
        let shade = view.shade(normal);
        Some(if enters { looks::entering(shade) } else { looks::leaving(shade) })
    };
    let mut run: Vec<Border> = Vec::new();
    let mut ink = None;
    let mut close = |run: &mut Vec<Border>, ink: Option<Ink>| {
        if let (Some(ink), true) = (ink, run.len() > 1) {
            let there = run.iter().map(|b| on_circle(rings[0].x, rings[0].y, b[0]));
            let back = run.iter().rev().map(|b| on_circle(rings[1].x, rings[1].y, b[1]));
            picture.path(ink, line(there.chain(back).map(|p| view.px(p))) + "Z");
        }
        run.clear();
    };
    for pair in borders.windows(2) {
        let next = look(pair);
        if next != ink || run.is_empty() {
            close(&mut run, ink);
            ink = next;
            run.push(pair[0]);
        }
        run.push(pair[1]);
    }
    close(&mut run, ink);
}

/// A border within the first turn by its mean.
fn wrapped(border: Border) -> Border {
    let turns = (0.5 * (border[0] + border[1]) / TAU).floor();
    border.map(|a| a - turns * TAU)
}

/// The outline is the grazing curve of a motion to the viewer; edges are circles.
fn outline(sheet: &GrazingSheet, view: &View, hiding: &Hiding, picture: &mut Picture) {
    let to_viewer = crate::machine::Twist::translation(view.viewer);
    let grazing = sheet.chain.grazing(&to_viewer);
    for span in &grazing.spans {
        if sheet.chain.pieces()[span.piece].is_fan() {
            continue;
        }
        for branch in 0..2 {
            let at = |t: f64| sheet.chain.grazing_points(span, t)[branch];
            let parts = sheet.chain.parts(span, view.mm(ERROR));
            let seen = |t: f64| {
                let p = at(t);
                hiding.is_free(p.point + p.normal * view.mm(1.0))
            };
            let points: Vec<_> = dense(&parts).into_iter().map(|t| (at(t).point, t)).collect();
            stretches(&points, view, seen, |seen, d| {
                if seen {
                    picture.path(looks::OUTLINE, d);
                }
            });
        }
    }
    for (index, piece) in sheet.chain.pieces().iter().enumerate() {
        if piece.is_fan() && piece.point(piece.from).x > 0.0 {
            ring(sheet, view, hiding, (index, piece.from), [looks::OUTLINE, looks::AXIS], picture);
        }
    }
}

/// A parallel circle; a hidden part of an outline is left out.
fn ring(
    sheet: &GrazingSheet,
    view: &View,
    hiding: &Hiding,
    (index, u): (usize, f64),
    inks: [Ink; 2],
    picture: &mut Picture,
) {
    let piece = &sheet.chain.pieces()[index];
    let p = piece.point(u);
    if p.x <= 0.0 {
        return;
    }
    // On an edge either of its faces may be seen.
    let normals = [piece.from, 0.5 * (piece.from + piece.to), piece.to].map(|u| piece.normal(u));
    let points: Vec<(DVec3, f64)> = (0..=2 * COLUMNS)
        .map(|i| TAU * i as f64 / (2 * COLUMNS) as f64)
        .map(|theta| (on_circle(p.x, p.y, theta), theta))
        .collect();
    let seen = |theta: f64| {
        let at = on_circle(p.x, p.y, theta);
        let own = piece.normal(u);
        let mut faces = if piece.is_fan() { normals.to_vec() } else { vec![own] };
        faces.dedup();
        faces.iter().any(|n| hiding.sees(at, on_circle(n.x, n.y, theta)))
    };
    stretches(&points, view, seen, |seen, d| match seen {
        true => picture.path(inks[0], d),
        false if inks[1] != looks::AXIS => picture.path(inks[1], d),
        false => {}
    });
}

/// The grazing curves with their folds.
fn curve(sheet: &GrazingSheet, view: &View, hiding: &Hiding, picture: &mut Picture) {
    let mut folds = Vec::new();
    for span in &sheet.grazing.spans {
        let piece = &sheet.chain.pieces()[span.piece];
        let number = kind_number(span.kind);
        let ts = dense(&sheet.chain.parts(span, view.mm(ERROR)));
        for branch in 0..2 {
            let at = |t: f64| sheet.chain.grazing_points(span, t)[branch];
            let seen = |t: f64| {
                let p = at(t);
                if !piece.is_fan() {
                    return hiding.sees(p.point, p.normal);
                }
                let theta = p.theta();
                [piece.from, p.u, piece.to].iter().any(|&u| {
                    let n = piece.normal(u);
                    hiding.sees(p.point, on_circle(n.x, n.y, theta))
                })
            };
            let points: Vec<(DVec3, f64)> = ts.iter().map(|&t| (at(t).point, t)).collect();
            stretches(&points, view, seen, |seen, d| {
                picture.path(if seen { looks::segment(number) } else { looks::hidden_segment(number) }, d);
            });
        }
        for (fold, t) in [(span.folds[0], 0.0), (span.folds[1], 1.0)] {
            let p = sheet.chain.grazing_points(span, t)[0];
            if fold && p.point.truncate().length_squared() > 0.0 {
                folds.push(view.px(p.point));
            }
        }
    }
    folds.into_iter().for_each(|at| picture.circle(looks::FOLD, at, 3.2));
}

/// Parameters with more between where they are few.
fn dense(parts: &[f64]) -> Vec<f64> {
    let between = (PARTS / parts.len().max(1)).max(1);
    let mut all = Vec::with_capacity(parts.len() * between + 1);
    for pair in parts.windows(2) {
        all.extend((0..between).map(|k| pair[0] + (pair[1] - pair[0]) * k as f64 / between as f64));
    }
    all.extend(parts.last());
    all
}

/// A line cut into what is seen and what is hidden, by the middles of its legs; single legs do not flicker.
pub(crate) fn stretches(
    points: &[(DVec3, f64)],
    view: &View,
    seen: impl Fn(f64) -> bool,
    mut put: impl FnMut(bool, String),
) {
    let mut flags: Vec<bool> = points.windows(2).map(|p| seen(0.5 * (p[0].1 + p[1].1))).collect();
    for i in 1..flags.len().saturating_sub(1) {
        if flags[i - 1] == flags[i + 1] {
            flags[i] = flags[i - 1];
        }
    }
    let mut start = 0;
    for i in 1..=flags.len() {
        if i < flags.len() && flags[i] == flags[start] {
            continue;
        }
        put(flags[start], line(points[start..=i].iter().map(|p| view.px(p.0))));
        start = i;
    }
}

fn axis(sheet: &GrazingSheet, view: &View, picture: &mut Picture) {
    let [_, low, high] = extent(sheet);
    let beyond = 0.08 * (high - low);
    let ends = [low - beyond, high + beyond].map(|z| view.px(DVec3::new(0.0, 0.0, z)));
    picture.path(looks::AXIS, line(ends));
}

/// Velocities at both ends of the axis, the faster one at full length.
fn arrows(sheet: &GrazingSheet, view: &View, picture: &mut Picture) {
    let [_, low, high] = extent(sheet);
    let places = [low, high].map(|z| DVec3::new(0.0, 0.0, z));
    let velocities = places.map(|p| sheet.twist.velocity(p));
    let most = velocities.iter().map(|v| v.length()).fold(0.0, f64::max);
    if most <= 0.0 {
        return;
    }
    for (place, v) in places.into_iter().zip(velocities) {
        let on_paper = view.turned(v / most) * ARROW[0];
        let from = DVec2::from(view.px(place));
        let Some(along) = on_paper.try_normalize().filter(|_| on_paper.length() > ARROW[1]) else { continue };
        let tip = from + on_paper;
        picture.path(looks::ARROW, line([from, tip - along * ARROW[1]].map(|p| p.to_array())));
        picture.path(looks::HEAD, head(tip, along, [ARROW[1], 0.38 * ARROW[1]]));
    }
}
