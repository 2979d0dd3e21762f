//! A job file.

#![no_main]

#[path = "../../tests/main/hostile/targets.rs"]
#[allow(dead_code, reason = "each target calls one of the functions")]
mod fuzzed;

libfuzzer_sys::fuzz_target!(|data: &[u8]| {
    fuzzed::job(data);
});
