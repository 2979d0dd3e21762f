//! The verbs about what a moving tool does: `grazing`, `envelope`.

use std::path::Path;

use kinecut::base::{Error, Silent};
use kinecut::job::Items;
use kinecut::verbs::envelope::{ENVELOPE_LIST, EnvelopeTable, Envelopes, envelope_sheets};
use kinecut::verbs::grazing::{GRAZING_LIST, Gallery, GrazingTable, gallery, grazing_sheet};

use crate::answers::{To, answer, answers};
use crate::args::{Args, Envelope, Grazing};
use crate::files;

/// Grazing curves, or the paper's cases.
pub(crate) fn grazing(args: &Args, wanted: &Grazing) -> Result<u8, Error> {
    let to = To { out: wanted.out.as_deref(), svg: wanted.svg.as_deref(), ..To::default() };
    if wanted.gallery {
        return answer(args, to, Gallery(gallery()?));
    }
    let texts = Items::<GrazingTable>::read(&wanted.file, files::text(&wanted.file)?, GRAZING_LIST)?;
    // Drawings and jobs are named as seen from the file.
    let (loader, _) = files::beside(Path::new(&wanted.file));
    answers(args, to, &texts, |table| grazing_sheet(table, &loader))
}

/// Volumes that tools sweep in a move.
pub(crate) fn envelope(args: &Args, wanted: &Envelope) -> Result<u8, Error> {
    let texts = Items::<EnvelopeTable>::read(&wanted.file, files::text(&wanted.file)?, ENVELOPE_LIST)?;
    // Drawings, machines and jobs are named as seen from the file.
    let (loader, _) = files::beside(Path::new(&wanted.file));
    let to = To { out: wanted.out.as_deref(), svg: wanted.svg.as_deref(), ..To::default() };
    answers(args, to, &texts, |table| envelope_sheets(table, &loader, &Silent).map(Envelopes))
}
