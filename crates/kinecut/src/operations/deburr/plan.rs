//! A planned deburring: its moves, its wall, its part of report and plan.

use std::sync::Arc;

use super::DeburrOperation;
use crate::base::Result;
use crate::operations::edge::{EdgeJson, PlannedEdge, section};
use crate::operations::kind;
use crate::operations::wanted::WantedWall;
use crate::operations::{Found, Judged, Pen, PostedPlan, Shown};
use crate::page::Section;

/// A planned deburring.
#[derive(Clone, Debug)]
pub struct PlannedDeburr {
    /// The operation.
    pub of: Arc<DeburrOperation>,
    /// The break of the edge.
    pub edge: PlannedEdge,
}

impl kind::Plan for PlannedDeburr {
    type Json = EdgeJson;

    const LIST: &'static str = "deburrings";

    fn write(&mut self, pen: &mut Pen<'_>) -> Result<()> {
        self.edge.write(pen);
        Ok(())
    }

    fn walls(&self) -> Vec<WantedWall> {
        self.edge.walls()
    }

    fn judge(&mut self, name: &str, _posted: &PostedPlan<'_>, _found: &Found<'_>) -> Judged {
        self.edge.judged(name)
    }

    fn sections(all: &[(&PlannedDeburr, &Shown<'_>)]) -> Vec<Section> {
        all.iter().map(|(plan, shown)| section(&plan.edge, shown)).collect()
    }

    fn json(&self, shown: &Shown<'_>) -> Option<EdgeJson> {
        Some(EdgeJson::new(&self.edge, shown.number))
    }
}
