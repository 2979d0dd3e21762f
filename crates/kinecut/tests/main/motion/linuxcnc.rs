//! Motion as LinuxCNC plans it, against the planner itself.
//!
//! The times are those of LinuxCNC 2.10.0~pre1 (commit 5c41560), `src/emc/tp`, compiled and run by
//! `benches/peers/linuxcnc.py` over these programs with the limits of [`machine`].

use kinecut::base::Silent;
use kinecut::job::{GivenFile, ProgramWants, given_alone};
use kinecut::machine::{Interpolator, Machine};
use kinecut::motion::{AxisLimit, axis_limits, program_samples};
use kinecut::program::{Blend, ToolAxis};
use kinecut::verbs::check::program_sheet;

use super::program::{Written, contour, dynamics, machine as limited, machine_of};

const CYCLE: f64 = 1e-3;

/// 500, 400 and 250 mm/s; 5000, 2000 and 3000 mm/s^2.
fn machine() -> Machine {
    let mut machine = limited();
    machine.control.interpolator = Some(Interpolator::LinuxCnc);
    machine
}

fn time(text: &str) -> f64 {
    let text = format!("G21 G90 G94 G17 G54\nG0 X0 Y0 Z0\nF12000\n{text}\nM2\n");
    let program = GivenFile { name: "program.ngc", bytes: text.as_bytes() };
    let wants = ProgramWants { machine: Some(machine()), ..ProgramWants::default() };
    program_sheet(&given_alone(program, &wants, false).unwrap()).unwrap().time
}

#[test]
fn small_programs_take_the_time_of_the_planner_itself() {
    let facets: String = (1..=30)
        .map(|i| f64::from(i) * std::f64::consts::PI / 180.0)
        .map(|angle| format!("X{:.4} Y{:.4}\n", 60.0 * angle.sin(), 60.0 - 60.0 * angle.cos()))
        .collect();
    let facets = format!("G64 P0.01 Q0\nG1 {facets}");
    for (what, text, planner) in [
        ("a corner within a tolerance", "G64 P0.02 Q0\nG1 X100\nY100", 1.142),
        ("a corner without one", "G64\nG1 X100\nY100", 1.016),
        ("an exact stop", "G61.1\nG1 X100\nY100", 1.140),
        ("rapids that overlap one another, and feeds", "G64\nG0 X50\nY20\nG1 Z-5\nX10\nG0 Z5", 0.802),
        ("facets of a degree", &facets, 0.264),
        ("a way back", "G64\nG1 X40\nX0 Y0.2\nX40", 0.721),
        ("an arc between tangents", "G64\nG1 X30\nG3 X30 Y10 J5\nG1 X0", 0.597),
        (
            "arcs at angles",
            "G64 P0.05 Q0\nG1 X30\nG3 X40 Y10 R12\nG1 X40 Y30\nG2 X50 Y40 R14\nG3 X60 Y30 R14\nG1 X80",
            0.986,
        ),
        ("a helix out of the plane", "G64 P0.1 Q0\nG1 X30\nG3 X50 Y20 Z-8 R20\nG1 X50 Y40", 0.670),
        ("a line that an arc takes", "G64 P0.05 Q0\nG1 X40\nX40.1 Y0.1\nX40.1 Y50", 0.593),
        ("a spindle that is switched", "G64\nM3 S1000\nG0 Z10\nM5\nG0 X40\nM3 S2000\nG0 Y10\nG1 X0", 0.677),
        ("a cycle", "G64\nG0 Z10\nG98 G81 X10 Y0 Z-5 R2 F600\nX20 Y5\nX30\nG80", 3.262),
    ] {
        let found = time(text);
        assert!((found - planner).abs() < 1.5 * CYCLE, "{what}: {found} {planner}");
    }
}

/// Largest steps of position between two samples, over what the limits allow in a cycle.
fn farthest_step(written: &Written, machine: &Machine) -> f64 {
    let limits = axis_limits(machine);
    let mut before: Option<[f64; 6]> = None;
    let mut most = 0.0_f64;
    let trace = written.traced(machine);
    let extent = program_samples(&written.program, &trace, machine, CYCLE, &Silent, &mut |sample| {
        let now = sample.axes.map(|axis| axis.position);
        for (a, before) in before.unwrap_or(now).into_iter().enumerate() {
            let Some(limit) = limits[a] else { continue };
            most = most.max((now[a] - before).abs() / (limit.velocity * CYCLE));
        }
        before = Some(now);
        Ok(())
    });
    let (_, extent) = extent.unwrap().unwrap();
    assert_eq!((extent.jumps, extent.left_out), (0, 0));
    let total = written.time(machine).unwrap().total();
    assert!((extent.time - total).abs() < 1e-9, "{} {total}", extent.time);
    most
}

#[test]
fn positions_have_no_steps_in_arcs_of_corners_and_in_overlaps() {
    for blend in [Blend::Stop, Blend::Exact, Blend::Continuous, Blend::within(0.02)] {
        let most = farthest_step(&contour(blend), &machine());
        assert!(most > 0.01 && most <= 1.0, "{blend:?} {most}");
    }
    // Corners with a rotary axis get no arc: both moves run at once.
    let mut machine = machine_of("651203");
    let (place, _) = machine.joint('C').unwrap();
    machine.joints[place].dynamics = dynamics(AxisLimit { velocity: 2.0, acceleration: 20.0, jerk: 90.0 });
    machine.control.interpolator = Some(Interpolator::LinuxCnc);
    let mut written = Written::at_feed(Blend::Continuous);
    let axes = |c: f64| ToolAxis::Rotary([None, None, Some(c)]);
    written.turned_to([30.0, 0.0, 0.0], axes(0.2));
    written.turned_to([30.0, 20.0, 0.0], axes(0.2));
    written.turned_to([10.0, 20.0, 0.0], axes(0.0));
    let most = farthest_step(&written, &machine);
    assert!(most > 0.01 && most <= 1.0, "{most}");
}

#[test]
fn the_speed_of_a_corner_that_is_passed_is_that_of_its_arc() {
    // A right angle within 0.02 mm: the arc of R = d tan(45) with d = 0.02 cos(45) / (1 - sin(45)), and sqrt(3)/2 of the
    // acceleration across it.
    let mut machine = machine();
    for joint in &mut machine.joints {
        joint.dynamics.acceleration = Some(2000.0);
        joint.dynamics.rapid = Some(500.0);
    }
    let mut written = Written::at_feed(Blend::within(0.02));
    written.to([100.0, 0.0, 0.0]);
    written.to([100.0, 100.0, 0.0]);
    let half = 0.5_f64.sqrt();
    let radius = 0.02 * half / (1.0 - half);
    let speed = (3.0_f64.sqrt() / 2.0 * 2000.0 * radius).sqrt();
    let trace = written.traced(&machine);
    let mut slowest = f64::INFINITY;
    let total = written.time(&machine).unwrap().total();
    let samples = program_samples(&written.program, &trace, &machine, 1e-4, &Silent, &mut |sample| {
        if sample.time > 0.1 && sample.time < total - 0.1 {
            slowest = slowest.min(sample.feed);
        }
        Ok(())
    });
    assert_eq!(samples.unwrap().unwrap().1.jumps, 0);
    assert!((slowest - speed).abs() < 0.05 * speed, "{slowest} {speed}");
}
