//! Measures of a contour, in closed form.
//!
//! By Pappus and Guldin volume and surface are integrals along the contour: the surface 2 pi int x ds, the volume
//! pi int x^2 dz over the whole way from the axis to the axis. A line gives a frustum; an arc of centre (a, c), signed
//! radius r and normal angle phi has x = a + r cos phi, dz = r cos phi dphi and ds = |r dphi|.

use std::f64::consts::PI;

use glam::DVec2;

use super::check::edge_of;
use super::{Contour, ContourShape, DOWN};

impl Contour {
    /// Volume of the tool [mm3].
    ///
    /// ```
    /// # use kinecut_geom as kinecut;
    /// use kinecut::tool::{Contour, ContourElement, DOWN, ElementRole, UP};
    /// let ball = ContourElement::arc([0.0, 5.0], 5.0, DOWN, UP, ElementRole::Cutting);
    /// let ball = Contour::new(vec![ball]).unwrap();
    /// assert!((ball.volume() - 4.0 / 3.0 * std::f64::consts::PI * 125.0).abs() < 1e-12 * ball.volume());
    /// assert!((ball.surface() - 100.0 * std::f64::consts::PI).abs() < 1e-12 * ball.surface());
    /// ```
    pub fn volume(&self) -> f64 {
        self.elements.iter().map(|e| volume(&e.shape)).sum()
    }

    /// Area of the surface of the tool [mm2].
    pub fn surface(&self) -> f64 {
        self.elements.iter().map(|e| surface(&e.shape)).sum()
    }

    /// Largest radius [mm].
    pub fn largest_radius(&self) -> f64 {
        self.elements.iter().map(|e| edge_of(&e.shape).extent(DVec2::X)[1]).fold(0.0, f64::max)
    }

    /// Lowest and highest height [mm].
    pub fn extent(&self) -> [f64; 2] {
        let extents = self.elements.iter().map(|e| edge_of(&e.shape).extent(DVec2::Y));
        extents.fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], [a, b]| [low.min(a), high.max(b)])
    }

    /// The radii within the tool at a height, from the axis outwards [mm]; several where it is hollow or undercut. At the
    /// height of a face, those just above it.
    ///
    /// ```
    /// # use kinecut_geom as kinecut;
    /// use kinecut::tool::{Contour, ContourElement, DOWN, ElementRole, UP};
    /// let ball = Contour::new(vec![ContourElement::arc([0.0, 5.0], 5.0, DOWN, UP, ElementRole::Cutting)]).unwrap();
    /// assert_eq!(ball.radii_at(1.0), [[0.0, 3.0]]);
    /// assert!(ball.radii_at(10.5).is_empty());
    /// ```
    pub fn radii_at(&self, height: f64) -> Vec<[f64; 2]> {
        // Half-open stretches of heights: where the way goes up material ends, where it goes down it begins.
        let mut borders: Vec<f64> = Vec::new();
        for element in &self.elements {
            crossings(&element.shape, height, &mut borders);
        }
        if (self.bottom()..self.height()).contains(&height) {
            borders.push(0.0);
        }
        borders.sort_by(f64::total_cmp);
        borders.chunks_exact(2).map(|pair| [pair[0], pair[1]]).filter(|[a, b]| b > a).collect()
    }

    /// Points along the contour, ends of elements among them, whose chords lie within `tolerance` [mm] of it.
    pub fn points(&self, tolerance: f64) -> Vec<DVec2> {
        let mut points: Vec<DVec2> = self.elements.first().map(|e| e.shape.start()).into_iter().collect();
        for element in &self.elements {
            points.extend(element.shape.chords(tolerance));
        }
        points
    }
}

/// Fewest and most chords of an arc in a drawing.
const CHORDS: [f64; 2] = [2.0, 4096.0];

impl ContourShape {
    /// The ends of chords along it, without its start, within `tolerance` [mm] of it.
    pub fn chords(&self, tolerance: f64) -> Vec<DVec2> {
        let ContourShape::Arc { radius, convex, centre, from, to } = *self else { return vec![self.end()] };
        // The sagitta of a chord of the angle a is r (1 - cos(a / 2)).
        let share = (tolerance / radius).clamp(0.0, 1.0);
        let angle = 2.0 * (1.0 - share).acos();
        let count = ((to - from).abs() / angle).ceil().clamp(CHORDS[0], CHORDS[1]);
        let count = if count.is_finite() { count as u32 } else { CHORDS[1] as u32 };
        let at = |i: u32| from + (to - from) * f64::from(i) / f64::from(count);
        (1..=count).map(|i| super::element::on_arc(centre, radius, convex, at(i))).collect()
    }
}

/// Volume between an element and the axis, negative where the way goes down [mm3].
fn volume(shape: &ContourShape) -> f64 {
    match *shape {
        ContourShape::Line { start, end } => {
            PI / 3.0 * (end.y - start.y) * (start.x * start.x + start.x * end.x + end.x * end.x)
        }
        ContourShape::Arc { centre, radius, convex, from, to } => {
            // pi int (a + r cos)^2 r cos dphi, with the sine and its powers taken between the ends.
            let r = if convex { radius } else { -radius };
            let a = centre.x;
            let (sin, sin2) = (difference(from, to, f64::sin), difference(from, to, |p| (2.0 * p).sin()));
            let sin3 = difference(from, to, |p| p.sin().powi(3));
            PI * r * (a * a * sin + a * r * ((to - from) + 0.5 * sin2) + r * r * (sin - sin3 / 3.0))
        }
    }
}

/// Area of the surface of an element [mm2].
fn surface(shape: &ContourShape) -> f64 {
    match *shape {
        ContourShape::Line { start, end } => PI * (start.x + end.x) * start.distance(end),
        ContourShape::Arc { centre, radius, convex, from, to } => {
            let r = if convex { radius } else { -radius };
            let (along, sense) = ((to - from).abs(), (to - from).signum());
            2.0 * PI * radius * (centre.x * along + r * sense * difference(from, to, f64::sin))
        }
    }
}

fn difference(from: f64, to: f64, f: impl Fn(f64) -> f64) -> f64 {
    f(to) - f(from)
}

/// The radii at which a way crosses a height; each stretch of heights without its upper end.
fn crossings(shape: &ContourShape, height: f64, out: &mut Vec<f64>) {
    match *shape {
        ContourShape::Line { start, end } => {
            if (start.y <= height) != (end.y <= height) {
                out.push(start.x + (end.x - start.x) * ((height - start.y) / (end.y - start.y)));
            }
        }
        ContourShape::Arc { centre, radius, convex, from, to } => {
            // Cut where the arc is highest and lowest: each part rises or falls.
            let mut cuts = vec![from];
            let (low, high) = if from < to { (from, to) } else { (to, from) };
            // Normals along the axis: -pi/2 + k pi.
            let mut k = ((low - DOWN) / PI).floor() + 1.0;
            let mut inside = Vec::new();
            while DOWN + k * PI < high {
                inside.push(DOWN + k * PI);
                k += 1.0;
            }
            if from > to {
                inside.reverse();
            }
            cuts.extend(inside);
            cuts.push(to);
            let at = |phi: f64| super::element::on_arc(centre, radius, convex, phi);
            for pair in cuts.windows(2) {
                let (a, b) = (at(pair[0]), at(pair[1]));
                if (a.y <= height) != (b.y <= height) {
                    let h = height - centre.y;
                    let half = ((radius - h) * (radius + h)).max(0.0).sqrt();
                    // The side of the circle on which the part lies.
                    let middle = at(0.5 * (pair[0] + pair[1]));
                    out.push(centre.x + half.copysign(middle.x - centre.x));
                }
            }
        }
    }
}
