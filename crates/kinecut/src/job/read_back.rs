//! How far the posted text, as the control would read it, lies from the plan.

use serde::Serialize;

use crate::base::{Code, Finding, Result};
use crate::geom::{Curve, CurveKind};
use crate::trace::{Segment, Trace};

/// The comparison of the text with the plan.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize)]
pub struct ReadBack {
    /// Largest distance of the text's path from the exact curve of the plan [mm].
    pub largest: f64,
    /// Where [part coordinates, mm].
    pub at: [f64; 3],
    /// Index of the item of the text there.
    pub item: u32,
    /// Number of moves compared.
    pub moves: usize,
    /// Number of points compared.
    pub points: usize,
}

/// Samples for each curve of the text, beside its ends: arcs of a chain lie off at a quarter and three quarters.
const SAMPLES: usize = 16;
/// Largest step of tangent angle between samples of an involute [rad].
const SAMPLE_TURN: f64 = 0.1;

/// Compares the trace of the text with the trace of the plan. `planned_item` gives for an item of the text the item
/// of the plan that it was written for.
///
/// # Errors
/// `KC0303` when a cutting move of the plan is missing from the text or has become something else.
pub fn compare(plan: &Trace, text: &Trace, planned_item: impl Fn(u32) -> Option<u32>) -> Result<ReadBack> {
    let mut answer = ReadBack::default();
    let moves =
        |t: &Trace| -> Vec<Segment> { t.segments.iter().filter(|s| !s.alternative).cloned().collect() };
    let (planned, written) = (moves(plan), moves(text));
    let mut next = 0;
    for segment in &planned {
        let from = next;
        while next < written.len() && planned_item(written[next].item) == Some(segment.item) {
            next += 1;
        }
        let pieces = &written[from..next];
        let length: f64 = pieces.iter().map(|p| p.curve.length()).sum();
        let lost = pieces.is_empty() && segment.curve.length() > LOST_BELOW
            || pieces.iter().any(|p| p.motion != segment.motion && !close_feed(p, segment));
        if lost {
            return Err(Finding::error(
                Code::READ_BACK,
                "a move of the plan is not in the text as it was meant",
            )
            .key(format!("item[{}]", segment.item))
            .point(segment.curve.start().to_array())
            .cure("this is a defect of the post: do not run the program")
            .into());
        }
        answer.moves += pieces.len();
        let mut before = 0.0;
        for piece in pieces {
            for (s, p) in samples(&piece.curve) {
                let guess = (before + s) / length * segment.curve.length();
                let distance = distance_to(&segment.curve, p, guess);
                answer.points += 1;
                if distance > answer.largest {
                    answer = ReadBack { largest: distance, at: p.to_array(), item: piece.item, ..answer };
                }
            }
            before += piece.curve.length();
        }
        // The other way round, the text must reach the end of the plan's curve.
        if let Some(last) = pieces.last() {
            let gap = (last.curve.end() - segment.curve.end()).length();
            if gap > answer.largest {
                answer =
                    ReadBack { largest: gap, at: segment.curve.end().to_array(), item: last.item, ..answer };
            }
        }
    }
    // What a template of the user moves belongs to no item; it is simulated, not compared.
    while next < written.len() && planned_item(written[next].item).is_none() {
        next += 1;
    }
    if next < written.len() {
        return Err(Finding::error(Code::READ_BACK, "the text has a move that the plan does not have")
            .key(format!("item[{}]", written[next].item))
            .point(written[next].curve.start().to_array())
            .cure("this is a defect of the post: do not run the program")
            .into());
    }
    Ok(answer)
}

/// Moves shorter than any control's resolution may vanish when they are written [mm].
const LOST_BELOW: f64 = 2e-3;

/// Feeds are written with few decimals: equal to a thousandth.
fn close_feed(a: &Segment, b: &Segment) -> bool {
    use crate::trace::Motion::Feed;
    matches!((a.motion, b.motion), (Feed(x), Feed(y)) if (x - y).abs() <= 1e-3 * y.abs())
}

fn samples(curve: &Curve) -> Vec<(f64, glam::DVec3)> {
    let n = match curve.kind() {
        CurveKind::Involute { record, .. } => {
            SAMPLES.max((record.turn(record.length()).abs() / SAMPLE_TURN).ceil() as usize)
        }
        _ => SAMPLES,
    };
    (0..=n)
        .map(|i| {
            let s = curve.length() * i as f64 / n as f64;
            (s, curve.at(s).p)
        })
        .collect()
}

/// Distance of a point from a curve near arc length `guess`: Newton on the foot of the perpendicular.
fn distance_to(curve: &Curve, p: glam::DVec3, guess: f64) -> f64 {
    let mut s = guess.clamp(0.0, curve.length());
    let mut best = f64::INFINITY;
    for _ in 0..8 {
        let jet = curve.at(s);
        let off = p - jet.p;
        best = best.min(off.length());
        let slope = jet.d1.dot(jet.d1) - off.dot(jet.d2);
        let step = off.dot(jet.d1) / if slope.is_finite() && slope > 0.1 { slope } else { 1.0 };
        s = (s + step).clamp(0.0, curve.length());
        if step.abs() < 1e-12 * (1.0 + s) {
            break;
        }
    }
    best
}
