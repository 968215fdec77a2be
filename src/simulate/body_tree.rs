//! Momentum, energy and centre of mass of a robot and of the bodies beside it at several instants at once, in the vectors of
//! the processor that the program runs on.

use crate::dynamics::AnyModel;
use crate::error::Error;
use crate::frames::{point, turned};
use crate::scalar::Scalar;
use crate::scalar::lane::Lane;
use crate::simulate::bodies::BodySums;
use crate::simulate::equation::CanonicalStorage;
use crate::simulate::system::Body;
use multiversion::multiversion;

/// Number of instants.
pub(crate) const LANES: usize = 8;

/// A number at each instant.
pub(crate) type Lanes = [f64; LANES];

/// The bodies of a robot, each after the one that carries it, then those beside it.
#[derive(Clone, Debug)]
pub(crate) struct BodyTree {
    nodes: Vec<Node>,
    motions: Vec<Motion>,
}

/// A body.
#[derive(Clone, Copy, Debug)]
struct Node {
    /// kg.
    mass: f64,
    /// About its COM, kg m².
    inertia: f64,
    place: Place,
}

/// What determines where a body is.
#[derive(Clone, Copy, Debug)]
enum Place {
    /// Its own pose and twist, by the row of the first coordinate.
    Free(usize),
    /// A joint on a body before it.
    Carried {
        by: usize,
        /// The row of the joint's angle.
        joint: usize,
        /// Yaw from that of the body that carries it, where the angle is 0, rad.
        angle: f64,
        /// The joint from the COM of the body that carries it, in that body's axes, m.
        at: [f64; 2],
        /// The COM from the joint, in the body's axes, m.
        com: [f64; 2],
    },
}

/// Pose and twist of a body's COM, sine and cosine of its yaw.
#[derive(Clone, Copy, Debug, Default)]
struct Motion {
    yaw: Lanes,
    x: Lanes,
    y: Lanes,
    omega: Lanes,
    vx: Lanes,
    vy: Lanes,
    sin: Lanes,
    cos: Lanes,
}

/// Sums over the bodies.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct LaneSums {
    /// kg.
    mass: f64,
    first_moment: [Lanes; 2],
    momentum: [Lanes; 3],
    kinetic_energy: Lanes,
    momentum_sizes: [Lanes; 2],
    /// The largest distance of a body's COM from that of all, m.
    pub(crate) extent: Lanes,
}

impl BodyTree {
    /// Of a robot whose joints are measured in one pose, and of bodies beside it.
    pub(crate) fn new(model: &AnyModel<f64>, beside: &[Body]) -> Result<Self, Error> {
        let joints = model.joints();
        let at_zero = vec![0.0; joints];
        let CanonicalStorage { inertias, poses, offsets, leaves, .. } =
            CanonicalStorage::new(model, &[0.0; 3], &at_zero)?;
        let mut by = 0;
        let links = offsets.into_iter().zip(leaves).enumerate().map(|(joint, (com, is_last))| {
            let (carrier, link) = (poses[by], poses[joint + 1]);
            let [x, y] = point(link, com.map(|from_joint| -from_joint));
            let at = point([-carrier[0], 0.0, 0.0], [x - carrier[1], y - carrier[2]]);
            let place = Place::Carried { by, joint: 3 + joint, angle: link[0] - carrier[0], at, com };
            by = if is_last { 0 } else { joint + 1 };
            place
        });
        let places = std::iter::once(Place::Free(0)).chain(links);
        let node = |([mass, inertia], place): ([f64; 2], Place)| Node { mass, inertia, place };
        let mut nodes: Vec<_> = inertias.into_iter().zip(places).map(node).collect();
        let free = |(i, body): (usize, &Body)| node(([body.mass, body.inertia], Place::Free(3 + joints + 3 * i)));
        nodes.extend(beside.iter().enumerate().map(free));
        Ok(Self { motions: vec![Motion::default(); nodes.len()], nodes })
    }

    /// Number of coordinates.
    pub(crate) fn coordinates(&self) -> usize {
        self.nodes.iter().map(|node| if matches!(node.place, Place::Free(_)) { 3 } else { 1 }).sum()
    }

    /// The sums where positions and rates of the coordinates are these: base, joints, bodies beside the robot.
    pub(crate) fn sums(&mut self, positions: &[Lanes], rates: &[Lanes]) -> LaneSums {
        let mut sums = sweep::<false>(&self.nodes, positions, rates, &mut self.motions);
        if sums.kinetic_energy.iter().any(|energy| energy.is_nan()) {
            // angles far from 0
            sums = sweep::<true>(&self.nodes, positions, rates, &mut self.motions);
        }
        sums.extent = extent(&self.motions, &sums);
        sums
    }
}

impl LaneSums {
    /// Those of one instant.
    #[inline]
    pub(crate) fn at(&self, lane: usize) -> BodySums {
        let Self { first_moment: [mx, my], momentum: [l, px, py], momentum_sizes: [angular, linear], .. } = self;
        BodySums {
            mass: self.mass,
            first_moment: [mx[lane], my[lane]],
            momentum: [l[lane], px[lane], py[lane]],
            kinetic_energy: self.kinetic_energy[lane],
            momentum_sizes: [angular[lane], linear[lane]],
        }
    }

    /// Sets those of one instant but for the mass, which is that of all.
    #[inline]
    fn set(&mut self, lane: usize, sums: &BodySums) {
        let Self { first_moment: [mx, my], momentum: [l, px, py], momentum_sizes: [angular, linear], .. } = self;
        [mx[lane], my[lane]] = sums.first_moment;
        [l[lane], px[lane], py[lane]] = sums.momentum;
        self.kinetic_energy[lane] = sums.kinetic_energy;
        [angular[lane], linear[lane]] = sums.momentum_sizes;
    }
}

/// The motions of all bodies, and the sums over them; `FAR` says whether angles may be far from 0.
#[multiversion(targets("x86_64+avx512f+avx512dq+avx512vl+avx2", "x86_64+avx2"))]
fn sweep<const FAR: bool>(nodes: &[Node], positions: &[Lanes], rates: &[Lanes], motions: &mut [Motion]) -> LaneSums {
    // what is written is in variables of this function, which the compiler knows apart
    let mut all = LaneSums::default();
    for (i, node) in nodes.iter().enumerate() {
        let (mut own, mass, inertia) = (Motion::default(), node.mass, node.inertia);
        match node.place {
            Place::Free(first) => {
                (own.yaw, own.x, own.y) = (positions[first], positions[first + 1], positions[first + 2]);
                (own.omega, own.vx, own.vy) = (rates[first], rates[first + 1], rates[first + 2]);
                for l in 0..LANES {
                    (own.sin[l], own.cos[l]) = sin_cos::<FAR>(own.yaw[l]);
                }
            }
            Place::Carried { by, joint, angle, at, com } => {
                let (carrier, angles, turns) = (motions[by], positions[joint], rates[joint]);
                for l in 0..LANES {
                    let (yaw, omega) = (carrier.yaw[l] + angle + angles[l], carrier.omega[l] + turns[l]);
                    let (sin, cos) = sin_cos::<FAR>(yaw);
                    let [ax, ay] = turned(at, (carrier.sin[l], carrier.cos[l]));
                    let [cx, cy] = turned(com, (sin, cos));
                    (own.yaw[l], own.omega[l], own.sin[l], own.cos[l]) = (yaw, omega, sin, cos);
                    (own.x[l], own.y[l]) = (carrier.x[l] + ax + cx, carrier.y[l] + ay + cy);
                    own.vx[l] = carrier.vx[l] - carrier.omega[l] * ay - omega * cy;
                    own.vy[l] = carrier.vy[l] + carrier.omega[l] * ax + omega * cx;
                }
            }
        }
        for l in 0..LANES {
            let (pose, twist) = ([own.yaw[l], own.x[l], own.y[l]], [own.omega[l], own.vx[l], own.vy[l]]);
            all.set(l, &all.at(l).with(&Body { mass, inertia, pose, twist }));
        }
        all.mass += mass;
        motions[i] = own;
    }
    all
}

/// The largest distance of a body's COM from that of all, m.
#[multiversion(targets("x86_64+avx512f+avx512dq+avx512vl+avx2", "x86_64+avx2"))]
fn extent(motions: &[Motion], sums: &LaneSums) -> Lanes {
    let (center, mut most) = (sums.first_moment.map(|moment| moment.map(|moment| moment / sums.mass)), [0.0; LANES]);
    for Motion { x, y, .. } in motions {
        for l in 0..LANES {
            let [dx, dy] = [x[l] - center[0][l], y[l] - center[1][l]];
            let square = dx * dx + dy * dy;
            most[l] = if square > most[l] { square } else { most[l] };
        }
    }
    most.map(f64::sqrt)
}

/// NaN for angles that are far from 0 where they are not to be.
#[inline]
fn sin_cos<const FAR: bool>(angle: f64) -> (f64, f64) {
    if FAR {
        return Scalar::sin_cos(angle);
    }
    let (sin, cos) = Lane::<false>(angle).sin_cos();
    (sin.0, cos.0)
}
