/* The end of an S-function: its methods are used. */
void methods(SimStruct *S);
void methods(SimStruct *S)
{
    mdlInitializeSizes(S);
    mdlInitializeSampleTimes(S);
    mdlInitializeConditions(S);
    mdlUpdate(S, 0);
    mdlOutputs(S, 0);
    mdlTerminate(S);
}
