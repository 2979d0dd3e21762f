//! A plot: the places of numbers in it, its grid, its border, the numbers and names of its axes.

use super::{Ink, Ticks, width};
use crate::page::picture::{Anchor, Picture};
use crate::page::px;

/// Room below a plot for the numbers and the name of x [px].
pub(crate) const BELOW: f64 = 38.0;

/// A plot area with its ranges.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Plot {
    /// Left and upper border [px].
    pub(crate) corner: [f64; 2],
    /// Width and height [px].
    pub(crate) size: [f64; 2],
    /// Range of x, from left to right.
    pub(crate) x: [f64; 2],
    /// Range of y, from the bottom up.
    pub(crate) y: [f64; 2],
}

/// Room to the left of a plot for the numbers of y [px].
pub(crate) fn room_left<'a>(labels: impl IntoIterator<Item = &'a str>) -> f64 {
    14.0 + labels.into_iter().map(width).fold(0.0, f64::max)
}

impl Plot {
    /// Pixels for one of x.
    pub(crate) fn kx(&self) -> f64 {
        self.size[0] / (self.x[1] - self.x[0])
    }

    /// Pixels for one of y, downwards.
    pub(crate) fn ky(&self) -> f64 {
        -self.size[1] / (self.y[1] - self.y[0])
    }

    /// x [px].
    pub(crate) fn px(&self, x: f64) -> f64 {
        self.corner[0] + (x - self.x[0]) * self.kx()
    }

    /// y [px].
    pub(crate) fn py(&self, y: f64) -> f64 {
        self.corner[1] + (y - self.y[1]) * self.ky()
    }

    /// A point [px].
    pub(crate) fn at(&self, p: [f64; 2]) -> [f64; 2] {
        [self.px(p[0]), self.py(p[1])]
    }

    /// Left, top, right, bottom [px].
    pub(crate) fn bounds(&self) -> [f64; 4] {
        let ([left, top], [width, height]) = (self.corner, self.size);
        [left, top, left + width, top + height]
    }

    /// The whole area as the data of a path.
    pub(crate) fn area(&self) -> String {
        let [left, top, right, bottom] = self.bounds().map(px);
        format!("M{left} {top}H{right}V{bottom}H{left}Z")
    }

    /// An upright line over the plot.
    pub(crate) fn upright(&self, x: f64) -> String {
        let [_, top, _, bottom] = self.bounds();
        format!("M{} {}V{}", px(self.px(x)), px(top), px(bottom))
    }

    /// A level line over the plot.
    pub(crate) fn level(&self, y: f64) -> String {
        let [left, _, right, _] = self.bounds();
        format!("M{} {}H{}", px(left), px(self.py(y)), px(right))
    }

    /// A number below the plot.
    pub(crate) fn number_x(&self, picture: &mut Picture, x: f64, anchor: Anchor, text: impl Into<String>) {
        picture.tick([self.px(x), self.bounds()[3] + 15.0], anchor, text);
    }

    /// A number beside the plot.
    pub(crate) fn number_y(&self, picture: &mut Picture, y: f64, text: impl Into<String>) {
        picture.tick([self.corner[0] - 6.0, self.py(y) + 4.0], Anchor::End, text);
    }

    /// The name of x, under its numbers.
    pub(crate) fn name_x(&self, picture: &mut Picture, name: impl Into<String>) {
        let [_, _, right, bottom] = self.bounds();
        picture.tick([right, bottom + 32.0], Anchor::End, name);
    }

    /// The border.
    pub(crate) fn border(&self, picture: &mut Picture) {
        picture.path(Ink::FRAME, self.area());
    }

    /// Grid, numbers, and the name of x.
    pub(crate) fn axes(&self, picture: &mut Picture, x: &Ticks, y: &Ticks, name: impl Into<String>) {
        let at_zero = |lines: &Ticks, zero: bool| {
            lines.values.iter().copied().filter(|v| (*v == 0.0) == zero).collect()
        };
        let grid = |zero: bool| {
            let (xs, ys): (Vec<f64>, Vec<f64>) = (at_zero(x, zero), at_zero(y, zero));
            let upright = xs.into_iter().map(|v| self.upright(v));
            upright.chain(ys.into_iter().map(|v| self.level(v))).collect::<String>()
        };
        picture.path(Ink::GRID, grid(false));
        picture.path(Ink::ZERO, grid(true));
        for &v in &x.values {
            self.number_x(picture, v, Anchor::Middle, x.label(v));
        }
        for &v in &y.values {
            self.number_y(picture, v, y.label(v));
        }
        self.name_x(picture, name);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_plot_goes_from_its_lower_left_to_its_upper_right() {
        let plot = Plot { corner: [40.0, 10.0], size: [200.0, 100.0], x: [-1.0, 1.0], y: [0.0, 50.0] };
        assert_eq!((plot.at([-1.0, 0.0]), plot.at([1.0, 50.0])), ([40.0, 110.0], [240.0, 10.0]));
        assert_eq!(plot.level(25.0), "M40 60H240");
        let mut picture = Picture::default();
        plot.axes(&mut picture, &Ticks::new(-1.0, 1.0, 4), &Ticks::new(0.0, 50.0, 5), "x");
        // Grid, the lines at zero, numbers of both axes, the name.
        assert_eq!(picture.shapes.len(), 2 + 5 + 6 + 1);
    }
}
