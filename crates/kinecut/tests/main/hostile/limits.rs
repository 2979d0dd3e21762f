//! What large but right jobs get, and what findings about them say.

use crate::common::planned::drillings;
use std::path::Path;
use std::sync::atomic::{AtomicBool, Ordering};

use kinecut::base::{Code, MemoryLoader, Progress, Silent};
use kinecut::job::{Heading, Outcome};
use kinecut::verbs::drill::plan_drill_sheet;
use kinecut::verbs::face::{SheetWants, plan_face_sheet};
use kinecut::verbs::hole::read_holes;
use kinecut_cases::cases;

const HEAD: &str = r#"format = 1
stock = { box = { min = [-30, -30, -10], max = [30, 30, 0] } }
post = { control = "linuxcnc", program = "small" }
simulate = { step = 1 }
[[tool]]
number = 1
type = "drill"
diameter = 3
point_angle = 118
flute_length = 22
"#;

const SETUP: &str = "[[setup]]\noffset = \"G54\"\n";

/// A drill operation; `more` are its own keys.
fn drill(more: &str) -> String {
    format!(
        "[[setup.operation]]\ntype = \"drill\"\ntool = 1\nspeed = 1000\nfeed_per_rev = {{ steady = 0.1 }}\n{more}\n"
    )
}

fn run(job: &str, files: &MemoryLoader) -> Outcome {
    kinecut::job::run("job.toml", job, files, &Silent).unwrap()
}

/// A closed block as STL, of this size to all sides of the Z axis, 10 deep.
fn block(half: i32) -> String {
    let corner = |i: usize| [[-half, half][i & 1], [-half, half][i >> 1 & 1], [-10, 0][i >> 2 & 1]];
    let faces = [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]];
    let mut text = String::from("solid block\n");
    for [a, b, c, d] in faces {
        for triangle in [[a, b, c], [a, c, d]] {
            text += "facet normal 0 0 0\nouter loop\n";
            for [x, y, z] in triangle.map(corner) {
                text += &format!("vertex {x} {y} {z}\n");
            }
            text += "endloop\nendfacet\n";
        }
    }
    text + "endsolid block\n"
}

#[test]
fn a_pattern_of_thousands_of_holes_is_planned() {
    let side = cases(41, 101) as usize;
    let grid = format!("grid = {{ at = [-25, -25], step = [0.5, 0.5], count = [{side}, {side}] }}");
    let job = format!("{HEAD}{SETUP}{}", drill(&format!("depth = 5\npattern = {{ {grid} }}")));
    let job = job.replace("step = 1 }", "step = 4 }").replace("diameter = 3", "diameter = 0.4");
    let outcome = run(&job, &MemoryLoader::default());
    assert_eq!(drillings(&outcome.setups[0].planned)[0].holes.len(), side * side);
}

#[test]
fn drilled_and_reamed_places_are_each_measured_where_they_are() {
    // The holes of the drill are gone, those of the reamer are there; one is only drilled.
    let reamer = HEAD.replace("number = 1", "number = 2").replace("diameter = 3", "diameter = 4");
    let reamer = &reamer[reamer.find("[[tool]]").unwrap()..];
    let grid =
        |n: usize| format!("pattern = {{ grid = {{ at = [-20, -20], step = [8, 8], count = [{n}, 2] }} }}");
    let job = format!(
        "{HEAD}{reamer}{SETUP}{}{}",
        drill(&format!("depth = 5\n{}", grid(4))),
        drill(&format!("depth = 6\nmethod = \"reaming\"\npre_hole = {{ diameter = 3 }}\n{}", grid(3)))
            .replace("tool = 1", "tool = 2")
    );
    let outcome = run(&job.replace("step = 1 }", "step = 0.5 }"), &MemoryLoader::default());
    let bores = &outcome.deviation.bores;
    let replaced: Vec<bool> = bores.iter().map(|m| m.replaced).collect();
    assert_eq!(replaced.len(), 14);
    assert_eq!(replaced.iter().filter(|r| **r).count(), 6, "{replaced:?}");
    assert!(bores.iter().all(|m| m.replaced || m.ends > 0), "{bores:?}");
}

#[test]
fn what_nothing_is_compared_with_is_listed_where_a_job_has_it() {
    let shape = |method: &str| {
        let job = format!(
            "{HEAD}{SETUP}{}",
            drill(&format!("depth = 1\npoints = [[0, 0]]\nmethod = \"{method}\""))
        );
        let outcome = run(&job, &MemoryLoader::default());
        let groups = outcome.verdict.not_checked.into_iter().filter(|g| g.heading == Heading::Shape);
        groups.flat_map(|g| g.items).filter(|i| i.what.contains("compared with nothing")).collect::<Vec<_>>()
    };
    let items = shape("centring");
    assert_eq!(items.len(), 1, "{items:?}");
    assert!(items[0].what.contains("centre drill") && !items[0].lines.is_empty(), "{:?}", items[0]);
    assert!(shape("drilling").is_empty());
}

#[test]
fn stock_that_nothing_cut_is_found_at_what_wanted_it_gone() {
    let job = format!(
        "design = {{ mesh = \"part.stl\", tolerance = 0.1 }}\n{HEAD}{SETUP}{}",
        drill("depth = 5\npoints = [[0, 0]]")
    );
    let outcome = run(&job, &MemoryLoader::default().with("part.stl", block(20)));
    let left = outcome.verdict.found.iter().find(|f| f.code == Code::STOCK_LEFT).unwrap();
    let place = left.place.as_ref().unwrap();
    assert_eq!((place.file.as_str(), place.line), ("job.toml", 1), "{left}");
    assert!(!left.help.is_empty(), "{left}");
}

#[test]
fn a_sheet_in_klartext_has_the_raw_part_only_where_it_is_known() {
    let drilling = |more: &str| {
        let text = format!(
            r#"{{"tool": {{"number": 1, "type": "drill", "diameter": 10, "flute_length": 80}}, "post": {{"control": "heidenhain"}},
            {more} "operation": {{"type": "drill", "tool": 1, "depth": 6, "speed": 900, "feed_per_rev": {{"steady": 0.2}}}}}}"#
        );
        let table = read_holes("d.json", &text).unwrap().item(0).unwrap();
        plan_drill_sheet(&table, false, &MemoryLoader::default().with("part.stl", block(20))).unwrap().program
    };
    let text = r#"{"tool": {"number": 1, "type": "face-mill", "diameter": 80, "teeth": 5, "flute_length": 8},
        "post": {"control": "heidenhain"}, "operation": {"type": "face", "tool": 1, "depth": 0.5, "speed": 800,
        "feed_per_tooth": 0.1, "outline": {"loops": [[[0, 0], [60, 0], [60, 40], [0, 40]]]}}}"#;
    let table = read_holes("f.json", text).unwrap().item(0).unwrap();
    let wants = SheetWants { compare: true, ..SheetWants::default() };
    let face = plan_face_sheet(&table, wants, &MemoryLoader::default(), &Silent).unwrap().program;
    for unknown in [drilling(""), face] {
        assert!(!unknown.contains("5000") && !unknown.contains("BLK FORM 0."), "{unknown}");
        assert!(unknown.lines().any(|l| l.contains(';') && l.contains("BLK FORM left out")), "{unknown}");
    }
    let known = drilling(r#""part": {"mesh": "part.stl", "at": [5, 0, 0]},"#);
    assert!(known.contains("BLK FORM 0.1 Z X-25 Y-20 Z-10"), "{known}");
    assert!(known.contains("BLK FORM 0.2 X+15 Y+20 Z+0") && !known.contains("left out"), "{known}");
}

/// Cancelled as soon as a stage begins.
struct StopAt {
    stage: &'static str,
    reached: AtomicBool,
}

impl Progress for StopAt {
    fn stage(&self, name: &str, _: u64) {
        if name == self.stage {
            self.reached.store(true, Ordering::Relaxed);
        }
    }

    fn advance(&self, _: u64) {}

    fn cancelled(&self) -> bool {
        self.reached.load(Ordering::Relaxed)
    }
}

#[test]
fn a_run_is_cancelled_in_every_stage_and_writes_nothing() {
    let folder = std::env::temp_dir().join(format!("kinecut-cancelled-{}", std::process::id()));
    let (job, out) = (folder.join("job.toml"), folder.join("out"));
    let example = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../examples/02_blind_bore/job.toml");
    let text = std::fs::read_to_string(example).unwrap();
    assert!(text.contains("step = 0.15"));
    std::fs::create_dir_all(&folder).unwrap();
    std::fs::write(&job, text.replace("step = 0.15", "step = 0.6")).unwrap();
    for stage in ["plan", "stock", "cut", "surface", "compare", "report"] {
        let progress = StopAt { stage, reached: AtomicBool::new(false) };
        let error = kinecut::run(&job, &out, &progress).err().unwrap();
        assert_eq!((error.code(), progress.cancelled()), (Code::CANCELLED, true), "{stage}");
        assert!(!out.exists(), "{stage}");
    }
    std::fs::remove_dir_all(&folder).unwrap();
}
