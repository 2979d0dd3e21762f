//! Lines and arrows as the data of SVG paths.

use std::fmt::Write as _;

use glam::DVec2;

use super::{Colour, Ink, Width};
use crate::page::picture::Picture;
use crate::page::px;

/// Length and half width of the head of an arrow [px].
const HEAD: [f64; 2] = [9.0, 3.4];

/// An SVG path of straight lines.
#[derive(Default)]
pub(crate) struct LinePath {
    /// The attribute `d`.
    pub(crate) d: String,
}

impl LinePath {
    /// Adds a polyline; a single point becomes a dot.
    pub(crate) fn add(&mut self, points: impl IntoIterator<Item = [f64; 2]>) {
        let mut count = 0;
        let mut last = String::new();
        for p in points {
            last = format!("{} {}", px(p[0]), px(p[1]));
            self.d.push(if count == 0 { 'M' } else { 'L' });
            self.d.push_str(&last);
            count += 1;
        }
        if count == 1 {
            self.d.push('L');
            self.d.push_str(&last);
        }
    }
}

/// A line through points, to a tenth of a pixel.
pub(crate) fn line(points: impl IntoIterator<Item = [f64; 2]>) -> String {
    let mut d = String::new();
    let short = |v: f64| px((10.0 * v).round() / 10.0);
    for (i, p) in points.into_iter().enumerate() {
        // Writing to a String cannot fail.
        let _ = write!(d, "{}{} {}", if i == 0 { 'M' } else { 'L' }, short(p[0]), short(p[1]));
    }
    d
}

/// A head of an arrow with its tip at a place, along a direction of length one.
pub(crate) fn head(tip: DVec2, along: DVec2, [length, half]: [f64; 2]) -> String {
    let (back, side) = (tip - length * along, half * along.perp());
    line([tip, back + side, back - side].map(|p| p.to_array())) + "Z"
}

/// An arrow through points [px], its head at the last one, on a halo.
pub(crate) fn arrow(picture: &mut Picture, points: &[[f64; 2]], shaft: Ink, colour: Colour) {
    let [.., before, last] = points else { return };
    let tip = DVec2::from(*last);
    let Some(along) = (tip - DVec2::from(*before)).try_normalize() else { return };
    picture.path(Ink::Halo, line(points.iter().copied()));
    let neck = (tip - 0.7 * HEAD[0] * along).to_array();
    picture.path(shaft, line(points[..points.len() - 1].iter().copied().chain([neck])));
    picture.path(Ink::Area(colour), head(tip, along, HEAD));
}

/// The arms X, Y, Z of the coordinates at a place of paper, each with its letter, as a view turns them.
pub(crate) fn triad(picture: &mut Picture, view: &super::View, at: DVec2, arm: f64) {
    for (name, direction) in [("X", glam::DVec3::X), ("Y", glam::DVec3::Y), ("Z", glam::DVec3::Z)] {
        let reach = view.turned(direction) * arm;
        picture.path(Ink::line(Colour::Quiet, Width::Thin), line([at, at + reach].map(|p| p.to_array())));
        let word = at + reach + reach.normalize_or_zero() * 9.0;
        picture.tick([word.x, word.y + 4.0], crate::page::Anchor::Middle, name);
    }
}
