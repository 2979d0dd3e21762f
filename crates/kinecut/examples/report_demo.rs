//! Writes a report of a made-up part to look at: `cargo run -p kinecut --example report_demo -- out.html [safe|big]`.
//!
//! `safe` leaves the gouge away; `big` repeats the program to 100 000 lines.

use std::process::ExitCode;

#[path = "../tests/fixtures/report.rs"]
mod fixture;

fn main() -> ExitCode {
    let args: Vec<String> = std::env::args().skip(1).collect();
    let Some(out) = args.first() else { return ExitCode::from(2) };
    let has = |word: &str| args.iter().any(|a| a == word);
    let mut report = fixture::plate(has("safe"));
    if has("big") {
        repeat(&mut report, 100_000);
    }
    if std::fs::write(out, kinecut::job::report::html(&report)).is_err() {
        return ExitCode::FAILURE;
    }
    let text = kinecut::page::text(&kinecut::job::report::sections(&report), kinecut::page::WIDTH);
    if std::io::Write::write_all(&mut std::io::stdout(), text.as_bytes()).is_err() {
        return ExitCode::FAILURE;
    }
    ExitCode::SUCCESS
}

/// Repeats path and program until the program has so many lines.
fn repeat(report: &mut kinecut::job::report::Report, lines: usize) {
    let (path, Some(program)) = (report.path.clone(), report.program.as_mut()) else { return };
    let once = program.clone();
    while program.lines.len() < lines {
        let shift = program.lines.len() as u32;
        program.lines.extend_from_slice(&once.lines);
        program.time.extend_from_slice(&once.time);
        program.length.extend_from_slice(&once.length);
        report.path.extend(path.iter().map(|p| {
            let mut p = p.clone();
            p.block += shift;
            let depth = shift as f32 * 1e-4;
            p.points.iter_mut().for_each(|q| q[2] -= depth);
            p
        }));
    }
}
