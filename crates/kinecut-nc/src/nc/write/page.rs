//! The lines of a text, with the item each was written for.

/// Lines under construction.
#[derive(Debug, Default)]
pub(super) struct Page {
    pub(super) lines: Vec<Line>,
    /// The item being written.
    pub(super) item: Option<u32>,
}

#[derive(Debug)]
pub(super) struct Line {
    pub(super) text: String,
    pub(super) item: Option<u32>,
    /// Whether it is a block, which gets a number.
    pub(super) block: bool,
}

/// Step of block numbers: room for blocks put in by hand.
const STEP: usize = 10;

impl Page {
    /// A line that is no block.
    pub(super) fn line(&mut self, text: String) {
        self.lines.push(Line { text, item: self.item, block: false });
    }

    /// A block.
    pub(super) fn block(&mut self, text: String) {
        self.lines.push(Line { text, item: self.item, block: true });
    }

    /// Number of lines.
    pub(super) fn len(&self) -> usize {
        self.lines.len()
    }

    /// Takes the last lines back.
    pub(super) fn truncate(&mut self, lines: usize) {
        self.lines.truncate(lines);
    }

    /// Moves the lines from `from` to the end up to before line `to`.
    pub(super) fn bring_up(&mut self, from: usize, to: usize) {
        let moved = self.lines.len() - from;
        self.lines[to..].rotate_right(moved);
    }

    /// The text, and for each line its item. Block numbers begin anew when the largest is reached.
    pub(super) fn text(self, most_blocks: Option<usize>) -> (String, Vec<Option<u32>>) {
        let blocks = self.lines.iter().filter(|l| l.block).count();
        let step = |most: usize| if blocks.saturating_mul(STEP) <= most { STEP } else { 1 };
        let mut number = 0;
        let mut text = String::with_capacity(self.lines.iter().map(|l| l.text.len() + 10).sum());
        let mut items = Vec::with_capacity(self.lines.len());
        for line in self.lines {
            if let (true, Some(most)) = (line.block, most_blocks) {
                number += step(most);
                if number > most {
                    number = step(most);
                }
                text.push('N');
                text.push_str(&number.to_string());
                text.push(' ');
            }
            text.push_str(&line.text);
            text.push('\n');
            items.push(line.item);
        }
        (text, items)
    }

    /// The same with every line counted from 0, but those that continue the one before (they begin with a blank).
    pub(super) fn counted(self, numbers: bool) -> (String, Vec<Option<u32>>) {
        let mut text = String::with_capacity(self.lines.iter().map(|l| l.text.len() + 8).sum());
        let mut items = Vec::with_capacity(self.lines.len());
        let mut number = 0usize;
        for line in self.lines {
            if numbers && !line.text.starts_with(' ') {
                text.push_str(&number.to_string());
                text.push(' ');
                number += 1;
            }
            text.push_str(&line.text);
            text.push('\n');
            items.push(line.item);
        }
        (text, items)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_begin_anew_at_the_limit() {
        let mut page = Page::default();
        for i in 0..5 {
            page.item = Some(i);
            page.block("G1".to_owned());
        }
        page.line("( x )".to_owned());
        let (text, items) = page.text(Some(3));
        assert_eq!(text, "N1 G1\nN2 G1\nN3 G1\nN1 G1\nN2 G1\n( x )\n");
        assert_eq!(items.len(), 6);
    }
}
