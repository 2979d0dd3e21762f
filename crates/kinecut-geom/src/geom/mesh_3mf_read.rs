//! 3MF files as a mesh: all items of the build, in millimetres.
//!
//! Source: 3MF Core Specification 1.3, sections 2 to 4. Extensions that give form (beams, slices, booleans) are refused where a file
//! says that it needs them.

use std::cell::Cell;
use std::collections::BTreeMap;
use std::io::{Cursor, Read as _};

use glam::{DMat3, DVec3};
use roxmltree::{Document, Node};

use super::Mesh;
use crate::base::{Code, Finding, Result};

/// Most bytes of an unpacked model: about eight million triangles.
const MOST_BYTES: u64 = 1 << 28;
/// Most triangles of all items: parts may be used many times.
const MOST_TRIANGLES: usize = 16_000_000;
/// Most objects that are placed.
const MOST_PLACED: u32 = 1_000_000;
/// Most levels of components within components.
const MOST_LEVELS: u32 = 32;
/// The namespace of the core specification.
const CORE: &str = "http://schemas.microsoft.com/3dmanufacturing/core/2015/02";

/// Reads a 3MF file [mm].
///
/// ```
/// # use kinecut_geom as kinecut;
/// use kinecut::geom::{Mesh, read_3mf, write_3mf};
/// let corners = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 0.5]];
/// let mesh = Mesh {
///     vertices: corners.map(Into::into).to_vec(),
///     triangles: vec![[0, 2, 1], [0, 1, 3], [1, 2, 3], [0, 3, 2]],
/// };
/// assert_eq!(read_3mf(&write_3mf(&mesh).unwrap()).unwrap(), mesh);
/// assert!(read_3mf(b"solid t").is_err());
/// ```
///
/// # Errors
/// `KC0601` where the package or its model cannot be read, is too large, names what it does not hold, needs an extension, or holds no
/// triangle.
pub fn read_3mf(bytes: &[u8]) -> Result<Mesh> {
    let text = model_text(bytes)?;
    let document = Document::parse(&text).map_err(|e| unreadable(format!("the model of a 3MF file: {e}")))?;
    let model = Model::of(document.root_element())?;
    let mut mesh = Mesh { vertices: Vec::new(), triangles: Vec::new() };
    let build = children(document.root_element(), "build");
    for item in build.flat_map(|build| children(build, "item")) {
        let place = Place::of(item.attribute("transform"))?;
        model.put(attribute(item, "objectid")?, &place, 0, &mut mesh)?;
    }
    if mesh.triangles.is_empty() {
        return Err(unreadable("the build of a 3MF file holds no triangle").into());
    }
    Ok(mesh)
}

fn unreadable(what: impl Into<String>) -> Finding {
    Finding::error(Code::MESH_UNREADABLE, what.into()).help("write it again as 3MF, or as STL")
}

/// The text of the model that the package starts with.
fn model_text(bytes: &[u8]) -> Result<String> {
    let broken = |e: zip::result::ZipError| unreadable(format!("a 3MF file is not a package: {e}"));
    let mut zip = zip::ZipArchive::new(Cursor::new(bytes)).map_err(broken)?;
    let mut file = |name: &str| -> Result<Option<String>> {
        let Ok(file) = zip.by_name(name) else { return Ok(None) };
        let mut text = String::new();
        let read = file.take(MOST_BYTES + 1).read_to_string(&mut text);
        let read = read.map_err(|e| unreadable(format!("`{name}` of a 3MF file: {e}")))?;
        if read as u64 > MOST_BYTES {
            return Err(unreadable(format!("`{name}` of a 3MF file is too large"))
                .bound(MOST_BYTES as f64 / 1e6, "MB")
                .into());
        }
        Ok(Some(text))
    };
    let relations = file("_rels/.rels")?.unwrap_or_default();
    let start = Document::parse(&relations).ok().and_then(|relations| {
        let is_model = |n: &Node<'_, '_>| n.attribute("Type").is_some_and(|t| t.ends_with("/3dmodel"));
        let target = relations.descendants().find(is_model)?.attribute("Target")?;
        Some(target.trim_start_matches('/').to_owned())
    });
    let name = start.unwrap_or_else(|| "3D/3dmodel.model".to_owned());
    file(&name)?.ok_or_else(|| unreadable(format!("a 3MF file does not hold its model `{name}`")).into())
}

/// The objects of a model.
struct Model<'a> {
    objects: BTreeMap<&'a str, Node<'a, 'a>>,
    /// Length of its unit [mm].
    unit: f64,
    /// Objects that were placed.
    placed: Cell<u32>,
}

impl<'a> Model<'a> {
    fn of(root: Node<'a, 'a>) -> Result<Model<'a>> {
        let unit = match root.attribute("unit").unwrap_or("millimeter") {
            "micron" => 1e-3,
            "millimeter" => 1.0,
            "centimeter" => 10.0,
            "inch" => 25.4,
            "foot" => 304.8,
            "meter" => 1000.0,
            other => {
                return Err(unreadable(format!("a 3MF file counts in `{}`", other.escape_default())).into());
            }
        };
        if let Some(needed) = root.attribute("requiredextensions").map(str::trim).filter(|n| !n.is_empty()) {
            return Err(unreadable(format!("a 3MF file needs the extensions `{}`", needed.escape_default()))
                .help("write its core form only, or STL")
                .into());
        }
        let resources = children(root, "resources").flat_map(|resources| children(resources, "object"));
        let objects = resources.map(|object| Ok((attribute(object, "id")?, object)));
        Ok(Model { objects: objects.collect::<Result<_>>()?, unit, placed: Cell::new(0) })
    }

    /// Puts an object at a place.
    fn put(&self, id: &str, place: &Place, level: u32, mesh: &mut Mesh) -> Result<()> {
        let refused = |what: &str| unreadable(format!("a 3MF file {what} object `{}`", id.escape_default()));
        let object = self.objects.get(id).ok_or_else(|| refused("has no"))?;
        self.placed.set(self.placed.get() + 1);
        if level >= MOST_LEVELS || self.placed.get() > MOST_PLACED {
            return Err(refused("has too many components at").into());
        }
        for own in children(*object, "mesh") {
            self.put_mesh(own, place, mesh)?;
        }
        for component in children(*object, "components").flat_map(|all| children(all, "component")) {
            let own = Place::of(component.attribute("transform"))?;
            self.put(attribute(component, "objectid")?, &place.after(&own), level + 1, mesh)?;
        }
        Ok(())
    }

    fn put_mesh(&self, own: Node<'_, '_>, place: &Place, mesh: &mut Mesh) -> Result<()> {
        let before = mesh.vertices.len();
        for vertex in children(own, "vertices").flat_map(|all| children(all, "vertex")) {
            let p = DVec3::new(number(vertex, "x")?, number(vertex, "y")?, number(vertex, "z")?);
            mesh.vertices.push((place.matrix * p + place.shift) * self.unit);
        }
        let count = mesh.vertices.len() - before;
        // A mirrored place turns triangles inside out.
        let mirrored = place.matrix.determinant() < 0.0;
        for triangle in children(own, "triangles").flat_map(|all| children(all, "triangle")) {
            if mesh.triangles.len() >= MOST_TRIANGLES || mesh.vertices.len() > u32::MAX as usize {
                return Err(unreadable("a 3MF file holds too many triangles")
                    .bound(MOST_TRIANGLES as f64, "triangles")
                    .into());
            }
            let corner = |key: &str| -> Result<u32> {
                let text = attribute(triangle, key)?;
                let index = text.parse::<usize>().ok().filter(|i| *i < count).ok_or_else(|| {
                    unreadable(format!(
                        "a triangle of a 3MF file names the vertex `{}`",
                        text.escape_default()
                    ))
                    .bound(count as f64, "vertices")
                })?;
                Ok((before + index) as u32)
            };
            let [a, b, c] = [corner("v1")?, corner("v2")?, corner("v3")?];
            mesh.triangles.push(if mirrored { [a, c, b] } else { [a, b, c] });
        }
        Ok(())
    }
}

/// An affine map.
struct Place {
    matrix: DMat3,
    shift: DVec3,
}

impl Place {
    /// Of twelve numbers, row by row: three rows of the transposed matrix, then the shift.
    fn of(text: Option<&str>) -> Result<Place> {
        let Some(text) = text else { return Ok(Place { matrix: DMat3::IDENTITY, shift: DVec3::ZERO }) };
        let numbers: Option<Vec<f64>> = text.split_whitespace().map(finite).collect();
        let Some(Ok(m)) = numbers.map(<[f64; 12]>::try_from) else {
            return Err(unreadable(format!("a 3MF file places a part by `{}`", text.escape_default()))
                .help("twelve numbers are needed")
                .into());
        };
        let row = |i: usize| DVec3::new(m[3 * i], m[3 * i + 1], m[3 * i + 2]);
        Ok(Place { matrix: DMat3::from_cols(row(0), row(1), row(2)), shift: row(3) })
    }

    /// This map behind another one.
    fn after(&self, first: &Place) -> Place {
        Place { matrix: self.matrix * first.matrix, shift: self.matrix * first.shift + self.shift }
    }
}

fn finite(text: &str) -> Option<f64> {
    text.parse::<f64>().ok().filter(|v| v.is_finite())
}

fn number(node: Node<'_, '_>, key: &str) -> Result<f64> {
    let text = attribute(node, key)?;
    let said = || unreadable(format!("a vertex of a 3MF file has {key} `{}`", text.escape_default()));
    Ok(finite(text).ok_or_else(said)?)
}

fn attribute<'a>(node: Node<'a, '_>, key: &str) -> Result<&'a str> {
    let name = node.tag_name().name();
    Ok(node.attribute(key).ok_or_else(|| unreadable(format!("a `{name}` of a 3MF file has no `{key}`")))?)
}

/// The children of a name; those of other namespaces are left out.
fn children<'a, 'i>(node: Node<'a, 'i>, name: &'static str) -> impl Iterator<Item = Node<'a, 'i>> {
    node.children().filter(move |n| {
        let tag = n.tag_name();
        n.is_element() && tag.name() == name && tag.namespace().is_none_or(|space| space == CORE)
    })
}

#[cfg(test)]
mod tests {
    use std::io::Write as _;

    use super::*;

    const MESH: &str = "<mesh><vertices><vertex x=\"0\" y=\"0\" z=\"0\"/><vertex x=\"1\" y=\"0\" z=\"0\"/>\
        <vertex x=\"0\" y=\"1\" z=\"0\"/><vertex x=\"0\" y=\"0\" z=\"1\"/></vertices><triangles>\
        <triangle v1=\"0\" v2=\"2\" v3=\"1\"/><triangle v1=\"0\" v2=\"1\" v3=\"3\"/>\
        <triangle v1=\"1\" v2=\"2\" v3=\"3\"/><triangle v1=\"0\" v2=\"3\" v3=\"2\"/></triangles></mesh>";

    fn package(attributes: &str, resources: &str, build: &str) -> Vec<u8> {
        let model = format!(
            "<model xmlns=\"{CORE}\" {attributes}><resources>{resources}</resources><build>{build}</build></model>"
        );
        let mut zip = zip::ZipWriter::new(Cursor::new(Vec::new()));
        zip.start_file("3D/3dmodel.model", zip::write::SimpleFileOptions::default()).unwrap();
        zip.write_all(model.as_bytes()).unwrap();
        zip.finish().unwrap().into_inner()
    }

    #[test]
    fn items_components_units_and_mirrors_are_placed() {
        let resources = format!(
            "<object id=\"1\">{MESH}</object><object id=\"2\"><components>\
            <component objectid=\"1\" transform=\"1 0 0 0 1 0 0 0 1 5 0 0\"/>\
            <component objectid=\"1\" transform=\"-1 0 0 0 1 0 0 0 1 0 0 0\"/></components></object>"
        );
        let build = "<item objectid=\"2\" transform=\"0 1 0 -1 0 0 0 0 1 0 0 2\"/>";
        let mesh = read_3mf(&package("unit=\"centimeter\"", &resources, build)).unwrap();
        assert_eq!(mesh.triangles.len(), 8);
        assert!((mesh.volume() - 2.0 * 1000.0 / 6.0).abs() < 1e-9, "{}", mesh.volume());
        mesh.check_closed().unwrap();
        // X goes to Y, Y to -X: the first is at Y 50 to 60, both begin at Z 20.
        let bounds = mesh.bounds();
        assert!((bounds.max - DVec3::new(0.0, 60.0, 30.0)).length() < 1e-9, "{bounds:?}");
        assert!((bounds.min - DVec3::new(-10.0, -10.0, 20.0)).length() < 1e-9, "{bounds:?}");
    }

    #[test]
    fn what_cannot_be_read_is_refused_with_its_reason() {
        let object = format!("<object id=\"1\">{MESH}</object>");
        let item = "<item objectid=\"1\"/>";
        let wild = object.replace("v3=\"1\"", "v3=\"7\"");
        let nan = object.replace("x=\"1\"", "x=\"nan\"");
        let round =
            "<object id=\"1\"><components><component objectid=\"1\"/></components></object>".to_owned();
        // Each level holds the next one twice: without an end in sight, and without a triangle.
        let level = |i: u32| {
            let next = i + 1;
            format!(
                "<object id=\"{i}\"><components><component objectid=\"{next}\"/><component objectid=\"{next}\"/></components></object>"
            )
        };
        let twice = (1..30).map(level).collect::<String>() + "<object id=\"30\"><mesh/></object>";
        for (attributes, resources, build, says) in [
            ("unit=\"mile\"", &object, item, "counts in `mile`"),
            ("requiredextensions=\"b\"", &object, item, "needs the extensions `b`"),
            ("", &object, "", "no triangle"),
            ("", &object, "<item objectid=\"3\"/>", "has no object `3`"),
            ("", &object, "<item/>", "has no `objectid`"),
            ("", &object, "<item objectid=\"1\" transform=\"1 0\"/>", "places a part by"),
            ("", &wild, item, "names the vertex `7`"),
            ("", &nan, item, "has x `nan`"),
            ("", &round, item, "too many components"),
            ("", &twice, item, "too many components"),
        ] {
            let error = read_3mf(&package(attributes, resources, build)).unwrap_err().to_string();
            assert!(error.contains(says), "{says}: {error}");
        }
        let mut broken = package("", &object, item);
        broken.truncate(60);
        assert!(read_3mf(&broken).unwrap_err().to_string().contains("not a package"));
    }
}
