/* An instance of the FMU, for the files that implement the functions of FMI. */
#ifndef INSTANCE_INCLUDED
#define INSTANCE_INCLUDED

#include "fmi3Functions.h"
#include "robot.h"

/* between which functions of FMI an instance is */
typedef enum { INSTANTIATED, INITIALIZATION, STEP, TERMINATED } instance_mode;

/* all that fmi3GetFMUState copies; no pointers */
typedef struct {
    double values[ROBOT_VARIABLES];
    robot_model model;
    double stop_time;
    instance_mode mode;
    bool has_stop_time;
    /* whether the model is that of the parameters, and the computed outputs are those of the states */
    bool is_set_up;
    bool is_observed;
} instance_state;

typedef struct {
    instance_state state;
    fmi3InstanceEnvironment environment;
    fmi3LogMessageCallback log;
} fmu_instance;

/* Logs why a function has no result, with the number that it is about, and returns fmi3Error. */
fmi3Status instance_error(const fmu_instance *instance, const char *function, const char *reason, double number);

#endif
