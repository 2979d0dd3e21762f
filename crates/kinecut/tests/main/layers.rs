//! The architecture as a test: a layer imports only layers below it.
//!
//! The table is that of ARCHITECTURE.md. Cargo holds the order of the crates; this test holds that of the folders in them.

use std::fs;
use std::path::{Path, PathBuf};

/// Crates and their layers, from the lowest to the highest. Layers of one row know nothing of one another.
const LAYERS: &[(&str, &[&[&str]])] = &[
    ("kinecut-geom", &[&["base"], &["num"], &["geom"], &["tool"]]),
    ("kinecut-machine", &[&["machine"]]),
    ("kinecut-nc", &[&["program"], &["trace"], &["nc"]]),
    ("kinecut-stock", &[&["sweep"], &["contact", "stock"]]),
    (
        "kinecut-plan",
        &[
            &["motion", "cutting"],
            &["holes", "drilling", "facing"],
            &["clearing", "threading"],
            &["contouring"],
        ],
    ),
    ("kinecut", &[&["page"], &["operations"], &["job"], &["verbs"]]),
];

/// Layers that may touch the file system.
const FILE_ACCESS: &[&str] = &[
    "base/loader.rs",
    "job/output/mod.rs",
    "job/output/disk.rs",
    "job/output/streamed.rs",
    "job/output/turn.rs",
    "job/output/tests.rs",
];

fn crates() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("..")
}

fn rows() -> impl Iterator<Item = &'static [&'static str]> {
    LAYERS.iter().flat_map(|(_, rows)| rows.iter().copied())
}

fn rank(layer: &str) -> Option<usize> {
    rows().position(|row| row.contains(&layer))
}

/// Every source file of the library with its path below the `src` of its crate.
fn sources() -> Vec<(String, PathBuf)> {
    let mut sources = Vec::new();
    for (name, _) in LAYERS {
        let root = crates().join(name).join("src");
        let mut files = Vec::new();
        rust_files(&root, &mut files);
        sources.extend(
            files
                .into_iter()
                .map(|file| (file.strip_prefix(&root).unwrap().to_str().unwrap().replace('\\', "/"), file)),
        );
    }
    sources
}

fn rust_files(folder: &Path, files: &mut Vec<PathBuf>) {
    for entry in fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        if path.is_dir() {
            rust_files(&path, files);
        } else if path.extension().is_some_and(|e| e == "rs") {
            files.push(path);
        }
    }
    files.sort();
}

/// The layer names that a source text refers to by `crate::`; doc examples and comments do not count.
fn imports(text: &str) -> Vec<String> {
    let code = text.lines().filter(|l| !l.trim_start().starts_with("//")).collect::<Vec<_>>().join("\n");
    code.match_indices("crate::")
        .flat_map(|(at, _)| {
            let rest = &code[at + "crate::".len()..];
            let one = |t: &str| {
                t.trim().chars().take_while(|c| c.is_alphanumeric() || *c == '_').collect::<String>()
            };
            match rest.strip_prefix('{') {
                Some(group) => {
                    let mut depth = 0;
                    let mut names = vec![String::new()];
                    for c in group.chars() {
                        match c {
                            '{' => depth += 1,
                            '}' if depth == 0 => break,
                            '}' => depth -= 1,
                            ',' if depth == 0 => names.push(String::new()),
                            c => names.last_mut().unwrap().push(c),
                        }
                    }
                    names.iter().map(|n| one(n)).collect()
                }
                None => vec![one(rest)],
            }
        })
        .collect()
}

#[test]
fn imports_are_recognised_in_every_form() {
    let text = "use crate::geom::{A, B};\n// use crate::report::X;\nlet y = crate::num::angle::wrap(1.0);\nuse crate::{base::C, stock::{D, E}, tool};";
    assert_eq!(imports(text), ["geom", "num", "base", "stock", "tool"]);
}

#[test]
fn every_folder_is_a_layer_of_its_crate() {
    for (name, rows) in LAYERS {
        for entry in fs::read_dir(crates().join(name).join("src")).unwrap() {
            let entry = entry.unwrap();
            let folder = entry.file_name().into_string().unwrap();
            if entry.path().is_dir() {
                let known = rows.iter().any(|row| row.contains(&folder.as_str()));
                assert!(known, "{name}: folder `{folder}` is not in the layer table");
            } else {
                assert_eq!(folder, "lib.rs", "{name}: only lib.rs lies beside the layers");
            }
        }
    }
}

#[test]
fn no_layer_imports_a_higher_one() {
    let mut seen = 0;
    for (relative, file) in sources() {
        let layer = relative.split('/').next().unwrap();
        if layer == "lib.rs" {
            continue;
        }
        let own = rank(layer).unwrap();
        for import in imports(&fs::read_to_string(&file).unwrap()) {
            let Some(other) = rank(&import) else { continue };
            seen += 1;
            let same = import == layer;
            assert!(other < own || same, "{relative}: `{layer}` imports `{import}`, which is not below it");
        }
    }
    assert!(seen > 50, "the scan has found only {seen} imports: it no longer works");
}

#[test]
fn only_the_loader_and_the_output_touch_files() {
    for (relative, file) in sources() {
        let text = fs::read_to_string(&file).unwrap();
        let code = text.lines().filter(|l| !l.trim_start().starts_with("//")).collect::<Vec<_>>().join("\n");
        if !FILE_ACCESS.contains(&relative.as_str()) {
            assert!(
                !code.contains("std::fs") && !code.contains("File::open"),
                "{relative} touches the file system"
            );
        }
        assert!(!code.contains("println!") || relative.contains("tests"), "{relative} prints");
    }
}

#[test]
fn every_property_takes_its_count_from_the_one_setting() {
    let mut files: Vec<PathBuf> = sources().into_iter().map(|(_, file)| file).collect();
    rust_files(&Path::new(env!("CARGO_MANIFEST_DIR")).join("tests"), &mut files);
    let block = concat!("proptest", "! {");
    let mut seen = 0;
    for file in files {
        let text = fs::read_to_string(&file).unwrap();
        for (at, _) in text.match_indices(block) {
            let config = text[at + block.len()..].trim_start().lines().next().unwrap_or_default();
            let counted =
                config.starts_with("#![proptest_config(") && config.contains("kinecut_cases::property(");
            assert!(counted, "{}: begin with `kinecut_cases::property`, not with `{config}`", file.display());
            seen += 1;
        }
    }
    assert!(seen > 50, "the scan has found only {seen} properties: it no longer works");
}
