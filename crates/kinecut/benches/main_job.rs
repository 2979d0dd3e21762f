//! The main job: a plate of 260 x 260 x 30 mm with a bore of 200 mm, two levels and finishing, at a 0.2 mm grid.
//! Claim: under 3 s on two cores, and each stage of it.

use std::path::Path;

use kinecut::base::{DiskLoader, Silent};
use kinecut::job::Outcome;

fn main() {
    divan::main();
}

fn job() -> (String, DiskLoader) {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../examples/01_bore");
    let text = std::fs::read_to_string(folder.join("job.toml")).expect("the example is in the repository");
    (text, DiskLoader::new(folder))
}

fn outcome() -> Outcome {
    let (text, loader) = job();
    kinecut::job::run("job.toml", &text, &loader, &Silent).expect("the example runs")
}

/// Read, plan, post, read back, cut, surface, compare, judge.
#[divan::bench(sample_count = 5, sample_size = 1)]
fn job_at_0_2_mm() -> Outcome {
    outcome()
}

/// The report of it.
#[divan::bench(sample_count = 5, sample_size = 1)]
fn report_page(bencher: divan::Bencher) {
    let outcome = outcome();
    bencher.bench_local(|| kinecut::job::report::html(&kinecut::job::report::of_job(&outcome)));
}

/// Posting, 36 blocks and two native involutes for each level.
#[divan::bench]
fn post_for_sinumerik(bencher: divan::Bencher) {
    let outcome = outcome();
    let program = &outcome.setups[0].planned.program;
    bencher.bench_local(|| kinecut::nc::write(program, &outcome.job.tools, &outcome.job.post));
}
