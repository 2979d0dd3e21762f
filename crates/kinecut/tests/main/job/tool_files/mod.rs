//! Tool files: each format by small files written for the tests, names and numbers that operations call, round trips.

mod called;
mod freecad;
mod fusion;
mod round_trip;
mod shop;
mod table;

use kinecut::base::{Error, FileKind, Loader, MemoryLoader, Result, Sources};
use kinecut::job::file::ToolFileTable;
use kinecut::job::library::{Library, LibraryTool, read_library};

/// A file of a name.
fn named(file: &str) -> ToolFileTable {
    ToolFileTable { file: file.to_owned(), ..ToolFileTable::default() }
}

/// Reads one file in memory.
fn read(file: &str, content: impl Into<Vec<u8>>) -> Result<Library> {
    read_library(&mut Sources::default(), &named(file), &MemoryLoader::default().with(file, content))
}

fn wrong(file: &str, content: impl Into<Vec<u8>>) -> Error {
    read(file, content).map(|library| library.tools).unwrap_err()
}

/// The keys that a tool lacks.
fn lacks(tool: &LibraryTool) -> Vec<&str> {
    tool.missing.iter().map(|missing| missing.key).collect()
}

fn near(a: f64, b: f64) -> bool {
    (a - b).abs() <= 1e-9 * b.abs().max(1.0)
}

#[test]
fn a_file_is_known_by_its_content() {
    let own = "[[tool]]\nnumber = 1\ntype = \"end-mill\"\ndiameter = 10\nflute_length = 22\n";
    let json = r#"{"tool": [{"number": 1, "type": "end-mill", "diameter": 10, "flute_length": 22}]}"#;
    for (file, text) in [("a.toml", own), ("a.txt", own), ("a.json", json), ("a.tools", json)] {
        assert_eq!(read(file, text).unwrap().tools, read("b.toml", own).unwrap().tools, "{file}");
    }
    // A mark of the order of bytes says nothing.
    assert_eq!(read("a.toml", format!("\u{feff}{own}")).unwrap().tools.len(), 1);
    assert_eq!(read("a.json", format!("\u{feff}{json}")).unwrap().tools.len(), 1);
}

#[test]
fn wrong_files_are_refused_at_their_place() {
    let place = |error: &Error| error.0.place.clone().map(|p| (p.file, p.line)).unwrap();
    let error = wrong("a.json", "{\"data\": [\n  {\"type\": }\n]}");
    assert_eq!((error.code().to_string().as_str(), place(&error)), ("KC0706", ("a.json".to_owned(), 2)));
    let error = wrong("a.json", "{\"name\": \"x\"}");
    assert_eq!((error.code().to_string().as_str(), place(&error).0), ("KC0706", "a.json".to_owned()));
    let error = wrong("a.tools", b"PK\x03\x04 and no more".to_vec());
    assert_eq!((error.code().to_string().as_str(), place(&error).0), ("KC0706", "a.tools".to_owned()));
    let error = wrong("a.toml", "[[tool]]\nnumber = 1\ndiametre = 5\n");
    assert_eq!((error.code().to_string().as_str(), place(&error)), ("KC0102", ("a.toml".to_owned(), 3)));
    assert!(error.0.help.contains("diameter"), "{error}");
    let twice = "[[tool]]\nnumber = 1\ntype = \"drill\"\ndiameter = 5\nflute_length = 9\n";
    let error = wrong("a.toml", twice.repeat(2));
    assert_eq!((error.code().to_string().as_str(), place(&error)), ("KC0103", ("a.toml".to_owned(), 7)));
    assert!(error.to_string().contains("T1 is defined twice"), "{error}");
    assert!(MemoryLoader::default().read_as("b", FileKind::Text).is_err());
    assert_eq!(wrong("a.toml", vec![0xff_u8, 0xfe, 0]).code().to_string(), "KC0002");
}

#[test]
fn what_a_file_cannot_have_is_not_said_of_it() {
    let loader = MemoryLoader::default().with("a.toml", "").with("b.tbl", "T1 D5\nT2 D6\n");
    let told = |table: ToolFileTable| read_library(&mut Sources::default(), &table, &loader).unwrap_err();
    assert!(told(ToolFileTable { inches: true, ..named("a.toml") }).to_string().contains("units itself"));
    assert!(told(ToolFileTable { number: Some(3), ..named("b.tbl") }).to_string().contains("several tools"));
}
