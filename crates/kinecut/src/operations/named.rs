//! Outlines of operations that have a name, to which others after them in the setup refer.

use super::outlines::OutlineKeys;
use super::{OperationTable, PlaneTable};
use crate::base::{Code, Finding, Result};
use crate::contouring::{ContourLoops, ContourSide};

/// The outline along which an operation works, as its table says it.
#[derive(Clone, Copy, Debug)]
pub(crate) struct NamedOutline<'a> {
    /// Name of the operation.
    pub(crate) name: &'a str,
    /// The keys that say the outline.
    pub(crate) keys: OutlineKeys<'a>,
    /// Side on which its cutter runs.
    pub(crate) side: ContourSide,
    /// Loops that it cuts.
    pub(crate) loops: ContourLoops,
    /// Height of the material's upper face [mm].
    pub(crate) top: f64,
    /// Stock that it leaves on the wall [mm].
    pub(crate) stock_to_leave: f64,
    /// The plane in which it works, if it names one.
    pub(crate) plane: Option<&'a PlaneTable>,
    /// Whether side and top follow from the edge of a mesh, as far as they are not given.
    pub(crate) from_edge: [bool; 2],
    /// Whether it cuts the wall along the outline, and compares it.
    pub(crate) has_wall: bool,
}

impl<'a> NamedOutline<'a> {
    /// The outline of the operation of a name, among those before another.
    ///
    /// # Errors
    /// `KC0104` with the key `of` where none has the name, or more than one.
    pub(crate) fn find(name: &str, before: &'a [OperationTable]) -> Result<NamedOutline<'a>> {
        let all: Vec<NamedOutline<'_>> = before.iter().filter_map(OperationTable::named_outline).collect();
        let mut of_name = all.iter().filter(|o| o.name == name);
        let (what, help) = match (of_name.next(), of_name.next()) {
            (Some(found), None) => return Ok(*found),
            (Some(_), Some(_)) => (
                format!("two operations before it have the name `{name}`"),
                "give each a name of its own".to_owned(),
            ),
            (None, _) => {
                let known: Vec<String> = all.iter().map(|o| format!("`{}`", o.name)).collect();
                let help = match known.is_empty() {
                    true => format!("give the contour before it a name: name = \"{name}\""),
                    false => format!("names in this setup before it: {}", known.join(", ")),
                };
                (format!("no operation before it in the setup has the name `{name}`"), help)
            }
        };
        Err(Finding::error(Code::JOB_REFERENCE, what).help(help).key("of").into())
    }
}
