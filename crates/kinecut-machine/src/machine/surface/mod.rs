//! Surfaces by their generating lines: shape-generation functions, codes, redistributions between machine and tool,
//! recognition.

mod arrangement;
mod catalogue;
mod check;
mod definition;
mod element;
mod file;
mod fold;
mod formula;
mod methods;
mod recognise;
mod shape;
mod sliding;
mod split;
mod text;

pub use arrangement::arrangements;
pub use catalogue::catalogue;
pub use check::LONGEST_CHAIN;
pub use definition::{GeneratedSurface, Variable};
pub use element::{ChainElement, chain_text, word};
pub use file::{ChainEntry, NumberText, SurfaceFile, VariableEntry};
pub use fold::{Fold, FoldKind};
pub use formula::{Matrix, ShapeFormula, Vector};
pub use methods::{
    ContactEquations, EnvelopeMethod, GeneratingMethod, Group, KnownProcess, LineMethod, Makes, MethodsRow,
    SplitMethods, envelopes, envelopes_of, methods_table, notation,
};
pub use recognise::{Primitive, RecogniseOptions, RecognisedFace, Recognition, recognise};
pub use shape::{ShapeFunction, ShapeJet};
pub use sliding::{Form, Sample, Slide, SlidingGroup, sliding_group};
pub use split::{
    Candidate, ContactEffect, LinkKind, LinkedMotion, Retreat, SetupMotion, Source, Split, SplitOptions,
    ToolKind, filters,
};
pub use text::parse_chain;
