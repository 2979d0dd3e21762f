//! Random faces, bores and pre-holes: what the way says against the material that stands over every point of a grid.

use kinecut::drilling::{
    BoundarySurface, CrossBore, DrillWay, Feeds, Passage, PreHole, Side, Travel, ZoneStage, zones,
};
use kinecut::geom::EdgeProfile;
use proptest::prelude::*;

use super::mesh::points;

/// Top or bottom of a half cylinder, or a plane, at a distance u from the tool axis.
fn height(surface: &BoundarySurface, u: f64) -> f64 {
    let half = |radius: f64, w: f64| (radius * radius - w * w).max(0.0).sqrt();
    match *surface {
        BoundarySurface::Plane { height, slope } => height + slope * u,
        BoundarySurface::Ridge { radius, offset, height } => height + half(radius, u + offset),
        BoundarySurface::Valley { radius, offset, height } => height - half(radius, u + offset),
    }
}

/// Whether a bore's wall stands nearly upright over a point: what another surface leaves there is a strip that may be
/// narrower than the search sees.
fn is_beside_a_wall(way: &DrillWay, x: f64, y: f64) -> bool {
    way.bores.iter().any(|bore| {
        let w = x * bore.turn.cos() + y * bore.turn.sin() + bore.offset;
        (w.abs() - bore.radius).abs() < 0.005
    })
}

/// Half the width of strips that are not looked at [mm].
const WIDE: f64 = 0.015;

/// The intervals of material over a point, from below, and whether the drill is to be looked at there: where it could cut,
/// away from upright walls.
fn material(way: &DrillWay, x: f64, y: f64) -> (Vec<[f64; 2]>, bool) {
    let along = |turn: f64| x * turn.cos() + y * turn.sin();
    let bottom = way.exit.map_or(-1e6, |s| height(&s, along(way.exit_turn)));
    let mut solid = vec![[bottom, height(&way.entry, x)]];
    let mut cut = |from: f64, to: f64| {
        let parts = solid.iter().flat_map(|&[a, b]| [[a, b.min(from)], [a.max(to), b]]);
        solid = parts.filter(|[a, b]| b > a).collect();
    };
    let mut there = true;
    if let Some(hole) = &way.pre_hole {
        let r = (x - hole.at[0]).hypot(y - hole.at[1]);
        if r < 0.5 * hole.diameter {
            match &hole.bottom {
                Some(made) => {
                    let floor = made.height + made.edge.height(r).unwrap();
                    cut(floor, 1e9);
                    there = floor > bottom;
                }
                None => {
                    cut(-1e9, 1e9);
                    there = false;
                }
            }
        }
    }
    for bore in &way.bores {
        let w = along(bore.turn) + bore.offset;
        if w.abs() < bore.radius {
            let h = (bore.radius * bore.radius - w * w).sqrt();
            cut(bore.height - h, bore.height + h);
        }
    }
    (solid, there && !is_beside_a_wall(way, x, y))
}

/// Points of the edge: place, radius, height of the edge; on the ends of each segment too.
fn grid(edge: &EdgeProfile, rings: u32, angles: u32) -> Vec<(f64, f64, f64)> {
    let mut found = Vec::new();
    for s in edge.segments() {
        let [a, b] = s.range();
        for i in 0..=rings {
            let r = a + (b - a) * f64::from(i) / f64::from(rings);
            for k in 0..angles {
                let (sin, cos) = (std::f64::consts::TAU * f64::from(k) / f64::from(angles)).sin_cos();
                found.push((r * cos, r * sin, s.height(r)));
            }
        }
    }
    found
}

/// Stretches of Z that passages cover, joined.
fn joined(passages: &[Passage]) -> Vec<[f64; 2]> {
    let mut all: Vec<[f64; 2]> = passages.iter().map(|p| [p.transient.last, p.transient.first]).collect();
    all.sort_by(|a, b| a[0].total_cmp(&b[0]));
    let mut found: Vec<[f64; 2]> = Vec::new();
    for [a, b] in all {
        match found.last_mut() {
            Some(last) if a <= last[1] => last[1] = last[1].max(b),
            _ => found.push([a, b]),
        }
    }
    found
}

/// All boundaries over the grid are passed within passages, whose ends are reached within `near`; where none is passed
/// the drill is in material as the zones say.
fn compare(way: &DrillWay, edge: &EdgeProfile, near: f64) -> Result<(), TestCaseError> {
    let passages = way.passages(edge).unwrap();
    let stretches = joined(&passages);
    let mut reached = vec![[f64::INFINITY, f64::NEG_INFINITY]; stretches.len()];
    let columns: Vec<_> =
        grid(edge, 20, 72).into_iter().map(|(x, y, z)| (material(way, x, y), z, x, y)).collect();
    for ((solid, _), z, x, y) in columns.iter().filter(|(.., x, y)| !is_beside_a_wall(way, *x, *y)) {
        for (h, side) in solid.iter().flat_map(|i| [(i[1], Side::Entry), (i[0], Side::Exit)]) {
            if h < -1e5 {
                continue;
            }
            let at = h - z;
            let within = |p: &Passage| {
                p.side == side && at >= p.transient.last - 1e-9 && at <= p.transient.first + 1e-9
            };
            prop_assert!(
                passages.iter().any(within),
                "{side:?} at {at} over {x} {y} is in none of {passages:?}"
            );
            if let Some(n) = stretches.iter().position(|s| at >= s[0] - 1e-9 && at <= s[1] + 1e-9) {
                reached[n] = [reached[n][0].min(at), reached[n][1].max(at)];
            }
        }
    }
    let far =
        |stretch: &[f64; 2], ends: &[f64; 2]| ends[0] - stretch[0] > near || stretch[1] - ends[1] > near;
    // Horns between rims and bores fall between the points of the grid.
    if stretches.iter().zip(&reached).any(|(s, e)| far(s, e)) {
        for (x, y, z) in grid(edge, 150, 1440) {
            for h in material(way, x, y).0.into_iter().flatten().filter(|h| *h > -1e5) {
                if let Some(n) = stretches.iter().position(|s| h - z >= s[0] - 1e-9 && h - z <= s[1] + 1e-9) {
                    reached[n] = [reached[n][0].min(h - z), reached[n][1].max(h - z)];
                }
            }
        }
    }
    for (stretch, ends) in stretches.iter().zip(&reached) {
        prop_assert!(!far(stretch, ends), "{stretch:?} is reached only from {ends:?}: {passages:?}");
    }
    let mut found = Vec::new();
    let feeds = Feeds { entry: 0.2, steady: 0.3, exit: 0.1 };
    zones(&passages, Travel { start: 80.0, end: -160.0 }, &feeds, &mut found);
    prop_assert!((found[0].from - 80.0).abs() < 1e-12 && (found[found.len() - 1].to + 160.0).abs() < 1e-12);
    for pair in found.windows(2) {
        prop_assert!(pair[0].to == pair[1].from && pair[0].from > pair[0].to);
    }
    for zone in &found {
        let wanted = match zone.stage {
            ZoneStage::Steady => [true, true],
            ZoneStage::Air => [false, false],
            ZoneStage::Partial => [true, false],
            _ => continue,
        };
        for part in [0.01, 0.5, 0.99] {
            let z = zone.from + part * (zone.to - zone.from);
            let at = |e: &f64, solid: &[[f64; 2]]| solid.iter().any(|i| z + e > i[0] && z + e < i[1]);
            // At the ends of segments and on rims a point may touch what it passes.
            // Nor counts a strip that is narrower than the columns see by which shares are counted.
            let beside = |x: f64, y: f64, cut: bool| {
                [[WIDE, 0.0], [-WIDE, 0.0], [0.0, WIDE], [0.0, -WIDE]].iter().any(|by| {
                    let (x, y) = (x + by[0], y + by[1]);
                    let (solid, there) = material(way, x, y);
                    there && edge.height(x.hypot(y)).is_some_and(|e| at(&e, &solid) == cut)
                })
            };
            let counts = |wanted: bool| {
                let other = |g: &&((Vec<[f64; 2]>, bool), f64, f64, f64)| {
                    g.0.1 && at(&g.1, &g.0.0) != wanted && !beside(g.2, g.3, wanted)
                };
                columns.iter().filter(other).count()
            };
            let others = match wanted {
                [true, true] => counts(true),
                [false, _] => counts(false),
                _ => 0,
            };
            prop_assert!(others == 0, "{others} at {z} in {zone:?} of {found:?} {passages:?}");
        }
    }
    Ok(())
}

fn surface(height: f64) -> impl Strategy<Value = BoundarySurface> {
    (0..3u8, -0.7..0.7f64, 15.0..60.0f64, -1.0..1.0f64).prop_map(move |(kind, slope, radius, x)| {
        let offset = x * (radius - 5.1);
        match kind {
            0 => BoundarySurface::Plane { height, slope },
            1 => {
                // So that the surface passes through the height on the axis.
                let rise = (radius * radius - offset * offset).sqrt();
                BoundarySurface::Ridge { radius, offset, height: height - rise }
            }
            _ => {
                let rise = (radius * radius - offset * offset).sqrt();
                BoundarySurface::Valley { radius, offset, height: height + rise }
            }
        }
    })
}

fn bore(heights: std::ops::Range<f64>) -> impl Strategy<Value = CrossBore> {
    (0.8..14.0f64, -9.0..9.0f64, heights, 0.0..3.2f64).prop_map(|(radius, offset, height, turn)| CrossBore {
        radius,
        offset,
        height,
        turn,
    })
}

fn pre_hole() -> impl Strategy<Value = Option<PreHole>> {
    (0..5u8, 1.0..8.0f64, -60.0..-10.0f64, 0.0..6.0f64, 0.0..6.3f64, 0usize..6).prop_map(
        |(kind, diameter, height, d, angle, made)| {
            let at = [d * angle.cos(), d * angle.sin()];
            let made = [0, 1, 4, 8, 9, 10][made];
            match kind {
                0 => None,
                1 => Some(PreHole::through(diameter)),
                2 => Some(PreHole::through(diameter).moved(at)),
                3 => Some(PreHole::blind(diameter, height, points()[made].edge(diameter).ok()?)),
                _ => Some(PreHole::blind(diameter, height, points()[made].edge(diameter).ok()?).moved(at)),
            }
        },
    )
}

proptest! {
    #![proptest_config(kinecut_cases::property(60))]

    #[test]
    fn ways_on_which_nothing_touches(
        kind in 0usize..11,
        entry in surface(0.0), exit in surface(-120.0), exit_turn in 0.0..3.2f64,
        upper in bore(-45.0..-40.0), lower in bore(-85.0..-80.0), count in 0usize..3,
        hole in pre_hole(),
    ) {
        let edge = points()[kind].edge(10.0).unwrap();
        let bores = [upper, lower][..count].to_vec();
        let way = DrillWay { entry, exit: Some(exit), exit_turn, bores, pre_hole: hole };
        // Between points of the grid lie 0.44 mm at the rim and 0.25 mm along the edge.
        compare(&way, &edge, 1.4)?;
    }
}

proptest! {
    #![proptest_config(kinecut_cases::property(16))]

    #[test]
    fn ways_on_which_bores_open_into_anything(
        kind in 0usize..11,
        entry in surface(0.0), exit in surface(-30.0), exit_turn in 0.0..3.2f64,
        bores in prop::collection::vec(bore(-40.0..10.0), 1..3), blind in any::<bool>(),
        hole in pre_hole(),
    ) {
        let edge = points()[kind].edge(10.0).unwrap();
        let exit = if blind { None } else { Some(exit) };
        let way = DrillWay { entry, exit, exit_turn, bores, pre_hole: hole };
        compare(&way, &edge, 1.9)?;
    }
}
