//! Outlines from SVG drawings.
//!
//! Read are paths and the basic shapes, with the transforms of their groups; strokes and fills do not matter. Circular
//! arcs stay exact where the transforms leave them circles; other curves become arcs. Y points upwards, the origin is the
//! lower left corner of the page. The label of an edge is the `inkscape:label`, class or own `id` of its element, else
//! those of the groups around it; an `id` such as `path12` is a drawing program's and no label.
//!
//! Source: W3C, Scalable Vector Graphics 1.1 (2011).

mod page;
mod path;
mod pen;

use std::collections::BTreeMap;

use glam::{DAffine2, DVec2};
use roxmltree::{Document, Node, ParsingOptions};

use super::drawing::{Drawing, Origin};
use super::source::Source;
use super::{OutlineOptions, OutlineRead};
use crate::base::Result;
use page::page;
use pen::{Pen, Subpath};

const INKSCAPE: &str = "http://www.inkscape.org/namespaces/inkscape";
/// Most nodes of a file: more is not a drawing of a face.
const MOST_NODES: u32 = 5_000_000;

/// An element to be visited, with what its groups say.
struct Visit<'a, 'i> {
    node: Node<'a, 'i>,
    affine: DAffine2,
    label: Option<String>,
    /// It lies in a chosen layer.
    chosen: bool,
}

/// Reads the outline of an SVG file.
pub(super) fn read_svg(name: &str, bytes: &[u8], options: &OutlineOptions) -> Result<OutlineRead> {
    let source = Source::new(name, bytes);
    let text = source.text();
    let parsing = ParsingOptions { allow_dtd: true, nodes_limit: MOST_NODES, ..ParsingOptions::default() };
    let document = Document::parse_with_options(&text, parsing).map_err(|e| {
        let at = e.pos();
        let offset = source.offset_of_line(at.row as usize) + at.col.saturating_sub(1) as usize;
        crate::base::Error::from(
            source.error(offset, format!("the file is not well-formed XML: {e}")).help("export it again"),
        )
    })?;
    let root = document.root_element();
    if root.tag_name().name() != "svg" {
        return Err(source.error(root.range().start, "the file is XML but not SVG").into());
    }
    let mut drawing = Drawing::new(source);
    let affine = page(root, &drawing.source, options.unit, &mut drawing.notes)?;
    let mut reader =
        Reader { drawing, options, passed: BTreeMap::new(), labels: BTreeMap::new(), converted: 0 };
    // A stack of its own: files may nest deeper than the stack of a thread.
    let mut stack = vec![Visit { node: root, affine, label: None, chosen: options.layers.is_empty() }];
    while let Some(visit) = stack.pop() {
        let children = reader.visit(visit)?;
        stack.extend(children.into_iter().rev());
    }
    reader.finish()
}

struct Reader<'o> {
    drawing: Drawing,
    options: &'o OutlineOptions,
    passed: BTreeMap<String, usize>,
    labels: BTreeMap<String, usize>,
    converted: usize,
}

impl Reader<'_> {
    /// Draws an element, or gives the elements of a group.
    fn visit<'a, 'i>(&mut self, visit: Visit<'a, 'i>) -> Result<Vec<Visit<'a, 'i>>> {
        const SILENT: [&str; 16] = [
            "defs",
            "symbol",
            "clipPath",
            "mask",
            "marker",
            "pattern",
            "metadata",
            "title",
            "desc",
            "style",
            "script",
            "namedview",
            "linearGradient",
            "radialGradient",
            "filter",
            "grid",
        ];
        let Visit { node, affine, mut label, mut chosen } = visit;
        let name = node.tag_name().name();
        if !node.is_element() || SILENT.contains(&name) {
            return Ok(Vec::new());
        }
        let offset = node.range().start;
        let style = node.attribute("style").unwrap_or("");
        let says = |key: &str, value: &str| {
            node.attribute(key).is_some_and(|v| v.trim() == value) || style_of(style, key) == Some(value)
        };
        if says("display", "none") || says("visibility", "hidden") {
            self.pass(format!("invisible {name}"));
            return Ok(Vec::new());
        }
        if style_of(style, "transform").is_some() {
            return Err(self
                .drawing
                .source
                .error(offset, "a transform in a style cannot be read")
                .help("apply the transforms in the drawing program and export again")
                .into());
        }
        for clip in ["clip-path", "mask"] {
            if node.has_attribute(clip) && !says(clip, "none") {
                self.pass(format!("{clip} of a {name}"));
            }
        }
        for own in names(node) {
            *self.labels.entry(own.clone()).or_default() += 1;
            chosen |= self.options.layers.contains(&own);
        }
        label = own_label(node).or(label);
        let is_root = node.parent_element().is_none();
        let affine = match node.attribute("transform") {
            Some(text) if !is_root => affine * self.transform(text, offset)?,
            _ => affine,
        };
        match name {
            "g" | "a" | "svg" if name != "svg" || is_root => {
                return Ok(node
                    .children()
                    .filter(Node::is_element)
                    .map(|node| Visit { node, affine, label: label.clone(), chosen })
                    .collect());
            }
            "use" | "svg" | "switch" => {
                let help = if name == "use" { "unlink the clone" } else { "ungroup it" };
                let what = format!("a {name} element cannot be read");
                return Err(self
                    .drawing
                    .source
                    .error(offset, what)
                    .help(format!("{help} in the drawing program"))
                    .into());
            }
            _ => {}
        }
        if chosen {
            self.draw(node, affine, label)?;
        }
        Ok(Vec::new())
    }

    fn draw(&mut self, node: Node<'_, '_>, affine: DAffine2, label: Option<String>) -> Result<()> {
        let name = node.tag_name().name();
        let offset = node.range().start;
        let mut pen = Pen::new(affine, self.options.curve_tolerance);
        let drawn = path::draw(node, &mut pen).map_err(|mut e| {
            e.0.message = format!("{name}: {}", e.0.message);
            e.0.place.get_or_insert_with(|| self.drawing.source.at(offset));
            e
        })?;
        if !drawn {
            self.pass(name.chars().take(30).collect());
            return Ok(());
        }
        self.converted += pen.converted;
        let label =
            self.drawing.origin(Origin { what: name.to_owned(), offset: Some(offset), label, weight: None });
        for subpath in pen.finish() {
            let (Subpath::Closed(edges) | Subpath::Open(edges)) = &subpath;
            let edges = edges.iter().map(|e| e.labelled(label)).collect();
            match subpath {
                Subpath::Closed(_) => self.drawing.loops.push(edges),
                Subpath::Open(_) => self.drawing.paths.push(edges),
            }
        }
        Ok(())
    }

    fn transform(&self, text: &str, offset: usize) -> Result<DAffine2> {
        let bad = |what: &str| self.drawing.source.error(offset, what);
        let t: svgtypes::Transform =
            text.parse().map_err(|_| bad("a transform of the SVG file is not valid"))?;
        let affine = DAffine2::from_cols(DVec2::new(t.a, t.b), DVec2::new(t.c, t.d), DVec2::new(t.e, t.f));
        let area = affine.matrix2.determinant();
        if !(affine.is_finite() && area.is_finite() && area != 0.0) {
            return Err(bad("a transform of the SVG file leaves nothing of the drawing").into());
        }
        Ok(affine)
    }

    fn pass(&mut self, what: String) {
        *self.passed.entry(what).or_default() += 1;
    }

    fn finish(mut self) -> Result<OutlineRead> {
        for layer in &self.options.layers {
            if !self.labels.contains_key(layer) {
                /// Most names that a message lists.
                const MOST: usize = 20;
                let there: Vec<String> = self.labels.keys().take(MOST).map(|l| format!("{l:?}")).collect();
                return Err(self
                    .drawing
                    .source
                    .whole(format!("nothing is drawn in a layer {layer:?}"))
                    .help(format!("names in the drawing: {}", there.join(", ")))
                    .into());
            }
        }
        for (what, count) in &self.passed {
            self.drawing.notes.push(format!("{count} {what} passed over"));
        }
        if self.converted > 0 {
            self.drawing.notes.push(format!(
                "{} curves stand as arcs within {} mm",
                self.converted, self.options.curve_tolerance
            ));
        }
        self.drawing.finish_with(self.options)
    }
}

/// The value of a property in a style attribute.
fn style_of<'s>(style: &'s str, key: &str) -> Option<&'s str> {
    style
        .split(';')
        .filter_map(|item| item.split_once(':'))
        .find(|(k, _)| k.trim() == key)
        .map(|(_, v)| v.trim())
}

/// All names of an element by which a layer may be chosen.
fn names(node: Node<'_, '_>) -> Vec<String> {
    let label = node.attribute((INKSCAPE, "label"));
    let classes = node.attribute("class").unwrap_or("").split_whitespace();
    label.into_iter().chain(classes).chain(node.attribute("id")).map(str::to_owned).collect()
}

/// The name that an element gives its edges.
fn own_label(node: Node<'_, '_>) -> Option<String> {
    let kind = node.tag_name().name();
    // Programs number what has no name: path12, rect3-5, g7.
    let numbered = |id: &str| {
        id.strip_prefix(kind)
            .or_else(|| id.strip_prefix("svg"))
            .is_some_and(|rest| rest.chars().all(|c| c.is_ascii_digit() || matches!(c, '-' | '_')))
    };
    let class = node.attribute("class").and_then(|c| c.split_whitespace().next());
    let id = node.attribute("id").filter(|id| !numbered(id));
    node.attribute((INKSCAPE, "label")).or(class).or(id).map(str::to_owned)
}

#[cfg(test)]
mod tests;
