//! Outlines as tables of operations give them: a rectangle, a circle, a polygon, a drawing, or the loops themselves.

use std::f64::consts::{FRAC_PI_2, TAU};

use glam::DVec2;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::slot_outline::OutlineSlot;
use crate::base::bounded::{MAX_LENGTH, bounded, length, positive};
use crate::base::{Code, Error, FileKind, Finding, Loader, Result};
use crate::geom::{
    LengthUnit, MeshOutline, Outline, OutlineEdge, OutlineFile, OutlineOptions, OutlineRead, OutlineReads,
    PointEntry, read_outline,
};

/// The edges of a face.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(untagged)]
pub enum OutlineEntry {
    /// "top", or the name of a file.
    Name(String),
    /// The loops and lines themselves.
    Loops(OutlineFile),
}

/// A rectangle.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct OutlineRectangle {
    /// Its middle, in coordinates of the work offset; default [0, 0].
    #[serde(default)]
    pub at: [f64; 2],
    /// Lengths of its sides.
    #[schemars(example = vec![60, 40])]
    pub size: [f64; 2],
    /// Radius of its corners; default 0.
    #[serde(default)]
    pub corner: f64,
    /// Angle by which it is turned about its middle, degrees, counter-clockwise; default 0.
    #[serde(default)]
    pub angle: f64,
}

/// A circle.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct OutlineCircle {
    /// Its centre, in coordinates of the work offset; default [0, 0].
    #[serde(default)]
    pub at: [f64; 2],
    /// Its diameter.
    #[schemars(example = 40)]
    pub diameter: f64,
}

/// The keys of a table that say its outline.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct OutlineKeys<'a> {
    pub(crate) rectangle: Option<&'a OutlineRectangle>,
    pub(crate) circle: Option<&'a OutlineCircle>,
    pub(crate) polygon: Option<&'a [[f64; 2]]>,
    pub(crate) slot: Option<OutlineSlot>,
    /// An open line by its points.
    pub(crate) polyline: Option<&'a [PointEntry]>,
    pub(crate) drawing: Option<Drawn<'a>>,
    /// The keys by which a part of a mesh is asked for, as far as they are given.
    pub(crate) mesh_keys: [Option<&'static str>; 2],
}

/// The part of a mesh that an outline is, in its own coordinates [mm].
#[derive(Clone, Copy, Debug)]
pub(crate) enum MeshPart {
    /// The material just below a height.
    Material(f64),
    /// The holes in that material.
    Holes(f64),
    /// The loop of the edge at a point.
    Edge([f64; 3]),
}

/// A drawing, with the keys that say how it is read and where it lies.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Drawn<'a> {
    pub(crate) outline: &'a OutlineEntry,
    pub(crate) unit: Option<LengthUnit>,
    pub(crate) layers: Option<&'a [String]>,
    pub(crate) snap: Option<f64>,
    pub(crate) part: Option<MeshPart>,
    pub(crate) at: [f64; 2],
    /// Degrees.
    pub(crate) angle: f64,
}

/// The outline keys of a table that has all of them.
macro_rules! outline_keys {
    ($table:expr) => {
        $crate::operations::outlines::OutlineKeys {
            rectangle: $table.rectangle.as_ref(),
            circle: $table.circle.as_ref(),
            polygon: $table.polygon.as_deref(),
            slot: $table.slot,
            polyline: None,
            mesh_keys: [$table.section.map(|_| "section"), $table.edge_at.map(|_| "edge_at")],
            drawing: $table.outline.as_ref().map(|outline| $crate::operations::outlines::Drawn {
                outline,
                unit: $table.unit,
                layers: $table.layers.as_deref(),
                snap: $table.snap,
                part: ($table.edge_at.map($crate::operations::outlines::MeshPart::Edge))
                    .or($table.section.map($crate::operations::outlines::MeshPart::Material)),
                at: $table.at,
                angle: $table.angle,
            }),
        }
    };
}
pub(crate) use outline_keys;

impl OutlineKeys<'_> {
    /// Whether none of them is given.
    pub(crate) fn is_empty(&self) -> bool {
        self.forms().iter().all(|(_, given)| !given)
    }

    /// With the section of a mesh as a pocket has it: what the material encloses.
    pub(crate) fn of_pocket(mut self) -> Self {
        if let Some(Drawn { part: Some(part @ MeshPart::Material(_)), .. }) = &mut self.drawing
            && let MeshPart::Material(z) = *part
        {
            *part = MeshPart::Holes(z);
        }
        self
    }

    /// Checks that a part of a mesh is asked for beside a drawing alone, and by one key.
    ///
    /// # Errors
    /// `KC0102` with that key.
    pub(crate) fn check_mesh_keys(&self) -> Result<()> {
        match self.mesh_keys {
            [Some(_), Some(_)] => {
                let what = "`section` and `edge_at` exclude each other";
                Err(Finding::error(Code::JOB_SHAPE, what).help("give one of them").key("edge_at").into())
            }
            [Some(key), _] | [_, Some(key)] if self.drawing.is_none() => Err(no_mesh(key)),
            _ => Ok(()),
        }
    }

    /// The ways to say an outline, and whether each is given.
    fn forms(&self) -> [(&'static str, bool); 6] {
        [
            ("rectangle", self.rectangle.is_some()),
            ("circle", self.circle.is_some()),
            ("polygon", self.polygon.is_some()),
            ("slot", self.slot.is_some()),
            ("polyline", self.polyline.is_some()),
            ("outline", self.drawing.is_some()),
        ]
    }

    /// The outline, in coordinates of the work offset.
    ///
    /// # Errors
    /// One finding with the key of the first wrong value; those of the drawing's reader.
    pub(crate) fn read(self, loader: &dyn Loader) -> Result<OutlineRead> {
        let forms = self.forms();
        let mut given = forms.iter().filter(|(_, given)| *given);
        let (Some((key, _)), None) = (given.next(), given.next()) else {
            let finding = Finding::error(Code::JOB_SHAPE, "the operation needs one outline");
            let help = "give one of rectangle, circle, polygon, slot, outline: for example rectangle = { size = [40, 30], corner = 6 }";
            return Err(finding.help(help).key("outline").into());
        };
        self.check_mesh_keys()?;
        let under = |e: Error| e.under(key);
        let outline = match (self.rectangle, self.circle, self.polygon, self.slot, self.drawing) {
            (Some(rectangle), ..) => rectangle.outline().map_err(under)?,
            (_, Some(circle), ..) => circle.outline().map_err(under)?,
            (_, _, Some(points), ..) => polygon(points).map_err(under)?,
            (_, _, _, Some(slot), _) => slot.outline().map_err(under)?,
            (.., Some(drawn)) => return drawn.read(loader),
            _ => return Err(Finding::error(Code::JOB_SHAPE, "the operation needs an outline").into()),
        };
        let weights = vec![1.0; outline.edges().len()];
        Ok(OutlineRead { outline, weights, notes: Vec::new(), edge: None })
    }

    /// The lines of a drawing, in coordinates of the work offset.
    ///
    /// # Errors
    /// As [`OutlineKeys::read`]; `KC0802` with the key `outline` where there is no drawing, or no line in it.
    pub(crate) fn read_lines(self, reads: OutlineReads, loader: &dyn Loader) -> Result<OutlineRead> {
        match self.drawing {
            Some(drawn) => drawn.read_as(reads, loader),
            None => {
                let finding =
                    Finding::error(Code::OUTLINE_FILE, "the operation has no drawing of open lines");
                Err(finding.help("write outline = \"part.dxf\"").key("outline").into())
            }
        }
    }
}

/// Distance of the arcs of a spline or an ellipse from it [mm]: a wall is cut along them.
const CURVE_TOLERANCE: f64 = 0.001;

impl Drawn<'_> {
    /// The unit of a mesh, which does not say it, in a job that is in inches.
    fn unit_of_mesh(&self, loader: &dyn Loader) -> Option<LengthUnit> {
        let OutlineEntry::Name(name) = self.outline else { return None };
        let is_mesh = FileKind::of_outline(name) == FileKind::Mesh;
        (is_mesh && loader.mesh_unit() == LengthUnit::Inch.mm()).then_some(LengthUnit::Inch)
    }

    /// The outline, turned and moved to its place.
    ///
    /// # Errors
    /// Those of the drawing's reader; `KC0103` for a place or angle out of range.
    pub(crate) fn read(self, loader: &dyn Loader) -> Result<OutlineRead> {
        self.read_as(OutlineReads::Loops, loader)
    }

    /// The part of it that is read, where it is a mesh.
    fn of_mesh(&self) -> Result<MeshOutline> {
        let Some(part) = self.part else { return Ok(MeshOutline::Top) };
        let is_mesh =
            matches!(self.outline, OutlineEntry::Name(name) if FileKind::of_outline(name) == FileKind::Mesh);
        let key = if matches!(part, MeshPart::Edge(_)) { "edge_at" } else { "section" };
        if !is_mesh {
            return Err(no_mesh(key));
        }
        match part {
            MeshPart::Material(z) | MeshPart::Holes(z) => {
                length(key, z, -MAX_LENGTH, MAX_LENGTH).map(MeshOutline::Section)
            }
            MeshPart::Edge(at) => {
                for (i, v) in at.into_iter().enumerate() {
                    length(&format!("{key}[{i}]"), v, -MAX_LENGTH, MAX_LENGTH)?;
                }
                Ok(MeshOutline::Edge(at.into()))
            }
        }
    }

    /// As [`Drawn::read`], or its lines.
    fn read_as(self, reads: OutlineReads, loader: &dyn Loader) -> Result<OutlineRead> {
        let under = |e: Error| e.under("outline");
        let options = OutlineOptions {
            unit: self.unit.or_else(|| self.unit_of_mesh(loader)),
            layers: self.layers.unwrap_or_default().to_vec(),
            snap: length("snap", self.snap.unwrap_or(OutlineOptions::default().snap), 0.0, 10.0)?,
            curve_tolerance: CURVE_TOLERANCE,
            mesh: self.of_mesh()?,
            reads,
            ..OutlineOptions::default()
        };
        let mut read = match self.outline {
            OutlineEntry::Name(name) => {
                let bytes = loader.read_as(name, FileKind::of_outline(name)).map_err(under)?;
                // An error about the point itself is one of its key.
                let at = |e: Error| match (self.part, e.code()) {
                    (Some(MeshPart::Edge(_)), Code::OUTLINE_FILE) => e.under("edge_at"),
                    _ => e.under("outline"),
                };
                read_outline(name, &bytes, &options).map_err(at)?
            }
            OutlineEntry::Loops(loops) => loops.outline(&options).map_err(under)?,
        };
        if let Some(MeshPart::Holes(z)) = self.part {
            read = enclosed(read, z)?;
        }
        for (i, v) in self.at.into_iter().enumerate() {
            length(&format!("at[{i}]"), v, -MAX_LENGTH, MAX_LENGTH)?;
        }
        let angle = bounded("angle", self.angle, -360.0, 360.0, "deg")?.to_radians();
        let [min, max] = read.outline.bounds();
        let far = min.abs().max(max.abs()).max_element();
        length("outline", far, 0.0, MAX_LENGTH)?;
        Ok(OutlineRead { outline: read.outline.moved(angle, DVec2::from_array(self.at)), ..read })
    }
}

/// The holes of a section, with the material in them as islands: all of its loops but the outermost ones.
fn enclosed(read: OutlineRead, z: f64) -> Result<OutlineRead> {
    let outline = &read.outline;
    let all = outline.loops();
    let start = |i: usize| outline.edges()[all[i].edges.start].start;
    let edges = |i: usize| outline.edges()[all[i].edges.clone()].to_vec();
    // A loop within none of the others is outermost.
    let alone: Vec<Outline> =
        (0..all.len()).map(|i| Outline::new(vec![edges(i)], Vec::new())).collect::<Result<_>>()?;
    let is_within = |i: usize| (0..all.len()).any(|j| j != i && alone[j].contains(start(i)));
    let inner: Vec<Vec<OutlineEdge>> = (0..all.len()).filter(|i| is_within(*i)).map(edges).collect();
    if inner.is_empty() {
        let finding = Finding::error(Code::OUTLINE_FILE, "the material encloses nothing at this height");
        let help =
            "choose another height; a pocket that is open to a side is drawn: rectangle, polygon, outline";
        return Err(finding.value_mm(z).help(help).key("section").into());
    }
    let outline = Outline::new(inner, Vec::new())?;
    Ok(OutlineRead { weights: vec![1.0; outline.edges().len()], outline, notes: read.notes, edge: None })
}

fn no_mesh(key: &str) -> Error {
    let what = match key {
        "section" => "only a mesh has a section at a height",
        _ => "only a mesh has edges at a point",
    };
    let help = format!("write outline = \"part.stl\", or leave `{key}` out");
    Finding::error(Code::JOB_SHAPE, what).help(help).key(key).into()
}

impl OutlineRectangle {
    fn outline(&self) -> Result<Outline> {
        let [x, y] = self.size;
        for (i, side) in self.size.into_iter().enumerate() {
            positive(&format!("size[{i}]"), side, MAX_LENGTH, "mm")?;
        }
        place(self.at)?;
        let least = if x < y { x } else { y };
        let r = length("corner", self.corner, 0.0, 0.5 * least)?;
        let angle = bounded("angle", self.angle, -360.0, 360.0, "deg")?.to_radians();
        let half = DVec2::new(0.5 * x, 0.5 * y);
        // Counter-clockwise from the lower left corner on.
        let signs = [DVec2::new(-1.0, -1.0), DVec2::new(1.0, -1.0), DVec2::ONE, DVec2::new(-1.0, 1.0)];
        let centre = |i: usize| (half - DVec2::splat(r)) * signs[i % 4];
        let mut edges = Vec::with_capacity(8);
        for i in 0..4 {
            let from = (i as f64 + 2.0) * FRAC_PI_2;
            let out = |angle: f64| {
                let (sin, cos) = angle.sin_cos();
                DVec2::new(cos.round(), sin.round())
            };
            if r > 0.0 {
                let arc = OutlineEdge::arc(centre(i), r, from, FRAC_PI_2);
                let ends = [from, from + FRAC_PI_2].map(|a| centre(i) + r * out(a));
                edges.push(OutlineEdge { start: ends[0], end: ends[1], ..arc });
            }
            let aside = r * out(from + FRAC_PI_2);
            let (start, end) = (centre(i) + aside, centre(i + 1) + aside);
            if start.distance(end) > 1e-9 * least {
                edges.push(OutlineEdge::line(start, end));
            }
        }
        Ok(Outline::new(vec![edges], Vec::new())?.moved(angle, DVec2::from_array(self.at)))
    }
}

impl OutlineCircle {
    fn outline(&self) -> Result<Outline> {
        let diameter = positive("diameter", self.diameter, MAX_LENGTH, "mm")?;
        place(self.at)?;
        let circle = OutlineEdge::arc(DVec2::from_array(self.at), 0.5 * diameter, -FRAC_PI_2, TAU);
        Outline::new(vec![vec![circle]], Vec::new())
    }
}

fn polygon(points: &[[f64; 2]]) -> Result<Outline> {
    for (i, p) in points.iter().enumerate() {
        place(*p).map_err(|mut e| {
            e.0.key = Some(format!("[{i}]"));
            e
        })?;
    }
    if points.len() < 3 {
        let finding = Finding::error(Code::JOB_VALUE, "a polygon has three corners at least");
        return Err(finding.value(points.len() as f64, "corners").bound(3.0, "corners").into());
    }
    Outline::polygon(&points.iter().map(|p| DVec2::from_array(*p)).collect::<Vec<_>>())
}

fn place(at: [f64; 2]) -> Result<()> {
    for (i, v) in at.into_iter().enumerate() {
        length(&format!("at[{i}]"), v, -MAX_LENGTH, MAX_LENGTH)?;
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rectangles_and_circles_have_their_areas() {
        let of = |size, corner, angle| {
            OutlineRectangle { at: [7.0, -3.0], size, corner, angle }.outline().unwrap()
        };
        assert!((of([40.0, 30.0], 6.0, 0.0).area() - (1200.0 - (4.0 - FRAC_PI_2 * 2.0) * 36.0)).abs() < 1e-9);
        assert_eq!(of([40.0, 30.0], 0.0, 30.0).edges().len(), 4);
        // An obround, and a circle that is a rectangle's.
        assert_eq!(of([40.0, 30.0], 15.0, 10.0).edges().len(), 6);
        assert!((of([30.0, 30.0], 15.0, 0.0).area() - FRAC_PI_2 * 450.0).abs() < 1e-9);
        let circle = OutlineCircle { at: [1.0, 1.0], diameter: 10.0 }.outline().unwrap();
        assert!((circle.area() - FRAC_PI_2 * 50.0).abs() < 1e-9);
        let [min, max] = of([40.0, 30.0], 6.0, 0.0).bounds();
        assert!(
            (min - DVec2::new(-13.0, -18.0)).length() < 1e-12
                && (max - DVec2::new(27.0, 12.0)).length() < 1e-12
        );
    }

    #[test]
    fn corners_that_do_not_fit_are_refused() {
        let table = OutlineRectangle { at: [0.0; 2], size: [40.0, 10.0], corner: 6.0, angle: 0.0 };
        let error = table.outline().unwrap_err();
        assert!(error.0.key.as_deref() == Some("corner") && error.0.bound.unwrap().value == 5.0);
    }
}
