//! Halving of an interval.

/// The last of `halvings` halves of an interval between an end at which `holds` and an end at which it does not. Neither end
/// is looked at, and either may be the lower.
///
/// ```
/// # use kinecut_geom as kinecut;
/// let [below, above] = kinecut::num::bisect::bisected([0.0, 2.0], 50, |x| x * x < 2.0);
/// assert!(below <= 2f64.sqrt() && 2f64.sqrt() <= above && above - below < 1e-14);
/// ```
pub fn bisected([mut yes, mut no]: [f64; 2], halvings: u32, mut holds: impl FnMut(f64) -> bool) -> [f64; 2] {
    for _ in 0..halvings {
        let middle = 0.5 * (yes + no);
        if holds(middle) { yes = middle } else { no = middle }
    }
    [yes, no]
}
