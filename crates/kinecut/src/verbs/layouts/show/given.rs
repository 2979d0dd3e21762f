//! Bodies of a machine as its file gives them, at positions of its axes, with the place of each arrow.

use glam::DVec3;

use super::bodies::{Bodies, Link, turned};
use super::looks;
use super::solid::{Hub, Point3, Shape, Solid, unit};
use crate::machine::layouts::Attitude;
use crate::machine::{self, Machine};
use crate::page::draw::Facets;

/// The bodies of a machine at joint positions `q`; none when its file gives none.
pub(crate) fn given_bodies(machine: &Machine, attitude: Attitude, q: &[f64]) -> Option<Bodies> {
    if machine.bodies.is_empty() {
        return None;
    }
    let bed = machine.code.bed();
    let to_picture = |v: [f64; 3]| turned(v, attitude);
    let tint = |link: machine::Link| match link {
        machine::Link::Bed => looks::BED,
        machine::Link::Axis(i) if i < bed => looks::WORK,
        machine::Link::Axis(_) => looks::TOOL,
    };
    let motions = machine.body_motions(q);
    let mut out = Bodies::default();
    for (body, moved) in machine.bodies.iter().zip(&motions) {
        let mut facets = Facets::of(&body.solid, &moved.after(&body.place));
        facets.corners.iter_mut().for_each(|c| *c = to_picture(c.to_array()).into());
        out.solids.push(Solid { shape: Shape::Given, facets, tint: tint(body.link), hub: None });
    }
    let size = |i: usize| {
        let [low, high] = out.solids[i].bounds();
        (0..3).map(|k| high[k] - low[k]).product::<f64>()
    };
    // The greatest body of a link shows its motion.
    let body_of = |link: machine::Link| {
        let own = (0..out.solids.len()).filter(|&i| machine.bodies[i].link == link);
        own.max_by(|&a, &b| size(a).total_cmp(&size(b)))
    };
    let count = machine.joints.len();
    for (i, joint) in machine.joints.iter().enumerate() {
        let work = i < bed;
        // Without a body of its own: the nearest that it carries, then the nearest that carries it.
        let carried = if work { (0..=i).rev().collect::<Vec<_>>() } else { (i..count).collect() };
        let carrying = if work { (i + 1..bed).collect::<Vec<_>>() } else { (bed..i).rev().collect() };
        let links = carried.into_iter().chain(carrying).map(machine::Link::Axis);
        let body = links.chain([machine::Link::Bed]).find_map(body_of).unwrap_or(0);
        // The axis has the place of the link that carries it.
        let holder = match i {
            _ if work && i + 1 < bed => machine::Link::Axis(i + 1),
            _ if !work && i > bed => machine::Link::Axis(i - 1),
            _ => machine::Link::Bed,
        };
        let at = machine.link(holder, q);
        let axis = unit(to_picture(at.vector(joint.direction * joint.sense).to_array()));
        let through = to_picture(at.point(joint.point).to_array());
        let hub = joint.motion.is_rotation().then(|| hub(&out.solids[body], axis, through));
        out.links.push(Link { motion: joint.motion, work, axis, body, end: 0.0, hub });
    }
    let lowest = |i: usize| out.solids[i].bounds()[0][2];
    let floor = (0..out.solids.len()).map(lowest).fold(f64::INFINITY, f64::min);
    /// A body whose bottom is within this height of the lowest one is on the ground too [mm].
    const GROUND: f64 = 1.0;
    let stands = |&i: &usize| machine.bodies[i].link == machine::Link::Bed && lowest(i) <= floor + GROUND;
    out.ground = (0..out.solids.len()).filter(stands).collect();
    Some(out)
}

/// The drum about an axis that a body fills: as long as the body along the axis, as wide as the body is across it where it is
/// narrowest.
fn hub(body: &Solid, axis: Point3, through: Point3) -> Hub {
    let (a, p) = (DVec3::from_array(axis), DVec3::from_array(through));
    let [low, high] = body.bounds().map(DVec3::from_array);
    let (middle, half) = (0.5 * (low + high), 0.5 * (high - low));
    let centre = p + a * a.dot(middle - p);
    let (mut least, mut most) = (f64::INFINITY, f64::NEG_INFINITY);
    for &corner in &body.facets.corners {
        let along = a.dot(corner - centre);
        (least, most) = (least.min(along), most.max(along));
    }
    if !(least < most) {
        let reach = a.abs().dot(half);
        (least, most) = (-reach, reach);
    }
    let across = (0..3).filter(|&k| a[k].abs() < 0.7).map(|k| half[k]).fold(f64::INFINITY, f64::min);
    let radius = if across.is_finite() { across } else { half.max_element() };
    let centre = centre + a * (0.5 * (least + most));
    Hub { centre: centre.to_array(), radius, half: 0.5 * (most - least) }
}
