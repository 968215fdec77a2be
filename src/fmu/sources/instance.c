/* Creation, modes and messages of instances. */
#include "instance.h"

#include <float.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

fmi3Status instance_error(const fmu_instance *instance, const char *function, const char *reason, double number)
{
    if ((instance != NULL) && (instance->log != NULL)) {
        char text[256];
        (void)snprintf(text, sizeof(text), "%s: %s (%.17g)", function, reason, number);
        instance->log(instance->environment, fmi3Error, "logStatusError", text);
    }
    return fmi3Error;
}

const char *fmi3GetVersion(void)
{
    return fmi3Version;
}

fmi3Instance fmi3InstantiateCoSimulation(fmi3String instanceName, fmi3String instantiationToken, fmi3String resourcePath,
    fmi3Boolean visible, fmi3Boolean loggingOn, fmi3Boolean eventModeUsed, fmi3Boolean earlyReturnAllowed,
    const fmi3ValueReference requiredIntermediateVariables[], size_t nRequiredIntermediateVariables,
    fmi3InstanceEnvironment instanceEnvironment, fmi3LogMessageCallback logMessage,
    fmi3IntermediateUpdateCallback intermediateUpdate)
{
    fmu_instance *created = NULL;
    (void)instanceName;
    (void)resourcePath;
    (void)visible;
    (void)loggingOn;
    (void)eventModeUsed;
    (void)earlyReturnAllowed;
    (void)requiredIntermediateVariables;
    (void)nRequiredIntermediateVariables;
    (void)intermediateUpdate;
    if ((instantiationToken != NULL) && (strcmp(instantiationToken, ROBOT_TOKEN) == 0)) {
        /* zeros between members too: they are part of a serialized state */
        created = calloc(1, sizeof(fmu_instance));
    } else if (logMessage != NULL) {
        logMessage(instanceEnvironment, fmi3Error, "logStatusError",
            "fmi3InstantiateCoSimulation: the instantiationToken is not that of this binary's modelDescription.xml");
    }
    if (created != NULL) {
        created->environment = instanceEnvironment;
        created->log = logMessage;
        (void)fmi3Reset(created);
    }
    return created;
}

void fmi3FreeInstance(fmi3Instance instance)
{
    free(instance);
}

fmi3Status fmi3Reset(fmi3Instance instance)
{
    fmu_instance *const of = instance;
    if (of == NULL) {
        return fmi3Error;
    }
    (void)memset(&of->state, 0, sizeof(of->state));
    robot_start(of->state.values);
    of->state.mode = INSTANTIATED;
    return fmi3OK;
}

/* An error message where an instance is not in a mode. */
static fmi3Status check_mode(const fmu_instance *of, const char *function, instance_mode mode)
{
    if (of == NULL) {
        return fmi3Error;
    }
    return (of->state.mode == mode) ? fmi3OK : instance_error(of, function, "not in this mode", (double)of->state.mode);
}

fmi3Status fmi3EnterInitializationMode(fmi3Instance instance, fmi3Boolean toleranceDefined, fmi3Float64 tolerance,
    fmi3Float64 startTime, fmi3Boolean stopTimeDefined, fmi3Float64 stopTime)
{
    fmu_instance *const of = instance;
    const fmi3Status status = check_mode(of, "fmi3EnterInitializationMode", INSTANTIATED);
    (void)toleranceDefined;
    (void)tolerance;
    if (status != fmi3OK) {
        return status;
    }
    if (!((startTime >= -DBL_MAX) && (startTime <= DBL_MAX))) {
        return instance_error(of, "fmi3EnterInitializationMode", "startTime is not finite", startTime);
    }
    if (stopTimeDefined && !(stopTime >= startTime)) {
        return instance_error(of, "fmi3EnterInitializationMode", "stopTime is before startTime", stopTime);
    }
    of->state.values[ROBOT_TIME] = startTime;
    of->state.has_stop_time = stopTimeDefined;
    of->state.stop_time = stopTimeDefined ? stopTime : 0.0;
    of->state.mode = INITIALIZATION;
    return fmi3OK;
}

fmi3Status fmi3ExitInitializationMode(fmi3Instance instance)
{
    fmu_instance *const of = instance;
    const fmi3Status status = check_mode(of, "fmi3ExitInitializationMode", INITIALIZATION);
    if (status != fmi3OK) {
        return status;
    }
    const double step = of->state.values[ROBOT_INTERNAL_STEP];
    if (!((step > 0.0) && (step <= DBL_MAX))) {
        return instance_error(of, "fmi3ExitInitializationMode", "internal_step is not above 0", step);
    }
    const int set_up = robot_set_up(&of->state.model, of->state.values);
    if (set_up != 0) {
        return instance_error(of, "fmi3ExitInitializationMode",
            "parameters: status 1: one that is divided by is 0; 2: one is not finite", (double)set_up);
    }
    of->state.is_set_up = true;
    of->state.mode = STEP;
    return fmi3OK;
}

fmi3Status fmi3Terminate(fmi3Instance instance)
{
    fmu_instance *const of = instance;
    const fmi3Status status = check_mode(of, "fmi3Terminate", STEP);
    if (status == fmi3OK) {
        of->state.mode = TERMINATED;
    }
    return status;
}

fmi3Status fmi3SetDebugLogging(fmi3Instance instance, fmi3Boolean loggingOn, size_t nCategories,
    const fmi3String categories[])
{
    /* errors alone are logged, and always */
    const fmu_instance *const of = instance;
    (void)loggingOn;
    for (size_t i = 0U; i < nCategories; ++i) {
        if (strcmp(categories[i], "logStatusError") != 0) {
            return instance_error(of, "fmi3SetDebugLogging", "no such category, counted from 0", (double)i);
        }
    }
    return (of == NULL) ? fmi3Error : fmi3OK;
}
