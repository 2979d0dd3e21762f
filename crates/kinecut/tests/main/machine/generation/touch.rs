//! Surfaces that machines make by touching and rolling, verified in micrometres.

use kinecut::base::{Finding, Silent};
use kinecut::machine::generation::{Enveloped, FeasibleOptions, LeftByTool, envelope_surface};
use kinecut::machine::surface::{GeneratedSurface, Makes, catalogue, envelopes, envelopes_of};
use kinecut::machine::{CoordinateCode, Machine};

fn machine(code: &str) -> Machine {
    Machine::of_code(CoordinateCode::parse(code).unwrap())
}

/// The machine on which each known envelope is tried: motions of the work, then those of the spindle.
fn maker(surface: &str, process: &str) -> Machine {
    machine(match (surface, process) {
        ("plane", _) => "0134",
        ("cone", _) => "60315",
        ("cylindrical-cam", _) => "6035",
        ("extrusion", _) => "0123",
        ("screw", _) => "60314",
        ("involute-cylinder", "pinion shaping") => "6017",
        ("involute-cylinder", _) => "601254",
        _ => "6031",
    })
}

fn ask(surface: &GeneratedSurface, index: usize, cells: [usize; 2]) -> Enveloped {
    let envelope = envelopes_of(surface).nth(index).unwrap();
    let options = FeasibleOptions { cells, ..FeasibleOptions::default() };
    envelope_surface(surface, envelope, &maker(envelope.surface, envelope.process), &options, &Silent)
        .unwrap()
}

fn left(made: &Enveloped) -> Result<&LeftByTool, &Finding> {
    match made.left.as_ref().unwrap_or_else(|| panic!("{:?}", made.outcome.as_ref().err())) {
        Ok(left) => Ok(left),
        Err(why) => Err(why),
    }
}

#[test]
fn known_envelopes_leave_their_surfaces() {
    let mut verified = 0;
    for surface in catalogue() {
        for (index, envelope) in envelopes(&surface.name).enumerate() {
            let at = format!("{} by {}", surface.name, envelope.process);
            // Of a flank a rack makes the convex side, whose material is where the catalogue has none.
            let convex = surface.name == "involute-cylinder";
            let side = if convex { surface.clone().reversed() } else { surface.clone() };
            let made = ask(&side, index, [24, 4]);
            if convex {
                let why = left(&ask(surface, index, [24, 4])).unwrap_err().to_string();
                assert!(why.contains("other side"), "{at}: {why}");
            }
            if envelope.makes == Makes::Near {
                let why = left(&made).unwrap_err().to_string();
                assert!(why.contains("not compared"), "{at}: {why}");
                continue;
            }
            let left = left(&made).unwrap();
            let way = made.outcome.as_ref().unwrap();
            // Laws that are no straight lines are cubics between 25 nodes.
            let exact = way.laws.iter().all(|l| l.law != kinecut::machine::generation::VariableLaw::Sampled);
            let bound = if exact { 1e-7 } else { 2e-3 };
            assert!(left.least > -bound && left.greatest < bound, "{at}: {left:?} by {:?}", way.lines());
            assert!((left.coverage.share - 1.0).abs() < 1e-12, "{at}: {left:?}");
            assert!(!made.contacts.is_empty(), "{at}");
            verified += 1;
        }
    }
    assert!(verified >= 11, "{verified}");
}

#[test]
fn a_wheel_in_a_bore_takes_too_much_when_it_is_too_large() {
    let bore = |radius: f64| {
        let made = ask(&GeneratedSurface::named("cylinder").unwrap().with("R", radius).reversed(), 0, [6, 4]);
        left(&made).unwrap().clone()
    };
    let fits = bore(20.0);
    assert!(fits.least > -1e-9 && fits.greatest < 1e-9, "{fits:?}");
    // A wheel of 8 mm whose centre runs at 3 mm about the axis of a bore of 5 mm cuts to 11 mm: 6 mm too much.
    let large = bore(5.0);
    assert!((large.least + 6.0).abs() < 1e-3, "{large:?}");
    assert!(large.coverage.share < 0.5, "{large:?}");
}

#[test]
fn a_pinion_that_is_too_small_does_not_reach_the_whole_flank() {
    // The line of contact is (rb + rt) tan(aw) = 46.2 mm long and ends at a roll of 46.2/40 = 1.155.
    let flank = |to: f64| {
        let made = ask(
            &GeneratedSurface::named("involute-cylinder").unwrap().over("phi", 0.05, to).reversed(),
            1,
            [24, 2],
        );
        left(&made).unwrap().clone()
    };
    let whole = flank(1.1);
    assert!(whole.least > -1e-7 && whole.greatest < 1e-7 && whole.coverage.share == 1.0, "{whole:?}");
    let beyond = flank(1.6);
    let off = beyond.greatest.max(-beyond.least);
    assert!(off > 0.05 && beyond.coverage.share < 0.95, "{beyond:?}");
}
