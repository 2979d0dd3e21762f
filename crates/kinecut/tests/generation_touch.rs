//! Surfaces that machines make by touching and rolling, and budgets of errors over them.

#![allow(clippy::unwrap_used, reason = "a test panics when it fails")]

use glam::DVec3;
use kinecut::base::Silent;
use kinecut::machine::generation::{FeasibleOptions, envelope_surface};
use kinecut::machine::surface::{Surface, catalogue, envelopes};
use kinecut::machine::{CoordinateCode, Machine};

fn machine(code: &str) -> Machine {
    Machine::of_code(CoordinateCode::parse(code).unwrap())
}

fn coarse() -> FeasibleOptions {
    FeasibleOptions { cells: [6, 4], ..FeasibleOptions::default() }
}

#[test]
fn known_envelopes_are_made_and_verified() {
    let all = machine("6541230");
    for surface in catalogue() {
        for envelope in envelopes(&surface.name) {
            let t = std::time::Instant::now();
            let made = envelope_surface(surface, envelope, &all, &coarse(), 1e-3, &Silent).unwrap();
            println!("{} {}: {} {:?}", surface.name, envelope.process, made.tool, made.hold);
            match &made.outcome {
                Ok(way) => println!("   {:?}", way.lines()),
                Err(o) => println!("   NO {}", o.finding(&all, made.hold, &made.names)),
            }
            match &made.left {
                Some(Ok(l)) => println!("   {:e} .. {:e} rms {:e} cover {:?} at {}", l.least, l.greatest, l.rms, l.coverage, l.worst),
                Some(Err(f)) => println!("   {f}"),
                None => {}
            }
            println!("   {:?}", t.elapsed());
        }
    }
    let _ = (DVec3::ZERO, Surface::named("plane").unwrap());
}
