//! What must hold of any bytes: the functions that the fuzz targets call, and the property tests of the suite.
//!
//! Each takes the bytes of a file, does with it all that a front end does, and panics when a promise is broken. A finding is
//! a fine answer; what is accepted must come through its own round trip.

use kinecut::base::{MemoryLoader, Silent, Sources};
use kinecut::geom::{OutlineOptions, read_outline, read_stl, write_stl};
use kinecut::job::machine::{LoadOptions, load, machine_toml, read};
use kinecut::job::{JobText, check, plan};
use kinecut::nc::{self, Control, PostSettings};
use kinecut::program::{Item, Program};

/// An NC program of a control: what is read and can be written is read again, and is then written as the same text but for
/// comments that stood behind words and come to stand at the head: that is the text's, not the program's.
pub(crate) fn nc_program(control: Control, bytes: &[u8]) {
    let text = String::from_utf8_lossy(bytes);
    let Ok(reading) = nc::read(&mut Sources::default(), "a", &text, control, &[]) else { return };
    let settings = PostSettings::new(control);
    let Ok(first) = nc::write(&reading.program, &[], &settings) else { return };
    let again = nc::read(&mut Sources::default(), "b", &first.text, control, &[]).unwrap_or_else(|e| {
        panic!("what was written is not read: {e}\n--- of\n{text}\n--- written\n{}", first.text)
    });
    if let Ok(second) = nc::write(&again.program, &[], &settings) {
        let lines = |text: &str| text.lines().count();
        let to_head = comments_at_start(&reading.program).saturating_sub(comments_at_start(&again.program));
        assert_eq!(lines(&first.text), lines(&second.text) + to_head, "{}\n---\n{}", first.text, second.text);
    }
}

/// Comments before anything else of a program.
fn comments_at_start(program: &Program) -> usize {
    let items = &program.items;
    (0..items.len()).take_while(|i| matches!(items.get(*i), Item::Text(_))).count()
}

/// A job file: read, checked and planned.
pub(crate) fn job(bytes: &[u8]) {
    let text = String::from_utf8_lossy(bytes).into_owned();
    let mut sources = Sources::default();
    let id = sources.add("job.toml", text);
    let files = MemoryLoader::default();
    let Ok(job) = JobText::read(&mut sources, id, &files) else { return };
    let Ok(job) = check(&job.file, "job", &files) else { return };
    let _ = plan(&job, &Silent);
}

/// An outline, as the ending of its name says.
pub(crate) fn outline(name: &str, bytes: &[u8]) {
    if let Ok(read) = read_outline(name, bytes, &OutlineOptions::default()) {
        let area = read.outline.area();
        assert!(area.is_finite(), "{area}");
    }
}

/// A machine file, or a configuration of LinuxCNC: written as a machine file it is the same machine.
pub(crate) fn machine(name: &str, bytes: &[u8]) {
    let files = MemoryLoader::default().with(name, bytes);
    let Ok(loaded) = load(name, name, &LoadOptions::default(), &files) else { return };
    let text = machine_toml(&loaded.machine);
    let again = read("again.toml", &text).unwrap_or_else(|e| panic!("{e}\n{text}"));
    assert_eq!(machine_toml(&again), text);
}

/// A mesh: written and read again it has the same facets.
pub(crate) fn stl(bytes: &[u8]) {
    let Ok(mesh) = read_stl(bytes) else { return };
    let again = read_stl(&write_stl(&mesh));
    if let Ok(again) = again {
        assert!(again.triangles.len() <= mesh.triangles.len());
    }
}

/// The contour of a tool, as the ending of its name says.
pub(crate) fn contour(name: &str, bytes: &[u8]) {
    let files = MemoryLoader::default().with(name, bytes);
    if let Ok(read) = kinecut::job::contour::load_contour(name, &files) {
        assert!(read.contour.height().is_finite() && read.contour.largest_radius() > 0.0);
    }
}

/// A file of cutter locations, in a job.
pub(crate) fn cutter_locations(bytes: &[u8]) {
    let files = MemoryLoader::default().with("a.cl", bytes);
    let mut sources = Sources::default();
    let id = sources.add("job.toml", PATH_JOB);
    let Ok(job) = JobText::read(&mut sources, id, &files) else { panic!("the job around it is right") };
    let Ok(job) = check(&job.file, "job", &files) else { return };
    let _ = plan(&job, &Silent);
}

/// A surface file with its formulas.
pub(crate) fn surface(bytes: &[u8]) {
    let text = String::from_utf8_lossy(bytes);
    let Ok(surface) = kinecut::verbs::surface::load_surface("s.toml", Some(&text)) else { return };
    let _ = kinecut::verbs::surface::surface_sheet(&surface);
}

const PATH_JOB: &str = r#"format = 1
stock = { box = { min = [-50, -50, -20], max = [50, 50, 0] } }
post = { control = "linuxcnc" }
[[tool]]
number = 1
type = "ball-nose"
diameter = 10
flute_length = 22
[[setup]]
offset = "G54"
[[setup.operation]]
type = "path"
tool = 1
speed = 8000
feed = 900
file = "a.cl"
"#;
