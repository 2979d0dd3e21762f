//! Bounds of cutting data by kind of tool: so wide that every tool in every material is inside.
//!
//! The numbers are orders of magnitude that handbooks and catalogues agree on, set down from memory and then widened; none
//! is a recommendation. Where a range is named, it is the widest known one.

use crate::tool::Cutter;

/// Bounds of one tool.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Bounds {
    /// Cutting speed at the largest diameter [m/min].
    pub(super) speed: [f64; 2],
    /// Feed per tooth of a mill, per revolution of a drill [mm].
    pub(super) feed: [f64; 2],
    /// Largest removal rate [cm^3/min].
    pub(super) removal: f64,
}

/// Diameter up to which mills are mostly solid [mm]; larger ones carry inserts.
const SOLID: f64 = 20.0;

/// The bounds of a cutter of a diameter [mm].
pub(super) fn bounds(cutter: &Cutter, diameter: f64) -> Bounds {
    let least = |a: f64, b: f64| if a < b { a } else { b };
    match cutter {
        Cutter::Drill { .. } | Cutter::Tap(_) => Bounds {
            // HSS reamers in hard steel 2 to 5, HSS drills in steel 10 to 40, carbide in aluminium up to 400 m/min
            // (Dubbel, Taschenbuch fuer den Maschinenbau, tables of drilling; Machinery's Handbook, speeds and feeds; from
            // memory). Widened by two and a half each way.
            speed: [0.8, 1000.0],
            // Deep-hole drills from 0.0005 d, twist drills 0.01 to 0.04 d, reamers of several edges up to 0.1 d per
            // revolution (makers' tables, from memory).
            feed: [1e-4 * diameter, 0.2 + 0.1 * diameter],
            removal: REMOVAL,
        },
        _ => Bounds {
            // HSS in nickel alloys from 4 m/min (Machinery's Handbook, from memory); solid carbide in aluminium up to
            // 1500, inserts of PCD in aluminium up to 6000 (makers' tables, from memory). Ball-nose mills work at less
            // than their diameter: their lower bound is that of the whole tool.
            speed: [2.0, if diameter <= SOLID { 1500.0 } else { 6000.0 }],
            // Finishing from 0.001 d, micro mills less; roughing 0.005 to 0.02 d; high-feed mills up to 3 mm (makers'
            // tables, from memory).
            feed: [1e-4 * diameter, least(0.1 + 0.15 * diameter, 4.0)],
            removal: REMOVAL,
        },
    }
}

/// Largest removal rate of any milling machine [cm^3/min]: about ten litres a minute in aluminium structures of aircraft at
/// 100 kW and more (makers of such machines, from memory), twice that here.
const REMOVAL: f64 = 20_000.0;

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_shops_do_is_inside() {
        let mill = Cutter::EndMill { diameter: 12.0 };
        let inside = |b: Bounds, speed: f64, feed: f64| {
            speed > b.speed[0] && speed < b.speed[1] && feed > b.feed[0] && feed < b.feed[1]
        };
        // Titanium, steel, aluminium; and a micro mill at 40000 rev/min.
        for (speed, feed) in [(25.0, 0.03), (150.0, 0.08), (900.0, 0.15)] {
            assert!(inside(bounds(&mill, 12.0), speed, feed));
        }
        assert!(inside(bounds(&mill, 0.3), 37.0, 0.001));
        assert!(inside(bounds(&mill, 63.0), 4000.0, 2.5));
        assert!(!inside(bounds(&mill, 12.0), 150.0, 6.7) && !inside(bounds(&mill, 12.0), 1508.0, 0.05));
    }
}
