//! Some instances of a batch, copied to where the compiler knows that nothing else is.

use crate::scalar::Scalar;
use crate::status::Status;

/// The scalar of a batch: `f64`, or one that becomes vectors.
pub trait Number: Scalar {
    /// The number.
    fn value(self) -> f64;
}

/// One row per number, one column per instance of the block.
pub type Rows<const R: usize, const B: usize> = [[f64; B]; R];

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

    /// As [`Place::load`], where an instance has a matrix.
    #[inline(always)]
    pub fn load_matrix<const R: usize, const C: usize, const B: usize>(
        self,
        matrix: &[f64],
        rows: &mut [Rows<C, B>; R],
    ) {
        for (rows, matrix) in rows.iter_mut().zip(matrix.chunks_exact(C * self.columns)) {
            self.load(matrix, rows);
        }
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
pub fn take<T: Number, const R: usize, const B: usize>(rows: &Rows<R, B>, instance: usize) -> [T; R] {
    let mut numbers = [T::ZERO; R];
    for (number, row) in numbers.iter_mut().zip(rows) {
        *number = T::constant(row[instance]);
    }
    numbers
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

/// What the statuses of a block are found from.
#[derive(Clone, Copy, Debug)]
pub struct Checks<const B: usize> {
    /// Sums of [`zeros`] of what is given.
    given: [f64; B],
    /// Smallest pivots.
    pivots: [f64; B],
    /// Sums of [`zeros`] of what is computed.
    computed: [f64; B],
}

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
        Self { given: [0.0; B], pivots: [0.0; B], computed: [0.0; B] }
    }

    /// Of an instance.
    #[inline(always)]
    pub fn put<T: Number>(&mut self, instance: usize, given: T, pivot: T, computed: T) {
        self.given[instance] = given.value();
        self.pivots[instance] = pivot.value();
        self.computed[instance] = computed.value();
    }

    /// The statuses of all instances.
    #[inline(always)]
    #[must_use]
    #[allow(clippy::needless_bitwise_bool, reason = "a loop with a branch does not become vectors")]
    pub fn statuses(&self) -> Statuses<B> {
        let Self { given, pivots, computed } = self;
        let limit = 8.0 * f64::EPSILON;
        let mut failed = 0_u64;
        for instance in 0..B {
            let is_done = (pivots[instance] > limit) & (given[instance] + computed[instance] == 0.0);
            failed += u64::from(!is_done);
        }
        let mut each = [Status::Done; B];
        if failed > 0 {
            for (instance, status) in each.iter_mut().enumerate() {
                *status = match (given[instance] == 0.0, pivots[instance] > limit, computed[instance] == 0.0) {
                    (true, true, true) => Status::Done,
                    (true, false, _) => Status::Singular,
                    _ => Status::NotFinite,
                };
            }
        }
        Statuses { all_done: failed == 0, each }
    }
}

/// 0 where all numbers are finite, else NaN.
#[inline(always)]
#[must_use]
pub fn zeros<T: Number, const N: usize>(numbers: &[T; N]) -> T {
    numbers.iter().fold(T::ZERO, |sum, number| sum + *number * T::ZERO)
}

/// One of two numbers: the first where a sum of [`zeros`] is 0.
#[inline(always)]
#[must_use]
pub fn where_finite<T: Number>(zeros: T, number: T, other: T) -> T {
    if zeros.value() == 0.0 { number } else { other }
}

/// As [`zeros`], of a matrix.
#[inline(always)]
#[must_use]
pub fn zeros_of_matrix<T: Number, const N: usize, const C: usize>(matrix: &[[T; C]; N]) -> T {
    matrix.iter().fold(T::ZERO, |sum, row| sum + zeros(row))
}
