//! Eigenvalues and eigenvectors of a symmetric 3x3 matrix, for fits of points and planes.
//!
//! Cyclic Jacobi rotations: slower than the closed form, but accurate for nearly equal and for vanishing
//! eigenvalues, which are the rule for flat and for cylindrical faces.

use glam::{DMat3, DVec3};

/// Sweeps until the off-diagonal part is below rounding; Jacobi converges quadratically and needs 3 to 5.
const MOST_SWEEPS: u32 = 12;

/// Eigenvalues in falling order with their unit eigenvectors; only the symmetric part of the matrix is read from
/// its upper triangle. A matrix with a number that is not finite gives numbers that are not finite.
///
/// ```
/// # use kinecut_geom as kinecut;
/// use glam::{DMat3, DVec3};
/// let m = DMat3::from_diagonal(DVec3::new(1.0, 5.0, 2.0));
/// let (values, vectors) = kinecut::num::eigen::symmetric_eigen(m);
/// assert_eq!(values, DVec3::new(5.0, 2.0, 1.0));
/// assert_eq!(vectors[0].abs(), DVec3::Y);
/// ```
pub fn symmetric_eigen(matrix: DMat3) -> (DVec3, [DVec3; 3]) {
    let mut a = matrix.transpose().to_cols_array_2d();
    let mut v = DMat3::IDENTITY.to_cols_array_2d();
    for (i, j) in [(0, 1), (0, 2), (1, 2)] {
        a[j][i] = a[i][j];
    }
    for _ in 0..MOST_SWEEPS {
        let off = a[0][1].abs() + a[0][2].abs() + a[1][2].abs();
        let on = a[0][0].abs() + a[1][1].abs() + a[2][2].abs();
        if !(off > 1e-17 * on) {
            break;
        }
        for (p, q) in [(0, 1), (0, 2), (1, 2)] {
            if a[p][q] == 0.0 {
                continue;
            }
            let theta = (a[q][q] - a[p][p]) / (2.0 * a[p][q]);
            let t = 1f64.copysign(theta) / (theta.abs() + theta.hypot(1.0));
            let c = 1.0 / t.hypot(1.0);
            let s = t * c;
            for row in &mut a {
                (row[p], row[q]) = (c * row[p] - s * row[q], s * row[p] + c * row[q]);
            }
            for k in 0..3 {
                (a[p][k], a[q][k]) = (c * a[p][k] - s * a[q][k], s * a[p][k] + c * a[q][k]);
            }
            // Columns of the rotation are kept as rows.
            for k in 0..3 {
                (v[p][k], v[q][k]) = (c * v[p][k] - s * v[q][k], s * v[p][k] + c * v[q][k]);
            }
        }
    }
    let mut order = [0, 1, 2];
    order.sort_by(|&i, &j| a[j][j].total_cmp(&a[i][i]));
    (DVec3::from_array(order.map(|i| a[i][i])), order.map(|i| DVec3::from_array(v[i])))
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        #![proptest_config(kinecut_cases::property(256))]
        #[test]
        fn vectors_are_orthonormal_and_scaled_by_their_values(m in prop::array::uniform6(-3.0..3.0f64)) {
            let [a, b, c, d, e, f] = m;
            let m = DMat3::from_cols_array(&[a, d, e, d, b, f, e, f, c]);
            let (values, vectors) = symmetric_eigen(m);
            prop_assert!(values.x >= values.y && values.y >= values.z);
            for i in 0..3 {
                prop_assert!((m * vectors[i] - values[i] * vectors[i]).length() < 1e-13);
                for j in 0..3 {
                    let wanted = f64::from(u8::from(i == j));
                    prop_assert!((vectors[i].dot(vectors[j]) - wanted).abs() < 1e-14);
                }
            }
        }
    }
}
