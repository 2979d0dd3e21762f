//! The parameter plane: the chain of pieces upwards by its length (edges, which have none, by a fixed height), the angle about the
//! axis across; where the tool enters, the curves by their kinds, the folds.

use std::f64::consts::TAU;

use super::bands::{Band, strips};
use super::{kind_number, kind_words, kinds, looks};
use crate::page::draw::{Plot, line};
use crate::page::{Anchor, Ink, Picture};
use crate::sweep::PieceShape;
use crate::verbs::grazing::GrazingSheet;

/// Size of the picture, and its plot: left, top, right, bottom [px].
const SIZE: [f64; 2] = [460.0, 440.0];
const PLOT: [f64; 4] = [112.0, 14.0, 446.0, 404.0];
/// Height of an edge [px].
const FAN: f64 = 20.0;
/// Least height of an element [px].
const LEAST: f64 = 16.0;
/// Error of a drawn curve [px].
const ERROR: f64 = 0.3;

/// Places of pieces: bottom and height of each [px].
struct Heights(Vec<[f64; 2]>);

impl Heights {
    fn new(sheet: &GrazingSheet) -> Heights {
        let pieces = sheet.chain.pieces();
        let length = |p: &crate::sweep::ChainPiece| match p.shape {
            PieceShape::Line { .. } => p.to - p.from,
            PieceShape::Arc { radius, .. } => (p.to - p.from).abs() * radius.abs(),
        };
        let fans = pieces.iter().filter(|p| p.is_fan()).count() as f64;
        let elements = pieces.len() as f64 - fans;
        let all: f64 = pieces.iter().map(length).sum();
        let room = PLOT[3] - PLOT[1];
        // A tool of very many pieces shares the room out evenly.
        let squeeze = (room / (fans * FAN + elements * LEAST)).min(1.0);
        let free = (room - squeeze * (fans * FAN + elements * LEAST)).max(0.0);
        let mut at = PLOT[3];
        let one = |p: &crate::sweep::ChainPiece| {
            let high = if p.is_fan() { squeeze * FAN } else { squeeze * LEAST + free * length(p) / all };
            let bottom = at;
            at -= high;
            [bottom, high]
        };
        Heights(pieces.iter().map(one).collect())
    }

    fn y(&self, sheet: &GrazingSheet, piece: usize, u: f64) -> f64 {
        let p = &sheet.chain.pieces()[piece];
        let [bottom, high] = self.0[piece];
        bottom - high * (u - p.from) / (p.to - p.from)
    }
}

/// The plane: angles [rad] across, pixels downwards.
const PLANE: Plot = Plot {
    corner: [PLOT[0], PLOT[1]],
    size: [PLOT[2] - PLOT[0], PLOT[3] - PLOT[1]],
    x: [0.0, TAU],
    y: [PLOT[3], PLOT[1]],
};

/// The picture.
pub(crate) fn figure(sheet: &GrazingSheet, id: &str, title: &str) -> Picture {
    let heights = Heights::new(sheet);
    let mut picture = Picture {
        id: id.to_owned(),
        title: title.to_owned(),
        about: "up the profile against the angle about the axis".to_owned(),
        size: SIZE,
        ..Picture::default()
    };
    picture.legend =
        vec![(looks::entering(2), "enters".to_owned()), (looks::leaving(0), "leaves".to_owned())];
    let named = kinds(&sheet.grazing).into_iter();
    picture.legend.extend(named.map(|k| (looks::segment(kind_number(k)), kind_words(k).to_owned())));
    picture.summary =
        "The plane of angle and profile: regions that enter and leave, parted by the grazing curve."
            .to_owned();
    picture.path(looks::leaving(0), PLANE.area());
    regions(sheet, &heights, &mut picture);
    scales(sheet, &heights, &mut picture);
    for &piece in &sheet.grazing.whole {
        let [bottom, high] = heights.0[piece];
        let middle = bottom - 0.5 * high;
        picture.path(looks::WHOLE, PLANE.level(middle));
    }
    for &(piece, u) in &sheet.grazing.circles {
        let y = heights.y(sheet, piece, u);
        picture.path(looks::WHOLE, PLANE.level(y));
    }
    curves(sheet, &heights, &mut picture);
    picture
}

fn regions(sheet: &GrazingSheet, heights: &Heights, picture: &mut Picture) {
    let fine = 0.002 * sheet.chain.reach();
    let mut d = String::new();
    for index in 0..sheet.chain.pieces().len() {
        for strip in strips(sheet, index, fine) {
            let [a, b] = strip.u.map(|u| heights.y(sheet, index, u));
            let part = match strip.band {
                Band::Leaves => continue,
                Band::Enters => [[0.0, TAU]; 2],
                Band::Part(part) => part,
            };
            for turns in -2..=2 {
                let by = f64::from(turns) * TAU;
                let corners = [[part[0][0], a], [part[0][1], a], [part[1][1], b], [part[1][0], b]];
                let clipped = clip(&corners.map(|[t, y]| [t + by, y]));
                if clipped.len() > 2 {
                    d += &line(clipped.iter().map(|[t, y]| PLANE.at([*t, *y])));
                    d.push('Z');
                }
            }
        }
    }
    picture.path(looks::entering(2), d);
}

/// Part of a polygon between the angles 0 and one turn.
fn clip(corners: &[[f64; 2]]) -> Vec<[f64; 2]> {
    let half = |points: &[[f64; 2]], border: f64, sign: f64| {
        let inside = |p: &[f64; 2]| sign * (p[0] - border) >= 0.0;
        let mut kept: Vec<[f64; 2]> = Vec::new();
        for (i, p) in points.iter().enumerate() {
            let before = &points[(i + points.len() - 1) % points.len()];
            if inside(p) != inside(before) {
                let t = (border - before[0]) / (p[0] - before[0]);
                kept.push([border, before[1] + t * (p[1] - before[1])]);
            }
            if inside(p) {
                kept.push(*p);
            }
        }
        kept
    };
    let right = half(corners, 0.0, 1.0);
    if right.is_empty() { right } else { half(&right, TAU, -1.0) }
}

fn scales(sheet: &GrazingSheet, heights: &Heights, picture: &mut Picture) {
    let mut borders = String::new();
    let mut last = f64::INFINITY;
    for (index, [bottom, high]) in heights.0.iter().enumerate() {
        if index > 0 {
            borders += &PLANE.level(*bottom);
        }
        let middle = bottom - 0.5 * high;
        // Names that would lie on each other are left out.
        if last - middle >= 11.0 {
            PLANE.number_y(picture, middle, sheet.piece_words(index));
            last = middle;
        }
    }
    let quarter = |k: u32| TAU * f64::from(k) / 4.0;
    borders.extend((1..4).map(|k| PLANE.upright(quarter(k))));
    picture.path(Ink::ZERO, borders);
    PLANE.border(picture);
    for k in 0..=4 {
        let anchor = if k == 4 { Anchor::End } else { Anchor::Middle };
        PLANE.number_x(picture, quarter(k), anchor, format!("{}\u{b0}", 90 * k));
    }
    PLANE.name_x(picture, "angle about the axis, from X");
}

fn curves(sheet: &GrazingSheet, heights: &Heights, picture: &mut Picture) {
    let fine = ERROR / (PLOT[3] - PLOT[1]) * sheet.chain.reach();
    let mut folds = Vec::new();
    for span in &sheet.grazing.spans {
        let piece = &sheet.chain.pieces()[span.piece];
        let mut parts = sheet.chain.parts(span, fine);
        // On a pole all points are one, and on an edge its height counts: the angle must be followed by itself.
        if piece.is_fan() || parts.len() < 48 {
            parts = (0..=48).map(|k| f64::from(k) / 48.0).collect();
        }
        for branch in 0..2 {
            let mut way: Vec<[f64; 2]> = Vec::new();
            for &t in &parts {
                let p = sheet.chain.grazing_points(span, t)[branch];
                if p.point.truncate() == glam::DVec2::ZERO && p.normal.truncate() == glam::DVec2::ZERO {
                    // The middle of a disc has no angle; the curve goes on from it as it came.
                    continue;
                }
                let theta = p.theta();
                let theta = match way.last() {
                    Some(last) => theta + ((last[0] - theta) / TAU).round() * TAU,
                    None => theta,
                };
                way.push([theta, heights.y(sheet, span.piece, p.u)]);
            }
            for turns in -2..=2 {
                let by = f64::from(turns) * TAU;
                for stretch in within(way.iter().map(|p| [p[0] + by, p[1]])) {
                    picture.path(
                        looks::segment(kind_number(span.kind)),
                        line(stretch.iter().map(|p| PLANE.at(*p))),
                    );
                }
            }
            for (fold, end) in [(span.folds[0], way.first()), (span.folds[1], way.last())] {
                if let (true, 0, Some(p)) = (fold, branch, end) {
                    folds.push(PLANE.at([p[0].rem_euclid(TAU), p[1]]));
                }
            }
        }
    }
    folds.into_iter().for_each(|at| picture.circle(looks::FOLD, at, 3.2));
}

/// Stretches of a line between the angles 0 and one turn.
fn within(points: impl Iterator<Item = [f64; 2]>) -> Vec<Vec<[f64; 2]>> {
    let mut found: Vec<Vec<[f64; 2]>> = Vec::new();
    let mut open: Vec<[f64; 2]> = Vec::new();
    let mut before: Option<[f64; 2]> = None;
    for p in points {
        if let Some(b) = before {
            let (mut from, mut to) = (0.0f64, 1.0f64);
            let run = p[0] - b[0];
            for border in [0.0, TAU] {
                let [in_b, in_p] = [b[0], p[0]].map(|t| if border == 0.0 { t >= 0.0 } else { t <= TAU });
                match (in_b, in_p) {
                    (true, false) => to = to.min((border - b[0]) / run),
                    (false, true) => from = from.max((border - b[0]) / run),
                    (false, false) => to = -1.0,
                    (true, true) => {}
                }
            }
            if from < to {
                let at = |t: f64| [b[0] + t * run, b[1] + t * (p[1] - b[1])];
                if from > 0.0 || open.is_empty() {
                    found.push(std::mem::take(&mut open));
                    open.push(at(from));
                }
                open.push(at(to));
                if to < 1.0 {
                    found.push(std::mem::take(&mut open));
                }
            }
        }
        before = Some(p);
    }
    found.push(open);
    found.retain(|s| s.len() > 1);
    found
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_line_around_the_seam_falls_into_two() {
        let way = [[6.0, 0.0], [6.2, 1.0], [6.4, 2.0], [6.6, 3.0]];
        let seam = within(way.into_iter());
        assert_eq!(seam.len(), 1);
        assert!((seam[0].last().unwrap()[0] - TAU).abs() < 1e-12);
        let rest = within(way.into_iter().map(|p| [p[0] - TAU, p[1]]));
        assert_eq!((rest.len(), rest[0][0][0]), (1, 0.0));
    }

    #[test]
    fn a_polygon_over_the_seam_is_cut_there() {
        let left = clip(&[[-1.0, 0.0], [1.0, 0.0], [1.0, 2.0], [-1.0, 2.0]]);
        assert_eq!(left.len(), 4);
        assert!(left.iter().all(|p| p[0] >= 0.0));
        assert!(clip(&[[-2.0, 0.0], [-1.0, 0.0], [-1.0, 2.0]]).is_empty());
    }
}
