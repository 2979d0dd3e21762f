//! Outlines from DXF drawings.
//!
//! Read are LINE, ARC, CIRCLE, LWPOLYLINE and POLYLINE with bulges, which stay exact, and ELLIPSE and SPLINE, which
//! become arcs. Layers become labels. The reader is our own: it must name the line of each entity in its messages, and
//! needs eight kinds of entities of one section.
//!
//! Source: Autodesk, DXF Reference (2012).

mod entity;
mod groups;

use std::collections::BTreeMap;

use entity::{Shape, shape};
use groups::{Entity, groups, whole};

use super::drawing::{Drawing, Origin, sentences};
use super::source::Source;
use super::{LengthUnit, OutlineOptions, OutlineRead};
use crate::base::Result;

/// First bytes of a binary DXF file.
const BINARY: &[u8] = b"AutoCAD Binary DXF";
/// First bytes of a DWG file.
const DWG: &[u8] = b"AC10";

/// Reads the outline of a DXF file.
pub(super) fn read_dxf(name: &str, bytes: &[u8], options: &OutlineOptions) -> Result<OutlineRead> {
    for (start, what) in [(BINARY, "a binary DXF"), (DWG, "a DWG")] {
        if bytes.starts_with(start) {
            return Err(Source::new(name, b"")
                .whole(format!("the file is {what} file, not a DXF text"))
                .help("export the drawing as DXF in text form (ASCII)")
                .into());
        }
    }
    let source = Source::new(name, bytes);
    let text = source.text();
    let groups = groups(&text, &source)?;
    let mm = unit(&source, groups.units, options.unit)?.mm();
    let mut reader = Reader::new(source, mm, options);
    let mut entities = groups.entities.into_iter().peekable();
    while let Some(mut entity) = entities.next() {
        // The vertices of an old polyline are entities of their own.
        let mut vertices = Vec::new();
        while entity.name == "POLYLINE"
            && let Some(next) = entities.next_if(|e| e.name == "VERTEX" || e.name == "SEQEND")
        {
            if next.name == "SEQEND" {
                break;
            }
            vertices.push(next);
        }
        reader.entity(&mut entity, &vertices)?;
    }
    reader.finish()
}

fn unit(source: &Source, number: Option<i64>, wanted: Option<LengthUnit>) -> Result<LengthUnit> {
    if let Some(unit) = wanted {
        return Ok(unit);
    }
    let Some(number) = number.filter(|&n| n != 0) else {
        return Err(source
            .whole("unknown units: the drawing does not say its unit of length ($INSUNITS)")
            .help("say the unit, for example mm, or set it in the drawing and export again")
            .into());
    };
    LengthUnit::of_dxf(number).ok_or_else(|| {
        source
            .whole("unknown units: no part is drawn in this unit ($INSUNITS)")
            .value(number as f64, "")
            .help("say the unit, for example mm")
            .into()
    })
}

struct Reader<'o> {
    drawing: Drawing,
    mm: f64,
    options: &'o OutlineOptions,
    passed: BTreeMap<String, usize>,
    layers: BTreeMap<String, usize>,
    converted: usize,
    points_twice: Vec<String>,
    heights: Option<[f64; 2]>,
}

impl<'o> Reader<'o> {
    fn new(source: Source, mm: f64, options: &'o OutlineOptions) -> Reader<'o> {
        Reader {
            drawing: Drawing::new(source),
            mm,
            options,
            passed: BTreeMap::new(),
            layers: BTreeMap::new(),
            converted: 0,
            points_twice: Vec::new(),
            heights: None,
        }
    }

    fn pass(&mut self, what: String) {
        *self.passed.entry(what).or_default() += 1;
    }

    fn entity(&mut self, entity: &mut Entity<'_>, vertices: &[Entity<'_>]) -> Result<()> {
        const DRAWN: [&str; 7] = ["LINE", "ARC", "CIRCLE", "LWPOLYLINE", "POLYLINE", "ELLIPSE", "SPLINE"];
        const REFUSED: [(&str, &str); 7] = [
            ("INSERT", "explode the block in the drawing"),
            ("REGION", "explode the region into lines and arcs"),
            ("3DSOLID", "export the part as STL, or its face as lines and arcs"),
            ("BODY", "export the part as STL, or its face as lines and arcs"),
            ("MLINE", "explode the multiline"),
            ("HELIX", "draw the contour in the plane"),
            ("TRACE", "draw its contour as a polyline"),
        ];
        let source = &self.drawing.source;
        let layer = entity.groups.iter().find(|g| g.code == 8).map_or("0", |g| g.value).to_owned();
        let flag = |code: i32| -> Result<i64> {
            entity.groups.iter().find(|g| g.code == code).map_or(Ok(0), |g| whole(source, g))
        };
        let refused = REFUSED.iter().find(|(name, _)| *name == entity.name);
        let drawn = DRAWN.contains(&entity.name);
        if !drawn && refused.is_none() {
            self.pass(entity.name.chars().take(30).collect());
            return Ok(());
        }
        if flag(67)? == 1 {
            self.pass(format!("{} in paper space", entity.name));
            return Ok(());
        }
        if flag(60)? == 1 {
            self.pass(format!("invisible {}", entity.name));
            return Ok(());
        }
        *self.layers.entry(layer.clone()).or_default() += 1;
        if !self.options.layers.is_empty() && !self.options.layers.contains(&layer) {
            return Ok(());
        }
        if let Some((name, help)) = refused {
            let what = format!("a {name} of layer {layer:?} is no outline that can be read");
            return Err(self.drawing.source.error(entity.offset, what).help(*help).into());
        }
        let origin = Origin {
            what: entity.name.to_owned(),
            offset: Some(entity.offset),
            label: Some(layer),
            weight: None,
        };
        let label = self.drawing.origin(origin);
        let found = shape(&self.drawing.source, entity, vertices, self.mm, self.options.curve_tolerance)?;
        self.converted += usize::from(found.converted);
        if found.points_twice > 0 {
            let entity = self.drawing.entity(label);
            self.points_twice
                .push(format!("{entity}: {} points that stand twice are left out", found.points_twice));
        }
        for z in found.heights {
            let [low, high] = self.heights.unwrap_or([z, z]);
            self.heights = Some([if z < low { z } else { low }, if z > high { z } else { high }]);
        }
        match found.shape {
            Shape::Loop(edges) => self.drawing.loops.push(edges.iter().map(|e| e.labelled(label)).collect()),
            Shape::Path(edges) if !edges.is_empty() => {
                self.drawing.paths.push(edges.iter().map(|e| e.labelled(label)).collect());
            }
            Shape::Path(_) => {}
        }
        Ok(())
    }

    fn finish(mut self) -> Result<OutlineRead> {
        for layer in &self.options.layers {
            if !self.layers.contains_key(layer) {
                let there: Vec<String> = self.layers.keys().map(|l| format!("{l:?}")).collect();
                return Err(self
                    .drawing
                    .source
                    .whole(format!("nothing is drawn on layer {layer:?}"))
                    .help(format!("layers of the drawing: {}", there.join(", ")))
                    .into());
            }
        }
        for (layer, count) in &self.layers {
            if !self.options.layers.is_empty() && !self.options.layers.contains(layer) {
                self.drawing.notes.push(format!("layer {layer:?}: {count} entities passed over"));
            }
        }
        for (what, count) in &self.passed {
            self.drawing.notes.push(format!("{count} {what} passed over"));
        }
        if self.converted > 0 {
            self.drawing.notes.push(format!(
                "{} ellipses and splines stand as arcs within {} mm",
                self.converted, self.options.curve_tolerance
            ));
        }
        self.drawing.notes.extend(sentences("polylines with points that stand twice", &self.points_twice));
        if let Some([low, high]) = self.heights
            && high > low
        {
            self.drawing.notes.push(format!("heights from Z {low} to Z {high} are all taken as one plane"));
        }
        self.drawing.finish_with(self.options)
    }
}

#[cfg(test)]
mod tests;
