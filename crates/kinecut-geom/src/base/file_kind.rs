//! Kinds of files that are read, each with the most bytes that are read of it.

/// A kind of file: who asks for one says which, and no more is ever read than its limit.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum FileKind {
    /// Job, hole, machine, tool and surface files, configurations, verdicts: TOML, JSON, INI, HAL.
    Text,
    /// Outlines and tool contours: DXF, SVG, JSON.
    Drawing,
    /// NC programs and files of cutter locations.
    Program,
    /// Meshes: STL.
    Mesh,
    /// Bytes of whatever kind that are only hashed.
    Bytes,
}

impl FileKind {
    /// Most bytes that are read of such a file.
    ///
    /// ```
    /// # use kinecut_geom as kinecut;
    /// use kinecut::base::FileKind;
    /// assert!(FileKind::Text.limit() < FileKind::Program.limit());
    /// ```
    pub fn limit(self) -> u64 {
        const MEGABYTE: u64 = 1_000_000;
        match self {
            FileKind::Text => 16 * MEGABYTE,
            FileKind::Drawing => 64 * MEGABYTE,
            FileKind::Program => 256 * MEGABYTE,
            FileKind::Mesh | FileKind::Bytes => 1 << 30,
        }
    }

    /// Of an outline, which is a drawing or a face of a mesh.
    pub fn of_outline(name: &str) -> FileKind {
        let ending = name.rsplit_once('.').map(|(_, ending)| ending);
        let mesh = ending.is_some_and(|e| e.eq_ignore_ascii_case("stl"));
        if mesh { FileKind::Mesh } else { FileKind::Drawing }
    }

    /// As messages name it.
    pub fn word(self) -> &'static str {
        match self {
            FileKind::Text => "text file",
            FileKind::Drawing => "drawing",
            FileKind::Program => "program",
            FileKind::Mesh => "mesh",
            FileKind::Bytes => "file",
        }
    }
}
