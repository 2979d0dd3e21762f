//! Every number of every schema, replaced by what hurts: nothing panics, hangs or asks for more than the budget.
//!
//! What is counted: steps of progress, bytes announced to the gate, and the most memory that the process really had. The
//! clock is a guard against hanging only; the weekly form holds each number to ten seconds, too.
//!
//! An executable of its own: bytes and memory are those of a whole process, and other tests beside it would count.

#![allow(clippy::unwrap_used, reason = "a test panics when it fails")]

#[allow(dead_code, reason = "no counts here")]
#[path = "every_number/numbers.rs"]
mod numbers;

use std::sync::Mutex;
use std::sync::atomic::{AtomicU64, Ordering};
use std::time::{Duration, Instant};

use kinecut::base::{MemoryLoader, Progress, Result, Silent, bytes_asked};
use kinecut::job::TextItems;
use kinecut::job::file::{contour_schema, machine_schema, outline_schema, schema, surface_schema};
use kinecut::verbs::drill::plan_drill_sheet;
use kinecut::verbs::envelope::{ENVELOPE_LIST, EnvelopeTable, envelope_schema, envelope_sheets};
use kinecut::verbs::face::{SheetWants, plan_face_sheet};
use kinecut::verbs::grazing::{GRAZING_LIST, GrazingTable, grazing_schema, grazing_sheet};
use kinecut::verbs::hole::{HoleTable, compare_hole, hole_schema, plan_hole, read_holes};
use serde_json::{Value, json};

use kinecut_cases::weekly;
use numbers::{places, with};

/// Bytes that one number may ask the gate for, and that the process may have.
const MEMORY: u64 = 2_000_000_000;
/// Steps of progress that one number may take.
const STEPS: u64 = 50_000_000;

fn hurting() -> [Value; 5] {
    [json!(0), json!(-1), json!(1e-300), json!(1e300), json!(2_147_483_647)]
}

/// Counts steps.
#[derive(Default)]
struct Counted(AtomicU64);

impl Progress for Counted {
    fn stage(&self, _: &str, _: u64) {}
    fn advance(&self, steps: u64) {
        self.0.fetch_add(steps, Ordering::Relaxed);
    }
}

/// What runs now, and since when.
static NOW: Mutex<Option<(Instant, String)>> = Mutex::new(None);

/// A number that hangs would say nothing: it ends the process with its name.
#[allow(clippy::exit, clippy::print_stderr, reason = "nobody else can stop work that does not end")]
fn guard() {
    std::thread::Builder::new()
        .spawn(|| {
            loop {
                std::thread::sleep(Duration::from_secs(1));
                if let Some((since, what)) = &*NOW.lock().unwrap()
                    && since.elapsed() > Duration::from_secs(120)
                {
                    eprintln!("hangs: {what}");
                    std::process::exit(101);
                }
            }
        })
        .unwrap();
}

/// Most memory of the process so far [bytes]; zero where the system does not say.
fn peak() -> u64 {
    let status = std::fs::read_to_string("/proc/self/status").unwrap_or_default();
    let line = status.lines().find_map(|l| l.strip_prefix("VmHWM:"));
    line.and_then(|l| l.split_whitespace().next()?.parse::<u64>().ok()).map_or(0, |kb| kb * 1024)
}

/// Runs a document with each number replaced; how many cases there were, and how many of them were refused.
fn every(
    name: &str,
    schema: &Value,
    base: &Value,
    run: impl Fn(&Value, &dyn Progress) -> Result<()>,
) -> [usize; 2] {
    run(base, &Silent).unwrap_or_else(|e| panic!("{name}: the base itself is refused: {e}"));
    let places = places(schema, base);
    let weekly = weekly();
    let (mut cases, mut refused) = (0, 0);
    for place in &places {
        for value in hurting() {
            let what = format!("{name}: {place:?} = {value}");
            *NOW.lock().unwrap() = Some((Instant::now(), what.clone()));
            let (asked, begin, steps) = (bytes_asked(), Instant::now(), Counted::default());
            let result = run(&with(base, place, &value), &steps);
            *NOW.lock().unwrap() = None;
            cases += 1;
            if let Err(error) = result {
                refused += 1;
                assert!(error.to_string().len() < 1000, "{what}: {error}");
            }
            assert!(bytes_asked() - asked < MEMORY, "{what} asks for {} bytes", bytes_asked() - asked);
            assert!(steps.0.into_inner() < STEPS, "{what} takes too many steps");
            assert!(peak() < MEMORY, "{what} has taken {} bytes", peak());
            let took = begin.elapsed();
            assert!(!weekly || took < Duration::from_secs(10), "{what} takes {took:?}");
        }
    }
    assert!(places.len() > 5, "{name}: {} numbers", places.len());
    [cases, refused]
}

fn toml(text: &str) -> Value {
    serde_json::to_value(toml::from_str::<toml::Value>(text).unwrap()).unwrap()
}

fn toml_text(document: &Value) -> String {
    toml::to_string(document).unwrap()
}

const JOB: &str = r#"
format = 1
stock = { box = { min = [-16, -16, -5], max = [16, 16, 0] } }
drilled = [{ at = [12, 12], diameter = 2, top = 0, bottom = -5 }]
post = { control = "sinumerik-840d", decimals = 4 }
simulate = { step = 2.0 }
machine = { code = "2103", travel = { X = [-400, 400] }, dynamics = { rapid = 30000, max_speed = 12000, interpolator = "junction-deviation" } }
[[holder]]
name = "h"
segments = [{ height = 20, lower_diameter = 30, upper_diameter = 40 }]
[[tool]]
number = 1
type = "end-mill"
diameter = 6
flute_length = 12
teeth = 3
stickout = 30
holder = "h"
[[setup]]
offset = "G54"
zero = [0, 0, 0]
[[setup.operation]]
type = "bore"
tool = 1
at = [0, 0]
diameter = 20
depth = 3
strategy = "involute"
entry = { helix = { radius = 2, pitch = 0.5 } }
speed = 8000
rough = { stepover = 2, allowance = 0.2, feed = 1200 }
finish = { turns = 2, feed = 800 }
"#;

#[test]
fn of_a_job() {
    guard();
    let run = |document: &Value, progress: &dyn Progress| {
        kinecut::job::run("job.toml", &toml_text(document), &MemoryLoader::default(), progress).map(|_| ())
    };
    let [cases, refused] = every("job", &schema(), &toml(JOB), run);
    assert!(cases > 300 && refused > cases / 3, "{refused} of {cases}");
}

#[test]
fn of_a_thread() {
    guard();
    let threads =
        JOB.replace("end-mill", "tap").replace("teeth = 3", "pitch = 1\nlead = 2\ntip_length = 0.1");
    let threads = &threads[..threads.find("[[setup.operation]]").unwrap()];
    let base = toml(&format!(
        "{threads}[[setup.operation]]\ntype = \"tap\"\ntool = 1\ntop = 0\ndepth = 2\nspeed = 500\napproach = 3\nclearance = 20\n\
         core = {{ diameter = 5, depth = 6 }}\npattern = {{ grid = {{ at = [0, 0], step = [5, 5], count = [2, 1] }} }}\n"
    ));
    let run = |document: &Value, progress: &dyn Progress| {
        kinecut::job::run("job.toml", &toml_text(document), &MemoryLoader::default(), progress).map(|_| ())
    };
    let [cases, refused] = every("thread", &schema(), &base, run);
    assert!(cases > 200 && refused > cases / 3, "{refused} of {cases}");
}

fn hole(document: &Value) -> Result<HoleTable> {
    read_holes("hole.json", document.to_string())?.item(0)
}

const MILL: &str = "[tool]\nnumber = 1\ntype = \"end-mill\"\ndiameter = 6\nflute_length = 12\nteeth = 3\nmax_ramp_angle = 30\ncentre_cutting = true\n";

fn bore(strategy: &str) -> String {
    format!(
        "{MILL}[operation]\ntype = \"bore\"\ntool = 1\nat = [0, 0]\ndiameter = 20\ndepth = 3\nstrategy = \"{strategy}\"\n\
         speed = 8000\nrough = {{ stepover = 2, feed = 1200, engagement = 60 }}\nfinish = {{ feed = 800 }}\n"
    )
}

fn hole_table() -> Value {
    let schema = hole_schema();
    json!({ "$defs": schema["$defs"], "allOf": [schema["$defs"]["HoleTable"]] })
}

#[test]
fn of_a_bore() {
    guard();
    // Strategies whose curves and ways of entering are the most different; the rest in the weekly form.
    let usual = ["involute", "constant-engagement", "trochoidal", "helix"];
    let rest_of_them = ["lens-1", "arcs-2", "ramping", "rings"];
    for strategy in usual.into_iter().chain(rest_of_them.into_iter().filter(|_| weekly())) {
        let smaller = if strategy == "helix" { "diameter = 11" } else { "diameter = 20" };
        let base = toml(&bore(strategy).replace("diameter = 20", smaller));
        every(strategy, &hole_table(), &base, |d, _| plan_hole(&hole(d)?).map(|_| ()));
    }
}

#[test]
fn of_a_comparison() {
    guard();
    every("compared", &hole_table(), &toml(&bore("involute")), |d, _| compare_hole(&hole(d)?).map(|_| ()));
}

#[test]
fn of_a_drilled_hole() {
    guard();
    let drill = format!(
        "{MILL}[operation]\ntype = \"drill\"\ntool = 1\ndepth = 10\nspeed = 1000\nfeed_per_rev = {{ entry = 0.05, steady = 0.1 }}\n\
         pattern = {{ grid = {{ at = [0, 0], step = [5, 5], count = [2, 2] }} }}\n"
    )
    .replace("end-mill", "drill")
    .replace("teeth = 3\nmax_ramp_angle = 30\ncentre_cutting = true\n", "point_angle = 118\n");
    every("drill", &hole_table(), &toml(&drill), |d, _| {
        plan_drill_sheet(&hole(d)?, true, &MemoryLoader::default()).map(|_| ())
    });
}

#[test]
fn of_a_face() {
    guard();
    let base = toml(
        "[tool]\nnumber = 1\ntype = \"face-mill\"\ndiameter = 100\nteeth = 5\nflute_length = 8\n[operation]\ntype = \"face\"\n\
         tool = 1\noutline = { loops = [[[0, 0], [60, 0], [60, 40], [0, 40]]] }\ndepth = 0.5\ncutting_speed = 250\nfeed_per_tooth = 0.12\n\
         placement = { angle = 0, offset = 10 }\n",
    );
    every("face", &hole_table(), &base, |d, progress| {
        let wants = SheetWants { events: true, ..SheetWants::default() };
        plan_face_sheet(&hole(d)?, wants, &MemoryLoader::default(), progress).map(|_| ())
    });
}

const TOOL: &str = "[tool]\nshape.bull-nose = { diameter = 20, corner_radius = 5, flute_length = 24 }\nshank_diameter = 16\n\
                    stickout = 42\nholder = [{ height = 12, lower_diameter = 34, upper_diameter = 40 }]\n";

#[test]
fn of_what_a_tool_sweeps() {
    guard();
    let envelope = toml(&format!(
        "tolerance = 0.5\npoints = 10\n{TOOL}[move]\nfrom = [0, 0, 0]\nto = [60, 10, -8]\naxis = [0, 0, 1]\naxis_to = [0.5, 0.35, 0.8]\n"
    ));
    let table = |s: &Value, name: &str| json!({ "$defs": s["$defs"], "allOf": [s["$defs"][name]] });
    every("envelope", &table(&envelope_schema(), "EnvelopeTable"), &envelope, |d, progress| {
        let items = TextItems::<EnvelopeTable>::read("e.json", d.to_string(), ENVELOPE_LIST)?;
        envelope_sheets(&items.item(0)?, &MemoryLoader::default(), progress).map(|_| ())
    });
    let grazing = toml(&format!(
        "tolerance = 0.1\n{TOOL}[twist]\nvelocity = [1200, 150, -220]\nturn = [180, 1100, 0]\n"
    ));
    every("grazing", &table(&grazing_schema(), "GrazingTable"), &grazing, |d, _| {
        let items = TextItems::<GrazingTable>::read("g.json", d.to_string(), GRAZING_LIST)?;
        grazing_sheet(&items.item(0)?, &MemoryLoader::default()).map(|_| ())
    });
    let contour = &toml(TOOL)["tool"];
    every("contour", &contour_schema(), contour, |d, _| {
        let files = MemoryLoader::default().with("tool.json", d.to_string());
        kinecut::job::contour::load_contour("tool.json", &files).map(|_| ())
    });
}

#[test]
fn of_machines_surfaces_and_outlines() {
    guard();
    let machine = toml(
        "code = \"641203\"\ntravel = { X = [-400, 400], A = [-115, 35] }\ndynamics = { rapid = 30000, acceleration = 5, jerk = 50 }\n\
         [axis.A]\npoint = [0, 0.02, -480]\nrapid = 25\n[[body]]\nname = \"table\"\nlink = \"C\"\n\
         cylinder = { base = [0, 0, -540], diameter = 320, height = 40 }\n[spindle]\npoint = [0, 0, 100]\n",
    );
    every("machine", &machine_schema(), &machine, |d, _| {
        let machine = kinecut::job::machine::read("m.toml", &toml_text(d))?;
        kinecut::verbs::machine::MachineSheet::of(&machine);
        Ok(())
    });
    let surface = toml("like = \"torus\"\nparameters = { R = 30, r = 10 }\n");
    let read = |d: &Value| kinecut::verbs::surface::load_surface("s.toml", Some(&toml_text(d)));
    let parameters = |d: &Value| kinecut::verbs::surface::surface_sheet(&read(d)?).map(|_| ());
    if places(&surface_schema(), &surface).len() > 5 {
        every("surface", &surface_schema(), &surface, |d, _| parameters(d));
    } else {
        for key in ["R", "r"] {
            for value in hurting() {
                let mut changed = surface.clone();
                changed["parameters"][key] = value;
                // Either is an answer.
                let _ = parameters(&changed);
            }
        }
    }
    let outline = json!({ "loops": [[[0, 0], [60, 0], { "to": [60, 40], "radius": 30 }, [0, 40]]] });
    let read = |d: &Value| {
        let options = kinecut::geom::OutlineOptions::default();
        kinecut::geom::read_outline("o.json", d.to_string().as_bytes(), &options).map(|_| ())
    };
    if read(&outline).is_ok() {
        every("outline", &outline_schema(), &outline, |d, _| read(d));
    } else {
        let plain = json!({ "loops": [[[0, 0], [60, 0], [60, 40], [0, 40]]] });
        every("outline", &outline_schema(), &plain, |d, _| read(d));
    }
}
