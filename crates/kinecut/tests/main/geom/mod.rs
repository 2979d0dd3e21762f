//! Outlines, as they come from files.

mod outline_files;
