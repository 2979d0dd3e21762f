//! STL files: reading binary and text, writing binary.
//!
//! An STL file has no shared vertices; corners with the same numbers become one vertex. Triangles that thereby have
//! two equal corners are slivers without area and are left out (their neighbours then share an edge).

use std::collections::HashMap;

use glam::DVec3;

use super::Mesh;
use crate::base::{Code, Finding, Result};

/// Bytes before the triangles of a binary file: a comment of 80 and the count.
const HEAD: usize = 84;
/// Bytes of a triangle: normal, three corners, attributes.
const TRIANGLE: usize = 50;

/// Reads an STL file [mm], binary or text.
///
/// # Errors
/// `KC0601` when the bytes are neither, end early or go on after the last triangle, hold a number that is not
/// finite, or hold no triangle.
///
/// ```
/// # use kinecut_geom as kinecut;
/// use kinecut::geom::read_stl;
/// let text = b"solid t facet normal 0 0 1 outer loop vertex 0 0 0 vertex 1 0 0 vertex 0 1 0 endloop endfacet endsolid";
/// assert_eq!(read_stl(text).unwrap().vertices.len(), 3);
/// assert!(read_stl(b"solid t facet").is_err());
/// ```
pub fn read_stl(bytes: &[u8]) -> Result<Mesh> {
    let mut builder = Builder::default();
    let count = bytes.get(80..HEAD).map(|c| u32::from_le_bytes([c[0], c[1], c[2], c[3]]));
    let wanted = count.map(|n| HEAD as u64 + u64::from(n) * TRIANGLE as u64);
    // Binary files may begin with "solid" too: the length decides.
    if wanted == Some(bytes.len() as u64) {
        for triangle in bytes[HEAD..].chunks_exact(TRIANGLE) {
            let number = |i: usize| {
                let at = 12 + 4 * i;
                f64::from(f32::from_le_bytes([
                    triangle[at],
                    triangle[at + 1],
                    triangle[at + 2],
                    triangle[at + 3],
                ]))
            };
            builder.triangle([0, 3, 6].map(|i| DVec3::new(number(i), number(i + 1), number(i + 2))))?;
        }
    } else if bytes.trim_ascii_start().get(..5).is_some_and(|b| b.eq_ignore_ascii_case(b"solid")) {
        text(bytes, &mut builder)?;
    } else {
        let mut finding = unreadable("a file is neither binary nor text STL, or ends early")
            .value(bytes.len() as f64, "bytes");
        if let Some(wanted) = wanted {
            finding = finding.bound(wanted as f64, "bytes");
        }
        return Err(finding.into());
    }
    if builder.mesh.triangles.is_empty() {
        return Err(unreadable("an STL file holds no triangle").into());
    }
    Ok(builder.mesh)
}

/// A mesh as a binary STL file [mm], numbers rounded to 32 bits. The comment is `kinecut`. A mesh with more
/// triangles than 32 bits count is cut short.
pub fn write_stl(mesh: &Mesh) -> Vec<u8> {
    let count = u32::try_from(mesh.triangles.len()).unwrap_or(u32::MAX);
    let mut bytes = Vec::with_capacity(HEAD + TRIANGLE * count as usize);
    bytes.extend_from_slice(b"kinecut");
    bytes.resize(80, b' ');
    bytes.extend_from_slice(&count.to_le_bytes());
    for t in &mesh.triangles[..count as usize] {
        let [a, b, c] = t.map(|i| mesh.vertices[i as usize]);
        let normal = (b - a).cross(c - a).try_normalize().unwrap_or(DVec3::ZERO);
        for p in [normal, a, b, c] {
            for v in p.to_array() {
                bytes.extend_from_slice(&(v as f32).to_le_bytes());
            }
        }
        bytes.extend_from_slice(&[0; 2]);
    }
    bytes
}

fn unreadable(what: &str) -> Finding {
    Finding::error(Code::MESH_UNREADABLE, what).help("export the part as binary STL in mm again")
}

/// Reads the text form. Facet normals and names are passed over.
fn text(bytes: &[u8], builder: &mut Builder) -> Result<()> {
    let text = std::str::from_utf8(bytes).map_err(|_| unreadable("an STL file in text form is not text"))?;
    let mut corners = [DVec3::ZERO; 3];
    let mut count = 0;
    let mut words = text.split_ascii_whitespace();
    let mut ended = false;
    let number = |word: Option<&str>| {
        word.and_then(|w| w.parse::<f64>().ok())
            .ok_or_else(|| unreadable("a vertex of an STL file in text form is not three numbers"))
    };
    while let Some(word) = words.next() {
        let is = |name: &str| word.eq_ignore_ascii_case(name);
        if is("vertex") {
            let p = DVec3::new(number(words.next())?, number(words.next())?, number(words.next())?);
            if count == 3 {
                return Err(
                    unreadable("a facet of an STL file in text form has more than three vertices").into()
                );
            }
            corners[count] = p;
            count += 1;
        } else if is("endfacet") {
            if count != 3 {
                return Err(unreadable("a facet of an STL file in text form lacks vertices").into());
            }
            builder.triangle(corners)?;
            count = 0;
        } else if is("endsolid") {
            ended = true;
        } else if is("facet") {
            ended = false;
        }
    }
    if count != 0 || !ended {
        return Err(unreadable("an STL file in text form ends early").into());
    }
    Ok(())
}

#[derive(Default)]
struct Builder {
    mesh: Mesh,
    // Only looked up, never iterated: the order of vertices is that of the file.
    numbers: HashMap<[u64; 3], u32>,
}

impl Builder {
    fn triangle(&mut self, corners: [DVec3; 3]) -> Result<()> {
        let mut triangle = [0; 3];
        for (p, number) in corners.into_iter().zip(&mut triangle) {
            if !p.is_finite() {
                return Err(unreadable("a vertex of an STL file is not finite").into());
            }
            // Minus zero is zero.
            let p = p + 0.0;
            let next = self.mesh.vertices.len() as u32;
            *number = *self.numbers.entry(p.to_array().map(f64::to_bits)).or_insert(next);
            if *number == next {
                self.mesh.vertices.push(p);
            }
        }
        let [a, b, c] = triangle;
        if a != b && b != c && c != a {
            self.mesh.triangles.push(triangle);
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn octahedron() -> Mesh {
        let s = [
            [1.5, 0.0, 0.0],
            [0.0, 2.5, 0.0],
            [-1.0, 0.0, 0.0],
            [0.0, -1.0, 0.0],
            [0.0, 0.0, 3.0],
            [0.0, 0.0, -1.0],
        ];
        Mesh {
            vertices: s.map(Into::into).to_vec(),
            triangles: (0..4).flat_map(|i| [[i, (i + 1) % 4, 4], [(i + 1) % 4, i, 5]]).collect(),
        }
    }

    /// Every corner of every triangle, whatever the numbers of the vertices.
    fn soup(mesh: &Mesh) -> Vec<[[f64; 3]; 3]> {
        mesh.triangles.iter().map(|t| t.map(|i| mesh.vertices[i as usize].to_array())).collect()
    }

    #[test]
    fn another_reader_and_ours_read_what_was_written() {
        let mesh = octahedron();
        let bytes = write_stl(&mesh);
        assert_eq!(bytes.len(), 84 + 8 * 50);
        let back = read_stl(&bytes).unwrap();
        assert_eq!(soup(&back), soup(&mesh));
        assert_eq!(back.vertices.len(), 6);
        assert!(back.check_closed().is_ok());
        let theirs = stl_io::read_stl(&mut std::io::Cursor::new(&bytes)).unwrap();
        theirs.validate().unwrap();
        assert_eq!((theirs.faces.len(), theirs.vertices.len()), (8, 6));
        let n = theirs.faces[0].normal;
        let out = DVec3::new(f64::from(n[0]), f64::from(n[1]), f64::from(n[2]));
        let expected = DVec3::new(1.0 / 1.5, 1.0 / 2.5, 1.0 / 3.0);
        assert!((out - expected / expected.length()).length() < 1e-6);
    }

    #[test]
    fn text_is_read_with_all_its_digits() {
        let mut text = String::from("  solid two words\n");
        for t in soup(&octahedron()) {
            text += "facet normal 0 0 0\n outer loop\n";
            for [x, y, z] in t {
                text += &format!("  VERTEX {x:e} {y} {z}\n");
            }
            text += " endloop\nendfacet\n";
        }
        assert_eq!(read_stl(text.as_bytes()).unwrap_err().code(), Code::MESH_UNREADABLE);
        text += "endsolid two words\n";
        assert_eq!(soup(&read_stl(text.as_bytes()).unwrap()), soup(&octahedron()));
        let fine = "solid\nfacet\nvertex 0.1234567890123 0 0 vertex 0 1 0 vertex -0 -0 1 endfacet endsolid";
        assert_eq!(read_stl(fine.as_bytes()).unwrap().vertices[0].x, 0.1234567890123);
    }

    #[test]
    fn slivers_vanish_and_minus_zero_is_zero() {
        let text = "solid facet vertex 0 0 0 vertex 1 0 0 vertex -0 0 0 endfacet
            facet vertex 0 0 0 vertex 1 0 0 vertex 0 1 -0.0 endfacet endsolid";
        let mesh = read_stl(text.as_bytes()).unwrap();
        assert_eq!((mesh.vertices.len(), mesh.triangles.len()), (3, 1));
    }

    #[test]
    fn what_is_not_stl_is_refused() {
        let mut nan = write_stl(&octahedron());
        nan[100..104].copy_from_slice(&f32::NAN.to_le_bytes());
        let whole = write_stl(&octahedron());
        let mut longer = whole.clone();
        longer.push(0);
        let empty = write_stl(&Mesh::default());
        for bad in [&b""[..], b"solid", b"ply\nformat", &whole[..300], &whole[..84], &longer, &nan, &empty] {
            assert_eq!(read_stl(bad).unwrap_err().code(), Code::MESH_UNREADABLE);
        }
        for facet in [
            "vertex 1 2 x vertex 0 0 0 vertex 1 1 1",
            "vertex 1 2 3 vertex 2 2 2",
            "vertex 1 inf 2 vertex 0 0 0 vertex 1 1 1",
        ] {
            let text = format!("solid a\nfacet normal 0 0 1\n{facet}\nendfacet\nendsolid a\n");
            assert_eq!(read_stl(text.as_bytes()).unwrap_err().code(), Code::MESH_UNREADABLE);
        }
    }

    proptest! {
        #![proptest_config(kinecut_cases::property(256))]
        #[test]
        fn no_bytes_make_it_panic(bytes in prop::collection::vec(any::<u8>(), 0..400), cut in 0usize..500) {
            let _ = read_stl(&bytes);
            let mut whole = write_stl(&octahedron());
            whole.truncate(cut);
            let _ = read_stl(&whole);
            let mut text = b"solid ".to_vec();
            text.extend(bytes);
            let _ = read_stl(&text);
        }
    }
}
