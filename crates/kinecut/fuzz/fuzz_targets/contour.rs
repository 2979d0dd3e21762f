//! The contour of a tool; the first byte chooses the form of the file.

#![no_main]

#[path = "../../tests/main/hostile/targets.rs"]
#[allow(dead_code, reason = "each target calls one of the functions")]
mod fuzzed;

libfuzzer_sys::fuzz_target!(|data: &[u8]| {
    let Some((&first, rest)) = data.split_first() else { return };
    fuzzed::contour(["a.toml", "a.json", "a.svg", "a.dxf"][first as usize % 4], rest);
});
