//! Plane curves as courses of two axes: each gives heading, curvature and its slope over arc length.

use std::f64::consts::{PI, TAU};

use kinecut::motion::{AxisLimit, Course};

/// Limits of the spiral table: 500 mm/s, 5000 mm/s^2, 50 000 mm/s^3.
pub(super) const USUAL: AxisLimit = AxisLimit { velocity: 500.0, acceleration: 5000.0, jerk: 50_000.0 };

/// A curve that is run at one feed.
#[derive(Clone)]
pub(super) struct Planar {
    shape: Shape,
    length: f64,
    pub(super) feed: f64,
    knots: Vec<f64>,
}

#[derive(Clone)]
enum Shape {
    /// From the cusp of an involute of a circle of this radius.
    Involute(f64),
    /// `r = c theta` from the centre.
    Archimedean(f64),
    Pieces(Pieces),
}

/// Curvature piecewise linear over arc length.
#[derive(Clone)]
struct Pieces {
    /// Start of each piece.
    starts: Vec<f64>,
    /// Heading at the start, curvature there and its slope.
    laws: Vec<[f64; 3]>,
}

/// Arc length of `r = c theta` over `c`.
fn archimedean_length(theta: f64) -> f64 {
    0.5 * (theta * theta.hypot(1.0) + theta.asinh())
}

impl Planar {
    /// An involute from its cusp, with this distance of its turns.
    pub(super) fn involute(pitch: f64, turns: f64, feed: f64) -> Planar {
        let radius = pitch / TAU;
        let length = 0.5 * radius * (TAU * turns).powi(2);
        Planar { shape: Shape::Involute(radius), length, feed, knots: Vec::new() }
    }

    /// An Archimedean spiral from its centre, with this distance of its turns.
    pub(super) fn archimedean(pitch: f64, turns: f64, feed: f64) -> Planar {
        let c = pitch / TAU;
        let length = c * archimedean_length(TAU * turns);
        Planar { shape: Shape::Archimedean(c), length, feed, knots: Vec::new() }
    }

    /// Pieces of these lengths whose curvature goes evenly from one value to another.
    pub(super) fn pieces(heading: f64, pieces: &[(f64, [f64; 2])], feed: f64) -> Planar {
        let (mut s, mut heading) = (0.0, heading);
        let (mut starts, mut laws) = (Vec::new(), Vec::new());
        for (length, [from, to]) in pieces {
            starts.push(s);
            laws.push([heading, *from, (to - from) / length]);
            heading += 0.5 * (from + to) * length;
            s += length;
        }
        let knots = starts[1..].to_vec();
        Planar { shape: Shape::Pieces(Pieces { starts, laws }), length: s, feed, knots }
    }

    /// A straight way.
    pub(super) fn straight(length: f64, heading: f64, feed: f64) -> Planar {
        Planar::pieces(heading, &[(length, [0.0; 2])], feed)
    }

    /// Semicircles of `pitch / 2`, `pitch`, ... with clothoids of length `ramp` about their joints.
    pub(super) fn semicircles(pitch: f64, turns: u32, ramp: f64, feed: f64) -> Planar {
        let count = 2 * turns;
        let mut pieces = Vec::new();
        for i in 1..=count {
            let radius = 0.5 * pitch * f64::from(i);
            let taken = if i == 1 || i == count { 0.5 * ramp } else { ramp };
            pieces.push((PI * radius - taken, [1.0 / radius; 2]));
            if i < count {
                pieces.push((ramp, [1.0 / radius, 2.0 / (pitch * f64::from(i + 1))]));
            }
        }
        Planar::pieces(0.0, &pieces, feed)
    }

    /// Heading, curvature and its slope.
    pub(super) fn frame(&self, s: f64) -> [f64; 3] {
        match &self.shape {
            Shape::Involute(radius) => {
                let s = s.max(1e-12);
                let theta = (2.0 * s / radius).sqrt();
                let curvature = 1.0 / (radius * theta);
                [theta, curvature, -curvature / (2.0 * s)]
            }
            Shape::Archimedean(c) => {
                let theta = archimedean_angle(s / c);
                let w = 1.0 + theta * theta;
                let curvature = (2.0 + theta * theta) / (c * w.powf(1.5));
                let by_angle = (2.0 * theta * w - 3.0 * theta * (2.0 + theta * theta)) / (c * w.powf(2.5));
                [theta + theta.atan(), curvature, by_angle / (c * w.sqrt())]
            }
            Shape::Pieces(Pieces { starts, laws }) => {
                let i = starts.partition_point(|start| *start <= s).max(1) - 1;
                let ([heading, curvature, slope], u) = (laws[i], s - starts[i]);
                [heading + (curvature + 0.5 * slope * u) * u, curvature + slope * u, slope]
            }
        }
    }

    /// Change of the position between two places: Gauss quadrature of the heading, in parts that turn little.
    pub(super) fn way(&self, from: f64, to: f64) -> [f64; 2] {
        // Nodes and weights of five points on [-1, 1].
        const NODES: [f64; 5] = [
            -0.906_179_845_938_664,
            -0.538_469_310_105_683_1,
            0.0,
            0.538_469_310_105_683_1,
            0.906_179_845_938_664,
        ];
        const WEIGHTS: [f64; 5] = [
            0.236_926_885_056_189_08,
            0.478_628_670_499_366_47,
            0.568_888_888_888_888_9,
            0.478_628_670_499_366_47,
            0.236_926_885_056_189_08,
        ];
        const TURN: f64 = 0.05;
        let mut moved = [0.0; 2];
        let mut start = from;
        let first = self.knots.partition_point(|k| *k <= from);
        let inside = self.knots[first..].iter().copied().take_while(|k| *k < to);
        for end in inside.chain([to]) {
            let turned = self.frame(start)[1].abs().max(self.frame(end - 1e-9 * (end - start))[1].abs())
                * (end - start);
            let parts = (turned / TURN).ceil().max(1.0);
            let h = (end - start) / parts;
            for k in 0..parts as usize {
                let middle = start + (k as f64 + 0.5) * h;
                for (node, weight) in NODES.iter().zip(WEIGHTS) {
                    let (sin, cos) = self.frame(middle + 0.5 * h * node)[0].sin_cos();
                    moved[0] += 0.5 * h * weight * cos;
                    moved[1] += 0.5 * h * weight * sin;
                }
            }
            start = end;
        }
        moved
    }
}

/// Angle at which `archimedean_length` has this value.
fn archimedean_angle(length: f64) -> f64 {
    let mut theta = length.min((2.0 * length.max(0.0)).sqrt());
    for _ in 0..30 {
        let step = (archimedean_length(theta) - length) / theta.hypot(1.0);
        theta -= step;
        if step.abs() < 1e-13 * (1.0 + theta) {
            break;
        }
    }
    theta
}

impl Course<2> for Planar {
    fn length(&self) -> f64 {
        self.length
    }

    fn derivatives(&self, s: f64) -> [[f64; 3]; 2] {
        let [heading, curvature, slope] = self.frame(s);
        let (sin, cos) = heading.sin_cos();
        let square = curvature * curvature;
        [
            [cos, -curvature * sin, -slope * sin - square * cos],
            [sin, curvature * cos, slope * cos - square * sin],
        ]
    }

    fn feed(&self, _: f64) -> f64 {
        self.feed
    }

    fn knots(&self) -> &[f64] {
        &self.knots
    }
}
