//! The faces of a mesh by the motions that carry them in themselves: what they are, and what makes them.

use serde::Serialize;

use crate::base::Result;
use crate::geom::Mesh;
use crate::machine::surface::{RecogniseOptions, recognise};
use crate::page::{Block, Section};
use crate::verbs::Answer;

/// A face of a mesh.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct FaceRow {
    /// Its shape, with its dimensions.
    pub shape: String,
    /// Kind of surface.
    pub form: &'static str,
    /// Area [mm2].
    pub area: f64,
    /// Number of its facets.
    pub facets: usize,
    /// Facets that do not belong to the named surface.
    pub outliers: usize,
    /// Motions by which it slides in itself.
    pub slides: Vec<String>,
    /// Its generation, in words.
    pub generation: &'static str,
    /// The surface of the catalogue whose generating lines fit.
    pub like: Option<&'static str>,
    /// Root mean square angle by which the facets leave the motions [deg].
    pub deviation_deg: f64,
}

/// The faces of a mesh.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct MeshSheet {
    /// Name of the file.
    pub name: String,
    /// The faces, the greatest first.
    pub faces: Vec<FaceRow>,
    /// Area of the faces that have too few facets to tell [mm2].
    pub unnamed_area: f64,
}

impl Answer for MeshSheet {
    fn sections(&self) -> Vec<Section> {
        let mut section = Section::new(format!("{}: {} faces", self.name, self.faces.len()));
        for face in &self.faces {
            let heading = format!("{}, {:.2} mm2 in {} facets", face.shape, face.area, face.facets);
            let mut lines: Vec<String> =
                face.slides.iter().map(|slide| format!("slides by {slide}")).collect();
            lines.push(face.generation.to_owned());
            lines.extend(face.like.map(|like| format!("its generating lines: kinecut surface {like}")));
            lines
                .extend((face.outliers > 0).then(|| format!("{} facets do not belong to it", face.outliers)));
            section = section.with(Block::Heading(heading)).with(Block::List(lines));
        }
        if self.unnamed_area > 0.0 {
            let few = format!("{:.2} mm2 in faces with too few facets to tell", self.unnamed_area);
            section = section.with(Block::Heading(few));
        }
        vec![section]
    }
}

/// The faces of a mesh. `crease` is the angle from which on an edge divides two faces [deg]; default 40.
///
/// # Errors
/// `KC1109` for a mesh without triangles or with corners that are not finite.
pub fn mesh_sheet(name: &str, mesh: &Mesh, crease: Option<f64>) -> Result<MeshSheet> {
    let mut options = RecogniseOptions::default();
    if let Some(crease) = crease {
        options.crease = crease.to_radians();
    }
    let found = recognise(mesh, &options)?;
    let faces = found.faces.iter().map(|face| FaceRow {
        shape: face.primitive.to_string(),
        form: face.group.form.name(),
        area: face.area,
        facets: face.triangles.len(),
        outliers: face.outliers.len(),
        slides: face.group.slides.iter().map(ToString::to_string).collect(),
        generation: face.generation(),
        like: face.catalogue_name(),
        deviation_deg: face.deviation[0].to_degrees(),
    });
    Ok(MeshSheet { name: name.to_owned(), faces: faces.collect(), unnamed_area: found.unnamed_area })
}
