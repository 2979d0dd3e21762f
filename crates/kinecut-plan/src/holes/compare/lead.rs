//! Growth of the load along a finishing lead-in.
//!
//! A lead-in of contact `G2`, `G4` or `G6` comes to the finished wall from inside the roughed one. A higher contact comes
//! in flatter: it touches the allowance earlier, and its first chips are thinner. Near the wall the stock that is still to
//! be taken at the angle `e` before the joint is `r e^3/6`, `r e^5/30` or `4 r e^7/315`; here the exact curves are used.

use serde::Serialize;

use super::Terms;
use super::load::{LoadSample, radial_depth};
use crate::base::Result;
use crate::geom::{LensOrder, Spiral, Support};
use crate::holes::engagement::engagement;
use crate::num::bisect::bisected;
use std::f64::consts::TAU;

/// A finishing lead-in.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct LeadGrowth {
    /// Order of its contact with the wall: 2, 4 or 6.
    pub contact: u8,
    /// Angle before the wall at which it first touches the allowance [rad].
    pub touch: f64,
    /// Way from there to the wall [mm].
    pub way: f64,
    /// Engagement at the wall [rad].
    pub engaged: f64,
    /// Fastest growth of the engagement on the way, over an eighth of it [rad/mm].
    pub growth: f64,
    /// Way from the first touch to a tenth of the allowance [mm]: there the chips are so thin that edges rub.
    pub thin_way: f64,
    /// The load from the first touch to the wall.
    pub samples: Vec<LoadSample>,
}

/// Samples along a lead-in.
const SAMPLES: usize = 160;
/// Halvings of an angle: to rounding.
const HALVINGS: u32 = 60;

pub(super) fn lead_ins(terms: &Terms) -> Result<Vec<LeadGrowth>> {
    if !(terms.allowance > 0.0) || terms.lead_turns == 0 {
        return Ok(Vec::new());
    }
    [LensOrder::Zero, LensOrder::One, LensOrder::Two].into_iter().map(|order| lead_in(terms, order)).collect()
}

fn lead_in(terms: &Terms, order: LensOrder) -> Result<LeadGrowth> {
    let wall = terms.wall + terms.allowance;
    let whole = TAU * f64::from(terms.lead_turns);
    let law = Support::Lens { inner: 0.0, base_radius: wall / whole, order };
    // Distance from the centre grows with the angle.
    let distance = |angle: f64| {
        let [q, slope] = law.at(angle);
        q.hypot(slope)
    };
    let at_distance = |wanted: f64| {
        let [_, reached] = bisected([0.0, whole], HALVINGS, |angle| distance(angle) < wanted);
        reached
    };
    let (touch, thin) = (at_distance(terms.wall), at_distance(terms.wall + 0.1 * terms.allowance));
    let spiral = Spiral::new(law.into(), touch, whole)?;
    let way = spiral.length();
    let measured = engagement(&[spiral], terms.cutter, Some(terms.wall + terms.cutter), SAMPLES)?;
    let samples: Vec<LoadSample> = measured
        .iter()
        .map(|e| LoadSample {
            s: e.s,
            angle: e.angle,
            depth: radial_depth(e.curvature, terms.cutter, e.angle),
        })
        .collect();
    let apart = samples.len().div_ceil(8).clamp(1, SAMPLES);
    let growth = samples
        .iter()
        .zip(samples.iter().skip(apart))
        .map(|(a, b)| (b.angle - a.angle) / (b.s - a.s))
        .fold(0.0, |most, g| if g > most { g } else { most });
    Ok(LeadGrowth {
        contact: order.contact(),
        touch: whole - touch,
        way,
        engaged: samples.last().map_or(0.0, |s| s.angle),
        growth,
        thin_way: spiral.length_to(thin),
        samples,
    })
}
