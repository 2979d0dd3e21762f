//! The cut part against the design, by regions of its surface: each end of a line counts where it is nearest.

use glam::DVec3;

use super::Compared;
use crate::base::Result;
use crate::geom::MeshDistance;
use crate::job::check::Design;
use crate::operations::measured::Worst;
use crate::stock::{CutId, EndMap, EndPoint, FIXED_STEP, TriDexel};

/// Rounding of a deviation [parts of a mm]: below that of the ends of lines.
const ROUNDED: f64 = 1e6;

/// An end of a line against the design.
#[derive(Clone, Copy, Debug)]
pub(super) struct OfDesign {
    /// Positive outside of the design [mm].
    deviation: f32,
    region: u16,
}

/// Deviations from the design in one of its regions.
#[derive(Clone, Debug, Default)]
pub struct RegionMeasure {
    /// Its name; empty for the surface outside of all regions.
    pub name: String,
    /// Greatest depth to which it may be cut into [mm].
    pub gouge_limit: f64,
    /// Most stock that may be left on it [mm].
    pub rest_limit: f64,
    /// Ends of lines that are nearest to it.
    pub ends: usize,
    /// Deepest cut into it.
    pub gouge: Worst,
    /// Most stock left on it.
    pub left: Worst,
    /// The first cut that went deeper into it than it may, as far as it is still seen, with its deepest end.
    pub first: Option<Worst>,
}

/// Compares the ends of a stock with a design.
pub(super) fn ends(design: &Design, stock: &TriDexel) -> Result<EndMap<OfDesign>> {
    let distance = MeshDistance::new(&design.mesh)?;
    let mut ends = EndMap::new(stock, OfDesign { deviation: f32::NAN, region: 0 })?;
    ends.replace(stock, |p, _, _| match distance.nearest(p) {
        Some(nearest) => {
            OfDesign { deviation: nearest.distance as f32, region: design.region(nearest.triangle) }
        }
        None => OfDesign { deviation: f32::INFINITY, region: 0 },
    });
    Ok(ends)
}

impl OfDesign {
    /// The limit of its region [mm] where there is more stock.
    pub(super) fn is_left(self, design: &Design) -> Option<f64> {
        let [_, rest] = design.limits(self.region);
        (f64::from(self.deviation) > rest && self.deviation.is_finite()).then_some(rest)
    }

    /// Deviation with its tolerance, as the colours take it.
    pub(super) fn compared(self, design: &Design) -> Compared {
        let [gouge, rest] = design.limits(self.region);
        let tolerance = if self.deviation < 0.0 { gouge } else { rest };
        Compared { deviation: self.deviation, tolerance: tolerance as f32 }
    }
}

/// The measures of the surface outside of all regions, and of each region.
pub(super) fn measures(design: &Design, stock: &TriDexel, ends: &EndMap<OfDesign>) -> Vec<RegionMeasure> {
    let names = std::iter::once("").chain(design.regions.iter().map(|r| r.name.as_str()));
    let measure = |(number, name): (u16, &str)| {
        let [gouge_limit, rest_limit] = design.limits(number);
        RegionMeasure { name: name.to_owned(), gouge_limit, rest_limit, ..RegionMeasure::default() }
    };
    let mut all: Vec<RegionMeasure> = (0..).zip(names).map(measure).collect();
    ends.visit(stock, |point, end, of| all[usize::from(of.region)].note(of, point, end));
    for m in &mut all {
        // Of equal depths that of the first cut counts.
        m.gouge = m.first.filter(|first| first.depth + FIXED_STEP >= m.gouge.depth).unwrap_or(m.gouge);
    }
    all
}

impl RegionMeasure {
    fn note(&mut self, of: OfDesign, point: DVec3, EndPoint { cut, .. }: EndPoint) {
        if of.deviation.is_nan() {
            return;
        }
        self.ends += 1;
        let deviation = (f64::from(of.deviation) * ROUNDED).round() / ROUNDED;
        let worst = Worst { depth: deviation.abs(), point, cut };
        let side = if deviation < 0.0 { &mut self.gouge } else { &mut self.left };
        if worst.depth > side.depth {
            *side = worst;
        }
        if -deviation > self.gouge_limit
            && cut != 0
            && self.first.as_ref().is_none_or(|f| is_before(&worst, f))
        {
            self.first = Some(worst);
        }
    }

    /// Whether it lies within its limits.
    pub fn is_within(&self) -> bool {
        self.gouge.depth <= self.gouge_limit && self.left.depth <= self.rest_limit
    }
}

/// Whether a gouge is of an earlier cut, or of the same one and deeper.
fn is_before(one: &Worst, other: &Worst) -> bool {
    let order: fn(&Worst) -> (CutId, f64) = |w| (w.cut, -w.depth);
    order(one) < order(other)
}
