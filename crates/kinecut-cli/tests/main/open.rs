//! The workbench, as the program serves it: its answers are those of the verbs, and a save is whole or was none.

use std::fs;
use std::io::{BufRead as _, BufReader, Read as _, Write as _};
use std::net::TcpStream;
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Stdio};
use std::time::{Duration, Instant};

use serde_json::{Value, json};

/// A program that serves a folder.
struct Workbench {
    program: Child,
    port: u16,
    token: String,
}

impl Workbench {
    fn of(folder: &Path) -> Workbench {
        let mut program = Command::new(env!("CARGO_BIN_EXE_kinecut"))
            .args(["open", "--no-browser", "--json"])
            .arg(folder)
            .stdout(Stdio::piped())
            .spawn()
            .unwrap();
        let mut said = String::new();
        let mut output = BufReader::new(program.stdout.take().unwrap());
        while !said.trim_end().ends_with('}') {
            assert!(output.read_line(&mut said).unwrap() > 0, "it ended: {said}");
        }
        let said: Value = serde_json::from_str(&said).unwrap();
        let address = said["address"].as_str().unwrap();
        let (start, token) = address.split_once("/#token=").unwrap();
        let port = start.strip_prefix("http://127.0.0.1:").unwrap().parse().unwrap();
        Workbench { program, port, token: token.to_owned() }
    }

    fn send(&self, method: &str, path: &str, body: &str) -> Option<(String, Vec<u8>)> {
        send((self.port, &self.token), method, path, body)
    }

    fn json(&self, method: &str, path: &str, body: &Value) -> Value {
        let (head, body) = self.send(method, path, &body.to_string()).unwrap();
        serde_json::from_slice(&body).unwrap_or_else(|e| panic!("{e}: {head}"))
    }

    fn id(&self, name: &str) -> String {
        let project = self.json("GET", "/api/project", &Value::Null);
        let files = project["files"].as_array().unwrap();
        files.iter().find(|f| f["name"] == name).unwrap()["id"].as_str().unwrap().to_owned()
    }
}

impl Drop for Workbench {
    fn drop(&mut self) {
        let _ = self.program.kill();
        let _ = self.program.wait();
    }
}

/// Sends a request; its answer may be lost when the program dies.
fn send((port, token): (u16, &str), method: &str, path: &str, body: &str) -> Option<(String, Vec<u8>)> {
    let mut stream = TcpStream::connect(("127.0.0.1", port)).ok()?;
    let head = format!(
        "{method} {path} HTTP/1.1\r\nHost: 127.0.0.1:{port}\r\nOrigin: http://127.0.0.1:{port}\r\nAuthorization: Bearer {token}\r\n\
         Content-Type: application/json\r\nConnection: close\r\nContent-Length: {}\r\n\r\n",
        body.len()
    );
    stream.write_all(format!("{head}{body}").as_bytes()).ok()?;
    let mut all = Vec::new();
    stream.read_to_end(&mut all).ok()?;
    let end = all.windows(4).position(|w| w == b"\r\n\r\n")?;
    Some((String::from_utf8_lossy(&all[..end]).into_owned(), all[end + 4..].to_vec()))
}

fn examples() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../../examples")
}

/// A new folder for a test.
fn folder(name: &str) -> PathBuf {
    let folder = std::env::temp_dir().join(format!("kinecut-open-{}-{name}", std::process::id()));
    let _ = fs::remove_dir_all(&folder);
    fs::create_dir_all(&folder).unwrap();
    folder
}

/// What the command line prints for these words, with its exit code.
fn printed(words: &[&str], place: &Path) -> (String, i32) {
    let output = Command::new(env!("CARGO_BIN_EXE_kinecut")).args(words).current_dir(place).output().unwrap();
    (String::from_utf8(output.stdout).unwrap(), output.status.code().unwrap())
}

#[test]
fn a_plan_is_that_of_run_letter_by_letter() {
    let place = folder("plan");
    for example in ["03_drill_through_shaft", "20_pocket_with_island"] {
        for entry in fs::read_dir(examples().join(example)).unwrap() {
            let from = entry.unwrap().path();
            fs::copy(&from, place.join(from.file_name().unwrap())).unwrap();
        }
        printed(
            &["run", "job.toml", "--out", "out", "--mesh", "none", "--no-playback", "--step", "1"],
            &place,
        );
        let file = fs::read_to_string(place.join("out/plan.json")).unwrap();
        let workbench = Workbench::of(&place);
        let body = json!({ "client": "c", "file": workbench.id("job.toml") }).to_string();
        let (_, answer) = workbench.send("POST", "/api/plan", &body).unwrap();
        let answer = String::from_utf8(answer).unwrap();
        // From the programs to what only cutting tells.
        let setups = &file[file.find("  \"setups\": [").unwrap()..file.find("  \"stock_volume\"").unwrap()];
        let setups = setups.trim_end().trim_end_matches(',');
        assert!(answer.contains(setups), "{example}: {answer}");
        let body = json!({ "client": "c", "file": workbench.id("job.toml"), "step": 1.0, "playback": false });
        let (_, answer) = workbench.send("POST", "/api/simulate", &body.to_string()).unwrap();
        assert!(String::from_utf8(answer).unwrap().contains(file.trim_end()), "{example}");
    }
    fs::remove_dir_all(place).unwrap();
}

#[test]
fn verbs_answer_as_the_command_line_does() {
    let place = folder("verbs");
    for (name, file, of) in [
        ("hole", "hole.toml", "12_compare/hole.toml"),
        ("drill", "figure_7.toml", "03_drill_through_shaft/figure_7.toml"),
        ("face", "face.toml", "04_gear_pump_cover/face.toml"),
    ] {
        fs::copy(examples().join(of), place.join(file)).unwrap();
        if name == "face" {
            fs::copy(examples().join("04_gear_pump_cover/cover.dxf"), place.join("cover.dxf")).unwrap();
        }
        let workbench = Workbench::of(&place);
        let id = workbench.id(file);
        let text = fs::read_to_string(place.join(file)).unwrap();
        let wrong = text.replacen("tool = ", "tool_ = ", 1).replacen("[tool]", "[tool_]", 1);
        let list = format!("[{{}}, {}]", "{ \"tool\": 1 }");
        for text in [text, wrong, list] {
            fs::write(place.join(file), &text).unwrap();
            let (wanted, code) = printed(&[name, file, "--json"], &place);
            fs::write(place.join(file), "# another text on disk\n").unwrap();
            let body = json!({ "client": "c", "file": id, "text": text }).to_string();
            let (head, answer) = workbench.send("POST", &format!("/api/verb/{name}"), &body).unwrap();
            assert_eq!(String::from_utf8(answer).unwrap(), wanted, "{name}");
            assert!(head.contains(&format!("kinecut-exit: {code}")), "{name}: {head}");
        }
    }
    let workbench = Workbench::of(&place);
    for schema in ["job", "face", "machine", "contour"] {
        let (_, answer) = workbench.send("GET", &format!("/api/schema/{schema}"), "").unwrap();
        assert_eq!(String::from_utf8(answer).unwrap(), printed(&["schema", schema], &place).0, "{schema}");
    }
    let (_, answer) = workbench.send("GET", "/api/explain/KC0501", "").unwrap();
    assert_eq!(String::from_utf8(answer).unwrap(), printed(&["explain", "KC0501", "--json"], &place).0);
    fs::remove_dir_all(place).unwrap();
}

#[cfg(unix)]
#[test]
fn it_ends_cleanly_when_it_is_interrupted() {
    let place = folder("end");
    fs::write(place.join("job.toml"), "format = 1\n").unwrap();
    let mut workbench = Workbench::of(&place);
    assert_eq!(workbench.json("GET", "/api/project", &Value::Null)["open"], workbench.id("job.toml"));
    let number = workbench.program.id().to_string();
    assert!(Command::new("kill").args(["-INT", &number]).status().unwrap().success());
    let begun = Instant::now();
    let code = loop {
        if let Some(status) = workbench.program.try_wait().unwrap() {
            break status.code();
        }
        assert!(begun.elapsed() < Duration::from_secs(10), "it goes on");
        std::thread::sleep(Duration::from_millis(10));
    };
    assert_eq!(code, Some(0));
    let (said, code) = printed(&["open", "nothing.toml", "--no-browser", "--json"], &place);
    assert_eq!((serde_json::from_str::<Value>(&said).unwrap()["code"].as_str(), code), (Some("KC0001"), 2));
    fs::remove_dir_all(place).unwrap();
}

#[test]
fn a_killed_save_leaves_the_old_or_the_new_file_whole() {
    const KILLS: u32 = 100;
    let place = folder("kill");
    let file = place.join("job.toml");
    // Long enough that a write takes time.
    let text = |n: u32| format!("# {n}\n").repeat(50_000);
    let hash = |text: &str| kinecut::job::sha256(text.as_bytes());
    fs::write(&file, text(0)).unwrap();
    let (mut now, mut next) = (0, 1);
    let (mut replaced, mut kept) = (0, 0);
    // The time that a save takes here and now.
    let workbench = Workbench::of(&place);
    let body = json!({ "text": text(next), "sha256": hash(&text(now)) });
    let (path, begun) = (format!("/api/file/{}", workbench.id("job.toml")), Instant::now());
    assert_eq!(workbench.json("PUT", &path, &body)["sha256"], hash(&text(next)));
    let whole = begun.elapsed();
    drop(workbench);
    (now, next) = (next, next + 1);
    for kill in 0..KILLS {
        let mut workbench = Workbench::of(&place);
        let (id, port, token) = (workbench.id("job.toml"), workbench.port, workbench.token.clone());
        let body = json!({ "text": text(next), "sha256": hash(&text(now)) }).to_string();
        std::thread::scope(|scope| {
            // Its answer does not matter: the program may be gone.
            let saving = scope.spawn(move || send((port, &token), "PUT", &format!("/api/file/{id}"), &body));
            // From before it begins to after it has ended.
            std::thread::sleep(whole.mul_f64(2.0 * f64::from(kill) / f64::from(KILLS)));
            workbench.program.kill().unwrap();
            let _ = saving.join();
        });
        drop(workbench);
        let found = fs::read_to_string(&file).unwrap();
        if found == text(next) {
            (now, next) = (next, next + 1);
            replaced += 1;
        } else {
            assert_eq!(hash(&found), hash(&text(now)), "kill {kill}: neither the old nor the new text");
            kept += 1;
        }
    }
    assert!(replaced > 0 && kept > 0, "{replaced} replaced, {kept} kept: no kill fell between");
    fs::remove_dir_all(place).unwrap();
}
