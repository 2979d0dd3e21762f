//! Usual bodies that move: those of the picture of a code, each on the link that carries it.
//!
//! The machine of the picture turns about the middles of the bodies as they are drawn. Where the axes of a machine are
//! elsewhere, its own chain tells the numbers, and the picture who moves.

use glam::DVec3;

use super::bodies::{Bodies, bodies, turned};
use super::looks;
use super::solid::Shape;
use crate::base::Result;
use crate::geom::Aabb;
use crate::machine::layouts::{Attitude, Sizes};
use crate::machine::{Body, CoordinateCode, Link, Machine};

/// Name of the body that is the workpiece.
pub(crate) const PART: &str = "part";
/// Name of the body that is the cutter.
pub(crate) const CUTTER: &str = "cutter";

/// A machine with usual bodies in place of its own, its rotary axes through the middles of those, its gauge point
/// where the cutter ends; and the picture of them at home.
pub(crate) fn usual(of: &Machine, attitude: Attitude, sizes: &Sizes) -> (Machine, Bodies) {
    let made = bodies(&of.code, attitude, sizes);
    let mut machine = of.clone();
    for (joint, link) in machine.joints.iter_mut().zip(&made.links) {
        if let (true, Some(hub)) = (joint.motion.is_rotation(), made.solids[link.body].hub) {
            joint.point = of_picture(hub.centre, attitude);
        }
    }
    let mut all: Vec<Body> = Vec::with_capacity(made.solids.len());
    for (solid, &carrier) in made.solids.iter().zip(&made.carriers) {
        let mut body = match (solid.shape, solid.hub) {
            (Shape::Drum(axis), Some(hub)) => {
                let axis = of_picture(axis.to_array(), attitude);
                let base = of_picture(hub.centre, attitude) - axis * hub.half;
                Body::cylinder(carrier, base, axis, hub.radius, 2.0 * hub.half)
            }
            (Shape::Block(b), _) => {
                let ends = [b.min, b.max].map(|c| of_picture(c.to_array(), attitude));
                Body::cuboid(carrier, Aabb { min: ends[0].min(ends[1]), max: ends[0].max(ends[1]) })
            }
            _ => continue,
        };
        if solid.tint == looks::PART {
            body.name = PART.to_owned();
        } else if solid.tint == looks::STEEL {
            // The cutter comes before the spindle.
            let first = all.iter().all(|b| b.name != CUTTER);
            body.name = if first { CUTTER } else { "spindle" }.to_owned();
            if first {
                machine.spindle.translation = DVec3::Z * (body.bounds().max - body.bounds().min).z;
            }
        }
        all.push(body);
    }
    machine.bodies = all.into();
    (machine, made)
}

/// Sizes of the usual bodies of a machine: its strokes, and the directions of its inclined axes.
pub(crate) fn usual_sizes(machine: &Machine) -> Sizes {
    let mut sizes = Sizes::default();
    for joint in &machine.joints {
        let digit = usize::from(joint.motion.digit());
        match joint.travel {
            Some([low, high]) if digit <= 3 && high - low > 0.0 => sizes.stroke[digit - 1] = high - low,
            _ => {}
        }
        if digit > 6 {
            sizes.inclined[digit - 7] = joint.direction;
        }
    }
    sizes
}

/// A machine of a layout: its rotary axes go through the middles of the usual bodies, its gauge point is where the usual
/// cutter ends. It has no bodies of its own; it is drawn with the usual ones.
///
/// # Errors
/// Those of [`Sizes::machine`].
pub fn layout_machine(code: &CoordinateCode, attitude: Attitude, sizes: &Sizes) -> Result<Machine> {
    let (machine, _) = usual(&sizes.machine(code)?, attitude, sizes);
    Ok(Machine { bodies: [].into(), ..machine })
}

/// A machine with its bodies, or with the usual ones without part and cutter, which are none of the machine.
pub fn with_usual_bodies(machine: &Machine, attitude: Attitude) -> Machine {
    if !machine.bodies.is_empty() {
        return machine.clone();
    }
    let (mut machine, _) = usual(machine, attitude, &usual_sizes(machine));
    machine.bodies = machine.bodies.iter().filter(|b| b.name != PART && b.name != CUTTER).cloned().collect();
    machine
}

/// A place or direction of the picture in the frame of the machine.
fn of_picture(p: [f64; 3], attitude: Attitude) -> DVec3 {
    // The turn of the picture is its own inverse.
    DVec3::from(turned(p, attitude))
}

/// The link that a body of the picture is on, for a machine whose bodies are its own too.
pub(crate) fn side(machine: &Machine, link: Link) -> &'static str {
    match link {
        Link::Bed => "bed",
        Link::Axis(i) if i < machine.code.bed() => "work",
        Link::Axis(_) => "tool",
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::machine::layouts::Search;

    #[test]
    fn every_usual_body_is_on_a_link_and_the_tip_of_the_cutter_is_that_of_the_chain() {
        let mut codes = Search::parse("XYZAC").unwrap().codes().unwrap();
        codes.extend(["6031", "012367", "2103"].map(|text| CoordinateCode::parse(text).unwrap()));
        for code in codes.iter().step_by(29).chain(codes.iter().rev().take(3)) {
            for attitude in [Attitude::Vertical, Attitude::Horizontal] {
                let sizes = Sizes::default();
                let (machine, made) = usual(&sizes.machine(code).unwrap(), attitude, &sizes);
                assert_eq!(machine.bodies.len(), made.solids.len(), "{code}");
                machine.check().unwrap();
                let q: Vec<f64> = (0..machine.joints.len()).map(|i| 0.3 + 0.1 * i as f64).collect();
                let [work, tool] = [machine.work_link(), machine.tool_link()].map(|l| machine.link(l, &q));
                let length = machine.spindle.translation.z;
                let tip = machine.kinematics(length).forward(&q).translation;
                // The tip is drawn at the zero of the picture at home.
                let seen = work.inverse().after(&tool).point(DVec3::ZERO);
                assert!((seen - tip).length() < 1e-9, "{code} {attitude:?}");
                // Each axis that moves takes a body along: its own is on it.
                for (i, link) in made.links.iter().enumerate() {
                    assert_eq!(made.carriers[link.body], Link::Axis(i), "{code} {attitude:?} {link:?}");
                }
            }
        }
    }
}
