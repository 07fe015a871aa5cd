/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The calls of FMI 2.0 for fmi_fuzz.c, which includes this file. */
#include "fmi2_interface.h"

static void logger(fmi2ComponentEnvironment e, fmi2String name, fmi2Status status, fmi2String category, fmi2String message, ...) {
    (void)e, (void)status;
    if (strlen(name) + strlen(category) + strlen(message) > 2000) exit(1);
}
static const fmi2CallbackFunctions functions = {logger, calloc, free, NULL, NULL};

static void* instantiate(void) {
    if (rarely()) return fmi2Instantiate(below(2) ? NULL : "", fmi2ModelExchange, FMI_TOKEN, "", &functions, 0, 0);
    if (rarely()) return fmi2Instantiate("x", (fmi2Type)below(3), below(2) ? NULL : "?", "", &functions, 0, 0);
    return fmi2Instantiate("x", below(2) ? fmi2ModelExchange : fmi2CoSimulation, FMI_TOKEN, NULL, rarely() ? NULL : &functions, 0,
                           (int)below(2));
}
static void release(void* one) { fmi2FreeInstance(one); }

static void advance(void) {
    fmi2EventInfo info;
    int wants_events, over;
    const double h = 1e-3 * (double)(1 + below(50));
    double now = 0.0, x[1024];
    const fmi2ValueReference time = 0;
    if (below(4) == 0) counted(fmi2SetupExperiment(c, (int)below(2), 1e-6, 0.0, 0, 0.0));
    if (below(4) == 0) counted(fmi2EnterInitializationMode(c));
    if (below(4) == 0) counted(fmi2ExitInitializationMode(c));
    if (fmi2GetReal(c, &time, 1, &now) != fmi2OK || plant->states > 500) return;
    if (fmi2DoStep(c, now, h, 1) == fmi2OK) return;
    counted(fmi2NewDiscreteStates(c, &info));
    counted(fmi2EnterContinuousTimeMode(c));
    if (fmi2GetContinuousStates(c, x, plant->states) != fmi2OK || fmi2GetDerivatives(c, x + plant->states, plant->states) != fmi2OK) return;
    for (size_t i = 0; i < plant->states; ++i) x[i] += h * x[plant->states + i];
    counted(fmi2SetTime(c, now + h));
    counted(fmi2SetContinuousStates(c, x, plant->states));
    counted(fmi2CompletedIntegratorStep(c, 1, &wants_events, &over));
    if (below(3) == 0) counted(fmi2EnterEventMode(c));
}

static void any_call(void) {
    fmi2EventInfo info;
    int a = 0, b = 0, whole[most * 8];
    fmi2String text[most * 8];
    double number = any_number(), other = any_number();
    const int is_small = n <= most * 8;
    const fmi2String names[] = {"logEvents", "logStatusError", rarely() ? "unknown" : "logStatusDiscard"};
    unsigned* const list = rarely() && rarely() ? NULL : references;
    double* const result = rarely() && rarely() ? NULL : results;
    fmi2Status status;
    switch (below(42)) {
    case 0: counted(fmi2SetDebugLogging(c, (int)below(2), below(4), rarely() ? NULL : names)); break;
    case 1: counted(fmi2SetupExperiment(c, (int)below(2), number, other, (int)below(2), any_number())); break;
    case 2: counted(fmi2EnterInitializationMode(c)); break;
    case 3: counted(fmi2ExitInitializationMode(c)); break;
    case 4: if (rarely()) counted(fmi2Terminate(c)); break;
    case 5: if (rarely() || below(3) == 0) counted(fmi2Reset(c)); break;
    case 6: case 7: counted(fmi2GetReal(c, list, n, result)); break;
    case 8: if (is_small) counted(fmi2GetInteger(c, list, n, rarely() ? NULL : whole)); break;
    case 9: if (is_small) counted(fmi2GetBoolean(c, list, n, whole)); break;
    case 10: if (is_small) counted(fmi2GetString(c, list, n, text)); break;
    case 11: case 12: counted(fmi2SetReal(c, list, n, rarely() && rarely() ? NULL : values)); break;
    case 13: counted(fmi2SetInteger(c, list, below(2), whole)); break;
    case 14: counted(fmi2SetBoolean(c, list, below(2), whole)); break;
    case 15: counted(fmi2SetString(c, list, below(2), names)); break;
    case 16: case 17: counted(fmi2GetFMUstate(c, state)); break;
    case 18: counted(fmi2SetFMUstate(c, state ? *state : NULL)); break;
    case 19: counted(fmi2FreeFMUstate(c, state)); break;
    case 20: {
        size_t size = 0;
        if (!state || counted(fmi2SerializedFMUstateSize(c, *state, rarely() ? NULL : &size)) != fmi2OK) break;
        bytes = (char*)exact(bytes, size, 1);
        byte_count = size;
        counted(fmi2SerializeFMUstate(c, *state, bytes, rarely() ? size / 2 : size));
        if (rarely()) bytes[below(size)] ^= 1;
        break;
    }
    case 21:
        if (state && *state) counted(fmi2FreeFMUstate(instances[0] ? instances[0] : c, state));
        if (state && *state) break;
        counted(fmi2DeSerializeFMUstate(c, bytes, rarely() ? byte_count / 2 : byte_count, state));
        break;
    case 22: case 23: counted(fmi2GetDirectionalDerivative(c, list, n, others, m, values, result)); break;
    case 24: counted(fmi2EnterEventMode(c)); break;
    case 25: case 26: counted(fmi2NewDiscreteStates(c, rarely() ? NULL : &info)); break;
    case 27: counted(fmi2EnterContinuousTimeMode(c)); break;
    case 28: counted(fmi2CompletedIntegratorStep(c, (int)below(2), rarely() ? NULL : &a, rarely() ? NULL : &b)); break;
    case 29: counted(fmi2SetTime(c, number)); break;
    case 30: case 31: counted(fmi2SetContinuousStates(c, rarely() ? NULL : values, n)); break;
    case 32: counted(fmi2GetDerivatives(c, result, n)); break;
    case 33: counted(fmi2GetEventIndicators(c, result, n)); break;
    case 34: counted(fmi2GetContinuousStates(c, result, n)); break;
    case 35: counted(fmi2GetNominalsOfContinuousStates(c, result, n)); break;
    case 36: counted(fmi2SetRealInputDerivatives(c, list, n, whole, values)); break;
    case 37: counted(fmi2GetRealOutputDerivatives(c, list, n, whole, result)); break;
    case 38: counted(fmi2DoStep(c, number, below(2) ? 1e-3 : other, 1)); break;
    case 39: counted(fmi2CancelStep(c)); break;
    case 40:
        counted(fmi2GetStatus(c, (fmi2StatusKind)below(5), &status));
        counted(fmi2GetRealStatus(c, (fmi2StatusKind)below(5), rarely() ? NULL : &number));
        counted(fmi2GetIntegerStatus(c, (fmi2StatusKind)below(5), &a));
        counted(fmi2GetBooleanStatus(c, (fmi2StatusKind)below(5), rarely() ? NULL : &a));
        counted(fmi2GetStringStatus(c, (fmi2StatusKind)below(5), text));
        break;
    default:
        if (strcmp(fmi2GetVersion(), "2.0") != 0 || strcmp(fmi2GetTypesPlatform(), "default") != 0) exit(1);
        break;
    }
}
