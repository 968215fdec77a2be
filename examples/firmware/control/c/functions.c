/* The functions that are measured, for one robot. */
#include "functions.h"

static dual_arm_3r_parameters parameters;
static dual_arm_3r_model model;
static dual_arm_3r_model other;

int control_self_test(void)
{
    return dual_arm_3r_self_test();
}

int control_start(void)
{
    dual_arm_3r_default_parameters(&parameters);
    return dual_arm_3r_model_new(&model, &parameters);
}

int control_model_new(void)
{
    return dual_arm_3r_model_new(&other, &parameters);
}

int control_forward_dynamics(const inputs *in, results *out)
{
    return dual_arm_3r_forward_dynamics(&model, in->base_pose, in->joint_angles, in->base_twist, in->joint_rates,
        in->joint_torques, out->base, out->joints);
}

int control_reduced_dynamics(const inputs *in, results *out)
{
    return dual_arm_3r_reduced_dynamics(&model, in->base_pose, in->joint_angles, in->base_twist, in->joint_rates,
        out->generalized_inertia, out->generalized_bias, out->generalized_jacobian);
}

int control_exact_impact(const inputs *in, results *out)
{
    static real impact_matrix[SIZE * SIZE];
    static real impact_momentum[SIZE];
    return dual_arm_3r_full_impact(&model, in->base_pose, in->joint_angles, in->base_twist, in->joint_rates,
        in->target_masses, in->target_inertias, in->contacts, in->target_twists, impact_matrix, impact_momentum, out->base,
        out->joints);
}

int control_exact_impact_with_impulses(const inputs *in, results *out)
{
    int status = control_exact_impact(in, out);
    if (status == 0) {
        status = dual_arm_3r_impulses(&model, in->base_pose, in->joint_angles, out->base, out->joints, in->target_masses,
            in->target_inertias, in->contacts, in->target_twists, out->target_twists, out->impulses);
    }
    return status;
}

int control_pd_and_rk4_step(const inputs *in, results *out)
{
    real gains[2][JOINTS];
    real torques[JOINTS];
    int status;
    for (int i = 0; i < JOINTS; ++i) {
        gains[0][i] = (real)49.0;
        gains[1][i] = (real)14.0;
    }
    status = dual_arm_3r_pd_torques(&model, in->joint_angles, in->joint_rates, in->desired_angles, in->desired_rates,
        gains[0], gains[1], torques);
    if (status == 0) {
        status = dual_arm_3r_rk4_step(&model, in->base_pose, in->joint_angles, in->base_twist, in->joint_rates, torques,
            in->step, out->base_pose_after, out->joint_angles_after, out->base, out->joints);
    }
    return status;
}

int control_merge(const inputs *in, results *out)
{
    (void)out;
    return dual_arm_3r_merge(&model, in->base_pose, in->joint_angles, in->target_masses, in->target_inertias, in->contacts,
        &other);
}

const real *control_parameters(void)
{
    return &other.parameters.base_mass;
}
