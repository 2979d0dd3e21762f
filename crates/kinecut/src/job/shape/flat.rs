//! The milled face against its plane: measured at the ends of the stock's lines, where the stock is exact.

use glam::{DVec2, DVec3};
use rayon::prelude::*;

use crate::geom::Rigid;
use crate::operations::measured::{FaceMeasure, Worst};
use crate::operations::wanted::WantedPlane;
use crate::stock::{Axis, CutId, DexelGrid, unfixed};

/// Measures the face of an operation: over its outline no material is above the finished plane, and where the
/// operation cut, the material ends at it. `own` tells whether a cut is the operation's, `to_work` maps the
/// part as it is clamped, turned or not, to the work offset. `each` is given every end that was measured: its line, its number
/// on the line, and its height above the plane.
pub(super) fn measure_face(
    face: &WantedPlane<'_>,
    operation: u32,
    to_work: Rigid,
    stock: &(impl DexelGrid + ?Sized),
    own: impl Fn(CutId) -> bool + Sync,
    mut each: impl FnMut(Axis, u32, u32, usize, f64),
) -> FaceMeasure {
    let mut all = FaceMeasure {
        operation,
        height: [f64::INFINITY, f64::NEG_INFINITY],
        ends: 0,
        left: Worst::default(),
        gouge: Worst::default(),
    };
    let to_part = to_work.inverse();
    let up = to_part.vector(DVec3::Z);
    let axis = Axis::nearest(up);
    let upwards = up[axis.index()] > 0.0;
    let (a, b) = axis.others();
    let lattice = stock.lattice();
    let [min, max] = face.outline.bounds();
    let row = |i: u32| {
        let mut found = Vec::new();
        for j in 0..lattice.counts[b.index()] {
            let mut point = DVec3::ZERO;
            point[a.index()] = lattice.coordinate(a, i);
            point[b.index()] = lattice.coordinate(b, j);
            // The highest material over the outline, seen from the spindle.
            let line = stock.line(axis, i, j);
            let over_outline = |k: usize| {
                let k = if upwards { line.len() - 1 - k } else { k };
                let (end, number) = if upwards { (line[k].hi, 2 * k + 1) } else { (line[k].lo, 2 * k) };
                let mut point = point;
                point[axis.index()] = unfixed(end.at);
                let placed = to_work.point(point);
                let over: DVec2 = face.in_outline(placed.truncate());
                let near = over.cmpge(min).all() && over.cmple(max).all();
                (near && face.outline.contains(over)).then_some((number, placed.z - face.top, point, end.cut))
            };
            let Some((number, above, point, cut)) = (0..line.len()).find_map(over_outline) else { continue };
            if above <= 0.0 && !own(cut) {
                continue;
            }
            found.push((j, number, above, point, cut));
        }
        found
    };
    let rows: Vec<_> = (0..lattice.counts[a.index()]).into_par_iter().map(row).collect();
    for (i, row) in rows.into_iter().enumerate() {
        for (j, number, above, point, cut) in row {
            each(axis, i as u32, j, number, above);
            all.ends += 1;
            all.height = [all.height[0].min(above), all.height[1].max(above)];
            all.left.note(above, point, cut);
            all.gouge.note(-above, point, cut);
        }
    }
    all
}
