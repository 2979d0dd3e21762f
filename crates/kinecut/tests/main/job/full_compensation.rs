//! The contour itself posted under a register that holds the cutter's radius.

use kinecut::base::{Code, MemoryLoader, Silent};
use kinecut::job::{Outcome, run};

use crate::common::random::Random;

fn job(control: &str, operation: &str) -> String {
    format!(
        r#"format = 1
post = {{ control = "{control}" }}
stock = {{ box = {{ min = [-80, -50, -20], max = [80, 50, 0] }} }}
simulate = {{ step = 0.5, engagement = false }}
[[tool]]
number = 1
type = "end-mill"
diameter = 10
teeth = 4
flute_length = 26
stickout = 40
gauge_length = 120
[[setup]]
offset = "G54"
[[setup.operation]]
type = "contour"
tool = 1
speed = 6000
feed = 1200
stepdown = 5
{operation}
"#
    )
}

fn cut(control: &str, operation: &str) -> Outcome {
    run("job.toml", &job(control, operation), &MemoryLoader::default(), &Silent)
        .unwrap_or_else(|e| panic!("{control}: {e}"))
}

const CONTROLS: [(&str, &str); 4] =
    [("sinumerik-840d", "D1"), ("heidenhain", "D1"), ("fanuc", "D101"), ("linuxcnc", "D101")];

/// An angle bracket: sharp outside corners, one inside corner, a rounded one, an inside arc.
const BRACKET: &str = "outline = { loops = [[[-50, -30], [50, -30], [50, 0], [10, 0, -0.4142135623730951], [0, 10], [0, 30], [-50, 30]]] }\n";

fn finish(register: &str, compensation: &str, value: f64) -> String {
    format!(
        "finish = {{ wear_offset = \"{register}\", compensation = \"{compensation}\", wear_value = {value} }}\n"
    )
}

#[test]
fn the_wall_is_where_the_path_of_the_centre_puts_it() {
    for (control, register) in CONTROLS {
        for side in ["outside", "inside"] {
            let operation = format!("{BRACKET}side = \"{side}\"\ndepth = 8\n");
            for value in [0.0, 0.04, -0.04] {
                let outcome = cut(control, &format!("{operation}{}", finish(register, "full", value)));
                let found = &outcome.verdict.found;
                assert!(outcome.verdict.is_safe(), "{control} {side} {value}: {found:?}");
                let wall = &outcome.deviation.bores[0];
                assert!(wall.ends > 1000 && wall.worst() < 2e-3, "{control} {side} {value}: {wall:?}");
            }
        }
    }
}

#[test]
fn corners_of_the_drawing_are_in_the_text() {
    let operation = format!("{BRACKET}side = \"outside\"\ndepth = 8\n");
    for (control, register) in CONTROLS {
        let text = cut(control, &format!("{operation}{}", finish(register, "full", 0.0))).setups[0]
            .posted
            .text
            .clone();
        let has = |text: &str, word: &str| {
            text.split_whitespace().any(|w| w.replace('+', "").trim_end_matches('.') == word)
        };
        // One after the other, a corner is reached by one of its coordinates alone.
        assert!(["X-50", "X50", "Y-30", "Y30"].iter().all(|w| has(&text, w)), "{control}: {text}");
        assert_eq!(has(&text, "CFTCP"), control == "sinumerik-840d", "{text}");
        assert!(
            text.contains("RADIUS OF THE CUTTER IN") || text.contains("DIAMETER OF THE CUTTER IN"),
            "{text}"
        );
        // The path of the centre has arcs about the corners instead.
        let worn = if register == "D1" { "D2" } else { register };
        let wear =
            cut(control, &format!("{operation}{}", finish(worn, "wear", 0.0))).setups[0].posted.text.clone();
        assert!(wear.contains("WEAR IN"), "{wear}");
        assert!(has(&wear, "X-55") && !has(&text, "X-55"), "{control}: {wear}");
    }
}

#[test]
fn random_outlines_are_cut_alike_by_both_paths() {
    let mut random = Random(21);
    for case in 0..12 {
        // A star of corners about the middle, some of them joined by arcs.
        let corners = 5 + (random.share() * 5.0) as usize;
        let points: Vec<String> = (0..corners)
            .map(|i| {
                let angle = std::f64::consts::TAU * (i as f64 + 0.3 * random.share()) / corners as f64;
                let radius = 25.0 + 15.0 * random.share();
                let bulge = if random.share() < 0.3 { 0.3 * (random.share() - 0.5) } else { 0.0 };
                format!("[{:.3}, {:.3}, {bulge:.4}]", radius * angle.cos(), radius * angle.sin())
            })
            .collect();
        let (control, register) = CONTROLS[case % 4];
        let operation = format!("outline = {{ loops = [[{}]] }}\ndepth = 6\n", points.join(", "));
        let of = |compensation: &str, register: &str| {
            cut(control, &format!("{operation}{}", finish(register, compensation, 0.0)))
        };
        let (full, wear) = (of("full", register), of("wear", if register == "D1" { "D2" } else { register }));
        for outcome in [&full, &wear] {
            assert!(
                outcome.verdict.found.iter().all(|f| f.code == Code::CORNERS_STAY),
                "{case}: {operation} {:?}",
                outcome.verdict.found
            );
            assert!(
                outcome.deviation.bores[0].worst() < 2e-3,
                "{case} {control}: {operation} {:?}",
                outcome.deviation.bores[0]
            );
        }
        let volume = |o: &Outcome| o.simulation.stock.volume();
        assert!(
            (volume(&full) - volume(&wear)).abs() < 60.0,
            "{case} {control}: {} {}",
            volume(&full),
            volume(&wear)
        );
    }
}

#[test]
fn a_register_is_needed_and_the_control_must_have_one() {
    let operation = format!("{BRACKET}depth = 8\n");
    let of = |control: &str, more: &str| {
        run("job.toml", &job(control, &format!("{operation}{more}")), &MemoryLoader::default(), &Silent)
            .unwrap_err()
    };
    let lacks = of("fanuc", "finish = { compensation = \"full\" }\n");
    assert_eq!(lacks.0.key.as_deref(), Some("setup[0].operation[0].finish.wear_offset"), "{lacks}");
    let grbl = of("grbl", "finish = { compensation = \"full\", wear_offset = \"D2\" }\n");
    assert_eq!(grbl.code(), Code::POST_CONTROL, "{grbl}");
    // A groove narrower than the cutter: it touches both corners at once, which no contour describes.
    let narrow = "outline = { loops = [[[-50, -30], [50, -30], [50, 30], [4, 30], [4, 10], [-4, 10], [-4, 30], [-50, 30]]] }\ndepth = 8\n";
    let groove = run(
        "job.toml",
        &job("fanuc", &format!("{narrow}{}", finish("D101", "full", 0.0))),
        &MemoryLoader::default(),
        &Silent,
    )
    .unwrap_err();
    assert_eq!(groove.0.key.as_deref(), Some("setup[0].operation[0].finish.compensation"), "{groove}");
    assert!(groove.0.message.contains("4.000, 30.000)"), "{groove}");
}
