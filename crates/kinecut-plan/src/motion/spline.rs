//! The square of the speed along a path as a quadratic B-spline with one continuous derivative.
//!
//! Notation: `b = (ds/dt)^2`; `t_0 .. t_n` the knots; cell `k` between `t_k` and `t_(k+1)` has the coefficients
//! `c_k, c_(k+1), c_(k+2)`. Before the first and behind the last knot the path comes from rest and goes to rest at
//! constant jerk: `b = c (x / h)^(4/3)` with the distance `x` from the stop and the length `h` of that cell.

/// Values, first and second derivatives of the three splines of a cell at a distance `u` from its left knot; `h` are the
/// lengths of the cell before, of this one and of the next one, zero where there is none.
pub(super) fn basis([before, h, after]: [f64; 3], u: f64) -> [[f64; 3]; 3] {
    let (low, high) = ((before + h) * h, (h + after) * h);
    let back = h - u;
    let (n0, n2) = (back * back / low, u * u / high);
    let (d0, d2) = (-2.0 * back / low, 2.0 * u / high);
    let (e0, e2) = (2.0 / low, 2.0 / high);
    [[n0, 1.0 - n0 - n2, n2], [d0, -d0 - d2, d2], [e0, -e0 - e2, e2]]
}

/// Lengths of the cell before, of cell `k` and of the next one.
pub(super) fn lengths(knots: &[f64], k: usize) -> [f64; 3] {
    let n = knots.len() - 1;
    let h = |k: usize| knots[k + 1] - knots[k];
    [if k > 0 { h(k - 1) } else { 0.0 }, h(k), if k + 1 < n { h(k + 1) } else { 0.0 }]
}

/// Share of its neighbour that the coefficient at a stop is, so that the cell at rest joins with one derivative: `rest`
/// its length, `h` that of the cell beside it.
pub(super) fn at_stop(rest: f64, h: f64) -> f64 {
    (2.0 / h) / (4.0 / (3.0 * rest) + 2.0 / h)
}
