//! Speeds, feeds and cutting data.

use kinecut::base::{Code, Severity};

use super::*;

const CUT: &str = "G1 Z-2. F200.\nX45. F400.";

#[test]
fn a_spindle_that_turns_backwards_is_wrong_for_the_hand_of_the_tool() {
    let right_hand = mill(CUT);
    let m4 = right_hand.replace(" M3\n", " M4\n");
    told(&fanuc(&m4), Code::SPINDLE_WRONG, Severity::Error, "G54 G0 X15. Y20. S3000 M4");
    right(&with_mill("hand = \"left\"", &m4));
    told(
        &with_mill("hand = \"left\"", &right_hand),
        Code::SPINDLE_WRONG,
        Severity::Error,
        "G54 G0 X15. Y20. S3000 M3",
    );
    // In a block of its own.
    let alone = right_hand.replace("S3000 M3\n", "\nS3000 M04\n");
    told(&fanuc(&alone), Code::SPINDLE_WRONG, Severity::Error, "S3000 M04");
}

#[test]
fn other_controls_turn_backwards_too() {
    let klartext = "0 BEGIN PGM P MM\n1 CYCL DEF 247 DATUM SETTING Q339=+1 ;DATUM NUMBER\n2 TOOL CALL 1 Z S3000\n\
        3 L X+15 Y+20 R0 FMAX M4\n4 L Z+20 FMAX M8\n5 L Z+2 FMAX\n6 L Z-2 F200\n7 L X+45 F400\n8 L Z+20 FMAX M9\n9 M30\n\
        10 END PGM P MM\n";
    let sinumerik = "G17 G40 G90 G94 G710 G54\nT1 M6\nD1\nG0 X15 Y20 S3000 M4\nG0 Z20 M8\nZ2\nG1 Z-2 F200\nX45 F400\n\
        G0 Z20 M9\nM5\nM30\n";
    for (control, text, block) in [
        ("heidenhain", klartext, "3 L X+15 Y+20 R0 FMAX M4"),
        ("sinumerik-840d", sinumerik, "G0 X15 Y20 S3000 M4"),
    ] {
        let run = |text: &str| {
            outcome(
                &job(control, "", "[machine]\ncode = \"2103\"\ndynamics = { rapid = 24000 }", PLAIN),
                text,
            )
        };
        right(&run(&text.replace(" M4\n", " M3\n")));
        told(&run(text), Code::SPINDLE_WRONG, Severity::Error, block);
        let fast = text.replace(" M4\n", " M3\n").replace("F400", "F80000");
        assert!(!blocks(&run(&fast), Code::FEED_TOO_FAST).is_empty(), "{control}");
    }
}

#[test]
fn the_speed_is_at_most_that_of_the_tool_and_of_the_machine() {
    let program = mill(CUT);
    right(&with_mill("max_speed = 3000", &program));
    told(&with_mill("max_speed = 2900", &program), Code::SPINDLE_WRONG, Severity::Error, "Z2.");
    let machine = |most: u32| {
        let more = format!("[machine]\ncode = \"2103\"\ndynamics = {{ max_speed = {most} }}");
        outcome(&job("fanuc", "", &more, PLAIN), &program)
    };
    right(&machine(3000));
    assert_eq!(blocks(&machine(2900), Code::SPINDLE_WRONG).len(), 1);
}

#[test]
fn the_feed_is_at_most_the_rapid_and_what_tool_and_machine_state() {
    let run = |dynamics: &str, mill_keys: &str, feed: &str| {
        let more = format!("[machine]\ncode = \"2103\"\ndynamics = {{ {dynamics} }}");
        outcome(
            &job("fanuc", mill_keys, &more, PLAIN),
            &mill(&format!("G1 Z-2. F200.\nX45. {feed}\nX15. F300.")),
        )
    };
    right(&run("rapid = 5000", "", "F5000."));
    told(&run("rapid = 5000", "", "F5100."), Code::FEED_TOO_FAST, Severity::Error, "X45. F5100.");
    told(
        &run("rapid = 5000, max_feed = 4000", "", "F4500."),
        Code::FEED_TOO_FAST,
        Severity::Error,
        "X45. F4500.",
    );
    told(
        &run("rapid = 5000", "max_feed = 3000", "F3100."),
        Code::FEED_TOO_FAST,
        Severity::Error,
        "X45. F3100.",
    );
    // Per revolution, left on by mistake: without any limit given.
    let revolution = mill("G1 Z-2. F200.\nG95 X45. F400.");
    told(&fanuc(&revolution), Code::FEED_TOO_FAST, Severity::Error, "G95 X45. F400.");
}

#[test]
fn implausible_cutting_data_are_told_with_the_number() {
    // Two teeth at 3000: 2 mm a tooth where 1.3 are the bound; 0.0005 where 0.0008 are.
    told(&fanuc(&mill("G1 Z-2. F200.\nX45. F12000.")), Code::CUTTING_DATA, Severity::Warning, "X45. F12000.");
    right(&fanuc(&mill("G1 Z-2. F200.\nX45. F7000.")));
    told(&fanuc(&mill("G1 Z-2. F200.\nX45. F3.")), Code::CUTTING_DATA, Severity::Warning, "X45. F3.");
    // 2262 and 1.5 m/min.
    told(
        &fanuc(&mill(CUT).replace("S3000", "S90000")),
        Code::CUTTING_DATA,
        Severity::Warning,
        "G1 Z-2. F200.",
    );
    told(
        &fanuc(&mill("G1 Z-2. F20.").replace("S3000", "S60")),
        Code::CUTTING_DATA,
        Severity::Warning,
        "G1 Z-2. F20.",
    );
    right(&fanuc(&mill(CUT).replace("S3000", "S40000").replace("F400", "F4000")));
}

#[test]
fn speed_and_feed_are_not_carried_over_to_a_tool_of_another_kind() {
    right(&fanuc(GOOD));
    let no_speed = GOOD.replace("S2000 M3", "M3");
    told(&fanuc(&no_speed), Code::CUTTING_DATA, Severity::Warning, "G54 G0 X15. Y8. M3");
    let no_feed = GOOD.replace("R2. F150.", "R2.");
    told(&fanuc(&no_feed), Code::CUTTING_DATA, Severity::Warning, "G99 G81 X15. Y8. Z-10. R2.");
    // The same numbers, written again, are meant.
    right(&fanuc(&GOOD.replace("S2000 M3", "S3000 M3").replace("R2. F150.", "R2. F400.")));
    // Its sister takes over where the mill ends.
    let sister =
        "\n[[tool]]\nnumber = 3\ntype = \"end-mill\"\ndiameter = 8\nflute_length = 20\ngauge_length = 100";
    let second =
        "G0 Z20. M9\nG91 G28 Z0.\nG90\nT3 M6\nG54 G0 X15. Y30. M3\nG43 H3 Z20. M8\nZ2.\nG1 Z-2.\nX45.";
    right(&with_mill(sister, &mill(&format!("G1 Z-2. F400.\nX45.\n{second}"))));
}
