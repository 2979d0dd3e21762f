//! The documents, taken apart: commands with what is said of them, links, files.

use crate::shell::root;

/// A command that a document shows.
#[derive(Clone, Debug)]
pub(crate) struct Shown {
    /// Document and line.
    pub(crate) place: String,
    /// Words behind `kinecut`.
    pub(crate) words: Vec<String>,
    /// Exit code: that of `exit code N` in the comment of the line, else 0.
    pub(crate) code: i32,
    /// File that takes standard output.
    pub(crate) redirected: Option<String>,
    /// Files that the line says are written.
    pub(crate) files: Vec<String>,
    /// Lines of output shown below it.
    pub(crate) output: Vec<String>,
}

/// A document, taken apart; each item with its place.
pub(crate) struct Document {
    /// Path from the root.
    pub(crate) name: String,
    /// Commands of kinecut, in their order.
    pub(crate) commands: Vec<Shown>,
    /// Other lines of shell blocks.
    pub(crate) others: Vec<(String, String)>,
    /// `kinecut VERB --option` in sentences: the words behind `kinecut`.
    pub(crate) named: Vec<(String, Vec<String>)>,
    /// Targets of relative links.
    pub(crate) links: Vec<(String, String)>,
    /// Files named between backticks with a folder in front.
    pub(crate) paths: Vec<(String, String)>,
}

/// README.md, DESIGN.md, docs/*.md, the READMEs of the examples, and the heads of their files.
pub(crate) fn documents() -> Vec<Document> {
    let mut names = vec!["README.md".to_owned(), "DESIGN.md".to_owned(), "examples/README.md".to_owned()];
    let listed = |folder: &str| {
        let entries = std::fs::read_dir(root().join(folder)).unwrap();
        entries.map(|e| e.unwrap().file_name().into_string().unwrap()).collect::<Vec<_>>()
    };
    let docs = listed("docs").into_iter().filter(|n| n.ends_with(".md"));
    names.extend(docs.map(|n| format!("docs/{n}")));
    let examples = listed("examples").into_iter().map(|n| format!("examples/{n}/README.md"));
    names.extend(examples.filter(|n| root().join(n).exists()));
    names.sort();
    assert!(names.len() > 12, "{names:?}");
    let mut all: Vec<Document> = names.iter().map(|n| document(n)).collect();
    let folders = listed("examples").into_iter().filter(|n| root().join("examples").join(n).is_dir());
    for folder in folders {
        let mut files = listed(&format!("examples/{folder}"));
        files.sort();
        let files = files.iter().filter(|n| n.ends_with(".toml") || n.ends_with(".ini"));
        all.extend(files.map(|n| head(&format!("examples/{folder}/{n}"))));
    }
    all
}

/// The commands that the head of an example's file shows, indented behind `#`.
fn head(name: &str) -> Document {
    let text = std::fs::read_to_string(root().join(name)).unwrap();
    let shown = text.lines().enumerate().filter_map(|(i, line)| {
        let line = line.strip_prefix("#     ")?;
        command(&format!("{name}:{}", i + 1), line)
    });
    let commands = shown.collect();
    let name = name.to_owned();
    Document { name, commands, others: Vec::new(), named: Vec::new(), links: Vec::new(), paths: Vec::new() }
}

/// Taken apart.
fn document(name: &str) -> Document {
    let mut document = Document {
        name: name.to_owned(),
        commands: Vec::new(),
        others: Vec::new(),
        named: Vec::new(),
        links: Vec::new(),
        paths: Vec::new(),
    };
    let text = std::fs::read_to_string(root().join(name)).unwrap();
    let (mut block, mut shell) = (None::<String>, false);
    for (number, line) in text.lines().enumerate() {
        let place = format!("{name}:{}", number + 1);
        if let Some(language) = line.strip_prefix("```") {
            let open = block.take().is_none().then(|| language.to_owned());
            // Output belongs to the shell block right before it.
            shell = shell && open.as_deref().is_none_or(|l| l == "text") || open.as_deref() == Some("sh");
            block = open;
            continue;
        }
        match block.as_deref() {
            Some("sh") if !line.trim().is_empty() => match command(&place, line) {
                Some(shown) => document.commands.push(shown),
                None => document.others.push((place, line.to_owned())),
            },
            Some("text") if shell => {
                document.commands.last_mut().unwrap().output.push(line.to_owned());
            }
            Some(_) => {}
            None => {
                shell &= line.trim().is_empty();
                sentence(&mut document, &place, line);
            }
        }
    }
    document
}

/// A shell line as a command of kinecut.
fn command(place: &str, line: &str) -> Option<Shown> {
    let rest = line.strip_prefix("kinecut ").or_else(|| line.strip_prefix("cargo run --release -- "))?;
    let (rest, comment) = rest.split_once(" #").unwrap_or((rest, ""));
    let rest = rest.split(" | ").next().unwrap();
    let (rest, redirected) = match rest.split_once(" > ") {
        Some((rest, file)) => (rest, Some(file.trim().to_owned())),
        None => (rest, None),
    };
    let words = words(rest);
    let after = |options: &[&str]| {
        let at = words.iter().position(|w| options.contains(&w.as_str()))?;
        words.get(at + 1).cloned()
    };
    let mut files: Vec<String> =
        [after(&["--svg"]), after(&["-o", "--output"])].into_iter().flatten().collect();
    if let Some(out) = after(&["--out"]) {
        let page = match words[0].as_str() {
            "run" | "simulate" => "report",
            "hole" if words.iter().any(|w| w == "--compare") => "compare",
            "grazing" if words.iter().any(|w| w == "--gallery") => "gallery",
            verb => verb,
        };
        files.push(format!("{out}/{page}.html"));
    }
    let code = comment
        .split_once("exit code ")
        .map_or(0, |(_, c)| c.chars().take_while(char::is_ascii_digit).collect::<String>().parse().unwrap());
    Some(Shown { place: place.to_owned(), words, code, redirected, files, output: Vec::new() })
}

/// Words of a shell line, double quotes taken off.
fn words(line: &str) -> Vec<String> {
    let quoted = line.split('"').enumerate().flat_map(|(i, part)| match i % 2 {
        0 => part.split_whitespace().map(str::to_owned).collect::<Vec<_>>(),
        _ => vec![part.to_owned()],
    });
    quoted.collect()
}

/// Links, files and options that a sentence names.
fn sentence(document: &mut Document, place: &str, line: &str) {
    for part in line.split("](").skip(1) {
        let target = part.split([')', '#']).next().unwrap();
        if !target.is_empty() && !target.contains("://") {
            document.links.push((place.to_owned(), target.to_owned()));
        }
    }
    for span in line.split('`').skip(1).step_by(2) {
        if let Some(rest) = span.strip_prefix("kinecut ") {
            // A whole command, of a table: it is run as those of shell blocks are.
            if span.contains("examples/") {
                document.commands.extend(command(place, span));
            } else if rest.starts_with(|c: char| c.is_ascii_lowercase()) {
                document.named.push((place.to_owned(), words(rest)));
            }
            continue;
        }
        if names_a_file(span) {
            document.paths.push((place.to_owned(), span.to_owned()));
        }
    }
}

/// A path below a folder of the repository, or with a folder and an ending.
fn names_a_file(span: &str) -> bool {
    let plain = |c: char| c.is_ascii_alphanumeric() || "/_-.".contains(c);
    let Some((folder, last)) = span.rsplit_once('/') else { return false };
    let below = ["examples", "docs", "crates", "tests"].iter().any(|f| span.starts_with(&format!("{f}/")));
    // `examples/NAME/job.toml` stands for many, `/job.toml` and `../` for none, and `out/` holds what a run writes.
    let many = span.contains("NAME") || folder.is_empty() || span.contains("..") || folder == "out";
    span.chars().all(plain) && !many && (below || last.contains('.'))
}
