//! The documents show what happens: each command in README.md, docs/ and the examples runs as it
//! is written, ends with the exit code that its line states (0 if it states none), and writes the files that it names;
//! output that is shown is output; files that are named are there.
//!
//! A command runs at the root of a copy that holds the examples only, so nothing is written into the repository.

mod documents;
mod numbers;
mod snippets;

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::process::Command;
use std::sync::Mutex;

use documents::{Document, Shown, documents};

use crate::shell::{folder, root};

/// Commands of others that a document may show.
const OTHERS: [&str; 4] = ["cargo test", "cargo bench", "cargo doc", "apt-get"];

/// Files that `kinecut run` writes beside the program, as README says.
const RESULTS: [&str; 6] =
    ["report.html", "plan.json", "engagement.json", "verdict.json", "part.stl", "part.glb"];

fn copy(from: &Path, to: &Path) {
    std::fs::create_dir_all(to).unwrap();
    for entry in std::fs::read_dir(from).unwrap() {
        let entry = entry.unwrap();
        let target = to.join(entry.file_name());
        match entry.file_type().unwrap().is_dir() {
            true => copy(&entry.path(), &target),
            false => drop(std::fs::copy(entry.path(), target).unwrap()),
        }
    }
}

/// Files below a folder with their bytes.
fn files(folder: &Path) -> BTreeMap<PathBuf, Vec<u8>> {
    let mut found = BTreeMap::new();
    for entry in std::fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        if path.is_dir() {
            found.extend(files(&path));
        } else {
            let bytes = std::fs::read(&path).unwrap();
            found.insert(path, bytes);
        }
    }
    found
}

/// Runs a shown command in a folder; its output, or what is wrong.
fn run(shown: &Shown, folder: &Path) -> Result<String, String> {
    if shown.words[0] == "open" {
        return open(shown, folder);
    }
    let done = Command::new(env!("CARGO_BIN_EXE_kinecut"))
        .args(&shown.words)
        .current_dir(folder)
        .stdin(std::process::Stdio::null())
        .output()
        .unwrap();
    let stdout = String::from_utf8(done.stdout).unwrap();
    let stderr = String::from_utf8_lossy(&done.stderr);
    if done.status.code() != Some(shown.code) {
        return Err(format!(
            "exit code {:?}, the line says {}\n{stdout}{stderr}",
            done.status.code(),
            shown.code
        ));
    }
    if let Some(file) = &shown.redirected {
        std::fs::write(folder.join(file), &stdout).unwrap();
    }
    for file in &shown.files {
        if std::fs::metadata(folder.join(file)).map_or(0, |m| m.len()) == 0 {
            return Err(format!("{file} was not written\n{stdout}{stderr}"));
        }
    }
    if shown.words[0] == "run" {
        let out = folder.join("out");
        let missing: Vec<_> = RESULTS.iter().filter(|f| !out.join(f).is_file()).collect();
        if !missing.is_empty() {
            return Err(format!("{missing:?} not written"));
        }
    }
    let lines: Vec<&str> = stdout.lines().map(str::trim_end).collect();
    for line in shown.output.iter().filter(|l| !l.trim().is_empty() && l.trim() != "..") {
        if !lines.contains(&line.trim_end()) {
            return Err(format!("`{line}` is shown, but the output is\n{stdout}{stderr}"));
        }
    }
    Ok(stdout)
}

/// Opens the workbench that a document shows, without a browser, until it says its address.
fn open(shown: &Shown, folder: &Path) -> Result<String, String> {
    use std::io::{BufRead as _, BufReader};
    let mut program = Command::new(env!("CARGO_BIN_EXE_kinecut"))
        .args(shown.words.iter().filter(|word| *word != "--no-browser"))
        .arg("--no-browser")
        .current_dir(folder)
        .stdout(std::process::Stdio::piped())
        .spawn()
        .unwrap();
    let lines: Vec<String> =
        BufReader::new(program.stdout.take().unwrap()).lines().take(2).map(Result::unwrap).collect();
    program.kill().unwrap();
    program.wait().unwrap();
    let said = lines.join("\n");
    if said.contains("http://127.0.0.1:") { Ok(said) } else { Err(format!("no address: {said}")) }
}

/// Commands in their order, those that read `out` behind the first that wrote it; equal ones once.
fn in_order(documents: &[Document]) -> Vec<Vec<Shown>> {
    let mut chains: Vec<Vec<Shown>> = Vec::new();
    for document in documents {
        let mut first = None;
        for shown in &document.commands {
            let writes = shown.words.iter().any(|w| w == "--out");
            let reads = !writes && shown.words.iter().skip(1).any(|w| w.starts_with("out/"));
            if reads {
                let at = first.unwrap_or_else(|| panic!("{}: nothing has written `out`", shown.place));
                let chain: &mut Vec<Shown> = &mut chains[at];
                chain.push(shown.clone());
                continue;
            }
            let same = chains.iter().position(|c| c[0].words == shown.words && c[0].code == shown.code);
            let at = same.unwrap_or_else(|| {
                chains.push(vec![shown.clone()]);
                chains.len() - 1
            });
            chains[at][0].output.extend(shown.output.iter().filter(|_| same.is_some()).cloned());
            if shown.words[0] == "run" {
                first = first.or(Some(at));
            }
        }
    }
    chains
}

#[test]
fn every_shown_command_does_what_its_line_says() {
    let documents = documents();
    let chains = in_order(&documents);
    assert!(chains.len() > 40, "{}", chains.len());
    let temporary = folder("shown");
    let wrong = Mutex::new(Vec::new());
    let next = Mutex::new(chains.iter().enumerate());
    std::thread::scope(|scope| {
        for _ in 0..std::thread::available_parallelism().map_or(2, usize::from) {
            scope.spawn(|| {
                loop {
                    let Some((i, chain)) = next.lock().unwrap().next() else { break };
                    let folder = temporary.join(i.to_string());
                    copy(&root().join("examples"), &folder.join("examples"));
                    for shown in chain {
                        if let Err(e) = run(shown, &folder) {
                            wrong.lock().unwrap().push(format!(
                                "{}: {}\n{e}",
                                shown.place,
                                shown.words.join(" ")
                            ));
                        }
                    }
                    let changed = |(path, bytes): (&PathBuf, &Vec<u8>)| {
                        let original = root().join(path.strip_prefix(&folder).unwrap());
                        std::fs::read(original).ok().as_ref() != Some(bytes)
                    };
                    if files(&folder.join("examples")).iter().any(changed) {
                        wrong.lock().unwrap().push(format!("{}: writes beside the examples", chain[0].place));
                    }
                    std::fs::remove_dir_all(&folder).unwrap();
                }
            });
        }
    });
    let wrong = wrong.into_inner().unwrap();
    assert!(wrong.is_empty(), "{} of {}\n{}", wrong.len(), chains.len(), wrong.join("\n\n"));
}

#[test]
fn only_known_commands_of_others_are_shown() {
    for document in documents() {
        for (place, line) in &document.others {
            assert!(OTHERS.iter().any(|o| line.starts_with(o)), "{place}: `{line}` is not tried by any test");
        }
    }
}

/// `kinecut face --events`, named in a sentence: the verb has that option.
#[test]
fn options_that_are_named_are_options() {
    let mut helps: BTreeMap<String, String> = BTreeMap::new();
    let mut seen = 0;
    for document in documents() {
        for (place, words) in &document.named {
            let help = helps.entry(words[0].clone()).or_insert_with(|| {
                let done =
                    Command::new(env!("CARGO_BIN_EXE_kinecut")).args([&words[0], "--help"]).output().unwrap();
                assert!(done.status.success(), "{place}: no verb `{}`", words[0]);
                String::from_utf8(done.stdout).unwrap()
            });
            for option in words.iter().filter(|w| w.starts_with("--")) {
                let name = option.split('=').next().unwrap();
                let known = help.split(|c: char| !(c.is_alphanumeric() || c == '-')).any(|w| w == name);
                assert!(known, "{place}: `kinecut {}` has no {name}", words[0]);
                seen += 1;
            }
        }
    }
    assert!(seen > 2, "{seen}");
}

#[test]
fn files_that_are_named_are_there() {
    let mut seen = 0;
    for document in documents() {
        let folder = root().join(&document.name).parent().unwrap().to_path_buf();
        for (place, link) in &document.links {
            assert!(folder.join(link).exists(), "{place}: no file {link}");
            seen += 1;
        }
        for (place, path) in &document.paths {
            let there = [root(), folder.clone()].iter().any(|f| f.join(path).exists())
                || root().join("crates/kinecut").join(path).exists();
            assert!(there, "{place}: no file {path}");
            seen += 1;
        }
    }
    assert!(seen > 40, "{seen}");
}
