//! Cutter compensation by the control: from the programmed contour to the path of the tool's centre.
//!
//! For the trace. A run of compensated moves begins with its entry (see [`entry`]) and ends with the first, straight move
//! without compensation. In between each move is replaced by its parallel, exactly; see [`corner`] for the joints.
//! Moves across the plane run at the present place of the tool. The plane is XY of the frame of the moves (`G17`).
//!
//! Checked against the interpreter of LinuxCNC 2.9 (`tests`). Where directions differ by less than [`corner::SMALL`]
//! LinuxCNC and others each have their own way to close the joint; here the parallels are brought to their
//! intersection, which differs by less than a thousandth of the compensation.

mod corner;
mod entry;
mod flat;
mod spiral;
#[cfg(test)]
mod tests;

use glam::{DVec2, DVec3};

use crate::base::{Code, Finding, Result};
use crate::geom::{Arc, Curve, CurveKind, Line, PlaneCurve};
use corner::{Corner, corner};
use flat::{Flat, Shape};

/// End of the entry of a compensation. An entry in the direction in which the contour goes on ends at the same place by
/// either rule, so that is how entries should be planned.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum CompStart {
    /// Square to the start of the contour's first element (SINUMERIK `NORM`, FANUC type A).
    #[default]
    AtNext,
    /// Square to the end of the entry itself; the joint to the next element is one like any other (LinuxCNC).
    AtEntry,
}

/// A programmed move and its item.
#[derive(Clone, Debug)]
pub(super) struct Programmed {
    pub(super) item: usize,
    pub(super) curve: Curve,
}

/// Distance of two ends that is rounding [mm]: no step is made for it.
const CLOSED: f64 = 1e-9;

/// An error of compensation about an item.
pub(super) fn refused(item: usize, message: impl Into<String>) -> Finding {
    Finding::error(Code::COMPENSATION, message).item(item as u32)
}

/// The path of the tool's centre at `d` to the left of `contour` [mm] (negative: to the right), whose first move is
/// the entry, and after it along `exit`. Each curve comes with the item it belongs to; the arc round a corner belongs
/// to the move after it. With `d` zero they are the programmed curves.
///
/// # Errors
/// `KC0205` for an exit that is not straight in the plane, an entry that is neither that nor an arc where the control takes
/// one, or not longer than the compensation, a move in another plane, and a contour that the tool cannot follow without
/// cutting into it.
pub(super) fn compensate(
    contour: &[Programmed],
    exit: Option<&Programmed>,
    d: f64,
    start: CompStart,
) -> Result<Vec<Programmed>> {
    let Some(entry) = contour.first() else { return Ok(exit.into_iter().cloned().collect()) };
    entry::check(entry, d, start)?;
    if let Some(exit) = exit {
        entry::straight(exit, "the end of a compensation")?;
    }
    in_plane(contour)?;
    if d == 0.0 {
        return Ok(contour.iter().chain(exit).cloned().collect());
    }
    let contour = &without_spirals(contour)[..];
    let mut planar = Vec::with_capacity(contour.len());
    for (index, programmed) in contour.iter().enumerate() {
        if let Shape::Flat(flat) = Flat::of(&programmed.curve) {
            planar.push(Planar { index, item: programmed.item, flat, path: flat, cuts: [0.0; 2] });
        }
    }
    for element in &mut planar {
        element.path = element.flat.offset(d).ok_or_else(|| {
            refused(element.item, "gouging: the radius of a hollow curve is not larger than the compensation")
                .value_mm(element.flat.inner_radius(d))
                .bound_mm(d.abs())
                .help("use a smaller radius register or tool, or a larger radius")
        })?;
    }
    if let Some(first @ Planar { index: 0, flat: Flat::Arc { .. }, .. }) = planar.first_mut() {
        first.path = entry::arc(first.item, &first.flat, &first.path)?;
    }
    let rounds = join(&mut planar, d, start)?;
    let mut path = Path { curves: Vec::new(), here: entry.curve.start() };
    let mut next = planar.iter().zip(&rounds).peekable();
    for (index, programmed) in contour.iter().enumerate() {
        let rise = programmed.curve.end().z - programmed.curve.start().z;
        let Some((element, round)) = next.next_if(|(e, _)| e.index == index) else {
            path.to(programmed.item, path.here + DVec3::Z * rise);
            continue;
        };
        if index == 0 && !matches!(element.flat, Flat::Arc { .. }) {
            let end = element.path.at(element.path.length() - element.cuts[1]).0;
            path.to(programmed.item, end.extend(path.here.z + rise));
            continue;
        }
        if let Some(sweep) = *round {
            path.around(programmed.item, element.flat.at(0.0).0, sweep);
        }
        let length = element.path.length();
        let part = element.path.part(element.cuts[0], length - element.cuts[1]);
        let part = part.ok_or_else(|| no_room(element, d))?;
        path.to(programmed.item, part.at(0.0).0.extend(path.here.z));
        path.along(programmed.item, &part, rise);
    }
    if let Some(exit) = exit {
        path.to(exit.item, exit.curve.end());
    }
    Ok(path.curves)
}

/// Refuses moves in another plane.
fn in_plane(contour: &[Programmed]) -> Result<()> {
    match contour.iter().find(|p| Flat::of(&p.curve) == Shape::OtherPlane) {
        Some(other) => {
            Err(refused(other.item, "a compensated curve does not lie in the plane of compensation")
                .help("switch the compensation off before it")
                .into())
        }
        None => Ok(()),
    }
}

/// The contour with its spirals and cubics as arcs.
fn without_spirals(contour: &[Programmed]) -> Vec<Programmed> {
    let mut moves = Vec::with_capacity(contour.len());
    for programmed in contour {
        let turn = match programmed.curve.kind() {
            CurveKind::Spiral { spiral, .. } => Some(PlaneCurve::from(spiral).turn()),
            CurveKind::Bezier { span, .. } => Some(span.turn()),
            _ => None,
        };
        match turn {
            Some(turn) if Flat::of(&programmed.curve) == Shape::Spiral => {
                let arcs = spiral::arcs(&programmed.curve, turn);
                moves.extend(arcs.into_iter().map(|curve| Programmed { curve, ..*programmed }));
            }
            _ => moves.push(programmed.clone()),
        }
    }
    moves
}

/// An element of the contour in the plane.
struct Planar {
    /// Number in the contour.
    index: usize,
    item: usize,
    flat: Flat,
    /// Its parallel.
    path: Flat,
    /// Lengths that the joints take off the parallel's start and end [mm].
    cuts: [f64; 2],
}

/// Joins the parallels; returns the sweep of the arc before each element, where there is one.
fn join(planar: &mut [Planar], d: f64, start: CompStart) -> Result<Vec<Option<f64>>> {
    let mut rounds = vec![None; planar.len()];
    for k in 1..planar.len() {
        let (head, tail) = planar.split_at_mut(k);
        let (a, b) = (&mut head[k - 1], &mut tail[0]);
        let ((point, t), (_, u)) = (a.flat.end(), b.flat.at(0.0));
        if k == 1 && start == CompStart::AtNext {
            // The entry's own parallel plays no part.
            let from = a.flat.at(0.0).0;
            a.path = Flat::Line { start: from, end: point + u.perp() * d };
            continue;
        }
        match corner(&a.path, &b.path, t.angle_to(u), d) {
            Corner::Meet { back, forth } => {
                a.cuts[1] = back;
                b.cuts[0] = forth;
            }
            Corner::Round { sweep } => rounds[k] = Some(sweep),
            Corner::Step => {}
            Corner::NoRoom => return Err(no_room(b, d).into()),
        }
    }
    Ok(rounds)
}

fn no_room(element: &Planar, d: f64) -> Finding {
    refused(element.item, "gouging: an inside corner has no room for the compensation beside this move")
        .value_mm(element.flat.length())
        .bound_mm(d.abs())
        .help("use a smaller radius register or tool, or a longer move")
}

/// The path so far.
struct Path {
    curves: Vec<Programmed>,
    here: DVec3,
}

impl Path {
    fn push(&mut self, item: usize, curve: Curve) {
        self.here = curve.end();
        self.curves.push(Programmed { item, curve });
    }

    fn to(&mut self, item: usize, end: DVec3) {
        if self.here.distance(end) > CLOSED {
            self.push(item, Line { start: self.here, end }.into());
        }
    }

    fn along(&mut self, item: usize, part: &Flat, rise: f64) {
        let z = self.here.z;
        self.push(item, part.lifted(z, rise));
    }

    /// Round a corner in the plane.
    fn around(&mut self, item: usize, corner: DVec2, sweep: f64) {
        let centre = corner.extend(self.here.z);
        self.push(item, Arc { start: self.here, centre, axis: DVec3::Z, sweep, rise: 0.0 }.into());
    }
}
