//! Stock and tools of a program that comes alone: as far as its comments tell them, and otherwise about its moves.
//!
//! All of it is a guess, which each answer says; as a job file it is there to be corrected.

use std::fmt::Write as _;

use crate::base::{Error, Result};
use crate::job::{
    Carried, CarriedTool, GivenFile, GivenStock, ProgramWants, TableTools, all_in_words, carried, control_of,
    given_alone, is_tool_table, micrometres, toml_of,
};
use crate::nc::Control;
use crate::verbs::check::program_sheet;

/// Stock and tools that are guessed.
#[derive(Clone, Debug)]
pub struct Guess {
    control: Control,
    carried: Carried,
    stock: Option<[f64; 6]>,
    of_stock: String,
    /// The reason why nothing is known of its moves.
    unread: Option<Error>,
    /// Whether the machine counts in inches.
    in_inches: bool,
    program: String,
}

impl Guess {
    /// The control that runs the program.
    pub fn control(&self) -> Control {
        self.control
    }

    /// Guesses the stock and the tools of a program.
    ///
    /// ```
    /// use kinecut::job::{GivenFile, ProgramWants};
    /// use kinecut::verbs::guess::Guess;
    /// let bytes = b"(T1 D=6. CR=0. - FLAT END MILL)\nG21 G90 G54\nT1 M6\nG43\nG0 X0 Y0 Z5\nG1 Z-1 F300\nX30\nM2\n";
    /// let program = GivenFile { name: "slot.ngc", bytes };
    /// let guess = Guess::of(program, &ProgramWants::default()).unwrap();
    /// // The feed moves and the radius of the tool about them.
    /// assert_eq!(guess.stock(), Some([-3.0, -3.0, -1.0, 33.0, 3.0, 0.0]));
    /// assert!(guess.job("slot.ngc", &[]).contains("type = \"end-mill\""));
    /// ```
    ///
    /// # Errors
    /// `KC0301` when nothing tells the control; a program that cannot be read has no box of its moves.
    pub fn of(program: GivenFile<'_>, wants: &ProgramWants) -> Result<Guess> {
        let (control, _) = control_of(wants.control.as_deref(), None, program.name, program.bytes)?;
        let text = String::from_utf8_lossy(program.bytes);
        let mut carried = carried(&text, control);
        if let Some((name, table)) = wants.tools.as_ref().filter(|(name, _)| is_tool_table(name)) {
            carried.tools = TableTools::read(name, table, wants.machine_unit())?.tools;
        }
        let mut unread = None;
        let (stock, of_stock) = match &carried.stock {
            Some(block) => {
                let [a, b, c] = block.min;
                let [d, e, f] = block.max;
                let assumed = block.assumed.map_or_else(String::new, |what| format!("; {what}"));
                let said = format!("as line {} says{assumed}", block.line);
                (Some([a, b, c, d, e, f]), said)
            }
            None => {
                let said = "the box of the feed moves and the radius of the largest tool about it, up to Z0 where they are below";
                let own = wants
                    .tools
                    .clone()
                    .or_else(|| (!carried.tools.is_empty()).then(|| tools_of(program.name, &carried.tools)));
                match about_moves(program, &ProgramWants { tools: own, ..wants.clone() }) {
                    Ok(stock) => (stock, said.to_owned()),
                    Err(error) => {
                        unread = Some(error);
                        (None, said.to_owned())
                    }
                }
            }
        };
        let in_inches = wants.machine_in_inches;
        Ok(Guess { control, carried, stock, of_stock, unread, in_inches, program: program.name.to_owned() })
    }

    /// The block of the stock: its least and its greatest corner [mm]; none where the program cuts nothing.
    pub fn stock(&self) -> Option<[f64; 6]> {
        self.stock
    }

    /// Takes what the user has not given from the guess, and says so.
    ///
    /// # Errors
    /// That of the program where its moves would tell the stock and cannot be read.
    pub fn complete(&self, wants: &mut ProgramWants) -> Result<()> {
        if let (None, None, Some(error)) = (&wants.stock, self.stock, &self.unread) {
            return Err(error.clone());
        }
        if let (None, Some(corners)) = (&wants.stock, self.stock) {
            wants.stock = Some(GivenStock::Block(corners));
            let [a, b, c, d, e, f] = corners.map(micrometres);
            wants
                .guessed
                .push(format!("the raw stock is a guess, {a},{b},{c} to {d},{e},{f}: {}", self.of_stock));
        }
        if wants.tools.is_none() && !self.carried.tools.is_empty() {
            wants.tools = Some(tools_of(&self.program, &self.carried.tools));
            let tools = all_in_words(&self.carried.tools);
            wants.guessed.push(format!("the tools are guessed from comments: {tools}"));
        }
        Ok(())
    }

    /// A job file with the guess, to be corrected; `file` is the program as seen from there, `kept` are further keys of its table with
    /// their values: files of the machine as seen from there.
    pub fn job(&self, file: &str, kept: &[(&str, String)]) -> String {
        let mut out =
            format!("# A guess from {}: correct it, then simulate this file.\nformat = 1\n", self.program);
        let _ = writeln!(out, "post = {{ control = \"{}\" }}", self.control.name());
        match self.stock {
            Some(corners) => {
                let [a, b, c, d, e, f] = corners.map(micrometres);
                let _ = writeln!(out, "# {}", self.of_stock);
                let _ =
                    writeln!(out, "stock = {{ box = {{ min = [{a}, {b}, {c}], max = [{d}, {e}, {f}] }} }}\n");
            }
            None => {
                let why =
                    if self.unread.is_some() { "its moves could not be read" } else { "it cuts nothing" };
                let _ = writeln!(out, "# The stock is to be filled in: {why}");
                out.push_str("stock = { box = { min = [0, 0, -1], max = [1, 1, 0] } }\n\n");
            }
        }
        out.push_str(&toml_of(&self.carried.tools));
        let kept: String = kept.iter().map(|(key, name)| format!(", {key} = {}", quoted(name))).collect();
        let inches = if self.in_inches && !kept.is_empty() { ", machine_in_inches = true" } else { "" };
        let file = quoted(file);
        let _ = writeln!(out, "[[setup]]\noffset = \"G54\"\nprogram = {{ file = {file}{kept}{inches} }}");
        out
    }
}

/// The box of the feed moves, wider by the radius of the largest tool; none where nothing is cut.
fn about_moves(program: GivenFile<'_>, wants: &ProgramWants) -> Result<Option<[f64; 6]>> {
    let given = given_alone(program, &ProgramWants { stock: None, ..wants.clone() }, false)?;
    let sheet = program_sheet(&given)?;
    if let Some(wrong) = sheet.findings.iter().find(|_| sheet.errors > 0) {
        return Err(wrong.clone().into());
    }
    let Some([[a, b, c], [d, e, f]]) = sheet.range else { return Ok(None) };
    let diameters = given.job().tools.iter().map(|t| t.cutter.diameter(t.flute_length));
    let radius = 0.5 * diameters.fold(0.0, f64::max);
    // What is fed above Z0 is air as a rule.
    let top = if c < 0.0 && f > 0.0 { 0.0 } else { f };
    let corners = [a - radius, b - radius, c, d + radius, e + radius, top];
    Ok((0..3).all(|i| corners[i] < corners[3 + i]).then_some(corners))
}

/// The tools of comments as a file of tools: its name and its text.
fn tools_of(program: &str, tools: &[CarriedTool]) -> (String, String) {
    (format!("comments of {program}"), toml_of(tools))
}

/// A text as a TOML string.
fn quoted(text: &str) -> String {
    serde_json::Value::from(text).to_string()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::job::GivenStock;

    const PROGRAM: &[u8] = b"(Material Size)\n(X= 60, Y= 40, Z= 12)\n(T1 D=6. CR=0. - FLAT END MILL)\n(T2 D=5. TAPER=118DEG - DRILL)\n\
        G21 G90 G54\nT1 M6\nG43\nG0 X0 Y0 Z5\nG1 Z-1 F300\nX30\nM2\n";

    #[test]
    fn what_the_user_gives_is_no_guess() {
        let program = GivenFile { name: "a.ngc", bytes: PROGRAM };
        let mut wants = ProgramWants {
            stock: Some(GivenStock::Block([0.0, 0.0, -5.0, 9.0, 9.0, 0.0])),
            ..ProgramWants::default()
        };
        Guess::of(program, &wants).unwrap().complete(&mut wants).unwrap();
        assert!(matches!(wants.stock, Some(GivenStock::Block([_, _, -5.0, ..]))));
        assert_eq!(
            wants.guessed,
            ["the tools are guessed from comments: T1 end-mill 6 mm (line 3), T2 drill 5 mm (line 4)"]
        );
        let mut wants =
            ProgramWants { tools: Some(("t".to_owned(), String::new())), ..ProgramWants::default() };
        Guess::of(program, &wants).unwrap().complete(&mut wants).unwrap();
        assert_eq!(
            wants.guessed,
            [
                "the raw stock is a guess, 0,0,-12 to 60,40,0: as line 2 says; its zero is taken to be the lower left corner of its upper side"
            ]
        );
    }

    #[test]
    fn the_job_of_a_guess_is_a_job() {
        let guess =
            Guess::of(GivenFile { name: "x/a \"b\".ngc", bytes: PROGRAM }, &ProgramWants::default()).unwrap();
        let job = guess.job("a \"b\".ngc", &[("parameters", "m.var".to_owned())]);
        assert!(job.contains("file = \"a \\\"b\\\".ngc\", parameters = \"m.var\" }"), "{job}");
        assert!(
            job.contains("min = [0, 0, -12], max = [60, 40, 0]") && job.contains("point_angle = 118"),
            "{job}"
        );
        let table: toml::Table = toml::from_str(&job).unwrap();
        assert_eq!(table["setup"][0]["program"]["file"].as_str(), Some("a \"b\".ngc"));
        assert_eq!(table["tool"].as_array().map(Vec::len), Some(2));
    }
}
