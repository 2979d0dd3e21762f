//! Moves under compensation of the control, from the path of the cutter's centre on to the contour itself: for a register that holds the
//! cutter's radius.
//!
//! Each move becomes its parallel on the wall. An arc about an outside corner becomes the corner, which the control goes round by
//! itself; where the path turns inside, the parallels are brought to their intersection.

use std::f64::consts::TAU;

use glam::{DVec2, DVec3};

use crate::base::{Code, Finding, Result};
use crate::geom::{Arc, CurveKind, Line};
use crate::holes::PlannedMove;

/// Distance of two ends that is rounding of an offset [mm].
const ROUNDING: f64 = 1e-6;
/// Farthest corner from the ends that meet in it, in radii of the cutter: one of 8 degrees.
const FARTHEST: f64 = 15.0;

/// Puts moves on to the wall: the entry by its end, those under compensation whole, the exit by its start. `right`: distance of
/// the wall to the right of the path [mm], negative to the left.
///
/// # Errors
/// `KC0404` where the contour has no corner in which the cutter could turn as its path does, and where the height changes about an
/// outside corner.
pub(super) fn onto_wall(moves: &mut Vec<PlannedMove>, right: f64) -> Result<()> {
    let Some((entry, path)) = moves.split_first() else { return Ok(()) };
    let exit = path.iter().position(|m| !m.comp).unwrap_or(path.len());
    let mut on_wall: Vec<(PlannedMove, Flat)> = Vec::with_capacity(path.len());
    let mut corner: Option<DVec2> = None;
    let mut first: Option<DVec2> = None;
    for m in &path[..exit] {
        let Some(flat) = Flat::of(m, right)? else {
            // An outside corner: no move is left of it.
            let (from, to) = (m.curve.start(), m.curve.end());
            let CurveKind::Arc(arc) = m.curve.kind() else { continue };
            let at = arc.centre.truncate();
            if (to.z - from.z).abs() > ROUNDING {
                return Err(refused(at, "the way up or down beside a tab goes about an outside corner"));
            }
            if let Some((_, last)) = on_wall.last_mut() {
                last.end_in(at)?;
            }
            if corner.is_some_and(|other| other.distance(at) > ROUNDING) {
                return Err(refused(at, "the cutter touches two corners at once"));
            }
            first.get_or_insert(at);
            corner = Some(at);
            continue;
        };
        let mut flat = flat;
        match (corner.take(), on_wall.last_mut()) {
            (Some(at), _) => flat.begin_in(at)?,
            (None, Some((_, last))) => join(last, &mut flat, right.abs())?,
            (None, None) => {}
        }
        first.get_or_insert(flat.start);
        on_wall.push((m.clone(), flat));
    }
    let Some(begin) = first else { return Ok(()) };
    let from = entry.curve.start();
    let mut here = begin.extend(entry.curve.end().z);
    let mut all = vec![PlannedMove { curve: Line { start: from, end: here }.into(), ..entry.clone() }];
    for (m, flat) in on_wall {
        let rise = m.curve.end().z - m.curve.start().z;
        let curve = flat.lifted(here, rise)?;
        here = curve.end();
        all.push(PlannedMove { curve, ..m });
    }
    if let Some(exit) = path.get(exit) {
        let end = exit.curve.end();
        all.push(PlannedMove { curve: Line { start: here, end }.into(), ..exit.clone() });
    }
    all.extend(path.iter().skip(exit + 1).cloned());
    *moves = all;
    Ok(())
}

/// A move in the plane.
#[derive(Clone, Copy, Debug)]
struct Flat {
    start: DVec2,
    end: DVec2,
    /// Centre, and whether it turns counter-clockwise.
    about: Option<(DVec2, bool)>,
}

impl Flat {
    /// The parallel of a move; `None` where that is a point.
    fn of(m: &PlannedMove, right: f64) -> Result<Option<Flat>> {
        let (p, q) = (m.curve.start().truncate(), m.curve.end().truncate());
        match m.curve.kind() {
            CurveKind::Line(_) => {
                let Some(along) = (q - p).try_normalize() else {
                    return Err(refused(p, "the height changes on the spot"));
                };
                let aside = -along.perp() * right;
                Ok(Some(Flat { start: p + aside, end: q + aside, about: None }))
            }
            CurveKind::Arc(arc) => {
                let centre = arc.centre.truncate();
                let turns_left = arc.sweep * arc.axis.z > 0.0;
                let radius = p.distance(centre);
                let on_wall = if turns_left { radius + right } else { radius - right };
                if on_wall.abs() <= ROUNDING {
                    return Ok(None);
                }
                let at = |p: DVec2| centre + (p - centre) * (on_wall / radius);
                Ok(Some(Flat { start: at(p), end: at(q), about: Some((centre, turns_left)) }))
            }
            _ => Err(refused(p, "a move is no line and no arc")),
        }
    }

    /// Ends in a corner that lies where it ends.
    fn end_in(&mut self, corner: DVec2) -> Result<()> {
        if self.end.distance(corner) > ROUNDING {
            return Err(refused(corner, "the cutter touches a corner and another wall at once"));
        }
        self.end = corner;
        Ok(())
    }

    /// Begins in a corner that lies where it begins.
    fn begin_in(&mut self, corner: DVec2) -> Result<()> {
        if self.start.distance(corner) > ROUNDING {
            return Err(refused(corner, "the cutter touches a corner and another wall at once"));
        }
        self.start = corner;
        Ok(())
    }

    /// The move in space from a place, rising [mm].
    fn lifted(&self, start: DVec3, rise: f64) -> Result<crate::geom::Curve> {
        let Some((centre, turns_left)) = self.about else {
            return Ok(Line { start, end: self.end.extend(start.z + rise) }.into());
        };
        let angle = (start.truncate() - centre).angle_to(self.end - centre);
        // A whole turn is no turn of nothing.
        let sweep = match turns_left {
            true => {
                if angle > 0.0 {
                    angle
                } else {
                    angle + TAU
                }
            }
            false => {
                if angle < 0.0 {
                    angle
                } else {
                    angle - TAU
                }
            }
        };
        Ok(Arc::new(start, centre.extend(start.z), DVec3::Z, sweep, rise)?.into())
    }
}

/// Brings two moves to the corner of the wall between them.
fn join(before: &mut Flat, after: &mut Flat, radius: f64) -> Result<()> {
    let gap = before.end.distance(after.start);
    let at = match gap <= ROUNDING {
        true => before.end,
        false => {
            let middle = 0.5 * (before.end + after.start);
            let found = crossings(before, after)
                .into_iter()
                .min_by(|a, b| a.distance(middle).total_cmp(&b.distance(middle)));
            found
                .filter(|p| p.distance(middle) <= FARTHEST * radius)
                .ok_or_else(|| refused(middle, "the walls on both sides of a turn of the path do not meet"))?
        }
    };
    (before.end, after.start) = (at, at);
    Ok(())
}

/// Meetings of the lines or circles of two moves.
fn crossings(a: &Flat, b: &Flat) -> Vec<DVec2> {
    match (a.about, b.about) {
        (None, None) => {
            let (u, v) = (a.end - a.start, b.end - b.start);
            let det = u.perp_dot(v);
            let share = (b.start - a.start).perp_dot(v) / det;
            if share.is_finite() { vec![a.start + share * u] } else { Vec::new() }
        }
        (None, Some((centre, _))) => line_circle(a, centre, b.start.distance(centre)),
        (Some((centre, _)), None) => line_circle(b, centre, a.start.distance(centre)),
        (Some((c, _)), Some((d, _))) => {
            let (r, s, apart) = (a.start.distance(c), b.start.distance(d), c.distance(d));
            let along = (apart * apart + r * r - s * s) / (2.0 * apart);
            let height = (r * r - along * along).sqrt();
            let Some(u) = (d - c).try_normalize() else { return Vec::new() };
            if !height.is_finite() {
                return Vec::new();
            }
            [height, -height].map(|h| c + along * u + h * u.perp()).to_vec()
        }
    }
}

fn line_circle(line: &Flat, centre: DVec2, radius: f64) -> Vec<DVec2> {
    let Some(u) = (line.end - line.start).try_normalize() else { return Vec::new() };
    let foot = line.start + u * (centre - line.start).dot(u);
    let half = (radius * radius - foot.distance_squared(centre)).sqrt();
    if half.is_finite() { vec![foot + half * u, foot - half * u] } else { Vec::new() }
}

fn refused(at: DVec2, what: &str) -> crate::base::Error {
    let message = format!("the contour itself cannot be posted: {what} at ({:.3}, {:.3})", at.x, at.y);
    Finding::error(Code::PLAN_VALUE, message)
        .point([at.x, at.y, 0.0])
        .help("write compensation = \"wear\": the path of the cutter's centre goes there")
        .key("finish.compensation")
        .into()
}
