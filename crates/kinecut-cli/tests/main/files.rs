//! Files on unlucky days: pipes and devices for inputs, outputs named like inputs, disks that are full, runs that meet.

use std::fs;
use std::path::Path;
use std::process::{Command, Output, Stdio};
use std::time::{Duration, Instant};

use crate::shell::folder;

/// Runs in a folder; who is not done after a minute and a half hangs.
fn kinecut(folder: &Path, args: &[&str], stdin: Stdio) -> Output {
    let mut command = Command::new(env!("CARGO_BIN_EXE_kinecut"));
    let command = command.args(args).current_dir(folder).stdin(stdin);
    let mut child = command.stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().unwrap();
    let begin = Instant::now();
    while child.try_wait().unwrap().is_none() {
        if begin.elapsed() > Duration::from_secs(90) {
            child.kill().unwrap();
            panic!("{args:?} hangs");
        }
        std::thread::sleep(Duration::from_millis(10));
    }
    child.wait_with_output().unwrap()
}

/// Runs, and expects that the input is refused with this code.
fn refused(folder: &Path, args: &[&str], code: &str) -> String {
    let run = kinecut(folder, args, Stdio::null());
    let message = String::from_utf8(run.stderr).unwrap();
    assert_eq!(run.status.code(), Some(2), "{args:?}: {message}");
    assert!(message.contains(code), "{args:?}: {message}");
    message
}

/// A small bore; `stock` is its raw stock.
fn job(stock: &str) -> String {
    format!(
        r#"format = 1
stock = {stock}
post = {{ control = "linuxcnc", program = "small" }}
simulate = {{ step = 1 }}
[[tool]]
number = 1
type = "end-mill"
diameter = 10
flute_length = 22
[[setup]]
offset = "G54"
[[setup.operation]]
type = "bore"
tool = 1
at = [0, 0]
diameter = 40
depth = 8
strategy = "involute"
entry = "plunge"
speed = 8000
rough = {{ stepover = 2, feed = 1200, allowance = 0.2 }}
finish = {{ feed = 800 }}
"#
    )
}

const BLOCK: &str = "{ box = { min = [-30, -30, -10], max = [30, 30, 0] } }";

/// A closed block as text STL.
fn block_stl() -> String {
    let corner = |i: usize| [[-30, 30][i & 1], [-30, 30][i >> 1 & 1], [-10, 0][i >> 2 & 1]];
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
fn pipes_and_devices_are_refused_at_once() {
    let folder = folder("pipe");
    for name in ["pipe", "pipe.toml", "pipe.stl", "pipe.ini", "pipe.dxf", "pipe.ngc"] {
        assert!(Command::new("mkfifo").arg(folder.join(name)).status().unwrap().success());
    }
    let verbs: [&[&str]; 9] = [
        &["run", "pipe.toml"],
        &["check", "pipe.ngc"],
        &["post", "pipe.ngc", "--to", "fanuc"],
        &["verify", "pipe"],
        &["machine", "pipe.toml"],
        &["machine", "pipe.ini"],
        &["surface", "pipe.stl"],
        &["hole", "pipe"],
        &["envelope", "pipe"],
    ];
    for verb in verbs {
        let message = refused(&folder, verb, "KC0001");
        assert!(message.contains("regular"), "{message}");
    }
    for verb in
        [["run", "/dev/zero"], ["verify", "/dev/zero"], ["surface", "/dev/zero"], ["hole", "/dev/zero"]]
    {
        refused(&folder, &verb, "KC0001");
    }
    refused(&folder, &["check", "/dev/zero", "--control", "fanuc"], "KC0001");
    // One that a job of a stranger names.
    fs::write(folder.join("job.toml"), job("{ mesh = \"pipe.stl\" }")).unwrap();
    refused(&folder, &["run", "job.toml"], "KC0001");
    fs::remove_dir_all(folder).unwrap();
}

#[test]
fn no_more_is_read_than_the_limit() {
    let folder = folder("limit");
    let endless = kinecut(&folder, &["hole", "-"], Stdio::from(fs::File::open("/dev/zero").unwrap()));
    assert_eq!(endless.status.code(), Some(2));
    assert!(String::from_utf8(endless.stderr).unwrap().contains("too large"));
    // A file of holes: its size is known before anything is read.
    for (name, size) in [("a.toml", 16_000_001), ("a.ngc", 256_000_001), ("a.stl", (1 << 30) + 1)] {
        fs::File::create(folder.join(name)).unwrap().set_len(size).unwrap();
    }
    let verbs = ["run", "machine", "hole", "drill", "face", "grazing", "envelope", "surface"];
    let of_text = verbs.map(|verb| [verb, "a.toml"]).into_iter();
    for verb in of_text.chain([["check", "a.ngc"], ["surface", "a.stl"]]) {
        assert!(refused(&folder, &verb, "KC0001").contains("too large"));
    }
    // Within the limit, but no text.
    fs::write(folder.join("nul.toml"), vec![0; 1_000_000]).unwrap();
    refused(&folder, &["run", "nul.toml"], "KC0002");
    refused(&folder, &["hole", "nul.toml"], "KC0002");
    fs::remove_dir_all(folder).unwrap();
}

#[test]
fn nothing_that_was_read_is_replaced() {
    let folder = folder("replaced");
    let kept = |name: &str, bytes: &str, args: &[&str]| {
        fs::write(folder.join(name), bytes).unwrap();
        refused(&folder, args, "KC0004");
        assert_eq!(fs::read_to_string(folder.join(name)).unwrap(), bytes, "{args:?}");
    };
    fs::write(folder.join("job.toml"), job("{ mesh = \"part.stl\" }")).unwrap();
    kept("part.stl", &block_stl(), &["run", "job.toml", "--out", "."]);
    assert!(!folder.join("verdict.json").exists() && !folder.join("small.ngc").exists());
    for name in ["plan.json", "verdict.json"] {
        kept(name, &job(BLOCK), &["run", name, "--out", "."]);
        fs::remove_file(folder.join(name)).unwrap();
    }
    let machine = "code = \"2103\"\n";
    kept("t.toml", machine, &["machine", "t.toml", "--svg", "t.toml"]);
    let program = "G21 G90 G94 G54 G17\nT1 M6\nG43\nS1000 M3\nG0 X0 Y0 Z5\nG1 Z1 F100\nG0 Z5\nM2\n";
    kept("a.ngc", program, &["post", "a.ngc", "--to", "fanuc", "-o", "a.ngc"]);
    fs::write(folder.join("job.toml"), job(BLOCK)).unwrap();
    kept("job.toml", &job(BLOCK), &["post", "a.ngc", "--job", "job.toml", "--to", "fanuc", "-o", "job.toml"]);
    let hole = job(BLOCK);
    let operation = &hole[hole.find("type = \"bore\"").unwrap()..];
    let hole = format!(
        "tool = {{ number = 1, type = \"end-mill\", diameter = 10, flute_length = 22 }}\n[operation]\n{operation}"
    );
    kept("compare.html", &hole, &["hole", "compare.html", "--compare", "--out", "."]);
    kept("hole.html", &hole, &["hole", "hole.html", "--out", "."]);
    let drill = "tool = { number = 1, type = \"drill\", diameter = 10, flute_length = 80 }\n[operation]\ntype = \"drill\"\n\
        tool = 1\ndepth = 6\nspeed = 900\nfeed_per_rev = { steady = 0.2 }\n";
    kept("drill.html", drill, &["drill", "drill.html", "--out", "."]);
    fs::remove_dir_all(folder).unwrap();
}

#[test]
fn every_output_is_a_subject_and_a_full_disk_leaves_the_old_run_whole() {
    let folder = folder("subjects");
    fs::write(folder.join("job.toml"), job(BLOCK)).unwrap();
    let run = kinecut(&folder, &["run", "job.toml"], Stdio::null());
    assert_eq!(run.status.code(), Some(0), "{}", String::from_utf8_lossy(&run.stderr));
    let valid = || kinecut(&folder, &["verify", "out"], Stdio::null()).status.code() == Some(0);
    assert!(valid());
    let names: Vec<String> = fs::read_dir(folder.join("out"))
        .unwrap()
        .map(|e| e.unwrap().file_name().into_string().unwrap())
        .collect();
    assert_eq!(names.len(), 7, "{names:?}");
    for name in &names {
        let path = folder.join("out").join(name);
        let bytes = fs::read(&path).unwrap();
        let mut changed = bytes.clone();
        changed.push(b'\n');
        fs::write(&path, changed).unwrap();
        // White space after a verdict changes nothing that it says.
        assert_eq!(valid(), name == "verdict.json", "{name}");
        fs::remove_file(&path).unwrap();
        assert!(!valid(), "{name}");
        fs::write(&path, bytes).unwrap();
        assert!(valid());
    }
    // No file may become longer than a few blocks: the report does not fit.
    fs::write(folder.join("job.toml"), job(BLOCK).replace("depth = 8", "depth = 7")).unwrap();
    let script = "trap '' XFSZ; ulimit -f 16; exec \"$0\" run job.toml";
    let full = Command::new("sh")
        .args(["-c", script, env!("CARGO_BIN_EXE_kinecut")])
        .current_dir(&folder)
        .output()
        .unwrap();
    let message = String::from_utf8(full.stderr).unwrap();
    assert!(full.status.code() == Some(2) && message.contains("KC0003"), "{message}");
    fs::write(folder.join("job.toml"), job(BLOCK)).unwrap();
    assert!(valid());
    assert_eq!(fs::read_dir(folder.join("out")).unwrap().count(), 7);
    // Places where nothing can be written.
    fs::write(folder.join("file"), "").unwrap();
    for out in ["file", "file/deeper", "/proc/self/out", "/dev/full"] {
        refused(&folder, &["run", "job.toml", "--out", out], "KC0003");
    }
    fs::remove_dir_all(folder).unwrap();
}

#[test]
fn a_name_in_a_configuration_cannot_steer_the_terminal() {
    let folder = folder("steer");
    let name = "a\u{1b}]0;pwn\u{7}\u{9b}31m\u{202e}b";
    let ini = format!("[EMC]\nMACHINE = {name}\n[KINS]\nKINEMATICS = trivkins\n[TRAJ]\nCOORDINATES = XYZ\n");
    fs::write(folder.join("x.ini"), ini).unwrap();
    for extra in [&[][..], &["--json"]] {
        let run = kinecut(&folder, &[&["machine", "x.ini", "--code", "2103"], extra].concat(), Stdio::null());
        let shown = String::from_utf8(run.stdout).unwrap();
        assert!(run.status.success() && !shown.is_empty());
        let steers = |c: char| c != '\n' && (c.is_control() || c == '\u{202e}');
        assert!(!shown.contains(steers), "{shown:?}");
    }
    // A text of the user in a message.
    let message = refused(&folder, &["explain", name], "KC0104");
    assert!(!message.contains(|c: char| c != '\n' && (c.is_control() || c == '\u{202e}')), "{message:?}");
    fs::remove_dir_all(folder).unwrap();
}
