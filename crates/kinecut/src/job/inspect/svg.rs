//! A section as an SVG file to the scale of the part: one unit is one millimetre.

use std::fmt::Write as _;

use super::PartSection;
use crate::page::trimmed;

/// Decimals of coordinates: the step in which ends of lines are kept.
const DECIMALS: usize = 5;

/// Room around the outlines [mm].
const ROOM: f64 = 1.0;

/// The picture of a section that has outlines; material is filled, y of the file runs down.
pub(super) fn svg(section: &PartSection) -> String {
    let points = || section.outlines.iter().flat_map(|o| &o.points);
    let least = |i: usize| points().map(|p| p[i]).fold(f64::INFINITY, f64::min) - ROOM;
    let most = |i: usize| points().map(|p| p[i]).fold(f64::NEG_INFINITY, f64::max) + ROOM;
    let [left, right, low, high] = [least(0), most(0), least(1), most(1)];
    let number = |mm: f64| trimmed(mm, DECIMALS);
    let (width, height) = (right - left, high - low);
    let mut path = String::new();
    for outline in &section.outlines {
        for (i, [x, y]) in outline.points.iter().enumerate() {
            // Writing to a text does not fail.
            let _ = write!(path, "{}{} {}", if i == 0 { 'M' } else { 'L' }, number(*x), number(-y));
        }
        path.push('Z');
    }
    let name = section.plane;
    let [left, top, width, height] = [left, -high, width, height].map(number);
    format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{width}mm\" height=\"{height}mm\" viewBox=\"{left} {top} {width} {height}\">\n\
         <title>Section at {name}, in mm</title>\n\
         <path d=\"{path}\" fill=\"#c9d3dd\" fill-rule=\"evenodd\" stroke=\"#1c242c\" stroke-width=\"1\" vector-effect=\"non-scaling-stroke\"/>\n\
         </svg>\n"
    )
}
