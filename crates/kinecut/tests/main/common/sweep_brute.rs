//! What a moving tool sweeps, by brute force: the least signed distance of a point from the tool over all moments.
//!
//! Nothing of the closed forms is used: the distance is that of a point from lines, arcs and corners of the half-section.

use glam::{DVec2, DVec3};
use kinecut::sweep::ToolMotion;
use kinecut::tool::{Contour, ContourShape};

pub(crate) struct Brute {
    elements: Vec<ContourShape>,
    /// Corners, the sense of their turn (0 where there is none), and the normal before.
    corners: Vec<(DVec2, f64, DVec2)>,
}

/// Samples of a move that miss nothing but what hardly counts.
pub(crate) const MANY: usize = 2048;

fn normal(shape: &ContourShape, end: usize) -> DVec2 {
    DVec2::from_angle(shape.normals()[end])
}

impl Brute {
    pub(crate) fn new(contour: &Contour) -> Brute {
        let elements: Vec<ContourShape> = contour.elements().iter().map(|e| e.shape).collect();
        let mut corners = Vec::new();
        for pair in elements.windows(2) {
            let (a, b) = (normal(&pair[0], 1), normal(&pair[1], 0));
            let turn = a.perp_dot(b);
            let smooth = turn.abs() < 1e-12 && a.dot(b) > 0.0;
            corners.push((pair[0].end(), if smooth { 0.0 } else { turn.signum() }, a));
        }
        let (first, last) = (&elements[0], &elements[elements.len() - 1]);
        for (shape, at, end) in [(first, first.start(), 0), (last, last.end(), 1)] {
            let n = normal(shape, end);
            corners.push((at, if n.x.abs() < 1e-12 { 0.0 } else { n.x.signum() }, n));
        }
        Brute { elements, corners }
    }

    /// Signed distance of a point from the tool [tool coordinates], negative inside.
    pub(crate) fn distance(&self, p: DVec3) -> f64 {
        let q = DVec2::new(p.truncate().length(), p.z);
        let (mut best, mut signed) = (f64::INFINITY, f64::INFINITY);
        let mut take = |d: f64, sign: f64| {
            if d < best {
                (best, signed) = (d, d * sign);
            }
        };
        for &(at, turn, n) in &self.corners {
            let r = q - at;
            let sign = if turn != 0.0 {
                turn
            } else if r.dot(n) >= 0.0 {
                1.0
            } else {
                -1.0
            };
            take(r.length(), sign);
        }
        for shape in &self.elements {
            match *shape {
                ContourShape::Line { start, end } => {
                    let t = (end - start).normalize_or_zero();
                    let r = q - start;
                    let along = r.dot(t);
                    if along >= 0.0 && along <= (end - start).length() {
                        let off = r.dot(DVec2::new(t.y, -t.x));
                        take(off.abs(), off.signum());
                    }
                }
                ContourShape::Arc { centre, radius, convex, from, to } => {
                    let s = if convex { 1.0 } else { -1.0 };
                    let r = (q - centre) * s;
                    let angle = r.y.atan2(r.x);
                    if angle >= from.min(to) && angle <= from.max(to) {
                        let off = s * (r.length() - radius);
                        take(off.abs(), off.signum());
                    }
                }
            }
        }
        signed
    }

    fn at(&self, motion: &ToolMotion, t: f64, p: DVec3) -> f64 {
        self.distance(motion.pose(t).inverse().point(p))
    }

    /// Least signed distance of a point from the tool over the whole move: negative inside of what is swept.
    pub(crate) fn swept(&self, motion: &ToolMotion, p: DVec3, samples: usize) -> f64 {
        let h = 1.0 / samples as f64;
        let f: Vec<f64> = (0..=samples).map(|k| self.at(motion, k as f64 * h, p)).collect();
        let mut lows: Vec<usize> = (0..=samples)
            .filter(|&k| (k == 0 || f[k] <= f[k - 1]) && (k == samples || f[k] <= f[k + 1]))
            .collect();
        lows.sort_by(|&a, &b| f[a].total_cmp(&f[b]));
        let mut best = f64::INFINITY;
        for &k in lows.iter().take(3) {
            best = best.min(f[k]);
            let (mut a, mut b) = ((k as f64 - 1.0).max(0.0) * h, ((k + 1) as f64 * h).min(1.0));
            const G: f64 = 0.618_033_988_749_895;
            let (mut c, mut d) = (b - G * (b - a), a + G * (b - a));
            let (mut fc, mut fd) = (self.at(motion, c, p), self.at(motion, d, p));
            for _ in 0..40 {
                if fc < fd {
                    (b, d, fd) = (d, c, fc);
                    c = b - G * (b - a);
                    fc = self.at(motion, c, p);
                } else {
                    (a, c, fc) = (c, d, fd);
                    d = a + G * (b - a);
                    fd = self.at(motion, d, p);
                }
            }
            best = best.min(fc).min(fd);
        }
        best
    }

    /// As [`Brute::first`]. Few samples may miss a short contact, and the line then goes on into what is swept: seen with many,
    /// it is gone again.
    pub(crate) fn first_surely(
        &self,
        motion: &ToolMotion,
        from: DVec3,
        way: DVec3,
        most: f64,
    ) -> Option<DVec3> {
        let quick = self.first(motion, from, way, most, 64)?;
        if self.swept(motion, quick, MANY) > -1e-6 {
            Some(quick)
        } else {
            self.first(motion, from, way, most, MANY)
        }
    }

    /// Where a line from outside first meets what is swept.
    pub(crate) fn first(
        &self,
        motion: &ToolMotion,
        from: DVec3,
        way: DVec3,
        most: f64,
        samples: usize,
    ) -> Option<DVec3> {
        let mut s = 0.0;
        for _ in 0..400 {
            let p = from + way * s;
            let d = self.swept(motion, p, samples);
            if d < 1e-8 {
                return Some(p);
            }
            s += d;
            if s > most {
                return None;
            }
        }
        None
    }
}
