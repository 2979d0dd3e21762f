//! Stock that the passes of a level have left so far.

use glam::DVec2;

use super::level::box_of;
use super::swept::Clearing;

/// Farthest a pass may be from a point for that to be tried again, in radii of the cutter.
const NEAR: f64 = 3.0;
/// The same for a first look.
const NEAREST: f64 = 1.5;
/// Distance from a point at which no pass could be made within which none can, in radii of the cutter.
const BESIDE: f64 = 0.25;
/// Passes after which all points are looked at.
const UPDATED: usize = 32;
/// Points that are looked at together.
const TOGETHER: usize = 32;

/// Stock that passes have left, by the middles of cells.
#[derive(Debug)]
pub(super) struct Rest {
    points: Vec<Left>,
    /// The box of each pass.
    passes: Vec<[DVec2; 2]>,
}

/// A point that is left.
#[derive(Clone, Copy, Debug)]
struct Left {
    at: DVec2,
    /// Number of vain looks for a pass.
    fails: u32,
    /// Whether a pass was begun here.
    begun: bool,
    /// Number of passes when one was looked for in vain all around it.
    given_up: Option<usize>,
    /// Number of passes when one that was begun beside it has cut nothing.
    put_off: Option<usize>,
}

impl Rest {
    /// The stock that is left where `reached` is true.
    pub(super) fn new(clearing: &Clearing, reached: impl Fn(DVec2) -> bool) -> Rest {
        let left = |at| Left { at, fails: 0, begun: false, given_up: None, put_off: None };
        Rest { points: clearing.remains(reached).into_iter().map(left).collect(), passes: Vec::new() }
    }

    /// Number of points that are left at most: those that were cleared not long ago may count still.
    pub(super) fn most(&self) -> usize {
        self.points.len()
    }

    /// Takes out all points that are cleared.
    pub(super) fn update(&mut self, clearing: &Clearing) {
        self.points.retain(|left| !clearing.is_clear(left.at));
    }

    /// The points that are left.
    pub(super) fn points(&self) -> Vec<DVec2> {
        self.points.iter().map(|left| left.at).collect()
    }

    /// A pass was made along these points.
    pub(super) fn passed(&mut self, way: &[DVec2], clearing: &Clearing) {
        self.passes.push(box_of(way, 0.0));
        if self.passes.len().is_multiple_of(UPDATED) {
            self.update(clearing);
        }
    }

    /// A pass that was begun at a point has cut nothing: those beside it come last.
    pub(super) fn cut_nothing(&mut self, p: DVec2, radius: f64) {
        let passes = self.passes.len();
        let beside = BESIDE * radius;
        for left in self.points.iter_mut().filter(|left| left.at.distance(p) <= beside) {
            left.put_off = Some(passes);
        }
    }

    /// The first point for which `start` finds a beginning of a pass, and that: those at which one was looked for in vain
    /// the least come first, of them the nearest to `here`. Those that were put off come again only when a pass has come near
    /// since; with `all` those that were given up, as all that is looked at in vain then is. `start` gives nothing at all for a point that it does not look at.
    pub(super) fn begin<T>(
        &mut self,
        clearing: &Clearing,
        (here, radius): (DVec2, f64),
        all: bool,
        mut start: impl FnMut(DVec2) -> Option<Option<T>>,
    ) -> Option<(T, DVec2)> {
        let passes = &self.passes;
        let reach = DVec2::splat(if all { NEAR } else { NEAREST } * radius);
        let came_near = |left: &Left| match if all { left.given_up } else { left.put_off } {
            Some(then) => passes[then..]
                .iter()
                .any(|[low, high]| (*low - reach).cmple(left.at).all() && left.at.cmple(*high + reach).all()),
            _ => true,
        };
        // Those before others come first; of equal ones that of the lower index.
        let mut order: Vec<(u32, u64, usize)> = self
            .points
            .iter()
            .enumerate()
            .filter(|(_, left)| !left.begun)
            .map(|(i, left)| (left.fails, left.at.distance_squared(here).to_bits(), i))
            .collect();
        let mut done = 0;
        while done < order.len() {
            let rest = &mut order[done..];
            let count = TOGETHER.min(rest.len());
            if count < rest.len() {
                rest.select_nth_unstable(count - 1);
            }
            rest[..count].sort_unstable();
            for &(_, _, i) in &order[done..done + count] {
                let left = self.points[i];
                if clearing.is_clear(left.at) || !came_near(&left) {
                    continue;
                }
                match start(left.at) {
                    Some(Some(found)) => {
                        self.points[i].begun = true;
                        return Some((found, left.at));
                    }
                    Some(None) => {
                        self.points[i].fails += 1;
                        self.points[i].given_up = all.then_some(passes.len()).or(left.given_up);
                    }
                    None => {}
                }
            }
            done += count;
        }
        None
    }
}
