//! Least values of functions of one or two variables over a range.
//!
//! A grid finds every valley that is wider than its step; each valley is followed down by parabolas through three points,
//! kept inside a shrinking bracket (one variable), or through a stencil of nine points that shrinks (two). Parabolas
//! are only proposals: the least value that was seen counts, so corners of the function do no harm.

/// Place of the least value of `f` over `[from, to]`, and the value, from a grid of `cells` cells. At an edge of the
/// range the end counts.
///
/// ```
/// # use kinecut_geom as kinecut;
/// use kinecut::num::minimum::minimum_along;
/// let (x, least) = minimum_along(|x: f64| (x - 0.3).powi(2) - 1.0, -2.0, 2.0, 10);
/// assert!((x - 0.3).abs() < 1e-7 && least == -1.0);
/// ```
pub fn minimum_along(f: impl Fn(f64) -> f64, from: f64, to: f64, cells: usize) -> (f64, f64) {
    let cells = cells.max(2);
    let at = |i: usize| from + (to - from) * (i as f64 / cells as f64);
    let values: Vec<f64> = (0..=cells).map(|i| f(at(i))).collect();
    let mut best = (from, f64::INFINITY);
    for (i, &value) in values.iter().enumerate() {
        let (before, after) = (i.saturating_sub(1), (i + 1).min(cells));
        if value > values[before] || value > values[after] {
            continue;
        }
        // A range of no length has no valley.
        let found =
            if to > from { valley(&f, [at(before), at(i), at(after)], value) } else { (at(i), value) };
        if found.1 < best.1 {
            best = found;
        }
    }
    best
}

/// Follows a valley between `bracket[0]` and `bracket[2]` from `bracket[1]`, where the value is `least` (Brent's
/// method: parabolas, with the golden section where they do not help).
fn valley(f: &impl Fn(f64) -> f64, bracket: [f64; 3], least: f64) -> (f64, f64) {
    let [mut a, x0, mut b] = bracket;
    let (mut x, mut fx) = (x0, least);
    let (mut w, mut fw, mut v, mut fv) = (x, fx, x, fx);
    let (mut step, mut before) = (b - a, b - a);
    for _ in 0..STEPS {
        let middle = 0.5 * (a + b);
        let small = RESOLUTION * x.abs().max(b - a) + f64::MIN_POSITIVE;
        if (x - middle).abs() + 0.5 * (b - a) <= 2.0 * small {
            break;
        }
        let (r, q) = ((x - w) * (fx - fv), (x - v) * (fx - fw));
        let (p, q) = ((x - v) * q - (x - w) * r, 2.0 * (q - r));
        let shift = if q == 0.0 { f64::NAN } else { -p / q };
        let inside = x + shift > a && x + shift < b && shift.abs() < 0.5 * before.abs();
        before = step;
        step = if inside { shift } else { GOLDEN * if x < middle { b - x } else { a - x } };
        if !inside {
            before = step;
        }
        let u = x + if step.abs() >= small { step } else { small.copysign(step) };
        let u = u.clamp(bracket[0], bracket[2]);
        let fu = f(u);
        if fu <= fx {
            if u < x {
                b = x;
            } else {
                a = x;
            }
            (v, fv, w, fw, x, fx) = (w, fw, x, fx, u, fu);
        } else {
            if u < x {
                a = u;
            } else {
                b = u;
            }
            if fu <= fw || w == x {
                (v, fv, w, fw) = (w, fw, u, fu);
            } else if fu <= fv || v == x || v == w {
                (v, fv) = (u, fu);
            }
        }
    }
    (x, fx)
}

/// Place of the least value of `f` over a rectangle, and the value, from a grid of `cells` cells; the eight lowest
/// hollows of the grid are followed.
pub fn minimum_over(
    f: impl Fn([f64; 2]) -> f64,
    domain: [[f64; 2]; 2],
    cells: [usize; 2],
) -> ([f64; 2], f64) {
    let [[u0, u1], [v0, v1]] = domain;
    if !(v1 > v0) {
        let (u, value) = minimum_along(|u| f([u, v0]), u0, u1, cells[0]);
        return ([u, v0], value);
    }
    if !(u1 > u0) {
        let (v, value) = minimum_along(|v| f([u0, v]), v0, v1, cells[1]);
        return ([u0, v], value);
    }
    let [nu, nv] = cells.map(|n| n.max(2));
    let step = [(u1 - u0) / nu as f64, (v1 - v0) / nv as f64];
    let at = |i: usize, j: usize| [u0 + step[0] * i as f64, v0 + step[1] * j as f64];
    let values: Vec<f64> = (0..(nu + 1) * (nv + 1)).map(|k| f(at(k / (nv + 1), k % (nv + 1)))).collect();
    let value = |i: usize, j: usize| values[i * (nv + 1) + j];
    let is_lowest = |&(i, j): &(usize, usize)| {
        let near = (i.saturating_sub(1)..=(i + 1).min(nu))
            .flat_map(|k| (j.saturating_sub(1)..=(j + 1).min(nv)).map(move |l| (k, l)));
        let lowest = near.map(|(k, l)| value(k, l)).fold(f64::INFINITY, f64::min);
        value(i, j) <= lowest
    };
    let nodes = (0..=nu).flat_map(|i| (0..=nv).map(move |j| (i, j)));
    let mut hollows: Vec<(usize, usize)> = nodes.filter(is_lowest).collect();
    hollows.sort_by(|a, b| value(a.0, a.1).total_cmp(&value(b.0, b.1)));
    let mut best = (at(0, 0), f64::INFINITY);
    for &(i, j) in hollows.iter().take(MOST_HOLLOWS) {
        let found = hollow(&f, domain, at(i, j), value(i, j), step);
        if found.1 < best.1 {
            best = found;
        }
    }
    best
}

/// Follows a hollow down from `at` with a stencil of nine points, which moves to its least point and shrinks when that
/// is in the middle.
fn hollow(
    f: &impl Fn([f64; 2]) -> f64,
    domain: [[f64; 2]; 2],
    at: [f64; 2],
    value: f64,
    step: [f64; 2],
) -> ([f64; 2], f64) {
    let clamp = |x: f64, k: usize| x.clamp(domain[k][0], domain[k][1]);
    let (mut at, mut least, mut size) = (at, value, 0.5);
    let mut evaluations = 0;
    while size > RESOLUTION && evaluations < MOST_EVALUATIONS {
        let mut around = [[0.0; 3]; 3];
        let mut best = (at, least);
        for (i, row) in around.iter_mut().enumerate() {
            for (j, cell) in row.iter_mut().enumerate() {
                let place = [
                    clamp(at[0] + (i as f64 - 1.0) * size * step[0], 0),
                    clamp(at[1] + (j as f64 - 1.0) * size * step[1], 1),
                ];
                *cell = if i == 1 && j == 1 { least } else { f(place) };
                if *cell < best.1 {
                    best = (place, *cell);
                }
            }
        }
        evaluations += 9;
        let lowest = around.as_flattened().iter().copied().fold(f64::INFINITY, f64::min);
        let highest = around.as_flattened().iter().copied().fold(f64::NEG_INFINITY, f64::max);
        if highest - lowest <= FLAT * (1.0 + least.abs()) {
            return best;
        }
        // The least point of the paraboloid through the stencil, in units of its size.
        let g = [0.5 * (around[2][1] - around[0][1]), 0.5 * (around[1][2] - around[1][0])];
        let h = [
            around[2][1] - 2.0 * least + around[0][1],
            0.25 * (around[2][2] - around[2][0] - around[0][2] + around[0][0]),
            around[1][2] - 2.0 * least + around[1][0],
        ];
        let det = h[0] * h[2] - h[1] * h[1];
        if det > 0.0 && h[0] > 0.0 {
            let du = (h[1] * g[1] - h[2] * g[0]) / det;
            let dv = (h[1] * g[0] - h[0] * g[1]) / det;
            let place = [
                clamp(at[0] + du.clamp(-2.0, 2.0) * size * step[0], 0),
                clamp(at[1] + dv.clamp(-2.0, 2.0) * size * step[1], 1),
            ];
            let value = f(place);
            if value < best.1 {
                best = (place, value);
                size *= 0.35;
            }
        }
        if best.1 < least {
            (at, least) = best;
        } else {
            size *= 0.35;
        }
    }
    (at, least)
}

/// The thing with the least value between two places, where the value has one valley; `at` makes the thing of a place, `steps`
/// times the range shrinks to 0.618 of itself (golden section).
///
/// ```
/// # use kinecut_geom as kinecut;
/// let best = kinecut::num::minimum::golden([-1.0, 4.0], 60, |x| x, |x| (x - 0.3).powi(2));
/// assert!((best - 0.3).abs() < 1e-7);
/// ```
pub fn golden<T>(
    [mut low, mut high]: [f64; 2],
    steps: u32,
    mut at: impl FnMut(f64) -> T,
    value: impl Fn(&T) -> f64,
) -> T {
    const SECTION: f64 = 0.618_033_988_749_894_9;
    let (mut a, mut b) = (high - SECTION * (high - low), low + SECTION * (high - low));
    let (mut at_a, mut at_b) = (at(a), at(b));
    for _ in 0..steps {
        if value(&at_a) <= value(&at_b) {
            (high, b, at_b) = (b, a, at_a);
            a = high - SECTION * (high - low);
            at_a = at(a);
        } else {
            (low, a, at_a) = (a, b, at_b);
            b = low + SECTION * (high - low);
            at_b = at(b);
        }
    }
    if value(&at_a) <= value(&at_b) { at_a } else { at_b }
}

/// Relative length at which a minimum is flat to rounding: about the square root of the rounding unit.
const RESOLUTION: f64 = 1e-9;
/// Spread of a stencil that is rounding: distances of points some hundred millimetres away.
const FLAT: f64 = 1e-11;
/// Golden section.
const GOLDEN: f64 = 0.381_966_011_250_105_2;
/// Most steps of Brent's method; the golden section alone shrinks a bracket to the resolution in 44.
const STEPS: usize = 100;
/// Most hollows that are followed, the lowest ones: more are the rounding of a flat function.
const MOST_HOLLOWS: usize = 8;
/// Most evaluations for one hollow of two variables.
const MOST_EVALUATIONS: usize = 1200;

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_lowest_of_several_valleys_and_a_corner_are_found() {
        let f = |x: f64| (3.0 * x).sin() + 0.1 * x;
        let (x, least) = minimum_along(f, -6.0, 6.0, 40);
        // Stationary: cos 3x = -1/30, and the leftmost valley is the lowest.
        let exact = (-(-1.0f64 / 30.0).acos() - 2.0 * std::f64::consts::TAU) / 3.0;
        let stationary = (3.0 * (3.0 * x).cos() + 0.1).abs();
        assert!(stationary < 1e-6 && (x - exact).abs() < 2e-7, "{x} {exact} {stationary}");
        assert!((least - f(x)).abs() == 0.0);
        let (x, least) = minimum_along(|x: f64| (x - 0.123_456).abs(), -1.0, 3.0, 7);
        assert!((x - 0.123_456).abs() < 1e-8 && least < 1e-8);
        assert_eq!(minimum_along(|x| x, 1.0, 2.0, 5), (1.0, 1.0));
        assert_eq!(minimum_along(|x| x, 1.0, 1.0, 5), (1.0, 1.0));
    }

    #[test]
    fn a_narrow_slanted_valley_of_two_variables() {
        let f = |[u, v]: [f64; 2]| 50.0 * (u - v - 0.2).powi(2) + (u + v - 1.0).powi(2);
        let ([u, v], least) = minimum_over(f, [[-1.0, 2.0], [-1.0, 2.0]], [6, 6]);
        assert!((u - 0.6).abs() < 1e-6 && (v - 0.4).abs() < 1e-6 && least < 1e-12, "{u} {v} {least}");
        let (place, least) = minimum_over(|[u, v]| u.abs() + v, [[-1.0, 1.5], [0.0, 2.0]], [5, 5]);
        assert!(place[0].abs() < 1e-7 && place[1] == 0.0 && least < 1e-7);
    }
}
