/* The capture in C, by a generated module. */
#include "functions.h"

#define STEP ((real)0.001)
#define APPROACH_STEPS 2000
#define POST_IMPACT_STEPS 1000
#define DURATION ((real)2.0)

static const real initial_angles[6] = {(real)0.698, (real)-1.571, (real)1.047, (real)2.444, (real)1.571, (real)-1.047};
static const real final_angles[6] = {(real)-0.524, (real)-1.393, (real)-0.035, (real)2.618, (real)-1.393, (real)-0.035};
static const real final_rates[6] = {(real)-0.05, (real)0.02, (real)0.03, (real)-0.05, (real)0.02, (real)0.03};

typedef struct {
    real pose[3];
    real angles[JOINTS];
    real twist[3];
    real rates[JOINTS];
} state;

/* Eq. (6): angles and rates at a time (s). */
static void quartic(real time, real angles[JOINTS], real rates[JOINTS])
{
    const real tau = time / DURATION;
    const real tau2 = tau * tau;
    const real tau3 = tau * tau * tau;
    const real of_angle[2] = {
        tau3 * ((real)10.0 - (real)15.0 * tau + (real)6.0 * tau2),
        DURATION * (tau3 * ((real)-4.0 + (real)7.0 * tau - (real)3.0 * tau2)),
    };
    const real of_rate[2] = {
        tau2 * ((real)30.0 - (real)60.0 * tau + (real)30.0 * tau2) / DURATION,
        tau2 * ((real)-12.0 + (real)28.0 * tau - (real)15.0 * tau2),
    };
    for (int i = 0; i < JOINTS; ++i) {
        const real from = initial_angles[i % 6];
        const real change = final_angles[i % 6] - from;
        const real end = final_rates[i % 6];
        angles[i] = from + (change * of_angle[0] + end * of_angle[1]);
        rates[i] = change * of_rate[0] + end * of_rate[1];
    }
}

static int advance(const dual_arm_3r_model *robot, state *x, const real torques[JOINTS])
{
    return dual_arm_3r_rk4_step(robot, x->pose, x->angles, x->twist, x->rates, torques, STEP, x->pose, x->angles, x->twist,
        x->rates);
}

static real *copy(real *to, const real *from, int count)
{
    for (int i = 0; i < count; ++i) {
        to[i] = from[i];
    }
    return to + count;
}

static real *put(real *record, const state *x)
{
    record = copy(record, x->pose, 3);
    record = copy(record, x->angles, JOINTS);
    record = copy(record, x->twist, 3);
    return copy(record, x->rates, JOINTS);
}

int control_capture(real record[6 * SIZE + 3 * ARMS])
{
    static dual_arm_3r_model robot;
    static dual_arm_3r_model merged;
    static real impact_matrix[SIZE * SIZE];
    static real impact_momentum[SIZE];
    dual_arm_3r_parameters parameters;
    state x = {{0}, {0}, {0}, {0}};
    real stiffness[JOINTS];
    real damping[JOINTS];
    real masses[ARMS];
    real inertias[ARMS];
    real contacts[2 * ARMS];
    real twists[3 * ARMS];
    real target_twists[3 * ARMS];
    real impulses[3 * ARMS];
    real desired_angles[JOINTS];
    real desired_rates[JOINTS];
    real torques[JOINTS];
    int status;

    for (int i = 0; i < JOINTS; ++i) {
        x.angles[i] = initial_angles[i % 6];
        stiffness[i] = (real)49.0;
        damping[i] = (real)14.0;
    }
    for (int arm = 0; arm < ARMS; ++arm) {
        masses[arm] = (real)10.0;
        inertias[arm] = (real)1.0;
        contacts[2 * arm] = (real)0.0;
        contacts[2 * arm + 1] = arm % 2 == 0 ? (real)0.5 : (real)-0.5;
        twists[3 * arm] = (real)0.2;
        twists[3 * arm + 1] = (real)0.0;
        twists[3 * arm + 2] = (real)0.0;
    }

    dual_arm_3r_default_parameters(&parameters);
    status = dual_arm_3r_model_new(&robot, &parameters);
    for (int i = 0; i < APPROACH_STEPS && status == 0; ++i) {
        quartic((real)i * STEP, desired_angles, desired_rates);
        status = dual_arm_3r_pd_torques(&robot, x.angles, x.rates, desired_angles, desired_rates, stiffness, damping, torques);
        status |= advance(&robot, &x, torques);
    }
    record = put(record, &x);

    status |= dual_arm_3r_full_impact(&robot, x.pose, x.angles, x.twist, x.rates, masses, inertias, contacts, twists,
        impact_matrix, impact_momentum, x.twist, x.rates);
    status |= dual_arm_3r_impulses(&robot, x.pose, x.angles, x.twist, x.rates, masses, inertias, contacts, twists,
        target_twists, impulses);
    status |= dual_arm_3r_merge(&robot, x.pose, x.angles, masses, inertias, contacts, &merged);
    record = put(record, &x);
    record = copy(record, impulses, 3 * ARMS);

    for (int i = 0; i < JOINTS; ++i) {
        torques[i] = (real)0.0;
    }
    for (int i = 0; i < POST_IMPACT_STEPS && status == 0; ++i) {
        status = advance(&merged, &x, torques);
    }
    put(record, &x);
    return status;
}
