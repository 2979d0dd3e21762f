//! Crossings of real teeth with outlines against dense sampling, and the lengths they leave against the limit of many
//! teeth.

mod lengths;
mod sampling;
mod shapes;

use glam::dvec2;
use kinecut::facing::{FaceCase, Placement, Tooth, ToothCrossing, ToothedPass};
use kinecut::geom::Outline;
use proptest::prelude::*;
use sampling::{Sampled, sampled};
use shapes::{outlines, passes};

fn assert_same(have: &[ToothCrossing], want: &[Sampled]) {
    let mut have: Vec<_> = have.iter().map(|c| (c.tooth as usize, c.edge as usize, c.time, c.exit)).collect();
    have.sort_by(|a, b| (a.0, a.1).cmp(&(b.0, b.1)).then(a.2.total_cmp(&b.2)));
    assert_eq!(have.len(), want.len(), "{have:?}\n{want:?}");
    for (h, w) in have.iter().zip(want) {
        assert_eq!((h.0, h.1, h.3), (w.tooth, w.edge, w.exit));
        assert!((h.2 - w.time).abs() < 1e-7, "{h:?} against {w:?}");
    }
}

proptest! {
    #![proptest_config(kinecut_cases::property(200))]

    #[test]
    fn no_crossing_is_lost_or_invented(outline in outlines(), pass in passes(0.02..0.4)) {
        let Some(want) = sampled(&outline, &pass, 1.0, 600) else { return Ok(()) };
        let have = pass.crossings(&outline).unwrap();
        prop_assert_eq!(pass.count(&outline), have.len() as u64);
        assert_same(&have, &want);
        let moved = outline.moved(pass.placement.angle, dvec2(pass.along, 0.0));
        for c in &have {
            // The point lies on the edge at its share, and the tooth is there at its time.
            let edge = &moved.edges()[c.edge as usize];
            prop_assert!((edge.at(c.share) - c.point).length() < 1e-9);
            let tooth = sampling::position(&pass, c.tooth as usize, 1.0, c.time);
            prop_assert!((tooth - c.point).length() < 1e-9);
            let step = 1e-6;
            let velocity = (sampling::position(&pass, c.tooth as usize, 1.0, c.time + step) - tooth) / step;
            let angle = velocity.y.atan2(velocity.x) - edge.heading(c.share);
            prop_assert!((angle.sin() - c.exit_angle().sin()).abs() < 1e-4);
            prop_assert!((angle.cos() - c.exit_angle().cos()).abs() < 1e-4);
            prop_assert_eq!(c.exit, c.exit_angle() > 0.0);
            prop_assert!(((c.point.x - pass.feed_per_radian * c.time) - c.ahead * pass.teeth[c.tooth as usize].radius).abs() < 1e-9);
        }
    }

    #[test]
    fn a_left_hand_spindle_is_the_mirror_image(outline in outlines(), pass in passes(0.02..0.4)) {
        let Some(want) = sampled(&outline, &pass, -1.0, 600) else { return Ok(()) };
        let bad = kinecut::facing::BadSet::below(1.0).unwrap();
        let mirrored = FaceCase::new(outline.clone(), 1.0, bad).unwrap().mirrored();
        let pass = ToothedPass { placement: pass.placement.mirrored(), ..pass };
        let mut have = pass.crossings(&mirrored.outline).unwrap();
        for c in &mut have {
            let own = outline.loops().iter().find(|l| l.edges.contains(&(c.edge as usize))).unwrap();
            c.edge = (own.edges.start + own.edges.end - 1 - c.edge as usize) as u32;
        }
        assert_same(&have, &want);
    }

    #[test]
    fn each_tooth_enters_and_leaves_in_turn(outline in outlines(), pass in passes(0.0005..0.02)) {
        let all = pass.crossings(&outline).unwrap();
        for k in 0..pass.teeth.len() {
            let own: Vec<_> = all.iter().filter(|c| c.tooth as usize == k).collect();
            prop_assert!(own.len() % 2 == 0);
            prop_assert!(own.first().is_none_or(|c| !c.exit));
            for w in own.windows(2) {
                prop_assert!(w[0].exit != w[1].exit && w[0].time <= w[1].time, "{:?} {:?}", w[0], w[1]);
            }
        }
    }
}

#[test]
fn dense_samples_of_a_fine_feed_change_their_sign_as_often() {
    let outline = shapes::bracket_with_bore();
    let placement = Placement { angle: 0.83, offset: 21.0 };
    let pass = ToothedPass::even(1, 50.0, 6.0, placement).unwrap();
    let turns = (outline.bounds()[1] - outline.bounds()[0]).length() / 6.0;
    let want = sampled(&outline, &pass, 1.0, (400_001.0 / turns) as usize).unwrap();
    assert_same(&pass.crossings(&outline).unwrap(), &want);
    assert!(want.len() > 50, "{}", want.len());
}

/// Crossings of an edge near a time.
fn near(pass: &ToothedPass, outline: &Outline, time: f64, within: f64) -> Vec<ToothCrossing> {
    pass.crossings(outline).unwrap().into_iter().filter(|c| (c.time - time).abs() < within).collect()
}

#[test]
fn a_tooth_that_grazes_an_edge_does_not_cross_it() {
    for outline in [shapes::bracket_with_bore(), shapes::slot()] {
        for (angle, offset) in [(0.3, 25.0), (2.2, 4.0), (4.9, -20.0)] {
            let pass = ToothedPass::even(1, 50.0, 9.0, Placement { angle, offset }).unwrap();
            let moved = outline.moved(angle, glam::DVec2::ZERO);
            let grazes = sampling::tangencies(&moved, &pass);
            assert!(!grazes.is_empty());
            for g in grazes {
                // Shifting the part along the feed brings the tooth onto the edge, and beyond it.
                let at = |extra: f64| {
                    let pass = ToothedPass { along: pass.along + g.shift + extra, ..pass.clone() };
                    let mut close = near(&pass, &outline, g.time, 1e-3);
                    close.retain(|c| c.edge as usize == g.edge);
                    close.len()
                };
                assert_eq!(at(0.0), 0, "{g:?}");
                let sides = [at(1e-8), at(-1e-8)];
                assert!(sides == [0, 2] || sides == [2, 0], "{g:?} {sides:?}");
            }
        }
    }
    // An edge along the feed at the very side of the cutter.
    let plate = Outline::polygon(&[dvec2(0.0, 0.0), dvec2(100.0, 0.0), dvec2(100.0, 60.0), dvec2(0.0, 60.0)]);
    let plate = plate.unwrap();
    for (extra, want) in [(0.0, 0), (1e-9, 0), (-1e-9, 10)] {
        let pass = ToothedPass::even(1, 50.0, 10.0, Placement { angle: 0.0, offset: 10.0 - extra }).unwrap();
        let mut on_top = pass.crossings(&plate).unwrap();
        on_top.retain(|c| {
            plate.edges()[c.edge as usize].start.y == 60.0 && plate.edges()[c.edge as usize].end.y == 60.0
        });
        assert_eq!(on_top.len(), 2 * want, "{extra}");
    }
}

#[test]
fn a_tooth_through_a_vertex_crosses_once() {
    let mut through = 0;
    for outline in [shapes::bracket_with_bore(), shapes::slot()] {
        for (angle, offset) in [(0.0, 25.0), (0.3, 25.0), (2.2, 4.0), (4.9, -20.0)] {
            for front in [true, false] {
                let pass = ToothedPass::even(1, 50.0, 9.0, Placement { angle, offset }).unwrap();
                for edge in outline.edges() {
                    let vertex = edge.moved(angle, glam::DVec2::ZERO).start;
                    let Some((shift, time)) = sampling::meet(vertex, &pass, front) else { continue };
                    let count = |extra: f64| {
                        let pass = ToothedPass { along: shift + extra, ..pass.clone() };
                        let close = near(&pass, &outline, time, 1e-4);
                        assert!(close.windows(2).all(|w| w[0].exit != w[1].exit), "{close:?}");
                        close.len()
                    };
                    let sides = [count(1e-7), count(-1e-7)];
                    for ulps in -3..=3 {
                        let here = count(shift.abs() * f64::EPSILON * f64::from(ulps));
                        assert!(here <= 2);
                        if sides == [1, 1] {
                            assert_eq!(here, 1);
                            through += 1;
                        }
                    }
                }
            }
        }
    }
    assert!(through > 100, "{through}");
}

#[test]
fn a_pass_that_makes_no_sense_is_refused() {
    let placement = Placement { angle: 0.0, offset: 0.0 };
    let even = |teeth, radius, feed| ToothedPass::even(teeth, radius, feed, placement);
    for bad in [
        even(0, 50.0, 0.1),
        even(2, 0.0, 0.1),
        even(2, f64::NAN, 0.1),
        even(2, 50.0, 0.0),
        even(2, 50.0, 100.0),
    ] {
        assert_eq!(bad.unwrap_err().code(), kinecut::base::Code::FACE_CASE);
    }
    let odd = Tooth { phase: f64::INFINITY, radius: 1.0 };
    assert!(ToothedPass { teeth: vec![odd], ..even(1, 1.0, 0.1).unwrap() }.checked().is_err());
    // What is put together by hand crosses nothing, and says why when asked for all.
    for (feed_per_radian, radius) in [(0.0, 50.0), (100.0, 50.0), (f64::NAN, 50.0), (1.0, -3.0), (1.0, 0.0)] {
        let pass =
            ToothedPass { teeth: vec![Tooth { phase: 0.0, radius }], feed_per_radian, placement, along: 0.0 };
        pass.visit(&shapes::slot(), |c| panic!("{c:?}"));
        assert_eq!(pass.count(&shapes::slot()), 0);
        assert!(pass.crossings(&shapes::slot()).is_err());
    }
    let fine = ToothedPass { feed_per_radian: 2e-7, ..even(4, 1.0, 0.1).unwrap() }.checked().unwrap();
    assert!(fine.crossings(&shapes::slot()).is_err());
}
