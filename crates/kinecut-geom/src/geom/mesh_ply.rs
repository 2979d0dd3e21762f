//! PLY files, binary: each vertex once, then the triangles.

use super::Mesh;

/// A mesh as a binary PLY file: positions as 32-bit floats [mm], triangles as indices of their vertices.
///
/// Source: Turk, The PLY polygon file format (1994).
///
/// ```
/// # use kinecut_geom as kinecut;
/// use kinecut::geom::{Mesh, write_ply};
/// let corners = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
/// let mesh = Mesh {
///     vertices: corners.map(Into::into).to_vec(),
///     triangles: vec![[0, 2, 1], [0, 1, 3], [1, 2, 3], [0, 3, 2]],
/// };
/// let file = write_ply(&mesh);
/// let head = file.windows(11).position(|w| w == b"end_header\n").unwrap() + 11;
/// // Twelve bytes a vertex, thirteen a triangle.
/// assert_eq!(file.len(), head + 4 * 12 + 4 * 13);
/// ```
pub fn write_ply(mesh: &Mesh) -> Vec<u8> {
    let head = format!(
        "ply\nformat binary_little_endian 1.0\ncomment mm\n\
         element vertex {}\nproperty float x\nproperty float y\nproperty float z\n\
         element face {}\nproperty list uchar uint vertex_indices\nend_header\n",
        mesh.vertices.len(),
        mesh.triangles.len()
    );
    let mut file = head.into_bytes();
    file.reserve_exact(12 * mesh.vertices.len() + 13 * mesh.triangles.len());
    for v in mesh.vertices.iter().flat_map(|v| v.to_array()) {
        file.extend((v as f32).to_le_bytes());
    }
    for triangle in &mesh.triangles {
        file.push(3);
        file.extend(triangle.iter().flat_map(|i| i.to_le_bytes()));
    }
    file
}
