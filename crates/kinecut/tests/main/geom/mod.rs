//! Outlines, as they come from files.

mod offset;
mod outline_files;
