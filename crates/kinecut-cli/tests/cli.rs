//! The command line as a shell sees it: streams, exit codes, files.

#![allow(clippy::unwrap_used, reason = "a test panics when it fails")]

use std::path::{Path, PathBuf};
use std::process::{Command, Output};

fn kinecut(args: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_kinecut")).args(args).output().unwrap()
}

fn text(bytes: &[u8]) -> String {
    String::from_utf8(bytes.to_vec()).unwrap()
}

/// An empty folder of this test's own.
fn folder(name: &str) -> PathBuf {
    let folder = std::env::temp_dir().join(format!("kinecut-cli-{name}-{}", std::process::id()));
    let _ = std::fs::remove_dir_all(&folder);
    std::fs::create_dir_all(&folder).unwrap();
    folder
}

/// The first example with some text replaced, on a coarse grid, in a folder of its own.
fn job(folder: &Path, from: &str, to: &str) -> String {
    let example = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../examples/01_bore/job.toml");
    let job = std::fs::read_to_string(example).unwrap();
    assert!(job.contains(from), "{from}");
    let path = folder.join("plate.toml");
    std::fs::write(&path, job.replace("step = 0.2 }", "step = 2 }").replace(from, to)).unwrap();
    path.display().to_string()
}

#[test]
fn a_good_job_exits_0_with_its_summary_on_stdout_and_the_verdict_holds() {
    let folder = folder("good");
    let job = job(&folder, "format = 1", "format = 1");
    let out = folder.join("out").display().to_string();
    let run = kinecut(&["run", &job, "--out", &out]);
    assert_eq!(run.status.code(), Some(0), "{}", text(&run.stderr));
    assert!(text(&run.stdout).starts_with("SAFE") && run.stderr.is_empty(), "{}", text(&run.stderr));
    let verify = kinecut(&["verify", &out]);
    assert_eq!((verify.status.code(), text(&verify.stdout).contains("VALID")), (Some(0), true));
    let program = Path::new(&out).join("BORE200.mpf");
    let changed = std::fs::read_to_string(&program).unwrap().replacen("F300", "F301", 1);
    std::fs::write(&program, changed).unwrap();
    let verify = kinecut(&["verify", &out]);
    assert_eq!((verify.status.code(), text(&verify.stdout).contains("VOID")), (Some(1), true));
    std::fs::remove_dir_all(folder).unwrap();
}

#[test]
fn findings_exit_1_and_strict_writes_nothing() {
    let folder = folder("findings");
    let job = job(&folder, "stickout = 90", "stickout = 46");
    let job = {
        let text = std::fs::read_to_string(&job).unwrap().replace("flute_length = 45", "flute_length = 20");
        std::fs::write(&job, text.replace("stickout = 46", "stickout = 25")).unwrap();
        job
    };
    let out = folder.join("out").display().to_string();
    let strict = kinecut(&["run", &job, "--out", &out, "--strict"]);
    assert_eq!(strict.status.code(), Some(2));
    assert!(!Path::new(&out).exists());
    let run = kinecut(&["run", &job, "--out", &out]);
    assert_eq!(run.status.code(), Some(1), "{}", text(&run.stderr));
    assert!(text(&run.stdout).starts_with("NOT SAFE") && text(&run.stderr).contains("KC0503"));
    assert!(Path::new(&out).join("report.html").exists());
    std::fs::remove_dir_all(folder).unwrap();
}

#[test]
fn wrong_input_exits_2_with_one_message_that_points_at_it_and_writes_nothing() {
    let folder = folder("wrong");
    let job = job(&folder, "step = 4,", "stepp = 4,");
    let out = folder.join("out").display().to_string();
    let run = kinecut(&["run", &job, "--out", &out]);
    let message = text(&run.stderr);
    assert_eq!(run.status.code(), Some(2));
    assert!(message.contains("error[KC0102]") && message.contains("plate.toml:52:11"), "{message}");
    assert!(message.contains("^^^^^") && message.contains("did you mean `step`?"), "{message}");
    assert!(run.stdout.is_empty() && !Path::new(&out).exists());
    let json = kinecut(&["run", &job, "--out", &out, "--json"]);
    let document: serde_json::Value = serde_json::from_slice(&json.stdout).unwrap();
    assert_eq!((document["code"].as_str(), document["place"]["line"].as_u64()), (Some("KC0102"), Some(52)));
    assert_eq!(kinecut(&["run", "nowhere.toml"]).status.code(), Some(2));
    assert_eq!(kinecut(&["rum"]).status.code(), Some(2));
    std::fs::remove_dir_all(folder).unwrap();
}

#[test]
fn the_schema_is_json_and_every_code_is_explained() {
    let schema: serde_json::Value = serde_json::from_slice(&kinecut(&["schema", "job"]).stdout).unwrap();
    assert!(schema["properties"]["stock"].is_object());
    let list = text(&kinecut(&["explain"]).stdout);
    assert!(list.lines().count() > 20);
    for line in list.lines() {
        let code = line.split_whitespace().next().unwrap();
        assert_eq!(kinecut(&["explain", code]).status.code(), Some(0), "{code}");
    }
    assert_eq!(kinecut(&["explain", "KC9999"]).status.code(), Some(2));
}

#[test]
fn control_characters_of_a_job_never_reach_the_terminal() {
    let folder = folder("escape");
    let job = job(&folder, "Housing plate, bore 200", "\\u001b[31mred");
    let run = kinecut(&["run", &job, "--out", &folder.join("out").display().to_string()]);
    assert_eq!(run.status.code(), Some(2));
    assert!(!run.stderr.contains(&0x1b), "{}", text(&run.stderr));
    std::fs::remove_dir_all(folder).unwrap();
}
