//! HEIDENHAIN klartext: the same walk over the program, in blocks of another grammar.
//!
//! `L` for straight moves, `CC` and `C` for arcs in the plane, `CP IPA` for helices, `TOOL CALL`, `CYCL DEF 200` for
//! holes, `CYCL DEF 247` for work offsets, `CYCL DEF 32` for the tolerance of the path, `CYCL DEF 9` for a dwell. Arcs
//! in other planes become lines within the arc tolerance. The meanings of the words are in `nc/heidenhain`.

mod cycle;
mod moves;
mod plane;
pub(super) mod rotary;
pub(super) mod speed;
mod state;

use glam::{DVec2, DVec3};

use crate::base::Result;
use crate::geom::Aabb;
use crate::nc::Control;
use crate::nc::dialect::AXES;
use crate::nc::heidenhain::REGISTERS;
use crate::program::{Blend, Item, Target, Tcp, ToolNumber};

use super::{Writer, unsupported};

/// Longest program name.
const LONGEST_NAME: usize = 24;

/// Words that a klartext program has given, other than the common ones.
#[derive(Clone, Debug, Default)]
pub(super) struct Pen {
    /// Pole [steps].
    pole: Option<[i64; 2]>,
    /// Radius compensation in force and wanted.
    comp: Option<&'static str>,
    wanted: Option<&'static str>,
    /// Spindle speed of the last `TOOL CALL`.
    rpm: Option<String>,
    blend: Option<Blend>,
    /// The drilling cycle that is defined.
    cycle: Option<String>,
    /// Whether the item asks for an exact stop.
    stop: bool,
    /// Position of the control after a polar arc, if that is not a point of the grid [mm].
    pub(super) beside: Option<DVec2>,
    /// Rotary axes [steps]; `None` where the control may have them elsewhere.
    rotary: [Option<i64>; 3],
    /// Control of the tool centre point in force.
    tcp: Tcp,
    /// The turn of the rotary axes that the next plane is said with.
    turn: Option<String>,
    /// Whether that turn is back to coordinates that are not tilted.
    leaves: bool,
}

impl Pen {
    /// Keeps the radius compensation as it is for a block; gives what was wanted back.
    pub(super) fn hold(&mut self) -> Option<&'static str> {
        std::mem::replace(&mut self.wanted, self.comp)
    }

    /// Undoes [`Pen::hold`].
    pub(super) fn release(&mut self, wanted: Option<&'static str>) {
        self.wanted = wanted;
    }

    /// The coordinates are others: what was said in the old ones is said again.
    pub(super) fn forget_place(&mut self) {
        self.pole = None;
        self.beside = None;
        self.cycle = None;
    }
}

impl Writer<'_> {
    /// Whether the text is klartext.
    pub(super) fn klartext(&self) -> bool {
        self.settings.control == Control::Heidenhain
    }

    /// First blocks: name, unit and the raw part for the control's graphics.
    pub(super) fn begin_program(&mut self) {
        let name = self.program_word();
        self.page.block(format!("BEGIN PGM {name} {}", self.unit_word()));
        let Some(part) = self.raw_part() else { return };
        let mut corners = [String::from("BLK FORM 0.1 Z"), String::from("BLK FORM 0.2")];
        for (text, corner) in corners.iter_mut().zip([part.min, part.max]) {
            for (axis, value) in corner.to_array().into_iter().enumerate() {
                let Ok(count) = self.grid.round(value) else { return };
                text.push(' ');
                self.grid.word(text, AXES[axis], count);
            }
        }
        for text in corners {
            self.page.block(text);
        }
    }

    /// Last block.
    pub(super) fn end_program(&mut self) {
        let name = self.program_word();
        self.page.block(format!("END PGM {name} {}", self.unit_word()));
    }

    fn unit_word(&self) -> &'static str {
        if self.settings.units.is_inch() { "INCH" } else { "MM" }
    }

    fn program_word(&self) -> String {
        let name: String = self
            .settings
            .program_name
            .chars()
            .filter(|c| c.is_ascii_alphanumeric() || matches!(c, '_' | '-'))
            .take(LONGEST_NAME)
            .collect();
        if name.is_empty() { "PROGRAM".to_owned() } else { name.to_ascii_uppercase() }
    }

    /// Box around the raw part of the first clamping, in the coordinates of the first move.
    fn raw_part(&self) -> Option<Aabb> {
        let items = &self.program.items;
        let first = (0..items.len())
            .find(|i| matches!(items.get(*i), Item::Move(m) if matches!(m.end, Target::Tip { .. })))?;
        let state = self.program.state(first);
        // BLK FORM comes before the words of a turned frame: it is in the work offset.
        let tilted = self.program.in_tilted(state.frame).map(|t| t.0);
        let offset = tilted.or_else(|| Some(self.program.in_work(state.frame)?.0))?;
        let setup = self.program.setups.get(state.setup.0 as usize)?;
        let to_program = setup.work_offsets.get(&offset)?.inverse().after(&setup.part_on_table);
        let Aabb { min, max } = setup.stock.as_ref()?.bounds();
        let corner = |i: u8| {
            let pick = |bit: u8, a: f64, b: f64| if i >> bit & 1 == 0 { a } else { b };
            DVec3::new(pick(0, min.x, max.x), pick(1, min.y, max.y), pick(2, min.z, max.z))
        };
        let part = Aabb::of_points((0..8).map(|i| to_program.point(corner(i))));
        (part.min.is_finite() && part.max.is_finite() && !part.is_empty()).then_some(part)
    }

    /// `TOOL CALL`; [`speed::in_tool_calls`] adds the speed that the tool first turns at.
    pub(super) fn klartext_tool(
        &mut self,
        id: ToolNumber,
        length: Option<u32>,
        radius: Option<u32>,
    ) -> Result<()> {
        let Some(register) = length.filter(|r| REGISTERS.contains(r) && radius.is_none_or(|o| o == *r))
        else {
            return Err(unsupported(
                "TOOL CALL applies length and radius of the tool together, from register 1 (the tool) to 9 (its index)",
            )
            .value(length.or(radius).map_or(0.0, f64::from), "register")
            .help("use one register from 1 to 9 for the length and the radius")
            .into());
        };
        let name = if register == 1 { id.0.to_string() } else { format!("{}.{register}", id.0) };
        if self.tool == Some(id) {
            if self.length != length {
                self.klartext_tcp_off();
                let speed = self.modal.pen.rpm.as_ref().map_or_else(String::new, |s| format!(" S{s}"));
                self.page.block(format!("TOOL CALL {name} Z{speed}"));
                // Heights are then another, so the next move names its Z.
                self.length = length;
                self.forget_axis(2);
                self.modal.pen.cycle = None;
            }
            return Ok(());
        }
        self.length = length;
        self.klartext_tcp_off();
        self.turn_off()?;
        self.all_off();
        self.page.block(format!("TOOL CALL {name} Z"));
        self.tool = Some(id);
        self.place = super::ToolPosition::default();
        let blend = self.modal.pen.blend;
        self.modal.forget();
        self.modal.pen = Pen { blend, ..Pen::default() };
        Ok(())
    }
}
