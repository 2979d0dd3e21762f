//! Solids of a picture: blocks and drums, seen isometrically, drawn from the farthest to the nearest.
//!
//! Places are [right, back, up] in mm; the viewer stands in front, to the right, above. Blocks that do not overlap are
//! ordered exactly: what lies wholly left of, behind or below another one is farther; where two of these contradict each
//! other no ray meets both.

use super::facets::Facets;
use super::style::Look;

/// A place: right, back, up [mm].
pub(crate) type Place = [f64; 3];

/// Blocks that touch within this do not overlap [mm].
const TOUCH: f64 = 1e-6;
/// Corners of a circle.
const CORNERS: usize = 48;
/// The direction to the viewer, not of length one.
pub(crate) const VIEWER: Place = [1.0, -1.0, 1.0];

/// A point on paper, y downwards, in mm of the model.
pub(crate) fn project(p: Place) -> [f64; 2] {
    [(p[0] + p[1]) * (3f64.sqrt() / 2.0), (p[0] - p[1]) / 2.0 - p[2]]
}

/// A body of a picture.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Solid {
    pub(crate) shape: Shape,
    pub(crate) look: Look,
}

/// Its form.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum Shape {
    /// A block between two corners.
    Block { low: Place, high: Place },
    /// A cylinder about an axis of length one.
    Drum { centre: Place, axis: Place, radius: f64, half: f64 },
    /// Flat faces.
    Facets(Facets),
}

impl Solid {
    /// A block by centre and size.
    pub(crate) fn block(look: Look, centre: Place, size: Place) -> Solid {
        let at = |sign: f64| [0, 1, 2].map(|k| centre[k] + sign * 0.5 * size[k].abs());
        Solid { look, shape: Shape::Block { low: at(-1.0), high: at(1.0) } }
    }

    /// A drum.
    pub(crate) fn drum(look: Look, centre: Place, axis: Place, radius: f64, half: f64) -> Solid {
        Solid { look, shape: Shape::Drum { centre, axis, radius, half } }
    }

    /// The box about it.
    pub(crate) fn bounds(&self) -> [Place; 2] {
        match &self.shape {
            Shape::Block { low, high } => [*low, *high],
            Shape::Drum { centre, axis, radius, half } => {
                let reach = [0, 1, 2]
                    .map(|k| half * axis[k].abs() + radius * (1.0 - axis[k] * axis[k]).max(0.0).sqrt());
                [-1.0, 1.0].map(|s| [0, 1, 2].map(|k| centre[k] + s * reach[k]))
            }
            Shape::Facets(facets) => {
                let end = |start: f64, further: fn(f64, f64) -> f64| {
                    [0, 1, 2].map(|k| facets.corners.iter().map(|c| c[k]).fold(start, further))
                };
                [end(f64::INFINITY, f64::min), end(f64::NEG_INFINITY, f64::max)]
            }
        }
    }

    /// Its visible faces on paper, each with its shade from 0, the lightest, to 2.
    pub(crate) fn faces(&self) -> Vec<(usize, Vec<[f64; 2]>)> {
        match &self.shape {
            Shape::Block { low, high } => {
                let [l, h] = [low, high];
                let top = [[l[0], l[1], h[2]], [h[0], l[1], h[2]], [h[0], h[1], h[2]], [l[0], h[1], h[2]]];
                let front = [[l[0], l[1], l[2]], [h[0], l[1], l[2]], [h[0], l[1], h[2]], [l[0], l[1], h[2]]];
                let right = [[h[0], l[1], l[2]], [h[0], h[1], l[2]], [h[0], h[1], h[2]], [h[0], l[1], h[2]]];
                let face = |shade: usize, corners: [Place; 4]| (shade, corners.map(project).to_vec());
                vec![face(0, top), face(1, front), face(2, right)]
            }
            Shape::Drum { centre, axis, radius, half } => {
                let [u, v] = across(*axis);
                let ring = |side: f64| {
                    let at =
                        move |i: usize| {
                            let (sin, cos) = (std::f64::consts::TAU * i as f64 / CORNERS as f64).sin_cos();
                            project([0, 1, 2].map(|k| {
                                centre[k] + side * half * axis[k] + radius * (cos * u[k] + sin * v[k])
                            }))
                        };
                    (0..CORNERS).map(at).collect::<Vec<_>>()
                };
                let nearer = if dot(*axis, VIEWER) < 0.0 { -1.0 } else { 1.0 };
                let cap = ring(nearer);
                let mut all = cap.clone();
                all.extend(ring(-nearer));
                let lit = usize::from(axis[2].abs() < 0.5);
                vec![(2 - lit, hull(all)), (lit, cap)]
            }
            Shape::Facets(facets) => {
                let seen = facets.seen().into_iter();
                seen.map(|f| (f.shade(), f.outline.iter().map(|&p| project(p)).collect())).collect()
            }
        }
    }
}

/// Two directions across an axis that make a right-handed frame with it.
pub(crate) fn across(axis: Place) -> [Place; 2] {
    let helper = if axis[2].abs() < 0.9 { [0.0, 0.0, 1.0] } else { [1.0, 0.0, 0.0] };
    let u = unit(cross(helper, axis));
    [u, cross(axis, u)]
}

pub(crate) fn cross(a: Place, b: Place) -> Place {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

pub(crate) fn dot(a: Place, b: Place) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

/// The direction of a vector; right of one without length.
pub(crate) fn unit(a: Place) -> Place {
    let length = dot(a, a).sqrt();
    if length > 0.0 { a.map(|c| c / length) } else { [1.0, 0.0, 0.0] }
}

/// The convex outline of points.
fn hull(mut points: Vec<[f64; 2]>) -> Vec<[f64; 2]> {
    points.sort_by(|a, b| a[0].total_cmp(&b[0]).then(a[1].total_cmp(&b[1])));
    let turn =
        |o: [f64; 2], a: [f64; 2], b: [f64; 2]| (a[0] - o[0]) * (b[1] - o[1]) - (a[1] - o[1]) * (b[0] - o[0]);
    let half = |points: &mut dyn Iterator<Item = [f64; 2]>| {
        let mut chain: Vec<[f64; 2]> = Vec::new();
        for p in points {
            while let [.., o, a] = chain[..]
                && turn(o, a, p) <= 0.0
            {
                chain.pop();
            }
            chain.push(p);
        }
        chain.pop();
        chain
    };
    let mut outline = half(&mut points.iter().copied());
    outline.extend(half(&mut points.iter().rev().copied()));
    outline
}

/// The order in which solids are drawn, the farthest first.
pub(crate) fn order(solids: &[Solid]) -> Vec<usize> {
    let bounds: Vec<[Place; 2]> = solids.iter().map(Solid::bounds).collect();
    let farther = |a: usize, b: usize| {
        let ([al, ah], [bl, bh]) = (bounds[a], bounds[b]);
        ah[0] <= bl[0] + TOUCH || al[1] >= bh[1] - TOUCH || ah[2] <= bl[2] + TOUCH
    };
    let mut left: Vec<usize> = (0..solids.len()).collect();
    let mut sorted = Vec::with_capacity(solids.len());
    while !left.is_empty() {
        let free = |&i: &usize| left.iter().all(|&j| j == i || !farther(j, i) || farther(i, j));
        // Bodies that overlap may have no order: then the first one.
        let next = left.iter().position(free).unwrap_or(0);
        sorted.push(left.remove(next));
    }
    sorted
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_behind_left_or_below_is_drawn_first() {
        let block = |centre: Place| Solid::block(Look::Bed, centre, [2.0, 2.0, 2.0]);
        let solids =
            [block([0.0, 0.0, 0.0]), block([0.0, 4.0, 0.0]), block([0.0, 0.0, 4.0]), block([-4.0, 0.0, 0.0])];
        let place = |i: usize| order(&solids).iter().position(|&j| j == i).unwrap();
        assert!(place(1) < place(0) && place(3) < place(0) && place(0) < place(2));
    }

    #[test]
    fn a_drum_upright_shows_its_lid() {
        let drum = Solid::drum(Look::Part, [0.0; 3], [0.0, 0.0, 1.0], 10.0, 3.0);
        assert_eq!(drum.bounds(), [[-10.0, -10.0, -3.0], [10.0, 10.0, 3.0]]);
        let faces = drum.faces();
        let middle = |f: &[[f64; 2]]| f.iter().map(|p| p[1]).sum::<f64>() / f.len() as f64;
        assert!((middle(&faces[1].1) + 3.0).abs() < 1e-9, "the lid lies above, y is downwards");
    }
}
