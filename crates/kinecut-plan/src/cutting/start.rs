//! Values to start with.

use super::{Material, MaterialGroup, MilledChip, stickout_share};

/// Material of the edges of a tool.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum EdgeMaterial {
    /// Cemented carbide, mostly coated.
    Carbide,
    /// High-speed steel.
    Hss,
}

impl EdgeMaterial {
    /// Its name.
    pub fn name(self) -> &'static str {
        match self {
            EdgeMaterial::Carbide => "carbide",
            EdgeMaterial::Hss => "HSS",
        }
    }

    /// Modulus of elasticity of a tool that is made of it (N/mm2).
    pub fn elasticity(self) -> f64 {
        match self {
            EdgeMaterial::Carbide => 600_000.0,
            EdgeMaterial::Hss => 210_000.0,
        }
    }
}

/// The cut for which values are wanted.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum StartCut {
    /// An end mill in its full width.
    Slot,
    /// An end mill within an arc of engagement [rad].
    Side(f64),
    /// A face mill with inserts.
    Face,
    /// A cutter that breaks an edge.
    Edge,
    /// A thread mill; the feed is that of its edge.
    ThreadMill,
    /// A drill in the solid.
    Drill,
    /// A spot drill or countersink.
    Spot,
    /// A reamer.
    Ream,
    /// A tap: its feed is its pitch.
    Tap,
}

/// Values for a row of materials: cutting speeds (m/min), feeds in diameters.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct StartRow {
    /// Of carbide mills in full width, and with a tenth of the diameter or less.
    pub(super) mill: [f64; 2],
    /// Feed per tooth of mills.
    pub(super) tooth: f64,
    /// Of HSS drills.
    pub(super) drill: f64,
    /// Feed per revolution of drills and reamers.
    pub(super) drill_feed: f64,
    /// Of carbide drills.
    pub(super) carbide_drill: f64,
    /// Of taps.
    pub(super) tap: f64,
    /// Of reamers.
    pub(super) ream: f64,
}

/// A factor on a feed, and its reason.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct StartChange {
    /// The reason: "thin chip".
    pub what: &'static str,
    /// The factor.
    pub factor: f64,
}

/// Values to start with.
#[derive(Clone, Debug, PartialEq)]
pub struct StartData {
    /// Cutting speed (m/min).
    pub cutting_speed: f64,
    /// The row from which it is: "C45, carbide, full width".
    pub row: String,
    /// Feed per tooth of mills, per revolution of drills and reamers [mm], with all changes; taps have their pitch.
    pub feed: Option<f64>,
    /// The same before them [mm].
    pub plain_feed: Option<f64>,
    /// Factors on the feed.
    pub changes: Vec<StartChange>,
}

/// Share of the speed of a carbide mill at which one of high-speed steel runs.
const HSS_MILL: f64 = 0.3;
/// Largest feed per tooth of an end mill [mm].
const MOST_PER_TOOTH: f64 = 0.12;
/// Diameter of an end mill above which its feed per tooth grows no more [mm].
const WIDEST: f64 = 16.0;
/// Diameter of a drill above which its feed per revolution grows no more [mm].
const WIDEST_DRILL: f64 = 20.0;
/// Width of cut up to which the higher speed is taken, in diameters.
const NARROW: f64 = 0.1;

impl Material {
    /// Whether there are values to start with.
    pub fn has_start(&self) -> bool {
        self.start.is_some()
    }

    /// Values to start with for a tool of a diameter [mm] that sticks out of its holder by a length [mm], where that is known; `None`
    /// for materials without them.
    ///
    /// ```
    /// # use kinecut_plan as kinecut;
    /// use kinecut::cutting::{EdgeMaterial, Material, StartCut};
    /// let c45 = Material::of("C45").unwrap();
    /// let side = c45.start(StartCut::Side(36.87_f64.to_radians()), EdgeMaterial::Carbide, 10.0, None).unwrap();
    /// assert_eq!(side.cutting_speed, 200.0);
    /// // 0.006 x 10, and 1 / sin of the arc for the thin chip.
    /// assert!((side.feed.unwrap() - 0.1).abs() < 1e-6);
    /// let drill = c45.start(StartCut::Drill, EdgeMaterial::Hss, 6.6, None).unwrap();
    /// assert_eq!(drill.cutting_speed, 25.0);
    /// assert!((drill.feed.unwrap() - 0.132).abs() < 1e-12);
    /// ```
    pub fn start(
        &self,
        cut: StartCut,
        edge: EdgeMaterial,
        diameter: f64,
        stickout: Option<f64>,
    ) -> Option<StartData> {
        let row = self.start.as_ref()?;
        // An angle of two decimals is the one that is meant.
        let is_narrow = |arc: f64| (0.5 * arc).sin().powi(2) <= NARROW + 1e-5;
        let mill = |narrow: bool| {
            let carbide = row.mill[usize::from(narrow)];
            if edge == EdgeMaterial::Hss { HSS_MILL * carbide } else { carbide }
        };
        let drill = if edge == EdgeMaterial::Carbide { row.carbide_drill } else { row.drill };
        let (cutting_speed, words) = match cut {
            StartCut::Slot => (mill(false), "full width"),
            StartCut::Side(arc) if is_narrow(arc) => (mill(true), "a tenth of the diameter wide at most"),
            StartCut::Side(_) => (mill(false), "side milling"),
            StartCut::Face => (mill(true), "face mill"),
            StartCut::Edge => (mill(true), "edges"),
            StartCut::ThreadMill => (mill(true), "thread mill"),
            StartCut::Drill => (drill, "drill"),
            StartCut::Spot => (SPOT * drill, "spot drill"),
            StartCut::Ream => (row.ream, "reamer"),
            StartCut::Tap => (row.tap, "tap"),
        };
        let tooth = (row.tooth * diameter.min(WIDEST)).min(MOST_PER_TOOTH);
        let turn = row.drill_feed * diameter.min(WIDEST_DRILL);
        let plain_feed = match cut {
            StartCut::Face => Some(self.per_insert()),
            StartCut::Slot | StartCut::Side(_) | StartCut::Edge | StartCut::ThreadMill => Some(tooth),
            StartCut::Drill | StartCut::Spot | StartCut::Ream => Some(turn),
            StartCut::Tap => None,
        };
        let mut changes = Vec::new();
        let mut change = |what, factor: f64| {
            if factor != 1.0 {
                changes.push(StartChange { what, factor });
            }
        };
        match cut {
            StartCut::Slot => change("full width", SLOT_SHARE),
            StartCut::Side(arc) => change("thin chip", MilledChip::thinning(arc)),
            StartCut::Edge => change("edge", EDGE_SHARE),
            StartCut::ThreadMill => change("thread", EDGE_SHARE),
            StartCut::Spot => change("spot", SPOT),
            StartCut::Face | StartCut::Drill | StartCut::Ream | StartCut::Tap => {}
        }
        if let (Some(length), StartCut::Slot | StartCut::Side(_) | StartCut::ThreadMill) = (stickout, cut) {
            change("stickout", stickout_share(diameter, length));
        }
        let factor: f64 = changes.iter().map(|c| c.factor).product();
        Some(StartData {
            cutting_speed,
            row: format!("{}, {}, {words}", self.name, edge.name()),
            feed: plain_feed.map(|feed| feed * factor),
            plain_feed,
            changes,
        })
    }

    /// Feed per tooth of a face mill with inserts [mm].
    fn per_insert(&self) -> f64 {
        match self.group {
            MaterialGroup::Stainless => 0.10,
            MaterialGroup::Iron => 0.15,
            _ => 0.12,
        }
    }
}

/// Share of a drill's speed and feed at which a spot drill runs.
const SPOT: f64 = 0.8;
/// Share of its feed per tooth at which an end mill cuts in its full width.
const SLOT_SHARE: f64 = 0.8;
/// Share of its feed per tooth at which a cutter breaks edges or mills threads.
const EDGE_SHARE: f64 = 0.5;
