//! GLB files (binary glTF 2.0) for viewers.
//!
//! glTF is in metres with Y up: a root node scales by 0.001 and turns Z up to Y up, so that the numbers in the file
//! stay mm in the axes of the part. Positions are 32-bit floats about the middle of the part's box, which therefore
//! lies at the viewer's origin. Corners of one vertex share a normal where the faces around it turn by less than
//! [`CREASE`] from each to the next; edges sharper than that stay sharp.

use std::collections::BTreeMap;

use glam::DVec3;
use gltf_json as gltf;
use gltf_json::validation::Checked::Valid;
use rayon::prelude::*;

use super::Mesh;
use crate::base::{Code, Finding, Result};
use crate::num::sets::Sets;

/// Cosine of 30 degrees: facets of curved faces meet at less, edges of parts at more.
const CREASE: f64 = 0.866_025_403_784_438_6;

/// A mesh as a GLB file, with a colour (sRGB) for each vertex if given.
///
/// # Errors
/// `KC0801` when the mesh is empty or has numbers that are not finite, when the colours are not one for each vertex,
/// or when the file would be larger than 4 GiB.
///
/// ```
/// # use kinecut_geom as kinecut;
/// use kinecut::geom::{Mesh, write_glb};
/// let corners = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
/// let mesh = Mesh {
///     vertices: corners.map(Into::into).to_vec(),
///     triangles: vec![[0, 2, 1], [0, 1, 3], [1, 2, 3], [0, 3, 2]],
/// };
/// assert_eq!(&write_glb(&mesh, None).unwrap()[..4], b"glTF");
/// ```
pub fn write_glb(mesh: &Mesh, colours: Option<&[[u8; 3]]>) -> Result<Vec<u8>> {
    let refuse = |what: &str| Finding::error(Code::GEOMETRY, what);
    if mesh.triangles.is_empty() {
        return Err(refuse("an empty mesh makes no GLB file").into());
    }
    if !mesh.vertices.iter().all(|v| v.is_finite()) {
        return Err(refuse("a mesh with numbers that are not finite makes no GLB file").into());
    }
    if let Some(colours) = colours
        && colours.len() != mesh.vertices.len()
    {
        return Err(refuse("the colours of a mesh are not one for each vertex")
            .value(colours.len() as f64, "")
            .bound(mesh.vertices.len() as f64, "")
            .into());
    }
    let Shaded { corners, normals, indices } = shade(mesh);
    let bounds = mesh.bounds();
    let middle = (bounds.min + bounds.max) * 0.5;
    let positions: Vec<[f32; 3]> =
        corners.iter().map(|&i| single(mesh.vertices[i as usize] - middle)).collect();
    let mut file = File::default();
    let index_view = file
        .view(gltf::buffer::Target::ElementArrayBuffer, indices.iter().flatten().map(|i| i.to_le_bytes()));
    let index_accessor = file.accessor(index_view, indices.len() * 3, ComponentType::U32, Type::Scalar);
    let floats = |list: &[[f32; 3]]| list.iter().flatten().map(|v| v.to_le_bytes()).collect::<Vec<_>>();
    let view = file.view(gltf::buffer::Target::ArrayBuffer, floats(&positions));
    let position = file.accessor(view, positions.len(), ComponentType::F32, Type::Vec3);
    let extreme = |pick: fn(f32, f32) -> f32| {
        positions
            .iter()
            .copied()
            .reduce(|a, b| std::array::from_fn(|i| pick(a[i], b[i])))
            .map(|v| serde_json::json!(v))
    };
    let accessor = &mut file.root.accessors[position.value()];
    (accessor.min, accessor.max) = (extreme(f32::min), extreme(f32::max));
    let view = file.view(gltf::buffer::Target::ArrayBuffer, floats(&normals));
    let normal = file.accessor(view, normals.len(), ComponentType::F32, Type::Vec3);
    let mut attributes = BTreeMap::from([
        (Valid(gltf::mesh::Semantic::Positions), position),
        (Valid(gltf::mesh::Semantic::Normals), normal),
    ]);
    if let Some(colours) = colours {
        // Linear light in 16 bits; a fourth component keeps the stride a multiple of four.
        let linear = corners.iter().flat_map(|&i| {
            let [r, g, b] = colours[i as usize].map(linear_light);
            [r, g, b, u16::MAX]
        });
        let view = file.view(gltf::buffer::Target::ArrayBuffer, linear.map(u16::to_le_bytes));
        let colour = file.accessor(view, corners.len(), ComponentType::U16, Type::Vec4);
        file.root.accessors[colour.value()].normalized = true;
        attributes.insert(Valid(gltf::mesh::Semantic::Colors(0)), colour);
    }
    let base = if colours.is_some() { [1.0; 4] } else { [0.58, 0.60, 0.63, 1.0] };
    let material = file.root.push(gltf::Material {
        pbr_metallic_roughness: gltf::material::PbrMetallicRoughness {
            base_color_factor: gltf::material::PbrBaseColorFactor(base),
            metallic_factor: gltf::material::StrengthFactor(0.2),
            roughness_factor: gltf::material::StrengthFactor(0.6),
            ..Default::default()
        },
        ..Default::default()
    });
    let part = file.root.push(gltf::Mesh {
        extensions: None,
        extras: Default::default(),
        primitives: vec![gltf::mesh::Primitive {
            attributes,
            extensions: None,
            extras: Default::default(),
            indices: Some(index_accessor),
            material: Some(material),
            mode: Valid(gltf::mesh::Mode::Triangles),
            targets: None,
        }],
        weights: None,
    });
    file.finish(part)
}

use gltf::accessor::{ComponentType, Type};

/// Vertices divided at creases.
struct Shaded {
    /// For each vertex of the file its vertex in the mesh.
    corners: Vec<u32>,
    normals: Vec<[f32; 3]>,
    indices: Vec<[u32; 3]>,
}

/// Vertices with normals: corners at a vertex are joined to fans across edges that are not creases; each fan gets one
/// normal, the mean of its faces weighted by their angles at the vertex.
fn shade(mesh: &Mesh) -> Shaded {
    let point = |i: u32| mesh.vertices[i as usize];
    let faces: Vec<DVec3> = mesh
        .triangles
        .iter()
        .map(|t| {
            let [a, b, c] = t.map(point);
            (b - a).cross(c - a).try_normalize().unwrap_or(DVec3::ZERO)
        })
        .collect();
    // Edges as (lower vertex, higher vertex, triangle, side), equal edges side by side.
    let mut edges: Vec<(u32, u32, u32, u8)> = Vec::with_capacity(faces.len() * 3);
    for (n, t) in mesh.triangles.iter().enumerate() {
        for side in 0..3u8 {
            let (a, b) = (t[usize::from(side)], t[(usize::from(side) + 1) % 3]);
            edges.push((a.min(b), a.max(b), n as u32, side));
        }
    }
    edges.par_sort_unstable();
    let mut fans = Sets::new(3 * faces.len());
    for pair in edges.windows(2) {
        let ((a, b, t, s), (c, d, u, r)) = (pair[0], pair[1]);
        if (a, b) != (c, d) || faces[t as usize].dot(faces[u as usize]) < CREASE {
            continue;
        }
        for vertex in [a, b] {
            let corner = |t: u32, s: u8| {
                let s = u32::from(s);
                if mesh.triangles[t as usize][s as usize] == vertex { 3 * t + s } else { 3 * t + (s + 1) % 3 }
            };
            fans.join(corner(t, s), corner(u, r));
        }
    }
    let mut sums: Vec<DVec3> = Vec::new();
    let mut corners = Vec::new();
    let mut number: Vec<u32> = vec![u32::MAX; fans.len()];
    let mut indices = Vec::with_capacity(faces.len());
    for (n, t) in mesh.triangles.iter().enumerate() {
        let mut out = [0; 3];
        for side in 0..3 {
            let head = fans.least((3 * n + side) as u32) as usize;
            if number[head] == u32::MAX {
                number[head] = corners.len() as u32;
                corners.push(t[side]);
                sums.push(DVec3::ZERO);
            }
            let [p, q, r] = [0, 1, 2].map(|k| point(t[(side + k) % 3]));
            let (along, back) = (q - p, r - p);
            sums[number[head] as usize] += faces[n] * along.cross(back).length().atan2(along.dot(back));
            out[side] = number[head];
        }
        indices.push(out);
    }
    let normals = sums.into_iter().map(|s| single(s.try_normalize().unwrap_or(DVec3::Z))).collect();
    Shaded { corners, normals, indices }
}

fn single(p: DVec3) -> [f32; 3] {
    p.to_array().map(|v| v as f32)
}

/// sRGB to linear light in 16 bits (IEC 61966-2-1).
fn linear_light(c: u8) -> u16 {
    let c = f64::from(c) / 255.0;
    let linear = if c <= 0.04045 { c / 12.92 } else { ((c + 0.055) / 1.055).powf(2.4) };
    (linear * 65535.0).round() as u16
}

/// The JSON and the binary part of a file in the making.
#[derive(Default)]
struct File {
    root: gltf::Root,
    binary: Vec<u8>,
}

impl File {
    fn view<B: AsRef<[u8]>>(
        &mut self,
        target: gltf::buffer::Target,
        bytes: impl IntoIterator<Item = B>,
    ) -> gltf::Index<gltf::buffer::View> {
        let start = self.binary.len();
        for b in bytes {
            self.binary.extend_from_slice(b.as_ref());
        }
        let length = self.binary.len() - start;
        self.binary.resize(self.binary.len().next_multiple_of(4), 0);
        self.root.push(gltf::buffer::View {
            buffer: gltf::Index::new(0),
            byte_length: length.into(),
            byte_offset: Some(start.into()),
            byte_stride: None,
            extensions: None,
            extras: Default::default(),
            target: Some(Valid(target)),
        })
    }

    fn accessor(
        &mut self,
        view: gltf::Index<gltf::buffer::View>,
        count: usize,
        component: ComponentType,
        kind: Type,
    ) -> gltf::Index<gltf::Accessor> {
        self.root.push(gltf::Accessor {
            buffer_view: Some(view),
            byte_offset: None,
            count: count.into(),
            component_type: Valid(gltf::accessor::GenericComponentType(component)),
            extensions: None,
            extras: Default::default(),
            type_: Valid(kind),
            min: None,
            max: None,
            normalized: false,
            sparse: None,
        })
    }

    /// Node, scene and buffer, and all of it as bytes.
    fn finish(mut self, part: gltf::Index<gltf::Mesh>) -> Result<Vec<u8>> {
        let half = std::f32::consts::FRAC_1_SQRT_2;
        let node = self.root.push(gltf::Node {
            mesh: Some(part),
            // A quarter turn about X takes Z to Y.
            rotation: Some(gltf::scene::UnitQuaternion([-half, 0.0, 0.0, half])),
            scale: Some([0.001; 3]),
            ..Default::default()
        });
        let scene =
            self.root.push(gltf::Scene { extensions: None, extras: Default::default(), nodes: vec![node] });
        self.root.scene = Some(scene);
        self.root.asset.generator = Some(concat!("kinecut ", env!("CARGO_PKG_VERSION")).to_owned());
        self.root.push(gltf::Buffer {
            byte_length: self.binary.len().into(),
            uri: None,
            extensions: None,
            extras: Default::default(),
        });
        let failed = || Finding::error(Code::GEOMETRY, "a GLB file would be too large").bound(4.0, "GiB");
        let mut json = self.root.to_vec().map_err(|_| failed())?;
        json.resize(json.len().next_multiple_of(4), b' ');
        let size = |bytes: &[u8]| u32::try_from(bytes.len()).map_err(|_| failed());
        let total = u32::try_from(12 + 8 + json.len() + 8 + self.binary.len()).map_err(|_| failed())?;
        let mut out = Vec::with_capacity(total as usize);
        out.extend_from_slice(b"glTF");
        out.extend_from_slice(&2u32.to_le_bytes());
        out.extend_from_slice(&total.to_le_bytes());
        for (kind, bytes) in [(b"JSON", &json), (b"BIN\0", &self.binary)] {
            out.extend_from_slice(&size(bytes)?.to_le_bytes());
            out.extend_from_slice(kind);
            out.extend_from_slice(bytes);
        }
        Ok(out)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use gltf_json::validation::Validate;

    /// A box [0, 2] x [0, 4] x [0, 6] with each side in two triangles.
    fn cuboid() -> Mesh {
        let vertices = (0..8)
            .map(|i| DVec3::new(f64::from(i & 1) * 2.0, f64::from(i >> 1 & 1) * 4.0, f64::from(i >> 2) * 6.0))
            .collect();
        let quads = [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]];
        let triangles = quads.iter().flat_map(|&[a, b, c, d]| [[a, b, c], [a, c, d]]).collect();
        Mesh { vertices, triangles }
    }

    fn number<const N: usize>(bytes: &[u8], at: usize) -> [u8; N] {
        bytes[at..at + N].try_into().unwrap()
    }

    fn parse(glb: &[u8]) -> (gltf::Root, Vec<u8>) {
        assert_eq!(u32::from_le_bytes(number(glb, 8)) as usize, glb.len());
        let json = u32::from_le_bytes(number(glb, 12)) as usize;
        assert_eq!((&glb[16..20], json % 4), (&b"JSON"[..], 0));
        let root = gltf::Root::from_slice(&glb[20..20 + json]).unwrap();
        let mut errors = Vec::new();
        root.validate(&root, gltf::Path::new, &mut |path, error| errors.push((path(), error)));
        assert!(errors.is_empty(), "{errors:?}");
        assert_eq!(&glb[24 + json..28 + json], b"BIN\0");
        (root, glb[28 + json..].to_vec())
    }

    fn floats(root: &gltf::Root, binary: &[u8], name: gltf::mesh::Semantic) -> Vec<[f32; 3]> {
        let accessor = &root.accessors[root.meshes[0].primitives[0].attributes[&Valid(name)].value()];
        let view = &root.buffer_views[accessor.buffer_view.unwrap().value()];
        let start = view.byte_offset.unwrap().0 as usize;
        (0..accessor.count.0 as usize)
            .map(|n| std::array::from_fn(|i| f32::from_le_bytes(number(binary, start + 12 * n + 4 * i))))
            .collect()
    }

    #[test]
    fn a_box_is_valid_gltf_with_sharp_edges_about_its_middle() {
        let glb = write_glb(&cuboid(), None).unwrap();
        let (root, binary) = parse(&glb);
        let positions = floats(&root, &binary, gltf::mesh::Semantic::Positions);
        let normals = floats(&root, &binary, gltf::mesh::Semantic::Normals);
        // Three faces at each of the eight corners.
        assert_eq!((positions.len(), normals.len()), (24, 24));
        for (p, n) in positions.iter().zip(&normals) {
            assert_eq!(n.map(f32::abs).iter().sum::<f32>(), 1.0);
            let axis = n.iter().position(|v| *v != 0.0).unwrap();
            // A side of the box faces away from its middle.
            assert_eq!(p[axis], n[axis] * [1.0, 2.0, 3.0][axis]);
        }
        // The root node: mm to m, Z to Y.
        let node = &root.nodes[0];
        assert_eq!(node.scale, Some([0.001; 3]));
        let [x, y, z, w] = node.rotation.unwrap().0.map(f64::from);
        let up = glam::DQuat::from_xyzw(x, y, z, w) * DVec3::Z;
        assert!((up - DVec3::Y).length() < 1e-6);
        assert_eq!(glb, write_glb(&cuboid(), None).unwrap());
    }

    #[test]
    fn a_fine_cylinder_is_shaded_round() {
        let n = 24;
        let mut mesh = Mesh::default();
        for i in 0..n {
            let (s, c) = (f64::from(i) * std::f64::consts::TAU / f64::from(n)).sin_cos();
            mesh.vertices.extend([DVec3::new(c, s, 0.0), DVec3::new(c, s, 5.0)]);
        }
        mesh.vertices.extend([DVec3::ZERO, DVec3::new(0.0, 0.0, 5.0)]);
        for i in 0..n {
            let (a, b) = (2 * i, 2 * ((i + 1) % n));
            mesh.triangles.extend([
                [a, b, b + 1],
                [a, b + 1, a + 1],
                [b, a, 2 * n],
                [a + 1, b + 1, 2 * n + 1],
            ]);
        }
        mesh.check_closed().unwrap();
        let (root, binary) = parse(&write_glb(&mesh, None).unwrap());
        let positions = floats(&root, &binary, gltf::mesh::Semantic::Positions);
        let normals = floats(&root, &binary, gltf::mesh::Semantic::Normals);
        assert_eq!(positions.len(), 2 * n as usize * 2 + 2);
        let wall = positions.iter().zip(&normals).filter(|(_, n)| n[2].abs() < 0.5);
        // Divided quads lean the mean by a fraction of the step of 15 degrees.
        assert!(wall.clone().count() == 48 && wall.clone().all(|(p, n)| p[0] * n[0] + p[1] * n[1] > 0.998));
    }

    #[test]
    fn colours_become_linear_light() {
        let colours = [[255, 0, 188]; 8];
        let (root, binary) = parse(&write_glb(&cuboid(), Some(&colours)).unwrap());
        let index = root.meshes[0].primitives[0].attributes[&Valid(gltf::mesh::Semantic::Colors(0))];
        let view = &root.buffer_views[root.accessors[index.value()].buffer_view.unwrap().value()];
        let start = view.byte_offset.unwrap().0 as usize;
        let c: [u16; 4] = std::array::from_fn(|i| u16::from_le_bytes(number(&binary, start + 2 * i)));
        // sRGB 188 is close to half the light: 0.5029.
        assert_eq!((c[0], c[1], c[3]), (65535, 0, 65535));
        assert!((f64::from(c[2]) / 65535.0 - 0.5029).abs() < 1e-4);
    }

    #[test]
    fn what_cannot_be_written_is_refused() {
        assert!(write_glb(&Mesh::default(), None).is_err());
        assert!(write_glb(&cuboid(), Some(&[[0; 3]; 7])).is_err());
        let mut mesh = cuboid();
        mesh.vertices[0].x = f64::NAN;
        assert!(write_glb(&mesh, None).is_err());
    }
}
