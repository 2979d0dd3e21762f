//! A job of one hole alone.

use super::HoleTable;
use crate::base::{Code, Error, Finding, MemoryLoader, Result};
use crate::job::check::{Job, check};
use crate::job::file::{BoxTable, JobFile, PostTable, SetupTable, SimulateTable, StockTable, ToolTable};
use crate::nc;
use crate::operations::OperationTable;

/// A job of this hole alone, in a block around it.
pub(super) fn job(table: &HoleTable) -> Result<Job> {
    let OperationTable::Bore(bore) = &table.operation else {
        let help = match &table.operation {
            OperationTable::Drill(_) => "use `kinecut drill`",
            OperationTable::Face(_) => "use `kinecut face`",
            OperationTable::Path(_) => "use `kinecut run`: a path is part of a job",
            _ => "write type = \"bore\", or run the operation as a job",
        };
        return Err(Finding::error(Code::JOB_SHAPE, "this verb plans bores only")
            .help(help)
            .key("operation.type")
            .into());
    };
    // An absurd value is reported by the checks of its own key, not by those of the block.
    const MODEST: f64 = 4000.0;
    let modest = |v: f64, default: f64| if v.abs() < MODEST { v } else { default };
    let half = modest(bore.diameter, 1.0).abs() + 1.0;
    let [x, y] = bore.at.map(|v| modest(v, 0.0));
    let top = modest(bore.top, 0.0);
    let bottom = top - modest(bore.depth, 1.0).abs() - modest(bore.breakthrough, 0.0).abs() - 1.0;
    let stock =
        StockTable::Box(BoxTable { min: [x - half, y - half, bottom], max: [x + half, y + half, top] });
    let setup = SetupTable::of(table.operation.clone());
    let file = job_file(table, stock, setup);
    check(&file, "HOLE", &MemoryLoader::default()).map_err(own_key)
}

/// The file of a job of one operation.
pub(crate) fn job_file(table: &HoleTable, stock: StockTable, setup: SetupTable) -> JobFile {
    let post = table.post.clone().unwrap_or(PostTable {
        control: nc::Control::Sinumerik840d.name().to_owned(),
        ..PostTable::default()
    });
    JobFile {
        format: 1,
        units: None,
        title: table.title.clone(),
        material: None,
        libraries: None,
        tool_files: Vec::new(),

        cutting: None,
        taken: Vec::new(),
        design: None,
        stock,
        drilled: Vec::new(),
        fixtures: Vec::new(),
        post,
        simulate: SimulateTable::default(),
        machine: None,
        holders: Vec::new(),
        tools: vec![ToolTable { holder: None, ..table.tool.clone() }],
        setups: vec![setup],
    }
}

/// An error with the key that the user wrote instead of that of the job around it.
pub(crate) fn own_key(mut error: Error) -> Error {
    if let Some(key) = error.0.key.take() {
        let own = [("setup[0].operation[0]", "operation"), ("tool[0]", "tool")]
            .iter()
            .find_map(|(from, to)| Some(format!("{to}{}", key.strip_prefix(from)?)));
        error.0.key = Some(own.unwrap_or(key));
    }
    error
}
