//! A simulation by brute force that shares nothing with kinecut: points spread in the stock, the tool at poses close together.

use super::program::{Block, Part, Random, SAFE, SHIFT, Tool};

/// Distance of the points [mm]; each is moved at random within its cell.
const GRID: f64 = 1.1;

/// Distance of the poses on the way of the tip [mm].
const POSES: f64 = 0.25;

/// What lies less than this inside of a tool does not touch [mm]: more than what poses apart leave between them.
const INSIDE: f64 = 0.1;

/// What lies less than this outside of a cutter is cut [mm].
const OUTSIDE: f64 = 0.02;

/// The points of the stock that are still there.
struct Points {
    counts: [usize; 3],
    low: [f64; 3],
    at: Vec<[f64; 3]>,
    there: Vec<bool>,
}

impl Points {
    fn new(size: [f64; 3]) -> Points {
        let mut random = Random::new(77);
        let counts = size.map(|s| (s / GRID) as usize);
        let low = [0.0, 0.0, -size[2]];
        let mut at = Vec::new();
        for k in 0..counts[2] {
            for j in 0..counts[1] {
                for i in 0..counts[0] {
                    let cell = [i, j, k].map(|i| i as f64);
                    at.push([0, 1, 2].map(|a| low[a] + (cell[a] + random.share()) * GRID));
                }
            }
        }
        Points { counts, low, there: vec![true; at.len()], at }
    }

    /// The points that may lie in a cylinder about the vertical through a place.
    fn near(&self, tip: [f64; 3], radius: f64, from: f64, to: f64, mut each: impl FnMut(usize)) {
        let range = |axis: usize, lo: f64, hi: f64| {
            let index =
                |x: f64| ((x - self.low[axis]) / GRID).floor().clamp(-1.0, self.counts[axis] as f64) as isize;
            (index(lo) - 1).max(0) as usize..((index(hi) + 2).max(0) as usize).min(self.counts[axis])
        };
        for k in range(2, tip[2] + from, tip[2] + to) {
            for j in range(1, tip[1] - radius, tip[1] + radius) {
                for i in range(0, tip[0] - radius, tip[0] + radius) {
                    each((k * self.counts[1] + j) * self.counts[0] + i);
                }
            }
        }
    }

    /// Whether a point that is there lies deeper in a cylinder on the tip than [`INSIDE`].
    fn touched(&self, tip: [f64; 3], radius: f64, from: f64, to: f64) -> bool {
        let mut found = false;
        self.near(tip, radius, from, to, |n| {
            let p = self.at[n];
            let height = p[2] - tip[2];
            found |= self.there[n]
                && (p[0] - tip[0]).hypot(p[1] - tip[1]) < radius - INSIDE
                && height > from + INSIDE
                && height < to - INSIDE;
        });
        found
    }

    fn cut(&mut self, tip: [f64; 3], tool: &Tool) {
        let mut gone = Vec::new();
        self.near(tip, tool.radius + OUTSIDE, -OUTSIDE, tool.flutes, |n| {
            let p = self.at[n];
            if (p[0] - tip[0]).hypot(p[1] - tip[1]) <= tool.radius + OUTSIDE
                && p[2] >= tip[2] - OUTSIDE
                && p[2] <= tip[2] + tool.flutes
            {
                gone.push(n);
            }
        });
        for n in gone {
            self.there[n] = false;
        }
    }
}

/// The first contact of a rapid, of a standing spindle, of a shank or a holder with what is there; none if there is none.
pub(crate) fn touches(part: &Part) -> Option<String> {
    let mut points = Points::new(part.size);
    let mut tool = &part.tools[0];
    let (mut here, mut shift, mut on) = ([-30.0, -30.0, SAFE], [0.0; 3], false);
    for (number, block) in part.blocks.iter().enumerate() {
        match block {
            Block::Offset(55) => shift = SHIFT,
            Block::Offset(_) => shift = [0.0; 3],
            Block::Spindle(turns) => on = *turns,
            Block::Tool(new) => {
                // Up to the changing place, and back above the corner.
                let up = [here[0], here[1], 200.0];
                if let Some(what) = along(&mut points, tool, here, up, true, on) {
                    return Some(format!("block {number} {what}"));
                }
                tool = &part.tools[*new - 1];
                here = [-30.0 + shift[0], -30.0 + shift[1], SAFE + shift[2]];
                on = false;
            }
            Block::Move { to, rapid } => {
                let end = [0, 1, 2].map(|a| to[a].map_or(here[a], |v| v + shift[a]));
                if *rapid {
                    // Each axis at the same speed until it has arrived, then straight.
                    let mut from = here;
                    let mut lengths: Vec<f64> = (0..3).map(|a| (end[a] - here[a]).abs()).collect();
                    lengths.sort_by(f64::total_cmp);
                    for t in lengths {
                        let leg = [0, 1, 2].map(|a| {
                            let d = end[a] - here[a];
                            here[a] + d.signum() * d.abs().min(t)
                        });
                        if let Some(what) = along(&mut points, tool, from, leg, true, on) {
                            return Some(format!("block {number} {what} axis by axis"));
                        }
                        from = leg;
                    }
                }
                if let Some(what) = along(&mut points, tool, here, end, *rapid, on) {
                    return Some(format!("block {number} {what}"));
                }
                here = end;
            }
        }
    }
    None
}

fn along(
    points: &mut Points,
    tool: &Tool,
    from: [f64; 3],
    to: [f64; 3],
    rapid: bool,
    on: bool,
) -> Option<&'static str> {
    let length = (0..3).map(|a| (to[a] - from[a]).powi(2)).sum::<f64>().sqrt();
    let poses = (length / POSES).ceil().max(1.0) as usize;
    let shank_top = tool.stickout;
    for i in 0..=poses {
        let t = i as f64 / poses as f64;
        let tip = [0, 1, 2].map(|a| from[a] + (to[a] - from[a]) * t);
        // High above the block nothing happens.
        if tip[2] > 1.0 {
            continue;
        }
        if (rapid || !on) && points.touched(tip, tool.radius, 0.0, tool.flutes) {
            return Some(if rapid { "rapid in stock" } else { "spindle off in stock" });
        }
        if !rapid {
            points.cut(tip, tool);
        }
        if points.touched(tip, tool.radius, tool.flutes, shank_top) {
            return Some("shank in stock");
        }
        if points.touched(tip, tool.holder_radius, shank_top, shank_top + 40.0) {
            return Some("holder in stock");
        }
    }
    None
}
