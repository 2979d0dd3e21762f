//! Planned faces as the report takes them: of a job's outcome, and of the sheet of `kinecut face`.
