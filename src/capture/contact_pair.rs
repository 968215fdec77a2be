//! An end effector and a target that may come into contact.

/// By indices.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct ContactPair {
    /// Of the target.
    pub target: usize,
    /// Of the contact among the target's.
    pub contact: usize,
    /// Of the arm.
    pub arm: usize,
}
