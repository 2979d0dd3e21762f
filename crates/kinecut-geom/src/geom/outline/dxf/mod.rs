//! Outlines from DXF drawings.
//!
//! Read are LINE, ARC, CIRCLE, LWPOLYLINE and POLYLINE with bulges, which stay exact, and ELLIPSE and SPLINE, which
//! become arcs. Blocks are inserted, at any scale. Layers become labels. The reader is our own: it must name the line of each entity in its messages, and
//! needs nine kinds of entities of two sections.
//!
//! Source: Autodesk, DXF Reference (2012).

mod block;
mod entity;
mod groups;

use std::collections::BTreeMap;

use block::{Blocks, Placement};
use entity::{Shape, shape, with_article};
use groups::{Entity, groups, whole};

use super::drawing::{Drawing, Origin, sentences};
use super::source::Source;
use super::{LengthUnit, OutlineEdge, OutlineOptions, OutlineRead};
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
    let blocks = Blocks::new(groups.blocks);
    blocks.count(&source, &groups.entities)?;
    let mut reader = Reader::new(source, mm, options);
    reader.entities(&groups.entities, &Placement::DRAWING, &blocks)?;
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
    points: Vec<String>,
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
            points: Vec::new(),
            heights: None,
        }
    }

    fn pass(&mut self, what: String) {
        *self.passed.entry(what).or_default() += 1;
    }

    /// Entities at their place; of blocks, which do not contain themselves, those within.
    fn entities(
        &mut self,
        entities: &[Entity<'_>],
        place: &Placement<'_>,
        blocks: &Blocks<'_>,
    ) -> Result<()> {
        let mut at = 0;
        while let Some(entity) = entities.get(at) {
            at += 1;
            // The vertices of an old polyline are entities of their own.
            let first = at;
            while entity.name == "POLYLINE" && entities.get(at).is_some_and(|e| e.name == "VERTEX") {
                at += 1;
            }
            let vertices = &entities[first..at];
            at += usize::from(
                entity.name == "POLYLINE" && entities.get(at).is_some_and(|e| e.name == "SEQEND"),
            );
            if entity.name == "INSERT" && self.is_seen(entity)? {
                let layer = layer_of(entity, place);
                let block = match blocks.of(&self.drawing.source, entity) {
                    Ok(block) => block,
                    // The frame of a sheet may be in another file, on a layer that is not asked for.
                    Err(_) if !self.is_asked_for(layer) => {
                        self.pass("INSERT of a block that is not in the file".to_owned());
                        continue;
                    }
                    Err(error) => return Err(error),
                };
                let own = (self.mm, layer);
                for place in place.inserted(&self.drawing.source, entity, block, own)? {
                    self.entities(&block.entities, &place, blocks)?;
                }
            } else if entity.name != "INSERT" {
                self.entity(entity, vertices, place)?;
            }
        }
        Ok(())
    }

    /// Whether a layer is read: all are where none is named.
    fn is_asked_for(&self, layer: &str) -> bool {
        self.options.layers.is_empty() || self.options.layers.iter().any(|wanted| wanted == layer)
    }

    /// Whether an entity is neither in paper space nor invisible; a note where it is.
    fn is_seen(&mut self, entity: &Entity<'_>) -> Result<bool> {
        let source = &self.drawing.source;
        let flag = |code: i32| -> Result<i64> {
            entity.groups.iter().find(|g| g.code == code).map_or(Ok(0), |g| whole(source, g))
        };
        let (paper, hidden) = (flag(67)? == 1, flag(60)? == 1);
        if paper {
            self.pass(format!("{} in paper space", entity.name));
        } else if hidden {
            self.pass(format!("invisible {}", entity.name));
        }
        Ok(!paper && !hidden)
    }

    fn entity(&mut self, entity: &Entity<'_>, vertices: &[Entity<'_>], place: &Placement<'_>) -> Result<()> {
        const DRAWN: [&str; 7] = ["LINE", "ARC", "CIRCLE", "LWPOLYLINE", "POLYLINE", "ELLIPSE", "SPLINE"];
        const REFUSED: [(&str, &str); 6] = [
            ("REGION", "explode the region into lines and arcs"),
            ("3DSOLID", "export the part as STL, or its face as lines and arcs"),
            ("BODY", "export the part as STL, or its face as lines and arcs"),
            ("MLINE", "explode the multiline"),
            ("HELIX", "draw the contour in the plane"),
            ("TRACE", "draw its contour as a polyline"),
        ];
        let layer = layer_of(entity, place).to_owned();
        let refused = REFUSED.iter().find(|(name, _)| *name == entity.name);
        let drawn = DRAWN.contains(&entity.name);
        if !drawn && refused.is_none() {
            self.pass(entity.name.chars().take(30).collect());
            return Ok(());
        }
        if !self.is_seen(entity)? {
            return Ok(());
        }
        *self.layers.entry(layer.clone()).or_default() += 1;
        if !self.is_asked_for(&layer) {
            return Ok(());
        }
        if let Some((name, help)) = refused {
            let what = format!("{} of layer {layer:?} is no outline that can be read", with_article(name));
            return Err(self.drawing.source.error(entity.offset, what).help(*help).into());
        }
        let origin = Origin {
            what: entity.name.to_owned(),
            offset: Some(entity.offset),
            label: Some(layer),
            weight: None,
        };
        let label = self.drawing.origin(origin);
        let tolerance = self.options.curve_tolerance;
        let found =
            shape(&self.drawing.source, entity, vertices, self.mm, tolerance / place.stretch().max(1.0))?;
        let place = |edges| -> Result<Vec<OutlineEdge>> {
            let placed = place.edges(edges, tolerance);
            placed.map_err(|e| {
                self.drawing.error_at(label, e.code(), e.0.message.clone()).help(e.0.help.clone()).into()
            })
        };
        let shape = match found.shape {
            Shape::Loop(edges) => Shape::Loop(place(edges)?),
            Shape::Path(edges) => Shape::Path(place(edges)?),
        };
        self.converted += usize::from(found.converted);
        if found.is_point {
            let entity = self.drawing.entity(label);
            self.points.push(format!("{entity} has no length and is passed over"));
        }
        if found.points_twice > 0 {
            let entity = self.drawing.entity(label);
            self.points_twice
                .push(format!("{entity}: {} points that stand twice are left out", found.points_twice));
        }
        for z in found.heights {
            let [low, high] = self.heights.unwrap_or([z, z]);
            self.heights = Some([if z < low { z } else { low }, if z > high { z } else { high }]);
        }
        match shape {
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
            if !self.is_asked_for(layer) {
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
        self.drawing.notes.extend(sentences("entities without length", &self.points));
        self.drawing.notes.extend(sentences("polylines with points that stand twice", &self.points_twice));
        if let Some([low, high]) = self.heights
            && high > low
        {
            self.drawing.notes.push(format!("heights from Z {low} to Z {high} are all taken as one plane"));
        }
        self.drawing.finish_with(self.options)
    }
}

/// The layer of an entity: within a block that of layer 0 is the layer on which the block is inserted.
fn layer_of<'e>(entity: &Entity<'e>, place: &Placement<'e>) -> &'e str {
    match (entity.text(8).unwrap_or("0"), place.layer) {
        ("0", Some(layer)) => layer,
        (layer, _) => layer,
    }
}

#[cfg(test)]
mod tests;
