//! Contours from drawings: half a section of the tool, as lines and arcs of a DXF, SVG or JSON outline.
//!
//! The axis of the tool is an axis of the drawing through its origin; the half lies on either side of it. It is an open chain
//! from the axis to the axis, or a closed half with the axis as an edge, drawn in any direction and order; the tip points
//! towards the lower end of the axis (to -Y, or to -X). Layers called `cutting`, `shank` and `holder` say what a part is
//! there for; what is on others cuts. The face on which the drawing ends at its top is held, not cutting.

use glam::DVec2;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::{Contour, ContourElement, ContourShape, ElementRole};
use crate::base::{Code, FileKind, Finding, Loader, Location, Result};
use crate::geom::{LengthUnit, Outline, OutlineEdge, OutlineOptions, SectionAxis, read_outline};
use crate::num::angle::wrap;

/// Distance from the axis within which an edge lies on it [mm]: what reading a drawing leaves.
const ON_AXIS: f64 = 1e-9;

/// Largest snap of a drawing of a tool [mm].
const LARGEST_SNAP: f64 = 1.0;

/// Half a section in a drawing.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct SectionDrawing {
    /// File, in the folder of this one. Layers called `cutting`, `shank` and `holder` say what a part is there for.
    #[schemars(example = &"tool.dxf")]
    pub file: String,
    /// Axis of the drawing that is the tool's, the tip towards its lower end; default "y".
    #[serde(default)]
    pub axis: Option<SectionAxis>,
    /// Unit of the drawing's numbers, whatever it says.
    #[serde(default)]
    pub unit: Option<LengthUnit>,
    /// Distance at which ends of lines and arcs are joined; default 0.01.
    #[serde(default)]
    pub snap: Option<f64>,
    /// Layers that are read; default: all.
    #[serde(default)]
    pub layers: Option<Vec<String>>,
}

impl SectionDrawing {
    /// The contour of the drawing.
    ///
    /// # Errors
    /// `KC0103` for a snap out of range, those of the loader, else as [`ContourRead::of_drawing`].
    pub fn read(&self, loader: &dyn Loader) -> Result<ContourRead> {
        let usual = OutlineOptions::default();
        let snap = self.snap.unwrap_or(usual.snap);
        if !(0.0..=LARGEST_SNAP).contains(&snap) {
            return Err(Finding::error(Code::JOB_VALUE, "the snap is out of range")
                .value_mm(snap)
                .bound_mm(if snap < 0.0 { 0.0 } else { LARGEST_SNAP })
                .key("snap")
                .into());
        }
        let options = OutlineOptions {
            unit: self.unit,
            snap,
            layers: self.layers.clone().unwrap_or_default(),
            half_section: Some(self.axis.unwrap_or(SectionAxis::Y)),
            ..usual
        };
        ContourRead::of_drawing(&self.file, &loader.read_as(&self.file, FileKind::Drawing)?, &options)
    }
}

/// A contour from a file.
#[derive(Clone, Debug, PartialEq)]
pub struct ContourRead {
    /// The contour.
    pub contour: Contour,
    /// Notes about parts passed over, joined, left out or converted, one sentence each.
    pub notes: Vec<String>,
}

impl ContourRead {
    /// A contour from the bytes of a drawing (`.dxf`, `.svg`, `.json`). Without an axis in the options it is the drawing's Y
    /// axis.
    ///
    /// ```
    /// # use kinecut_geom as kinecut;
    /// use kinecut::geom::OutlineOptions;
    /// use kinecut::tool::ContourRead;
    /// let text = br#"{ "loops": [[[0, 0], [5, 0], [5, 30], [0, 30]]] }"#;
    /// let mill = ContourRead::of_drawing("mill.json", text, &OutlineOptions::default()).unwrap().contour;
    /// assert_eq!((mill.elements().len(), mill.largest_radius(), mill.height()), (3, 5.0, 30.0));
    /// ```
    ///
    /// # Errors
    /// `KC0802` to `KC0805` as for outlines, with the entity and its line; `KC0704` when it is not half a section.
    pub fn of_drawing(name: &str, bytes: &[u8], options: &OutlineOptions) -> Result<ContourRead> {
        let axis = options.half_section.unwrap_or(SectionAxis::Y);
        let read =
            read_outline(name, bytes, &OutlineOptions { half_section: Some(axis), ..options.clone() })?;
        let mut notes = read.notes;
        let in_file = |mut e: crate::base::Error| {
            e.0.place.get_or_insert_with(|| Location::whole_file(name));
            e
        };
        let elements = elements(&read.outline, axis, &mut notes).map_err(in_file)?;
        Ok(ContourRead { contour: Contour::new(elements).map_err(in_file)?, notes })
    }
}

fn elements(outline: &Outline, axis: SectionAxis, notes: &mut Vec<String>) -> Result<Vec<ContourElement>> {
    let refuse = |what: &str, help: &str| Finding::error(Code::CONTOUR, what).help(help);
    if outline.loops().len() != 1 {
        return Err(refuse("the drawing holds more than one contour", "leave one, or name its layers")
            .value(outline.loops().len() as f64, "contours")
            .bound(1.0, "contours")
            .into());
    }
    let edges = outline.edges();
    let on_axis = |e: &OutlineEdge| axis.carries(e, ON_AXIS);
    let Some(first) = edges.iter().position(on_axis) else {
        let what = "the contour of the drawing has no edge on the axis";
        return Err(refuse(
            what,
            "draw one half of the section, with the axis through the origin, or say which axis it is",
        )
        .into());
    };
    // From behind the axis, all around.
    let around: Vec<&OutlineEdge> =
        edges[first..].iter().chain(&edges[..first]).filter(|e| !on_axis(e)).collect();
    let (low, high) = around
        .iter()
        .map(|e| e.extent(aside(axis)))
        .fold((0.0f64, 0.0f64), |(l, h), [a, b]| (if a < l { a } else { l }, if b > h { b } else { h }));
    let flip = if -low > high { -1.0 } else { 1.0 };
    // Seen in radius and height the material must be on the left; in an outline it is on the right.
    let mirrored = (axis == SectionAxis::X) != (flip < 0.0);
    let known: Vec<Option<ElementRole>> = outline.labels().iter().map(|l| role(l)).collect();
    if known.iter().any(Option::is_some) {
        let others = outline.labels().iter().zip(&known).filter(|(_, r)| r.is_none());
        notes.extend(others.map(|(l, _)| format!("layer {l:?} is taken as cutting")));
    }
    let mut elements: Vec<ContourElement> = around
        .iter()
        .map(|e| {
            let place = |p: DVec2| DVec2::new(flip * axis.aside(p), axis.along(p));
            let role = known.get(e.label as usize).copied().flatten().unwrap_or(ElementRole::Cutting);
            ContourElement { shape: shape(e, place, mirrored), role, body: 0 }
        })
        .collect();
    if !mirrored {
        elements.reverse();
    }
    if let Some(last) = elements.last_mut()
        && last.role == ElementRole::Cutting
        && matches!(last.shape, ContourShape::Line { start, end } if (start.y - end.y).abs() <= ON_AXIS)
    {
        last.role = ElementRole::Shank;
    }
    number_bodies(&mut elements);
    Ok(elements)
}

fn aside(axis: SectionAxis) -> DVec2 {
    match axis {
        SectionAxis::X => DVec2::Y,
        SectionAxis::Y => DVec2::X,
    }
}

/// A change of role begins a body, but for the face at the top.
fn number_bodies(elements: &mut [ContourElement]) {
    let last = elements.len().saturating_sub(1);
    let (mut body, mut role) = (0u16, elements.first().map(|e| e.role));
    for (i, element) in elements.iter_mut().enumerate() {
        if Some(element.role) != role && i < last {
            body = body.saturating_add(1);
            role = Some(element.role);
        }
        element.body = body;
    }
}

fn role(layer: &str) -> Option<ElementRole> {
    match layer.trim().to_ascii_lowercase().as_str() {
        "cutting" => Some(ElementRole::Cutting),
        "shank" => Some(ElementRole::Shank),
        "holder" => Some(ElementRole::Holder),
        _ => None,
    }
}

/// An edge, its places mapped, in the direction that has the material on the left.
fn shape(edge: &OutlineEdge, place: impl Fn(DVec2) -> DVec2, mirrored: bool) -> ContourShape {
    let edge = if mirrored { *edge } else { edge.reversed() };
    let (start, end) = (place(edge.start), place(edge.end));
    let Some(turn) = edge.turn else { return ContourShape::Line { start, end } };
    let centre = place(turn.centre);
    let sweep = if mirrored { -turn.sweep } else { turn.sweep };
    let convex = sweep > 0.0;
    let out = if convex { start - centre } else { centre - start };
    let from = wrap(out.y.atan2(out.x));
    ContourShape::Arc { centre, radius: turn.radius, convex, from, to: from + sweep }
}
