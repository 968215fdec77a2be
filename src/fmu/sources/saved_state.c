/* Saved states of instances. */
#include "instance.h"

#include <stdlib.h>
#include <string.h>

/* a serialized state: the token, then the bytes of the state, for the machine that has written it */
#define TOKEN_SIZE (sizeof(ROBOT_TOKEN))

fmi3Status fmi3GetFMUState(fmi3Instance instance, fmi3FMUState *FMUState)
{
    const fmu_instance *const of = instance;
    if (of == NULL) {
        return fmi3Error;
    }
    if (*FMUState == NULL) {
        *FMUState = malloc(sizeof(instance_state));
    }
    if (*FMUState == NULL) {
        return instance_error(of, "fmi3GetFMUState", "no memory for bytes", (double)sizeof(instance_state));
    }
    (void)memcpy(*FMUState, &of->state, sizeof(instance_state));
    return fmi3OK;
}

fmi3Status fmi3SetFMUState(fmi3Instance instance, fmi3FMUState FMUState)
{
    fmu_instance *const of = instance;
    if ((of == NULL) || (FMUState == NULL)) {
        return instance_error(of, "fmi3SetFMUState", "no state", 0.0);
    }
    (void)memcpy(&of->state, FMUState, sizeof(instance_state));
    return fmi3OK;
}

fmi3Status fmi3FreeFMUState(fmi3Instance instance, fmi3FMUState *FMUState)
{
    (void)instance;
    if (FMUState != NULL) {
        free(*FMUState);
        *FMUState = NULL;
    }
    return fmi3OK;
}

fmi3Status fmi3SerializedFMUStateSize(fmi3Instance instance, fmi3FMUState FMUState, size_t *size)
{
    (void)instance;
    (void)FMUState;
    *size = TOKEN_SIZE + sizeof(instance_state);
    return fmi3OK;
}

fmi3Status fmi3SerializeFMUState(fmi3Instance instance, fmi3FMUState FMUState, fmi3Byte serializedState[], size_t size)
{
    if ((FMUState == NULL) || (size < (TOKEN_SIZE + sizeof(instance_state)))) {
        return instance_error(instance, "fmi3SerializeFMUState", "no state, or too few bytes", (double)size);
    }
    (void)memcpy(serializedState, ROBOT_TOKEN, TOKEN_SIZE);
    (void)memcpy(&serializedState[TOKEN_SIZE], FMUState, sizeof(instance_state));
    return fmi3OK;
}

fmi3Status fmi3DeserializeFMUState(fmi3Instance instance, const fmi3Byte serializedState[], size_t size,
    fmi3FMUState *FMUState)
{
    const bool is_own = (size == (TOKEN_SIZE + sizeof(instance_state)))
        && (memcmp(serializedState, ROBOT_TOKEN, TOKEN_SIZE) == 0);
    if (!is_own) {
        return instance_error(instance, "fmi3DeserializeFMUState", "not a state of this FMU; bytes", (double)size);
    }
    if (*FMUState == NULL) {
        *FMUState = malloc(sizeof(instance_state));
    }
    if (*FMUState == NULL) {
        return instance_error(instance, "fmi3DeserializeFMUState", "no memory for bytes", (double)size);
    }
    (void)memcpy(*FMUState, &serializedState[TOKEN_SIZE], sizeof(instance_state));
    return fmi3OK;
}
