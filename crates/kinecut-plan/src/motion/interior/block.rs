//! Some cells beside each other in one step of the method: their part of the gradient, the matrix and the right sides, and the
//! step that they allow.

use super::lanes::{LANES, Lanes, dot};
use super::{Cell, KINDS};

/// Numbers of the rows of cells.
#[derive(Clone, Copy)]
struct Rows<const A: usize> {
    pairs: [[[Lanes; 2]; A]; KINDS],
    /// Of the cap, and of the unknown itself, which is positive.
    own: [Lanes; 2],
}

impl<const A: usize> Rows<A> {
    const ZERO: Rows<A> = Rows { pairs: [[[Lanes::ZERO; 2]; A]; KINDS], own: [Lanes::ZERO; 2] };
}

/// Cells beside each other, and where the method is in them. Cells behind the last one have no rows and no prices.
pub(super) struct Block<const A: usize> {
    /// `b` at the left and the right knot.
    ends: [[Lanes; 3]; 2],
    rows: [[[Lanes; 3]; A]; KINDS],
    gauss: [[Lanes; 3]; 2],
    weight: Lanes,
    /// One over the largest value of its own unknown.
    uncapped: Lanes,
    /// 1 for cells, and 0 behind the last one.
    is_cell: Lanes,
    /// Square roots of `b` at both ends, by which rows of jerk grow.
    roots: [Lanes; 2],
    /// Part of each row of jerk that is the same for both signs: the tangent of the fall of `J b^(-1/2)`, over the slack's scale.
    common: [[Lanes; 3]; 2],
    /// One over the slacks.
    inverse: Rows<A>,
    price: Rows<A>,
    change: Rows<A>,
}

/// Parts of cells in the sums of all, unknown by unknown: before their own, their own, the next one.
pub(super) struct Parts {
    /// Gradient of the time.
    pub(super) gradient: [Lanes; 3],
    /// Prices times rows.
    pub(super) prices: [Lanes; 3],
    /// Rows over slacks.
    pub(super) over: [Lanes; 3],
    /// The matrix: 00 01 02 11 12 22.
    pub(super) matrix: [Lanes; 6],
}

/// Sums of a look at the present unknowns.
#[derive(Clone, Copy)]
pub(super) struct Present {
    pub(super) time: Lanes,
    /// Slacks times prices.
    pub(super) gap: Lanes,
}

/// Extent of a step, in all rows so far.
#[derive(Clone, Copy)]
pub(super) struct Extent {
    /// The largest share of its slack that a row loses.
    pub(super) lost: Lanes,
    /// The smallest growth of a price over the price.
    pub(super) price: Lanes,
    /// Prices times losses of slack, and changes of price times these.
    pub(super) products: [Lanes; 2],
}

impl Extent {
    pub(super) const NONE: Extent =
        Extent { lost: Lanes::ZERO, price: Lanes::ZERO, products: [Lanes::ZERO; 2] };
}

/// Adds `w a a^T` to an upper triangle.
#[inline(always)]
fn add_square(h: &mut [Lanes; 6], a: &[Lanes; 3], w: Lanes) {
    let b = [a[0] * w, a[1] * w, a[2] * w];
    h[0] += a[0] * b[0];
    h[1] += a[0] * b[1];
    h[2] += a[0] * b[2];
    h[3] += a[1] * b[1];
    h[4] += a[1] * b[2];
    h[5] += a[2] * b[2];
}

/// Adds `a c^T + c a^T` to an upper triangle.
#[inline(always)]
fn add_product(h: &mut [Lanes; 6], a: &[Lanes; 3], c: &[Lanes; 3]) {
    h[0] += (a[0] * c[0]) + (a[0] * c[0]);
    h[1] += a[0] * c[1] + a[1] * c[0];
    h[2] += a[0] * c[2] + a[2] * c[0];
    h[3] += (a[1] * c[1]) + (a[1] * c[1]);
    h[4] += a[1] * c[2] + a[2] * c[1];
    h[5] += (a[2] * c[2]) + (a[2] * c[2]);
}

#[inline(always)]
fn add(to: &mut [Lanes; 3], row: &[Lanes; 3], w: Lanes) {
    for i in 0..3 {
        to[i] += w * row[i];
    }
}

impl<const A: usize> Block<A> {
    pub(super) fn new(cells: &[Cell<A>]) -> Block<A> {
        let of = |number: &dyn Fn(&Cell<A>) -> f64, behind: f64| {
            Lanes(std::array::from_fn(|l| cells.get(l).map_or(behind, number)))
        };
        let behind = [0.0, 1.0, 0.0];
        let three = |row: &dyn Fn(&Cell<A>) -> [f64; 3], behind: [f64; 3]| {
            [0, 1, 2].map(|i| of(&|cell| row(cell)[i], behind[i]))
        };
        Block {
            ends: [0, 1].map(|e| three(&|cell| cell.ends[e], behind)),
            rows: [0, 1, 2]
                .map(|kind| std::array::from_fn(|a| three(&|cell: &Cell<A>| cell.rows[kind][a], [0.0; 3]))),
            gauss: [0, 1].map(|e| three(&|cell| cell.gauss[e], behind)),
            weight: of(&|cell| cell.weight, 0.0),
            uncapped: of(&|cell| 1.0 / cell.cap, 0.0),
            is_cell: of(&|_| 1.0, 0.0),
            roots: [Lanes::ONE; 2],
            common: [[Lanes::ZERO; 3]; 2],
            inverse: Rows::ZERO,
            price: Rows::ZERO,
            change: Rows::ZERO,
        }
    }

    /// Time in the cells [s].
    #[inline(always)]
    pub(super) fn time(&self, here: &[Lanes; 3]) -> Lanes {
        let [first, second] = [0, 1].map(|e| self.weight / dot(&self.gauss[e], here).sqrt());
        first + second
    }

    /// Prices at which each slack costs the same.
    #[inline(always)]
    pub(super) fn start(&mut self, here: &[Lanes; 3], each: f64) {
        let each = Lanes::all(each) * self.is_cell;
        self.roots = [0, 1].map(|e| dot(&self.ends[e], here).sqrt());
        for kind in 0..KINDS {
            for a in 0..A {
                let value = self.value(kind, a, here);
                self.price.pairs[kind][a] = [each / (Lanes::ONE - value), each / (Lanes::ONE + value)];
            }
        }
        self.price.own = [each / (Lanes::ONE - here[1] * self.uncapped), each / here[1]];
    }

    /// Value of a row.
    #[inline(always)]
    fn value(&self, kind: usize, a: usize, x: &[Lanes; 3]) -> Lanes {
        let value = dot(&self.rows[kind][a], x);
        if kind > 0 { value * self.roots[kind - 1] } else { value }
    }

    /// Takes a share of the last change of prices, and looks at the present unknowns.
    #[inline(always)]
    pub(super) fn look(&mut self, here: &[Lanes; 3], price_along: f64, present: &mut Present) -> Parts {
        let along = Lanes::all(price_along);
        let mut parts = Parts {
            gradient: [Lanes::ZERO; 3],
            prices: [Lanes::ZERO; 3],
            over: [Lanes::ZERO; 3],
            matrix: [Lanes::ZERO; 6],
        };
        for row in &self.gauss {
            let b = dot(row, here);
            let w = self.weight / b.sqrt();
            present.time += w;
            let by_b = Lanes::ONE / b;
            let first = Lanes::all(-0.5) * w * by_b;
            add(&mut parts.gradient, row, first);
            add_square(&mut parts.matrix, row, Lanes::all(-1.5) * first * by_b);
        }
        let mut gap = Lanes::ZERO;
        for kind in 0..KINDS {
            // Rows of jerk are scaled by the square root of b; so are their prices, inversely.
            let (mut factor, mut rescaled) = (Lanes::ONE, Lanes::ONE);
            if kind > 0 {
                let b = dot(&self.ends[kind - 1], here);
                factor = b.sqrt();
                rescaled = self.roots[kind - 1] / factor;
                self.roots[kind - 1] = factor;
                let fall = Lanes::all(0.5) / b;
                let [before, own, next] = self.ends[kind - 1];
                self.common[kind - 1] = [before * fall, own * fall, next * fall];
            }
            let (mut of_prices, mut of_over, mut of_matrix) = (Lanes::ZERO, Lanes::ZERO, Lanes::ZERO);
            let mut mixed = [Lanes::ZERO; 3];
            for a in 0..A {
                let row = &self.rows[kind][a];
                let value = dot(row, here) * factor;
                let slack = [Lanes::ONE - value, Lanes::ONE + value];
                let inverse = [Lanes::ONE / slack[0], Lanes::ONE / slack[1]];
                let change = &self.change.pairs[kind][a];
                let pair = &mut self.price.pairs[kind][a];
                *pair = [(pair[0] + along * change[0]) * rescaled, (pair[1] + along * change[1]) * rescaled];
                self.inverse.pairs[kind][a] = inverse;
                gap += slack[0] * pair[0] + slack[1] * pair[1];
                let [wp, wm] = [pair[0] * inverse[0], pair[1] * inverse[1]];
                add(&mut parts.prices, row, (pair[0] - pair[1]) * factor);
                add(&mut parts.over, row, (inverse[0] - inverse[1]) * factor);
                add_square(&mut parts.matrix, row, (wp + wm) * factor * factor);
                of_prices += pair[0] + pair[1];
                of_over += inverse[0] + inverse[1];
                of_matrix += wp + wm;
                add(&mut mixed, row, (wp - wm) * factor);
            }
            if kind > 0 {
                let common = &self.common[kind - 1];
                add(&mut parts.prices, common, of_prices);
                add(&mut parts.over, common, of_over);
                add_square(&mut parts.matrix, common, of_matrix);
                add_product(&mut parts.matrix, &mixed, common);
            }
        }
        let slack = [Lanes::ONE - here[1] * self.uncapped, here[1]];
        let inverse = [self.is_cell / slack[0], self.is_cell / slack[1]];
        let (price, change) = (self.price.own, self.change.own);
        let price = [price[0] + along * change[0], price[1] + along * change[1]];
        gap += slack[0] * price[0] + slack[1] * price[1];
        let uncapped = self.uncapped;
        parts.prices[1] += price[0] * uncapped - price[1];
        parts.over[1] += inverse[0] * uncapped - inverse[1];
        parts.matrix[3] += price[0] * inverse[0] * uncapped * uncapped + price[1] * inverse[1];
        (self.inverse.own, self.price.own) = (inverse, price);
        present.gap += gap;
        parts
    }

    /// Goes through the rows with a step.
    #[inline(always)]
    fn each(&mut self, by: &[Lanes; 3], step: &mut impl Step) {
        for kind in 0..KINDS {
            let shared = if kind > 0 { dot(&self.common[kind - 1], by) } else { Lanes::ZERO };
            for a in 0..A {
                let value = self.value(kind, a, by);
                let ([ip, im], [yp, ym]) = (self.inverse.pairs[kind][a], self.price.pairs[kind][a]);
                let [cp, cm] = &mut self.change.pairs[kind][a];
                step.row(value + shared, ip, yp, cp);
                step.row(shared - value, im, ym, cm);
            }
        }
        let ([ic, iz], [yc, yz]) = (self.inverse.own, self.price.own);
        let [cap, zero] = &mut self.change.own;
        step.row(by[1] * self.uncapped, ic, yc, cap);
        step.row(-by[1], iz, yz, zero);
    }

    /// The step of the predictor: notes the second order of each row, at most `mean`, and gives its part in the right side.
    #[inline(always)]
    pub(super) fn predict(&mut self, by: &[Lanes; 3], mean: f64, extent: &mut Extent) -> [Lanes; 3] {
        let mut step = Predictor {
            most: Lanes::all(mean),
            least: Lanes::all(-mean),
            behind: Lanes::ONE - self.is_cell,
            extent: *extent,
        };
        self.each(by, &mut step);
        *extent = step.extent;
        let mut second = [Lanes::ZERO; 3];
        for kind in 0..KINDS {
            let mut shared = Lanes::ZERO;
            for a in 0..A {
                let ([cp, cm], [ip, im]) = (self.change.pairs[kind][a], self.inverse.pairs[kind][a]);
                let (plus, minus) = (cp * ip, cm * im);
                let factor = if kind > 0 { self.roots[kind - 1] } else { Lanes::ONE };
                add(&mut second, &self.rows[kind][a], (plus - minus) * factor);
                shared += plus + minus;
            }
            if kind > 0 {
                add(&mut second, &self.common[kind - 1], shared);
            }
        }
        let ([cap, zero], [ic, iz]) = (self.change.own, self.inverse.own);
        second[1] += cap * ic * self.uncapped - zero * iz;
        second
    }

    /// The step of the corrector, which leaves the changes of prices.
    #[inline(always)]
    pub(super) fn correct(&mut self, by: &[Lanes; 3], target: f64, extent: &mut Extent) {
        let target = Lanes::all(target) * self.is_cell;
        let mut step = Corrector { target, behind: Lanes::ONE - self.is_cell, extent: *extent };
        self.each(by, &mut step);
        *extent = step.extent;
    }
}

/// A step in the rows of cells.
trait Step {
    /// Goes through rows that lose so much slack, of which the inverse of their slack is given, with their prices and changes.
    fn row(&mut self, grown: Lanes, inverse: Lanes, price: Lanes, change: &mut Lanes);
}

struct Predictor {
    most: Lanes,
    least: Lanes,
    /// 1 behind the last cell.
    behind: Lanes,
    extent: Extent,
}

impl Step for Predictor {
    #[inline(always)]
    fn row(&mut self, grown: Lanes, inverse: Lanes, price: Lanes, change: &mut Lanes) {
        let extent = &mut self.extent;
        let lost = grown * inverse;
        let growth = lost - Lanes::ONE;
        let paid = grown * price;
        let product = Lanes::ZERO - paid * growth;
        extent.lost = extent.lost.max(lost);
        extent.price = extent.price.min(growth + self.behind);
        extent.products[0] += paid;
        extent.products[1] += product;
        *change = product.min(self.most).max(self.least);
    }
}

struct Corrector {
    target: Lanes,
    /// 1 behind the last cell.
    behind: Lanes,
    extent: Extent,
}

impl Step for Corrector {
    #[inline(always)]
    fn row(&mut self, grown: Lanes, inverse: Lanes, price: Lanes, change: &mut Lanes) {
        let extent = &mut self.extent;
        extent.lost = extent.lost.max(grown * inverse);
        let growth = (self.target - *change + price * grown) * inverse - price;
        extent.price = extent.price.min(growth / (price + self.behind));
        *change = growth;
    }
}

/// Cells beside each other, in blocks.
pub(super) fn blocks<const A: usize>(cells: &[Cell<A>]) -> Vec<Block<A>> {
    cells.chunks(LANES).map(Block::new).collect()
}
