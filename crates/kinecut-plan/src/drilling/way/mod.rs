//! All that a drill meets on its way: the face where it goes in, bores that cross the way, a hole that is there before,
//! the face where it comes out.
//!
//! Surfaces that do not touch one another under the drill are each a passage for itself, exactly. If a bore opens into
//! a face or another bore, or a pre-hole ends in one, only the parts of their surfaces that bound the part count: see
//! `clash`.

mod cell;
mod clash;

use self::clash::{WayBody, apart};
use super::domain::{Laid, area, transient_outside};
use super::{BoundarySurface, Cover, CrossBore, Passage, PreHole, Side};
use crate::base::Result;
use crate::geom::EdgeProfile;

/// Surfaces that cover a smaller share of the annulus only touch it; a thousandth of what `zones` tells apart.
const TOUCH: f64 = 1e-9;

/// Faces, bores and a pre-hole on the way of a drill, all in one frame: Z up towards the spindle, the origin on the
/// tool axis, u of the entry along x.
///
/// ```
/// # use kinecut_plan as kinecut;
/// use kinecut::drilling::*;
/// use kinecut::tool::DrillPoint;
/// let edge = DrillPoint::SinglePlane { angle: 118f64.to_radians() }.edge(10.0)?;
/// let face = |height: f64| BoundarySurface::Plane { height, slope: 0.0 };
/// let mut way = DrillWay::new(face(0.0), Some(face(-60.0)));
/// way.bores.push(CrossBore { radius: 12.0, offset: 2.0, height: -30.0, turn: 0.0 });
/// let mut found = Vec::new();
/// zones(&way.passages(&edge)?, Travel { start: 2.0, end: -66.0 }, &Feeds::constant(0.2), &mut found);
/// let stages: Vec<&str> = found.iter().map(|z| z.stage.word()).collect();
/// assert_eq!(stages, ["entry", "steady", "exit", "air", "entry", "steady", "exit"]);
/// # Ok::<(), kinecut::base::Error>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct DrillWay {
    /// The face where the drill goes in.
    pub entry: BoundarySurface,
    /// The face where it comes out; none for a blind hole.
    pub exit: Option<BoundarySurface>,
    /// Angle of the exit's u from the entry's [rad]. It counts only with an eccentric pre-hole, or where bores and faces
    /// meet under the drill.
    pub exit_turn: f64,
    /// Bores that cross the way.
    pub bores: Vec<CrossBore>,
    /// A hole that is there before.
    pub pre_hole: Option<PreHole>,
}

impl DrillWay {
    /// A way between faces, nothing between them.
    pub fn new(entry: BoundarySurface, exit: Option<BoundarySurface>) -> DrillWay {
        DrillWay { entry, exit, exit_turn: 0.0, bores: Vec::new(), pre_hole: None }
    }

    /// The passages of an edge, the one met first at the front. Exact; along the rim of an eccentric pre-hole within
    /// 1e-9 mm, and where bores, faces and the bottom of a pre-hole run into one another within 1e-4 mm, never inside
    /// the true interval; a surface of which they leave a strip narrower than 5 um beside a bore's wall may have no passage.
    /// Shares are counted of what the edge cuts when all of it is in: without a through pre-hole the whole annulus, with one
    /// what the pre-hole leaves; where surfaces run into one another by 43 200 columns, so that less than one is not seen.
    ///
    /// # Errors
    /// `KC0901` when the pre-hole leaves nothing to cut or contradicts itself, `KC0902` when a face does not cover the
    /// drill or a bore is not valid.
    pub fn passages(&self, edge: &EdgeProfile) -> Result<Vec<Passage>> {
        if let Some(hole) = &self.pre_hole {
            hole.check(edge)?;
        }
        let pre_hole = self.pre_hole.as_ref().filter(|hole| hole.meets(edge));
        let (edge, pre_hole) = match pre_hole {
            // A concentric through hole leaves an annulus again.
            Some(hole) if hole.leaves_annulus() => {
                (edge.clipped(0.5 * hole.diameter, edge.outer_radius()).unwrap_or(*edge), None)
            }
            other => (*edge, other),
        };
        let body = WayBody {
            edge: &edge,
            entry: Laid { surface: self.entry, turn: 0.0 },
            exit: self.exit.map(|surface| Laid { surface, turn: self.exit_turn }),
            bores: &self.bores,
            pre_hole,
        };
        // Faces and bores are checked here, whatever follows.
        let plain = self.plain(&body)?;
        let mut passages = if apart(&body) {
            plain.into_iter().filter(|p| p.share > TOUCH).collect()
        } else {
            body.passages(&plain)
        };
        passages.sort_by(|a, b| {
            let (s, t) = (&a.transient, &b.transient);
            t.first.total_cmp(&s.first).then(t.last.total_cmp(&s.last)).then(a.side.cmp(&b.side))
        });
        Ok(passages)
    }

    /// The passages if nothing touches anything else, in the order of [`WayBody::sheets`].
    fn plain(&self, body: &WayBody<'_>) -> Result<Vec<Passage>> {
        let edge = body.edge;
        let disc = body.pre_hole.map(PreHole::disc);
        let bottom = body.pre_hole.and_then(|h| Some((h.bottom?, h.bottom_transient(edge))));
        let outside = area(edge, None, disc.as_ref());
        let whole = if bottom.is_some() { area(edge, None, None) } else { outside };
        let mut passages = Vec::new();
        // A concentric blind hole leaves an annulus above its bottom; `None` if it leaves nothing there.
        let clipped = match body.pre_hole {
            Some(h) if h.is_concentric() => edge.clipped(0.5 * h.diameter, edge.outer_radius()),
            _ => Some(*edge),
        };
        let hole_above = if body.pre_hole.is_some_and(PreHole::is_concentric) { None } else { disc.as_ref() };
        if let Some(above) = &clipped
            && let Some(transient) = transient_outside(above, &body.entry, Cover::Whole, hole_above)?
        {
            passages.push(Passage { transient, side: Side::Entry, share: outside / whole });
        }
        if let Some((_, Some(transient))) = bottom {
            passages.push(Passage { transient, side: Side::Entry, share: (whole - outside) / whole });
        }
        // Below the bottom of a blind hole all of the edge cuts.
        let under = |above_bottom: bool| match (&bottom, above_bottom) {
            (Some(_), false) => (Some(*edge), None),
            _ => (clipped, hole_above),
        };
        for bore in &self.bores {
            let above_bottom = bottom.is_some_and(|(b, _)| bore.height > b.height);
            let (edge, hole) = under(above_bottom);
            if let Some(edge) = edge
                && let Some(sheets) = bore.over(&edge, hole, whole)?
            {
                passages.extend(bore.merged(edge.outer_radius(), sheets));
            }
        }
        if let Some(exit) = &body.exit
            && let (Some(edge), hole) = under(false)
            && let Some(transient) = transient_outside(&edge, exit, Cover::Whole, hole)?
        {
            let share = if bottom.is_some() { 1.0 } else { outside / whole };
            passages.push(Passage { transient, side: Side::Exit, share });
        }
        Ok(passages)
    }
}
