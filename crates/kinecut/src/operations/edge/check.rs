//! Broken edges, checked: the outline read and placed, or the face before; feeds; the break of the cutter.

use super::{EdgeKeys, WantedEdges};
use crate::base::bounded::{MAX_LENGTH, length, positive};
use crate::base::{Code, Error, Finding, Result};
use crate::contouring::{ContourLoops, ContourSide, EdgeBreak};
use crate::geom::{MeshEdge, Outline, OutlineRead};
use crate::holes::Sense;
use crate::operations::named::NamedOutline;
use crate::operations::outlines::{Drawn, MeshPart};
use crate::operations::{Around, Milling, feed_of, milling_of, spindle, tool_of, whole_revolutions};
use crate::page::trimmed;
use crate::tool::{Hand, Tool};

/// Share of the feed at which the cutter goes down where the job does not say.
const DOWN: f64 = 0.5;
/// Deviation of the width where the job does not say [mm].
const USUAL_TOLERANCE: f64 = 0.01;

/// The breaking of an edge along an outline.
#[derive(Clone, Debug)]
pub struct EdgeOperation {
    /// Noun of the operation: "chamfer".
    pub noun: &'static str,
    /// Tool, speed, coolant, tolerance.
    pub milling: Milling,
    /// The outline in coordinates of the work offset.
    pub outline: Outline,
    /// Side of the outline on which the cutter runs: outside or inside.
    pub side: ContourSide,
    /// Loops whose edges are broken.
    pub loops: ContourLoops,
    /// Height of the edge [mm].
    pub top: f64,
    /// Distance of the wall before the outline [mm].
    pub stock_to_leave: f64,
    /// Notes of the outline's reader.
    pub notes: Vec<String>,
    /// The break and the place of the cutter's tip.
    pub cut: EdgeBreak,
    /// Feed along the edge [mm/s].
    pub feed: f64,
    /// Feed down [mm/s].
    pub plunge_feed: f64,
    /// Climb or conventional milling.
    pub direction: Sense,
    /// Radius of the arcs on which the edge is joined and left [mm].
    pub lead_radius: Option<f64>,
    /// Point near which the cut begins.
    pub start: Option<[f64; 2]>,
    /// Way beyond the start that is cut twice [mm].
    pub overlap: Option<f64>,
    /// Whether the outline is that of another operation, which compares its wall.
    pub of_other: bool,
    /// The edges of the face before that are broken; `None`: whole loops.
    pub edges: Option<WantedEdges>,
}

impl EdgeOperation {
    /// A person's name for it.
    pub(crate) fn name(&self) -> String {
        let [min, max] = self.outline.bounds();
        let size = max - min;
        let shown = |mm: f64| trimmed(mm, 2);
        let where_ = match &self.edges {
            Some(edges) => edges.in_words(),
            None => match self.side {
                ContourSide::Inside => "inside".to_owned(),
                ContourSide::Left => "left of line".to_owned(),
                ContourSide::Right => "right of line".to_owned(),
                ContourSide::Outside | ContourSide::On => "outside".to_owned(),
            },
        };
        format!("{} {} {where_} {} x {}", self.noun, shown(self.cut.width()), shown(size.x), shown(size.y))
    }

    /// Whether its tool cuts left-handed.
    pub(crate) fn is_left_hand(&self) -> bool {
        self.milling.tool.limits.hand == Hand::Left
    }

    /// Whether the edges of a loop are broken.
    pub(crate) fn is_wanted(&self, outer: bool) -> bool {
        match self.loops {
            ContourLoops::All => true,
            ContourLoops::Outer => outer,
            ContourLoops::Inner => !outer,
        }
    }
}

/// The outline of a table under its name, by which others refer to it; one that refers to another has none of its own to give.
pub(crate) fn named_outline<'a>(t: &EdgeKeys<'a>) -> Option<NamedOutline<'a>> {
    let name = t.name.filter(|_| !t.own.is_empty())?;
    Some(NamedOutline {
        name,
        keys: t.own,
        side: t.side.unwrap_or_default().into(),
        loops: t.loops.unwrap_or_default(),
        top: t.top.unwrap_or_default(),
        stock_to_leave: t.stock_to_leave.unwrap_or_default(),
        plane: t.plane,
        from_edge: from_edge(t),
        has_wall: false,
    })
}

/// Whether its side and its top follow from the edge of a mesh.
fn from_edge(t: &EdgeKeys<'_>) -> [bool; 2] {
    let is_edge = matches!(t.own.drawing, Some(Drawn { part: Some(MeshPart::Edge(_)), .. }));
    [is_edge && t.side.is_none(), is_edge && t.top.is_none()]
}

/// Checks a table; `cut` gives the break that its tool makes.
pub(crate) fn operation(
    t: &EdgeKeys<'_>,
    around: &Around<'_>,
    cut: impl Fn(&Tool) -> Result<EdgeBreak>,
) -> Result<EdgeOperation> {
    let tool = tool_of(t.tool, around.tools)?;
    let cut = cut(&tool)?;
    t.own.check_mesh_keys()?;
    let (place, read, edges, of_other) = match WantedEdges::of(t, around)? {
        Some((edges, face)) => {
            let notes = face.notes.clone();
            let outline = face.case.outline.clone();
            let read = OutlineRead { outline, weights: Vec::new(), notes, edge: None };
            (Place::of_face(t, face.table.top)?, read, Some(edges), false)
        }
        None => {
            let edge = edge(t, around)?;
            let read = edge
                .keys
                .read_beside(edge.side, around.loader)
                .map_err(|e| if t.of.is_some() { at_of(e) } else { e })?;
            let place = Place::of(&edge).at_edge(&edge, read.edge.as_ref())?;
            (place, read, None, edge.has_wall)
        }
    };
    length("top", place.top, -MAX_LENGTH, MAX_LENGTH)?;
    length("stock_to_leave", place.stock_to_leave, 0.0, MAX_LENGTH)?;
    for (i, v) in t.start.iter().flatten().enumerate() {
        length(&format!("start[{i}]"), *v, -MAX_LENGTH, MAX_LENGTH)?;
    }
    let speed = spindle(t.speed, t.cutting_speed, ("width", 2.0 * cut.top_radius()))?;
    let speed = whole_revolutions(speed);
    let feed = feed_of(t.noun, t.feed, t.feed_per_tooth, speed, tool.teeth)?;
    let plunge_feed = match t.plunge_feed {
        Some(feed) => positive("plunge_feed", feed, 1e6, "mm/min")? / 60.0,
        None => DOWN * feed,
    };
    let tolerance = Some(t.tolerance.unwrap_or(USUAL_TOLERANCE));
    Ok(EdgeOperation {
        noun: t.noun,
        outline: read.outline,
        side: place.side,
        loops: place.loops,
        top: place.top,
        stock_to_leave: place.stock_to_leave,
        notes: read.notes,
        cut,
        feed,
        plunge_feed,
        direction: t.direction,
        lead_radius: t.lead_radius,
        start: t.start,
        overlap: t.overlap,
        of_other,
        edges,
        milling: milling_of(tool, speed, t.coolant, tolerance)?,
    })
}

/// The place of an edge beside an outline.
struct Place {
    side: ContourSide,
    loops: ContourLoops,
    top: f64,
    stock_to_leave: f64,
}

impl Place {
    fn of(edge: &NamedOutline<'_>) -> Place {
        let (side, loops) = (edge.side, edge.loops);
        Place { side, loops, top: edge.top, stock_to_leave: edge.stock_to_leave }
    }

    /// With the side and the height of the edge of a mesh, where they follow from it.
    fn at_edge(mut self, of: &NamedOutline<'_>, edge: Option<&MeshEdge>) -> Result<Place> {
        let Some(edge) = edge else { return Ok(self) };
        let wrong = |what: &str, help: &str, key: &str| {
            Err(Finding::error(Code::JOB_SHAPE, what).value(edge.height, "mm (Z)").help(help).key(key).into())
        };
        if !edge.is_upper {
            let what = "the edge of the mesh cannot be broken from above: the material does not stand out upwards at it";
            return wrong(what, "name an upper edge of a boss, a plate, a hole or a pocket", "edge_at");
        }
        let side = if edge.material_inside { ContourSide::Outside } else { ContourSide::Inside };
        if of.from_edge[0] {
            self.side = side;
        } else if self.side != side {
            let what = "the material lies on the other side of the edge of the mesh";
            return wrong(what, "leave out `side`: it follows from the edge", "side");
        }
        if of.from_edge[1] {
            self.top = edge.height;
        }
        Ok(self)
    }

    /// Of a face at a height, whose material lies inside of its outline.
    fn of_face(t: &EdgeKeys<'_>, top: f64) -> Result<Place> {
        if t.side.is_some_and(|side| ContourSide::from(side) != ContourSide::Outside) {
            let finding = Finding::error(Code::JOB_SHAPE, "the edges of a face are broken from outside");
            return Err(finding
                .help("leave out `side`: holes of the face are cut from within")
                .key("side")
                .into());
        }
        Ok(Place {
            side: ContourSide::Outside,
            loops: t.loops.unwrap_or_default(),
            top: t.top.unwrap_or(top),
            stock_to_leave: t.stock_to_leave.unwrap_or(0.0),
        })
    }
}

/// The edge: that which the table says, the rest of it that of the operation to which it refers.
fn edge<'a>(t: &EdgeKeys<'a>, around: &Around<'a>) -> Result<NamedOutline<'a>> {
    let name = t.name.unwrap_or_default();
    let of = match t.of {
        Some(of) if t.own.is_empty() => {
            let found = NamedOutline::find(of, around.before)?;
            agrees(t, &found)?;
            // A height that is given here is taken.
            let from_edge = [found.from_edge[0], found.from_edge[1] && t.top.is_none()];
            NamedOutline { name, from_edge, ..found }
        }
        Some(_) => {
            let finding = Finding::error(Code::JOB_SHAPE, "`of` and an outline exclude each other");
            return Err(finding.help("give one of them").key("of").into());
        }
        None => NamedOutline {
            name,
            keys: t.own,
            side: ContourSide::Outside,
            loops: ContourLoops::All,
            top: 0.0,
            stock_to_leave: 0.0,
            plane: t.plane,
            from_edge: from_edge(t),
            has_wall: false,
        },
    };
    let edge = NamedOutline {
        side: t.side.map_or(of.side, ContourSide::from),
        loops: t.loops.unwrap_or(of.loops),
        top: t.top.unwrap_or(of.top),
        stock_to_leave: t.stock_to_leave.unwrap_or(of.stock_to_leave),
        ..of
    };
    if edge.plane != t.plane {
        let finding = Finding::error(Code::JOB_SHAPE, "the operation that `of` names works in another plane");
        return Err(finding.help("give both the same plane").key("of").into());
    }
    if edge.side == ContourSide::On {
        let finding =
            Finding::error(Code::JOB_SHAPE, "the contour that `of` names runs on its line and has no side");
        return Err(finding
            .help("say it here: side = \"outside\" or \"inside\", for an open line \"left\" or \"right\"")
            .key("of")
            .into());
    }
    Ok(edge)
}

/// A table says nothing else of the wall than the operation to which it refers; a contour on its line has none.
fn agrees(t: &EdgeKeys<'_>, of: &NamedOutline<'_>) -> Result<()> {
    /// Difference of stock that is rounding [mm].
    const ROUNDING: f64 = 1e-9;
    if of.side == ContourSide::On {
        return Ok(());
    }
    let other = |key: &str, what: &str| {
        let help = format!("leave out `{key}`, or give the outline itself in place of `of`");
        Finding::error(Code::JOB_SHAPE, format!("`{key}` contradicts the operation that `of` names: {what}"))
            .help(help)
            .key(key)
    };
    if t.side.is_some_and(|side| ContourSide::from(side) != of.side) {
        return Err(other("side", "its wall is that of the other side").into());
    }
    if of.loops != ContourLoops::All && t.loops.is_some_and(|loops| loops != of.loops) {
        return Err(other("loops", "it does not cut all of these loops").into());
    }
    if let Some(leave) = t.stock_to_leave.filter(|leave| (leave - of.stock_to_leave).abs() > ROUNDING) {
        let finding = other("stock_to_leave", "its wall lies elsewhere");
        return Err(finding.value_mm(leave).bound_mm(of.stock_to_leave).into());
    }
    Ok(())
}

/// An error of the outline of the operation to which a table refers.
fn at_of(Error(mut finding): Error) -> Error {
    finding.key = None;
    finding.key("of").into()
}
