//! Round numbers on an axis.

/// Ticks of an axis: round values that cover an interval, with the decimals that tell them apart.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Ticks {
    /// Distance of two ticks.
    pub(crate) step: f64,
    /// The values inside the interval, rising.
    pub(crate) values: Vec<f64>,
}

impl Ticks {
    /// About `wanted` ticks with a step of 1, 2 or 5 times a power of ten inside `[lo, hi]`. Bounds that are not
    /// finite or not ordered give the single tick `lo` (0 if that is not finite).
    pub(crate) fn new(lo: f64, hi: f64, wanted: usize) -> Ticks {
        let span = hi - lo;
        // Below a relative span of 1e-12 neighbouring ticks would be the same f64.
        if !(span.is_finite() && span > 1e-12 * lo.abs().max(hi.abs()) && span > 0.0) {
            let only = if lo.is_finite() { lo } else { 0.0 };
            return Ticks { step: 1.0, values: vec![only] };
        }
        let raw = span / wanted.max(1) as f64;
        let power = 10f64.powf(raw.log10().floor());
        // The nearest of 1, 2, 5, 10 on a logarithmic scale (the borders are geometric means) or, when the interval holds
        // fewer than two of its multiples, the next finer one: a fifth of the span always has four.
        const ROUND: [f64; 6] = [10.0, 5.0, 2.0, 1.0, 0.5, 0.2];
        let start = [7.071, 3.162, 1.414].iter().filter(|&&border| raw / power <= border).count();
        let mut steps = ROUND[start..].iter().map(|&n| (n * power, inside(lo, hi, n * power)));
        let (step, values) = steps.find(|(_, v)| v.len() > 1).unwrap_or((raw, vec![lo]));
        Ticks { step, values }
    }

    /// The multiples of a step inside `[lo, hi]`.
    pub(crate) fn every(lo: f64, hi: f64, step: f64) -> Ticks {
        Ticks { step, values: inside(lo, hi, step) }
    }

    /// All ticks as text.
    pub(crate) fn labels(&self) -> Vec<String> {
        self.values.iter().map(|&v| self.label(v)).collect()
    }

    /// A tick as text.
    pub(crate) fn label(&self, value: f64) -> String {
        let magnitude = self.values.iter().fold(0.0, |m: f64, v| m.max(v.abs()));
        // Six digits fit beside an axis; what needs more is written with an exponent.
        if magnitude >= 1e6 || self.step < 1e-5 {
            let shown = if value.abs() < self.step * 1e-6 { 0.0 } else { value };
            return format!("{:.*e}", self.exponent_digits(magnitude), shown).replace("e", "·10^");
        }
        let decimals = (-self.step.log10().floor()).max(0.0) as usize;
        crate::page::fixed(value, decimals)
    }

    fn exponent_digits(&self, magnitude: f64) -> usize {
        if magnitude == 0.0 {
            0
        } else {
            (magnitude.log10().floor() - self.step.log10().floor()).clamp(0.0, 6.0) as usize
        }
    }
}

/// The multiples of a step in an interval.
fn inside(lo: f64, hi: f64, step: f64) -> Vec<f64> {
    // A millionth of a step: a bound that is a tick but for rounding is one.
    let (first, last) = ((lo / step - 1e-6).ceil(), (hi / step + 1e-6).floor());
    if last < first {
        return Vec::new();
    }
    // Adding 0.0 turns -0.0 into 0.0.
    (0..=(last - first) as usize).map(|i| (first + i as f64) * step + 0.0).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    #[test]
    fn ticks_of_common_axes() {
        let t = Ticks::new(0.0, 0.0125, 5);
        assert_eq!(t.labels(), ["0.000", "0.002", "0.004", "0.006", "0.008", "0.010", "0.012"]);
        let t = Ticks::new(-110.0, 110.0, 6);
        assert_eq!(t.values, [-100.0, -50.0, 0.0, 50.0, 100.0]);
        assert_eq!(Ticks::new(0.0, 3e-7, 3).label(2e-7), "2·10^-7");
        assert_eq!(Ticks::new(3.0, 3.0, 5).values, [3.0]);
        assert_eq!(Ticks::new(f64::NAN, 1.0, 5).values, [0.0]);
    }

    proptest! {
        #![proptest_config(kinecut_cases::property(256))]
        #[test]
        fn ticks_lie_inside_rise_and_are_neither_few_nor_many(lo in -1e7..1e7f64, span in 1e-4..1e7f64, wanted in 2usize..12) {
            let hi = lo + span;
            let t = Ticks::new(lo, hi, wanted);
            prop_assert!(t.values.iter().all(|&v| v >= lo - 1e-5 * t.step && v <= hi + 1e-5 * t.step));
            prop_assert!(t.values.windows(2).all(|w| w[1] > w[0]));
            prop_assert!(t.values.len() >= 2 && t.values.len() <= 3 * wanted / 2 + 4, "{t:?}");
            prop_assert!(t.values.len() + 1 >= wanted / 2, "{t:?}");
            let digit = t.step / 10f64.powf(t.step.log10().floor() + 1e-9);
            prop_assert!([1.0, 2.0, 5.0, 10.0].iter().any(|n| (digit / n - 1.0).abs() < 1e-6), "{t:?}");
        }
    }
}
