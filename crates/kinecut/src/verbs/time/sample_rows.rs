//! Samples as rows of a table, in a CSV or a JSON file; degrees for rotary axes.

use std::fmt::Write as _;

use super::timed::LETTERS;
use crate::machine::Machine;
use crate::motion::{AxisMoment, MotionSample};
use crate::page::trimmed;

/// Form of a file of samples.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Form {
    Csv,
    Json,
}

/// The table of samples of a machine.
pub(super) struct SampleRows {
    form: Form,
    /// Indices of the axes that the machine has.
    axes: Vec<usize>,
    /// Whether rows tell their setup.
    setups: bool,
    rows: u64,
}

/// A quantity of an axis: the letters before its own, its unit after mm or degrees, its decimals, its value.
type Quantity = (&'static str, &'static str, usize, fn(&AxisMoment) -> f64);

/// Positions to 1e-9, so that differences at a millisecond still tell the jerk.
const QUANTITIES: [Quantity; 4] = [
    ("", "", 9, |axis| axis.position),
    ("v", "_per_s", 6, |axis| axis.velocity),
    ("a", "_per_s2", 4, |axis| axis.acceleration),
    ("j", "_per_s3", 2, |axis| axis.jerk),
];

impl SampleRows {
    pub(super) fn new(form: Form, machine: &Machine, setups: bool) -> SampleRows {
        let axes = (0..LETTERS.len()).filter(|a| machine.joint(LETTERS[*a]).is_some()).collect();
        SampleRows { form, axes, setups, rows: 0 }
    }

    fn columns(&self) -> Vec<String> {
        let mut columns = vec!["time_s".to_owned()];
        columns.extend(self.setups.then(|| "setup".to_owned()));
        columns.push("line".to_owned());
        for (i, (before, after, ..)) in QUANTITIES.iter().enumerate() {
            for a in &self.axes {
                let unit = if *a < 3 { "mm" } else { "deg" };
                columns.push(format!("{before}{}_{unit}{after}", LETTERS[*a].to_ascii_lowercase()));
            }
            if i == 0 {
                columns.push("feed_mm_per_min".to_owned());
            }
        }
        columns
    }

    /// Text before the first row.
    pub(super) fn head(&self, cycle: f64) -> String {
        let columns = self.columns();
        match self.form {
            Form::Csv => columns.join(",") + "\n",
            Form::Json => {
                format!(
                    "{{\n\"cycle\": {cycle},\n\"columns\": [\"{}\"],\n\"rows\": [",
                    columns.join("\", \"")
                )
            }
        }
    }

    /// One sample; `setup` and `line` count from 1.
    pub(super) fn row(
        &mut self,
        sample: &MotionSample,
        after: f64,
        setup: usize,
        line: Option<u32>,
    ) -> String {
        let mut cells = vec![self.number(sample.time + after, 9)];
        cells.extend(self.setups.then(|| setup.to_string()));
        cells.push(line.map_or_else(|| self.nothing(), |line| line.to_string()));
        for (i, (_, _, decimals, value)) in QUANTITIES.iter().enumerate() {
            for a in &self.axes {
                let value = value(&sample.axes[*a]);
                cells.push(self.number(if *a < 3 { value } else { value.to_degrees() }, *decimals));
            }
            if i == 0 {
                cells.push(self.number(sample.feed * 60.0, 4));
            }
        }
        let cells = cells.join(",");
        let first = self.rows == 0;
        self.rows += 1;
        let mut row = String::with_capacity(cells.len() + 4);
        // Writing into a text never fails.
        let _ = match self.form {
            Form::Csv => writeln!(row, "{cells}"),
            Form::Json => write!(row, "{}\n[{cells}]", if first { "" } else { "," }),
        };
        row
    }

    /// Text behind the last row.
    pub(super) fn tail(&self) -> &'static str {
        match self.form {
            Form::Csv => "",
            Form::Json => "\n]\n}\n",
        }
    }

    fn number(&self, value: f64, decimals: usize) -> String {
        if value.is_finite() { trimmed(value, decimals) } else { self.nothing() }
    }

    fn nothing(&self) -> String {
        match self.form {
            Form::Csv => String::new(),
            Form::Json => "null".to_owned(),
        }
    }
}
