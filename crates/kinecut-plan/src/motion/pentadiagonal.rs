//! Symmetric positive definite matrices of half bandwidth two.

/// Share of its entry below which a pivot is rounding: where neighbours of a matrix are much alike it may even be negative.
const ROUNDING: f64 = 1e-13;

/// A matrix of this kind, row by row; factored and solved in place.
pub(super) struct Pentadiagonal {
    /// Of row `i` the entries `(i, i)`, `(i, i + 1)` and `(i, i + 2)`; after [`Pentadiagonal::factor`] the inverse pivot and
    /// the multipliers of the next two rows.
    pub(super) rows: Vec<[f64; 3]>,
}

impl Pentadiagonal {
    /// Zero, of this many rows.
    pub(super) fn zero(n: usize) -> Pentadiagonal {
        Pentadiagonal { rows: vec![[0.0; 3]; n] }
    }

    /// Factors into `L D L^T`; false where an entry of the diagonal is not positive.
    pub(super) fn factor(&mut self) -> bool {
        // Of the row before and the one before that: pivot, and multipliers of the next two rows.
        let mut before = [[0.0; 3]; 2];
        for row in &mut self.rows {
            let [[p1, l1, m1], [p2, _, m2]] = before;
            let pivot = (row[0] - p1 * l1 * l1 - p2 * m2 * m2).max(ROUNDING * row[0]);
            if !(pivot > 0.0 && pivot.is_finite()) {
                return false;
            }
            let inverse = 1.0 / pivot;
            let next = [pivot, (row[1] - p1 * l1 * m1) * inverse, row[2] * inverse];
            *row = [inverse, next[1], next[2]];
            before = [next, before[0]];
        }
        true
    }

    /// Replaces the right side by the solution; after [`Pentadiagonal::factor`].
    pub(super) fn solve(&self, x: &mut [f64]) {
        let n = x.len();
        for i in 0..n {
            let [_, l, m] = self.rows[i];
            let v = x[i];
            if i + 1 < n {
                x[i + 1] -= l * v;
            }
            if i + 2 < n {
                x[i + 2] -= m * v;
            }
        }
        for i in (0..n).rev() {
            let [inverse, l, m] = self.rows[i];
            let mut v = x[i] * inverse;
            if i + 1 < n {
                v -= l * x[i + 1];
            }
            if i + 2 < n {
                v -= m * x[i + 2];
            }
            x[i] = v;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::Pentadiagonal;

    #[test]
    fn a_solution_gives_its_right_side_back() {
        let n = 9;
        let entry = |i: usize, j: usize| match i.abs_diff(j) {
            0 => 4.0 + (i as f64).sin(),
            1 => 1.0 - 0.3 * (i.min(j) as f64).cos(),
            2 => 0.4 + 0.1 * i.min(j) as f64 / n as f64,
            _ => 0.0,
        };
        let mut matrix = Pentadiagonal::zero(n);
        for (i, row) in matrix.rows.iter_mut().enumerate() {
            *row = [0, 1, 2].map(|d| if i + d < n { entry(i, i + d) } else { 0.0 });
        }
        let wanted: Vec<f64> = (0..n).map(|i| (1.7 * i as f64).sin() + 0.2).collect();
        let mut x: Vec<f64> = (0..n).map(|i| (0..n).map(|j| entry(i, j) * wanted[j]).sum()).collect();
        assert!(matrix.factor());
        matrix.solve(&mut x);
        assert!(x.iter().zip(&wanted).all(|(a, b)| (a - b).abs() < 1e-13), "{x:?} {wanted:?}");
        matrix.rows[3] = [-1.0, 0.0, 0.0];
        assert!(!matrix.factor());
    }
}
