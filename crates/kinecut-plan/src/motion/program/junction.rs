//! Look-ahead by junction deviation, as hobby controls run: trapezoids of speed, and a speed that each joint allows.
//!
//! Curves are chords there. At a joint whose moves enclose the angle `h` the speed is at most
//! `v^2 = a d s / (1 - s)` with `s = sin(h/2)`, the acceleration `a` and the deviation `d`: that of an arc that touches both moves
//! and leaves the corner by `d`. Jerk is not limited. Source: Grbl 1.1, planner.c.

use super::super::AxisLimit;
use super::joint::AXES;
use super::run::Piece;
use super::straight::along;

/// Distance of a chord from its curve [mm]: Grbl's setting $12.
const CHORD: f64 = 0.002;
/// Most chords of one move.
const MOST_CHORDS: f64 = 100_000.0;

/// A chord.
struct Block {
    /// Index of its move.
    piece: usize,
    length: f64,
    limit: AxisLimit,
    /// Direction of all axes, of unit length.
    unit: [f64; AXES],
}

/// Time of each move [s] of a sequence without a stop; `None` if an axis that moves has no limits.
pub(super) fn junction_times(
    pieces: &[Piece],
    deviation: f64,
    limits: &[Option<AxisLimit>; AXES],
) -> Option<Vec<f64>> {
    let mut blocks: Vec<Block> = Vec::new();
    for (i, Piece { path, feed }) in pieces.iter().enumerate() {
        let length = path.length();
        let bend = path.at(0.5 * length).iter().map(|jet| jet.d2 * jet.d2).sum::<f64>().sqrt();
        // A chord of length c is c^2 k / 8 from an arc of curvature k.
        let chords = (length * (bend / (8.0 * CHORD)).sqrt()).ceil().clamp(1.0, MOST_CHORDS);
        let step = length / chords;
        let mut before = path.at(0.0).map(|jet| jet.q);
        for k in 1..=chords as usize {
            let after = path.at((step * k as f64).min(length)).map(|jet| jet.q);
            let mut rates = [0.0; AXES];
            for a in 0..AXES {
                rates[a] = (after[a] - before[a]) / step;
            }
            if rates.iter().zip(limits).any(|(rate, limit)| *rate != 0.0 && limit.is_none()) {
                return None;
            }
            let size = rates.iter().map(|r| r * r).sum::<f64>().sqrt();
            if size > 0.0 {
                let unit = rates.map(|r| r / size);
                let limit = along(&rates, limits, *feed);
                blocks.push(Block { piece: i, length: step, limit, unit });
            }
            before = after;
        }
    }
    let n = blocks.len();
    // Squares of the speed at the start of each block, and at the end of the last one.
    let mut squares = vec![0.0; n + 1];
    for k in 1..n {
        let (a, b) = (&blocks[k - 1], &blocks[k]);
        let dot: f64 = a.unit.iter().zip(b.unit).map(|(x, y)| x * y).sum();
        // sin(h/2) with h the enclosed angle: cos h = -dot.
        let s = (0.5 * (1.0 + dot)).max(0.0).sqrt();
        let acceleration = a.limit.acceleration.min(b.limit.acceleration);
        let joint = if s < 1.0 { acceleration * deviation * s / (1.0 - s) } else { f64::INFINITY };
        squares[k] = joint.min(a.limit.velocity.powi(2)).min(b.limit.velocity.powi(2));
    }
    for k in (0..n).rev() {
        squares[k] = squares[k].min(squares[k + 1] + 2.0 * blocks[k].limit.acceleration * blocks[k].length);
    }
    let mut times = vec![0.0; pieces.len()];
    for (k, block) in blocks.iter().enumerate() {
        let AxisLimit { velocity: v, acceleration: a, .. } = block.limit;
        squares[k + 1] = squares[k + 1].min(squares[k] + 2.0 * a * block.length);
        let (b0, b1) = (squares[k], squares[k + 1]);
        // The square of the speed at which both ramps meet.
        let peak = (0.5 * (b0 + b1) + a * block.length).min(v * v);
        let (v0, v1, top) = (b0.sqrt(), b1.sqrt(), peak.sqrt());
        let ramps = (2.0 * peak - b0 - b1) / (2.0 * a);
        let even = (block.length - ramps).max(0.0);
        times[block.piece] += (2.0 * top - v0 - v1) / a + if even > 0.0 { even / top } else { 0.0 };
    }
    Some(times)
}
