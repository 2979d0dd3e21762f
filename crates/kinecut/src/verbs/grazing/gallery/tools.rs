//! Tools of the gallery, round numbers in mm.

use std::f64::consts::FRAC_PI_2;

use crate::base::Result;
use crate::tool::{Contour, ContourElement, ElementRole};

/// Straight elements through points.
fn lines(points: &[[f64; 2]], role: ElementRole) -> Vec<ContourElement> {
    points.windows(2).map(|p| ContourElement::line(p[0], p[1], role)).collect()
}

/// Cylinder of 20.
pub(crate) fn flat() -> Result<Contour> {
    Contour::new(lines(&[[0.0, 0.0], [10.0, 0.0], [10.0, 24.0], [0.0, 24.0]], ElementRole::Cutting))
}

/// A longer one.
pub(crate) fn cylinder() -> Result<Contour> {
    Contour::new(lines(&[[0.0, 0.0], [8.0, 0.0], [8.0, 30.0], [0.0, 30.0]], ElementRole::Cutting))
}

/// A cone with a flat tip.
pub(crate) fn taper() -> Result<Contour> {
    Contour::new(lines(&[[0.0, 0.0], [4.0, 0.0], [12.0, 24.0], [0.0, 24.0]], ElementRole::Cutting))
}

/// A ring around a hollow.
pub(crate) fn annulus() -> Result<Contour> {
    let points = [[0.0, 3.0], [3.0, 3.0], [5.0, 0.0], [12.0, 0.0], [12.0, 16.0], [0.0, 16.0]];
    Contour::new(lines(&points, ElementRole::Cutting))
}

/// A corner that bulges outwards.
pub(crate) fn bull() -> Result<Contour> {
    let mut elements = lines(&[[0.0, 0.0], [4.0, 0.0]], ElementRole::Cutting);
    elements.push(ContourElement::arc([4.0, 8.0], 8.0, -FRAC_PI_2, 0.0, ElementRole::Cutting));
    elements.extend(lines(&[[12.0, 8.0], [12.0, 26.0], [0.0, 26.0]], ElementRole::Cutting));
    Contour::new(elements)
}

/// A corner that bulges inwards.
pub(crate) fn rounding() -> Result<Contour> {
    let mut elements = lines(&[[0.0, 0.0], [4.0, 0.0], [4.0, 3.0]], ElementRole::Cutting);
    elements.push(ContourElement::arc([12.0, 3.0], 8.0, 0.0, -FRAC_PI_2, ElementRole::Cutting));
    elements.extend(lines(&[[12.0, 11.0], [12.0, 26.0], [0.0, 26.0]], ElementRole::Cutting));
    Contour::new(elements)
}

/// A disc with a round or hollow rim: normal angles from one to another.
pub(crate) fn rim(outwards: bool) -> Result<Contour> {
    let end = 70f64.to_radians();
    let rim = match outwards {
        true => ContourElement::arc([6.0, 8.0], 8.0, -end, end, ElementRole::Cutting),
        false => ContourElement::arc([14.0, 8.0], 8.0, end, -end, ElementRole::Cutting),
    };
    let (a, b) = (rim.shape.start(), rim.shape.end());
    let mut elements = lines(&[[0.0, a.y], a.to_array()], ElementRole::Cutting);
    elements.push(rim);
    elements.extend(lines(&[b.to_array(), [0.0, b.y]], ElementRole::Cutting));
    Contour::new(elements)
}

/// A corner whose normals stay away from those across the axis.
pub(crate) fn shallow(outwards: bool) -> Result<Contour> {
    let [flat, steep] = [80f64, 35.0].map(f64::to_radians);
    let corner = match outwards {
        true => ContourElement::arc([6.0, 8.0], 8.0, -flat, -steep, ElementRole::Cutting),
        false => ContourElement::arc([14.0, 4.0], 8.0, -steep, -flat, ElementRole::Cutting),
    };
    let (a, b) = (corner.shape.start(), corner.shape.end());
    let mut elements = match outwards {
        true => lines(&[[0.0, a.y], a.to_array()], ElementRole::Cutting),
        false => lines(&[[0.0, 0.0], [a.x, 0.0], a.to_array()], ElementRole::Cutting),
    };
    elements.push(corner);
    elements.extend(lines(&[b.to_array(), [b.x, 26.0], [0.0, 26.0]], ElementRole::Cutting));
    Contour::new(elements)
}

/// Half a sphere under a cylinder.
pub(crate) fn ball() -> Result<Contour> {
    let mut elements = vec![ContourElement::arc([0.0, 10.0], 10.0, -FRAC_PI_2, 0.0, ElementRole::Cutting)];
    elements.extend(lines(&[[10.0, 10.0], [10.0, 28.0], [0.0, 28.0]], ElementRole::Shank));
    Contour::new(elements)
}

/// More than half a sphere under a thin neck.
pub(crate) fn lollipop() -> Result<Contour> {
    let phi = 0.4f64.acos();
    let neck = [4.0, 10.0 + 10.0 * phi.sin()];
    let mut elements = vec![ContourElement::arc([0.0, 10.0], 10.0, -FRAC_PI_2, phi, ElementRole::Cutting)];
    elements.extend(lines(&[neck, [4.0, 32.0], [0.0, 32.0]], ElementRole::Shank));
    Contour::new(elements)
}

/// Cutter, thicker shank, holder.
pub(crate) fn stack() -> Result<Contour> {
    let mut elements = lines(&[[0.0, 0.0], [5.0, 0.0], [5.0, 12.0]], ElementRole::Cutting);
    elements.extend(lines(&[[5.0, 12.0], [7.0, 12.0], [7.0, 22.0]], ElementRole::Shank));
    elements.extend(lines(&[[7.0, 22.0], [12.0, 26.0], [12.0, 34.0], [0.0, 34.0]], ElementRole::Holder));
    Contour::new(elements)
}

/// A disc on a thin shank.
pub(crate) fn collar() -> Result<Contour> {
    let points = [
        [0.0, 0.0],
        [4.0, 0.0],
        [4.0, 8.0],
        [12.0, 8.0],
        [12.0, 13.0],
        [4.0, 13.0],
        [4.0, 30.0],
        [0.0, 30.0],
    ];
    Contour::new(lines(&points, ElementRole::Cutting))
}
