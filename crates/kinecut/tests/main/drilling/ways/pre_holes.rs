//! Holes that are there before: eccentric ones against dense rims and discs, limits, bad ones.

use kinecut::base::Code;
use kinecut::drilling::{
    BoundarySurface, Cover, CrossBore, DrillWay, Feeds, PreHole, Side, Travel, ZoneStage, transient, zones,
};
use kinecut::geom::EdgeProfile;
use kinecut::tool::DrillPoint;
use proptest::prelude::*;

use super::mesh::points;

fn plane(height: f64, slope: f64) -> BoundarySurface {
    BoundarySurface::Plane { height, slope }
}

fn twist(diameter: f64) -> EdgeProfile {
    DrillPoint::SinglePlane { angle: 118f64.to_radians() }.edge(diameter).unwrap()
}

proptest! {
    #![proptest_config(kinecut_cases::property(80))]

    /// The rim of the pre-hole and the disc without it, densely: never beyond the transient, and within the grid of it.
    #[test]
    fn an_eccentric_hole_takes_away_exactly_its_disc(
        kind in 0usize..11, surface in 0..3u8, slope in -1.2..1.2f64, offset in -14.0..14.0f64,
        diameter in 1.0..9.0f64, d in 0.0..7.0f64, angle in 0.0..6.3f64,
    ) {
        let edge = points()[kind].edge(10.0).unwrap();
        let surface = match surface {
            0 => plane(1.0, slope),
            1 => BoundarySurface::Ridge { radius: 20.0, offset, height: 0.0 },
            _ => BoundarySurface::Valley { radius: 20.0, offset, height: 0.0 },
        };
        let mut way = DrillWay::new(surface, None);
        let at = [d * angle.cos(), d * angle.sin()];
        way.pre_hole = Some(PreHole::through(diameter).moved(at));
        let found = way.passages(&edge).unwrap();
        prop_assert_eq!(found.len(), 1);
        let t = found[0].transient;
        let (mut low, mut high) = (f64::INFINITY, f64::NEG_INFINITY);
        let mut see = |x: f64, y: f64| {
            let r = x.hypot(y);
            for s in edge.segments() {
                // Points made on a circle are on it but for rounding.
                if r > s.range()[0] - 1e-12 && r < s.range()[1] + 1e-12 {
                    let z = surface.height(x) - s.height(r.clamp(s.range()[0], s.range()[1]));
                    low = low.min(z);
                    high = high.max(z);
                }
            }
        };
        for k in 0..2000 {
            let (sin, cos) = (std::f64::consts::TAU * f64::from(k) / 2000.0).sin_cos();
            see(at[0] + 0.5 * diameter * cos, at[1] + 0.5 * diameter * sin);
            for s in edge.segments() {
                for i in 0..=4 {
                    let r = s.range()[0] + (s.range()[1] - s.range()[0]) * f64::from(i) / 4.0;
                    if (r * cos - at[0]).hypot(r * sin - at[1]) > 0.5 * diameter {
                        see(r * cos, r * sin);
                    }
                }
            }
        }
        prop_assert!(low >= t.last - 1e-9 && high <= t.first + 1e-9, "{low} {high} {t:?}");
        // Planes and straight edges have their extremes on knots and rims: the step of 0.016 mm along them. Inside rings
        // of arcs and under cylinders the grid is coarser.
        let coarse = if matches!(surface, BoundarySurface::Plane { .. }) && ![3, 4].contains(&kind) { 0.06 } else { 0.7 };
        prop_assert!(low - t.last < coarse && t.first - high < coarse, "{low} {high} {t:?}");
    }

    #[test]
    fn a_concentric_hole_raises_nothing_and_lowers_nothing(
        kind in 0usize..11, slope in -1.2..1.2f64, diameter in 0.5..9.5f64, much in 1.0..1.2f64,
    ) {
        let edge = points()[kind].edge(10.0).unwrap();
        let mut way = DrillWay::new(plane(0.0, slope), Some(plane(-50.0, -slope)));
        let mut before = way.passages(&edge).unwrap();
        for d in [diameter, (diameter * much).min(9.9)] {
            way.pre_hole = Some(PreHole::through(d));
            let now = way.passages(&edge).unwrap();
            for (p, q) in before.iter().zip(&now) {
                prop_assert!(q.transient.first <= p.transient.first + 1e-12);
                prop_assert!(q.transient.last >= p.transient.last - 1e-12);
                prop_assert!((q.share - 1.0).abs() < 1e-12);
            }
            before = now;
        }
    }

    #[test]
    fn a_hole_hardly_off_the_axis_is_as_on_it_and_a_tiny_one_as_none(
        kind in 0usize..11, slope in -1.2..1.2f64, diameter in 0.5..9.0f64, angle in 0.0..6.3f64,
    ) {
        let edge = points()[kind].edge(10.0).unwrap();
        let mut way = DrillWay::new(plane(0.0, slope), None);
        let off = 1e-7;
        let mut first = |hole: Option<PreHole>| {
            way.pre_hole = hole;
            way.passages(&edge).unwrap()[0].transient
        };
        let on_axis = first(Some(PreHole::through(diameter)));
        let beside = first(Some(PreHole::through(diameter).moved([off * angle.cos(), off * angle.sin()])));
        // A point may stand a tool's steepest slope times the offset higher; a step wholly inside is another matter.
        let knot = edge.segments().iter().any(|s| (s.range()[0] - 0.5 * diameter).abs() < 1e-5);
        if !knot {
            prop_assert!((on_axis.first - beside.first).abs() < 1e-5 && (on_axis.last - beside.last).abs() < 1e-5);
        }
        let none = first(None);
        let tiny = first(Some(PreHole::through(1e-6).moved([1.0, 0.3])));
        prop_assert!((none.first - tiny.first).abs() < 1e-5 && (none.last - tiny.last).abs() < 1e-5);
    }

    #[test]
    fn all_lengths_scaled_scale_the_passages(
        c in 0.1..9.0f64, slope in -1.0..1.0f64, diameter in 1.0..9.0f64, d in 0.0..6.0f64, offset in -4.0..4.0f64,
    ) {
        let way = |c: f64| DrillWay {
            entry: plane(0.0, slope),
            exit: Some(BoundarySurface::Valley { radius: 30.0 * c, offset: offset * c, height: -50.0 * c }),
            exit_turn: 1.0,
            bores: vec![kinecut::drilling::CrossBore {
                radius: 6.0 * c, offset: offset * c, height: -30.0 * c, turn: 0.7,
            }],
            pre_hole: Some(PreHole::through(diameter * c).moved([d * c, 0.2 * c])),
        };
        let (one, other) = (way(1.0).passages(&twist(10.0)).unwrap(), way(c).passages(&twist(10.0 * c)).unwrap());
        prop_assert_eq!(one.len(), other.len());
        for (p, q) in one.iter().zip(&other) {
            prop_assert!((p.transient.first * c - q.transient.first).abs() < 2e-8);
            prop_assert!((p.transient.last * c - q.transient.last).abs() < 2e-8);
            prop_assert!((p.share - q.share).abs() < 1e-9);
        }
    }
}

#[test]
fn a_blind_hole_is_an_annulus_then_all() {
    // Half the diameter drilled 20 mm deep with the same point, then opened.
    let edge = twist(20.0);
    let mut way = DrillWay::new(plane(0.0, 0.0), None);
    way.pre_hole = Some(PreHole::blind(10.0, -20.0, twist(10.0)));
    let passages = way.passages(&edge).unwrap();
    let [entry, bottom] = passages[..] else { panic!("{passages:?}") };
    let cot = 1.0 / 59f64.to_radians().tan();
    assert!(
        (entry.transient.first + 5.0 * cot).abs() < 1e-12
            && (entry.transient.last + 10.0 * cot).abs() < 1e-12
    );
    assert!((bottom.transient.first + 20.0).abs() < 1e-12 && (bottom.transient.last + 20.0).abs() < 1e-12);
    assert!((entry.share - 0.75).abs() < 1e-12 && (bottom.share - 0.25).abs() < 1e-12);
    let mut found = Vec::new();
    zones(
        &passages,
        Travel { start: 2.0, end: -40.0 },
        &Feeds { entry: 0.1, steady: 0.3, exit: 0.2 },
        &mut found,
    );
    let stages: Vec<ZoneStage> = found.iter().map(|z| z.stage).collect();
    assert_eq!(stages, [ZoneStage::Entry, ZoneStage::Partial, ZoneStage::Steady]);
    assert!((found[2].from + 20.0).abs() < 1e-9);
}

#[test]
fn a_ring_between_slot_and_pre_hole_is_not_cut_where_the_hole_ends_in_a_bore() {
    // 0.02 mm of the edge hang over the hole: 0.13 % of it.
    let edge = DrillPoint::SlottedChisel { angle: 118f64.to_radians(), slot: 0.8 }.edge(10.0).unwrap();
    let inner = edge.inner_radius();
    let mut way = DrillWay::new(plane(0.0, 0.0), None);
    way.bores.push(CrossBore { radius: 8.0, offset: 0.0, height: -40.0, turn: 0.0 });
    way.pre_hole = Some(PreHole::blind(2.0 * inner + 0.04, -38.0, twist(2.0 * inner + 0.04)));
    let passages = way.passages(&edge).unwrap();
    let ring = ((inner + 0.02).powi(2) - inner * inner) / (25.0 - inner * inner);
    // A column stands for 2.3e-5 of the edge.
    assert!((1.0 - passages[0].share - ring).abs() < 5e-5, "{passages:?}");
    let mut found = Vec::new();
    let feeds = Feeds { entry: 0.1, steady: 0.3, exit: 0.2 };
    zones(&passages, Travel { start: 2.0, end: -70.0 }, &feeds, &mut found);
    assert_eq!((found[1].stage, found[1].feed), (ZoneStage::Partial, 0.1), "{found:?}");
}

#[test]
fn a_finishing_drill_of_the_same_size_meets_only_the_bottom() {
    let flat = DrillPoint::Flat.edge(10.0).unwrap();
    let mut way = DrillWay::new(plane(0.0, 0.0), Some(plane(-60.0, 0.0)));
    way.pre_hole = Some(PreHole::blind(10.0, -20.0, twist(10.0)));
    let passages = way.passages(&flat).unwrap();
    let [bottom, exit] = passages[..] else { panic!("{passages:?}") };
    assert!((bottom.transient.first - (-20.0 + 5.0 / 59f64.to_radians().tan())).abs() < 1e-12, "its rim");
    assert!((bottom.transient.last + 20.0).abs() < 1e-12 && (bottom.share - 1.0).abs() < 1e-12);
    assert_eq!((exit.side, exit.share), (Side::Exit, 1.0));
}

#[test]
fn bad_pre_holes_are_refused_and_one_beside_the_drill_is_none() {
    let edge = twist(10.0);
    let with = |hole: PreHole| {
        let mut way = DrillWay::new(plane(0.0, 0.0), None);
        way.pre_hole = Some(hole);
        way.passages(&edge)
    };
    let ring = DrillPoint::Annular { core: 2.0 }.edge(6.0).unwrap();
    for bad in [
        PreHole::through(10.0),
        PreHole::through(30.0).moved([9.0, 0.0]),
        PreHole::through(-1.0),
        PreHole::through(f64::NAN),
        PreHole::through(3.0).moved([f64::NAN, 0.0]),
        PreHole::blind(6.0, -5.0, ring),
        PreHole::blind(6.0, -5.0, twist(5.0)),
        PreHole::blind(6.0, f64::NAN, twist(6.0)),
    ] {
        assert_eq!(with(bad.clone()).unwrap_err().code(), Code::DRILL_CASE, "{bad:?}");
    }
    let whole = transient(&edge, &plane(0.0, 0.0), Cover::Whole).unwrap();
    let beside = with(PreHole::through(4.0).moved([0.0, 7.5])).unwrap();
    assert_eq!((beside[0].transient, beside[0].share), (whole, 1.0));
}
