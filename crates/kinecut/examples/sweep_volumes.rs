//! Volumes of sweeps, one JSON object a line: what `benches/peers/sweep_volume.py` compares with another program.
//!
//! Of each move: the half-section of the tool as points, the poses, the mesh's volume, and the closed form where there is one.

#![allow(clippy::print_stdout, reason = "an example prints what it finds")]

use std::f64::consts::FRAC_PI_2;

use glam::DVec3;
use kinecut::base::{Result, Silent};
use kinecut::geom::{Arc, Curve, Line};
use kinecut::sweep::{ProfileChain, ToolMotion, arc_volume, line_volume};
use kinecut::tool::{Contour, ContourElement, ContourShape, ElementRole};

/// Within which the envelopes are meshed [mm].
const TOLERANCE: f64 = 0.001;
/// Steps of an arc of the half-section.
const STEPS: u32 = 64;

fn bull() -> Result<Contour> {
    Contour::new(vec![
        ContourElement::line([0.0, 0.0], [3.0, 0.0], ElementRole::Cutting),
        ContourElement::arc([3.0, 2.0], 2.0, -FRAC_PI_2, 0.0, ElementRole::Cutting),
        ContourElement::line([5.0, 2.0], [5.0, 20.0], ElementRole::Cutting),
        ContourElement::line([5.0, 20.0], [0.0, 20.0], ElementRole::Shank),
    ])
}

fn ball() -> Result<Contour> {
    Contour::new(vec![
        ContourElement::arc([0.0, 5.0], 5.0, -FRAC_PI_2, 0.0, ElementRole::Cutting),
        ContourElement::line([5.0, 5.0], [5.0, 20.0], ElementRole::Cutting),
        ContourElement::line([5.0, 20.0], [0.0, 20.0], ElementRole::Shank),
    ])
}

fn section(contour: &Contour) -> Vec<[f64; 2]> {
    let mut points = vec![[0.0, contour.elements()[0].shape.start().y]];
    for element in contour.elements() {
        if let ContourShape::Arc { centre, radius, convex, from, to } = element.shape {
            let radius = if convex { radius } else { -radius };
            for k in 1..STEPS {
                let phi = from + (to - from) * f64::from(k) / f64::from(STEPS);
                points.push([centre.x + radius * phi.cos(), centre.y + radius * phi.sin()]);
            }
        }
        points.push(element.shape.end().to_array());
    }
    points.dedup();
    points
}

fn main() -> Result<()> {
    let way = DVec3::new(20.0, 6.0, -5.0);
    let level = DVec3::new(20.0, 6.0, 0.0);
    let line = |end| Curve::from(Line { start: DVec3::ZERO, end });
    let arc = || Arc::new(DVec3::new(14.0, 0.0, 0.0), DVec3::ZERO, DVec3::Z, 2.0, 0.0);
    for (tool, contour) in [("bull", bull()?), ("ball", ball()?)] {
        let moves = [
            (
                "level line",
                ToolMotion::fixed(line(level), DVec3::Z)?,
                Some(line_volume(&contour, level)),
                true,
            ),
            ("ramp", ToolMotion::fixed(line(way), DVec3::Z)?, Some(line_volume(&contour, way)), true),
            ("arc", ToolMotion::fixed(arc()?.into(), DVec3::Z)?, arc_volume(&contour, 14.0, 2.0), false),
            ("five axes", ToolMotion::between(line(way), DVec3::Z, DVec3::new(0.3, 0.1, 0.9))?, None, false),
        ];
        for (name, motion, exact, straight) in moves {
            let swept = ProfileChain::new(&contour).envelope(&motion, TOLERANCE, &Silent)?;
            let poses: Vec<Vec<f64>> = (0..=if straight { 1 } else { 50 })
                .map(|k| motion.pose(if straight { f64::from(k) } else { f64::from(k) / 50.0 }))
                .map(|pose| {
                    let r = pose.rotation;
                    [r.x_axis, r.y_axis, r.z_axis, pose.translation]
                        .iter()
                        .flat_map(|c| c.to_array())
                        .collect()
                })
                .collect();
            let line = serde_json::json!({
                "tool": tool, "move": name, "section": section(&contour), "poses": poses, "straight": straight,
                "volume": swept.mesh.volume(), "exact": exact, "triangles": swept.mesh.triangles.len(),
                "curves_change": swept.events.len(),
            });
            println!("{line}");
        }
    }
    Ok(())
}
