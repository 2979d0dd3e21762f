//! A collected drawing becomes an outline: closed, chained, its edges weighed and labelled.

use super::chain::chain;
use super::drawing::Drawing;
use super::half_section::close_along;
use super::{Outline, OutlineEdge, OutlineOptions, OutlineRead};
use crate::base::Result;

/// Weight of an edge that has none.
const PLAIN: f64 = 1.0;

impl Drawing {
    /// The outline as the options say: closed along the axis of a half section, open chains joined.
    pub(super) fn finish_with(mut self, options: &OutlineOptions) -> Result<OutlineRead> {
        if let Some(axis) = options.half_section {
            close_along(&mut self, axis, options.snap)?;
        }
        self.finish(options.snap)
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
        let origin_of: Vec<u32> = loops.iter().flatten().map(|e| e.label).collect();
        let name = |i: usize| match origin_of.get(i) {
            Some(&label) => format!("{i} ({})", self.entity(label)),
            None => i.to_string(),
        };
        let outline = Outline::named(loops, Vec::new(), &name).map_err(|mut error| {
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
        Ok(OutlineRead { outline, weights, notes: self.notes })
    }
}
