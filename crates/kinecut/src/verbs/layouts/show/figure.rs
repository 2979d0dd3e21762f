//! A layout as a picture: bodies, ground, arrows, letters in columns beside.

use std::fmt::Write as _;

use maud::{Markup, html};

use super::arrow::motion_arrows;
use super::bodies::{Bodies, Link, bodies};
use super::hidden::{Piece, painted};
use super::solid::{Shape, Solid, order, project};
use crate::machine::CoordinateCode;
use crate::machine::layouts::{Attitude, Sizes};
use crate::page::chart::px;

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
/// Length and half width of an arrow's head [px].
const HEAD: [f64; 2] = [8.0, 3.3];

/// The picture of a layout in a box of this size [px], without the frame of a file.
pub(crate) fn layout_group(
    code: &CoordinateCode,
    attitude: Attitude,
    sizes: &Sizes,
    at: [f64; 2],
    size: [f64; 2],
) -> Markup {
    group(code, &bodies(code, attitude, sizes), at, size)
}

/// The picture of bodies in a box of this size [px], without the frame of a file.
pub(crate) fn group(code: &CoordinateCode, made: &Bodies, at: [f64; 2], size: [f64; 2]) -> Markup {
    let frame = Frame::new(&made.solids, at, size);
    let letters = letters(code, made, &frame);
    let drawn = order(&made.solids);
    let given = made.solids.iter().any(|s| matches!(s.shape, Shape::Facets(_)));
    html! {
        g {
            (ground(made, &frame))
            @if given { (pieces(made, &frame)) } @else { (faces(made, &drawn, &frame)) }
            @for letter in &letters {
                path.leader d=(letter.leader) {}
                circle.dot cx=(px(letter.from[0])) cy=(px(letter.from[1])) r="1.6" {}
            }
            @for link in &made.links {
                (arrow(&frame.line(&free_arrow(link, made, &drawn)), ""))
            }
            @for letter in &letters {
                text.letter.on x=(px(letter.at[0])) y=(px(letter.at[1])) text-anchor=(if letter.left { "end" } else { "start" }) {
                    (letter.text)
                }
            }
            (scale_bar(&frame))
        }
    }
}

/// Blocks and drums in their order.
fn faces(made: &Bodies, drawn: &[usize], frame: &Frame) -> Markup {
    html! {
        @for &i in drawn {
            @for (shade, outline) in made.solids[i].faces() {
                path class=(format!("face {}", made.solids[i].look.class(shade))) d=(frame.outline(&outline)) {}
            }
        }
    }
}

/// Faces of any bodies, each piece before those that hide it: filled without a line, then its edges.
fn pieces(made: &Bodies, frame: &Frame) -> Markup {
    let mut all = Vec::new();
    for (body, solid) in made.solids.iter().enumerate() {
        if let Shape::Facets(facets) = &solid.shape {
            all.extend(facets.seen().into_iter().map(|face| Piece { face, body }));
        }
    }
    let mut rows: Vec<(String, String, String)> = Vec::new();
    for piece in painted(all) {
        let outline: Vec<[f64; 2]> = piece.face.outline.iter().map(|&p| project(p)).collect();
        let class = made.solids[piece.body].look.class(piece.face.shade());
        let mut lines = String::new();
        let line = frame.line(&outline);
        for (i, _) in piece.face.drawn.iter().enumerate().filter(|(_, drawn)| **drawn) {
            lines.push_str(&polyline(&[line[i], line[(i + 1) % line.len()]]));
        }
        let fill = polyline(&line) + "Z";
        match rows.last_mut() {
            // Pieces of one colour without an edge before them make one path.
            Some(last) if last.0 == class && last.2.is_empty() => {
                last.1.push_str(&fill);
                last.2 = lines;
            }
            _ => rows.push((class, fill, lines)),
        }
    }
    html! {
        @for (class, fill, lines) in rows {
            // A line of its own colour closes the seams between pieces.
            path class=(format!("seam {class}")) style=(format!("stroke:var(--{}-{})", &class[..1], &class[1..])) d=(fill) {}
            @if !lines.is_empty() { path class="edge-line" d=(lines) {} }
        }
    }
}

/// The arrow of a link of which least is hidden by nearer bodies.
fn free_arrow(link: &Link, made: &Bodies, drawn: &[usize]) -> Vec<[f64; 2]> {
    let place = drawn.iter().position(|&i| i == link.body).unwrap_or(0);
    let nearer: Vec<Vec<[f64; 2]>> =
        drawn[place + 1..].iter().flat_map(|&i| made.solids[i].faces()).map(|f| f.1).collect();
    let hidden = |way: &Vec<[f64; 2]>| {
        way.iter().filter(|p| nearer.iter().any(|outline| inside(outline, **p))).count()
    };
    let mut ways = motion_arrows(link, &made.solids[link.body]);
    // Each further way must show that much more to be taken: the usual places are easier to read.
    let best = (0..ways.len()).min_by_key(|&i| hidden(&ways[i]) + DEAR * i);
    best.map(|i| ways.swap_remove(i)).unwrap_or_default()
}

/// Whether a point lies in an outline.
fn inside(outline: &[[f64; 2]], p: [f64; 2]) -> bool {
    let mut odd = false;
    for (i, a) in outline.iter().enumerate() {
        let b = outline[(i + 1) % outline.len()];
        if (a[1] > p[1]) != (b[1] > p[1]) && p[0] < a[0] + (b[0] - a[0]) * (p[1] - a[1]) / (b[1] - a[1]) {
            odd = !odd;
        }
    }
    odd
}

/// From the model to paper.
pub(crate) struct Frame {
    /// Pixels of a millimetre.
    scale: f64,
    /// Where the model's zero is [px].
    zero: [f64; 2],
    /// What the bodies take: left, right, top, bottom [px].
    extent: [f64; 4],
    at: [f64; 2],
    size: [f64; 2],
}

impl Frame {
    fn new(solids: &[Solid], at: [f64; 2], size: [f64; 2]) -> Frame {
        let mut extent = [f64::INFINITY, f64::NEG_INFINITY, f64::INFINITY, f64::NEG_INFINITY];
        for p in solids.iter().flat_map(|s| s.faces()).flat_map(|f| f.1) {
            extent = [extent[0].min(p[0]), extent[1].max(p[0]), extent[2].min(p[1]), extent[3].max(p[1])];
        }
        let room = [size[0] - 2.0 * (COLUMN + BESIDE), size[1] - BELOW - 8.0];
        let (wide, tall) = ((extent[1] - extent[0]).max(1.0), (extent[3] - extent[2]).max(1.0));
        let scale = (room[0] / wide).min(room[1] / tall);
        let zero = [
            at[0] + 0.5 * size[0] - 0.5 * scale * (extent[0] + extent[1]),
            at[1] + 4.0 + 0.5 * (room[1] - scale * tall) - scale * extent[2],
        ];
        let extent = [0, 1, 2, 3].map(|i| zero[i / 2] + scale * extent[i]);
        Frame { scale, zero, extent, at, size }
    }

    fn px(&self, p: [f64; 2]) -> [f64; 2] {
        [0, 1].map(|k| self.zero[k] + self.scale * p[k])
    }

    fn line(&self, points: &[[f64; 2]]) -> Vec<[f64; 2]> {
        points.iter().map(|&p| self.px(p)).collect()
    }

    fn outline(&self, points: &[[f64; 2]]) -> String {
        polyline(&self.line(points)) + "Z"
    }
}

/// A line through points as the data of a path.
pub(crate) fn polyline(points: &[[f64; 2]]) -> String {
    let mut d = String::new();
    for (i, p) in points.iter().enumerate() {
        // Writing to a String cannot fail.
        let _ = write!(d, "{}{} {}", if i == 0 { 'M' } else { 'L' }, px(p[0]), px(p[1]));
    }
    d
}

/// An arrow through points [px], its head at the last one.
pub(crate) fn arrow(points: &[[f64; 2]], class: &str) -> Markup {
    let [.., before, last] = points else { return Markup::default() };
    let (dx, dy) = (last[0] - before[0], last[1] - before[1]);
    let length = dx.hypot(dy);
    if !(length > 0.0) {
        return Markup::default();
    }
    let [u, v] = [dx / length, dy / length];
    let corner =
        |side: f64| [last[0] - HEAD[0] * u - side * HEAD[1] * v, last[1] - HEAD[0] * v + side * HEAD[1] * u];
    let mut shaft = points.to_vec();
    if let Some(end) = shaft.last_mut() {
        *end = [last[0] - 0.7 * HEAD[0] * u, last[1] - 0.7 * HEAD[0] * v];
    }
    let head = polyline(&[corner(1.0), *last, corner(-1.0)]) + "Z";
    html! {
        path.halo d=(polyline(points)) {}
        path class=(format!("move {class}")) d=(polyline(&shaft)) {}
        path class=(format!("tip {class}")) d=(head) {}
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
fn letters(code: &CoordinateCode, made: &Bodies, frame: &Frame) -> Vec<Letter> {
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
        let heights = spread(&side.iter().map(|s| s.0[1]).collect::<Vec<_>>());
        let x = if left { frame.extent[0] - BESIDE } else { frame.extent[1] + BESIDE };
        for ((from, text), y) in side.into_iter().zip(heights) {
            let end = if left { x + 4.0 } else { x - 4.0 };
            let knee = if left { frame.extent[0] - 3.0 } else { frame.extent[1] + 3.0 };
            let leader = polyline(&[from, [knee, y], [end, y]]);
            all.push(Letter { text, left, at: [x, y + 5.0], from, leader });
        }
    }
    debug_assert_eq!(all.len(), code.word().0.len());
    all
}

/// The place of a body where its leader begins: its leftmost or rightmost visible edge, half way up.
fn edge(body: &Solid, left: bool, frame: &Frame) -> [f64; 2] {
    let outline: Vec<[f64; 2]> = body.faces().into_iter().flat_map(|f| f.1).collect();
    let sign = if left { -1.0 } else { 1.0 };
    let most = outline.iter().map(|p| sign * p[0]).fold(f64::NEG_INFINITY, f64::max);
    // The edge: all points as far out as the farthest.
    let width = 1e-6 * most.abs().max(1.0);
    let heights: Vec<f64> = outline.iter().filter(|p| sign * p[0] >= most - width).map(|p| p[1]).collect();
    let middle = heights.iter().sum::<f64>() / heights.len().max(1) as f64;
    frame.px([sign * most, middle])
}

/// Heights that want to stand where given, in ascending order, but need the room of a line: the least displacement.
fn spread(wanted: &[f64]) -> Vec<f64> {
    let mut pools: Vec<(f64, usize)> = Vec::new();
    for (i, y) in wanted.iter().enumerate() {
        pools.push((y - i as f64 * LINE, 1));
        while let [.., (a, n), (b, m)] = pools[..]
            && a > b
        {
            pools.truncate(pools.len() - 2);
            pools.push(((a * n as f64 + b * m as f64) / (n + m) as f64, n + m));
        }
    }
    let flat = pools.into_iter().flat_map(|(y, n)| std::iter::repeat_n(y, n));
    flat.enumerate().map(|(i, y)| y + i as f64 * LINE).collect()
}

/// Hatching below the lower edges of what stands on the ground.
fn ground(made: &Bodies, frame: &Frame) -> Markup {
    let mut d = String::new();
    for &i in &made.ground {
        let [low, high] = made.solids[i].bounds();
        let corners = [[low[0], low[1], low[2]], [high[0], low[1], low[2]], [high[0], high[1], low[2]]];
        let corners = corners.map(|c| frame.px(project(c)));
        for pair in corners.windows(2) {
            let length = (pair[1][0] - pair[0][0]).hypot(pair[1][1] - pair[0][1]);
            let count = (length / HATCH).floor() as usize;
            for n in 0..count {
                let t = (n as f64 + 0.5) / count as f64;
                let from = [0, 1].map(|k| pair[0][k] + t * (pair[1][k] - pair[0][k]));
                d.push_str(&polyline(&[from, [from[0] - 4.0, from[1] + 7.0]]));
            }
        }
    }
    html! { path.ground d=(d) {} }
}

/// A bar of a round length below the picture.
fn scale_bar(frame: &Frame) -> Markup {
    let most = 0.3 * frame.size[0] / frame.scale;
    let power = 10f64.powf(most.log10().floor());
    let length = [5.0, 2.0, 1.0].into_iter().map(|f| f * power).find(|l| *l <= most).unwrap_or(power);
    let width = length * frame.scale;
    let (x, y) = (frame.at[0] + 12.0, frame.at[1] + frame.size[1] - 10.0);
    let bar = polyline(&[[x, y - 3.0], [x, y + 3.0]])
        + &polyline(&[[x, y], [x + width, y]])
        + &polyline(&[[x + width, y - 3.0], [x + width, y + 3.0]]);
    html! {
        path.bar d=(bar) {}
        text.quiet x=(px(x + width + 6.0)) y=(px(y + 4.0)) { (px(length)) " mm" }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::machine::layouts::Search;

    #[test]
    fn letters_keep_their_room_and_order() {
        let at = spread(&[10.0, 11.0, 12.0, 100.0]);
        assert!(at.windows(2).all(|w| w[1] - w[0] >= LINE - 1e-9));
        assert_eq!(at[3], 100.0);
        assert!((at[..3].iter().sum::<f64>() - 33.0).abs() < 1e-9);
    }

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
                let frame = Frame::new(&made.solids, [0.0; 2], size);
                let drawn = order(&made.solids);
                for p in made.solids.iter().flat_map(|s| s.faces()).flat_map(|f| f.1) {
                    assert!(!outside(frame.px(p), size), "{code} {attitude:?}");
                }
                for link in &made.links {
                    let arrow = frame.line(&free_arrow(link, &made, &drawn));
                    assert!(arrow.len() > 1 && !arrow.iter().any(|p| outside(*p, size)), "{code} {link:?}");
                }
                let letters = letters(code, &made, &frame);
                for (i, a) in letters.iter().enumerate() {
                    let clear = |b: &Letter| a.left != b.left || (a.at[1] - b.at[1]).abs() >= LINE - 1e-6;
                    assert!(letters[..i].iter().all(clear), "{code}");
                    assert!(!outside(a.at, size), "{code} {}", a.text);
                }
            }
        }
    }
}
