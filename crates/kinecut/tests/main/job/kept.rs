//! Reports and programs of all examples, word by word.

use std::path::Path;

use kinecut::base::{DiskLoader, Silent};
use kinecut::job::report::{of_job, sections};
use kinecut::page::{WIDTH, text};

use crate::common::kept::assert_kept;

/// The version stands in every program, and with it the hash of the program changes.
fn without_version(text: &str) -> String {
    let lines = text.lines().filter(|l| !l.trim_start().starts_with("Program SHA-256"));
    lines.map(|l| l.replace(env!("CARGO_PKG_VERSION"), "VERSION") + "\n").collect()
}

/// The head of a long program stands for all of it, beside its length: the rest repeats it level by level.
fn head(text: &str) -> String {
    const LINES: usize = 150;
    let count = text.lines().count();
    if count <= LINES {
        return text.to_owned();
    }
    let head: String = text.lines().take(LINES).map(|l| format!("{l}\n")).collect();
    format!("{head}.. {count} lines in all\n")
}

/// The job with a coarse grid: shapes and contacts of the reports are exact along fewer lines.
fn coarse(job: &str) -> String {
    let simulate = |l: &str| {
        if l.starts_with("simulate =") { "simulate = { step = 1.0 }".to_owned() } else { l.to_owned() }
    };
    job.lines().map(|l| simulate(l) + "\n").collect()
}

#[test]
fn reports_and_programs_of_all_examples_are_those_kept() {
    let examples = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../examples");
    let mut jobs = 0;
    for folder in std::fs::read_dir(examples).unwrap().map(|e| e.unwrap().path()).filter(|p| p.is_dir()) {
        let files =
            std::fs::read_dir(&folder).unwrap().map(|e| e.unwrap().file_name().into_string().unwrap());
        for file in files.filter(|f| f.starts_with("job") && f.ends_with(".toml")) {
            let job = coarse(&std::fs::read_to_string(folder.join(&file)).unwrap());
            let outcome = kinecut::job::run(&file, &job, &DiskLoader::new(&folder), &Silent)
                .unwrap_or_else(|e| panic!("{}: {e}", folder.display()));
            let mut kept = text(&sections(&of_job(&outcome)), WIDTH);
            for setup in &outcome.setups {
                kept += &format!("\n{}\n{}", setup.file, head(&setup.posted.text));
            }
            let number = folder.file_name().unwrap().to_str().unwrap();
            assert_kept(&format!("{number}.{}", file.trim_end_matches(".toml")), &without_version(&kept));
            jobs += 1;
        }
    }
    assert!(jobs >= 15, "{jobs} examples");
}
