//! The fastest law on given knots: an interior point method whose matrix has half bandwidth two.
//!
//! Time is `sum w b^(-1/2)` over the quadrature points, convex in the coefficients `c`. Speed and acceleration bind linear
//! combinations of three neighbours. Jerk binds `E = q''' b + 3/2 q'' b' + 1/2 q' b''` by `|E| <= J b^(-1/2)`: `b^(-1/2)` is
//! convex, so its tangent at the present `b` lies below it, and a step that keeps the tangent rows keeps the true ones. The
//! tangents follow `b` in each step, and each iterate is feasible. After Verscheure et al. 2009 (the unknown `b`) and
//! Debrouwere et al. 2013 (jerk as a difference of convex functions); predictor and corrector after Mehrotra.

mod block;
mod columns;
mod lanes;

use pulp::{Arch, NullaryFnOnce};

use self::block::{Block, Extent, Present, blocks};
use self::columns::Columns;
use self::lanes::{LANES, Lanes};
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

/// A result of [`solve`].
pub(super) struct Solved {
    /// The unknowns.
    pub(super) x: Vec<f64>,
    /// Steps taken.
    pub(super) steps: u32,
}

/// Most steps.
const MOST_STEPS: u32 = 150;
/// Share of the way to the nearest limit that a step takes.
const SHORT_OF_LIMIT: f64 = 0.995;

/// The largest step of at most 1 of which a limit is left, where a whole one takes this share of it.
fn within(share: f64) -> f64 {
    if share > SHORT_OF_LIMIT { SHORT_OF_LIMIT / share } else { 1.0 }
}

/// Minimises the time from strictly feasible unknowns `x`; `gaps`: those between time and its bound, over the time, to start
/// from and to end at.
pub(super) fn solve<const A: usize>(problem: &Problem<A>, x: &[f64], [gap, settled]: [f64; 2]) -> Solved {
    let mut method = Method::new(problem, x, gap);
    let arch = Arch::new();
    let mut steps = 0;
    let mut price_along = 0.0;
    while steps < MOST_STEPS {
        let Some(mean) =
            arch.dispatch(Look(&mut method, price_along, settled)).filter(|_| method.matrix.factor())
        else {
            break;
        };
        method.step.iter_mut().zip(&method.gradient).for_each(|(s, g)| *s = -g);
        if !method.solved_step() {
            break;
        }
        let target = arch.dispatch(Predict(&mut method, mean));
        let (gradient, over, second) = (&method.gradient, &method.over, &method.second);
        for (i, s) in method.step.iter_mut().enumerate() {
            *s = -gradient[i] - target * over[i] + second[i];
        }
        if !method.solved_step() {
            break;
        }
        let along;
        [along, price_along] = arch.dispatch(Correct(&mut method, target));
        let n = method.step.len();
        for (x, by) in method.x[1..=n].iter_mut().zip(&method.step) {
            *x += along * by;
        }
        steps += 1;
    }
    Solved { x: method.x[1..=problem.cells.len()].to_vec(), steps }
}

/// The method at the present unknowns.
struct Method<const A: usize> {
    blocks: Vec<Block<A>>,
    rest: [[f64; 2]; 2],
    /// Rows of all cells.
    count: f64,
    /// Unknowns, with a place before them and some behind.
    x: Vec<f64>,
    matrix: Pentadiagonal,
    /// The step at hand, by itself and as the unknowns are kept.
    step: Vec<f64>,
    by: Vec<f64>,
    columns: Columns,
    gradient: Vec<f64>,
    /// Prices times rows; rows over slacks; the second order.
    prices: Vec<f64>,
    over: Vec<f64>,
    second: Vec<f64>,
    gap: f64,
}

impl<const A: usize> Method<A> {
    fn new(problem: &Problem<A>, x: &[f64], gap: f64) -> Method<A> {
        let n = problem.cells.len();
        let mut blocks = blocks(&problem.cells);
        let places = LANES * blocks.len();
        let mut all = vec![1.0; places + 2];
        all[0] = 0.0;
        all[1..=n].copy_from_slice(x);
        let time = blocks.iter().enumerate().map(|(i, block)| block.time(&three(&all, i)).sum()).sum::<f64>()
            + [(0, 1), (1, n)].map(|(e, place)| at_rest(problem.rest[e], all[place])).iter().sum::<f64>();
        let count = n as f64 * (2 * A * KINDS + 2) as f64;
        let each = gap * time / count;
        blocks.iter_mut().enumerate().for_each(|(i, block)| block.start(&three(&all, i), each));
        let list = || vec![0.0; n];
        Method {
            blocks,
            rest: problem.rest,
            count,
            x: all,
            matrix: Pentadiagonal::zero(n),
            step: list(),
            by: vec![0.0; places + 2],
            columns: Columns::new(places),
            gradient: list(),
            prices: list(),
            over: list(),
            second: list(),
            gap: 0.0,
        }
    }

    /// Solves for the step; false where the last digits are used up: the unknowns are as good as they get.
    fn solved_step(&mut self) -> bool {
        self.matrix.solve(&mut self.step);
        let n = self.step.len();
        self.by[1..=n].copy_from_slice(&self.step);
        self.step.iter().all(|s| s.is_finite())
    }

    /// Gradient, right sides and matrix at the present unknowns; the mean of slacks times prices, unless the time is settled.
    #[inline(always)]
    fn look(&mut self, price_along: f64, settled: f64) -> Option<f64> {
        let n = self.step.len();
        let mut present = Present { time: Lanes::ZERO, gap: Lanes::ZERO };
        for (i, block) in self.blocks.iter_mut().enumerate() {
            let parts = block.look(&three(&self.x, i), price_along, &mut present);
            self.columns.put(i, &parts);
        }
        let columns = &self.columns;
        columns.three(Columns::GRADIENT, &mut self.gradient);
        columns.three(Columns::PRICES, &mut self.prices);
        columns.three(Columns::OVER, &mut self.over);
        columns.matrix(&mut self.matrix.rows);
        let (mut time, gap) = (present.time.sum(), present.gap.sum());
        for (e, place) in [(0, 0), (1, n - 1)] {
            let (x, t) = (self.x[place + 1], at_rest(self.rest[e], self.x[place + 1]));
            time += t;
            self.gradient[place] -= 0.5 * t / x;
            self.matrix.rows[place][0] += 0.75 * t / (x * x);
        }
        let (mut largest, mut residual) = (0.0_f64, 0.0_f64);
        for (g, p) in self.gradient.iter().zip(&self.prices) {
            largest = largest.max(g.abs());
            residual = residual.max((g + p).abs());
        }
        self.gap = gap;
        let is_settled = gap < settled * time && residual < 1e-3 * largest;
        (!is_settled).then_some(gap / self.count)
    }

    /// Looks at the step of the predictor: slack times price to aim at.
    #[inline(always)]
    fn predict(&mut self, mean: f64) -> f64 {
        let mut extent = Extent::NONE;
        for (i, block) in self.blocks.iter_mut().enumerate() {
            let second = block.predict(&three(&self.by, i), mean, &mut extent);
            self.columns.put_three(Columns::SECOND, i, &second);
        }
        self.columns.three(Columns::SECOND, &mut self.second);
        let [along, price_along] = steps(&extent);
        let [products, second] = extent.products.map(Lanes::sum);
        let after =
            self.gap - along * products + price_along * (products - self.gap) + along * price_along * second;
        mean * (after / self.gap).clamp(0.0, 1.0).powi(3)
    }

    /// Looks at the step of the corrector: the shares of it that unknowns and prices take.
    #[inline(always)]
    fn correct(&mut self, target: f64) -> [f64; 2] {
        let mut extent = Extent::NONE;
        for (i, block) in self.blocks.iter_mut().enumerate() {
            block.correct(&three(&self.by, i), target, &mut extent);
        }
        steps(&extent)
    }
}

/// The shares of a step that unknowns and prices can take.
fn steps(extent: &Extent) -> [f64; 2] {
    [within(extent.lost.most()), within(-extent.price.least())]
}

/// The three unknowns of each cell of block `i` in a list with one place before and some behind.
#[inline(always)]
fn three(padded: &[f64], i: usize) -> [Lanes; 3] {
    let place = LANES * i;
    [Lanes::at(padded, place), Lanes::at(padded, place + 1), Lanes::at(padded, place + 2)]
}

/// Time in a cell at rest [s].
fn at_rest([w, f]: [f64; 2], x: f64) -> f64 {
    w / (f * x).sqrt()
}

struct Look<'a, const A: usize>(&'a mut Method<A>, f64, f64);

impl<const A: usize> NullaryFnOnce for Look<'_, A> {
    type Output = Option<f64>;
    #[inline(always)]
    fn call(self) -> Option<f64> {
        self.0.look(self.1, self.2)
    }
}

struct Predict<'a, const A: usize>(&'a mut Method<A>, f64);

impl<const A: usize> NullaryFnOnce for Predict<'_, A> {
    type Output = f64;
    #[inline(always)]
    fn call(self) -> f64 {
        self.0.predict(self.1)
    }
}

struct Correct<'a, const A: usize>(&'a mut Method<A>, f64);

impl<const A: usize> NullaryFnOnce for Correct<'_, A> {
    type Output = [f64; 2];
    #[inline(always)]
    fn call(self) -> [f64; 2] {
        self.0.correct(self.1)
    }
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
}
