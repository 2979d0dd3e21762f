//! Surfaces as files say them: name, parameters, domains, the two lines.
//!
//! Numbers may be written as formulas of numbers (`"pi/6"`); lengths are mm and angles radians, because laws mix them.

use std::collections::BTreeMap;

use glam::DVec3;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::{ChainElement, GeneratedSurface, Variable, parse_chain};
use crate::base::{Code, Error, Finding, Result};
use crate::machine::Elementary;
use crate::machine::formula::Expression;

/// A surface by its generating lines.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct SurfaceFile {
    /// Name of the surface; `like` starts from a surface of the catalogue.
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub name: Option<String>,
    /// Title in words.
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub title: Option<String>,
    /// Name of a surface of the catalogue: everything that is not given here is taken from it.
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub like: Option<String>,
    /// Parameters of the laws [mm or rad]: numbers, or formulas of numbers ("pi/6").
    #[serde(skip_serializing_if = "BTreeMap::is_empty", default)]
    pub parameters: BTreeMap<String, NumberText>,
    /// The two free variables with their domains [mm or rad], in the order of the normal.
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub variables: Option<Vec<VariableEntry>>,
    /// Chain of the line along which the other one is carried: "6(phi) 1(R)" or [[6, "phi"], [1, "R"]].
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub directrix: Option<ChainEntry>,
    /// Chain of the line that is carried.
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub generatrix: Option<ChainEntry>,
    /// True if the product of the derivatives by the first and the second variable points into the material.
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub inward: Option<bool>,
    /// Directions of the inclined rotations 7, 8, 9 at home.
    #[serde(skip_serializing_if = "BTreeMap::is_empty", default)]
    pub inclined: BTreeMap<String, [f64; 3]>,
    /// Formula in X, Y, Z and the parameters that vanishes on the surface and is positive outside of the material.
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub implicit: Option<String>,
}

/// A number, or a formula of numbers.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(untagged)]
pub enum NumberText {
    /// A number.
    Number(f64),
    /// A formula of numbers, for example "pi/6".
    Formula(String),
}

/// A variable with its domain.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct VariableEntry {
    /// Name in the laws.
    #[schemars(example = &"u")]
    pub name: String,
    /// Least value [mm or rad].
    #[schemars(example = 0)]
    pub from: NumberText,
    /// Greatest value [mm or rad].
    #[schemars(example = &"2*pi")]
    pub to: NumberText,
}

/// A chain, as text or as a list of motions with their laws.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(untagged)]
pub enum ChainEntry {
    /// "6(phi) 1(R)".
    Text(String),
    /// [[6, "phi"], [1, "R"]].
    List(Vec<(u8, NumberText)>),
}

impl NumberText {
    fn expression(&self) -> Result<Expression> {
        match self {
            NumberText::Number(value) => Ok(Expression::number(*value)),
            NumberText::Formula(text) => Expression::parse(text),
        }
    }

    fn value(&self) -> Result<f64> {
        if let NumberText::Number(value) = self {
            return Ok(*value);
        }
        self.expression()?.bind(&[]).map(|bound| bound.value(&[]))
    }
}

impl ChainEntry {
    fn elements(&self) -> Result<Vec<ChainElement>> {
        match self {
            ChainEntry::Text(text) => parse_chain(text),
            ChainEntry::List(list) => list
                .iter()
                .enumerate()
                .map(|(i, (digit, law))| {
                    let motion = Elementary::from_digit(*digit).ok_or_else(|| {
                        Error::from(
                            Finding::error(Code::SURFACE_TEXT, format!("`{digit}` is no motion"))
                                .key(format!("[{i}]"))
                                .help("write a digit from 1 to 9 with its law: [6, \"phi\"]"),
                        )
                    })?;
                    Ok(ChainElement::new(motion, law.expression().map_err(|e| e.under(&format!("[{i}]")))?))
                })
                .collect(),
        }
    }
}

impl SurfaceFile {
    /// The surface, checked.
    ///
    /// ```
    /// # use kinecut_machine as kinecut;
    /// use kinecut::machine::surface::SurfaceFile;
    /// let text = r#"
    ///     like = "cone"
    ///     name = "taper"
    ///     parameters = { alpha = "pi/12" }
    ///     directrix = [[6, "phi"], [1, "R"]]
    /// "#;
    /// let taper = toml::from_str::<SurfaceFile>(text).unwrap().surface().unwrap();
    /// assert_eq!((taper.name.as_str(), taper.code().to_string().as_str()), ("taper", "6153"));
    /// assert!((taper.parameter("alpha").unwrap().to_degrees() - 15.0).abs() < 1e-12);
    /// ```
    ///
    /// # Errors
    /// `KC1107` for an unknown `like`, `KC1106` for a chain that cannot be read, `KC1101` and `KC1102` for formulas,
    /// `KC1104` for a key that is missing, and those of [`GeneratedSurface::check`]. Errors carry the key.
    pub fn surface(&self) -> Result<GeneratedSurface> {
        let base =
            self.like.as_deref().map(GeneratedSurface::named).transpose().map_err(|e| keyed(e, "like"))?;
        let lines = [("directrix", &self.directrix), ("generatrix", &self.generatrix)].map(|(key, entry)| {
            entry.as_ref().map(|e| e.elements().map_err(|error| keyed(error, key))).transpose()
        });
        let [directrix, generatrix] = lines;
        let (directrix, generatrix) = (directrix?, generatrix?);
        // The catalogue's equation does not hold for other lines.
        let own_lines = directrix.is_some() || generatrix.is_some();
        let mut surface = match base {
            Some(base) => base,
            None => {
                let given = directrix.is_some() && generatrix.is_some() && self.variables.is_some();
                if !given {
                    let help = "give `directrix`, `generatrix` and `variables`, or `like` with a name of the catalogue";
                    return Err(missing("a surface has no lines or variables").help(help).into());
                }
                GeneratedSurface {
                    name: "surface".to_owned(),
                    title: String::new(),
                    parameters: Vec::new(),
                    variables: [Variable::new("u", 0.0, 1.0), Variable::new("v", 0.0, 1.0)],
                    directrix: Vec::new(),
                    generatrix: Vec::new(),
                    inward: false,
                    inclined: [None; 3],
                    implicit: None,
                }
            }
        };
        let before = surface.chain();
        surface.name = self.name.clone().unwrap_or(surface.name);
        surface.title = self.title.clone().unwrap_or(surface.title);
        surface.directrix = directrix.unwrap_or(surface.directrix);
        surface.generatrix = generatrix.unwrap_or(surface.generatrix);
        for (name, value) in &self.parameters {
            surface = surface.with(name, value.value().map_err(|e| keyed(e, &format!("parameters.{name}")))?);
        }
        if let Some(entries) = &self.variables {
            surface.variables = variables(entries)?;
        }
        surface.inward = self.inward.unwrap_or(surface.inward);
        for (digit, direction) in &self.inclined {
            let slot = digit.parse::<usize>().ok().and_then(|d| d.checked_sub(7)).filter(|slot| *slot < 3);
            let key = format!("inclined.{digit}");
            let slot = slot.ok_or_else(|| {
                let help = "inclined rotations are 7, 8 and 9";
                Error::from(missing(&format!("`{digit}` is no inclined rotation")).key(key).help(help))
            })?;
            surface.inclined[slot] = Some(DVec3::from_array(*direction));
        }
        if let Some(implicit) = &self.implicit {
            surface.implicit = Some(Expression::parse(implicit).map_err(|e| keyed(e, "implicit"))?);
        } else if own_lines && surface.chain() != before {
            surface.implicit = None;
        }
        surface.check()?;
        Ok(surface)
    }

    /// The file of a surface, with all that it has.
    pub fn of(surface: &GeneratedSurface) -> SurfaceFile {
        let number = |value: f64| NumberText::Number(value);
        let inclined = surface.inclined.iter().enumerate().filter_map(|(i, d)| d.map(|d| (i + 7, d)));
        SurfaceFile {
            name: Some(surface.name.clone()),
            title: (!surface.title.is_empty()).then(|| surface.title.clone()),
            like: None,
            parameters: surface
                .parameters
                .iter()
                .map(|(name, value)| (name.clone(), number(*value)))
                .collect(),
            variables: Some(
                surface
                    .variables
                    .iter()
                    .map(|v| VariableEntry { name: v.name.clone(), from: number(v.from), to: number(v.to) })
                    .collect(),
            ),
            directrix: Some(ChainEntry::Text(super::chain_text(&surface.directrix))),
            generatrix: Some(ChainEntry::Text(super::chain_text(&surface.generatrix))),
            inward: Some(surface.inward),
            inclined: inclined.map(|(digit, d)| (digit.to_string(), d.to_array())).collect(),
            implicit: surface.implicit.as_ref().map(Expression::to_string),
        }
    }
}

fn variables(entries: &[VariableEntry]) -> Result<[Variable; 2]> {
    let [u, v] = entries else {
        return Err(missing("a surface has not two variables")
            .key("variables")
            .value(entries.len() as f64, "")
            .bound(2.0, "")
            .help("give the two free variables with their domains")
            .into());
    };
    let variable = |i: usize, entry: &VariableEntry| {
        let value = |key: &str, number: &NumberText| {
            number.value().map_err(|e| keyed(e, &format!("variables[{i}].{key}")))
        };
        Ok::<Variable, Error>(Variable::new(
            &entry.name,
            value("from", &entry.from)?,
            value("to", &entry.to)?,
        ))
    };
    Ok([variable(0, u)?, variable(1, v)?])
}

fn missing(what: &str) -> Finding {
    Finding::error(Code::SURFACE_FORM, what)
}

/// An error with the key it belongs to.
fn keyed(error: Error, key: &str) -> Error {
    let has_key = error.0.key.is_some();
    if has_key { error.under(key) } else { Error(Box::new(error.0.key(key))) }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn message(text: &str) -> String {
        let file: SurfaceFile = toml::from_str(text).unwrap();
        let error = file.surface().unwrap_err();
        format!("{} {}: {error}", error.code(), error.0.key.clone().unwrap_or_default())
    }

    #[test]
    fn a_file_of_each_surface_gives_it_back() {
        for surface in super::super::catalogue() {
            let text = toml::to_string(&SurfaceFile::of(surface)).unwrap();
            let mut again = toml::from_str::<SurfaceFile>(&text).unwrap().surface().unwrap();
            // The file has its parameters by name.
            let order = |(name, _): &(String, f64)| surface.parameters.iter().position(|(n, _)| n == name);
            again.parameters.sort_by_key(order);
            assert_eq!(&again, surface);
            assert_eq!(toml::to_string(&SurfaceFile::of(&again)).unwrap(), text);
        }
    }

    #[test]
    fn wrong_files_are_told_with_key_and_help() {
        let lines = "directrix = \"6(phi) 1(R)\"\ngeneratrix = \"1(R) 3(z)\"\n";
        let domains =
            "variables = [{ name = \"phi\", from = 0, to = \"2*pi\" }, { name = \"z\", from = 0, to = 9 }]\n";
        let good = format!("{lines}{domains}parameters = {{ R = 3 }}");
        assert!(toml::from_str::<SurfaceFile>(&good).unwrap().surface().is_ok());
        for (text, wanted) in [
            (lines.to_owned(), "KC1104 : a surface has no lines or variables"),
            ("like = \"kone\"".to_owned(), "KC1107 like: there is no surface `kone`"),
            (format!("{lines}{domains}"), "unknown name `R`"),
            (good.replace("R = 3", "R = \"3*q\""), "KC1102 parameters.R"),
            (good.replace("R = 3", "R = nan"), "no number for the parameter `R`"),
            (good.replace("1(R) 3(z)", "1(R) 0(z)"), "KC1106 generatrix"),
            (
                good.replace("\"6(phi) 1(R)\"", "[[6, \"phi\"], [11, \"R\"]]"),
                "KC1106 directrix[1]: `11` is no motion",
            ),
            (good.replace("to = 9", "to = -9"), "empty domain of `z`"),
            (good.replace("1(R) 3(z)", "1(2*R) 3(z)"), "has motion 1 twice in one place"),
            (good.replace("3(z)", "7(z)"), "inclined axis 7, which has no direction"),
            (good.replace("3(z)", "6(z)"), "is a line"),
            (good.replace("3(z)", "3(5)"), "does not use its variable `z`"),
            (good.replace("3(z)", "3(sqrt(z-5))"), "has no point at"),
            (good.replace("name = \"z\"", "name = \"phi\""), "has the name `phi` twice"),
            (
                good.replace(", { name = \"z\", from = 0, to = 9 }", ""),
                "KC1104 variables: a surface has not two variables",
            ),
        ] {
            let message = message(&text);
            assert!(message.contains(wanted), "{message}\n{text}");
            assert!(message.contains(';'), "no help: {message}");
        }
    }
}
