//! Joints of two elements: where they stop, overlap, go on, or get an arc.
//!
//! Source: LinuxCNC 2.10, `src/emc/tp/tp.c`, at `tpHandleBlendArc`, `tpSetupTangent` and `tpComputeBlendVelocity`.

use glam::DVec3;

use super::blend_arc::blend_arc;
use super::element::{Element, Passage};
use super::shape::Shape;
use super::{Bounds, CYCLE, KINK, TANGENTIAL_SHARE};

/// What stands between two elements.
pub(super) enum Between<'a> {
    Nothing,
    /// An arc.
    Arc(Box<Element<'a>>),
    /// An arc in place of the element before, which was short.
    Instead(Box<Element<'a>>),
}

/// Joins two elements.
pub(super) fn join<'a>(before: &mut Element<'a>, next: &mut Element<'a>, bounds: &Bounds) -> Between<'a> {
    /// Sum of two directions that is a way back: two degrees.
    const BACK: f64 = 2.0 * std::f64::consts::PI / 180.0;
    if before.is_rapid != next.is_rapid {
        before.pass(next, Passage::Stop);
    }
    if before.turns || next.turns || before.end == Passage::Stop {
        return Between::Nothing;
    }
    let (old, new) = (before.shape.tangent(true), next.shape.tangent(false));
    if (old + new).length_squared() < BACK * BACK {
        before.pass(next, Passage::Stop);
        return Between::Nothing;
    }
    let speed = before.target().min(next.target());
    let step = (new - old) * (speed / CYCLE + next.acceleration);
    let mut share = (step / bounds.acceleration).abs().max_element();
    if [&before.shape, &next.shape].into_iter().any(|shape| matches!(shape, Shape::Arc(_))) {
        share /= TANGENTIAL_SHARE;
    }
    if share < KINK {
        before.pass(next, Passage::Tangent);
        before.set_kink(next, speed, share);
        return Between::Nothing;
    }
    before.set_kink(next, speed * KINK / share, KINK);
    if before.end != Passage::Overlap || before.is_fixed {
        return Between::Nothing;
    }
    blend_arc(before, next, bounds).unwrap_or_else(|| {
        choose(before, next, 0.0);
        Between::Nothing
    })
}

/// The fastest of overlap, tangential passage, and an arc of this speed [mm/s]; true if that is the arc.
pub(super) fn choose(before: &mut Element, next: &mut Element, arc: f64) -> bool {
    let overlap = 0.5 * overlap_speeds(before, next)[2];
    let tangent = before.kink.unwrap_or(-1.0);
    if arc > overlap && arc > tangent {
        before.forget_kink(next);
        return true;
    }
    if tangent > overlap {
        before.pass(next, Passage::Tangent);
    } else {
        before.forget_kink(next);
        before.pass(next, Passage::Overlap);
    }
    false
}

/// Speeds at which an overlap begins in this element and ends in the next one, and of both together [mm/s].
pub(super) fn overlap_speeds(this: &Element, next: &Element) -> [f64; 3] {
    let reached = |e: &Element| {
        let length = if e.is_fixed { e.length } else { 0.5 * e.length };
        (e.tangential() * length).sqrt().min(e.target())
    };
    let (a, b) = (this.tangential(), next.tangential());
    let (v, w) = (reached(this), reached(next));
    let longest = (this.length / v).min(next.length / w);
    let time = longest.min((v / a).max(w / b));
    let (mut v, mut w) = (v.min(time * a), w.min(time * b));
    // Half of the angle that the moves enclose.
    let half =
        0.5 * (-pull(&this.shape, this, true).dot(pull(&next.shape, next, false))).clamp(-1.0, 1.0).acos();
    /// Angle to a straight joint below which the tolerance does not count [rad].
    const STRAIGHT: f64 = 1e-3;
    if this.tolerance > 0.0 && half.cos() > STRAIGHT.sin() {
        let within = 2.0 * (a * this.tolerance / half.cos()).sqrt();
        v = v.min(within);
        w = w.min(within);
    }
    [v, w, 0.5 * half.sin() * (v + w)]
}

/// Direction of the acceleration at the start or at the end of an element.
fn pull(shape: &Shape, element: &Element, at_end: bool) -> DVec3 {
    let Shape::Arc(arc) = shape else { return shape.tangent(at_end) };
    if at_end {
        return arc.normal.cross(arc.point(arc.angle) - arc.centre).normalize_or_zero();
    }
    let radius = arc.radius();
    let across = -arc.start / radius * ((0.5 * element.feed).powi(2) / radius);
    (arc.normal.cross(arc.start) / radius * element.overall() + across).normalize_or_zero()
}
