//! Random states, regime by regime.
//!
//! # Example
//! ```
//! use planar_build::prove::sampling::Regime;
//! use planar_layout::layout::Layout;
//!
//! let folder = concat!(env!("CARGO_MANIFEST_DIR"), "/../../codegen");
//! let layout = Layout::read(format!("{folder}/layouts/dual_arm_3r.toml").as_ref())?;
//! let folded = Regime::Folded.sample(&layout, 1, 0);
//! // all joints of an arm but its first one
//! let angles = folded.instant.state.joint_angles.chunks(3).flat_map(|arm| &arm[1..]);
//! assert!(angles.map(|angle| angle.abs()).eq([std::f64::consts::PI; 4]));
//! // each sample is there without the others
//! assert_eq!(Regime::Folded.sample(&layout, 1, 0), folded);
//! assert_ne!(Regime::Folded.sample(&layout, 1, 1), folded);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

use crate::prove::evaluation::EvaluationInput;
use crate::prove::owned::RobotState;
use planar_dynamics::manifest::ParameterKind;
use planar_dynamics::target::Target;
use planar_layout::layout::Layout;
use planar_layout::structure::Structure;
use rand::rngs::ChaCha8Rng;
use rand::{Rng, SeedableRng};
use std::f64::consts::{FRAC_PI_2, PI, TAU};

macro_rules! regimes {
    ($($(#[$doc:meta])* $regime:ident $name:literal,)*) => {
        /// A region of states, or of layouts, in which a particular error can occur. Units of mass and length are 1 kg and 1 m
        /// for links of 10 g to 100 kg in arms of 1 cm to 100 m, else by factors of a hundred those of the robot's size.
        #[derive(Clone, Copy, Debug, PartialEq, Eq)]
        pub enum Regime {
            $($(#[$doc])* $regime,)*
        }

        /// Every regime.
        pub const REGIMES: [Regime; [$($name),*].len()] = [$(Regime::$regime),*];

        impl Regime {
            /// As printed.
            #[must_use]
            pub fn name(self) -> &'static str {
                match self {
                    $(Self::$regime => $name,)*
                }
            }
        }
    };
}

regimes! {
    /// Everything moves, at about 1 rad/s.
    Moving "moving",
    /// Nothing moves: accelerations come from forces alone.
    AtRest "at rest",
    /// 100 rad/s, and 100 units of length a second: the bias dominates.
    Fast "fast",
    /// All joints but the first at 0.
    Stretched "stretched",
    /// All joints but the first at ±π.
    Folded "folded",
    /// Joints at multiples of π, less than 0.001 and more than 10⁻¹² off.
    NearSingular "near singular",
    /// The base 10⁶ units of length away, turned several times.
    Far "far away",
    /// Links a thousandth to a millionth of their mass and inertia.
    LightLinks "light links",
    /// Links a thousand to a million times their mass and inertia.
    HeavyLinks "heavy links",
    /// Every body's mass and inertia off by a factor of its own, up to a thousand.
    MixedMasses "mixed masses",
    /// Other lengths, mounts and centres of mass, up to three times as large or as small, structural zeros aside, and
    /// the last links' centres of mass anywhere. No links or distances of mounts that are far shorter than the arms:
    /// generated forward dynamics lose digits with the square of that ratio.
    OtherShape "other shape",
    /// Targets of 10⁻⁶ to 10⁻³ units of mass.
    LightTargets "light targets",
    /// Targets of 10³ to 10⁶ units of mass.
    HeavyTargets "heavy targets",
}

/// A robot and a state of it.
#[derive(Clone, Debug, PartialEq)]
pub struct RegimeSample {
    /// With the masses of the regime.
    pub layout: Layout,
    /// State, forces, targets.
    pub instant: EvaluationInput,
}

impl Regime {
    /// Sample `index` of the regime for a layout: any one alone, the same on every machine.
    #[must_use]
    pub fn sample(self, layout: &Layout, seed: u64, index: u64) -> RegimeSample {
        let mut random = Random::new(seed, self, index);
        let units = Units::of(layout);
        let layout = self.layout(layout, &units, &mut random);
        let instant = self.instant(&layout, &units, &mut random);
        RegimeSample { layout, instant }
    }

    fn layout(self, layout: &Layout, units: &Units, random: &mut Random) -> Layout {
        let mut layout = layout.clone();
        let common = match self {
            Self::LightLinks => random.decades(-6.0, -3.0),
            Self::HeavyLinks => random.decades(3.0, 6.0),
            _ => 1.0,
        };
        let mut scale = |mass: &mut f64, inertia: &mut f64, common: f64| {
            let own = if self == Self::MixedMasses { random.decades(-3.0, 3.0) } else { 1.0 };
            *mass *= common * own;
            *inertia *= common * own;
        };
        scale(&mut layout.base.mass, &mut layout.base.inertia, 1.0);
        for link in layout.arms.iter_mut().flat_map(|arm| &mut arm.links) {
            scale(&mut link.mass, &mut link.inertia, common);
        }
        if self == Self::OtherShape {
            reshape(&mut layout, units, random);
        }
        layout
    }

    fn instant(self, layout: &Layout, units: &Units, random: &mut Random) -> EvaluationInput {
        let joints = layout.joints();
        let distance = units.length * if self == Self::Far { 1e6 } else { 2.0 };
        let turns = if self == Self::Far { 10.0 } else { 1.0 };
        let speed = match self {
            Self::AtRest => 0.0,
            Self::Fast => 100.0,
            _ => 1.0,
        };
        let state = RobotState {
            base_pose: [random.within(turns * PI), random.within(distance), random.within(distance)],
            joint_angles: layout
                .arms
                .iter()
                .flat_map(|arm| 0..arm.links.len())
                .map(|link| self.joint_angle(link, random))
                .collect(),
            base_twist: units.twist(random.vector(speed)),
            joint_rates: (0..joints).map(|_| random.within(speed)).collect(),
        };
        let arms = layout.arms.len();
        EvaluationInput {
            state,
            joint_torques: (0..joints).map(|_| units.torque() * random.within(10.0)).collect(),
            base_wrench: random.coin().then(|| units.wrench(random.vector(10.0))),
            end_effector_wrenches: random
                .coin()
                .then(|| (0..arms).map(|_| units.wrench(random.vector(10.0))).collect()),
            // most arms have one
            targets: (0..arms).map(|_| (random.coin() || random.coin()).then(|| self.target(units, random))).collect(),
        }
    }

    fn joint_angle(self, link: usize, random: &mut Random) -> f64 {
        let straight = random.coin();
        let side = if random.coin() { 1.0 } else { -1.0 };
        let off = random.decades(-12.0, -3.0);
        let any = random.within(PI);
        match self {
            Self::NearSingular if straight => side * off,
            Self::NearSingular => side * (PI - off),
            Self::Stretched if link > 0 => 0.0,
            Self::Folded if link > 0 => side * PI,
            _ => any,
        }
    }

    fn target(self, units: &Units, random: &mut Random) -> Target<f64> {
        let mass = match self {
            Self::LightTargets => random.decades(-6.0, -3.0),
            Self::HeavyTargets => random.decades(3.0, 6.0),
            _ => random.decades(0.0, 2.0),
        };
        let inertia = mass * random.decades(-2.0, 0.0);
        units.target(&Target {
            mass,
            inertia,
            contact: [random.within(0.5), random.within(0.5)],
            twist: random.vector(1.0),
        })
    }
}

/// A moving robot of a structure whose numbers are all others than the layout's, of like size, and of four digits, so that each
/// parameter, force and target has a part in the results. Its bodies are about as heavy as the layout's heaviest link, and
/// about as long as its longest. Sines and cosines of their angles, and of those between neighbours, are far from 0.
pub(super) fn balanced(layout: &Layout, structure: &Structure) -> RegimeSample {
    let mut random = Random::new(1, Regime::OtherShape, 0);
    let links = || layout.arms.iter().flat_map(|arm| &arm.links);
    let mass = links().map(|link| link.mass).fold(0.0, f64::max);
    let length = links().map(|link| link.length).fold(0.0, f64::max);
    // a robot of wheels alone has none
    let length = if length > 0.0 { length } else { 1.0 };
    let mut layout = layout.clone();
    let mut numbers = layout.parameters_mut();
    for (kind, arm, link) in &structure.parameters {
        let (size, has_sign) = match kind {
            ParameterKind::BaseMass | ParameterKind::LinkMass => (mass, false),
            ParameterKind::BaseInertia | ParameterKind::LinkInertia => (0.1 * mass * length * length, false),
            ParameterKind::LinkLength => (length, false),
            ParameterKind::MountAngle => (1.0, true),
            ParameterKind::MountX | ParameterKind::MountY => (0.5 * length, true),
            ParameterKind::LinkComX | ParameterKind::LinkComY => (0.3 * length, true),
        };
        let sign = if has_sign && random.coin() { -1.0 } else { 1.0 };
        let number = four_digits(sign * size * random.factor());
        if let Some((.., place)) = numbers.iter_mut().find(|(k, a, l, _)| (k, a, l) == (kind, arm, link)) {
            **place = number;
        }
    }
    let units = Units { mass, length };
    let mut instant = Regime::Moving.instant(&layout, &units, &mut random);
    instant.state.base_pose[0] = random.oblique(1.0);
    let mut joint_angles = instant.state.joint_angles.iter_mut();
    for arm in &layout.arms {
        let (mut yaw, mut side) = (instant.state.base_pose[0] + arm.mount_angle, 1.0);
        for angle in joint_angles.by_ref().take(arm.links.len()) {
            side = -side;
            let next = random.oblique(side);
            *angle = libm::remainder(next - yaw, TAU);
            yaw = next;
        }
    }
    // of the size of what the motion takes
    instant.joint_torques.iter_mut().for_each(|torque| *torque *= 0.1);
    instant.base_wrench = Some(units.wrench(random.vector(1.0)));
    instant.end_effector_wrenches = Some(layout.arms.iter().map(|_| units.wrench(random.vector(1.0))).collect());
    instant.targets = layout.arms.iter().map(|_| Some(Regime::Moving.target(&units, &mut random))).collect();
    RegimeSample { layout, instant }
}

/// A number with four digits.
pub(super) fn four_digits(number: f64) -> f64 {
    rounded(number, 3)
}

/// A number with so many decimals in scientific notation.
pub(super) fn rounded(number: f64, decimals: usize) -> f64 {
    format!("{number:.decimals$e}").parse().expect("a number that was written is read")
}

/// Other numbers of the same structure: zeros stay, save those of the last links' centres of mass.
fn reshape(layout: &mut Layout, units: &Units, random: &mut Random) {
    for arm in &mut layout.arms {
        arm.mount = arm.mount.map(|x| x * random.factor()); // the signs stay, so that mounts stay apart
        arm.mount_angle *= random.factor();
        for link in &mut arm.links {
            link.length *= random.factor();
            link.com = link.com.map(|x| x * random.factor());
        }
        if let Some(last) = arm.links.last_mut() {
            last.com = last.com.map(|x| x + units.length * random.within(0.3));
        }
    }
}

/// Units of mass (kg) and length (m) in which a robot's bodies are of a usual size; time is in seconds. See [`Regime`].
pub(super) struct Units {
    mass: f64,
    length: f64,
}

impl Units {
    /// Those of its heaviest link, and of its longest arm.
    pub(super) fn of(layout: &Layout) -> Self {
        let heaviest = layout.arms.iter().flat_map(|arm| &arm.links).map(|link| link.mass).fold(0.0, f64::max);
        Self { mass: hundreds(heaviest), length: hundreds(layout.reach_from_base()) }
    }

    fn torque(&self) -> f64 {
        self.mass * self.length * self.length
    }

    fn twist(&self, [omega, vx, vy]: [f64; 3]) -> [f64; 3] {
        [omega, self.length * vx, self.length * vy]
    }

    fn wrench(&self, [torque, fx, fy]: [f64; 3]) -> [f64; 3] {
        let force = self.mass * self.length;
        [self.torque() * torque, force * fx, force * fy]
    }

    /// A target in kg and m, of one in these units.
    pub(super) fn target(&self, target: &Target<f64>) -> Target<f64> {
        Target {
            mass: self.mass * target.mass,
            inertia: self.torque() * target.inertia,
            contact: target.contact.map(|x| self.length * x),
            twist: self.twist(target.twist),
        }
    }
}

/// The power of 100 next to a size on the side of 1; 1 for a size of 0.
fn hundreds(size: f64) -> f64 {
    if size > 0.0 { libm::pow(100.0, libm::trunc(libm::log10(size) / 2.0)) } else { 1.0 }
}

/// Numbers of one sample: a stream of its own for every regime and index.
struct Random(ChaCha8Rng);

impl Random {
    fn new(seed: u64, regime: Regime, index: u64) -> Self {
        let mut generator = ChaCha8Rng::seed_from_u64(seed);
        generator.set_stream(((regime as u64) << 48) | index);
        Self(generator)
    }

    /// In [0, 1): 53 random bits, so that the value is the same wherever it is computed.
    #[allow(clippy::cast_precision_loss, reason = "53 bits fit")]
    fn unit(&mut self) -> f64 {
        (self.0.next_u64() >> 11) as f64 * (0.5_f64).powi(53)
    }

    fn within(&mut self, size: f64) -> f64 {
        size * (2.0 * self.unit() - 1.0)
    }

    fn vector(&mut self, size: f64) -> [f64; 3] {
        [self.within(size), self.within(size), self.within(size)]
    }

    fn coin(&mut self) -> bool {
        self.unit() < 0.5
    }

    /// An angle in one of the four quadrants, 0.2 to 0.4 rad from its middle to one side.
    fn oblique(&mut self, side: f64) -> f64 {
        let quadrant = libm::floor(4.0 * self.unit()) - 2.0;
        (quadrant + 0.5) * FRAC_PI_2 + side * (0.2 + 0.2 * self.unit())
    }

    /// Up to three times as large or as small.
    fn factor(&mut self) -> f64 {
        self.decades(-0.5, 0.5)
    }

    /// 10 to a power between two.
    fn decades(&mut self, from: f64, to: f64) -> f64 {
        libm::pow(10.0, from + (to - from) * self.unit())
    }
}

#[cfg(test)]
mod tests {
    use super::balanced;
    use planar_layout::layout::Layout;
    use planar_layout::structure::Structure;

    /// No term with a sine or a cosine vanishes from the results of a balanced robot.
    #[test]
    fn bodies_of_a_balanced_robot_are_oblique() {
        for name in ["single_arm_2r", "dual_arm_3r", "asymmetric_wheel", "boom_7r"] {
            let file = format!("{}/../../codegen/layouts/{name}.toml", env!("CARGO_MANIFEST_DIR"));
            let layout = Layout::read(file.as_ref()).expect("a layout");
            let parameters = layout.parameters().into_iter().map(|(kind, arm, link, _)| (kind, arm, link)).collect();
            let links = layout.arms.iter().map(|arm| arm.links.len()).collect();
            let sample = balanced(&layout, &Structure { links, parameters, needs_distinct_mounts: false });
            let state = &sample.instant.state;
            let mut joint_angles = state.joint_angles.iter();
            let mut angles = vec![state.base_pose[0]];
            for arm in &sample.layout.arms {
                let mut yaw = state.base_pose[0] + arm.mount_angle;
                for (link, angle) in joint_angles.by_ref().take(arm.links.len()).enumerate() {
                    yaw += angle;
                    angles.push(yaw);
                    if link > 0 {
                        angles.push(*angle);
                    }
                }
            }
            for angle in angles {
                let (sine, cosine) = angle.sin_cos();
                assert!(sine.abs().min(cosine.abs()) > 0.35, "{name}: {angle}");
            }
        }
    }
}
