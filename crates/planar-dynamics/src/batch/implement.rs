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
                Checks, Number, Place, Rows, Statuses, put, put_matrix, take, where_finite, zeros, zeros_of_matrix,
            };
            use $crate::batch::{
                Accelerations, BatchModel, FullImpact, ReducedDynamics, ReducedImpact, States, StatesAfter, Status,
                Targets,
            };
            use $crate::state::RobotState;

            /// States, or their rates.
            #[derive(Clone, Copy)]
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
                    RobotState {
                        base_pose: take(&self.base_poses, instance),
                        joint_angles: take(&self.joint_angles, instance),
                        base_twist: take(&self.base_twists, instance),
                        joint_rates: take(&self.joint_rates, instance),
                    }
                }

                #[inline(always)]
                fn put<T: Number>(&mut self, state: &Single<T>, instance: usize) {
                    put(&state.base_pose, &mut self.base_poses, instance);
                    put(&state.joint_angles, &mut self.joint_angles, instance);
                    put(&state.base_twist, &mut self.base_twists, instance);
                    put(&state.joint_rates, &mut self.joint_rates, instance);
                }
            }

            #[inline(always)]
            fn zeros_of_state<T: Number>(state: &Single<T>) -> T {
                let positions = zeros(&state.base_pose) + zeros(&state.joint_angles);
                positions + (zeros(&state.base_twist) + zeros(&state.joint_rates))
            }

            struct TargetBlock<const B: usize> {
                masses: Rows<ARMS, B>,
                inertias: Rows<ARMS, B>,
                contacts: [Rows<2, B>; ARMS],
                twists: [Rows<3, B>; ARMS],
            }

            /// Masses, inertias, contacts and twists.
            type SingleTargets<T> = ([T; ARMS], [T; ARMS], [[T; 2]; ARMS], [[T; 3]; ARMS]);

            impl<const B: usize> TargetBlock<B> {
                const fn new() -> Self {
                    Self {
                        masses: [[0.0; B]; ARMS],
                        inertias: [[0.0; B]; ARMS],
                        contacts: [[[0.0; B]; 2]; ARMS],
                        twists: [[[0.0; B]; 3]; ARMS],
                    }
                }

                #[inline(always)]
                fn load(&mut self, targets: &Targets<'_>, place: Place) {
                    place.load(targets.masses, &mut self.masses);
                    place.load(targets.inertias, &mut self.inertias);
                    place.load_matrix(targets.contacts, &mut self.contacts);
                    place.load_matrix(targets.twists, &mut self.twists);
                }

                #[inline(always)]
                fn take<T: Number>(&self, instance: usize) -> SingleTargets<T> {
                    let mut contacts = [[T::ZERO; 2]; ARMS];
                    contacts.iter_mut().zip(&self.contacts).for_each(|(to, rows)| *to = take(rows, instance));
                    let mut twists = [[T::ZERO; 3]; ARMS];
                    twists.iter_mut().zip(&self.twists).for_each(|(to, rows)| *to = take(rows, instance));
                    (take(&self.masses, instance), take(&self.inertias, instance), contacts, twists)
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

                #[inline(always)]
                fn forward_dynamics<T: Number, const B: usize>(
                    model: &Model<T>,
                    states: &States<'_>,
                    joint_torques: &[f64],
                    results: &mut Accelerations<'_>,
                    place: Place,
                    statuses: &mut [Status],
                ) {
                    let (model, mut given, mut given_torques) = (*model, Block::<B>::new(0.0), [[0.0; B]; JOINTS]);
                    let (mut base, mut joints) = ([[0.0; B]; 3], [[0.0; B]; JOINTS]);
                    let mut checks = Checks::new();
                    for place in place.blocks(B) {
                        given.load(states, place);
                        place.load(joint_torques, &mut given_torques);
                        for i in 0..B {
                            let (state, torques) = (given.take::<T>(i), take(&given_torques, i));
                            let configuration =
                                model.forward_dynamics_configuration(&state.base_pose, &state.joint_angles);
                            let found = configuration.forward_dynamics_with_pivot::<false>(
                                &state.base_twist,
                                &state.joint_rates,
                                &torques,
                            );
                            put(&found.base_acceleration, &mut base, i);
                            put(&found.joint_accelerations, &mut joints, i);
                            let computed = zeros(&found.base_acceleration) + zeros(&found.joint_accelerations);
                            checks.put(i, zeros_of_state(&state) + zeros(&torques), found.smallest_pivot, computed);
                        }
                        let found_statuses = checks.statuses();
                        place.store(&base, &found_statuses, results.base);
                        place.store(&joints, &found_statuses, results.joints);
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
                    let (model, mut given) = (*model, Block::<B>::new(0.0));
                    let mut inertia = [[[0.0; B]; JOINTS]; JOINTS];
                    let mut bias = [[0.0; B]; JOINTS];
                    let mut jacobian = [[[0.0; B]; JOINTS]; 3 * ARMS];
                    let mut checks = Checks::new();
                    for place in place.blocks(B) {
                        given.load(states, place);
                        for i in 0..B {
                            let state = given.take::<T>(i);
                            let configuration =
                                model.reduced_dynamics_configuration(&state.base_pose, &state.joint_angles);
                            let found = configuration
                                .reduced_dynamics_with_pivot::<false>(&state.base_twist, &state.joint_rates);
                            put_matrix(&found.generalized_inertia, &mut inertia, i);
                            put(&found.generalized_bias, &mut bias, i);
                            put_matrix(&found.generalized_jacobian, &mut jacobian, i);
                            let matrices = zeros_of_matrix(&found.generalized_inertia)
                                + zeros_of_matrix(&found.generalized_jacobian);
                            let computed = matrices + zeros(&found.generalized_bias);
                            checks.put(i, zeros_of_state(&state), found.smallest_pivot, computed);
                        }
                        let found_statuses = checks.statuses();
                        place.store_matrix(&inertia, &found_statuses, results.generalized_inertia);
                        place.store(&bias, &found_statuses, results.generalized_bias);
                        place.store_matrix(&jacobian, &found_statuses, results.generalized_jacobian);
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
                    let (model, mut given, mut given_targets) = (*model, Block::<B>::new(0.0), TargetBlock::<B>::new());
                    let mut matrix = [[[0.0; B]; JOINTS]; JOINTS];
                    let (mut momentum, mut rates) = ([[0.0; B]; JOINTS], [[0.0; B]; JOINTS]);
                    let mut checks = Checks::new();
                    for place in place.blocks(B) {
                        given.load(states, place);
                        given_targets.load(targets, place);
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
                            put_matrix(&found.impact_matrix, &mut matrix, i);
                            put(&found.impact_momentum, &mut momentum, i);
                            put(&found.joint_rates_after, &mut rates, i);
                            let vectors = zeros(&found.impact_momentum) + zeros(&found.joint_rates_after);
                            let computed = zeros_of_matrix(&found.impact_matrix) + vectors;
                            let given = zeros_of_state(&state) + zeros_of_targets(&target);
                            checks.put(i, given, found.smallest_pivot, computed);
                        }
                        let found_statuses = checks.statuses();
                        place.store_matrix(&matrix, &found_statuses, results.impact_matrix);
                        place.store(&momentum, &found_statuses, results.impact_momentum);
                        place.store(&rates, &found_statuses, results.joint_rates_after);
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
                    let (model, mut given, mut given_targets) = (*model, Block::<B>::new(0.0), TargetBlock::<B>::new());
                    let (mut base, mut rates) = ([[0.0; B]; 3], [[0.0; B]; JOINTS]);
                    let mut checks = Checks::new();
                    for place in place.blocks(B) {
                        given.load(states, place);
                        given_targets.load(targets, place);
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
                            put(&found.base_twist_after, &mut base, i);
                            put(&found.joint_rates_after, &mut rates, i);
                            let computed = zeros(&found.base_twist_after) + zeros(&found.joint_rates_after);
                            let given = zeros_of_state(&state) + zeros_of_targets(&target);
                            checks.put(i, given, found.smallest_pivot, computed);
                        }
                        let found_statuses = checks.statuses();
                        place.store(&base, &found_statuses, results.base_twists_after);
                        place.store(&rates, &found_statuses, results.joint_rates_after);
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
                        start.load(states, place);
                        place.load(joint_torques, &mut given_torques);
                        // adding to negative zeros leaves all bits
                        let mut sum = Block::<B>::new(-0.0);
                        let (mut stage, mut pivots) = (start, [[f64::INFINITY; B]]);
                        for (advance, weight) in [(half, 1.0), (half, 2.0), (step, 2.0), (step, 1.0)] {
                            let (advance, weight) = (T::constant(advance), T::constant(weight));
                            for i in 0..B {
                                let (state, torques) = (stage.take::<T>(i), take(&given_torques, i));
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
                                let [smallest] = take::<T, 1, B>(&pivots, i);
                                // those of what follows a number that is not finite say nothing
                                let pivot = where_finite(zeros_of_state(&state), found.smallest_pivot, smallest);
                                put(&[smallest.minimum(pivot)], &mut pivots, i);
                            }
                        }
                        let sixth = T::constant(step / 6.0);
                        let mut end = start;
                        for i in 0..B {
                            let (first, torques) = (start.take::<T>(i), take::<T, JOINTS, B>(&given_torques, i));
                            let last = plus(&first, sixth, &sum.take(i));
                            end.put(&last, i);
                            let given = zeros_of_state(&first) + zeros(&torques);
                            let [smallest] = take(&pivots, i);
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
