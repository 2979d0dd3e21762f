//! Numbers that the documents give and no other test holds: each is computed here, and the sentence with it must be in
//! its document, word for word.

use std::path::Path;

use kinecut::geom::{InvoluteRecord, LensOrder, PlaneCurve};
use kinecut::holes::clearing::{Clearing, Disc};
use serde_json::{Value, json};

use crate::shell::{example, folder, kinecut, text};

fn document(name: &str) -> String {
    std::fs::read_to_string(Path::new(env!("CARGO_MANIFEST_DIR")).join("../..").join(name)).unwrap()
}

/// The sentence is in the document, whatever its line breaks.
fn says(name: &str, sentence: &str) {
    let flat = |t: &str| t.split_whitespace().collect::<Vec<_>>().join(" ");
    assert!(flat(&document(name)).contains(&flat(sentence)), "{name} does not say: {sentence}");
}

fn json_of(args: &[&str], input: &str) -> Value {
    let run = kinecut(args, input);
    serde_json::from_slice(&run.stdout).unwrap_or_else(|e| panic!("{args:?}: {e}\n{}", text(&run.stderr)))
}

/// The plate of docs/facing.md under a cutter of this radius; `more` are keys of the operation.
fn plate(radius: f64, more: Value) -> Value {
    let mut operation = json!({ "type": "face", "tool": 1, "depth": 0.5, "speed": 800, "feed_per_tooth": 0.1,
        "guard": 0, "exit_angle_min": 90,
        "outline": { "loops": [[[0, 0], [200, 0], [200, 120], [0, 120]]] } });
    operation.as_object_mut().unwrap().extend(more.as_object().unwrap().clone());
    let face = json!({ "operation": operation,
        "tool": { "number": 1, "type": "face-mill", "diameter": 2.0 * radius, "teeth": 5, "flute_length": 8 } });
    json_of(&["face", "-", "--json"], &face.to_string())
}

/// Bad length of the way chosen.
fn chosen(sheet: &Value) -> f64 {
    sheet["ways"][sheet["chosen"].as_u64().unwrap() as usize]["bad"].as_f64().unwrap()
}

#[test]
fn the_plate_of_the_page_on_faces() {
    let one = [62.5, 80.0, 100.0].map(|r| plate(r, json!({}))["optimum"]["value"].as_f64().unwrap());
    says("docs/facing.md", &format!("R 62.5 / 80 / 100 | {:.3} / {:.3} / {:.3} |", one[0], one[1], one[2]));
    let rows = [2, 3, 4].map(|n| chosen(&plate(40.0, json!({ "passes": { "rows": n } }))));
    says("docs/facing.md", &format!("optimised | {:.3} / {:.3} / {:.3} |", rows[0], rows[1], rows[2]));
    let frames = [10, 0, -20].map(|f| chosen(&plate(40.0, json!({ "passes": { "frames": f } }))));
    says(
        "docs/facing.md",
        &format!("20 mm inside | {:.0} / {:.0} / {:.0} |", frames[0], frames[1], frames[2]),
    );
}

#[test]
fn the_cover_of_the_gear_pump() {
    let sheet = json_of(&["face", &example("04_gear_pump_cover/face.toml"), "--compare", "--json"], "");
    let optimum = &sheet["optimum"];
    let number = |v: &Value| v.as_f64().unwrap();
    let always: f64 = optimum["irreducible"].as_array().unwrap().iter().map(|i| number(&i["length"])).sum();
    let three = sheet["ways"].as_array().unwrap().iter();
    let three = three.filter(|w| w["name"].as_str().unwrap().starts_with("3 best rows"));
    let three = three.map(|w| number(&w["bad"])).fold(f64::INFINITY, f64::min);
    says(
        "examples/04_gear_pump_cover/README.md",
        &format!(
            "{:.1} mm of edge get an exit angle below 90 degrees. Turned by {:.1} degrees it is {:.3} mm, and no placement of \
             one straight pass leaves less than {:.4} mm. Of these, {always:.1} mm no straight pass avoids: the rims of the \
             bolt holes, and parts of the outer edge and of the gear bores. Three rows leave {three:.1} mm.",
            number(&sheet["as_drawn"]["bad"]),
            number(&optimum["placement"]["turn"]),
            number(&optimum["value"]),
            number(&optimum["lower_bound"]),
        ),
    );
    says("docs/facing.md", &format!("at {:.3} mm with its true circles", number(&optimum["value"])));
}

/// The largest engagement of turns that start with a full circle of 10 mm, in a bore of 200 mm with a cutter of 40 mm [rad].
fn peak(curves: &[PlaneCurve]) -> f64 {
    let mut all = vec![PlaneCurve::from(InvoluteRecord::circle(10.0, 0.0).unwrap())];
    let first = all[0].length();
    all.extend(curves);
    let samples = kinecut::holes::engagement(&all, 20.0, Some(30.0), 2400).unwrap();
    samples.iter().filter(|s| s.s > first).map(|s| s.angle).fold(0.0, f64::max)
}

#[test]
fn turns_of_constant_engagement_and_of_constant_step() {
    let disc = |step: f64| Disc {
        inner: 10.0,
        inner_most: 10.0,
        outer: 79.0,
        cutter: 20.0,
        step,
        engagement: Some(60f64.to_radians()),
        psi: 0.0,
        resolution: None,
    };
    let kept = Clearing::ConstantEngagement(LensOrder::One).path(&disc(40.0)).unwrap();
    let most = peak(&kept.curves);
    assert!(most < 60.5f64.to_radians(), "{}", most.to_degrees());
    // The fewest turns of the involute whose peak is no higher.
    let even = (8..40).find(|&n| {
        let path = Clearing::Involute.path(&disc(69.0 / f64::from(n) * (1.0 + 1e-9))).unwrap();
        assert_eq!(path.turns, f64::from(n));
        peak(&path.curves) <= most
    });
    says(
        "docs/strategies.md",
        &format!(
            "constant engagement within 60° needs {} turns; the involute with the same peak needs {}.",
            kept.turns,
            even.unwrap()
        ),
    );
}

#[test]
fn the_paper_s_hole_by_every_strategy() {
    let sheet = json_of(&["hole", &example("12_compare/hole.toml"), "--compare", "--json"], "");
    let rows = sheet["comparison"]["rows"].as_array().unwrap();
    let time = |name: &str| {
        let row = rows.iter().find(|r| r["strategy"] == name).unwrap();
        row["figures"]["runs"][0]["time"].as_f64().unwrap()
    };
    says(
        "examples/12_compare/README.md",
        &format!(
            "(`constant-engagement-free`): {:.1} s instead of {:.1} s at 6 m/min",
            time("constant-engagement-free"),
            time("involute")
        ),
    );
    let touch = |i: usize| sheet["comparison"]["lead_ins"][i]["touch"].as_f64().unwrap();
    says(
        "docs/strategies.md",
        &format!(
            "touches 1 mm of allowance {:.2} rad before the wall (G2), {:.2} rad (G4), {:.2} rad (G6)",
            touch(0),
            touch(1),
            touch(2)
        ),
    );
}

#[test]
fn counts_in_the_readme() {
    let schema = json_of(&["schema", "job"], "");
    let points = schema["$defs"]["DrillPoint"]["oneOf"].as_array().unwrap().len();
    says("README.md", &format!("# {points} kinds of points"));
    let surfaces = json_of(&["surface", "--json"], "").as_array().unwrap().len();
    says("README.md", &format!("# {surfaces} surfaces, or your own file"));
    let manifest = document("Cargo.toml");
    let version =
        manifest.lines().find_map(|l| l.strip_prefix("rust-version = \"")).unwrap().trim_end_matches('"');
    says("README.md", &format!("With Rust {version} or newer"));
}

#[test]
fn zones_of_the_shaft_are_those_of_the_posted_program() {
    let folder = folder("shaft");
    let out = folder.display().to_string();
    let run = kinecut(&["run", &example("03_drill_through_shaft/job.toml"), "--out", &out], "");
    assert_eq!(run.status.code(), Some(0), "{}", text(&run.stdout));
    let program = std::fs::read_to_string(folder.join("SHAFT.ngc")).unwrap();
    std::fs::remove_dir_all(&folder).unwrap();
    let page = document("examples/03_drill_through_shaft/README.md");
    let rows: Vec<&str> = page.lines().filter(|l| l.contains("| Z ")).collect();
    assert_eq!(rows.len(), 3);
    for row in rows {
        for cell in row.split('|').map(str::trim).filter_map(|c| c.strip_prefix("Z ")) {
            let z: f64 = cell.replace('−', "-").parse().unwrap();
            let posted = |w: &str| w.strip_prefix('Z').and_then(|z| z.parse::<f64>().ok());
            let found = program.split_whitespace().filter_map(posted).any(|p| (p - z).abs() < 1e-9);
            assert!(found, "Z {z} of `{row}` is not in the program");
        }
    }
}

#[test]
fn three_turns_of_c_begin_at_the_end_of_its_travel() {
    let folder = folder("turns");
    std::fs::create_dir_all(&folder).unwrap();
    let machine = std::fs::read_to_string(example("05_machine_from_code/trunnion.toml")).unwrap();
    assert!(machine.contains("C = [-3600, 3600]"));
    let file = folder.join("machine.toml");
    std::fs::write(&file, machine.replace("C = [-3600, 3600]", "C = [-540, 540]")).unwrap();
    // A tool that leans by 30 degrees goes three times round; its first direction asks for C 0 or 180.
    let poses: String = (0..=108)
        .map(|k| {
            let (sin, cos) = f64::to_radians(10.0 * f64::from(k)).sin_cos();
            format!("X0 Y0 Z-400 I{:.9} J{:.9} K{:.9}\n", 0.5 * sin, -0.5 * cos, 0.75f64.sqrt())
        })
        .collect();
    let way = json_of(&["ik", &file.display().to_string(), "-", "--path", "--json"], &poses);
    std::fs::remove_dir_all(&folder).unwrap();
    let c = |i: usize| way["joints"][i]["C"].as_f64().unwrap();
    assert!((c(0) + 540.0).abs() < 1e-6 && (c(108) - 540.0).abs() < 1e-6, "{} {}", c(0), c(108));
    says(
        "docs/machines.md",
        "with C from -540 to 540 degrees, three turns whose first direction asks for C 0 or 180 must *start* at -540.",
    );
}

/// The optima of the golden polygons are held by a test of the planner; here their table is.
#[test]
fn the_table_of_polygons() {
    let golden: Value = serde_json::from_str(&document("crates/kinecut/tests/golden/burr.json")).unwrap();
    let polygons = &golden["polygons"];
    let optimum = |name: &str, guard: f64| {
        let all = polygons[name]["optima"].as_array().unwrap().iter();
        let mut own = all.filter(|o| o["guard_deg"] == guard && o["psi0_deg"] == 90);
        own.next().unwrap_or_else(|| panic!("{name} {guard}"))["value"].as_f64().unwrap()
    };
    for (shown, name) in [
        ("L bracket, R 50", "L_bracket"),
        ("U channel, R 62.5", "U_channel"),
        ("Z plate, R 62.5", "Z_plate"),
        ("C ring, R 50", "C_ring"),
        ("gear pump cover, R 50", "gear_pump_cover"),
        ("concave, 31 edges, R 62.5", "random_concave_31"),
        ("rectangle, R 50", "rectangle"),
    ] {
        says("docs/facing.md", &format!("| {shown} | {:.3} |", optimum(name, 0.0)));
    }
    let nearest = polygons["random_concave_31"]["nelder_mead_psi0_90_guard_0"]["best"].as_f64().unwrap();
    says("docs/facing.md", &format!("came nearer than {nearest:.3}."));
    let pairs = ["U_channel", "L_bracket", "gear_pump_cover"].map(|n| [optimum(n, 0.0), optimum(n, 2.0)]);
    let [u, l, cover] = pairs.map(|p| p.map(|v| format!("{v:.1}")));
    says(
        "docs/facing.md",
        &format!(
            "the U channel goes from {} to {} mm, the L bracket from {} to {}, the cover from {} to {}.",
            u[0], u[1], l[0], l[1], cover[0], cover[1]
        ),
    );
}

#[test]
fn the_torus_as_a_chain_of_cones() {
    let gallery = json_of(&["grazing", "--gallery", "--json"], "");
    let groups = gallery.as_array().unwrap().iter();
    let chain = groups.filter_map(|g| g["cones"][0].as_array().filter(|c| !c.is_empty())).next().unwrap();
    let off = |cones: u64| {
        let own = chain.iter().find(|c| c["cones"] == cones).unwrap();
        own["distance"].as_f64().unwrap()
    };
    says(
        "docs/grazing.md",
        &format!("4 cones {:.2} mm, 32 cones {:.3} mm, 128 cones {:.3} mm", off(4), off(32), off(128)),
    );
}

#[test]
fn the_times_of_figure_7() {
    let sheet = json_of(&["drill", &example("03_drill_through_shaft/figure_7.toml"), "--json"], "");
    let hole = &sheet["holes"][0];
    let number = |v: &Value| v.as_f64().unwrap();
    let [a, b, c] = [0, 1, 2].map(|i| number(&hole["zones"][i]["time"]));
    let (all, constant) = (number(&hole["time"]), number(&hole["constant_feed_time"]));
    says(
        "docs/drilling.md",
        &format!(
            "takes {a:.3} + {b:.3} + {c:.3} = {all:.3} s. At the one feed that is safe throughout, 0.2 mm/rev, it would take \
             {constant:.3} s."
        ),
    );
}
