//! Words of a series of cycles.

/// Words that stay during a series of cycle blocks [mm, s].
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Sticky {
    /// Height at which the series began.
    pub(super) begun: Option<f64>,
    /// R, Z as programmed.
    pub(super) reference: Option<f64>,
    pub(super) bottom: Option<f64>,
    pub(super) step: Option<f64>,
    pub(super) dwell: Option<f64>,
    /// Step aside in the plane (`G76`, `G87` with I and J).
    pub(super) shift: Option<[f64; 2]>,
    /// First step, by how much each is shorter, and the least (Haas `G73`, `G83` with I, J, K).
    pub(super) pecks: Option<[f64; 3]>,
    /// Threads are rigid (`M29`).
    pub(super) rigid: bool,
}

impl Sticky {
    /// Another cycle of the series: LinuxCNC wants its R, Z, Q and P again, the height of the return stays.
    pub(super) fn another(&mut self) {
        (self.reference, self.bottom, self.step, self.dwell) = (None, None, None, None);
    }

    /// Another motion code ends the series.
    pub(super) fn end(&mut self) {
        *self = Sticky::default();
    }
}
