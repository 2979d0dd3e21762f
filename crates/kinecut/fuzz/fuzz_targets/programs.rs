//! A program that is run as its control runs it, with itself beside it; the first byte chooses the control.

#![no_main]

#[path = "../../../kinecut-nc/tests/executed/hostile/target.rs"]
mod target;

libfuzzer_sys::fuzz_target!(|data: &[u8]| {
    let Some((&first, rest)) = data.split_first() else { return };
    let controls = kinecut_nc::nc::Control::ALL;
    target::program(controls[first as usize % controls.len()], rest);
});
