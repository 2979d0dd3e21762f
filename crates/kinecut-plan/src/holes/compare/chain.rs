//! A chain of plane curves as one way: points by its arc length, places of its joints.

use glam::DVec2;

use crate::geom::{Curve, PlaneCurve};

/// Consecutive curves.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Chain {
    pub(super) curves: Vec<PlaneCurve>,
    /// Arc length at the start of each curve, and the whole [mm].
    pub(super) starts: Vec<f64>,
}

impl Chain {
    pub(super) fn new(curves: Vec<PlaneCurve>) -> Chain {
        let mut starts = vec![0.0];
        let mut s = 0.0;
        for curve in &curves {
            s += curve.length();
            starts.push(s);
        }
        Chain { curves, starts }
    }

    pub(super) fn length(&self) -> f64 {
        self.starts[self.starts.len() - 1]
    }

    /// Point at an arc length, held within the chain [mm].
    pub(super) fn point(&self, s: f64) -> DVec2 {
        let s = s.clamp(0.0, self.length());
        let at = self.starts.partition_point(|start| *start <= s).clamp(1, self.curves.len()) - 1;
        self.curves.get(at).map_or(DVec2::ZERO, |c| c.at(s - self.starts[at]).p)
    }

    /// In the plane of height zero.
    pub(super) fn in_space(&self) -> Vec<Curve> {
        self.curves.iter().map(|c| c.at_height(0.0, 0.0)).collect()
    }
}
