//! LinuxCNC: parameters, expressions, O words, `M98`.
//!
//! Expected values are those of the interpreter's stand-alone version (2.9), or of its documentation.

use crate::{moves, read, refused, run};
use kinecut_nc::base::Sources;
use kinecut_nc::nc::Control::{Fanuc, LinuxCnc};
use kinecut_nc::nc::{self, PostSettings, ReadSettings};
use kinecut_nc::program::{Coolant, Item};

#[test]
fn words_take_values() {
    assert_eq!(
        run("#1=2\n#<depth>=-[1.5*#1]\nX[#1+1] Y-#1 ZSIN[30]\nG0 Z#<Dep th>", LinuxCnc),
        ["R 3 -2 0.5", "R 3 -2 -3"]
    );
    assert_eq!(run("X--5 Y-[2-5] Z- 1", LinuxCnc), ["R 5 3 -1"]);
}

#[test]
fn a_block_sets_its_parameters_after_it_has_read_them() {
    assert_eq!(run("#1=2\n#1=[#1+1] #2=#1 X#1\nX#1 Y#2", LinuxCnc), ["R 2 0 0", "R 3 2 0"]);
    assert_eq!(run("#1=2 #1=3\nX#1", LinuxCnc), ["R 3 0 0"]);
}

#[test]
fn positions_and_state_have_names() {
    assert_eq!(run("X1 Y2 Z3\nX[#5420+#<_y>] Y#5422", LinuxCnc), ["R 1 2 3", "R 3 3 3"]);
    assert_eq!(run("G20 X1\nX[#5420*2+#<_imperial>+#<_metric>]", LinuxCnc), ["R 25.4 0 0", "R 76.2 0 0"]);
    assert_eq!(
        run("G91 G18 F120 S1000 M3\nX[#<_incremental>+#<_plane>+#<_feed>+#<_rpm>]", LinuxCnc),
        ["R 1301 0 0"]
    );
    assert!(refused("X#5221", LinuxCnc).contains("`#5221` has no value: the machine knows its offsets"));
    assert!(refused("X#<width>", LinuxCnc).contains("`#<width>` has no value: nothing has set it"));
    assert!(refused("#5420=1", LinuxCnc).contains("the control keeps its own state"));
    assert!(refused("#<_feed>=1", LinuxCnc).contains("the control alone sets this parameter"));
}

#[test]
fn a_parameter_that_is_not_set_is_said() {
    let reading = read("G21 G54 G0 X#100 Y#101 Z1\nM2\n", LinuxCnc).unwrap();
    assert_eq!(moves(&reading), ["R 0 0 1"]);
    let found: Vec<&str> = reading.findings.iter().map(|f| f.message.as_str()).collect();
    assert!(found.contains(&"#100 is read before the program sets it: 0 is assumed"), "{found:?}");
}

#[test]
fn branches_go_one_way() {
    let body = |value: i32| {
        run(
            &format!(
                "#1={value}\no1 if [#1 EQ 1]\nX1\no1 elseif [#1 EQ 2] (two)\nX2\no1 else\nX3\no2 if [1]\nY1\no2 endif\no1 endif\nZ9"
            ),
            LinuxCnc,
        )
    };
    assert_eq!(body(1), ["R 1 0 0", "R 1 0 9"]);
    assert_eq!(body(2), ["R 2 0 0", "R 2 0 9"]);
    assert_eq!(body(3), ["R 3 0 0", "R 3 1 0", "R 3 1 9"]);
    // What is skipped is not read.
    assert_eq!(run("o1 if [0]\nX[1/0] nonsense\no1 endif\nX1", LinuxCnc), ["R 1 0 0"]);
}

#[test]
fn loops_end_as_the_interpreter_ends_them() {
    // A `while` loop with a `break` that was not run: the next `do` loop ends after one turn.
    let while_loop =
        "#1=0\no1 while [#1 LT 2]\n#1=[#1+1]\no2 if [#1 EQ 9]\no1 break\no2 endif\no1 endwhile\n";
    let do_loop = "#1=0\no3 do\n#1=[#1+1]\nX#1\no3 while [#1 LT 3]";
    assert_eq!(run(&format!("{while_loop}{do_loop}"), LinuxCnc), ["R 1 0 0"]);
    assert_eq!(run(do_loop, LinuxCnc).len(), 3);
    assert_eq!(run(&format!("{while_loop}{do_loop}\n{}", do_loop.replace("o3", "o4")), LinuxCnc).len(), 4);
    let reading = read(&format!("G21 G54 G0 X0 Y0 Z0\n{while_loop}{do_loop}\nM2\n"), LinuxCnc).unwrap();
    let said = reading.findings.iter().filter(|f| f.message.contains("ends this loop although")).count();
    assert_eq!(said, 1);
    // A `continue` of a `do` loop passes its `break`; without one it makes the next `break` of a `while` a `continue`.
    let passes = "#1=0\no1 do\n#1=[#1+1]\nX#1\no2 if [#1 EQ 2]\no1 continue\no2 endif\no3 if [0]\no1 break\no3 endif\no1 while [#1 LT 5]";
    assert_eq!(run(passes, LinuxCnc).len(), 2);
    let before = "#1=0\no1 do\n#1=[#1+1]\nX#1\no2 if [#1 EQ 9]\no1 break\no2 endif\no3 if [#1 EQ 2]\no1 continue\no3 endif\no1 while [#1 LT 4]";
    assert_eq!(run(before, LinuxCnc).len(), 4);
    let goes_on =
        "o1 do\no1 continue\no1 while [0]\n#1=0\no2 while [#1 LT 5]\n#1=[#1+1]\nX#1\no2 break\no2 endwhile";
    assert_eq!(run(goes_on, LinuxCnc), ["R 1 0 0", "R 2 0 0"]);
    let again = "o1 do\no1 continue\no1 while [0]\nG91\no2 repeat [2]\nX1\no2 endrepeat";
    assert_eq!(run(again, LinuxCnc).len(), 4);
    assert_eq!(
        run("G91\no1 repeat [2.5]\nX1\no1 endrepeat\no2 repeat [0.5]\nX1\no2 endrepeat", LinuxCnc).len(),
        2
    );
    let nested = refused("o1 sub\no2 sub\no2 endsub\no1 endsub", LinuxCnc);
    assert!(nested.contains("a subprogram begins within another one"), "{nested}");
    let called = refused("o1 call\nM2\no1 sub\nX1\no2 sub\no2 endsub\no1 endsub", LinuxCnc);
    assert!(called.contains("a subprogram begins within another one"), "{called}");
    // A bottom above R is refused in every cycle.
    for cycle in ["G81", "G85", "S100 M3\nG84", "G82 P1"] {
        let up = refused(&format!("F100\n{cycle} X1 R-5 Z-2"), LinuxCnc);
        assert!(up.contains("its bottom below the reference height"), "{cycle}: {up}");
    }
}

#[test]
fn mist_and_flood_are_on_together() {
    let states = |text: &str, control| {
        let reading = read(&format!("G21 G54 G0 X0 Y0 Z0\n{text}\nM30\n"), control).unwrap();
        let items = &reading.program.items;
        let moves = (0..items.len()).filter(|i| matches!(items.get(*i), Item::Move(_)));
        moves.map(|i| reading.program.state(i).coolant).collect::<Vec<_>>().split_off(1)
    };
    let text = "M7\nX1\nM8\nX2\nM7\nX3\nM9\nX4";
    assert_eq!(states(text, LinuxCnc), [Coolant::Mist, Coolant::Both, Coolant::Both, Coolant::Off]);
    // What a FANUC machine makes of it is its builder's.
    assert_eq!(states(text, Fanuc), [Coolant::Mist, Coolant::Flood, Coolant::Mist, Coolant::Off]);
    let reading = read("G21 G54 G0 X0 Y0 Z0\nM7\nM8\nX2\nM30\n", LinuxCnc).unwrap();
    let written = nc::write(&reading.program, &[], &PostSettings::new(LinuxCnc)).unwrap().text;
    assert!(written.contains("M7\nM8\nG0 X2"), "{written}");
    let other = nc::write(&reading.program, &[], &PostSettings::new(Fanuc)).unwrap_err();
    assert!(other.to_string().contains("mist and flood on together"), "{other}");
}

#[test]
fn loops_turn_as_often_as_they_say() {
    assert_eq!(
        run(
            "#1=0\no1 while [#1 LT 3]\n#1=[#1+1]\no2 if [#1 EQ 2]\no1 continue\no2 endif\nX#1\no1 endwhile",
            LinuxCnc
        ),
        ["R 1 0 0", "R 3 0 0"]
    );
    assert_eq!(
        run(
            "#1=0\no1 do\n#1=[#1+1]\nX#1\no2 if [#1 EQ 2]\no1 break\no2 endif\no1 while [#1 LT 9]\nY1",
            LinuxCnc
        ),
        ["R 1 0 0", "R 2 0 0", "R 2 1 0"]
    );
    assert_eq!(
        run("G91\no1 repeat [2]\nX1\no2 repeat[2]\nY1\no2 endrepeat\no1 endrepeat", LinuxCnc).len(),
        6
    );
    assert_eq!(
        run("o1 repeat [0]\nX1\no1 endrepeat\no2 while [0]\nX1\no2 endwhile\nY1", LinuxCnc),
        ["R 0 1 0"]
    );
}

#[test]
fn subprograms_have_their_own_parameters() {
    let text = "o<go> sub ([x] [y])\nX#1 Y#2 Z#3\n#1=50 #<own>=1\no<GO> endsub [#2*2]\n#1=7 #<own>=3\no<go> call [1] [2]\nX#1 Y#<own> Z#<_value>\no9 call [5]\no9 sub\nX#1\no9 endsub";
    assert_eq!(run(text, LinuxCnc), ["R 1 2 0", "R 7 3 4", "R 5 3 4"]);
    let back = "o1 sub\no2 while [1]\n#1=[#1+1]\no3 if [#1 GT 4]\no1 return [#1]\no3 endif\no2 endwhile\no1 endsub\no1 call [1]\nX#<_value> Y#<_value_returned>";
    assert_eq!(run(back, LinuxCnc), ["R 5 1 0"]);
}

#[test]
fn programs_are_called_by_number() {
    let text = "#1=5\nM98 P1 L3\nX#1\nM2\nO1\nG91 X1\n#1=[#1+1]\nG90 M99";
    assert_eq!(run(text, LinuxCnc), ["R 1 0 0", "R 2 0 0", "R 3 0 0", "R 8 0 0"]);
    assert_eq!(run("M98 P1 L0\nX1\nM2\nO1\nX9\nM99", LinuxCnc), ["R 1 0 0"]);
}

#[test]
fn each_fault_is_said_where_it_is() {
    let cases = [
        ("o1 call", "the subprogram `1` that is called is not in this file"),
        ("M98 P7", "the program O7 that is called is not in this file"),
        ("o1 endif", "has no beginning of its label"),
        ("o1 while [1]\nX1", "has no `endwhile` of its label behind it"),
        ("o1 return", "`return` outside of a subprogram"),
        ("o1 sub\nG0 X[1/0]\no1 endsub\no1 call", "division by zero; called in line 5 of a.nc"),
        ("o1 sub\no1 call\no1 endsub\no1 call", "nested deeper than the control allows"),
        ("o1 repeat [2]\no1 break\no1 endrepeat", "no break or continue of a repeat"),
        ("o1 while 1\no1 endwhile", "`1` is where `[` belongs"),
        ("o1 call [1] X5\no1 sub\no1 endsub", "nothing but a comment follows here"),
        ("#1", "is given to a parameter with `=`"),
    ];
    for (body, expected) in cases {
        let error = refused(body, LinuxCnc);
        assert!(error.contains(expected), "{body}: {error}");
        assert!(error.starts_with("a.nc:"), "{error}");
    }
}

#[test]
fn a_program_that_never_ends_is_refused() {
    for body in [
        "o1 while [1]\nX1\nX0\no1 endwhile",
        "#1=1\no1 do\n#1=[0-#1]\no1 while [1]",
        "o1 sub\n#31=[#31+1]\no1 endsub\no2 while [1]\no1 call\n#31=[#31 MOD 1000]\no2 endwhile",
    ] {
        assert!(refused(body, LinuxCnc).contains("it never ends"), "{body}");
    }
}

#[test]
fn a_feed_move_from_nowhere_is_said_and_its_end_is_known() {
    let reading = read("G21 G54\nG1 X1 Y2 F100\nG1 Z-1\nX5\nM2\n", LinuxCnc).unwrap();
    assert_eq!(moves(&reading), ["F 1 2 ?", "F 1 2 -1", "F 5 2 -1"]);
    let found: Vec<&str> = reading.findings.iter().map(|f| f.message.as_str()).collect();
    assert!(
        found.contains(
            &"the program has not set the position where a feed move starts, which is not followed: lines 2, 3"
        ),
        "{found:?}"
    );
}

#[test]
fn splines_are_curves() {
    let body = "G1 X5 Y5 F100\nG5.2 X5 Y10 P1 L3\nX10 Y10 P2\nX10 Y5 P1\nG5.3\nG1 X0 Y0\nG5.1 X2 Y0 I1 J1";
    let done = run(body, LinuxCnc);
    assert_eq!((done[0].as_str(), done.last().unwrap().as_str()), ("F 5 5 0", "F 2 0 0"));
    assert!(done.contains(&"F 10 5 0".to_owned()) && done.len() > 6, "{done:?}");
    for (body, expected) in [
        ("F100\nG5.3", "a spline without control points"),
        ("F100\nG5.2 X1 Y1\nG5.3", "a control point without its weight P"),
        ("F100\nG5.2 X1 P1\nG5.3", "a control point needs both X and Y"),
        ("F100\nG5.2 X1 Y1 P1\nG5.3", "fewer control points than its order"),
        ("F100\nG5.2 X1 Y1 P1\nG0 X0", "another motion before the spline is run"),
        ("F100\nG5.2 X1 Y1 P-1\nG5.3", "the weight of a control point is positive"),
        ("F100 G5.2 X1 Y1 P1 L99999", "the order of a spline is out of range"),
    ] {
        let error = refused(body, LinuxCnc);
        assert!(error.contains(expected), "{body}: {error}");
    }
}

#[test]
fn cycles_run_along_the_axis_that_is_square_to_the_plane() {
    let body = "G0 X0 Y9 Z0\nG18 G98 G81 X1 Z2 Y-5 R2 F100\nX3\nG80";
    assert_eq!(
        run(body, LinuxCnc),
        ["R 0 9 0", "R 1 9 2", "R 1 2 2", "F 1 -5 2", "R 1 9 2", "R 3 9 2", "R 3 2 2", "F 3 -5 2", "R 3 9 2"]
    );
    let body = "G0 X9 Y0 Z0\nG19 G99 G83 Y1 Z2 X-1 R2 Q2 F100\nG80";
    assert_eq!(
        run(body, LinuxCnc),
        ["R 9 0 0", "R 9 1 2", "R 2 1 2", "F 0 1 2", "R 2 1 2", "R 0.254 1 2", "F -1 1 2", "R 2 1 2"]
    );
}

#[test]
fn bores_and_floating_taps_come_back_at_feed() {
    assert_eq!(
        run("G0 Z9\nG98 G85 X1 Z-5 R2 F100", LinuxCnc),
        ["R 0 0 9", "R 1 0 9", "R 1 0 2", "F 1 0 -5", "F 1 0 2", "R 1 0 9"]
    );
    assert_eq!(
        run("G0 Z9\nM3 S100\nG99 G84 X1 Z-5 R2 F100", LinuxCnc),
        ["R 0 0 9", "R 1 0 9", "R 1 0 2", "F 1 0 -5", "F 1 0 2"]
    );
    assert_eq!(
        run("G0 Z9\nM3 S100\nG99 G86 X1 Z-5 R2 P1 F100", LinuxCnc),
        ["R 0 0 9", "R 1 0 9", "R 1 0 2", "F 1 0 -5", "R 1 0 2"]
    );
    assert!(
        refused("G0 Z9\nG84 X1 Z-5 R2 F100", LinuxCnc)
            .contains("the spindle does not turn as this cycle needs it")
    );
}

#[test]
fn taps_outside_of_g17_go_where_the_interpreter_goes() {
    // The expectation of the interpreter's own test-suite, in its inches.
    let body = "G20 M3 S1000 F10\nG18 G99 G90\nG0 X1 Z1 Y1\nG84 X1 Z2 Y0.5 R3\nG80";
    let inch: Vec<String> = run(body, LinuxCnc)
        .iter()
        .map(|m| {
            let (kind, rest) = m.split_at(2);
            let ends: Vec<String> = rest
                .split(' ')
                .map(|v| ((v.parse::<f64>().unwrap() / 25.4 * 1e6).round() / 1e6).to_string())
                .collect();
            format!("{kind}{}", ends.join(" "))
        })
        .collect();
    assert_eq!(inch, ["R 1 1 1", "R 1 3 1", "R 1 3 2", "F 0.5 2 1", "F 3 2 1"]);
}

#[test]
fn another_cycle_wants_its_words_again() {
    // As the interpreter's stand-alone version: the same code keeps R and Z, another one does not.
    assert_eq!(run("G0 Z9\nF100\nG99 G81 X1 Z-1 R2\nG81 X2", LinuxCnc).len(), 5);
    assert!(refused("G0 Z9\nF100\nG81 X1 Z-1 R2\nG82 X2 P1", LinuxCnc).contains("a cycle needs R and Z"));
    assert!(refused("G0 Z9\nF100\nG83 X1 Z-1 R2 Q1\nG73 X2 Z-1 R2", LinuxCnc).contains("needs a step Q"));
}

#[test]
fn a_tap_waits_as_long_as_the_last_cycle_said() {
    let waits = |body: &str| {
        let reading = read(&format!("G21 G54 G0 X0 Y0 Z9\nF100 M3 S1\n{body}\nM2\n"), LinuxCnc).unwrap();
        let items = &reading.program.items;
        (0..items.len())
            .filter_map(
                |i| if let kinecut_nc::program::Item::Dwell(s) = items.get(i) { Some(s) } else { None },
            )
            .collect::<Vec<f64>>()
    };
    assert_eq!(waits("G89 X1 Z-1 R2 P0.5\nG80\nG84 X2 Z-1 R2"), [0.5, 0.5]);
    assert_eq!(waits("G84 X2 Z-1 R2"), [0.0]);
}

#[test]
fn a_parameter_is_said_at_the_line_that_reads_it() {
    let reading = read("G21 G54 G0 X0 Y0 Z0\no1 if [#100 EQ 1]\nX1\no1 endif\nM2\n", LinuxCnc).unwrap();
    let found = reading.findings.iter().find(|f| f.message.contains("#100 is read")).unwrap();
    assert_eq!(found.place.as_ref().unwrap().line, 2);
}

#[test]
fn a_loop_that_waits_for_the_state_of_the_control_is_not_endless() {
    // Variables and position stay, the coolant does not.
    let body = "M8\no1 while [#<_flood>]\nM9\no1 endwhile\nX1";
    assert_eq!(run(body, LinuxCnc), ["R 1 0 0"]);
    let body = "M8\n#1=1\no1 do\no2 if [#<_flood>]\nM9\no2 elseif [#<_mist>]\n#1=0\no2 else\nM7\no2 endif\no1 while [#1]\nX2";
    assert_eq!(run(body, LinuxCnc), ["R 2 0 0"]);
}

#[test]
fn a_file_beside_calls_what_the_program_holds() {
    let mut sources = Sources::default();
    let main =
        sources.add("a.ngc", "G21 G54 G0 X0 Y0 Z0\no<row> call [2]\nM2\no<hole> sub\nX#1\no<hole> endsub\n");
    let row = sources.add("row.ngc", "o<row> sub\nG1 Z[0-#1] F100\no<hole> call [7]\no<row> endsub\n");
    let settings = ReadSettings { files: vec![("row".to_owned(), row)], ..ReadSettings::default() };
    let reading = nc::read_source(&sources, main, LinuxCnc, &[], &settings).unwrap();
    assert_eq!(moves(&reading), ["R 0 0 0", "F 0 0 -2", "F 7 0 -2"]);
    // A feed move from nowhere is at its line of its file.
    let main = sources.add("b.ngc", "G21 G54\no<row> call [2]\nM2\no<hole> sub\n(none)\no<hole> endsub\n");
    let reading = nc::read_source(&sources, main, LinuxCnc, &[], &settings).unwrap();
    let found = reading.findings.iter().find(|f| f.message.contains("has not set the position")).unwrap();
    assert!(found.message.ends_with("line 2 of row.ngc"), "{found}");
    assert_eq!(found.place.as_ref().unwrap().file, "row.ngc");
}

#[test]
fn a_name_is_made_as_soon_as_its_block_names_it() {
    // The interpreter has `#<a>` with 0 while it reads the value, so that EXISTS is 1, and 0 is what the same block reads of it.
    assert_eq!(run("#<a>=[5+EXISTS[#<a>]]\nX#<a>", LinuxCnc), ["R 6 0 0"]);
    assert_eq!(run("#<b>=3 #<c>=#<b> X#<b>\nX#<b> Y#<c>", LinuxCnc), ["R 0 0 0", "R 3 0 0"]);
    assert!(refused("#<c>=#<b> #<b>=3", LinuxCnc).contains("`#<b>` has no value"));
}

#[test]
fn m98_shares_numbers_and_has_names_of_its_own() {
    let body = "#<a>=1 #1=2\nM98 P7 L2\nX#1 Y#<a>\nM2\nO7\nX[10*EXISTS[#<a>]+#1]\n#<a>=5 #1=[#1+1]\nM99";
    assert_eq!(run(body, LinuxCnc), ["R 2 0 0", "R 3 0 0", "R 4 1 0"]);
}

#[test]
fn the_points_of_a_cubic_are_from_its_ends_whatever_centres_are() {
    let spans = |mode: &str| {
        let text =
            format!("G21 {mode} G90 G64 G0 X10 Y10 Z0\nG5 X30 Y20 I4 J3 P-5 Q2 F90\nG5.1 X40 Y9 I2 J3\nM2\n");
        let reading = read(&text, LinuxCnc).unwrap();
        format!(
            "{:?}",
            (0..reading.program.items.len()).map(|i| reading.program.items.get(i)).collect::<Vec<_>>()
        )
    };
    assert_eq!(spans("G91.1"), spans("G90.1"));
    assert!(spans("G90.1").contains("Bezier"));
}

#[test]
fn remarks_behind_o_words_stay() {
    let text = "G21 G54 G0 X0 Y0 Z0\no1 repeat [2] (again)\nG1 X1 F9\no1 endrepeat ; turn\no2 if [0]\no2 endif\nM2\n";
    let reading = read(text, LinuxCnc).unwrap();
    let items = &reading.program.items;
    let texts = (0..items.len()).filter_map(|i| match items.get(i) {
        Item::Text(text) => Some(text.to_owned()),
        _ => None,
    });
    assert_eq!(texts.collect::<Vec<_>>(), ["again", "turn", "turn"]);
}
