//! Entries of lines into what a ball and a flat end sweep while they lean over, against numbers from branch and bound over exact
//! poses, which shares nothing with the search here.

use glam::{DQuat, DVec3};

use super::super::body::RevolvedParts;
use super::span::spans;
use super::swept::{MOST_STRETCHES, SpanPoses, StockLine};
use crate::geom::{Line, Profile};
use crate::sweep::ToolMotion;

/// Ball or flat end of 10 mm; the long motion or the short one; a point of a line and its direction; the distance to the entry [mm].
type Entry = (bool, bool, [f64; 3], [f64; 3], f64);

const ENTRIES: [Entry; 11] = [
    (
        true,
        true,
        [27.087896581298544, 71.683541679733, 61.92525783931943],
        [-0.22503366920493328, -0.8291400442561553, -0.511748605015261],
        79.59000899706405,
    ),
    (
        true,
        true,
        [70.91515569384005, 40.075763348363125, 60.15581185605263],
        [-0.7116918483150072, -0.4595733530554348, -0.5313069227888467],
        73.14086336215632,
    ),
    (
        false,
        true,
        [-38.627125413853136, -23.30262595369417, -71.84983539075814],
        [0.44963585422144065, 0.31634128407532897, 0.8353177782066699],
        85.84410457718342,
    ),
    (
        false,
        true,
        [-4.881078057960536, -71.36068645007687, 28.37123919356263],
        [0.3399343676685268, 0.9194984120739935, -0.19740135731854336],
        73.45119117819739,
    ),
    (
        false,
        true,
        [-9.51995825786749, -74.6103539440543, 41.814594191240694],
        [0.2067717676163206, 0.9006893038983603, -0.3821049776696314],
        77.64113145346128,
    ),
    (
        true,
        false,
        [-76.02279455792201, -24.383033049607604, 18.315097121760882],
        [0.9262898473035287, 0.32242720236821004, -0.19500722539284165],
        76.98596756360374,
    ),
    (
        true,
        false,
        [23.18582228105586, 55.10076315416751, 72.33736837454263],
        [-0.27601787470009825, -0.6716948923537044, -0.6874882576684392],
        71.06783411373257,
    ),
    (
        false,
        false,
        [20.81511599227112, -14.627579114684961, 86.64829868098806],
        [-0.21183490415771775, 0.20670995543540763, -0.9551947276364031],
        70.77222007315108,
    ),
    (
        false,
        false,
        [-25.511847450419463, 32.90484454678742, -59.48513534417216],
        [0.29592099919889053, -0.398119480764812, 0.868292370845608],
        73.37840033780074,
    ),
    (
        false,
        false,
        [-26.771551964125344, -13.62436938265919, 86.22235782858431],
        [0.32532325481459023, 0.17238525775323554, -0.9297570127652663],
        70.9954948084688,
    ),
    (
        false,
        false,
        [50.51355342493403, -54.055491339066826, -26.500150748835935],
        [-0.6211374596289897, 0.6573656283843244, 0.42668335667626833],
        76.49219073191135,
    ),
];

#[test]
fn lines_enter_where_branch_and_bound_says() {
    let long = (DVec3::new(20.0, 0.0, -2.0), DVec3::Z, DVec3::new(0.5f64.sin(), 0.1, 0.5f64.cos()));
    let tilt = DVec3::new(0.02f64.sin(), 0.11, 0.02f64.cos());
    let short = (DVec3::new(1.0, 0.2, -0.1), DVec3::new(0.0, 0.1, 1.0), tilt);
    for (ball, is_long, origin, direction, entry) in ENTRIES {
        let corner = if ball { 5.0 } else { 0.0 };
        let body = RevolvedParts::new([(&Profile::bull_nose(10.0, corner, 30.0).unwrap(), 0.0)]);
        let (end, from, to) = if is_long { long } else { short };
        for (along, (travel, within)) in (0..3).flat_map(|along| SPANS.map(|of| (along, of))) {
            // Turned so that the line lies along an axis, where the stock has its lines.
            let (origin, direction) = (DVec3::from_array(origin), DVec3::from_array(direction));
            let turn = DQuat::from_rotation_arc(direction.normalize_or_zero(), DVec3::AXES[along]);
            let place = |p: DVec3| turn * (p - origin);
            let line = Line { start: place(DVec3::ZERO), end: place(end) };
            let motion = ToolMotion::between(line.into(), turn * from, turn * to).unwrap();
            let reach = 36.0;
            let (list, _) = spans(&motion, reach, travel, |_, _| false);
            let material = [0.0, 300.0];
            let line =
                StockLine { start: DVec3::ZERO, along, material, stretches: [material; MOST_STRETCHES] };
            let mut first = f64::INFINITY;
            for span in list {
                for part in &body.parts {
                    SpanPoses::new(span)
                        .covers(part, span.bend(reach), &line, |[lo, _]| first = first.min(lo.s));
                }
            }
            let off = (first - entry) * 1e6;
            assert!(off.abs() * 1e-6 < within, "{ball} {is_long} {along}, spans of {travel} mm: {off} nm");
        }
    }
}

/// Longest ways of the tool in a span, as the stock has them and shorter, and how far entries may be off then [mm]: what is more than
/// rounding comes from the poses of long spans.
const SPANS: [(f64, f64); 2] = [(5.0, 2e-9), (2.5, 1e-9)];
