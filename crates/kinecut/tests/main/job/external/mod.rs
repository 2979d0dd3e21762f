//! Programs that others wrote: simulated as a job, given by themselves, checked, and translated between controls.

mod multi_axis;
mod programs;
mod registers;
mod translated;
mod wrong;

use kinecut::base::Error;
use kinecut::job::Outcome;

use crate::common::job::{self, removed};

/// A plate with two tools; a test adds its setup.
pub(crate) const HEAD: &str = r#"format = 1
stock = { box = { min = [0, 0, -12], max = [60, 40, 0] } }
simulate = { step = 0.5 }
[[tool]]
number = 1
type = "end-mill"
diameter = 8
flute_length = 20
gauge_length = 100
[[tool]]
number = 2
type = "drill"
diameter = 6
point = "flat"
flute_length = 40
gauge_length = 130
"#;

/// The job of a program for a control.
pub(crate) fn job(control: &str, setup: &str) -> String {
    format!("post = {{ control = \"{control}\" }}\n{HEAD}[[setup]]\noffset = \"G54\"\n{setup}\n")
}

pub(crate) fn outcome(control: &str, setup: &str, program: &str) -> Result<Outcome, Error> {
    job::run_program(&job(control, setup), program)
}

pub(crate) const PLAIN: &str = "program = { file = \"P.nc\" }";

/// A slot of 8 x 30 with round ends, 3 deep, and two holes of 6, 10 deep; on five controls.
pub(crate) const FANUC: &str = "%\nO7 (PLATE)\n(SLOT)\nG17 G21 G40 G49 G80 G90 G94\nT1 M6\nG54 G0 X15. Y20. S3000 M3\n\
    G43 H1 Z20. M8\nZ2.\nG1 Z-3. F200.\nX45. F400.\nG0 Z20. M9\nG91 G28 Z0.\nG90\nT2 M6\nG54 G0 X15. Y8. S2000 M3\n\
    G43 H2 Z20. M8\nG99 G81 X15. Y8. Z-10. R2. F150.\nX45.\nG80\nG0 Z20. M9\nM5\nM30\n%\n";
pub(crate) const LINUXCNC: &str = "; PLATE\nG17 G21 G40 G49 G80 G90 G94\nT1 M6\nG54 G0 X15 Y20 S3000 M3\nG43 Z20\nM8\nZ2\n\
    G1 Z-3 F200\nX45 F400\nG0 Z20\nM9\nT2 M6\nG43\nG0 X15 Y8 S2000 M3\nZ20\nG99 G81 X15 Y8 Z-10 R2 F150\nX45\nG80\n\
    G0 Z20\nM5\nM2\n";
pub(crate) const SINUMERIK: &str = "; PLATE\nG17 G40 G90 G94 G710 G54\nT1 M6\nD1\nG0 X15 Y20 S3000 M3\nG0 Z20 M8\nZ2\n\
    G1 Z-3 F200\nX45 F400\nG0 Z20 M9\nT2 M6\nD1\nG0 X15 Y8 S2000 M3\nZ20\nF150\nMCALL CYCLE81(2,0,2,-10)\n\
    X15 Y8\nX45\nMCALL\nG0 Z20\nM5\nM30\n";
pub(crate) const GRBL: &str = "(PLATE)\nG17 G21 G90 G94 G54\nG0 X15 Y20 S3000 M3\nZ20\nM8\nZ2\nG1 Z-3 F200\nX45 F400\nG0 Z20\nM9\nM5\nM30\n";
pub(crate) const HEIDENHAIN: &str = "0 BEGIN PGM PLATE MM\n1 ; PLATE\n2 CYCL DEF 247 DATUM SETTING Q339=+1 ;DATUM NUMBER\n\
    3 TOOL CALL 1 Z S3000\n4 L X+15 Y+20 R0 FMAX M3\n5 L Z+20 FMAX M8\n6 L Z+2 FMAX\n7 L Z-3 F200\n8 L X+45 F400\n\
    9 L Z+20 FMAX M9\n10 TOOL CALL 2 Z S2000\n11 L X+15 Y+8 R0 FMAX M3\n12 L Z+20 FMAX\n\
    13 CYCL DEF 200 DRILLING Q200=+2 Q201=-10 Q206=+150 Q202=+10 Q210=+0 Q203=+0 Q204=+2 Q211=+0\n\
    14 L X+15 Y+8 R0 FMAX M99\n15 L X+45 R0 FMAX M99\n\
    16 L Z+20 FMAX M5\n17 M30\n18 END PGM PLATE MM\n";
