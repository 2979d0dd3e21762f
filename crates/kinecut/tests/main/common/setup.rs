//! A clamping with its zero at the table's.

use std::collections::BTreeMap;

use kinecut::geom::Rigid;
use kinecut::program::{Setup, WorkOffset};

/// A setup whose work offset G54 lies in the zero of the table, on a machine that is known.
pub(crate) fn setup() -> Setup {
    Setup {
        name: "setup 1".to_owned(),
        part_on_table: Rigid::IDENTITY,
        work_offsets: BTreeMap::from([(WorkOffset::G54, Rigid::IDENTITY)]),
        located: true,
        stock: None,
        fixtures: Vec::new(),
    }
}
