//! The instructions of a program: the operations of a graph, and sums of products as one.

/// The number of a register.
pub(super) type Register = u16;

/// The registers of an instruction: those of the results, then those of the operands; what is left over is 0.
pub(super) type Operands = [Register; 5];

/// What an instruction computes. Sums of products have a rounding for each product and one for the sum, as the
/// operations that they replace.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Kind {
    /// −a.
    Neg,
    /// √a.
    Sqrt,
    /// Sine and cosine of a, two results.
    SinCos,
    /// a + b.
    Add,
    /// a − b.
    Sub,
    /// a b.
    Mul,
    /// a / b.
    Div,
    /// The smaller of a and b.
    Min,
    /// The angle of (b, a).
    Atan2,
    /// a b + c.
    MulAdd,
    /// a b − c.
    MulSub,
    /// c − a b.
    SubMul,
    /// a b + c d.
    MulAddMul,
    /// a b − c d.
    MulSubMul,
}

/// Instructions of one kind that follow each other.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Run {
    pub kind: Kind,
    pub count: u32,
}
