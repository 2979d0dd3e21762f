//! Outlines of solids: the highest horizontal face, and the section by a horizontal plane.
//!
//! Of a box it is a rectangle, of a cylinder a circle. Of a mesh it is polygons; runs of their chords whose vertices lie
//! on a circle are made arcs again ([`recover`]).

mod recover;
mod top;

use glam::{DVec2, DVec3};

use super::{Outline, OutlineEdge, OutlineOptions, OutlineRead};
use crate::base::{Code, Finding, Location, Result};
use crate::geom::mesh_section::section_loops;
use crate::geom::{Aabb, Mesh, Solid, read_stl};
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
    Ok(OutlineRead { outline, weights, notes })
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
    match options.section {
        None => mesh_top(&mesh, options.arc_tolerance),
        Some(z) => mesh_section(&mesh, z, options.arc_tolerance),
    }
    .map_err(placed)
}

#[cfg(test)]
mod tests;
