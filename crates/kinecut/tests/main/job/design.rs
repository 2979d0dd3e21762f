//! Regions of a design with limits of their own.

use glam::DVec3;
use kinecut::base::{Code, Error, MemoryLoader, Severity, Silent};
use kinecut::geom::{Mesh, write_stl};
use kinecut::job::{Outcome, report};

use super::fixtures::{found, line, value};

/// A block of 60 x 40 x 12 mm with a step: 3 mm lower from X 20 on.
fn step() -> Mesh {
    let outline = [[0.0, -12.0], [60.0, -12.0], [60.0, -3.0], [20.0, -3.0], [20.0, 0.0], [0.0, 0.0]];
    let at = |y: f64| outline.map(|[x, z]| DVec3::new(x, y, z));
    let vertices = [at(0.0), at(40.0)].concat();
    let mut triangles = Vec::new();
    // Its ends, and a side for each line of the outline.
    for [a, b, c] in [[0, 1, 2], [0, 2, 3], [0, 3, 5], [3, 4, 5]] {
        triangles.extend([[a, b, c], [a + 6, c + 6, b + 6]]);
    }
    for i in 0..6 {
        let j = (i + 1) % 6;
        triangles.extend([[i, i + 6, j + 6], [i, j + 6, j]]);
    }
    let mesh = Mesh { vertices, triangles };
    mesh.check_closed().unwrap();
    assert!((mesh.volume() - 40.0 * (60.0 * 12.0 - 40.0 * 3.0)).abs() < 1e-9);
    mesh
}

/// The step milled by 8 mm, 0.05 mm too deep, with 0.2 mm left at the wall.
fn run(regions: &str) -> Result<Outcome, Error> {
    run_in(60.0, regions)
}

/// The same in a block that ends at this X.
fn run_in(length: f64, regions: &str) -> Result<Outcome, Error> {
    let text = format!(
        r#"format = 1
stock = {{ box = {{ min = [0, 0, -12], max = [{length}, 40, 0] }} }}
simulate = {{ step = 0.5 }}
post = {{ control = "linuxcnc" }}
[design]
mesh = "step.stl"
tolerance = 0.03
{regions}
[[tool]]
number = 1
type = "end-mill"
diameter = 8
flute_length = 20
[[setup]]
offset = "G54"
program = {{ file = "P.ngc" }}
"#
    );
    let mut program = "G17 G21 G90 G94 G54\nT1 M6\nG43\nS3000 M3\nG0 X64 Y-10 Z20\nG0 Z-3.05\n".to_owned();
    for x in [62.0, 56.0, 50.0, 44.0, 38.0, 32.0, 26.0, 24.2] {
        program.push_str(&format!("G0 X{x}\nG1 Y50 F900\nG0 Y-10\n").replace("G0 Y-10", "G1 Y-10"));
    }
    program.push_str("G0 Z20\nM2\n");
    let loader = MemoryLoader::default().with("step.stl", write_stl(&step())).with("P.ngc", program);
    kinecut::job::run("job.toml", &text, &loader, &Silent)
}

const FLOOR: &str = "[[design.region]]\nname = \"floor\"\nat = [[40, 20, -3]]\ngouge = 0.06\nrest = 0.25\n";

#[test]
fn each_region_has_its_own_limits() {
    // Without regions: too deep, and stock left.
    let done = run("").unwrap();
    let [gouge, left] = [Code::WALL_GOUGED, Code::STOCK_LEFT].map(|code| {
        let all = found(&done, code);
        assert_eq!(all.len(), 1, "{all:?}");
        (all[0].message.clone(), value(all[0]))
    });
    assert_eq!(gouge.0, "the part is cut into the design");
    assert!((gouge.1 - 0.05).abs() < 1e-5 && (left.1 - 0.2).abs() < 1e-5, "{gouge:?} {left:?}");
    assert!(report::of_job(&done).sections.iter().all(|s| s.title != "Design by region"));

    // The floor may be as deep, the wall may have as much.
    let wall = |rest: f64| {
        format!(
            "{FLOOR}[[design.region]]\nname = \"wall\"\nat = [[20, 20, -1.5]]\ngouge = 0.01\nrest = {rest}\n"
        )
    };
    let within = run(&wall(0.21)).unwrap();
    assert!(within.verdict.is_safe(), "{:?}", within.verdict.found);
    let claims: Vec<&str> = within.deviation.proven.iter().map(String::as_str).collect();
    assert!(claims[0].starts_with("outside of all regions the part lies within "), "{claims:?}");
    assert!(claims[1].starts_with("at `floor` the part lies within ") && claims[2].starts_with("at `wall`"));
    let [elsewhere, floor, wall_measure] = &within.deviation.regions[..] else { panic!() };
    assert!(elsewhere.ends > 1000 && elsewhere.gouge.depth.max(elsewhere.left.depth) < 1e-5);
    assert!((floor.gouge.depth - 0.05).abs() < 1e-5 && floor.ends > 1000, "{floor:?}");
    assert!((wall_measure.left.depth - 0.2).abs() < 1e-5 && wall_measure.gouge.depth == 0.0);

    // A little less, and it is the wall that has too much; nothing of the floor is wrong.
    let done = run(&wall(0.19)).unwrap();
    assert!(found(&done, Code::WALL_GOUGED).is_empty());
    let all = found(&done, Code::STOCK_LEFT);
    assert!(all.len() == 1 && all[0].message == "at `wall` stock is left on the design", "{all:?}");
    assert!((value(all[0]) - 0.2).abs() < 1e-5 && line(all[0]) == "G1 Y50 F900", "{}", all[0]);
    // The colours show the limits of each, and the table its answer.
    let report = report::of_job(&done);
    assert!(report.part.as_ref().unwrap().relative);
    let section = report.sections.iter().find(|s| s.title == "Design by region").unwrap();
    let text = format!("{section:?}");
    assert!(["elsewhere", "within", "stock is left"].iter().all(|word| text.contains(word)), "{text}");
    let largest = done.deviation.largest.unwrap();
    assert!((largest.deviation - 0.2).abs() < 1e-5 && largest.tolerance == 0.19, "{largest:?}");
}

#[test]
fn a_region_that_no_line_ends_near_is_a_doubt() {
    // The block ends 10 mm before the far side of the design: all of it is nearer to another face.
    let far = "[[design.region]]\nname = \"far side\"\nat = [[60, 20, -8]]\n";
    let done = run_in(50.0, far).unwrap();
    let doubts = found(&done, Code::NOT_MEASURED);
    assert!(doubts.len() == 1 && doubts[0].severity == Severity::Doubt, "{doubts:?}");
    assert!(
        doubts[0].message.starts_with("region `far side` of the design could not be measured"),
        "{}",
        doubts[0]
    );
    assert!(done.deviation.proven.iter().all(|claim| !claim.contains("far side")));
    assert!(found(&run(far).unwrap(), Code::NOT_MEASURED).is_empty());
}

#[test]
fn wrong_regions_are_named() {
    let region = |more: &str| format!("[[design.region]]\nname = \"a\"\n{more}");
    for (text, key, what) in [
        (region("at = [[40, 20, 9]]"), "design.region[0].at[0]", "no face of the design is near"),
        (region("at = []"), "design.region[0].at", "no point names a face of `a`"),
        (region("at = [[40, 20, -3]]\ngouge = -1"), "design.region[0].gouge", ""),
        (region("at = [[40, 20, -3]]\nangle = 200"), "design.region[0].angle", ""),
        (
            format!("{FLOOR}{}", region("at = [[30, 20, -3]]")),
            "design.region[1].at[0]",
            "belongs to `floor` already",
        ),
        // With edges of 90 degrees as smooth it is all one face.
        (
            format!("{FLOOR}{}", region("at = [[0, 20, -6]]\nangle = 100")),
            "design.region[1].at[0]",
            "`floor` already",
        ),
    ] {
        let error = run(&text).unwrap_err();
        assert_eq!(error.0.key.as_deref(), Some(key), "{error}");
        assert!(error.0.message.contains(what), "{error}");
    }
}
