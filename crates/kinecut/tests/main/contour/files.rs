//! Tools of any form from files: tables, and what is wrong in them.

use kinecut::base::{Code, MemoryLoader};
use kinecut::job::contour::load_contour;

use crate::common::drawing::dxf;

#[test]
fn a_table_gives_shape_shank_and_holder() {
    let text = "
name = \"long reach\"
shape.bull-nose = { diameter = 10, corner_radius = 1, flute_length = 15 }
shank_diameter = 8
stickout = 35
[[holder]]
height = 5
lower_diameter = 8
upper_diameter = 24
[[holder]]
height = 20
lower_diameter = 24
";
    let drawn = dxf("0 LINE 10 0 20 0 11 5 21 0 0 LINE 10 5 20 0 11 5 21 30 0 LINE 10 5 20 30 11 0 21 30");
    let files = MemoryLoader::default()
        .with("long.toml", text)
        .with("tool.dxf", drawn)
        .with("drawn.toml", "shape.outline = { file = \"tool.dxf\" }\nshank_diameter = 12\nstickout = 40\n")
        .with(
            "drill.json",
            r#"{ "shape": { "drill": { "diameter": 12, "point_angle": 60, "flute_length": 25 } } }"#,
        )
        .with("gun.toml", "shape.drill = { diameter = 12, point = { gun = {} }, flute_length = 50 }\n");
    let long = load_contour("long.toml", &files).unwrap().contour;
    assert_eq!((long.elements().len(), long.height(), long.largest_radius()), (8, 60.0, 12.0));
    let drawn = load_contour("drawn.toml", &files).unwrap().contour;
    assert_eq!((drawn.elements().len(), drawn.height(), drawn.largest_radius()), (5, 40.0, 6.0));
    let drill = load_contour("drill.json", &files).unwrap().contour;
    assert!((drill.elements()[0].shape.end().y - 6.0 / 30f64.to_radians().tan()).abs() < 1e-12);
    // A gun drill is hollow between axis and apex.
    let gun = load_contour("gun.toml", &files).unwrap().contour;
    assert!(
        gun.bottom() > 1.0
            && gun.radii_at(0.5 * gun.bottom()).len() == 1
            && gun.radii_at(0.5 * gun.bottom())[0][0] > 0.0
    );
    assert_eq!(load_contour("tool.dxf", &files).unwrap().contour.elements().len(), 3);
}

#[test]
fn errors_in_a_table_have_line_and_key() {
    let refused = |text: &str, code: Code, key: &str| {
        let files = MemoryLoader::default().with("t.toml", text);
        let error = load_contour("t.toml", &files).unwrap_err();
        assert_eq!((error.code(), error.0.key.as_deref().unwrap_or_default()), (code, key), "{error}");
        assert_eq!(error.0.place.as_ref().map(|p| p.file.as_str()), Some("t.toml"), "{error}");
    };
    refused(
        "shape.ball-nose = { diameter = -1, flute_length = 9 }",
        Code::TOOL_VALUE,
        "shape.ball-nose.diameter",
    );
    refused(
        "shape.ball-nose = { diameter = 4, flute_length = 1 }",
        Code::TOOL_VALUE,
        "shape.ball-nose.flute_length",
    );
    refused(
        "shape.ball-nose = { diameter = nan, flute_length = 1 }",
        Code::TOOL_VALUE,
        "shape.ball-nose.diameter",
    );
    let taper = "shape.taper = { diameter = 10, profile_radius = 250, tip_radius = 1, half_angle = 95, flute_length = 60 }";
    refused(taper, Code::TOOL_VALUE, "shape.taper.half_angle");
    let gun = "shape.drill = { diameter = 12, point = { gun = { apex = 7 } }, flute_length = 50 }";
    refused(gun, Code::TOOL_VALUE, "shape.drill.point.gun.apex");
    let apt = "shape.apt = { diameter = 12, corner_radius = 2, centre_radius = 3, height = 20 }";
    refused(apt, Code::TOOL_VALUE, "shape.apt.diameter");
    let gap =
        "shape.contour = { elements = [{ to = [5, 0] }, { to = [5, 9], radius = 2 }, { to = [0, 9] }] }";
    refused(gap, Code::CONTOUR, "shape.contour.elements[1]");
    let open = "shape.contour = { elements = [{ to = [5, 0] }, { to = [5, 9] }] }";
    refused(open, Code::CONTOUR, "shape.contour.elements[1]");
    let stickout = "shape.end-mill = { diameter = 4, flute_length = 9 }\nstickout = 5";
    refused(stickout, Code::TOOL_VALUE, "stickout");
    let holder =
        "shape.end-mill = { diameter = 4, flute_length = 9 }\nholder = [{ height = 0, lower_diameter = 9 }]";
    refused(holder, Code::TOOL_VALUE, "holder[0].height");
    let files =
        MemoryLoader::default().with("t.toml", "shape.ball-nose = { diametre = 4, flute_length = 9 }");
    let error = load_contour("t.toml", &files).unwrap_err().to_string();
    assert!(error.contains("diametre") && error.contains("diameter"), "{error}");
}
