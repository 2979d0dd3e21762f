//! What must hold of a drilled hole whatever the point and the surfaces.

use kinecut::drilling::{
    BoundarySurface, Cover, DrillPlan, DrillSpec, End, FeedChoice, PartFace, PreHole, Side, Transient,
    plan_drill, transient,
};
use kinecut::tool::DrillPoint;
use proptest::prelude::*;

fn point(kind: usize, a: f64, b: f64) -> DrillPoint {
    let angle = (60.0 + 100.0 * a).to_radians();
    match kind {
        0 => DrillPoint::SinglePlane { angle },
        1 => DrillPoint::DoubleGround { angle, second: (30.0 + 80.0 * b).to_radians() },
        2 => DrillPoint::CastIron { angle, second: 70f64.to_radians(), third: 55f64.to_radians(), slot: b },
        3 => DrillPoint::Rounded { radius: 10.0 + 20.0 * a },
        4 => DrillPoint::CornerRadius { angle, radius: 0.5 + 8.0 * b },
        5 => DrillPoint::ThinnedWeb { angle, flat: 0.2 + 5.0 * b },
        6 => DrillPoint::SlottedChisel { angle, slot: 5.0 * b },
        7 => DrillPoint::Annular { core: 2.0 + 15.0 * b },
        8 => DrillPoint::Flat,
        9 => DrillPoint::Cannon { overlap: 2.0 * b, edge_angle: (50.0 + 35.0 * a).to_radians() },
        _ => DrillPoint::Gun {
            apex: Some(1.0 + 8.0 * b),
            outer_angle: (40.0 + 45.0 * a).to_radians(),
            inner_angle: (50.0 + 35.0 * b).to_radians(),
        },
    }
}

/// A face that covers a drill of 20 mm.
fn face(kind: usize, a: f64, b: f64) -> PartFace {
    match kind {
        0 => PartFace::Plane { inclination: (120.0 * a - 60.0).to_radians(), offset: 20.0 * b - 10.0 },
        1 => PartFace::OuterCylinder { radius: 12.0 + 60.0 * a, offset: (2.0 + 60.0 * a) * (2.0 * b - 1.0) },
        _ => PartFace::InnerCylinder { radius: 12.0 + 60.0 * a, offset: (2.0 + 60.0 * a) * (2.0 * b - 1.0) },
    }
}

fn mirrored(face: PartFace) -> PartFace {
    match face {
        PartFace::Plane { inclination, offset } => {
            PartFace::Plane { inclination: -inclination, offset: -offset }
        }
        PartFace::OuterCylinder { radius, offset } => PartFace::OuterCylinder { radius, offset: -offset },
        PartFace::InnerCylinder { radius, offset } => PartFace::InnerCylinder { radius, offset: -offset },
    }
}

fn near(a: Transient, b: Transient, within: f64) -> bool {
    (a.first - b.first).abs() < within && (a.last - b.last).abs() < within
}

fn plan(point: DrillPoint, entry: PartFace, exit: PartFace, length: f64, shift: f64) -> DrillPlan {
    let spec = DrillSpec {
        length,
        feed: FeedChoice { entry: Some(0.1), steady: 0.2, exit: Some(0.05) },
        guided: true,
        ..DrillSpec::new(
            20.0,
            point,
            entry.surface(Side::Entry, shift).unwrap(),
            exit.surface(Side::Exit, shift - length).unwrap(),
        )
    };
    plan_drill(&spec).unwrap()
}

proptest! {
    #![proptest_config(kinecut_cases::property(400))]

    #[test]
    fn lengths_and_zones_of_a_hole_fit_together(
        p in (0usize..11, 0.0..1.0, 0.0..1.0), e in (0usize..3, 0.0..1.0, 0.0..1.0), x in (0usize..3, 0.0..1.0, 0.0..1.0),
        length in 0.0..300.0, shift in -500.0..500.0,
    ) {
        let (point, entry, exit) = (point(p.0, p.1, p.2), face(e.0, e.1, e.2), face(x.0, x.1, x.2));
        let length = length + 150.0;
        let a = plan(point.clone(), entry, exit, length, 0.0);
        let (l, z) = (a.lengths, a.coordinates);
        prop_assert!(a.entry.first >= a.entry.last && a.exit.unwrap().first >= a.exit.unwrap().last);
        prop_assert!((l.entry + l.steady + l.exit.unwrap() - l.stroke).abs() < 1e-9);
        prop_assert!((l.entry - (2.0 + l.point + l.entry_surface)).abs() < 1e-9);
        prop_assert!((l.exit.unwrap() - (2.0 + l.point + l.exit_surface.unwrap())).abs() < 1e-9);
        prop_assert!((z.exit_own.unwrap()[0] - length - z.exit.unwrap()[0]).abs() < 1e-9);
        // Zones without gap from start to end, and a constant safe feed is never faster.
        prop_assert_eq!((a.zones[0].from, a.zones.last().unwrap().to), (a.travel.start, a.travel.end));
        prop_assert!(a.zones.windows(2).all(|w| w[0].to == w[1].from && w[0].from > w[0].to));
        prop_assert!(a.time <= a.constant_time * (1.0 + 1e-12));
        // Mirrored, and in a frame that lies elsewhere.
        let b = plan(point, mirrored(entry), mirrored(exit), length, shift);
        prop_assert!((b.time - a.time).abs() < 1e-6 * a.time);
        for (one, other) in a.zones.iter().zip(&b.zones) {
            prop_assert!((one.from + shift - other.from).abs() < 1e-9 && one.stage == other.stage);
        }
    }

    #[test]
    fn a_tolerance_of_the_surfaces_lengthens_every_zone_of_their_own(
        p in (0usize..11, 0.0..1.0, 0.0..1.0), e in (0usize..3, 0.0..1.0, 0.0..1.0), tolerance in 0.01..3.0,
    ) {
        let spec = |tolerance| DrillSpec {
            length: 200.0,
            tolerance,
            guided: true,
            ..DrillSpec::new(
                20.0,
                point(p.0, p.1, p.2),
                face(e.0, e.1, e.2).surface(Side::Entry, 0.0).unwrap(),
                face(1, 0.5, 0.5).surface(Side::Exit, -200.0).unwrap(),
            )
        };
        let (drawn, worst) = (plan_drill(&spec(0.0)).unwrap(), plan_drill(&spec(tolerance)).unwrap());
        let [a, b] = [&drawn, &worst].map(|p| (p.travel, p.entry.last, p.exit.unwrap().first));
        prop_assert!((b.0.start - a.0.start - tolerance).abs() < 1e-9 && (a.0.end - b.0.end - tolerance).abs() < 1e-9);
        prop_assert!((a.1 - b.1 - tolerance).abs() < 1e-9 && (b.2 - a.2 - tolerance).abs() < 1e-9);
    }

    #[test]
    fn entry_and_exit_swap_ridge_and_valley(p in (0usize..11, 0.0..1.0, 0.0..1.0), a in 0.0..1.0, b in 0.0..1.0) {
        let edge = point(p.0, p.1, p.2).edge(20.0).unwrap();
        let (outer, inner) = (face(1, a, b), face(2, a, b));
        let at = |f: PartFace, side| transient(&edge, &f.surface(side, 0.0).unwrap(), Cover::Whole).unwrap();
        prop_assert_eq!(at(outer, Side::Entry), at(inner, Side::Exit));
        prop_assert_eq!(at(outer, Side::Exit), at(inner, Side::Entry));
        // A plane is the same from both sides.
        let plane = face(0, a, b);
        prop_assert_eq!(at(plane, Side::Entry), at(plane, Side::Exit));
    }

    #[test]
    fn a_huge_cylinder_is_a_plane_and_everything_scales(p in (0usize..2, 0.0..1.0, 0.0..1.0), b in 0.0..1.0, c in 0.1..10.0) {
        let edge = point(p.0, p.1, p.2).edge(20.0).unwrap();
        let radius = 1e7;
        let flat = transient(&edge, &BoundarySurface::Plane { height: radius, slope: 0.0 }, Cover::Whole).unwrap();
        let ridge = BoundarySurface::Ridge { radius, offset: 10.0 * b, height: 0.0 };
        prop_assert!(near(transient(&edge, &ridge, Cover::Whole).unwrap(), flat, 1e-4));
        let (small, large) = (
            transient(&edge, &BoundarySurface::Valley { radius: 40.0, offset: 25.0 * b, height: 3.0 }, Cover::Whole).unwrap(),
            transient(
                &point(p.0, p.1, p.2).edge(20.0 * c).unwrap(),
                &BoundarySurface::Valley { radius: 40.0 * c, offset: 25.0 * b * c, height: 3.0 * c },
                Cover::Whole,
            ).unwrap(),
        );
        let scaled = Transient { first: small.first * c, last: small.last * c, ..small };
        prop_assert!(near(scaled, large, 1e-9 * (1.0 + 100.0 * c)));
    }

    #[test]
    fn a_hole_that_is_there_never_widens_the_entry(
        p in (0usize..2, 0.0..1.0, 0.0..1.0), e in (0usize..3, 0.0..1.0, 0.0..1.0), hole in 0.01..19.0,
    ) {
        let spec = |pre_hole| DrillSpec {
            pre_hole,
            end: End::Tip(-300.0),
            guided: true,
            ..DrillSpec::new(
                20.0,
                point(p.0, p.1, p.2),
                face(e.0, e.1, e.2).surface(Side::Entry, 0.0).unwrap(),
                BoundarySurface::Plane { height: 0.0, slope: 0.0 },
            )
        };
        let full = plan_drill(&spec(None)).unwrap().entry;
        let annulus = plan_drill(&spec(Some(PreHole::through(hole)))).unwrap().entry;
        prop_assert!(annulus.first <= full.first + 1e-9 && annulus.last >= full.last - 1e-9);
        // The smaller the hole, the less it changes.
        let tiny = plan_drill(&spec(Some(PreHole::through(1e-4)))).unwrap().entry;
        prop_assert!(near(tiny, full, 1e-3));
    }
}
