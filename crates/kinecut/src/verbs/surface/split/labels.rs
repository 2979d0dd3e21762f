//! Names beside arrows: each where it covers least.

/// Height of a name [px].
const HEIGHT: f64 = 15.0;
/// Room between the head of an arrow and its name [px].
const OFF: f64 = 9.0;

/// A name on paper.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Label {
    /// Left end of its foot line [px].
    pub(crate) at: [f64; 2],
    /// Left, top, right, bottom [px].
    bounds: [f64; 4],
}

/// Places names of the given widths at heads of arrows: not on another name, on as few of the points to be left free as can
/// be, inside of the box `[left, top, right, bottom]`.
pub(crate) fn place(wanted: &[(f64, [f64; 2])], free: &[[f64; 2]], within: [f64; 4]) -> Vec<Label> {
    let mut placed: Vec<Label> = Vec::new();
    for (width, head) in wanted {
        let mut best: Option<(f64, Label)> = None;
        for (ring, out) in [OFF, OFF + HEIGHT, OFF + 2.0 * HEIGHT, OFF + 4.0 * HEIGHT].into_iter().enumerate()
        {
            for i in 0..12 {
                let (sin, cos) = (f64::from(i) * std::f64::consts::TAU / 12.0).sin_cos();
                let x = head[0] + cos * (out + 0.5 * width) - 0.5 * width;
                let y = head[1] + sin * (out + 0.5 * HEIGHT) - 0.5 * HEIGHT;
                let bounds = [x, y, x + width, y + HEIGHT];
                let outside = (within[0] - bounds[0]).max(0.0)
                    + (within[1] - bounds[1]).max(0.0)
                    + (bounds[2] - within[2]).max(0.0)
                    + (bounds[3] - within[3]).max(0.0);
                let names = placed.iter().filter(|l| meet(&l.bounds, &bounds)).count() as f64;
                let points = free.iter().filter(|p| contains(&bounds, p)).count() as f64;
                let cost = 1e4 * names + 100.0 * outside + 6.0 * points + 10.0 * ring as f64;
                if best.as_ref().is_none_or(|b| cost < b.0) {
                    best = Some((cost, Label { at: [x, y + HEIGHT - 4.0], bounds }));
                }
            }
        }
        placed.extend(best.map(|b| b.1));
    }
    placed
}

fn meet(a: &[f64; 4], b: &[f64; 4]) -> bool {
    a[0] < b[2] && b[0] < a[2] && a[1] < b[3] && b[1] < a[3]
}

fn contains(a: &[f64; 4], p: &[f64; 2]) -> bool {
    a[0] - 2.0 < p[0] && p[0] < a[2] + 2.0 && a[1] - 2.0 < p[1] && p[1] < a[3] + 2.0
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_of_one_place_do_not_lie_on_each_other() {
        let line = [[50.0, 50.0], [100.0, 100.0]];
        let placed = place(&[(40.0, line[1]); 6], &line, [0.0, 0.0, 300.0, 300.0]);
        for (i, a) in placed.iter().enumerate() {
            assert!(placed[..i].iter().all(|b| !meet(&a.bounds, &b.bounds)));
            assert!(!contains(&a.bounds, &line[1]));
        }
        assert_eq!(placed.len(), 6);
    }
}
