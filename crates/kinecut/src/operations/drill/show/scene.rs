//! The part and the hole in it in the section through the tool axis: what all drawings of a hole begin with.

use super::DrilledHole;
use super::outline::{Core, half, silhouette};
use crate::base::Result;
use crate::drilling::{BoundarySurface, CrossBore, Side, Transient};
use crate::geom::EdgeProfile;
use crate::page::{Drawing, Look, Stroke};
use crate::tool::DrillPoint;

/// Distance from the tool axis to which the part is drawn, in radii of the hole; the page may show less of it.
pub(super) const DRAWN: f64 = 8.0;
/// Least that is shown, in radii.
const SHOWN: f64 = 1.5;
/// Pieces in which a surface is drawn on each side of the hole, and within it.
const PIECES: u32 = 160;
/// Distance that is rounding [mm].
const ROUNDING: f64 = 1e-9;
/// Height of the margins drawn above a point, in radii.
pub(super) const MARGIN: f64 = 0.3;

/// Data of a drawing of a hole.
pub(super) struct Scene<'a> {
    pub(super) hole: &'a DrilledHole<'a>,
    /// The whole edge of the tool, also what does not cut.
    pub(super) tool: EdgeProfile,
    pub(super) radius: f64,
    pub(super) entry: BoundarySurface,
    pub(super) exit: Option<(BoundarySurface, Transient)>,
}

impl<'a> Scene<'a> {
    pub(super) fn new(hole: &'a DrilledHole<'a>) -> Result<Scene<'a>> {
        let exit = hole.spec.end.exit().copied().zip(hole.plan.exit);
        Ok(Scene {
            hole,
            tool: hole.spec.point.edge(hole.spec.diameter)?,
            radius: hole.plan.edge.outer_radius(),
            entry: hole.spec.entry,
            exit,
        })
    }

    /// Height of the point that cuts.
    pub(super) fn point(&self) -> f64 {
        self.hole.plan.lengths.point
    }

    /// Heights of the point's lowest and highest cutting points above the reference point.
    pub(super) fn extent(&self) -> [f64; 2] {
        self.hole.plan.edge.extent()
    }

    /// A surface at distances from the axis, in a section whose direction and the surface's u have this cosine.
    fn run(surface: &BoundarySurface, cos: f64, from: f64, to: f64) -> Vec<[f64; 2]> {
        let mut points: Vec<[f64; 2]> = (0..=PIECES)
            .map(|i| from + (to - from) * f64::from(i) / f64::from(PIECES))
            .map(|u| [u, surface.height(cos * u)])
            .collect();
        // The run has a corner where a cylinder's side is upright.
        if let BoundarySurface::Ridge { radius, offset, .. }
        | BoundarySurface::Valley { radius, offset, .. } = *surface
        {
            let corners = [-radius - offset, radius - offset].map(|u| u / cos);
            let corners = corners.into_iter().filter(|u| *u > from && *u < to);
            points.extend(corners.map(|u| [u, surface.height(cos * u)]));
            points.sort_by(|a, b| a[0].total_cmp(&b[0]));
        }
        points
    }

    /// The face that the drill enters, with the recess at the hole's mouth.
    fn face(&self, cos: f64, from: f64, to: f64) -> Vec<[f64; 2]> {
        let face = Scene::run(&self.entry, cos, from, to);
        match &self.hole.spec.mouth {
            Some(mouth) => recessed(face, &mouth.edge, [mouth.height, 1.0], |u| self.entry.height(cos * u)),
            None => face,
        }
    }

    /// The face that the drill leaves, with the hole from the other side into which it comes out.
    fn foot(&self, exit: &BoundarySurface, cos: f64, from: f64, to: f64) -> Vec<[f64; 2]> {
        let face = Scene::run(exit, cos, from, to);
        match &self.hole.spec.ceiling {
            Some(c) => recessed(face, &c.edge, [c.height, -1.0], |u| exit.height(cos * u)),
            None => face,
        }
    }

    /// The drawing of the part and the hole in it, nothing named yet, in the section along the u of a side.
    pub(super) fn part(&self, title: &str, along: Side, low: f64, high: f64) -> Drawing {
        let turned = self.hole.spec.exit_turn.cos();
        let (ce, cx) = if along == Side::Entry { (1.0, turned) } else { (turned, 1.0) };
        let (r, far) = (self.radius, DRAWN * self.radius);
        let shown = SHOWN * r;
        let mut d = Drawing::new(title, [[-shown, low], [shown, high]]);
        let floor = low - r;
        let foot = |from: f64, to: f64| match &self.exit {
            Some((exit, _)) => self.foot(exit, cx, from, to),
            None => vec![[from, floor], [to, floor]],
        };
        for [from, to] in [[-far, -r], [r, far]] {
            let mut outline = self.face(ce, from, to);
            outline.extend(foot(from, to).into_iter().rev());
            d.hatched.push(outline);
            d.line(Look::Edge, self.face(ce, from, to));
            if self.exit.is_some() {
                d.line(Look::Edge, foot(from, to));
            }
        }
        d.line(Look::Hidden, self.face(ce, -r, r));
        let end = self.hole.plan.travel.end;
        let corner = |sign: f64| match &self.exit {
            // At the rim of a hole from the other side that is as wide, its floor counts.
            Some((exit, _)) => {
                let at_wall = self.foot(exit, cx, -r, r).into_iter().filter(|p| p[0] == sign * r);
                at_wall.map(|p| p[1]).max_by(f64::total_cmp).unwrap_or_else(|| exit.height(cx * sign * r))
            }
            None => end + self.extent()[1],
        };
        for sign in [-1.0, 1.0] {
            let top = self.face(ce, sign * r, sign * r);
            let top = top.first().map_or_else(|| self.entry.height(ce * sign * r), |p| p[1]);
            d.line(Look::Edge, vec![[sign * r, top], [sign * r, corner(sign)]]);
        }
        match &self.exit {
            Some((exit, _)) => d.line(Look::Hidden, self.foot(exit, cx, -r, r)),
            None => {
                // The bottom of a blind hole, and the material under it: on both sides of a hole that is there, of a core,
                // or all across.
                let right: Vec<[f64; 2]> =
                    half(&self.hole.plan.edge).iter().map(|p| [p[0], end + p[1]]).collect();
                let left: Vec<[f64; 2]> = right.iter().rev().map(|p| [-p[0], p[1]]).collect();
                let inner = self.hole.plan.edge.inner_radius();
                if self.hole.spec.pre_hole.is_some()
                    || matches!(self.hole.spec.point, DrillPoint::Annular { .. })
                {
                    for (mut side, sign) in [(left, -1.0), (right, 1.0)] {
                        d.line(Look::Edge, side.clone());
                        let ends = [[sign * r, floor], [sign * inner, floor]];
                        if sign > 0.0 {
                            side.extend(ends)
                        } else {
                            side.extend([ends[1], ends[0]])
                        }
                        d.hatched.push(side);
                    }
                    if self.hole.spec.pre_hole.is_none() {
                        let mut core = Scene::run(&self.entry, ce, -inner, inner);
                        d.line(Look::Edge, core.clone());
                        core.extend([[inner, floor], [-inner, floor]]);
                        d.hatched.push(core);
                        for x in [-inner, inner] {
                            d.line(Look::Edge, vec![[x, self.entry.height(x)], [x, end]]);
                        }
                    }
                } else {
                    let mut bottom: Vec<[f64; 2]> = left.into_iter().chain(right).collect();
                    d.line(Look::Edge, bottom.clone());
                    bottom.extend([[r, floor], [-r, floor]]);
                    d.hatched.push(bottom);
                }
            }
        }
        if let Some(pre) = &self.hole.spec.pre_hole {
            let through = self.exit.as_ref().map_or(floor, |(exit, _)| exit.height(0.0));
            let foot = pre.bottom.map_or(through, |b| b.height);
            // Half as wide as the section cuts it.
            let half = (pre.diameter / 2.0 - pre.at[1]) * (pre.diameter / 2.0 + pre.at[1]);
            if half > 0.0 {
                for x in [pre.at[0] - half.sqrt(), pre.at[0] + half.sqrt()] {
                    d.line(Look::Hidden, vec![[x, self.entry.height(ce * x)], [x, foot]]);
                }
            }
        }
        for bore in &self.hole.spec.bores {
            if let Some(outline) = across(bore, far) {
                // Cut out of the part on both sides of the hole.
                for sign in [-1.0, 1.0] {
                    let beside = |p: &[f64; 2]| [if p[0] * sign > r { p[0] } else { sign * r }, p[1]];
                    d.hatched.push(outline.iter().map(beside).collect());
                }
                d.line(Look::Edge, outline);
            }
        }
        d.line(Look::Axis, vec![[0.0, high], [0.0, low]]);
        d
    }

    pub(super) fn drill(&self, d: &mut Drawing, look: Look, name: &str, z: f64) {
        let up = z + self.tool.extent()[1] + MARGIN * self.radius;
        let points = silhouette(&self.tool, Core::of(&self.hole.spec.point), z, up);
        d.strokes.push(Stroke { look, name: name.to_owned(), points });
    }
}

/// The run of a face with a recess about the axis that an edge has made: its height where the edge has the height 0, and 1 or -1
/// as it is open upwards or downwards.
fn recessed(
    run: Vec<[f64; 2]>,
    edge: &EdgeProfile,
    [height, sense]: [f64; 2],
    face: impl Fn(f64) -> f64,
) -> Vec<[f64; 2]> {
    let (Some(from), Some(to)) = (run.first().map(|p| p[0]), run.last().map(|p| p[0])) else {
        return run;
    };
    let rim = edge.outer_radius();
    let floor = |u: f64| Some([u, height + sense * edge.height(u.abs())?]);
    let shown = |u: f64| u >= from - ROUNDING && u <= to + ROUNDING;
    let side = half(edge);
    let both = side.iter().rev().map(|p| [-p[0], p[1]]).chain(side.iter().copied());
    let mut points: Vec<[f64; 2]> = run.iter().copied().filter(|p| p[0] < -rim).collect();
    points.extend([-rim].into_iter().filter(|u| shown(*u)).map(|u| [u, face(u)]));
    points.extend([from].into_iter().filter(|u| u.abs() < rim).filter_map(floor));
    points.extend(both.filter(|p| shown(p[0])).map(|p| [p[0], height + sense * p[1]]));
    points.extend([to].into_iter().filter(|u| u.abs() < rim).filter_map(floor));
    points.extend([rim].into_iter().filter(|u| shown(*u)).map(|u| [u, face(u)]));
    points.extend(run.into_iter().filter(|p| p[0] > rim));
    points.dedup();
    points
}

/// A bore in the section along the hole's x axis: a circle or an ellipse, or the strip between two lines where its axis
/// lies in the section; nothing where it passes beside it.
fn across(bore: &CrossBore, far: f64) -> Option<Vec<[f64; 2]>> {
    /// Below this the bore runs along the section: its ellipse would be longer than anything drawn.
    const ALONG: f64 = 1e-3;
    let cos = bore.turn.cos();
    if cos.abs() < ALONG {
        let half = (bore.radius - bore.offset) * (bore.radius + bore.offset);
        let (low, high) = (bore.height - half.max(0.0).sqrt(), bore.height + half.max(0.0).sqrt());
        return (half > 0.0).then(|| vec![[-far, low], [far, low], [far, high], [-far, high], [-far, low]]);
    }
    let turn = |i: u32| std::f64::consts::TAU * f64::from(i) / f64::from(PIECES);
    let at = |t: f64| [(bore.radius * t.cos() - bore.offset) / cos, bore.height + bore.radius * t.sin()];
    Some((0..=PIECES).map(|i| at(turn(i))).collect())
}
