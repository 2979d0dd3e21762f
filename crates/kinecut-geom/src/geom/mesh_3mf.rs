//! 3MF files: a mesh in millimetres, as printers and CAD read it.

use std::fmt::Write as _;
use std::io::{Cursor, Write as _};

use zip::write::SimpleFileOptions;
use zip::{CompressionMethod, ZipWriter};

use super::Mesh;
use crate::base::{Code, Finding, Result};

/// The kinds of file by their endings.
const CONTENT_TYPES: &str = "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n\
    <Types xmlns=\"http://schemas.openxmlformats.org/package/2006/content-types\">\
    <Default Extension=\"rels\" ContentType=\"application/vnd.openxmlformats-package.relationships+xml\"/>\
    <Default Extension=\"model\" ContentType=\"application/vnd.ms-package.3dmanufacturing-3dmodel+xml\"/></Types>\n";

/// The place of the model.
const RELATIONS: &str = "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n\
    <Relationships xmlns=\"http://schemas.openxmlformats.org/package/2006/relationships\">\
    <Relationship Target=\"/3D/3dmodel.model\" Id=\"rel0\" \
    Type=\"http://schemas.microsoft.com/3dmanufacturing/2013/01/3dmodel\"/></Relationships>\n";

/// Deflate's level: a model is digits, which the lowest levels press nearly as well.
const LEVEL: i64 = 2;

/// A mesh as a 3MF file: positions as 32-bit floats [mm], each vertex once.
///
/// Source: 3MF Core Specification 1.3, sections 2 to 4.
///
/// ```
/// # use kinecut_geom as kinecut;
/// use kinecut::geom::{Mesh, write_3mf};
/// let corners = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 0.1]];
/// let mesh = Mesh {
///     vertices: corners.map(Into::into).to_vec(),
///     triangles: vec![[0, 2, 1], [0, 1, 3], [1, 2, 3], [0, 3, 2]],
/// };
/// let file = write_3mf(&mesh).unwrap();
/// // The directory of a package ends with the number of its files.
/// let end = file.windows(4).rposition(|w| w == b"PK\x05\x06").unwrap();
/// assert_eq!(file[end + 10], 3);
/// ```
///
/// # Errors
/// `KC0801` for a vertex that is not finite, and when the package would be too large for its format.
pub fn write_3mf(mesh: &Mesh) -> Result<Vec<u8>> {
    if let Some(i) = mesh.vertices.iter().position(|v| !v.is_finite()) {
        let finding = Finding::error(Code::GEOMETRY, "a vertex is not finite");
        return Err(finding.key(format!("vertices[{i}]")).into());
    }
    let model = model(mesh);
    let files =
        [("[Content_Types].xml", CONTENT_TYPES), ("_rels/.rels", RELATIONS), ("3D/3dmodel.model", &model)];
    package(&files).map_err(|e| {
        Finding::error(Code::GEOMETRY, format!("the mesh does not fit into a 3MF file: {e}"))
            .help("write it as STL or PLY, or with a coarser step")
            .into()
    })
}

/// Files in a package without times, so that its bytes depend on the files alone.
fn package(files: &[(&str, &str)]) -> zip::result::ZipResult<Vec<u8>> {
    /// From this size on a file needs the larger fields of the format.
    const LARGE: usize = u32::MAX as usize;
    let mut zip = ZipWriter::new(Cursor::new(Vec::new()));
    for (name, text) in files {
        let options = SimpleFileOptions::default()
            .compression_method(CompressionMethod::Deflated)
            .compression_level(Some(LEVEL))
            .large_file(text.len() >= LARGE);
        zip.start_file(*name, options)?;
        zip.write_all(text.as_bytes())?;
    }
    Ok(zip.finish()?.into_inner())
}

/// The model of one object.
fn model(mesh: &Mesh) -> String {
    // About the length of a line of each.
    let mut text = String::with_capacity(400 + 56 * mesh.vertices.len() + 48 * mesh.triangles.len());
    text.push_str(
        "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n\
         <model unit=\"millimeter\" xml:lang=\"en-US\" \
         xmlns=\"http://schemas.microsoft.com/3dmanufacturing/core/2015/02\">\n\
         <resources>\n<object id=\"1\" type=\"model\">\n<mesh>\n<vertices>\n",
    );
    // Writing into a string does not fail.
    for v in &mesh.vertices {
        let [x, y, z] = v.to_array().map(|c| c as f32);
        let _ = writeln!(text, "<vertex x=\"{x}\" y=\"{y}\" z=\"{z}\"/>");
    }
    text.push_str("</vertices>\n<triangles>\n");
    for [a, b, c] in &mesh.triangles {
        let _ = writeln!(text, "<triangle v1=\"{a}\" v2=\"{b}\" v3=\"{c}\"/>");
    }
    text.push_str("</triangles>\n</mesh>\n</object>\n</resources>\n<build>\n<item objectid=\"1\"/>\n</build>\n</model>\n");
    text
}

#[cfg(test)]
mod tests {
    use std::io::Read as _;

    use super::*;

    #[test]
    fn the_package_holds_the_mesh() {
        let corners = [[0.0, -1e-9, 12345.675], [1.0, 0.0, 0.0], [0.0, 1.5, 0.0], [0.0, 0.0, 0.1]];
        let mesh = Mesh {
            vertices: corners.map(Into::into).to_vec(),
            triangles: vec![[0, 2, 1], [0, 1, 3], [1, 2, 3], [0, 3, 2]],
        };
        let file = write_3mf(&mesh).unwrap();
        assert_eq!(file, write_3mf(&mesh).unwrap());
        let mut zip = zip::ZipArchive::new(Cursor::new(file)).unwrap();
        for name in ["[Content_Types].xml", "_rels/.rels", "3D/3dmodel.model"] {
            let mut text = String::new();
            zip.by_name(name).unwrap().read_to_string(&mut text).unwrap();
            let document = roxmltree::Document::parse(&text).unwrap();
            if !name.ends_with(".model") {
                continue;
            }
            assert_eq!(document.root_element().attribute("unit"), Some("millimeter"));
            let all = |tag: &str, keys: [&str; 3]| -> Vec<[f64; 3]> {
                let tagged = document.descendants().filter(|n| n.has_tag_name(tag_of(tag)));
                tagged.map(|n| keys.map(|k| n.attribute(k).unwrap().parse().unwrap())).collect()
            };
            let vertices = all("vertex", ["x", "y", "z"]);
            assert_eq!(vertices.len(), 4);
            for (read, given) in vertices.iter().flatten().zip(corners.iter().flatten()) {
                assert!((read - given).abs() <= 1e-7 * given.abs().max(1e-9), "{read} {given}");
            }
            let triangles = all("triangle", ["v1", "v2", "v3"]);
            let given: Vec<[f64; 3]> = mesh.triangles.iter().map(|t| t.map(f64::from)).collect();
            assert_eq!(triangles, given);
        }
    }

    fn tag_of(name: &str) -> (&'static str, &str) {
        ("http://schemas.microsoft.com/3dmanufacturing/core/2015/02", name)
    }
}
