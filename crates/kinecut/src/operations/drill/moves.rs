//! SetupPlan holes as moves and cycles of a program.

use glam::DVec3;

use super::{DrillOperation, PeckName, PeckTable, PlannedHole};
use crate::base::Result;
use crate::drilling::{DrillMethod, Zone, ZoneStage};
use crate::geom::Line;
use crate::nc::Control;
use crate::operations::Pen;
use crate::program::{Between, Cycle, DeepHole, Move, Origin, Role, Shortening, Speed};

/// Distance above the depth reached at which a rapid back into a hole ends, and lift that breaks a chip [mm], where the
/// control has no distance of its own.
const ABOVE: f64 = 0.5;

/// Heights nearer to a step of the control than this share of it are on it.
const ON_STEP: f64 = 1e-6;

/// Drills the holes in their order.
///
/// # Errors
/// Those of a cycle's steps.
pub(super) fn write_holes(
    pen: &mut Pen<'_>,
    drill: &DrillOperation,
    holes: &mut [PlannedHole],
) -> Result<()> {
    let (control, resolution) = (pen.setting.post.control, pen.setting.resolution());
    let clearance = drill.table.clearance.unwrap_or(pen.setting.clamping.safe_height);
    for (i, hole) in holes.iter_mut().enumerate() {
        hole.first_item = pen.program.items.len() as u32;
        let heights = Heights { step: resolution, zero: hole.zero };
        let zones = heights.zones(&hole.plan.zones);
        let spindle = hole.plan.spindle;
        let mut at = HolePen { pen, at: hole.at, spindle, control, clearance, resolution };
        // From the tool change the height is not known: first over the place, then down.
        at.rapid(if i == 0 { f64::NAN } else { clearance });
        if i == 0 {
            at.rapid(clearance);
            at.pen.state.coolant = drill.milling.coolant;
        }
        at.hole(drill, &zones)?;
        hole.next_item = pen.program.items.len() as u32;
    }
    Ok(())
}

/// The pen over one hole.
struct HolePen<'a, 'b> {
    pen: &'a mut Pen<'b>,
    at: [f64; 2],
    /// Speed of the spindle [rad/s].
    spindle: f64,
    control: Control,
    clearance: f64,
    resolution: f64,
}

impl HolePen<'_, '_> {
    fn to(&mut self, z: f64, speed: Speed, role: Role) {
        let end = DVec3::new(self.at[0], self.at[1], z);
        self.pen.state.speed = speed;
        let origin = Origin { role, ..self.pen.origin };
        self.pen.program.push_move(Move::along(&Line { start: end, end }.into()), self.pen.state, origin);
    }

    fn rapid(&mut self, z: f64) {
        self.to(z, Speed::Rapid { linear: true }, Role::Link);
    }

    fn feed(&mut self, zone: &Zone) {
        let speed = self.speed(zone.feed);
        let role = if matches!(zone.stage, ZoneStage::Steady | ZoneStage::Partial) {
            Role::Rough
        } else {
            Role::Lead
        };
        self.to(zone.to, speed, role);
    }

    /// A feed per revolution, as the control takes it.
    fn speed(&self, feed: f64) -> Speed {
        if self.control.has_feed_per_revolution() {
            Speed::PerRevolution(feed)
        } else {
            Speed::PerMinute(feed * self.spindle / std::f64::consts::TAU)
        }
    }

    fn hole(&mut self, drill: &DrillOperation, zones: &[Zone]) -> Result<()> {
        let t = &drill.table;
        let (Some(first), Some(last)) = (zones.first(), zones.last()) else { return Ok(()) };
        let (start, bottom) = (first.from, last.to);
        // A reamer that leaves in a rapid move scores the wall: it comes out at its feed, which the cycles of drilling do not.
        let reams = drill.method == DrillMethod::Reaming;
        let one_feed = zones.iter().all(|z| z.feed == first.feed);
        let drilled = start - t.approach - bottom;
        let peck = t.peck.or_else(|| t.peck_deep.filter(|(least, _)| drilled > *least).map(|(_, peck)| peck));
        if !reams && one_feed && peck.is_none() && t.cycles {
            let cycle = Cycle::Drill { reference: start, bottom, retract: self.clearance, dwell: t.dwell };
            return self.cycle(cycle, first.feed);
        }
        if let (Control::Sinumerik840d, true, Some(peck)) = (self.control, t.cycles, peck)
            && let Some(cycle) = self.entry_and_steps(zones, peck, t.dwell)
        {
            return self.cycle(cycle, last.feed);
        }
        self.rapid(start);
        for zone in zones {
            match (peck, zone.stage) {
                (Some(peck), ZoneStage::Steady) if zone.length() > peck.step => {
                    let cycle = match peck.after {
                        PeckName::BreakChip => Cycle::ChipBreak {
                            reference: zone.from,
                            bottom: zone.to,
                            retract: zone.from,
                            step: peck.step,
                            lift: ABOVE,
                        },
                        PeckName::Clear => Cycle::Peck {
                            reference: start,
                            bottom: zone.to,
                            retract: start,
                            step: peck.step,
                            clearance: ABOVE,
                        },
                    };
                    self.cycle(cycle, zone.feed)?;
                    if zone.to > bottom || t.dwell > 0.0 {
                        self.rapid(zone.to + ABOVE);
                    }
                    if zone.to <= bottom && t.dwell > 0.0 {
                        // The cycle has withdrawn; the dwell is at the bottom.
                        self.feed(zone);
                    }
                }
                _ => self.feed(zone),
            }
        }
        if t.dwell > 0.0 {
            self.pen.program.push_dwell(t.dwell, self.pen.state, self.pen.origin);
        }
        if reams {
            let speed = self.speed(drill.feed.steady);
            self.to(start, speed, Role::Lead);
        }
        self.rapid(self.clearance);
        Ok(())
    }

    /// A blind hole in steps as one cycle whose first step is the entry at its own feed (`CYCLE83` with `FRF`); the last
    /// steps are whole. `None` for other holes.
    fn entry_and_steps(&self, zones: &[Zone], peck: PeckTable, dwell: f64) -> Option<Cycle> {
        let [entry, steady] = zones else { return None };
        let blind = (entry.stage, steady.stage) == (ZoneStage::Entry, ZoneStage::Steady);
        // The cycle counts its steps from a surface that lies below its start.
        let most = if peck.step < entry.length() { peck.step } else { entry.length() };
        if !blind || peck.after != PeckName::Clear || entry.feed > steady.feed || steady.length() <= most {
            return None;
        }
        let count = (steady.length() / most - ON_STEP).ceil();
        let units = (steady.length() / count / self.resolution + ON_STEP).floor();
        let step = units * self.resolution;
        // Whole steps from the bottom up: the entry reaches a little farther.
        let first = steady.to + count * step;
        (units > 0.0 && entry.from - first >= step).then_some(Cycle::DeepHole(DeepHole {
            reference: entry.from,
            first,
            bottom: steady.to,
            retract: self.clearance,
            step,
            shortening: Shortening::None,
            between: Between::Withdraw { clearance: ABOVE, dwell: 0.0 },
            first_feed: entry.feed / steady.feed,
            dwell: 0.0,
            dwell_bottom: dwell,
        }))
    }

    fn cycle(&mut self, cycle: Cycle, feed: f64) -> Result<()> {
        self.pen.state.speed = match self.control {
            // Its cycles take a feed per minute.
            Control::Heidenhain => Speed::PerMinute(feed * self.spindle / std::f64::consts::TAU),
            _ => self.speed(feed),
        };
        let cycle = self.control.own_cycle(cycle, self.resolution);
        self.pen.program.push_cycle(cycle, self.pen.state, Origin { role: Role::Rough, ..self.pen.origin })
    }
}

/// Heights on the steps of the control, so that a zone as posted contains the exact one of its slower feed.
struct Heights {
    step: f64,
    zero: f64,
}

impl Heights {
    fn zones(&self, exact: &[Zone]) -> Vec<Zone> {
        let mut zones: Vec<Zone> = exact.to_vec();
        let last = zones.len().saturating_sub(1);
        for i in 0..zones.len() {
            zones[i].from = if i == 0 { self.up(exact[0].from) } else { zones[i - 1].to };
            // The slower of two neighbours reaches into the other; a hole is not too short.
            let slows = i < last && exact[i].feed > exact[i + 1].feed;
            zones[i].to = if slows { self.up(exact[i].to) } else { self.down(exact[i].to) };
        }
        zones.retain(|z| z.from > z.to);
        // A faster stretch of less than a revolution between two slower ones has no feed of its own.
        let mut i = 1;
        while i + 1 < zones.len() {
            let (before, here, after) = (zones[i - 1], zones[i], zones[i + 1]);
            if here.feed > before.feed && here.feed > after.feed && here.revolutions() < 1.0 {
                zones[i - 1].to = here.to;
                zones.remove(i);
            } else {
                i += 1;
            }
        }
        zones
    }

    fn up(&self, z: f64) -> f64 {
        ((z + self.zero) / self.step - ON_STEP).ceil() * self.step
    }

    fn down(&self, z: f64) -> f64 {
        ((z + self.zero) / self.step + ON_STEP).floor() * self.step
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn slower_zones_reach_into_faster_ones_and_swallow_what_is_no_revolution() {
        let zone = |from: f64, to: f64, stage: ZoneStage, feed: f64| Zone { from, to, stage, feed };
        let heights = Heights { step: 0.01, zero: 5.0 };
        let exact = [
            zone(2.0, -1.2345, ZoneStage::Entry, 0.1),
            zone(-1.2345, -8.7654, ZoneStage::Steady, 0.2),
            zone(-8.7654, -12.0001, ZoneStage::Exit, 0.05),
        ];
        let posted = heights.zones(&exact);
        let ends: Vec<f64> = posted.iter().map(|z| (z.to * 100.0).round() / 100.0).collect();
        assert_eq!(ends, [3.76, -3.76, -7.01]);
        assert!(posted.windows(2).all(|w| w[0].to == w[1].from));
        let short = [
            zone(2.0, -1.0, ZoneStage::Entry, 0.1),
            zone(-1.0, -1.1, ZoneStage::Steady, 0.2),
            zone(-1.1, -5.0, ZoneStage::Mixed, 0.05),
        ];
        let posted = heights.zones(&short);
        assert_eq!(posted.iter().map(|z| z.stage).collect::<Vec<_>>(), [ZoneStage::Entry, ZoneStage::Mixed]);
        assert!((posted[0].to - 3.9).abs() < 1e-9);
    }
}
