//! Quadrature of smooth functions.

/// Points and weights of the Gauss-Legendre rule of 16 points on [-1, 1], the positive half (Abramowitz & Stegun,
/// table 25.4).
const GAUSS: [(f64, f64); 8] = [
    (0.095_012_509_837_637_44, 0.189_450_610_455_068_5),
    (0.281_603_550_779_258_9, 0.182_603_415_044_923_6),
    (0.458_016_777_657_227_4, 0.169_156_519_395_002_54),
    (0.617_876_244_402_643_7, 0.149_595_988_816_576_73),
    (0.755_404_408_355_003, 0.124_628_971_255_533_87),
    (0.865_631_202_387_831_7, 0.095_158_511_682_492_78),
    (0.944_575_023_073_232_6, 0.062_253_523_938_647_89),
    (0.989_400_934_991_649_9, 0.027_152_459_411_754_095),
];

/// The integral of `f` from `a` to `b` in equal panels no wider than `panel`, each by 16 points: exact for
/// polynomials of degree 31 in each panel.
///
/// ```
/// # use kinecut_geom as kinecut;
/// use kinecut::num::quadrature::gauss;
/// assert!((gauss(0.0, 3.0, 1.0, f64::sin) - (1.0 - 3f64.cos())).abs() < 1e-15);
/// ```
pub fn gauss(a: f64, b: f64, panel: f64, mut f: impl FnMut(f64) -> f64) -> f64 {
    let panels = ((b - a).abs() / panel).ceil().max(1.0);
    let half = 0.5 * (b - a) / panels;
    let mut sum = 0.0;
    let mut k = 0.0;
    while k < panels {
        let middle = a + (2.0 * k + 1.0) * half;
        for (x, weight) in GAUSS {
            sum += weight * (f(middle - half * x) + f(middle + half * x));
        }
        k += 1.0;
    }
    sum * half
}

/// Points and weights of the Gauss-Legendre rule of 6 points on [-1, 1], the positive half (Abramowitz & Stegun,
/// table 25.4).
const GAUSS_SHORT: [(f64, f64); 3] = [
    (0.238_619_186_083_196_9, 0.467_913_934_572_691),
    (0.661_209_386_466_264_5, 0.360_761_573_048_138_6),
    (0.932_469_514_203_152, 0.171_324_492_379_170_4),
];

/// The integral of `f` from `a` to `b`, which are near one another, by 6 points: exact for polynomials of degree 11.
///
/// ```
/// # use kinecut_geom as kinecut;
/// use kinecut::num::quadrature::gauss_short;
/// assert!((gauss_short(0.0, 0.2, f64::cos) - 0.2f64.sin()).abs() < 1e-16);
/// ```
pub fn gauss_short(a: f64, b: f64, mut f: impl FnMut(f64) -> f64) -> f64 {
    let (middle, half) = (0.5 * (a + b), 0.5 * (b - a));
    let sum = GAUSS_SHORT.iter().map(|(x, weight)| weight * (f(middle - half * x) + f(middle + half * x)));
    half * sum.sum::<f64>()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn polynomials_to_degree_11_are_exact_by_six_points() {
        let exact = 2f64.powi(12) / 12.0;
        assert!((gauss_short(0.0, 2.0, |x| x.powi(11)) / exact - 1.0).abs() < 1e-14);
        assert!((gauss_short(0.0, 2.0, |x| x.powi(12)) / (2f64.powi(13) / 13.0) - 1.0).abs() > 1e-8);
        assert!((gauss_short(2.0, 0.0, |x| x) + 2.0).abs() < 1e-15);
    }

    #[test]
    fn polynomials_to_degree_31_are_exact() {
        let exact = 2f64.powi(32) / 32.0;
        assert!((gauss(0.0, 2.0, 5.0, |x| x.powi(31)) / exact - 1.0).abs() < 1e-14);
        assert_eq!(gauss(1.0, 1.0, 1.0, |x| x), 0.0);
        assert!((gauss(2.0, 0.0, 0.5, |x| x) + 2.0).abs() < 1e-15);
    }
}
