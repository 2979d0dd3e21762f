//! The text of a DXF file as group codes with values, and its entities.
//!
//! A DXF text is pairs of lines: a number that says what the value is, and the value. Sections begin with `0 SECTION`,
//! entities with `0 NAME`. Read are the HEADER's `$INSUNITS`, the section BLOCKS and the section ENTITIES; tables and objects
//! are passed over.
//!
//! Source: Autodesk, DXF Reference (2012), group codes and ENTITIES section.

use super::block::Block;
use crate::base::Result;
use crate::geom::outline::source::Source;

/// A group: code, value, first byte of the value's line.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Group<'a> {
    pub(super) code: i32,
    pub(super) value: &'a str,
    pub(super) offset: usize,
}

/// An entity: its name, first byte, groups up to the next entity.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Entity<'a> {
    pub(super) name: &'a str,
    pub(super) offset: usize,
    pub(super) groups: Vec<Group<'a>>,
}

/// Contents read of a file.
pub(super) struct Groups<'a> {
    /// `$INSUNITS`, if given.
    pub(super) units: Option<i64>,
    pub(super) entities: Vec<Entity<'a>>,
    pub(super) blocks: Vec<Block<'a>>,
}

impl<'a> Entity<'a> {
    /// The text of its first group of a code.
    pub(super) fn text(&self, code: i32) -> Option<&'a str> {
        self.groups.iter().find(|group| group.code == code).map(|group| group.value)
    }
}

/// Splits a text.
pub(super) fn groups<'a>(text: &'a str, source: &Source) -> Result<Groups<'a>> {
    const EXPORT: &str = "export the drawing as DXF (text) again";
    let mut lines = Lines { text, offset: 0 };
    let mut found = Groups { units: None, entities: Vec::new(), blocks: Vec::new() };
    let mut in_block = false;
    let mut section: Option<&str> = None;
    let mut variable = "";
    let mut names_section = false;
    let mut any_entities = false;
    let mut ended = false;
    while let Some((at, line)) = lines.next() {
        let Ok(code) = line.trim().parse::<i32>() else {
            if line.trim().is_empty() && lines.rest_is_blank() {
                break;
            }
            let shown: String = line.trim().chars().take(20).collect();
            return Err(source
                .error(at, format!("a DXF group code is expected, not {shown:?}"))
                .help(EXPORT)
                .into());
        };
        let Some((offset, value)) = lines.next() else {
            return Err(source.error(at, "the DXF file ends in a group").help(EXPORT).into());
        };
        let value = value.trim();
        let group = Group { code, value, offset };
        match (code, value) {
            (999, _) => {}
            (0, "SECTION") => (names_section, section) = (true, Some("")),
            (0, "ENDSEC") => section = None,
            (0, "EOF") => {
                ended = true;
                break;
            }
            (2, name) if names_section => {
                section = Some(name);
                any_entities |= name == "ENTITIES";
                names_section = false;
            }
            _ => match section {
                Some("HEADER") if code == 9 => variable = value,
                Some("HEADER") if code == 70 && variable == "$INSUNITS" => {
                    found.units = Some(whole(source, &group)?);
                }
                Some("BLOCKS") if code == 0 && value == "BLOCK" => {
                    let head = Entity { name: value, offset, groups: Vec::new() };
                    found.blocks.push(Block { head, entities: Vec::new() });
                    in_block = true;
                }
                Some("BLOCKS") if code == 0 && value == "ENDBLK" => in_block = false,
                Some("BLOCKS") if in_block => {
                    let Some(block) = found.blocks.last_mut() else { continue };
                    if code == 0 {
                        block.entities.push(Entity { name: value, offset, groups: Vec::new() });
                    } else {
                        block.entities.last_mut().unwrap_or(&mut block.head).groups.push(group);
                    }
                }
                Some("ENTITIES") if code == 0 => {
                    found.entities.push(Entity { name: value, offset, groups: Vec::new() });
                }
                Some("ENTITIES") => {
                    if let Some(entity) = found.entities.last_mut() {
                        entity.groups.push(group);
                    }
                }
                _ => {}
            },
        }
    }
    if !any_entities {
        return Err(source.whole("the DXF file has no section ENTITIES").help(EXPORT).into());
    }
    if !ended && section.is_some() {
        let message = "the DXF file ends before its section ENTITIES does";
        return Err(source.error(text.len().saturating_sub(1), message).help(EXPORT).into());
    }
    Ok(found)
}

/// The value of a group as a finite number.
pub(super) fn number(source: &Source, group: &Group<'_>) -> Result<f64> {
    match group.value.parse::<f64>() {
        Ok(x) if x.is_finite() => Ok(x),
        _ => Err(not_a_number(source, group)),
    }
}

/// The value of a group as a whole number.
pub(super) fn whole(source: &Source, group: &Group<'_>) -> Result<i64> {
    group.value.parse::<i64>().map_err(|_| not_a_number(source, group))
}

fn not_a_number(source: &Source, group: &Group<'_>) -> crate::base::Error {
    let shown: String = group.value.chars().take(20).collect();
    let what = format!("group {} of a DXF entity is not a number: {shown:?}", group.code);
    source.error(group.offset, what).help("export the drawing again").into()
}

struct Lines<'a> {
    text: &'a str,
    offset: usize,
}

impl<'a> Lines<'a> {
    fn rest_is_blank(&self) -> bool {
        self.text[self.offset..].trim().is_empty()
    }
}

impl<'a> Iterator for Lines<'a> {
    type Item = (usize, &'a str);

    fn next(&mut self) -> Option<(usize, &'a str)> {
        let rest = &self.text[self.offset..];
        if rest.is_empty() {
            return None;
        }
        let at = self.offset;
        let line = rest.split_inclusive('\n').next().unwrap_or(rest);
        self.offset += line.len();
        Some((at, line.trim_end_matches(['\n', '\r'])))
    }
}
