//! Dimension lines in lanes: nothing lies on anything else.

/// Room that two things in a lane keep [px].
const APART: f64 = 4.0;
/// Length of an arrow [px].
pub(crate) const ARROW: f64 = 7.0;

/// A dimension line in its lane [px along the lane].
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Placed {
    /// The lane, 0 next to the drawing.
    pub(crate) lane: usize,
    /// Start.
    pub(crate) from: f64,
    /// End, not before the start.
    pub(crate) to: f64,
    /// Middle of the words.
    pub(crate) middle: f64,
    /// Whether the arrows point in from outside.
    pub(crate) outside: bool,
}

/// Places dimension lines, given as ends and width of the words: the shorter, the nearer to the drawing. Words stay
/// between `low` and `high` where they can.
pub(crate) fn place(wanted: &[([f64; 2], f64)], low: f64, high: f64) -> Vec<Placed> {
    let mut order: Vec<usize> = (0..wanted.len()).collect();
    let length = |i: usize| (wanted[i].0[1] - wanted[i].0[0]).abs();
    order.sort_by(|&a, &b| length(a).total_cmp(&length(b)));
    let mut lanes: Vec<Vec<[f64; 2]>> = Vec::new();
    let mut placed = vec![None; wanted.len()];
    for i in order {
        let ([a, b], width) = wanted[i];
        let (from, to) = if a < b { (a, b) } else { (b, a) };
        let outside = to - from < 2.5 * ARROW;
        let tail = if outside { 1.7 * ARROW } else { 0.0 };
        let ways = [
            ([from - tail, to + tail], (from + to) / 2.0),
            ([from - tail, to + tail + APART + width], to + tail + APART + width / 2.0),
            ([from - tail - APART - width, to + tail], from - tail - APART - width / 2.0),
        ];
        // In the middle of the line, or else after or before it, first where the words stay inside.
        let fits = to - from >= width + 2.0 * APART;
        let mut choice = if fits { ways[..1].to_vec() } else { ways[1..].to_vec() };
        choice.sort_by_key(|w| w.1 - width / 2.0 < low || w.1 + width / 2.0 > high);
        let free =
            |lane: &[[f64; 2]], r: [f64; 2]| lane.iter().all(|o| o[1] <= r[0] + 0.5 || o[0] >= r[1] - 0.5);
        let lane = (0..).find(|&n| lanes.get(n).is_none_or(|l| choice.iter().any(|w| free(l, w.0))));
        let lane = lane.unwrap_or(lanes.len());
        if lane == lanes.len() {
            lanes.push(Vec::new());
        }
        let way = choice.iter().find(|w| free(&lanes[lane], w.0)).unwrap_or(&choice[0]);
        lanes[lane].push(way.0);
        placed[i] = Some(Placed { lane, from, to, middle: way.1, outside });
    }
    placed.into_iter().flatten().collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    #[test]
    fn a_chain_of_dimensions_shares_a_lane_and_the_whole_stands_outside() {
        let placed = place(&[([0.0, 300.0], 60.0), ([0.0, 100.0], 60.0), ([100.0, 300.0], 60.0)], 0.0, 300.0);
        assert_eq!(placed.iter().map(|p| p.lane).collect::<Vec<_>>(), [1, 0, 0]);
        assert!(placed.iter().all(|p| p.middle == (p.from + p.to) / 2.0 && !p.outside));
    }

    #[test]
    fn words_of_a_short_dimension_stand_beside_it_inside_where_they_can() {
        let alone = place(&[([95.0, 100.0], 60.0)], 0.0, 100.0);
        assert!(alone[0].middle < 65.0 && alone[0].outside, "{alone:?}");
        let placed = place(&[([0.0, 5.0], 60.0), ([95.0, 100.0], 60.0)], 0.0, 100.0);
        assert!(placed[0].middle > 35.0 && placed[0].middle < 70.0, "{placed:?}");
        assert!(placed[1].middle > 100.0, "no room between: {placed:?}");
    }

    proptest! {
        #![proptest_config(kinecut_cases::property(256))]
        #[test]
        fn nothing_in_a_lane_lies_on_anything_else(
            wanted in proptest::collection::vec((0.0..400.0f64, 0.0..200.0f64, 20.0..90.0f64), 1..9)
        ) {
            let wanted: Vec<_> = wanted.iter().map(|w| ([w.0, w.0 + w.1], w.2)).collect();
            let placed = place(&wanted, 0.0, 400.0);
            for (i, a) in placed.iter().enumerate() {
                for (j, b) in placed.iter().enumerate().filter(|(_, b)| b.lane == a.lane) {
                    if i == j { continue; }
                    let (wa, wb) = (wanted[i].1 / 2.0, wanted[j].1 / 2.0);
                    prop_assert!((a.middle - b.middle).abs() >= wa + wb - 1.0, "{a:?} {b:?}");
                    prop_assert!(a.to <= b.from + 1.0 || b.to <= a.from + 1.0, "{a:?} {b:?}");
                }
            }
        }
    }
}
