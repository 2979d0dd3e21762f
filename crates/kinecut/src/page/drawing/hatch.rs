//! Hatching: parallel lines at 45 degrees inside closed outlines, by even and odd crossings.

/// Most lines: beyond this a drawing is out of all proportion.
const MOST: f64 = 1e5;

/// The lines inside closed outlines, from lower left to upper right, `distance` apart; an outline within another is a hole
/// in it. Coordinates as the outlines', y downwards.
pub(crate) fn lines(outlines: &[Vec<[f64; 2]>], distance: f64) -> Vec<[[f64; 2]; 2]> {
    let mut found = Vec::new();
    // Across the lines p = x + y, along them q = x - y.
    let turned: Vec<Vec<[f64; 2]>> = outlines
        .iter()
        .filter(|o| o.len() > 2 && o.iter().flatten().all(|v| v.is_finite()))
        .map(|o| o.iter().map(|p| [p[0] + p[1], p[0] - p[1]]).collect())
        .collect();
    let across = distance * std::f64::consts::SQRT_2;
    let all = || turned.iter().flatten().map(|p| p[0]);
    let (low, high) = (all().fold(f64::INFINITY, f64::min), all().fold(f64::NEG_INFINITY, f64::max));
    if !(distance > 0.0 && high - low < MOST * across) {
        return found;
    }
    let (first, last) = ((low / across).ceil() as i64, (high / across).floor() as i64);
    let mut crossings = Vec::new();
    for n in first..=last {
        let p = n as f64 * across;
        crossings.clear();
        for outline in &turned {
            for (i, a) in outline.iter().enumerate() {
                let b = outline[(i + 1) % outline.len()];
                // Half open: a corner on the line counts once.
                if (a[0] <= p) != (b[0] <= p) {
                    crossings.push(a[1] + (b[1] - a[1]) * (p - a[0]) / (b[0] - a[0]));
                }
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
    fn a_square_is_hatched_over_its_area_without_the_hole_in_it() {
        let square = [[0.0, 0.0], [10.0, 0.0], [10.0, 10.0], [0.0, 10.0]];
        let lines = lines(&[square.to_vec(), vec![[2.0, 2.0], [4.0, 2.0], [4.0, 4.0]]], 0.05);
        let length: f64 = lines.iter().map(|[a, b]| (a[0] - b[0]).hypot(a[1] - b[1])).sum();
        assert!((length * 0.05 - 98.0).abs() < 0.1, "{length}");
        assert!(lines.iter().flatten().flatten().all(|v| (-1e-9..10.0 + 1e-9).contains(v)));
    }

    #[test]
    fn what_has_no_area_has_no_lines() {
        assert!(lines(&[vec![[0.0, 0.0], [1.0, 1.0]]], 1.0).is_empty());
        assert!(lines(&[vec![[0.0, 0.0], [f64::NAN, 1.0], [3.0, 0.0]]], 1.0).is_empty());
    }
}
