/* Functions of FMI for what this FMU has none of: variables other than Float64, clocks, events, derivatives. */
#include "instance.h"

#define NONE 0.0

/* no variables of a type: a list without any is in order */
static fmi3Status no_variables(fmi3Instance instance, const char *function, size_t count)
{
    return (count == 0U) ? fmi3OK
                         : instance_error(instance, function, "there are no variables of this type", (double)count);
}

static fmi3Status absent(fmi3Instance instance, const char *function)
{
    return instance_error(instance, function, "this FMU has no such thing", NONE);
}

#define VARIABLES_OF(type) \
    fmi3Status fmi3Get##type(fmi3Instance instance, const fmi3ValueReference valueReferences[], \
        size_t nValueReferences, fmi3##type values[], size_t nValues) \
    { \
        (void)valueReferences; \
        (void)values; \
        (void)nValues; \
        return no_variables(instance, "fmi3Get" #type, nValueReferences); \
    } \
    fmi3Status fmi3Set##type(fmi3Instance instance, const fmi3ValueReference valueReferences[], \
        size_t nValueReferences, const fmi3##type values[], size_t nValues) \
    { \
        (void)valueReferences; \
        (void)values; \
        (void)nValues; \
        return no_variables(instance, "fmi3Set" #type, nValueReferences); \
    }

VARIABLES_OF(Float32)
VARIABLES_OF(Int8)
VARIABLES_OF(UInt8)
VARIABLES_OF(Int16)
VARIABLES_OF(UInt16)
VARIABLES_OF(Int32)
VARIABLES_OF(UInt32)
VARIABLES_OF(Int64)
VARIABLES_OF(UInt64)
VARIABLES_OF(Boolean)
VARIABLES_OF(String)

fmi3Status fmi3GetBinary(fmi3Instance instance, const fmi3ValueReference valueReferences[], size_t nValueReferences,
    size_t valueSizes[], fmi3Binary values[], size_t nValues)
{
    (void)valueReferences;
    (void)valueSizes;
    (void)values;
    (void)nValues;
    return no_variables(instance, "fmi3GetBinary", nValueReferences);
}

fmi3Status fmi3SetBinary(fmi3Instance instance, const fmi3ValueReference valueReferences[], size_t nValueReferences,
    const size_t valueSizes[], const fmi3Binary values[], size_t nValues)
{
    (void)valueReferences;
    (void)valueSizes;
    (void)values;
    (void)nValues;
    return no_variables(instance, "fmi3SetBinary", nValueReferences);
}

/* clocks: their values, intervals and shifts */
#define CLOCKS(name, ...) \
    fmi3Status fmi3##name(fmi3Instance instance, const fmi3ValueReference valueReferences[], size_t nValueReferences, \
        __VA_ARGS__) \
    { \
        (void)valueReferences; \
        CLOCK_ARGUMENTS \
        return no_variables(instance, "fmi3" #name, nValueReferences); \
    }

#define CLOCK_ARGUMENTS (void)values;
CLOCKS(GetClock, fmi3Clock values[])
CLOCKS(SetClock, const fmi3Clock values[])
#undef CLOCK_ARGUMENTS
#define CLOCK_ARGUMENTS (void)intervals, (void)qualifiers;
CLOCKS(GetIntervalDecimal, fmi3Float64 intervals[], fmi3IntervalQualifier qualifiers[])
#undef CLOCK_ARGUMENTS
#define CLOCK_ARGUMENTS (void)counters, (void)resolutions, (void)qualifiers;
CLOCKS(GetIntervalFraction, fmi3UInt64 counters[], fmi3UInt64 resolutions[], fmi3IntervalQualifier qualifiers[])
#undef CLOCK_ARGUMENTS
#define CLOCK_ARGUMENTS (void)intervals;
CLOCKS(SetIntervalDecimal, const fmi3Float64 intervals[])
#undef CLOCK_ARGUMENTS
#define CLOCK_ARGUMENTS (void)shifts;
CLOCKS(GetShiftDecimal, fmi3Float64 shifts[])
CLOCKS(SetShiftDecimal, const fmi3Float64 shifts[])
#undef CLOCK_ARGUMENTS
#define CLOCK_ARGUMENTS (void)counters, (void)resolutions;
CLOCKS(GetShiftFraction, fmi3UInt64 counters[], fmi3UInt64 resolutions[])
CLOCKS(SetIntervalFraction, const fmi3UInt64 counters[], const fmi3UInt64 resolutions[])
CLOCKS(SetShiftFraction, const fmi3UInt64 counters[], const fmi3UInt64 resolutions[])

/* modes that it has not */
#define MODE(name) \
    fmi3Status fmi3##name(fmi3Instance instance) \
    { \
        return absent(instance, "fmi3" #name); \
    }

MODE(EnterEventMode)
MODE(EnterStepMode)
MODE(EnterConfigurationMode)
MODE(ExitConfigurationMode)
MODE(EvaluateDiscreteStates)

fmi3Status fmi3UpdateDiscreteStates(fmi3Instance instance, fmi3Boolean *discreteStatesNeedUpdate,
    fmi3Boolean *terminateSimulation, fmi3Boolean *nominalsOfContinuousStatesChanged,
    fmi3Boolean *valuesOfContinuousStatesChanged, fmi3Boolean *nextEventTimeDefined, fmi3Float64 *nextEventTime)
{
    (void)discreteStatesNeedUpdate;
    (void)terminateSimulation;
    (void)nominalsOfContinuousStatesChanged;
    (void)valuesOfContinuousStatesChanged;
    (void)nextEventTimeDefined;
    (void)nextEventTime;
    return absent(instance, "fmi3UpdateDiscreteStates");
}

/* derivatives and dependencies */
fmi3Status fmi3GetNumberOfVariableDependencies(fmi3Instance instance, fmi3ValueReference valueReference,
    size_t *nDependencies)
{
    (void)valueReference;
    (void)nDependencies;
    return absent(instance, "fmi3GetNumberOfVariableDependencies");
}

fmi3Status fmi3GetVariableDependencies(fmi3Instance instance, fmi3ValueReference dependent,
    size_t elementIndicesOfDependent[], fmi3ValueReference independents[], size_t elementIndicesOfIndependents[],
    fmi3DependencyKind dependencyKinds[], size_t nDependencies)
{
    (void)dependent;
    (void)elementIndicesOfDependent;
    (void)independents;
    (void)elementIndicesOfIndependents;
    (void)dependencyKinds;
    (void)nDependencies;
    return absent(instance, "fmi3GetVariableDependencies");
}

#define DERIVATIVE(name) \
    fmi3Status fmi3##name(fmi3Instance instance, const fmi3ValueReference unknowns[], size_t nUnknowns, \
        const fmi3ValueReference knowns[], size_t nKnowns, const fmi3Float64 seed[], size_t nSeed, \
        fmi3Float64 sensitivity[], size_t nSensitivity) \
    { \
        (void)unknowns; \
        (void)nUnknowns; \
        (void)knowns; \
        (void)nKnowns; \
        (void)seed; \
        (void)nSeed; \
        (void)sensitivity; \
        (void)nSensitivity; \
        return absent(instance, "fmi3" #name); \
    }

DERIVATIVE(GetDirectionalDerivative)
DERIVATIVE(GetAdjointDerivative)

fmi3Status fmi3GetOutputDerivatives(fmi3Instance instance, const fmi3ValueReference valueReferences[],
    size_t nValueReferences, const fmi3Int32 orders[], fmi3Float64 values[], size_t nValues)
{
    (void)valueReferences;
    (void)orders;
    (void)values;
    (void)nValues;
    return no_variables(instance, "fmi3GetOutputDerivatives", nValueReferences);
}
