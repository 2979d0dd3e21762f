//! The sheet of `kinecut drill` as JSON: lengths in mm, Z in the frame that its name says, speeds in rev/min, feeds in
//! mm/rev, times in s.

use serde::{Serialize, Serializer};

use super::DrillSheet;
use crate::operations::drill::{HoleJson, hole_json, refused_json};

#[derive(Debug, Serialize)]
struct SheetJson<'a> {
    title: &'a str,
    name: &'a str,
    point: &'static str,
    diameter: f64,
    control: &'static str,
    holes: Vec<HoleJson>,
    program: &'a str,
}

impl Serialize for DrillSheet {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let holes = self.holes.iter().zip(&self.places).enumerate();
        let holes = holes.map(|(number, (hole, at))| match hole {
            Ok(hole) => hole_json(hole, self.paper, self.load),
            Err(e) => refused_json(number, *at, (*e.0).clone()),
        });
        let sheet = SheetJson {
            title: &self.title,
            name: &self.name,
            point: self.point.name(),
            diameter: self.diameter,
            control: self.control,
            holes: holes.collect(),
            program: &self.program,
        };
        sheet.serialize(serializer)
    }
}
