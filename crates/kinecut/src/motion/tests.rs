//! The figures of the comparison in the specification, and closed forms.

use std::f64::consts::{FRAC_PI_2, PI, TAU};

use super::{Limits, Way, pointwise};
use crate::geom::{Arc, Curve, InvoluteRecord, Line, PlaneCurve};
use glam::DVec3;

fn record(length: f64, start: [f64; 2], angle: f64, radii: [f64; 2]) -> PlaneCurve {
    InvoluteRecord::new(length, start, angle, radii[0], radii[1]).unwrap().into()
}

fn closing() -> PlaneCurve {
    record(TAU * 79.0, [0.0, -79.0], 0.0, [79.0, 79.0])
}

/// At 6, 18 and 36 m/min.
fn times(chain: &[PlaneCurve]) -> Vec<f64> {
    [100.0, 300.0, 600.0].iter().map(|f| pointwise(chain, &Limits { axis_velocity: 1e4, ..Limits::usual(*f) }).unwrap().time).collect()
}

#[test]
fn print_times() {
    let involute = [record(PI * 20.0 * 79.0, [0.0; 2], 0.0, [0.0, 79.0]), closing()];
    println!("{:?}", times(&involute));
    println!("{:?}", times(&involute[..1]));
    let ann = [record(TAU * 10.0, [0.0, -10.0], 0.0, [10.0, 10.0]), record(PI * 20.0 * 89.0, [0.0, -10.0], 0.0, [10.0, 79.0]), closing()];
    println!("{:?}", times(&ann));
    use crate::holes::clearing::*;
    for (c, inner) in [(Clearing::Poles(2), 0.0), (Clearing::Poles(4), 0.0), (Clearing::Archimedes, 0.0), (Clearing::RingsRadial, 0.0), (Clearing::RingsTangent, 0.0), (Clearing::ConstantEngagement(crate::geom::LensOrder::One), 10.0)] {
        let disc = Disc { inner, inner_most: inner, outer: 79.0, cutter: 20.0, step: if inner > 0.0 { 40.0 } else { 4.0 }, engagement: Some(60f64.to_radians()), psi: 0.0, resolution: None };
        let p = c.path(&disc).unwrap();
        let mut chain = p.curves.clone();
        if inner > 0.0 { chain.insert(0, record(TAU * 10.0, [0.0, -10.0], 0.0, [10.0, 10.0])); }
        chain.push(p.closing.into());
        let t0 = std::time::Instant::now();
        println!("{} {:?} {:?} {}", c.name(), times(&chain), t0.elapsed(), pointwise(&chain, &Limits::usual(100.0)).unwrap().uncertainty);
    }
}
