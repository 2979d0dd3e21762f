//! The cutter at places on its way, each with the exit angles there (figure 4 of Kryzhanivskyi and Kryzhanivska 2011).

use super::figure_plan::{exit_angles, put_face, tooth};
use super::frame::{PictureFrame, Window};
use super::{MilledFace, looks};
use crate::facing::{MillingWay, pictures};
use crate::page::draw::Labels;
use crate::page::{Anchor, Picture, fixed};

/// Pictures side by side, and rows of them.
const ACROSS: u32 = 3;
const DOWN: u32 = 2;
/// Width of all, of the space between them, and their greatest height [px].
const WIDTH: f64 = 720.0;
const SPACE: f64 = 14.0;
const HEIGHT: f64 = 230.0;
/// Room above each for its words [px].
const ABOVE: f64 = 18.0;

/// The series of one straight pass; none of another way.
pub(super) fn series(face: &MilledFace<'_>, way: &MillingWay) -> Option<Picture> {
    let placement = way.placement()?;
    // Some more than are shown: at the end of the way the front may have left already.
    let all = pictures(&face.plan.case, &[placement], 2 * ACROSS * DOWN).into_iter().next()?;
    let crossed: Vec<_> = all.positions.into_iter().filter(|p| !p.crossings.is_empty()).collect();
    let every = (crossed.len() as f64 / f64::from(ACROSS * DOWN)).max(1.0);
    let shown = (0..ACROSS * DOWN).filter_map(|k| crossed.get(((f64::from(k) + 0.5) * every) as usize));
    let shown: Vec<_> = shown.collect();
    let turned = PictureFrame::turned(placement.angle, face.plan.left_hand);
    let mut window = Window::EMPTY;
    window.grow_edges(face.plan.case.outline.edges(), &turned);
    // Angles are written next to the part.
    let room = 0.16 * window.size().max_element();
    let window = Window { min: window.min - room, max: window.max + room };
    let cell = (WIDTH - SPACE * f64::from(ACROSS - 1)) / f64::from(ACROSS);
    let mut picture = Picture {
        id: format!("{}-series", face.id),
        title: "The cutter on its way".to_owned(),
        about: "the front of its circle in the part, exit angles where teeth leave".to_owned(),
        legend: vec![
            (looks::TOOTH, "front of the cutter in the part".to_owned()),
            (looks::BAD_EXIT, "bad exit".to_owned()),
            (looks::POINT, "good exit".to_owned()),
        ],
        ..Picture::default()
    };
    let (_, high) = turned.fitted(&window, [0.0; 2], [cell, HEIGHT]);
    for (i, position) in shown.iter().enumerate() {
        let (column, row) = (i as u32 % ACROSS, i as u32 / ACROSS);
        let corner = [f64::from(column) * (cell + SPACE), f64::from(row) * (high + ABOVE + SPACE) + ABOVE];
        let (frame, _) = turned.fitted(&window, corner, [cell, HEIGHT]);
        put_face(&mut picture, face, &frame);
        tooth(&mut picture, face, way, position, &frame);
        let exits = position.crossings.iter().filter(|c| c.exit_angle > 0.0);
        let bad = exits.clone().filter(|c| c.weight > 0.0).count();
        picture.word(
            [corner[0] + 4.0, corner[1] - 5.0],
            Anchor::Start,
            format!("X {}: {} exits, {bad} bad", fixed(position.centre[0], 1), exits.count()),
        );
        let mut words = Labels::new([corner[0], corner[1], corner[0] + cell, corner[1] + high]);
        exit_angles(&mut picture, face, position, &frame, &mut words);
    }
    let rows = shown.len().div_ceil(ACROSS as usize) as f64;
    picture.size = [WIDTH, rows * (high + ABOVE + SPACE)];
    picture.summary = format!("{} places of the cutter on its way over the part.", shown.len());
    Some(picture)
}
