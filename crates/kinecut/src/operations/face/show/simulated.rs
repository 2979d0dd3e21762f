//! Simulated exits against the planned ones.

use glam::DVec2;

use super::frame::PictureFrame;
use super::{MilledFace, Timed, looks};
use crate::geom::OutlineEdge;
use crate::num::angle::wrap;
use crate::page::px;
use crate::page::{Ink, Picture};

/// Result of simulating the posted text for a face.
pub(crate) struct Simulated {
    /// Places on the walls of the stock.
    pub(crate) dots: Vec<Dot>,
    /// The way of the cutter's centre in the plan's frame, its times from its begin.
    pub(crate) chains: Timed,
    /// The program's time at that begin, and its whole time [s].
    pub(crate) program: [f64; 2],
}

/// A place on a wall.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Dot {
    /// In the plan's frame [mm].
    pub(crate) at: DVec2,
    /// Exit angle as simulated [rad]: an exit between 0 and pi.
    pub(crate) angle: f64,
    /// As planned [rad], where the plan does not change.
    pub(crate) planned: Option<f64>,
}

/// Distance of the dots from the edge [px].
const AWAY: f64 = 6.5;
/// Difference of angles that the grid explains [rad].
const GRID: f64 = 0.02;
/// Facets of a mesh lie this much farther inside of an arc than the place that was met [mm].
const FACET: f64 = 0.01;

/// The dots outside of the outline, in the inks of what was simulated; differing ones marked.
pub(super) fn put_dots(picture: &mut Picture, face: &MilledFace<'_>, frame: &PictureFrame, dots: &[Dot]) {
    let case = &face.plan.case;
    let mut paths: Vec<(Ink, String, &str)> = vec![
        (looks::SIMULATED_ENTRY, String::new(), "simulated entry"),
        (looks::SIMULATED_GOOD, String::new(), "simulated good exit"),
        (looks::SIMULATED_BAD, String::new(), "simulated bad exit"),
        (looks::DIFFERING, String::new(), "simulated otherwise than planned"),
    ];
    for dot in dots {
        let Some((index, away, out)) = nearest(case.outline.edges(), dot.at) else { continue };
        let edge = &case.outline.edges()[index];
        let lean = edge.turn.map_or(0.0, |t| (1.0 - (away + FACET) / t.radius).clamp(-1.0, 1.0).acos());
        let ink = match dot.planned {
            Some(planned) if wrap(dot.angle - planned).abs() > GRID + lean => 3,
            _ if !(dot.angle > 0.0) => 0,
            _ if case.bad.weight(dot.angle) > 0.0 => 2,
            _ => 1,
        };
        let at = DVec2::from_array(frame.at(dot.at)) + AWAY * frame.along(out);
        paths[ink].1 += &format!("M{} {}h0", px(at.x), px(at.y));
    }
    for (ink, d, word) in paths {
        if !d.is_empty() {
            picture.legend.push((ink, word.to_owned()));
            picture.path(ink, d);
        }
    }
}

/// The edge nearest to a point, its distance [mm], and the direction out of the material there.
fn nearest(edges: &[OutlineEdge], point: DVec2) -> Option<(usize, f64, DVec2)> {
    let one = |(i, edge): (usize, &OutlineEdge)| {
        let (s, distance) = edge.nearest(point);
        (i, distance, DVec2::from_angle(edge.outward(s)))
    };
    edges.iter().enumerate().map(one).min_by(|a, b| a.1.total_cmp(&b.1))
}
