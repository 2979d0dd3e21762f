//! Extremes of a quantity in the columns of a graph.

/// Columns of a graph.
pub(super) const COLUMNS: usize = 800;

/// Extremes of a quantity in each column.
pub(super) struct Columns(Vec<[f64; 2]>);

impl Columns {
    pub(super) fn new() -> Columns {
        Columns(vec![[f64::INFINITY, f64::NEG_INFINITY]; COLUMNS])
    }

    pub(super) fn add(&mut self, column: usize, value: f64) {
        let [least, most] = &mut self.0[column];
        *least = least.min(value);
        *most = most.max(value);
    }

    /// Through the extremes of the columns, which are `width` wide; columns without samples are gaps.
    pub(super) fn points(&self, width: f64) -> Vec<[f64; 2]> {
        let mut points = Vec::with_capacity(2 * COLUMNS);
        for (i, [least, most]) in self.0.iter().enumerate() {
            let at = (i as f64 + 0.5) * width;
            if least > most {
                points.push([at, f64::NAN]);
                continue;
            }
            points.push([at, *least]);
            if most > least {
                points.push([at, *most]);
            }
        }
        points
    }
}
