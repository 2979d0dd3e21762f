//! Planes of swept parts about a place, side by side.

use pulp::{Arch, NullaryFnOnce};

use super::bundle::Shape;
use super::lanes::{LANES, Lane, Ways, along, dot, times};

/// Numbers of a plane: its normal, the reach of the part beyond the centre, and how much less that likely is.
pub(super) const PLANE: usize = 5;

/// Numbers of a gauge near a centre.
pub(super) const NUMBERS: usize = 14;

/// Numbers of a plane, those of the gauge, and by how much the plane widens with each millimetre beside.
pub(super) const ABOUT: usize = PLANE + NUMBERS + 1;

/// The planes of parts about what is no farther than `radius` from a place, number by number.
pub(super) fn about(
    arch: Arch,
    shape: Shape,
    ways: &Ways,
    centre: [f64; 3],
    radius: f64,
) -> [[f64; LANES]; ABOUT] {
    let mut about = [[0.0; LANES]; ABOUT];
    arch.dispatch(About { shape, ways, centre, radius, about: &mut about });
    about
}

/// The planes of parts about a cell, as [`SweptPart::tangent_closely`], and their gauges near its centre, as [`SweptPart::nearby`].
struct About<'a> {
    shape: Shape,
    ways: &'a Ways,
    centre: [f64; 3],
    radius: f64,
    about: &'a mut [[f64; LANES]; ABOUT],
}

impl NullaryFnOnce for About<'_> {
    type Output = ();

    #[inline(always)]
    fn call(self) {
        let About { shape, ways, centre, radius, about } = self;
        // In a place of its own, as with the bounds of spans that stay away.
        let mut found = [[0.0; LANES]; ABOUT];
        for lane in 0..LANES {
            let of = Lane { shape, ways, lane };
            let middle = of.at(centre, 0.0);
            let time = if middle.rate > 0.0 { -0.5 } else { 0.5 };
            let last = of.at(centre, time);
            let turns_back = (middle.rate > 0.0) != (last.rate > 0.0);
            let share = if turns_back { last.rate / (last.rate - middle.rate) } else { 0.0 };
            let rest = 1.0 - share;
            let last_value = if share > 0.0 { last.value - last.rate * time } else { last.value };
            let value = share * middle.value + rest * last_value;
            let beside = radius * middle.by_way;
            let nearer = share * middle.half + rest * last.whole;
            let slack = (0.5 * share + rest) * radius * middle.turns + nearer + beside;
            let wide = 0.5 * (middle.rate.abs() + radius * middle.turns) + middle.half + beside;
            let closer = slack - value < wide - middle.value;
            let reach = if closer { slack - value } else { wide - middle.value };
            let (share, rest) = if closer { (share, rest) } else { (1.0, 0.0) };
            let [a, b] = middle.curves;
            let (v, w) = (dot(a, middle.velocity), dot(b, middle.velocity));
            let [l, m, n] = along(times(middle.normal, share), last.normal, rest);
            let [x, y, z] = middle.normal;
            let gains = v * v + w * w + middle.second;
            found[0][lane] = l;
            found[1][lane] = m;
            found[2][lane] = n;
            found[3][lane] = reach;
            found[4][lane] = reach + value;
            found[5][lane] = x;
            found[6][lane] = y;
            found[7][lane] = z;
            found[8][lane] = a[0];
            found[9][lane] = a[1];
            found[10][lane] = a[2];
            found[11][lane] = b[0];
            found[12][lane] = b[1];
            found[13][lane] = b[2];
            found[14][lane] = v;
            found[15][lane] = w;
            found[16][lane] = middle.value;
            found[17][lane] = -middle.rate;
            found[18][lane] = gains;
            found[19][lane] = middle.turns + middle.by_way;
        }
        *about = found;
    }
}
