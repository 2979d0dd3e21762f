//! Look-ahead by junction deviation, as hobby controls run: trapezoids of speed, and a speed that each joint allows.
//!
//! Curves are chords there. At a joint whose moves enclose the angle `h` the speed is at most
//! `v^2 = a d s / (1 - s)` with `s = sin(h/2)`, the acceleration `a` and the deviation `d`: that of an arc that touches both moves
//! and leaves the corner by `d`. Jerk is not limited. Source: Grbl 1.1, planner.c.

use super::super::{AxisLimit, Moment};
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
    /// Length of the parameter [mm].
    length: f64,
    limit: AxisLimit,
    /// Positions of the axes at its start [mm, rad].
    from: [f64; AXES],
    /// Their rates by the parameter, and the size of these.
    rates: [f64; AXES],
    size: f64,
    /// Moment of its start [s].
    start: f64,
    /// Rates of the parameter at its start, in its middle and at its end [mm/s].
    speeds: [f64; 3],
    /// Times of both ramps and of the way between them [s].
    phases: [f64; 3],
}

/// The run over the chords of moves that follow one another.
pub(super) struct Chords {
    blocks: Vec<Block>,
    /// Index of the segment of each move, and whether its tip stands.
    segments: Vec<(usize, bool)>,
}

/// Motion at a moment.
pub(super) struct OnChord {
    /// Index of the segment, and whether its tip stands.
    pub(super) of: (usize, bool),
    /// Motion of the parameter along the chord.
    pub(super) at: Moment,
    /// Positions of the axes, and their rates by the parameter.
    pub(super) axes: [[f64; 2]; AXES],
}

impl Chords {
    /// The run over a sequence without a stop; `None` if an axis that moves has no limits.
    pub(super) fn of(pieces: &[Piece], deviation: f64, limits: &[Option<AxisLimit>; AXES]) -> Option<Chords> {
        let mut blocks: Vec<Block> = Vec::new();
        for (i, piece) in pieces.iter().enumerate() {
            cut(i, piece, limits, &mut blocks)?;
        }
        run(&mut blocks, deviation);
        Some(Chords { blocks, segments: pieces.iter().map(|piece| (piece.segment, piece.stands)).collect() })
    }

    /// Time of each move [s].
    pub(super) fn times(&self) -> Vec<f64> {
        let mut times = vec![0.0; self.segments.len()];
        for block in &self.blocks {
            times[block.piece] += block.time();
        }
        times
    }

    /// Time of all moves [s].
    pub(super) fn duration(&self) -> f64 {
        self.blocks.last().map_or(0.0, |block| block.start + block.time())
    }

    /// The motion at a moment [s]; `None` where nothing moves.
    pub(super) fn at(&self, time: f64) -> Option<OnChord> {
        let k = self.blocks.partition_point(|block| block.start <= time).checked_sub(1)?;
        let block = &self.blocks[k];
        let at = block.at(time - block.start);
        let axes = std::array::from_fn(|a| [block.from[a] + block.rates[a] * at.way, block.rates[a]]);
        Some(OnChord { of: self.segments[block.piece], at, axes })
    }
}

impl Block {
    fn time(&self) -> f64 {
        self.phases.iter().sum()
    }

    /// Motion of the parameter from the start of the chord at a moment after it [s].
    fn at(&self, time: f64) -> Moment {
        let a = self.limit.acceleration;
        let ([first, top, last], [up, even, _]) = (self.speeds, self.phases);
        let moment = |way, velocity, acceleration| Moment { way, velocity, acceleration, jerk: 0.0 };
        if time < up {
            return moment(time * (first + 0.5 * a * time), first + a * time, a);
        }
        if time < up + even {
            return moment(0.5 * up * (first + top) + (time - up) * top, top, 0.0);
        }
        let left = (self.time() - time).max(0.0);
        moment(self.length - left * (last + 0.5 * a * left), last + a * left, -a)
    }
}

/// The chords of a move, appended to others; `None` if an axis that moves has no limits.
fn cut(
    index: usize,
    piece: &Piece,
    limits: &[Option<AxisLimit>; AXES],
    blocks: &mut Vec<Block>,
) -> Option<()> {
    let Piece { path, feed, .. } = piece;
    let length = path.length();
    let bend = path.at(0.5 * length).iter().map(|jet| jet.d2 * jet.d2).sum::<f64>().sqrt();
    // A chord of length c is c^2 k / 8 from an arc of curvature k.
    let chords = (length * (bend / (8.0 * CHORD)).sqrt()).ceil().clamp(1.0, MOST_CHORDS);
    let step = length / chords;
    let mut from = path.at(0.0).map(|jet| jet.q);
    for k in 1..=chords as usize {
        let to = path.at((step * k as f64).min(length)).map(|jet| jet.q);
        let rates: [f64; AXES] = std::array::from_fn(|a| (to[a] - from[a]) / step);
        if rates.iter().zip(limits).any(|(rate, limit)| *rate != 0.0 && limit.is_none()) {
            return None;
        }
        let size = rates.iter().map(|r| r * r).sum::<f64>().sqrt();
        if size > 0.0 {
            let limit = along(&rates, limits, *feed);
            let (speeds, phases) = ([0.0; 3], [0.0; 3]);
            blocks.push(Block {
                piece: index,
                length: step,
                limit,
                from,
                rates,
                size,
                start: 0.0,
                speeds,
                phases,
            });
        }
        from = to;
    }
    Some(())
}

/// Runs over the chords as fast as their joints and limits allow.
fn run(blocks: &mut [Block], deviation: f64) {
    let n = blocks.len();
    // Squares of the speed at the start of each block, and at the end of the last one.
    let mut squares = vec![0.0; n + 1];
    for k in 1..n {
        let (a, b) = (&blocks[k - 1], &blocks[k]);
        let dot: f64 = a.rates.iter().zip(b.rates).map(|(x, y)| (x / a.size) * (y / b.size)).sum();
        // sin(h/2) with h the enclosed angle: cos h = -dot.
        let s = (0.5 * (1.0 + dot)).max(0.0).sqrt();
        let acceleration = a.limit.acceleration.min(b.limit.acceleration);
        let joint = if s < 1.0 { acceleration * deviation * s / (1.0 - s) } else { f64::INFINITY };
        squares[k] = joint.min(a.limit.velocity.powi(2)).min(b.limit.velocity.powi(2));
    }
    for k in (0..n).rev() {
        squares[k] = squares[k].min(squares[k + 1] + 2.0 * blocks[k].limit.acceleration * blocks[k].length);
    }
    let mut clock = 0.0;
    for (k, block) in blocks.iter_mut().enumerate() {
        let AxisLimit { velocity: v, acceleration: a, .. } = block.limit;
        squares[k + 1] = squares[k + 1].min(squares[k] + 2.0 * a * block.length);
        let (b0, b1) = (squares[k], squares[k + 1]);
        // The square of the speed at which both ramps meet.
        let peak = (0.5 * (b0 + b1) + a * block.length).min(v * v);
        let (v0, v1, top) = (b0.sqrt(), b1.sqrt(), peak.sqrt());
        let even = (block.length - (2.0 * peak - b0 - b1) / (2.0 * a)).max(0.0);
        block.start = clock;
        block.speeds = [v0, top, v1];
        block.phases = [(top - v0) / a, if even > 0.0 { even / top } else { 0.0 }, (top - v1) / a];
        clock += block.time();
    }
}
