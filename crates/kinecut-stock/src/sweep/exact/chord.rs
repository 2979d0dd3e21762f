//! The stretch of a line that a convex tool of fixed axis removes on a straight move.
//!
//! The swept volume is the sum of the tool and a segment, and convex: a line meets it in one stretch. Where the line enters the
//! tool is a convex function of the moment, where it leaves a concave one, so that the least and the greatest have one place
//! each. The tool itself is met piece by piece: in the slab of a piece the distance from the axis less the profile's radius is
//! convex along the line.

use glam::{DVec2, DVec3};

use crate::num::bisect::bisected;
use crate::num::root::bracketed_newton;
use crate::tool::{Contour, ContourShape};

/// A convex tool.
#[derive(Clone, Debug, PartialEq)]
pub struct ConvexTool {
    elements: Vec<ContourShape>,
    radius: f64,
}

/// Turn of the contour to the wrong side that is rounding.
const STRAIGHT: f64 = 1e-12;
/// Halvings by which the lowest place of a convex function is found.
const HALVINGS: u32 = 60;
/// Evaluations of a bracketed root.
const LIMIT: u32 = 100;
/// Ratio of the golden section.
const GOLDEN: f64 = 0.618_033_988_749_894_9;
/// Golden steps: a width of 1e-10 of the move, where an extreme is flat to 1e-20.
const STEPS: u32 = 48;

impl ConvexTool {
    /// The tool of a contour; none when it is not convex.
    pub fn new(contour: &Contour) -> Option<ConvexTool> {
        let elements: Vec<ContourShape> = contour.elements().iter().map(|e| e.shape).collect();
        let mut before: Option<f64> = None;
        for shape in &elements {
            let [first, last] = shape.normals();
            let convex = !matches!(shape, ContourShape::Arc { convex: false, .. });
            if !convex
                || before.is_some_and(|b| (first - b).sin() < -STRAIGHT)
                || before.is_none() && first.cos() < -STRAIGHT
            {
                return None;
            }
            before = Some(last);
        }
        let of = |s: &ContourShape| match *s {
            ContourShape::Line { start, end } => start.x.max(end.x),
            ContourShape::Arc { centre, radius, .. } => centre.x + radius,
        };
        let radius = elements.iter().map(of).fold(0.0, f64::max);
        Some(ConvexTool { elements, radius })
    }

    /// The stretch of the line `origin + s way` inside the tool, which is at the origin, as values of s [mm]; `way`
    /// is a unit vector.
    pub fn chord(&self, origin: DVec3, way: DVec3) -> Option<[f64; 2]> {
        let mut whole: Option<[f64; 2]> = None;
        for shape in &self.elements {
            let (low, high) = (shape.start().y, shape.end().y);
            if high <= low {
                continue;
            }
            let Some(range) = self.slab(origin, way, low, high) else { continue };
            if let Some([a, b]) = inside(shape, origin, way, range) {
                whole = Some(whole.map_or([a, b], |[x, y]| [x.min(a), y.max(b)]));
            }
        }
        whole
    }

    /// The stretch of the line that the tool removes on a straight move of its tip from the origin to `to`.
    ///
    /// ```
    /// # use kinecut_stock as kinecut;
    /// use glam::DVec3;
    /// use kinecut::sweep::ConvexTool;
    /// use kinecut::tool::{Contour, ContourElement, ElementRole};
    /// let pin = Contour::new(vec![
    ///     ContourElement::line([0.0, 0.0], [5.0, 0.0], ElementRole::Cutting),
    ///     ContourElement::line([5.0, 0.0], [5.0, 30.0], ElementRole::Cutting),
    ///     ContourElement::line([5.0, 30.0], [0.0, 30.0], ElementRole::Shank),
    /// ]);
    /// let tool = ConvexTool::new(&pin.unwrap()).unwrap();
    /// // Down at 45 degrees: a line that falls as steeply along the other way.
    /// let swept = tool.removed(DVec3::new(20.0, 0.0, -10.0), DVec3::new(10.0, 0.0, -30.0), DVec3::Z).unwrap();
    /// assert!((swept[0] - 22.5).abs() < 1e-9 && (swept[1] - 57.5).abs() < 1e-9);
    /// ```
    pub fn removed(&self, to: DVec3, origin: DVec3, way: DVec3) -> Option<[f64; 2]> {
        // The moments at which the line meets the tool are an interval: any of them is found where it is least far off.
        let miss = |t: f64| self.clearance(origin - to * t, way);
        let nearest = least(0.0, 1.0, &miss);
        let nearest =
            [0.0, 1.0, nearest].into_iter().find(|&t| self.chord(origin - to * t, way).is_some())?;
        let edge = |outer: f64| {
            if self.chord(origin - to * outer, way).is_some() {
                return outer;
            }
            bisected([nearest, outer], HALVINGS, |m| self.chord(origin - to * m, way).is_some())[0]
        };
        let (first, last) = (edge(0.0), edge(1.0));
        let at = |t: f64, end: usize| self.chord(origin - to * t, way).map(|c| c[end]);
        let enters = |t: f64| at(t, 0).unwrap_or(f64::INFINITY);
        let leaves = |t: f64| at(t, 1).map_or(f64::INFINITY, |s| -s);
        let lowest = |f: &dyn Fn(f64) -> f64| {
            [f(first), f(last), f(least(first, last, f))].into_iter().fold(f64::INFINITY, f64::min)
        };
        Some([lowest(&enters), -lowest(&leaves)])
    }

    /// Distance by which the line misses the tool, in a measure that is convex in the place of the line; zero where it
    /// meets.
    fn clearance(&self, origin: DVec3, way: DVec3) -> f64 {
        let (bottom, top) = (self.elements[0].start().y, self.elements[self.elements.len() - 1].end().y);
        let place = |s: f64| {
            let p = origin + way * s;
            let rho = p.truncate().length();
            let mut off = (bottom - p.z).max(p.z - top).max(0.0);
            for shape in &self.elements {
                off = off.max(beyond(shape, DVec2::new(rho, p.z)));
            }
            off
        };
        let middle = -origin.dot(way);
        let reach = origin.length() + top.abs().max(bottom.abs()) + self.radius;
        let s = least(middle - 2.0 * reach, middle + 2.0 * reach, &place);
        place(s)
    }

    /// The stretch of the line between two heights, and no farther from the axis than the tool is wide.
    fn slab(&self, origin: DVec3, way: DVec3, low: f64, high: f64) -> Option<[f64; 2]> {
        let (mut a, mut b) = (f64::NEG_INFINITY, f64::INFINITY);
        if way.z == 0.0 {
            if origin.z < low || origin.z > high {
                return None;
            }
        } else {
            let ends = [(low - origin.z) / way.z, (high - origin.z) / way.z];
            (a, b) = (ends[0].min(ends[1]), ends[0].max(ends[1]));
        }
        let (o, d) = (origin.truncate(), way.truncate());
        let square = d.length_squared();
        if square > 0.0 {
            let off = o.perp_dot(d);
            let room = self.radius * self.radius * square - off * off;
            if room < 0.0 {
                return None;
            }
            let (middle, half) = (-o.dot(d) / square, room.sqrt() / square);
            (a, b) = (a.max(middle - half), b.min(middle + half));
        } else if o.length() > self.radius {
            return None;
        }
        (a <= b).then_some([a, b])
    }
}

/// Distance of a point of the half-section beyond a convex element's tangent or circle [mm], if outside of it.
fn beyond(shape: &ContourShape, q: DVec2) -> f64 {
    match *shape {
        ContourShape::Line { start, end } => {
            let t = (end - start).try_normalize().unwrap_or(DVec2::X);
            (q - start).dot(DVec2::new(t.y, -t.x))
        }
        ContourShape::Arc { centre, radius, from, to, .. } => {
            // Farthest beyond of all tangents: that in the direction of the point, or the nearest of the arc.
            let r = q - centre;
            let phi = r.y.atan2(r.x).clamp(from.min(to), from.max(to));
            r.dot(DVec2::from_angle(phi)) - radius
        }
    }
}

/// The part of a stretch of the line inside of one piece's slab.
fn inside(shape: &ContourShape, origin: DVec3, way: DVec3, [a, b]: [f64; 2]) -> Option<[f64; 2]> {
    let place = |s: f64| {
        let p = origin + way * s;
        let rho = p.truncate().length();
        let rate = if rho > 0.0 { p.truncate().dot(way.truncate()) / rho } else { 0.0 };
        let (x, slope) = width(shape, p.z);
        (rho - x, rate - slope * way.z)
    };
    // The lowest place of a convex function, by the sign of its derivative.
    let [high, low] = bisected([b, a], HALVINGS, |m| place(m).1 > 0.0);
    let lowest = [a, b, 0.5 * (low + high)].into_iter().min_by(|x, y| place(*x).0.total_cmp(&place(*y).0))?;
    if place(lowest).0 > 0.0 {
        return None;
    }
    let root = |end: f64| {
        if place(end).0 <= 0.0 {
            return end;
        }
        // Grows from the lowest place to the end.
        let sense = if end > lowest { 1.0 } else { -1.0 };
        let f = |y: f64| {
            let (value, slope) = place(sense * y);
            (value, sense * slope)
        };
        sense * bracketed_newton(f, 0.5 * sense * (lowest + end), sense * lowest, sense * end, LIMIT).0
    };
    Some([root(a), root(b)])
}

/// Radius of an element at a height, and its derivative.
fn width(shape: &ContourShape, z: f64) -> (f64, f64) {
    match *shape {
        ContourShape::Line { start, end } => {
            let slope = (end.x - start.x) / (end.y - start.y);
            (start.x + slope * (z - start.y), slope)
        }
        ContourShape::Arc { centre, radius, .. } => {
            let off = z - centre.y;
            let half = ((radius - off) * (radius + off)).max(0.0).sqrt();
            (centre.x + half, -off / half)
        }
    }
}

/// Place at which a convex function is least, by the golden section.
fn least(mut a: f64, mut b: f64, f: &dyn Fn(f64) -> f64) -> f64 {
    let (mut c, mut d) = (b - GOLDEN * (b - a), a + GOLDEN * (b - a));
    let (mut fc, mut fd) = (f(c), f(d));
    for _ in 0..STEPS {
        if fc <= fd {
            (b, d, fd) = (d, c, fc);
            c = b - GOLDEN * (b - a);
            fc = f(c);
        } else {
            (a, c, fc) = (c, d, fd);
            d = a + GOLDEN * (b - a);
            fd = f(d);
        }
    }
    if fc <= fd { c } else { d }
}
