//! A convex part on its way along a piece: the lowest height at which it passes over many lines at once.
//!
//! The closed forms are those of `axial.rs`. On a straight path they are written without branches, so that the compiler takes
//! several lines in one instruction; over an arc each line is asked by itself. A height from a torus on a slope is that of a
//! place on its way near to the lowest one: it is never too low, and too high by less than rounding.

use glam::{DVec2, Vec2Swizzles};

use super::super::axial::hits;
use super::super::body::{ConvexPart, Foot};
use super::super::piece::MovePiece;
use super::super::plan::Plan;
use super::super::task::Task;

/// Lines along an edge of a block.
pub(super) const BLOCK: usize = 8;

/// A value for each line of a block, row by row.
pub(super) type BlockOf<T> = [[T; BLOCK]; BLOCK];

/// A convex part along a piece, in the coordinates of the grid along the tool axis: x and y count the lines.
pub(super) struct Sweep<'a> {
    pub(super) part: &'a ConvexPart,
    piece: MovePiece,
    /// Least height of the tip [mm].
    low: f64,
    straight: Option<Straight>,
}

/// A straight path, or a standing tool as one of no length.
#[derive(Clone, Copy)]
struct Straight {
    start: DVec2,
    /// Unit vector.
    way: DVec2,
    length: f64,
    /// Rise of the tip per mm of the way; 0 when the tool stands.
    slope: f64,
    /// Height of the tip at the start; of a standing tool the lowest.
    from: f64,
}

impl Straight {
    fn of(piece: &MovePiece) -> Option<Straight> {
        match piece.plan {
            Plan::Dot(start) => Some(Straight {
                start,
                way: DVec2::X,
                length: 0.0,
                slope: 0.0,
                from: piece.w[0].min(piece.w[1]),
            }),
            Plan::Line(line) => Some(Straight {
                start: line.start,
                way: line.way / line.length,
                length: line.length,
                slope: piece.rise() / line.length,
                from: piece.w[0],
            }),
            Plan::Arc(_) => None,
        }
    }

    /// Way along the path and beside it to a point.
    #[inline(always)]
    fn place(&self, x: f64, y: f64) -> (f64, f64) {
        let (vx, vy) = (x - self.start.x, y - self.start.y);
        (vx * self.way.x + vy * self.way.y, vx * self.way.y - vy * self.way.x)
    }
}

/// The lesser: of two numbers, neither NaN, in one instruction.
#[inline(always)]
pub(super) fn least(a: f64, b: f64) -> f64 {
    if a < b { a } else { b }
}

/// The greater, as [`least`].
#[inline(always)]
pub(super) fn most(a: f64, b: f64) -> f64 {
    if a > b { a } else { b }
}

/// Root of what rounding may have made negative.
#[inline(always)]
fn root(square: f64) -> f64 {
    most(square, 0.0).sqrt()
}

impl<'a> Sweep<'a> {
    /// A part of the tool of a task.
    pub(super) fn new(task: &Task<'a>, part: &'a ConvexPart) -> Sweep<'a> {
        let swapped = task.frame.sign < 0.0;
        let plan = if swapped { task.piece.plan.mirrored() } else { task.piece.plan };
        let piece = MovePiece { plan, ..task.piece };
        Sweep { part, piece, low: task.tip_range().0, straight: Straight::of(&piece) }
    }

    /// True if what is swept is convex: then so is its underside, along any line.
    pub(super) fn is_convex(&self) -> bool {
        self.straight.is_some()
    }

    /// Bounds from below for discs about middles: no line within `radius` of one is passed lower. Infinite where none is
    /// reached.
    #[inline(always)]
    pub(super) fn bounds<const N: usize>(&self, x: &[f64; N], y: &[f64; N], radius: f64) -> [f64; N] {
        let mut bounds = [0.0; N];
        let part = self.part;
        match &self.straight {
            Some(path) => {
                let reach = part.r1 + radius;
                for i in 0..N {
                    let (along, beside) = path.place(x[i], y[i]);
                    let off = along - most(0.0, least(along, path.length));
                    let d = most((off * off + beside * beside).sqrt() - radius, 0.0);
                    // The tip is no lower than at the ends of the way on which the disc is reached.
                    let ends = [along - reach, along + reach].map(|t| most(0.0, least(t, path.length)));
                    let tip = path.from + least(path.slope * ends[0], path.slope * ends[1]);
                    bounds[i] = if d > part.r1 { f64::INFINITY } else { tip + self.foot(d) };
                }
            }
            None => {
                for i in 0..N {
                    let d = self.piece.plan.distance_squared(DVec2::new(x[i], y[i])).sqrt() - radius;
                    bounds[i] = if d > part.r1 {
                        f64::INFINITY
                    } else {
                        self.low + part.height(d.clamp(0.0, part.r1))
                    };
                }
            }
        }
        bounds
    }

    /// The lowest height over each line of a block, line by line; infinite where the part does not pass.
    pub(super) fn heights_one_by_one(&self, x: &[f64; BLOCK], y: &[f64; BLOCK], out: &mut BlockOf<f64>) {
        for (row, y) in out.iter_mut().zip(y) {
            for (h, x) in row.iter_mut().zip(x) {
                *h = self.height(DVec2::new(*x, *y)).0;
            }
        }
    }

    /// The same along a straight path, for several lines in one instruction.
    #[inline(always)]
    pub(super) fn heights(&self, x: &[f64; BLOCK], y: &[f64; BLOCK], out: &mut BlockOf<f64>) {
        let Some(path) = &self.straight else { return };
        let part = self.part;
        let round = |cr: f64, cz: f64, radius: f64| {
            let (rr, r0, z0) = (radius * radius, part.r0, part.z0);
            move |d: f64| {
                let h = cz - root(rr - (d - cr) * (d - cr));
                if d <= r0 { z0 } else { h }
            }
        };
        match part.foot {
            Foot::Flat => {
                let z0 = part.z0;
                self.fill(path, x, y, out, move |_| z0, |half, _| half);
            }
            Foot::Cone { rise } => {
                let (z0, r0) = (part.z0, part.r0);
                let k = path.slope.abs();
                let free = if rise > k { k / ((rise - k) * (rise + k)).sqrt() } else { f64::INFINITY };
                let least_x = self.edge();
                let foot = move |d: f64| z0 + rise * most(d - r0, 0.0);
                let lowest = move |half: f64, l: f64| {
                    // No way beside a needle on a slope steeper than itself: infinity times zero.
                    let x = if l > 0.0 || free < f64::INFINITY { free * l } else { f64::INFINITY };
                    least(half, most(x, least_x(l)))
                };
                self.fill(path, x, y, out, foot, lowest);
            }
            Foot::Torus { centre_radius: 0.0, centre_z, radius } => {
                let k = path.slope.abs();
                let share = k / k.hypot(1.0);
                let (rr, least_x) = (radius * radius, self.edge());
                let lowest = move |half: f64, l: f64| least(half, most(share * root(rr - l * l), least_x(l)));
                self.fill(path, x, y, out, round(0.0, centre_z, radius), lowest);
            }
            Foot::Torus { centre_radius, centre_z, radius } => {
                let k = path.slope.abs();
                let least_x = self.edge();
                let lowest = move |half: f64, l: f64| {
                    let reach = centre_radius + radius * torus(centre_radius, radius, k, l);
                    least(half, most(root((reach - l) * (reach + l)), least_x(l)))
                };
                self.fill(path, x, y, out, round(centre_radius, centre_z, radius), lowest);
            }
        }
    }

    /// The way to the edge of the flat disc, at a distance beside the path; no way where there is no edge.
    #[inline(always)]
    fn edge(&self) -> impl Fn(f64) -> f64 + Copy + use<> {
        let r0 = if self.part.has_edge() { self.part.r0 } else { 0.0 };
        move |l: f64| root((r0 - l) * (r0 + l))
    }

    /// Heights along a straight path, by the height of the foot at a distance from the axis, and by the way from the foot of the
    /// perpendicular to the lowest place, which half a chord and the distance beside the path give.
    #[inline(always)]
    fn fill(
        &self,
        path: &Straight,
        x: &[f64; BLOCK],
        y: &[f64; BLOCK],
        out: &mut BlockOf<f64>,
        foot: impl Fn(f64) -> f64,
        lowest: impl Fn(f64, f64) -> f64,
    ) {
        let (r1, rr) = (self.part.r1, self.part.r1 * self.part.r1);
        if path.slope == 0.0 {
            for (row, y) in out.iter_mut().zip(y) {
                for (h, x) in row.iter_mut().zip(x) {
                    let (along, beside) = path.place(*x, *y);
                    let off = along - most(0.0, least(along, path.length));
                    let dd = off * off + beside * beside;
                    let low = path.from + foot(least(dd.sqrt(), r1));
                    *h = if dd > rr { f64::INFINITY } else { low };
                }
            }
            return;
        }
        let down = -1f64.copysign(path.slope);
        for (row, y) in out.iter_mut().zip(y) {
            for (h, x) in row.iter_mut().zip(x) {
                let (along, beside) = path.place(*x, *y);
                let l = beside.abs();
                let half = root(rr - l * l);
                let (first, last) = (most(along - half, 0.0), least(along + half, path.length));
                let t = least(most(along + down * lowest(half, l), first), last);
                let off = along - t;
                let low = path.from + path.slope * t + foot(least((off * off + l * l).sqrt(), r1));
                *h = if l > r1 || first > last { f64::INFINITY } else { low };
            }
        }
    }

    /// Height of the part at a distance from its axis.
    #[inline(always)]
    fn foot(&self, rho: f64) -> f64 {
        let part = self.part;
        let beyond = match part.foot {
            Foot::Flat => part.z0,
            Foot::Cone { rise } => part.z0 + rise * (rho - part.r0),
            Foot::Torus { centre_radius, centre_z, radius } => {
                let d = rho - centre_radius;
                centre_z - root(radius * radius - d * d)
            }
        };
        if rho <= part.r0 { part.z0 } else { beyond }
    }

    /// The lowest height over a line, and the fraction of the piece at which it is reached.
    fn height(&self, q: DVec2) -> (f64, f64) {
        let mut lowest = (f64::INFINITY, 0.0);
        hits(self.part, &self.piece, q, |hit| {
            if hit.lo < lowest.0 {
                lowest = (hit.lo, hit.lo_at.0);
            }
        });
        if lowest.1.is_nan() {
            lowest.1 = self.piece.plan.nearest(q);
        }
        lowest
    }

    /// A height from which on up all of the straight way between two lines lies in the part at one time.
    pub(super) fn between(&self, p: DVec2, q: DVec2) -> f64 {
        let posed = |at: (f64, f64), other: DVec2| {
            let rho = self.piece.plan.point(at.1).distance(other);
            if at.0.is_finite() && rho <= self.part.r1 {
                at.0.max(self.piece.tip(at.1) + self.part.height(rho))
            } else {
                f64::INFINITY
            }
        };
        posed(self.height(p), q).min(posed(self.height(q), p))
    }

    /// The coordinates of the grid from those of the tool frame, or back.
    pub(super) fn exchanged(task: &Task, p: DVec2) -> DVec2 {
        if task.frame.sign < 0.0 { p.yx() } else { p }
    }
}

/// The root of `axial::torus_root` by steps from above.
#[inline(always)]
fn torus(d: f64, r: f64, k: f64, l: f64) -> f64 {
    let (kk, ll) = (k * k, l * l);
    let lower = k / (1.0 + kk).sqrt();
    let mut s = 1.0;
    for _ in 0..6 {
        let rho = d + r * s;
        let g = 1.0 + kk - kk / (s * s);
        let f = rho * rho * g - ll;
        let slope = 2.0 * r * rho * g + rho * rho * 2.0 * kk / (s * s * s);
        s = most(lower, least(s - f / slope, 1.0));
    }
    s
}
