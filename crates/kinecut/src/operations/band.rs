//! The strip along a contour that a cutter takes away, with the wall at one side of it: what an operation along a contour wants.

use std::ops::Range;

use glam::DVec2;

use crate::contouring::ContourSide;
use crate::geom::{NearestEdge, Outline, OutlineEdge};

/// A strip along an outline, in coordinates of the work offset [mm].
#[derive(Clone, Debug)]
pub(crate) struct Band {
    edges: Vec<OutlineEdge>,
    /// Ranges of the edges of each loop or line.
    loops: Vec<Range<usize>>,
    near: NearestEdge,
    /// Whether the face stays, or what is around it.
    keeps_face: bool,
    /// Stock left on the wall.
    leave: f64,
    /// Width of the strip.
    width: f64,
    /// The middle of the outline.
    pub(crate) middle: DVec2,
    /// Distance from the middle that the strip stays within.
    pub(crate) reach: f64,
    /// Corners that the cutter does not reach.
    pub(crate) corners: Vec<Fillet>,
    /// Tabs.
    pub(crate) tabs: Vec<TabPlace>,
    /// Radius of the fillet that the cutter leaves along the foot of the strip's sides.
    pub(crate) foot: f64,
    /// The lean of the wall, if it does not stand upright.
    slope: Option<Slope>,
    /// Stretches of loops that are wanted, from and to along each from its first point; `None`: all. The second may lie beyond the
    /// end of the loop, the first before its begin.
    only: Option<Vec<(usize, [f64; 2])>>,
}

/// The lean of a wall that a conical cutter leaves: a chamfer.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Slope {
    /// Height of its upper edge.
    pub(crate) top: f64,
    /// Distance by which it lies behind the upright wall there.
    pub(crate) width: f64,
    /// Tangent of the angle between it and the upright wall.
    pub(crate) lean: f64,
    /// Height of the cutter's tip.
    pub(crate) tip: f64,
    /// Radius of the ball that makes it, if a ball does: then it is hollow, and `lean` is that at its upper edge.
    pub(crate) ball: Option<f64>,
}

impl Slope {
    /// Distance by which it lies behind the upright wall at a height; before it below its lower edge.
    fn behind(&self, z: f64) -> f64 {
        let below = if z < self.top { self.top - z } else { 0.0 };
        let Some(radius) = self.ball else { return self.width - below * self.lean };
        // The centre of the ball lies as far beside the wall as over the edge: `beside^2 + (beside + width)^2 = radius^2`.
        let beside = self.beside(radius);
        let square = radius * radius - (beside + below) * (beside + below);
        if square > 0.0 { square.sqrt() - beside } else { -beside }
    }

    /// Distance of a ball's centre from the wall, and its height over the edge.
    fn beside(&self, radius: f64) -> f64 {
        let square = 2.0 * radius * radius - self.width * self.width;
        if square > 0.0 { 0.5 * (square.sqrt() - self.width) } else { 0.0 }
    }

    /// Greatest share upwards of the direction in which it looks.
    pub(crate) fn upward(&self) -> f64 {
        match self.ball {
            Some(radius) => (self.beside(radius) + self.width) / radius,
            None => self.lean / self.lean.hypot(1.0),
        }
    }

    /// Its noun.
    pub(crate) fn noun(&self) -> &'static str {
        if self.ball.is_some() { "break" } else { "chamfer" }
    }
}

/// A fillet that a cutter leaves in a corner.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Fillet {
    /// Its centre.
    pub(crate) centre: DVec2,
    /// Its radius.
    pub(crate) radius: f64,
    /// Directions from the centre to its ends.
    pub(crate) between: [DVec2; 2],
}

/// A place at which a tab stays.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct TabPlace {
    /// Its middle.
    pub(crate) at: DVec2,
    /// Distance from it within which it may reach.
    pub(crate) radius: f64,
    /// Height of its upper side.
    pub(crate) top: f64,
}

/// Distance beyond a fillet that still belongs to it [mm].
const FILLET: f64 = 1e-3;

impl Fillet {
    /// Distance of a point on the corner's side from the fillet, positive on the side of its centre.
    ///
    /// `wider`: what is added to the radius.
    fn inside(&self, p: DVec2, wider: f64) -> Option<f64> {
        let off = p - self.centre;
        let [from, to] = self.between;
        let turn = from.perp_dot(to);
        let within =
            from.perp_dot(off) * turn >= 0.0 && off.perp_dot(to) * turn >= 0.0 && off.dot(from + to) > 0.0;
        within.then(|| self.radius + wider - off.length())
    }
}

impl Band {
    pub(crate) fn new(outline: &Outline, keeps_face: bool, leave: f64, width: f64) -> Band {
        let loops = outline.loops().iter().map(|l| l.edges.clone()).collect();
        Band::along(outline.edges().to_vec(), loops, keeps_face, (leave, width))
    }

    /// On a side of an outline, with so much left on the wall, and of a width.
    pub(crate) fn beside(outline: &Outline, side: ContourSide, (leave, width): (f64, f64)) -> Band {
        if !outline.is_of_lines() {
            return Band::new(outline, side == ContourSide::Outside, leave, width);
        }
        let reversed = |line: &[OutlineEdge]| line.iter().rev().map(OutlineEdge::reversed).collect();
        let lines = outline.lines().map(|l| if side == ContourSide::Left { l.to_vec() } else { reversed(l) });
        Band::beside_lines(lines.collect(), leave, width)
    }

    /// On the left of open lines.
    fn beside_lines(lines: Vec<Vec<OutlineEdge>>, leave: f64, width: f64) -> Band {
        /// Length at the ends of a line that is not compared [mm]: there the cutter begins to leave.
        const ENDS: f64 = 2e-3;
        let (mut loops, mut only) = (Vec::new(), Vec::new());
        for line in &lines {
            let first = loops.last().map_or(0, |l: &Range<usize>| l.end);
            let length: f64 = line.iter().map(OutlineEdge::length).sum();
            only.push((loops.len(), [ENDS, length - ENDS]));
            loops.push(first..first + line.len());
        }
        Band::along(lines.concat(), loops, true, (leave, width)).only(only.into_iter())
    }

    fn along(
        edges: Vec<OutlineEdge>,
        loops: Vec<Range<usize>>,
        keeps_face: bool,
        (leave, width): (f64, f64),
    ) -> Band {
        let near = NearestEdge::new(&edges);
        let [min, max] = bounds(&edges);
        Band {
            edges,
            loops,
            near,
            keeps_face,
            leave,
            width,
            middle: 0.5 * (min + max),
            reach: 0.5 * min.distance(max) + width + leave,
            corners: Vec::new(),
            tabs: Vec::new(),
            foot: 0.0,
            slope: None,
            only: None,
        }
    }

    /// All inside of an outline, around its islands: a pocket, with so much left on its wall [mm].
    pub(crate) fn inside_of(outline: &Outline, leave: f64) -> Band {
        let [min, max] = outline.bounds();
        // No point inside is so far from the wall that it would lie beyond the middle of the strip.
        let size = min.distance(max);
        Band { reach: 0.5 * size, ..Band::new(outline, false, leave, 2.0 * size) }
    }

    /// With a wall that leans: its width and fillets are those at its lower edge.
    pub(crate) fn leaning(self, slope: Slope) -> Band {
        Band { reach: self.reach + slope.width, slope: Some(slope), ..self }
    }

    /// With stretches of its loops only, each from and to along its loop; about their middle.
    pub(crate) fn only(self, on: impl Iterator<Item = (usize, [f64; 2])>) -> Band {
        let mut band = Band { only: Some(on.collect()), ..self };
        let edges = band.wanted_edges();
        if edges.is_empty() {
            return band;
        }
        let [min, max] = bounds(&edges);
        band.middle = 0.5 * (min + max);
        band.reach = 0.5 * min.distance(max) + band.width + band.leave + band.slope.map_or(0.0, |s| s.width);
        band
    }

    /// The edges along which it is wanted, or parts of them.
    fn wanted_edges(&self) -> Vec<OutlineEdge> {
        let Some(only) = &self.only else { return self.edges.clone() };
        let mut found = Vec::new();
        for &(of_loop, [from, to]) in only {
            let Some(one) = self.loops.get(of_loop) else { continue };
            let edges = &self.edges[one.clone()];
            let whole: f64 = edges.iter().map(OutlineEdge::length).sum();
            let from_first = from.rem_euclid(whole);
            let end = from_first + if to - from < whole { to - from } else { whole };
            for turn in [0.0, whole] {
                let mut begin = turn;
                for edge in edges {
                    let length = edge.length();
                    let a = if from_first > begin { from_first } else { begin };
                    let b = if end < begin + length { end } else { begin + length };
                    if a < b {
                        found.push(edge.part((a - begin) / length, (b - begin) / length));
                    }
                    begin += length;
                }
            }
        }
        found
    }

    /// Whether the wall at the place nearest to a point is wanted.
    fn is_wanted(&self, p: DVec2) -> bool {
        /// Ends of a stretch that are as near as this are not compared [mm]: there the cutter begins to leave.
        const ENDS: f64 = 1e-3;
        let Some(only) = &self.only else { return true };
        let Some(nearest) = self.near.at(p, self.search()) else { return false };
        let edges = &self.edges;
        let found = self.loops.iter().position(|l| l.contains(&nearest.edge));
        let Some(of_loop) = found else { return false };
        let range = self.loops[of_loop].clone();
        let length = |edges: &[OutlineEdge]| edges.iter().map(|e| e.length()).sum::<f64>();
        let whole = length(&edges[range.clone()]);
        let at = length(&edges[range.start..nearest.edge]) + nearest.share * edges[nearest.edge].length();
        let on = |[from, to]: [f64; 2]| {
            let gone = (at - from).rem_euclid(whole);
            // A corner lies between two stretches that meet in it.
            gone <= to - from && (gone > ENDS || to - from > whole - ENDS) && to - from - gone > ENDS
        };
        only.iter().filter(|(l, _)| *l == of_loop).any(|(_, along)| on(*along))
    }

    /// The lean of the wall.
    pub(crate) fn slope(&self) -> Option<Slope> {
        self.slope
    }

    /// Distance by which the wall lies behind its upright part at a height.
    fn behind(&self, z: f64) -> f64 {
        self.slope.map_or(0.0, |s| s.behind(z))
    }

    /// Width of the strip at a height.
    fn width(&self, z: f64) -> f64 {
        self.width + 2.0 * self.behind(z)
    }

    /// Distance from the wall within which edges are looked for.
    fn search(&self) -> f64 {
        self.width + self.leave + self.slope.map_or(0.0, |s| 2.0 * s.width)
    }

    /// Distance of a point from the wall, positive where it is cut; `None` far away.
    fn off_wall(&self, p: DVec2, z: f64) -> Option<f64> {
        let nearest = self.near.at(p, self.search())?;
        let away = if self.keeps_face { nearest.distance } else { -nearest.distance };
        Some(away - self.leave + self.behind(z))
    }

    /// Distance from the border of the strip, positive inside.
    pub(crate) fn inside(&self, p: DVec2, z: f64) -> f64 {
        let width = self.width(z);
        match self.off_wall(p, z) {
            _ if self.slope.is_some_and(|s| z < s.tip) || !self.is_wanted(p) => -self.width,
            None => -self.width,
            Some(d) if 2.0 * d > width => width - d,
            Some(d) => d,
        }
    }

    /// Whether a point lies on the face beside the upper edge of a wall that leans, not farther behind it than the wall is wide.
    pub(crate) fn beside_edge(&self, p: DVec2) -> bool {
        let Some(slope) = self.slope.filter(|_| self.is_wanted(p)) else { return false };
        self.off_wall(p, slope.top).is_some_and(|d| d < 0.0 && d > -slope.width)
    }

    /// The same on the half beside the wall, which alone is compared, from the fillets in its corners where the cutter leaves
    /// them; not a number elsewhere, beyond fillets, and at tabs.
    pub(crate) fn compared(&self, p: DVec2, z: f64) -> f64 {
        let d = self.off_wall(p, z).unwrap_or(f64::NAN);
        let is_free = 2.0 * d > self.width(z);
        if is_free || self.is_tab(p, z) || !self.is_wanted(p) {
            return f64::NAN;
        }
        match self.fillet(p, z).filter(|_| d > 0.0) {
            // Beyond the fillet stock stays, and what else cuts there is no matter of this wall.
            Some(inside) if inside < -FILLET => f64::NAN,
            Some(inside) => inside,
            None => d,
        }
    }

    /// Distance from the border of what the cutter leaves level at the floor, positive over it: on all of the width of the strip,
    /// but not in the fillets; not a number at tabs.
    pub(crate) fn over_floor(&self, p: DVec2, z: f64) -> f64 {
        if self.is_tab(p, z) {
            return f64::NAN;
        }
        let inside = self.inside(p, z);
        let nearer = self.fillet(p, z).filter(|fillet| *fillet < inside).unwrap_or(inside);
        nearer - self.foot
    }

    fn is_tab(&self, p: DVec2, z: f64) -> bool {
        self.tabs.iter().any(|t| z < t.top && p.distance(t.at) < t.radius)
    }

    /// Distance of a point in a corner from the fillet that stays there, positive where the cutter passes.
    fn fillet(&self, p: DVec2, z: f64) -> Option<f64> {
        let wider = self.behind(z);
        self.corners.iter().filter_map(|f| f.inside(p, wider)).min_by(f64::total_cmp)
    }

    /// The part of a face's normal that looks away from the material that stays: 1 of a face along the wall, 0 far from it.
    pub(crate) fn towards_cut(&self, p: DVec2, normal: DVec2) -> f64 {
        self.near.at(p, self.search()).map_or(0.0, |nearest| {
            let edge = &self.edges[nearest.edge];
            let out = DVec2::from_angle(edge.outward(nearest.share));
            if self.keeps_face { normal.dot(out) } else { -normal.dot(out) }
        })
    }

    /// The point of the wall at a share of its length.
    pub(crate) fn point(&self, share: f64) -> DVec2 {
        let edges = self.wanted_edges();
        let mut left = share.rem_euclid(1.0) * edges.iter().map(OutlineEdge::length).sum::<f64>();
        for edge in &edges {
            if left <= edge.length() {
                return edge.at(left / edge.length());
            }
            left -= edge.length();
        }
        edges.first().map_or(self.middle, |e| e.start)
    }
}

/// Least and greatest corner of the box around edges [mm].
fn bounds(edges: &[OutlineEdge]) -> [DVec2; 2] {
    let [[x0, x1], [y0, y1]] = [DVec2::X, DVec2::Y].map(|axis| {
        let all = edges.iter().map(|e| e.extent(axis));
        all.fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], [l, h]| [low.min(l), high.max(h)])
    });
    [DVec2::new(x0, y0), DVec2::new(x1, y1)]
}

#[cfg(test)]
mod tests {
    use glam::dvec2;

    use super::*;

    fn square() -> Outline {
        Outline::polygon(&[dvec2(0.0, 0.0), dvec2(40.0, 0.0), dvec2(40.0, 40.0), dvec2(0.0, 40.0)]).unwrap()
    }

    #[test]
    fn a_strip_lies_on_one_side_of_the_wall() {
        for (keeps, sign) in [(true, 1.0), (false, -1.0)] {
            let band = Band::new(&square(), keeps, 0.0, 10.0);
            for (aside, inside) in [(0.5, 0.5), (-0.5, -0.5), (4.0, 4.0), (7.0, 3.0), (11.0, -1.0)] {
                let p = dvec2(20.0, -sign * aside);
                assert!(
                    (band.inside(p, 0.0) - inside).abs() < 1e-12 || aside > 10.0 && band.inside(p, 0.0) < 0.0,
                    "{aside}"
                );
            }
            assert!(band.compared(dvec2(20.0, -sign * 0.5), 0.0) > 0.0);
            assert!(band.compared(dvec2(20.0, -sign * 6.0), 0.0).is_nan());
            assert!((band.towards_cut(dvec2(20.0, 0.1), dvec2(0.0, -sign)) - 1.0).abs() < 1e-12);
        }
    }

    #[test]
    fn a_strip_beside_a_line_ends_with_it_and_knows_what_is_cut_beyond() {
        let line = vec![
            OutlineEdge::line(dvec2(0.0, 0.0), dvec2(30.0, 0.0)),
            OutlineEdge::line(dvec2(30.0, 0.0), dvec2(30.0, 20.0)),
        ];
        let band = Band::beside_lines(vec![line], 0.0, 10.0);
        for (x, y, d) in [(10.0, 0.5, 0.5), (10.0, -0.1, -0.1), (29.6, 10.0, 0.4), (30.2, 10.0, -0.2)] {
            assert!((band.compared(dvec2(x, y), 0.0) - d).abs() < 1e-12, "{x} {y}");
        }
        // Far from the wall, before its begin and beyond its end.
        for (x, y) in [(10.0, 6.0), (-0.5, 0.2), (29.0, 20.5), (-0.5, -0.2)] {
            assert!(band.compared(dvec2(x, y), 0.0).is_nan(), "{x} {y}");
        }
        assert!((band.inside(dvec2(10.0, 7.0), 0.0) - 3.0).abs() < 1e-12);
        assert!(band.inside(dvec2(10.0, -7.0), 0.0) < 0.0 && band.inside(dvec2(-3.0, 2.0), 0.0) < 0.0);
        for y in [1.0, -1.0] {
            assert!((band.towards_cut(dvec2(10.0, 0.1), dvec2(0.0, y)) - y).abs() < 1e-12);
        }
    }

    #[test]
    fn a_wall_that_leans_lies_farther_behind_the_higher() {
        let slope = Slope { top: 2.0, width: 1.5, lean: 0.5, tip: -2.0, ball: None };
        let band = Band::new(&square(), true, 0.0, 2.0).leaning(slope);
        // At its lower edge, at its upper one, and above.
        for (z, behind, width) in [(-1.0, 0.0, 2.0), (0.0, 0.5, 3.0), (2.0, 1.5, 5.0), (3.0, 1.5, 5.0)] {
            for (aside, inside) in
                [(0.1, 0.1), (-0.1, -0.1), (0.4 * width, 0.4 * width), (0.6 * width, f64::NAN)]
            {
                let found = band.compared(dvec2(20.0, behind - aside), z);
                assert!(
                    (found - inside).abs() < 1e-12 || found.is_nan() && inside.is_nan(),
                    "{z} {aside} {found}"
                );
            }
            assert!((band.inside(dvec2(20.0, behind - 0.9 * width), z) - 0.1 * width).abs() < 1e-12);
        }
        assert!(band.inside(dvec2(20.0, -1.0), -2.1) < 0.0);
        assert!([1.6, 2.9].iter().all(|y| band.beside_edge(dvec2(20.0, *y))));
        assert!([1.4, 3.1, -1.0].iter().all(|y| !band.beside_edge(dvec2(20.0, *y))));
    }

    #[test]
    fn a_hollow_wall_lies_on_the_ball() {
        let (radius, width) = (3.0, 0.4_f64);
        let beside = 0.5 * ((2.0 * radius * radius - width * width).sqrt() - width);
        let slope = Slope { top: 1.0, width, lean: 0.0, tip: -3.0, ball: Some(radius) };
        let band = Band::new(&square(), true, 0.0, 2.0 * beside).leaning(slope);
        for (z, behind) in [(1.0, width), (1.0 - width, 0.0)] {
            assert!((slope.behind(z) - behind).abs() < 1e-12, "{z}");
        }
        for i in 0..=20 {
            let z = 1.0 - 0.02 * f64::from(i);
            let p = dvec2(20.0, slope.behind(z));
            assert!(band.compared(p, z).abs() < 1e-12);
            // Seen along the wall, the ball's centre lies before it and over the edge.
            assert!(((p.y + beside).hypot(1.0 + beside - z) - radius).abs() < 1e-12);
        }
        assert!(slope.upward() > 0.7 && slope.upward() < 0.8);
    }

    #[test]
    fn stretches_that_are_not_wanted_are_not_compared() {
        // Clockwise, the lower side comes last.
        let outline = square();
        let lower = outline.edges().iter().position(|e| e.start.y == 0.0 && e.end.y == 0.0).unwrap();
        let begin: f64 = outline.edges()[..lower].iter().map(|e| e.length()).sum();
        let start = outline.edges()[lower].start.x;
        let on = |along: [f64; 2]| {
            let band = Band::new(&outline, true, 0.0, 10.0).only([(0, along)].into_iter());
            move |x: f64| !band.compared(dvec2(x, -1.0), 0.0).is_nan()
        };
        let middle = on([begin + 10.0, begin + 15.0]);
        let at = |s: f64| if start == 0.0 { s } else { 40.0 - s };
        assert!(middle(at(12.0)) && !middle(at(9.9)) && !middle(at(15.1)));
        // Round the corner, beyond the end of the loop.
        let corner = on([begin + 150.0, begin + 165.0]);
        assert!(corner(at(4.0)) && !corner(at(6.0)));
        // It lies about its stretch, and so do the points of its wall.
        let band = Band::new(&outline, true, 0.0, 10.0).only([(0, [begin + 10.0, begin + 15.0])].into_iter());
        assert!(band.middle.distance(dvec2(at(12.5), 0.0)) < 1e-9 && (band.reach - 12.5).abs() < 1e-9);
        for i in 0..16 {
            let p = band.point(f64::from(i) / 16.0);
            assert!(p.y.abs() < 1e-9 && (p.x - at(12.5)).abs() < 2.5 + 1e-9, "{p}");
        }
        // Beyond the end of the loop both sides of the corner are.
        let around =
            Band::new(&outline, true, 0.0, 10.0).only([(0, [begin + 150.0, begin + 165.0])].into_iter());
        let sides = (0..16).map(|i| around.point(f64::from(i) / 16.0).y.abs() < 1e-9);
        assert!(sides.clone().any(|lower| lower) && sides.clone().any(|lower| !lower));
    }

    #[test]
    fn corners_and_tabs_are_not_compared() {
        let mut band = Band::new(&square(), false, 0.0, 10.0);
        let corner = dvec2(0.5, 0.5);
        assert!(band.compared(corner, 0.0) > 0.4);
        let between = [dvec2(-1.0, 0.0), dvec2(0.0, -1.0)];
        band.corners.push(Fillet { centre: dvec2(5.0, 5.0), radius: 5.0, between });
        assert!(band.compared(corner, 0.0).is_nan());
        assert!((band.compared(dvec2(2.0, 2.0), 0.0) - (5.0 - 18.0_f64.sqrt())).abs() < 1e-12);
        // Beside the fillet all counts, and what is cut too deep counts everywhere.
        assert!(band.compared(dvec2(6.0, 0.01), 0.0) > 0.0 && band.compared(dvec2(-0.2, 0.5), 0.0) < 0.0);
        // The floor is compared across the whole strip, but for its corners.
        for (p, over) in [((20.0, 0.5), 0.5), ((20.0, 7.0), 3.0), ((20.0, 11.0), -10.0), ((20.0, -1.0), -1.0)]
        {
            let found = band.over_floor(p.into(), -9.0);
            assert!((found - over).abs() < 1e-12 || over < 0.0 && found < 0.0, "{p:?} {found}");
        }
        assert!(band.over_floor(corner, -9.0) < -1.0);
        band.foot = 1.0;
        assert!((band.over_floor(dvec2(20.0, 7.0), -9.0) - 2.0).abs() < 1e-12);
        band.tabs.push(TabPlace { at: dvec2(20.0, 5.0), radius: 8.0, top: -3.0 });
        assert!(band.over_floor(dvec2(20.0, 7.0), -9.0).is_nan());
        assert!(
            band.compared(dvec2(20.0, 0.1), -4.0).is_nan() && band.compared(dvec2(20.0, 0.1), -2.0) > 0.0
        );
    }
}
