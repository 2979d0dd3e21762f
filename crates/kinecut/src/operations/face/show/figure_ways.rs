//! The paths of the ways, small, with what they leave.

use super::figure_plan::{put_face, put_strokes, put_way};
use super::frame::{PictureFrame, Window};
use super::strokes::{Kind, strokes};
use super::{MilledFace, looks};
use crate::page::draw::{CHARACTER, Plot};
use crate::page::{Anchor, Picture, fixed};

/// Paths side by side, and most of them.
const ACROSS: usize = 3;
const MOST: usize = 6;
/// Width of all, of the space between them, and their greatest height [px].
const WIDTH: f64 = 720.0;
const SPACE: f64 = 14.0;
const HEIGHT: f64 = 220.0;
/// Room above each for three lines [px].
const ABOVE: f64 = 48.0;

/// The ways drawn: the chosen one, the unbeaten ones, then others by time.
fn drawn(face: &MilledFace<'_>) -> Vec<usize> {
    let ways = &face.plan.ways;
    let mut order: Vec<usize> = (0..ways.len()).collect();
    order.sort_by_key(|&i| (i != face.plan.chosen, !ways[i].unbeaten));
    order.truncate(MOST);
    order.sort_unstable();
    order
}

/// The ways side by side; none where there is but one.
pub(super) fn ways_picture(face: &MilledFace<'_>) -> Option<Picture> {
    let ways = &face.plan.ways;
    if ways.len() < 2 {
        return None;
    }
    let mut picture = Picture {
        id: format!("{}-ways", face.id),
        title: "Ways over the face".to_owned(),
        about: "numbers as in the table; each as its feed lies best".to_owned(),
        legend: vec![
            (looks::BAD_EXIT, Kind::Bad.word().to_owned()),
            (looks::CENTRE, "way of the cutter\u{2019}s centre".to_owned()),
            (looks::LINK, "rapid".to_owned()),
        ],
        ..Picture::default()
    };
    let shown = drawn(face);
    let cell = (WIDTH - SPACE * (ACROSS - 1) as f64) / ACROSS as f64;
    let mut top = 0.0;
    for row in shown.chunks(ACROSS) {
        let mut tallest = 0.0;
        for (column, &i) in row.iter().enumerate() {
            let way = &ways[i];
            let turned = PictureFrame::turned(way.angle.unwrap_or(0.0), face.plan.left_hand);
            let mut window = Window::EMPTY;
            window.grow_edges(face.plan.case.outline.edges(), &turned);
            for chain in &way.path.chains {
                window.grow_edges(chain, &turned);
            }
            let room = 0.03 * window.size().max_element();
            let window = Window { min: window.min - room, max: window.max + room };
            let corner = [column as f64 * (cell + SPACE), top + ABOVE];
            let (frame, high) = turned.fitted(&window, corner, [cell, HEIGHT]);
            tallest = f64::max(tallest, high);
            put_face(&mut picture, face, &frame);
            let all = strokes(&face.plan.case, way, None);
            let bad: Vec<_> =
                all.into_iter().filter(|s| s.kind == Kind::Bad || s.kind == Kind::Unmet).collect();
            put_strokes(&mut picture, face, &frame, &bad);
            let plot = Plot { corner, size: [cell, high], x: [0.0, 1.0], y: [0.0, 1.0] };
            put_way(&mut picture, way, &frame, &plot);
            let mark = if i == face.plan.chosen { "\u{25cf} " } else { "" };
            let lines = lines(&format!("{mark}{}: {}", i + 1, way.name), (cell / CHARACTER) as usize);
            for (k, line) in lines.into_iter().enumerate() {
                picture.word([corner[0], top + 13.0 + 14.0 * k as f64], Anchor::Start, line);
            }
            let price = format!("{} mm bad, {} s", fixed(way.bad, 2), fixed(way.time, 1));
            picture.tick([corner[0], top + 41.0], Anchor::Start, price);
        }
        top += ABOVE + tallest + SPACE;
    }
    picture.size = [WIDTH, top];
    picture.summary = format!("The paths of {} ways over the face.", shown.len());
    if shown.len() < ways.len() {
        picture.notes.push(format!("{} more ways are in the table.", ways.len() - shown.len()));
    }
    Some(picture)
}

/// A name in two lines of so many characters; what is more is left out.
fn lines(name: &str, most: usize) -> Vec<String> {
    let mut lines = vec![String::new()];
    for word in name.split_whitespace() {
        let here = lines.len() - 1;
        let room = most.saturating_sub(lines[here].chars().count() + 1);
        if word.chars().count() <= room || lines[here].is_empty() {
            if !lines[here].is_empty() {
                lines[here].push(' ');
            }
            lines[here].extend(word.chars().take(most));
        } else if lines.len() < 2 {
            lines.push(word.chars().take(most).collect());
        } else {
            lines[here].push('\u{2026}');
            break;
        }
    }
    lines
}
