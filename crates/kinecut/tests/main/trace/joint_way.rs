//! Bounds on speed and acceleration of the axes: no difference of their positions is more, on machines with offsets, with control of
//! the tip, along vectors and without.

use glam::DVec3;
use kinecut::base::Code;
use kinecut::program::{Speed, Tcp, ToolAxis};
use kinecut::trace::{JointWay, travel_findings};

use super::rotary::{followed, machine, program, rotary, to};

/// Tables, heads, one of each, and a rotary axis between two linear ones.
const CODES: [&str; 6] = ["641203", "651203", "450123", "012365", "612035", "261035"];

#[test]
fn no_difference_of_positions_is_more_than_its_bound() {
    let mut looked = 0;
    for code in CODES {
        for tcp in [Tcp::Off, Tcp::Axes, Tcp::Vector] {
            let machine = machine(code);
            let (mut program, mut state) = program(true);
            to(&mut program, &state, [0.0, 0.0, 50.0], ToolAxis::Rotary(rotary(code, 0.1, 0.2)));
            state.tcp = tcp;
            state.speed = Speed::PerMinute(20.0);
            for (point, a, b) in [
                ([40.0, 10.0, 20.0], 0.4, -0.7),
                ([-10.0, 30.0, 5.0], -0.2, 0.3),
                ([-10.0, 30.0, 5.0], 0.9, 0.5),
                ([90.0, -40.0, 5.0], 0.9, 0.5),
            ] {
                to(&mut program, &state, point, ToolAxis::Rotary(rotary(code, a, b)));
            }
            let trace = followed(&program, &machine);
            for segment in trace.segments.iter().step_by(if tcp == Tcp::Off { 40 } else { 1 }) {
                let way = JointWay::new(segment).unwrap();
                for k in 0..60u32 {
                    // Stretches of all lengths, everywhere.
                    let step = 0.5f64.powi((k % 6) as i32 + 1);
                    let from = (1.0 - step) * f64::from((k * 37) % 60) / 59.0;
                    let rates = way.rates(from, from + step);
                    let at = |t: f64| way.at(from + t * step);
                    for j in 0..8 {
                        let t = f64::from(j) / 8.0;
                        let [a, b, c] = [at(t), at(t + 0.0625), at(t + 0.125)];
                        for i in 0..6 {
                            let (rate, bend) = rates[i];
                            let h = 0.0625 * step;
                            let (first, second) = ((c[i] - a[i]).abs(), (c[i] - 2.0 * b[i] + a[i]).abs());
                            assert!(
                                first <= 2.0 * h * rate + 1e-10,
                                "{code} {tcp:?} axis {i}: {first} {}",
                                2.0 * h * rate
                            );
                            assert!(
                                second <= h * h * bend + 1e-10,
                                "{code} {tcp:?} axis {i}: {second} {}",
                                h * h * bend
                            );
                            looked += 1;
                        }
                    }
                }
            }
        }
    }
    assert!(looked > 100_000, "{looked}");
}

#[test]
fn directions_out_of_reach_between_two_places_are_found() {
    // A cannot come nearer to 0 than a hundredth of a radian: the pole is out of reach, and the way of the tool passes it in less than a
    // 64th of a move, away from the places at which directions are looked at first.
    let mut machine = machine("641203");
    for joint in machine.joints.iter_mut().filter(|j| j.letter == 'A') {
        joint.travel = Some([0.008, 1.4]);
    }
    let tilted = |angle: f64| ToolAxis::Vector(DVec3::new(angle.sin(), 0.0, angle.cos()));
    let (mut program, mut state) = program(true);
    state.tcp = Tcp::Vector;
    state.speed = Speed::PerMinute(20.0);
    // At half of the way and half a place more the tool is upright.
    let [from, to_angle] = [0.8 * (1.0 + 1.0 / 64.0), -0.8 * (1.0 - 1.0 / 64.0)];
    to(&mut program, &state, [0.0, 0.0, 50.0], tilted(from));
    to(&mut program, &state, [40.0, 10.0, 50.0], tilted(to_angle));
    let trace = followed(&program, &machine);
    let segment = trace.segments.last().unwrap();
    let way = JointWay::new(segment).unwrap();
    assert!(!way.is_lost());
    assert!(way.at(0.5 + 0.5 / 64.0)[0].is_nan() && way.is_lost());
    let found = travel_findings(&trace, &program, &machine);
    assert!(
        found.iter().any(|f| f.code == Code::TRAVEL_EXCEEDED && f.message.contains("cannot follow")),
        "{found:?}"
    );
}
