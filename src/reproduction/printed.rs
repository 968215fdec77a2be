//! The numbers that the paper prints, to be set beside ours.

/// Table 1: length (m), mass (kg) and moment of inertia (kg m²) of the base, then of every link.
pub(super) const BODIES: [[f64; 3]; 2] = [[1.0, 500.0, 83.61], [1.0, 10.0, 1.05]];
/// Table 2: mass (kg), radius (m) and moment of inertia (kg m²) of both targets.
pub(super) const TARGET: [f64; 3] = [10.0, 0.5, 1.0];
/// Table 2: where the targets are, m.
pub(super) const LOCATIONS: [[f64; 2]; 2] = [[2.0, -2.0], [-2.0, 2.0]];
/// Table 3: initial and final joint angles, rad.
pub(super) const JOINT_ANGLES: [[f64; 6]; 2] =
    [[0.698, -1.571, 1.047, 2.444, 1.571, -1.047], [-0.524, -1.393, -0.035, 2.618, -1.393, -0.035]];
/// Table 4: initial and final positions of both end effectors, m.
pub(super) const END_EFFECTORS: [[[f64; 2]; 2]; 2] = [[[2.9, 0.05], [-2.9, 0.05]], [[2.0, -1.5], [-2.0, 1.5]]];
/// Table 5: impulses at contact points 1 and 2 in cases 1 to 3, N s.
pub(super) const IMPULSES: [[f64; 2]; 3] = [[0.0873, 0.0873], [0.0131, 0.0131], [0.0873, 0.0873]];
/// Section 3, assumption (1): how long an impact takes, s.
pub(super) const IMPACT_DURATION: f64 = 1e-3;
