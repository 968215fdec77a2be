//! Implements [`BatchModel`](super::BatchModel) for generated models.

/// [`BatchModel`](crate::batch::BatchModel) for the `Model` of a rendered module; for generated code only.
#[doc(hidden)]
#[macro_export]
macro_rules! implement_batch {
    () => {
        mod batch {
            #![allow(clippy::inline_always, reason = "what is not inlined has the instruction set of the build")]

            use super::{ARMS, JOINTS, Model};
            use $crate::batch::generated::{
                Checks, Lines, Number, Place, Rows, Statuses, put, put_matrix, take, take_matrix, where_finite, zeros,
                zeros_of_matrix,
            };
            use $crate::batch::{
                Accelerations, BatchModel, FullImpact, ReducedDynamics, ReducedImpact, States, StatesAfter, Status,
                Targets,
            };
            use $crate::state::RobotState;
            use $crate::validate::all_finite;

            /// States, or their rates.
            #[derive(Clone, Copy)]
            #[repr(C, align(64))]
            struct Block<const B: usize> {
                base_poses: Rows<3, B>,
                joint_angles: Rows<JOINTS, B>,
                base_twists: Rows<3, B>,
                joint_rates: Rows<JOINTS, B>,
            }

            type Single<T> = RobotState<T, [T; JOINTS]>;

            impl<const B: usize> Block<B> {
                const fn new(value: f64) -> Self {
                    Self {
                        base_poses: [[value; B]; 3],
                        joint_angles: [[value; B]; JOINTS],
                        base_twists: [[value; B]; 3],
                        joint_rates: [[value; B]; JOINTS],
                    }
                }

                #[inline(always)]
                fn load(&mut self, states: &States<'_>, place: Place) {
                    place.load(states.base_poses, &mut self.base_poses);
                    place.load(states.joint_angles, &mut self.joint_angles);
                    place.load(states.base_twists, &mut self.base_twists);
                    place.load(states.joint_rates, &mut self.joint_rates);
                }

                #[inline(always)]
                fn store(&self, statuses: &Statuses<B>, states: &mut StatesAfter<'_>, place: Place) {
                    place.store(&self.base_poses, statuses, states.base_poses);
                    place.store(&self.joint_angles, statuses, states.joint_angles);
                    place.store(&self.base_twists, statuses, states.base_twists);
                    place.store(&self.joint_rates, statuses, states.joint_rates);
                }

                #[inline(always)]
                fn take<T: Number>(&self, instance: usize) -> Single<T> {
                    let rows = Given {
                        base_poses: self.base_poses.each_ref(),
                        joint_angles: self.joint_angles.each_ref(),
                        base_twists: self.base_twists.each_ref(),
                        joint_rates: self.joint_rates.each_ref(),
                    };
                    rows.take(instance)
                }

                #[inline(always)]
                fn put<T: Number>(&mut self, state: &Single<T>, instance: usize) {
                    put(&state.base_pose, &mut self.base_poses, instance);
                    put(&state.joint_angles, &mut self.joint_angles, instance);
                    put(&state.base_twist, &mut self.base_twists, instance);
                    put(&state.joint_rates, &mut self.joint_rates, instance);
                }
            }

            /// States that are only read, where they are.
            struct Given<'a, const B: usize> {
                base_poses: [&'a [f64; B]; 3],
                joint_angles: [&'a [f64; B]; JOINTS],
                base_twists: [&'a [f64; B]; 3],
                joint_rates: [&'a [f64; B]; JOINTS],
            }

            /// Of the rows of [`Given`].
            type Copies<const B: usize> =
                (Option<Rows<3, B>>, Option<Rows<JOINTS, B>>, Option<Rows<3, B>>, Option<Rows<JOINTS, B>>);

            impl<'a, const B: usize> Given<'a, B> {
                #[inline(always)]
                fn of(states: &States<'a>, place: Place, copies: &'a mut Copies<B>) -> Self {
                    Self {
                        base_poses: place.rows(states.base_poses, &mut copies.0),
                        joint_angles: place.rows(states.joint_angles, &mut copies.1),
                        base_twists: place.rows(states.base_twists, &mut copies.2),
                        joint_rates: place.rows(states.joint_rates, &mut copies.3),
                    }
                }

                #[inline(always)]
                fn take<T: Number>(&self, instance: usize) -> Single<T> {
                    RobotState {
                        base_pose: take(&self.base_poses, instance),
                        joint_angles: take(&self.joint_angles, instance),
                        base_twist: take(&self.base_twists, instance),
                        joint_rates: take(&self.joint_rates, instance),
                    }
                }
            }

            #[inline(always)]
            fn zeros_of_state<T: Number>(state: &Single<T>) -> T {
                let positions = zeros(&state.base_pose) + zeros(&state.joint_angles);
                positions + (zeros(&state.base_twist) + zeros(&state.joint_rates))
            }

            /// Targets, where they are.
            struct GivenTargets<'a, const B: usize> {
                masses: [&'a [f64; B]; ARMS],
                inertias: [&'a [f64; B]; ARMS],
                contacts: [[&'a [f64; B]; 2]; ARMS],
                twists: [[&'a [f64; B]; 3]; ARMS],
            }

            /// Of the rows of [`GivenTargets`].
            type CopiesOfTargets<const B: usize> =
                (Option<Rows<ARMS, B>>, Option<Rows<ARMS, B>>, [Option<Rows<2, B>>; ARMS], [Option<Rows<3, B>>; ARMS]);

            /// Masses, inertias, contacts and twists.
            type SingleTargets<T> = ([T; ARMS], [T; ARMS], [[T; 2]; ARMS], [[T; 3]; ARMS]);

            impl<'a, const B: usize> GivenTargets<'a, B> {
                #[inline(always)]
                fn of(targets: &Targets<'a>, place: Place, copies: &'a mut CopiesOfTargets<B>) -> Self {
                    Self {
                        masses: place.rows(targets.masses, &mut copies.0),
                        inertias: place.rows(targets.inertias, &mut copies.1),
                        contacts: place.matrix_rows(targets.contacts, &mut copies.2),
                        twists: place.matrix_rows(targets.twists, &mut copies.3),
                    }
                }

                #[inline(always)]
                fn take<T: Number>(&self, instance: usize) -> SingleTargets<T> {
                    (
                        take(&self.masses, instance),
                        take(&self.inertias, instance),
                        take_matrix(&self.contacts, instance),
                        take_matrix(&self.twists, instance),
                    )
                }
            }

            #[inline(always)]
            fn zeros_of_targets<T: Number>((masses, inertias, contacts, twists): &SingleTargets<T>) -> T {
                zeros(masses) + zeros(inertias) + (zeros_of_matrix(contacts) + zeros_of_matrix(twists))
            }

            /// start + factor · part
            #[inline(always)]
            fn plus<T: Number>(start: &Single<T>, factor: T, part: &Single<T>) -> Single<T> {
                let mut sum = *start;
                add(&mut sum.base_pose, factor, &part.base_pose);
                add(&mut sum.joint_angles, factor, &part.joint_angles);
                add(&mut sum.base_twist, factor, &part.base_twist);
                add(&mut sum.joint_rates, factor, &part.joint_rates);
                sum
            }

            #[inline(always)]
            fn add<T: Number, const N: usize>(sum: &mut [T; N], factor: T, part: &[T; N]) {
                for (sum, part) in sum.iter_mut().zip(part) {
                    *sum = *sum + factor * *part;
                }
            }

            impl BatchModel for Model<f64> {
                type Of<T: Number> = Model<T>;
                const ARMS: usize = ARMS;
                const JOINTS: usize = JOINTS;

                fn with_scalar<T: Number>(&self) -> Model<T> {
                    self.map(T::constant)
                }

                fn is_finite(&self) -> bool {
                    all_finite([&self.parameters().to_array()[..]])
                }

                #[inline(always)]
                fn forward_dynamics<T: Number, const B: usize>(
                    model: &Model<T>,
                    states: &States<'_>,
                    joint_torques: &[f64],
                    results: &mut Accelerations<'_>,
                    place: Place,
                    statuses: &mut [Status],
                ) {
                    let model = *model;
                    let (mut base, mut joints) = (Lines([[0.0; B]; 3]), Lines([[0.0; B]; JOINTS]));
                    let mut checks = Checks::new();
                    for place in place.blocks(B) {
                        let (mut copies, mut copied_torques) = Default::default();
                        let given = Given::<B>::of(states, place, &mut copies);
                        let given_torques = place.rows::<JOINTS, B>(joint_torques, &mut copied_torques);
                        for i in 0..B {
                            let (state, torques) = (given.take::<T>(i), take(&given_torques, i));
                            let configuration =
                                model.forward_dynamics_configuration(&state.base_pose, &state.joint_angles);
                            let found = configuration.forward_dynamics_with_pivot::<false>(
                                &state.base_twist,
                                &state.joint_rates,
                                &torques,
                            );
                            put(&found.base_acceleration, &mut base.0, i);
                            put(&found.joint_accelerations, &mut joints.0, i);
                            let computed = zeros(&found.base_acceleration) + zeros(&found.joint_accelerations);
                            let given = if T::DECIDES {
                                zeros_of_state(&state) + zeros(&torques)
                            } else {
                                // on place and velocity of the base no acceleration depends, and on all else they do
                                zeros(&state.base_pose) + zeros(&state.base_twist)
                            };
                            checks.put(i, given, found.smallest_pivot, computed);
                        }
                        let found_statuses = checks.statuses();
                        place.store(&base.0, &found_statuses, results.base);
                        place.store(&joints.0, &found_statuses, results.joints);
                        place.store_statuses(&found_statuses, statuses);
                    }
                }

                #[inline(always)]
                fn reduced_dynamics<T: Number, const B: usize>(
                    model: &Model<T>,
                    states: &States<'_>,
                    results: &mut ReducedDynamics<'_>,
                    place: Place,
                    statuses: &mut [Status],
                ) {
                    let model = *model;
                    let mut inertia = Lines([[[0.0; B]; JOINTS]; JOINTS]);
                    let mut bias = Lines([[0.0; B]; JOINTS]);
                    let mut jacobian = Lines([[[0.0; B]; JOINTS]; 3 * ARMS]);
                    let mut checks = Checks::new();
                    for place in place.blocks(B) {
                        let mut copies = Default::default();
                        let given = Given::<B>::of(states, place, &mut copies);
                        for i in 0..B {
                            let state = given.take::<T>(i);
                            let configuration =
                                model.reduced_dynamics_configuration(&state.base_pose, &state.joint_angles);
                            let found = configuration
                                .reduced_dynamics_with_pivot::<false>(&state.base_twist, &state.joint_rates);
                            put_matrix(&found.generalized_inertia, &mut inertia.0, i);
                            put(&found.generalized_bias, &mut bias.0, i);
                            put_matrix(&found.generalized_jacobian, &mut jacobian.0, i);
                            let matrices = zeros_of_matrix(&found.generalized_inertia)
                                + zeros_of_matrix(&found.generalized_jacobian);
                            let computed = matrices + zeros(&found.generalized_bias);
                            checks.put(i, zeros_of_state(&state), found.smallest_pivot, computed);
                        }
                        let found_statuses = checks.statuses();
                        place.store_matrix(&inertia.0, &found_statuses, results.generalized_inertia);
                        place.store(&bias.0, &found_statuses, results.generalized_bias);
                        place.store_matrix(&jacobian.0, &found_statuses, results.generalized_jacobian);
                        place.store_statuses(&found_statuses, statuses);
                    }
                }

                #[inline(always)]
                fn reduced_impact<T: Number, const B: usize>(
                    model: &Model<T>,
                    states: &States<'_>,
                    targets: &Targets<'_>,
                    results: &mut ReducedImpact<'_>,
                    place: Place,
                    statuses: &mut [Status],
                ) {
                    let model = *model;
                    let mut matrix = Lines([[[0.0; B]; JOINTS]; JOINTS]);
                    let (mut momentum, mut rates) = (Lines([[0.0; B]; JOINTS]), Lines([[0.0; B]; JOINTS]));
                    let mut checks = Checks::new();
                    for place in place.blocks(B) {
                        let (mut copies, mut copied_targets) = Default::default();
                        let given = Given::<B>::of(states, place, &mut copies);
                        let given_targets = GivenTargets::<B>::of(targets, place, &mut copied_targets);
                        for i in 0..B {
                            let (state, target) = (given.take::<T>(i), given_targets.take::<T>(i));
                            let (masses, inertias, contacts, twists) = &target;
                            let configuration = model.impact_configuration(&state.base_pose, &state.joint_angles);
                            let found = configuration.reduced_impact_with_pivot::<false>(
                                &state.joint_rates,
                                masses,
                                inertias,
                                contacts,
                                twists,
                            );
                            put_matrix(&found.impact_matrix, &mut matrix.0, i);
                            put(&found.impact_momentum, &mut momentum.0, i);
                            put(&found.joint_rates_after, &mut rates.0, i);
                            let vectors = zeros(&found.impact_momentum) + zeros(&found.joint_rates_after);
                            let computed = zeros_of_matrix(&found.impact_matrix) + vectors;
                            let given = zeros_of_state(&state) + zeros_of_targets(&target);
                            checks.put(i, given, found.smallest_pivot, computed);
                        }
                        let found_statuses = checks.statuses();
                        place.store_matrix(&matrix.0, &found_statuses, results.impact_matrix);
                        place.store(&momentum.0, &found_statuses, results.impact_momentum);
                        place.store(&rates.0, &found_statuses, results.joint_rates_after);
                        place.store_statuses(&found_statuses, statuses);
                    }
                }

                #[inline(always)]
                fn full_impact<T: Number, const B: usize>(
                    model: &Model<T>,
                    states: &States<'_>,
                    targets: &Targets<'_>,
                    results: &mut FullImpact<'_>,
                    place: Place,
                    statuses: &mut [Status],
                ) {
                    let model = *model;
                    let (mut base, mut rates) = (Lines([[0.0; B]; 3]), Lines([[0.0; B]; JOINTS]));
                    let mut checks = Checks::new();
                    for place in place.blocks(B) {
                        let (mut copies, mut copied_targets) = Default::default();
                        let given = Given::<B>::of(states, place, &mut copies);
                        let given_targets = GivenTargets::<B>::of(targets, place, &mut copied_targets);
                        for i in 0..B {
                            let (state, target) = (given.take::<T>(i), given_targets.take::<T>(i));
                            let (masses, inertias, contacts, twists) = &target;
                            let RobotState { base_pose, joint_angles, base_twist, joint_rates } = &state;
                            let configuration = model.impact_configuration(base_pose, joint_angles);
                            let found = configuration.full_impact_with_pivot::<false>(
                                base_twist,
                                joint_rates,
                                masses,
                                inertias,
                                contacts,
                                twists,
                            );
                            put(&found.base_twist_after, &mut base.0, i);
                            put(&found.joint_rates_after, &mut rates.0, i);
                            let computed = zeros(&found.base_twist_after) + zeros(&found.joint_rates_after);
                            let given = zeros_of_state(&state) + zeros_of_targets(&target);
                            checks.put(i, given, found.smallest_pivot, computed);
                        }
                        let found_statuses = checks.statuses();
                        place.store(&base.0, &found_statuses, results.base_twists_after);
                        place.store(&rates.0, &found_statuses, results.joint_rates_after);
                        place.store_statuses(&found_statuses, statuses);
                    }
                }

                /// In the operations and the order of the integrator for one state.
                #[inline(always)]
                fn runge_kutta_step<T: Number, const B: usize>(
                    model: &Model<T>,
                    states: &States<'_>,
                    joint_torques: &[f64],
                    step: f64,
                    after: &mut StatesAfter<'_>,
                    place: Place,
                    statuses: &mut [Status],
                ) {
                    let (model, mut start, mut given_torques) = (*model, Block::<B>::new(0.0), [[0.0; B]; JOINTS]);
                    let mut checks = Checks::new();
                    let half = step * 0.5;
                    for place in place.blocks(B) {
                        // copies, which stay in the first-level cache from stage to stage
                        start.load(states, place);
                        place.load(joint_torques, &mut given_torques);
                        // adding to negative zeros leaves all bits
                        let mut sum = Block::<B>::new(-0.0);
                        let (mut stage, mut pivots) = (start, [[f64::INFINITY; B]]);
                        for (advance, weight) in [(half, 1.0), (half, 2.0), (step, 2.0), (step, 1.0)] {
                            let (advance, weight) = (T::constant(advance), T::constant(weight));
                            for i in 0..B {
                                let (state, torques) = (stage.take::<T>(i), take(&given_torques.each_ref(), i));
                                let RobotState { base_pose, joint_angles, base_twist, joint_rates } = &state;
                                let configuration = model.forward_dynamics_configuration(base_pose, joint_angles);
                                let found = configuration.forward_dynamics_with_pivot::<false>(
                                    base_twist,
                                    joint_rates,
                                    &torques,
                                );
                                let slope = RobotState {
                                    base_pose: *base_twist,
                                    joint_angles: *joint_rates,
                                    base_twist: found.base_acceleration,
                                    joint_rates: found.joint_accelerations,
                                };
                                sum.put(&plus(&sum.take(i), weight, &slope), i);
                                stage.put(&plus(&start.take(i), advance, &slope), i);
                                let [smallest] = take(&pivots.each_ref(), i);
                                // those of what follows a number that is not finite say nothing
                                let pivot = where_finite(zeros_of_state(&state), found.smallest_pivot, smallest);
                                put(&[smallest.minimum(pivot)], &mut pivots, i);
                            }
                        }
                        let sixth = T::constant(step / 6.0);
                        let end = &mut stage;
                        for i in 0..B {
                            let (first, torques) =
                                (start.take::<T>(i), take::<T, JOINTS, B>(&given_torques.each_ref(), i));
                            let last = plus(&first, sixth, &sum.take(i));
                            end.put(&last, i);
                            let given = zeros_of_state(&first) + zeros(&torques);
                            let [smallest] = take(&pivots.each_ref(), i);
                            checks.put(i, given, smallest, zeros_of_state(&last));
                        }
                        let found_statuses = checks.statuses();
                        end.store(&found_statuses, after, place);
                        place.store_statuses(&found_statuses, statuses);
                    }
                }
            }
        }
    };
}
