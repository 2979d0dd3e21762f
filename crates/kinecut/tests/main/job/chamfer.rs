//! Chamfers through the whole: posted for each control, read back, cut, and their width measured.

use std::f64::consts::PI;

use kinecut::base::{Code, Error, MemoryLoader, Severity, Silent};
use kinecut::job::{Outcome, run};

/// A plate of 120 x 90 x 10 with an end mill of 10 mm and V cutters of 10 mm, one of 90 degrees and a point, one of 60 with a flat.
fn job(control: &str, operations: &str) -> String {
    format!(
        r#"format = 1
post = {{ control = "{control}" }}
stock = {{ box = {{ min = [-60, -45, -10], max = [60, 45, 0] }} }}
simulate = {{ step = 0.4, engagement = false }}
[[tool]]
number = 1
type = "end-mill"
diameter = 10
teeth = 4
flute_length = 26
stickout = 40
gauge_length = 120
[[tool]]
number = 5
type = "tapered"
diameter = 0
half_angle = 45
flute_length = 5
shank_diameter = 10
stickout = 30
gauge_length = 110
[[tool]]
number = 6
type = "tapered"
diameter = 1
half_angle = 30
flute_length = 8
shank_diameter = 10
stickout = 30
gauge_length = 110
[[setup]]
offset = "G54"
{operations}
"#
    )
}

const CONTOUR: &str = "[[setup.operation]]\ntype = \"contour\"\ntool = 1\nspeed = 6000\nfeed = 1200\n";
const CHAMFER: &str = "[[setup.operation]]\ntype = \"chamfer\"\ntool = 5\nspeed = 9000\nfeed = 900\n";

fn cut(control: &str, operations: &str) -> Outcome {
    run("job.toml", &job(control, operations), &MemoryLoader::default(), &Silent)
        .unwrap_or_else(|e| panic!("{e}"))
}

fn refused(operation: &str) -> Error {
    let operations = format!("{CHAMFER}{operation}");
    run("job.toml", &job("fanuc", &operations), &MemoryLoader::default(), &Silent).unwrap_err()
}

/// A contour of a depth, and a chamfer of its edge.
fn both(outline: &str, depth: f64, chamfer: &str) -> String {
    format!("{CONTOUR}{outline}\ndepth = {depth}\n{CHAMFER}{outline}\n{chamfer}\n")
}

fn removed(outcome: &Outcome) -> f64 {
    outcome.simulation.raw_volume - outcome.simulation.stock.volume()
}

const PLATE: &str = "rectangle = { size = [60, 40], corner = 6, angle = 20 }";

#[test]
fn the_width_is_measured_on_every_control() {
    for control in ["sinumerik-840d", "heidenhain", "linuxcnc", "fanuc", "grbl"] {
        let outcome = cut(control, &both(PLATE, 6.0, "width = 1"));
        let verdict = &outcome.verdict;
        assert!(verdict.is_safe() && verdict.found.is_empty(), "{control}: {:?}", verdict.found);
        let claims: Vec<_> =
            verdict.proven.iter().filter(|p| p.claim.contains("the chamfer lies within")).collect();
        assert_eq!(claims.len(), 1, "{control}");
        let chamfer = &outcome.deviation.bores[1];
        assert!(chamfer.ends > 1000 && chamfer.worst() < 2e-3, "{control}: {chamfer:?}");
        // The wall below is what it was.
        assert!(outcome.deviation.bores[0].worst() < 2e-3, "{control}");
    }
}

#[test]
fn the_volume_is_that_of_the_chamfer() {
    let contour = format!("{CONTOUR}{PLATE}\ndepth = 6\n");
    let gone = removed(&cut("fanuc", &both(PLATE, 6.0, "width = 1.5"))) - removed(&cut("fanuc", &contour));
    // At each height the area between the outline and itself, set back.
    let perimeter = 2.0 * (48.0 + 28.0) + 12.0 * PI;
    let wanted = 1.5 * (perimeter * 1.5 / 2.0 - PI * 1.5 * 1.5 / 3.0);
    // Volumes are known to half a line at each wall.
    assert!((gone / wanted - 1.0).abs() < 2e-2, "{gone} {wanted}");
}

#[test]
fn lines_arcs_and_corners_of_all_sides_have_their_width() {
    let notched =
        "polygon = [[-40, -30], [40, -30], [40, 30], [10, 30], [10, 5], [-10, 5], [-10, 30], [-40, 30]]";
    for (outline, more, webs) in [
        ("circle = { at = [10, 5], diameter = 60 }", "width = 0.5", 0),
        (
            "side = \"inside\"\ncircle = { at = [3, 2], diameter = 40 }",
            "width = 0.8\ndirection = \"conventional\"",
            0,
        ),
        ("side = \"inside\"\nrectangle = { size = [60, 40], corner = 8 }", "width = 1\nwall_height = 6", 0),
        // Sharp corners of a part are cut whole, those of a pocket keep a web.
        ("polygon = [[-40, -30], [40, -30], [0, 30]]", "width = 1.2", 0),
        (notched, "width = 1\ntip_clearance = 0.3", 2),
        ("side = \"inside\"\nrectangle = { size = [60, 40] }", "width = 1", 4),
    ] {
        // The notched part by the cutter of 60 degrees.
        let operations =
            both(outline, 6.0, more).replace("tool = 5", if webs == 2 { "tool = 6" } else { "tool = 5" });
        let outcome = cut("linuxcnc", &operations);
        let verdict = &outcome.verdict;
        let found: Vec<_> = verdict.found.iter().filter(|f| f.code != Code::CORNERS_STAY).collect();
        assert!(verdict.is_safe() && found.is_empty(), "{outline}: {:?}", verdict.found);
        let chamfer = &outcome.deviation.bores[1];
        assert!(chamfer.ends > 500 && chamfer.worst() < 2e-3, "{outline}: {chamfer:?}");
        let told: Vec<_> = verdict.found.iter().filter(|f| f.message.contains("a web stays")).collect();
        assert_eq!(told.len(), usize::from(webs > 0), "{outline}");
        let unchecked =
            verdict.unchecked().filter(|item| format!("{item:?}").contains("mm of edge at")).count();
        assert_eq!(unchecked, usize::from(webs > 0), "{outline}");
        let json: serde_json::Value = serde_json::from_str(&kinecut::job::plan_json(&outcome)).unwrap();
        let own = &json["setups"][0]["chamfers"][0];
        assert_eq!(own["webs"].as_array().unwrap().len(), webs, "{outline}");
    }
}

#[test]
fn webs_are_told_with_the_length_of_the_edge() {
    let outcome = cut("fanuc", &both("side = \"inside\"\nrectangle = { size = [60, 40] }", 6.0, "width = 1"));
    let told = outcome.verdict.found.iter().find(|f| f.message.contains("a web stays")).unwrap();
    // The chamfer ends 0.5 mm before a corner on both of its sides.
    assert!(told.message.contains("4 mm of edge at 4 inside corners"), "{}", told.message);
    assert_eq!((told.code, told.severity), (Code::CORNERS_STAY, Severity::Warning));
}

#[test]
fn a_chamfer_before_the_contour_is_as_wide() {
    let operations = format!("{CHAMFER}{PLATE}\nwidth = 1\n{CONTOUR}{PLATE}\ndepth = 6\n");
    let outcome = cut("fanuc", &operations);
    assert!(outcome.verdict.is_safe(), "{:?}", outcome.verdict.found);
    assert!(outcome.deviation.bores.iter().all(|b| b.ends > 1000 && b.worst() < 2e-3));
    // Alone, in the full stock, it is measured on its own side of the groove.
    let alone = cut("fanuc", &format!("{CHAMFER}{PLATE}\nwidth = 1\n"));
    assert!(alone.verdict.is_safe(), "{:?}", alone.verdict.found);
    assert!(alone.deviation.bores[0].ends > 1000 && alone.deviation.bores[0].worst() < 2e-3);
}

#[test]
fn a_wall_with_stock_on_it_is_chamfered_where_it_is() {
    let outline = format!("{PLATE}\nstock_to_leave = 0.3");
    let outcome = cut("fanuc", &both(&outline, 6.0, "width = 1"));
    assert!(outcome.verdict.is_safe(), "{:?}", outcome.verdict.found);
    assert!(outcome.deviation.bores.iter().all(|b| b.ends > 1000 && b.worst() < 2e-3));
    // From the fillets of corners too.
    let pocket = "side = \"inside\"\nrectangle = { size = [40, 30] }\nstock_to_leave = 0.3\nwidth = 1\n";
    let corners = cut("fanuc", &format!("{CHAMFER}{pocket}"));
    assert!(
        corners.verdict.is_safe() && corners.deviation.bores[0].worst() < 2e-3,
        "{:?}",
        corners.deviation.bores
    );
    // The wall below it is not looked at, and so it is said.
    let told =
        |o: &Outcome| o.verdict.unchecked().any(|item| format!("{item:?}").contains("the wall below it"));
    assert!(told(&outcome) && told(&corners));
}

#[test]
fn a_face_that_is_not_where_the_edge_is_said_to_be_is_found() {
    for (top, code, words) in [(-0.2, Code::STOCK_LEFT, "too high"), (0.2, Code::WALL_GOUGED, "too low")] {
        let outcome = cut("fanuc", &both(PLATE, 6.0, &format!("width = 1\ntop = {top}")));
        let found = outcome.verdict.found.iter().find(|f| f.code == code && f.message.contains(words));
        let value =
            found.and_then(|f| f.value.as_ref()).unwrap_or_else(|| panic!("{:?}", outcome.verdict.found));
        assert!((value.value - 0.2).abs() < 2e-3, "{value:?}");
        assert!(!outcome.verdict.proven.iter().any(|p| p.claim.contains("the chamfer lies")));
    }
}

#[test]
fn an_edge_that_is_not_cut_is_not_claimed() {
    // Beside the stock nothing is cut, and nothing measured.
    let outcome = cut("fanuc", &format!("{CHAMFER}circle = {{ at = [200, 0], diameter = 40 }}\nwidth = 1\n"));
    assert!(!outcome.verdict.is_safe());
    assert!(
        outcome.verdict.found.iter().any(|f| f.code == Code::NOT_MEASURED),
        "{:?}",
        outcome.verdict.found
    );
    assert!(!outcome.verdict.proven.iter().any(|p| p.claim.contains("the chamfer lies")));
}

/// A plate of 90 x 50 with a hole of 18 in it, `beside` its lower edge, as a drawing.
fn drawing(beside: f64) -> MemoryLoader {
    let y = 9.0 + beside;
    let text = format!(
        "0\nSECTION\n2\nHEADER\n9\n$INSUNITS\n70\n4\n0\nENDSEC\n0\nSECTION\n2\nENTITIES\n\
        0\nLWPOLYLINE\n8\nPART\n90\n4\n70\n1\n10\n0\n20\n0\n10\n90\n20\n0\n42\n0.2\n10\n90\n20\n50\n10\n0\n20\n50\n\
        0\nCIRCLE\n8\nHOLES\n10\n20\n20\n{y}\n40\n9\n0\nENDSEC\n0\nEOF\n"
    );
    MemoryLoader::default().with("plate.dxf", text)
}

#[test]
fn a_chamfer_has_the_outline_of_the_contour_that_it_names() {
    let contour = format!("{CONTOUR}name = \"edge\"\n{PLATE}\ntop = -0.5\ndepth = 6\nstock_to_leave = 0.2\n");
    let named = cut("fanuc", &format!("{contour}{CHAMFER}of = \"edge\"\nwidth = 1\n"));
    let said =
        cut("fanuc", &format!("{contour}{CHAMFER}{PLATE}\ntop = -0.5\nstock_to_leave = 0.2\nwidth = 1\n"));
    assert_eq!(named.setups[0].posted.text, said.setups[0].posted.text);
    // Keys that are given here are not taken from there.
    let higher = cut("fanuc", &format!("{contour}{CHAMFER}of = \"edge\"\ntop = 0\nwidth = 1\n"));
    assert!(higher.verdict.is_safe(), "{:?}", higher.verdict.found);
    let refused = |operations: &str| {
        let error =
            run("job.toml", &job("fanuc", operations), &MemoryLoader::default(), &Silent).unwrap_err();
        assert_eq!(error.0.key.as_deref(), Some("setup[0].operation[1].of"), "{error}");
        error
    };
    let unknown = refused(&format!("{contour}{CHAMFER}of = \"rim\"\nwidth = 1\n"));
    assert!(unknown.code() == Code::JOB_REFERENCE && unknown.0.help.contains("`edge`"), "{unknown}");
    let twice = refused(&format!("{contour}{CHAMFER}of = \"edge\"\n{PLATE}\nwidth = 1\n"));
    assert_eq!(twice.code(), Code::JOB_SHAPE);
    refused(&format!("{contour}side = \"on\"\n{CHAMFER}of = \"edge\"\nwidth = 1\n"));
}

#[test]
fn a_chamfer_does_not_contradict_the_contour_that_it_names() {
    let contour = |keys: &str| format!("{CONTOUR}name = \"edge\"\n{PLATE}\ndepth = 6\n{keys}");
    let chamfer = |keys: &str| format!("{CHAMFER}of = \"edge\"\nwidth = 1\n{keys}\n");
    for (of, keys, key) in [
        ("", "side = \"inside\"", "side"),
        ("loops = \"outer\"\n", "loops = \"all\"", "loops"),
        ("stock_to_leave = 0.2\n", "stock_to_leave = 0", "stock_to_leave"),
    ] {
        let operations = format!("{}{}", contour(of), chamfer(keys));
        let job = job("fanuc", &operations);
        let error = run("job.toml", &job, &MemoryLoader::default(), &Silent).unwrap_err();
        assert_eq!(error.code(), Code::JOB_SHAPE, "{error}");
        assert_eq!(error.0.key, Some(format!("setup[0].operation[1].{key}")), "{error}");
        assert!(error.0.message.contains(&format!("`{key}` contradicts the operation that `of` names")));
    }
    // The same again is no contradiction, nor are fewer of its loops.
    let wall_below =
        |o: &Outcome| o.verdict.unchecked().any(|item| format!("{item:?}").contains("the wall below it"));
    for (of, keys) in
        [("stock_to_leave = 0.2\n", "stock_to_leave = 0.2\nside = \"outside\""), ("", "loops = \"outer\"")]
    {
        let outcome = cut("fanuc", &format!("{}{}", contour(of), chamfer(keys)));
        assert!(outcome.verdict.is_safe() && !wall_below(&outcome), "{:?}", outcome.verdict.found);
    }
    // Who refers to a chamfer refers to no wall that is compared.
    let named = format!("{CHAMFER}name = \"edge\"\n{PLATE}\nwidth = 0.5\n{}", chamfer(""));
    let outcome = cut("fanuc", &named);
    let told = outcome.verdict.unchecked().filter(|i| format!("{i:?}").contains("the wall below it"));
    assert_eq!(told.count(), 2);
}

#[test]
fn holes_of_a_face_are_chamfered_by_their_loops() {
    let outline = "outline = \"plate.dxf\"\nat = [-45, -25]\n";
    let run_with = |beside: f64, chamfer: &str| {
        let job = job("fanuc", &both(outline, 6.0, chamfer));
        run("job.toml", &job, &drawing(beside), &Silent)
    };
    for (loops, count) in [("all", 2), ("outer", 1), ("inner", 1)] {
        let outcome = run_with(16.0, &format!("width = 1\nloops = \"{loops}\"")).unwrap();
        assert!(outcome.verdict.is_safe(), "{loops}: {:?}", outcome.verdict.found);
        assert!(outcome.deviation.bores[1].worst() < 2e-3, "{loops}");
        let json: serde_json::Value = serde_json::from_str(&kinecut::job::plan_json(&outcome)).unwrap();
        assert_eq!(json["setups"][0]["chamfers"][0]["loops"].as_array().unwrap().len(), count, "{loops}");
    }
    // A wall so thin that the cutter comes to the edge of the hole.
    let thin = run_with(0.9, "width = 1\nloops = \"outer\"").unwrap_err();
    assert_eq!(thin.0.key.as_deref(), Some("setup[0].operation[1].loops"), "{thin}");
    assert!((thin.0.bound.unwrap().value - 1.55).abs() < 1e-9);
}

#[test]
fn what_makes_no_chamfer_is_refused_with_a_cure() {
    let key = |e: &Error| e.0.key.clone().unwrap_or_default();
    let under = |key: &str| format!("setup[0].operation[0].{key}");
    let value = |e: &Error| e.0.value.as_ref().unwrap().value;
    let bound = |e: &Error| e.0.bound.as_ref().unwrap().value;
    // The tip on the floor.
    let floor = refused(&format!("{PLATE}\nwidth = 0.5\ntip_clearance = 1\nwall_height = 1.2"));
    assert_eq!((floor.code(), key(&floor)), (Code::PLAN_VALUE, under("tip_clearance")));
    assert!(value(&floor) == 1.5 && bound(&floor) == 1.2, "{floor}");
    assert!(floor.0.help.contains("tip_clearance = 0.7 with width = 0.5"), "{floor}");
    let low = refused(&format!("{PLATE}\nwidth = 1\nwall_height = 0.9"));
    assert_eq!(key(&low), under("width"));
    assert!(low.0.help.contains("width = 0.7 with tip_clearance = 0.2"), "{low}");
    let none = refused(&format!("{PLATE}\nwidth = 1\nwall_height = 0.1"));
    assert_eq!(key(&none), under("wall_height"));
    // Lengths that are told to fit do.
    for fits in [
        "width = 0.5\ntip_clearance = 0.7\nwall_height = 1.2",
        "width = 0.7\ntip_clearance = 0.2\nwall_height = 0.9",
    ] {
        cut("fanuc", &format!("{CHAMFER}{PLATE}\n{fits}\n"));
    }
    // A cutter that is too small.
    let wide = refused(&format!("{PLATE}\nwidth = 5.8\ntip_clearance = 0.5"));
    assert_eq!((wide.code(), key(&wide)), (Code::PLAN_VALUE, under("width")));
    assert!((value(&wide) - 6.3).abs() < 1e-9 && (bound(&wide) - 4.9).abs() < 1e-9, "{wide}");
    assert!(wide.0.help.contains("width = 4.4"), "{wide}");
    // Room, tools, keys.
    let hole = refused("side = \"inside\"\ncircle = { diameter = 2.4 }\nwidth = 1");
    assert_eq!(hole.code(), Code::LEAD_ROOM, "{hole}");
    let small = refused("side = \"inside\"\ncircle = { diameter = 0.9 }\nwidth = 1");
    assert_eq!((small.code(), key(&small)), (Code::CUTTER_TOO_LARGE, under("tip_clearance")), "{small}");
    assert_eq!(key(&refused("circle = { diameter = 40 }\nwidth = 0")), under("width"));
    assert_eq!(
        key(&refused("circle = { diameter = 40 }\nwidth = 1\ntip_clearance = 0.1")),
        under("tip_clearance")
    );
    let mill = job("fanuc", &format!("{CHAMFER}{PLATE}\nwidth = 1\n")).replace("tool = 5", "tool = 1");
    let mill = run("job.toml", &mill, &MemoryLoader::default(), &Silent).unwrap_err();
    assert_eq!((mill.code(), key(&mill)), (Code::JOB_REFERENCE, under("tool")));
}

#[test]
fn edges_along_open_lines_have_their_width_on_every_control() {
    let bent = "polyline = [[-70, -20], [20, -20, 0.2], [40, 10], [40, 50]]";
    for control in ["sinumerik-840d", "heidenhain", "linuxcnc", "fanuc", "grbl"] {
        for (side, corners) in [("left", 2), ("right", 0)] {
            let contour = format!("{CONTOUR}name = \"step\"\nside = \"{side}\"\n{bent}\ndepth = 6\n");
            // By the name of the contour, and by a line of its own.
            let own = format!("side = \"{side}\"\n{bent}");
            for of in ["of = \"step\"", own.as_str()] {
                let outcome = cut(control, &format!("{contour}{CHAMFER}{of}\nwidth = 0.8\n"));
                let verdict = &outcome.verdict;
                assert!(verdict.is_safe(), "{control} {side}: {:?}", verdict.found);
                let edge = &outcome.deviation.bores[1];
                assert!(edge.ends > 500 && edge.worst() < 2e-3, "{control} {side}: {edge:?}");
                let webs = verdict.found.iter().filter(|f| f.code == Code::CORNERS_STAY).count();
                assert_eq!(webs > 0, corners > 0, "{control} {side}: {:?}", verdict.found);
            }
        }
    }
    // The edge lies on the side on which the cutter runs: 0.8 x 0.8 / 2 along 80 mm, and what runs out at the ends.
    let straight = "polyline = [[-40, 0.2], [40, 0.2]]";
    for side in ["left", "right"] {
        let contour = format!("{CONTOUR}name = \"step\"\nside = \"{side}\"\n{straight}\ndepth = 6\n");
        let plain = removed(&cut("fanuc", &contour));
        let broken = removed(&cut("fanuc", &format!("{contour}{CHAMFER}of = \"step\"\nwidth = 0.8\n")));
        let gone = broken - plain;
        assert!(gone > 0.32 * 80.0 && gone < 0.32 * 86.0, "{side}: {gone}");
    }
}

#[test]
fn edges_of_open_lines_say_their_side() {
    let line = "polyline = [[-40, 0], [40, 0]]\nwidth = 0.5\n";
    for (operation, key) in [
        (line.to_owned(), "side"),
        (format!("side = \"outside\"\n{line}"), "side"),
        ("side = \"left\"\ncircle = { diameter = 30 }\nwidth = 0.5\n".to_owned(), "side"),
        (format!("side = \"left\"\ncircle = {{ diameter = 30 }}\n{line}"), "polyline"),
    ] {
        let e = refused(&operation);
        assert!(e.0.key.as_deref().is_some_and(|k| k.ends_with(key)), "{operation}: {e} {:?}", e.0.key);
        assert!(!e.0.help.is_empty(), "{e}");
    }
    let other = format!(
        "{CONTOUR}name = \"step\"\nside = \"left\"\npolyline = [[-40, 0], [40, 0]]\ndepth = 6\n\
         {CHAMFER}of = \"step\"\nside = \"right\"\nwidth = 0.5\n"
    );
    let e = run("job.toml", &job("fanuc", &other), &MemoryLoader::default(), &Silent).unwrap_err();
    assert!(e.0.message.contains("the other side"), "{e}");
}

#[test]
fn the_edge_of_a_mesh_is_chamfered_like_its_outline_in_numbers() {
    let loader = MemoryLoader::default().with("plate.stl", super::contour::plate_with_hole());
    let of = |keys: &str| {
        let operation = format!("{CHAMFER}width = 0.5\nstart = [0, -10]\n{keys}");
        run("job.toml", &job("fanuc", &operation), &loader, &Silent)
    };
    let moves = |outcome: &Outcome| -> Vec<String> {
        outcome.setups[0].posted.text.lines().filter(|l| !l.contains('(')).map(str::to_owned).collect()
    };
    for (edge, numbers) in [
        ("[10, 3, 0]", "rectangle = { size = [20, 20] }\nside = \"inside\"\n"),
        ("[9.5, 9.6, 0.2]", "rectangle = { size = [20, 20] }\nside = \"inside\"\n"),
        ("[30, 3, 0]", "rectangle = { size = [60, 40] }\n"),
    ] {
        let found =
            of(&format!("outline = \"plate.stl\"\nedge_at = {edge}\n")).unwrap_or_else(|e| panic!("{e}"));
        let wanted = of(numbers).unwrap_or_else(|e| panic!("{e}"));
        assert_eq!(moves(&found), moves(&wanted), "{edge}");
        let json: serde_json::Value = serde_json::from_str(&kinecut::job::plan_json(&found)).unwrap();
        assert_eq!(json["setups"][0]["chamfers"][0]["top"], 0.0, "{json}");
        // Another refers to it, height and side too.
        let both = format!(
            "name = \"rim\"\noutline = \"plate.stl\"\nedge_at = {edge}\n{CHAMFER}width = 0.6\nstart = [0, -10]\nof = \"rim\"\n"
        );
        let second = of(&both).unwrap_or_else(|e| panic!("{e}"));
        assert!(moves(&second).len() > moves(&found).len(), "{edge}");
    }
    for (keys, words, key) in [
        ("edge_at = [0, 0, -5]", "no sharp level edge", "edge_at"),
        ("edge_at = [10, 0, -12]", "cannot be broken from above", "edge_at"),
        ("edge_at = [30, 0, -20]", "cannot be broken from above", "edge_at"),
        ("edge_at = [10, 0, 0]\nside = \"outside\"", "on the other side", "side"),
        ("edge_at = [10, 0, 0]\nsection = -5", "exclude each other", "edge_at"),
        ("edge_at = [10, 0, 1e9]", "", "edge_at[2]"),
    ] {
        let Err(e) = of(&format!("outline = \"plate.stl\"\n{keys}\n")) else { panic!("{keys}") };
        assert!(e.0.message.contains(words), "{keys}: {e}");
        assert!(e.0.key.as_deref().is_some_and(|k| k.ends_with(key)), "{keys}: {:?}", e.0.key);
    }
    let Err(e) = of("rectangle = { size = [20, 20] }\nedge_at = [10, 0, 0]\n") else { panic!("no mesh") };
    assert!(e.0.message.contains("only a mesh has edges at a point"), "{e}");
    // Beside the edges of another operation too, where it would mean nothing.
    for key in ["edge_at = [10, 0, 0]", "section = -5"] {
        let both = format!(
            "name = \"rim\"\nrectangle = {{ size = [20, 20] }}\n{CHAMFER}width = 0.6\nof = \"rim\"\n{key}\n"
        );
        let Err(e) = of(&both) else { panic!("{key}") };
        assert!(e.0.message.contains("only a mesh has"), "{e}");
    }
}
