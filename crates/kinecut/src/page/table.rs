//! Tables: columns, rows, cells.

use serde::{Deserialize, Serialize};

/// A table: caption, columns, rows, notes.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Table {
    /// Subject of the table.
    pub caption: String,
    /// Column heads.
    pub columns: Vec<Column>,
    /// Rows; the first cell heads its row.
    pub rows: Vec<Row>,
    /// Remarks below the table.
    pub notes: Vec<String>,
}

impl Table {
    /// A table without rows. Its columns are divided by `;`, a unit in brackets is that of numbers, `[]` of such without one.
    ///
    /// ```
    /// use kinecut::page::{Column, Table};
    /// let table = Table::new("Ways", "Way; Bad length [mm]; Rows []");
    /// let columns = [Column::text("Way"), Column::number("Bad length", "mm"), Column::number("Rows", "")];
    /// assert_eq!(table.columns, columns);
    /// ```
    pub fn new(caption: impl Into<String>, columns: &str) -> Table {
        let column = |head: &str| match head.strip_suffix(']').and_then(|head| head.rsplit_once(" [")) {
            Some((title, unit)) => Column::number(title, unit),
            None => Column::text(head),
        };
        let columns = columns.split("; ").map(column).collect();
        Table { caption: caption.into(), columns, ..Table::default() }
    }

    /// With one more remark.
    #[must_use]
    pub fn note(mut self, note: impl Into<String>) -> Table {
        self.notes.push(note.into());
        self
    }

    /// With more rows.
    #[must_use]
    pub fn rows(mut self, rows: impl IntoIterator<Item = Row>) -> Table {
        self.rows.extend(rows);
        self
    }
}

/// Alignment of a column.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Align {
    /// Words.
    #[default]
    Left,
    /// Numbers.
    Right,
}

/// Head of a column.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Column {
    /// Name.
    pub title: String,
    /// Unit; may be empty.
    pub unit: String,
    /// Alignment of its cells.
    pub align: Align,
}

impl Column {
    /// A column of words.
    pub fn text(title: impl Into<String>) -> Column {
        Column { title: title.into(), unit: String::new(), align: Align::Left }
    }

    /// A column of numbers with a unit ("" for none).
    pub fn number(title: impl Into<String>, unit: impl Into<String>) -> Column {
        Column { title: title.into(), unit: unit.into(), align: Align::Right }
    }
}

/// A row of a table.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Row {
    /// Cells in the order of the columns; missing ones stay empty.
    pub cells: Vec<Cell>,
    /// Line of the program, from 0, to which a click on the row goes; the programs of several setups count on.
    pub block: Option<u32>,
    /// That line as its own program counts, from 1, where it is not `block` and one.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub line: Option<u32>,
}

impl Row {
    /// A row without a link.
    pub fn new(cells: Vec<Cell>) -> Row {
        Row { cells, block: None, line: None }
    }

    /// With a link to a program line, from 0.
    #[must_use]
    pub fn at(mut self, block: u32) -> Row {
        self.block = Some(block);
        self
    }
}

/// Whether a cell is as it should be.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Mark {
    /// Nothing to say.
    #[default]
    Plain,
    /// Checked and right.
    Right,
    /// Wrong.
    Wrong,
}

/// One cell.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct Cell {
    /// Content of the cell.
    pub text: String,
    /// Text printed here before it was corrected; shown struck out above `text`.
    pub printed: Option<String>,
    /// Whether it is right.
    pub mark: Mark,
}

impl Cell {
    /// A plain cell.
    pub fn new(text: impl Into<String>) -> Cell {
        Cell { text: text.into(), printed: None, mark: Mark::Plain }
    }

    /// A cell that is wrong.
    pub fn wrong(text: impl Into<String>) -> Cell {
        Cell { mark: Mark::Wrong, ..Cell::new(text) }
    }

    /// A cell that was checked and is right.
    pub fn right(text: impl Into<String>) -> Cell {
        Cell { mark: Mark::Right, ..Cell::new(text) }
    }

    /// A corrected value with what was printed; an empty `printed` means that it was left out.
    pub fn corrected(text: impl Into<String>, printed: impl Into<String>) -> Cell {
        Cell { printed: Some(printed.into()), mark: Mark::Right, ..Cell::new(text) }
    }
}

impl<T: Into<String>> From<T> for Cell {
    fn from(text: T) -> Cell {
        Cell::new(text)
    }
}
