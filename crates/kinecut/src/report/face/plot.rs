//! Axes of a picture: ticks, grid, names.

use crate::page::chart::px;
use crate::page::draw::CHARACTER;
use crate::page::ticks::Ticks;
use crate::page::{Anchor, Ink, Picture};

/// A plot area with its ranges.
#[derive(Clone, Copy, Debug)]
pub(super) struct Plot {
    /// Left and upper border [px].
    pub(super) corner: [f64; 2],
    /// Width and height [px].
    pub(super) size: [f64; 2],
    /// Range of x.
    pub(super) x: [f64; 2],
    /// Range of y.
    pub(super) y: [f64; 2],
}

/// Room to the left of a plot for labels of `digits` characters [px].
pub(super) fn room_left(digits: usize) -> f64 {
    10.0 + CHARACTER * digits as f64
}

/// Room below a plot for ticks and the name of x [px].
pub(super) const BELOW: f64 = 38.0;

impl Plot {
    pub(super) fn px(&self, x: f64) -> f64 {
        self.corner[0] + (x - self.x[0]) / (self.x[1] - self.x[0]) * self.size[0]
    }

    pub(super) fn py(&self, y: f64) -> f64 {
        self.corner[1] + (self.y[1] - y) / (self.y[1] - self.y[0]) * self.size[1]
    }

    pub(super) fn at(&self, p: [f64; 2]) -> [f64; 2] {
        [self.px(p[0]), self.py(p[1])]
    }

    /// Grid, border, numbers, and the name of x; `step`: of the ticks of x where round numbers are others than tens.
    pub(super) fn draw(&self, picture: &mut Picture, wanted: [usize; 2], name: &str, step: Option<f64>) {
        let mut x = Ticks::new(self.x[0], self.x[1], wanted[0]);
        if let Some(step) = step {
            let first = (self.x[0] / step).ceil() as i32;
            let last = (self.x[1] / step).floor() as i32;
            x = Ticks { step, values: (first..=last).map(|i| f64::from(i) * step).collect() };
        }
        let y = Ticks::new(self.y[0], self.y[1], wanted[1]);
        let [left, top] = self.corner;
        let (right, bottom) = (left + self.size[0], top + self.size[1]);
        let mut grid = String::new();
        for &v in &x.values {
            grid += &format!("M{} {}V{}", px(self.px(v)), px(top), px(bottom));
            picture.tick([self.px(v), bottom + 15.0], Anchor::Middle, x.label(v));
        }
        for &v in &y.values {
            grid += &format!("M{} {}H{}", px(left), px(self.py(v)), px(right));
            picture.tick([left - 6.0, self.py(v) + 4.0], Anchor::End, y.label(v));
        }
        // Below all else.
        let words = std::mem::take(&mut picture.shapes);
        picture.path(Ink::GRID, grid);
        picture.shapes.extend(words);
        picture.tick([right, bottom + 32.0], Anchor::End, name);
    }

    /// The border.
    pub(super) fn border(&self, picture: &mut Picture) {
        let ([left, top], [width, height]) = (self.corner, self.size);
        let d = format!("M{} {}h{}v{}h{}Z", px(left), px(top), px(width), px(height), px(-width));
        picture.path(Ink::FRAME, d);
    }
}

/// Words of a picture that must not lie over one another.
#[derive(Default)]
pub(super) struct Words {
    boxes: Vec<[f64; 4]>,
}

impl Words {
    /// Height of a word [px].
    const HEIGHT: f64 = 13.0;

    /// Keeps words off a circle [px].
    pub(super) fn keep_off(&mut self, at: [f64; 2], radius: f64) {
        self.boxes.push([at[0] - radius, at[1] - radius, at[0] + radius, at[1] + radius]);
    }

    /// Keeps words off a level line between two x [px].
    pub(super) fn keep_off_line(&mut self, y: f64, [from, to]: [f64; 2]) {
        self.boxes.push([from, y - 1.0, to, y + 1.0]);
    }

    /// Puts a word whose middle is at a place, unless another is there or it leaves the window [px].
    pub(super) fn put(&mut self, picture: &mut Picture, at: [f64; 2], text: &str, window: [f64; 4]) -> bool {
        let half = 0.5 * (CHARACTER * text.chars().count() as f64 + 3.0);
        let one = [at[0] - half, at[1] - 0.5 * Words::HEIGHT, at[0] + half, at[1] + 0.5 * Words::HEIGHT];
        let outside = one[0] < window[0] || one[1] < window[1] || one[2] > window[2] || one[3] > window[3];
        let meets = |b: &[f64; 4]| one[0] < b[2] && b[0] < one[2] && one[1] < b[3] && b[1] < one[3];
        if outside || self.boxes.iter().any(meets) {
            return false;
        }
        self.boxes.push(one);
        picture.word([at[0], at[1] + 4.0], Anchor::Middle, text);
        true
    }
}
