//! Crossings by dense sampling of each tooth's way, from the definitions alone.

use std::f64::consts::TAU;

use glam::{DVec2, dvec2};
use kinecut::facing::ToothedPass;
use kinecut::geom::{Outline, OutlineEdge};

#[derive(Clone, Copy, Debug)]
pub(crate) struct Sampled {
    pub(crate) tooth: usize,
    pub(crate) edge: usize,
    pub(crate) time: f64,
    pub(crate) exit: bool,
}

/// Where a tooth is; `spindle` is 1 for M3, -1 for M4.
pub(crate) fn position(pass: &ToothedPass, tooth: usize, spindle: f64, time: f64) -> DVec2 {
    let one = pass.teeth[tooth];
    let (sin, cos) = (time + one.phase).sin_cos();
    dvec2(pass.feed_per_radian * time - one.radius * sin, pass.placement.offset - spindle * one.radius * cos)
}

/// Distance from the line or circle of an edge, positive in the material.
fn depth(edge: &OutlineEdge, p: DVec2) -> f64 {
    match edge.turn {
        None => -(edge.end - edge.start).normalize_or_zero().perp_dot(p - edge.start),
        Some(t) => -t.sweep.signum() * (t.radius - (p - t.centre).length()),
    }
}

fn share(edge: &OutlineEdge, p: DVec2) -> f64 {
    match edge.turn {
        None => {
            let d = edge.end - edge.start;
            d.dot(p - edge.start) / d.length_squared()
        }
        Some(t) => {
            let phi = (p - t.centre).to_angle();
            ((phi - t.from) * t.sweep.signum()).rem_euclid(TAU) / t.sweep.abs()
        }
    }
}

fn bisect(f: impl Fn(f64) -> f64, mut lo: f64, mut hi: f64) -> f64 {
    let rising = f(hi) > f(lo);
    for _ in 0..52 {
        let middle = 0.5 * (lo + hi);
        if (f(middle) > 0.0) == rising {
            hi = middle;
        } else {
            lo = middle;
        }
    }
    0.5 * (lo + hi)
}

/// Place of the least of a function with one minimum.
fn least(f: impl Fn(f64) -> f64, mut lo: f64, mut hi: f64) -> f64 {
    for _ in 0..60 {
        let (a, b) = (lo + (hi - lo) / 3.0, hi - (hi - lo) / 3.0);
        if f(a) < f(b) {
            hi = b;
        } else {
            lo = a;
        }
    }
    0.5 * (lo + hi)
}

/// Sorted by tooth, edge and time; none where a crossing is too near to a tangency or vertex to be told.
pub(crate) fn sampled(
    outline: &Outline,
    pass: &ToothedPass,
    spindle: f64,
    per_turn: usize,
) -> Option<Vec<Sampled>> {
    let moved = outline.moved(pass.placement.angle, dvec2(pass.along, 0.0));
    let mut all = Vec::new();
    for tooth in 0..pass.teeth.len() {
        for (index, edge) in moved.edges().iter().enumerate() {
            let g = |t: f64| depth(edge, position(pass, tooth, spindle, t));
            let [x0, x1] = edge.extent(DVec2::X);
            let reach = pass.teeth[tooth].radius + 1.0;
            let (t0, t1) = ((x0 - reach) / pass.feed_per_radian, (x1 + reach) / pass.feed_per_radian);
            let n = ((t1 - t0) / TAU * per_turn as f64).ceil() as usize;
            let at = |i: usize| t0 + (t1 - t0) * i as f64 / n as f64;
            let mut take = |time: f64, exit: bool| {
                let s = share(edge, position(pass, tooth, spindle, time));
                if (0.0..1.0).contains(&s) {
                    all.push(Sampled { tooth, edge: index, time, exit });
                }
                s.abs() > 1e-7 && (s - 1.0).abs() > 1e-7
            };
            let mut last = [f64::NAN, g(at(0))];
            for i in 1..=n {
                let now = g(at(i));
                let [before, here] = last;
                if (now > 0.0) != (here > 0.0) {
                    if !take(bisect(g, at(i - 1), at(i)), now < here) {
                        return None;
                    }
                } else if (before > 0.0) == (here > 0.0)
                    && here.abs() <= before.abs()
                    && here.abs() < now.abs()
                {
                    let sign = here.signum();
                    let t = least(|t| sign * g(t), at(i - 2), at(i));
                    let g_t = sign * g(t);
                    if g_t.abs() < 1e-9 {
                        return None;
                    }
                    if g_t < 0.0 {
                        let roots = [bisect(g, at(i - 2), t), bisect(g, t, at(i))];
                        if !take(roots[0], sign > 0.0) || !take(roots[1], sign < 0.0) {
                            return None;
                        }
                    }
                }
                last = [here, now];
            }
        }
    }
    Some(all)
}

/// A tooth that touches an edge when the part is shifted along the feed.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Tangency {
    pub(crate) edge: usize,
    pub(crate) time: f64,
    pub(crate) shift: f64,
}

/// Tangencies of the first tooth in its first turn, for every edge that has some clear of its ends.
pub(crate) fn tangencies(moved: &Outline, pass: &ToothedPass) -> Vec<Tangency> {
    let mut all = Vec::new();
    for (index, edge) in moved.edges().iter().enumerate() {
        for k in 0..40 {
            // The edge's point at a share, and the tooth at that height: their directions agree at a tangency.
            for front in [true, false] {
                let miss = |s: f64| {
                    let (_, time) = meet(edge.at(s), pass, front)?;
                    let step = 1e-5;
                    let way = position(pass, 0, 1.0, time + step) - position(pass, 0, 1.0, time - step);
                    Some(way.normalize_or_zero().perp_dot(DVec2::from_angle(edge.heading(s))))
                };
                let (lo, hi) = (0.02 + 0.024 * f64::from(k), 0.02 + 0.024 * f64::from(k + 1));
                if let (Some(a), Some(b)) = (miss(lo), miss(hi))
                    && (a > 0.0) != (b > 0.0)
                {
                    let s = bisect(|s| miss(s).unwrap_or(0.0), lo, hi);
                    let Some((shift, time)) = meet(edge.at(s), pass, front) else { continue };
                    all.push(Tangency { edge: index, time, shift });
                }
            }
        }
    }
    all
}

/// Shift of the part along the feed, and time, for the first tooth to meet a point of the part.
pub(crate) fn meet(point: DVec2, pass: &ToothedPass, front: bool) -> Option<(f64, f64)> {
    let one = pass.teeth[0];
    let cos = (pass.placement.offset - point.y) / one.radius;
    let phase = if front { -cos.acos() } else { cos.acos() };
    let time = phase - one.phase;
    (cos.abs() < 1.0).then(|| (pass.feed_per_radian * time - one.radius * phase.sin() - point.x, time))
}
