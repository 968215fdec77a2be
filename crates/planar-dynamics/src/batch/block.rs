//! Some instances of a batch: what is given where it is, what is computed first where the compiler knows that nothing else is.

use crate::scalar::Scalar;
use crate::status::Status;
use crate::validate::is_regular;
use core::hint::black_box;

/// The scalar of a batch: `f64`, or one that becomes vectors.
pub trait Number: Scalar {
    /// Whether a status found with it is the instance's; else it is that there is none, or may be one, other than `Done`.
    const DECIDES: bool;

    /// The number.
    fn value(self) -> f64;
}

/// One row per number, one column per instance of the block.
pub type Rows<const R: usize, const B: usize> = [[f64; B]; R];

/// Numbers that begin a line of the cache: vectors as long as a line are then in one each.
#[derive(Clone, Copy, Debug)]
#[repr(align(64))]
pub struct Lines<T>(pub T);

/// Where the instances of a block are in the matrices of a batch.
#[derive(Clone, Copy, Debug)]
pub struct Place {
    /// The first instance.
    pub from: usize,
    /// Number of instances, at most those of a block.
    pub len: usize,
    /// Number of columns of the matrices.
    pub columns: usize,
}

impl Place {
    /// Parts of at most so many instances.
    #[inline(always)]
    pub fn blocks(self, len: usize) -> impl Iterator<Item = Self> {
        let starts = (0..self.len).step_by(len);
        starts.map(move |start| Self { from: self.from + start, len: len.min(self.len - start), ..self })
    }

    /// Copies rows of a matrix to those of a block. Instances that the last block lacks are as its first.
    #[inline(always)]
    pub fn load<const R: usize, const B: usize>(self, matrix: &[f64], rows: &mut Rows<R, B>) {
        for (row, values) in rows.iter_mut().zip(matrix.chunks_exact(self.columns)) {
            let Some(values) = values.get(self.from..self.from + self.len) else { continue };
            if let Some(all) = values.first_chunk() {
                *row = *all;
            } else {
                *row = [values.first().copied().unwrap_or(0.0); B];
                row.iter_mut().zip(values).for_each(|(to, value)| *to = *value);
            }
        }
    }

    /// Rows of a block: those of the matrix itself, or copies where it has fewer instances.
    #[inline(always)]
    pub fn rows<'a, const R: usize, const B: usize>(
        self,
        matrix: &'a [f64],
        copies: &'a mut Option<Rows<R, B>>,
    ) -> [&'a [f64; B]; R] {
        let mut rows = [const { &[0.0; B] }; R];
        if self.len < B {
            let copies = copies.insert([[0.0; B]; R]);
            self.load(matrix, copies);
            rows = copies.each_ref();
        } else {
            for (row, values) in rows.iter_mut().zip(matrix.chunks_exact(self.columns)) {
                if let Some(all) = values.get(self.from..).and_then(<[f64]>::first_chunk) {
                    *row = all;
                }
            }
        }
        // of a choice of places, the compiler does not see that results are not among them
        black_box(rows)
    }

    /// As [`Place::rows`], where an instance has a matrix.
    #[inline(always)]
    pub fn matrix_rows<'a, const R: usize, const C: usize, const B: usize>(
        self,
        matrix: &'a [f64],
        copies: &'a mut [Option<Rows<C, B>>; R],
    ) -> [[&'a [f64; B]; C]; R] {
        let mut rows = [[const { &[0.0; B] }; C]; R];
        for ((rows, copies), matrix) in rows.iter_mut().zip(copies).zip(matrix.chunks_exact(C * self.columns)) {
            *rows = self.rows(matrix, copies);
        }
        rows
    }

    /// Copies rows of a block to those of a matrix, for the instances that are done.
    #[inline(always)]
    pub fn store<const R: usize, const B: usize>(self, rows: &Rows<R, B>, statuses: &Statuses<B>, matrix: &mut [f64]) {
        for (row, values) in rows.iter().zip(matrix.chunks_exact_mut(self.columns)) {
            let Some(values) = values.get_mut(self.from..self.from + self.len) else { continue };
            match (values.first_chunk_mut(), statuses.all_done) {
                (Some(all), true) => *all = *row,
                _ => {
                    for ((to, value), status) in values.iter_mut().zip(row).zip(&statuses.each) {
                        if *status == Status::Done {
                            *to = *value;
                        }
                    }
                }
            }
        }
    }

    /// As [`Place::store`], where an instance has a matrix.
    #[inline(always)]
    pub fn store_matrix<const R: usize, const C: usize, const B: usize>(
        self,
        rows: &[Rows<C, B>; R],
        statuses: &Statuses<B>,
        matrix: &mut [f64],
    ) {
        for (rows, matrix) in rows.iter().zip(matrix.chunks_exact_mut(C * self.columns)) {
            self.store(rows, statuses, matrix);
        }
    }

    /// Copies statuses that are not `Done`.
    #[inline(always)]
    pub fn store_statuses<const B: usize>(self, found: &Statuses<B>, statuses: &mut [Status]) {
        if !found.all_done {
            let own = statuses.iter_mut().skip(self.from).take(self.len);
            own.zip(&found.each).for_each(|(status, found)| *status = *found);
        }
    }
}

/// The numbers of an instance.
#[inline(always)]
#[must_use]
pub fn take<T: Number, const R: usize, const B: usize>(rows: &[&[f64; B]; R], instance: usize) -> [T; R] {
    rows.map(|row| T::constant(row[instance]))
}

/// As [`take`], of a matrix.
#[inline(always)]
#[must_use]
pub fn take_matrix<T: Number, const R: usize, const C: usize, const B: usize>(
    rows: &[[&[f64; B]; C]; R],
    instance: usize,
) -> [[T; C]; R] {
    rows.map(|rows| take(&rows, instance))
}

/// Sets the numbers of an instance.
#[inline(always)]
pub fn put<T: Number, const R: usize, const B: usize>(numbers: &[T; R], rows: &mut Rows<R, B>, instance: usize) {
    for (number, row) in numbers.iter().zip(rows) {
        row[instance] = number.value();
    }
}

/// As [`put`], of a matrix.
#[inline(always)]
pub fn put_matrix<T: Number, const R: usize, const C: usize, const B: usize>(
    matrix: &[[T; C]; R],
    rows: &mut [Rows<C, B>; R],
    instance: usize,
) {
    for (numbers, rows) in matrix.iter().zip(rows) {
        put(numbers, rows, instance);
    }
}

/// What the statuses of a block are found from: 0 for an instance that is done, 1 for a singular one, else NaN.
#[derive(Clone, Copy, Debug)]
#[repr(align(64))]
pub struct Checks<const B: usize>([f64; B]);

/// The statuses of a block.
#[derive(Clone, Copy, Debug)]
pub struct Statuses<const B: usize> {
    all_done: bool,
    each: [Status; B],
}

impl<const B: usize> Checks<B> {
    /// Without any number.
    #[must_use]
    #[allow(clippy::new_without_default, reason = "for generated code alone")]
    pub const fn new() -> Self {
        Self([0.0; B])
    }

    /// Of an instance, from sums of [`zeros`] of what is given and of what is computed, and its smallest pivot.
    #[inline(always)]
    pub fn put<T: Number>(&mut self, instance: usize, given: T, pivot: T, computed: T) {
        let of_result = if is_regular(pivot.value()) { computed.value() } else { 1.0 };
        self.0[instance] = given.value() + of_result;
    }

    /// The statuses of all instances.
    #[inline(always)]
    #[must_use]
    pub fn statuses(&self) -> Statuses<B> {
        let mut failed = 0_u64;
        for check in &self.0 {
            failed += u64::from(*check != 0.0);
        }
        let mut each = [Status::Done; B];
        if failed > 0 {
            for (status, check) in each.iter_mut().zip(&self.0) {
                *status = match *check {
                    0.0 => Status::Done,
                    1.0 => Status::Singular,
                    _ => Status::NotFinite,
                };
            }
        }
        Statuses { all_done: failed == 0, each }
    }
}

/// 0 where all numbers are finite, else NaN; NaN too for a scalar that does not decide where their sum is not finite.
#[inline(always)]
#[must_use]
pub fn zeros<T: Number, const N: usize>(numbers: &[T; N]) -> T {
    if T::DECIDES {
        numbers.iter().fold(T::ZERO, |sum, number| sum + *number * T::ZERO)
    } else {
        numbers.iter().fold(T::ZERO, |sum, number| sum + *number) * T::ZERO
    }
}

/// One of two numbers: the first where a sum of [`zeros`] is 0, or where the scalar does not decide.
#[inline(always)]
#[must_use]
pub fn where_finite<T: Number>(zeros: T, number: T, other: T) -> T {
    if !T::DECIDES || zeros.value() == 0.0 { number } else { other }
}

/// As [`zeros`], of a matrix.
#[inline(always)]
#[must_use]
pub fn zeros_of_matrix<T: Number, const N: usize, const C: usize>(matrix: &[[T; C]; N]) -> T {
    matrix.iter().fold(T::ZERO, |sum, row| sum + zeros(row))
}
