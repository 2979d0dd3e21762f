//! The picture: what is swept, with the tool at both ends, grazing curves at a few moments, and cusps.

use glam::{DVec2, DVec3};

use super::looks;
use super::parts::EnvelopePart;
use super::scene::Scene;
use crate::base::Result;
use crate::machine::Twist;
use crate::page::draw::{line, put_faces, triad};
use crate::page::{Ink, Picture};
use crate::verbs::envelope::EnvelopeSheet;
use crate::verbs::grazing::show::{looks as tool_looks, stretches};

/// Size of the picture [px].
const SIZE: [f64; 2] = [512.0, 440.0];
/// Room around [px].
const ROOM: f64 = 24.0;
/// Moments whose grazing curves are drawn.
const CURVES: u32 = 6;
/// Error of a drawn curve [px].
const ERROR: f64 = 0.2;
/// Chords of a circle.
const ROUND: u32 = 72;
/// Length of the arms of the coordinates [px].
const ARM: f64 = 24.0;
/// Least distance of marked cusps on paper [px].
const APART: f64 = 6.0;

/// The picture of a sheet.
pub(crate) fn figure(sheet: &EnvelopeSheet, id: &str) -> Result<Picture> {
    let scene = Scene::new(sheet, [ROOM, ROOM, SIZE[0] - 2.0 * ROOM, SIZE[1] - 2.0 * ROOM])?;
    let mut picture = Picture {
        id: id.to_owned(),
        title: "The swept volume".to_owned(),
        about: "seen from the side of the move; hidden curves dashed".to_owned(),
        summary: "The body that the tool sweeps, with grazing curves and the tool at both ends.".to_owned(),
        size: SIZE,
        ..Picture::default()
    };
    picture.legend = vec![
        (Ink::Face(looks::tint(EnvelopePart::Start), 2), "tool at the start, what leaves".to_owned()),
        (Ink::Face(looks::tint(EnvelopePart::End), 2), "tool at the end, what enters".to_owned()),
        (Ink::Face(looks::tint(EnvelopePart::Wall), 2), "wall traced by grazing curves".to_owned()),
    ];
    if scene.pieces.iter().any(|p| scene.labels[p.body] == EnvelopePart::Inside) {
        picture.legend.push((
            Ink::Face(looks::tint(EnvelopePart::Inside), 2),
            "wall that lies inside (F_tt < 0)".to_owned(),
        ));
    }
    picture.legend.push((looks::CURVE, "grazing curves".to_owned()));
    picture.legend.push((looks::PHANTOM, "outline of the tool at both ends".to_owned()));
    put_faces(&mut picture, &scene.view, scene.pieces.clone(), |face| looks::tint(scene.labels[face]));
    curves(sheet, &scene, &mut picture);
    for t in [0.0, 1.0] {
        outline(sheet, &scene, t, &mut picture);
    }
    if !sheet.cusps.is_empty() {
        picture.legend.push((tool_looks::FOLD, "cusps".to_owned()));
        cusps(sheet, &scene, &mut picture);
    }
    triad(&mut picture, &scene.view, DVec2::new(ARM + 12.0, SIZE[1] - ARM - 10.0), ARM);
    Ok(picture)
}

/// Grazing curves at a few moments.
fn curves(sheet: &EnvelopeSheet, scene: &Scene, picture: &mut Picture) {
    for k in 0..=CURVES {
        let jet = sheet.motion.at(f64::from(k) / f64::from(CURVES));
        let grazing = sheet.chain.grazing(&jet.twist);
        for of in &grazing.loops {
            let on_tool = sheet.chain.curve(&grazing, of, scene.view.mm(ERROR));
            let points: Vec<(DVec3, f64)> =
                on_tool.iter().enumerate().map(|(i, p)| (jet.pose.point(p.point), i as f64)).collect();
            let seen = |at: f64| {
                let i = at as usize;
                let (Some(a), Some(b)) = (points.get(i), points.get(i + 1)) else { return false };
                !scene.cover.hides(0.5 * (a.0 + b.0))
            };
            stretches(&points, &scene.view, seen, |seen, d| {
                picture.path(if seen { looks::CURVE } else { looks::HIDDEN_CURVE }, d);
            });
        }
    }
}

/// The outline of the tool at a moment: the grazing curve of a motion to the viewer, and its edges.
fn outline(sheet: &EnvelopeSheet, scene: &Scene, t: f64, picture: &mut Picture) {
    let pose = sheet.motion.pose(t);
    let viewer = pose.rotation.transpose() * scene.view.viewer;
    let grazing = sheet.chain.grazing(&Twist::translation(viewer));
    for span in grazing.spans.iter().filter(|s| !sheet.chain.pieces()[s.piece].is_fan()) {
        let parts = sheet.chain.parts(span, scene.view.mm(ERROR));
        for branch in 0..2 {
            let at = |&part: &f64| pose.point(sheet.chain.grazing_points(span, part)[branch].point);
            picture.path(looks::PHANTOM, line(parts.iter().map(at).map(|p| scene.view.px(p))));
        }
    }
    for piece in sheet.chain.pieces().iter().filter(|p| p.is_fan()) {
        let p = piece.point(piece.from);
        if p.x > 0.0 {
            let at = |i: u32| {
                let (sin, cos) = (std::f64::consts::TAU * f64::from(i) / f64::from(ROUND)).sin_cos();
                scene.view.px(pose.point(DVec3::new(p.x * cos, p.x * sin, p.y)))
            };
            picture.path(looks::PHANTOM, line((0..=ROUND).map(at)));
        }
    }
}

/// Cusps, as many as have room.
fn cusps(sheet: &EnvelopeSheet, scene: &Scene, picture: &mut Picture) {
    let mut marked: Vec<[f64; 2]> = Vec::new();
    for cusp in &sheet.cusps {
        let at = scene.view.px(cusp.point);
        let free = marked.iter().all(|m| (m[0] - at[0]).hypot(m[1] - at[1]) >= APART);
        if free {
            marked.push(at);
            picture.circle(tool_looks::FOLD, at, 2.2);
        }
    }
}
