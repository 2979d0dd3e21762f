//! Claims of the paper about its path, and the measurement of each on the user's own hole.
//!
//! Source: Sorokin, But, Kombarov 2013. The paper's spiral starts in the centre; so it does here, whatever the entry of
//! the hole. Each number is measured or in closed form as said.

use std::f64::consts::{FRAC_1_SQRT_2, TAU};

use serde::Serialize;

use super::chain::Chain;
use super::joints::joints;
use super::lead::LeadGrowth;
use super::load::{Load, load};
use super::{ComparedStrategy, Figures, Run, Terms};
use crate::base::Result;
use crate::holes::clearing::{Clearing, Disc};
use crate::holes::engagement::engagement;
use crate::holes::entry::USUAL_RAMP;
use crate::holes::lead_in::{lead_in, turns_as_printed};

/// Whether a claim holds.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Holds {
    /// It holds.
    Yes,
    /// It holds with a restriction that is said.
    Partly,
    /// It does not hold.
    No,
}

/// A claim and what was found.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Claim {
    /// The claim.
    pub claim: &'static str,
    /// Whether it holds.
    pub holds: Holds,
    /// The measurement, in numbers.
    pub found: String,
    /// The numbers, in the order of the words.
    pub numbers: Vec<f64>,
}

impl Claim {
    fn new(claim: &'static str, holds: Holds, found: String, numbers: &[f64]) -> Claim {
        Claim { claim, holds, found, numbers: numbers.to_vec() }
    }
}

/// A number with four digits, in words of a person.
fn digits(v: f64) -> String {
    if v == 0.0 || !v.is_finite() {
        return if v == 0.0 { "0".to_owned() } else { "unbounded".to_owned() };
    }
    /// Digits shown.
    const DIGITS: i32 = 4;
    let magnitude = v.abs().log10().floor() as i32;
    let decimals = (DIGITS - 1 - magnitude).clamp(0, 12) as usize;
    let text = format!("{v:.decimals$}");
    if text.contains('.') { text.trim_end_matches('0').trim_end_matches('.').to_owned() } else { text }
}

fn degrees(v: f64) -> String {
    format!("{:.1}\u{b0}", v.to_degrees())
}

/// The paper's spiral on the hole, from the centre.
struct Paper {
    chain: Chain,
    load: Load,
    /// Turns.
    n: u32,
    /// Step [mm].
    step: f64,
    /// Base radius [mm].
    base: f64,
    /// Radius of the cutter [mm].
    cutter: f64,
}

impl Paper {
    fn new(terms: &Terms) -> Result<Paper> {
        let centre = Terms { entry: 0.0, drilled: None, ..*terms };
        let path = Clearing::Involute.path(&Disc { inner: 0.0, inner_most: 0.0, ..centre.disc() })?;
        let chain = Chain::new(path.curves.iter().copied().chain([path.closing.into()]).collect());
        let load = load(&chain, &centre)?;
        // A whole number by construction.
        let n = path.turns.round() as u32;
        Ok(Paper { chain, load, n, step: path.step, base: path.step / TAU, cutter: terms.cutter })
    }

    /// Engagement at the end of a turn [rad]: the last place of the spiral cut off there.
    fn at_turn(&self, turn: f64) -> Result<f64> {
        let length = 0.5 * self.base * (TAU * turn).powi(2);
        let mut before = 0.0;
        let mut path = Vec::new();
        for curve in &self.chain.curves {
            let rest = length - before;
            // The last turn ends with its curve, to rounding.
            if rest <= curve.length() * (1.0 + 1e-9) {
                path.push(if rest < curve.length() { curve.part(0.0, rest) } else { *curve });
                break;
            }
            path.push(*curve);
            before += curve.length();
        }
        Ok(engagement(&path, self.cutter, None, 2)?.last().map_or(f64::NAN, |e| e.angle))
    }
}

fn of<'a>(rows: &'a [ComparedStrategy], name: &str) -> Option<&'a Figures> {
    rows.iter().find(|r| r.strategy == name)?.figures.as_ref()
}

pub(super) fn claims(
    terms: &Terms,
    rows: &[ComparedStrategy],
    lead_ins: &[LeadGrowth],
) -> Result<Vec<Claim>> {
    let paper = Paper::new(terms)?;
    let mut claims = vec![
        smooth(terms, &paper),
        shock(terms, rows),
        archimedes(terms, &paper),
        helix(terms),
        allowance(&paper),
        even_load(&paper)?,
        first_turn(&paper)?,
        last_turn(terms, &paper),
        centre(terms, &paper),
        visible_turns(terms)?,
    ];
    claims.extend(time(rows));
    claims.extend(positioning(terms, rows));
    claims.extend(contact_for_nothing(rows, lead_ins));
    Ok(claims)
}

fn smooth(terms: &Terms, paper: &Paper) -> Claim {
    let feed = terms.limits.feed;
    let closing = joints(&paper.chain, feed).last().copied();
    let step = closing.and_then(|j| j.steps.jerk).unwrap_or(f64::NAN);
    let ground = feed.powi(3) / terms.wall.powi(2);
    let found = format!(
        "The contact is {}: the curvature agrees, its slope jumps by {} 1/mm\u{b2}. At the feed the jerk steps by {} \
         mm/s\u{b3} on {} mm/s\u{b3} of the circle itself, 1/(2\u{3c0}n) of it ({:.2} %).",
        closing.map_or("unknown", |j| j.contact),
        digits(paper.base / terms.wall.powi(3)),
        digits(step),
        digits(ground),
        100.0 * step / ground,
    );
    Claim::new(
        "The involute joins the circle with all derivatives (C\u{221e})",
        Holds::No,
        found,
        &[step, ground],
    )
}

fn shock(terms: &Terms, rows: &[ComparedStrategy]) -> Claim {
    let step = |name: &str| of(rows, name).and_then(|f| f.closing.steps.acceleration).unwrap_or(f64::NAN);
    let (two, four, paper) = (step("arcs-2"), step("arcs-4"), step("involute"));
    let ground = terms.limits.feed.powi(2) / terms.wall;
    let found = format!(
        "At the wall the acceleration steps by {} mm/s\u{b2} (two poles), {} (four poles) and {} (involute), on {} of the \
         circle; with arcs it steps at every joint inside too, with rings the machine stops at every corner.",
        digits(two),
        digits(four),
        digits(paper),
        digits(ground)
    );
    let holds = if paper == 0.0 { Holds::Yes } else { Holds::No };
    Claim::new(
        "The involute has no step of acceleration, where arcs have one",
        holds,
        found,
        &[two, four, paper],
    )
}

fn archimedes(terms: &Terms, paper: &Paper) -> Claim {
    let kink = (1.0 / (TAU * f64::from(paper.n))).atan();
    let step = 2.0 * terms.limits.feed * (0.5 * kink).sin();
    let first = paper.step * (1.0 / TAU).atan().cos();
    let found = format!(
        "Its direction breaks by {:.4}\u{b0} = atan(1/(2\u{3c0}n)) at the wall, a step of velocity of {} mm/s. But its normal \
         step is {} mm after one turn against {} mm: that is no argument against it.",
        kink.to_degrees(),
        digits(step),
        digits(first),
        digits(paper.step)
    );
    let claim = "The Archimedean spiral does not join the circle even to first order";
    Claim::new(claim, Holds::Yes, found, &[kink.to_degrees(), step, first])
}

fn helix(terms: &Terms) -> Claim {
    let step = 2.0 * terms.limits.feed * (0.5 * USUAL_RAMP).sin();
    let pitch = TAU * terms.wall * USUAL_RAMP.tan();
    let found = format!(
        "At its foot it breaks by its slope, atan(P/(2\u{3c0}R)): {:.2}\u{b0} for a pitch of {} mm on the radius of {} mm, a step of \
         velocity of {} mm/s into the flat circle, and again at its start. A foot that levels out gradually has none.",
        USUAL_RAMP.to_degrees(),
        digits(pitch),
        digits(terms.wall),
        digits(step)
    );
    Claim::new("A helical path is free of breaks", Holds::No, found, &[USUAL_RAMP.to_degrees(), pitch, step])
}

fn allowance(paper: &Paper) -> Claim {
    let found = format!(
        "The distance of neighbouring turns along the normal is {} mm everywhere from the second turn on. It is the radial \
         depth that is even, not the load; in the first turn there is no neighbour, and on the closing circle the depth \
         falls from {} mm to nothing.",
        digits(paper.step),
        digits(paper.step)
    );
    Claim::new("The allowance is uniform", Holds::Partly, found, &[paper.step])
}

fn even_load(paper: &Paper) -> Result<Claim> {
    let n = f64::from(paper.n);
    let (first, last) = (paper.at_turn(1.0)?, paper.at_turn(n)?);
    let second = if paper.n > 1 { paper.at_turn(2.0)? } else { first };
    let found = format!(
        "At the end of turn 1 the cutter is engaged by {}, of turn 2 by {}, of turn {} by {}: the load falls to {:.0} % of \
         that of turn 1 on the way out. Only a path of constant engagement has an even load.",
        degrees(first),
        degrees(second),
        paper.n,
        degrees(last),
        100.0 * last / first
    );
    let numbers = [first.to_degrees(), second.to_degrees(), last.to_degrees()];
    // One turn has no way on which to fall.
    let holds = if paper.n > 1 { Holds::No } else { Holds::Partly };
    Ok(Claim::new("Uniform allowance means uniform load", holds, found, &numbers))
}

fn first_turn(paper: &Paper) -> Result<Claim> {
    let (quarter, half, whole) = (paper.at_turn(0.25)?, paper.at_turn(0.5)?, paper.at_turn(1.0)?);
    let found = format!(
        "After a plunge into the centre the engagement is {} after a quarter turn, {} after a half, {} after the first \
         turn: near a slot, and nothing in the method limits it.",
        degrees(quarter),
        degrees(half),
        degrees(whole)
    );
    let numbers = [quarter, half, whole].map(f64::to_degrees);
    Ok(Claim::new(
        "The method covers the whole of the hole, its first turn included",
        Holds::No,
        found,
        &numbers,
    ))
}

fn last_turn(terms: &Terms, paper: &Paper) -> Claim {
    let spiral = paper.chain.length() - TAU * terms.wall;
    let at = |share: f64| paper.load.at(spiral + share * TAU * terms.wall);
    let shares = [0.0, 0.25, 0.5, 0.75, 0.95].map(|s| at(s).to_degrees());
    let found = format!(
        "On the circle at the wall the engagement falls from {:.1}\u{b0} over {:.1}\u{b0} (a quarter), {:.1}\u{b0} (a half) and \
         {:.1}\u{b0} (three quarters) to nothing: it always tapers.",
        shares[0], shares[1], shares[2], shares[3]
    );
    Claim::new("The closing circle is cut with an even load", Holds::No, found, &shares)
}

fn centre(terms: &Terms, paper: &Paper) -> Claim {
    let l = &terms.limits;
    let at_one = l.feed.powi(2) / paper.base;
    let cap = super::peaks::capped_radius(l);
    let found = format!(
        "In the centre the curvature is infinite. At the full feed the acceleration is {} mm/s\u{b2} at one radian of roll \
         (limit {} mm/s\u{b2}) and grows without bound towards the centre; within {} mm of it the feed has to be lowered. \
         Starting on a circle avoids it.",
        digits(at_one),
        digits(l.acceleration),
        digits(cap)
    );
    Claim::new("The path can be run at constant feed from the centre", Holds::No, found, &[at_one, cap])
}

fn visible_turns(terms: &Terms) -> Result<Claim> {
    let wall = terms.wall + terms.allowance;
    let n = terms.lead_turns.clamp(1, u32::MAX);
    /// The paper's own start lies at this share of the wall's radius; the second one near the rim.
    const NEAR_RIM: f64 = 0.998;
    let mut numbers = Vec::new();
    for share in [FRAC_1_SQRT_2, NEAR_RIM] {
        let distance = share * wall;
        let exact = lead_in(wall, n, [distance, 0.0], 0.0)?.turns;
        numbers.extend([distance, exact, turns_as_printed(wall, n, distance)]);
    }
    let found = format!(
        "For a lead-in of {n} turns from {} mm the exact number is {:.4}, the formula n(1 \u{2212} \u{3c1}/R) gives {:.4}; from {} mm, \
         near the wall, {:.4} against {:.4}.",
        digits(numbers[0]),
        numbers[1],
        numbers[2],
        digits(numbers[3]),
        numbers[4],
        numbers[5]
    );
    Ok(Claim::new("The formula for the turns that are run, n_B", Holds::Partly, found, &numbers))
}

fn time(rows: &[ComparedStrategy]) -> Option<Claim> {
    let paper = of(rows, "involute")?;
    let others = [
        "lens-1",
        "archimedean",
        "arcs-2",
        "arcs-4",
        "rings",
        "rings-tangent",
        "constant-engagement",
        super::FREE,
    ];
    let timed = |i: usize| {
        others
            .iter()
            .filter_map(|&name| Some((name, of(rows, name)?.runs.get(i)?.time)))
            .min_by(|a, b| a.1.total_cmp(&b.1))
    };
    let mut parts = Vec::new();
    let mut numbers = Vec::new();
    let mut fastest = true;
    for (i, run) in paper.runs.iter().enumerate() {
        let (name, best) = timed(i)?;
        fastest &= run.time <= best;
        parts.push(format!(
            "at {} m/min {} s, the fastest other ({name}) {} s",
            digits(run.feed * 0.06),
            digits(run.time),
            digits(best)
        ));
        numbers.extend([run.time, best]);
    }
    let mut found = format!("{}.", parts.join("; "));
    found.replace_range(..1, "A");
    found.push_str(" What it wins is shock, not time; the time is won by fewer turns at an even load.");
    let holds = if fastest { Holds::Yes } else { Holds::No };
    Some(Claim::new("The involute path is the fastest", holds, found, &numbers))
}

fn positioning(terms: &Terms, rows: &[ComparedStrategy]) -> Option<Claim> {
    /// Share by which an error must be smaller, to be smaller.
    const LESS: f64 = 0.95;
    let names = ["involute", "arcs-2", "arcs-4"];
    let [paper, two, four] = names.map(|name| of(rows, name).map(|f| &f.runs));
    let (mut parts, mut numbers, mut smaller) = (Vec::new(), Vec::new(), Vec::new());
    for ((paper, two), four) in paper?.iter().zip(two?).zip(four?) {
        let [own, a, b] = [paper, two, four].map(|run| 1e3 * run.servo.at_wall);
        let off = [paper, two, four].map(|run| Some(1e3 * run.farthest?));
        parts.push(format!(
            "at {} m/min {own:.3} \u{3bc}m, with arcs {a:.3} (two poles) and {b:.3} (four)",
            digits(paper.feed * 0.06)
        ));
        let nearer = match off {
            [Some(own), Some(a), Some(b)] => own <= a.min(b),
            // A control with a planner of its own does not tell.
            _ => true,
        };
        smaller.push(own < LESS * a.min(b) && nearer);
        numbers.extend([own, a, b]);
        numbers.extend(off.into_iter().flatten());
    }
    let all = |runs: &[Run]| -> Option<f64> {
        runs.iter().try_fold(0.0, |most, run| Some(f64::max(most, 1e3 * run.farthest?)))
    };
    let mut found = format!(
        "Position loops of {} Hz (a model) leave the circle at the wall by this much: {}.",
        digits(terms.servo.bandwidth),
        parts.join("; "),
    );
    match (all(paper?), all(two?), all(four?)) {
        (Some(own), Some(a), Some(b)) => found.push_str(&format!(
            " Besides, the control itself leaves the path where it smooths joints, by up to {own:.2} \u{3bc}m on the involute, \
             {a:.2} and {b:.2} \u{3bc}m on the arcs."
        )),
        _ => found.push_str(
            " Besides, the control itself leaves the path at joints; by how much its planner does not tell.",
        ),
    }
    let holds = match smaller.iter().filter(|is| **is).count() {
        0 => Holds::No,
        n if n == smaller.len() => Holds::Yes,
        _ => Holds::Partly,
    };
    Some(Claim::new("Smooth motion lowers the positioning error of the axes", holds, found, &numbers))
}

fn contact_for_nothing(rows: &[ComparedStrategy], lead_ins: &[LeadGrowth]) -> Option<Claim> {
    let (paper, lens) = (of(rows, "involute")?, of(rows, "lens-1")?);
    let mut found = format!(
        "The lens involute of the same step is {} mm long against {} mm and meets the wall with {} instead of {}.",
        digits(lens.path_length),
        digits(paper.path_length),
        lens.closing.contact,
        paper.closing.contact
    );
    let mut numbers = vec![lens.path_length, paper.path_length];
    if let [zero, one, ..] = lead_ins {
        found.push_str(&format!(
            " It has a price in finishing: its lead-in touches the allowance {} rad before the wall instead of {} rad, so more \
             of its way is thin chips.",
            digits(one.touch),
            digits(zero.touch)
        ));
        numbers.extend([one.touch, zero.touch]);
    }
    let same = (lens.path_length - paper.path_length).abs() < 1e-6 * paper.path_length;
    let better = lens.closing.order > paper.closing.order;
    let holds = if same && better { Holds::No } else { Holds::Partly };
    Some(Claim::new("No smoother path of this length is known", holds, found, &numbers))
}
