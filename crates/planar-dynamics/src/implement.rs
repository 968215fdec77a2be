//! Implements the traits of [`dynamics`](crate::dynamics) for generated models, by their inherent functions.

/// The traits of [`crate::dynamics`] for the `Model` of a rendered module; for generated code only.
///
/// The argument is the format of that code: code of another format does not compile.
#[doc(hidden)]
#[macro_export]
macro_rules! implement_dynamics {
    (5) => {
        $crate::implement_dynamics!(@one_by_one);
        $crate::implement_batch!();
    };
    (@one_by_one) => {
        mod traits {
            use super::{ARMS, JOINTS, MANIFEST, Model, PARAMETERS, Parameters};
            use $crate::dynamics::{
                ForwardDynamics, Impact, Merge, Momentum, MomentumAndEnergy, ReducedDynamics, Robot, TorquesAt,
            };
            use $crate::error::Error;
            use $crate::integrate::step_at_once::{Accelerate, Accelerations, Half, step_at_once};
            use $crate::manifest::ParameterKind;
            use $crate::objection;
            use $crate::scalar::Real;
            use $crate::state::{Forces, State, vector_length};
            use $crate::target::{LinkInertia, Target};
            use $crate::validate::{
                all_finite, are_regular_and_finite, array, array_mut, finite, finite_configuration, finite_joint_arrays, finite_target,
                is_regular_and_finite, joint_arrays, pivot, pivot_of, rows_mut, store, store_rows,
            };

            impl<T: Real> Robot<T> for Model<T> {
                fn arms(&self) -> usize {
                    ARMS
                }

                fn joints(&self) -> usize {
                    JOINTS
                }

                fn body_inertias(&self, inertias: &mut [[T; 2]]) -> Result<(), Error> {
                    let mut values = self.parameters().to_array();
                    let mut body = |kinds: [ParameterKind; 2], arm, link| -> Result<[T; 2], Error> {
                        let [mass, inertia] = kinds.map(|kind| parameter(&mut values, kind, arm, link).copied());
                        Ok([mass?, inertia?])
                    };
                    let mut bodies = [[T::ZERO; 2]; JOINTS + 1];
                    bodies[0] = body([ParameterKind::BaseMass, ParameterKind::BaseInertia], 0, 0)?;
                    let links =
                        MANIFEST.links.iter().enumerate().flat_map(|(arm, n)| (0..*n).map(move |link| (arm, link)));
                    for (place, (arm, link)) in bodies.iter_mut().skip(1).zip(links) {
                        *place = body([ParameterKind::LinkMass, ParameterKind::LinkInertia], arm, link)?;
                    }
                    store_rows("body_inertias", &bodies, inertias)
                }
            }

            $crate::with_quantities!($crate::implement_functions);

            impl<T: Real> ReducedDynamics<T> for Model<T> {
                #[cfg_attr(target_arch = "arm", inline(always))]
                #[cfg_attr(not(target_arch = "arm"), inline)]
                fn reduced_dynamics(
                    &self,
                    state: &State<'_, T>,
                    generalized_inertia: &mut [T],
                    generalized_bias: &mut [T],
                    generalized_jacobian: &mut [T],
                ) -> Result<(), Error> {
                    let [angles, rates] = joint_arrays(state)?;
                    let inertia = rows_mut("generalized_inertia", generalized_inertia)?;
                    let bias = array_mut("generalized_bias", generalized_bias)?;
                    let jacobian = rows_mut("generalized_jacobian", generalized_jacobian)?;
                    let (pose, twist) = (&state.base_pose, &state.base_twist);
                    $crate::implement_dynamics!(@finite pose twist);
                    let result = Model::reduced_dynamics_with_pivot::<false>(self, pose, angles, twist, rates);
                    *inertia = result.generalized_inertia;
                    *bias = result.generalized_bias;
                    *jacobian = result.generalized_jacobian;
                    let pivot = result.smallest_pivot;
                    // the linear rows of the Jacobian depend on all angles, the bias on all rates and what is in the angular rows
                    let linear = jacobian.as_chunks::<3>().0.iter().map(|arm| arm[1..].as_flattened());
                    let upper = inertia.iter().enumerate().map(|(index, row)| row.get(index..).unwrap_or_default());
                    if !are_regular_and_finite(pivot, linear.chain(upper), [bias]) {
                        let found = objection::to_joints(angles, rates)
                            .or(|| objection::to_base_inertia(pivot))
                            .or(|| objection::to_reduced_dynamics(inertia, bias, jacobian))
                            .unless_of_parameters(|| to_parameters(self));
                        *inertia = [[T::ZERO; JOINTS]; JOINTS];
                        *bias = [T::ZERO; JOINTS];
                        *jacobian = [[T::ZERO; JOINTS]; 3 * ARMS];
                        return Err(found.error());
                    }
                    Ok(())
                }
            }

            impl<T: Real> ForwardDynamics<T> for Model<T> {
                #[inline(always)]
                fn forward_dynamics(
                    &self,
                    state: &State<'_, T>,
                    forces: &Forces<'_, T>,
                    joint_accelerations: &mut [T],
                ) -> Result<[T; 3], Error> {
                    let [angles, rates] = joint_arrays(state)?;
                    let torques = array("joint_torques", forces.joint_torques)?;
                    let joints = array_mut("joint_accelerations", joint_accelerations)?;
                    let zero = [T::ZERO; 3];
                    let wrench = forces.base_wrench.as_ref().unwrap_or(&zero);
                    if let Some(wrenches) = forces.end_effector_wrenches {
                        let wrenches = array("end_effector_wrenches", wrenches)?;
                        under_wrenches(self, state, angles, rates, torques, wrench, wrenches, joints)
                    } else if forces.base_wrench.is_some() {
                        under_a_base_wrench(self, state, angles, rates, torques, wrench, joints)
                    } else {
                        under_torques(self, state, angles, rates, torques, joints)
                    }
                }

                #[inline(always)]
                fn step_at_once(
                    &self,
                    torques_at: Option<&mut TorquesAt<'_, T>>,
                    time_and_step: [T; 2],
                    x: &mut [T],
                    torques: &mut [T],
                ) -> Option<()> {
                    const LENGTH: usize = vector_length(JOINTS);
                    // a large robot's vectors do not belong on the stack, and are no faster there where registers are few
                    if LENGTH > 32 || cfg!(target_arch = "arm") {
                        return None;
                    }
                    match torques_at {
                        Some(torques_at) => {
                            step_at_once::<_, JOINTS, LENGTH>(self, torques_at, time_and_step, x, torques)
                        }
                        None => {
                            let constant = &mut |_, _: &[T], _: &mut [T]| Some(());
                            step_at_once::<_, JOINTS, LENGTH>(self, constant, time_and_step, x, torques)
                        }
                    }
                }
            }

            impl<T: Real> Accelerate<T, JOINTS> for Model<T> {
                #[inline(always)]
                fn accelerate(
                    &self,
                    [(base_pose, joint_angles), (base_twist, joint_rates)]: [Half<'_, T, JOINTS>; 2],
                    joint_torques: &[T; JOINTS],
                ) -> Accelerations<T, JOINTS> {
                    let result = self
                        .forward_dynamics_configuration(base_pose, joint_angles)
                        .forward_dynamics_with_pivot::<false>(base_twist, joint_rates, joint_torques);
                    Accelerations {
                        base: result.base_acceleration,
                        joints: result.joint_accelerations,
                        smallest_pivot: result.smallest_pivot,
                    }
                }
            }

            $crate::implement_dynamics!(@accelerations under_torques forward_dynamics_with_pivot());
            $crate::implement_dynamics!(
                @accelerations under_a_base_wrench forward_dynamics_with_base_wrench_with_pivot(base_wrench: &[T; 3] => base_wrench)
            );
            $crate::implement_dynamics!(
                @accelerations under_wrenches forward_dynamics_with_wrenches_with_pivot(
                    base_wrench: &[T; 3] => base_wrench, wrenches: &[[T; 3]; ARMS] => wrenches.as_flattened()
                )
            );

            impl<T: Real> MomentumAndEnergy<T> for Model<T> {
                fn momentum(&self, state: &State<'_, T>) -> Result<Momentum<T>, Error> {
                    let [angles, rates] = finite_joint_arrays(state)?;
                    let result = Model::momentum(self, &state.base_pose, angles, &state.base_twist, rates);
                    finite("linear_momentum", &result.linear_momentum)?;
                    finite("angular_momentum", &[result.angular_momentum])?;
                    finite("kinetic_energy", &[result.kinetic_energy])?;
                    Ok(Momentum {
                        linear_momentum: result.linear_momentum,
                        angular_momentum: result.angular_momentum,
                        kinetic_energy: result.kinetic_energy,
                    })
                }
            }

            impl<T: Real> Impact<T> for Model<T> {
                fn reduced_impact(
                    &self,
                    state: &State<'_, T>,
                    targets: &[Option<Target<T>>],
                    impact_matrix: &mut [T],
                    impact_momentum: &mut [T],
                    joint_rates_after: &mut [T],
                ) -> Result<(), Error> {
                    let [angles, rates] = finite_joint_arrays(state)?;
                    let (masses, inertias, contacts, twists) = by_arm(finite_targets(targets)?);
                    let pose = &state.base_pose;
                    let result = Model::reduced_impact_with_pivot::<false>(
                        self, pose, angles, rates, &masses, &inertias, &contacts, &twists,
                    );
                    pivot_of(|| self.parameters().to_array(), "the impact matrix G", result.smallest_pivot)?;
                    store("impact_matrix", result.impact_matrix.as_flattened(), impact_matrix)?;
                    store("impact_momentum", &result.impact_momentum, impact_momentum)?;
                    store("joint_rates_after", &result.joint_rates_after, joint_rates_after)
                }

                #[cfg_attr(target_arch = "arm", inline(always))]
                #[cfg_attr(not(target_arch = "arm"), inline)]
                fn full_impact(
                    &self,
                    state: &State<'_, T>,
                    targets: &[Option<Target<T>>],
                    joint_rates_after: &mut [T],
                ) -> Result<[T; 3], Error> {
                    let [angles, rates] = joint_arrays(state)?;
                    let of_arms = array("targets", targets)?;
                    let joints = array_mut("joint_rates_after", joint_rates_after)?;
                    let (pose, twist) = (&state.base_pose, &state.base_twist);
                    $crate::implement_dynamics!(@finite pose twist);
                    // the targets' numbers are read after the sines, which would have to keep them
                    let configuration = Model::impact_configuration(self, pose, angles);
                    let (masses, inertias, contacts, twists) = by_arm(of_arms);
                    let result = configuration
                        .full_impact_with_pivot::<false>(twist, rates, &masses, &inertias, &contacts, &twists);
                    // copies: a result whose parts are borrowed would be kept in memory as a whole, with its matrix
                    let (base, after) = (result.base_twist_after, result.joint_rates_after);
                    *joints = after;
                    // the velocities depend on all numbers but the place of the base
                    if !is_regular_and_finite(result.smallest_pivot, [&base, &after]) {
                        let [omega, vx, vy] = base;
                        let found = objection::to_joints(angles, rates)
                            .or(|| objection::to_targets(of_arms))
                            .or(|| objection::to_impact_matrix(result.smallest_pivot))
                            .or(|| objection::to_velocities_after(joints, omega, vx, vy))
                            .unless_of_parameters(|| to_parameters(self));
                        *joints = [T::ZERO; JOINTS];
                        return Err(found.error());
                    }
                    Ok(base)
                }
            }

            impl<T: Real> Merge<T> for Model<T> {
                fn merge(
                    &mut self,
                    base_pose: &[T; 3],
                    joint_angles: &[T],
                    targets: &[Option<Target<T>>],
                ) -> Result<(), Error> {
                    finite_configuration(base_pose, joint_angles)?;
                    let targets = finite_targets(targets)?;
                    let end_effectors =
                        Model::end_effector_poses(self, base_pose, array("joint_angles", joint_angles)?);
                    let mut values = self.parameters().to_array();
                    for (arm, ((target, end_effector), places)) in
                        (0..ARMS).zip(targets.iter().zip(&end_effectors).zip(&LAST_LINKS))
                    {
                        let Some(target) = target else { continue };
                        let value = |(kind, index): (ParameterKind, Option<usize>)| {
                            let link = MANIFEST.links.get(arm).map_or(0, |links| links.saturating_sub(1));
                            let found = index.and_then(|index| values.get(index)).copied();
                            found.ok_or(Error::Parameter { kind, arm, link })
                        };
                        let [mass, inertia, x, y, length] = *places;
                        let before = LinkInertia { mass: value(mass)?, inertia: value(inertia)?, com: [value(x)?, value(y)?] };
                        let after = target.merged_link(&before, value(length)?, end_effector[0]);
                        let [com_x, com_y] = after.com;
                        for ((_, index), number) in
                            [mass, inertia, x, y].into_iter().zip([after.mass, after.inertia, com_x, com_y])
                        {
                            if let Some(place) = index.and_then(|index| values.get_mut(index)) {
                                *place = number;
                            }
                        }
                    }
                    if !all_finite([&values[..]]) {
                        finite("merged parameters", &{ values })?;
                    }
                    let parameters = Parameters::from_array(values);
                    pivot("the merged robot", T::ONE + parameters.regularity())?;
                    *self = Model::new(parameters);
                    Ok(())
                }
            }

            /// Places of mass, inertia, COM and length of each arm's last link among the parameters: never structural zeros.
            const LAST_LINKS: [[(ParameterKind, Option<usize>); 5]; ARMS] = {
                use ParameterKind::{LinkComX, LinkComY, LinkInertia, LinkLength, LinkMass};
                let kinds = [LinkMass, LinkInertia, LinkComX, LinkComY, LinkLength];
                let mut places = [[(LinkMass, None); 5]; ARMS];
                let mut arm = 0;
                while arm < ARMS {
                    let mut k = 0;
                    while k < kinds.len() {
                        places[arm][k] = (kinds[k], MANIFEST.position(kinds[k], arm, MANIFEST.links[arm].saturating_sub(1)));
                        k += 1;
                    }
                    arm += 1;
                }
                places
            };

            /// The value of a parameter that is never a structural zero: a mass, an inertia, or any of a last link.
            fn parameter<T>(
                values: &mut [T; PARAMETERS],
                kind: ParameterKind,
                arm: usize,
                link: usize,
            ) -> Result<&mut T, Error> {
                let index = MANIFEST.position(kind, arm, link);
                index.and_then(|index| values.get_mut(index)).ok_or(Error::Parameter { kind, arm, link })
            }

            type ByArm<T> = ([T; ARMS], [T; ARMS], [[T; 2]; ARMS], [[T; 3]; ARMS]);

            #[cold]
            #[inline(never)]
            fn to_parameters<T: Real>(model: &Model<T>) -> objection::Objection<T> {
                objection::to_parameters(&model.parameters().to_array())
            }

            /// Targets with finite numbers, one per arm.
            fn finite_targets<T: Real>(targets: &[Option<Target<T>>]) -> Result<&[Option<Target<T>>; ARMS], Error> {
                let targets: &[Option<Target<T>>; ARMS] = array("targets", targets)?;
                targets.iter().flatten().try_for_each(finite_target)?;
                Ok(targets)
            }

            /// Masses, inertias, contacts and twists, one per arm; those of a massless target for an arm without one.
            #[inline]
            fn by_arm<T: Real>(targets: &[Option<Target<T>>; ARMS]) -> ByArm<T> {
                let nothing = &Target::massless();
                let of_arms = targets.each_ref().map(|target| target.as_ref().unwrap_or(nothing));
                let (masses, inertias) = (of_arms.map(|target| target.mass), of_arms.map(|target| target.inertia));
                let (contacts, twists) = (of_arms.map(|target| target.contact), of_arms.map(|target| target.twist));
                (masses, inertias, contacts, twists)
            }
        }
    };
    (@accelerations $name:ident $function:ident($($wrench:ident: $type:ty => $slice:expr),*)) => {
        /// The accelerations, unless an input is not finite or the matrix singular. Inlined: the caller's state and forces are
        /// then not passed through memory, and where registers are few in no frame, nor is the error that it does not look at.
        #[inline(always)]
        #[allow(clippy::too_many_arguments, reason = "those of the inherent function, and the result")]
        fn $name<T: Real>(
            model: &Model<T>,
            state: &State<'_, T>,
            angles: &[T; JOINTS],
            rates: &[T; JOINTS],
            torques: &[T; JOINTS],
            $($wrench: $type,)*
            joints: &mut [T; JOINTS],
        ) -> Result<[T; 3], Error> {
            let (pose, twist) = (&state.base_pose, &state.base_twist);
            // neither pivot nor accelerations depend on place and velocity of the base, and on all else they do
            $crate::implement_dynamics!(@finite pose twist);
            let result = Model::$function::<false>(model, pose, angles, twist, rates, torques $(, $wrench)*);
            let (base, of_joints) = (result.base_acceleration, result.joint_accelerations);
            // the angular acceleration of the base is a part of the first joint's
            if !is_regular_and_finite(result.smallest_pivot, [&base[1..], &of_joints]) {
                let [alpha, ax, ay] = base;
                // copies: what a function borrows is in memory, where it could have been in registers, unless those are few
                let mut copies = (*angles, *rates, *torques, of_joints);
                let (angles, rates, torques, joints) = if cfg!(target_arch = "arm") {
                    *joints = of_joints;
                    (angles, rates, torques, joints)
                } else {
                    *joints = [T::ZERO; JOINTS];
                    (&copies.0, &copies.1, &copies.2, &mut copies.3)
                };
                let wrenches: &[&[T]] = &[$($slice),*];
                let pivot = result.smallest_pivot;
                let found = objection::to_accelerations(angles, rates, torques, joints, wrenches, pivot, alpha, ax, ay);
                return Err(found.unless_of_parameters(|| to_parameters(model)).error());
            }
            *joints = of_joints;
            Ok(base)
        }
    };
    // before anything is computed: until afterwards, these numbers would take registers
    (@finite $pose:ident $twist:ident) => {
        if !all_finite([&$pose[..], $twist]) {
            let ([yaw, x, y], [omega, vx, vy]) = (*$pose, *$twist);
            return Err(objection::to_base(yaw, x, y, omega, vx, vy).error());
        }
    };
    ($other:tt) => {
        compile_error!("this code was generated for another version of planar-capture: generate it again");
    };
}

/// Without the feature `batch` there is nothing to implement.
#[cfg(not(feature = "batch"))]
#[doc(hidden)]
#[macro_export]
macro_rules! implement_batch {
    () => {};
}

/// The traits of [`with_quantities!`](crate::with_quantities) for a rendered model.
#[doc(hidden)]
#[macro_export]
macro_rules! implement_functions {
    (
        functions { $($(#[$doc:meta])* trait $trait:ident {
            $($(#[$of_method:meta])* $quantity:ident $method:ident($inputs:ident) $kind:ident $extents:tt $unit:literal, $shown:expr;)*
        })* }
        results $results:tt
    ) => {
        $(impl<T: Real> $crate::dynamics::$trait<T> for Model<T> {
            $($crate::implement_functions!(@method $method($inputs) $kind);)*
        })*
    };
    (@method $method:ident(configuration) $kind:ident) => {
        fn $method(
            &self,
            base_pose: &[T; 3],
            joint_angles: &[T],
            into: &mut [$crate::element!($kind T)],
        ) -> Result<(), Error> {
            finite_configuration(base_pose, joint_angles)?;
            let result = Model::$method(self, base_pose, array("joint_angles", joint_angles)?);
            $crate::implement_functions!(@store $kind $method result into)
        }
    };
    (@method $method:ident(state) $kind:ident) => {
        fn $method(
            &self,
            state: &State<'_, T>,
            into: &mut [$crate::element!($kind T)],
        ) -> Result<(), Error> {
            let [angles, rates] = finite_joint_arrays(state)?;
            let result = Model::$method(self, &state.base_pose, angles, &state.base_twist, rates);
            $crate::implement_functions!(@store $kind $method result into)
        }
    };
    (@store triples $method:ident $result:ident $into:ident) => { store_rows(stringify!($method), &$result, $into) };
    (@store matrix $method:ident $result:ident $into:ident) => { store(stringify!($method), $result.as_flattened(), $into) };
    (@store vector $method:ident $result:ident $into:ident) => { store(stringify!($method), &$result, $into) };
}

/// The module of a layout that [`build::render`](https://docs.rs/planar-capture) wrote in the crate's build script.
///
/// `include_layout!("my_robot");` is `pub mod my_robot { … }`.
#[macro_export]
macro_rules! include_layout {
    ($name:literal) => {
        include!(concat!(env!("OUT_DIR"), "/", $name, ".rs"));
    };
}
