//! A path as a time law sees it: axes over one parameter.

/// Positions of `A` axes over a parameter, with three derivatives; the parameter is the tip's arc length, or near to it.
pub trait Course<const A: usize>: Sync {
    /// Length of the parameter [mm].
    fn length(&self) -> f64;

    /// First, second and third derivative of each axis by the parameter [mm or rad, and mm].
    ///
    /// At a knot the sides may differ: callers ask beside it.
    fn derivatives(&self, s: f64) -> [[f64; 3]; A];

    /// Largest rate of the parameter that the programmed feed allows [mm/s].
    fn feed(&self, s: f64) -> f64;

    /// Places inside at which a derivative or the feed may step, in rising order [mm].
    fn knots(&self) -> &[f64];

    /// Length about a place over which the derivatives change little [mm].
    fn finest(&self, _s: f64) -> f64 {
        f64::INFINITY
    }
}
