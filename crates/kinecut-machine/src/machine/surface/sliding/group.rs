//! The sliding group of a sampled surface.
//!
//! A twist (w, v) slides a surface in itself when `n . (w x p + v) = 0` at every point p with normal n. Twists are
//! compared by the root mean square of their normal speed over all samples per that of their whole speed: the mean sine
//! of the angle at which they leave the surface. Its extreme values and twists are the singular values and vectors of
//! the normal speeds relative to the speeds (two triangles of rows, nothing squared). An error of the normals by some
//! angle [rad] so shows as a value of that size, whatever the proportions of the surface.
//!
//! The twists that slide are then named, the simplest motion first: a screw whose advance does not matter within the
//! tolerance is a rotation, one whose turning does not matter a translation.

use glam::DVec3;

use super::{Sample, Slide};
use crate::base::{Code, Finding, Result};
use crate::num::singular::Triangle;

/// Sine of the angle to the surface that is rounding of exact samples.
const EXACT: f64 = 1e-8;

/// Kind of the surface that a sliding group belongs to.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Form {
    /// No motion: a surface of its own shape everywhere.
    General,
    /// One translation: a general cylinder.
    Extrusion,
    /// One rotation.
    Revolution,
    /// One screw: thread, helical flank.
    Screw,
    /// A rotation and the translation along its axis.
    Cylinder,
    /// Two translations and the rotation between them.
    Plane,
    /// All rotations about a point.
    Sphere,
}

impl Form {
    /// The name in words.
    pub fn name(self) -> &'static str {
        match self {
            Form::General => "general surface",
            Form::Extrusion => "extrusion",
            Form::Revolution => "surface of revolution",
            Form::Screw => "screw surface",
            Form::Cylinder => "circular cylinder",
            Form::Plane => "plane",
            Form::Sphere => "sphere",
        }
    }

    /// Number of independent motions.
    pub fn dimension(self) -> usize {
        match self {
            Form::General => 0,
            Form::Extrusion | Form::Revolution | Form::Screw => 1,
            Form::Cylinder => 2,
            Form::Plane | Form::Sphere => 3,
        }
    }
}

/// The motions by which a surface slides in itself.
#[derive(Clone, Debug, PartialEq)]
pub struct SlidingGroup {
    /// Kind of the surface.
    pub form: Form,
    /// Independent motions, as many as the dimension: of a plane two translations and a rotation, of a sphere three
    /// rotations, of a cylinder the rotation and the translation.
    pub slides: Vec<Slide>,
    /// Mean sines of the angles at which the six principal twists leave the surface, falling; the last ones slide.
    pub spectrum: [f64; 6],
    /// Sine up to which a twist counts as sliding.
    pub tolerance: f64,
}

/// The group of sampled points and normals. `noise` is the root mean square of the angle by which the normals may be
/// wrong [rad]: 0 for samples of formulas.
///
/// # Errors
/// `KC1109` for fewer than six samples, numbers that are not finite, or points that all lie in one place or on a line.
pub fn sliding_group(samples: &[Sample], noise: f64) -> Result<SlidingGroup> {
    let mut fit = Fit::new(samples)?;
    fit.tolerance = noise.max(EXACT);
    Ok(fit.named())
}

/// Rows per triangle that is built on its own; the triangles are joined in their order, whatever made them.
const CHUNK: usize = 4096;

/// Normal speeds and speeds of all samples, in coordinates about their middle and in units of their size.
pub(in super::super) struct Fit {
    normal_speed: Triangle<6>,
    speed: Triangle<6>,
    relative: Triangle<6>,
    middle: DVec3,
    size: f64,
    normal: DVec3,
    root_weight: f64,
    /// Sine up to which a twist counts as sliding.
    pub(in super::super) tolerance: f64,
}

fn fault(what: &str) -> crate::base::Error {
    Finding::error(Code::SURFACE_SAMPLES, what).help("sample the surface in both directions").into()
}

impl Fit {
    pub(in super::super) fn new(samples: &[Sample]) -> Result<Fit> {
        let finite =
            samples.iter().all(|s| s.point.is_finite() && s.normal.is_finite() && s.weight.is_finite());
        if !finite {
            return Err(fault("a sample has a number that is not finite"));
        }
        let weight: f64 = samples.iter().map(|s| s.weight).sum();
        if samples.len() < 6 || !(weight > 0.0) {
            return Err(Finding::error(Code::SURFACE_SAMPLES, "there are too few samples of the surface")
                .value(samples.len() as f64, "")
                .bound(6.0, "")
                .help("sample the surface more densely")
                .into());
        }
        let middle = samples.iter().map(|s| s.point * s.weight).sum::<DVec3>() / weight;
        let size = samples.iter().map(|s| s.point.distance(middle)).fold(0.0, f64::max);
        if !(size > 0.0) {
            return Err(fault("all points of the surface are in one place"));
        }
        let (mut normal_speed, mut speed) = (Triangle::<6>::default(), Triangle::<6>::default());
        for chunk in samples.chunks(CHUNK) {
            let (mut along_normal, mut whole) = (Triangle::<6>::default(), Triangle::<6>::default());
            for s in chunk {
                let root = s.weight.max(0.0).sqrt();
                let q = (s.point - middle) / size;
                let row = |n: DVec3| {
                    let [a, b, c] = q.cross(n).to_array();
                    [a, b, c, n.x, n.y, n.z].map(|x| x * root)
                };
                along_normal.push(row(s.normal));
                [DVec3::X, DVec3::Y, DVec3::Z].iter().for_each(|&axis| whole.push(row(axis)));
            }
            normal_speed.join(&along_normal);
            speed.join(&whole);
        }
        let normal = samples.iter().map(|s| s.normal * s.weight).sum();
        let relative = normal_speed
            .relative_to(&speed)
            .ok_or_else(|| fault("the points of the surface lie on one line, or all in one place"))?;
        let root_weight = weight.sqrt();
        Ok(Fit { normal_speed, speed, relative, middle, size, normal, root_weight, tolerance: EXACT })
    }

    /// Mean sines of the angles at which the six principal twists leave the surface, falling.
    pub(in super::super) fn spectrum(&self) -> [f64; 6] {
        self.relative.singular().0
    }

    /// Mean sine of the angle at which a twist about the middle, in units of the size, leaves the surface.
    fn leaves(&self, w: DVec3, v: DVec3) -> f64 {
        let x = [w.x, w.y, w.z, v.x, v.y, v.z];
        self.normal_speed.length(&x) / self.speed.length(&x)
    }

    fn slides_along(&self, w: DVec3, v: DVec3) -> bool {
        self.leaves(w, v) <= self.tolerance
    }

    /// A twist about the middle as a slide in space; the pitch is kept only if the twist needs it.
    fn turn(&self, w: DVec3, v: DVec3) -> Slide {
        let squared = w.length_squared();
        let pitch = w.dot(v) / squared;
        let point = self.middle + w.cross(v) / squared * self.size;
        let needed = !self.slides_along(w, v - w * pitch);
        Slide::Turn { axis: canonical(w), point, pitch: if needed { pitch * self.size } else { 0.0 } }
    }

    /// The group within the tolerance.
    pub(in super::super) fn named(&self) -> SlidingGroup {
        let (spectrum, vectors) = self.relative.singular();
        let twist = |k: usize| {
            let x = self.speed.solve(vectors[k]);
            (DVec3::new(x[0], x[1], x[2]), DVec3::new(x[3], x[4], x[5]))
        };
        let group = |form, slides| SlidingGroup { form, slides, spectrum, tolerance: self.tolerance };
        if spectrum[3] <= self.tolerance {
            let found = self.plane().or_else(|| self.sphere([twist(3), twist(4), twist(5)]));
            if let Some((form, slides)) = found {
                return group(form, slides);
            }
        }
        if spectrum[4] <= self.tolerance
            && let Some(slides) = self.cylinder([twist(4), twist(5)])
        {
            return group(Form::Cylinder, slides);
        }
        if spectrum[5] <= self.tolerance {
            let slide = self.single(twist(5));
            let form = match slide {
                Slide::Shift { .. } => Form::Extrusion,
                Slide::Turn { pitch: 0.0, .. } => Form::Revolution,
                Slide::Turn { .. } => Form::Screw,
            };
            return group(form, vec![slide]);
        }
        group(Form::General, Vec::new())
    }

    /// The principal motions that leave the surface by at most this mean sine, at least one, at most three.
    pub(in super::super) fn within(&self, sine: f64) -> Vec<Slide> {
        let (spectrum, vectors) = self.relative.singular();
        let slide = |k: usize| {
            let x = self.speed.solve(vectors[k]);
            let (w, v) = (DVec3::new(x[0], x[1], x[2]), DVec3::new(x[3], x[4], x[5]));
            // Without a rotation that could be told from a translation.
            if w.length() <= EXACT * v.length() { shift(v) } else { self.turn(w, v) }
        };
        [5, 4, 3].into_iter().filter(|&k| k == 5 || spectrum[k] <= sine).map(slide).collect()
    }

    /// Translations that slide, the best first: the singular vectors of the columns of translations.
    fn shifts(&self) -> [(f64, DVec3); 3] {
        let (values, vectors) = self.normal_speed.columns([3, 4, 5]).singular();
        [2, 1, 0].map(|k| (values[k] / self.root_weight, DVec3::from_array(vectors[k])))
    }

    fn plane(&self) -> Option<(Form, Vec<Slide>)> {
        let [(_, first), (second_speed, second), (_, normal)] = self.shifts();
        if second_speed > self.tolerance || !self.slides_along(normal, DVec3::ZERO) {
            return None;
        }
        let axis = if normal.dot(self.normal) < 0.0 { -normal } else { normal };
        let turn = Slide::Turn { axis, point: self.middle, pitch: 0.0 };
        Some((Form::Plane, vec![shift(first), shift(second), turn]))
    }

    /// The centre c has v = c x w for every twist of the null space, in the sense of least squares.
    fn sphere(&self, twists: [(DVec3, DVec3); 3]) -> Option<(Form, Vec<Slide>)> {
        let mut normal_matrix = glam::DMat3::ZERO;
        let mut right = DVec3::ZERO;
        for (w, v) in twists {
            // |c x w - v|^2: its gradient by c is (|w|^2 - w w^T) c - w x v.
            let outer = glam::DMat3::from_cols(w * w.x, w * w.y, w * w.z);
            normal_matrix += glam::DMat3::from_diagonal(DVec3::splat(w.length_squared())) - outer;
            right += w.cross(v);
        }
        let centre = normal_matrix.inverse() * right;
        let axes = [DVec3::X, DVec3::Y, DVec3::Z];
        let sphere = centre.is_finite() && axes.iter().all(|&w| self.slides_along(w, centre.cross(w)));
        let point = self.middle + centre * self.size;
        let slides = axes.map(|axis| Slide::Turn { axis, point, pitch: 0.0 });
        sphere.then(|| (Form::Sphere, slides.to_vec()))
    }

    fn cylinder(&self, twists: [(DVec3, DVec3); 2]) -> Option<Vec<Slide>> {
        let [(speed, along), ..] = self.shifts();
        if speed > self.tolerance {
            return None;
        }
        // Of the twists of the null space the one with the strongest rotation, freed from its advance.
        let [(w0, v0), (w1, v1)] = twists;
        let (w, v) = if w0.length() > w1.length() { (w0, v0) } else { (w1, v1) };
        let v = v - along * along.dot(v);
        let (w, squared) = (along * along.dot(w), along.dot(w).powi(2));
        let cylinder = squared > 0.0 && self.slides_along(w, v);
        let point = self.middle + w.cross(v) / squared * self.size;
        cylinder.then(|| vec![Slide::Turn { axis: canonical(along), point, pitch: 0.0 }, shift(along)])
    }

    fn single(&self, (w, v): (DVec3, DVec3)) -> Slide {
        let [(speed, along), ..] = self.shifts();
        if speed <= self.tolerance { shift(along) } else { self.turn(w, v) }
    }
}

fn shift(direction: DVec3) -> Slide {
    Slide::Shift { direction: canonical(direction) }
}

/// The unit vector along a direction whose largest component is positive, so that the same axis has the same name.
fn canonical(direction: DVec3) -> DVec3 {
    let unit = direction.normalize_or(DVec3::Z);
    let [x, y, z] = unit.to_array();
    // The last of nearly equal components decides, so that rounding does not.
    let nearly = 0.999;
    let lead = if z.abs() >= nearly * x.abs() && z.abs() >= nearly * y.abs() {
        z
    } else if y.abs() >= nearly * x.abs() {
        y
    } else {
        x
    };
    if lead < 0.0 { -unit } else { unit }
}
