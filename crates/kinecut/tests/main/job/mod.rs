//! Jobs as a whole: errors of the file, programs of others, rules of the proof, the cut part.

mod budget;
mod chamfer;
mod contour;
mod design;
mod engagement;
mod errors;
mod examples;
mod external;
mod feeds;
mod five_axis;
mod fixtures;
mod inspect;
mod kept;
mod machine_bodies;
mod picture;
mod playback;
mod pocket;
mod prove_motion;
mod prove_rules;
mod rest;
mod shape;
mod tap;
mod tool_files;
mod uncertainty;
