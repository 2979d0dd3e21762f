//! What the writer of klartext says, and what it refuses.

use super::*;

#[test]
fn what_klartext_cannot_say_is_refused() {
    let refused = |change: &dyn Fn(&mut Builder)| {
        let mut b = Builder::new(DVec3::ZERO);
        change(&mut b);
        b.post(4).unwrap_err()
    };
    let error = refused(&|b| {
        b.state.blend = Blend::Stop;
        b.line(FEED, DVec3::X);
    });
    assert!(error.code() == Code::POST_CONTROL && error.to_string().contains("exact stop"), "{error}");
    let tool = |length: Option<u32>, radius: Option<u32>| {
        refused(&|b| b.program.push_tool(ToolNumber(7), length, radius, &b.state, Origin::default()))
    };
    for error in [tool(Some(10), None), tool(None, None), tool(Some(1), Some(2)), tool(Some(0), None)] {
        assert!(error.code() == Code::POST_CONTROL && error.to_string().contains("TOOL CALL"), "{error}");
    }
    assert_eq!(
        refused(&|b| b.program.push_dwell(3601.0, &b.state, Origin::default())).code(),
        Code::POST_NUMBER
    );
    // A rapid in exact stop loses nothing.
    let mut b = Builder::new(DVec3::ZERO);
    b.state.blend = Blend::Stop;
    b.line(RAPID, DVec3::X);
    assert!(b.post(4).is_ok());
}

#[test]
fn compensation_is_said_on_lines_and_read_back() {
    let mut b = Builder::new(DVec3::new(0.0, 0.0, 5.0));
    b.line(FEED, DVec3::new(0.0, 0.0, -2.0));
    b.state.comp = Comp::Left(1);
    b.line(FEED, DVec3::new(10.0, 0.0, -2.0));
    let arc = |start: DVec3| Arc {
        start,
        centre: DVec3::new(0.0, 0.0, -2.0),
        axis: DVec3::Z,
        sweep: TAU,
        rise: 0.0,
    };
    b.go(FEED, arc(b.at));
    b.state.comp = Comp::Off;
    b.line(FEED, DVec3::new(0.0, 0.0, -2.0));
    let text = b.post(4).unwrap();
    let wanted = ["L Z-2 F600", "L X+10 RL", "CC X+0 Y+0", "C X+10 Y+0 DR+", "L X+0 R0"];
    assert!(blocks(&text).windows(5).any(|w| w == wanted), "{text}");
    let comps: Vec<Comp> = all(&read(&text).program).iter().map(|m| m.2.comp).collect();
    assert_eq!(comps, [Comp::Off, Comp::Off, Comp::Left(1), Comp::Left(1), Comp::Off]);
    // It cannot begin on an arc.
    let mut b = Builder::new(DVec3::new(10.0, 0.0, -2.0));
    b.state.comp = Comp::Right(1);
    b.go(FEED, arc(b.at));
    assert_eq!(b.post(4).unwrap_err().code(), Code::COMPENSATION);
}

#[test]
fn another_line_of_the_tool_is_called_without_a_change() {
    let mut b = Builder::new(DVec3::new(0.0, 0.0, 5.0));
    b.state.spindle = Spindle::Clockwise(1500.0 / 60.0 * TAU);
    b.line(RAPID, DVec3::new(1.0, 0.0, 5.0));
    b.program.push_tool(ToolNumber(4), Some(2), Some(2), &b.state, Origin::default());
    b.line(RAPID, DVec3::new(1.0, 0.0, 5.0));
    b.state.comp = Comp::Left(2);
    b.line(FEED, DVec3::new(9.0, 0.0, 5.0));
    b.state.comp = Comp::Off;
    b.line(FEED, DVec3::new(9.0, 5.0, 5.0));
    let text = b.post(4).unwrap();
    let wanted = ["L X+1 R0 FMAX", "TOOL CALL 4.2 Z S1500", "L Z+5 R0 FMAX", "L X+9 RL F600", "L Y+5 R0"];
    assert!(
        text.contains(" TOOL CALL 4 Z S1500\n") && blocks(&text).windows(5).any(|w| w == wanted),
        "{text}"
    );
    let back = read(&text).program;
    let last = all(&back).len() - 1;
    assert_eq!(all(&back)[last - 1].2.comp, Comp::Left(2));
    assert!(matches!(all(&back)[last].2.spindle, Spindle::Clockwise(_)));
}

#[test]
fn a_hole_drilled_in_one_go_is_a_cycle_and_any_other_its_moves() {
    let mut b = Builder::new(DVec3::new(0.0, 0.0, 50.0));
    let hole = |retract: f64| Cycle::Drill { reference: 2.0, bottom: -15.5, retract, dwell: 0.25 };
    let low = Cycle::Drill { reference: -3.0, bottom: -5.0, retract: -3.0, dwell: 0.0 };
    let peck = Cycle::Peck { reference: 2.0, bottom: -5.0, retract: 50.0, step: 4.0, clearance: 0.5 };
    for (x, cycle) in [(10.0, hole(50.0)), (20.0, hole(50.0)), (30.0, low), (40.0, peck)] {
        b.line(RAPID, DVec3::new(x, 0.0, 50.0));
        b.state.speed = Speed::PerMinute(2.0);
        b.program.push_cycle(cycle, &b.state, Origin::default()).unwrap();
    }
    let text = b.post(4).unwrap();
    let wanted = "\
        X+10 R0 FMAX|CYCL DEF 200 DRILLING ~|Q200=+2 ;SET-UP CLEARANCE ~|Q201=-15.5 ;DEPTH ~|\
        Q206=+120 ;FEED RATE FOR PLNGNG ~|Q202=+15.5 ;PLUNGING DEPTH ~|Q210=+0 ;DWELL TIME AT TOP ~|\
        Q203=+0 ;SURFACE COORDINATE ~|Q204=+50 ;2ND SET-UP CLEARANCE ~|Q211=+0.25 ;DWELL TIME AT DEPTH|CYCL CALL|\
        L X+20 R0 FMAX|CYCL CALL|L X+30 R0 FMAX|CYCL DEF 200 DRILLING ~|Q200=+0 ;SET-UP CLEARANCE ~|Q201=-2 ;DEPTH ~";
    let lines: Vec<&str> = text
        .lines()
        .map(|l| l.trim_start().trim_start_matches(|c: char| c.is_ascii_digit()).trim_start())
        .collect();
    assert!(lines.join("|").contains(wanted), "{text}");
    assert_eq!(text.matches("CYCL CALL").count(), 3, "{text}");
    let back = read(&text).program;
    let cycles: Vec<Cycle> = (0..back.items.len())
        .filter_map(|i| if let Item::Cycle(c, _) = back.items.get(i) { Some(*c) } else { None })
        .collect();
    assert_eq!(cycles, [hole(50.0), hole(50.0), low]);
    let settings = PostSettings::new(Control::Heidenhain);
    assert_eq!(nc::write(&back, &[], &settings).unwrap().text.to_string(), text);
}

#[test]
fn the_raw_part_is_drawn_in_the_coordinates_of_the_program() {
    // Part turned by a quarter about Z on the table; the datum on its upper corner.
    let turn =
        Rigid { rotation: glam::DMat3::from_rotation_z(FRAC_PI_2), translation: DVec3::new(100.0, 0.0, 0.0) };
    let setup = Setup {
        name: "one".to_owned(),
        part_on_table: turn,
        work_offsets: BTreeMap::from([(
            WorkOffset::G54,
            Rigid::from_translation(DVec3::new(100.0, 0.0, 20.0)),
        )]),
        located: false,
        stock: Some(Solid::Box(Aabb { min: DVec3::ZERO, max: DVec3::new(60.0, 30.0, 20.0) })),
        fixtures: Vec::new(),
    };
    let mut b = Builder::new(DVec3::new(0.0, 0.0, 5.0));
    b.program.setups.push(setup);
    let text = b.post(3).unwrap();
    assert!(
        text.starts_with(
            "0 BEGIN PGM PROGRAM MM\n1 BLK FORM 0.1 Z X-30 Y+0 Z-20\n2 BLK FORM 0.2 X+0 Y+60 Z+0\n"
        ),
        "{text}"
    );
}

#[test]
fn arcs_out_of_the_plane_become_lines_within_the_tolerance() {
    let mut b = Builder::new(DVec3::new(5.0, 0.0, 0.0));
    b.go(FEED, Arc { start: b.at, centre: DVec3::ZERO, axis: DVec3::Y, sweep: PI, rise: 0.0 });
    let settings = PostSettings { arc_tolerance: 0.001, ..PostSettings::new(Control::Heidenhain) };
    let posted = nc::write(&b.program, &[], &settings).unwrap();
    assert_eq!(posted.notes.chain_tolerance, 0.001);
    let found = all(&read(&posted.text).program);
    assert!((20..200).contains(&found.len()), "{}", found.len());
    for (curve, _, _) in &found[1..] {
        let curve = curve.as_ref().unwrap();
        for k in 0..=4 {
            let p = curve.at(curve.length() * f64::from(k) / 4.0).p;
            assert!((p.length() - 5.0).abs() < 0.0011 && p.y == 0.0 && p.z < 1e-4, "{p}");
        }
    }
    assert!(near(point(&found[found.len() - 1].1), [-5.0, 0.0, 0.0]));
}

#[test]
fn names_and_numbers_of_blocks() {
    let program = Builder::new(DVec3::ZERO).program;
    let mut settings = PostSettings::new(Control::Heidenhain);
    settings.program_name = "a b\n;~\u{e4}(1)-2".to_owned();
    let text = nc::write(&program, &[], &settings).unwrap().text;
    assert!(text.starts_with("0 BEGIN PGM AB1-2 MM\n1 ; a b\n"), "{text}");
    assert!(text.ends_with("END PGM AB1-2 MM\n"));
    assert!(!text.replace("SETTING ~\n", "").contains('~'), "{text}");
    let numbers: Vec<usize> = text
        .lines()
        .filter(|l| !l.starts_with(' '))
        .map(|l| l.split(' ').next().unwrap().parse().unwrap())
        .collect();
    assert_eq!(numbers, (0..numbers.len()).collect::<Vec<_>>());
    settings.block_numbers = false;
    let bare = nc::write(&program, &[], &settings).unwrap().text;
    assert!(bare.starts_with("BEGIN PGM"));
    assert_eq!(all(&read(&bare).program).len(), all(&read(&text).program).len());
}

#[test]
fn a_tool_vector_is_not_written() {
    let mut b = Builder::new(DVec3::ZERO);
    let end = Target::Tip { point: DVec3::X, axis: ToolAxis::Vector(DVec3::Z) };
    b.program.push_move(Move { end, path: Path::Line }, &b.state, Origin::default());
    assert_eq!(b.post(4).unwrap_err().code(), Code::POST_CONTROL);
}
