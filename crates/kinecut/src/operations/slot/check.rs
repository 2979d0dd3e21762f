//! Slots, checked: as pockets, with a centre line.

use std::sync::Arc;

use super::SlotTable;
use super::plan::PlannedSlot;
use crate::base::{Code, Finding, Result};
use crate::contouring::{ContourLoops, ContourSide};
use crate::cutting::StartCut;
use crate::geom::OutlineRead;
use crate::operations::kind::{self, Attempt};
use crate::operations::named::NamedOutline;
use crate::operations::outlines::OutlineKeys;
use crate::operations::pocket::{CentredSlot, PocketOperation, USUAL_ENGAGEMENT, checked, planned};
use crate::operations::{Around, CalledTool, CuttingKeys, FeedKeys, Milling, PlaneTable, Setting};
use crate::page::trimmed;

/// Milling of a slot.
#[derive(Clone, Debug)]
pub struct SlotOperation {
    /// All but its name: a pocket with a centre line.
    pub pocket: Arc<PocketOperation>,
}

impl kind::Checked for SlotOperation {
    type Plan = PlannedSlot;

    const NOUN: &'static str = "slot";

    fn milling(&self) -> &Milling {
        &self.pocket.milling
    }

    fn milling_mut(&mut self) -> &mut Milling {
        &mut Arc::make_mut(&mut self.pocket).milling
    }

    fn name(&self) -> String {
        let shown = |mm: f64| trimmed(mm, 2);
        let [length, width] = self.pocket.slot.as_ref().map_or([0.0; 2], |s| [s.line.length(), s.width]);
        format!("slot {} x {} x {}", shown(length + width), shown(width), shown(self.pocket.table.depth))
    }

    fn is_left_hand(&self) -> bool {
        self.pocket.is_left_hand()
    }

    fn plan(self: &Arc<Self>, setting: &Setting<'_>) -> Result<Attempt<PlannedSlot>> {
        Ok(match planned(&self.pocket, setting)? {
            Attempt::SetupPlan(pocket, findings) => Attempt::SetupPlan(PlannedSlot { pocket }, findings),
            Attempt::LeftOut(reason) => Attempt::LeftOut(reason),
        })
    }
}

impl kind::Table for SlotTable {
    type Of = SlotOperation;

    fn check(&self, around: &Around<'_>) -> Result<SlotOperation> {
        if self.entry.is_some_and(|entry| entry.way.is_some()) {
            let what = "the way down into a slot follows from its width: a helix, or a ramp along it";
            let finding = Finding::error(Code::JOB_SHAPE, what).help("leave `way` out");
            return Err(finding.key("entry.way").into());
        }
        let line = self.slot().centre_line()?;
        let outline = line.outline(self.width)?;
        let weights = vec![1.0; outline.edges().len()];
        let read = OutlineRead { outline, weights, notes: Vec::new(), edge: None };
        let mut pocket = checked(&self.pocket(), "slot", around, || Ok(read))?;
        pocket.slot = Some(CentredSlot { line, width: self.width });
        Ok(SlotOperation { pocket: Arc::new(pocket) })
    }

    fn called(&mut self) -> &mut CalledTool {
        &mut self.tool
    }

    fn data(&mut self) -> Option<CuttingKeys<'_>> {
        let cut = StartCut::Side(self.engagement.unwrap_or(USUAL_ENGAGEMENT).to_radians());
        let feed = Some(FeedKeys { feed: &mut self.feed, per_tooth: &mut self.feed_per_tooth });
        Some(CuttingKeys {
            speed: &mut self.speed,
            cutting_speed: &mut self.cutting_speed,
            feed,
            per_rev: None,
            cut,
        })
    }

    fn plane(&self) -> Option<&PlaneTable> {
        self.plane.as_ref()
    }

    fn named_outline(&self) -> Option<NamedOutline<'_>> {
        self.name.as_deref().map(|name| NamedOutline {
            name,
            keys: OutlineKeys { slot: Some(self.slot()), ..OutlineKeys::default() },
            side: ContourSide::Inside,
            loops: ContourLoops::All,
            top: self.top,
            stock_to_leave: self.stock_to_leave,
            plane: self.plane(),
            from_edge: [false; 2],
            has_wall: true,
        })
    }
}
