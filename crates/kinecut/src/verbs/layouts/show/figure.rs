//! A layout as a picture: bodies, ground, arrows, letters in columns beside.

use glam::DVec3;

use super::arrow::motion_arrows;
use super::bodies::{Bodies, Link, bodies};
use super::solid::Solid;
use crate::machine::CoordinateCode;
use crate::machine::layouts::{Attitude, Sizes};
use crate::page::draw::{Cover, FacePiece, View, arrow, line, put_faces, spread};
use crate::page::px;
use crate::page::{Anchor, Colour, Ink, Lettering, Picture, Shape, Width};

/// Room between the bodies and a column of letters [px].
const BESIDE: f64 = 16.0;
/// Width of a column of letters [px].
const COLUMN: f64 = 26.0;
/// Height of a letter [px].
const LINE: f64 = 19.0;
/// Room for hatching below and the bar of the scale [px].
const BELOW: f64 = 34.0;
/// Distance of hatching lines [px].
const HATCH: f64 = 7.0;
/// Points of an arrow that another place of it must show more.
const DEAR: usize = 10;
/// Distance by which a face must be nearer than a point of an arrow to hide it, by the size of the picture.
const OFF: f64 = 2e-3;
/// Receding lines.
const THIN: Ink = Ink::line(Colour::Quiet, Width::Hair);
/// Shafts of arrows.
pub(super) const SHAFT: Ink = Ink::line(Colour::Ink, Width::Middle);

/// The picture of a layout in a box: left, top, width, height [px].
pub(crate) fn put_layout(
    picture: &mut Picture,
    code: &CoordinateCode,
    attitude: Attitude,
    sizes: &Sizes,
    at: [f64; 4],
) {
    put(picture, &bodies(code, attitude, sizes), at);
}

/// The picture of bodies in a box: left, top, width, height [px].
pub(crate) fn put(picture: &mut Picture, made: &Bodies, at: [f64; 4]) {
    let frame = PaperFrame::new(&made.solids, at);
    let letters = letters(made, &frame);
    picture.path(THIN, ground(made, &frame));
    put_faces(picture, &frame.view, frame.pieces.clone(), |body| made.solids[body].tint);
    for letter in &letters {
        picture.path(THIN, letter.leader.clone());
        picture.circle(Ink::Area(Colour::Quiet), letter.from, 1.6);
    }
    for link in &made.links {
        arrow(picture, &free_arrow(link, made, &frame), SHAFT, Colour::Ink);
    }
    for letter in letters {
        let anchor = if letter.left { Anchor::End } else { Anchor::Start };
        let lettering = Lettering::Name(Colour::Ink);
        picture.shapes.push(Shape::Word { at: letter.at, anchor, text: letter.text, lettering });
    }
    scale_bar(picture, &frame);
}

/// The arrow of a link on paper with the least part hidden.
fn free_arrow(link: &Link, made: &Bodies, frame: &PaperFrame) -> Vec<[f64; 2]> {
    let mut ways = motion_arrows(link, &made.solids[link.body], &frame.view);
    let hidden = |way: &Vec<DVec3>| way.iter().filter(|p| frame.cover.hides(**p)).count();
    // Each further way must show that much more to be taken: the usual places are easier to read.
    let best = (0..ways.len()).min_by_key(|&i| hidden(&ways[i]) + DEAR * i);
    let way = best.map(|i| ways.swap_remove(i)).unwrap_or_default();
    way.into_iter().map(|p| frame.view.px(p)).collect()
}

/// The bodies on paper.
struct PaperFrame {
    view: View,
    /// Visible parts of them, body by body.
    pieces: Vec<FacePiece>,
    /// Their extent: left, right, top, bottom [px].
    extent: [f64; 4],
    at: [f64; 4],
    cover: Cover,
}

impl PaperFrame {
    fn new(solids: &[Solid], at: [f64; 4]) -> PaperFrame {
        let [left, top, width, height] = at;
        let (aside, room) = (COLUMN + BESIDE, height - BELOW - 8.0);
        let corners = solids.iter().flat_map(|s| s.facets.corners.iter().copied());
        let within = [left + aside, top + 4.0, width - 2.0 * aside, room];
        let view = View::isometric().fitting(corners, within);
        let mut extent = [f64::INFINITY, f64::NEG_INFINITY, f64::INFINITY, f64::NEG_INFINITY];
        for p in solids.iter().flat_map(|s| s.outline(&view)) {
            extent = [extent[0].min(p[0]), extent[1].max(p[0]), extent[2].min(p[1]), extent[3].max(p[1])];
        }
        let seen = |(body, solid): (usize, &Solid)| {
            let faces = solid.facets.seen(view.viewer).into_iter();
            faces.map(move |(_, face)| FacePiece { face, body }).collect::<Vec<_>>()
        };
        let pieces: Vec<FacePiece> = solids.iter().enumerate().flat_map(seen).collect();
        let cover = Cover::new(view, &pieces, OFF * view.mm(width));
        PaperFrame { view, pieces, extent, at, cover }
    }
}

/// A letter beside the picture.
struct Letter {
    text: String,
    left: bool,
    at: [f64; 2],
    from: [f64; 2],
    leader: String,
}

/// Letters of the links: those of the work on the left, those of the tool on the right, in the order of height, so that
/// no leader crosses another one.
fn letters(made: &Bodies, frame: &PaperFrame) -> Vec<Letter> {
    let mut all = Vec::new();
    for left in [true, false] {
        let mut side: Vec<([f64; 2], String)> = made
            .links
            .iter()
            .filter(|link| link.work == left)
            .map(|link| {
                let prime = if link.work { "\u{2032}" } else { "" };
                (edge(&made.solids[link.body], left, frame), format!("{}{prime}", link.motion.iso()))
            })
            .collect();
        side.sort_by(|a, b| a.0[1].total_cmp(&b.0[1]));
        let heights = spread(&side.iter().map(|s| (s.0[1], LINE)).collect::<Vec<_>>());
        let x = if left { frame.extent[0] - BESIDE } else { frame.extent[1] + BESIDE };
        for ((from, text), y) in side.into_iter().zip(heights) {
            let end = if left { x + 4.0 } else { x - 4.0 };
            let knee = if left { frame.extent[0] - 3.0 } else { frame.extent[1] + 3.0 };
            let leader = line([from, [knee, y], [end, y]]);
            all.push(Letter { text, left, at: [x, y + 5.0], from, leader });
        }
    }
    all
}

/// The place of a body where its leader begins: its leftmost or rightmost visible edge, half way up [px].
fn edge(body: &Solid, left: bool, frame: &PaperFrame) -> [f64; 2] {
    let outline: Vec<[f64; 2]> = body.outline(&frame.view).collect();
    let sign = if left { -1.0 } else { 1.0 };
    let most = outline.iter().map(|p| sign * p[0]).fold(f64::NEG_INFINITY, f64::max);
    // The edge: all points as far out as the farthest.
    let heights: Vec<f64> = outline.iter().filter(|p| sign * p[0] >= most - 1e-3).map(|p| p[1]).collect();
    let middle = heights.iter().sum::<f64>() / heights.len().max(1) as f64;
    [sign * most, middle]
}

/// Hatching below the lower edges of bodies on the ground.
fn ground(made: &Bodies, frame: &PaperFrame) -> String {
    let mut d = String::new();
    for &i in &made.ground {
        let [low, high] = made.solids[i].bounds();
        let corners = [[low[0], low[1], low[2]], [high[0], low[1], low[2]], [high[0], high[1], low[2]]];
        let corners = corners.map(|c| frame.view.px(DVec3::from(c)));
        for pair in corners.windows(2) {
            let length = (pair[1][0] - pair[0][0]).hypot(pair[1][1] - pair[0][1]);
            let count = (length / HATCH).floor() as usize;
            for n in 0..count {
                let t = (n as f64 + 0.5) / count as f64;
                let from = [0, 1].map(|k| pair[0][k] + t * (pair[1][k] - pair[0][k]));
                d.push_str(&line([from, [from[0] - 4.0, from[1] + 7.0]]));
            }
        }
    }
    d
}

/// A bar of a round length below the picture.
fn scale_bar(picture: &mut Picture, frame: &PaperFrame) {
    let [left, top, width, height] = frame.at;
    let most = frame.view.mm(0.3 * width);
    let power = 10f64.powf(most.log10().floor());
    let length = [5.0, 2.0, 1.0].into_iter().map(|f| f * power).find(|l| *l <= most).unwrap_or(power);
    let wide = length / frame.view.mm(1.0);
    let (x, y) = (left + 12.0, top + height - 10.0);
    let bar = line([[x, y - 3.0], [x, y + 3.0]])
        + &line([[x, y], [x + wide, y]])
        + &line([[x + wide, y - 3.0], [x + wide, y + 3.0]]);
    picture.path(Ink::line(Colour::Quiet, Width::Thin), bar);
    picture.tick([x + wide + 6.0, y + 4.0], Anchor::Start, format!("{} mm", px(length)));
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::machine::layouts::Search;

    /// A point that has no place in the picture.
    fn outside(p: [f64; 2], size: [f64; 2]) -> bool {
        !(p[0] >= 0.0 && p[0] <= size[0] && p[1] >= 0.0 && p[1] <= size[1])
    }

    #[test]
    fn every_layout_has_its_bodies_arrows_and_letters_inside_of_the_picture() {
        let size = [300.0, 260.0];
        let mut codes = Vec::new();
        for search in ["XYZ", "XYZC", "XYZAC", "XYZAB", "XYZCBn"] {
            codes.extend(Search::parse(search).unwrap().codes().unwrap());
        }
        for text in ["6031", "0", "10", "4012367"] {
            codes.push(CoordinateCode::parse(text).unwrap());
        }
        // Every 31st: orders and places of the bed mix.
        for code in codes.iter().step_by(31).chain(codes.iter().rev().take(4)) {
            for attitude in [Attitude::Vertical, Attitude::Horizontal] {
                let made = bodies(code, attitude, &Sizes::default());
                assert_eq!(made.links.len(), code.word().0.len(), "{code}");
                let frame = PaperFrame::new(&made.solids, [0.0, 0.0, size[0], size[1]]);
                for p in made.solids.iter().flat_map(|s| s.outline(&frame.view)) {
                    assert!(!outside(p, size), "{code} {attitude:?}");
                }
                for link in &made.links {
                    let arrow = free_arrow(link, &made, &frame);
                    assert!(arrow.len() > 1 && !arrow.iter().any(|p| outside(*p, size)), "{code} {link:?}");
                }
                let letters = letters(&made, &frame);
                for (i, a) in letters.iter().enumerate() {
                    let clear = |b: &Letter| a.left != b.left || (a.at[1] - b.at[1]).abs() >= LINE - 1e-6;
                    assert!(letters[..i].iter().all(clear), "{code}");
                    assert!(!outside(a.at, size), "{code} {}", a.text);
                }
            }
        }
    }
}
