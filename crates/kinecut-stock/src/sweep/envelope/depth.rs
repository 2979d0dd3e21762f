//! The depth of a point in what a tool sweeps: that in the tool at the moment when it is deepest.
//!
//! In the tool it is the distance from the contour, inside where a level ray outwards crosses it an odd number of times. Over a move it is
//! sought at moments so near to one another that the tool goes no farther between two of them than a part of its radius, and from the deepest two on
//! by golden section. A point that is found inside is inside; one that a tool grazes for less than a moment can be missed.

use std::f64::consts::{FRAC_PI_2, PI, TAU};

use glam::{DVec2, DVec3};

use crate::geom::Rigid;
use crate::sweep::ToolMotion;
use crate::tool::{Contour, ContourShape};

/// Way of the tool between two moments, in its radius.
const WAY: f64 = 0.25;
/// Fewest and most moments.
const MOMENTS: [f64; 2] = [32.0, 2048.0];
/// Steps of golden section.
const STEPS: u32 = 24;
const GOLDEN: f64 = 0.618_033_988_749_895;

/// A point in what is swept.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Depth {
    /// Depth [mm]; negative outside, then less than the distance.
    pub depth: f64,
    /// Outward normal of the tool where it is nearest to the point at that moment [workpiece coordinates].
    pub normal: DVec3,
}

/// The tool and its move.
#[derive(Clone, Debug)]
pub struct SweptDepth<'a> {
    motion: &'a ToolMotion,
    /// Elements; arcs that go up or down all the way.
    shapes: Vec<ContourShape>,
    /// Poses at equal moments, from the workpiece to the tool.
    back: Vec<Rigid>,
}

impl<'a> SweptDepth<'a> {
    /// Of a tool in a move.
    ///
    /// ```
    /// # use kinecut_stock as kinecut;
    /// use glam::DVec3;
    /// use kinecut::geom::Line;
    /// use kinecut::sweep::{SweptDepth, ToolMotion};
    /// use kinecut::tool::{Contour, ContourElement, DOWN, ElementRole, UP};
    /// let ball = Contour::new(vec![ContourElement::arc([0.0, 5.0], 5.0, DOWN, UP, ElementRole::Cutting)]).unwrap();
    /// let line = Line { start: DVec3::ZERO, end: DVec3::new(30.0, 0.0, 0.0) };
    /// let motion = ToolMotion::fixed(line.into(), DVec3::Z).unwrap();
    /// let depth = SweptDepth::new(&ball, &motion);
    /// // 3 mm beside the middle of the ball's way, and 4 mm above: 5 mm less 5 mm.
    /// assert!(depth.of(DVec3::new(13.0, 3.0, 9.0)).depth.abs() < 1e-6);
    /// assert!((depth.of(DVec3::new(13.0, 3.0, 6.0)).depth - (5.0 - 10f64.sqrt())).abs() < 1e-6);
    /// ```
    pub fn new(contour: &Contour, motion: &'a ToolMotion) -> SweptDepth<'a> {
        let [low, high] = contour.extent();
        let radius = contour.largest_radius();
        let reach = radius.hypot(low.abs().max(high.abs()));
        let fastest = (0..=32).map(|k| motion.speed(f64::from(k) / 32.0, reach)).fold(0.0, f64::max);
        let count = (fastest / (WAY * radius)).ceil().clamp(MOMENTS[0], MOMENTS[1]) as u32;
        let back = (0..=count).map(|k| motion.pose(f64::from(k) / f64::from(count)).inverse()).collect();
        let shapes = contour.elements().iter().flat_map(|e| parts(&e.shape)).collect();
        SweptDepth { motion, shapes, back }
    }

    /// The depth of a point of the workpiece [mm].
    pub fn of(&self, point: DVec3) -> Depth {
        let count = self.back.len() - 1;
        let at = |k: usize| self.in_tool(self.back[k].point(point)).0;
        // The two deepest moments of those that are deeper than the ones beside.
        let mut deepest = [(0, f64::NEG_INFINITY); 2];
        let mut near = [f64::NEG_INFINITY, at(0)];
        for k in 0..=count {
            let next = if k < count { at(k + 1) } else { f64::NEG_INFINITY };
            if near[1] >= near[0] && near[1] >= next {
                if near[1] > deepest[0].1 {
                    deepest = [(k, near[1]), deepest[0]];
                } else if near[1] > deepest[1].1 {
                    deepest[1] = (k, near[1]);
                }
            }
            near = [near[1], next];
        }
        let moment = |k: usize| k as f64 / count as f64;
        let found = deepest.iter().filter(|(_, depth)| depth.is_finite()).map(|(k, depth)| {
            let ends = [moment(k.saturating_sub(1)), moment((k + 1).min(count))];
            let (t, refined) = self.most(point, ends);
            if refined > *depth { (t, refined) } else { (moment(*k), *depth) }
        });
        let (t, depth) = found.fold((0.0, f64::NEG_INFINITY), |a, b| if b.1 > a.1 { b } else { a });
        let pose = self.motion.pose(t);
        let p = pose.inverse().point(point);
        let (_, normal) = self.in_tool(p);
        let out = p.truncate().try_normalize().unwrap_or(DVec2::X);
        Depth { depth, normal: pose.vector((out * normal.x).extend(normal.y)) }
    }

    /// The deepest moment between two, by golden section.
    fn most(&self, point: DVec3, [mut a, mut b]: [f64; 2]) -> (f64, f64) {
        let at = |t: f64| self.in_tool(self.motion.pose(t).inverse().point(point)).0;
        let (mut c, mut d) = (b - GOLDEN * (b - a), a + GOLDEN * (b - a));
        let (mut fc, mut fd) = (at(c), at(d));
        for _ in 0..STEPS {
            if fc > fd {
                (b, d, fd) = (d, c, fc);
                c = b - GOLDEN * (b - a);
                fc = at(c);
            } else {
                (a, c, fc) = (c, d, fd);
                d = a + GOLDEN * (b - a);
                fd = at(d);
            }
        }
        if fc > fd { (c, fc) } else { (d, fd) }
    }

    /// Depth in the tool, and the direction outwards in its half-section [tool coordinates].
    fn in_tool(&self, p: DVec3) -> (f64, DVec2) {
        let q = DVec2::new(p.truncate().length(), p.z);
        let (mut best, mut nearest, mut inside) = (f64::INFINITY, DVec2::ZERO, false);
        for shape in &self.shapes {
            let place = place(shape, q);
            let distance = (place - q).length();
            if distance < best {
                (best, nearest) = (distance, place);
            }
            inside ^= crosses(shape, q);
        }
        let out = if inside { nearest - q } else { q - nearest };
        (if inside { best } else { -best }, out.try_normalize().unwrap_or(DVec2::X))
    }
}

/// An element in parts whose height only grows or only falls.
fn parts(shape: &ContourShape) -> Vec<ContourShape> {
    let ContourShape::Arc { centre, radius, convex, from, to } = *shape else { return vec![*shape] };
    let (low, high) = (from.min(to), from.max(to));
    let first = ((low - FRAC_PI_2) / PI).floor() as i32 + 1;
    let turns = (first..).map(|k| FRAC_PI_2 + PI * f64::from(k)).take_while(|phi| *phi < high);
    let mut ends: Vec<f64> =
        std::iter::once(low).chain(turns.filter(|phi| *phi > low)).chain([high]).collect();
    if to < from {
        ends.reverse();
    }
    let part = |pair: &[f64]| ContourShape::Arc { centre, radius, convex, from: pair[0], to: pair[1] };
    ends.windows(2).map(part).collect()
}

/// The place of an element that is nearest to a point.
fn place(shape: &ContourShape, q: DVec2) -> DVec2 {
    match *shape {
        ContourShape::Line { start, end } => {
            let way = end - start;
            let t = (q - start).dot(way) / way.length_squared();
            // A line without length has no `t`.
            if t > 0.0 { start + way * t.min(1.0) } else { start }
        }
        ContourShape::Arc { centre, radius, convex, from, to } => {
            let sense = if convex { 1.0 } else { -1.0 };
            let r = (q - centre) * sense;
            let (low, high) = (from.min(to), from.max(to));
            let angle = low + (r.y.atan2(r.x) - low).rem_euclid(TAU);
            if angle <= high
                && let Some(out) = r.try_normalize()
            {
                return centre + out * (radius * sense);
            }
            let (a, b) = (shape.start(), shape.end());
            if (a - q).length_squared() < (b - q).length_squared() { a } else { b }
        }
    }
}

/// Whether the level ray outwards from a point crosses an element that only goes up or down.
fn crosses(shape: &ContourShape, q: DVec2) -> bool {
    let (start, end) = (shape.start(), shape.end());
    // Half-open heights: at a corner one of the two elements counts, or both or none where the way turns back.
    if (start.y <= q.y) == (end.y <= q.y) {
        return false;
    }
    let radius = match *shape {
        ContourShape::Line { .. } => start.x + (end.x - start.x) * ((q.y - start.y) / (end.y - start.y)),
        ContourShape::Arc { centre, radius, convex, from, to } => {
            let up = q.y - centre.y;
            let across = ((radius - up) * (radius + up)).max(0.0).sqrt();
            let side = (0.5 * (from + to)).cos() * if convex { 1.0 } else { -1.0 };
            centre.x + across.copysign(side)
        }
    };
    radius > q.x
}
