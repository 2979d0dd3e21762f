//! Axis positions along segments with their derivatives, against positions alone and differences of them.

use glam::{DQuat, DVec3};
use kinecut::machine::Machine;
use kinecut::num::random::Random;
use kinecut::program::{Move, Origin, Path, Program, RotarySolution, Speed, State, Target, Tcp, ToolAxis};
use kinecut::trace::{AxisPath, Segment};

use super::rotary::{followed, followed_or, machine, program, tilted, to};

/// A number between -1 and 1.
fn about_zero(random: &mut Random) -> f64 {
    2.0 * random.share() - 1.0
}

fn vector(random: &mut Random) -> DVec3 {
    DVec3::new(about_zero(random), about_zero(random), about_zero(random))
}

fn unit(random: &mut Random) -> DVec3 {
    vector(random).try_normalize().unwrap()
}

/// Positions of the rotary axes of a machine within `most` of zero.
fn angles(machine: &Machine, most: f64, random: &mut Random) -> ToolAxis {
    let mut angles = [None; 3];
    for joint in machine.joints.iter().filter(|joint| joint.motion.is_rotation()) {
        angles["ABC".find(joint.letter).unwrap()] = Some(most * about_zero(random));
    }
    ToolAxis::Rotary(angles)
}

/// A program as it is written, with the end of its last move.
struct Written {
    program: Program,
    state: State,
    at: DVec3,
}

impl Written {
    fn new() -> Written {
        let (mut program, mut state) = program(true);
        let at = DVec3::new(0.0, 0.0, 50.0);
        to(&mut program, &state, at.to_array(), ToolAxis::Fixed);
        state.speed = Speed::PerMinute(20.0);
        Written { program, state, at }
    }

    fn line(&mut self, end: DVec3, axis: ToolAxis) {
        self.at = end;
        to(&mut self.program, &self.state, end.to_array(), axis);
    }

    /// An arc about any axis, which climbs by `rise`.
    fn arc(&mut self, rise: f64, axis: ToolAxis, random: &mut Random) {
        let about = unit(random);
        let radial = about.any_orthonormal_vector() * (5.0 + 20.0 * random.share());
        let (sweep, centre) = (1.0 + 2.0 * random.share(), self.at - radial);
        self.at = centre + DQuat::from_axis_angle(about, sweep) * radial + about * rise;
        let end = Target::Tip { point: self.at, axis };
        let path = Path::Arc { centre, axis: about, sweep, rise };
        self.program.push_move(Move { end, path }, &self.state, Origin::default());
    }

    /// A line, an arc, a helix, and a move on the spot if the tool turns.
    fn moves(&mut self, random: &mut Random, mut axis: impl FnMut(&mut Random) -> ToolAxis) {
        let (end, turned) = (40.0 * vector(random), axis(random));
        self.line(end, turned);
        let turned = axis(random);
        self.arc(0.0, turned, random);
        let turned = axis(random);
        self.arc(7.0, turned, random);
        let turned = axis(random);
        if turned != ToolAxis::Fixed {
            self.line(self.at, turned);
        }
    }
}

/// Central differences of eight steps for the first derivative, beyond the middle [1/step].
const DIFFERENCES: [f64; 4] = [0.8, -0.2, 4.0 / 105.0, -1.0 / 280.0];

/// Positions and derivatives by the part of the segment.
fn by_part(path: &AxisPath, t: f64) -> [[f64; 4]; 6] {
    let length = path.length();
    path.at(t * length).map(|jet| [jet.q, jet.d1 * length, jet.d2 * length.powi(2), jet.d3 * length.powi(3)])
}

/// Angle by which arcs and tools turn at least along a segment, to choose steps by [rad].
const SLOW: f64 = 3.0;
/// Distance of the tip from the rotary axes, to judge errors by [mm].
const LEVER: f64 = 10.0;

/// Compares positions and derivatives of a segment with its positions; gives the largest rate of a rotary axis.
fn check(segment: &Segment, what: &str) -> f64 {
    let path = segment.axis_path().unwrap();
    let mut fastest = 0f64;
    for k in 0..=8 {
        let t = f64::from(k) / 8.0;
        let jets = by_part(&path, t);
        let Some(joints) = segment.joints(t) else {
            assert!(jets.iter().flatten().all(|c| c.is_nan()), "{what}: no positions at {t}");
            continue;
        };
        for i in 0..6 {
            assert!((jets[i][0] - joints[i]).abs() < 1e-9, "{what}: axis {i} at {t}");
        }
        // The higher derivatives are large near a place where two axes cannot turn the tool into all directions.
        let rate = jets[3..].iter().fold(SLOW, |most: f64, [_, d1, d2, d3]| {
            most.max(d1.abs()).max(d2.abs().sqrt()).max(d3.abs().cbrt())
        });
        fastest = fastest.max(rate);
        if k == 0 || k == 8 {
            // There is one side only: the series is good to the fourth order.
            let step = if k == 0 { 0.005 / rate } else { -0.005 / rate };
            let [near, far] = [step, 2.0 * step].map(|h| {
                let Some(joints) = segment.joints(t + h) else { return [0.0; 6] };
                [0, 1, 2, 3, 4, 5].map(|i| {
                    let [q, d1, d2, d3] = jets[i];
                    joints[i] - (q + h * (d1 + h / 2.0 * (d2 + h / 3.0 * d3)))
                })
            });
            // Two steps leave the fifth order, here far below the third.
            let third = jets.iter().fold(LEVER * rate.powi(3), |most: f64, jet| most.max(jet[3].abs()));
            for i in 0..6 {
                let off = near[i] - far[i] / 16.0;
                let most = 1e-10 + 0.003 * third * step.abs().powi(3) / 6.0;
                assert!(off.abs() < most, "{what}: axis {i} off by {off} at its end {t}");
            }
            continue;
        }
        // Each derivative against differences of the one before it, the first against those of positions alone.
        let step = 0.01 / rate;
        let place = |n: i32| t + f64::from(n) * step;
        let around: Option<Vec<_>> = (-4..=4).map(|n| segment.joints(place(n))).collect();
        let Some(joints) = around else { continue };
        let jets_around: Vec<_> = (-4..=4).map(|n| by_part(&path, place(n))).collect();
        for order in 1..=3 {
            let lower =
                |n: usize, i: usize| if order == 1 { joints[n][i] } else { jets_around[n][i][order - 1] };
            let power = rate.powi(order as i32);
            let most = (0..6).fold(LEVER * power, |most, i| jets[i][order].abs().max(most));
            for i in 0..6 {
                let terms = DIFFERENCES.iter().enumerate();
                let sum: f64 = terms.map(|(n, w)| w * (lower(5 + n, i) - lower(3 - n, i))).sum();
                let (difference, exact) = (sum / step, jets[i][order]);
                assert!(
                    (difference - exact).abs() < 1e-7 * most,
                    "{what}: derivative {order} of axis {i} at {t}: {exact}, by differences {difference}"
                );
            }
        }
    }
    fastest
}

/// Machines of every arrangement: rotary axes on the side of the work, of the tool, of both, inclined, one alone, none;
/// and with all axes askew.
fn machines() -> Vec<(String, Machine)> {
    let codes =
        ["641203", "651203", "450123", "012365", "012364", "612035", "402135", "41203", "20315", "2103"];
    let mut machines: Vec<_> = codes.iter().map(|code| ((*code).to_owned(), machine(code))).collect();
    for name in ["nut_head_c_b45", "dmu_nut_table", "trt_xyzac_lcnc_default"] {
        machines.push((name.to_owned(), Machine::preset(name).unwrap()));
    }
    let mut random = Random(7);
    for code in ["641203", "012365", "612035", "162053"] {
        let mut machine = machine(code);
        for joint in &mut machine.joints {
            let by = if joint.motion.is_rotation() { 0.5 } else { 0.2 };
            joint.direction = (joint.direction + by * vector(&mut random)).try_normalize().unwrap();
        }
        machines.push((format!("{code} askew"), machine));
    }
    machines
}

#[test]
fn a_tool_that_stands_in_any_direction() {
    let mut random = Random(11);
    for (name, machine) in machines() {
        let mut written = Written::new();
        written.state.tcp = Tcp::Axes;
        written.line(written.at, angles(&machine, 0.8, &mut random));
        written.moves(&mut random, |_| ToolAxis::Fixed);
        let trace = followed(&written.program, &machine);
        let standing: Vec<_> = trace.segments.iter().filter(|s| s.turning.is_none()).collect();
        assert_eq!(standing.len(), 3);
        for segment in standing {
            assert_eq!(segment.axis_path().unwrap().length(), segment.curve.length());
            check(segment, &name);
        }
    }
    // In a tilted plane.
    for branch in [RotarySolution::Positive, RotarySolution::Negative] {
        let (program, mut state) = tilted(DVec3::new(0.3, 0.4, 0.8).try_normalize().unwrap(), branch);
        let at = DVec3::new(4.0, 5.0, 6.0);
        let mut written = Written { program, state, at };
        written.line(at, ToolAxis::Fixed);
        state.speed = Speed::PerMinute(20.0);
        written.state = state;
        written.moves(&mut random, |_| ToolAxis::Fixed);
        for segment in &followed(&written.program, &machine("641203")).segments {
            check(segment, "tilted");
        }
    }
}

#[test]
fn straight_rotary_axes_under_control_of_the_tool_centre_point() {
    let mut random = Random(12);
    for (name, machine) in machines().into_iter().filter(|(_, machine)| machine.is_multi_axis()) {
        for _ in 0..4 {
            let mut written = Written::new();
            written.state.tcp = Tcp::Axes;
            written.moves(&mut random, |random| angles(&machine, 1.2, random));
            let trace = followed(&written.program, &machine);
            assert_eq!(trace.segments.len(), 4);
            for segment in &trace.segments {
                check(segment, &name);
            }
            // On the spot the parameter is the angle of the axis that turns most.
            let spot = trace.segments[3].axis_path().unwrap();
            let fastest =
                spot.at(0.3 * spot.length())[3..].iter().fold(0.0, |most: f64, a| most.max(a.d1.abs()));
            assert!((fastest - 1.0).abs() < 1e-12, "{name}");
        }
    }
}

#[test]
fn a_tool_that_turns_in_a_plane() {
    let mut random = Random(13);
    let (mut followed_whole, mut fast) = (0, 0);
    for (name, machine) in machines().into_iter().filter(|(_, machine)| machine.is_multi_axis()) {
        for _ in 0..6 {
            let mut written = Written::new();
            written.state.tcp = Tcp::Axes;
            // Away from the zero of the machine, where the tool stands along an axis.
            written.line(written.at, angles(&machine, 1.2, &mut random));
            written.state.tcp = Tcp::Vector;
            written.moves(&mut random, |random| angles(&machine, 1.2, random));
            let trace = followed(&written.program, &machine);
            for segment in &trace.segments {
                // A way that is not one: the axes jump to other solutions, or do not reach all of it.
                let dense: Option<Vec<_>> = (0..=400).map(|k| segment.joints(f64::from(k) / 400.0)).collect();
                let jumps =
                    |q: &Vec<[f64; 6]>| q.windows(2).any(|w| (3..6).any(|i| (w[0][i] - w[1][i]).abs() > 0.1));
                if dense.as_ref().is_some_and(jumps) {
                    continue;
                }
                followed_whole += usize::from(dense.is_some());
                fast += usize::from(check(segment, &name) > 2.0 * SLOW);
            }
        }
    }
    assert!(followed_whole > 200 && fast > 5, "{followed_whole} {fast}");
}

#[test]
fn straight_axes_without_control_of_the_tool_centre_point() {
    let mut random = Random(14);
    for code in ["641203", "012365", "612035", "41203"] {
        let machine = machine(code);
        let mut written = Written::new();
        written.state.speed = Speed::Duration(2.0);
        written.line(40.0 * vector(&mut random), angles(&machine, 0.6, &mut random));
        // Rotary axes alone.
        written.line(written.at, angles(&machine, 0.6, &mut random));
        let trace = followed(&written.program, &machine);
        assert!(trace.segments.len() > 10);
        for segment in trace.segments.iter().step_by(5) {
            check(segment, code);
            let path = segment.axis_path().unwrap();
            assert!(path.at(0.5 * path.length()).iter().all(|jet| (jet.d2, jet.d3) == (0.0, 0.0)));
        }
    }
}

#[test]
fn without_a_machine_there_are_none_and_at_a_pole_they_are_numbers() {
    let machine = machine("641203");
    let mut written = Written::new();
    written.state.tcp = Tcp::Vector;
    // From the direction of the C axis, then through it: C is free there.
    written.line(DVec3::new(40.0, 10.0, 20.0), ToolAxis::Vector(DVec3::new(0.3, -0.2, 0.9)));
    written.line(DVec3::new(10.0, 10.0, 20.0), ToolAxis::Vector(DVec3::new(-0.3, 0.2, 0.9)));
    let trace = followed(&written.program, &machine);
    let [from, through] = &trace.segments[..] else { panic!("two moves") };
    for (segment, t) in [(from, 0.0), (through, 0.5), (through, 0.5 + 1e-7)] {
        let path = segment.axis_path().unwrap();
        let jets = path.at(t * path.length());
        let finite = jets.iter().all(|jet| [jet.q, jet.d1, jet.d2, jet.d3].iter().all(|c| c.is_finite()));
        assert!(finite, "{jets:?}");
    }
    let path = from.axis_path().unwrap();
    // A leaves the pole as fast as the tool turns, once C has turned to the plane.
    let [near, angle] = [path.at(1e-4), path.at(path.length())].map(|jets| jets[3]);
    assert!((near.d1.abs() - angle.q.abs() / path.length()).abs() < 1e-9);
    // Without a machine the direction alone is known, and while it stands the place of the tip.
    written.line(DVec3::new(10.0, 20.0, 20.0), ToolAxis::Fixed);
    let unknown = followed_or(&written.program, None).unwrap();
    let known: Vec<_> = unknown.segments.iter().map(|segment| segment.axis_path().is_some()).collect();
    assert_eq!(known, [false, false, true]);
}
