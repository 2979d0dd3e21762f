//! Polylines with fewer points, for drawing: no dropped point lies farther from the result than a tolerance.
//!
//! Method: Ramer, Douglas and Peucker, with a stack of its own instead of recursion. Its cost can grow with the
//! square of the length, so a long polyline is worked off in windows; each window end stays.

/// Longest window [points]; bounds the quadratic worst case.
const WINDOW: usize = 4096;

/// Indices of the points that stay, rising; first and last always do. Coordinates must be finite.
pub(crate) fn kept<const N: usize>(points: &[[f64; N]], tolerance: f64) -> Vec<usize> {
    if points.len() < 3 {
        return (0..points.len()).collect();
    }
    let mut keep = vec![false; points.len()];
    let last = points.len() - 1;
    let mut stack: Vec<(usize, usize)> =
        (0..last).step_by(WINDOW).map(|a| (a, (a + WINDOW).min(last))).collect();
    for &(a, b) in &stack {
        keep[a] = true;
        keep[b] = true;
    }
    let bound = tolerance * tolerance;
    while let Some((a, b)) = stack.pop() {
        let mut worst = (bound, 0);
        for i in a + 1..b {
            let d = distance_squared(points[i], points[a], points[b]);
            if d > worst.0 {
                worst = (d, i);
            }
        }
        if worst.1 != 0 {
            keep[worst.1] = true;
            stack.push((a, worst.1));
            stack.push((worst.1, b));
        }
    }
    (0..points.len()).filter(|&i| keep[i]).collect()
}

/// Squared distance of `p` from the segment `a` to `b`.
fn distance_squared<const N: usize>(p: [f64; N], a: [f64; N], b: [f64; N]) -> f64 {
    let (mut length, mut along) = (0.0, 0.0);
    for k in 0..N {
        length += (b[k] - a[k]) * (b[k] - a[k]);
        along += (p[k] - a[k]) * (b[k] - a[k]);
    }
    let t = if length > 0.0 { (along / length).clamp(0.0, 1.0) } else { 0.0 };
    (0..N).map(|k| p[k] - a[k] - t * (b[k] - a[k])).map(|d| d * d).sum()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_circle_keeps_its_sagitta_and_a_straight_line_its_ends() {
        let circle: Vec<[f64; 2]> = (0..=100_000)
            .map(|i| (f64::from(i) * std::f64::consts::TAU / 1e5).sin_cos())
            .map(|(s, c)| [100.0 * c, 100.0 * s])
            .collect();
        let kept = kept(&circle, 0.01);
        // A chord over the angle 2h has the sagitta R (1 - cos h): 0.01 mm at R 100 is h = 0.01414, 222 chords.
        assert!((200..500).contains(&kept.len()), "{}", kept.len());
        for w in kept.windows(2) {
            for i in w[0]..w[1] {
                assert!(distance_squared(circle[i], circle[w[0]], circle[w[1]]).sqrt() <= 0.01);
            }
        }
        let line: Vec<[f64; 3]> = (0..1000).map(|i| [f64::from(i), 2.0 * f64::from(i), 3.0]).collect();
        assert_eq!(super::kept(&line, 1e-9), [0, 999]);
    }

    #[test]
    fn a_line_that_turns_back_keeps_its_turning_point() {
        assert_eq!(kept(&[[0.0, 0.0], [10.0, 0.0], [5.0, 0.0]], 0.1), [0, 1, 2]);
        assert_eq!(kept::<2>(&[], 0.1), [0usize; 0]);
        assert_eq!(kept(&[[1.0, 1.0]; 5], 0.1), [0, 4]);
    }
}
