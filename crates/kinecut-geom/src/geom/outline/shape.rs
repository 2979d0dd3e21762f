//! Loops of edges with their nesting and orientation.

use std::f64::consts::TAU;

use glam::DVec2;

use super::crossing::first_crossing;
use super::{OutlineEdge, OutlineLoop};
use crate::base::{Code, Finding, Result};
use crate::geom::OffsetLoop;

/// The outline of a face: outer loops clockwise, holes counter-clockwise, so that the material always lies on the
/// right of the direction of travel. Edges are numbered loop after loop.
///
/// ```
/// # use kinecut_geom as kinecut;
/// use glam::dvec2;
/// use kinecut::geom::{Outline, OutlineEdge};
/// let corners = [dvec2(0.0, 0.0), dvec2(4.0, 0.0), dvec2(4.0, 3.0), dvec2(0.0, 3.0)];
/// let plate = Outline::polygon(&corners)?;
/// let bore = vec![OutlineEdge::arc(dvec2(2.0, 1.5), 0.5, 0.0, 6.4)];
/// let plate = Outline::new(vec![plate.edges().to_vec(), bore], vec![])?;
/// assert!((plate.area() - (12.0 - 0.25 * std::f64::consts::PI)).abs() < 1e-12);
/// assert!(plate.loops()[0].outer && !plate.loops()[1].outer);
/// # Ok::<(), kinecut::base::Error>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Outline {
    edges: Vec<OutlineEdge>,
    loops: Vec<OutlineLoop>,
    labels: Vec<String>,
    /// Whether each loop is an open line, there and back.
    of_lines: bool,
}

impl Outline {
    /// Largest gap between the end of an edge and the start of the next, per size of the outline: rounding.
    const JOINED: f64 = 1e-9;

    /// The outline of closed loops in any order and direction. Loops inside an odd number of others are holes. Loops
    /// keep their first point; edges of a loop that runs the wrong way are reversed. `labels` are the meanings of the
    /// `label`s of the edges.
    ///
    /// # Errors
    /// `KC0803` for a loop with a gap, `KC0804` where edges cross, touch or overlap, with their numbers in the order given
    /// and the point; `KC0805` for an edge without length, with numbers that are not finite, or whose circle does not pass
    /// its ends.
    pub fn new(loops: Vec<Vec<OutlineEdge>>, labels: Vec<String>) -> Result<Outline> {
        Outline::named(loops, labels, &|i| i.to_string())
    }

    /// The face of loops that were checked as an offset, which has them on its right: edges that are no longer than the rounding
    /// of offsets are left out, joints are closed, and loops may touch or overlap by that. Nothing is checked again.
    pub fn of_offset<'a>(loops: impl IntoIterator<Item = &'a OffsetLoop>) -> Outline {
        let mut outline = Outline::empty(Vec::new());
        for one in loops {
            let first = outline.edges.len();
            outline.edges.extend(one.joined());
            if outline.edges.len() > first {
                outline
                    .loops
                    .push(OutlineLoop { edges: first..outline.edges.len(), outer: one.area() > 0.0 });
            }
        }
        outline
    }

    /// As [`Outline::new`], with words for an edge by its number in messages.
    pub(super) fn named(
        loops: Vec<Vec<OutlineEdge>>,
        labels: Vec<String>,
        name: &dyn Fn(usize) -> String,
    ) -> Result<Outline> {
        if loops.iter().all(Vec::is_empty) {
            return Err(Finding::error(Code::OUTLINE_EDGE, "the outline has no edges").into());
        }
        let mut outline = Outline::empty(labels);
        for edges in loops.into_iter().filter(|l| !l.is_empty()) {
            let first = outline.edges.len();
            outline.edges.extend(edges);
            outline.loops.push(OutlineLoop { edges: first..outline.edges.len(), outer: true });
        }
        outline.check_edges(name)?;
        let tolerance = Outline::JOINED * outline.size();
        outline.check_joined(tolerance)?;
        outline.check_simple(tolerance, name)?;
        outline.orient();
        Ok(outline)
    }

    fn empty(labels: Vec<String>) -> Outline {
        Outline { edges: Vec::new(), loops: Vec::new(), labels, of_lines: false }
    }

    /// Open lines as faces without width: each loop runs along its line and back, so that what lies beside a line is on the left of
    /// the loop on either side. The first half of a loop is its line, in the direction given.
    ///
    /// # Errors
    /// `KC0803` for a line with a gap, `KC0804` where lines cross, touch or overlap; `KC0805` as [`Outline::new`].
    ///
    /// ```
    /// # use kinecut_geom as kinecut;
    /// use glam::dvec2;
    /// use kinecut::geom::{Outline, OutlineEdge, offset};
    /// let line = OutlineEdge::line(dvec2(0.0, 0.0), dvec2(30.0, 0.0));
    /// let line = Outline::of_lines(vec![vec![line]], vec![])?;
    /// assert!(line.is_of_lines() && line.area() == 0.0 && line.perimeter() == 60.0);
    /// // At 5 mm around it: both sides, and a half circle about each end.
    /// let around = offset(&line, -5.0)?;
    /// assert!((around.length() - (60.0 + 10.0 * std::f64::consts::PI)).abs() < 1e-9);
    /// # Ok::<(), kinecut::base::Error>(())
    /// ```
    pub fn of_lines(lines: Vec<Vec<OutlineEdge>>, labels: Vec<String>) -> Result<Outline> {
        Outline::named_lines(lines, labels, &|i| i.to_string(), true)
    }

    /// As [`Outline::of_lines`], but lines may cross, touch and overlap, and end where they begin: for a cutter that runs on them.
    ///
    /// # Errors
    /// `KC0803` for a line with a gap; `KC0805` as [`Outline::new`].
    pub fn of_drawn(lines: Vec<Vec<OutlineEdge>>, labels: Vec<String>) -> Result<Outline> {
        Outline::named_lines(lines, labels, &|i| i.to_string(), false)
    }

    /// As [`Outline::of_lines`], with words for an edge by its number in messages; `apart`: lines must not meet.
    pub(super) fn named_lines(
        lines: Vec<Vec<OutlineEdge>>,
        labels: Vec<String>,
        name: &dyn Fn(usize) -> String,
        apart: bool,
    ) -> Result<Outline> {
        let mut there = Outline { of_lines: true, ..Outline::empty(labels) };
        for edges in lines.into_iter().filter(|l| !l.is_empty()) {
            let first = there.edges.len();
            there.edges.extend(edges);
            there.loops.push(OutlineLoop { edges: first..there.edges.len(), outer: true });
        }
        if there.edges.is_empty() {
            return Err(Finding::error(Code::OUTLINE_EDGE, "the line has no edges").into());
        }
        there.check_edges(name)?;
        let tolerance = Outline::JOINED * there.size();
        there.check_joined(tolerance)?;
        if apart {
            there.check_simple(tolerance, name)?;
        }
        let mut outline = Outline { edges: Vec::new(), loops: Vec::new(), ..there.clone() };
        for one in &there.loops {
            let (first, line) = (outline.edges.len(), &there.edges[one.edges.clone()]);
            outline.edges.extend_from_slice(line);
            outline.edges.extend(line.iter().rev().map(OutlineEdge::reversed));
            outline.loops.push(OutlineLoop { edges: first..outline.edges.len(), outer: true });
        }
        Ok(outline)
    }

    /// Whether it is made of open lines, each there and back: [`Outline::of_lines`].
    pub fn is_of_lines(&self) -> bool {
        self.of_lines
    }

    /// The open lines of which it is made, in the direction that they were given; none of an outline of faces.
    pub fn lines(&self) -> impl Iterator<Item = &[OutlineEdge]> {
        let halves = self.loops.iter().map(|one| {
            let half = one.edges.len() / 2;
            &self.edges[one.edges.start..one.edges.start + half]
        });
        halves.take(if self.of_lines { self.loops.len() } else { 0 })
    }

    /// The outline of one polygon.
    ///
    /// # Errors
    /// As [`Outline::new`].
    pub fn polygon(corners: &[DVec2]) -> Result<Outline> {
        Outline::new(vec![polygon_edges(corners)], Vec::new())
    }

    /// The outline of polygons, each a loop.
    ///
    /// # Errors
    /// As [`Outline::new`].
    pub fn polygons(loops: &[Vec<DVec2>]) -> Result<Outline> {
        Outline::new(loops.iter().map(|l| polygon_edges(l)).collect(), Vec::new())
    }

    /// All edges, loop after loop.
    pub fn edges(&self) -> &[OutlineEdge] {
        &self.edges
    }

    /// The loops.
    pub fn loops(&self) -> &[OutlineLoop] {
        &self.loops
    }

    /// Meanings of the edges' labels: layers of a drawing, names of a file.
    pub fn labels(&self) -> &[String] {
        &self.labels
    }

    /// The label of an edge, if it has one.
    pub fn label(&self, edge: usize) -> Option<&str> {
        self.labels.get(self.edges.get(edge)?.label as usize).map(String::as_str)
    }

    /// Length of all edges [mm].
    pub fn perimeter(&self) -> f64 {
        self.edges.iter().map(OutlineEdge::length).sum()
    }

    /// Area of the face [mm2].
    pub fn area(&self) -> f64 {
        -0.5 * self.edges.iter().map(OutlineEdge::twice_area).sum::<f64>()
    }

    /// Least and greatest value of `direction . point` over the outline.
    pub fn extent(&self, direction: DVec2) -> [f64; 2] {
        extent(&self.edges, direction)
    }

    /// Least and greatest corner of the box around the outline [mm].
    pub fn bounds(&self) -> [DVec2; 2] {
        bounds(&self.edges)
    }

    /// True if a point lies in the material of the face; on an edge either answer is given.
    pub fn contains(&self, point: DVec2) -> bool {
        self.edges.iter().map(|e| crossings_beyond(e, point)).sum::<usize>() % 2 != 0
    }

    /// The outline turned about the origin by `angle` [rad], then moved by `shift` [mm].
    #[must_use]
    pub fn moved(&self, angle: f64, shift: DVec2) -> Outline {
        Outline { edges: self.edges.iter().map(|e| e.moved(angle, shift)).collect(), ..self.clone() }
    }

    /// The outline with `y` and `-y` exchanged. The order of the edges of each loop is reversed but for its first
    /// point: edge `k` of a loop of `n` edges becomes edge `n - 1 - k`.
    #[must_use]
    pub fn mirrored(&self) -> Outline {
        let mut mirrored = self.clone();
        for one in &self.loops {
            let edges = &mut mirrored.edges[one.edges.clone()];
            edges.reverse();
            for edge in edges {
                *edge = edge.mirrored();
            }
        }
        mirrored
    }

    /// The outline of some of its loops; an inner one without the one around it is an outline of its own, whose material
    /// still lies on the right.
    #[must_use]
    pub fn with_loops(&self, keep: impl Fn(&OutlineLoop) -> bool) -> Outline {
        let mut some = Outline { of_lines: self.of_lines, ..Outline::empty(self.labels.clone()) };
        for one in self.loops.iter().filter(|l| keep(l)) {
            let first = some.edges.len();
            some.edges.extend_from_slice(&self.edges[one.edges.clone()]);
            some.loops.push(OutlineLoop { edges: first..some.edges.len(), outer: one.outer });
        }
        some
    }

    /// The outline with other labels: of each edge, and the list of their meanings.
    pub(super) fn relabelled(mut self, label: impl Fn(u32) -> u32, labels: Vec<String>) -> Outline {
        for edge in &mut self.edges {
            edge.label = label(edge.label);
        }
        self.labels = labels;
        self
    }

    fn size(&self) -> f64 {
        let [min, max] = self.bounds();
        (max - min).length()
    }

    fn check_edges(&self, name: &dyn Fn(usize) -> String) -> Result<()> {
        for (i, edge) in self.edges.iter().enumerate() {
            let finite = edge.start.is_finite()
                && edge.end.is_finite()
                && edge.turn.is_none_or(|t| {
                    t.centre.is_finite() && t.radius.is_finite() && t.from.is_finite() && t.sweep.is_finite()
                });
            if !finite {
                return Err(Finding::error(
                    Code::OUTLINE_EDGE,
                    format!("edge {} has numbers that are not finite", name(i)),
                )
                .into());
            }
        }
        let least = Outline::JOINED * self.size();
        for (i, edge) in self.edges.iter().enumerate() {
            if !(edge.length() > least) {
                return Err(Finding::error(Code::OUTLINE_EDGE, format!("edge {} has no length", name(i)))
                    .value_mm(edge.length())
                    .bound_mm(least)
                    .point([edge.start.x, edge.start.y, 0.0])
                    .help("remove the point that stands twice")
                    .into());
            }
            let Some(t) = edge.turn else { continue };
            // Points of a nearly straight arc are known no better than the rounding of its radius.
            let largest = least + 8.0 * f64::EPSILON * (t.radius + t.centre.length());
            let ends = [(edge.start, t.from), (edge.end, t.from + t.sweep)];
            let off = ends.map(|(p, angle)| p.distance(t.centre + t.radius * DVec2::from_angle(angle)));
            let worst = if off[0] > off[1] { off[0] } else { off[1] };
            if !(t.radius > 0.0 && t.sweep.abs() <= TAU && worst <= largest) {
                return Err(Finding::error(
                    Code::OUTLINE_EDGE,
                    format!("the circle of edge {} does not pass the edge's ends", name(i)),
                )
                .value_mm(worst)
                .bound_mm(largest)
                .point([edge.start.x, edge.start.y, 0.0])
                .into());
            }
        }
        Ok(())
    }

    fn check_joined(&self, largest: f64) -> Result<()> {
        for one in &self.loops {
            // The end of a line meets nothing.
            let last = one.edges.end - usize::from(self.of_lines);
            for i in one.edges.start..last {
                let next = if i + 1 < one.edges.end { i + 1 } else { one.edges.start };
                let (end, start) = (self.edges[i].end, self.edges[next].start);
                if !(end.distance(start) <= largest) {
                    return Err(Finding::error(
                        Code::OUTLINE_OPEN,
                        format!(
                            "the outline is open between ({:.4}, {:.4}) and ({:.4}, {:.4})",
                            end.x, end.y, start.x, start.y
                        ),
                    )
                    .value_mm(end.distance(start))
                    .bound_mm(largest)
                    .point([end.x, end.y, 0.0])
                    .help("close the gap in the drawing")
                    .into());
                }
            }
        }
        Ok(())
    }

    fn check_simple(&self, tolerance: f64, name: &dyn Fn(usize) -> String) -> Result<()> {
        let Some(crossing) = first_crossing(&self.edges, &self.loops, self.of_lines, tolerance) else {
            return Ok(());
        };
        let [a, b] = crossing.edges;
        let p = crossing.point;
        Err(Finding::error(
            Code::OUTLINE_CROSSES,
            format!("edges {} and {} meet at ({:.4}, {:.4})", name(a), name(b), p.x, p.y),
        )
        .point([p.x, p.y, 0.0])
        .help("trim the drawing there, or remove what is drawn twice")
        .into())
    }

    /// Outer loops clockwise, holes counter-clockwise, by the parity of containment.
    fn orient(&mut self) {
        let boxes: Vec<[DVec2; 2]> =
            self.loops.iter().map(|l| bounds(&self.edges[l.edges.clone()])).collect();
        let outer: Vec<bool> =
            (0..self.loops.len()).map(|i| self.depth(i, &boxes).is_multiple_of(2)).collect();
        for (one, outer) in self.loops.iter_mut().zip(outer) {
            one.outer = outer;
            let edges = &mut self.edges[one.edges.clone()];
            let clockwise = edges.iter().map(OutlineEdge::twice_area).sum::<f64>() < 0.0;
            if clockwise != outer {
                edges.reverse();
                for edge in edges {
                    *edge = edge.reversed();
                }
            }
        }
    }

    /// In how many other loops a loop lies; `boxes` are those around the loops.
    fn depth(&self, index: usize, boxes: &[[DVec2; 2]]) -> usize {
        let inside = self.edges[self.loops[index].edges.start].at(0.5);
        let around = |i: usize| {
            let [min, max] = boxes[i];
            i != index && min.cmple(inside).all() && inside.cmple(max).all()
        };
        (0..self.loops.len())
            .filter(|&i| around(i))
            .filter(|&i| {
                let edges = &self.edges[self.loops[i].edges.clone()];
                edges.iter().map(|e| crossings_beyond(e, inside)).sum::<usize>() % 2 != 0
            })
            .count()
    }
}

/// Least and greatest corner of the box around edges [mm].
fn bounds(edges: &[OutlineEdge]) -> [DVec2; 2] {
    let ([x0, x1], [y0, y1]) = (extent(edges, DVec2::X), extent(edges, DVec2::Y));
    [DVec2::new(x0, y0), DVec2::new(x1, y1)]
}

fn extent(edges: &[OutlineEdge], direction: DVec2) -> [f64; 2] {
    edges.iter().fold([f64::INFINITY, f64::NEG_INFINITY], |all, edge| {
        let one = edge.extent(direction);
        [if one[0] < all[0] { one[0] } else { all[0] }, if one[1] > all[1] { one[1] } else { all[1] }]
    })
}

fn polygon_edges(corners: &[DVec2]) -> Vec<OutlineEdge> {
    (0..corners.len()).map(|i| OutlineEdge::line(corners[i], corners[(i + 1) % corners.len()])).collect()
}

/// Number of times the edge crosses the ray from `point` towards +x.
fn crossings_beyond(edge: &OutlineEdge, point: DVec2) -> usize {
    let Some(t) = edge.turn else {
        return usize::from(crosses(edge.start, edge.end, point));
    };
    let off = point - t.centre;
    if off.y.abs() > t.radius || off.x > t.radius {
        return 0;
    }
    // Pieces between the circle's highest and lowest points rise or fall: each is crossed once at most, and where it is
    // crossed the circle tells.
    let mut angles = vec![t.from, t.from + t.sweep];
    for k in [0.25, 0.75] {
        let gone = crate::num::angle::wrap_positive((k * std::f64::consts::TAU - t.from) * t.sweep.signum());
        for gone in [gone, gone + std::f64::consts::TAU] {
            if gone < t.sweep.abs() {
                angles.push(t.from + gone * t.sweep.signum());
            }
        }
    }
    angles.sort_by(f64::total_cmp);
    let height = |a: f64| {
        if a == t.from {
            edge.start.y
        } else if a == t.from + t.sweep {
            edge.end.y
        } else {
            t.centre.y + t.radius * a.sin()
        }
    };
    angles
        .windows(2)
        .filter(|w| {
            let (y0, y1) = (height(w[0]), height(w[1]));
            if (y0 > point.y) == (y1 > point.y) {
                return false;
            }
            let right = (0.5 * (w[0] + w[1])).cos() > 0.0;
            let up = point.y - t.centre.y;
            let half = (t.radius * t.radius - up * up).max(0.0).sqrt();
            t.centre.x + if right { half } else { -half } > point.x
        })
        .count()
}

fn crosses(a: DVec2, b: DVec2, point: DVec2) -> bool {
    if (a.y > point.y) == (b.y > point.y) {
        return false;
    }
    let x = a.x + (point.y - a.y) / (b.y - a.y) * (b.x - a.x);
    x > point.x
}

#[cfg(test)]
mod tests {
    use std::f64::consts::TAU;

    use glam::dvec2;

    use super::*;

    fn ring() -> Outline {
        let outer = vec![OutlineEdge::arc(DVec2::ZERO, 10.0, 0.3, TAU)];
        let hole = vec![
            OutlineEdge::arc(DVec2::ZERO, 6.0, 0.1, -2.0),
            OutlineEdge::arc(DVec2::ZERO, 6.0, 0.1 - 2.0, -TAU + 2.0),
        ];
        let island = vec![OutlineEdge::arc(dvec2(0.5, 0.0), 2.0, 3.0, TAU)];
        Outline::new(vec![outer, hole, island], vec![]).unwrap()
    }

    #[test]
    fn loops_are_nested_and_have_their_material_on_the_right() {
        let ring = ring();
        assert_eq!(ring.loops().iter().map(|l| l.outer).collect::<Vec<_>>(), [true, false, true]);
        let area = TAU / 2.0 * (100.0 - 36.0 + 4.0);
        assert!((ring.area() - area).abs() < 1e-10);
        for edge in ring.edges() {
            for s in [0.1, 0.5, 0.9] {
                let out = DVec2::from_angle(edge.outward(s));
                assert!(ring.contains(edge.at(s) - 1e-6 * out) && !ring.contains(edge.at(s) + 1e-6 * out));
            }
        }
    }

    #[test]
    fn a_mirrored_outline_keeps_material_on_the_right_and_its_area() {
        let ring = ring().moved(0.4, dvec2(3.0, -7.0));
        let mirrored = ring.mirrored();
        assert!((ring.area() - mirrored.area()).abs() < 1e-9);
        assert_eq!(mirrored.loops(), ring.loops());
        for edge in mirrored.edges() {
            let out = DVec2::from_angle(edge.outward(0.4));
            assert!(
                mirrored.contains(edge.at(0.4) - 1e-6 * out) && !mirrored.contains(edge.at(0.4) + 1e-6 * out)
            );
        }
    }

    #[test]
    fn extents_of_arcs_are_those_of_dense_points() {
        for sweep in [0.3, 1.7, -2.9, 4.4, -6.0] {
            let arc = OutlineEdge::arc(dvec2(1.0, 2.0), 3.0, 0.8, sweep);
            for k in 0..12 {
                let direction = DVec2::from_angle(0.5 * f64::from(k));
                let [min, max] = arc.extent(direction);
                let values: Vec<f64> =
                    (0..=4000).map(|i| direction.dot(arc.at(f64::from(i) / 4000.0))).collect();
                let least = values.iter().copied().fold(f64::INFINITY, f64::min);
                let most = values.iter().copied().fold(f64::NEG_INFINITY, f64::max);
                assert!(min <= least + 1e-12 && least - min < 1e-5, "{sweep} {k}");
                assert!(max >= most - 1e-12 && max - most < 1e-5, "{sweep} {k}");
            }
        }
    }

    #[test]
    fn gaps_and_points_that_stand_twice_are_refused() {
        let open = vec![
            OutlineEdge::line(dvec2(0.0, 0.0), dvec2(1.0, 0.0)),
            OutlineEdge::line(dvec2(1.0, 0.0), dvec2(0.5, 1.0)),
        ];
        let error = Outline::new(vec![open], vec![]).unwrap_err();
        assert_eq!(error.code(), Code::OUTLINE_OPEN);
        assert!(error.to_string().contains("(0.5000, 1.0000)"), "{error}");
        let twice = [dvec2(0.0, 0.0), dvec2(1.0, 0.0), dvec2(1.0, 0.0), dvec2(0.0, 1.0)];
        assert_eq!(Outline::polygon(&twice).unwrap_err().code(), Code::OUTLINE_EDGE);
        let nan = [dvec2(0.0, 0.0), dvec2(f64::NAN, 0.0), dvec2(0.0, 1.0)];
        assert_eq!(Outline::polygon(&nan).unwrap_err().code(), Code::OUTLINE_EDGE);
    }
}
