//! Tables: columns as wide as their texts, none that is empty.

use super::wrap::{WIDTH, sentence};

/// What is between two columns.
const GAP: &str = "  ";

/// What stands before each row.
const INDENT: &str = "  ";

/// What stands where a row of a column that is shown has no text.
const NOTHING: &str = "-";

/// A column: its head, and the side that its texts are at.
#[derive(Clone, Copy, Debug)]
pub enum Column {
    /// Words.
    Left(&'static str),
    /// Numbers.
    Right(&'static str),
}

/// A table that is being filled.
#[derive(Debug)]
pub struct Table {
    columns: Vec<Column>,
    lines: Vec<Line>,
}

#[derive(Debug)]
enum Line {
    /// One text for each column; an empty one for what there is not.
    Row(Vec<String>),
    /// More of the row before it, where that has several texts in a column.
    More(Vec<String>),
    /// A sentence about the row before it.
    Note(String),
}

impl Column {
    fn head(self) -> &'static str {
        let (Self::Left(head) | Self::Right(head)) = self;
        head
    }

    fn cell(self, text: &str, width: usize) -> String {
        // a width of `format!` has 16 bits: a name may be longer
        let rest = " ".repeat(width.saturating_sub(text.chars().count()));
        match self {
            Self::Left(_) => format!("{text}{rest}"),
            Self::Right(_) => format!("{rest}{text}"),
        }
    }
}

impl Table {
    /// Without rows.
    pub fn new(columns: &[Column]) -> Self {
        Self { columns: columns.to_vec(), lines: Vec::new() }
    }

    /// Adds a row with a text for each column.
    pub fn row<const N: usize>(&mut self, texts: [String; N]) {
        assert_eq!(N, self.columns.len(), "a text for each column");
        self.lines.push(Line::Row(texts.into()));
    }

    /// Adds more texts to the columns of the last row, in a line of their own.
    pub fn more<const N: usize>(&mut self, texts: [String; N]) {
        assert_eq!(N, self.columns.len(), "a text for each column");
        self.lines.push(Line::More(texts.into()));
    }

    /// Adds a sentence.
    pub fn note(&mut self, text: impl Into<String>) {
        self.lines.push(Line::Note(text.into()));
    }

    /// Head and rows. Columns without any text are left out. Where the columns together are wider than a line, each row
    /// begins with its first text on a line of its own.
    pub fn text(&self) -> String {
        let rows = || {
            self.lines.iter().filter_map(|line| match line {
                Line::Row(row) | Line::More(row) => Some(row),
                Line::Note(_) => None,
            })
        };
        let shown: Vec<(usize, Column, usize)> = self
            .columns
            .iter()
            .enumerate()
            .filter_map(|(i, column)| {
                let longest = rows().map(|row| row[i].chars().count()).max().filter(|longest| *longest > 0)?;
                Some((i, *column, longest.max(column.head().chars().count())))
            })
            .collect();
        let width =
            |columns: &[(usize, Column, usize)]| columns.iter().map(|(_, _, width)| GAP.len() + width).sum::<usize>();
        let (own_line, columns) = match shown.split_first() {
            Some((first, others)) if width(&shown) > WIDTH => (Some(first.0), others),
            _ => (None, &shown[..]),
        };
        let mut out = String::new();
        let line = |out: &mut String, cell: &dyn Fn(usize) -> String| {
            if let Some(first) = own_line {
                out.extend([INDENT, &cell(first), "\n", INDENT]);
            }
            let cells: Vec<_> = columns.iter().map(|(i, column, width)| column.cell(&cell(*i), *width)).collect();
            out.extend([format!("{INDENT}{}", cells.join(GAP)).trim_end(), "\n"]);
        };
        line(&mut out, &|i| self.columns[i].head().to_owned());
        for each in &self.lines {
            match each {
                Line::Row(row) => {
                    line(&mut out, &|i| if row[i].is_empty() { NOTHING.to_owned() } else { row[i].clone() });
                }
                Line::More(row) => line(&mut out, &|i| row[i].clone()),
                Line::Note(text) => out += &sentence("    ", text),
            }
        }
        out
    }
}

#[cfg(test)]
mod tests {
    use super::{Column, Table};

    const COLUMNS: [Column; 3] = [Column::Left("name"), Column::Right("number"), Column::Right("other")];

    fn texts<const N: usize>(texts: [&str; N]) -> [String; N] {
        texts.map(str::to_owned)
    }

    #[test]
    fn columns_are_as_wide_as_their_texts_and_none_is_empty() {
        let mut table = Table::new(&COLUMNS);
        table.row(texts(["first", "1.5", ""]));
        table.note("about the first");
        table.row(texts(["second", "", ""]));
        assert_eq!(table.text(), "  name    number\n  first      1.5\n    about the first\n  second       -\n");
    }

    #[test]
    fn rows_that_are_too_long_have_two_lines() {
        let mut table = Table::new(&COLUMNS);
        let name = "n".repeat(90);
        table.row(texts([&name, "1", "22"]));
        assert_eq!(table.text(), format!("  name\n    number  other\n  {name}\n         1     22\n"));
    }

    /// Beyond the widths that `format!` has.
    #[test]
    fn a_text_may_have_any_length() {
        let mut table = Table::new(&COLUMNS);
        let name = "n".repeat(1 << 17);
        table.row(texts([&name, "1", "22"]));
        assert!(table.text().contains(&name));
    }
}
