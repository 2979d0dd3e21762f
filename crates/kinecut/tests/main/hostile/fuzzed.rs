//! The fuzz targets as property tests: right files, broken at random.

use kinecut::nc::Control;
use proptest::prelude::*;

use super::targets;

/// One thing done to the bytes of a file.
#[derive(Clone, Debug)]
enum Change {
    /// Another byte.
    Byte(usize, u8),
    /// A piece taken out.
    Cut(usize, usize),
    /// A piece written twice.
    Twice(usize, usize),
    /// A number put over what stands there.
    Number(usize, &'static str),
    /// A line moved.
    Line(usize, usize),
}

fn change() -> impl Strategy<Value = Change> {
    let at = any::<usize>;
    let numbers = [
        "0",
        "-1",
        "1e300",
        "1e-300",
        "-0.0",
        "2147483647",
        "4294967296",
        "nan",
        "inf",
        "99999999999999999999",
        ".",
        "1.2.3",
    ];
    prop_oneof![
        (at(), any::<u8>()).prop_map(|(i, b)| Change::Byte(i, b)),
        (at(), 0usize..40).prop_map(|(i, n)| Change::Cut(i, n)),
        (at(), 0usize..200).prop_map(|(i, n)| Change::Twice(i, n)),
        (at(), prop::sample::select(numbers.to_vec())).prop_map(|(i, n)| Change::Number(i, n)),
        (at(), at()).prop_map(|(i, j)| Change::Line(i, j)),
    ]
}

fn changed(seed: &str, changes: &[Change]) -> Vec<u8> {
    let mut bytes = seed.as_bytes().to_vec();
    for change in changes {
        let length = bytes.len().max(1);
        match *change {
            Change::Byte(i, b) if !bytes.is_empty() => bytes[i % length] = b,
            Change::Cut(i, n) if !bytes.is_empty() => {
                let i = i % length;
                bytes.drain(i..(i + n).min(length));
            }
            Change::Twice(i, n) if !bytes.is_empty() => {
                let i = i % length;
                let piece = bytes[i..(i + n).min(length)].to_vec();
                bytes.splice(i..i, piece);
            }
            Change::Number(i, number) => {
                let digits: Vec<usize> = (0..bytes.len()).filter(|&k| bytes[k].is_ascii_digit()).collect();
                let Some(&at) = digits.get(i % digits.len().max(1)) else { continue };
                bytes.splice(at..=at, number.bytes());
            }
            Change::Line(i, j) => {
                let mut lines: Vec<Vec<u8>> = bytes.split(|b| *b == b'\n').map(<[u8]>::to_vec).collect();
                let (i, j) = (i % lines.len(), j % lines.len());
                let line = lines.remove(i);
                lines.insert(j.min(lines.len()), line);
                bytes = lines.join(&b'\n');
            }
            _ => {}
        }
    }
    bytes
}

fn any_of(seeds: &'static [&'static str]) -> impl Strategy<Value = Vec<u8>> {
    (prop::sample::select(seeds), prop::collection::vec(change(), 0..6))
        .prop_map(|(seed, c)| changed(seed, &c))
}

const NC: &[(Control, &[&str])] = &[
    (
        Control::Sinumerik840d,
        &[include_str!("../../fixtures/nc/housing.mpf"), include_str!("../../fixtures/nc/turned.mpf")],
    ),
    (
        Control::Fanuc,
        &[include_str!("../../fixtures/nc/housing.nc"), include_str!("../../fixtures/nc/turned.nc")],
    ),
    (
        Control::LinuxCnc,
        &[include_str!("../../fixtures/nc/housing.ngc"), include_str!("../../fixtures/nc/turned.ngc")],
    ),
    (
        Control::Grbl,
        &[include_str!("../../fixtures/nc/housing.gcode"), include_str!("../../fixtures/nc/turned.gcode")],
    ),
    (
        Control::Heidenhain,
        &[include_str!("../../fixtures/nc/housing.h"), include_str!("../../fixtures/nc/turned.h")],
    ),
];
const JOBS: &[&str] = &[
    include_str!("../../../../../examples/02_blind_bore/job.toml"),
    include_str!("../../../../../examples/14_elliptic_pocket/job.toml"),
];
const MACHINES: &[&str] = &[include_str!("../../../../../examples/05_machine_from_code/trunnion.toml")];
const INI: &[&str] = &[
    "[EMC]\nMACHINE = mill\n[KINS]\nKINEMATICS = trivkins\n[TRAJ]\nCOORDINATES = X Y Z\nLINEAR_UNITS = mm\n[AXIS_X]\nMIN_LIMIT = -200\n\
     MAX_LIMIT = 200\nMAX_VELOCITY = 80\nMAX_ACCELERATION = 900\n[AXIS_Y]\nMIN_LIMIT = -100\nMAX_LIMIT = 100\n[AXIS_Z]\n\
     MIN_LIMIT = -120\nMAX_LIMIT = 0\n[JOINT_0]\nTYPE = LINEAR\nMAX_VELOCITY = 80\n",
];
const OUTLINES: &[&str] = &[
    r#"{"loops": [[[0, 0], [60, 0, 0.2], [60, 40], [0, 40]], {"centre": [30, 20], "radius": 5, "label": "hole"}]}"#,
];
const SVG: &[&str] = &[
    r#"<svg xmlns="http://www.w3.org/2000/svg" width="60mm" height="40mm" viewBox="0 0 60 40"><path d="M0 0 H60 V40 C40 30 20 50 0 40 Z"/><circle cx="30" cy="20" r="5"/></svg>"#,
];
const DXF: &[&str] = &[include_str!("../../../../../examples/04_gear_pump_cover/cover.dxf")];
const STL: &[&str] = &[
    "solid t\nfacet normal 0 0 -1\nouter loop\nvertex 0 0 0\nvertex 0 9 0\nvertex 9 0 0\nendloop\nendfacet\nfacet normal 0 -1 0\n\
     outer loop\nvertex 0 0 0\nvertex 9 0 0\nvertex 0 0 9\nendloop\nendfacet\nfacet normal -1 0 0\nouter loop\nvertex 0 0 0\n\
     vertex 0 0 9\nvertex 0 9 0\nendloop\nendfacet\nfacet normal 1 1 1\nouter loop\nvertex 9 0 0\nvertex 0 9 0\nvertex 0 0 9\n\
     endloop\nendfacet\nendsolid t\n",
];
const CONTOURS: &[&str] = &[
    "shape.bull-nose = { diameter = 20, corner_radius = 5, flute_length = 24 }\nshank_diameter = 16\nstickout = 42\n\
     holder = [{ height = 12, lower_diameter = 34, upper_diameter = 40 }]\n",
    "shape.ball-nose = { diameter = 10, flute_length = 20 }\nstickout = 40\n",
];
const LOCATIONS: &[&str] = &[
    "UNITS/MM\nLOADTL/1\nSPINDL/8000\nRAPID\nGOTO/0,0,10\nFEDRAT/900\nGOTO/0,0,-1\nGOTO/20,5,-2,0,0.1,0.995\nFINI\n",
];
const SURFACES: &[&str] = &[
    "like = \"cone\"\nparameters = { R = 30, alpha = \"20*pi/180\" }\n",
    include_str!("../../../../../examples/05_machine_from_code/thread.toml"),
];

#[test]
fn a_length_that_the_next_block_replaces_is_not_written() {
    let (control, seeds) = NC[2];
    targets::nc_program(control, &changed(seeds[1], &[Change::Twice(318, 43)]));
}

#[test]
fn a_comment_that_comes_to_stand_at_the_head_is_not_a_line_lost() {
    let (control, seeds) = NC[4];
    let change = Change::Line(4_340_776_081_739_762_059, 17_400_267_725_976_261_414);
    targets::nc_program(control, &changed(seeds[1], &[change]));
}

proptest! {
    #![proptest_config(kinecut_cases::property(60))]

    #[test]
    fn programs(index in 0..NC.len(), which in 0usize..2, other in 0..NC.len(), changes in prop::collection::vec(change(), 0..6)) {
        let (control, seeds) = NC[index];
        targets::nc_program(control, &changed(seeds[which], &changes));
        targets::nc_program(NC[other].0, &changed(seeds[which], &changes));
    }

    #[test]
    fn jobs(bytes in any_of(JOBS)) {
        targets::job(&bytes);
    }

    #[test]
    fn machines(file in any_of(MACHINES), ini in any_of(INI)) {
        targets::machine("m.toml", &file);
        targets::machine("m.ini", &ini);
    }

    #[test]
    fn outlines(json in any_of(OUTLINES), svg in any_of(SVG), dxf in any_of(DXF)) {
        targets::outline("a.json", &json);
        targets::outline("a.svg", &svg);
        targets::outline("a.dxf", &dxf);
    }

    #[test]
    fn meshes_and_tools(mesh in any_of(STL), tool in any_of(CONTOURS)) {
        targets::stl(&mesh);
        targets::outline("a.stl", &mesh);
        targets::contour("a.toml", &tool);
        targets::contour("a.svg", &tool);
    }

    #[test]
    fn locations_and_surfaces(locations in any_of(LOCATIONS), surface in any_of(SURFACES)) {
        targets::cutter_locations(&locations);
        targets::surface(&surface);
    }
}

#[test]
fn the_files_as_they_are_come_through() {
    for (control, seeds) in NC {
        seeds.iter().for_each(|s| targets::nc_program(*control, s.as_bytes()));
    }
    JOBS.iter().for_each(|s| targets::job(s.as_bytes()));
    INI.iter().for_each(|s| targets::machine("m.ini", s.as_bytes()));
    LOCATIONS.iter().for_each(|s| targets::cutter_locations(s.as_bytes()));
}
