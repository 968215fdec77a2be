//! The time series of a case as CSV.

use super::{APPROACH, Column, Columns, all_rows};
use crate::capture::{CaseResult, Study};
use crate::scenario::Scenario;
use std::io::{self, Write};

/// Writes a header row with units, then one row per sample: time, phase and the [`Columns`].
///
/// # Errors
/// Those of the writer.
pub fn write_csv(scenario: &Scenario, study: &Study, case: &CaseResult, to: impl Write) -> io::Result<()> {
    CsvWriter::new(scenario, study).write(case, to)
}

/// The time series of the cases of a study. Where these have the approach in common, the robot's numbers are formatted once.
#[derive(Debug)]
pub struct CsvWriter<'a> {
    scenario: &'a Scenario,
    study: &'a Study,
    /// What the rows of the common approach begin with, up to the last of the robot's state and tips.
    beginnings: Texts,
    text: Text,
}

impl<'a> CsvWriter<'a> {
    /// Of this study.
    #[must_use]
    pub fn new(scenario: &'a Scenario, study: &'a Study) -> Self {
        Self { scenario, study, beginnings: Texts::default(), text: Text::new() }
    }

    /// As [`write_csv`] for one of its cases.
    ///
    /// # Errors
    /// Those of the writer.
    pub fn write(&mut self, case: &CaseResult, to: impl Write) -> io::Result<()> {
        let columns = Columns::of(self.scenario, case);
        let of_robot = columns.list().iter().take_while(|column| matches!(column.group, "state" | "tips")).count();
        let mut csv = csv::Writer::from_writer(to);
        let names = ["time [s]".to_owned(), "phase".to_owned()];
        csv.write_record(names.into_iter().chain(columns.list().iter().map(Column::heading)))?;
        let mut to = csv.into_inner().map_err(csv::IntoInnerError::into_error)?;
        let mut values = Vec::new();
        let Self { beginnings, text, .. } = self;
        if case.approach.is_none() {
            beginnings.expect(self.study.approach.sample_count(), ROOM * (of_robot + 1) + APPROACH.len() + 1);
        }
        text.end = 0;
        all_rows(self.study, case).enumerate().try_for_each(|(index, row)| {
            let row = row?;
            columns.values(&row, &mut values);
            let (robot, others) = values.split_at(of_robot);
            let is_common = case.approach.is_none() && row.phase == APPROACH;
            if let Some(beginning) = beginnings.get(index).filter(|_| is_common) {
                text.push(beginning);
            } else {
                let start = text.end;
                text.push_numbers(&[row.time]);
                text.push(row.phase.as_bytes());
                text.push(b",");
                text.push_numbers(robot);
                if is_common {
                    beginnings.push(&text.as_bytes()[start..]);
                }
            }
            text.push_numbers(others);
            text.end_line();
            if text.end < BLOCK { Ok(()) } else { text.write(&mut to) }
        })?;
        text.write(&mut to)?;
        to.flush()
    }
}

/// Texts, one after the other.
#[derive(Debug, Default)]
struct Texts {
    bytes: Vec<u8>,
    ends: Vec<usize>,
}

impl Texts {
    /// Memory of all, in bytes: some ten thousand rows.
    const MOST: usize = 1 << 24;

    /// Takes memory for so many of at most this length, if these are the first; pages that are not written to are not used.
    fn expect(&mut self, count: usize, longest: usize) {
        if self.ends.is_empty() {
            self.bytes.reserve(Self::MOST.min(count.saturating_mul(longest)));
        }
    }

    /// Keeps one more, as long as there is memory.
    fn push(&mut self, text: &[u8]) {
        if self.bytes.len() < Self::MOST {
            self.bytes.extend_from_slice(text);
            self.ends.push(self.bytes.len());
        }
    }

    fn get(&self, index: usize) -> Option<&[u8]> {
        let end = *self.ends.get(index)?;
        let start = index.checked_sub(1).map_or(0, |before| self.ends[before]);
        Some(&self.bytes[start..end])
    }
}

/// Bytes that are written at once.
const BLOCK: usize = 1 << 16;

/// Numbers that are formatted before the first of their texts is copied. The formatter writes a text by parts, and what reads it as a
/// whole waits until these are in the cache, which takes two thirds of the formatter's time unless there is other work until then.
const AT_ONCE: usize = 16;

/// The longest text of a number, and the comma after it.
const ROOM: usize = 25;

/// Lines that are yet to be written: the bytes up to an end, and behind it memory for more, which is not cleared again for each.
#[derive(Debug)]
struct Text {
    bytes: Vec<u8>,
    end: usize,
}

impl Text {
    fn new() -> Self {
        Self { bytes: vec![0; BLOCK + BLOCK / 8], end: 0 }
    }

    fn as_bytes(&self) -> &[u8] {
        &self.bytes[..self.end]
    }

    /// Memory for so many bytes more.
    fn room(&mut self, count: usize) -> &mut [u8] {
        let until = self.end + count;
        if self.bytes.len() < until {
            self.bytes.resize(until, 0);
        }
        &mut self.bytes[self.end..]
    }

    fn push(&mut self, text: &[u8]) {
        self.room(text.len())[..text.len()].copy_from_slice(text);
        self.end += text.len();
    }

    /// Appends the shortest texts that read back exactly, each with a comma after it. No number needs quotation marks.
    fn push_numbers(&mut self, numbers: &[f64]) {
        let mut buffers: [_; AT_ONCE] = std::array::from_fn(|_| zmij::Buffer::new());
        let room = self.room(ROOM * numbers.len());
        let mut end = 0;
        for numbers in numbers.chunks(AT_ONCE) {
            let mut texts = [""; AT_ONCE];
            for ((text, buffer), number) in texts.iter_mut().zip(&mut buffers).zip(numbers) {
                *text = buffer.format(*number);
            }
            for text in &texts[..numbers.len()] {
                let to = room[end..].first_chunk_mut().expect("room for each number");
                copy(text.as_bytes(), to);
                to[text.len()] = b',';
                end += text.len() + 1;
            }
        }
        self.end += end;
    }

    /// The comma after the last number ends the line.
    fn end_line(&mut self) {
        if let Some(last) = self.end.checked_sub(1) {
            self.bytes[last] = b'\n';
        }
    }

    /// Writes the lines, and is empty then.
    fn write(&mut self, to: &mut impl Write) -> io::Result<()> {
        to.write_all(self.as_bytes())?;
        self.end = 0;
        Ok(())
    }
}

/// Copies a text; most by two copies of constant length, which overlap: no calls.
fn copy(text: &[u8], to: &mut [u8; ROOM]) {
    let copied = ends::<16>(text, to)
        .or_else(|| ends::<8>(text, to))
        .or_else(|| ends::<4>(text, to))
        .or_else(|| ends::<2>(text, to));
    if copied.is_none() {
        to[..text.len()].copy_from_slice(text);
    }
}

/// Copies the first and the last bytes of a text, if it has so many, and all of it if it has no more than twice as many.
fn ends<const N: usize>(text: &[u8], to: &mut [u8; ROOM]) -> Option<()> {
    let (first, last) = (text.first_chunk::<N>()?, text.last_chunk::<N>()?);
    *to.first_chunk_mut()? = *first;
    *to[..text.len()].last_chunk_mut()? = *last;
    Some(())
}

#[cfg(test)]
mod tests {
    use super::Text;

    /// Of three bytes and more, by the formatter.
    #[test]
    fn texts_are_those_of_the_formatter() {
        let numbers = [
            0.0,
            -0.5,
            0.25,
            12.125,
            -1234.5678,
            1.5e-7,
            0.1 + 0.2,
            -1.0 / 3.0,
            1e300,
            -2.225_073_858_507_201_4e-308,
            f64::NAN,
        ];
        for count in 0..40 {
            let numbers: Vec<f64> = (0..count).map(|i| numbers[i % numbers.len()]).collect();
            let mut text = Text::new();
            text.push(b"1.0,");
            text.push_numbers(&numbers);
            let texts = numbers.iter().map(|number| zmij::Buffer::new().format(*number).to_owned() + ",");
            assert_eq!(str::from_utf8(text.as_bytes()), Ok(&*("1.0,".to_owned() + &texts.collect::<String>())));
        }
    }
}
