//! Differences of elementary functions without cancellation at small arguments.

/// v - sin v.
///
/// ```
/// # use kinecut_geom as kinecut;
/// let v: f64 = 1e-5;
/// assert!((kinecut::num::series::v_minus_sin(v) / (v * v * v / 6.0) - 1.0).abs() < 1e-10);
/// ```
pub fn v_minus_sin(v: f64) -> f64 {
    // Below 0.6 the series to v^15 has a relative error under 1e-16; above it the difference loses at most four bits.
    if v.abs() > 0.6 {
        return v - v.sin();
    }
    let w = v * v;
    v * w
        * (1.0 / 6.0
            - w * (1.0 / 120.0
                - w * (1.0 / 5040.0
                    - w * (1.0 / 362_880.0
                        - w * (1.0 / 39_916_800.0 - w * (1.0 / 6_227_020_800.0 - w / 1_307_674_368_000.0))))))
}

/// 1 - cos v.
pub fn one_minus_cos(v: f64) -> f64 {
    let s = (0.5 * v).sin();
    2.0 * s * s
}

/// sin v - v cos v.
pub fn sin_minus_v_cos(v: f64) -> f64 {
    v * one_minus_cos(v) - v_minus_sin(v)
}

/// cos v + v sin v - 1.
pub fn v_sin_minus_one_minus_cos(v: f64) -> f64 {
    v * v.sin() - one_minus_cos(v)
}
