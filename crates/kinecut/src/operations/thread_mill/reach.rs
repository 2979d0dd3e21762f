//! Whether the helices of a posted thread cut its groove from end to end.

/// Heights between which helices cut the groove, of the middle of a tooth [mm].
pub(super) type Span = [f64; 2];

/// The first stretch of a groove that no span cuts, but for what is rounding of heights [mm].
pub(super) fn left_out(spans: &[Span], [from, to]: Span, rounding: f64) -> Option<Span> {
    let mut sorted = spans.to_vec();
    sorted.sort_by(|a, b| a[0].total_cmp(&b[0]));
    let mut reached = from;
    for [low, high] in sorted {
        if reached >= to - rounding {
            break;
        }
        // So that what is no number is a gap.
        let follows = low <= reached + rounding;
        if !follows {
            return Some([reached, if low < to { low } else { to }]);
        }
        if high > reached {
            reached = high;
        }
    }
    let complete = reached >= to - rounding;
    (!complete).then_some([reached, to])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn gaps_short_ends_and_what_is_no_number_are_found() {
        let groove = [-20.0, 1.25];
        let left = |spans: &[Span]| left_out(spans, groove, 1e-3);
        assert_eq!(left(&[[-20.0, 1.25]]), None);
        assert_eq!(left(&[[-8.0, 2.0], [-20.0005, -8.0005]]), None);
        assert_eq!(left(&[[-8.0, 2.0], [-20.0, -8.5]]), Some([-8.5, -8.0]));
        assert_eq!(left(&[[-20.0, 0.0]]), Some([0.0, 1.25]));
        assert_eq!(left(&[[-19.9, 2.0]]), Some([-20.0, -19.9]));
        assert_eq!(left(&[[-30.0, -25.0]]), Some(groove));
        assert_eq!(left(&[[5.0, 9.0]]), Some(groove));
        assert_eq!(left(&[]), Some(groove));
        assert_eq!(left(&[[f64::NAN, 2.0]]), Some(groove));
        assert_eq!(left(&[[-20.0, f64::NAN]]), Some(groove));
    }
}
