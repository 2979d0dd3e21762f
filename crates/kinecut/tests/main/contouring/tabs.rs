//! Tabs as planned: their places, width and height, over all contours.

use super::*;

#[test]
fn tabs_stand_where_they_are_told_and_as_high() {
    for (shape, centre_cutting, ramp) in [
        (TabShape::Flat, true, Some(0.05)),
        (TabShape::Flat, true, None),
        (TabShape::Ramp, true, Some(0.05)),
        (TabShape::Flat, false, Some(0.05)),
    ] {
        let tabs = Tabs { count: 3, width: 5.0, height: 2.0, shape, finish: true, places: vec![] };
        let finish = ContourFinish {
            allowance: 0.2,
            feed: 15.0,
            stepdown: None,
            spring_passes: 0,
            wear: None,
            corner_feed: false,
        };
        let spec = ContourSpec {
            tabs: Some(tabs),
            ramp,
            finish: Some(finish),
            cutter: CutterData { centre_cutting, ..CUTTER },
            breakthrough: 0.5,
            ..spec(rectangle(120.0, 80.0))
        };
        let plan = plan_contour(&spec).unwrap();
        sound(&spec, &plan);
        assert!(plan.findings.is_empty(), "{:?}", plan.findings);
        for one in &plan.loops {
            assert_eq!(one.tabs.len(), 3);
            for tab in &one.tabs {
                assert!((tab.lifted() - 11.0).abs() < 1e-9);
                // No move comes below the tab's top over its width and the cutter's.
                let low = lowest(&plan, |p| p.truncate().distance(tab.at) < 5.45);
                assert!((low - -8.0).abs() < 1e-9, "{shape:?} {centre_cutting} {low}");
            }
        }
        if !centre_cutting {
            // Down from a tab it goes along the ramp.
            for m in plan.moves.iter().filter(|m| is_feed(m) && m.curve.start().z < 0.0) {
                let fall = m.curve.start().z - m.curve.end().z;
                assert!(fall < 1e-9 || (fall / m.curve.length()).asin() < 0.0501, "{m:?}");
            }
        }
    }
}

/// Least height of the cutter at places, over all moves.
fn lowest(plan: &ContourPlan, at: impl Fn(DVec3) -> bool) -> f64 {
    let points = |m: &PlannedMove| {
        let curve = m.curve.clone();
        (0..=400).map(move |k| curve.at(curve.length() * f64::from(k) / 400.0).p)
    };
    plan.moves.iter().flat_map(points).filter(|p| at(*p)).map(|p| p.z).fold(f64::INFINITY, f64::min)
}

#[test]
fn finishing_under_compensation_leaves_tabs_their_width() {
    let tabs =
        Tabs { count: 2, width: 5.0, height: 2.0, shape: TabShape::Flat, finish: true, places: vec![] };
    let wear = Some(Wear { register: 2, largest: 0.05 });
    let finish = ContourFinish {
        allowance: 0.2,
        feed: 15.0,
        stepdown: None,
        spring_passes: 0,
        wear,
        corner_feed: false,
    };
    let spec = ContourSpec { tabs: Some(tabs), finish: Some(finish), ..spec(rectangle(120.0, 80.0)) };
    let plan = plan_contour(&spec).unwrap();
    sound(&spec, &plan);
    for one in &plan.loops {
        for tab in &one.tabs {
            assert!((lowest(&plan, |p| p.truncate().distance(tab.at) < 5.4) - -8.0).abs() < 1e-9);
        }
    }
    // The slopes, as long as they are said to be, lie beside.
    assert!((spec.slopes(2.0, true)[0] - 2.0 * 3f64.sqrt()).abs() < 1e-12);
    let tab = plan.loops.last().unwrap().tabs[0];
    let finishing =
        ContourPlan { moves: plan.moves.iter().filter(|m| m.finishing).cloned().collect(), ..plan };
    let half = 5.5 + 2.0 * 3f64.sqrt();
    assert!(lowest(&finishing, |p| p.truncate().distance(tab.at) < half - 0.2) > -10.0 + 0.1);
    assert!((lowest(&finishing, |p| p.truncate().distance(tab.at) < half + 0.2) - -10.0).abs() < 1e-9);
    let is_upright =
        |m: &&PlannedMove| m.comp && (m.curve.end() - m.curve.start()).truncate().length() < 1e-9;
    assert_eq!(finishing.moves.iter().filter(is_upright).count(), 0);
}

#[test]
fn whatever_the_contour_tabs_keep_their_width_and_ways_down_their_angle() {
    let mut random = Random(11);
    let mut planned = 0;
    for round in 0..150 {
        let (x, y) = (random.between(60.0, 160.0), random.between(50.0, 120.0));
        let shape = if random.share() < 0.5 { TabShape::Flat } else { TabShape::Ramp };
        let (width, height) = (random.between(1.0, 6.0), random.between(0.5, 4.0));
        let tabs =
            Tabs { count: 1 + random.below(5) as u32, width, height, shape, finish: true, places: vec![] };
        let wear = (random.share() < 0.5).then_some(Wear { register: 2, largest: 0.05 });
        let finish = ContourFinish {
            allowance: 0.2,
            feed: 15.0,
            stepdown: None,
            spring_passes: 1,
            wear,
            corner_feed: false,
        };
        let centre_cutting = random.share() < 0.6;
        let plunges = centre_cutting && random.share() < 0.3;
        let angle = random.between(0.03, 0.4);
        let spec = ContourSpec {
            side: if random.share() < 0.5 { ContourSide::Inside } else { ContourSide::Outside },
            sense: if random.share() < 0.5 { Sense::Climb } else { Sense::Conventional },
            ramp: (!plunges).then_some(angle),
            finish: (random.share() < 0.7).then_some(finish),
            cutter: CutterData { centre_cutting, ..CUTTER },
            stepdown: Some(random.between(1.0, 10.0)),
            breakthrough: if random.share() < 0.5 { 0.7 } else { 0.0 },
            tabs: Some(tabs),
            ..spec(rectangle(x, y).moved(random.between(0.0, 6.0), DVec2::ZERO))
        };
        let plan = match plan_contour(&spec) {
            Ok(plan) => plan,
            Err(e) if e.code() == Code::LEAD_ROOM => continue,
            Err(e) => panic!("{round}: {e}"),
        };
        planned += 1;
        sound(&spec, &plan);
        let half = 0.5 * width + 3.0 - 0.05;
        for tab in plan.loops.iter().flat_map(|l| &l.tabs) {
            let low = lowest(&plan, |p| p.truncate().distance(tab.at) < half);
            assert!(low >= spec.top - spec.depth + height - 1e-9, "{round}: {low} at {tab:?} of {spec:?}");
        }
        for pair in plan.moves.windows(2) {
            let [way, next] = [&pair[0].curve, &pair[1].curve].map(|c| c.end() - c.start());
            let (flat, flat_next) = (way.truncate(), next.truncate());
            // Feed moves along the path never turn back, and never fall steeper than the cutter can.
            let along = pair
                .iter()
                .all(|m| [ToolpathRole::Entry, ToolpathRole::Circle, ToolpathRole::Finish].contains(&m.role));
            let is_back =
                flat.length() > 1e-6 && flat_next.length() > 1e-6 && flat.angle_to(flat_next).abs() > 3.0;
            assert!(!(along && is_back), "{round}: {pair:?}");
            if !centre_cutting && is_feed(&pair[1]) && pair[1].curve.start().z < -1e-9 {
                assert!(next.z > -1e-9 || -next.z <= pair[1].curve.length() * angle.sin() + 1e-9, "{pair:?}");
            }
            assert!(!pair[1].comp || flat_next.length() > 1e-9, "{round}: {pair:?}");
        }
    }
    assert!(planned > 120, "{planned}");
}

#[test]
fn tabs_that_run_into_one_another_are_one() {
    let tabs = Tabs {
        count: 2,
        width: 5.0,
        height: 2.0,
        shape: TabShape::Flat,
        finish: true,
        places: vec![dvec2(50.0, 80.0), dvec2(70.0, 80.0)],
    };
    // A cutter without centre teeth comes down over 20 mm behind a tab: on the next one.
    let cutter = CutterData { centre_cutting: false, ..CUTTER };
    let apart = |cutter: CutterData| {
        let spec =
            ContourSpec { tabs: Some(tabs.clone()), ramp: Some(0.1), cutter, ..spec(rectangle(120.0, 80.0)) };
        let plan = plan_contour(&spec).unwrap();
        sound(&spec, &plan);
        let between = lowest(&plan, |p| (59.0..61.0).contains(&p.x) && p.y > 80.0);
        // It never goes back along the edge.
        let on_edge = |m: &&PlannedMove| m.curve.start().y > 82.9 && m.curve.end().y > 82.9 && m.level > 0;
        let back = plan.moves.iter().filter(|m| m.role == ToolpathRole::Circle).filter(on_edge);
        assert!(back.clone().count() > 0);
        for m in back {
            assert!(m.curve.end().x > m.curve.start().x - 1e-9, "{m:?}");
        }
        (between, plan.findings)
    };
    let (between, findings) = apart(cutter);
    assert!((between - -8.0).abs() < 1e-9, "{between}");
    assert!(findings.len() == 1 && findings[0].code == Code::TABS, "{findings:?}");
    assert!(findings[0].message.contains("run into one another and are 1"), "{findings:?}");
    let (between, findings) = apart(CUTTER);
    assert!((between - -10.0).abs() < 1e-9 && findings.is_empty(), "{between}");
    // Low parts all around: nothing of the tabs' height is cut.
    let all = ContourSpec {
        tabs: Some(Tabs { count: 3, places: vec![], ..tabs.clone() }),
        ramp: Some(0.01),
        cutter,
        ..spec(rectangle(120.0, 80.0))
    };
    let plan = plan_contour(&all).unwrap();
    sound(&all, &plan);
    assert!((lowest(&plan, |_| true) - -8.0).abs() < 1e-9);
    assert!(plan.findings[0].message.contains("hold all of it"), "{:?}", plan.findings);
}

#[test]
fn tabs_go_through_all_loops_beside_one_another() {
    let plate = rectangle(90.0, 60.0);
    let tabs =
        Tabs { count: 4, width: 5.0, height: 1.5, shape: TabShape::Flat, finish: true, places: vec![] };
    let spec = ContourSpec { loops_beside: Some((3, 4.0)), tabs: Some(tabs), ..spec(plate.clone()) };
    let plan = plan_contour(&spec).unwrap();
    sound(&spec, &plan);
    // The farthest from the wall first.
    let away: Vec<f64> = plan.loops.iter().map(|l| signed(&plate, l.edges[0].at(0.5))).collect();
    assert!(away.iter().zip([11.0, 7.0, 3.0]).all(|(a, b)| (a - b).abs() < 1e-9), "{away:?}");
    assert_eq!(plan.loops.iter().map(|l| l.farther).collect::<Vec<_>>(), [8.0, 4.0, 0.0]);
    // Nothing below the top of a tab comes within half its width of the line straight out from its middle.
    for tab in &plan.loops[2].tabs {
        let foot =
            plate.edges().iter().map(|e| (e, e.nearest(tab.at))).min_by(|a, b| a.1.1.total_cmp(&b.1.1));
        let out = (tab.at - foot.map(|(e, (s, _))| e.at(s)).unwrap()).try_normalize().unwrap();
        for m in plan.moves.iter() {
            for i in 0..=40 {
                let p = m.curve.at(m.curve.length() * f64::from(i) / 40.0).p;
                let along = (p.truncate() - tab.at).dot(out);
                let beside = (p.truncate() - tab.at).perp_dot(out).abs();
                let is_near = (-0.1..8.1).contains(&along) && beside < 2.5 + 3.0 - 1e-6;
                assert!(!is_near || p.z >= spec.bottom() + 1.5 - 1e-9, "{p} {tab:?}");
            }
        }
    }
}
