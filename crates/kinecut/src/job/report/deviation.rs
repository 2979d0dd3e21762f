//! Deviation of the cut part in graded bands: the legend of the 3-D view and the table beside it.

use super::PartView;

/// Borders of the bands in units of the tolerance. Between -1 and 1 the part is within tolerance.
pub const BAND_EDGES: [f64; 8] = [-5.0, -2.0, -1.0, -0.5, 0.5, 1.0, 2.0, 5.0];

/// One band of deviation and the area of part that lies in it.
#[derive(Clone, Debug, PartialEq)]
pub struct Band {
    /// Lower border [mm]; minus infinity for the first band.
    pub from: f64,
    /// Upper border [mm]; infinity for the last band.
    pub to: f64,
    /// Area [mm^2].
    pub area: f64,
    /// Share of the area that was compared, 0 to 1.
    pub share: f64,
}

/// The bands from the deepest gouge to the most stock left, with their areas; empty when nothing was compared or the
/// tolerance is not positive. Each vertex has the weight of a third of the area of its triangles. A triangle counts
/// when all its vertices were compared: a face beside the wanted surface shares some with it.
pub fn bands(part: &PartView) -> Vec<Band> {
    let tolerance = f64::from(part.tolerance);
    if !(tolerance > 0.0 && tolerance.is_finite()) || extremes(part).is_none() {
        return Vec::new();
    }
    let mut areas = [0.0; BAND_EDGES.len() + 1];
    for triangle in &part.triangles {
        let Some(third) = area(part, triangle).map(|a| a / 3.0) else { continue };
        let at = triangle.map(|v| part.deviation.get(v as usize).map_or(f64::NAN, |&d| f64::from(d)));
        if at.iter().all(|d| d.is_finite()) {
            for d in at {
                areas[BAND_EDGES.partition_point(|&e| e * tolerance < d)] += third;
            }
        }
    }
    let total: f64 = areas.iter().sum();
    let edge = |i: usize| BAND_EDGES[i] * tolerance;
    (0..areas.len())
        .map(|i| Band {
            from: if i == 0 { f64::NEG_INFINITY } else { edge(i - 1) },
            to: if i == BAND_EDGES.len() { f64::INFINITY } else { edge(i) },
            area: areas[i],
            share: if total > 0.0 { areas[i] / total } else { 0.0 },
        })
        .collect()
}

/// The least and the greatest deviation [mm]; `None` when nothing was compared.
pub fn extremes(part: &PartView) -> Option<(f64, f64)> {
    let finite =
        part.deviation.iter().take(part.vertices.len()).map(|&d| f64::from(d)).filter(|d| d.is_finite());
    finite.fold(None, |e, d| Some(e.map_or((d, d), |(lo, hi): (f64, f64)| (lo.min(d), hi.max(d)))))
}

fn area(part: &PartView, triangle: &[u32; 3]) -> Option<f64> {
    let mut p = [glam::DVec3::ZERO; 3];
    for (p, &i) in p.iter_mut().zip(triangle) {
        *p = glam::Vec3::from_array(*part.vertices.get(i as usize)?).as_dvec3();
    }
    let area = (p[1] - p[0]).cross(p[2] - p[0]).length() / 2.0;
    area.is_finite().then_some(area)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Triangles of area 6 (0.03 mm too deep), 12 (a corner unknown) and 12 (within tolerance, one corner outside it).
    fn part() -> PartView {
        PartView {
            vertices: vec![
                [0., 0., 0.],
                [3., 0., 0.],
                [0., 4., 0.],
                [0., 0., 5.],
                [6., 0., 5.],
                [0., 4., 5.],
                [0., -4., 5.],
            ],
            triangles: vec![[0, 1, 2], [3, 4, 5], [3, 4, 6], [0, 1, 99]],
            deviation: vec![-0.03, -0.03, -0.03, 0.001, 0.0, f32::NAN, 0.021],
            tolerance: 0.02,
            relative: false,
        }
    }

    #[test]
    fn areas_are_those_of_the_triangles_and_unknown_ones_do_not_count() {
        let bands = bands(&part());
        let areas: Vec<f64> = bands.iter().map(|b| b.area).collect();
        assert_eq!(areas, [0.0, 0.0, 6.0, 0.0, 8.0, 0.0, 4.0, 0.0, 0.0]);
        assert!((bands[2].share - 6.0 / 18.0).abs() < 1e-12);
        let (from, to) = (bands[2].from, bands[2].to);
        assert!((from + 0.04).abs() < 1e-8 && (to + 0.02).abs() < 1e-8, "{from} {to}");
    }

    #[test]
    fn extremes_skip_what_was_not_compared() {
        let (lo, hi) = extremes(&part()).unwrap();
        assert!((lo + 0.03).abs() < 1e-8 && (hi - 0.021).abs() < 1e-8);
        let nothing = PartView { deviation: Vec::new(), ..part() };
        assert!(extremes(&nothing).is_none() && super::bands(&nothing).is_empty());
    }
}
