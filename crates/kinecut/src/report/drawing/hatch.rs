//! Hatching: parallel lines at 45 degrees inside closed outlines, by even and odd crossings.

/// The lines inside an outline, from lower left to upper right, `distance` apart; outlines of one picture share their
/// lines, so that neighbours look alike. Coordinates as the outline's, y downwards.
pub(super) fn lines(outline: &[[f64; 2]], distance: f64) -> Vec<[[f64; 2]; 2]> {
    let mut found = Vec::new();
    if outline.len() < 3 || outline.iter().flatten().any(|v| !v.is_finite()) || !(distance > 0.0) {
        return found;
    }
    // Across the lines p = x + y, along them q = x - y.
    let turned: Vec<[f64; 2]> = outline.iter().map(|p| [p[0] + p[1], p[0] - p[1]]).collect();
    let across = distance * std::f64::consts::SQRT_2;
    let low = turned.iter().map(|p| p[0]).fold(f64::INFINITY, f64::min);
    let high = turned.iter().map(|p| p[0]).fold(f64::NEG_INFINITY, f64::max);
    let (first, last) = ((low / across).ceil() as i64, (high / across).floor() as i64);
    let mut crossings = Vec::new();
    for n in first..=last {
        let p = n as f64 * across;
        crossings.clear();
        for (i, a) in turned.iter().enumerate() {
            let b = turned[(i + 1) % turned.len()];
            // Half open: a corner on the line counts once.
            if (a[0] <= p) != (b[0] <= p) {
                crossings.push(a[1] + (b[1] - a[1]) * (p - a[0]) / (b[0] - a[0]));
            }
        }
        crossings.sort_unstable_by(f64::total_cmp);
        for pair in crossings.chunks_exact(2) {
            found.push([0, 1].map(|i| [(p + pair[i]) / 2.0, (p - pair[i]) / 2.0]));
        }
    }
    found
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_square_is_hatched_over_its_area() {
        let square = [[0.0, 0.0], [10.0, 0.0], [10.0, 10.0], [0.0, 10.0]];
        let lines = lines(&square, 0.05);
        let length: f64 = lines.iter().map(|[a, b]| (a[0] - b[0]).hypot(a[1] - b[1])).sum();
        assert!((length * 0.05 - 100.0).abs() < 0.1, "{length}");
        assert!(lines.iter().flatten().flatten().all(|v| (-1e-9..10.0 + 1e-9).contains(v)));
    }

    #[test]
    fn what_has_no_area_has_no_lines() {
        assert!(lines(&[[0.0, 0.0], [1.0, 1.0]], 1.0).is_empty());
        assert!(lines(&[[0.0, 0.0], [f64::NAN, 1.0], [3.0, 0.0]], 1.0).is_empty());
    }
}
