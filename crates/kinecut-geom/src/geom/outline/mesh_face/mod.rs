//! Outlines of solids: the highest horizontal face, and the section by a horizontal plane.
//!
//! Of a box it is a rectangle, of a cylinder a circle. Of a mesh also the loop of a sharp edge ([`MeshEdge`]). Of a mesh it is polygons; runs of their chords whose vertices lie
//! on a circle are made arcs again ([`recover`]).

mod edge;
mod recover;
mod top;

use glam::{DVec2, DVec3};

use super::{MeshOutline, Outline, OutlineEdge, OutlineOptions, OutlineRead};
use crate::base::{Code, Finding, Location, Result};
use crate::geom::mesh_section::section_loops;
use crate::geom::{Aabb, Mesh, Solid, read_stl};
pub use edge::MeshEdge;
use recover::recover;

impl Outline {
    /// The outline of the highest horizontal face of a solid. Of a mesh: chords whose vertices lie on a circle within
    /// `arc_tolerance` [mm] are one arc through the vertices; 0 leaves all chords.
    ///
    /// # Errors
    /// `KC0602` for a mesh that is not closed, `KC0802` where its highest place is no horizontal face, else as
    /// [`Outline::new`].
    ///
    /// ```
    /// # use kinecut_geom as kinecut;
    /// use glam::DVec3;
    /// use kinecut::geom::{Outline, Solid};
    /// let disc = Solid::Cylinder { base: DVec3::ZERO, radius: 2.0, height: 5.0 };
    /// let face = Outline::top_of(&disc, 1e-3)?;
    /// assert!(face.edges().len() == 1 && (face.area() - 4.0 * std::f64::consts::PI).abs() < 1e-12);
    /// # Ok::<(), kinecut::base::Error>(())
    /// ```
    pub fn top_of(solid: &Solid, arc_tolerance: f64) -> Result<Outline> {
        match solid {
            Solid::Mesh(mesh) => Ok(mesh_top(mesh, arc_tolerance)?.outline),
            simple => simple_outline(simple),
        }
    }

    /// The outline of the material just below the height `z` [mm]: the section of a solid, `arc_tolerance` as for
    /// [`Outline::top_of`]. Faces in the plane count by what lies under them.
    ///
    /// # Errors
    /// `KC0602` for a mesh that is not closed, `KC0802` where there is no material at that height, else as
    /// [`Outline::new`].
    pub fn section_of(solid: &Solid, z: f64, arc_tolerance: f64) -> Result<Outline> {
        match solid {
            Solid::Mesh(mesh) => Ok(mesh_section(mesh, z, arc_tolerance)?.outline),
            simple => {
                let bounds = simple.bounds();
                if z > bounds.min.z && z <= bounds.max.z {
                    simple_outline(simple)
                } else {
                    Err(nothing_at(z, &bounds))
                }
            }
        }
    }

    /// The loop of the sharp level edge of a mesh that passes a point, no farther than 1 mm from it, and what is known of the edge;
    /// `arc_tolerance` as for [`Outline::top_of`]. Sharp are edges at which facets meet at 20 degrees or more.
    ///
    /// # Errors
    /// `KC0602` for a mesh that is not closed, `KC0802` where no such edge is near, where it is no loop of one height, and where
    /// several go on from a place, else as [`Outline::new`].
    ///
    /// ```
    /// # use kinecut_geom as kinecut;
    /// use glam::dvec3;
    /// use kinecut::geom::{Mesh, Outline};
    /// // A block of 30 x 20 x 5: the bits of a corner's number say on which side it lies.
    /// let corner = |i: u8| dvec3(f64::from(i & 1) * 30.0, f64::from(i >> 1 & 1) * 20.0, f64::from(i >> 2) * 5.0);
    /// let sides = [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]];
    /// let triangles = sides.iter().flat_map(|&[a, b, c, d]| [[a, b, c], [a, c, d]]).collect();
    /// let block = Mesh { vertices: (0..8).map(corner).collect(), triangles };
    /// let (rim, edge) = Outline::edge_of(&block, dvec3(15.0, 0.1, 5.0), 1e-3)?;
    /// assert!((rim.area() - 600.0).abs() < 1e-9 && edge.height == 5.0);
    /// assert!(edge.material_inside && edge.is_upper);
    /// # Ok::<(), kinecut::base::Error>(())
    /// ```
    pub fn edge_of(mesh: &Mesh, at: DVec3, arc_tolerance: f64) -> Result<(Outline, MeshEdge)> {
        mesh.check_closed()?;
        let (points, edge) = edge::edge_loop(mesh, at)?;
        Ok((outline_of(vec![points], arc_tolerance)?.outline, edge))
    }
}

/// The horizontal outline of a box or a cylinder.
fn simple_outline(solid: &Solid) -> Result<Outline> {
    if let Solid::Cylinder { base, radius, .. } = solid {
        let circle = OutlineEdge::arc(base.truncate(), *radius, 0.0, -std::f64::consts::TAU);
        return Outline::new(vec![vec![circle]], Vec::new());
    }
    let Aabb { min, max } = solid.bounds();
    let corners = [(min.x, min.y), (min.x, max.y), (max.x, max.y), (max.x, min.y)].map(DVec2::from);
    Outline::polygon(&corners)
}

fn mesh_top(mesh: &Mesh, arc_tolerance: f64) -> Result<OutlineRead> {
    mesh.check_closed()?;
    outline_of(top::top_loops(mesh)?, arc_tolerance)
}

fn mesh_section(mesh: &Mesh, z: f64, arc_tolerance: f64) -> Result<OutlineRead> {
    mesh.check_closed()?;
    let loops: Vec<Vec<DVec2>> = section_loops(mesh, DVec3::Z, z)
        .into_iter()
        .map(|points| points.into_iter().map(DVec3::truncate).collect())
        .collect();
    if loops.is_empty() {
        return Err(nothing_at(z, &mesh.bounds()));
    }
    outline_of(loops, arc_tolerance)
}

fn mesh_edge(mesh: &Mesh, at: DVec3, arc_tolerance: f64) -> Result<OutlineRead> {
    mesh.check_closed()?;
    let (points, edge) = edge::edge_loop(mesh, at)?;
    Ok(OutlineRead { edge: Some(edge), ..outline_of(vec![points], arc_tolerance)? })
}

fn nothing_at(z: f64, bounds: &Aabb) -> crate::base::Error {
    Finding::error(Code::OUTLINE_FILE, "there is no material just below this height")
        .value_mm(z)
        .help(format!("choose a height over Z {} up to Z {}", bounds.min.z, bounds.max.z))
        .into()
}

fn outline_of(loops: Vec<Vec<DVec2>>, arc_tolerance: f64) -> Result<OutlineRead> {
    let size = loops.iter().flatten().map(|p| p.length()).fold(0.0, f64::max);
    let (mut arcs, mut chords) = (0, 0);
    let mut found = Vec::with_capacity(loops.len());
    for points in &loops {
        let (edges, joined) = recover(points, arc_tolerance, size);
        arcs += edges.iter().filter(|e| e.turn.is_some()).count();
        chords += joined;
        found.push(edges);
    }
    let outline = Outline::new(found, Vec::new())?;
    let weights = vec![1.0; outline.edges().len()];
    let notes = if arcs > 0 {
        vec![format!("{arcs} arcs stand for {chords} chords of the mesh; they go through its vertices")]
    } else {
        Vec::new()
    };
    Ok(OutlineRead { outline, weights, notes, edge: None })
}

/// Reads the outline of the part in an STL file.
pub(super) fn read_stl_face(name: &str, bytes: &[u8], options: &OutlineOptions) -> Result<OutlineRead> {
    let placed = |mut error: crate::base::Error| {
        error.0.place.get_or_insert_with(|| Location::whole_file(name));
        error
    };
    let mut mesh = read_stl(bytes).map_err(placed)?;
    // STL files have no unit; all of them are taken as mm.
    if let Some(unit) = options.unit {
        mesh.vertices.iter_mut().for_each(|v: &mut DVec3| *v *= unit.mm());
    }
    match options.mesh {
        MeshOutline::Top => mesh_top(&mesh, options.arc_tolerance),
        MeshOutline::Section(z) => mesh_section(&mesh, z, options.arc_tolerance),
        MeshOutline::Edge(at) => mesh_edge(&mesh, at, options.arc_tolerance),
    }
    .map_err(placed)
}

#[cfg(test)]
mod tests;
