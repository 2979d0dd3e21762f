//! Splines of LinuxCNC: `G5.1`, and `G5.2` to `G5.3`.
//!
//! `G5.1` is a quadratic Bezier curve, which is a cubic one. `G5.2` gives control points with their weights `P` and once the
//! order `L` (3 without it), the present position is the first point; `G5.3` runs the curve. Its knots are whole numbers, those of
//! both ends repeated. Between two knots the curve is a quotient of polynomials: of equal weights and up to the fourth order a
//! cubic, otherwise it is followed by cubics that have its points and directions, within 10 nm.
//!
//! The control itself runs splines as arcs, two to a step of the parameter: by how much they leave the curve is not followed.

use glam::{DVec2, DVec3};

use crate::base::{Code as FindingCode, Result};
use crate::geom::CubicSpan;
use crate::nc::dialect::{AXES, Code, OFFSETS, Plane};
use crate::program::{Comp, Path, Speed};

use super::block::Word;
use super::place::Bytes;
use super::reader::{Reader, take};

/// Order without `L`, and the largest.
const USUAL_ORDER: usize = 3;
pub(super) const LARGEST_ORDER: u32 = 32;
/// Distance of the cubics from the curve at three places between their ends [mm].
const WITHIN: f64 = 1e-5;
/// Halvings of a span until then at most.
const HALVINGS: u32 = 16;
/// Most cubics of a spline.
const MOST_CUBICS: usize = 100_000;

/// A spline whose control points are being given: place [mm] and weight.
#[derive(Clone, Debug)]
pub(super) struct Nurbs {
    pub(super) order: usize,
    pub(super) points: Vec<(DVec2, f64)>,
    /// Its knots; none are whole numbers.
    pub(super) knots: Vec<f64>,
}

impl Nurbs {
    /// One with knots of its own, that has none yet.
    pub(super) fn with_knots(order: usize) -> Nurbs {
        Nurbs { order, points: Vec::new(), knots: Vec::new() }
    }

    /// The knot of a number: without knots of its own whole numbers, those of the ends as often as the order.
    fn knot(&self, i: usize) -> f64 {
        if let Some(knot) = self.knots.get(i) {
            return *knot;
        }
        let last = self.points.len() - self.order + 1;
        (i + 1).saturating_sub(self.order).min(last) as f64
    }

    /// Place and direction at a parameter of the span that begins at a knot.
    fn at(&self, span: usize, u: f64) -> (DVec2, DVec2) {
        let degree = self.order - 1;
        let homogeneous = |(p, w): &(DVec2, f64)| DVec3::new(p.x * w, p.y * w, *w);
        let mut d: Vec<DVec3> = self.points[span - degree..=span].iter().map(homogeneous).collect();
        let mut slope = DVec3::ZERO;
        for level in 1..=degree {
            if level == degree {
                slope = (d[degree] - d[degree - 1]) * degree as f64 / (self.knot(span + 1) - self.knot(span));
            }
            for j in (level..=degree).rev() {
                let i = span - degree + j;
                let (from, to) = (self.knot(i), self.knot(i + degree + 1 - level));
                d[j] = d[j - 1].lerp(d[j], (u - from) / (to - from));
            }
        }
        let (p, w) = (d[degree].truncate(), d[degree].z);
        (p / w, (slope.truncate() - p / w * slope.z) / w)
    }

    /// The curve as cubics, [`MOST_CUBICS`] and a few at most.
    fn cubics(&self) -> Vec<[DVec2; 4]> {
        let mut cubics = Vec::new();
        for span in self.order - 1..self.points.len() {
            let (from, to) = (self.knot(span), self.knot(span + 1));
            if to > from {
                self.piece(span, from, to, HALVINGS, &mut cubics);
            }
        }
        cubics
    }

    fn piece(&self, span: usize, from: f64, to: f64, halvings: u32, cubics: &mut Vec<[DVec2; 4]>) {
        if cubics.len() > MOST_CUBICS {
            return;
        }
        let ((a, at_a), (b, at_b)) = (self.at(span, from), self.at(span, to));
        let third = (to - from) / 3.0;
        let cubic = [a, a + at_a * third, b - at_b * third, b];
        let off = |t: f64| {
            let s = 1.0 - t;
            let place = cubic[0] * (s * s * s)
                + cubic[1] * (3.0 * s * s * t)
                + cubic[2] * (3.0 * s * t * t)
                + cubic[3] * (t * t * t);
            place.distance(self.at(span, from + (to - from) * t).0)
        };
        if halvings == 0 || [0.25, 0.5, 0.75].into_iter().all(|t| off(t) <= WITHIN) {
            cubics.push(cubic);
            return;
        }
        let middle = 0.5 * (from + to);
        self.piece(span, from, middle, halvings - 1, cubics);
        self.piece(span, middle, to, halvings - 1, cubics);
    }
}

impl<'s> Reader<'s> {
    /// `G5.1`: control point of a parabola.
    pub(super) fn quadratic(&mut self, words: &mut [Word<'s>]) -> Result<()> {
        let speed = self.spline_speed(words)?;
        let here = self.here.clone();
        let start = self.start()?.truncate();
        let said = self.end(words)?;
        let unit = self.modal.length_unit;
        let [Some(i), Some(j)] = [OFFSETS[0], OFFSETS[1]].map(|o| take(words, o).map(|v| v.value * unit))
        else {
            return Err(self.lacks(&here, "G5.1 without I and J").help("program both").into());
        };
        let [x, y, _] = said.map(|v| v.unwrap_or(f64::NAN));
        let (control, end) = (start + DVec2::new(i, j), DVec2::new(x, y));
        self.push_cubic([start, start.lerp(control, 2.0 / 3.0), end.lerp(control, 2.0 / 3.0), end], speed)
    }

    /// A block of `G5.2`: a control point.
    pub(super) fn control_point(&mut self, words: &mut [Word<'s>]) -> Result<()> {
        self.spline_speed(words)?;
        let here = self.here.clone();
        let start = self.start()?.truncate();
        let weight = take(words, "P");
        let order = take(words, "L");
        let given = [AXES[0], AXES[1]].map(|axis| words.iter().any(|w| !w.used && w.is(axis)));
        let first = self.nurbs.is_none();
        if let Some(weight) = weight.as_ref().filter(|w| w.value <= 0.0) {
            let finding = self.place.malformed(&weight.bytes, "the weight of a control point is positive");
            return Err(finding.into());
        }
        let own = |place: DVec2, weight: f64| (place, weight);
        let mut nurbs = self.nurbs.take().unwrap_or_else(|| Nurbs {
            order: USUAL_ORDER,
            points: vec![own(start, 1.0)],
            knots: Vec::new(),
        });
        if let Some(order) = order {
            let order = self.count(&order, "the order of a spline").and_then(|n| match n {
                0..=LARGEST_ORDER => Ok(n as usize),
                _ => Err(self
                    .place
                    .malformed(&here, "the order of a spline is out of range")
                    .value(f64::from(n), "")
                    .bound(f64::from(LARGEST_ORDER), "")
                    .into()),
            })?;
            nurbs.order = nurbs.order.max(order);
        }
        match (given, weight) {
            ([true, true], Some(weight)) => {
                let last = nurbs.points.last().map_or(start, |p| p.0);
                // Increments count from the control point before.
                self.modal.position = [Some(last.x), Some(last.y), self.modal.position[2]];
                let end = self.end(words)?;
                self.modal.position = [Some(start.x), Some(start.y), end[2]];
                let [x, y, _] = end.map(|v| v.unwrap_or(f64::NAN));
                nurbs.points.push(own(DVec2::new(x, y), weight.value));
            }
            ([false, false], Some(weight)) if first => nurbs.points[0].1 = weight.value,
            ([true, true], None) => {
                return Err(self.lacks(&here, "a control point without its weight P").into());
            }
            _ => return Err(self.lacks(&here, "a control point needs both X and Y").into()),
        }
        self.nurbs = Some(nurbs);
        Ok(())
    }

    /// `G5.3` and `G6.3`: runs the spline.
    pub(super) fn run_spline(&mut self, bytes: &Bytes) -> Result<()> {
        let Some(nurbs) = self.nurbs.take() else {
            return Err(self
                .lacks(bytes, "a spline without control points")
                .help("program G5.2 or G6.2")
                .into());
        };
        if nurbs.points.len() < nurbs.order {
            let finding = self.lacks(bytes, "a spline has fewer control points than its order");
            return Err(finding
                .value(nurbs.points.len() as f64, "points")
                .bound(nurbs.order as f64, "points")
                .into());
        }
        self.check_knots(&nurbs, bytes)?;
        let speed = self.feed_speed()?;
        self.note("LinuxCNC runs a spline as arcs of its own choice: the spline itself is followed");
        let cubics = nurbs.cubics();
        if cubics.len() > MOST_CUBICS {
            let finding = self.lacks(bytes, "a spline needs more cubics than are followed");
            let finding = finding.bound(MOST_CUBICS as f64, "cubics");
            return Err(finding.help("divide it, or give weights that are nearer to one another").into());
        }
        for cubic in cubics {
            self.push_cubic(cubic, speed)?;
        }
        Ok(())
    }

    fn push_cubic(&mut self, points: [DVec2; 4], speed: Speed) -> Result<()> {
        let here = self.here.clone();
        let span = CubicSpan::new(points);
        let span = span.map_err(|e| e.0.at(self.place.sources.locate(self.place.span(&here))))?;
        let end = [Some(points[3].x), Some(points[3].y), self.modal.position[2]];
        self.push_tip(end, Path::Bezier { span }, speed);
        Ok(())
    }

    /// Feed of a spline, which runs in XY without compensation.
    pub(super) fn spline_speed(&mut self, words: &[Word<'s>]) -> Result<Speed> {
        let here = self.here.clone();
        if self.modal.comp != Comp::Off {
            return Err(self.while_on(&here).into());
        }
        if self.modal.plane != Plane::Xy {
            let finding = self.place.error(FindingCode::NC_ARC, &here, "a spline runs in G17 only");
            return Err(finding.help("program G17").into());
        }
        if let Some(z) = words.iter().find(|w| !w.used && w.is(AXES[2])) {
            let finding = self.place.error(FindingCode::NC_ARC, &z.bytes, "a spline moves X and Y only");
            return Err(finding.help("move Z in a block of its own").into());
        }
        self.feed_speed()
    }

    /// Whether the motion in force gives control points.
    pub(super) fn gives_points(&self) -> bool {
        matches!(self.modal.motion, Some(Code::ControlPoint | Code::KnotRow))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn nurbs(order: usize, points: &[(f64, f64, f64)]) -> Nurbs {
        let points = points.iter().map(|(x, y, w)| (DVec2::new(*x, *y), *w)).collect();
        Nurbs { order, points, knots: Vec::new() }
    }

    #[test]
    fn a_quarter_of_a_circle_is_one_of_third_order() {
        let arc = nurbs(3, &[(1.0, 0.0, 1.0), (1.0, 1.0, 0.5f64.sqrt()), (0.0, 1.0, 1.0)]);
        for i in 0..=10 {
            let (place, slope) = arc.at(2, f64::from(i) / 10.0);
            assert!((place.length() - 1.0).abs() < 1e-12 && place.dot(slope).abs() < 1e-12, "{i}");
        }
        let cubics = arc.cubics();
        for [a, b, c, d] in cubics {
            let middle = (a + 3.0 * b + 3.0 * c + d) / 8.0;
            assert!((middle.length() - 1.0).abs() < WITHIN && (d.length() - 1.0).abs() < 1e-12);
        }
    }

    #[test]
    fn spans_of_equal_weights_are_cubics_as_they_are() {
        let four = nurbs(4, &[(0.0, 0.0, 1.0), (1.0, 2.0, 1.0), (3.0, 2.0, 1.0), (4.0, 0.0, 1.0)]);
        let cubics = four.cubics();
        assert_eq!(cubics.len(), 1);
        let expected = [DVec2::ZERO, DVec2::new(1.0, 2.0), DVec2::new(3.0, 2.0), DVec2::new(4.0, 0.0)];
        assert!(cubics[0].iter().zip(expected).all(|(a, b)| a.distance(b) < 1e-12), "{cubics:?}");
        // Six points of third order: four parabolas that meet half way between inner points.
        let six = nurbs(
            3,
            &[
                (0.0, 0.0, 1.0),
                (1.0, 1.0, 1.0),
                (2.0, 0.0, 1.0),
                (3.0, 1.0, 1.0),
                (4.0, 0.0, 1.0),
                (5.0, 1.0, 1.0),
            ],
        );
        let cubics = six.cubics();
        assert_eq!(cubics.len(), 4);
        assert!(
            cubics[0][3].distance(DVec2::new(1.5, 0.5)) < 1e-12
                && cubics[3][3].distance(DVec2::new(5.0, 1.0)) < 1e-12
        );
    }
}
