//! The bad length of a circular edge over a box of placements: what is surely bad, and the derivatives where it has no
//! kink.
//!
//! A point with the outward normal nu (in the machine frame) lies at the height h + s r sin nu over the centre line, h
//! that of the arc's centre, s = 1 for a convex arc and -1 for a concave one, r the arc's radius. Its exit angle is x =
//! theta - nu with R sin theta = h + s r sin nu. At a fixed nu, x grows with h: over h1 <= h <= h2 the point is surely
//! bad where x(h1) is above the bad interval's beginning and x(h2), the same turn, below its end. Both borders are
//! roots of size sin(nu + base) = h, with size sin base = R sin psi, size cos base = R cos psi - s r. Then, while the
//! angle runs over an interval, a point of the part has its normal in the sure set throughout if the set holds it at
//! both ends: intervals of the set lose the angle's width.
//!
//! Derivatives: a border moves with dnu/dh = 1 / (size cos(nu + base)) = +-1 / sqrt(size^2 - h^2), and in the part
//! with n = nu - angle.

use std::f64::consts::{FRAC_PI_2, PI, TAU};

use super::domain::{Covers, Extent, Turned, covers};
use super::interval::{Smooth, minus, times};
use super::lines::BadInterval;
use super::place::PlacementBox;
use crate::geom::{OutlineEdge, Turn};
use crate::num::angle::wrap_positive;

/// A circular edge in the frame of the part's middle.
#[derive(Clone, Debug)]
pub(super) struct Arc {
    turn: Turn,
    /// Distance of its centre from the origin.
    centre_size: f64,
    /// 1 for a convex arc, -1 for a concave one, times its radius.
    side: f64,
    /// Direction of the first outward normal in the part, counter-clockwise.
    first: f64,
    span: f64,
    full: bool,
    /// The weight of a millimetre.
    pub(super) weight: f64,
    /// For both ends of each bad interval.
    borders: Vec<[Border; 2]>,
    cutter: f64,
}

/// Border at which the exit angle is psi: size sin(normal + base) = height of the arc's centre.
#[derive(Clone, Copy, Debug)]
struct Border {
    psi: f64,
    size: f64,
    base: f64,
}

impl Arc {
    /// `None` for a straight edge.
    pub(super) fn new(
        edge: &OutlineEdge,
        middle: glam::DVec2,
        weight: f64,
        cutter: f64,
        parts: &[BadInterval],
    ) -> Option<Arc> {
        let turn = edge.turn?;
        let turn = Turn { centre: turn.centre - middle, ..turn };
        let side = if turn.convex() { turn.radius } else { -turn.radius };
        let border = |psi: f64| {
            let (a, b) = (cutter * psi.cos() - side, cutter * psi.sin());
            Border { psi, size: a.hypot(b), base: b.atan2(a) }
        };
        Some(Arc {
            turn,
            centre_size: turn.centre.length(),
            side,
            first: if turn.convex() { turn.from + turn.sweep } else { turn.from + PI },
            span: turn.sweep.abs(),
            full: turn.sweep.abs() >= TAU,
            weight,
            borders: parts.iter().map(|p| [border(p.from), border(p.to)]).collect(),
            cutter,
        })
    }

    /// True for a full circle.
    pub(super) fn is_full(&self) -> bool {
        self.full
    }

    /// Length of a full circle that is bad at every height of the centre over the centre line in an interval [mm].
    pub(super) fn sure_at(&self, k: usize, height: Extent) -> f64 {
        self.turn.radius * self.sure_turn(k, height, [0.0, 0.0])
    }

    /// Bad length for bad interval `k` at one placement [mm].
    pub(super) fn length_at(&self, k: usize, turned: &Turned, local: f64) -> f64 {
        let height = turned.heights(self.turn.centre, self.centre_size)[0] - local;
        self.turn.radius * self.sure_turn(k, [height; 2], turned.angle)
    }

    /// Heights of the centre over the centre line.
    fn heights(&self, place: &PlacementBox) -> Extent {
        minus(place.turned.heights(self.turn.centre, self.centre_size), place.offset)
    }

    /// Length that is bad for bad interval `k` at every placement of the box [mm].
    pub(super) fn sure(&self, k: usize, place: &PlacementBox) -> f64 {
        self.turn.radius * self.sure_turn(k, self.heights(place), place.turned.angle)
    }

    /// Angle of normals that are surely bad while the height of the centre and the part's angle run over intervals.
    fn sure_turn(&self, k: usize, height: Extent, angle: Extent) -> f64 {
        let [from, to] = self.borders[k];
        // A full circle is the same at every angle.
        let width = if self.full { 0.0 } else { angle[1] - angle[0] };
        let start = if self.full { 0.0 } else { self.first + angle[0] };
        let span = self.span + width;
        // 2 ends, 2 roots of each border, 2 of each side of the cutter at each height, each perhaps a turn later too.
        let mut breaks = [0.0; 26];
        breaks[1] = span;
        let mut count = 2;
        let mut at = |nu: f64| {
            let mut gone = wrap_positive(nu - start);
            while gone < span && count < breaks.len() {
                breaks[count] = gone;
                count += 1;
                gone += TAU;
            }
        };
        for (border, h) in [(from, height[0]), (to, height[1])] {
            if h.abs() <= border.size && border.size > 0.0 {
                let w = (h / border.size).asin();
                at(w - border.base);
                at(PI - w - border.base);
            }
        }
        for h in height {
            for cutter in [self.cutter, -self.cutter] {
                let s = (cutter - h) / self.side;
                if s.abs() < 1.0 {
                    at(s.asin());
                    at(PI - s.asin());
                }
            }
        }
        let breaks = &mut breaks[..count];
        breaks.sort_unstable_by(f64::total_cmp);
        let mut sum = 0.0;
        let mut open: Option<f64> = None;
        let mut close = |open: &mut Option<f64>, end: f64| {
            if let Some(begin) = open.take() {
                let length = end - width - begin;
                if length > 0.0 {
                    sum += length;
                }
            }
        };
        for w in breaks.windows(2) {
            if w[1] - w[0] <= GAP {
                continue;
            }
            let nu = start + 0.5 * (w[0] + w[1]);
            let rise = self.side * nu.sin();
            let exit = |h: f64| ((h + rise) / self.cutter).clamp(-1.0, 1.0).asin() - nu;
            let least = exit(height[0]);
            let spread = if height[1] > height[0] { exit(height[1]) - least } else { 0.0 };
            let least = from.psi + wrap_positive(least - from.psi);
            if least > from.psi && least + spread < to.psi {
                open.get_or_insert(w[0]);
            } else {
                close(&mut open, w[0]);
            }
        }
        close(&mut open, span);
        sum
    }

    /// The bad length for bad interval `k` with its derivatives if it has no kink on the box.
    pub(super) fn smooth(&self, k: usize, place: &PlacementBox) -> Option<Smooth> {
        let height = self.heights(place);
        if !self.inside(place, height) {
            return None;
        }
        let angle = place.turned.angle;
        let mut out = Smooth::default();
        let slope = place.turned.abscissas(self.turn.centre, self.centre_size);
        let least = if height[0] > 0.0 {
            height[0]
        } else if height[1] < 0.0 {
            -height[1]
        } else {
            0.0
        };
        let most = if height[1] > -height[0] { height[1] } else { -height[0] };
        for (border, begins) in self.borders[k].iter().zip([true, false]) {
            if least > border.size {
                continue;
            }
            if most >= border.size * (1.0 - NEARLY) {
                return None;
            }
            // Along the rising branch the exit angle falls with the normal: the bad interval's beginning ends a
            // stretch there.
            let root = height.map(|h| (h / border.size).asin());
            let speed = [least, most].map(|h| 1.0 / ((border.size - h) * (border.size + h)).sqrt());
            for rising in [true, false] {
                let nu = if rising {
                    root.map(|w| w - border.base)
                } else {
                    [PI - root[1] - border.base, PI - root[0] - border.base]
                };
                let front = nu.map(|nu| (nu + border.psi).cos());
                if front[0] < 0.0 && front[1] < 0.0 {
                    continue;
                }
                if !(front[0] > NEARLY && front[1] > NEARLY) {
                    return None;
                }
                if !self.full {
                    let gone = wrap_positive(nu[0] - angle[1] - self.first);
                    let end = gone + (nu[1] - angle[0]) - (nu[0] - angle[1]);
                    if gone > self.span && end < TAU {
                        continue;
                    }
                    if end > self.span {
                        return None;
                    }
                }
                let by_height = if rising { speed } else { [-speed[1], -speed[0]] };
                let turned = times(by_height, slope);
                let by_angle = [turned[0] - 1.0, turned[1] - 1.0];
                out.add_end(rising == begins, 0.0, by_angle, [-by_height[1], -by_height[0]]);
            }
        }
        let (sin, cos) = place.sin_cos;
        let middle = sin * self.turn.centre.x + cos * self.turn.centre.y - place.middle[1];
        out.value = self.sure_turn(k, [middle; 2], [place.middle[0]; 2]);
        let r = self.turn.radius;
        Some(Smooth {
            value: r * out.value,
            by_angle: out.by_angle.map(|x| r * x),
            by_offset: out.by_offset.map(|x| r * x),
        })
    }

    /// True if the whole arc lies in the cutter's reach at every placement of the box, allowed or not.
    fn inside(&self, place: &PlacementBox, height: Extent) -> bool {
        let r = self.turn.radius;
        if height[1] + r < self.cutter && height[0] - r > -self.cutter {
            return true;
        }
        let [mut low, mut high] = [f64::INFINITY, f64::NEG_INFINITY];
        let ends = [self.turn.from, self.turn.from + self.turn.sweep];
        for p in ends.map(|a| self.turn.centre + r * glam::DVec2::from_angle(a)) {
            let y = minus(place.turned.heights(p, p.length()), place.offset);
            if y[0] < low {
                low = y[0];
            }
            if y[1] > high {
                high = y[1];
            }
        }
        let apex = |at: f64| [at - place.turned.angle[1], at - place.turned.angle[0]];
        if !matches!(covers(&self.turn, apex(FRAC_PI_2)), Covers::None) {
            high = height[1] + r;
        }
        if !matches!(covers(&self.turn, apex(-FRAC_PI_2)), Covers::None) {
            low = height[0] - r;
        }
        high < self.cutter && low > -self.cutter
    }
}

/// Breaks nearer than this are one [rad].
const GAP: f64 = 1e-12;
/// Distance from a kink, per size, within which the derivatives are not used: they are large.
const NEARLY: f64 = 1e-9;
