//! Runge–Kutta steps under proportional-derivative control, written by hand for a fixed size: the loop that a user would
//! write around any implementation.

/// Base pose, joint angles, base twist, joint rates.
pub type Vector = [f64; 18];

/// Gains of all joints, N m/rad and N m s/rad.
pub const GAINS: [f64; 2] = [50.0, 20.0];

/// Torques that hold the joints at 0.
#[inline(always)]
#[allow(clippy::inline_always, reason = "as where they are asked for")]
pub fn torques(x: &Vector) -> [f64; 6] {
    std::array::from_fn(|i| -GAINS[0] * x[3 + i] - GAINS[1] * x[12 + i])
}

/// A motion by its accelerations, of base and joints.
pub trait Motion {
    /// At a state.
    fn accelerations(&self, x: &Vector) -> [f64; 9];
}

/// One step of a motion. An evaluation that is inlined has its numbers in registers from stage to stage.
#[inline(always)]
#[allow(clippy::inline_always, reason = "what is called passes vectors through memory")]
pub fn step(motion: &impl Motion, x: &mut Vector, step: f64) {
    let first = derivative(motion, x);
    let second = derivative(motion, &moved(x, 0.5 * step, &first));
    let third = derivative(motion, &moved(x, 0.5 * step, &second));
    let fourth = derivative(motion, &moved(x, step, &third));
    for i in 0..18 {
        x[i] += step / 6.0 * (first[i] + 2.0 * (second[i] + third[i]) + fourth[i]);
    }
}

#[inline(always)]
#[allow(clippy::inline_always, reason = "as above")]
fn derivative(motion: &impl Motion, x: &Vector) -> Vector {
    let accelerations = motion.accelerations(x);
    std::array::from_fn(|i| if i < 9 { x[9 + i] } else { accelerations[i - 9] })
}

#[inline(always)]
#[allow(clippy::inline_always, reason = "as above")]
fn moved(x: &Vector, by: f64, rate: &Vector) -> Vector {
    std::array::from_fn(|i| x[i] + by * rate[i])
}

/// The parts of a vector.
#[inline(always)]
#[allow(clippy::inline_always, reason = "as above")]
pub fn parts(x: &Vector) -> ([f64; 3], [f64; 6], [f64; 3], [f64; 6]) {
    (part(x, 0), part(x, 3), part(x, 9), part(x, 12))
}

#[inline(always)]
#[allow(clippy::inline_always, reason = "as above")]
fn part<const N: usize>(x: &Vector, from: usize) -> [f64; N] {
    std::array::from_fn(|i| x[from + i])
}
