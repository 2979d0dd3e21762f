//! Singular values and null vectors of tall matrices with a few columns, for fits in which nothing may be squared.
//!
//! Rows are folded one by one into an upper triangle by Givens rotations (the triangle has the singular values of all
//! rows), whose singular values come from one-sided Jacobi rotations of its columns (Hestenes): small values keep their
//! relative accuracy, where the eigenvalues of the product matrix would lose half of the digits.

/// Sweeps of Jacobi rotations; convergence is quadratic and needs 5 to 8 for six columns.
const MOST_SWEEPS: u32 = 30;

/// Cosine between two columns below which they count as orthogonal: rounding.
const ORTHOGONAL: f64 = 1e-16;

/// Ratio of the diagonal of a triangle below which it is singular.
const SINGULAR: f64 = 1e-12;

/// The upper triangle of all rows seen so far.
///
/// ```
/// # use kinecut_geom as kinecut;
/// use kinecut::num::singular::Triangle;
/// let mut rows = Triangle::<2>::default();
/// for row in [[3.0, 0.0], [0.0, 4.0], [4.0, 0.0]] {
///     rows.push(row);
/// }
/// let (values, vectors) = rows.singular();
/// assert_eq!(values, [5.0, 4.0]);
/// assert_eq!(vectors[1].map(f64::abs), [0.0, 1.0]);
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Triangle<const N: usize> {
    rows: [[f64; N]; N],
}

impl<const N: usize> Default for Triangle<N> {
    fn default() -> Triangle<N> {
        Triangle { rows: [[0.0; N]; N] }
    }
}

impl<const N: usize> Triangle<N> {
    /// Adds a row. A row with a number that is not finite makes the result not finite.
    pub fn push(&mut self, mut row: [f64; N]) {
        for (k, own) in self.rows.iter_mut().enumerate() {
            if row[k] == 0.0 {
                continue;
            }
            let r = own[k].hypot(row[k]);
            let (c, s) = (own[k] / r, row[k] / r);
            for (a, b) in own.iter_mut().zip(&mut row).skip(k) {
                (*a, *b) = (c * *a + s * *b, c * *b - s * *a);
            }
        }
    }

    /// Adds all rows of another triangle.
    pub fn join(&mut self, other: &Triangle<N>) {
        other.rows.iter().for_each(|row| self.push(*row));
    }

    /// Length of the product of all rows with a vector.
    pub fn length(&self, x: &[f64; N]) -> f64 {
        let product = |row: &[f64; N]| row.iter().zip(x).map(|(a, b)| a * b).sum::<f64>();
        self.rows.iter().map(|row| product(row).powi(2)).sum::<f64>().sqrt()
    }

    /// The triangle of some of the columns only.
    #[must_use]
    pub fn columns<const M: usize>(&self, kept: [usize; M]) -> Triangle<M> {
        let mut some = Triangle::<M>::default();
        self.rows.iter().for_each(|row| some.push(kept.map(|k| row[k])));
        some
    }

    /// The rows of this triangle per row of another one: `self` times the inverse of `other`. Its singular values are
    /// the lengths of `self x` per length of `other x`. None if `other` is singular to rounding.
    pub fn relative_to(&self, other: &Triangle<N>) -> Option<Triangle<N>> {
        let greatest = (0..N).map(|k| other.rows[k][k].abs()).fold(0.0, f64::max);
        let regular = (0..N).all(|k| other.rows[k][k].abs() > SINGULAR * greatest);
        let mut relative = Triangle::default();
        for row in &self.rows {
            // x solves x * other = row, column by column.
            let mut x = [0.0; N];
            for k in 0..N {
                let known: f64 = (0..k).map(|j| x[j] * other.rows[j][k]).sum();
                x[k] = (row[k] - known) / other.rows[k][k];
            }
            relative.push(x);
        }
        regular.then_some(relative)
    }

    /// The x for which the triangle times x is y; not finite if the triangle is singular.
    pub fn solve(&self, y: [f64; N]) -> [f64; N] {
        let mut x = [0.0; N];
        for k in (0..N).rev() {
            let known: f64 = (k + 1..N).map(|j| self.rows[k][j] * x[j]).sum();
            x[k] = (y[k] - known) / self.rows[k][k];
        }
        x
    }

    /// The x of the first columns for which all rows are nearest to their last column; its last entry is -1. None if
    /// the columns are dependent.
    ///
    /// ```
    /// # use kinecut_geom as kinecut;
    /// use kinecut::num::singular::Triangle;
    /// let mut line = Triangle::<3>::default(); // y = 2 x + 1
    /// [[0.0, 1.0, 1.0], [1.0, 1.0, 3.0], [2.0, 1.0, 5.0]].into_iter().for_each(|row| line.push(row));
    /// let [slope, offset, _] = line.least_squares().unwrap();
    /// assert!((slope - 2.0).abs() < 1e-14 && (offset - 1.0).abs() < 1e-14);
    /// ```
    pub fn least_squares(&self) -> Option<[f64; N]> {
        let last = N.checked_sub(1)?;
        let greatest = (0..last).map(|k| self.rows[k][k].abs()).fold(0.0, f64::max);
        let mut x = [0.0; N];
        x[last] = -1.0;
        for k in (0..last).rev() {
            if !(self.rows[k][k].abs() > SINGULAR * greatest) {
                return None;
            }
            let known: f64 = (k + 1..N).map(|j| self.rows[k][j] * x[j]).sum();
            x[k] = -known / self.rows[k][k];
        }
        Some(x)
    }

    /// Singular values in falling order with their right vectors, which are unit vectors orthogonal to one another.
    pub fn singular(&self) -> ([f64; N], [[f64; N]; N]) {
        // Columns as rows, because columns are what is turned.
        let mut columns = [[0.0; N]; N];
        let mut vectors = [[0.0; N]; N];
        for (i, row) in self.rows.iter().enumerate() {
            vectors[i][i] = 1.0;
            for (j, value) in row.iter().enumerate() {
                columns[j][i] = *value;
            }
        }
        for _ in 0..MOST_SWEEPS {
            let mut turned = false;
            for p in 0..N {
                for q in p + 1..N {
                    turned |= orthogonalise(&mut columns, &mut vectors, p, q);
                }
            }
            if !turned {
                break;
            }
        }
        let lengths = columns.map(|c| dot(&c, &c).sqrt());
        let mut order: [usize; N] = std::array::from_fn(|i| i);
        order.sort_by(|&i, &j| lengths[j].total_cmp(&lengths[i]));
        (order.map(|i| lengths[i]), order.map(|i| vectors[i]))
    }
}

fn dot<const N: usize>(a: &[f64; N], b: &[f64; N]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

/// Turns columns p and q so that they become orthogonal; true if it had to.
fn orthogonalise<const N: usize>(
    columns: &mut [[f64; N]; N],
    vectors: &mut [[f64; N]; N],
    p: usize,
    q: usize,
) -> bool {
    let (a, b) = (dot(&columns[p], &columns[p]), dot(&columns[q], &columns[q]));
    let c = dot(&columns[p], &columns[q]);
    if !(c.abs() > ORTHOGONAL * a.sqrt() * b.sqrt()) || c == 0.0 {
        return false;
    }
    let zeta = (b - a) / (2.0 * c);
    let t = 1f64.copysign(zeta) / (zeta.abs() + zeta.hypot(1.0));
    let cos = 1.0 / t.hypot(1.0);
    let sin = cos * t;
    for matrix in [columns, vectors] {
        for k in 0..N {
            let (x, y) = (matrix[p][k], matrix[q][k]);
            (matrix[p][k], matrix[q][k]) = (cos * x - sin * y, sin * x + cos * y);
        }
    }
    true
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        #![proptest_config(kinecut_cases::property(256))]
        #[test]
        fn vectors_are_orthonormal_and_scaled_by_their_values(
            rows in prop::collection::vec(prop::array::uniform6(-3.0..3.0f64), 1..30)
        ) {
            let mut triangle = Triangle::<6>::default();
            rows.iter().for_each(|row| triangle.push(*row));
            let (values, vectors) = triangle.singular();
            for i in 0..6 {
                let image: Vec<f64> = rows.iter().map(|r| dot(r, &vectors[i])).collect();
                let length = image.iter().map(|x| x * x).sum::<f64>().sqrt();
                prop_assert!((length - values[i]).abs() < 1e-12 * (1.0 + values[0]));
                prop_assert!((length - triangle.length(&vectors[i])).abs() < 1e-12 * (1.0 + values[0]));
                for j in 0..6 {
                    let wanted = f64::from(u8::from(i == j));
                    prop_assert!((dot(&vectors[i], &vectors[j]) - wanted).abs() < 1e-13);
                }
            }
            let squares: f64 = rows.iter().flatten().map(|x| x * x).sum();
            prop_assert!((values.iter().map(|s| s * s).sum::<f64>() - squares).abs() < 1e-11 * (1.0 + squares));
        }
    }

    proptest! {
        #![proptest_config(kinecut_cases::property(256))]
        #[test]
        fn relative_values_are_ratios_of_lengths(
            rows in prop::collection::vec(prop::array::uniform4(-3.0..3.0f64), 5..12),
            others in prop::collection::vec(prop::array::uniform4(-3.0..3.0f64), 8..12),
            x in prop::array::uniform4(-1.0..1.0f64),
        ) {
            let (mut a, mut b) = (Triangle::<4>::default(), Triangle::<4>::default());
            rows.iter().for_each(|row| a.push(*row));
            others.iter().for_each(|row| b.push(*row));
            let Some(relative) = a.relative_to(&b) else { return Ok(()) };
            let (values, vectors) = relative.singular();
            for (value, vector) in values.iter().zip(vectors) {
                let x = b.solve(vector);
                prop_assert!((a.length(&x) / b.length(&x) - value).abs() < 1e-9 * (1.0 + values[0]));
            }
            let ratio = a.length(&x) / b.length(&x);
            prop_assert!(ratio <= values[0] * (1.0 + 1e-9) && ratio >= values[3] * (1.0 - 1e-9));
        }
    }

    /// Two columns that differ by 1e-10: the product matrix has the eigenvalue 1e-20, which is lost next to 2.
    #[test]
    fn small_values_are_accurate() {
        let mut triangle = Triangle::<2>::default();
        triangle.push([1.0, 1.0]);
        triangle.push([0.0, 1e-10]);
        let (values, _) = triangle.singular();
        // Product of the values is the determinant.
        assert!((values[0] * values[1] - 1e-10).abs() < 1e-24, "{values:?}");
    }
}
