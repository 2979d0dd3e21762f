//! Data of the control that a program sets: `G10`, `G92` at the beginning, `G43.1`, `G41.1`, `M19`; arcs that are not round.
//!
//! Expected places are those of the interpreter's own test-suite and stand-alone version, or follow from the rules of the manuals.

use crate::{moves, read, refused, run};
use kinecut_nc::base::{Severity, Sources};
use kinecut_nc::nc::Control::{Fanuc, Grbl, LinuxCnc, Sinumerik840d};
use kinecut_nc::nc::{self, Control, Kept, PostSettings, ReadSettings, Reading};
use kinecut_nc::program::{Comp, ControlData, Item, OwnLength, Path, Target, WorkOffset};

/// Ends of the moves of the tip in the coordinates of the work offset as the setup has it.
fn in_work(reading: &Reading) -> Vec<[f64; 3]> {
    let (program, items) = (&reading.program, &reading.program.items);
    let mut places = Vec::new();
    for i in 0..items.len() {
        let Item::Move(motion) = items.get(i) else { continue };
        let Target::Tip { point, .. } = motion.end else { continue };
        let Some((_, motion)) = program.in_work(program.state(i).frame) else { panic!("item {i}") };
        places.push((motion.point(point) * 1e6).round().to_array().map(|v| v / 1e6 + 0.0));
    }
    places
}

/// The text that is written of a program, and what is read of that.
fn again(reading: &Reading, control: Control) -> (String, Reading) {
    let settings = PostSettings { decimals: 6, ..PostSettings::new(control) };
    let text = nc::write(&reading.program, &[], &settings).unwrap_or_else(|e| panic!("{e}")).text;
    let second = read(&text, control).unwrap_or_else(|e| panic!("{e}\n{text}"));
    (text.to_string(), second)
}

fn has(reading: &Reading, wanted: ControlData) -> bool {
    let items = &reading.program.items;
    (0..items.len()).any(|i| items.get(i) == Item::Data(wanted))
}

#[test]
fn a_zero_that_is_set_again_shifts_and_turns() {
    let text = "G21 G54\nG10 L2 P1 X0 Y0 Z0 R0\nG1 X0 Y0 Z0 F60\nG10 L2 P1 X1\nX0 Y0 Z0\nG10 L2 P1 R-45\nY SQRT[2]\n\
                G10 L2 P1 X2 Y1 R90\nY3\nG10 L2 P1 X0 Y0\nX0 Y0\nM2\n";
    let wanted = [[0.0; 3], [1.0, 0.0, 0.0], [2.0, 1.0, 0.0], [-1.0, 1.0, 0.0], [0.0, 0.0, 0.0]];
    let reading = read(text, LinuxCnc).unwrap();
    assert_eq!(in_work(&reading), wanted);
    assert_eq!(in_work(&again(&reading, LinuxCnc).1), wanted);
    let said = "the program sets the zero of a work offset in machine coordinates (G10 L2): the setup is taken to have it there";
    assert_eq!(reading.findings.iter().filter(|f| f.message == said).count(), 1);
    let late = refused("G0 X5\nG10 L2 P1 X3", LinuxCnc);
    assert!(
        late.contains("the zero of G54 changes after moves in it, by how much the machine alone knows"),
        "{late}"
    );
}

#[test]
fn a_zero_is_set_by_the_present_place() {
    let text = "G21 G54\nG10 L2 P1 X0 Y0 Z0 R45\nG0 G53 X0 Y0 Z0\nG10 L20 P1 X-1\nG1 X0 F60\nG10 L20 P1 Y -1\nY0\n\
                G10 L20 P1 X1 Y1\nX0 Y0\nM2\n";
    let half = 0.5f64.sqrt();
    let round = |v: f64| (v * 1e6).round() / 1e6;
    let wanted = [[round(half), round(half), 0.0], [0.0, round(2.0 * half), 0.0], [0.0; 3]];
    let reading = read(text, LinuxCnc).unwrap();
    assert_eq!(in_work(&reading), wanted);
    // GRBL has the same words, and P0 for the work offset in force.
    assert_eq!(run("X5\nG10 L20 P0 X1\nX0", Grbl), ["R 5 0 0", "R 0 0 0"]);
    let unknown = refused("G28 X0\nG10 L20 P2 X1", LinuxCnc);
    assert!(
        unknown.contains("G10 L20 sets the zero of G55 from a place that is not known in it"),
        "{unknown}"
    );
}

#[test]
fn the_place_is_known_behind_machine_coordinates_and_in_another_offset() {
    let text = "G21\nG10 L2 P1 X10 Y20 Z30\nG10 L2 P2 X11 Y22 Z33\nG54 G90\nG53 G0 X11 Y22 Z33\nG91 G1 X1 F60\nG55 X1\n\
                G90 G54 G53 G0 Z30\nG1 X0\nM2\n";
    // In G54 the place is (1, 2, 3), then (2, 2, 3); in G55 that is (1, 0, 0).
    assert_eq!(moves(&read(text, LinuxCnc).unwrap()), ["F 2 2 3", "F 2 0 0", "F 0 2 0"]);
    // With a length it is the spindle that is there, not the tip.
    let long = "G21\nG10 L2 P1 X10 Y20 Z30\nT1 M6\nG43 H1\nG53 G0 X11 Y22 Z33\nG91 G1 Z1 F60\nM2\n";
    assert!(
        read(long, LinuxCnc)
            .unwrap_err()
            .contains("an increment from a position that the program has not set")
    );
}

#[test]
fn fanuc_sets_zeros_and_registers() {
    let text = "O1\nG21 G90 G10 L2 P0 X0. Y0. Z0.\nG10 L2 P1 X-300. Y-200. Z-400.\nG10 L12 P5 R4.98\nG10 L10 P5 R120.\n\
                G54 G0 X0. Y0. Z0.\nG91 G10 L2 P1 X5.\nG90 X0. Y0.\nM30\n";
    let reading = read(text, Fanuc).unwrap();
    assert_eq!(reading.radii, [(5, 4.98)]);
    let places: Vec<[f64; 2]> = in_work(&reading).iter().map(|p| [p[0], p[1]]).collect();
    assert_eq!(places, [[0.0, 0.0], [5.0, 0.0]]);
    let (text, second) = again(&reading, Fanuc);
    for block in
        ["G10 L2 P0 X0. Y0. Z0.", "G10 L2 P1 X-300. Y-200. Z-400.", "G10 L12 P5 R4.98", "G10 L10 P5 R120."]
    {
        assert!(text.contains(block), "{block}\n{text}");
    }
    assert_eq!(second.radii, [(5, 4.98)]);
    let further =
        read("O1\nG21 G90 G10 L20 P48 X1. Y2. Z3.\nG54.1 P48 G0 X0. Y0. Z0.\nM30\n", Fanuc).unwrap();
    assert!(again(&further, Fanuc).0.contains("G10 L20 P48 X1. Y2. Z3."));
    let twice = read("O1\nG21 G90 G10 L10 P5 R120.\nG10 L10 P5 R119.\nM30\n", Fanuc).unwrap();
    assert_eq!(twice.lengths, [(5, 119.0)]);
    let called = refused("G10 L10 P5 R120.\nT5 M6\nG43 H5 Z50.\nG10 L10 P5 R119.", Fanuc);
    assert!(
        called.contains("the length of 5 changes after it was called, which is not followed"),
        "{called}"
    );
    let settings = PostSettings::new(Sinumerik840d);
    let other = nc::write(&reading.program, &[], &settings).unwrap_err().to_string();
    assert!(
        other.contains("the offset that is added to all") || other.contains("the zero of a work offset"),
        "{other}"
    );
}

#[test]
fn coordinates_are_given_to_the_place_where_the_program_begins() {
    let reading = read("G21 G92 X0 Y0 Z10\nG1 X5 F100\nG92 X0\nX1\nM2\n", LinuxCnc).unwrap();
    assert_eq!(in_work(&reading), [[5.0, 0.0, 10.0], [6.0, 0.0, 10.0]]);
    assert!(reading.findings.iter().any(|f| {
        f.message
            == "the program gives coordinates to a place that it has not set: the setup is taken to have that zero"
    }));
    // No feed move starts at a place that is not known.
    assert!(reading.findings.iter().all(|f| f.code.to_string() != "KC0529"));
    let (text, second) = again(&reading, LinuxCnc);
    assert!(text.contains("G92 X0 Y0 Z10"), "{text}");
    assert_eq!(in_work(&second), in_work(&reading));
    // What was before is not known.
    assert!(read("G21 G92 X0\nG92.1\nM2\n", LinuxCnc).is_ok());
    let back = read("G21 G92 X0\nG92.1\nG0 X1\nM2\n", LinuxCnc).unwrap_err();
    assert!(back.contains("the coordinates that this axis had before G92 are not known"), "{back}");
}

#[test]
fn lengths_and_radii_are_numbers() {
    let reading = read(
        "G21 G54 T1 M6\nG43.1 Z100.5\nG0 X0 Y0 Z5\nG42.1 D-0.8\nG1 X10 F100\nX20\nG40 X30\nG49\nM2\n",
        LinuxCnc,
    )
    .unwrap();
    let (text, second) = again(&reading, LinuxCnc);
    assert!(text.contains("G43.1 Z100.5"), "{text}");
    // A negative diameter changes the side.
    assert!(text.contains("G41.1 D0.8"), "{text}");
    for reading in [&reading, &second] {
        let items = &reading.program.items;
        let state = (0..items.len()).map(|i| reading.program.state(i).comp).find(|c| *c != Comp::Off);
        let Some(Comp::Left(register)) = state else { panic!("{state:?}") };
        assert_eq!(reading.radii, [(register, 0.4)]);
    }
    let fanuc = nc::write(&reading.program, &[], &PostSettings::new(Fanuc)).unwrap_err().to_string();
    assert!(fanuc.contains("G43.1"), "{fanuc}");
    assert!(refused("G41.1\nG1 X1 F1", LinuxCnc).contains("without D"));
}

#[test]
fn lengths_are_added_and_replaced() {
    let text = |between: &str| {
        let reading =
            read(&format!("G21 T1 M6\nG43 H1\nG0 X0 Y0 Z9\n{between}\nG0 X1 Y1 Z1\nM2\n"), LinuxCnc).unwrap();
        let (text, second) = again(&reading, LinuxCnc);
        assert_eq!(again(&second, LinuxCnc).0, text);
        let behind = text.split_once("G0 X0 Y0 Z9\n").unwrap().1;
        (behind.split_once("\nG0").map_or(String::new(), |b| b.0.to_owned()), reading)
    };
    let (sum, reading) = text("G43.2 H7");
    assert_eq!(sum, "G43.2 H7");
    assert_eq!(reading.own_lengths, [OwnLength { before: Some(1), set: [None; 3], add: Some(7) }]);
    assert_eq!(text("G43.1 Z5\nG43.2 H7").0, "G43.1 Z5\nG43.2 H7");
    assert_eq!(text("G49\nG43.1 Z5\nG43.2 H7").0, "G49\nG43.1 Z5\nG43.2 H7");
    assert_eq!(text("G43.2 H7\nG43.2 H7\nG43.1 Z-3").0, "G43.2 H7\nG43.2 H7\nG43.1 Z-3");
    assert_eq!(text("G43.1 Z5\nG43.1 Z6").0, "G43.1 Z6");
    // The program's own numbers: with 3 mm in the table the spindle is 8 mm above the tip.
    let down =
        "G10 L1 P7 Z3\nG10 L2 P1 X0 Y0 Z0\nG49\nG43.1 Z5\nG43.2 H7\nG53 G0 X4 Y4 Z20\nG91 G1 Z-1 F60\nM2\n";
    assert_eq!(moves(&read(&format!("G21\n{down}"), LinuxCnc).unwrap()), ["F 4 4 11"]);
    // Across its axis the place of the tip on the machine is another.
    let reading = read("G21 T1 M6\nG0 X0 Y0 Z9\nG43.1 X-5.5\nG0 X1 Y1 Z1\nG49\nM2\n", LinuxCnc).unwrap();
    assert!(again(&reading, LinuxCnc).0.contains("G43.1 X-5.5"));
    let said = reading.findings.iter().find(|f| f.message.contains("offset across its axis")).unwrap();
    assert_eq!(said.severity, Severity::Doubt);
    assert!(
        refused("T1 M6\nG0 X1 Y1 Z1\nG43.1 X1\nG91 G0 X1", LinuxCnc).contains("an increment from a position")
    );
    // Before a tool is called it is that of the tool in the spindle.
    let lifted = read("G21 G43.1 Z5\nG53 G0 X1 Y2 Z3\nG49\nM2\n", LinuxCnc).unwrap();
    let text = again(&lifted, LinuxCnc).0;
    assert!(text.contains("\nG43.1 Z5\n") && text.contains("Z3\nG49\n"), "{text}");
    let many = "G43.2 H1\n".repeat(21);
    assert!(
        refused(&many, LinuxCnc).contains("write G43.1 with their sum")
            || refused(&many, LinuxCnc).contains("21")
    );
}

/// Reads with the tool table and the parameters of a machine.
fn kept(text: &str, table: &str, var: &str) -> Result<Reading, String> {
    let mut sources = Sources::default();
    let [table, var] = [("tool.tbl", table), ("a.var", var)].map(|(name, text)| sources.add(name, text));
    let tools = Some(nc::tool_table(&sources, table, 1.0).map_err(|e| e.to_string())?);
    let parameters = Some(nc::parameters(&sources, var, 25.4).map_err(|e| e.to_string())?);
    let settings = ReadSettings { kept: Kept { tools, parameters }, ..ReadSettings::default() };
    let file = sources.add("a.ngc", text);
    nc::read_source(&sources, file, LinuxCnc, &[], &settings).map_err(|e| e.to_string())
}

#[test]
fn a_program_begins_with_what_the_machine_has_kept() {
    let table = "T1 Z10 D5\nT2 X1 Y2 Z20 D6\n";
    // The machine counts in inches.
    let var = "31 7\n5161 4\n5162 0\n5163 2\n5210 1\n5211 0.5\n5220 2\n5241 1\n5242 2\n5250 90\n5261 3\n";
    let moved = |text: &str| moves(&kept(&format!("G21\n{text}\nM2\n"), table, var).unwrap());
    // G55, turned by 90 degrees and shifted by G92, is in force: X of the program is Y of the machine.
    assert_eq!(moved("G53 G0 X25.4 Y76.2 Z0\nG91 G1 X1 F60"), ["F 13.7 0 0"]);
    let reads = "#1=[#5161+#5163*10+#5211*100+#5241*1000+#5250]\nG0 X#1 Y#31 Z#5220";
    assert_eq!(moved(reads), ["R 1164 7 2"]);
    // #5221 follows what the program sets, in units of the machine.
    assert_eq!(moved("G10 L2 P3 X50.8\nG0 X#5261 Y0 Z0"), ["R 2 0 0"]);
    // G28 goes to the place of the file, 101.6 mm along X.
    let home = kept("G21\nG54 G92.1\nG0 X0 Y0 Z0\nG28 X5\nG91 G1 X1 F60\nM2\n", table, var).unwrap();
    assert_eq!(moves(&home).last().unwrap(), "F 102.6 0 0");
    // Lengths: the spindle is 20 mm above the tip.
    assert_eq!(moved("G54 G92.1\nT1 M6\nG43\nG53 G0 X0 Y0 Z30\nG91 G1 Z1 F60"), ["F 0 0 21"]);
    assert_eq!(
        moved("T2 M6\nG0 X#[5401] Y[#5402*25.4] Z[#5403*25.4]\nG0 X#5400"),
        ["R 0.0394 2 20", "R 2 2 20"]
    );
    let none = kept("T3 M6\nM2\n", table, var).unwrap_err();
    assert!(none.starts_with("a.ngc:1:1: T3 is not in the tool table of the machine"), "{none}");
    assert!(kept("G43 H9\nM2\n", table, var).unwrap_err().contains("T9 is not in the tool table"));
}

#[test]
fn lines_of_the_tool_table_change() {
    let var = "5220 1\n";
    let table = "T1 Z10\nT2 Z20\n";
    let written = |text: &str| {
        let reading = kept(&format!("G21\n{text}\nM2\n"), table, var).unwrap();
        again(&reading, LinuxCnc).0
    };
    // The spindle is at 40, so that with 35 the tip would be at 5.
    let text = written("G0 X1 Y2 Z40\nG10 L10 P1 Z5\nG43 H1\nG0 Z0\nX0 Y0");
    assert!(text.contains("G10 L1 P1 Z35\nG43 H1\n"), "{text}");
    // With a length in force it is the spindle that counts; G59.3 is where machine zero is, without G92.
    let text = written("G43 H2\nG0 X1 Y2 Z40\nG92 Z0\nG10 L11 P1 X0 Z5\nG0 Z0");
    assert!(text.contains("G10 L1 P1 X1 Z55"), "{text}");
    // A line that was called before is another one from now on.
    let text = written(
        "G43 H1\nG0 X0 Y0 Z5\nG10 L1 P1 Z12\nG0 X1\nG43 H1\nG0 Z6 X1 Y0\nG10 L1 P1 Y1\nG43 H1\nG0 Z6 X1 Y0",
    );
    assert!(text.contains("G10 L1 P1 Z12\nG0 X1\nG43.1 X0 Y0 Z12\n"), "{text}");
    assert!(text.contains("G10 L1 P1 Y1\nG43.1 X0 Y1 Z12\n"), "{text}");
    // Of a turned work offset, one axis: the part of the offset along the other stays.
    let turned = kept("G21\nG10 L2 P1 R90\nG0 X5 Y6 Z7\nG10 L10 P2 X1\nM2\n", "T2 X1 Y2 Z20\n", var).unwrap();
    assert!(again(&turned, LinuxCnc).0.contains("G10 L1 P2 X1 Y4"), "{}", again(&turned, LinuxCnc).0);
    let far = kept("G21\nG28 X0\nG10 L10 P1 X5\nM2\n", table, "5161 1\n5220 1\n");
    assert!(far.is_ok(), "{far:?}");
    let unknown = refused("G28 X0\nG10 L10 P1 X5", LinuxCnc);
    assert!(unknown.contains("G10 L10 sets an offset along X from a place that is not known"), "{unknown}");
    assert!(refused("G10 L1 P1", LinuxCnc).contains("without an offset or radius"));
}

#[test]
fn a_length_in_force_is_that_of_its_call() {
    let (table, var) = ("T1 Z10\nT2 X1 Y2 Z20\n", "5220 1\n");
    let moved = |text: &str| moves(&kept(&format!("G21\n{text}\nM2\n"), table, var).unwrap());
    let written = |text: &str| again(&kept(&format!("G21\n{text}\nM2\n"), table, var).unwrap(), LinuxCnc).0;
    // The table changes, the length in force does not.
    let changed = "T1 M6\nG43 H1\nG0 X0 Y0 Z9\nG10 L1 P1 Z50\n";
    assert_eq!(moved(&format!("{changed}G43.1 X5\nG53 G0 X0 Y0 Z0\nG91 G1 X1 F60"))[1..], ["F -4 0 -10"]);
    assert!(written(&format!("{changed}G43.2 H2\nG0 X1 Y1 Z1")).contains("G43.1 X0 Y0 Z10\nG43.2 H2\n"));
    let unknown = refused("T1 M6\nG43 H1\nG10 L1 P1 Z50\nG43.2 H2", LinuxCnc);
    assert!(unknown.contains("another length than the one in force"), "{unknown}");
    // A length may be across: all axes are written again behind it.
    assert!(
        written("T1 M6\nG43\nG0 X0 Y0 Z9\nG43 H2\nG0 X0 Y0 Z9").ends_with("G43 H2\nG0 X0 Y0 Z9\nM2\n%\n")
    );
    // H0 is the tool in the spindle.
    assert_eq!(moved("T2 M6\nG43 H0\nG53 G0 X0 Y0 Z0\nG91 G1 X1 F60"), ["F 0 -2 -20"]);
    // M72 takes again whether a length was on, as that of the tool in the spindle.
    let saved = "T1 M6\nG43\nM70\nT2 M6\nG43\nM72\nG0 X0 Y0 Z9";
    assert!(written(saved).contains("T2 M6\nG43 H2\n"), "{}", written(saved));
    let off = "T1 M6\nG43 H2\nM70\nG49\nM72\nG0 X0 Y0 Z9";
    assert!(written(off).contains("T1 M6\nG43 H1\n"), "{}", written(off));
}

#[test]
fn a_stored_place_is_gone_to_in_the_coordinates_in_force() {
    let table = "T1 Z10\nT2 A5 Z1\n";
    // One axis of turned coordinates: both axes of the machine move.
    let var = "5161 7\n5162 8\n5163 9\n5220 1\n5221 10\n5230 90\n";
    let text = "G21\nG0 X1 Y1 Z1\nG91 G28 X0\nM2\n";
    // (7, 8) in is (8, 3) in there.
    assert_eq!(moves(&kept(text, table, var).unwrap()), ["R 1 1 1", "R 203.2 1 1"]);
    // The spindle goes where it was: with a length the tip is that much lower.
    let stored = "G10 L1 P1 Z10\nT1 M6\nG0 X0 Y0 Z30\nG28.1\nG43 H1\nG0 X5 Y5 Z50\nG28";
    assert_eq!(run(stored, LinuxCnc).last().unwrap(), "R 0 0 20");
    // Rotary axes: the place of the file, and no shifted zero.
    let home = |var: &str| kept("G21\nG0 X0 Y0 Z10 A0\nG91 G28 Z0 A0\nM2\n", table, var);
    let reading = home("5163 100\n5164 50\n5220 1\n").unwrap();
    let joints = (0..reading.program.items.len()).find_map(|i| match reading.program.items.get(i) {
        Item::Move(motion) => match motion.end {
            Target::Joints(joints) => Some(joints),
            _ => None,
        },
        _ => None,
    });
    assert_eq!(joints, Some([None, None, Some(2540.0), Some(50f64.to_radians()), None, None]));
    let shifted = home("5220 1\n5224 30\n").unwrap_err();
    assert!(shifted.contains("a rotary axis A whose zero is shifted (#5224)"), "{shifted}");
    let turned = kept("T2 M6\nG43\nM2\n", table, "5220 1\n").unwrap_err();
    assert!(turned.contains("T2 has offsets of rotary axes"), "{turned}");
    // A loop that waits for a stored place ends.
    let waits =
        "G20\nG0 X0 Y0 Z10\nG28.1\no1 while [#5161 LT 5]\nG0 X[#5161+1]\nG28.1\nG0 X0\no1 endwhile\nM2\n";
    assert_eq!(moves(&kept(waits, table, "5220 1\n").unwrap()).len(), 11);
}

#[test]
fn a_zero_lies_from_another_one() {
    let text = "G54\nG0 X10 Y20 Z30\nG10 L20 P2 X1 Y2 Z3\nG55\nG91 G1 X1 F60\nG90 G54\nG91 X1\nM2\n";
    let reading = read(&format!("G21 {text}"), LinuxCnc).unwrap();
    assert_eq!(moves(&reading), ["R 10 20 30", "F 2 2 3", "F 12 20 30"]);
    let g55 = WorkOffset::from_tenths(550).unwrap();
    assert_eq!(reading.zero_from(WorkOffset::G54, g55).map(|v| v.to_array()), Some([9.0, 18.0, 27.0]));
    assert!(again(&reading, LinuxCnc).0.contains("G10 L20 P2 X1 Y2 Z3"));
    // Once one of them has a place in the machine, the other has one too.
    let later = "G10 L2 P1 X100 Y0 Z0\nG54 G0 X0 Y0 Z0\nG10 L20 P2 X-5 Y0 Z0\nG55 G53 G0 X101 Y1 Z1\nG91 G1 X1 F60\nM2\n";
    assert_eq!(moves(&read(&format!("G21 {later}"), LinuxCnc).unwrap())[1..], ["F -3 1 1"]);
    // Moves in it before are at a place that the machine alone knows.
    let moved = refused("G55 G0 X1 Y1 Z1\nG54 G0 X0 Y0 Z0\nG10 L20 P2 X1", LinuxCnc);
    assert!(moved.contains("the zero of G55 changes after moves in it"), "{moved}");
}

#[test]
fn the_spindle_stops_at_an_angle() {
    let reading = read("G21 M19 R45 P1 Q2\nM19\nM2\n", LinuxCnc).unwrap();
    assert!(has(&reading, ControlData::Orient { degrees: 45.0, way: 1, seconds: 2.0 }));
    assert!(again(&reading, LinuxCnc).0.contains("M19 R45 P1 Q2"));
    assert!(refused("M19 R361", LinuxCnc).contains("from 0 to 360 degrees"));
    assert!(refused("M19 P3", LinuxCnc).contains("P0, P1 or P2"));
    assert!(refused("G64 M19 R90", LinuxCnc).contains("both G64 and M19 of this block take it"));
}

#[test]
fn the_radius_of_an_arc_that_is_not_round_changes_evenly() {
    // The interpreter's own case: 25 mm at the start, 25.014 at the end.
    let text = "G21 G17 G0 X0 Y0 Z0\nG2 X50 Y0 I24.986 J0 F100\nM2\n";
    let reading = read(text, LinuxCnc).unwrap();
    let spiral = |reading: &Reading| {
        let items = &reading.program.items;
        (0..items.len()).find_map(|i| match items.get(i) {
            Item::Move(motion) => match motion.path {
                Path::Spiral { spiral, .. } => Some(spiral),
                _ => None,
            },
            _ => None,
        })
    };
    let of = spiral(&reading).unwrap();
    let [a, b] = of.parameters();
    // Half way round it is half way out.
    let middle = of.point(0.5 * (a + b));
    assert!((middle.x - 24.986).abs() < 1e-9 && (middle.y - 25.0).abs() < 1e-9, "{middle}");
    let (text, second) = again(&reading, LinuxCnc);
    assert!(text.contains("G2 X50 Y0 I24.986 J0"), "{text}");
    assert!((spiral(&second).unwrap().length() - of.length()).abs() < 1e-9);
    // Rounded words leave an arc, and other controls move the centre.
    assert!(spiral(&read("G21 G0 X0 Y0 Z0\nG2 X50 Y0 I24.998 J0 F100\nM2\n", LinuxCnc).unwrap()).is_none());
    let fanuc = "G21 G54 G0 X0. Y0. Z0.\nG2 X50. Y0. I24.998 J0. F100.\nM30\n";
    assert!(spiral(&read(fanuc, Fanuc).unwrap()).is_none());
}

#[test]
fn comments_are_between_the_arguments_of_a_call() {
    let body = "o1 sub\nX#1 Y#2\no1 endsub\no1 call [1] (will this cause problems) [2] (no)";
    assert_eq!(run(body, LinuxCnc), ["R 1 2 0"]);
    assert!(refused("o1 sub\no1 endsub\no1 call [1] (open", LinuxCnc).contains("comment is not closed"));
}

#[test]
fn a_wrong_first_move_behind_a_switch_is_said_where_it_is() {
    let mut sources = Sources::default();
    let text = "G21 G0 X0 Y0 Z0\nG41 D1\nG1 X10 F100\nG40\nG2 I5\nM2\n";
    let error = nc::read(&mut sources, "a.ngc", text, LinuxCnc, &[]).unwrap_err().to_string();
    assert!(
        error.starts_with("a.ngc:5:1: the first move after a switch of the compensation is not straight"),
        "{error}"
    );
    assert!(error.contains("it is switched in line 4"), "{error}");
}

#[test]
fn a_length_is_called_for_the_tool_that_is_in_the_spindle() {
    let reading = read("G21 G54 G43 H4\nG0 X1 Y2 Z3\nG49\nG0 Z5\nM2\n", LinuxCnc).unwrap();
    let call = |register| ControlData::LengthCall { register };
    assert!(has(&reading, call(Some(4))) && has(&reading, call(None)));
    let (text, second) = again(&reading, LinuxCnc);
    assert!(text.contains("G43 H4\n") && text.contains("\nG49\nG0 X1 Y2 Z5"), "{text}");
    assert_eq!(in_work(&second), in_work(&reading));
    assert!(again(&reading, Fanuc).0.contains("G43 H4"));
}
