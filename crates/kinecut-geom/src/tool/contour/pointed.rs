//! Contours of tools that work along their axis: the edge of a point, turned about the axis.

use glam::DVec2;

use super::Contour;
use super::pen::Pen;
use crate::base::Result;
use crate::geom::EdgeSegment;
use crate::tool::DrillPoint;
use crate::tool::dimension::{at_least, at_most, positive, refuse};

pub(super) fn drill(diameter: f64, point: &DrillPoint, length: f64) -> Result<Contour> {
    let edge = point.edge(diameter)?;
    positive("flute_length", length)?;
    at_least("flute_length", length, edge.extent()[1], "the height of the point")?;
    let first = edge.segments()[0];
    let mut pen = Pen::at(first.height(first.range()[0]));
    for segment in edge.segments() {
        let [inner, outer] = segment.range();
        // Across the core of the first, up or down the step before another.
        pen = pen.to(inner, segment.height(inner));
        pen = match *segment {
            EdgeSegment::Line { .. } => pen.to(outer, segment.height(outer)),
            EdgeSegment::Arc { centre, radius, .. } => {
                let normal = |r: f64| {
                    let out = DVec2::new(r, segment.height(r)) - DVec2::from(centre);
                    out.y.atan2(out.x)
                };
                // At the height of the centre the sine is rounded to either side of 0: the lower side ends there.
                pen.round(centre, radius, normal(inner), normal(outer))
            }
        };
    }
    pen.to(0.5 * diameter, length).cap(length)
}

pub(super) fn countersink(diameter: f64, angle: f64, nose: f64, length: f64) -> Result<Contour> {
    let cone = DrillPoint::Cone { angle, nose };
    drill(diameter, &cone, length).map_err(|mut e| {
        // The dimension as it is called here.
        if e.0.key.as_deref() == Some("cone_angle") {
            e.0.key = Some("angle".to_owned());
        }
        e
    })
}

pub(super) fn hollow(diameter: f64, core: f64, depth: f64, length: f64) -> Result<Contour> {
    positive("diameter", diameter)?;
    positive("core_diameter", core)?;
    positive("depth", depth)?;
    at_most("core_diameter", core, diameter, "the diameter")?;
    if !(length > depth && length.is_finite()) {
        return Err(refuse("flute_length", "the body must end above the hollow", length, depth));
    }
    let (inner, outer) = (0.5 * core, 0.5 * diameter);
    Pen::at(depth).to(inner, depth).to(inner, 0.0).to(outer, 0.0).to(outer, length).cap(length)
}
