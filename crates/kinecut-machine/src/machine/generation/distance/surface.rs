//! Distance from any parametric surface.
//!
//! The domain is cut into cells, each inside a ball around its middle. The foot is found from the nearest cell, then from
//! every other one that can still hold a nearer point, by Newton's method on the squared distance, damped and kept
//! inside the domain.

use glam::{DMat2, DVec2, DVec3};

use super::Distance;
use crate::base::{Code, Finding, Result};

/// A map from two variables to points of a surface.
pub trait SurfaceMap: Sync {
    /// The point at (u, v) [mm].
    fn point(&self, u: f64, v: f64) -> DVec3;
}

impl<F: Fn(f64, f64) -> DVec3 + Sync> SurfaceMap for F {
    fn point(&self, u: f64, v: f64) -> DVec3 {
        self(u, v)
    }
}

/// A patch of a parametric surface. Positive is the side of `r_u x r_v`. Where the nearest point is on the border the
/// distance is that of the border: give a domain that reaches beyond what is compared.
#[derive(Clone, Debug)]
pub struct ParametricSurface<S> {
    map: S,
    domain: [[f64; 2]; 2],
    sign: f64,
    cells: Vec<Cell>,
}

/// A cell: its middle in the domain, a point near it and the radius of a ball that holds it.
#[derive(Clone, Copy, Debug)]
struct Cell {
    middle: DVec2,
    centre: DVec3,
    radius: f64,
}

impl<S: SurfaceMap> ParametricSurface<S> {
    /// A patch over `domain` (ranges of u and v), cut into `cells` by `cells`; `inward` turns the positive side over.
    ///
    /// # Errors
    /// `KC1131` for a domain that is empty, no cell, or a point that is not finite.
    pub fn new(
        map: S,
        domain: [[f64; 2]; 2],
        cells: [usize; 2],
        inward: bool,
    ) -> Result<ParametricSurface<S>> {
        let [u, v] = domain;
        if !(u[1] > u[0] && v[1] > v[0] && cells[0] > 0 && cells[1] > 0) {
            return Err(Finding::error(Code::GENERATION_INPUT, "the domain of a surface is empty")
                .value(u[1] - u[0], "")
                .bound(0.0, "")
                .help("give ranges whose end is above their start, and a cell or more")
                .into());
        }
        let [nu, nv] = cells;
        let at = |i: usize, j: usize| {
            // Halves of cells: even numbers are corners.
            let u = u[0] + (u[1] - u[0]) * i as f64 / (2 * nu) as f64;
            let v = v[0] + (v[1] - v[0]) * j as f64 / (2 * nv) as f64;
            (DVec2::new(u, v), map.point(u, v))
        };
        let mut list = Vec::with_capacity(nu * nv);
        for i in 0..nu {
            for j in 0..nv {
                let (middle, centre) = at(2 * i + 1, 2 * j + 1);
                let mut radius = 0.0f64;
                for (k, l) in [(0, 0), (1, 0), (2, 0), (0, 1), (2, 1), (0, 2), (1, 2), (2, 2)] {
                    let gap = at(2 * i + k, 2 * j + l).1.distance(centre);
                    if !gap.is_finite() {
                        return Err(Finding::error(
                            Code::GENERATION_INPUT,
                            "a point of a surface is not finite",
                        )
                        .value(middle.x, "")
                        .help("choose parameters and ranges for which the laws have values")
                        .into());
                    }
                    radius = radius.max(gap);
                }
                list.push(Cell { middle, centre, radius: radius * BULGE });
            }
        }
        Ok(ParametricSurface { map, domain, sign: if inward { -1.0 } else { 1.0 }, cells: list })
    }

    /// The nearest point of the patch: its variables and its place [mm].
    pub fn foot(&self, p: DVec3) -> (DVec2, DVec3) {
        let bound = |cell: &Cell| p.distance(cell.centre) - cell.radius;
        // The cell whose middle is nearest comes first, so that nearly all others are out of question.
        let first = self
            .cells
            .iter()
            .min_by(|a, b| p.distance_squared(a.centre).total_cmp(&p.distance_squared(b.centre)));
        let mut best = (f64::INFINITY, DVec2::ZERO, DVec3::ZERO);
        for cell in first.into_iter().chain(&self.cells) {
            if best.0 < TOUCHING {
                break;
            }
            if bound(cell) > best.0 {
                continue;
            }
            let at = self.descend(p, cell.middle);
            let place = self.map.point(at.x, at.y);
            let distance = p.distance(place);
            if distance < best.0 {
                best = (distance, at, place);
            }
        }
        (best.1, best.2)
    }

    /// The normal on the positive side at (u, v); zero where the surface has none.
    pub fn normal(&self, at: DVec2) -> DVec3 {
        let [u, v] = self.derivatives(at).0;
        u.cross(v).normalize_or_zero() * self.sign
    }

    /// First derivatives, and second ones (uu, uv, vv), by differences of a stencil that is pushed into the domain.
    fn derivatives(&self, at: DVec2) -> ([DVec3; 2], [DVec3; 3]) {
        let h = DVec2::new(self.domain[0][1] - self.domain[0][0], self.domain[1][1] - self.domain[1][0])
            * STENCIL;
        let f = |i: f64, j: f64| self.map.point(at.x + i * h.x, at.y + j * h.y);
        let (o, r, l, t, b) = (f(0.0, 0.0), f(1.0, 0.0), f(-1.0, 0.0), f(0.0, 1.0), f(0.0, -1.0));
        let mixed = (f(1.0, 1.0) - f(1.0, -1.0) - f(-1.0, 1.0) + f(-1.0, -1.0)) / (4.0 * h.x * h.y);
        (
            [(r - l) / (2.0 * h.x), (t - b) / (2.0 * h.y)],
            [(r - o * 2.0 + l) / (h.x * h.x), mixed, (t - o * 2.0 + b) / (h.y * h.y)],
        )
    }

    fn clamped(&self, at: DVec2) -> DVec2 {
        let [u, v] = self.domain;
        DVec2::new(at.x.clamp(u[0], u[1]), at.y.clamp(v[0], v[1]))
    }

    /// The foot of `p` from a start, as the least squared distance.
    fn descend(&self, p: DVec3, start: DVec2) -> DVec2 {
        let value = |at: DVec2| p.distance_squared(self.map.point(at.x, at.y));
        let (mut at, mut squared, mut damping) = (start, value(start), 0.0);
        for _ in 0..STEPS {
            let ([du, dv], [uu, uv, vv]) = self.derivatives(at);
            let gap = self.map.point(at.x, at.y) - p;
            let slope = DVec2::new(du.dot(gap), dv.dot(gap));
            let metric = DVec2::new(du.length_squared(), dv.length_squared());
            // A variable at its end that the slope pushes outwards stays there.
            let held = |k: usize| {
                let [lo, hi] = self.domain[k];
                (at[k] <= lo && slope[k] > 0.0) || (at[k] >= hi && slope[k] < 0.0) || metric[k] <= 0.0
            };
            let (hold_u, hold_v) = (held(0), held(1));
            let mixed = if hold_u || hold_v { 0.0 } else { du.dot(dv) };
            let flat = DMat2::from_cols_array(&[metric.x, mixed, mixed, metric.y]);
            let bend = if hold_u || hold_v { 0.0 } else { uv.dot(gap) };
            let bent = flat + DMat2::from_cols_array(&[uu.dot(gap), bend, bend, vv.dot(gap)]);
            let convex = bent.determinant() > CONVEX * metric.x * metric.y && bent.x_axis.x > 0.0;
            let mut matrix = if convex { bent } else { flat * 2.0 };
            matrix += DMat2::from_diagonal(metric * damping);
            let step = DVec2::new(if hold_u { 0.0 } else { 1.0 }, if hold_v { 0.0 } else { 1.0 });
            let mut slope = slope * step;
            if hold_u {
                matrix = DMat2::from_diagonal(DVec2::new(1.0, matrix.y_axis.y));
            }
            if hold_v {
                matrix = DMat2::from_diagonal(DVec2::new(matrix.x_axis.x, 1.0));
            }
            if matrix.determinant() == 0.0 {
                slope = DVec2::ZERO;
            }
            let next = self.clamped(at - matrix.inverse() * slope);
            if !next.is_finite() || next == at {
                return at;
            }
            let less = value(next);
            if less < squared {
                let gain = squared - less;
                (at, squared) = (next, less);
                damping *= 0.1;
                if gain <= GAIN * squared {
                    return at;
                }
            } else {
                if damping > MOST_DAMPING {
                    return at;
                }
                damping = (damping * 8.0).max(FIRST_DAMPING);
            }
        }
        at
    }
}

impl<S: SurfaceMap> Distance for ParametricSurface<S> {
    fn signed(&self, p: DVec3) -> f64 {
        let (at, place) = self.foot(p);
        let distance = p.distance(place);
        if self.normal(at).dot(p - place) < 0.0 { -distance } else { distance }
    }

    fn gradient(&self, p: DVec3) -> DVec3 {
        self.normal(self.foot(p).0)
    }
}

/// Factor by which a cell may reach farther from its middle than its corners and the middles of its sides.
const BULGE: f64 = 1.25;
/// Distance at which a point is on the surface, so that nothing nearer is looked for [mm].
const TOUCHING: f64 = 1e-11;
/// Step of differences as a share of the domain: second differences are best at the fourth root of the rounding unit.
const STENCIL: f64 = 1e-4;
/// Most steps of the descent; Newton needs about six, the damped steps of a flat valley more.
const STEPS: usize = 60;
/// Gain, relative to the squared distance, that is lost in rounding.
const GAIN: f64 = 1e-15;
/// Share of the determinant below which the squared distance counts as not convex.
const CONVEX: f64 = 1e-3;
/// Damping after a first step that failed, and the one at which steps are lost in rounding.
const FIRST_DAMPING: f64 = 1e-3;
const MOST_DAMPING: f64 = 1e12;
