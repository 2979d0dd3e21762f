//! The zip package of a Fusion library: one JSON file.

use std::io::{Cursor, Read};

use crate::base::{Code, Finding, Result};

/// Most bytes of the file in a package: what is read is counted, whatever the package says.
const MOST_BYTES: u64 = 64_000_000;
/// Most files of a package.
const MOST_FILES: usize = 4096;

/// Whether bytes are a zip package.
pub(super) fn is_package(bytes: &[u8]) -> bool {
    bytes.starts_with(b"PK\x03\x04") || bytes.starts_with(b"PK\x05\x06")
}

/// The JSON text of a package: `tools.json`, or else the first file of that ending.
pub(super) fn package_text(bytes: &[u8]) -> Result<String> {
    let broken = |e: &dyn std::fmt::Display| unreadable(format!("the package of tools is broken: {e}"));
    let mut zip = zip::ZipArchive::new(Cursor::new(bytes)).map_err(|e| broken(&e))?;
    if zip.len() > MOST_FILES {
        return Err(unreadable("the package of tools has too many files")
            .value(zip.len() as f64, "files")
            .bound(MOST_FILES as f64, "files")
            .into());
    }
    let names: Vec<String> =
        zip.file_names().filter_map(|name| name.ok().map(std::borrow::Cow::into_owned)).collect();
    let is_json = |name: &&String| name.to_ascii_lowercase().ends_with(".json");
    let wanted = names.iter().find(|name| *name == "tools.json").or_else(|| names.iter().find(is_json));
    let Some(wanted) = wanted else {
        return Err(unreadable("the package of tools holds no tools.json").into());
    };
    let file = zip.by_name(wanted).map_err(|e| broken(&e))?;
    let mut text = String::new();
    file.take(MOST_BYTES + 1).read_to_string(&mut text).map_err(|e| broken(&e))?;
    if text.len() as u64 > MOST_BYTES {
        return Err(unreadable("the JSON file of the package of tools is too large")
            .bound(MOST_BYTES as f64, "bytes")
            .into());
    }
    Ok(text)
}

fn unreadable(what: impl Into<String>) -> Finding {
    Finding::error(Code::TOOL_FILE, what.into()).help("export the library again")
}
