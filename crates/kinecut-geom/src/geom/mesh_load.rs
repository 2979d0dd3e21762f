//! A closed mesh from a file that something outside names.

use super::{Mesh, read_3mf, read_stl};
use crate::base::bounded::MAX_LENGTH;
use crate::base::{Code, Error, FileKind, Finding, Loader, Location, Result};

/// Reads an STL or 3MF file through the loader: a package is 3MF, whatever its name, STL is in the loader's unit of meshes; it must be closed, not empty and of a size that can be handled.
///
/// # Errors
/// Those of the loader, of [`read_stl`] and of [`read_3mf`] with the name of the file; `KC0602` where it does not close; `KC0601` where it is
/// empty or larger than [`MAX_LENGTH`].
pub fn load_mesh(name: &str, loader: &dyn Loader) -> Result<Mesh> {
    let in_file = |e: Error| {
        let mut finding = *e.0;
        finding.message = format!("`{name}`: {}", finding.message);
        Error::from(finding)
    };
    let bytes = loader.read_as(name, FileKind::Mesh)?;
    let mesh = if bytes.starts_with(b"PK") {
        read_3mf(&bytes).map_err(in_file)?
    } else {
        // STL says no unit.
        let mut mesh = read_stl(&bytes).map_err(in_file)?;
        let unit = loader.mesh_unit();
        mesh.vertices.iter_mut().for_each(|v| *v *= unit);
        mesh
    };
    mesh.check_closed().map_err(in_file)?;
    let bounds = mesh.bounds();
    if bounds.is_empty() || bounds.min.abs().max(bounds.max.abs()).max_element() > MAX_LENGTH {
        return Err(Finding::error(
            Code::MESH_UNREADABLE,
            format!("`{name}` is empty or larger than can be handled"),
        )
        .bound_mm(MAX_LENGTH)
        .at(Location::whole_file(name))
        .into());
    }
    Ok(mesh)
}
