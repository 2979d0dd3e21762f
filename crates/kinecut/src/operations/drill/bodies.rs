//! The surfaces that a hole meets in a body: the stock, or a mesh that the operation names.

use glam::{DVec2, DVec3};

use super::DrillOperation;
use super::there::{There, View};
use crate::base::Result;
use crate::drilling::{BoundarySurface, Cover, PartFace, PartMesh, Passage, Side, Transient, transient};
use crate::geom::{Aabb, EdgeProfile, Mesh, Rigid, Solid};
use crate::operations::{Drilled, MadeHole, PlacedPlane, Setting};

/// A body that is drilled, in part coordinates, and the way from the work offset to it.
pub(super) struct DrilledBody<'a> {
    /// Maps coordinates of the work offset to those of the part.
    to_part: Rigid,
    kind: Kind<'a>,
    /// Whether it is the stock, not a body that the operation names.
    is_stock: bool,
    drilled: &'a [Drilled],
    /// Holes that operations before leave.
    made: &'a [MadeHole],
    /// Planes that have been milled before.
    faced: &'a [PlacedPlane],
}

enum Kind<'a> {
    /// A simple solid whose faces are known exactly, with a mesh for holes that meet its edges.
    Simple(&'a Solid, Box<PartMesh>),
    Mesh(Box<PartMesh>),
}

/// Surfaces that a hole meets; Z counted from the height that was given.
pub(super) struct Met {
    /// Entry and exit: exact, or standing for the mesh.
    pub(super) surfaces: [BoundarySurface; 2],
    /// Faces that a person would name, where they are exact.
    pub(super) faces: Option<[PartFace; 2]>,
    /// Passages of the hole, if found in a mesh.
    pub(super) passages: Option<Vec<Passage>>,
    /// Holes that are there, seen from `across`.
    pub(super) there: There,
    /// Direction of the surfaces' u from X of the work offset [rad].
    pub(super) across: f64,
}

/// Heights of a mesh in 32 bits: what differs by less is level [mm].
const LEVEL: f64 = 1e-4;
/// Difference of heights that is rounding [mm].
const ROUNDING: f64 = 1e-9;
/// Shares add up to all of the disc but for rounding.
const ALL: f64 = 1.0 - 1e-6;
/// Radius of the needle that finds the height on the axis, as a share of the drill's.
const NEEDLE: f64 = 1e-4;
/// Facets of the mesh of a cylinder [count]: 0.4 micrometres inside at 40 mm.
const FACETS: u32 = 720;

impl<'a> DrilledBody<'a> {
    pub(super) fn new(setting: &Setting<'a>, drill: &'a DrillOperation) -> Result<DrilledBody<'a>> {
        let to_part = setting.clamping.to_work().inverse();
        let (kind, drilled) = match (&drill.body, setting.stock) {
            (Some(mesh), _) => (Kind::Mesh(Box::new(PartMesh::new(mesh)?)), &[][..]),
            (None, Solid::Mesh(mesh)) => (Kind::Mesh(Box::new(PartMesh::new(mesh)?)), &[][..]),
            (None, simple) => {
                (Kind::Simple(simple, Box::new(PartMesh::new(&mesh_of(simple))?)), setting.drilled)
            }
        };
        let faced = if drill.body.is_none() { setting.faced } else { &[] };
        let made = if drill.body.is_none() { setting.made } else { &[] };
        Ok(DrilledBody { to_part, kind, is_stock: drill.body.is_none(), drilled, made, faced })
    }

    /// Surfaces that an edge meets at a place of the work offset; Z counts from `at.z`.
    pub(super) fn meet(&self, edge: &EdgeProfile, at: DVec3) -> Result<Met> {
        let (point, out) = (self.to_part.point(at), self.to_part.vector(DVec3::Z));
        let mesh = match &self.kind {
            Kind::Simple(solid, mesh) => {
                if let Some([entry, exit]) = exact(solid, point, out, edge.outer_radius()) {
                    let found = [entry.0.surface(Side::Entry, entry.1)?, exit.0.surface(Side::Exit, exit.1)?];
                    let (surfaces, milled) = self.milled(found, point, out, edge.outer_radius())?;
                    let faces = [entry.0, exit.0];
                    let faces = std::array::from_fn(|i| if milled[i] { LEVEL_PLANE } else { faces[i] });
                    let to_work = self.to_part.inverse();
                    let view = View { to_work: &to_work, at, faces: surfaces.map(|s| s.height(0.0)) };
                    let there = view.holes(edge.outer_radius(), self.drilled, self.made)?;
                    let across = match (solid, entry.0) {
                        (Solid::Cylinder { .. }, PartFace::OuterCylinder { .. }) => {
                            let u = self.to_part.inverse().vector(out.truncate().perp().extend(0.0));
                            u.y.atan2(u.x)
                        }
                        // Planes are square to the drill: any direction will do.
                        _ => 0.0,
                    };
                    return Ok(Met { surfaces, faces: Some(faces), passages: None, there, across });
                }
                mesh
            }
            Kind::Mesh(mesh) => mesh,
        };
        let mut passages = mesh.passages(edge, point, -out)?.passages;
        // A flat edge passes what it meets between the greatest and the least height over the disc; a needle tells the
        // height on the axis.
        let (inner, outer) = (edge.inner_radius(), edge.outer_radius());
        let heights = |from: f64, to: f64| -> Result<Vec<Passage>> {
            let flat = EdgeProfile::polyline(&[[from, 0.0], [to, 0.0]])?;
            Ok(mesh.passages(&flat, point, -out)?.passages)
        };
        let over_disc = heights(inner, outer)?;
        // The disc must do if nothing lies on the axis.
        let on_axis = heights(0.0, NEEDLE * outer).unwrap_or_default();
        let mut milled_top = None;
        if matches!(self.kind, Kind::Mesh(_)) && self.is_stock {
            let [top, bottom] = self.levels(&over_disc, point, out, outer);
            if let ([Some(top), Some(bottom)], true) = ([top, bottom], top > bottom) {
                return self.between([top, bottom], edge, at);
            }
            // All that was there above a milled plane is gone; what lies under it is as it was.
            let milled = self.milled_over(&over_disc, point, out, outer);
            if let (Some(top), Some(first)) = (milled, passages.iter_mut().find(|p| p.side == Side::Entry)) {
                milled_top = Some(top);
                let plane = LEVEL_PLANE.surface(Side::Entry, top)?;
                first.transient = transient(edge, &plane, Cover::Whole)?;
            }
        }
        let of = |list: &[Passage], side: Side| {
            let mut own = list.iter().filter(|p| p.side == side).map(|p| p.transient);
            if side == Side::Entry { own.next() } else { own.next_back() }
        };
        let stands_for = |side: Side| {
            of(&over_disc, side).map_or(BoundarySurface::Plane { height: 0.0, slope: 0.0 }, |t| {
                let rise = t.first - t.last;
                let slope = if rise > LEVEL { rise / (2.0 * outer) } else { 0.0 };
                let axis = of(&on_axis, side).unwrap_or(t);
                BoundarySurface::Plane { height: 0.5 * (axis.first + axis.last), slope }
            })
        };
        let mut surfaces = [stands_for(Side::Entry), stands_for(Side::Exit)];
        if let Some(top) = milled_top {
            surfaces[0] = LEVEL_PLANE.surface(Side::Entry, top)?;
        }
        Ok(Met { surfaces, faces: None, passages: Some(passages), there: There::default(), across: 0.0 })
    }

    /// Heights at which all of the disc goes into the stock and out of it, where they are level: milled, or as the mesh is.
    fn levels(&self, over_disc: &[Passage], point: DVec3, out: DVec3, radius: f64) -> [Option<f64>; 2] {
        let whole = |side: Side| {
            let mut own = over_disc.iter().filter(|p| p.side == side);
            match (own.next(), own.next()) {
                (Some(p), None) if p.share > ALL => Some(p.transient),
                _ => None,
            }
        };
        let level = |t: Transient| (t.first - t.last <= LEVEL).then_some(0.5 * (t.first + t.last));
        let top = whole(Side::Entry)
            .and_then(|t| self.milled_above(t.last, point, out, radius).or_else(|| level(t)));
        let bottom = whole(Side::Exit).and_then(|t| {
            let milled = self.lowest(point, -out, radius).map(|d| -d).filter(|low| t.first <= low + ROUNDING);
            milled.or_else(|| level(t))
        });
        [top, bottom]
    }

    /// The plane that was milled over all that the disc goes into first.
    fn milled_over(&self, over_disc: &[Passage], point: DVec3, out: DVec3, radius: f64) -> Option<f64> {
        let first = over_disc.iter().find(|p| p.side == Side::Entry).filter(|p| p.share > ALL)?;
        let top = self.milled_above(first.transient.last, point, out, radius)?;
        // Not into a cavity under the first wall.
        let mut exits = over_disc.iter().filter(|p| p.side == Side::Exit);
        exits.all(|p| p.transient.first < top).then_some(top)
    }

    /// The lowest plane that was milled over a disc, seen along a direction.
    fn lowest(&self, point: DVec3, out: DVec3, radius: f64) -> Option<f64> {
        self.faced.iter().filter_map(|p| p.over(point, out, radius)).min_by(f64::total_cmp)
    }

    /// That plane, where the stock's surface was nowhere lower than it: a dip below it would stay.
    fn milled_above(&self, least: f64, point: DVec3, out: DVec3, radius: f64) -> Option<f64> {
        self.lowest(point, out, radius).filter(|top| least >= top - ROUNDING)
    }

    /// The stock between two levels, with the holes that are there.
    fn between(&self, levels: [f64; 2], edge: &EdgeProfile, at: DVec3) -> Result<Met> {
        let [top, bottom] = levels;
        let surfaces = [LEVEL_PLANE.surface(Side::Entry, top)?, LEVEL_PLANE.surface(Side::Exit, bottom)?];
        let to_work = self.to_part.inverse();
        let view = View { to_work: &to_work, at, faces: levels };
        let there = view.holes(edge.outer_radius(), self.drilled, self.made)?;
        Ok(Met { surfaces, faces: Some([LEVEL_PLANE; 2]), passages: None, there, across: 0.0 })
    }

    /// Entry and exit, where a face has been milled over all of the disc the plane in their place; and which of them are.
    fn milled(
        &self,
        found: [BoundarySurface; 2],
        point: DVec3,
        out: DVec3,
        radius: f64,
    ) -> Result<([BoundarySurface; 2], [bool; 2])> {
        let lowest = |out: DVec3| self.lowest(point, out, radius);
        let [entry, exit] = found;
        // The plane counts where it has taken all that was there: a dip of the stock below it would stay.
        let top = lowest(out).filter(|top| least(&entry, radius).is_some_and(|low| low >= top - ROUNDING));
        let bottom = lowest(-out).map(|d| -d).filter(|bottom| exit.greatest(radius) <= bottom + ROUNDING);
        let heights = [top.unwrap_or(f64::INFINITY), bottom.unwrap_or(f64::NEG_INFINITY)];
        if heights[0] <= heights[1].max(exit.greatest(radius)) {
            return Ok((found, [false; 2]));
        }
        let plane = |height: Option<f64>, side: Side, of: BoundarySurface| match height {
            Some(height) => LEVEL_PLANE.surface(side, height),
            None => Ok(of),
        };
        let surfaces = [plane(top, Side::Entry, entry)?, plane(bottom, Side::Exit, exit)?];
        Ok((surfaces, [top.is_some(), bottom.is_some()]))
    }
}

/// A plane square to the drill.
const LEVEL_PLANE: PartFace = PartFace::Plane { inclination: 0.0, offset: 0.0 };

/// Least height of a surface over a disc of a radius about the tool axis [mm]; `None` under a roof.
fn least(surface: &BoundarySurface, radius: f64) -> Option<f64> {
    let ends = [-radius, radius].map(|u| surface.height(u));
    match surface {
        BoundarySurface::Valley { .. } => None,
        _ => Some(if ends[0] < ends[1] { ends[0] } else { ends[1] }),
    }
}

/// Entry and exit with the heights of their frames, where the drill lies within plain faces of a simple solid.
fn exact(solid: &Solid, point: DVec3, out: DVec3, radius: f64) -> Option<[(PartFace, f64); 2]> {
    let plane = LEVEL_PLANE;
    match solid {
        Solid::Box(b) => {
            let axis = (0..3).find(|&i| out[i].abs() > 1.0 - 1e-12)?;
            let within = |i: usize| point[i] - radius >= b.min[i] && point[i] + radius <= b.max[i];
            let ends = if out[axis] > 0.0 { [b.max[axis], b.min[axis]] } else { [b.min[axis], b.max[axis]] };
            let beside = (0..3).filter(|&i| i != axis).all(within);
            beside.then(|| ends.map(|e| (plane, (e - point[axis]) * out[axis].signum())))
        }
        Solid::Cylinder { base, radius: bar, height } => {
            let off = DVec2::new(point.x - base.x, point.y - base.y);
            if out.z.abs() > 1.0 - 1e-12 {
                let ends = if out.z > 0.0 { [base.z + height, base.z] } else { [base.z, base.z + height] };
                let inside = off.length() + radius <= *bar;
                return inside.then(|| ends.map(|e| (plane, (e - point.z) * out.z.signum())));
            }
            let along = out.truncate();
            let across = point.z - radius >= base.z && point.z + radius <= base.z + height;
            if out.z.abs() > 1e-12 || !across {
                return None;
            }
            let offset = along.perp().dot(off);
            let face = PartFace::OuterCylinder { radius: *bar, offset };
            let axis = -along.dot(off);
            (offset.abs() + radius <= *bar).then_some([(face, axis), (face, axis)])
        }
        Solid::Mesh(_) => None,
    }
}

/// A simple solid as a mesh.
fn mesh_of(solid: &Solid) -> Mesh {
    match solid {
        Solid::Box(b) => {
            prism(&[[b.min.x, b.min.y], [b.max.x, b.min.y], [b.max.x, b.max.y], [b.min.x, b.max.y]], b)
        }
        Solid::Cylinder { base, radius, .. } => {
            let corner = |i: u32| {
                let (sin, cos) = (std::f64::consts::TAU * f64::from(i) / f64::from(FACETS)).sin_cos();
                [base.x + radius * cos, base.y + radius * sin]
            };
            let corners: Vec<[f64; 2]> = (0..FACETS).map(corner).collect();
            prism(&corners, &solid.bounds())
        }
        Solid::Mesh(mesh) => mesh.clone(),
    }
}

/// An upright prism over a convex outline that runs counter-clockwise.
fn prism(outline: &[[f64; 2]], bounds: &Aabb) -> Mesh {
    let n = outline.len() as u32;
    let at = |z: f64| outline.iter().map(move |p| DVec3::new(p[0], p[1], z));
    let vertices = at(bounds.min.z).chain(at(bounds.max.z)).collect();
    let mut triangles = Vec::with_capacity(4 * outline.len());
    for i in 0..n {
        let j = (i + 1) % n;
        triangles.push([i, j, n + j]);
        triangles.push([i, n + j, n + i]);
        if i > 0 && j > 0 {
            triangles.push([0, j, i]);
            triangles.push([n, n + i, n + j]);
        }
    }
    Mesh { vertices, triangles }
}
