//! The contour itself posted under a register that holds the cutter's radius.

use kinecut::base::{Code, MemoryLoader, Silent};
use kinecut::job::{Outcome, run};

use super::contour::job;
use crate::common::random::Random;

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

/// Slots, pockets, open lines, tabs, conventional milling, stock to leave: walls where they are wanted, no warning but that of corners.
#[test]
fn all_that_has_a_wall_can_be_posted_as_the_wall() {
    let line = "polyline = [[-80, -20], [20, -20, 0.2], [40, 10], [40, 50]]\ndepth = 8\n";
    let cases = [
        ("type = \"pocket\"\nrectangle = { size = [60, 40], corner = 8 }\ndepth = 8\n".to_owned(), ""),
        ("type = \"pocket\"\nrectangle = { size = [60, 40] }\ndepth = 8\n".to_owned(), ", wear_value = 0.03"),
        ("type = \"slot\"\nline = [[-30, 0], [30, 0]]\nwidth = 16\ndepth = 6\n".to_owned(), ""),
        (format!("type = \"contour\"\nside = \"left\"\n{line}"), ""),
        (format!("type = \"contour\"\nside = \"right\"\n{line}"), ""),
        (
            "type = \"contour\"\nrectangle = { size = [120, 70], corner = 6 }\ndepth = 20\nbreakthrough = 0.5\n\
             tabs = { count = 4, width = 6, height = 1.5 }\n"
                .to_owned(),
            ", spring_passes = 1, stepdown = 10",
        ),
        (
            "type = \"contour\"\nside = \"inside\"\ndirection = \"conventional\"\ncircle = { diameter = 60 }\ndepth = 8\n"
                .to_owned(),
            "",
        ),
        ("type = \"contour\"\nrectangle = { size = [100, 60] }\nstock_to_leave = 0.3\ndepth = 8\n".to_owned(), ""),
    ];
    for (control, register) in CONTROLS {
        for (operation, more) in &cases {
            let finish =
                format!("finish = {{ wear_offset = \"{register}\", compensation = \"full\"{more} }}");
            let text =
                job(control, &format!("{operation}{finish}")).replacen("type = \"contour\"\ntool", "tool", 1);
            let outcome = run("job.toml", &text, &MemoryLoader::default(), &Silent)
                .unwrap_or_else(|e| panic!("{control} {operation}: {e}"));
            let found = &outcome.verdict.found;
            assert!(outcome.verdict.is_safe(), "{control} {operation}: {found:?}");
            assert!(found.iter().all(|f| f.code == Code::CORNERS_STAY), "{control} {operation}: {found:?}");
            let wall = &outcome.deviation.bores[0];
            assert!(wall.ends > 300 && wall.worst() < 2e-3, "{control} {operation}: {wall:?}");
            // The operator reads the value with which it was proven.
            let value = 5.0 + if more.contains("wear_value") { 0.03 } else { 0.0 };
            let told = match control {
                "linuxcnc" => format!("diameter {} mm", 2.0 * value),
                _ => format!("radius {value} mm"),
            };
            let ensured = &outcome.verdict.to_ensure;
            let register = format!("register {register}");
            assert!(ensured.iter().any(|e| e.what == register && e.value == told), "{control}: {ensured:?}");
        }
    }
}

#[test]
fn two_cutters_need_two_registers() {
    let second = "[[tool]]\nnumber = 2\ntype = \"end-mill\"\ndiameter = 8\nteeth = 4\nflute_length = 20\nstickout = 40\n[[setup]]";
    let of = |register: &str| {
        let first = format!("{BRACKET}depth = 8\n{}", finish("D1", "full", 0.0));
        let pocket = format!(
            "[[setup.operation]]\ntype = \"pocket\"\ntool = 2\nspeed = 6000\nfeed = 800\ncircle = {{ diameter = 24 }}\n\
             at = [-28, 0]\ndepth = 4\n{}",
            finish(register, "full", 0.0)
        );
        let text = job("sinumerik-840d", &format!("{first}{pocket}")).replace("[[setup]]", second);
        run("job.toml", &text, &MemoryLoader::default(), &Silent)
    };
    let same = of("D1").unwrap_err();
    assert_eq!(same.0.key.as_deref(), Some("setup[0].operation[1].finish.wear_offset"), "{same}");
    let outcome = of("D2").unwrap_or_else(|e| panic!("{e}"));
    assert!(outcome.verdict.is_safe(), "{:?}", outcome.verdict.found);
    assert!(outcome.deviation.bores.iter().all(|wall| wall.worst() < 2e-3), "{:?}", outcome.deviation.bores);
}

#[test]
fn inside_corners_of_a_path_are_where_a_register_of_either_sign_leaves_them() {
    let outlines = [
        "side = \"inside\"\nrectangle = { size = [60, 40] }\ndepth = 6\n",
        "side = \"inside\"\npolygon = [[-40, -30], [40, -30], [0, 35]]\ndepth = 6\n",
        "side = \"outside\"\npolygon = [[-40, -30], [40, -30], [40, 30], [10, 30], [0, 5], [-10, 30], [-40, 30]]\ndepth = 6\n",
    ];
    for (control, register) in CONTROLS {
        for outline in outlines {
            for (compensation, value) in [("wear", -0.04), ("wear", 0.04), ("full", -0.04), ("full", 0.04)] {
                // The first one is the tool's own.
                let register = if compensation == "wear" && register == "D1" { "D2" } else { register };
                let outcome = cut(control, &format!("{outline}{}", finish(register, compensation, value)));
                let of = format!("{control} {compensation} {value} {outline}");
                assert!(outcome.verdict.is_safe(), "{of}: {:?}", outcome.verdict.found);
                assert!(outcome.deviation.bores[0].worst() < 2e-3, "{of}: {:?}", outcome.deviation.bores);
            }
        }
    }
}

#[test]
fn corners_that_are_tangent_but_for_the_digits_of_a_drawing_are_posted() {
    for (control, register) in CONTROLS {
        for r in [3.0, 5.0, 5.5, 8.0] {
            // The first is off by 4 seconds of arc at each joint.
            for bulge in ["0.41421", "0.4142136", "0.41421356", "0.414213562373095"] {
                let points = [
                    (-40.0, -30.0, "0"),
                    (40.0 - r, -30.0, bulge),
                    (40.0, -30.0 + r, "0"),
                    (40.0, 30.0 - r, bulge),
                    (40.0 - r, 30.0, "0"),
                    (-40.0, 30.0, "0"),
                ];
                let points: Vec<String> = points.iter().map(|(x, y, b)| format!("[{x}, {y}, {b}]")).collect();
                for side in ["inside", "outside"] {
                    // An arc of the cutter's own radius, and a little more: its path is shorter than the register moves it.
                    if side == "inside" && r == 5.0 && bulge == "0.41421" {
                        continue;
                    }
                    let outline = format!(
                        "side = \"{side}\"\noutline = {{ loops = [[{}]] }}\ndepth = 6\n",
                        points.join(", ")
                    );
                    let text = job(control, &format!("{outline}{}", finish(register, "full", 0.0)));
                    let of = format!("{control} {r} {bulge} {side}");
                    let outcome = run("job.toml", &text, &MemoryLoader::default(), &Silent);
                    let outcome = outcome.unwrap_or_else(|e| panic!("{of}: {e}"));
                    assert!(outcome.verdict.is_safe(), "{of}: {:?}", outcome.verdict.found);
                }
            }
        }
    }
}
