//! Drawings of half a section of a body of revolution: an open chain from its axis to its axis is closed along the axis.

use glam::DVec2;

use super::chain::open_ends;
use super::drawing::{Drawing, Origin};
use super::through::with_ends;
use super::{OutlineEdge, SectionAxis};
use crate::base::{Code, Result};

impl SectionAxis {
    /// Distance of a point from the axis, to either side [mm].
    pub fn aside(self, p: DVec2) -> f64 {
        match self {
            SectionAxis::X => p.y,
            SectionAxis::Y => p.x,
        }
    }

    /// Place of a point along the axis [mm].
    pub fn along(self, p: DVec2) -> f64 {
        match self {
            SectionAxis::X => p.x,
            SectionAxis::Y => p.y,
        }
    }

    fn foot(self, p: DVec2) -> DVec2 {
        match self {
            SectionAxis::X => DVec2::new(p.x, 0.0),
            SectionAxis::Y => DVec2::new(0.0, p.y),
        }
    }

    /// True if an edge runs along the axis, within `snap` [mm].
    pub fn carries(self, edge: &OutlineEdge, snap: f64) -> bool {
        edge.turn.is_none() && self.aside(edge.start).abs() <= snap && self.aside(edge.end).abs() <= snap
    }
}

/// Leaves out what is drawn along the axis (its centre line, the edge of a closed half) and closes what is then open by an
/// edge along it.
pub(super) fn close_along(drawing: &mut Drawing, axis: SectionAxis, snap: f64) -> Result<()> {
    let mut paths = Vec::new();
    for one in std::mem::take(&mut drawing.loops) {
        let Some(first) = one.iter().position(|e| axis.carries(e, snap)) else {
            drawing.loops.push(one);
            continue;
        };
        // Begin behind the axis, so that what is left is in one piece.
        paths.push(one[first..].iter().chain(&one[..first]).copied().collect::<Vec<_>>());
    }
    paths.append(&mut drawing.paths);
    for path in paths {
        let pieces = path.split(|e| axis.carries(e, snap)).filter(|p| !p.is_empty());
        drawing.paths.extend(pieces.map(<[OutlineEdge]>::to_vec));
    }
    let open = open_ends(&drawing.paths, snap);
    let place = |&(path, last): &(usize, bool), paths: &[Vec<OutlineEdge>]| {
        let path = &paths[path];
        if last { path[path.len() - 1].end } else { path[0].start }
    };
    let [a, b] = open[..] else { return Ok(()) };
    let mut feet = [DVec2::ZERO; 2];
    for (foot, end) in feet.iter_mut().zip([a, b]) {
        let p = place(&end, &drawing.paths);
        let aside = axis.aside(p);
        if aside.abs() > snap {
            let edge = &drawing.paths[end.0][if end.1 { drawing.paths[end.0].len() - 1 } else { 0 }];
            let what =
                format!("{} ends aside of the axis at ({:.4}, {:.4})", drawing.entity(edge.label), p.x, p.y);
            return Err(drawing
                .error_at(edge.label, Code::OUTLINE_OPEN, what)
                .value_mm(aside)
                .bound_mm(snap)
                .point([p.x, p.y, 0.0])
                .help("draw half the section from the axis to the axis, with the axis through the origin, or say which axis it is")
                .into());
        }
        *foot = axis.foot(p);
        let path = &mut drawing.paths[end.0];
        if end.1 {
            if let Some(edge) = path.last_mut() {
                *edge = with_ends(edge, edge.start, *foot);
            }
        } else if let Some(edge) = path.first_mut() {
            *edge = with_ends(edge, *foot, edge.end);
        }
    }
    let label =
        drawing.origin(Origin { what: "the axis".to_owned(), offset: None, label: None, weight: None });
    drawing.paths.push(vec![OutlineEdge::line(feet[0], feet[1]).labelled(label)]);
    Ok(())
}
