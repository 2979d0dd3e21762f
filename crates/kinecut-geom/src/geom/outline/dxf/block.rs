//! Blocks of a drawing, and the places at which they are inserted.

use std::collections::BTreeMap;

use glam::{DMat2, DVec2};

use super::entity::Read;
use super::groups::Entity;
use crate::base::Result;
use crate::geom::outline::OutlineEdge;
use crate::geom::outline::freeform::EllipticArc;
use crate::geom::outline::source::Source;

/// Most entities that a drawing may have with all of its blocks inserted.
const MOST: f64 = 1e6;
/// Most blocks within one another.
const DEEPEST: usize = 64;
/// Difference of two scales that is the rounding of their digits.
const ROUND: f64 = 1e-9;

/// A block: its entities, by the first of its own groups.
#[derive(Clone, Debug)]
pub(super) struct Block<'a> {
    /// The entity BLOCK, with its name and base point.
    pub(super) head: Entity<'a>,
    /// Entities within it.
    pub(super) entities: Vec<Entity<'a>>,
}

/// The blocks of a drawing by their names.
#[derive(Clone, Debug, Default)]
pub(super) struct Blocks<'a>(BTreeMap<&'a str, Block<'a>>);

impl<'a> Blocks<'a> {
    /// Of the blocks as the file has them.
    pub(super) fn new(blocks: Vec<Block<'a>>) -> Blocks<'a> {
        Blocks(blocks.into_iter().filter_map(|block| Some((block.head.text(2)?, block))).collect())
    }

    /// The block of an INSERT.
    ///
    /// # Errors
    /// A drawing without that block, or with it in another file.
    pub(super) fn of(&self, source: &Source, insert: &Entity<'_>) -> Result<&Block<'a>> {
        /// Flags of a block that is in another file.
        const EXTERNAL: i64 = 4 | 8 | 16;
        let name = insert.text(2).unwrap_or_default();
        let Some(block) = self.0.get(name) else {
            let what = format!("the drawing has no block {name:?}");
            return Err(source
                .error(insert.offset, what)
                .help("export the drawing again, with its blocks")
                .into());
        };
        let head = Read { source, entity: &block.head, mm: 1.0 };
        if head.flag(70)? & EXTERNAL != 0 && block.entities.is_empty() {
            let what = format!("the block {name:?} is in another file");
            return Err(source.error(insert.offset, what).help("bind the reference into the drawing").into());
        }
        Ok(block)
    }

    /// Counts the entities of a list with all that it inserts, before any is made.
    ///
    /// # Errors
    /// For more than a million, for blocks that are nested too deep, and for one that contains itself.
    pub(super) fn count(&self, source: &Source, entities: &[Entity<'_>]) -> Result<()> {
        let mut known = BTreeMap::new();
        let count = self.counted(source, entities, &mut Vec::new(), &mut known)?;
        if count > MOST {
            let finding = source.whole("the drawing has too many entities with its blocks inserted");
            let finding = finding.value(count, "entities").bound(MOST, "entities");
            return Err(finding.help("export the outline of the part only").into());
        }
        Ok(())
    }

    fn counted<'n>(
        &'n self,
        source: &Source,
        entities: &[Entity<'_>],
        within: &mut Vec<&'n str>,
        known: &mut BTreeMap<&'n str, f64>,
    ) -> Result<f64> {
        let mut count = 0.0;
        for entity in entities {
            count += 1.0;
            if entity.name != "INSERT" {
                continue;
            }
            let read = Read { source, entity, mm: 1.0 };
            if read.flag(67)? == 1 || read.flag(60)? == 1 {
                continue;
            }
            // One that is not there is refused where it is drawn.
            let Some((&name, block)) = self.0.get_key_value(entity.text(2).unwrap_or_default()) else {
                continue;
            };
            if within.contains(&name) {
                let what = format!("the block {name:?} contains itself");
                return Err(source.error(entity.offset, what).help("explode it in the drawing").into());
            }
            let own = match known.get(name) {
                Some(own) => *own,
                None => {
                    if within.len() >= DEEPEST {
                        let what = format!("blocks of the drawing are nested deeper than {DEEPEST} levels");
                        return Err(source
                            .error(entity.offset, what)
                            .help("explode them in the drawing")
                            .into());
                    }
                    within.push(name);
                    let own = self.counted(source, &block.entities, within, known)?;
                    within.pop();
                    known.insert(name, own);
                    own
                }
            };
            let [columns, rows] = [read.flag(70)?.max(1), read.flag(71)?.max(1)];
            count += own * columns as f64 * rows as f64;
        }
        Ok(count)
    }
}

/// A place of a block's entities in the drawing: first turned, scaled and mirrored, then moved [mm].
#[derive(Clone, Copy, Debug)]
pub(super) struct Placement<'a> {
    turned: DMat2,
    moved: DVec2,
    /// Layer of what is on layer 0 within the block.
    pub(super) layer: Option<&'a str>,
}

impl<'a> Placement<'a> {
    /// That of the drawing itself.
    pub(super) const DRAWING: Placement<'static> =
        Placement { turned: DMat2::IDENTITY, moved: DVec2::ZERO, layer: None };

    /// Those of an INSERT within this one: one for each row and column.
    ///
    /// Source: Autodesk, DXF Reference (2012), INSERT and BLOCK.
    pub(super) fn inserted<'n>(
        &self,
        source: &Source,
        insert: &Entity<'_>,
        block: &Block<'_>,
        (mm, layer): (f64, &'n str),
    ) -> Result<Vec<Placement<'n>>> {
        let read = Read { source, entity: insert, mm };
        let head = Read { source, entity: &block.head, mm };
        let base = DVec2::new(head.one_or(10, 0.0)?, head.one_or(20, 0.0)?) * mm;
        let scale = DVec2::new(read.one_or(41, 1.0)?, read.one_or(42, 1.0)?);
        if scale.x == 0.0 || scale.y == 0.0 {
            let finding = read.error("an INSERT of size 0 shows nothing").value(0.0, "scale");
            return Err(finding.help("take it out of the drawing").into());
        }
        let turn = DMat2::from_angle(read.one_or(50, 0.0)?.to_radians());
        // From below X is mirrored.
        let seen = DMat2::from_diagonal(DVec2::new(if read.mirrored()? { -1.0 } else { 1.0 }, 1.0));
        let own = seen * turn * DMat2::from_diagonal(scale);
        let [columns, rows] = [read.flag(70)?.max(1), read.flag(71)?.max(1)];
        let apart = DVec2::new(read.one_or(44, 0.0)?, read.one_or(45, 0.0)?) * mm;
        let at = read.point(10)?;
        let mut places = Vec::new();
        for row in 0..rows {
            for column in 0..columns {
                let cell = seen * (at + turn * (DVec2::new(column as f64, row as f64) * apart));
                let moved = self.turned * (cell - own * base) + self.moved;
                places.push(Placement { turned: self.turned * own, moved, layer: Some(layer) });
            }
        }
        Ok(places)
    }

    /// Largest stretch of a length.
    pub(super) fn stretch(&self) -> f64 {
        let [a, b] = [self.turned.x_axis, self.turned.y_axis];
        // The larger singular value.
        let (sum, apart) = (0.5 * (a.length_squared() + b.length_squared()), a.dot(b));
        let half = 0.5 * (a.length_squared() - b.length_squared());
        (sum + half.hypot(apart)).sqrt()
    }

    /// Edges in the drawing; arcs that become elliptic leave their curve by at most `tolerance` [mm].
    ///
    /// # Errors
    /// Those of arcs that become elliptic.
    pub(super) fn edges(&self, edges: Vec<OutlineEdge>, tolerance: f64) -> Result<Vec<OutlineEdge>> {
        let point = |p: DVec2| self.turned * p + self.moved;
        let [a, b] = [self.turned.x_axis, self.turned.y_axis];
        let size = a.length();
        let keeps_circles =
            (size - b.length()).abs() <= ROUND * size && a.dot(b).abs() <= ROUND * size * size;
        let mut placed = Vec::with_capacity(edges.len());
        for edge in edges {
            let Some(t) = edge.turn else {
                placed.push(OutlineEdge { start: point(edge.start), end: point(edge.end), ..edge });
                continue;
            };
            if keeps_circles {
                let centre = point(t.centre);
                let first = self.turned * DVec2::from_angle(t.from);
                let sweep = t.sweep * self.turned.determinant().signum();
                let arc = OutlineEdge::arc(centre, size * t.radius, first.to_angle(), sweep);
                placed.push(OutlineEdge { start: point(edge.start), end: point(edge.end), ..arc });
                continue;
            }
            let ellipse = EllipticArc {
                centre: point(t.centre),
                major: t.radius * a,
                minor: t.radius * b,
                from: t.from,
                sweep: t.sweep,
            };
            placed.extend(ellipse.edges(tolerance)?);
        }
        Ok(placed)
    }
}
