//! Runge–Kutta steps under proportional-derivative control, written by hand for a fixed size: the loop that a user would
//! write around any implementation.

/// Base pose, joint angles, base twist, joint rates.
pub type Vector = [f64; 18];

/// Gains of all joints, N m/rad and N m s/rad.
pub const GAINS: [f64; 2] = [50.0, 20.0];

/// Torques that hold the joints at 0.
pub fn torques(x: &Vector) -> [f64; 6] {
    std::array::from_fn(|i| -GAINS[0] * x[3 + i] - GAINS[1] * x[12 + i])
}

/// One step of the motion whose accelerations are given.
#[inline]
pub fn step(accelerations: impl Fn(&Vector) -> [f64; 9], x: &mut Vector, step: f64) {
    let derivative = |x: &Vector| -> Vector {
        let accelerations = accelerations(x);
        std::array::from_fn(|i| if i < 9 { x[9 + i] } else { accelerations[i - 9] })
    };
    let moved = |by: f64, rate: &Vector| -> Vector { std::array::from_fn(|i| x[i] + by * rate[i]) };
    let first = derivative(x);
    let second = derivative(&moved(0.5 * step, &first));
    let third = derivative(&moved(0.5 * step, &second));
    let fourth = derivative(&moved(step, &third));
    for i in 0..18 {
        x[i] += step / 6.0 * (first[i] + 2.0 * (second[i] + third[i]) + fourth[i]);
    }
}

/// The parts of a vector.
#[inline]
pub fn parts(x: &Vector) -> ([f64; 3], [f64; 6], [f64; 3], [f64; 6]) {
    let part = |from: usize| x[from..].iter();
    let mut found = ([0.0; 3], [0.0; 6], [0.0; 3], [0.0; 6]);
    found.0.iter_mut().zip(part(0)).for_each(|(to, from)| *to = *from);
    found.1.iter_mut().zip(part(3)).for_each(|(to, from)| *to = *from);
    found.2.iter_mut().zip(part(9)).for_each(|(to, from)| *to = *from);
    found.3.iter_mut().zip(part(12)).for_each(|(to, from)| *to = *from);
    found
}
