//! The wanted part, with regions of its surface that have limits of their own.

use glam::DVec3;

use crate::base::bounded::{bounded, length, text};
use crate::base::{Code, Finding, Loader, Result};
use crate::geom::{Mesh, MeshDistance, load_mesh};
use crate::job::file::{DesignTable, RegionTable};

/// The wanted part as a mesh.
#[derive(Clone, Debug)]
pub struct Design {
    /// Surface [part coordinates].
    pub mesh: Mesh,
    /// Largest allowed distance of the cut surface from it [mm].
    pub tolerance: f64,
    /// Regions of its surface with limits of their own.
    pub regions: Vec<Region>,
    /// For each triangle the number of its region, from 1 on; 0 for those that lie elsewhere. Empty where there are no regions.
    pub region_of: Vec<u16>,
}

/// A region of the surface of a design.
#[derive(Clone, Debug, PartialEq)]
pub struct Region {
    /// Name.
    pub name: String,
    /// Greatest depth to which it may be cut into [mm].
    pub gouge: f64,
    /// Most stock that may be left on it [mm].
    pub rest: f64,
}

/// Angle of the normals on both sides of an edge up to which a face goes on [degrees].
const ANGLE: f64 = 20.0;

/// Distance of a point from the face that it names [mm].
const NEAR: f64 = 1.0;

/// Most regions.
const MOST: usize = 1000;

impl Design {
    /// A design that is the same everywhere.
    pub fn new(mesh: Mesh, tolerance: f64) -> Design {
        Design { mesh, tolerance, regions: Vec::new(), region_of: Vec::new() }
    }

    pub(super) fn of(table: &DesignTable, loader: &dyn Loader) -> Result<Design> {
        let mesh = load_mesh(&table.mesh, loader).map_err(|e| e.under("design.mesh"))?;
        let tolerance = length("design.tolerance", table.tolerance, 1e-6, 100.0)?;
        let mut design = Design::new(mesh, tolerance);
        if table.regions.is_empty() {
            return Ok(design);
        }
        if table.regions.len() > MOST {
            return Err(Finding::error(Code::JOB_VALUE, "there are too many regions")
                .value(table.regions.len() as f64, "")
                .bound(MOST as f64, "")
                .key("design.region")
                .into());
        }
        let distance = MeshDistance::new(&design.mesh).map_err(|e| e.under("design.mesh"))?;
        design.region_of = vec![0; design.mesh.triangles.len()];
        for (i, region) in table.regions.iter().enumerate() {
            design.add(region, &distance).map_err(|e| e.under(&format!("design.region[{i}]")))?;
        }
        Ok(design)
    }

    /// Gives the faces that a table names to a region.
    fn add(&mut self, table: &RegionTable, distance: &MeshDistance) -> Result<()> {
        let limit = |key: &str, value: Option<f64>| length(key, value.unwrap_or(self.tolerance), 1e-6, 100.0);
        let region = Region {
            name: text("name", &table.name)?,
            gouge: limit("gouge", table.gouge)?,
            rest: limit("rest", table.rest)?,
        };
        let angle = bounded("angle", table.angle.unwrap_or(ANGLE), 0.0, 180.0, "degrees")?;
        if table.at.is_empty() {
            return Err(Finding::error(
                Code::JOB_SHAPE,
                format!("no point names a face of `{}`", region.name),
            )
            .key("at")
            .help("give points on its faces: at = [[10, 0, -5]]")
            .into());
        }
        let faces = self.mesh.smooth_faces(angle.to_radians());
        let number = self.regions.len() as u16 + 1;
        for (i, at) in table.at.iter().enumerate() {
            let key = || format!("at[{i}]");
            let nearest = distance.nearest(DVec3::from(*at)).filter(|n| n.distance.abs() <= NEAR);
            let nearest = nearest.ok_or_else(|| {
                let away = distance.signed(DVec3::from(*at)).abs();
                Finding::error(Code::JOB_VALUE, "no face of the design is near this point")
                    .key(key())
                    .value(away, "mm away")
                    .bound(NEAR, "mm")
                    .help("give a point on the face")
            })?;
            let face = faces[nearest.triangle as usize];
            for (of, _) in self.region_of.iter_mut().zip(&faces).filter(|(_, own)| **own == face) {
                if *of != 0 && *of != number {
                    let other = &self.regions[usize::from(*of) - 1].name;
                    let what = format!("this face belongs to `{other}` already");
                    return Err(Finding::error(Code::JOB_SHAPE, what)
                        .key(key())
                        .help("name each face once, or give a smaller `angle`")
                        .into());
                }
                *of = number;
            }
        }
        self.regions.push(region);
        Ok(())
    }

    /// The region of a triangle; 0 elsewhere.
    pub(in crate::job) fn region(&self, triangle: u32) -> u16 {
        self.region_of.get(triangle as usize).copied().unwrap_or(0)
    }

    /// Greatest depth of a cut into a region, and most stock that may be left on it [mm].
    pub(in crate::job) fn limits(&self, region: u16) -> [f64; 2] {
        let own = usize::from(region).checked_sub(1).and_then(|i| self.regions.get(i));
        own.map_or([self.tolerance; 2], |own| [own.gouge, own.rest])
    }
}
