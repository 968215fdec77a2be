/* What the functions take and give: `Inputs` of states.rs, `Results` of c.rs. */
#ifndef FUNCTIONS_H
#define FUNCTIONS_H

#include "dual_arm_3r.h"

#define ARMS DUAL_ARM_3R_ARMS
#define JOINTS DUAL_ARM_3R_JOINTS
#define SIZE DUAL_ARM_3R_SIZE

typedef dual_arm_3r_real real;

typedef struct {
    real base_pose[3];
    real joint_angles[JOINTS];
    real base_twist[3];
    real joint_rates[JOINTS];
    real joint_torques[JOINTS];
    real desired_angles[JOINTS];
    real desired_rates[JOINTS];
    real target_masses[ARMS];
    real target_inertias[ARMS];
    real contacts[2 * ARMS];
    real target_twists[3 * ARMS];
    real step;
} inputs;

typedef struct {
    real base[3];
    real joints[JOINTS];
    real generalized_inertia[JOINTS * JOINTS];
    real generalized_bias[JOINTS];
    real generalized_jacobian[3 * ARMS * JOINTS];
    real target_twists[3 * ARMS];
    real impulses[3 * ARMS];
    real base_pose_after[3];
    real joint_angles_after[JOINTS];
} results;

/* Approach, contact, impact, and the motion of the merged robot; returns a status of the module. */
int control_capture(real record[6 * SIZE + 3 * ARMS]);

int control_self_test(void);
int control_start(void);
int control_model_new(void);
int control_forward_dynamics(const inputs *in, results *out);
int control_reduced_dynamics(const inputs *in, results *out);
int control_exact_impact(const inputs *in, results *out);
int control_exact_impact_with_impulses(const inputs *in, results *out);
int control_pd_and_rk4_step(const inputs *in, results *out);
int control_merge(const inputs *in, results *out);
/* Of the robot that control_model_new or control_merge made. */
const real *control_parameters(void);

#endif
