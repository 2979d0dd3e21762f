//! Bodies of a layout: one for each link along the chain, as machines are built.
//!
//! From the work down to the bed: a translation is a slab on ways as long as slab and stroke together, a vertical one
//! stands on a lifting post, a rotation about the vertical is a round table, one about a level axis a drum in a cradle.
//! From the tool back to the bed: rotary axes first, along the spindle; then translations as ram and cross rail; the
//! vertical one runs on a column, and what lies between column and bed are slabs below it. Strokes are to scale, the rest
//! has the proportions of ordinary machines.

use super::looks;
use super::solid::{Hub, Point3, Solid, unit};
use crate::machine::layouts::{Attitude, Sizes};
use crate::machine::{CoordinateCode, Elementary, Link as Carrier};
use crate::page::Tint;

/// Size of the part where none is given, as a share of the strokes.
const PART: f64 = 0.45;
/// Thickness of a slab, as a share of the size of the part.
const SLAB: f64 = 0.22;
/// Overhang of a table beyond the part, both sides together.
const BORDER: f64 = 0.25;
/// Diameter of a rotary drum, as a share of the size of the part.
const DRUM: f64 = 0.5;

/// The link of an axis in a picture.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Link {
    pub(crate) motion: Elementary,
    /// Whether it carries the work.
    pub(crate) work: bool,
    /// Direction of the axis.
    pub(crate) axis: Point3,
    /// The body that shows the motion.
    pub(crate) body: usize,
    /// Distance from its middle along the axis at which a turning arrow is clear of the holder of the body [mm].
    pub(crate) end: f64,
    /// Of a rotation whose body is no drum: what its arrow goes round.
    pub(crate) hub: Option<Hub>,
}

/// All bodies of a layout.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct Bodies {
    pub(crate) solids: Vec<Solid>,
    /// The link of the machine that carries each of them; empty where the bodies are those of a file.
    pub(crate) carriers: Vec<Carrier>,
    pub(crate) links: Vec<Link>,
    /// Bodies that stand on the ground.
    pub(crate) ground: Vec<usize>,
}

/// Picture being built.
struct Builder<'a> {
    code: &'a CoordinateCode,
    sizes: &'a Sizes,
    attitude: Attitude,
    /// Size of the part: right, back, up.
    part: Point3,
    /// Size of an ordinary body.
    unit: f64,
    out: Bodies,
}

/// Bodies of a layout of these sizes.
pub(crate) fn bodies(code: &CoordinateCode, attitude: Attitude, sizes: &Sizes) -> Bodies {
    let part = sizes.part.unwrap_or_else(|| sizes.stroke.map(|s| PART * s));
    let part = turned(part, attitude).map(f64::abs);
    let unit = (part[0] * part[1] * part[2]).cbrt();
    let mut builder = Builder { code, sizes, attitude, part, unit, out: Bodies::default() };
    let work = builder.work_side();
    builder.tool_side(&work);
    builder.out.links.sort_by_key(|link| code.word().0.iter().position(|m| *m == link.motion));
    builder.out
}

/// A vector of the machine as right, back, up: with a horizontal spindle Y is up and the spindle points back.
pub(crate) fn turned(v: [f64; 3], attitude: Attitude) -> Point3 {
    match attitude {
        Attitude::Vertical => v,
        Attitude::Horizontal => [-v[0], v[2], v[1]],
    }
}

/// End of the work side: the ways of the bed.
struct WorkEnd {
    /// Top of the bed.
    top: f64,
    /// Middle of the part.
    middle: [f64; 2],
    /// Footprint of the bed.
    foot: [f64; 2],
}

impl Builder<'_> {
    fn axis(&self, motion: Elementary) -> Point3 {
        unit(turned(self.sizes.direction(motion).to_array(), self.attitude))
    }

    fn stroke(&self, motion: Elementary) -> f64 {
        self.sizes.stroke[usize::from(motion.digit()).clamp(1, 3) - 1]
    }

    fn add(&mut self, carrier: Carrier, solid: Solid) -> usize {
        self.out.carriers.push(carrier);
        self.out.solids.push(solid);
        self.out.solids.len() - 1
    }

    /// A link whose body turns as a drum does, or shifts.
    fn link(&mut self, motion: Elementary, work: bool, axis: Point3, body: usize, end: f64) {
        self.out.links.push(Link { motion, work, axis, body, end, hub: None });
    }

    /// The carrier of the body of link `i` on the work side: the next link, or the bed.
    fn below(&self, i: usize) -> (Carrier, Tint) {
        if i + 1 < self.code.bed() { (Carrier::Axis(i + 1), looks::WORK) } else { (Carrier::Bed, looks::BED) }
    }

    /// The link of the motion `i` of the tool side; without one the bed.
    fn tool_link(&self, i: Option<usize>) -> (Carrier, Tint) {
        i.map_or((Carrier::Bed, looks::BED), |i| (Carrier::Axis(self.code.bed() + i), looks::TOOL))
    }

    fn work_side(&mut self) -> WorkEnd {
        let (part, size) = (self.part, self.unit);
        let gap = 0.12 * size;
        let centre = match self.attitude {
            Attitude::Vertical => [0.0, 0.0, -gap - 0.5 * part[2]],
            Attitude::Horizontal => [0.0, -gap - 0.5 * part[1], 0.0],
        };
        let middle = [centre[0], centre[1]];
        let table = if self.code.bed() > 0 { Carrier::Axis(0) } else { Carrier::Bed };
        self.add(table, Solid::block(looks::PART, centre, part));
        let mut top = centre[2] - 0.5 * part[2];
        let mut foot = [part[0] * (1.0 + BORDER), part[1] * (1.0 + BORDER)];
        let slab = SLAB * size;
        for i in 0..self.code.bed() {
            let motion = self.code.word().0[i];
            let axis = self.axis(motion);
            let at = |height: f64, top: f64| [middle[0], middle[1], top - 0.5 * height];
            let (mut end, own) = (0.0, Carrier::Axis(i));
            let body = if !motion.is_rotation() {
                let body = self.add(own, Solid::block(looks::WORK, at(slab, top), [foot[0], foot[1], slab]));
                top -= slab;
                if axis[2].abs() > 0.5 {
                    // A lifting post: half of the stroke is out.
                    let (height, (link, look)) = (0.5 * self.stroke(motion), self.below(i));
                    let size = [0.45 * foot[0], 0.45 * foot[1], height];
                    self.add(link, Solid::block(look, at(height, top), size));
                    top -= height;
                } else {
                    let along = usize::from(axis[1].abs() > 0.5);
                    foot[along] += self.stroke(motion);
                }
                body
            } else if axis[2].abs() > 0.9 {
                let radius = 0.5 * foot[0].max(foot[1]);
                let body = self.add(own, Solid::drum(looks::WORK, at(slab, top), axis, radius, 0.5 * slab));
                top -= slab;
                foot = [2.0 * radius; 2];
                body
            } else {
                let (body, new_foot, height) = self.cradle(i, axis, foot, top, middle);
                end = 0.5 * new_foot[usize::from(axis[1].abs() > 0.5)];
                top -= height;
                foot = new_foot;
                body
            };
            self.link(motion, true, axis, body, end);
        }
        WorkEnd { top, middle, foot }
    }

    /// A drum about a level or inclined axis between two cheeks; its body, the footprint below, its height.
    fn cradle(
        &mut self,
        i: usize,
        axis: Point3,
        foot: [f64; 2],
        top: f64,
        middle: [f64; 2],
    ) -> (usize, [f64; 2], f64) {
        let diameter = DRUM * self.unit;
        let ((holder, look), own) = (self.below(i), Carrier::Axis(i));
        if axis[2].abs() > 0.3 {
            // Inclined: a disc on a wedge.
            let radius = 0.5 * foot[0].max(foot[1]);
            let half = 0.3 * SLAB * self.unit;
            let reach = half * axis[2].abs() + radius * (1.0 - axis[2] * axis[2]).sqrt();
            let centre = [middle[0], middle[1], top - reach];
            let body = self.add(own, Solid::drum(looks::WORK, centre, axis, radius, half));
            return (body, [2.0 * radius; 2], 2.0 * reach);
        }
        let along = usize::from(axis[1].abs() > 0.5);
        let (length, cheek) = (foot[along], 0.14 * self.unit);
        let centre = [middle[0], middle[1], top - 0.5 * diameter];
        let body = self.add(own, Solid::drum(looks::WORK, centre, axis, 0.5 * diameter, 0.5 * length));
        for side in [-0.5, 0.5] {
            let (mut at, mut size) = (centre, [0.8 * diameter; 3]);
            at[along] += side * (length + cheek);
            (size[along], size[2]) = (cheek, diameter);
            self.add(holder, Solid::block(look, at, size));
        }
        let mut below = foot;
        below[along] = length + 2.0 * cheek;
        (body, below, diameter)
    }

    fn tool_side(&mut self, work: &WorkEnd) {
        let motions: Vec<Elementary> = self.code.word().0[self.code.bed()..].to_vec();
        let axes: Vec<Point3> = motions.iter().map(|&m| self.axis(m)).collect();
        let lifts = |i: usize| !motions[i].is_rotation() && axes[i][2].abs() > 0.5;
        let lift = (0..motions.len()).find(|&i| lifts(i));
        let last_shift = (0..motions.len()).rev().find(|&i| !motions[i].is_rotation());
        // Links from `head` on hang at the column, those before stand below it.
        let head = lift.unwrap_or_else(|| last_shift.map_or(0, |i| i + 1));
        let first_turn = (head..motions.len()).find(|&i| motions[i].is_rotation()).unwrap_or(motions.len());
        let size = self.unit;
        let (dir, across) = match self.attitude {
            Attitude::Vertical => (2, 1),
            Attitude::Horizontal => (1, 2),
        };
        let mut spindle = [0.0; 3];
        spindle[dir] = 1.0;
        // Along the spindle from the tip: cutter, spindle, rotary axes.
        let mut reach = 0.0;
        let (nose, _) = self.tool_link(motions.len().checked_sub(1));
        let mut along = |this: &mut Self, length: f64, radius: f64, look: Tint| {
            let mut centre = [0.0; 3];
            centre[dir] = reach + 0.5 * length;
            reach += length;
            this.add(nose, Solid::drum(look, centre, spindle, radius, 0.5 * length))
        };
        along(self, 0.32 * size, 0.06 * size, looks::STEEL);
        along(self, 0.3 * size, 0.17 * size, looks::STEEL);
        let side = 0.5 * size;
        for i in (first_turn..motions.len()).rev() {
            let mut centre = [0.0; 3];
            let axis = axes[i];
            let (mut end, (own, _)) = (0.0, self.tool_link(Some(i)));
            let body = if !motions[i].is_rotation() {
                let mut block = [side; 3];
                block[dir] = SLAB * size;
                centre[dir] = reach + 0.5 * block[dir];
                reach += block[dir];
                self.add(own, Solid::block(looks::TOOL, centre, block))
            } else {
                let lean = axis[dir].abs();
                let (radius, half) =
                    if lean > 0.3 { (0.52 * side, 0.4 * SLAB * size) } else { (0.4 * side, 0.5 * side) };
                let depth = half * lean + radius * (1.0 - lean * lean).max(0.0).sqrt();
                centre[dir] = reach + depth;
                reach += 2.0 * depth;
                let body = self.add(own, Solid::drum(looks::TOOL, centre, axis, radius, half));
                if lean <= 0.3 {
                    end = half + 0.12 * size;
                    // The fork that holds the drum.
                    let level = if axis[0].abs() > 0.5 { 0 } else { across };
                    let (holder, look) = self.tool_link(i.checked_sub(1));
                    for side_sign in [-1.0, 1.0] {
                        let (mut at, mut block) = (centre, [1.5 * radius; 3]);
                        at[level] += side_sign * (half + 0.06 * size);
                        block[level] = 0.12 * size;
                        block[dir] = 2.0 * radius;
                        self.add(holder, Solid::block(look, at, block));
                    }
                }
                body
            };
            self.link(motions[i], false, axis, body, end);
        }
        self.column(work, &motions, &axes, head, first_turn, lift.is_some(), reach);
    }

    /// Head, ram and cross rail; the column; slabs below it; the bed.
    #[allow(clippy::too_many_arguments, reason = "what the tool side knows when it comes to the column")]
    fn column(
        &mut self,
        work: &WorkEnd,
        motions: &[Elementary],
        axes: &[Point3],
        head: usize,
        first_turn: usize,
        lifted: bool,
        reach: f64,
    ) {
        let size = self.unit;
        let slab = SLAB * size;
        let side = 0.62 * size;
        // The head: the body of the last translation that hangs at the column.
        let mut front = match self.attitude {
            Attitude::Vertical => -0.5 * side,
            Attitude::Horizontal => reach,
        };
        let height = match self.attitude {
            Attitude::Vertical => reach + 0.5 * side,
            Attitude::Horizontal => 0.0,
        };
        // Parts below the column, from the column down.
        let mut foot = [0.9 * size, 0.75 * size];
        let mut feet = Vec::new();
        let mut foot_height = 0.0;
        for i in (0..head).rev() {
            let thick = if motions[i].is_rotation() && axes[i][2].abs() < 0.5 { DRUM * size } else { slab };
            feet.push((i, foot, thick));
            foot_height += thick;
            if !motions[i].is_rotation() && axes[i][2].abs() < 0.5 {
                foot[usize::from(axes[i][1].abs() > 0.5)] += self.stroke(motions[i]);
            }
        }
        let bed_top = work.top.min(height - 0.5 * side - foot_height - slab);
        let work_back = work.middle[1] + 0.5 * work.foot[1];
        // Bodies from the head back to the column, with the width and depth of each.
        let mut chain = Vec::new();
        let (mut width, mut tall) = (side, side);
        for i in (head + usize::from(lifted)..first_turn).rev() {
            let ram = axes[i][1].abs() > 0.5;
            let depth = if ram { 0.5 * side + self.stroke(motions[i]) } else { 0.5 * side };
            chain.push((i, width, tall, depth));
            if !ram {
                width += self.stroke(motions[i]);
            }
            tall *= 1.12;
        }
        let carriage = lifted.then_some(head);
        let holder = if lifted { carriage } else { head.checked_sub(1) };
        let needed: f64 = chain.iter().map(|c| c.3).sum::<f64>();
        let fixed = 0.55 * side;
        let column_depth = 0.75 * size;
        let room = (work_back + 0.1 * size + 0.5 * foot[1] - 0.5 * column_depth - front).max(0.0);
        let slack = (room - needed - fixed).max(if chain.is_empty() { 0.5 * side } else { 0.0 });
        for (n, &(i, w, h, depth)) in chain.iter().enumerate() {
            let depth = if n == 0 { depth + slack } else { depth };
            let centre = [0.0, front + 0.5 * depth, height];
            let body = self.add(self.tool_link(Some(i)).0, Solid::block(looks::TOOL, centre, [w, depth, h]));
            front += depth;
            self.link(motions[i], false, axes[i], body, 0.0);
        }
        let depth = if chain.is_empty() { fixed + slack } else { fixed };
        let (link, look) = self.tool_link(holder);
        let centre = [0.0, front + 0.5 * depth, height];
        let body = self.add(link, Solid::block(look, centre, [width, depth, tall]));
        front += depth;
        if let Some(i) = carriage {
            self.link(motions[i], false, axes[i], body, 0.0);
        }
        // The column.
        let rise = if lifted { 0.5 * self.stroke(motions[head]) } else { 0.0 };
        let bottom = bed_top + foot_height;
        let top = height + 0.5 * tall + rise + 0.1 * size;
        let below = if lifted { head.checked_sub(1) } else { holder };
        let column_width = width.min(0.9 * size).max(0.7 * size);
        let middle = front + 0.5 * column_depth;
        let (link, look) = self.tool_link(below);
        let column = [column_width, column_depth, top - bottom];
        self.add(link, Solid::block(look, [0.0, middle, 0.5 * (top + bottom)], column));
        self.feet(feet, [middle, bottom], motions, axes);
        let base = bed_top.min(work.top) - 1.3 * slab;
        let rear_front = (middle - 0.5 * foot[1]).min(middle - 0.5 * column_depth).max(work_back);
        let rear_back = middle + 0.5 * foot[1].max(column_depth);
        let rear = Solid::block(
            looks::BED,
            [0.0, 0.5 * (rear_front + rear_back), 0.5 * (base + bed_top)],
            [foot[0].max(column_width), rear_back - rear_front, bed_top - base],
        );
        let rear = self.add(Carrier::Bed, rear);
        let front_length = rear_front - (work.middle[1] - 0.5 * work.foot[1]);
        let front_bed = Solid::block(
            looks::BED,
            [work.middle[0], rear_front - 0.5 * front_length, 0.5 * (base + work.top)],
            [work.foot[0], front_length, work.top - base],
        );
        let front_bed = self.add(Carrier::Bed, front_bed);
        self.out.ground = vec![front_bed, rear];
    }

    /// The slabs and drums below the column, from its foot at a depth and a height down: for each motion its size and
    /// thickness.
    fn feet(
        &mut self,
        feet: Vec<(usize, [f64; 2], f64)>,
        [middle, mut level]: [f64; 2],
        motions: &[Elementary],
        axes: &[Point3],
    ) {
        for (i, f, thick) in feet {
            let centre = [0.0, middle, level - 0.5 * thick];
            level -= thick;
            let (axis, (own, _)) = (axes[i], self.tool_link(Some(i)));
            let body = if !motions[i].is_rotation() {
                self.add(own, Solid::block(looks::TOOL, centre, [f[0], f[1], thick]))
            } else {
                let upright = axis[2].abs() > 0.5;
                let (radius, half) = if upright {
                    (0.5 * f[0].min(f[1]), 0.5 * thick)
                } else {
                    (0.5 * thick, 0.5 * f[usize::from(axis[1].abs() > 0.5)])
                };
                self.add(own, Solid::drum(looks::TOOL, centre, axis, radius, half))
            };
            self.link(motions[i], false, axis, body, 0.0);
        }
    }
}
