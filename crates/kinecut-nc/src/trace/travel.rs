//! Travel limits.

use glam::{DMat3, DVec3};

use super::chain::LETTERS;
use super::{JointWay, Segment, Trace};
use crate::base::{Code, Finding};
use crate::geom::{CurveKind, Rigid};
use crate::machine::Machine;
use crate::program::Program;

/// Positions of all axes between which a segment runs, with the points at which the linear axes have them.
struct AxisTravel {
    item: u32,
    low: [f64; 6],
    high: [f64; 6],
    at_low: DVec3,
    at_high: DVec3,
}

/// Axis positions beyond the travel of the machine: one finding for each setup and axis, with the item that goes
/// farthest in its key. In a setup that is not located on the machine only the span of the linear positions is compared
/// with the length of the travel. Where the tool turns, positions are bounded over the motion, to a micrometre; a move whose positions
/// are not known is an error, and an axis that swings round at a pole a warning.
pub fn travel_findings(trace: &Trace, program: &Program, machine: &Machine) -> Vec<Finding> {
    let mut findings = Vec::new();
    for (number, setup) in program.setups.iter().enumerate() {
        let own = || trace.segments.iter().filter(|s| s.setup.0 as usize == number);
        if let Some(lost) = own().find(|s| span(s).is_none()) {
            // Nothing may count as compared that was not.
            findings.push(
                Finding::error(
                    Code::TRAVEL_EXCEEDED,
                    "the axes cannot follow the tool between the ends of a move: a direction on the way lies outside of their travel",
                )
                .item(lost.item)
                .point(lost.curve.start().to_array())
                .help("turn the part, or divide the move"),
            );
        }
        if let Some((jumps, letter, by)) = own().find_map(|s| jump(s).map(|(letter, by)| (s, letter, by))) {
            findings.push(
                Finding::warning(
                    Code::PATH_BROKEN,
                    format!("{letter} swings round within a small part of a move: the tool passes a pole of the rotary axes"),
                )
                .value(by.to_degrees(), "degrees")
                .bound(JUMP.to_degrees(), "degrees")
                .item(jumps.item)
                .point(jumps.curve.start().to_array())
                .help("tilt the part, or retract and turn the axes there"),
            );
        }
        let spans: Vec<AxisTravel> = own().filter_map(span).collect();
        let Some(first) = spans.first() else { continue };
        for (i, letter) in LETTERS.into_iter().enumerate() {
            let Some([min, max]) = machine.travel(letter) else { continue };
            let low = spans.iter().fold(first, |a, b| if b.low[i] < a.low[i] { b } else { a });
            let high = spans.iter().fold(first, |a, b| if b.high[i] > a.high[i] { b } else { a });
            let finding = |what: &str, value: f64, bound: f64, item: u32, at: DVec3| {
                let finding = Finding::error(Code::TRAVEL_EXCEEDED, format!("{letter} {what}"));
                let finding = if i < 3 {
                    finding.value_mm(value).bound_mm(bound)
                } else {
                    finding.value(value.to_degrees(), "degrees").bound(bound.to_degrees(), "degrees")
                };
                finding
                    .item(item)
                    .point(at.to_array())
                    .help("move the part on the table, or use another machine")
            };
            if !setup.located && i < 3 {
                let span = high.high[i] - low.low[i];
                if span > max - min {
                    findings.push(finding(
                        "needs more travel than the machine has",
                        span,
                        max - min,
                        high.item,
                        high.at_high,
                    ));
                }
                continue;
            }
            // An axis may be at its limit, but for rounding.
            let slack = if i < 3 { AT_LIMIT_MM } else { AT_LIMIT };
            if low.low[i] < min - slack {
                findings.push(finding("leaves its travel", low.low[i], min, low.item, low.at_low));
            }
            if high.high[i] > max + slack {
                findings.push(finding("leaves its travel", high.high[i], max, high.item, high.at_high));
            }
        }
    }
    findings
}

/// Rounding of a linear position [mm]: a millionth of what a program can say.
const AT_LIMIT_MM: f64 = 1e-9;
/// Rounding of a rotary position [rad].
const AT_LIMIT: f64 = 1e-9;
/// Accuracy of the greatest and least positions of a move in which the tool turns [mm, rad].
const POSITION: [f64; 6] = [1e-3, 1e-3, 1e-3, 1e-6, 1e-6, 1e-6];
/// A stretch of a move that is not halved again: next to a pole there is no bound.
const LEAST_STRETCH: f64 = 1e-6;
/// Intervals of a move in which an axis may swing round.
const INTERVALS: u32 = 128;
/// Places in an interval at which it may begin.
const PLACES: u32 = 8;

/// Turn of a rotary axis within one interval of a move that no axis makes at the speed of a cut [rad]: 20 degrees in a
/// hundredth of the way.
const JUMP: f64 = 0.35;

/// A rotary axis that swings round within one interval of a move, and by how much [rad].
fn jump(segment: &Segment) -> Option<(char, f64)> {
    segment.turning.as_ref()?;
    let way = JointWay::new(segment)?;
    let most = way.rates(0.0, 1.0);
    if most[3..].iter().all(|(rate, _)| *rate <= JUMP * f64::from(INTERVALS)) {
        return None;
    }
    let count = INTERVALS * PLACES;
    let places: Vec<[f64; 6]> = (0..=count).map(|k| way.at(f64::from(k) / f64::from(count))).collect();
    places.windows(PLACES as usize + 1).find_map(|window| {
        let turned = |i: &usize| (window[PLACES as usize][*i] - window[0][*i]).abs();
        (3..6).find(|i| turned(i) > JUMP).map(|i| (LETTERS[i], turned(&i)))
    })
}

/// Greatest and least positions of a way, by bounds.
struct Extremes<'a> {
    way: &'a JointWay<'a>,
    low: [f64; 6],
    high: [f64; 6],
}

impl Extremes<'_> {
    fn of<'a>(way: &'a JointWay<'a>) -> Extremes<'a> {
        let ends = [way.at(0.0), way.at(1.0)];
        let by = |pick: fn(f64, f64) -> f64| std::array::from_fn(|i| pick(ends[0][i], ends[1][i]));
        let mut all = Extremes { way, low: by(f64::min), high: by(f64::max) };
        all.look(0.0, 1.0, ends);
        all
    }

    /// Looks at a stretch with its ends: halves it unless all axes keep within what is known.
    fn look(&mut self, from: f64, to: f64, ends: [[f64; 6]; 2]) {
        let step = to - from;
        let rates = self.way.rates(from, to);
        let beyond = |i: usize| 0.125 * step * step * rates[i].1;
        let within = |i: usize| {
            let [a, b] = [ends[0][i], ends[1][i]];
            a.max(b) + beyond(i) <= self.high[i] + POSITION[i]
                && a.min(b) - beyond(i) >= self.low[i] - POSITION[i]
        };
        if step <= LEAST_STRETCH || self.way.is_lost() || (0..6).all(within) {
            return;
        }
        let middle = 0.5 * (from + to);
        let at = self.way.at(middle);
        for i in 0..6 {
            self.low[i] = self.low[i].min(at[i]);
            self.high[i] = self.high[i].max(at[i]);
        }
        self.look(from, middle, [ends[0], at]);
        self.look(middle, to, [at, ends[1]]);
    }
}

/// Range of the axes along a segment; `None` where its machine is not known.
fn span(segment: &Segment) -> Option<AxisTravel> {
    let (matrix, shift) = segment.start_axes.to_linear;
    let (at_low, at_high) = (segment.curve.start(), segment.curve.end());
    // A line stays one under any matrix, other curves under a motion.
    let straight = matches!(segment.curve.kind(), CurveKind::Line(_));
    if segment.turning.is_none() && (straight || is_motion(matrix)) {
        let path = segment.curve.moved(&Rigid { rotation: matrix, translation: shift });
        let bounds = path.bounds();
        let [a, b, c] = segment.rotary();
        let all = |p: DVec3| [p.x, p.y, p.z, a, b, c];
        let back = matrix.inverse();
        let (at_low, at_high) = (back * (bounds.min - shift), back * (bounds.max - shift));
        return Some(AxisTravel {
            item: segment.item,
            low: all(bounds.min),
            high: all(bounds.max),
            at_low,
            at_high,
        });
    }
    let way = JointWay::new(segment)?;
    let Extremes { low, high, .. } = Extremes::of(&way);
    (!way.is_lost()).then_some(AxisTravel { item: segment.item, low, high, at_low, at_high })
}

/// True if a matrix keeps lengths, angles and hands: linear axes square to one another, none with a sense of its own.
fn is_motion(matrix: DMat3) -> bool {
    /// Rounding of products of a few rotations.
    const SQUARE: f64 = 1e-9;
    let skew = matrix.transpose() * matrix - DMat3::IDENTITY;
    matrix.determinant() > 0.0 && skew.to_cols_array().iter().all(|e| e.abs() < SQUARE)
}
