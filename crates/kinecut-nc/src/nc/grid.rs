//! The grid of numbers that a control can read: whole multiples of its resolution.
//!
//! Positions are kept as counts, so that writing, reading and writing again give the same digits.

use std::fmt::Write as _;

use crate::base::{Code, Finding, Result};

/// Multiples of a resolution that is itself a multiple of `10^-decimals` mm.
#[derive(Clone, Copy, Debug)]
pub(super) struct Grid {
    decimals: u8,
    scale: f64,
    /// The resolution in units of the last decimal.
    multiple: i64,
    /// Whether the decimal point is always written.
    point: bool,
    /// Whether a positive number gets its sign.
    plus: bool,
    /// Unit of the written numbers [mm]; of angles one degree.
    unit: f64,
}

/// Largest number written [mm]: a kilometre. Controls read at least six digits before the point.
pub(super) const LARGEST: f64 = 999_999.0;

impl Grid {
    /// Of coordinates in millimetres, or of angles.
    pub(super) fn new(decimals: u8, resolution: Option<f64>, point: bool) -> Result<Grid> {
        Grid::in_units(decimals, resolution, point, 1.0)
    }

    /// Of coordinates in a unit [mm]; the resolution is in mm.
    pub(super) fn in_units(decimals: u8, resolution: Option<f64>, point: bool, unit: f64) -> Result<Grid> {
        if !(3..=6).contains(&decimals) {
            return Err(Finding::error(Code::POST_NUMBER, "coordinates need 3 to 6 decimals")
                .value(f64::from(decimals), "decimals")
                .bound(if decimals < 3 { 3.0 } else { 6.0 }, "decimals")
                .into());
        }
        let scale = 10f64.powi(i32::from(decimals));
        let multiple = match resolution {
            None => 1.0,
            Some(step) => {
                let multiple = (step / unit * scale).round();
                if !(multiple >= 1.0
                    && step <= COARSEST
                    && (step / unit * scale - multiple).abs() < EXACT * multiple)
                {
                    let finding = Finding::error(
                        Code::POST_NUMBER,
                        "the resolution must be a whole multiple of the last decimal, at most 0.1 mm",
                    );
                    return Err(finding.value_mm(step).bound_mm(unit / scale).into());
                }
                multiple
            }
        };
        Ok(Grid { decimals, scale, multiple: multiple as i64, point, plus: false, unit })
    }

    /// The same with a sign before every number.
    pub(super) fn signed(self) -> Grid {
        Grid { plus: true, ..self }
    }

    /// Least step [mm].
    pub(super) fn unit(&self) -> f64 {
        self.multiple as f64 / self.scale * self.unit
    }

    /// The number in steps, not rounded.
    pub(super) fn steps(&self, value: f64) -> f64 {
        value / self.unit * self.scale / self.multiple as f64
    }

    /// The nearest count of steps.
    pub(super) fn round(&self, value: f64) -> Result<i64> {
        if value.is_finite() && value.abs() <= LARGEST {
            // Within 1e12: exact in both types.
            return Ok(self.steps(value).round() as i64);
        }
        Err(Finding::error(Code::POST_NUMBER, "a coordinate does not fit the number format of the control")
            .value_mm(value)
            .bound_mm(LARGEST)
            .into())
    }

    /// The double nearest to the decimal number: what a reader gets from [`Grid::word`] [mm].
    pub(super) fn value(&self, count: i64) -> f64 {
        self.written(count) * self.unit
    }

    /// The double nearest to the decimal number, in the unit of the text.
    pub(super) fn written(&self, count: i64) -> f64 {
        (count * self.multiple) as f64 / self.scale
    }

    /// A length that is no coordinate [mm], in the unit of the text, with seven significant digits.
    pub(super) fn length(&self, value: f64) -> String {
        plain(value / self.unit)
    }

    /// The number alone.
    pub(super) fn text(&self, count: i64) -> String {
        let mut text = String::new();
        self.word(&mut text, "", count);
        text
    }

    /// Appends an address and the number, without superfluous digits and never `-0`.
    pub(super) fn word(&self, out: &mut String, address: &str, count: i64) {
        if !out.is_empty() && !out.ends_with(' ') {
            out.push(' ');
        }
        out.push_str(address);
        if count < 0 {
            out.push('-');
        } else if self.plus {
            out.push('+');
        }
        let scale = 10u64.pow(u32::from(self.decimals));
        let digits = (count * self.multiple).unsigned_abs();
        let (whole, part) = (digits / scale, digits % scale);
        // Writing to a string cannot fail.
        let _ = write!(out, "{whole}");
        if part != 0 {
            let digits = format!("{part:0width$}", width = usize::from(self.decimals));
            out.push('.');
            out.push_str(digits.trim_end_matches('0'));
        } else if self.point {
            out.push('.');
        }
    }
}

/// Coarsest resolution of coordinates [mm]: a step beyond it is a slip of units.
const COARSEST: f64 = 0.1;
/// Relative rounding of a resolution given in decimals.
const EXACT: f64 = 1e-9;

/// A positive number that is no coordinate (feed, speed, time) with seven significant digits.
pub(super) fn plain(value: f64) -> String {
    let digits = if value > 0.0 { value.log10().floor() as i32 + 1 } else { 1 };
    let decimals = (SIGNIFICANT - digits).clamp(0, MOST_DECIMALS) as usize;
    let text = format!("{value:.decimals$}");
    if text.contains('.') { text.trim_end_matches('0').trim_end_matches('.').to_owned() } else { text }
}

/// Digits of a feed or speed: the seventh is below a thousandth of a percent, and short inputs come back as typed.
const SIGNIFICANT: i32 = 7;
/// Most decimals of a feed or speed: what controls read.
const MOST_DECIMALS: i32 = 8;

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn word(value: f64, decimals: u8) -> String {
        let grid = Grid::new(decimals, None, false).unwrap();
        let mut out = String::new();
        grid.word(&mut out, "X", grid.round(value).unwrap());
        out
    }

    #[test]
    fn numbers_are_short_and_zero_has_no_sign() {
        assert_eq!(word(-0.00004, 4), "X0");
        assert_eq!(word(-0.5, 4), "X-0.5");
        assert_eq!(word(-0.00005, 4), "X-0.0001");
        assert_eq!(word(10.0, 3), "X10");
        assert_eq!(word(64.911_318_83, 4), "X64.9113");
        assert_eq!(word(-46.757_748_06, 6), "X-46.757748");
    }

    #[test]
    fn too_large_and_not_finite_numbers_are_refused() {
        let grid = Grid::new(4, None, false).unwrap();
        for bad in [1e6, -1e6, f64::NAN, f64::INFINITY] {
            assert_eq!(grid.round(bad).unwrap_err().code(), Code::POST_NUMBER);
        }
        assert!(Grid::new(2, None, false).is_err() && Grid::new(7, None, false).is_err());
    }

    #[test]
    fn a_coarse_resolution_gives_multiples_and_a_point_where_asked() {
        let grid = Grid::new(3, Some(0.005), true).unwrap();
        let word = |value: f64| {
            let mut out = String::new();
            grid.word(&mut out, "X", grid.round(value).unwrap());
            out
        };
        assert_eq!([word(1.0), word(0.0124), word(0.0126), word(-0.002)], ["X1.", "X0.01", "X0.015", "X0."]);
        assert_eq!(grid.value(3), 0.015);
        assert_eq!((grid.unit(), grid.steps(0.01)), (0.005, 2.0));
        for bad in [0.0, -0.005, 0.0005, 0.0015, 0.2, f64::NAN, f64::INFINITY] {
            assert!(Grid::new(3, Some(bad), false).is_err(), "{bad}");
        }
    }

    #[test]
    fn feeds_are_written_as_typed() {
        for (value, text) in [
            (6000.0, "6000"),
            (0.05, "0.05"),
            (1234.5, "1234.5"),
            (0.123_456_78, "0.1234568"),
            (0.0, "0"),
            (1e7, "10000000"),
        ] {
            assert_eq!(plain(value), text);
        }
        assert_eq!(plain(6000.0 / 60.0 * 60.0), "6000");
    }

    proptest! {
        #![proptest_config(kinecut_cases::property(256))]
        #[test]
        fn the_digits_read_back_are_the_value(count in -999_999_000_000i64..999_999_000_000, decimals in 3u8..=6) {
            let grid = Grid::new(decimals, None, false).unwrap();
            let mut out = String::new();
            grid.word(&mut out, "", count);
            if grid.value(count).abs() <= LARGEST {
                prop_assert_eq!(out.parse::<f64>().unwrap(), grid.value(count));
                prop_assert_eq!(grid.round(grid.value(count)).unwrap(), count);
            }
        }
    }
}
