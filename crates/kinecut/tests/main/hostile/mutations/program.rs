//! Random right programs: slots, pockets, contours and holes in a block, with two tools, as FANUC text.

use std::fmt::Write as _;

/// Numbers of a job, in steps of a hundredth.
pub(crate) struct Random(crate::common::random::Random);

impl Random {
    pub(crate) fn new(job: u64) -> Random {
        Random(crate::common::random::Random(job.wrapping_mul(0x9e37_79b9_7f4a_7c15) ^ 0x5851_f42d_4c95_7f2d))
    }

    /// A number from 0 to 1.
    pub(crate) fn share(&mut self) -> f64 {
        self.0.share()
    }

    /// A number between two, in steps of a hundredth.
    pub(crate) fn between(&mut self, from: f64, to: f64) -> f64 {
        (self.0.between(from, to) * 100.0).round() / 100.0
    }

    /// One of so many.
    pub(crate) fn one_of(&mut self, count: usize) -> usize {
        self.0.below(count)
    }
}

/// A tool: a cylinder that cuts, a shank above it, a holder.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Tool {
    pub(crate) number: usize,
    pub(crate) radius: f64,
    pub(crate) flutes: f64,
    pub(crate) stickout: f64,
    pub(crate) holder_radius: f64,
    pub(crate) gauge: f64,
    pub(crate) is_drill: bool,
}

/// A block of the program.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Block {
    /// Tool change with its length, and a rapid to the height above which nothing stands.
    Tool(usize),
    /// The work offset: 54 or 55.
    Offset(u32),
    /// Spindle on or off.
    Spindle(bool),
    /// A move to these coordinates, where given; at feed or rapid.
    Move { to: [Option<f64>; 3], rapid: bool },
}

/// A program with its stock and tools.
#[derive(Clone, Debug)]
pub(crate) struct Part {
    /// Size of the block [mm]: from 0 to these, below 0 down to the depth.
    pub(crate) size: [f64; 3],
    pub(crate) tools: [Tool; 2],
    pub(crate) blocks: Vec<Block>,
}

/// Where G55 lies [mm].
pub(crate) const SHIFT: [f64; 3] = [17.0, -9.0, -6.0];

/// Height at which tools come and go [mm].
pub(crate) const SAFE: f64 = 60.0;

impl Part {
    /// A random part.
    pub(crate) fn new(random: &mut Random) -> Part {
        let size = [random.between(50.0, 80.0), random.between(40.0, 60.0), random.between(14.0, 22.0)];
        let radius = random.between(4.0, 6.0);
        let flutes = random.between(12.0, 20.0);
        let mill = Tool {
            number: 1,
            radius,
            flutes,
            stickout: flutes + random.between(8.0, 25.0),
            holder_radius: random.between(16.0, 24.0),
            gauge: random.between(90.0, 130.0),
            is_drill: false,
        };
        let flutes = random.between(30.0, 40.0);
        let drill = Tool {
            number: 2,
            radius: random.between(2.0, 3.5),
            flutes,
            stickout: flutes + random.between(4.0, 12.0),
            holder_radius: random.between(14.0, 22.0),
            gauge: random.between(120.0, 160.0),
            is_drill: true,
        };
        let mut part = Part { size, tools: [mill, drill], blocks: vec![Block::Offset(54)] };
        part.start(1);
        for _ in 0..2 + random.one_of(2) {
            match random.one_of(3) {
                0 => part.slot(random),
                1 => part.pocket(random),
                _ => part.contour(random),
            }
        }
        part.start(2);
        for _ in 0..2 + random.one_of(3) {
            part.hole(random);
        }
        part
    }

    fn start(&mut self, tool: usize) {
        self.blocks.extend([Block::Tool(tool), Block::Spindle(true)]);
    }

    fn rapid(&mut self, to: [Option<f64>; 3]) {
        self.blocks.push(Block::Move { to, rapid: true });
    }

    fn feed(&mut self, to: [Option<f64>; 3]) {
        self.blocks.push(Block::Move { to, rapid: false });
    }

    /// Over a place, and down to above the face.
    fn over(&mut self, x: f64, y: f64) {
        self.rapid([Some(x), Some(y), None]);
        self.rapid([None, None, Some(3.0)]);
    }

    fn up(&mut self) {
        self.rapid([None, None, Some(20.0)]);
    }

    /// A slot in one to three levels, to and fro.
    fn slot(&mut self, random: &mut Random) {
        let [w, d, h] = self.size;
        let (x0, x1) = (random.between(8.0, 0.4 * w), random.between(0.6 * w, w - 8.0));
        let (y0, y1) = (random.between(8.0, d - 8.0), random.between(8.0, d - 8.0));
        let levels = 1 + random.one_of(3);
        let deepest = random.between(3.0, h - 4.0).min(10.0);
        self.over(x0, y0);
        for level in 1..=levels {
            self.feed([None, None, Some(round(-deepest * level as f64 / levels as f64))]);
            let (x, y) = if level % 2 == 1 { (x1, y1) } else { (x0, y0) };
            self.feed([Some(x), Some(y), None]);
        }
        self.up();
    }

    /// A rectangular pocket in rows.
    fn pocket(&mut self, random: &mut Random) {
        let [w, d, h] = self.size;
        let r = self.tools[0].radius;
        let (x0, x1) = (random.between(r + 2.0, 0.35 * w), random.between(0.6 * w, w - r - 2.0));
        let (y0, y1) = (random.between(r + 2.0, 0.35 * d), random.between(0.6 * d, d - r - 2.0));
        let deepest = random.between(2.0, h - 5.0).min(8.0);
        self.over(x0, y0);
        self.feed([None, None, Some(-deepest)]);
        let mut y = y0;
        let mut forward = true;
        loop {
            self.feed([Some(if forward { x1 } else { x0 }), None, None]);
            forward = !forward;
            if y >= y1 {
                break;
            }
            y = round((y + 1.4 * r).min(y1));
            self.feed([None, Some(y), None]);
        }
        self.up();
    }

    /// Around the block, from beside it.
    fn contour(&mut self, random: &mut Random) {
        let [w, d, h] = self.size;
        let off = self.tools[0].radius - random.between(0.5, 2.0);
        let deepest = random.between(3.0, h - 3.0).min(11.0);
        let far = self.tools[0].radius + 6.0;
        self.rapid([Some(-far), Some(-far), None]);
        self.rapid([None, None, Some(-deepest)]);
        self.feed([Some(-off), Some(-off), None]);
        for (x, y) in [(w + off, -off), (w + off, d + off), (-off, d + off), (-off, -far)] {
            self.feed([Some(round(x)), Some(round(y)), None]);
        }
        self.up();
    }

    /// A hole, pecked in two.
    fn hole(&mut self, random: &mut Random) {
        let [w, d, h] = self.size;
        let (x, y) = (random.between(7.0, w - 7.0), random.between(7.0, d - 7.0));
        let deepest = random.between(6.0, h - 2.0);
        self.over(x, y);
        self.feed([None, None, Some(round(-0.5 * deepest))]);
        self.rapid([None, None, Some(3.0)]);
        self.rapid([None, None, Some(round(-0.5 * deepest + 1.0))]);
        self.feed([None, None, Some(-deepest)]);
        self.up();
    }

    /// The program as FANUC reads it.
    pub(crate) fn text(&self) -> String {
        let mut text = String::from("%\nO1000\nG21 G17 G90 G40 G80 G94\n");
        let mut offset = 54;
        for block in &self.blocks {
            // Writing to a string cannot fail.
            let _ = match block {
                Block::Offset(number) => {
                    offset = *number;
                    writeln!(text, "G{number}")
                }
                Block::Tool(tool) => {
                    let feed = if self.tools[*tool - 1].is_drill { 120 } else { 600 };
                    writeln!(
                        text,
                        "G91 G28 Z0.\nG90\nT{tool} M6\nG{offset} G0 X-30. Y-30. S3000\nG43 H{tool} Z{SAFE:.3} M8\nF{feed}."
                    )
                }
                Block::Spindle(true) => writeln!(text, "M3"),
                Block::Spindle(false) => writeln!(text, "M5"),
                Block::Move { to, rapid } => {
                    let mut line = if *rapid { "G0".to_owned() } else { "G1".to_owned() };
                    for (letter, value) in ["X", "Y", "Z"].into_iter().zip(to) {
                        if let Some(value) = value {
                            let _ = write!(line, " {letter}{value:.3}");
                        }
                    }
                    writeln!(text, "{line}")
                }
            };
        }
        text.push_str("M9\nG91 G28 Z0.\nM30\n%\n");
        text
    }

    /// The job around it.
    pub(crate) fn job(&self, step: f64) -> String {
        let [w, d, h] = self.size;
        let mut text = format!(
            "format = 1\nstock = {{ box = {{ min = [0, 0, {}], max = [{w}, {d}, 0] }} }}\n\
             post = {{ control = \"fanuc\" }}\nsimulate = {{ step = {step} }}\n\
             [machine]\ncode = \"2103\"\ntravel = {{ X = [-600, 400], Y = [-600, 400], Z = [-700, 0] }}\n",
            -h
        );
        for tool in &self.tools {
            let kind = if tool.is_drill { "drill\"\npoint = \"flat" } else { "end-mill" };
            let _ = write!(
                text,
                "[[holder]]\nname = \"H{n}\"\nsegments = [{{ height = 40, lower_diameter = {} }}]\n\
                 [[tool]]\nnumber = {n}\ntype = \"{kind}\"\ndiameter = {}\nflute_length = {}\nstickout = {}\n\
                 holder = \"H{n}\"\ngauge_length = {}\ncentre_cutting = true\n",
                2.0 * tool.holder_radius,
                2.0 * tool.radius,
                tool.flutes,
                tool.stickout,
                tool.gauge,
                n = tool.number
            );
        }
        let [x, y, z] = SHIFT;
        let _ = write!(
            text,
            "[[setup]]\noffset = \"G54\"\nposition = [-200, -200, -400]\noffsets = {{ G55 = [{x}, {y}, {z}] }}\n\
             program = {{ file = \"P.nc\" }}\n"
        );
        text
    }
}

fn round(value: f64) -> f64 {
    (value * 1000.0).round() / 1000.0
}
