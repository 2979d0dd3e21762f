//! The centre line of a slot.

use std::f64::consts::{FRAC_PI_2, PI, TAU};

use glam::DVec2;

use super::link::Pose;
use crate::base::{Code, Finding, Result};
use crate::geom::{Outline, OutlineEdge};
use crate::num::angle::wrap;

/// Gap between two edges that is rounding [mm].
const GAP: f64 = 1e-6;
/// Turn between two edges that is rounding [rad].
const TURN: f64 = 1e-6;

/// The centre line of a slot: lines and arcs, each tangent to the one before.
///
/// ```
/// # use kinecut_plan as kinecut;
/// use glam::dvec2;
/// use kinecut::clearing::CentreLine;
/// // A slot of 12 mm, 40 mm between the centres of its round ends.
/// let line = CentreLine::line(dvec2(-20.0, 0.0), dvec2(20.0, 0.0))?;
/// let area = 40.0 * 12.0 + std::f64::consts::PI * 36.0;
/// assert!((line.outline(12.0)?.area() - area).abs() < 1e-9);
/// # Ok::<(), kinecut::base::Error>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct CentreLine {
    edges: Vec<OutlineEdge>,
    length: f64,
}

impl CentreLine {
    /// Of edges that join.
    ///
    /// # Errors
    /// `KC0404` where it has no length, is closed, has a gap, or turns at once.
    pub fn new(edges: Vec<OutlineEdge>) -> Result<CentreLine> {
        let length: f64 = edges.iter().map(OutlineEdge::length).sum();
        let ends = edges.first().zip(edges.last()).map(|(first, last)| [first.start, last.end]);
        let broken = edges.windows(2).find(|pair| {
            let turn = wrap(pair[1].heading(0.0) - pair[0].heading(1.0)).abs();
            pair[0].end.distance(pair[1].start) > GAP || turn > TURN
        });
        let whole = edges.iter().any(|e| e.turn.is_some_and(|t| t.sweep.abs() > TAU - TURN));
        let what = match (ends, broken) {
            (Some([start, end]), _) if length > GAP && start.distance(end) < GAP || whole => {
                "the centre line of the slot is closed"
            }
            (Some(_), None) if length > GAP => return Ok(CentreLine { edges, length }),
            (_, Some(_)) => "the centre line of the slot has a gap or a corner",
            _ => "the centre line of the slot has no length",
        };
        let help = "give a line between two points, or an arc of less than 360 degrees; clear other shapes as a pocket";
        Err(Finding::error(Code::PLAN_VALUE, what).help(help).into())
    }

    /// A straight one between the centres of its ends.
    ///
    /// # Errors
    /// `KC0404` where they are the same.
    pub fn line(from: DVec2, to: DVec2) -> Result<CentreLine> {
        CentreLine::new(vec![OutlineEdge::line(from, to)])
    }

    /// An arc about a centre, of a radius [mm], from a polar angle [rad] on, counter-clockwise by a positive angle [rad].
    ///
    /// # Errors
    /// `KC0404` where it has no length or is a whole circle.
    pub fn arc(centre: DVec2, radius: f64, from: f64, sweep: f64) -> Result<CentreLine> {
        CentreLine::new(vec![OutlineEdge::arc(centre, radius, from, sweep)])
    }

    /// Its edges.
    pub fn edges(&self) -> &[OutlineEdge] {
        &self.edges
    }

    /// Its length, between the centres of the ends [mm].
    pub fn length(&self) -> f64 {
        self.length
    }

    /// The other way.
    #[must_use]
    pub fn reversed(&self) -> CentreLine {
        CentreLine { edges: self.edges.iter().rev().map(OutlineEdge::reversed).collect(), ..*self }
    }

    /// With `y` and `-y` exchanged.
    #[must_use]
    pub fn mirrored(&self) -> CentreLine {
        // The mirror image of an edge of an outline runs the other way.
        CentreLine { edges: self.edges.iter().map(|e| e.mirrored().reversed()).collect(), ..*self }
    }

    /// The place after a length [mm], with the direction of travel.
    pub(super) fn pose(&self, along: f64) -> Pose {
        let mut rest = along;
        for (i, edge) in self.edges.iter().enumerate() {
            let length = edge.length();
            if rest <= length || i + 1 == self.edges.len() {
                let share = (rest / length).clamp(0.0, 1.0);
                return Pose { at: edge.at(share), heading: edge.heading(share) };
            }
            rest -= length;
        }
        Pose { at: DVec2::ZERO, heading: 0.0 }
    }

    /// The outline of a slot of a width [mm], with round ends.
    ///
    /// # Errors
    /// `KC0404` where an arc is so tight that the inner wall vanishes; those of outlines where the slot crosses itself.
    pub fn outline(&self, width: f64) -> Result<Outline> {
        let half = 0.5 * width;
        let tight = self.edges.iter().filter_map(|e| e.turn).find(|t| t.radius - half <= GAP);
        if let Some(turn) = tight {
            let what = "the centre line of the slot turns so tightly that its inner wall vanishes";
            return Err(Finding::error(Code::PLAN_VALUE, what)
                .value_mm(turn.radius)
                .bound_mm(half)
                .help("give a larger radius, or a smaller width")
                .into());
        }
        let cap = |at: DVec2, heading: f64| OutlineEdge::arc(at, half, heading - FRAC_PI_2, PI);
        let there = self.edges.iter().map(|e| aside(e, half));
        let back = self.edges.iter().rev().map(|e| aside(&e.reversed(), half));
        let [start, end] = [self.pose(0.0), self.pose(self.length)];
        let ends = [cap(end.at, end.heading), cap(start.at, start.heading + PI)];
        let mut edges: Vec<OutlineEdge> = there.chain([ends[0]]).chain(back).chain([ends[1]]).collect();
        for i in 0..edges.len() {
            let next = (i + 1) % edges.len();
            edges[next].start = edges[i].end;
        }
        Outline::new(vec![edges], Vec::new())
    }
}

/// The parallel of an edge on its right, at a distance [mm].
fn aside(edge: &OutlineEdge, distance: f64) -> OutlineEdge {
    match edge.turn {
        None => {
            let right = DVec2::from_angle(edge.heading(0.0) - FRAC_PI_2);
            OutlineEdge::line(edge.start + distance * right, edge.end + distance * right)
        }
        Some(t) => OutlineEdge::arc(t.centre, t.radius + distance * t.sweep.signum(), t.from, t.sweep),
    }
}
