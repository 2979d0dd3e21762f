//! The fastest law on given knots: an interior point method whose matrix has half bandwidth two.
//!
//! Time is `sum w b^(-1/2)` over the quadrature points, convex in the coefficients `c`. Speed and acceleration bind linear
//! combinations of three neighbours. Jerk binds `E = q''' b + 3/2 q'' b' + 1/2 q' b''` by `|E| <= J b^(-1/2)`: `b^(-1/2)` is
//! convex, so its tangent at the present `b` lies below it, and a step that keeps the tangent rows keeps the true ones. The
//! tangents follow `b` in each step, and each iterate is feasible. After Verscheure et al. 2009 (the unknown `b`) and
//! Debrouwere et al. 2013 (jerk as a difference of convex functions); predictor and corrector after Mehrotra.

use super::pentadiagonal::Pentadiagonal;

/// Kinds of rows of a cell, each row for both signs: acceleration at its right knot, jerk at its left and right one.
pub(super) const KINDS: usize = 3;

/// A cell, in units of its limits and of scaled unknowns. Its three coefficients belong to the unknown before its own, its
/// own and the next one; those of stops are folded into their neighbours.
pub(super) struct Cell<const A: usize> {
    /// `b` at the left and the right knot.
    pub(super) ends: [[f64; 3]; 2],
    /// Acceleration at the right knot, `E` at the left and at the right one, of each axis over its limit.
    pub(super) rows: [[[f64; 3]; A]; KINDS],
    /// `b` at the two Gauss points.
    pub(super) gauss: [[f64; 3]; 2],
    /// Weight of a Gauss point [mm]: half the length.
    pub(super) weight: f64,
    /// Largest value of its own unknown.
    pub(super) cap: f64,
}

/// Cells, and what the first and the last unknown `x` add to the time in the cells at rest: `w (f x)^(-1/2)` as `[w, f]`.
pub(super) struct Problem<const A: usize> {
    pub(super) cells: Vec<Cell<A>>,
    pub(super) rest: [[f64; 2]; 2],
}

/// Numbers of the rows of a cell: slack, or price.
#[derive(Clone, Copy)]
struct Rows<const A: usize> {
    pairs: [[[f64; 2]; A]; KINDS],
    /// Of the cap, and of the unknown itself, which is positive.
    own: [f64; 2],
}

/// A result of [`solve`].
pub(super) struct Solved {
    /// The unknowns.
    pub(super) x: Vec<f64>,
    /// Steps taken.
    pub(super) steps: u32,
}

/// Gap between time and its bound at which steps end, over the time.
const SETTLED: f64 = 1e-7;
/// Most steps.
const MOST_STEPS: u32 = 150;
/// Share of the way to the nearest limit that a step takes.
const SHORT_OF_LIMIT: f64 = 0.995;

#[inline]
fn dot(a: &[f64; 3], x: &[f64; 3]) -> f64 {
    a[0] * x[0] + a[1] * x[1] + a[2] * x[2]
}

/// The three unknowns of cell `k` in a list with one place before and one behind.
#[inline]
fn three(padded: &[f64], k: usize) -> [f64; 3] {
    [padded[k], padded[k + 1], padded[k + 2]]
}

impl<const A: usize> Cell<A> {
    /// Value of each row at these unknowns, before signs; and what both signs of a kind have in common, `b/(2 r)`, whose
    /// tangent stands for the fall of `J b^(-1/2)`.
    fn frame(&self, x: &[f64; 3]) -> Frame {
        let b = [dot(&self.ends[0], x), dot(&self.ends[1], x)];
        let root = b.map(f64::sqrt);
        let fall = [0, 1].map(|e| self.ends[e].map(|n| 0.5 * n / b[e]));
        Frame { factor: [1.0, root[0], root[1]], common: [[0.0; 3], fall[0], fall[1]] }
    }
}

/// Factor of the rows of each kind, and the row that both signs have in common.
struct Frame {
    factor: [f64; KINDS],
    common: [[f64; 3]; KINDS],
}

/// The largest step of at most 1 that keeps `value` positive.
#[inline]
fn within(most: f64, value: f64, change: f64) -> f64 {
    if change * most < -SHORT_OF_LIMIT * value { -SHORT_OF_LIMIT * value / change } else { most }
}

/// Minimises the time from strictly feasible unknowns `x`.
pub(super) fn solve<const A: usize>(problem: &Problem<A>, x: &[f64], gap: f64) -> Solved {
    let n = problem.cells.len();
    let count = n as f64 * (2 * A * KINDS + 2) as f64;
    let mut x: Vec<f64> = [&[0.0][..], x, &[0.0]].concat();
    let mut slack = vec![Rows { pairs: [[[0.0; 2]; A]; KINDS], own: [0.0; 2] }; n];
    let mut price = slack.clone();
    let mut change = slack.clone();
    let mut roots = vec![[1.0; 2]; n];
    let mut matrix = Pentadiagonal::zero(n);
    // Gradient of the time; prices times rows; right sides of the corrector: rows over slack, and with the second order.
    let mut lists = [vec![0.0; n + 2], vec![0.0; n + 2], vec![0.0; n + 2], vec![0.0; n + 2]];
    let mut step = vec![0.0; n];
    let mut padded = vec![0.0; n + 2];
    let mut steps = 0;
    while steps < MOST_STEPS {
        let first = steps == 0;
        // Slacks, gradient and matrix at the present unknowns.
        let time = if first { problem.time(&x) } else { 0.0 };
        let start_price = gap * time / count;
        for list in &mut lists {
            list.fill(0.0);
        }
        matrix.rows.fill([0.0; 3]);
        let [gradient, prices, over, second] = &mut lists;
        let mut all_time = 0.0;
        let mut gap = 0.0;
        for (k, cell) in problem.cells.iter().enumerate() {
            let here = three(&x, k);
            let Frame { factor, common } = cell.frame(&here);
            // Upper triangle: 00 01 02 11 12 22.
            let mut h = [0.0; 6];
            let mut g = [0.0; 3];
            let mut p = [0.0; 3];
            for row in &cell.gauss {
                let b = dot(row, &here);
                let w = cell.weight / b.sqrt();
                all_time += w;
                let (first, second) = (-0.5 * w / b, 0.75 * w / (b * b));
                for i in 0..3 {
                    g[i] += first * row[i];
                }
                add_square(&mut h, row, second);
            }
            let s = &mut slack[k];
            let y = &mut price[k];
            if first {
                roots[k] = [factor[1], factor[2]];
            }
            for kind in 0..KINDS {
                let (f, q) = (factor[kind], &common[kind]);
                // Rows are scaled by the square root of b; so are prices, inversely.
                let rescaled = if kind > 0 { roots[k][kind - 1] / f } else { 1.0 };
                for a in 0..A {
                    let row = cell.rows[kind][a].map(|r| r * f);
                    let value = dot(&row, &here);
                    let (sp, sm) = (1.0 - value, 1.0 + value);
                    s.pairs[kind][a] = [sp, sm];
                    let pair = &mut y.pairs[kind][a];
                    *pair =
                        if first { [start_price / sp, start_price / sm] } else { pair.map(|v| v * rescaled) };
                    let [yp, ym] = *pair;
                    gap += sp * yp + sm * ym;
                    let (wp, wm) = (yp / sp, ym / sm);
                    let (sum, difference) = (wp + wm, wp - wm);
                    for i in 0..3 {
                        p[i] += (yp - ym) * row[i] + (yp + ym) * q[i];
                    }
                    add_square(&mut h, &row, sum);
                    if kind > 0 {
                        add_square(&mut h, q, sum);
                        add_product(&mut h, &row, q, difference);
                    }
                }
            }
            if !first {
                roots[k] = [factor[1], factor[2]];
            }
            let own = [1.0 - here[1] / cell.cap, here[1]];
            s.own = own;
            if first {
                y.own = own.map(|s| start_price / s);
            }
            gap += own[0] * y.own[0] + own[1] * y.own[1];
            p[1] += y.own[0] / cell.cap - y.own[1];
            h[3] += y.own[0] / own[0] / (cell.cap * cell.cap) + y.own[1] / own[1];
            for i in 0..3 {
                gradient[k + i] += g[i];
                prices[k + i] += p[i];
            }
            matrix.add(k, &h);
        }
        for (place, [w, f]) in [(1, problem.rest[0]), (n, problem.rest[1])] {
            let b = f * x[place];
            let t = w / b.sqrt();
            all_time += t;
            gradient[place] -= 0.5 * t / x[place];
            matrix.rows[place - 1][0] += 0.75 * t / (x[place] * x[place]);
        }
        let largest = gradient.iter().fold(0.0_f64, |m, g| m.max(g.abs()));
        let residual = gradient.iter().zip(&*prices).fold(0.0_f64, |m, (g, p)| m.max((g + p).abs()));
        if gap < SETTLED * all_time && residual < 1e-3 * largest {
            break;
        }
        if !matrix.factor() {
            break;
        }
        // Predictor.
        let mean = gap / count;
        for (s, g) in step.iter_mut().zip(&gradient[1..=n]) {
            *s = -g;
        }
        matrix.solve(&mut step);
        // The last digits are used up: the unknowns are as good as they get.
        if step.iter().any(|s| !s.is_finite()) {
            break;
        }
        padded[1..=n].copy_from_slice(&step);
        let (mut along, mut price_along) = (1.0_f64, 1.0_f64);
        let (mut s_dy, mut ds_y, mut ds_dy) = (0.0, 0.0, 0.0);
        for (k, cell) in problem.cells.iter().enumerate() {
            let (here, by) = (three(&x, k), three(&padded, k));
            let Frame { factor, common } = cell.frame(&here);
            let (s, y, c) = (&slack[k], &price[k], &mut change[k]);
            let mut o = [0.0; 3];
            let mut t = [0.0; 3];
            let mut look = |s: f64, y: f64, grown: f64| {
                let dy = y * grown / s - y;
                along = within(along, s, -grown);
                price_along = within(price_along, y, dy);
                s_dy += s * dy;
                ds_y -= grown * y;
                let product = -grown * dy;
                ds_dy += product;
                product.clamp(-mean, mean)
            };
            for kind in 0..KINDS {
                let (f, q) = (factor[kind], &common[kind]);
                let shared = dot(q, &by);
                for a in 0..A {
                    let row = cell.rows[kind][a].map(|r| r * f);
                    let value = dot(&row, &by);
                    let [sp, sm] = s.pairs[kind][a];
                    let [yp, ym] = y.pairs[kind][a];
                    let (cp, cm) = (look(sp, yp, value + shared), look(sm, ym, shared - value));
                    c.pairs[kind][a] = [cp, cm];
                    let (ip, im) = (1.0 / sp, 1.0 / sm);
                    for i in 0..3 {
                        o[i] += (ip - im) * row[i] + (ip + im) * q[i];
                        t[i] += (cp * ip - cm * im) * row[i] + (cp * ip + cm * im) * q[i];
                    }
                }
            }
            let cap = look(s.own[0], y.own[0], by[1] / cell.cap);
            let zero = look(s.own[1], y.own[1], -by[1]);
            c.own = [cap, zero];
            o[1] += 1.0 / s.own[0] / cell.cap - 1.0 / s.own[1];
            t[1] += cap / s.own[0] / cell.cap - zero / s.own[1];
            for i in 0..3 {
                over[k + i] += o[i];
                second[k + i] += t[i];
            }
        }
        let after = gap + along * ds_y + price_along * s_dy + along * price_along * ds_dy;
        let target = mean * (after / gap).clamp(0.0, 1.0).powi(3);
        // Corrector.
        for (i, s) in step.iter_mut().enumerate() {
            *s = -gradient[i + 1] - target * over[i + 1] + second[i + 1];
        }
        matrix.solve(&mut step);
        // The last digits are used up: the unknowns are as good as they get.
        if step.iter().any(|s| !s.is_finite()) {
            break;
        }
        padded[1..=n].copy_from_slice(&step);
        let (mut along, mut price_along) = (1.0_f64, 1.0_f64);
        for (k, cell) in problem.cells.iter().enumerate() {
            let (here, by) = (three(&x, k), three(&padded, k));
            let Frame { factor, common } = cell.frame(&here);
            let (s, y, c) = (&slack[k], &price[k], &mut change[k]);
            let mut look = |s: f64, y: f64, c: &mut f64, grown: f64| {
                let dy = (target - *c + y * grown) / s - y;
                along = within(along, s, -grown);
                price_along = within(price_along, y, dy);
                *c = dy;
            };
            for kind in 0..KINDS {
                let (f, q) = (factor[kind], &common[kind]);
                let shared = dot(q, &by);
                for a in 0..A {
                    let value = f * dot(&cell.rows[kind][a], &by);
                    let [sp, sm] = s.pairs[kind][a];
                    let [yp, ym] = y.pairs[kind][a];
                    let [cp, cm] = &mut c.pairs[kind][a];
                    look(sp, yp, cp, value + shared);
                    look(sm, ym, cm, shared - value);
                }
            }
            let [cap, zero] = &mut c.own;
            look(s.own[0], y.own[0], cap, by[1] / cell.cap);
            look(s.own[1], y.own[1], zero, -by[1]);
        }
        for (x, by) in x[1..=n].iter_mut().zip(&step) {
            *x += along * by;
        }
        for (y, dy) in price.iter_mut().zip(&change) {
            for (y, dy) in y.pairs.iter_mut().flatten().flatten().zip(dy.pairs.iter().flatten().flatten()) {
                *y += price_along * dy;
            }
            for (y, dy) in y.own.iter_mut().zip(dy.own) {
                *y += price_along * dy;
            }
        }
        steps += 1;
    }
    Solved { x: x[1..=n].to_vec(), steps }
}

impl<const A: usize> Problem<A> {
    /// Factor at which unknowns that are all alike use this share of a limit: acceleration grows with it, jerk with its
    /// power 3/2.
    pub(super) fn feasible(&self, share: f64) -> f64 {
        let sum = |row: &[f64; 3]| row[0] + row[1] + row[2];
        let mut worst = 0.0_f64;
        for cell in &self.cells {
            worst = worst.max(1.0 / cell.cap);
            for (kind, rows) in cell.rows.iter().enumerate() {
                let root = if kind == 0 { 1.0 } else { sum(&cell.ends[kind - 1]).sqrt() };
                for row in rows {
                    let value = (sum(row) * root).abs();
                    worst = worst.max(if kind == 0 { value } else { value.powf(2.0 / 3.0) });
                }
            }
        }
        share / worst
    }

    /// Time at unknowns with one place before and one behind [s].
    fn time(&self, padded: &[f64]) -> f64 {
        let n = self.cells.len();
        let moving: f64 = self
            .cells
            .iter()
            .enumerate()
            .map(|(k, cell)| {
                let here = three(padded, k);
                cell.gauss.iter().map(|row| cell.weight / dot(row, &here).sqrt()).sum::<f64>()
            })
            .sum();
        let rest = |[w, f]: [f64; 2], x: f64| w / (f * x).sqrt();
        moving + rest(self.rest[0], padded[1]) + rest(self.rest[1], padded[n])
    }
}

/// Adds `w a a^T` to an upper triangle.
#[inline]
fn add_square(h: &mut [f64; 6], a: &[f64; 3], w: f64) {
    let b = a.map(|v| v * w);
    h[0] += a[0] * b[0];
    h[1] += a[0] * b[1];
    h[2] += a[0] * b[2];
    h[3] += a[1] * b[1];
    h[4] += a[1] * b[2];
    h[5] += a[2] * b[2];
}

/// Adds `w (a c^T + c a^T)` to an upper triangle.
#[inline]
fn add_product(h: &mut [f64; 6], a: &[f64; 3], c: &[f64; 3], w: f64) {
    let b = c.map(|v| v * w);
    h[0] += 2.0 * a[0] * b[0];
    h[1] += a[0] * b[1] + a[1] * b[0];
    h[2] += a[0] * b[2] + a[2] * b[0];
    h[3] += 2.0 * a[1] * b[1];
    h[4] += a[1] * b[2] + a[2] * b[1];
    h[5] += 2.0 * a[2] * b[2];
}

impl Pentadiagonal {
    /// Adds the upper triangle of cell `k`, whose unknowns are `k - 1`, `k`, `k + 1`; those outside have no entries.
    fn add(&mut self, k: usize, h: &[f64; 6]) {
        if k > 0 {
            let row = &mut self.rows[k - 1];
            row[0] += h[0];
            row[1] += h[1];
            row[2] += h[2];
        }
        let row = &mut self.rows[k];
        row[0] += h[3];
        row[1] += h[4];
        if k + 1 < self.rows.len() {
            self.rows[k + 1][0] += h[5];
        }
    }
}
