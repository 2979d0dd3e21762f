//! The parameter file of LinuxCNC (`linuxcnc.var`): a number and a value a line, the numbers in their order.

use std::collections::BTreeMap;

use crate::base::{Code, FileId, Finding, Result, Sources, Span};

/// Greatest number of a parameter.
const LAST: u32 = 5601;

/// Parameters that LinuxCNC keeps from one program to the next.
#[derive(Clone, Debug, PartialEq)]
pub struct Parameters {
    values: BTreeMap<u32, f64>,
    unit: f64,
}

impl Parameters {
    /// The value of a parameter, 0 where the file does not have it; lengths of the machine are in [`Parameters::unit`].
    pub fn value(&self, number: u32) -> f64 {
        self.values.get(&number).copied().unwrap_or(0.0)
    }

    /// Unit of the machine's lengths in mm.
    pub fn unit(&self) -> f64 {
        self.unit
    }

    /// Numbers and values of the file, in their order.
    pub fn all(&self) -> impl Iterator<Item = (u32, f64)> + '_ {
        self.values.iter().map(|(number, value)| (*number, *value))
    }
}

/// The parameters in a file of LinuxCNC; `unit` is the unit of the machine's lengths in mm.
///
/// ```
/// use kinecut_nc::base::Sources;
/// use kinecut_nc::nc::parameters;
/// let mut sources = Sources::default();
/// let file = sources.add("linuxcnc.var", "31\t0.5\n5220\t1.000000\n5221\t-100.25\n");
/// let kept = parameters(&sources, file, 1.0).unwrap();
/// assert_eq!((kept.value(5221), kept.value(31), kept.value(5222)), (-100.25, 0.5, 0.0));
/// ```
///
/// # Errors
/// `KC0202` with its place for a line that is not a number and a value, and for a number out of range or out of order.
pub fn parameters(sources: &Sources, file: FileId, unit: f64) -> Result<Parameters> {
    let text = sources.text(file);
    let mut values = BTreeMap::new();
    let mut before = 0;
    let mut start = 0;
    for line in text.split_inclusive('\n') {
        let said = line.trim();
        let from = start + line.len() - line.trim_start().len();
        start += line.len();
        if said.is_empty() || said.starts_with([';', '#']) {
            continue;
        }
        let wrong = |why: &str| {
            let span = Span { file, start: from as u32, end: (from + said.len()) as u32 };
            let finding = Finding::error(Code::NC_SYNTAX, format!("`{said}` {why}"));
            finding.at(sources.locate(span)).help("write a line as 5221 -100.25")
        };
        let mut words = said.split_whitespace();
        let number = words.next().and_then(|word| word.parse::<u32>().ok());
        let value = words.next().and_then(|word| word.parse::<f64>().ok()).filter(|v| v.is_finite());
        let (Some(number), Some(value), None) = (number, value, words.next()) else {
            return Err(wrong("is not the number and the value of a parameter").into());
        };
        if !(1..=LAST).contains(&number) {
            let finding = wrong("is no parameter").value(f64::from(number), "").bound(f64::from(LAST), "");
            return Err(finding.help("parameters are 1 to 5601").into());
        }
        if number <= before {
            let finding = wrong("is out of order: LinuxCNC refuses such a file");
            return Err(finding.help("sort the lines by their numbers, each once").into());
        }
        before = number;
        values.insert(number, value);
    }
    Ok(Parameters { values, unit })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_line_that_is_no_parameter_is_an_error() {
        let said = |text: &str| {
            let mut sources = Sources::default();
            let file = sources.add("a.var", text);
            parameters(&sources, file, 1.0).map(|p| p.all().count()).map_err(|e| e.to_string())
        };
        assert_eq!(said("# kept\n31 1\n\n  5220\t1.000000\r\n"), Ok(2));
        assert_eq!(
            said("31 1\n 32 x\n"),
            Err("a.var:2:2: `32 x` is not the number and the value of a parameter; write a line as 5221 -100.25".into())
        );
        assert!(said("31 1 2").is_err() && said("31").is_err() && said("31 inf").is_err());
        assert!(said("5602 1").unwrap_err().contains("no parameter"));
        assert!(said("33 1\n32 1").unwrap_err().contains("out of order"));
    }
}
