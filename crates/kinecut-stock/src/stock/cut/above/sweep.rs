//! A convex part on its way along a piece: the lowest height at which it passes over many lines at once.
//!
//! The closed forms are those of `axial.rs`. On a straight path, and over an arc at one height, they are written without branches, so
//! that the compiler takes several lines in one instruction; over a rising arc each line is asked by itself. A height from a torus on a slope is that of a
//! place on its way near to the lowest one: it is never too low, and too high by less than rounding (`Torus`).

use glam::{DVec2, Vec2Swizzles};

use super::super::axial::hits;
use super::super::body::{ConvexPart, Foot};
use super::super::piece::MovePiece;
use super::super::plan::Plan;
use super::super::task::Task;
use super::patch::ROUNDING;
use super::round::Round;

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
    round: Option<Round>,
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
        let low = task.tip_range().0;
        let round = match &piece.plan {
            Plan::Arc(arc) => Some(Round::new(arc, (piece.rise() == 0.0).then_some(low))),
            Plan::Dot(_) | Plan::Line(_) => None,
        };
        Sweep { part, piece, low, straight: Straight::of(&piece), round }
    }

    /// True if what is swept is convex: then so is its underside, along any line.
    pub(super) fn is_convex(&self) -> bool {
        self.straight.is_some()
    }

    /// The arc of a path along one.
    #[inline(always)]
    pub(super) fn round(&self) -> Option<&Round> {
        self.round.as_ref()
    }

    /// True if the heights over the lines of a block are found one by one.
    pub(super) fn is_one_by_one(&self) -> bool {
        self.round.is_some_and(|round| round.level.is_none())
    }

    /// Bounds from below for discs about middles: no line within `radius` of one is passed lower. Infinite where none is
    /// reached.
    #[inline(always)]
    pub(super) fn bounds<const N: usize>(&self, x: &[f64; N], y: &[f64; N], radius: f64) -> [f64; N] {
        let part = self.part;
        let (z0, r0) = (part.z0, part.r0);
        // Not in the loop: a choice there is made for one after the other.
        match part.foot {
            Foot::Flat => self.bounds_by([x, y], radius, |_| z0),
            Foot::Cone { rise } => self.bounds_by([x, y], radius, |d| z0 + rise * most(d - r0, 0.0)),
            Foot::Torus { centre_radius, centre_z, radius: r } => {
                let foot = |d: f64| {
                    let off = d - centre_radius;
                    let h = centre_z - root((r - off) * (r + off));
                    if d <= r0 { z0 } else { h }
                };
                self.bounds_by([x, y], radius, foot)
            }
        }
    }

    /// Bounds by the height of the foot at a distance from the axis.
    #[inline(always)]
    fn bounds_by<const N: usize>(
        &self,
        places: [&[f64; N]; 2],
        radius: f64,
        foot: impl Fn(f64) -> f64,
    ) -> [f64; N] {
        match (&self.straight, &self.round) {
            (Some(path), _) => self.bounds_along(path, places, radius, foot),
            (_, Some(round)) => self.bounds_round(round, places, radius, foot),
            (None, None) => [f64::NEG_INFINITY; N],
        }
    }

    /// The same along an arc, on which the tip is nowhere lower than its least height.
    #[inline(always)]
    fn bounds_round<const N: usize>(
        &self,
        round: &Round,
        [x, y]: [&[f64; N]; 2],
        radius: f64,
        foot: impl Fn(f64) -> f64,
    ) -> [f64; N] {
        let (r1, low) = (self.part.r1, self.low);
        let mut bounds = [0.0; N];
        for i in 0..N {
            let d = most(round.distance(x[i], y[i]) - radius, 0.0);
            let bound = low + foot(least(d, r1));
            bounds[i] = if d > r1 { f64::INFINITY } else { bound };
        }
        bounds
    }

    /// The same along a straight path.
    #[inline(always)]
    fn bounds_along<const N: usize>(
        &self,
        path: &Straight,
        [x, y]: [&[f64; N]; 2],
        radius: f64,
        foot: impl Fn(f64) -> f64,
    ) -> [f64; N] {
        let (r1, reach) = (self.part.r1, self.part.r1 + radius);
        let mut bounds = [0.0; N];
        for i in 0..N {
            let (along, beside) = path.place(x[i], y[i]);
            let off = along - most(0.0, least(along, path.length));
            let d = most((off * off + beside * beside).sqrt() - radius, 0.0);
            // The tip is no lower than at the ends of the way on which the disc is reached.
            let first = most(0.0, least(along - reach, path.length));
            let last = most(0.0, least(along + reach, path.length));
            let tip = path.from + least(path.slope * first, path.slope * last);
            let bound = tip + foot(least(d, r1));
            bounds[i] = if d > r1 { f64::INFINITY } else { bound };
        }
        bounds
    }

    /// Bound from below on the part within a distance of lines that it does not pass, on a straight path.
    pub(super) fn rim(&self, distance: f64) -> f64 {
        /// Slope beyond which a height may be infinite over a line that is passed: where a ball is lowest is known to seven digits.
        const STEEP: f64 = 1000.0;
        let rho = self.part.r1 - distance - ROUNDING;
        let is_known = self.straight.is_some_and(|path| path.slope.abs() < STEEP);
        if is_known && rho > 0.0 { self.low + self.part.height(rho) } else { f64::NEG_INFINITY }
    }

    /// A bit for each disc about a middle that the part may reach on a straight path.
    #[inline(always)]
    pub(super) fn reached<const N: usize>(&self, x: &[f64; N], y: &[f64; N], radius: f64) -> u8 {
        let Some(path) = &self.straight else { return u8::MAX };
        let reach = self.part.r1 + radius;
        let mut reached = 0;
        for i in 0..N {
            let (along, beside) = path.place(x[i], y[i]);
            let off = along - most(0.0, least(along, path.length));
            reached |= u8::from(off * off + beside * beside <= reach * reach) << i;
        }
        reached
    }

    /// For each of some middles a plane that no point of what is swept lies below: its height over the middle, and its slopes along x
    /// and y. Without a straight path there is none.
    ///
    /// The plane is square to a normal of the part, near the one at the lowest place over the middle. However near, it lies as low as the
    /// part reaches in its direction at either end of the path: what is swept is convex.
    #[inline(always)]
    pub(super) fn planes<const N: usize>(&self, x: &[f64; N], y: &[f64; N]) -> [[f64; N]; 3] {
        let Some(path) = &self.straight else {
            return [[f64::NEG_INFINITY; N], [0.0; N], [0.0; N]];
        };
        let part = self.part;
        match part.foot {
            Foot::Flat => self.planes_along(path, [x, y], |_| 0.0),
            Foot::Cone { rise } => {
                let sine = rise / rise.hypot(1.0);
                self.planes_along(path, [x, y], |rho| if rho > part.r0 { sine } else { 0.0 })
            }
            Foot::Torus { centre_radius, radius, .. } => {
                self.planes_along(path, [x, y], |rho| most((rho - centre_radius) / radius, 0.0))
            }
        }
    }

    /// Planes along a straight path, by the sine of the angle of the normal to the tool axis at a distance from it.
    #[inline(always)]
    fn planes_along<const N: usize>(
        &self,
        path: &Straight,
        [x, y]: [&[f64; N]; 2],
        sine: impl Fn(f64) -> f64,
    ) -> [[f64; N]; 3] {
        /// Steepest normal: beyond it a plane says little of heights.
        const MOST: f64 = 0.98;
        let part = self.part;
        // The foot reaches lowest at one of its rims, or on its arc.
        let (r, z) = match part.foot {
            Foot::Torus { centre_radius, centre_z, .. } => (centre_radius, centre_z),
            Foot::Flat | Foot::Cone { .. } => (part.r1, part.z1),
        };
        let arc = if let Foot::Torus { radius, .. } = part.foot { radius } else { 0.0 };
        let k = path.slope;
        let [mut height, mut along_x, mut along_y] = [[0.0; N]; 3];
        for i in 0..N {
            let (along, beside) = path.place(x[i], y[i]);
            let t = most(0.0, least(along, path.length));
            // From the axis of the tool to the middle.
            let off = along - t;
            let rho = (off * off + beside * beside).sqrt();
            let s = least(sine(rho), MOST);
            let share = s / most(rho, 1e-12);
            // The normal by its parts along the path and beside it, and downwards.
            let down = root((1.0 - s) * (1.0 + s));
            let (a, b) = (off * share, beside * share);
            // Square to a path that is long enough to have a say.
            let tilt = (a - k * down) / (1.0 + k * k);
            let free = (along > 0.0) & (along < path.length);
            let (a, down) = if free { (a - tilt, down + k * tilt) } else { (a, down) };
            let across = (a * a + b * b).sqrt();
            let low = most(down, 1e-3);
            // How far the part reaches in the direction of the normal from the tip: the arc goes with the normal's length.
            let long = (across * across + down * down).sqrt();
            let reach = most(part.r0 * across - part.z0 * down, r * across - z * down + arc * long);
            // The tip at the start and at the end.
            let ends = most(0.0, (a - k * down) * path.length);
            // n . q - n . start - reach - the further end, over what points down.
            let over = along * a + beside * b - (reach + ends);
            height[i] = if down > 1e-3 { path.from + over / low } else { f64::NEG_INFINITY };
            // The ways along the path and beside it, in x and y.
            let (gx, gy) = (a * path.way.x + b * path.way.y, a * path.way.y - b * path.way.x);
            along_x[i] = gx / low;
            along_y[i] = gy / low;
        }
        [height, along_x, along_y]
    }

    /// The lowest height over each line of a block, line by line; infinite where the part does not pass.
    pub(super) fn heights_one_by_one(&self, x: &[f64; BLOCK], y: &[f64; BLOCK], out: &mut BlockOf<f64>) {
        for (row, y) in out.iter_mut().zip(y) {
            for (h, x) in row.iter_mut().zip(x) {
                *h = self.height(DVec2::new(*x, *y)).0;
            }
        }
    }

    /// The same along a straight path, or an arc at one height, for several lines in one instruction.
    #[inline(always)]
    pub(super) fn heights(&self, x: &[f64; BLOCK], y: &[f64; BLOCK], out: &mut BlockOf<f64>) {
        let Some(path) = &self.straight else {
            for (row, y) in out.iter_mut().zip(y) {
                *row = self.bounds(x, &[*y; BLOCK], 0.0);
            }
            return;
        };
        let part = self.part;
        let (z0, rr0) = (part.z0, part.r0 * part.r0);
        match part.foot {
            Foot::Flat => self.fill(path, x, y, out, move |_| z0, |half, _| half),
            Foot::Cone { rise } => {
                let (r0, k) = (part.r0, path.slope.abs());
                let free = if rise > k { k / ((rise - k) * (rise + k)).sqrt() } else { f64::INFINITY };
                let least_x = self.edge();
                let foot = move |dd: f64| z0 + rise * most(dd.sqrt() - r0, 0.0);
                let lowest = move |half: f64, l: f64| {
                    // No way beside a needle on a slope steeper than itself: infinity times zero.
                    let x = if l > 0.0 || free < f64::INFINITY { free * l } else { f64::INFINITY };
                    least(half, most(x, least_x(l)))
                };
                self.fill(path, x, y, out, foot, lowest);
            }
            Foot::Torus { centre_radius: 0.0, centre_z, radius } => {
                let k = path.slope.abs();
                let (share, rr) = (k / k.hypot(1.0), radius * radius);
                let foot = move |dd: f64| {
                    let h = centre_z - root(rr - dd);
                    if dd <= rr0 { z0 } else { h }
                };
                if radius == part.r1 && !part.has_edge() && path.slope != 0.0 {
                    self.fill_ball(path, x, y, out, (centre_z, share));
                } else if radius == part.r1 && !part.has_edge() {
                    self.fill(path, x, y, out, foot, move |half, _| share * half);
                } else {
                    let least_x = self.edge();
                    let lowest =
                        move |half: f64, l: f64| least(half, most(share * root(rr - l * l), least_x(l)));
                    self.fill(path, x, y, out, foot, lowest);
                }
            }
            Foot::Torus { centre_radius, centre_z, radius } => {
                let (rr, least_x) = (radius * radius, self.edge());
                let torus = Torus::new(centre_radius, radius, path.slope.abs());
                let foot = move |dd: f64| {
                    let d = dd.sqrt() - centre_radius;
                    let h = centre_z - root(rr - d * d);
                    if dd <= rr0 { z0 } else { h }
                };
                let lowest = move |half: f64, l: f64| {
                    let reach = centre_radius + radius * torus.root(l);
                    least(half, most(root((reach - l) * (reach + l)), least_x(l)))
                };
                self.fill(path, x, y, out, foot, lowest);
            }
        }
    }

    /// The way to the edge of the flat disc, at a distance beside the path; no way where there is no edge.
    #[inline(always)]
    fn edge(&self) -> impl Fn(f64) -> f64 + Copy + use<> {
        let r0 = if self.part.has_edge() { self.part.r0 } else { 0.0 };
        move |l: f64| root((r0 - l) * (r0 + l))
    }

    /// Heights along a straight path, by the height of the foot at a squared distance from the axis, and by the way from the foot of the
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
                    let low = path.from + foot(least(dd, rr));
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
                let low = path.from + path.slope * t + foot(least(off * off + l * l, rr));
                *h = if l > r1 || first > last { f64::INFINITY } else { low };
            }
        }
    }

    /// Heights of a ball along a slope. Where on its way it is lowest is known to seven digits, which the height does not see: it is
    /// even there.
    #[inline(always)]
    fn fill_ball(
        &self,
        path: &Straight,
        x: &[f64; BLOCK],
        y: &[f64; BLOCK],
        out: &mut BlockOf<f64>,
        (centre_z, share): (f64, f64),
    ) {
        let (rr, back) = (self.part.r1 * self.part.r1, -share.copysign(path.slope));
        for (row, y) in out.iter_mut().zip(y) {
            for (h, x) in row.iter_mut().zip(x) {
                let (along, beside) = path.place(*x, *y);
                let ll = beside * beside;
                let half = f64::from((most(rr - ll, 0.0) as f32).sqrt());
                let t = most(least(along + back * half, path.length), 0.0);
                let off = along - t;
                let dd = off * off + ll;
                let low = path.from + path.slope * t + (centre_z - root(rr - dd));
                *h = if dd > rr { f64::INFINITY } else { low };
            }
        }
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

    /// The same for ways to places from others, given the heights over both, for several in one instruction; along an arc at one height.
    #[inline(always)]
    pub(super) fn between_round(
        &self,
        round: &Round,
        [from, to]: [[&[f64; BLOCK]; 2]; 2],
        [over_from, over_to]: [&[f64; BLOCK]; 2],
    ) -> [f64; BLOCK] {
        let part = self.part;
        let (z0, r0) = (part.z0, part.r0);
        let ends = ([from, to], [over_from, over_to]);
        match part.foot {
            Foot::Flat => self.posed(round, ends, |_| z0),
            Foot::Cone { rise } => self.posed(round, ends, |d| z0 + rise * most(d - r0, 0.0)),
            Foot::Torus { centre_radius, centre_z, radius: r } => {
                let foot = |d: f64| {
                    let off = d - centre_radius;
                    let h = centre_z - root((r - off) * (r + off));
                    if d <= r0 { z0 } else { h }
                };
                self.posed(round, ends, foot)
            }
        }
    }

    /// Heights from which on up the part has both ends of ways in it at one time: where it is nearest to one of them.
    #[inline(always)]
    fn posed(
        &self,
        round: &Round,
        ([from, to], [over_from, over_to]): ([[&[f64; BLOCK]; 2]; 2], [&[f64; BLOCK]; 2]),
        foot: impl Fn(f64) -> f64,
    ) -> [f64; BLOCK] {
        let (r1, low) = (self.part.r1, self.low);
        let at = |p: [f64; 2], over: f64, q: [f64; 2]| {
            let (x, y) = round.nearest(p[0], p[1]);
            let (dx, dy) = (q[0] - x, q[1] - y);
            let rho = (dx * dx + dy * dy).sqrt();
            let height = most(over, low + foot(least(rho, r1)));
            if rho > r1 { f64::INFINITY } else { height }
        };
        let mut lowest = [0.0; BLOCK];
        for i in 0..BLOCK {
            let (p, q) = ([from[0][i], from[1][i]], [to[0][i], to[1][i]]);
            lowest[i] = least(at(p, over_from[i], q), at(q, over_to[i], p));
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

/// A torus drawn along a slope: where it is lowest at a distance beside its way.
///
/// The root of `axial::torus_root` in the form s^2 (1 + k^2 - l^2 / rho^2) = k^2, rho = d + r s, by steps from above. With `room` more
/// than the least s, that of rho = l or 0, the left side exceeds the right one: s^2 (rho^2 - l^2) > k^2 rho^2, as rho^2 - l^2 is at least
/// (r room)^2 and, about a circle of radius d, 2 d r room, and rho at most d + r. Five steps leave the height less than 1e-6 mm above
/// the lowest one, on tools of up to 160 mm and slopes of 0.0003 to 10.
#[derive(Clone, Copy)]
struct Torus {
    d: f64,
    r: f64,
    k: f64,
    /// Sine on a line through the middle.
    lower: f64,
    room: f64,
}

impl Torus {
    fn new(d: f64, r: f64, k: f64) -> Torus {
        let wide = k * (d + r);
        let narrow = (wide / r).sqrt();
        let room = if d > 0.0 { (wide * wide / (2.0 * d * r)).cbrt().min(narrow) } else { narrow };
        Torus { d, r, k, lower: k / k.hypot(1.0), room }
    }

    #[inline(always)]
    fn root(&self, l: f64) -> f64 {
        /// Least radius that is divided by: a torus may end in a point [mm].
        const POINT: f64 = 1e-9;
        let Torus { d, r, k, lower, room } = *self;
        let (kk, ll, least_s) = (k * k, l * l, most((l - d) / r, 0.0));
        let (mut s, lower) = (least(least_s + room, 1.0), most(lower, least_s));
        for _ in 0..5 {
            let inverse = 1.0 / most(d + r * s, POINT);
            let part = ll * inverse * inverse;
            let free = 1.0 + kk - part;
            let (f, slope) = (s * s * free - kk, 2.0 * s * (free + s * r * part * inverse));
            s = most(lower, least(s - f / slope, 1.0));
        }
        s
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Height over a line beside the way, where the torus' normal has a sine; less what is alike for all of them.
    fn height(torus: &Torus, l: f64, s: f64) -> f64 {
        let rho = torus.d + torus.r * s;
        -torus.k * root((rho - l) * (rho + l)) - torus.r * root((1.0 - s) * (1.0 + s))
    }

    /// Planes against heights of random moves and tools at random places: none lies above, and near to where they are asked for they
    /// say more than the least height. So for the rim, near places that are not passed, and for the discs that are reached.
    #[test]
    fn no_tool_goes_below_its_planes_and_rim() {
        use super::super::super::axis::ToolFrame;
        use super::super::super::tests::reference::Random;
        use super::super::super::upright::tasks_of;
        use super::super::super::{CutAxis, CutList, CutMove, CutOptions, ToolBody};
        use crate::geom::{Line, Profile, ProfileElement};
        use glam::DVec3;

        let cone = ProfileElement::Cone { z0: 0.0, r0: 1.0, z1: 2.0, r1: 3.0 };
        let side = ProfileElement::Cone { z0: 2.0, r0: 3.0, z1: 20.0, r1: 3.0 };
        let profiles = [
            Profile::bull_nose(6.0, 3.0, 20.0).unwrap(),
            Profile::bull_nose(6.0, 1.0, 20.0).unwrap(),
            Profile::cylinder(6.0, 20.0).unwrap(),
            Profile::new(vec![cone, side]).unwrap(),
        ];
        let mut random = Random(41);
        let (mut tight, mut asked, mut beyond) = (0, 0, 0);
        for round in 0..kinecut_cases::cases(200, 4_000) {
            let axis = CutAxis::ALL[round as usize % 6];
            let frame = ToolFrame::new(axis);
            let tool = ToolBody::new(profiles[round as usize % 4].clone());
            let size = [0.3, 3.0, 30.0][round as usize % 3];
            let mut place = || {
                let p =
                    DVec3::new(random.within(-1.0, 1.0), random.within(-1.0, 1.0), random.within(-1.0, 1.0));
                frame.stock(p * size)
            };
            let line = Line { start: place(), end: place() };
            let moves = vec![CutMove::new(line, axis, 0)];
            let list = CutList::new(&[tool], moves, &CutOptions::default(), 0.1).unwrap();
            let mut tasks = Vec::new();
            tasks_of(&list, 0, &frame, 0, &mut tasks);
            let sweep = Sweep::new(&tasks[0], &tasks[0].tool.cutting.parts[0]);
            let mut spot = || random.within(-1.2, 1.2) * (size + 3.0);
            let middle = [spot(), spot()];
            let [height, x, y] = sweep.planes(&[middle[0]; 1], &[middle[1]; 1]).map(|of| of[0]);
            for i in 0..60 {
                let far = [0.0, 0.2, 4.0][i % 3] * (1.0 + size);
                let off = DVec2::new(random.within(-far, far), random.within(-far, far));
                let over = DVec2::from_array(middle) + off;
                let own = sweep.height(over).0;
                let plane = height + DVec2::new(x, y).dot(off);
                assert!(own >= plane - 1e-9, "round {round}, {line:?}: {own} below {plane}");
                let apart = DVec2::new(random.within(-1.0, 1.0), random.within(-1.0, 1.0));
                let (rim, beside) = (sweep.rim(apart.length()), sweep.height(over + apart).0);
                assert!(
                    beside < f64::INFINITY || own >= rim - 1e-9,
                    "round {round}, {line:?}: {own} below {rim}"
                );
                beyond += u32::from(beside == f64::INFINITY && own < rim + 1.0);
                let reached = sweep.reached(&[middle[0]; 1], &[middle[1]; 1], off.length() + ROUNDING);
                assert!(own == f64::INFINITY || reached == 1, "round {round}, {line:?}: {over}");
                if i == 0 && own < f64::INFINITY {
                    asked += 1;
                    tight += u32::from(own - plane < 0.05 * size);
                }
            }
        }
        assert!(2 * tight > asked && asked > 20, "{tight} of {asked}");
        assert!(beyond > 20, "{beyond}");
    }

    #[test]
    fn a_torus_on_a_slope_is_passed_no_higher_than_by_a_tenth_of_a_rounding() {
        /// A tenth of a fixed step [mm].
        const LEAST: f64 = 1e-6;
        let mut worst: f64 = 0.0;
        let (bulls, barrels) = (
            [(2.0, 1.0), (1.0, 2.0), (2.9, 0.1), (0.1, 2.9), (10.0, 0.5), (79.5, 0.5), (0.01, 3.0)],
            [(-16.0, 20.0), (-1.0, 3.0), (-100.0, 103.0), (-0.1, 3.0), (-0.01, 3.0)],
        );
        for (d, r) in bulls.into_iter().chain(barrels) {
            for k in [0.0003, 0.001, 0.003, 0.01, 0.03, 0.1, 0.3, 1.0, 3.0, 10.0] {
                let torus = Torus::new(d, r, k);
                let near = [-1e-3, -1e-6, 0.0, 1e-6, 1e-3].map(|e| d.abs() * (1.0 + e));
                let all = (0..500).map(|i| (d + r) * f64::from(i) / 500.0).chain(near);
                for l in all.filter(|l| *l < d + r) {
                    // The height is convex in the sine: by thirds.
                    let (mut a, mut b) = (most(torus.lower, (l - d) / r), 1.0);
                    for _ in 0..200 {
                        let (p, q) = (a + (b - a) / 3.0, b - (b - a) / 3.0);
                        if height(&torus, l, p) < height(&torus, l, q) { b = q } else { a = p }
                    }
                    let over = height(&torus, l, torus.root(l)) - height(&torus, l, 0.5 * (a + b));
                    assert!((-1e-11..LEAST).contains(&over), "{d} {r} {k} {l}: {over}");
                    worst = worst.max(over);
                }
            }
        }
        assert!(worst > 0.1 * LEAST, "the bound is too wide: {worst}");
    }
}
