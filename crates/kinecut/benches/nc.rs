//! Speed of writing and reading NC text: `cargo bench --bench nc`.

use std::f64::consts::TAU;

use divan::Bencher;
use divan::counter::BytesCount;
use glam::DVec3;
use kinecut::base::Sources;
use kinecut::geom::{Arc, Curve, InvoluteRecord, LensOrder, Line, Rise, Spiral, Support};
use kinecut::nc::{self, Control, PostSettings};
use kinecut::program::{Frame, Move, Origin, Program, SetupId, Speed, State, WorkOffset};

/// A bore cleared by one involute of twenty turns, and by one lens spiral.
fn spirals() -> [Program; 2] {
    let r = 79.0 / (20.0 * TAU);
    let involute = InvoluteRecord::new(4963.71639267187, [0.0, 0.0], 0.0, 0.0, 79.0).expect("a record");
    let law = Support::Lens { inner: 0.0, base_radius: r, order: LensOrder::One };
    let lens = Spiral::new(law.into(), 0.0, 20.0 * TAU).expect("a spiral");
    [Curve::involute(involute, -5.0, 0.0), Curve::spiral(lens, -5.0, Rise::NONE)].map(|curve| {
        let mut program = Program::default();
        let frame = program.add_frame(Frame::Work(WorkOffset::G54));
        let mut state = State::start(SetupId(0), frame);
        let at = curve.start();
        program.push_move(Move::along(&Line { start: at, end: at }.into()), &state, Origin::default());
        state.speed = Speed::PerMinute(100.0);
        program.push_move(Move::along(&curve), &state, Origin::default());
        program
    })
}

#[divan::bench]
fn write_an_involute_of_20_turns_as_arcs(bencher: Bencher) {
    let [program, _] = spirals();
    let settings = PostSettings::new(Control::LinuxCnc);
    bencher.bench(|| nc::write(&program, &[], &settings).map(|p| p.text.len()).unwrap_or(0));
}

#[divan::bench]
fn write_a_lens_spiral_of_20_turns_as_arcs(bencher: Bencher) {
    let [_, program] = spirals();
    let settings = PostSettings::new(Control::LinuxCnc);
    bencher.bench(|| nc::write(&program, &[], &settings).map(|p| p.text.len()).unwrap_or(0));
}

fn main() {
    divan::main();
}

const CONTROLS: &[Control] = Control::WRITTEN;

/// A chain of 10 000 arcs of growing radius.
fn arcs_10_000() -> Program {
    let mut program = Program::default();
    let frame = program.add_frame(Frame::Work(WorkOffset::G54));
    let mut state = State::start(SetupId(0), frame);
    let mut at = DVec3::new(1.0, 2.0, 3.0);
    program.push_move(Move::along(&Line { start: at, end: at }.into()), &state, Origin::default());
    state.speed = Speed::PerMinute(100.0);
    let mut angle = 0.0f64;
    for i in 0..10_000 {
        let radius = 1.0 + 0.01 * f64::from(i);
        let centre = at - DVec3::new(angle.cos(), angle.sin(), 0.0) * radius;
        let arc = Arc { start: at, centre, axis: DVec3::Z, sweep: 0.3, rise: 0.0 };
        angle += 0.3;
        program.push_move(Move::along(&arc.into()), &state, Origin::default());
        at = arc.point(1.0);
    }
    program
}

#[divan::bench(args = CONTROLS)]
fn write_10_000_arcs(bencher: Bencher, control: Control) {
    let program = arcs_10_000();
    let settings = PostSettings::new(control);
    bencher.bench(|| nc::write(&program, &[], &settings).map(|p| p.text.len()).unwrap_or(0));
}

#[divan::bench(args = CONTROLS)]
fn read_10_000_arcs(bencher: Bencher, control: Control) {
    let text =
        nc::write(&arcs_10_000(), &[], &PostSettings::new(control)).expect("the chain is writable").text;
    bencher.counter(BytesCount::of_str(&text)).bench(|| {
        let reading = nc::read(&mut Sources::default(), "bench", &text, control, &[]);
        reading.map(|r| r.program.items.len()).unwrap_or(0)
    });
}
