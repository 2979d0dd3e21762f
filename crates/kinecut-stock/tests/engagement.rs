//! Engagement of moves: against closed forms, and against a search by brute force that shares nothing with it: points around the cutter
//! that lie in the block and in nothing that was cut before.

use std::f64::consts::{FRAC_PI_2, PI, TAU};

use glam::{DVec2, DVec3};
use kinecut_stock::base::Silent;
use kinecut_stock::geom::{Aabb, Arc, Line, Profile};
use kinecut_stock::stock::TriDexel;
use kinecut_stock::stock::cut::{
    CutAxis, CutMove, EngagedStretch, MoveEngagement, ToolBody, adjust_volumes, engagements,
};
use kinecut_stock::sweep::ToolMotion;

const BLOCK: Aabb = Aabb { min: DVec3::new(-30.0, -30.0, -10.0), max: DVec3::new(30.0, 30.0, 0.0) };
/// Radius of the cutter.
const A: f64 = 5.0;

fn cutter() -> ToolBody {
    ToolBody::new(Profile::cylinder(2.0 * A, 25.0).expect("a cylinder"))
}

fn line(from: DVec2, to: DVec2, z: f64) -> CutMove {
    CutMove::new(Line { start: from.extend(z), end: to.extend(z) }, CutAxis::PlusZ, 0)
}

fn measured(step: f64, moves: &[CutMove]) -> (Vec<MoveEngagement>, f64) {
    let mut stock = TriDexel::from_box(BLOCK, step).expect("a case of these numbers");
    let before = stock.volume();
    let found = engagements(&mut stock, &[cutter()], moves, &Silent).expect("a case of these numbers");
    (found, before - stock.volume())
}

/// The stretch in the middle of a move.
fn middle(found: &MoveEngagement) -> EngagedStretch {
    found.stretches[found.stretches.len() / 2]
}

#[test]
fn along_a_wall_it_is_that_of_the_closed_form_however_thin_the_pass() {
    for turn in [0.0, 0.3, PI / 4.0, 1.2] {
        let along = DVec2::from_angle(turn);
        let beside = along.perp();
        // A slot opens the wall; then it is moved back by h.
        for (h, step) in [(0.05, 0.5), (0.3, 0.5), (1.0, 0.5), (5.0, 0.5), (8.0, 0.5), (2.0, 0.2)] {
            let way = |off: f64| line(beside * off - along * 12.0, beside * off + along * 12.0, -4.0);
            let (found, _) = measured(step, &[way(0.0), way(h)]);
            let wall = middle(&found[1]);
            let arc = (1.0 - h / A).acos();
            let name = format!("h {h} at {turn}");
            assert!(
                (wall.arc - arc).to_degrees().abs() < 3.0,
                "{name}: {} {}",
                wall.arc.to_degrees(),
                arc.to_degrees()
            );
            assert!((wall.width - h).abs() < 0.05 * h + 0.01, "{name}: {}", wall.width);
            // Narrower than a step it may be that between lines across.
            let least = if h < step { 4.0 - step } else { 4.0 };
            assert!(wall.depth > least - 1e-3 && wall.depth < 4.0 + 1e-3, "{name}: {}", wall.depth);
            // The chip is thickest where the arc ends, at most where the cutter looks forward; the way is 24 mm.
            let chip = if arc < FRAC_PI_2 { arc.sin() } else { 1.0 };
            assert!((wall.advance / 24.0 - chip).abs() < 0.03, "{name}: {} {chip}", wall.advance / 24.0);
            let is_inner = |s: &EngagedStretch| s.from + s.to > 0.6 && s.from + s.to < 1.4;
            let inner: Vec<EngagedStretch> = found[1].stretches.iter().copied().filter(is_inner).collect();
            let volume: f64 = inner.iter().map(|s| s.removed).sum();
            let part = inner[inner.len() - 1].to - inner[0].from;
            // One line across more or less at either end.
            assert!((volume / (part * 24.0 * h * 4.0) - 1.0).abs() < 0.12, "{name}: {volume}");
        }
    }
}

#[test]
fn a_slot_is_half_a_turn_a_plunge_a_whole_one_and_air_nothing() {
    let (found, _) = measured(
        0.4,
        &[
            line(DVec2::new(-20.0, 0.0), DVec2::new(20.0, 0.0), -3.0),
            line(DVec2::new(20.0, 0.0), DVec2::new(-20.0, 0.0), -3.0),
            CutMove::new(
                Line { start: DVec3::new(0.0, 20.0, 5.0), end: DVec3::new(0.0, 20.0, -5.0) },
                CutAxis::PlusZ,
                0,
            ),
        ],
    );
    let slot = middle(&found[0]);
    assert!((slot.arc.to_degrees() - 180.0).abs() < 2.0 && (slot.width - 2.0 * A).abs() < 1e-2, "{slot:?}");
    assert!(found[1].stretches.is_empty() && found[1].share() == 0.0 && found[1].removed() == 0.0);
    let plunge = &found[2];
    // Half of the way is above the block.
    assert!((plunge.share() - 0.5).abs() < 0.1, "{}", plunge.share());
    assert!((plunge.removed() / (PI * A * A * 5.0) - 1.0).abs() < 0.01, "{}", plunge.removed());
    for stretch in &plunge.stretches {
        assert!((stretch.arc - TAU).to_degrees().abs() < 8.0, "{stretch:?}");
        assert!((stretch.advance - 10.0).abs() < 1e-6, "{stretch:?}");
    }
}

/// Angles in contact by brute force, one for each degree: the cutter at some places of a stretch, points around it.
fn contact(before: &[[DVec2; 2]], from: DVec2, to: DVec2) -> [bool; 360] {
    let distance = |p: DVec2, [a, b]: [DVec2; 2]| {
        let t = ((p - a).dot(b - a) / (b - a).length_squared().max(1e-30)).clamp(0.0, 1.0);
        p.distance(a.lerp(b, t))
    };
    let feed = (to - from).normalize_or_zero();
    let mut met = [false; 360];
    for k in 0..=24 {
        let centre = from.lerp(to, f64::from(k) / 24.0);
        for (degree, met) in met.iter_mut().enumerate() {
            for part in 0..4 {
                let angle = degree as f64 + 0.125 + 0.25 * f64::from(part);
                let out = DVec2::from_angle(angle.to_radians()).rotate(feed);
                // Just outside: what the cutter is about to take.
                let p = centre + out * (A + 1e-6);
                let inside = p.x.abs() < 30.0 && p.y.abs() < 30.0;
                *met |= inside && out.dot(feed) > 0.0 && before.iter().all(|way| distance(p, *way) > A);
            }
        }
    }
    met
}

#[test]
fn on_random_ways_it_is_that_of_brute_force() {
    let mut state = 7u64;
    let mut random = move || {
        state = state.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
        (state >> 33) as f64 / f64::from(u32::MAX >> 1)
    };
    let step = 0.25;
    let (mut compared, mut off, mut worst) = (0, 0.0, 0.0f64);
    for _ in 0..6 {
        let mut point = || DVec2::new(60.0 * random() - 30.0, 60.0 * random() - 30.0);
        let corners: Vec<DVec2> = (0..14).map(|_| point()).collect();
        let moves: Vec<CutMove> = corners.windows(2).map(|w| line(w[0], w[1], -2.0)).collect();
        let (found, gone) = measured(step, &moves);
        let sum: f64 = found.iter().map(MoveEngagement::removed).sum();
        assert!((sum / gone - 1.0).abs() < 5e-3, "{sum} of {gone}");
        let mut adjusted = found.clone();
        adjust_volumes(&mut adjusted, gone);
        let sum: f64 = adjusted.iter().map(MoveEngagement::removed).sum();
        assert!((sum / gone - 1.0).abs() < 1e-9, "{sum} of {gone}");
        for (i, (way, found)) in corners.windows(2).zip(&found).enumerate().skip(1) {
            let mut cut: Vec<[DVec2; 2]> = corners.windows(2).take(i).map(|w| [w[0], w[1]]).collect();
            let count = ((way[1] - way[0]).length() / (1.5 * step)).ceil();
            for k in (0..count as u32).step_by(7) {
                let [from, to] = [k, k + 1].map(|k| way[0].lerp(way[1], f64::from(k) / count));
                // What was cut on this way before the stretch.
                cut.push([way[0], from]);
                let expected = contact(&cut, from, to).iter().filter(|met| **met).count() as f64;
                cut.pop();
                let at = (f64::from(k) + 0.5) / count;
                let own = found.stretches.iter().find(|s| s.from < at && at < s.to);
                let difference = own.map_or(0.0, |s| s.arc.to_degrees()) - expected;
                (compared, off) = (compared + 1, off + difference.abs());
                worst = worst.max(difference.abs());
            }
        }
    }
    let mean = off / f64::from(compared);
    // Where contact ends on a side of the cutter, a way of one step is an arc of acos(1 - step / A).
    let most = (1.0 - step / A).acos().to_degrees() + 1.0;
    assert!(compared > 600 && mean < 1.5 && worst < most, "{compared}: mean {mean}, worst {worst}");
}

#[test]
fn a_circle_that_grows_is_engaged_as_its_closed_form_says() {
    let circle = |radius: f64| {
        let start = DVec3::new(radius, 0.0, -3.0);
        let arc = Arc::new(start, DVec3::new(0.0, 0.0, -3.0), DVec3::Z, TAU, 0.0).expect("a circle");
        CutMove::new(arc, CutAxis::PlusZ, 0)
    };
    let h = 1.0;
    for first in [6.0, 10.0, 20.0] {
        let radius = first + h;
        let (found, _) = measured(0.3, &[circle(first), circle(radius)]);
        let grown = middle(&found[1]);
        let arc = (((radius + A - h).powi(2) - radius * radius - A * A) / (2.0 * radius * A)).acos();
        assert!((grown.arc - arc).to_degrees().abs() < 3.0, "{first}: {} {arc}", grown.arc);
        assert!((grown.depth - 3.0).abs() < 1e-3, "{first}: {grown:?}");
        let volume = 3.0 * PI * ((radius + A).powi(2) - (first + A).powi(2));
        assert!((found[1].removed() / volume - 1.0).abs() < 0.02, "{first}: {}", found[1].removed());
    }
}

#[test]
fn tools_that_turn_take_what_is_gone_and_nothing_twice() {
    // A ball that is driven over the block while it tilts by 60 degrees, there and back.
    let ball = ToolBody::new(Profile::bull_nose(10.0, 5.0, 25.0).unwrap());
    let way = |from: f64, to: f64| Line {
        start: DVec3::new(from, from * 0.2, -3.0),
        end: DVec3::new(to, to * 0.2, -3.0),
    };
    let tilted = |angle: f64| DVec3::new(0.0, angle.sin(), angle.cos());
    let one = |from: f64, to: f64, tilts: [f64; 2]| {
        let line = way(from, to);
        let motion = ToolMotion::between(line.into(), tilted(tilts[0]), tilted(tilts[1])).unwrap();
        CutMove::leaning(motion, line, 0)
    };
    let moves = [one(-20.0, 20.0, [-0.5, 0.5]), one(20.0, -20.0, [0.5, -0.5]), one(-20.0, 20.0, [0.5, -0.5])];
    let mut stock = TriDexel::from_box(BLOCK, 0.3).unwrap();
    let before = stock.volume();
    let found = engagements(&mut stock, &[ball], &moves, &Silent).unwrap();
    let gone = before - stock.volume();
    let sum: f64 = found.iter().map(MoveEngagement::removed).sum();
    assert!((sum / gone - 1.0).abs() < 0.03, "{sum} {gone}");
    // The way back is the same: what is taken there is rounding.
    assert!(found[1].removed() < 1e-3 * sum, "{}", found[1].removed());
    for stretch in found.iter().flat_map(|moved| &moved.stretches) {
        assert!(stretch.depth <= 25.0 + 1e-3 && stretch.width <= 10.0 + 1e-3, "{stretch:?}");
    }
    // Where it stands upright it is a slot by a ball.
    let upright = middle(&found[0]);
    assert!((upright.arc.to_degrees() - 180.0).abs() < 8.0, "{upright:?}");
}

#[test]
fn a_tool_that_leans_is_measured_as_one_that_stands() {
    // The same slot in a block, the tool at 25 degrees in the plane across its way: a narrower floor, the same volume by sections.
    let lean = 25f64.to_radians();
    let axis = DVec3::new(0.0, lean.sin(), lean.cos());
    let way = Line { start: DVec3::new(-40.0, 0.0, -3.0), end: DVec3::new(40.0, 0.0, -3.0) };
    let motion = ToolMotion::fixed(way.into(), axis).unwrap();
    let mut stock = TriDexel::from_box(BLOCK, 0.3).unwrap();
    let before = stock.volume();
    let found = engagements(&mut stock, &[cutter()], &[CutMove::leaning(motion, way, 0)], &Silent).unwrap();
    let gone = before - stock.volume();
    assert!((found[0].removed() / gone - 1.0).abs() < 0.03, "{} {gone}", found[0].removed());
    // The section: a rectangle 2 A wide that leans, cut off at Z 0, its middle 3 mm below.
    let area = 2.0 * A * 3.0 / lean.cos();
    assert!((gone / (60.0 * area) - 1.0).abs() < 0.005, "{} {}", gone / 60.0, area);
    let slot = middle(&found[0]);
    assert!((slot.width - 2.0 * A).abs() < 1e-2, "{slot:?}");
    // From the floor of the cutter to the top of the block at its far side.
    let depth = 3.0 / lean.cos() + A * lean.tan();
    assert!((slot.depth - depth).abs() < 0.1, "{slot:?} {depth}");
    assert!((slot.advance - 80.0).abs() < 0.5, "{slot:?}");
}

#[test]
fn it_does_not_depend_on_the_number_of_threads() {
    let corners: Vec<DVec2> =
        (0..40).map(|k| DVec2::from_angle(f64::from(k)) * (3.0 + 0.5 * f64::from(k))).collect();
    let moves: Vec<CutMove> = corners.windows(2).map(|w| line(w[0], w[1], -2.0)).collect();
    let by = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| measured(0.5, &moves).0)
    };
    assert_eq!(by(1), by(3));
}
