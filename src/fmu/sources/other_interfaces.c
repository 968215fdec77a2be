/* Functions of model exchange and scheduled execution, which importers look for in every FMU; this one has neither. */
#include "instance.h"

static fmi3Status other_interface(fmi3Instance instance, const char *function)
{
    return instance_error(instance, function, "this FMU is for co-simulation alone", 0.0);
}

fmi3Instance fmi3InstantiateModelExchange(fmi3String instanceName, fmi3String instantiationToken,
    fmi3String resourcePath, fmi3Boolean visible, fmi3Boolean loggingOn, fmi3InstanceEnvironment instanceEnvironment,
    fmi3LogMessageCallback logMessage)
{
    (void)instanceName;
    (void)instantiationToken;
    (void)resourcePath;
    (void)visible;
    (void)loggingOn;
    (void)instanceEnvironment;
    (void)logMessage;
    return NULL;
}

fmi3Instance fmi3InstantiateScheduledExecution(fmi3String instanceName, fmi3String instantiationToken,
    fmi3String resourcePath, fmi3Boolean visible, fmi3Boolean loggingOn, fmi3InstanceEnvironment instanceEnvironment,
    fmi3LogMessageCallback logMessage, fmi3ClockUpdateCallback clockUpdate,
    fmi3LockPreemptionCallback lockPreemption, fmi3UnlockPreemptionCallback unlockPreemption)
{
    (void)instanceName;
    (void)instantiationToken;
    (void)resourcePath;
    (void)visible;
    (void)loggingOn;
    (void)instanceEnvironment;
    (void)logMessage;
    (void)clockUpdate;
    (void)lockPreemption;
    (void)unlockPreemption;
    return NULL;
}

fmi3Status fmi3EnterContinuousTimeMode(fmi3Instance instance)
{
    return other_interface(instance, "fmi3EnterContinuousTimeMode");
}

fmi3Status fmi3CompletedIntegratorStep(fmi3Instance instance, fmi3Boolean noSetFMUStatePriorToCurrentPoint,
    fmi3Boolean *enterEventMode, fmi3Boolean *terminateSimulation)
{
    (void)noSetFMUStatePriorToCurrentPoint;
    (void)enterEventMode;
    (void)terminateSimulation;
    return other_interface(instance, "fmi3CompletedIntegratorStep");
}

fmi3Status fmi3SetTime(fmi3Instance instance, fmi3Float64 time)
{
    (void)time;
    return other_interface(instance, "fmi3SetTime");
}

fmi3Status fmi3SetContinuousStates(fmi3Instance instance, const fmi3Float64 continuousStates[],
    size_t nContinuousStates)
{
    (void)continuousStates;
    (void)nContinuousStates;
    return other_interface(instance, "fmi3SetContinuousStates");
}

#define NUMBERS(name) \
    fmi3Status fmi3##name(fmi3Instance instance, fmi3Float64 values[], size_t nValues) \
    { \
        (void)values; \
        (void)nValues; \
        return other_interface(instance, "fmi3" #name); \
    }

NUMBERS(GetContinuousStateDerivatives)
NUMBERS(GetEventIndicators)
NUMBERS(GetContinuousStates)
NUMBERS(GetNominalsOfContinuousStates)

#define COUNT(name) \
    fmi3Status fmi3##name(fmi3Instance instance, size_t *count) \
    { \
        (void)count; \
        return other_interface(instance, "fmi3" #name); \
    }

COUNT(GetNumberOfEventIndicators)
COUNT(GetNumberOfContinuousStates)

fmi3Status fmi3ActivateModelPartition(fmi3Instance instance, fmi3ValueReference clockReference,
    fmi3Float64 activationTime)
{
    (void)clockReference;
    (void)activationTime;
    return other_interface(instance, "fmi3ActivateModelPartition");
}
