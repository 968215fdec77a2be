//! The numbers of a batch, and their copies in registers.

use super::execute::{Block, LANES, Lanes};

/// How the elements of all instances follow each other in an array.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Order {
    /// All elements of the first instance, then all of the second: the shape (instances, elements) of a row-major
    /// array.
    #[default]
    Instances,
    /// The first element of all instances, then the second: the shape (elements, instances). Fastest.
    Elements,
}

impl Order {
    /// Where an element is among those of so many `elements` of so many `instances`.
    #[inline(always)]
    fn place(self, element: usize, elements: usize, instance: usize, instances: usize) -> usize {
        match self {
            Self::Instances => instance * elements + element,
            Self::Elements => element * instances + instance,
        }
    }
}

/// Elements of instances, to be read.
#[derive(Clone, Copy, Debug)]
pub(in crate::evaluator) struct Matrix<'a> {
    pub numbers: &'a [f64],
    pub elements: usize,
    pub instances: usize,
    pub order: Order,
}

/// The instances of a block.
#[derive(Clone, Copy, Debug)]
pub(super) struct Span {
    pub from: usize,
    /// At most those of a block.
    pub len: usize,
}

impl Matrix<'_> {
    /// The element of an instance.
    #[inline(always)]
    pub(super) fn at(&self, element: usize, instance: usize) -> f64 {
        self.numbers[self.order.place(element, self.elements, instance, self.instances)]
    }

    /// Copies the elements of the instances of a span to registers; the instances that a block has beyond it are as its
    /// first.
    #[inline(always)]
    pub(super) fn load<const C: usize>(&self, span: Span, registers: &[Block<C>]) {
        let Span { from, len } = span;
        let registers = &registers[..self.elements];
        if len < C * LANES {
            let instance = |i: usize| if i < len { from + i } else { from };
            for (element, register) in registers.iter().enumerate() {
                for (chunk, place) in register.iter().enumerate() {
                    let at = |lane| self.at(element, instance(chunk * LANES + lane));
                    place.set(Lanes(std::array::from_fn(at)));
                }
            }
            return;
        }
        match self.order {
            Order::Elements => {
                for (element, register) in registers.iter().enumerate() {
                    let numbers = &self.numbers[element * self.instances + from..][..C * LANES];
                    for (place, numbers) in register.iter().zip(numbers.as_chunks().0) {
                        place.set(Lanes(*numbers));
                    }
                }
            }
            Order::Instances => {
                for chunk in 0..C {
                    let numbers = &self.numbers[(from + chunk * LANES) * self.elements..][..LANES * self.elements];
                    let rows: [&[f64]; LANES] =
                        std::array::from_fn(|lane| &numbers[lane * self.elements..][..self.elements]);
                    for (element, register) in registers.iter().enumerate() {
                        register[chunk].set(Lanes(rows.map(|row| row[element])));
                    }
                }
            }
        }
    }
}

/// Elements of instances, to be written.
#[derive(Debug)]
pub(in crate::evaluator) struct MatrixMut<'a> {
    pub numbers: &'a mut [f64],
    pub elements: usize,
    pub instances: usize,
    pub order: Order,
}

impl MatrixMut<'_> {
    /// Sets the element of an instance.
    #[inline(always)]
    pub(super) fn set(&mut self, element: usize, instance: usize, number: f64) {
        self.numbers[self.order.place(element, self.elements, instance, self.instances)] = number;
    }

    /// Copies registers to the elements of all instances of a block.
    #[inline(always)]
    pub(super) fn store<'b, const C: usize>(
        &mut self,
        from: usize,
        registers: impl Iterator<Item = &'b Block<C>> + Clone,
    ) {
        match self.order {
            Order::Elements => {
                for (element, register) in registers.enumerate() {
                    let numbers = &mut self.numbers[element * self.instances + from..][..C * LANES];
                    for (numbers, place) in numbers.as_chunks_mut().0.iter_mut().zip(register) {
                        *numbers = place.get().0;
                    }
                }
            }
            Order::Instances => {
                for chunk in 0..C {
                    let first = (from + chunk * LANES) * self.elements;
                    let numbers = &mut self.numbers[first..][..LANES * self.elements];
                    let mut rows = numbers.chunks_exact_mut(self.elements);
                    let mut rows: [&mut [f64]; LANES] = std::array::from_fn(|_| rows.next().unwrap_or_default());
                    for (element, register) in registers.clone().enumerate() {
                        for (row, number) in rows.iter_mut().zip(register[chunk].get().0) {
                            row[element] = number;
                        }
                    }
                }
            }
        }
    }
}
