//! The front door: an outline from the bytes of a file.

use super::{OutlineOptions, OutlineRead, OutlineReads, dxf, json, mesh_face, svg};
use crate::base::{Code, Finding, Location, Result};

/// An outline from the bytes of a file, by the ending of its name: `.dxf`, `.svg`, `.json`, `.stl`.
///
/// ```
/// # use kinecut_geom as kinecut;
/// use kinecut::geom::{OutlineOptions, read_outline};
/// let text = br#"{ "unit": "cm", "loops": [[[0, 0], [4, 0], [4, 3, 1], [0, 3]], {"centre": [2, 1], "radius": 0.5}] }"#;
/// let read = read_outline("plate.json", text, &OutlineOptions::default())?;
/// let pi = std::f64::consts::PI;
/// assert!((read.outline.area() - (1200.0 + 200.0 * pi - 25.0 * pi)).abs() < 1e-9);
/// # Ok::<(), kinecut::base::Error>(())
/// ```
///
/// # Errors
/// `KC0802` for a file that cannot be read, with line, entity and help; `KC0803` for loops that do not close, with place
/// and width of the gap; `KC0804` where edges meet that must not; `KC0805` for edges without length; `KC0601` and
/// `KC0602` for meshes.
pub fn read_outline(name: &str, bytes: &[u8], options: &OutlineOptions) -> Result<OutlineRead> {
    options.check()?;
    let ending = name.rsplit_once('.').map(|(_, ending)| ending.to_ascii_lowercase()).unwrap_or_default();
    if options.reads != OutlineReads::Loops && ending == "stl" {
        let finding =
            Finding::error(Code::OUTLINE_FILE, format!("files of the kind {ending:?} hold no open line"));
        let help =
            "export the line as .dxf, .svg or .json, or write its points: polyline = [[0, 0], [60, 0]]";
        return Err(finding.at(Location::whole_file(name)).help(help).into());
    }
    match ending.as_str() {
        "dxf" => dxf::read_dxf(name, bytes, options),
        "svg" => svg::read_svg(name, bytes, options),
        "json" => json::read_json(name, bytes, options),
        "stl" => mesh_face::read_stl_face(name, bytes, options),
        _ => Err(Finding::error(Code::OUTLINE_FILE, format!("files of the kind {ending:?} hold no outline"))
            .at(Location::whole_file(name))
            .help("export the face as .dxf, .svg or .json, or the part as .stl")
            .into()),
    }
}
