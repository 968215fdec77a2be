//! The instructions of a program: the operations of a graph, and sums of products as one.

/// The number of a register.
pub(super) type Register = u16;

/// An operation on registers, the first of which receive the result. Sums of products have a rounding for each product
/// and one for the sum, as the operations that they replace.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Instruction {
    /// −a.
    Neg([Register; 2]),
    /// √a.
    Sqrt([Register; 2]),
    /// Sine and cosine of a.
    SinCos([Register; 3]),
    /// a + b.
    Add([Register; 3]),
    /// a − b.
    Sub([Register; 3]),
    /// a b.
    Mul([Register; 3]),
    /// a / b.
    Div([Register; 3]),
    /// The smaller of a and b.
    Min([Register; 3]),
    /// The angle of (b, a).
    Atan2([Register; 3]),
    /// a b + c.
    MulAdd([Register; 4]),
    /// a b − c.
    MulSub([Register; 4]),
    /// c − a b.
    SubMul([Register; 4]),
    /// a b + c d.
    MulAddMul([Register; 5]),
    /// a b − c d.
    MulSubMul([Register; 5]),
}
