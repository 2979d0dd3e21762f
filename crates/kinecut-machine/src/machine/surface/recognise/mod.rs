//! Recognition of the faces of a mesh or scan: which motions make them.
//!
//! A mesh is divided at its creases into smooth faces; each face is sampled at the middles of its inner edges
//! ([`faces`]) and named by its sliding group. The tolerance follows from the data: it lies in the widest gap between
//! twists that leave the face little and those that leave it much, below a cap from the angle between the facets. Samples far off, a dent or a blend, are set aside by reweighting and reported.

mod describe;
mod faces;
mod primitive;

pub use primitive::Primitive;

use faces::SmoothFace;

use super::sliding::Fit;
use super::{Form, Sample, Slide, SlidingGroup};
use crate::base::{Code, Finding, Result};
use crate::geom::Mesh;

/// Tolerances of the recognition of a mesh.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RecogniseOptions {
    /// Angle between neighbouring facets from which on their edge divides two faces [rad].
    pub crease: f64,
    /// Root mean square of the angle by which normals may be wrong, in addition to the error of coarse facets [rad].
    pub noise: f64,
    /// Greatest share of the area of a face that may be set aside as outliers.
    pub outliers: f64,
}

impl Default for RecogniseOptions {
    fn default() -> RecogniseOptions {
        RecogniseOptions { crease: 40_f64.to_radians(), noise: 2e-3, outliers: 0.3 }
    }
}

/// A smooth face of a mesh with its name.
#[derive(Clone, Debug, PartialEq)]
pub struct RecognisedFace {
    /// Its triangles, rising.
    pub triangles: Vec<u32>,
    /// Area [mm^2].
    pub area: f64,
    /// Motions by which it slides in itself.
    pub group: SlidingGroup,
    /// Its dimensions.
    pub primitive: Primitive,
    /// Root mean square and greatest angle by which the samples leave the motions of the group [rad], outliers apart.
    pub deviation: [f64; 2],
    /// Triangles that do not belong to the named surface, rising.
    pub outliers: Vec<u32>,
    /// Greatest angle between neighbouring facets that the name rests on [rad]: root mean square.
    pub bend: f64,
}

/// The faces of a mesh.
#[derive(Clone, Debug, PartialEq)]
pub struct Recognition {
    /// Faces with enough facets to tell, the greatest first.
    pub faces: Vec<RecognisedFace>,
    /// Area of the faces that are too small to tell [mm^2].
    pub unnamed_area: f64,
}

/// Least tolerance: the rounding of corners in files of single precision, over facets of a hundredth of the part [rad].
const FLOOR: f64 = 2e-5;
/// Error of the normal at the middle of an edge by the angle between its facets, for uneven facets.
const FACET: f64 = 0.2;
/// Greatest tolerance [rad]: with more than this a name would say nothing.
const CAP: f64 = 0.1;
/// A motion counts as simpler (a screw as rotation, a twist as translation) when it leaves the surface by at most this
/// factor more.
const GAP: f64 = 2.5;
/// Motions that leave a face with outliers by up to this multiple of the cap are tried as those of the rest.
const NEAR: f64 = 3.0;
/// Rounds of reweighting; weights settle after a few.
const ROUNDS: usize = 12;
/// Multiple of the median deviation from which on a sample is an outlier: beyond 3 standard deviations of noise.
const FAR: f64 = 5.0;

/// The faces of a mesh with their sliding motions.
///
/// # Errors
/// `KC1109` for a mesh without triangles, or with corners that are not finite or not there.
pub fn recognise(mesh: &Mesh, options: &RecogniseOptions) -> Result<Recognition> {
    let fault =
        |what: &str| Finding::error(Code::SURFACE_SAMPLES, what).help("give a mesh of finite triangles");
    let known =
        |t: &[u32; 3]| t.iter().all(|i| mesh.vertices.get(*i as usize).is_some_and(|v| v.is_finite()));
    if mesh.triangles.is_empty() || !mesh.triangles.iter().all(known) {
        return Err(fault("a mesh has no triangles, or corners that are not finite or not there").into());
    }
    let mut recognition = Recognition { faces: Vec::new(), unnamed_area: 0.0 };
    for face in faces::faces(mesh, options.crease) {
        match named(mesh, &face, options) {
            Some(found) => recognition.faces.push(found),
            None => recognition.unnamed_area += face.area,
        }
    }
    Ok(recognition)
}

fn named(mesh: &Mesh, face: &SmoothFace, options: &RecogniseOptions) -> Option<RecognisedFace> {
    let cap = options.noise.max(FACET * face.bend).clamp(FLOOR, CAP);
    let (mut group, exact) = group_of(Fit::new(&face.samples).ok()?, cap);
    let mut kept: Vec<usize> = (0..face.samples.len()).collect();
    if !exact && let Some((fit, remaining)) = without_outliers(face, cap, options) {
        let (clean, _) = group_of(fit, cap);
        // Outliers set aside must pay for themselves.
        if clean.form.dimension() > group.form.dimension() {
            (group, kept) = (clean, remaining);
        }
    }
    let used: Vec<Sample> = kept.iter().map(|&i| face.samples[i]).collect();
    let deviation = deviation(&group, &used);
    let mut is_kept = vec![false; mesh.triangles.len()];
    kept.iter().flat_map(|&i| face.sides[i]).for_each(|t| is_kept[t as usize] = true);
    let triangles_kept: Vec<u32> = face.triangles.iter().copied().filter(|&t| is_kept[t as usize]).collect();
    let outliers = match group.form {
        Form::General => Vec::new(),
        _ => face.triangles.iter().copied().filter(|&t| !is_kept[t as usize]).collect(),
    };
    let mut corners: Vec<u32> = triangles_kept.iter().flat_map(|&t| mesh.triangles[t as usize]).collect();
    corners.sort_unstable();
    corners.dedup();
    let points: Vec<glam::DVec3> = corners.iter().map(|&v| mesh.vertices[v as usize]).collect();
    let normal = used.iter().map(|s| s.normal * s.weight).sum::<glam::DVec3>().normalize_or_zero();
    // The sagitta of an arc by its radius is an eighth of the square of its angle; corners of good meshes lie closer.
    let coarse = 0.125 * face.bend.powi(2) + deviation[0];
    primitive::centred(&mut group, &points);
    let primitive = primitive::primitive(&group, &points, normal, coarse);
    let (triangles, area, bend) = (face.triangles.clone(), face.area, face.bend);
    Some(RecognisedFace { triangles, area, group, primitive, deviation, outliers, bend })
}

/// The group of a fit, and whether its motions are exact. Its dimension is the one with the widest gap between the
/// motions of the group and the next one, among those whose motions all stay below the cap.
fn group_of(mut fit: Fit, cap: f64) -> (SlidingGroup, bool) {
    let spectrum = fit.spectrum();
    let mut widest = (1.0, FLOOR);
    for dimension in 1..=3 {
        let (inner, outer) = (spectrum[6 - dimension], spectrum[5 - dimension]);
        let gap = outer / inner.max(FLOOR);
        if inner <= cap && gap > widest.0 {
            widest = (gap, inner);
        }
    }
    fit.tolerance = (GAP * widest.1).clamp(FLOOR, cap);
    (fit.named(), widest.1 <= FLOOR && spectrum[5] <= FLOOR)
}

/// Angle at which a slide leaves the surface at a sample [rad]; zero where the sample does not move.
fn angle(slide: &Slide, sample: &Sample) -> f64 {
    let speed = slide.velocity(sample.point);
    let sine = speed.try_normalize().map_or(0.0, |direction| direction.dot(sample.normal));
    sine.clamp(-1.0, 1.0).asin().abs()
}

/// Root mean square and greatest angle at which any motion of the group leaves the samples [rad].
fn deviation(group: &SlidingGroup, samples: &[Sample]) -> [f64; 2] {
    let worst = |s: &Sample| group.slides.iter().map(|slide| angle(slide, s)).fold(0.0, f64::max);
    let weight: f64 = samples.iter().map(|s| s.weight).sum();
    let square: f64 = samples.iter().map(|s| s.weight * worst(s).powi(2)).sum();
    [(square / weight.max(f64::MIN_POSITIVE)).sqrt(), samples.iter().map(worst).fold(0.0, f64::max)]
}

/// The fit without samples that are far off, and the samples that stay; `None` if no motion fits the rest, or too much
/// would be set aside.
fn without_outliers(face: &SmoothFace, cap: f64, options: &RecogniseOptions) -> Option<(Fit, Vec<usize>)> {
    let area: f64 = face.samples.iter().map(|s| s.weight).sum();
    let mut weighted = face.samples.clone();
    let mut off = vec![0.0; weighted.len()];
    for _ in 0..ROUNDS {
        let fit = Fit::new(&weighted).ok()?;
        let slides = fit.within(NEAR * cap);
        let worst = |s: &Sample| slides.iter().map(|slide| angle(slide, s)).fold(0.0, f64::max);
        off = face.samples.iter().map(worst).collect();
        let scale = median(&off).max(0.5 * cap);
        for ((sample, from), r) in weighted.iter_mut().zip(&face.samples).zip(&off) {
            // Geman and McClure: the influence of far samples vanishes.
            sample.weight = from.weight / (1.0 + (r / scale).powi(2)).powi(2);
        }
    }
    let bound = FAR * median(&off).max(0.2 * cap);
    let kept: Vec<usize> = (0..off.len()).filter(|&i| off[i] <= bound).collect();
    let rest: Vec<Sample> = kept.iter().map(|&i| face.samples[i]).collect();
    let set_aside = 1.0 - rest.iter().map(|s| s.weight).sum::<f64>() / area;
    let fit = Fit::new(&rest).ok()?;
    (set_aside <= options.outliers && fit.spectrum()[5] <= cap).then_some((fit, kept))
}

fn median(values: &[f64]) -> f64 {
    let mut sorted = values.to_vec();
    sorted.sort_by(f64::total_cmp);
    sorted.get(sorted.len() / 2).copied().unwrap_or(0.0)
}
