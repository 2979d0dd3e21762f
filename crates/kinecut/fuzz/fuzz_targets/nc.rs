//! An NC program; the first byte chooses the control.

#![no_main]

#[path = "../../tests/main/hostile/targets.rs"]
#[allow(dead_code, reason = "each target calls one of the functions")]
mod fuzzed;

libfuzzer_sys::fuzz_target!(|data: &[u8]| {
    let Some((&first, rest)) = data.split_first() else { return };
    let controls = kinecut::nc::Control::ALL;
    fuzzed::nc_program(controls[first as usize % controls.len()], rest);
});
