//! The verbs that plan one operation: `hole`, `drill`, `face`.

use std::path::Path;

use kinecut::base::Error;
use kinecut::verbs::drill::plan_drill_sheet;
use kinecut::verbs::face::{SheetWants, plan_face_sheet};
use kinecut::verbs::hole::{compare_hole, plan_hole, read_holes};

use crate::answers::{To, answers};
use crate::args::{Args, Drill, Face, Hole};
use crate::{files, progress};

/// Plans holes, or compares all strategies on them.
pub(crate) fn hole(args: &Args, hole: &Hole) -> Result<u8, Error> {
    let texts = read_holes(&hole.file, files::text(&hole.file)?)?;
    let to = To { out: hole.out.as_deref(), ..To::default() };
    match hole.compare {
        true => answers(args, to, &texts, compare_hole),
        false => answers(args, to, &texts, plan_hole),
    }
}

/// Plans drillings.
pub(crate) fn drill(args: &Args, drill: &Drill) -> Result<u8, Error> {
    let texts = read_holes(&drill.file, files::text(&drill.file)?)?;
    // Meshes are named as seen from the file.
    let (loader, _) = files::beside(Path::new(&drill.file));
    let to = To { out: drill.out.as_deref(), program: drill.program, ..To::default() };
    answers(args, to, &texts, |table| plan_drill_sheet(table, drill.paper, &loader))
}

/// Plans faces.
pub(crate) fn face(args: &Args, face: &Face) -> Result<u8, Error> {
    let texts = read_holes(&face.file, files::text(&face.file)?)?;
    // Drawings are named as seen from the file.
    let (loader, _) = files::beside(Path::new(&face.file));
    let wants = SheetWants {
        compare: face.compare || face.out.is_some(),
        paper: face.paper || face.out.is_some(),
        events: face.events,
    };
    let bar = progress::Bar::new();
    let to = To { out: face.out.as_deref(), program: face.program, ..To::default() };
    answers(args, to, &texts, |table| plan_face_sheet(table, wants, &loader, &bar))
}
