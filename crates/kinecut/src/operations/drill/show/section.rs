//! The section of a hole through the tool axis, to scale: part, surfaces, the point at its four Z, lengths and
//! coordinates by the names of Belyakov and Seleznev 2023 (their figures 2 to 6). An overview with breaks where a long
//! hole has nothing to show, and a detail of the entry and of the exit.

use super::DrilledHole;
use super::contact::{ContactPoint, contacts};
use super::point::mm;
use super::scene::{DRAWN, MARGIN, Scene};
use crate::base::Result;
use crate::drilling::{BoundarySurface, Side, Transient};
use crate::page::{Along, Drawing, Look, fixed};

/// Room above and below, in radii.
const ROOM: f64 = 0.35;
/// A hole longer than this many radii is drawn with breaks.
const LONG: f64 = 13.0;
/// A stretch longer than this many radii with nothing to show is broken, and this much stays on either side.
const EMPTY: f64 = 2.6;
const STAYS: f64 = 0.9;

/// A turn of the exit with a smaller sine counts as zero.
const TURNED: f64 = 1e-9;

/// The drawings of a hole: overview, entry, and exit if it goes through.
///
/// # Errors
/// `KC0701` when the tool makes no point.
pub fn section_drawings(hole: &DrilledHole) -> Result<Vec<Drawing>> {
    let scene = Scene::new(hole)?;
    let mut drawings = vec![scene.overview(), scene.entry()];
    drawings.extend(scene.exit());
    Ok(drawings)
}

impl Scene<'_> {
    /// Words of a coordinate in both frames; names in the frame of entry and exit.
    fn both(&self, d: &mut Drawing, z: f64, names: [&str; 2]) {
        let mut lines = vec![coordinate("W_h", names[0], z)];
        if self.exit.is_some() {
            lines.push(coordinate("W_k", names[1], z + self.hole.spec.length));
        }
        d.level([0.0, z], lines);
    }

    fn overview(&self) -> Drawing {
        let plan = self.hole.plan;
        let (start, end) = (plan.travel.start, plan.travel.end);
        let (entry, r, top) = (plan.entry, self.radius, self.tool.extent()[1]);
        let mut heights = vec![start, start + top + MARGIN * r, entry.first, entry.last, end, end + top, 0.0];
        heights.extend([-r, 0.0, r].map(|u| self.entry.height(u)));
        if let Some((exit, t)) = &self.exit {
            heights.extend([t.first, t.last, -self.hole.spec.length]);
            heights.extend([-r, 0.0, r].map(|u| exit.height(u)));
        }
        for c in &self.hole.spec.bores {
            heights.extend([c.height - c.radius, c.height, c.height + c.radius]);
        }
        heights.sort_by(f64::total_cmp);
        let (low, high) = (heights[0] - ROOM * r, heights[heights.len() - 1] + ROOM * r);
        let mut d = self.part("Section through the tool axis", Side::Entry, low, high);
        if high - low > LONG * r {
            let gaps = heights.windows(2).filter(|w| w[1] - w[0] > EMPTY * r);
            d.breaks = gaps.map(|w| [w[0] + STAYS * r, w[1] - STAYS * r]).collect();
        }
        let far = DRAWN * r;
        d.line(Look::Axis, vec![[-far, 0.0], [far, 0.0]]);
        d.level([1.3 * r, 0.0], vec!["W_h zero".to_owned()]);
        d.span(Along::Left, [0.0, start], [0.0, entry.last], mm("L_vr", plan.lengths.entry));
        d.span(Along::Left, [0.0, start], [0.0, end], mm("L_rx", plan.lengths.stroke));
        d.span(Along::Left, [-r, 0.0], [0.0, entry.first], mm("L_nvr", plan.lengths.to_entry));
        self.both(&mut d, start, ["Z_nvr1", ""]);
        self.drill(&mut d, Look::First, "starts at feed (Z_nvr1)", start);
        self.both(&mut d, entry.last, ["Z_nvr2", ""]);
        self.drill(&mut d, Look::Second, "fully in (Z_nvr2)", entry.last);
        let below = self.exit.map_or(end, |(_, t)| t.first);
        d.span(Along::Left, [0.0, entry.last], [0.0, below], mm("L_ust", plan.lengths.steady));
        if let Some((_, t)) = self.exit {
            let wk = -self.hole.spec.length;
            d.line(Look::Axis, vec![[-far, wk], [far, wk]]);
            d.level([1.3 * r, wk], vec!["W_k zero".to_owned()]);
            d.span(Along::Left, [-r, 0.0], [-r, wk], mm("L", self.hole.spec.length));
            d.span(Along::Left, [0.0, t.first], [0.0, end], mm("L_vyh", t.first - end));
            d.span(
                Along::Left,
                [-r, wk],
                [0.0, t.first],
                mm("L_kvyh", plan.lengths.to_exit.unwrap_or(f64::NAN)),
            );
            self.both(&mut d, t.first, ["Z_nvyh1", "Z_kvyh1"]);
            self.drill(&mut d, Look::Third, "break-through begins (Z_kvyh1)", t.first);
            self.both(&mut d, end, ["Z_nvyh2", "Z_kvyh2"]);
            self.drill(&mut d, Look::Fourth, "out, with overrun (Z_kvyh2)", end);
        } else {
            self.both(&mut d, end, ["Z_end", ""]);
            self.drill(&mut d, Look::Third, "ends", end);
        }
        if !d.breaks.is_empty() {
            d.notes.push("To scale; where the hole is long a stretch is left out.".to_owned());
        }
        if self.hole.spec.passages.is_some() {
            let what = "The surfaces are those of a body: planes of the same length on the way stand for them; the \
                coordinates are the body\u{2019}s.";
            d.notes.push(what.to_owned());
        } else if self.exit.is_some() && self.hole.spec.exit_turn.sin().abs() > TURNED {
            d.notes.push(
                "The exit is turned against the entry; its own drawing lies across its cylinder.".to_owned(),
            );
        }
        d
    }

    fn window(&self, surface: &BoundarySurface, zs: &[f64]) -> [f64; 2] {
        let (r, most) = (self.radius, self.tool.extent()[1]);
        let heights = [-r, 0.0, r].map(|u| surface.height(u));
        let tips = zs.iter().flat_map(|z| [*z, z + most]);
        let all = || tips.clone().chain(heights);
        let low = all().fold(f64::INFINITY, |a, b| if b < a { b } else { a });
        let high = all().fold(f64::NEG_INFINITY, |a, b| if b > a { b } else { a });
        [low - ROOM * r, high + (ROOM + MARGIN) * r]
    }

    fn entry(&self) -> Drawing {
        let plan = self.hole.plan;
        let (start, t) = (plan.travel.start, plan.entry);
        let [low, high] = self.window(&self.entry, &[start, t.first, t.last]);
        let mut d = self.part("Entry", Side::Entry, low, high);
        self.drill(&mut d, Look::First, "starts at feed", start);
        self.drill(&mut d, Look::Hidden, "touches", t.first);
        self.drill(&mut d, Look::Second, "fully in", t.last);
        let inner = t.last + self.point();
        d.span(Along::Left, [0.0, start], [0.0, t.first], mm("L_pod", start - t.first));
        d.span(Along::Left, [0.0, t.first], [0.0, inner], mm("L_vr2", plan.lengths.entry_surface));
        d.span(Along::Left, [-self.radius, inner], [0.0, t.last], mm("L_vr1", self.point()));
        d.span(Along::Left, [0.0, start], [0.0, t.last], mm("L_vr", plan.lengths.entry));
        d.level([0.0, start], vec![format!("Z_nvr1 {}", fixed(start, 3))]);
        d.level([0.0, t.last], vec![format!("Z_nvr2 {}", fixed(t.last, 3))]);
        let [first, last] = match self.hole.spec.mouth {
            Some(_) => self.on_edge(&t),
            None => self.contacts(&self.entry, &t),
        };
        self.contact(&mut d, &first, ["touches first:", "first contact"], t.first, Side::Entry);
        self.contact(&mut d, &last, ["last to go in:", "last point"], t.last, Side::Entry);
        self.advise(&mut d);
        d
    }

    fn exit(&self) -> Option<Drawing> {
        let plan = self.hole.plan;
        let (surface, t) = self.exit?;
        let end = plan.travel.end;
        let [low, high] = self.window(&surface, &[end, t.first, t.last]);
        let mut d = self.part("Exit", Side::Exit, low, high);
        self.drill(&mut d, Look::Third, "break-through begins", t.first);
        self.drill(&mut d, Look::Hidden, "the last of it is out", t.last);
        self.drill(&mut d, Look::Fourth, "ends, with overrun", end);
        let outer = t.last + self.point();
        let extra = plan.lengths.exit_surface.unwrap_or(f64::NAN);
        d.span(Along::Left, [0.0, t.first], [0.0, outer], mm("L_vyh2", extra));
        d.span(Along::Left, [-self.radius, outer], [0.0, t.last], mm("L_vyh1", self.point()));
        d.span(Along::Left, [0.0, t.last], [0.0, end], mm("L_per", t.last - end));
        d.span(Along::Left, [0.0, t.first], [0.0, end], mm("L_vyh", t.first - end));
        let own = self.hole.spec.length;
        d.level([0.0, t.first], vec![format!("Z_kvyh1 {}", fixed(t.first + own, 3))]);
        d.level([0.0, end], vec![format!("Z_kvyh2 {}", fixed(end + own, 3))]);
        let [first, last] = match self.hole.spec.ceiling {
            Some(_) => self.on_edge(&t),
            None => self.contacts(&surface, &t),
        };
        self.contact(&mut d, &first, ["out first:", "first break-through"], t.first, Side::Exit);
        self.contact(&mut d, &last, ["last to go out:", "last point"], t.last, Side::Exit);
        d.notes.push("Coordinates in the frame of the exit, W_k.".to_owned());
        Some(d)
    }

    /// The points of first and last contact. Of a body only radius and height are known.
    fn contacts(&self, surface: &BoundarySurface, t: &Transient) -> [ContactPoint; 2] {
        if self.hole.spec.passages.is_none() {
            return contacts(surface, t);
        }
        self.on_edge(t)
    }

    /// These points where the edge then is.
    fn on_edge(&self, t: &Transient) -> [ContactPoint; 2] {
        let edge = &self.hole.plan.edge;
        [(t.first, t.first_radius), (t.last, t.last_radius)].map(|(z, radius)| {
            let at = [radius, z + edge.height(radius).unwrap_or(0.0)];
            ContactPoint { at, radius, beside: 0.0 }
        })
    }

    fn contact(&self, d: &mut Drawing, c: &ContactPoint, names: [&str; 2], z: f64, side: Side) {
        let place = format!("{}, r {}", c.place(self.radius), fixed(c.radius, 3));
        let z = if side == Side::Exit { z + self.hole.spec.length } else { z };
        d.point(c.at, vec![names[0].to_owned(), place, format!("at Z {}", fixed(z, 3))]);
        d.notes.extend(c.remark(names[1], side));
    }

    fn advise(&self, d: &mut Drawing) {
        let tolerance = self.hole.spec.tolerance;
        if tolerance > 0.0 {
            d.notes.push(format!(
                "Z of contact is moved by the tolerance of the surfaces, {} mm; the points are drawn on the surface.",
                fixed(tolerance, 3)
            ));
        }
    }
}

fn coordinate(frame: &str, name: &str, z: f64) -> String {
    let space = if name.is_empty() { "" } else { " " };
    format!("{frame}: {name}{space}{}", fixed(z, 3))
}
