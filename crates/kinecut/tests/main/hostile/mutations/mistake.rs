//! Mistakes that people make in programs.

use super::program::{Block, Part, Random};

/// Mistakes tried on each program.
pub(crate) const MISTAKES: usize = 20;

/// The program with one mistake, and its name.
pub(crate) fn mistaken(part: &Part, random: &mut Random) -> (Part, String) {
    loop {
        let mut wrong = part.clone();
        let at = random.one_of(wrong.blocks.len());
        let name = match (random.one_of(8), &mut wrong.blocks[at]) {
            (0, Block::Move { to, .. }) if to[0] != to[1] => {
                to.swap(0, 1);
                "axis swapped"
            }
            (1, Block::Move { to: [_, _, Some(z)], .. }) => {
                *z -= random.between(2.0, 12.0);
                "Z lowered"
            }
            (2, Block::Move { rapid, .. }) if !*rapid => {
                *rapid = true;
                "rapid for feed"
            }
            (3, Block::Tool(tool)) => {
                *tool = 3 - *tool;
                "tool swapped"
            }
            (4, Block::Offset(number)) => {
                *number = 55;
                "offset missing"
            }
            (5, Block::Move { to, .. }) => {
                let axis = random.one_of(3);
                match &mut to[axis] {
                    Some(value) if *value != 0.0 => *value = -*value,
                    _ => continue,
                }
                "sign flipped"
            }
            (6, Block::Spindle(on)) if *on => {
                *on = false;
                "spindle not started"
            }
            // A way up that was forgotten.
            (7, Block::Move { to: [None, None, Some(_)], rapid: true }) => {
                wrong.blocks.remove(at);
                "retract left out"
            }
            _ => continue,
        };
        return (wrong, format!("{name} in block {at}"));
    }
}
