//! The shape of an entity: lines and arcs [mm].
//!
//! LWPOLYLINE, POLYLINE, ARC and CIRCLE are given in coordinates of their own when drawn from below (extrusion
//! (0, 0, -1)): X is then mirrored. LINE, ELLIPSE and SPLINE are always in those of the drawing; an ellipse seen from
//! below runs the other way.

use std::f64::consts::TAU;

use glam::DVec2;

use super::groups::{Entity, number, whole};
use crate::base::{Code, Result};
use crate::geom::outline::OutlineEdge;
use crate::geom::outline::freeform::{EllipticArc, Spline};
use crate::geom::outline::source::Source;
use crate::num::angle::sweep;

/// Distance at which consecutive points of a polyline are the same [mm]: below the last digit of drawings.
const SAME: f64 = 1e-7;
/// Largest lean of the extrusion: the rounding of its digits.
const LEAN: f64 = 1e-6;

/// Edges, closed or not.
pub(super) enum Shape {
    Loop(Vec<OutlineEdge>),
    Path(Vec<OutlineEdge>),
}

/// A shape and what is to be said about it.
pub(super) struct Found {
    pub(super) shape: Shape,
    /// An ellipse or spline was replaced by arcs.
    pub(super) converted: bool,
    /// Points that were given twice.
    pub(super) points_twice: usize,
    /// It is a point: an arc of radius 0, a line back to where it began.
    pub(super) is_point: bool,
    /// Heights that occur [mm].
    pub(super) heights: Vec<f64>,
}

/// The shape of an entity.
pub(super) fn shape(
    source: &Source,
    entity: &Entity<'_>,
    vertices: &[Entity<'_>],
    mm: f64,
    tolerance: f64,
) -> Result<Found> {
    let read = Read { source, entity, mm };
    let heights =
        read.numbers(30).chain(read.numbers(31)).chain(read.numbers(38)).collect::<Result<Vec<_>>>()?;
    let mut found = Found {
        shape: Shape::Path(Vec::new()),
        converted: false,
        points_twice: 0,
        is_point: false,
        heights: heights.into_iter().map(|z| z * mm).collect(),
    };
    let mirrored = read.mirrored()?;
    let flip = |p: DVec2| if mirrored { DVec2::new(-p.x, p.y) } else { p };
    match entity.name {
        "LINE" => {
            let (a, b) = (read.point(10)?, read.point(11)?);
            found.shape = Shape::Path(vec![OutlineEdge::line(a, b)]);
        }
        "CIRCLE" => {
            let circle = OutlineEdge::arc(flip(read.point(10)?), read.radius()?, 0.0, TAU);
            found.shape = Shape::Loop(vec![circle]);
        }
        "ARC" => {
            let [from, to] = [read.one(50)?.to_radians(), read.one(51)?.to_radians()];
            let gone = sweep(from, to, true);
            let (centre, radius) = (read.point(10)?, read.radius()?);
            let arc = if mirrored {
                OutlineEdge::arc(flip(centre), radius, std::f64::consts::PI - from, -gone)
            } else {
                OutlineEdge::arc(centre, radius, from, gone)
            };
            found.shape = if gone >= TAU { Shape::Loop(vec![arc]) } else { Shape::Path(vec![arc]) };
        }
        "LWPOLYLINE" => {
            let points = read.light_points()?;
            polyline(&mut found, &points, read.flag(70)? & 1 != 0, flip);
        }
        "POLYLINE" => {
            let flags = read.flag(70)?;
            /// Flags of meshes of polygons and faces.
            const MESH: i64 = 16 | 64;
            if flags & MESH != 0 {
                return Err(read
                    .error("a POLYLINE that is a mesh is no outline")
                    .help("export the part as STL")
                    .into());
            }
            let points = heavy_points(source, vertices, mm)?;
            polyline(&mut found, &points, flags & 1 != 0, flip);
        }
        "ELLIPSE" => {
            let major = read.point(11)?;
            let ratio = read.one(40)?;
            if !(ratio > 0.0 && ratio <= 1.0 + LEAN) {
                return Err(read.error("an ELLIPSE needs two half axes").value(ratio, "ratio").into());
            }
            let minor = ratio * if mirrored { -major.perp() } else { major.perp() };
            let [from, to] = [read.one_or(41, 0.0)?, read.one_or(42, TAU)?];
            let ellipse =
                EllipticArc { centre: read.point(10)?, major, minor, from, sweep: sweep(from, to, true) };
            /// Parameters are written with few digits: a whole turn is known by them.
            const WHOLE: f64 = TAU - 1e-6;
            let whole = ellipse.sweep >= WHOLE;
            let ellipse = if whole { EllipticArc { sweep: TAU, ..ellipse } } else { ellipse };
            let edges = if TAU * major.length() > SAME {
                ellipse.edges(tolerance).map_err(|e| read.converting(&e))?
            } else {
                Vec::new()
            };
            found.converted = edges.len() > 1;
            found.shape = if whole { Shape::Loop(edges) } else { Shape::Path(edges) };
        }
        _ => {
            let edges = read.spline()?.edges(tolerance).map_err(|e| read.converting(&e))?;
            found.converted = true;
            let closed = match (edges.first(), edges.last()) {
                (Some(a), Some(b)) => a.start.distance(b.end) <= SAME,
                _ => false,
            };
            found.shape = if closed { Shape::Loop(joined(edges)) } else { Shape::Path(edges) };
        }
    }
    let (Shape::Loop(edges) | Shape::Path(edges)) = &found.shape;
    if edges.iter().map(OutlineEdge::length).sum::<f64>() <= SAME {
        found = Found {
            shape: Shape::Path(Vec::new()),
            converted: false,
            points_twice: 0,
            is_point: true,
            ..found
        };
    }
    Ok(found)
}

/// A closed chain whose last point is its first but for rounding, with the two made one.
fn joined(mut edges: Vec<OutlineEdge>) -> Vec<OutlineEdge> {
    if let (Some(first), Some(last)) = (edges.first().copied(), edges.last_mut()) {
        *last = crate::geom::outline::through::with_ends(last, last.start, first.start);
    }
    edges
}

fn polyline(found: &mut Found, points: &[(DVec2, f64)], closed: bool, flip: impl Fn(DVec2) -> DVec2) {
    let mut kept: Vec<(DVec2, f64)> = Vec::with_capacity(points.len());
    for &(p, bulge) in points {
        match kept.last_mut() {
            // The edge that begins at the later of two equal points counts.
            Some(last) if last.0.distance(p) <= SAME => {
                last.1 = bulge;
                found.points_twice += 1;
            }
            _ => kept.push((p, bulge)),
        }
    }
    // Closed by the flag and by a last point that is the first: the point goes, and with it its bulge.
    let returns = kept.len() > 2 && kept[0].0.distance(kept[kept.len() - 1].0) <= SAME;
    if returns {
        kept.pop();
    }
    let closed = (closed || returns) && kept.len() > 1;
    let edges: Vec<OutlineEdge> = (0..if closed { kept.len() } else { kept.len().saturating_sub(1) })
        .map(|i| {
            let (a, bulge) = kept[i];
            let b = kept[(i + 1) % kept.len()].0;
            let bulge = if flip(DVec2::X).x < 0.0 { -bulge } else { bulge };
            OutlineEdge::bulge(flip(a), flip(b), bulge)
        })
        .collect();
    found.shape = if closed { Shape::Loop(edges) } else { Shape::Path(edges) };
}

fn heavy_points(source: &Source, vertices: &[Entity<'_>], mm: f64) -> Result<Vec<(DVec2, f64)>> {
    /// Flag of a point that only guides a spline.
    const FRAME: i64 = 16;
    let mut points = Vec::with_capacity(vertices.len());
    for entity in vertices {
        let read = Read { source, entity, mm };
        if read.flag(70)? & FRAME == 0 {
            points.push((read.point(10)?, read.one_or(42, 0.0)?));
        }
    }
    Ok(points)
}

/// The name of an entity with its article: "an ARC".
pub(super) fn with_article(name: &str) -> String {
    let spoken = name.starts_with(['A', 'E', 'I', 'O']) || name.starts_with("LW");
    format!("{} {name}", if spoken { "an" } else { "a" })
}

/// The numbers of an entity.
pub(super) struct Read<'a> {
    pub(super) source: &'a Source,
    pub(super) entity: &'a Entity<'a>,
    pub(super) mm: f64,
}

impl<'a> Read<'a> {
    pub(super) fn error(&self, message: impl Into<String>) -> crate::base::Finding {
        self.source.error(self.entity.offset, message)
    }

    fn converting(&self, error: &crate::base::Error) -> crate::base::Error {
        let what = format!("{} cannot stand as arcs: {}", with_article(self.entity.name), error.0.message);
        self.error(what).help("convert it to lines and arcs in the drawing").into()
    }

    fn numbers(&self, code: i32) -> impl Iterator<Item = Result<f64>> + use<'a> {
        let source = self.source;
        self.entity.groups.iter().filter(move |g| g.code == code).map(move |g| number(source, g))
    }

    fn one(&self, code: i32) -> Result<f64> {
        self.numbers(code).next().unwrap_or_else(|| {
            Err(self.error(format!("{} lacks its group {code}", with_article(self.entity.name))).into())
        })
    }

    pub(super) fn one_or(&self, code: i32, otherwise: f64) -> Result<f64> {
        self.numbers(code).next().unwrap_or(Ok(otherwise))
    }

    pub(super) fn flag(&self, code: i32) -> Result<i64> {
        self.entity.groups.iter().find(|g| g.code == code).map_or(Ok(0), |g| whole(self.source, g))
    }

    pub(super) fn point(&self, code: i32) -> Result<DVec2> {
        Ok(DVec2::new(self.one(code)?, self.one(code + 10)?) * self.mm)
    }

    fn radius(&self) -> Result<f64> {
        let radius = self.one(40)? * self.mm;
        if radius >= 0.0 {
            return Ok(radius);
        }
        let what = format!("the radius of {} must not be negative", with_article(self.entity.name));
        Err(crate::base::Finding { code: Code::OUTLINE_EDGE, ..self.error(what).value_mm(radius) }.into())
    }

    /// True if the entity is drawn as seen from below.
    pub(super) fn mirrored(&self) -> Result<bool> {
        let (x, y, z) = (self.one_or(210, 0.0)?, self.one_or(220, 0.0)?, self.one_or(230, 1.0)?);
        if x.hypot(y) > LEAN * z.abs() {
            let what = format!("{} is not drawn in the XY plane", with_article(self.entity.name));
            return Err(self
                .error(what)
                .value(x.hypot(y).atan2(z).to_degrees(), "deg")
                .help("draw the face in the XY plane of the world")
                .into());
        }
        Ok(z < 0.0)
    }

    /// Points of an LWPOLYLINE with their bulges: a point begins with its X.
    fn light_points(&self) -> Result<Vec<(DVec2, f64)>> {
        let mut points: Vec<(DVec2, f64)> = Vec::new();
        let mut complete = true;
        for group in &self.entity.groups {
            match group.code {
                10 => {
                    points.push((DVec2::new(number(self.source, group)? * self.mm, 0.0), 0.0));
                    if !complete {
                        break;
                    }
                    complete = false;
                }
                20 if !complete => {
                    if let Some((p, _)) = points.last_mut() {
                        p.y = number(self.source, group)? * self.mm;
                    }
                    complete = true;
                }
                42 => {
                    if let Some((_, bulge)) = points.last_mut() {
                        *bulge = number(self.source, group)?;
                    }
                }
                _ => {}
            }
        }
        if !complete {
            return Err(self.error("a point of an LWPOLYLINE has an X but no Y").into());
        }
        Ok(points)
    }

    fn spline(&self) -> Result<Spline> {
        let all = |code: i32| self.numbers(code).collect::<Result<Vec<f64>>>();
        let (x, y) = (all(10)?, all(20)?);
        if x.is_empty() {
            return Err(self
                .error("a SPLINE is given by points to pass only, not by its control points")
                .help("convert it to lines and arcs, or to a polyline, in the drawing")
                .into());
        }
        let points: Vec<DVec2> = x.iter().zip(&y).map(|(&x, &y)| DVec2::new(x, y) * self.mm).collect();
        let degree = usize::try_from(self.flag(71)?).unwrap_or(0);
        if x.len() != y.len() {
            return Err(self.error("a SPLINE has points without Y").into());
        }
        Spline::new(degree, all(40)?, &points, &all(41)?)
            .map_err(|why| self.error(format!("a SPLINE is not valid: {why}")).into())
    }
}
