/* Variables, and steps in time. */
#include "instance.h"

#include <float.h>
#include <string.h>

/* most internal steps of a communication step */
#define MOST_STEPS 1.0e9
/* relative; a communication step of ten internal ones is not divided by eleven, for rounding */
#define ROUNDING 1.0e-9

/* The outputs that are computed from the states. */
static fmi3Status observe(fmu_instance *of)
{
    instance_state *const state = &of->state;
    int status = 0;
    if (!state->is_set_up) {
        status = robot_set_up(&state->model, state->values);
        state->is_set_up = (status == 0);
    }
    if (!state->is_observed && (status == 0)) {
        status = robot_observe(&state->model, state->values);
        state->is_observed = (status == 0);
    }
    return (status == 0) ? fmi3OK
                         : instance_error(of, "fmi3GetFloat64",
                               "parameters or states, status 1: singular; 2: not finite", (double)status);
}

fmi3Status fmi3GetFloat64(fmi3Instance instance, const fmi3ValueReference valueReferences[], size_t nValueReferences,
    fmi3Float64 values[], size_t nValues)
{
    fmu_instance *const of = instance;
    fmi3Status status = fmi3OK;
    if (of == NULL) {
        return fmi3Error;
    }
    if (nValues != nValueReferences) {
        return instance_error(of, "fmi3GetFloat64", "not one value for each reference", (double)nValues);
    }
    for (size_t i = 0U; (i < nValues) && (status == fmi3OK); ++i) {
        const fmi3ValueReference reference = valueReferences[i];
        if (reference >= ROBOT_VARIABLES) {
            status = instance_error(of, "fmi3GetFloat64", "no such value reference", (double)reference);
        } else {
            if ((reference >= ROBOT_OBSERVED) && !(of->state.is_set_up && of->state.is_observed)) {
                status = observe(of);
            }
            values[i] = of->state.values[reference];
        }
    }
    return status;
}

/* Whether a variable can be set in an instance's mode. */
static bool is_settable(const fmu_instance *of, fmi3ValueReference reference)
{
    const bool is_input = (reference >= ROBOT_INPUTS) && (reference < ROBOT_STATES);
    const bool is_start = (reference >= ROBOT_INTERNAL_STEP) && (reference < ROBOT_OBSERVED);
    const bool is_early = (of->state.mode == INSTANTIATED) || (of->state.mode == INITIALIZATION);
    return (is_input && (of->state.mode == STEP)) || (is_start && is_early);
}

fmi3Status fmi3SetFloat64(fmi3Instance instance, const fmi3ValueReference valueReferences[], size_t nValueReferences,
    const fmi3Float64 values[], size_t nValues)
{
    fmu_instance *const of = instance;
    if (of == NULL) {
        return fmi3Error;
    }
    if (nValues != nValueReferences) {
        return instance_error(of, "fmi3SetFloat64", "not one value for each reference", (double)nValues);
    }
    for (size_t i = 0U; i < nValues; ++i) {
        if (!is_settable(of, valueReferences[i])) {
            return instance_error(of, "fmi3SetFloat64", "this value reference cannot be set now",
                (double)valueReferences[i]);
        }
    }
    for (size_t i = 0U; i < nValues; ++i) {
        const fmi3ValueReference reference = valueReferences[i];
        of->state.values[reference] = values[i];
        if (reference < ROBOT_INPUTS) {
            of->state.is_set_up = false;
        }
        if ((reference < ROBOT_INPUTS) || (reference >= ROBOT_STATES)) {
            of->state.is_observed = false;
        }
    }
    return fmi3OK;
}

/* How many equal steps a communication step is divided into: the fewest that are at most the internal step. */
static size_t divisions(double ratio)
{
    size_t count = (size_t)ratio;
    if ((double)count < (ratio * (1.0 - ROUNDING))) {
        ++count;
    }
    return (count == 0U) ? 1U : count;
}

static double magnitude(double x)
{
    return (x < 0.0) ? -x : x;
}

/* Why there is no step from here, with the number; a null pointer if there is one. */
static const char *problem(const instance_state *state, double from, double step, double *number)
{
    const double time = state->values[ROBOT_TIME];
    const double tolerance = ROUNDING * (magnitude(time) + magnitude(step));
    *number = step;
    if (state->mode != STEP) {
        *number = (double)state->mode;
        return "not in this mode";
    }
    if (!((step > 0.0) && (step <= DBL_MAX))) {
        return "communicationStepSize is not above 0";
    }
    if (!(magnitude(from - time) <= tolerance)) {
        *number = from;
        return "currentCommunicationPoint is not the end of the last step";
    }
    if (state->has_stop_time && !((from + step) <= (state->stop_time + tolerance))) {
        *number = from + step;
        return "the step ends after stopTime";
    }
    if (!((step / state->values[ROBOT_INTERNAL_STEP]) <= MOST_STEPS)) {
        return "communicationStepSize is more than a billion of internal_step";
    }
    return NULL;
}

fmi3Status fmi3DoStep(fmi3Instance instance, fmi3Float64 currentCommunicationPoint, fmi3Float64 communicationStepSize,
    fmi3Boolean noSetFMUStatePriorToCurrentPoint, fmi3Boolean *eventHandlingNeeded, fmi3Boolean *terminateSimulation,
    fmi3Boolean *earlyReturn, fmi3Float64 *lastSuccessfulTime)
{
    fmu_instance *const of = instance;
    double number = 0.0;
    double values[ROBOT_VARIABLES];
    int status = 0;
    (void)noSetFMUStatePriorToCurrentPoint;
    if (of == NULL) {
        return fmi3Error;
    }
    *eventHandlingNeeded = false;
    *terminateSimulation = false;
    *earlyReturn = false;
    *lastSuccessfulTime = of->state.values[ROBOT_TIME];
    const char *const reason = problem(&of->state, currentCommunicationPoint, communicationStepSize, &number);
    if (reason != NULL) {
        return instance_error(of, "fmi3DoStep", reason, number);
    }
    const size_t count = divisions(communicationStepSize / of->state.values[ROBOT_INTERNAL_STEP]);
    const double step = communicationStepSize / (double)count;
    /* on a copy: a step that fails changes nothing */
    (void)memcpy(values, of->state.values, sizeof(values));
    for (size_t i = 0U; (i < count) && (status == 0); ++i) {
        status = robot_step(&of->state.model, values, step);
    }
    if (status != 0) {
        return instance_error(of, "fmi3DoStep",
            (status == 1) ? "singular equations of motion in the step from this time"
                          : "an input or a result is not finite in the step from this time",
            currentCommunicationPoint);
    }
    values[ROBOT_TIME] = currentCommunicationPoint + communicationStepSize;
    (void)memcpy(of->state.values, values, sizeof(values));
    of->state.is_observed = false;
    *lastSuccessfulTime = values[ROBOT_TIME];
    return fmi3OK;
}
