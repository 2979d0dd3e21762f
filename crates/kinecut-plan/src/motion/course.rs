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

    /// Both at once.
    fn derivatives_and_feed(&self, s: f64) -> ([[f64; 3]; A], f64) {
        (self.derivatives(s), self.feed(s))
    }

    /// Places inside at which a derivative or the feed may step, in rising order [mm].
    fn knots(&self) -> &[f64];

    /// Length about a place over which the derivatives change little [mm].
    fn finest(&self, _s: f64) -> f64 {
        f64::INFINITY
    }
}

/// A stretch of a course.
pub(super) struct Stretch<'a, C> {
    course: &'a C,
    from: f64,
    length: f64,
    knots: Vec<f64>,
}

impl<'a, C> Stretch<'a, C> {
    /// The stretch between two places [mm].
    pub(super) fn new<const A: usize>(course: &'a C, [from, to]: [f64; 2]) -> Stretch<'a, C>
    where
        C: Course<A>,
    {
        let all = course.knots();
        let inside = all.partition_point(|k| *k <= from)..all.partition_point(|k| *k < to);
        let knots = all.get(inside).unwrap_or_default().iter().map(|k| k - from).collect();
        Stretch { course, from, length: to - from, knots }
    }
}

impl<const A: usize, C: Course<A>> Course<A> for Stretch<'_, C> {
    fn length(&self) -> f64 {
        self.length
    }

    fn derivatives(&self, s: f64) -> [[f64; 3]; A] {
        self.course.derivatives(self.from + s)
    }

    fn feed(&self, s: f64) -> f64 {
        self.course.feed(self.from + s)
    }

    fn derivatives_and_feed(&self, s: f64) -> ([[f64; 3]; A], f64) {
        self.course.derivatives_and_feed(self.from + s)
    }

    fn knots(&self) -> &[f64] {
        &self.knots
    }

    fn finest(&self, s: f64) -> f64 {
        self.course.finest(self.from + s)
    }
}
