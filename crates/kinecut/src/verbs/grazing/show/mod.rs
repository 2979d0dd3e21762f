//! Grazing curves as a person sees them: the tool with its curve, the parameter plane with the sign regions, tables, and the
//! paper's cases as a gallery.

mod bands;
mod claims;
mod hidden;
pub(crate) mod looks;
mod page;
mod plane;
mod tables;
mod tool;
mod view;

pub(crate) use claims::gallery_sections;
pub use claims::{gallery_html, gallery_svgs};
pub use page::{grazing_html, grazing_svg};

pub(crate) use bands::{Band, strips};
pub(crate) use page::{section, sentence};
pub(crate) use tables::{role_name, vector};
pub(crate) use tool::stretches;
pub(crate) use view::{extent, view_of};

use crate::sweep::SegmentKind;

/// Number of a kind of segment: its colour.
fn kind_number(kind: SegmentKind) -> u8 {
    match kind {
        SegmentKind::Generator => 0,
        SegmentKind::ConeCurve => 1,
        SegmentKind::DiscChord => 2,
        SegmentKind::SphereArc => 3,
        SegmentKind::TorusOuter => 4,
        SegmentKind::TorusInner => 5,
        SegmentKind::EdgeArc => 6,
        SegmentKind::Join => 7,
    }
}

/// A kind of segment in words.
fn kind_words(kind: SegmentKind) -> &'static str {
    match kind {
        SegmentKind::Generator => "generator, straight",
        SegmentKind::ConeCurve => "curve on a cone",
        SegmentKind::DiscChord => "chord of a disc",
        SegmentKind::SphereArc => "arc of a great circle",
        SegmentKind::TorusOuter => "curve on a torus outward",
        SegmentKind::TorusInner => "curve on a torus inward",
        SegmentKind::EdgeArc => "arc of an edge",
        SegmentKind::Join => "join at a concave edge",
    }
}

/// Kinds of segments that a curve has, each once, in the order of their numbers.
fn kinds(grazing: &crate::sweep::Grazing) -> Vec<SegmentKind> {
    let mut all: Vec<SegmentKind> = grazing.spans.iter().map(|s| s.kind).collect();
    all.sort();
    all.dedup();
    all
}
