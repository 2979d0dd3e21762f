//! Promises about every text, whatever control it is for; the property test of the suite and the fuzz target check them.

use kinecut_nc::base::Sources;
use kinecut_nc::nc::{self, Control, PostSettings, ReadSettings, Reading};
use kinecut_nc::program::ToolNumber;
use kinecut_nc::tool::{Cutter, Tool, ToolLimits, ToothSpacing};
use kinecut_nc::trace::{RegisterState, TraceOptions, trace};

/// Blocks that a program may run in loops.
const BLOCKS: u64 = 2_000;

/// A program of a control, with itself beside it under two names: it ends, by an answer or by an error, in both ways of
/// reading; what is accepted is followed, and what can be written is read again and then written with as many lines.
pub(super) fn program(control: Control, bytes: &[u8]) {
    let text = String::from_utf8_lossy(bytes);
    if let Some(reading) = read(control, &text, true) {
        follow(&reading);
    }
    if let Some(reading) = read(control, &text, false) {
        follow(&reading);
        written_again(control, &text, &reading);
    }
}

fn read(control: Control, text: &str, reads_on: bool) -> Option<Reading> {
    let mut sources = Sources::default();
    let main = sources.add("a", text);
    let beside = sources.add("b", text);
    let files = ["100", "part"].map(|name| (name.to_owned(), beside)).to_vec();
    let settings = ReadSettings { files, blocks: BLOCKS, reads_on, ..ReadSettings::default() };
    nc::read_source(&sources, main, control, &[], &settings).ok()
}

fn tools() -> Vec<Tool> {
    let tool = |number| Tool {
        number: ToolNumber(number),
        name: String::new(),
        cutter: Cutter::EndMill { diameter: 2.0 },
        teeth: 2,
        spacing: ToothSpacing::default(),
        flute_length: 20.0,
        stickout: 40.0,
        shank_diameter: 2.0,
        holder: None,
        centre_cutting: true,
        max_ramp_angle: None,
        gauge_length: Some(100.0 + f64::from(number)),
        limits: ToolLimits::default(),
        elasticity: None,
    };
    (0..10).map(tool).collect()
}

fn follow(reading: &Reading) {
    let tools = tools();
    let options = TraceOptions {
        machine: None,
        tools: &tools,
        retract_height: 50.0,
        radii: &reading.radii,
        operator: RegisterState {
            in_spindle: Some(ToolNumber(0)),
            own_radius: true,
            ..RegisterState::default()
        },
        comp_start: Default::default(),
        chord: 0.1,
    };
    if let Ok(trace) = trace(&reading.program, &options) {
        let known = trace.segments.iter().all(|s| s.curve.start().is_finite() && s.curve.end().is_finite());
        assert!(known, "a place that is no number");
    }
}

/// Comments of the text may come to the head, and those that only the text had are gone.
fn written_again(control: Control, text: &str, reading: &Reading) {
    if !Control::WRITTEN.contains(&control) {
        return;
    }
    let settings = PostSettings::new(control);
    let Ok(first) = nc::write(&reading.program, &[], &settings) else { return };
    let Some(again) = read(control, &first.text, false) else {
        let mut sources = Sources::default();
        let why = nc::read(&mut sources, "b", &first.text, control, &[]).err();
        let why = why.map_or_else(|| "its loops are too long".to_owned(), |e| e.to_string());
        panic!("what was written is not read: {why}\n--- of\n{text}\n--- written\n{}", first.text);
    };
    let Ok(second) = nc::write(&again.program, &[], &settings) else { return };
    let Some(third) = read(control, &second.text, false) else {
        panic!("what was written twice is not read\n{}", second.text)
    };
    if let Ok(third) = nc::write(&third.program, &[], &settings) {
        assert_eq!(second.text, third.text, "of\n{text}");
    }
}
