//! The forty tools beside the examples.

use std::collections::BTreeSet;

use kinecut::job::file::ToolType;
use kinecut::job::library::library_toml;
use kinecut::tool::Cutter;

use super::read;

const SHOP: &str = include_str!("../../../../../../examples/shop.toml");

#[test]
fn forty_tools_are_valid_and_found_by_their_names() {
    let library = read("shop.toml", SHOP).unwrap();
    assert!(library.faults().is_empty(), "{:#?}", library.faults());
    let names: BTreeSet<&str> = library.tools.iter().filter_map(|t| t.table.name.as_deref()).collect();
    assert_eq!((library.tools.len(), names.len()), (40, 40));
    let numbers: Vec<u32> = library.tools.iter().map(|t| t.table.number).collect();
    assert_eq!(numbers, (1..=40).collect::<Vec<_>>());
    assert!(library.tools.iter().all(|t| t.table.presets.iter().any(|p| p.material == "C45")));
    // Each tap has the drill of its core hole, nominal diameter less pitch within 0.05, and each reamer its own 0.2 below.
    let tools: Vec<_> = library.checked().into_iter().flatten().collect();
    let drill = |wanted: f64| {
        let is_it =
            |c: &Cutter| matches!(c, Cutter::Drill { diameter, .. } if (diameter - wanted).abs() <= 0.051);
        tools.iter().any(|tool| tool.name.starts_with("drill") && is_it(&tool.cutter))
    };
    // Whatever goes only into a hole that is there does not cut at its centre; thin mills have a shank that a collet holds.
    for tool in &tools {
        let opens = tool.name.starts_with("reamer") || tool.name.starts_with("boring tool");
        let cuts = !opens && !tool.name.starts_with("face mill");
        assert_eq!(tool.centre_cutting, cuts, "{}", tool.name);
        if let Cutter::EndMill { diameter } = tool.cutter {
            assert_eq!(tool.shank_diameter, diameter.max(6.0), "{}", tool.name);
        }
        // A cutting speed at the width of a chamfer would be more than a spindle has.
        if matches!(tool.cutter, Cutter::Tapered { .. }) {
            let most = tool.limits.max_speed.unwrap() * 60.0 / std::f64::consts::TAU;
            assert!((most - 12_000.0).abs() < 1e-6, "{most}");
        }
    }
    let cones = library.tools.iter().filter(|tool| tool.table.kind == ToolType::Tapered);
    assert!(cones.flat_map(|tool| &tool.table.presets).all(|p| p.cutting_speed.is_none()));
    let mut checked = 0;
    for tool in &tools {
        let wanted = match &tool.cutter {
            Cutter::Tap(tap) => tap.diameter - tap.pitch,
            Cutter::Drill { diameter, .. } if tool.name.starts_with("reamer") => diameter - 0.2,
            _ => continue,
        };
        assert!(drill(wanted), "{}: no drill {wanted}", tool.name);
        checked += 1;
    }
    assert_eq!(checked, 11);
    assert_eq!(read("again.toml", library_toml(&library).unwrap()).unwrap().tools, library.tools);
}

#[test]
fn the_copy_of_an_example_is_the_same() {
    assert!(
        SHOP == include_str!("../../../../../../examples/20_pocket_with_island/shop.toml"),
        "copy it again"
    );
}
