//! A line along an axis of the stock against a convex part of a tool at one pose: the stretch inside, in closed form but for an
//! arc whose centre lies beside the axis, and the gauge, a convex function that is negative inside.

use glam::DVec3;

use super::super::body::{ConvexPart, Foot, Touch};
use super::span::Pose;

/// A line, seen from a pose.
#[derive(Clone, Copy, Debug)]
pub(super) struct LineFrom {
    /// The place of the line at the coordinate 0, from the tip.
    start: DVec3,
    axis: DVec3,
    /// Index of the coordinate along the line.
    along: usize,
    /// Height above the tip: `height + rise * s`.
    height: f64,
    rise: f64,
    /// Squared distance from the axis: `(a s + 2 b) s + c`.
    a: f64,
    b: f64,
    c: f64,
}

/// The stretch of a line inside a part.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Chord {
    pub(super) lo: f64,
    pub(super) hi: f64,
    pub(super) lo_at: Touch,
    pub(super) hi_at: Touch,
}

/// The gauge of a part at a point.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Gauge {
    /// Negative inside, no more than the distance outside [mm].
    pub(super) value: f64,
    /// Its gradient: a unit vector, or zero where the part is as deep all around.
    pub(super) normal: DVec3,
}

/// Sine below which a line lies in a plane across the axis of the tool: over ten metres it is off by 10 nm.
const LEVEL: f64 = 1e-12;

/// Squares of sines below this make a line parallel to the axis of the tool.
const PARALLEL: f64 = 1e-24;

impl LineFrom {
    /// The line through `start`, whose coordinate `along` is 0.
    pub(super) fn new(start: DVec3, along: usize, pose: &Pose) -> LineFrom {
        let from = start - pose.tip;
        let (height, rise) = (from.dot(pose.axis), pose.axis[along]);
        let beside = from - pose.axis * height;
        let across = DVec3::AXES[along] - pose.axis * rise;
        LineFrom {
            start: from,
            axis: pose.axis,
            along,
            height,
            rise,
            a: across.length_squared(),
            b: beside.dot(across),
            c: beside.length_squared(),
        }
    }

    /// The point at a coordinate, from the tip.
    pub(super) fn point(&self, s: f64) -> DVec3 {
        let mut p = self.start;
        p[self.along] += s;
        p
    }

    /// Coefficients of the squared distance from the axis: `(a s + 2 b) s + c`.
    pub(super) fn square(&self) -> [f64; 3] {
        [self.a, self.b, self.c]
    }

    /// Height above the tip at the coordinate 0, and its rise.
    pub(super) fn heights(&self) -> [f64; 2] {
        [self.height, self.rise]
    }

    /// The part of a stretch within a radius and between two heights; `None` when nothing of it is.
    pub(super) fn within(
        &self,
        [mut lo, mut hi]: [f64; 2],
        radius: f64,
        heights: [f64; 2],
    ) -> Option<[f64; 2]> {
        let mut cut = |x: f64, y: f64| (lo, hi) = (lo.max(x.min(y)), hi.min(x.max(y)));
        if radius <= 0.0 {
            return None;
        } else if self.a > 0.0 {
            let (x, y) = roots(self.a, self.b, self.c - radius * radius)?;
            cut(x, y);
        } else if self.c > radius * radius {
            return None;
        }
        if self.rise != 0.0 {
            cut((heights[0] - self.height) / self.rise, (heights[1] - self.height) / self.rise);
        } else if self.height < heights[0] || self.height > heights[1] {
            return None;
        }
        (lo < hi).then_some([lo, hi])
    }

    /// Distance from the axis of the tool at a coordinate, and the height above the tip.
    pub(super) fn place(&self, s: f64) -> (f64, f64) {
        let square = (self.a * s + 2.0 * self.b) * s + self.c;
        (square.clamp(0.0, f64::INFINITY).sqrt(), self.height + self.rise * s)
    }

    /// The gauge of a part at a coordinate.
    pub(super) fn gauge(&self, part: &ConvexPart, s: f64) -> Gauge {
        self.gauge_but(part, s, None)
    }

    /// The gauge of a part without one of its features.
    pub(super) fn gauge_but(&self, part: &ConvexPart, s: f64, without: Option<Touch>) -> Gauge {
        let (rho, z) = self.place(s);
        let (value, gradient) = gauge_in_section(part, rho, z, without);
        Gauge { value, normal: self.normal(s, rho, gradient) }
    }

    /// A vector by its radial and axial component at a coordinate.
    pub(super) fn normal(&self, s: f64, rho: f64, (radial, axial): (f64, f64)) -> DVec3 {
        let point = self.point(s);
        let out = if rho > 0.0 { (point - self.axis * point.dot(self.axis)) / rho } else { DVec3::ZERO };
        out * radial + self.axis * axial
    }

    /// Outward unit normal of a part at a coordinate, by the feature that is there.
    pub(super) fn outward(&self, part: &ConvexPart, s: f64, touch: Touch) -> DVec3 {
        let (rho, z) = self.place(s);
        let gradient = match (touch, part.foot) {
            (Touch::Disc, _) => (0.0, -1.0),
            (Touch::Top, _) => (0.0, 1.0),
            (Touch::Foot, Foot::Cone { rise }) => (rise / rise.hypot(1.0), -1.0 / rise.hypot(1.0)),
            (Touch::Foot, Foot::Torus { .. }) => round(part, rho, z).1,
            (Touch::Foot, Foot::Flat) | (Touch::Rim | Touch::Edge, _) => (1.0, 0.0),
        };
        self.normal(s, rho, gradient)
    }

    /// The stretch of the line inside a part; `None` when the line passes it by.
    pub(super) fn chord(&self, part: &ConvexPart) -> Option<Chord> {
        let mut chord =
            Chord { lo: f64::NEG_INFINITY, hi: f64::INFINITY, lo_at: Touch::Rim, hi_at: Touch::Rim };
        // Between floor and top.
        let (floor, top) = (part.z0 - self.height, part.top - self.height);
        if self.rise > LEVEL {
            chord.cut(floor / self.rise, top / self.rise, Touch::Disc, Touch::Top);
        } else if self.rise < -LEVEL {
            chord.cut(top / self.rise, floor / self.rise, Touch::Top, Touch::Disc);
        } else if !(floor <= 0.0 && top >= 0.0) {
            return None;
        }
        // Within the cylinder.
        if self.a > PARALLEL {
            let (lo, hi) = roots(self.a, self.b, self.c - part.r1 * part.r1)?;
            chord.cut(lo, hi, Touch::Rim, Touch::Rim);
        } else if self.c > part.r1 * part.r1 {
            return None;
        }
        if !(chord.lo < chord.hi && chord.lo.is_finite() && chord.hi.is_finite()) {
            return None;
        }
        match part.foot {
            Foot::Flat => {}
            Foot::Cone { rise } => self.cone(part, rise, &mut chord)?,
            Foot::Torus { .. } => self.torus(part, &mut chord)?,
        }
        (chord.lo < chord.hi).then_some(chord)
    }

    /// Cuts a chord to the cone of the foot: rho <= k + m s.
    fn cone(&self, part: &ConvexPart, rise: f64, chord: &mut Chord) -> Option<()> {
        let (k, m) = (part.r0 + (self.height - part.z0) / rise, self.rise / rise);
        let (a, b, c) = (self.a - m * m, self.b - k * m, self.c - k * k);
        let (lo, hi) = if a > 0.0 {
            roots(a, b, c)?
        } else if a < 0.0 {
            // Inside beyond either root: on the side on which the radius of the cone is positive.
            let (x, y) = roots(-a, -b, -c).unwrap_or((-b / a, -b / a));
            if m > 0.0 { (y, f64::INFINITY) } else { (f64::NEG_INFINITY, x) }
        } else if b != 0.0 {
            let s = -0.5 * c / b;
            if b > 0.0 { (f64::NEG_INFINITY, s) } else { (s, f64::INFINITY) }
        } else if c <= 0.0 {
            (f64::NEG_INFINITY, f64::INFINITY)
        } else {
            return None;
        };
        chord.cut(lo, hi, Touch::Foot, Touch::Foot);
        Some(())
    }

    /// Cuts a chord to the round of the foot: by Newton's steps from outside, which never go too far in a convex body.
    fn torus(&self, part: &ConvexPart, chord: &mut Chord) -> Option<()> {
        // What is left after a step goes with its square over the radius.
        let enough = if let Foot::Torus { radius, .. } = part.foot { 1e-12 * radius } else { 0.0 };
        for forth in [1.0, -1.0] {
            let (mut s, end) = if forth > 0.0 { (chord.lo, chord.hi) } else { (chord.hi, chord.lo) };
            let mut moved = false;
            if let Foot::Torus { centre_radius: 0.0, centre_z, radius } = part.foot {
                let (rho, z) = self.place(s);
                let below = z - centre_z;
                if below >= 0.0 || rho * rho + below * below <= radius * radius {
                    continue;
                }
                // The distance from the centre of the ball, squared: the parts along and across the axis together.
                let up = self.height - centre_z;
                let (lo, hi) = roots(1.0, self.b + up * self.rise, self.c + up * up - radius * radius)?;
                let next = if forth > 0.0 { lo } else { hi };
                if forth * next > forth * end {
                    return None;
                }
                if forth > 0.0 {
                    (chord.lo, chord.lo_at) = (next, Touch::Foot);
                } else {
                    (chord.hi, chord.hi_at) = (next, Touch::Foot);
                }
                continue;
            }
            for _ in 0..60 {
                let (rho, z) = self.place(s);
                let (value, (radial, axial)) = round(part, rho, z);
                if value <= 1e-12 {
                    break;
                }
                let slope = forth
                    * (axial * self.rise
                        + if rho > 0.0 { radial * (self.a * s + self.b) / rho } else { 0.0 });
                let next = s - forth * value / slope;
                if !(slope < 0.0) || forth * next > forth * end {
                    return None;
                }
                moved = true;
                let step = next - s;
                s = next;
                if step * step <= enough {
                    break;
                }
            }
            if moved && forth > 0.0 {
                (chord.lo, chord.lo_at) = (s, Touch::Foot);
            } else if moved {
                (chord.hi, chord.hi_at) = (s, Touch::Foot);
            }
        }
        Some(())
    }
}

impl Chord {
    fn cut(&mut self, lo: f64, hi: f64, lo_at: Touch, hi_at: Touch) {
        if lo > self.lo {
            (self.lo, self.lo_at) = (lo, lo_at);
        }
        if hi < self.hi {
            (self.hi, self.hi_at) = (hi, hi_at);
        }
    }
}

/// The gauge of a part at a pose and a point of the stock.
pub(super) fn gauge_at(part: &ConvexPart, pose: &Pose, point: DVec3) -> Gauge {
    let from = point - pose.tip;
    let z = from.dot(pose.axis);
    let beside = from - pose.axis * z;
    let rho = beside.length();
    let (value, (radial, axial)) = gauge_in_section(part, rho, z, None);
    let out = if rho > 0.0 { beside / rho } else { DVec3::ZERO };
    Gauge { value, normal: out * radial + pose.axis * axial }
}

/// The gauge of a part at a pose and a point of the stock, and its second derivative there: the sum of the squares of two vectors,
/// of that along the section of the part and of that around its axis.
pub(super) fn curved_gauge_at(part: &ConvexPart, pose: &Pose, point: DVec3) -> (Gauge, [DVec3; 2]) {
    let from = point - pose.tip;
    let z = from.dot(pose.axis);
    let beside = from - pose.axis * z;
    let rho = beside.length();
    let (value, (radial, axial)) = gauge_in_section(part, rho, z, None);
    let (out, around) =
        if rho > 0.0 { (beside / rho, (radial.max(0.0) / rho).sqrt()) } else { (DVec3::ZERO, 0.0) };
    let along = match part.foot {
        Foot::Torus { radius, .. } if radial > 0.0 && axial < 0.0 => 1.0 / (radius + value).max(0.0).sqrt(),
        _ => 0.0,
    };
    let curves = [(pose.axis * radial - out * axial) * along, pose.axis.cross(out) * around];
    (Gauge { value, normal: out * radial + pose.axis * axial }, curves)
}

/// The gauge of a part, at a distance from its axis and a height above its tip, and its radial and axial gradient; without one of
/// the part's features.
fn gauge_in_section(part: &ConvexPart, rho: f64, z: f64, without: Option<Touch>) -> (f64, (f64, f64)) {
    // Value, radial and axial component of the gradient.
    let mut best = (f64::NEG_INFINITY, (0.0, -1.0));
    let mut take = |value: f64, gradient: (f64, f64), touch: Touch| {
        if value > best.0 && without != Some(touch) {
            best = (value, gradient);
        }
    };
    take(part.z0 - z, (0.0, -1.0), Touch::Disc);
    take(z - part.top, (0.0, 1.0), Touch::Top);
    take(rho - part.r1, (1.0, 0.0), Touch::Rim);
    match part.foot {
        Foot::Flat => {}
        // Above the centre of a round foot its gauge repeats that of the cylinder.
        Foot::Torus { centre_z, .. } if without.is_some() && z >= centre_z => {}
        Foot::Cone { rise } => {
            let length = rise.hypot(1.0);
            let value = ((rho - part.r0) * rise - (z - part.z0)) / length;
            take(value, (rise / length, -1.0 / length), Touch::Foot);
        }
        Foot::Torus { .. } => {
            let (value, gradient) = round(part, rho, z);
            take(value, gradient, Touch::Foot);
        }
    }
    best
}

/// Gauge of a round foot, and its radial and axial gradient.
fn round(part: &ConvexPart, rho: f64, z: f64) -> (f64, (f64, f64)) {
    let Foot::Torus { centre_radius, centre_z, radius } = part.foot else {
        return (f64::NEG_INFINITY, (0.0, -1.0));
    };
    let (out, up) = (rho - centre_radius, z - centre_z);
    let (x, y) = (out.max(0.0), up.min(0.0));
    let h = (x * x + y * y).sqrt();
    if h > 0.0 {
        (h - radius, (x / h, y / h))
    } else if out > -up {
        // Beside the sector of its normals it goes on as its ends do.
        (out - radius, (1.0, 0.0))
    } else {
        (-up - radius, (0.0, -1.0))
    }
}

/// The roots of `a s^2 + 2 b s + c` with `a > 0`, the lesser first.
pub(super) fn roots(a: f64, b: f64, c: f64) -> Option<(f64, f64)> {
    let d = b * b - a * c;
    if !(d >= 0.0) {
        return None;
    }
    // Without a difference of nearly equal numbers.
    let q = -(b + d.sqrt().copysign(b));
    if q == 0.0 {
        return Some((0.0, 0.0));
    }
    let (x, y) = (q / a, c / q);
    Some(if x < y { (x, y) } else { (y, x) })
}
