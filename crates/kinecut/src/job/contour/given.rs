//! The tool of a verb that looks at one tool in motion: given as a table, as a file, or by the program that moves it.

use super::read::{contour_of, load_contour};
use crate::base::{Code, Finding, Loader, Result};
use crate::job::file::ContourTable;
use crate::tool::{Contour, ContourRead};

/// The tool of the keys `tool` and `tool_file`; at most one is given.
///
/// # Errors
/// `KC0102` when both are given; those of [`contour_of`] and [`load_contour`].
pub(crate) fn given_contour(
    tool: Option<&ContourTable>,
    file: Option<&str>,
    loader: &dyn Loader,
) -> Result<Option<ContourRead>> {
    match (tool, file) {
        (Some(_), Some(_)) => Err(Finding::error(Code::JOB_SHAPE, "the tool is given twice")
            .key("tool_file")
            .help("give either tool or tool_file")
            .into()),
        (Some(tool), None) => contour_of(tool, loader).map_err(|e| e.under("tool")).map(Some),
        (None, Some(file)) => load_contour(file, loader).map_err(|e| e.under("tool_file")).map(Some),
        (None, None) => Ok(None),
    }
}

/// Name, contour and remarks of the tool that is given, or of that of a program.
///
/// # Errors
/// `KC0102` when there is neither.
pub(crate) fn chosen_contour(
    given: Option<ContourRead>,
    of_program: Option<(String, Contour)>,
) -> Result<(String, Contour, Vec<String>)> {
    match (given, of_program) {
        (Some(read), _) => Ok((String::new(), read.contour, read.notes)),
        (None, Some((name, contour))) => Ok((name, contour, Vec::new())),
        (None, None) => {
            let help = "add [tool] with its shape, or tool_file with the name of a drawing";
            Err(Finding::error(Code::JOB_SHAPE, "there is no tool").help(help).into())
        }
    }
}
