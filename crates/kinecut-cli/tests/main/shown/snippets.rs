//! Each piece of TOML that a document shows is read and checked by the job reader: put into a job that has what the piece
//! leaves out (stock, tools, setup), beside the files of the examples.

use kinecut::base::{DiskLoader, FileKind, Loader, MemoryLoader, Result, Sources};
use kinecut::job::{JobText, check};
use kinecut::verbs::hole::read_holes;

use crate::shell::root;

/// Files of the examples by their names alone, and templates that a snippet names.
struct Files;

impl Loader for Files {
    fn read_as(&self, path: &str, kind: FileKind) -> Result<Vec<u8>> {
        let examples = std::fs::read_dir(root().join("examples")).unwrap().map(|e| e.unwrap().path());
        match examples.filter(|e| e.is_dir()).find(|e| e.join(path).is_file()) {
            Some(folder) => DiskLoader::new(folder).read_as(path, kind),
            None => {
                MemoryLoader::default().with("start.tmpl", "%").with("end.tmpl", "M30").read_as(path, kind)
            }
        }
    }
}

/// Number of the line, text.
fn snippets(text: &str) -> Vec<(usize, String)> {
    let (mut found, mut open) = (Vec::new(), false);
    for (i, line) in text.lines().enumerate() {
        match (line.strip_prefix("```"), open) {
            (Some("toml"), false) => {
                found.push((i + 2, String::new()));
                open = true;
            }
            (Some(_), _) => open = false,
            (None, true) => found.last_mut().unwrap().1 += &format!("{line}\n"),
            (None, false) => {}
        }
    }
    found
}

const TOOLS: &str = r#"
[[tool]]
number = 1
type = "end-mill"
diameter = 40
flute_length = 45
teeth = 4
centre_cutting = true
[[tool]]
number = 2
type = "ball-nose"
diameter = 6
teeth = 2
flute_length = 12
[[tool]]
number = 4
type = "drill"
diameter = 8
point = { twist = { point_angle = 118 } }
flute_length = 140
[[tool]]
number = 5
type = "end-mill"
diameter = 16
flute_length = 30
centre_cutting = true
[[tool]]
number = 93
type = "drill"
diameter = 10
point_angle = 90
flute_length = 20
preset = [{ material = "C45", cutting_speed = 20, feed_per_rev = 0.1 }]
[[tool]]
number = 94
type = "drill"
diameter = 7.8
flute_length = 80
preset = [{ material = "C45", cutting_speed = 20, feed_per_rev = 0.1 }]
[[tool]]
number = 95
name = "reamer 8H7"
type = "drill"
diameter = 8
point = { cone = { cone_angle = 90, nose_diameter = 7.6 } }
flute_length = 80
centre_cutting = false
preset = [{ material = "C45", cutting_speed = 10, feed_per_rev = 0.1 }]
"#;

const BORE: &str = r#"
[[setup.operation]]
type = "bore"
tool = 1
at = [0, 0]
diameter = 200
depth = 30
strategy = "involute"
entry = "plunge"
speed = 2400
rough = { stepover = 4, allowance = 1, feed = 6000, stepdown = 16 }
"#;

/// A job around a snippet.
fn job(snippet: &str) -> String {
    let inside = ["finish"].iter().any(|k| snippet.starts_with(k));
    let snippet = if inside { format!("{BORE}{snippet}") } else { snippet.to_owned() };
    // Keys of the file come before its first table.
    let (head, tables) = snippet.split_at(snippet.find("[[").unwrap_or(snippet.len()));
    let mut text = format!(
        "format = 1\nstock = {{ box = {{ min = [-130, -130, -60], max = [130, 130, 0] }} }}\nsimulate = {{ step = 2 }}\n{head}\n"
    );
    // A control with a register of wear by `D`.
    if !head.contains("post =") {
        text += "post = { control = \"fanuc\" }\n";
    }
    // Machine positions need a machine.
    if tables.contains("position =") {
        text += "machine = \"trunnion.toml\"\n";
    }
    let given: Vec<&str> = tables.lines().filter(|l| l.starts_with("number = ")).collect();
    for tool in TOOLS.split("[[tool]]").skip(1) {
        let number = tool.lines().find(|l| l.starts_with("number = ")).unwrap();
        if !given.contains(&number) && !tables.contains(&format!("[[tool]]\n{number} ")) {
            text += &format!("[[tool]]{tool}");
        }
    }
    match tables.find("[[setup") {
        _ if tables.contains("[[setup]]") => text + tables,
        Some(at) => text + &tables[..at] + "[[setup]]\noffset = \"G54\"\n" + &tables[at..],
        None => text + tables + "[[setup]]\noffset = \"G54\"\n" + BORE,
    }
}

fn read(snippet: &str) -> Result<()> {
    if snippet.starts_with("part =") {
        let tool = "[tool]\nnumber = 1\ntype = \"drill\"\ndiameter = 12\nflute_length = 90\n\
                    point = { twist = { point_angle = 118 } }\n[operation]\ntype = \"drill\"\ntool = 1\ncutting_speed = 25\n";
        let texts = read_holes("hole.toml", format!("{snippet}\n{tool}"))?;
        let name = "examples/03_drill_through_shaft/housing.toml";
        let example = std::fs::read_to_string(root().join(name)).unwrap();
        assert!(example.contains(snippet.trim_end()), "{name} differs from the snippet");
        drop(texts);
        return Ok(());
    }
    let mut sources = Sources::default();
    let id = sources.add("job.toml".to_owned(), job(snippet));
    let text = JobText::read(&mut sources, id, &Files)?;
    check(&text.file, "job", &Files).map_err(|e| text.locate(&sources, e)).map(drop)
}

#[test]
fn every_snippet_is_read_by_the_job_reader() {
    let mut count = 0;
    for name in ["README.md", "docs/strategies.md", "docs/drilling.md", "docs/facing.md", "docs/machines.md"]
    {
        for (line, snippet) in snippets(&std::fs::read_to_string(root().join(name)).unwrap()) {
            if let Err(e) = read(&snippet) {
                panic!("{name}:{line}: {e:?}\n{}", job(&snippet));
            }
            count += 1;
        }
    }
    assert!(count >= 9, "{count}");
}

#[test]
fn a_wrong_snippet_is_refused() {
    assert!(read("finish = { feed = 1200, feedat = \"wall\" }\n").is_err());
    assert!(read("[[setup.operation]]\ntype = \"pocket-ellipse\"\ntool = 5\nat = [0, 0]\n").is_err());
}
