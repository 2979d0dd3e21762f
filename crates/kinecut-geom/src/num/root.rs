//! Guaranteed root finders.

/// The root of an increasing function in `[lo, hi]` by Newton's method kept inside a shrinking bracket:
/// `f` returns value and derivative; whenever Newton leaves the bracket the bracket is halved.
///
/// Returns the root and the number of evaluations. The caller guarantees `f(lo) <= 0 <= f(hi)`; if it does
/// not, the nearer end is returned. At most `limit` evaluations.
///
/// ```
/// # use kinecut_geom as kinecut;
/// use kinecut::num::root::bracketed_newton;
/// let (x, n) = bracketed_newton(|x| (x * x - 2.0, 2.0 * x), 1.0, 0.0, 2.0, 60);
/// assert!((x - 2f64.sqrt()).abs() < 1e-15 && n < 9);
/// ```
pub fn bracketed_newton(
    mut f: impl FnMut(f64) -> (f64, f64),
    start: f64,
    mut lo: f64,
    mut hi: f64,
    limit: u32,
) -> (f64, u32) {
    let mut x = start.clamp(lo, hi);
    for n in 1..=limit {
        let (value, slope) = f(x);
        if value > 0.0 {
            hi = x;
        } else if value < 0.0 {
            lo = x;
        } else {
            return (x, n);
        }
        let mut next = if slope > 0.0 { x - value / slope } else { f64::NAN };
        if !(lo..=hi).contains(&next) {
            next = 0.5 * (lo + hi);
        }
        // Half an ulp of the root: the last step no longer changes it.
        if (next - x).abs() <= 4.5e-16 * x.abs() || next == lo && next == hi {
            return (next, n);
        }
        x = next;
    }
    (x, limit)
}
