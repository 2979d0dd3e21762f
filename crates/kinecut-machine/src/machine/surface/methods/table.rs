//! Known processes by surface and by the methods of their lines (after Fedotenok).

/// A process that makes a surface.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct KnownProcess {
    /// Names, the usual one first.
    pub name: &'static str,
    /// Motions, as [`super::notation`] writes them; empty where the tool leaves them open.
    pub motions: &'static str,
}

/// The processes of one kind of surface. A line by tracing is always there; the rows say what makes the other.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct MethodsRow {
    /// Name of the surface in the table.
    pub title: &'static str,
    /// Names of the surfaces in the catalogue.
    pub surfaces: &'static [&'static str],
    /// Both lines by tracing.
    pub tracing: &'static [KnownProcess],
    /// One or both lines by copying.
    pub copying: &'static [KnownProcess],
    /// A line by touching.
    pub touching: &'static [KnownProcess],
    /// A line by rolling.
    pub rolling: &'static [KnownProcess],
}

const fn p(name: &'static str, motions: &'static str) -> KnownProcess {
    KnownProcess { name, motions }
}

const TABLE: &[MethodsRow] = &[
    MethodsRow {
        title: "plane",
        surfaces: &["plane", "plane-facing"],
        tracing: &[p("planing", "v(P1)s(P2)"), p("facing", "v(B1)s(P2)")],
        copying: &[p("broad planing, broaching", "v(P1)")],
        touching: &[
            p("face milling, peripheral milling", "v(B1)s(P2)"),
            p("surface grinding", "v(B1)s(P2)s(P3)"),
        ],
        rolling: &[],
    },
    MethodsRow {
        title: "cylinder",
        surfaces: &["cylinder"],
        tracing: &[p("turning, boring", "v(B1)s(P2)")],
        copying: &[p("form turning", "v(B1)"), p("drawing, broaching", "v(P1)"), p("reaming", "v(B1)s(P2)")],
        touching: &[p("cylindrical grinding, orbital milling", "v(B1)s(B2)s(P3)")],
        rolling: &[],
    },
    MethodsRow {
        title: "cone",
        surfaces: &["cone"],
        tracing: &[
            p("taper turning with swivelled slide", "v(B1)s(P2)"),
            p("contour turning", "v(B1)s(P2P3)"),
        ],
        copying: &[p("form turning, countersinking", "v(B1)")],
        touching: &[p("taper grinding", "v(B1)s(B2)s(P3)")],
        rolling: &[],
    },
    MethodsRow {
        title: "sphere, torus",
        surfaces: &["sphere", "sphere-ring", "torus"],
        tracing: &[p("radius turning", "v(B1)s(B2)"), p("ring whirling", "v(B1)s(B2)")],
        copying: &[p("form turning", "v(B1)")],
        touching: &[p("ball-end milling", ""), p("cup-wheel grinding", "v(B1)s(B2)")],
        rolling: &[],
    },
    MethodsRow {
        title: "surface of revolution",
        surfaces: &["revolution"],
        tracing: &[p("contour turning", "v(B1)s(P2P3)")],
        copying: &[p("form turning", "v(B1)")],
        touching: &[p("profile grinding", "v(B1)s(B2)")],
        rolling: &[],
    },
    MethodsRow {
        title: "extrusion",
        surfaces: &["extrusion"],
        tracing: &[p("contour planing", "v(P1)s(P2P3)")],
        copying: &[p("form planing, broaching", "v(P1)"), p("wire erosion", "s(P1P2)")],
        touching: &[p("end milling", "v(B1)s(P2P3)"), p("form milling", "v(B1)s(P2)")],
        rolling: &[],
    },
    MethodsRow {
        title: "ruled surface",
        surfaces: &["ruled", "hyperbolic-paraboloid"],
        tracing: &[p("point tracing", "")],
        copying: &[p("wire erosion in four axes", "s(P1P2P3P4)")],
        touching: &[p("flank milling in five axes", "v(B1)s(P2P3P4B5B6)")],
        rolling: &[],
    },
    MethodsRow {
        title: "thread, screw surface",
        surfaces: &["right-helicoid", "inclined-helicoid", "screw"],
        tracing: &[p("thread turning", "v(B1P2)")],
        copying: &[
            p("thread turning with a formed insert", "v(B1P2)"),
            p("tapping, threading die", "v(B1P2)"),
        ],
        touching: &[p("thread milling, whirling, thread grinding", "v(B1)s(B2P3)")],
        rolling: &[p("thread rolling", ""), p("worm hobbing", "v(B1B2)s(P3)")],
    },
    MethodsRow {
        title: "cylindrical cam",
        surfaces: &["cylindrical-cam"],
        tracing: &[],
        copying: &[],
        touching: &[p("milling with a cutter of the roller's radius", "v(B1)s(B2P3)")],
        rolling: &[],
    },
    MethodsRow {
        title: "involute cylinder",
        surfaces: &["involute-cylinder"],
        tracing: &[p("unwinding point", "v(P1)s(B2P3)")],
        copying: &[p("form broaching", "v(P1)"), p("form disc milling with indexing", "v(B1)s(P2)")],
        touching: &[p("grinding with a plane wheel", "v(B1)s(B2P3)s(P4)")],
        rolling: &[
            p("rack planing", "v(P1)s(B2P3)"),
            p("pinion shaping", "v(P1)s(B2B3)"),
            p("hobbing", "v(B1B2)s(P3)"),
            p("hobbing of helical gears", "v(B1B2)s(P3B4)"),
            p("skiving", "v(B1B2)s(P3)"),
        ],
    },
    MethodsRow {
        title: "hyperboloid of one sheet",
        surfaces: &["hyperboloid"],
        tracing: &[p("turning with a skew slide", "v(B1)s(P2)")],
        copying: &[p("turning with a skew straight edge", "v(B1)")],
        touching: &[p("dressing of regulating wheels", "")],
        rolling: &[],
    },
    MethodsRow {
        title: "scroll",
        surfaces: &["scroll"],
        tracing: &[p("slow turning of a spiral", "s(B1P2)")],
        copying: &[p("straight edge on a spiral", "s(B1P2)")],
        touching: &[p("end milling", "v(B1)s(B2P3)")],
        rolling: &[],
    },
    MethodsRow {
        title: "elliptic cylinder, polygon",
        surfaces: &["elliptic-cylinder"],
        tracing: &[],
        copying: &[p("polygon turning with a fly cutter, ratio 1 to 2", "v(B1B2)")],
        touching: &[p("milling with linked turning of the work", "v(B1)s(B2P3)")],
        rolling: &[],
    },
];

/// The table of processes.
pub fn methods_table() -> &'static [MethodsRow] {
    TABLE
}

impl MethodsRow {
    /// The row of a surface of the catalogue.
    ///
    /// ```
    /// # use kinecut_machine as kinecut;
    /// use kinecut::machine::surface::MethodsRow;
    /// let gear = MethodsRow::of("involute-cylinder").unwrap();
    /// assert_eq!(gear.rolling[2].name, "hobbing");
    /// assert_eq!(gear.rolling[2].motions, "v(B1B2)s(P3)");
    /// ```
    pub fn of(surface: &str) -> Option<&'static MethodsRow> {
        TABLE.iter().find(|row| row.surfaces.contains(&surface))
    }
}
