//! The list of materials.
//!
//! Cutting forces: handbook values; where `checked`, the published table of a maker of chucks (specific force over feed, turning, entering
//! angle 45 degrees) has been fitted and agrees within 4 %. Start values: catalogues of three makers of solid carbide cutters for steel,
//! stainless steel, iron, aluminium and titanium; the others are usual values of workshops.

use super::material::MaterialGroup::{Iron, NonFerrous, Plastic, Stainless, Steel, Titanium};
use super::start::StartRow;
use super::{CuttingForce, Material, MaterialGroup};

/// A material without start values.
const fn material(
    name: &'static str,
    aliases: &'static [&'static str],
    group: MaterialGroup,
    (kc11, mc): (f64, f64),
    force_is_checked: bool,
) -> Material {
    Material { name, aliases, group, force: Some(CuttingForce { kc11, mc }), force_is_checked, start: None }
}

impl Material {
    const fn starting(self, row: StartRow) -> Material {
        Material { start: Some(row), ..self }
    }
}

/// Cutting speeds of carbide mills in full width and beside a wall, feed per tooth in diameters, speed and feed of HSS drills,
/// speed of carbide drills, taps, reamers; m/min, feeds in diameters.
const fn row(
    mill: [f64; 2],
    tooth: f64,
    (drill, drill_feed): (f64, f64),
    [carbide_drill, tap, ream]: [f64; 3],
) -> StartRow {
    StartRow { mill, tooth, drill, drill_feed, carbide_drill, tap, ream }
}

pub(super) static MATERIALS: &[Material] = &[
    material("S235", &["S235JR", "1.0038", "1.0037", "St37"], Steel, (1780.0, 0.17), true),
    material("E295", &["1.0050", "St50"], Steel, (1990.0, 0.26), true),
    material(
        "C45",
        &["C45E", "C45R", "Ck45", "1.0503", "1.1191", "1.1201", "1045"],
        Steel,
        (2110.0, 0.17),
        true,
    )
    .starting(row([150.0, 200.0], 0.006, (25.0, 0.020), [90.0, 12.0, 10.0])),
    material("C60", &["C60E", "Ck60", "1.0601", "1.1221", "1060"], Steel, (2110.0, 0.17), true),
    material("E335", &["1.0060", "St60"], Steel, (2110.0, 0.17), true),
    material("E360", &["1.0070", "St70"], Steel, (2260.0, 0.30), true),
    material("18CrNi8", &["1.5920"], Steel, (2260.0, 0.30), true),
    material("42CrMo4", &["1.7225", "4140", "42CrMo4+QT"], Steel, (2500.0, 0.26), true).starting(row(
        [100.0, 140.0],
        0.005,
        (18.0, 0.016),
        [75.0, 8.0, 8.0],
    )),
    material("16MnCr5", &["1.7131", "5115"], Steel, (2100.0, 0.26), true),
    material("X120Mn12", &["1.3401"], Steel, (3300.0, 0.22), true),
    material("GE240", &["1.0446", "GS-45"], Steel, (1600.0, 0.17), true),
    material("GE260", &["1.0552", "GS-52"], Steel, (1800.0, 0.16), true),
    material("1.4301", &["X5CrNi18-10", "304"], Stainless, (2350.0, 0.21), false).starting(row(
        [70.0, 100.0],
        0.004,
        (12.0, 0.014),
        [50.0, 6.0, 5.0],
    )),
    material("GJL-150", &["GG15", "0.6015"], Iron, (950.0, 0.21), true),
    material("GJL-250", &["GG25", "0.6025"], Iron, (1160.0, 0.26), true).starting(row(
        [130.0, 180.0],
        0.006,
        (22.0, 0.025),
        [90.0, 12.0, 10.0],
    )),
    material(
        "Al wrought",
        &[
            "aluminium",
            "aluminum",
            "AlMgSi1",
            "3.2315",
            "AW-6082",
            "6082",
            "AW-6061",
            "6061",
            "AlZnMgCu1.5",
            "3.4365",
            "AW-7075",
            "7075",
            "AlMg4.5Mn0.7",
            "3.3547",
            "AW-5083",
            "5083",
        ],
        NonFerrous,
        (700.0, 0.25),
        false,
    )
    .starting(row([350.0, 500.0], 0.008, (60.0, 0.025), [200.0, 20.0, 20.0])),
    material("AlSi10Mg", &["AlSi9Cu3", "AC-43000", "AC-46000"], NonFerrous, (800.0, 0.25), false),
    material(
        "CuZn39Pb3",
        &["CuZn39Pb2", "2.0401", "CW614N", "CW612N", "Ms58", "brass"],
        NonFerrous,
        (780.0, 0.18),
        false,
    )
    .starting(row([200.0, 300.0], 0.006, (50.0, 0.025), [150.0, 15.0, 15.0])),
    Material {
        name: "POM",
        aliases: &["POM-C", "POM-H", "Delrin"],
        group: Plastic,
        force: None,
        force_is_checked: false,
        start: Some(PLASTIC),
    },
    Material {
        name: "PA",
        aliases: &["PA6", "PA66", "nylon"],
        group: Plastic,
        force: None,
        force_is_checked: false,
        start: Some(PLASTIC),
    },
    material("Ti6Al4V", &["TiAl6V4", "3.7165", "3.7164", "Ti Grade 5"], Titanium, (1400.0, 0.23), false)
        .starting(row([40.0, 60.0], 0.004, (8.0, 0.012), [30.0, 4.0, 4.0])),
];

const PLASTIC: StartRow = row([250.0, 350.0], 0.010, (50.0, 0.030), [120.0, 15.0, 15.0]);
