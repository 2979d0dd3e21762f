//! Numbers as words.

/// A bound in words: `at most 0.13`, or `under 0.01` of one that would be printed as zero.
///
/// It is rounded away from zero, so that what is printed is never kinder than what is known; what floating point leaves of
/// a number that was meant to be round does not count.
///
/// ```
/// # use kinecut_geom as kinecut;
/// use kinecut::base::at_most;
/// assert_eq!(at_most(0.123, 2), "at most 0.13");
/// assert_eq!(at_most(0.1 + 0.2, 1), "at most 0.3");
/// assert_eq!((at_most(0.003, 2), at_most(0.0, 3)), ("under 0.01".to_owned(), "under 0.001".to_owned()));
/// ```
pub fn at_most(bound: f64, digits: usize) -> String {
    let unit = 10f64.powi(i32::try_from(digits).unwrap_or(0));
    let units = bound * unit;
    if units < 1.0 - SLACK {
        return format!("under {:.digits$}", 1.0 / unit);
    }
    let rounded = (units * (1.0 - SLACK)).ceil();
    format!("at most {:.digits$}", rounded / unit)
}

/// Share by which a number may lie off the round one that it was meant to be: well above the rounding of a few
/// operations, well below all that is printed.
const SLACK: f64 = 1e-9;

#[cfg(test)]
mod tests {
    use super::at_most;

    #[test]
    fn a_bound_is_printed_neither_as_zero_nor_smaller_than_it_is() {
        for (bound, digits, shown) in [
            (0.0, 2, "under 0.01"),
            (0.0049, 2, "under 0.01"),
            (0.0099, 2, "under 0.01"),
            (0.01, 2, "at most 0.01"),
            (0.010_1, 2, "at most 0.02"),
            (0.5, 2, "at most 0.50"),
            (0.501, 2, "at most 0.51"),
            (3.0, 0, "at most 3"),
            (0.2, 0, "under 1"),
            (f64::INFINITY, 2, "at most inf"),
        ] {
            assert_eq!(at_most(bound, digits), shown, "{bound} to {digits} digits");
        }
    }
}
