//! Compares the derivatives of a generated module, `robot.rs` beside this file, with dual numbers through its functions:
//! at random states, near symmetric poses, and with random numbers of the robot. Its argument is the bound.

mod robot;

use robot::{ARMS, JOINTS, MANIFEST, Model, PARAMETERS, Parameters, SIZE, Scalar};
use std::ops::{Add, Div, Mul, Neg, Sub};

/// Value and derivative.
#[derive(Clone, Copy)]
struct Dual(f64, f64);

impl Add for Dual {
    type Output = Self;
    fn add(self, b: Self) -> Self {
        Self(self.0 + b.0, self.1 + b.1)
    }
}
impl Sub for Dual {
    type Output = Self;
    fn sub(self, b: Self) -> Self {
        Self(self.0 - b.0, self.1 - b.1)
    }
}
impl Mul for Dual {
    type Output = Self;
    fn mul(self, b: Self) -> Self {
        Self(self.0 * b.0, self.1 * b.0 + self.0 * b.1)
    }
}
impl Div for Dual {
    type Output = Self;
    fn div(self, b: Self) -> Self {
        Self(self.0 / b.0, (self.1 - self.0 / b.0 * b.1) / b.0)
    }
}
impl Neg for Dual {
    type Output = Self;
    fn neg(self) -> Self {
        Self(-self.0, -self.1)
    }
}
impl Scalar for Dual {
    const ZERO: Self = Self(0.0, 0.0);
    const ONE: Self = Self(1.0, 0.0);
    fn constant(value: f64) -> Self {
        Self(value, 0.0)
    }
    fn sin_cos(self) -> (Self, Self) {
        let (sin, cos) = self.0.sin_cos();
        (Self(sin, cos * self.1), Self(cos, -sin * self.1))
    }
    fn sqrt(self) -> Self {
        Self(self.0.sqrt(), 0.5 * self.1 / self.0.sqrt())
    }
    fn atan2(self, x: Self) -> Self {
        let square = self.0 * self.0 + x.0 * x.0;
        Self(self.0.atan2(x.0), (x.0 * self.1 - self.0 * x.1) / square)
    }
    fn minimum(self, other: Self) -> Self {
        if self.0 < other.0 { self } else { other }
    }
}

/// The inputs of all functions, and the robot's numbers.
#[derive(Clone, Copy)]
struct Inputs<T> {
    parameters: [T; PARAMETERS],
    pose: [T; 3],
    angles: [T; JOINTS],
    twist: [T; 3],
    rates: [T; JOINTS],
    torques: [T; JOINTS],
    wrench: [T; 3],
    wrenches: [[T; 3]; ARMS],
    masses: [T; ARMS],
    inertias: [T; ARMS],
    contacts: [[T; 2]; ARMS],
    twists: [[T; 3]; ARMS],
}

impl<T: Copy> Inputs<T> {
    fn map<U>(&self, f: impl Fn(T) -> U + Copy) -> Inputs<U> {
        Inputs {
            parameters: self.parameters.map(f),
            pose: self.pose.map(f),
            angles: self.angles.map(f),
            twist: self.twist.map(f),
            rates: self.rates.map(f),
            torques: self.torques.map(f),
            wrench: self.wrench.map(f),
            wrenches: self.wrenches.map(|row| row.map(f)),
            masses: self.masses.map(f),
            inertias: self.inertias.map(f),
            contacts: self.contacts.map(|row| row.map(f)),
            twists: self.twists.map(|row| row.map(f)),
        }
    }
}

impl Inputs<f64> {
    /// As dual numbers, with a derivative of 1 in the element that `choose` returns.
    fn seeded(&self, choose: impl Fn(&mut Inputs<Dual>) -> &mut Dual) -> Inputs<Dual> {
        let mut dual = self.map(|value| Dual(value, 0.0));
        choose(&mut dual).1 = 1.0;
        dual
    }

    /// As dual numbers with the derivatives of a direction.
    fn along(&self, d: &Self) -> Inputs<Dual> {
        let mut dual = self.map(|value| Dual(value, 0.0));
        let each = |into: &mut [Dual], d: &[f64]| into.iter_mut().zip(d).for_each(|(into, d)| into.1 = *d);
        each(&mut dual.parameters, &d.parameters);
        each(&mut dual.pose, &d.pose);
        each(&mut dual.angles, &d.angles);
        each(&mut dual.twist, &d.twist);
        each(&mut dual.rates, &d.rates);
        dual
    }
}

fn forward<T: Scalar>(x: &Inputs<T>, forces: usize) -> Vec<T> {
    let model = Model::new(Parameters::from_array(x.parameters));
    let (base, joints) = match forces {
        0 => {
            let found = model.forward_dynamics(&x.pose, &x.angles, &x.twist, &x.rates, &x.torques);
            (found.base_acceleration, found.joint_accelerations)
        }
        1 => {
            let found =
                model.forward_dynamics_with_base_wrench(&x.pose, &x.angles, &x.twist, &x.rates, &x.torques, &x.wrench);
            (found.base_acceleration, found.joint_accelerations)
        }
        _ => {
            let found = model.forward_dynamics_with_wrenches(
                &x.pose, &x.angles, &x.twist, &x.rates, &x.torques, &x.wrench, &x.wrenches,
            );
            (found.base_acceleration, found.joint_accelerations)
        }
    };
    base.into_iter().chain(joints).collect()
}

fn impact<T: Scalar>(x: &Inputs<T>, exact: bool) -> Vec<T> {
    let model = Model::new(Parameters::from_array(x.parameters));
    macro_rules! results {
        ($function:ident) => {{
            let found = model.$function(
                &x.pose, &x.angles, &x.twist, &x.rates, &x.masses, &x.inertias, &x.contacts, &x.twists,
            );
            let velocities = found.base_twist_after.into_iter().chain(found.joint_rates_after);
            velocities.chain(found.target_twists_after.into_iter().flatten()).chain(found.impulses.into_iter().flatten()).collect()
        }};
    }
    if exact { results!(exact_impact) } else { results!(paper_impact) }
}

/// Comparisons, and the largest difference.
struct Comparison {
    bound: f64,
    worst: f64,
}

impl Comparison {
    /// A matrix against its columns by dual numbers, relative to its largest entry.
    fn matrix<const C: usize>(&mut self, what: &str, found: &[[f64; C]], columns: &[Vec<Dual>]) {
        assert_eq!(columns.len(), C, "{what}");
        let expected: Vec<Vec<f64>> = columns.iter().map(|column| column.iter().map(|d| d.1).collect()).collect();
        let size = expected.iter().flatten().fold(0.0, |most: f64, value| most.max(value.abs()));
        for (i, row) in found.iter().enumerate() {
            for (j, value) in row.iter().enumerate() {
                self.number(&format!("{what}[{i}][{j}]"), *value, expected[j][i], size);
            }
        }
    }

    fn number(&mut self, what: &str, found: f64, expected: f64, size: f64) {
        let error = (found - expected).abs();
        assert!(error <= self.bound * size, "{what}: {found:e}, dual numbers {expected:e}, of {size:e}");
        if error > 0.0 {
            self.worst = self.worst.max(error / size);
        }
    }
}

fn by_pose_and_angles(x: &Inputs<f64>, f: impl Fn(&Inputs<Dual>) -> Vec<Dual>) -> Vec<Vec<Dual>> {
    let pose = (0..3).map(|k| f(&x.seeded(|d| &mut d.pose[k])));
    pose.chain((0..JOINTS).map(|k| f(&x.seeded(|d| &mut d.angles[k])))).collect()
}

fn by_twist_and_rates(x: &Inputs<f64>, f: impl Fn(&Inputs<Dual>) -> Vec<Dual>) -> Vec<Vec<Dual>> {
    let twist = (0..3).map(|k| f(&x.seeded(|d| &mut d.twist[k])));
    twist.chain((0..JOINTS).map(|k| f(&x.seeded(|d| &mut d.rates[k])))).collect()
}

fn check(x: &Inputs<f64>, direction: &Inputs<f64>, to: &mut Comparison) {
    let model = Model::new(Parameters::from_array(x.parameters));
    let wrench = (0..3).map(|k| forward(&x.seeded(|d| &mut d.wrench[k]), 1));
    let by_forces: Vec<_> = wrench.chain((0..JOINTS).map(|k| forward(&x.seeded(|d| &mut d.torques[k]), 1))).collect();
    let inverse = model.inverse_mass_matrix(&x.pose, &x.angles);
    to.matrix("inverse mass matrix", &inverse.inverse_mass_matrix, &by_forces);
    macro_rules! accelerations {
        ($forces:literal, $found:expr) => {{
            let found = $found;
            let (base, joints) = found.base_acceleration.split_at(3);
            assert!(joints.is_empty() && found.smallest_pivot > 0.0);
            let values = forward(x, $forces);
            let size = values.iter().fold(0.0, |most: f64, value| most.max(value.abs()));
            for (value, expected) in base.iter().chain(&found.joint_accelerations).zip(values) {
                to.number("acceleration", *value, expected, size);
            }
            to.matrix("by position", &found.by_position, &by_pose_and_angles(x, |d| forward(d, $forces)));
            to.matrix("by velocity", &found.by_velocity, &by_twist_and_rates(x, |d| forward(d, $forces)));
            assert_eq!(found.inverse_mass_matrix, inverse.inverse_mass_matrix);
        }};
    }
    let Inputs { pose, angles, twist, rates, torques, wrench, wrenches, .. } = x;
    accelerations!(0, model.forward_dynamics_derivatives(pose, angles, twist, rates, torques));
    accelerations!(1, model.forward_dynamics_with_base_wrench_derivatives(pose, angles, twist, rates, torques, wrench));
    accelerations!(
        2,
        model.forward_dynamics_with_wrenches_derivatives(pose, angles, twist, rates, torques, wrench, wrenches)
    );
    macro_rules! impacts {
        ($exact:literal, $function:ident) => {{
            let (masses, inertias, contacts, twists) = (&x.masses, &x.inertias, &x.contacts, &x.twists);
            let found = model.$function(pose, angles, twist, rates, masses, inertias, contacts, twists);
            to.matrix("impact by position", &found.by_position, &by_pose_and_angles(x, |d| impact(d, $exact)));
            to.matrix("impact by velocity", &found.by_velocity, &by_twist_and_rates(x, |d| impact(d, $exact)));
            let contacts = (0..2 * ARMS).map(|k| impact(&x.seeded(|d| &mut d.contacts[k / 2][k % 2]), $exact));
            to.matrix("impact by contacts", &found.by_contacts, &contacts.collect::<Vec<_>>());
            let twists = (0..3 * ARMS).map(|k| impact(&x.seeded(|d| &mut d.twists[k / 3][k % 3]), $exact));
            to.matrix("impact by target twists", &found.by_target_twists, &twists.collect::<Vec<_>>());
        }};
    }
    impacts!(true, exact_impact_derivatives);
    impacts!(false, paper_impact_derivatives);

    let dual = x.along(direction);
    let values = Model::new(Parameters::from_array(dual.parameters)).momentum(&dual.pose, &dual.angles, &dual.twist, &dual.rates);
    let found = model.momentum_derivative_by_parameters(
        pose, angles, twist, rates, &direction.pose, &direction.angles, &direction.twist, &direction.rates, &direction.parameters,
    );
    let size = values.linear_momentum[0].1.abs() + values.linear_momentum[1].1.abs() + values.angular_momentum.1.abs();
    to.number("energy along a direction", found.kinetic_energy_derivative, values.kinetic_energy.1, size + values.kinetic_energy.1.abs());
    to.number("momentum along a direction", found.angular_momentum_derivative, values.angular_momentum.1, size);
}

/// Random numbers by Knuth's linear congruence.
struct Random(u64);

impl Random {
    fn within(&mut self, size: f64) -> f64 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        size * ((self.0 >> 11) as f64 / (1_u64 << 52) as f64 - 1.0)
    }

    fn array<const N: usize>(&mut self, size: f64) -> [f64; N] {
        [(); N].map(|()| self.within(size))
    }

    fn inputs(&mut self) -> Inputs<f64> {
        let own = MANIFEST.parameters;
        Inputs {
            parameters: std::array::from_fn(|i| own[i].default * (1.0 + self.within(0.3))),
            pose: self.array(3.0),
            angles: self.array(3.1),
            twist: self.array(1.0),
            rates: self.array(1.5),
            torques: self.array(10.0),
            wrench: self.array(10.0),
            wrenches: [(); ARMS].map(|()| self.array(10.0)),
            masses: [(); ARMS].map(|()| 15.0 + self.within(14.0)),
            inertias: [(); ARMS].map(|()| 1.5 + self.within(1.4)),
            contacts: [(); ARMS].map(|()| self.array(0.5)),
            twists: [(); ARMS].map(|()| self.array(1.0)),
        }
    }
}

fn main() {
    let bound = std::env::args().nth(1).and_then(|text| text.parse().ok()).expect("a bound");
    let (mut random, mut to) = (Random(20_170_613), Comparison { bound, worst: 0.0 });
    for k in 0..48 {
        let mut x = random.inputs();
        match k % 4 {
            1 => x.angles = [0.0; JOINTS],
            // all arms in the same pose, next to it, and folded
            2 => x.angles = std::array::from_fn(|i| 0.4 * (i % (JOINTS / ARMS).max(1)) as f64 + random.within(1e-9)),
            3 => x.angles = [(); JOINTS].map(|()| std::f64::consts::PI + random.within(1e-9)),
            _ => {}
        }
        if k % 8 < 4 {
            x.parameters = MANIFEST.parameters.iter().map(|p| p.default).collect::<Vec<_>>().try_into().expect("all");
        }
        let direction = random.inputs();
        check(&x, &direction, &mut to);
    }
    println!("{SIZE} degrees of freedom: {:.1e}", to.worst);
}
