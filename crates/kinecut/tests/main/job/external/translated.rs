//! Programs written for another control: the same motion, and nothing lost in silence.

use kinecut::base::{Code, Error};
use kinecut::job::{GivenFile, ProgramWants, given_alone};
use kinecut::nc::{Control, PostSettings};
use kinecut::verbs::post::{Translation, translate};

use super::{FANUC, GRBL, HEIDENHAIN, LINUXCNC, SINUMERIK};

fn translated(text: &str, from: Control, to: Control) -> Result<Translation, Error> {
    let program = GivenFile { name: "P.nc", bytes: text.as_bytes() };
    let wants = ProgramWants { control: Some(from.name().to_owned()), ..ProgramWants::default() };
    let given = given_alone(program, &wants, false)?;
    translate(&given, &PostSettings::new(to), None)
}

#[test]
fn every_control_says_what_the_others_say() {
    let texts = [
        (Control::Fanuc, FANUC),
        (Control::LinuxCnc, LINUXCNC),
        (Control::Sinumerik840d, SINUMERIK),
        (Control::Heidenhain, HEIDENHAIN),
        (Control::Grbl, GRBL),
    ];
    for (from, text) in texts {
        for to in Control::WRITTEN.iter().copied() {
            let done = translated(text, from, to).unwrap_or_else(|e| panic!("{from} to {to}: {e}"));
            // Three decimals, half a step along each axis.
            assert!(done.read_back.largest < 1e-3, "{from} to {to}: {:?}", done.read_back);
            assert!(done.read_back.moves >= 4);
            assert!(done.text.contains("PLATE"), "{from} to {to}:\n{}", done.text);
            assert!(
                done.findings.iter().all(|f| f.code == Code::TRANSLATED || f.code == Code::NC_STATE),
                "{from} to {to}: {:?}",
                done.findings
            );
        }
    }
}

#[test]
fn the_registers_are_those_of_the_other_control() {
    let text = translated(SINUMERIK, Control::Sinumerik840d, Control::Fanuc).unwrap().text;
    assert!(text.contains("G43 H1") && text.contains("G43 H2"), "{text}");
    let text = translated(FANUC, Control::Fanuc, Control::Sinumerik840d).unwrap().text;
    assert!(text.contains("T2 M6") && text.contains("D1") && !text.contains("D2"), "{text}");
    let own_order = FANUC.replace("H2", "H22");
    let done = translated(&own_order, Control::Fanuc, Control::LinuxCnc).unwrap();
    let found: Vec<_> = done.findings.iter().filter(|f| f.message.contains("keeps its number")).collect();
    assert_eq!(found.len(), 1, "{:?}", done.findings);
    assert!(found[0].place.is_some() && done.text.contains("H22"), "{}", done.text);
    // A second cutting edge has another number in the other table: which, is said once a tool.
    let edge =
        SINUMERIK.replace("T1 M6\nD1", "T1 M6\nD2").replace("Z20 M9", "Z20 M9\nD1\nG0 Z30\nD2\nG0 Z20");
    let done = translated(&edge, Control::Sinumerik840d, Control::LinuxCnc).unwrap();
    let found: Vec<_> = done.findings.iter().filter(|f| f.code == Code::REGISTER).collect();
    assert!(done.text.contains("G43 H101"), "{}", done.text);
    let moved: Vec<_> = found.iter().filter(|f| f.message.contains("called as register 101")).collect();
    assert_eq!(moved.len(), 1, "{:?}", done.findings);
    assert!(moved[0].message.starts_with("register 2 of T1 ") && moved[0].place.is_some(), "{:?}", moved[0]);
}

#[test]
fn what_the_other_control_lacks_is_an_error_at_its_block_or_a_finding() {
    let mist = FANUC.replace("Z20. M8", "Z20. M7");
    let error = translated(&mist, Control::Fanuc, Control::Grbl).unwrap_err();
    assert_eq!(error.code(), Code::POST_CONTROL);
    assert!(error.0.place.as_ref().unwrap().text.contains("M7"), "{error}");
    let overrides = LINUXCNC.replace("M8\n", "M8\nM49\n");
    let done = translated(&overrides, Control::LinuxCnc, Control::Fanuc).unwrap();
    let lost = done.findings.iter().find(|f| f.message.contains("M49")).unwrap();
    assert_eq!((lost.code, lost.place.as_ref().unwrap().text.as_str()), (Code::TRANSLATED, "M49"));
    let rapids = done.findings.iter().find(|f| f.message.contains("straight line"));
    assert!(rapids.is_some(), "{:?}", done.findings);
    let compensated = "G17 G21 G90 G94 G40\nT1 M6\nG54 G0 X-10. Y0. S3000 M3\nG43 H1 Z2.\nG1 Z-3. F200.\nG41 D1 Y10. F300.\n\
        X70.\nG40 Y30.\nG0 Z20.\nM30\n";
    let error = translated(compensated, Control::Fanuc, Control::Grbl).unwrap_err();
    assert!(error.0.place.as_ref().unwrap().text.contains("G41"), "{error}");
    let done = translated(compensated, Control::Fanuc, Control::Sinumerik840d).unwrap();
    assert!(done.text.contains("G41") && done.read_back.largest < 1e-3, "{}", done.text);
}

#[test]
fn messages_that_become_comments_are_reported() {
    let text = SINUMERIK.replace("T2 M6", "MSG(\"TURN (IT)\")\nT2 M6\nMSG()");
    let done = |to| translated(&text, Control::Sinumerik840d, to).unwrap();
    let told =
        |done: &Translation| done.findings.iter().filter(|f| f.message.contains("shows no messages")).count();
    let linuxcnc = done(Control::LinuxCnc);
    assert!(linuxcnc.text.contains("(MSG,TURN [IT])") && told(&linuxcnc) == 0, "{}", linuxcnc.text);
    for to in [Control::Fanuc, Control::Heidenhain] {
        let done = done(to);
        let found = done.findings.iter().find(|f| f.message.contains("shows no messages")).unwrap();
        assert_eq!(
            (found.code, found.place.as_ref().unwrap().text.contains("MSG")),
            (Code::TRANSLATED, true)
        );
        assert!(done.text.contains("TURN [IT]"), "{}", done.text);
    }
}

#[test]
fn arcs_in_inverse_time_are_translated() {
    let text = |arc: &str| {
        format!(
            "G17 G21 G90 G94\nT1 M6\nG43 H1\nG54\nG64\nS1000 M3\nG0 X0 Y0\nZ25\nG93\n{arc}\nG94\nG0 Z50\nM5\nM2\n"
        )
    };
    for arc in [
        "G2 Z-23.13 J1.96473 I-8.59839 P2 F13.08",
        "G3 R2.09 Z1.8849 Y-0.77014 F14.69",
        "G18 G2 X8 Z17 I8 F30",
    ] {
        for to in Control::WRITTEN.iter().copied() {
            let done =
                translated(&text(arc), Control::LinuxCnc, to).unwrap_or_else(|e| panic!("{to}: {arc}: {e}"));
            assert!(done.findings.iter().all(|f| f.code != Code::READ_BACK), "{to}: {:?}", done.findings);
        }
    }
}
