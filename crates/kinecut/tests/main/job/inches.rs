//! Jobs in inches: the same plan as their twins in mm, programs in inches on every control, messages and report in inches.

use kinecut::base::{MemoryLoader, Silent};
use kinecut::job::report::of_job;
use kinecut::job::{Outcome, plan_json, run};
use kinecut::page::Block;

/// A job of all kinds of numbers, in a unit by its size in mm.
fn job(units: &str, control: &str, post: &str) -> String {
    let inch = units == "in";
    let l = |mm: f64| if inch { mm / 25.4 } else { mm };
    let (feed, speed) = (l(508.0), if inch { 120.0 / 0.3048 } else { 120.0 });
    let [x, y, z, top, d, r, point, corner, depth, step] =
        [50.8, 31.75, 12.7, 1.016, 9.525, 6.35, 38.1, 2.54, 5.08, 2.54].map(l);
    let (length, stick, size) = (l(25.4), l(35.56), l(6.5278));
    format!(
        r#"format = 1
units = "{units}"
material = "C45"
post = {{ control = "{control}"{post} }}
stock = {{ box = {{ min = [-{x}, -{y}, -{z}], max = [{x}, {y}, {top}] }} }}
simulate = {{ step = {step} }}
[[tool]]
number = 1
type = "face-mill"
diameter = {face}
flute_length = {z}
stickout = {stick}
teeth = 4
material = "carbide"
max_speed = 8000
[[tool]]
number = 2
type = "end-mill"
diameter = {d}
flute_length = {length}
stickout = {stick}
teeth = 3
material = "carbide"
[[tool]]
number = 3
type = "drill"
diameter = {size}
point_angle = 118
flute_length = {long}
stickout = {longer}
preset = [{{ material = "C45", speed = 1500, feed_per_rev = {rev} }}]
[[tool]]
number = 4
type = "drill"
diameter = {d}
point_angle = 90
flute_length = {length}
stickout = {stick}
[[setup]]
offset = "G54"
[[setup.operation]]
type = "face"
tool = 1
outline = "top"
depth = {top}
cutting_speed = {speed}
feed_per_tooth = {tooth}
[[setup.operation]]
type = "hole"
size = "{size}"
points = [[-{point}, 0], [{point}, 0]]
[[setup.operation]]
type = "pocket"
tool = 2
rectangle = {{ size = [{point}, {length}], corner = {r} }}
depth = {depth}
speed = 6000
feed = {feed}
[[setup.operation]]
type = "contour"
tool = 2
rectangle = {{ size = [{px}, {py}], corner = {corner} }}
depth = {z}
stepdown = {depth}
speed = 5000
feed = {feed}
tabs = {{ count = 3, width = {r}, height = {tab} }}
"#,
        face = l(50.8),
        long = l(45.72),
        longer = l(55.88),
        tooth = l(0.1),
        rev = l(0.12),
        px = l(91.44),
        py = l(53.34),
        tab = l(1.524),
    )
}

fn done(text: &str) -> Outcome {
    run("job.toml", text, &MemoryLoader::default(), &Silent).unwrap_or_else(|e| panic!("{e}"))
}

/// All numbers of a JSON text.
fn numbers(value: &serde_json::Value, all: &mut Vec<f64>) {
    match value {
        serde_json::Value::Number(n) => all.extend(n.as_f64()),
        serde_json::Value::Array(list) => list.iter().for_each(|v| numbers(v, all)),
        serde_json::Value::Object(map) => map.values().for_each(|v| numbers(v, all)),
        _ => {}
    }
}

fn plan(outcome: &Outcome) -> Vec<f64> {
    let mut all = Vec::new();
    numbers(&serde_json::from_str(&plan_json(outcome)).unwrap(), &mut all);
    all
}

#[test]
fn a_job_in_inches_is_the_job_in_mm() {
    // The same plan, and the same text where both are written in mm; without the pocket, of which each step hangs on the last bit
    // of those before.
    let without_pocket = |text: String| {
        let (before, rest) = text.split_once("[[setup.operation]]\ntype = \"pocket\"").unwrap();
        format!("{before}[[setup.operation]]{}", rest.split_once("[[setup.operation]]").unwrap().1)
    };
    let mm = done(&without_pocket(job("mm", "fanuc", "")));
    let inch = done(&without_pocket(job("in", "fanuc", ", units = \"mm\"")));
    let (a, b) = (plan(&mm), plan(&inch));
    assert!(a.len() > 100 && a.len() == b.len(), "{} {}", a.len(), b.len());
    for (a, b) in a.iter().zip(&b) {
        // Half of a thousandth is rounded either way; no unit is as near to another.
        assert!((a - b).abs() <= 1e-4 * a.abs().max(1.0), "{a} {b}");
    }
    let of =
        |outcome: &Outcome| outcome.setups[0].posted.text.lines().filter(|l| !l.starts_with('(')).count();
    assert_eq!(of(&mm), of(&inch));
}

#[test]
fn programs_in_inches_run_as_planned_on_every_control() {
    for (control, word, not) in [
        ("fanuc", "G17 G20 G40", "G21"),
        ("linuxcnc", "G17 G20 G40", "G21"),
        ("grbl", "G17 G20 G40", "G21"),
        ("sinumerik-840d", "G700", "G710"),
        ("heidenhain", "BEGIN PGM JOB INCH", " MM"),
    ] {
        let outcome = done(&job("in", control, ""));
        let text = &outcome.setups[0].posted.text;
        assert!(text.contains(word) && !text.contains(not), "{control}: {}", &text[..300]);
        // One step of the last decimal and the chords of what becomes lines.
        let largest = outcome.setups[0].read_back.largest;
        assert!(largest < 0.004, "{control}: {largest}");
        assert!(outcome.verdict.is_safe(), "{control}: {:?}", outcome.verdict.found);
        // 508 mm/min.
        let feed = if control == "heidenhain" { "F200" } else { "F20" };
        assert!(text.contains(feed), "{control}");
        assert!(
            text.lines().any(|l| l.contains("DIAMETER 0.375") || l.contains("diameter 0.375")),
            "{control}"
        );
    }
}

#[test]
fn messages_and_report_are_in_inches() {
    let text = job("in", "fanuc", "").replace("diameter = 0.375", "diameter = -0.375");
    let error = run("job.toml", &text, &MemoryLoader::default(), &Silent).map(|_| ()).unwrap_err();
    let value = error.0.value.clone().unwrap();
    assert!((value.value + 0.375).abs() < 1e-9 && value.unit == "in", "{error:?}");
    // Corners of 90 inches.
    let text = job("in", "fanuc", "").replacen("corner = ", "corner = 9", 1);
    let error =
        run("job.toml", &text, &MemoryLoader::default(), &Silent).map(|_| ()).unwrap_err().to_string();
    assert!(!error.contains("mm"), "{error}");
    let outcome = done(&job("in", "fanuc", ""));
    let report = of_job(&outcome);
    assert!(report.inches);
    let mut seen = 0;
    for section in &report.sections {
        for block in &section.blocks {
            let texts: Vec<String> = match block {
                Block::Text(text) | Block::Heading(text) => vec![text.clone()],
                Block::List(list) => list.clone(),
                Block::Facts(facts) => facts.iter().flat_map(|f| [f.value.clone(), f.note.clone()]).collect(),
                Block::Table(table) => {
                    let heads = table.columns.iter().map(|c| format!("{} {}", c.title, c.unit));
                    let cells = table.rows.iter().flat_map(|r| &r.cells).map(|c| c.text.clone());
                    heads.chain(cells).chain([table.caption.clone()]).chain(table.notes.clone()).collect()
                }
                _ => Vec::new(),
            };
            for text in texts {
                let mm = text
                    .split(|c: char| !(c.is_alphanumeric() || c == '/'))
                    .any(|word| word.starts_with("mm"));
                assert!(!mm, "{}: {text}", section.title);
                seen += 1;
            }
        }
    }
    assert!(seen > 100, "{seen}");
    assert!(
        outcome.verdict.found.iter().all(|f| !f.to_string().contains(" mm")),
        "{:?}",
        outcome.verdict.found
    );
}

/// The files of a job, each in a unit of its own.
#[test]
fn machines_cutting_data_and_meshes_say_their_units() {
    let block = |size: f64| {
        let corners = [[0.0, 0.0, -size], [2.0 * size, size, 0.0]];
        box_stl(corners)
    };
    let job = |units: &str, stock: &str| {
        let depth = if units == "in" { 0.1 } else { 2.54 };
        format!(
            "format = 1\nunits = \"{units}\"\nmaterial = \"C45\"\ncutting = \"cutting.toml\"\nmachine = \"machine.toml\"\n\
             post = {{ control = \"fanuc\" }}\nstock = {{ mesh = \"{stock}\" }}\n\
             tools = \"tools.toml\"\n[[setup]]\noffset = \"G54\"\n[[setup.operation]]\ntype = \"face\"\ntool = 1\n\
             outline = {{ loops = [ [{corners}] ] }}\ndepth = {depth}\n",
            corners = if units == "in" {
                "[0, 0], [2, 0], [2, 1], [0, 1]"
            } else {
                "[0, 0], [50.8, 0], [50.8, 25.4], [0, 25.4]"
            },
        )
    };
    let tools = "[[tool]]\nnumber = 1\ntype = \"face-mill\"\ndiameter = 50.8\nflute_length = 10\nteeth = 4\n\
        stickout = 40\nmaterial = \"carbide\"\n";
    let cutting = "units = \"in\"\n[[cutting]]\nmaterial = \"C45\"\ntool = \"face-mill\"\ndiameter = [1.9, 2.1]\n\
        cutting_speed = 500\nfeed_per_tooth = 0.004\n";
    let machine = "units = \"in\"\ntravel = { X = [-20, 20], Y = [-10, 10], Z = [-20, 0] }\ndynamics = { rapid = 800, acceleration = 100 }\n\
        code = \"2103\"\n";
    let loader = MemoryLoader::default()
        .with("tools.toml", tools)
        .with("cutting.toml", cutting)
        .with("machine.toml", machine)
        .with("inch.stl", block(1.0))
        .with("mm.stl", block(25.4));
    let done = |units: &str, stock: &str| {
        run("job.toml", &job(units, stock), &loader, &Silent).unwrap_or_else(|e| panic!("{e}"))
    };
    let (inch, mm) = (done("in", "inch.stl"), done("mm", "mm.stl"));
    for outcome in [&inch, &mm] {
        let volume = 2.0 * 25.4_f64.powi(3);
        assert!(
            (outcome.simulation.raw_volume - volume).abs() < 0.01 * volume,
            "{}",
            outcome.simulation.raw_volume
        );
        // 500 ft/min on 2 in, 4 teeth of 0.004 in.
        let speed = 500.0 * 0.3048 / (std::f64::consts::PI * 0.0508);
        let text = &outcome.setups[0].posted.text;
        let rpm: f64 = text
            .split(" S")
            .chain(text.split("\nS"))
            .filter_map(|t| t.split(' ').next()?.parse().ok())
            .next()
            .unwrap();
        assert!((rpm - speed).abs() < 2.0, "{rpm} {speed}");
        let travel = outcome.job.machine.as_ref().unwrap().travel('X').unwrap();
        assert!((travel[1] - 508.0).abs() < 1e-9, "{travel:?}");
    }
    // A tool file in mm is told in mm, a job in inches in inches.
    let wrong = MemoryLoader::default()
        .with("tools.toml", tools.replace("50.8", "-50.8"))
        .with("cutting.toml", cutting)
        .with("machine.toml", machine)
        .with("inch.stl", block(1.0));
    let error = run("job.toml", &job("in", "inch.stl"), &wrong, &Silent).map(|_| ()).unwrap_err().0;
    let value = error.value.clone().unwrap();
    assert!(
        error.place.as_ref().unwrap().file == "tools.toml" && value.value == -50.8 && value.unit == "mm",
        "{error:?}"
    );
    let wrong = MemoryLoader::default()
        .with("tools.toml", tools)
        .with("cutting.toml", cutting.replace("0.004", "-0.004"))
        .with("machine.toml", machine)
        .with("mm.stl", block(25.4));
    let error = run("job.toml", &job("mm", "mm.stl"), &wrong, &Silent).map(|_| ()).unwrap_err().0;
    let value = error.value.clone().unwrap();
    assert!(
        error.place.as_ref().unwrap().file == "cutting.toml" && (value.value + 0.004).abs() < 1e-12,
        "{error:?}"
    );
    assert_eq!(value.unit, "in");
}

/// A closed box as STL text.
fn box_stl([low, high]: [[f64; 3]; 2]) -> Vec<u8> {
    let corner = |i: usize| [0, 1, 2].map(|axis| if i >> axis & 1 == 0 { low[axis] } else { high[axis] });
    let faces = [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]];
    let mut text = String::from("solid box\n");
    for [a, b, c, d] in faces {
        for triangle in [[a, b, c], [a, c, d]] {
            text.push_str("facet normal 0 0 0\nouter loop\n");
            for [x, y, z] in triangle.map(corner) {
                text.push_str(&format!("vertex {x} {y} {z}\n"));
            }
            text.push_str("endloop\nendfacet\n");
        }
    }
    (text + "endsolid box\n").into_bytes()
}

/// Blocks of a person's own at the start say the unit of the program.
#[test]
fn a_template_says_inches() {
    let run_with = |start: &str| {
        let loader = MemoryLoader::default().with("start.txt", start);
        let text = job("in", "fanuc", ", start = \"start.txt\"");
        run("job.toml", &text, &loader, &Silent).map(|outcome| outcome.setups[0].posted.text.to_string())
    };
    let told = |start: &str| run_with(start).unwrap_err().to_string();
    assert!(told("G90 G17 G21 G40 G49 G80").contains("the program is in inches"), "{}", told("G90 G21"));
    assert!(told("G90 G17 G40").contains("G20"));
    let text = run_with("( {{ units }} {{ tools[1].diameter }} )\nG90 G17 G20 G40 G49 G80").unwrap();
    assert!(text.contains("( in 0.375"), "{}", &text[..200]);
}
