//! The stock over time, against closed forms that share nothing with it: a point is material at a moment when it is in the raw block and no
//! tool has been there.

use glam::{DVec2, DVec3};
use kinecut_stock::base::Silent;
use kinecut_stock::geom::{Aabb, Curve, InvoluteRecord, Line, Profile};
use kinecut_stock::stock::TriDexel;
use kinecut_stock::stock::cut::{
    Clock, CutAxis, CutMove, Playback, PlayedFace, PlayedSurface, REMAINS, ToolBody,
};
use kinecut_stock::sweep::ToolMotion;

const BLOCK: Aabb = Aabb { min: DVec3::new(-30.0, -20.0, -12.0), max: DVec3::new(30.0, 20.0, 0.0) };
/// Radius of the flat cutter, and of the ball.
const A: f64 = 5.0;

/// A move of a tool: a straight one, flat cutter upright or ball along any axis.
#[derive(Clone, Copy)]
struct Way {
    from: DVec3,
    to: DVec3,
    axis: DVec3,
    ball: bool,
}

impl Way {
    fn flat(from: [f64; 3], to: [f64; 3]) -> Way {
        Way { from: from.into(), to: to.into(), axis: DVec3::Z, ball: false }
    }

    fn length(&self) -> f64 {
        self.from.distance(self.to)
    }

    /// Whether the tool has been at a point on the way from its beginning to a fraction.
    fn has_been(&self, p: DVec3, fraction: f64) -> bool {
        let end = self.from.lerp(self.to, fraction);
        if self.ball {
            // A ball and a straight shaft above it: both are near to a parallelogram.
            let steps = 80;
            return (0..=steps).any(|i| {
                let tip = self.from.lerp(end, f64::from(i) / f64::from(steps));
                let off = p - (tip + self.axis * A);
                let h = off.dot(self.axis).max(0.0);
                (off - self.axis * h).length() < A
            });
        }
        // Of a level way or a plunge.
        let (a, b, q) = (self.from.truncate(), end.truncate(), p.truncate());
        let along = b - a;
        let t = if along == DVec2::ZERO {
            0.0
        } else {
            ((q - a).dot(along) / along.length_squared()).clamp(0.0, 1.0)
        };
        q.distance(a + along * t) < A && p.z > end.z.min(self.from.z)
    }

    fn as_move(&self) -> CutMove {
        let line = Line { start: self.from, end: self.to };
        if self.ball {
            let motion = ToolMotion::fixed(line.into(), self.axis).expect("a direction");
            CutMove::leaning(motion, line, 1)
        } else {
            CutMove::new(line, CutAxis::PlusZ, 0)
        }
    }
}

/// A program: slots at several depths, one over another, a plunge, a pass that takes 0.4 mm of a wall, a leaning groove.
fn program() -> Vec<Way> {
    let lean = DVec3::new(0.0, -0.6, 0.8);
    vec![
        Way::flat([-40.0, 0.0, -2.1], [40.0, 0.0, -2.1]),
        Way::flat([40.0, 0.0, -5.3], [-40.0, 0.0, -5.3]),
        Way::flat([-20.0, -30.0, -3.7], [-20.0, 30.0, -3.7]),
        Way::flat([12.0, 11.0, 3.0], [12.0, 11.0, -9.2]),
        Way::flat([-40.0, -0.4, -5.3], [40.0, -0.4, -5.3]),
        Way { from: DVec3::new(3.0, -22.0, -3.0), to: DVec3::new(28.0, -17.0, -3.0), axis: lean, ball: true },
    ]
}

fn played(step: f64, tick: f64, most: usize) -> (PlayedSurface, Clock) {
    let ways = program();
    let mut stock = TriDexel::from_box(BLOCK, step).expect("a case of these numbers");
    let tools = [Profile::cylinder(2.0 * A, 30.0), Profile::bull_nose(2.0 * A, A, 60.0)];
    let tools = tools.map(|profile| ToolBody::new(profile.expect("a tool")));
    let mut playback = Playback::new(&stock, Clock::new(ways.iter().map(Way::length), tick));
    let moves: Vec<CutMove> = ways.iter().map(Way::as_move).collect();
    // In two calls, as the setups of a job come.
    playback.cut(&mut stock, &tools, &moves[..2], &Silent).expect("a case of these numbers");
    playback.cut(&mut stock, &tools, &moves[2..], &Silent).expect("a case of these numbers");
    let clock = playback.clock().clone();
    (playback.surface(&stock, most), clock)
}

fn material(p: DVec3, (number, fraction): (usize, f64)) -> bool {
    let inside = p.cmpgt(BLOCK.min).all() && p.cmplt(BLOCK.max).all();
    let ways = program();
    inside
        && !ways[..number].iter().any(|way| way.has_been(p, 1.0))
        && !(number < ways.len() && ways[number].has_been(p, fraction))
}

/// Whether all points about one are as it is.
fn is_deep(p: DVec3, by: f64, moment: (usize, f64)) -> bool {
    let here = material(p, moment);
    (0..27).all(|n| {
        let at = DVec3::new(f64::from(n % 3 - 1), f64::from(n / 3 % 3 - 1), f64::from(n / 9 - 1));
        material(p + at.normalize_or_zero() * by, moment) == here
    })
}

fn alive(surface: &PlayedSurface, tick: u16) -> Vec<&PlayedFace> {
    surface.faces.iter().filter(|face| face.from <= tick && tick < face.to).collect()
}

/// The tick of a moment.
fn tick(surface: &PlayedSurface, clock: &Clock, (number, fraction): (usize, f64)) -> u16 {
    (clock.done(number, fraction) * f64::from(surface.ticks) + 0.5) as u16
}

/// Number of faces above a point that look up, less those that look down: 1 inside of a closed surface, 0 outside.
fn crossings(surface: &PlayedSurface, faces: &[&PlayedFace], p: DVec3) -> i32 {
    let mut sum = 0;
    for face in faces {
        let corners = face.corners.map(|c| DVec3::from(surface.vertices[c as usize].map(f64::from)));
        for [a, b, c] in [[0, 1, 2], [0, 2, 3]].map(|t| t.map(|i: usize| corners[i])) {
            let side = |a: DVec3, b: DVec3| (b - a).truncate().perp_dot((p - a).truncate());
            let sides = [side(a, b), side(b, c), side(c, a)];
            let twice: f64 = sides.iter().sum();
            if twice == 0.0 || !(sides.iter().all(|s| *s >= 0.0) || sides.iter().all(|s| *s <= 0.0)) {
                continue;
            }
            let z = (a.z * sides[1] + b.z * sides[2] + c.z * sides[0]) / twice;
            if z > p.z {
                sum += if twice > 0.0 { 1 } else { -1 };
            }
        }
    }
    sum
}

#[test]
fn at_each_moment_it_bounds_what_no_tool_has_taken() {
    let (step, length) = (0.8, 1.2);
    let (surface, clock) = played(step, length, 1_000_000);
    let last = program().len();
    let moments =
        [(0, 0.0), (0, 0.37), (1, 0.0), (1, 0.5), (2, 0.6), (3, 1.0), (4, 0.5), (5, 0.7), (last, 0.0)];
    let mut seed = 7u64;
    let mut random = || {
        seed = seed.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (seed >> 11) as f64 / (1u64 << 53) as f64
    };
    for moment in moments {
        let faces = alive(&surface, tick(&surface, &clock, moment));
        // Near the tool material may go half a tick early or late.
        let ways = program();
        let tool = ways.get(moment.0).map(|way| (way.from.lerp(way.to, moment.1), way));
        let near_tool = |p: DVec3| {
            tool.is_some_and(|(tip, way)| {
                let off = p - tip;
                (off - way.axis * off.dot(way.axis)).length() < A + 2.0 * length + step
            })
        };
        for face in &faces {
            let corners = face.corners.map(|c| DVec3::from(surface.vertices[c as usize].map(f64::from)));
            for p in corners {
                assert!(near_tool(p) || !is_deep(p, step, moment), "{moment:?} {p} {face:?}");
            }
        }
        let (mut seen, mut solid) = (0, 0);
        for _ in 0..3000 {
            let size = BLOCK.size() + DVec3::splat(4.0);
            let p = BLOCK.min - DVec3::splat(2.0) + size * DVec3::new(random(), random(), random());
            if near_tool(p) || !is_deep(p, step, moment) {
                continue;
            }
            // A crossing near the tool may be late, too: then the line says nothing.
            let is_material = material(p, moment);
            if tool.is_some_and(|(tip, _)| (p - tip).truncate().length() < A + 2.0 * length + 14.0) {
                continue;
            }
            (seen, solid) = (seen + 1, solid + i32::from(is_material));
            assert_eq!(crossings(&surface, &faces, p), i32::from(is_material), "{moment:?} {p}");
        }
        assert!(seen > 500 && solid > 200, "{moment:?} {seen} {solid}");
    }
}

#[test]
fn a_surface_in_few_faces_has_longer_ticks_and_ends_as_the_finer_one() {
    let (fine, _) = played(0.8, 1.2, 1_000_000);
    let (coarse, _) = played(0.8, 1.2, 20_000);
    assert!(fine.faces.len() > 20_000 && coarse.faces.len() <= 20_000 && coarse.ticks < fine.ticks);
    let ends = |surface: &PlayedSurface| {
        let of = |face: &PlayedFace| face.corners.map(|c| surface.vertices[c as usize].map(f32::to_bits));
        let mut all: Vec<_> = surface.faces.iter().filter(|face| face.to == REMAINS).map(of).collect();
        all.sort_unstable();
        all
    };
    // Faces that remain at the end: those that came in the last, long state.
    let (few, many) = (ends(&coarse).len(), ends(&fine).len());
    assert!(few > 1000 && few <= many && many <= few + few / 4, "{few} {many}");
}

/// Faces along the axes are where they are, and not only within a step: floors and walls at heights that no line of the lattice has.
#[test]
fn flat_faces_are_exact_while_a_tool_is_on_its_way_and_after() {
    let (surface, clock) = played(0.8, 1.2, 1_000_000);
    let last = program().len();
    let boxed = |low: [f64; 3], high: [f64; 3]| Aabb { min: low.into(), max: high.into() };
    let places = [
        // The second slot is cut half of its way, from X+.
        ((1, 0.5), boxed([12.0, -3.5, -6.2], [28.0, 3.5, -4.4]), 2, -5.3),
        ((1, 0.5), boxed([12.0, 4.2, -4.2], [28.0, 5.8, -3.0]), 1, 5.0),
        ((1, 0.5), boxed([-28.0, -3.5, -3.0], [-12.0, 3.5, -1.2]), 2, -2.1),
        ((2, 0.0), boxed([-25.0, -5.8, -4.2], [25.0, -4.2, -1.0]), 1, -5.0),
        // 0.4 mm more at this wall: less than a step.
        ((last, 0.0), boxed([-12.0, -6.2, -4.2], [0.0, -4.6, -1.0]), 1, -5.4),
        ((last, 0.0), boxed([-18.0, 8.0, -4.6], [-17.0, 18.0, -2.8]), 2, -3.7),
    ];
    for (moment, region, axis, value) in places {
        let faces = alive(&surface, tick(&surface, &clock, moment));
        let corners = faces.iter().flat_map(|face| face.corners);
        let points = corners.map(|c| DVec3::from(surface.vertices[c as usize].map(f64::from)));
        let mut seen = 0;
        for p in points.filter(|p| p.cmpgt(region.min).all() && p.cmplt(region.max).all()) {
            assert!((p[axis] - value).abs() < 1e-3, "{moment:?} {p}: {value}");
            seen += 1;
        }
        assert!(seen > 40, "{moment:?} {value}: {seen}");
    }
}

/// A spiral of several turns is one move: its walls are where the turns before have left them, to a fraction of the step.
#[test]
fn walls_of_a_spiral_are_those_of_the_turns_that_are_done() {
    let (base, end, step, length) = (0.4, 13.0, 0.8, 1.2);
    let way = end * end / (2.0 * base);
    let record = InvoluteRecord::new(way, [0.0, 0.0], 0.0, 0.0, end).expect("a spiral");
    let curve = Curve::involute(record, -5.3, 0.0);
    let mut stock = TriDexel::from_box(BLOCK, step).expect("a case of these numbers");
    let tool = ToolBody::new(Profile::cylinder(2.0 * A, 30.0).expect("a tool"));
    let mut playback = Playback::new(&stock, Clock::new([way], length));
    let moves = [CutMove::new(curve.clone(), CutAxis::PlusZ, 0)];
    playback.cut(&mut stock, &[tool], &moves, &Silent).expect("a case of these numbers");
    let clock = playback.clock().clone();
    let surface = playback.surface(&stock, 1_000_000);
    let tip = |at: f64| curve.at(at).p.truncate();
    for fraction in [0.45, 0.62, 0.8] {
        let done: Vec<DVec2> = (0..=6000).map(|k| tip(way * fraction * f64::from(k) / 6000.0)).collect();
        let faces = alive(&surface, tick(&surface, &clock, (0, fraction)));
        let corners = faces.iter().flat_map(|face| face.corners);
        let points = corners.map(|c| DVec3::from(surface.vertices[c as usize].map(f64::from)));
        let is_wall = |p: &DVec3| -4.4 < p.z && p.z < -1.0 && p.truncate().length() < 19.0;
        let (mut seen, mut worst) = (0, 0.0f64);
        for p in points.filter(is_wall).map(|p| p.truncate()) {
            if p.distance(tip(way * fraction)) < A + 2.0 * length + step {
                continue;
            }
            let nearest = done.iter().map(|c| c.distance(p)).fold(f64::INFINITY, f64::min);
            worst = worst.max((nearest - A).abs());
            seen += 1;
        }
        assert!(seen > 200 && worst < 0.05, "{fraction}: {seen} {worst}");
    }
}
