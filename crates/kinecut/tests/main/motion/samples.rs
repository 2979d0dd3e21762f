//! Samples of the motion of whole programs, held against differences of their own positions.

use kinecut::base::{Code, Finding, Silent};
use kinecut::machine::{Interpolator, Machine, Rapids};
use kinecut::motion::{AxisLimit, MotionSample, SampledMotion, axis_limits, program_samples, sample_count};
use kinecut::program::{Blend, Origin, Speed, Spindle, ToolAxis, ToolNumber};

use super::program::{FEED, Written, X, contour, dynamics, facets, machine, machine_of};

const CYCLE: f64 = 1e-3;
/// Positions of the axes where the tip of the tool, 100 mm long, is at the origin.
const ORIGIN: [f64; 6] = [0.0, 0.0, 100.0, 0.0, 0.0, 0.0];

fn sampled_at(written: &Written, machine: &Machine, cycle: f64) -> (Vec<MotionSample>, SampledMotion) {
    let mut samples = Vec::new();
    let trace = written.traced(machine);
    let extent = program_samples(&written.program, &trace, machine, cycle, &Silent, &mut |sample| {
        samples.push(*sample);
        Ok(())
    });
    let (time, extent) = extent.unwrap().unwrap();
    let alone = written.time(machine).unwrap();
    let total = alone.total();
    assert_eq!(time, alone);
    assert_eq!(extent.count, samples.len() as u64);
    assert_eq!(extent.count as f64, sample_count(total, cycle));
    assert!((extent.time - total).abs() < 1e-9 * (1.0 + total), "{} {total}", extent.time);
    assert_eq!((extent.left_out, extent.jumps), (0, 0), "{extent:?}");
    for (k, sample) in samples[..samples.len() - 1].iter().enumerate() {
        assert!((sample.time - k as f64 * cycle).abs() < 1e-9 * (1.0 + sample.time), "{k} {}", sample.time);
        assert!(sample.time < total);
    }
    let last = samples[samples.len() - 1];
    assert!(last.time == extent.time && last.axes.iter().all(|axis| axis.velocity == 0.0), "{last:?}");
    (samples, extent)
}

fn sampled(written: &Written, machine: &Machine) -> Vec<MotionSample> {
    sampled_at(written, machine, CYCLE).0
}

/// Positions at the start and end of a program [mm, rad].
fn ends(samples: &[MotionSample]) -> [[f64; 6]; 2] {
    [samples[0], samples[samples.len() - 1]].map(|sample| sample.axes.map(|axis| axis.position))
}

fn near(found: [f64; 6], expected: [f64; 6]) {
    assert!(found.iter().zip(expected).all(|(a, b)| (a - b).abs() < 1e-9), "{found:?} {expected:?}");
}

/// Differences of positions keep the limits, and are the motion that the samples tell where jerk does not jump; the number of
/// places at which they are.
fn differences_agree(written: &Written, machine: &Machine) -> usize {
    /// Share of a limit that is rounding, or beside the places at which limits are looked at.
    const CLOSE: f64 = 1.0 + 1e-4;
    /// Samples of a cycle between those that are compared: jerk may jump and jump back within one.
    const BETWEEN: usize = 20;
    let h = CYCLE;
    let limits = axis_limits(machine);
    let (fine, _) = sampled_at(written, machine, CYCLE / BETWEEN as f64);
    let mut compared = 0;
    // Without the last sample, which lies beside the cycle.
    for five in fine[..fine.len() - 1].windows(4 * BETWEEN + 1).step_by(BETWEEN) {
        for a in 0..6 {
            let Some(limit) = limits[a] else { continue };
            let q: [f64; 5] = std::array::from_fn(|i| five[i * BETWEEN].axes[a].position);
            let velocity = (q[3] - q[1]) / (2.0 * h);
            let acceleration = (q[3] - 2.0 * q[2] + q[1]) / (h * h);
            let jerk = (q[4] - 2.0 * q[3] + 2.0 * q[1] - q[0]) / (2.0 * h * h * h);
            let own = five[2 * BETWEEN].axes[a];
            let at = five[2 * BETWEEN].time;
            assert!(velocity.abs() <= CLOSE * limit.velocity, "{at} {a}: v {velocity}");
            assert!(acceleration.abs() <= CLOSE * limit.acceleration, "{at} {a}: a {acceleration}");
            assert!(jerk.abs() <= CLOSE * limit.jerk, "{at} {a}: j {jerk}");
            // The mean of a velocity is off by its jerk alone, that of an acceleration by the change of jerk.
            assert!(
                (own.velocity - velocity).abs() <= CLOSE * h * h * limit.jerk / 6.0,
                "{at} {a}: {own:?} {velocity}"
            );
            let jerks = five.iter().map(|sample| sample.axes[a].jerk);
            let low = jerks.clone().fold(f64::INFINITY, f64::min);
            let change = jerks.fold(f64::NEG_INFINITY, f64::max) - low + 1e-4 * limit.jerk;
            if change < 0.05 * limit.jerk {
                compared += 1;
                let off = (own.acceleration - acceleration).abs();
                assert!(off <= h * change, "{at} {a}: {own:?} {acceleration}");
                assert!((own.jerk - jerk).abs() <= change, "{at} {a}: {own:?} {jerk}");
            }
        }
    }
    compared
}

#[test]
fn differences_of_positions_are_the_motion_and_keep_the_limits() {
    let within = |path| Blend::within(path);
    for (name, written) in [
        ("facets", facets(0.05)),
        ("contour, stops", contour(Blend::Stop)),
        ("contour, exact path", contour(Blend::Exact)),
        ("contour, usual", contour(Blend::Continuous)),
        ("contour, 0.2", contour(within(0.2))),
    ] {
        let machine = machine();
        let samples = sampled(&written, &machine);
        let compared = differences_agree(&written, &machine);
        assert!(compared > samples.len(), "{name}: {compared} of {}", samples.len());
        // The axes together are as fast as the tip on its programmed path, but for the smoothing of joints.
        let farthest = samples.iter().map(|sample| {
            let speed = sample.axes[..3].iter().map(|axis| axis.velocity.powi(2)).sum::<f64>().sqrt();
            speed - sample.feed
        });
        let farthest = farthest.fold(f64::NEG_INFINITY, f64::max);
        assert!(farthest < 0.01 * FEED, "{name}: {farthest}");
        assert!(samples.windows(2).all(|pair| pair[0].item <= pair[1].item), "{name}");
    }
    let [start, end] = ends(&sampled(&contour(Blend::Continuous), &machine()));
    near(start, ORIGIN);
    near(end, ORIGIN);
}

#[test]
fn rapids_run_together_or_axis_by_axis() {
    let mut written = Written::new();
    written.state.speed = Speed::Rapid { linear: false };
    written.to([120.0, -50.0, 10.0]);
    let mut machine = machine();
    let together = sampled(&written, &machine);
    differences_agree(&written, &machine);
    // On the straight line all the time.
    assert!(together.iter().all(|s| (s.axes[0].position * 50.0 + s.axes[1].position * 120.0).abs() < 1e-6));
    machine.rapids = Some(Rapids::AxisByAxis);
    let apart = sampled(&written, &machine);
    differences_agree(&written, &machine);
    // X takes longest; Z is at its end long before.
    let late = &apart[apart.len() * 2 / 3];
    assert!(late.axes[2].position == 110.0 && late.axes[2].velocity == 0.0 && late.axes[0].velocity > 0.0);
    for samples in [together, apart] {
        let [start, end] = ends(&samples);
        near(start, ORIGIN);
        near(end, [120.0, -50.0, 110.0, 0.0, 0.0, 0.0]);
    }
}

#[test]
fn rotary_axes_are_in_radians_and_follow_their_own_limits() {
    let limit = AxisLimit { velocity: 0.8, acceleration: 4.0, jerk: 90.0 };
    let mut machine = machine_of("651203");
    for letter in ['A', 'B', 'C'] {
        if let Some((place, _)) = machine.joint(letter) {
            machine.joints[place].dynamics = dynamics(limit);
        }
    }
    let mut written = Written::at_feed(Blend::Continuous);
    written.turned_to([0.0; 3], ToolAxis::Rotary([None, None, Some(1.1)]));
    let samples = sampled(&written, &machine);
    assert!(differences_agree(&written, &machine) > 0);
    let [start, end] = ends(&samples);
    assert!((end[5] - start[5] - 1.1).abs() < 1e-9, "{start:?} {end:?}");
}

#[test]
fn rests_have_samples_at_their_place_and_moves_go_on_between_multiples_of_the_cycle() {
    let mut written = Written::new();
    written.state.speed = Speed::PerMinute(FEED);
    written.state.spindle = Spindle::Clockwise(600.0);
    written.to([30.0, 0.0, 0.0]);
    written.program.push_dwell(0.25, &written.state, Origin::default());
    written.to([60.0, 0.0, 0.0]);
    written.program.push_tool(ToolNumber(2), Some(2), None, &written.state, Origin::default());
    let mut machine = machine();
    machine.control.tool_change = Some(0.5);
    machine.control.spindle_ramp = Some(0.4);
    machine.control.max_speed = Some(1200.0);
    let samples = sampled(&written, &machine);
    differences_agree(&written, &machine);
    let resting = |x: f64| {
        samples.iter().filter(|s| s.feed == 0.0 && (s.axes[0].position - x).abs() < 1e-12).count() as f64
    };
    // The first tool and the spindle, the dwell, the second tool.
    for (x, time) in [(0.0, 0.7), (30.0, 0.25), (60.0, 0.5)] {
        assert!((resting(x) * CYCLE - time).abs() < 2.0 * CYCLE, "{x}: {}", resting(x));
    }
    // A coarse cycle sees the same motion.
    let (coarse, _) = sampled_at(&written, &machine, 7.0 * CYCLE);
    for (k, sample) in coarse[..coarse.len() - 1].iter().enumerate() {
        let fine = samples[7 * k];
        assert!((fine.axes[0].position - sample.axes[0].position).abs() < 1e-9, "{k}");
    }
}

#[test]
fn look_ahead_by_junction_deviation_is_trapezoids_along_chords() {
    let mut machine = machine();
    for joint in &mut machine.joints {
        joint.dynamics = dynamics(X);
    }
    machine.control.interpolator = Some(Interpolator::JunctionDeviation);
    let samples = sampled(&contour(Blend::Continuous), &machine);
    let limits = axis_limits(&machine).map(|limit| Some(AxisLimit { jerk: f64::INFINITY, ..limit? }));
    for pair in samples[..samples.len() - 1].windows(2) {
        for a in 0..3 {
            let [before, after] = [pair[0].axes[a], pair[1].axes[a]];
            let mean = (after.position - before.position) / CYCLE;
            assert!(mean.abs() <= limits[a].unwrap().velocity && before.jerk == 0.0);
            let [low, high] = [before.velocity.min(after.velocity), before.velocity.max(after.velocity)];
            let slack = X.acceleration * CYCLE;
            assert!(mean >= low - slack && mean <= high + slack, "{}: {mean} {low} {high}", pair[0].time);
        }
    }
    let [start, end] = ends(&samples);
    near(start, ORIGIN);
    near(end, ORIGIN);
}

#[test]
fn a_wrong_cycle_a_machine_without_limits_and_an_error_of_the_caller_end_it() {
    let mut written = Written::at_feed(Blend::Continuous);
    written.to([30.0, 0.0, 0.0]);
    let with = |machine: &Machine, cycle: f64, fails: bool| {
        let trace = written.traced(machine);
        program_samples(&written.program, &trace, machine, cycle, &Silent, &mut |_| match fails {
            true => Err(Finding::error(Code::OUTPUT_NOT_WRITTEN, "full").into()),
            false => Ok(()),
        })
    };
    for cycle in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        let error = with(&machine(), cycle, false).unwrap_err();
        assert_eq!((error.code(), error.0.key.as_deref()), (Code::PLAN_VALUE, Some("cycle")));
    }
    assert_eq!(with(&machine(), CYCLE, true).unwrap_err().code(), Code::OUTPUT_NOT_WRITTEN);
    let mut none = machine();
    none.dynamics.acceleration = None;
    assert_eq!(with(&none, CYCLE, false).unwrap(), None);
}
