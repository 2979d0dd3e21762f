//! A collected drawing becomes an outline: closed, chained, its edges weighed and labelled.

use super::chain::{chain, drawn_chains, open_chains};
use super::drawing::Drawing;
use super::half_section::close_along;
use super::{Outline, OutlineEdge, OutlineOptions, OutlineRead, OutlineReads};
use crate::base::Result;

/// Weight of an edge that has none.
const PLAIN: f64 = 1.0;

/// Makes an outline of chains of edges, with labels, and with words for an edge by its number.
type MakeOutline = fn(Vec<Vec<OutlineEdge>>, Vec<String>, &dyn Fn(usize) -> String) -> Result<Outline>;

impl Drawing {
    /// The outline as the options say: closed along the axis of a half section, open chains joined.
    pub(super) fn finish_with(mut self, options: &OutlineOptions) -> Result<OutlineRead> {
        if let Some(axis) = options.half_section {
            close_along(&mut self, axis, options.snap)?;
        }
        match options.reads {
            OutlineReads::Loops => self.finish(options.snap),
            OutlineReads::Lines => self.finish_lines(options.snap),
            OutlineReads::Drawn => self.finish_drawn(options.snap),
        }
    }

    /// The open lines: chains joined within `snap` [mm], what is drawn twice left out; closed loops are passed over.
    fn finish_lines(mut self, snap: f64) -> Result<OutlineRead> {
        let lines = open_chains(&mut self, snap)?;
        let closed = self.loops.len();
        if lines.is_empty() {
            let what = match closed {
                0 => "the file holds no open line".to_owned(),
                1 => "the file holds no open line, but a closed loop".to_owned(),
                _ => format!("the file holds no open line, but {closed} closed loops"),
            };
            let help = "for closed loops write side = \"outside\" or \"inside\"; or choose the layer of the line: layers = [\"..\"]";
            return Err(self.source.whole(what).help(help).into());
        }
        if closed > 0 {
            self.notes.push(match closed {
                1 => "a closed loop is passed over: only open lines have a left and a right".to_owned(),
                _ => {
                    format!("{closed} closed loops are passed over: only open lines have a left and a right")
                }
            });
        }
        self.named(lines, |lines, labels, name| Outline::named_lines(lines, labels, name, true))
    }

    /// All that is drawn as lines: chains joined within `snap` [mm] where two ends meet, loops from their first point around, what is
    /// drawn twice left out.
    fn finish_drawn(mut self, snap: f64) -> Result<OutlineRead> {
        let mut lines = drawn_chains(&mut self, snap)?;
        lines.append(&mut self.loops);
        if lines.is_empty() {
            let help = "draw lines, arcs or loops along which the cutter is to run";
            return Err(self.source.whole("the file holds no line").help(help).into());
        }
        self.named(lines, |lines, labels, name| Outline::named_lines(lines, labels, name, false))
    }

    /// The outline: open chains joined within `snap` [mm], what is drawn twice left out.
    pub(super) fn finish(mut self, snap: f64) -> Result<OutlineRead> {
        chain(&mut self, snap)?;
        if self.loops.is_empty() {
            let passed =
                if self.notes.is_empty() { String::new() } else { format!(" ({})", self.notes.join("; ")) };
            return Err(self
                .source
                .whole(format!("the file holds no lines or arcs of an outline{passed}"))
                .help("draw the face as closed loops of lines and arcs")
                .into());
        }
        let loops = std::mem::take(&mut self.loops);
        self.named(loops, Outline::named)
    }

    /// The outline of loops or lines, their edges weighed and labelled.
    fn named(self, loops: Vec<Vec<OutlineEdge>>, make: MakeOutline) -> Result<OutlineRead> {
        let origin_of: Vec<u32> = loops.iter().flatten().map(|e| e.label).collect();
        let name = |i: usize| match origin_of.get(i) {
            Some(&label) => format!("{i} ({})", self.entity(label)),
            None => i.to_string(),
        };
        let outline = make(loops, Vec::new(), &name).map_err(|mut error| {
            if error.0.place.is_none() {
                error.0.place = Some(self.source.file());
            }
            error
        })?;
        let weight =
            |e: &OutlineEdge| self.origins.get(e.label as usize).and_then(|o| o.weight).unwrap_or(PLAIN);
        let weights = outline.edges().iter().map(weight).collect();
        let mut labels: Vec<String> = self.origins.iter().filter_map(|o| o.label.clone()).collect();
        labels.sort();
        labels.dedup();
        let label_of = |origin: u32| {
            let label = self.origins.get(origin as usize)?.label.as_ref()?;
            u32::try_from(labels.binary_search(label).ok()?).ok()
        };
        let outline = outline.relabelled(|l| label_of(l).unwrap_or(OutlineEdge::NO_LABEL), labels.clone());
        Ok(OutlineRead { outline, weights, notes: self.notes, edge: None })
    }
}
