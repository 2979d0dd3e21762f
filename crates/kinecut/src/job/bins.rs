//! An index of many boxes: those that hold a point, without trying each.

use glam::DVec3;

use crate::geom::Aabb;

/// Boxes by squares of the plane in which they are spread most.
pub(in crate::job) struct Bins {
    /// The axes of that plane.
    axes: [usize; 2],
    origin: DVec3,
    /// Edge lengths of a square [mm].
    edges: [f64; 2],
    /// Squares along either axis.
    across: usize,
    /// For each square the boxes that reach into it, ascending.
    boxes: Vec<Vec<u32>>,
}

/// Squares that a box is kept in, on average, before larger squares are taken.
const KEPT: usize = 16;

impl Bins {
    /// Of boxes that are finite.
    pub(in crate::job) fn of(boxes: &[Aabb]) -> Bins {
        let all = boxes.iter().fold(Aabb::EMPTY, |all, b| all.union(*b));
        let size = if all.is_empty() { DVec3::ZERO } else { all.size() };
        let mut axes = [0, 1, 2];
        axes.sort_by(|&a, &b| size[b].total_cmp(&size[a]));
        let mut across = (boxes.len() as f64).sqrt().ceil().max(1.0) as usize;
        loop {
            let edges = [axes[0], axes[1]].map(|axis| size[axis] / across as f64);
            let mut bins =
                Bins { axes: [axes[0], axes[1]], origin: all.min, edges, across, boxes: Vec::new() };
            let squares = |b: &Aabb| {
                let [columns, rows] = bins.squares(b.min, b.max);
                columns.count() * rows.count()
            };
            if across > 1 && boxes.iter().map(squares).sum::<usize>() > KEPT * boxes.len() {
                across = across.div_ceil(2);
                continue;
            }
            bins.boxes = vec![Vec::new(); across * across];
            for (number, b) in boxes.iter().enumerate() {
                let [columns, rows] = bins.squares(b.min, b.max);
                for square in rows.flat_map(|row| columns.clone().map(move |column| row * across + column)) {
                    bins.boxes[square].push(number as u32);
                }
            }
            return bins;
        }
    }

    /// Columns and rows of the squares from one corner of a box to the other.
    fn squares(&self, min: DVec3, max: DVec3) -> [std::ops::RangeInclusive<usize>; 2] {
        [0, 1].map(|i| {
            let axis = self.axes[i];
            let at = |x: f64| {
                let index = if self.edges[i] > 0.0 { (x - self.origin[axis]) / self.edges[i] } else { 0.0 };
                // The cast keeps what lies below the first square in it.
                (index as usize).min(self.across - 1)
            };
            at(min[axis])..=at(max[axis])
        })
    }

    /// The boxes that may meet another one, ascending; all that do are among them.
    pub(in crate::job) fn about(&self, b: Aabb) -> Vec<u32> {
        let [columns, rows] = self.squares(b.min, b.max);
        let squares = rows.flat_map(|row| columns.clone().map(move |column| row * self.across + column));
        let mut all: Vec<u32> =
            squares.filter_map(|square| self.boxes.get(square)).flatten().copied().collect();
        all.sort_unstable();
        all.dedup();
        all
    }

    /// The boxes that may hold a point, ascending; all that do are among them.
    pub(super) fn near(&self, p: DVec3) -> &[u32] {
        let [columns, rows] = self.squares(p, p);
        self.boxes.get(rows.start() * self.across + columns.start()).map_or(&[], |list| &list[..])
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_box_that_holds_a_point_is_near_and_few_others() {
        let corner = |i: u32| DVec3::new(f64::from(i % 40) * 5.0, f64::from(i % 3), f64::from(i / 40) * 7.0);
        let mut boxes: Vec<Aabb> =
            (0..1600).map(|i| Aabb { min: corner(i), max: corner(i) + 4.0 + f64::from(i % 5) }).collect();
        boxes.push(Aabb { min: DVec3::splat(-1.0), max: DVec3::new(300.0, 9.0, 300.0) });
        let bins = Bins::of(&boxes);
        for i in 0..1600 {
            let p = corner(i) + DVec3::new(1.0, 2.0, 0.5 * f64::from(i % 9));
            let near = bins.near(p);
            let holds = |b: &Aabb| b.min.cmple(p).all() && p.cmple(b.max).all();
            let holding = (0u32..).zip(&boxes).filter(|(_, b)| holds(b)).map(|(k, _)| k);
            assert!(holding.into_iter().all(|k| near.contains(&k)), "{i}");
            assert!(near.len() < 30, "{}", near.len());
        }
        assert!(Bins::of(&[]).near(DVec3::ONE).is_empty());
        // All in one place: one square, each box once.
        let same = vec![boxes[7]; 500];
        assert_eq!(Bins::of(&same).near(same[0].min).len(), 500);
        let kept: usize = Bins::of(&same).boxes.iter().map(Vec::len).sum();
        assert!(kept <= KEPT * 500);
    }
}
