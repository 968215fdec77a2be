//! What became of one instance of a batch.

/// What became of one instance of a batch; its results are written where it is `Done`.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
#[repr(u8)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum Status {
    /// Computed.
    #[default]
    Done = 0,
    /// A pivot at or below 8 roundings: [`Error::Singular`](crate::error::Error::Singular) of the model's trait.
    Singular = 1,
    /// A number that is NaN or infinite, given or computed: [`Error::NotFinite`](crate::error::Error::NotFinite).
    NotFinite = 2,
}
