//! The sheets of a mesh under a drill: connected patches of equally oriented triangles within the annulus.
//!
//! Two triangles are connected when the side between them meets the annulus. Triangles nearly parallel to the feed are
//! walls: they belong to no sheet, and the little that they cover counts to the neighbouring sheet, so that the shares
//! of all entries still add up.

use glam::{DVec2, DVec3};

use super::super::transient::Search;
use super::super::{Passage, Side};
use super::facet::{Facet, Touch};
use super::share::common_area;
use crate::geom::EdgeProfile;
use crate::num::sets::Sets;

/// Cosine between the normal of a triangle and the feed below which it is a wall: 0.0006 degrees, about the rounding of
/// an upright wall in a mesh of single precision. A wall of 100 mm leans by 1 µm.
const WALL: f64 = 1e-5;
/// Least area of a triangle in the annulus, as a share of the squared radius: the rounding of its closed form.
const LEAST_AREA: f64 = 1e-15;
/// Sheets that cover a smaller share of the annulus only touch it; a thousandth of what `zones` tells apart.
const TOUCH: f64 = 1e-9;

/// The triangles under one drill.
pub(super) struct Sheets<'a> {
    edge: &'a EdgeProfile,
    pieces: Vec<SheetPiece>,
    /// Sides that meet the annulus: their ends, the lesser first, and the piece.
    sides: Vec<(u64, u32)>,
}

struct SheetPiece {
    facet: Facet,
    area: f64,
    side: Side,
    wall: bool,
}

impl<'a> Sheets<'a> {
    pub(super) fn new(edge: &'a EdgeProfile) -> Sheets<'a> {
        Sheets { edge, pieces: Vec::new(), sides: Vec::new() }
    }

    /// Adds a triangle by the names of its corners and their places: across the axis, and the height along it.
    pub(super) fn add(&mut self, names: [u32; 3], places: [DVec3; 3]) {
        let (inner, outer) = (self.edge.inner_radius(), self.edge.outer_radius());
        let mut corners = places.map(DVec3::truncate);
        let beyond = |k: usize| {
            let c = corners.map(|p| p[k]);
            c.iter().all(|v| *v >= outer) || c.iter().all(|v| *v <= -outer)
        };
        if beyond(0) || beyond(1) {
            return;
        }
        let normal = (places[1] - places[0]).cross(places[2] - places[0]);
        let length = normal.length();
        let mut heights = places.map(|p| p.z);
        let side = if normal.z > 0.0 { Side::Entry } else { Side::Exit };
        if side == Side::Exit {
            corners.swap(1, 2);
            heights.swap(1, 2);
        }
        let area =
            common_area(&corners, outer) - if inner > 0.0 { common_area(&corners, inner) } else { 0.0 };
        if !(area > LEAST_AREA * outer * outer) {
            return;
        }
        let n = self.pieces.len() as u32;
        for i in 0..3 {
            let (a, b) = (names[i], names[(i + 1) % 3]);
            if meets(places[i].truncate(), places[(i + 1) % 3].truncate(), inner, outer) {
                let (low, high) = if a < b { (a, b) } else { (b, a) };
                self.sides.push((u64::from(low) << 32 | u64::from(high), n));
            }
        }
        let wall = normal.z.abs() <= WALL * length;
        self.pieces.push(SheetPiece { facet: Facet::new(corners, heights), area, side, wall });
    }

    /// The sheets, from the one met first, and the first touch of an entry.
    pub(super) fn passages(mut self) -> (Vec<Passage>, Option<Touch>) {
        let mut group = Sets::new(self.pieces.len());
        let mut beside: Vec<(u32, u32)> = Vec::new();
        self.sides.sort_unstable();
        for pair in self.sides.windows(2) {
            let [(a, p), (b, q)] = [pair[0], pair[1]];
            let (one, other) = (&self.pieces[p as usize], &self.pieces[q as usize]);
            if a != b || one.side != other.side {
                continue;
            }
            match (one.wall, other.wall) {
                (false, false) => {
                    group.join(p, q);
                }
                (true, false) => beside.push((p, q)),
                (false, true) => beside.push((q, p)),
                (true, true) => {}
            }
        }
        beside.sort_unstable();
        beside.dedup_by_key(|b| b.0);

        let (inner, outer) = (self.edge.inner_radius(), self.edge.outer_radius());
        let whole = std::f64::consts::PI * (outer - inner) * (outer + inner);
        let mut place = vec![usize::MAX; self.pieces.len()];
        let mut sheets: Vec<(Search, Passage)> = Vec::new();
        let mut touch: Option<Touch> = None;
        for (n, piece) in self.pieces.iter().enumerate().filter(|(_, p)| !p.wall) {
            let r = group.least(n as u32) as usize;
            if place[r] == usize::MAX {
                place[r] = sheets.len();
                let search = Search::new();
                let transient = search.found;
                sheets.push((search, Passage { transient, side: piece.side, share: 0.0 }));
            }
            let (search, passage) = &mut sheets[place[r]];
            passage.share += piece.area / whole;
            piece.facet.candidates(self.edge, |t| {
                search.note(t.z, t.z, t.radius);
                if piece.side == Side::Entry && touch.is_none_or(|first| t.z > first.z) {
                    touch = Some(t);
                }
            });
        }
        for (wall, other) in beside {
            let r = group.least(other) as usize;
            if let Some((_, passage)) = sheets.get_mut(place[r]) {
                passage.share += self.pieces[wall as usize].area / whole;
            }
        }
        let mut passages: Vec<Passage> = sheets
            .into_iter()
            .map(|(search, passage)| Passage { transient: search.found, ..passage })
            .filter(|p| p.share > TOUCH && p.transient.first.is_finite() && p.transient.last.is_finite())
            .collect();
        passages.sort_by(|a, b| {
            let (s, t) = (&a.transient, &b.transient);
            t.first.total_cmp(&s.first).then(t.last.total_cmp(&s.last)).then(a.side.cmp(&b.side))
        });
        (passages, touch)
    }
}

/// True if a side meets the open annulus about the origin; radii in mm.
fn meets(a: DVec2, b: DVec2, inner: f64, outer: f64) -> bool {
    let along = b - a;
    let squared = along.length_squared();
    let t = if squared > 0.0 { (-a.dot(along) / squared).clamp(0.0, 1.0) } else { 0.0 };
    let far = if a.length_squared() > b.length_squared() { a } else { b };
    (a + along * t).length() < outer && far.length() > inner
}
