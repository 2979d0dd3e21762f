//! The command line as a shell sees it: streams, exit codes, files.

use std::path::Path;
use std::process::{Command, Output};

use crate::shell::{folder, text};

fn kinecut(args: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_kinecut")).args(args).output().unwrap()
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
    assert_eq!((verify.status.code(), text(&verify.stdout).contains("UNCHANGED")), (Some(0), true));
    let program = Path::new(&out).join("BORE200.mpf");
    let changed = std::fs::read_to_string(&program).unwrap().replacen("F300", "F301", 1);
    std::fs::write(&program, changed).unwrap();
    let verify = kinecut(&["verify", &out]);
    assert_eq!((verify.status.code(), text(&verify.stdout).contains("VOID")), (Some(1), true));
    std::fs::remove_dir_all(folder).unwrap();
}

#[test]
fn a_program_that_is_not_safe_exits_1_and_so_does_its_verification() {
    let folder = folder("findings");
    let job = job(&folder, "stickout = 90", "stickout = 46");
    let job = {
        let text = std::fs::read_to_string(&job).unwrap().replace("flute_length = 45", "flute_length = 20");
        std::fs::write(&job, text.replace("stickout = 46", "stickout = 25")).unwrap();
        job
    };
    let out = folder.join("out").display().to_string();
    let run = kinecut(&["run", &job, "--out", &out]);
    assert_eq!(run.status.code(), Some(1), "{}", text(&run.stderr));
    assert!(text(&run.stdout).starts_with("NOT SAFE") && text(&run.stderr).contains("KC0503"));
    assert!(Path::new(&out).join("report.html").exists());
    let verify = kinecut(&["verify", &out]);
    let said = text(&verify.stdout);
    assert!(said.contains("UNCHANGED") && said.contains("NOT SAFE, "), "{said}");
    assert_eq!(verify.status.code(), Some(1), "{said}");
    std::fs::remove_dir_all(folder).unwrap();
}

#[test]
fn a_verdict_whose_job_is_gone_can_neither_hold_nor_be_void() {
    let folder = folder("gone");
    let job = job(&folder, "format = 1", "format = 1");
    let out = folder.join("out").display().to_string();
    assert_eq!(kinecut(&["run", &job, "--out", &out]).status.code(), Some(0));
    let elsewhere = folder.join("elsewhere.toml");
    std::fs::rename(&job, &elsewhere).unwrap();
    let verify = kinecut(&["verify", &out]);
    let said = format!("{}{}", text(&verify.stdout), text(&verify.stderr));
    assert!(said.contains("UNKNOWN") && said.contains("KC0107") && said.contains("--job"), "{said}");
    assert_eq!(verify.status.code(), Some(2), "{said}");
    let named = kinecut(&["verify", &out, "--job", &elsewhere.display().to_string()]);
    assert_eq!(named.status.code(), Some(0), "{}", text(&named.stdout));
    // A program that was changed is known to be changed, whatever else is missing.
    std::fs::write(Path::new(&out).join("BORE200.mpf"), "M30\n").unwrap();
    assert_eq!(kinecut(&["verify", &out]).status.code(), Some(1));
    std::fs::remove_dir_all(folder).unwrap();
}

#[test]
fn wrong_input_exits_2_with_one_message_that_points_at_it_and_writes_nothing() {
    let folder = folder("wrong");
    let job = job(&folder, "stepover = 4,", "stepoverr = 4,");
    let out = folder.join("out").display().to_string();
    let run = kinecut(&["run", &job, "--out", &out]);
    let message = text(&run.stderr);
    assert_eq!(run.status.code(), Some(2));
    assert!(message.contains("error[KC0102]") && message.contains("plate.toml:53:11"), "{message}");
    assert!(message.contains("^^^^^") && message.contains("did you mean `stepover`?"), "{message}");
    assert!(run.stdout.is_empty() && !Path::new(&out).exists());
    let json = kinecut(&["run", &job, "--out", &out, "--json"]);
    let document: serde_json::Value = serde_json::from_slice(&json.stdout).unwrap();
    assert_eq!((document["code"].as_str(), document["place"]["line"].as_u64()), (Some("KC0102"), Some(53)));
    assert_eq!(kinecut(&["run", "nowhere.toml"]).status.code(), Some(2));
    assert_eq!(kinecut(&["rum"]).status.code(), Some(2));
    std::fs::remove_dir_all(folder).unwrap();
}

#[test]
fn the_schema_is_json_and_every_code_is_explained() {
    let schema: serde_json::Value = serde_json::from_slice(&kinecut(&["schema", "job"]).stdout).unwrap();
    assert!(schema["properties"]["stock"].is_object());
    let list = text(&kinecut(&["explain"]).stdout);
    let codes = list.split_whitespace().filter(|word| word.starts_with("KC"));
    assert!(codes.clone().count() > 20, "{list}");
    for code in codes {
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

/// A small hole as JSON, with some text replaced.
fn hole_json(from: &str, to: &str) -> String {
    let hole = r#"{"title": "small", "tool": {"number": 1, "type": "end-mill", "diameter": 10, "flute_length": 22},
        "operation": {"type": "bore", "tool": 1, "at": [5, 5], "diameter": 40, "depth": 8, "strategy": "involute",
        "entry": "plunge", "speed": 8000, "rough": {"stepover": 2, "feed": 1200, "allowance": 0.2}, "finish": {"feed": 800}}}"#;
    assert!(hole.contains(from), "{from}");
    hole.replace(from, to)
}

fn hole(args: &[&str], input: &str) -> Output {
    use std::io::Write as _;
    let mut child = Command::new(env!("CARGO_BIN_EXE_kinecut"))
        .args(args)
        .stdin(std::process::Stdio::piped())
        .stdout(std::process::Stdio::piped())
        .stderr(std::process::Stdio::piped())
        .spawn()
        .unwrap();
    child.stdin.take().unwrap().write_all(input.as_bytes()).unwrap();
    child.wait_with_output().unwrap()
}

#[test]
fn a_list_of_holes_gives_a_list_in_which_a_bad_one_carries_its_error() {
    let list = format!(
        "[{},{},{}]",
        hole_json("small", "first"),
        hole_json("\"stepover\": 2", "\"stepoverr\": 2"),
        hole_json("\"diameter\": 40", "\"diameter\": 9")
    );
    let run = hole(&["hole", "-", "--json"], &list);
    assert_eq!(run.status.code(), Some(1), "{}", text(&run.stderr));
    let items: serde_json::Value = serde_json::from_str(&text(&run.stdout)).unwrap();
    assert_eq!(items.as_array().unwrap().len(), 3);
    assert_eq!(items[0]["title"], "first");
    assert_eq!(items[0]["passes"][0]["path_radius"], 14.8);
    assert_eq!((&items[1]["error"]["code"], items[1]["error"]["key"].is_string()), (&"KC0102".into(), true));
    assert_eq!(items[2]["error"]["code"], "KC0401");
    assert_eq!(items[2]["error"]["key"], "hole[2].operation.diameter");
}

#[test]
fn an_unknown_key_of_a_hole_is_pointed_at_in_its_text() {
    let toml = "tool = { number = 1, type = \"end-mill\", diameter = 10, flute_length = 22 }\n[operation]\ntype = \"bore\"\n\
                tool = 1\nat = [0, 0]\ndiameter = 40\ndepth = 8\nstrategy = \"involute\"\nspeed = 8000\n\
                rough = { stepoverr = 2, feed = 1200 }\n";
    let run = hole(&["hole"], toml);
    let message = text(&run.stderr);
    assert_eq!(run.status.code(), Some(2));
    assert!(
        message.contains("KC0102")
            && message.contains("-:10:11")
            && message.contains("did you mean `stepover`"),
        "{message}"
    );
    let run = hole(&["hole"], &toml.replace("stepoverr = 2", "stepover = 200"));
    let message = text(&run.stderr);
    assert!(message.contains("KC0404") && message.contains("-:10:"), "{message}");
}

#[test]
fn an_old_key_of_a_list_is_told_at_its_line() {
    let one = "[[hole]]\ntool = { number = 1, type = \"end-mill\", diameter = 10, flute_length = 22 }\n[hole.operation]\n\
               type = \"bore\"\ntool = 1\nat = [0, 0]\ndiameter = 40\ndepth = 8\nstrategy = \"involute\"\nspeed = 8000\n\
               rough = { stepover = 2, feed = 1200, allowance = 0.2 }\nfinish = { feed = 800 }\n";
    let old = one.replace("stepover = 2", "step = 2");
    // Each table by itself, and the text read at once.
    for (text_of_all, line) in
        [(format!("{one}{old}"), 23), (format!("# both\n{one}{old}[hole.post]\ncontrol = \"fanuc\"\n"), 24)]
    {
        let run = hole(&["hole"], &text_of_all);
        let said = text(&run.stderr);
        assert_eq!(run.status.code(), Some(0), "{said}");
        assert!(said.matches("KC0108").count() == 1 && said.contains(&format!("-:{line}:")), "{said}");
    }
    let json = hole(&["hole", "--json"], &format!("[{0}, {0}]", hole_json("\"stepover\"", "\"step\"")));
    let answers: serde_json::Value = serde_json::from_str(&text(&json.stdout)).unwrap();
    for (i, key) in ["hole[0].operation.rough.step", "hole[1].operation.rough.step"].iter().enumerate() {
        let finding = &answers[i]["findings"][0];
        assert_eq!((finding["code"].as_str(), finding["key"].as_str()), (Some("KC0108"), Some(*key)));
    }
}

#[test]
fn a_comparison_fits_the_terminal_and_its_page_is_whole() {
    let folder = folder("compare");
    let out = folder.join("out").display().to_string();
    let run = hole(&["hole", "--compare", "--out", &out], &hole_json("small", "small"));
    assert_eq!(run.status.code(), Some(0), "{}", text(&run.stderr));
    let table = text(&run.stdout);
    assert!(table.lines().all(|l| l.chars().count() <= 100), "{table}");
    for word in ["involute", "lens-2", "trochoidal", "does not hold"] {
        assert!(table.contains(word), "{word} in {table}");
    }
    let page = std::fs::read_to_string(Path::new(&out).join("compare.html")).unwrap();
    assert!(page.starts_with("<!DOCTYPE html>") && page.ends_with("</html>"));
    assert!(!page.contains("http://") && !page.contains("https://") && !page.contains("NaN"));
    assert!(page.contains("Strategies compared: small"));
    std::fs::remove_dir_all(folder).unwrap();
}

#[test]
fn the_schema_of_holes_lies_beside_the_examples() {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../examples/hole.schema.json");
    let beside = std::fs::read_to_string(path).unwrap();
    assert_eq!(
        text(&kinecut(&["schema", "hole"]).stdout),
        beside,
        "kinecut schema hole > examples/hole.schema.json"
    );
}

#[test]
fn what_was_typed_steers_no_terminal_whoever_complains() {
    let wrong: [&[&str]; 4] = [
        &["\u{1b}[31mfoo"],
        &["run", "a.toml", "--col\u{1b}]0;x\u{7}"],
        &["run", "a.toml", "--color", "\u{9b}31m"],
        &["explain", "KC0001", "\u{202e}x"],
    ];
    for args in wrong {
        let run = kinecut(args);
        assert_eq!(run.status.code(), Some(2), "{args:?}");
        let shown = text(&run.stderr);
        let harmless = |c: char| c == '\n' || !(c.is_control() || c == '\u{202e}');
        assert!(shown.contains("error") && shown.chars().all(harmless), "{shown:?}");
    }
    let help = kinecut(&["--help"]);
    assert_eq!(help.status.code(), Some(0));
    assert!(text(&help.stdout).contains("Usage: kinecut") && help.stderr.is_empty());
    // Lines of help name the thing first.
    for verb in ["run", "post", "machine", "ik", "reach", "layouts", "surface", "drill", "face"] {
        let help = text(&kinecut(&[verb, "--help"]).stdout);
        for word in ["What ", "How ", "Where "] {
            assert!(help.lines().all(|l| !l.trim_start().starts_with(word)), "{verb}: {help}");
        }
    }
}
