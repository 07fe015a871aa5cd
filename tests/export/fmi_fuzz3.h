/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The calls of FMI 3.0 for fmi_fuzz.c, which includes this file. */
#include "fmi3_interface.h"

static void logger(fmi3InstanceEnvironment e, fmi3Status status, fmi3String category, fmi3String message) {
    (void)e, (void)status;
    if (strlen(category) + strlen(message) > 2000) exit(1);
}

static void* instantiate(void) {
    if (rarely()) return fmi3InstantiateModelExchange(below(2) ? NULL : "", FMI_TOKEN, NULL, false, false, NULL, logger);
    if (rarely())
        return fmi3InstantiateCoSimulation("x", FMI_TOKEN, NULL, false, false, below(2) != 0, false, NULL, below(2), NULL, logger, NULL);
    if (rarely()) return fmi3InstantiateScheduledExecution("x", FMI_TOKEN, NULL, false, false, NULL, logger, NULL, NULL, NULL);
    if (below(2))
        return fmi3InstantiateModelExchange("x", rarely() ? NULL : FMI_TOKEN, NULL, false, below(2) != 0, NULL, rarely() ? NULL : logger);
    return fmi3InstantiateCoSimulation("x", FMI_TOKEN, NULL, false, below(2) != 0, false, false, NULL, 0, NULL, logger, NULL);
}
static void release(void* one) { fmi3FreeInstance(one); }

static void advance(void) {
    bool a, b, d, e, f;
    double next, now = 0.0, x[1024];
    const double h = 1e-3 * (double)(1 + below(50));
    const fmi3ValueReference time = 0;
    if (below(4) == 0) counted(fmi3EnterInitializationMode(c, below(2) != 0, 1e-6, 0.0, false, 0.0));
    if (below(4) == 0) counted(fmi3ExitInitializationMode(c));
    if (fmi3GetFloat64(c, &time, 1, &now, 1) != fmi3OK || plant->states > 500) return;
    if (fmi3DoStep(c, now, h, true, &a, &b, &d, &next) == fmi3OK) return;
    counted(fmi3UpdateDiscreteStates(c, &a, &b, &d, &e, &f, &next));
    counted(fmi3EnterContinuousTimeMode(c));
    if (fmi3GetContinuousStates(c, x, plant->states) != fmi3OK ||
        fmi3GetContinuousStateDerivatives(c, x + plant->states, plant->states) != fmi3OK)
        return;
    for (size_t i = 0; i < plant->states; ++i) x[i] += h * x[plant->states + i];
    counted(fmi3SetTime(c, now + h));
    counted(fmi3SetContinuousStates(c, x, plant->states));
    counted(fmi3CompletedIntegratorStep(c, true, &a, &b));
    if (below(3) == 0) counted(fmi3EnterEventMode(c));
}

/* Types of which there are no variables: any call must leave the arrays alone. */
#define TRY(type) \
    case type##_number: \
        counted(fmi3Get##type(c, list, n, (fmi3##type*)NULL, n)); \
        counted(fmi3Set##type(c, list, n, (const fmi3##type*)NULL, n)); \
        break;
#define NUMBER(type) type##_number,
enum { FMI3_NUMBERS(NUMBER) type_count };

static void any_type(const unsigned* list) {
    int64_t whole[most * 8];
    switch (below(type_count + 1)) {
        FMI3_NUMBERS(TRY)
    default:
        if (n <= most * 8) counted(fmi3GetInt64(c, list, n, whole, rarely() ? n + 1 : n));
        break;
    }
}

static void any_clock(const unsigned* list) {
    size_t sizes[2] = {0, 0};
    fmi3Binary binaries[2] = {NULL, NULL};
    bool active[2] = {false, false};
    double times[2] = {0, 0};
    uint64_t counters[2] = {0, 0}, resolutions[2] = {1, 1};
    fmi3IntervalQualifier qualifiers[2];
    const size_t few = n > 0 ? below(2) : 0;
    counted(fmi3GetBinary(c, list, few, sizes, binaries, few));
    counted(fmi3SetBinary(c, list, few, sizes, binaries, few));
    counted(fmi3GetClock(c, list, few, active));
    counted(fmi3SetClock(c, list, few, active));
    counted(fmi3GetIntervalDecimal(c, list, few, times, qualifiers));
    counted(fmi3GetIntervalFraction(c, list, few, counters, resolutions, qualifiers));
    counted(fmi3GetShiftDecimal(c, list, few, times));
    counted(fmi3GetShiftFraction(c, list, few, counters, resolutions));
    counted(fmi3SetIntervalDecimal(c, list, few, times));
    counted(fmi3SetIntervalFraction(c, list, few, counters, resolutions));
    counted(fmi3SetShiftDecimal(c, list, few, times));
    counted(fmi3SetShiftFraction(c, list, few, counters, resolutions));
    counted(fmi3ActivateModelPartition(c, 0, 0.0));
    counted(fmi3EnterConfigurationMode(c));
    counted(fmi3ExitConfigurationMode(c));
}

static void any_call(void) {
    bool a, b, d, e, f;
    double number = any_number(), other = any_number(), next;
    size_t size = 0;
    const fmi3String names[] = {"logEvents", "logStatusError", rarely() ? "unknown" : "logStatusDiscard"};
    unsigned* const list = rarely() && rarely() ? NULL : references;
    double* const result = rarely() && rarely() ? NULL : results;
    const size_t shown = rarely() ? n + 1 : n;
    switch (below(40)) {
    case 0: counted(fmi3SetDebugLogging(c, below(2) != 0, below(4), rarely() ? NULL : names)); break;
    case 1: counted(fmi3EnterInitializationMode(c, below(2) != 0, number, other, below(2) != 0, any_number())); break;
    case 2: counted(fmi3ExitInitializationMode(c)); break;
    case 3: counted(fmi3EnterEventMode(c)); break;
    case 4: if (rarely()) counted(fmi3Terminate(c)); break;
    case 5: if (below(3) == 0) counted(fmi3Reset(c)); break;
    case 6: case 7: counted(fmi3GetFloat64(c, list, n, result, shown)); break;
    case 8: case 9: counted(fmi3SetFloat64(c, list, n, rarely() && rarely() ? NULL : values, shown)); break;
    case 10: any_type(list); break;
    case 11: if (rarely()) any_clock(list); break;
    case 12: counted(fmi3GetNumberOfVariableDependencies(c, 1, &size)); break;
    case 13: counted(fmi3GetVariableDependencies(c, 1, NULL, NULL, NULL, NULL, 0)); break;
    case 14: case 15: counted(fmi3GetFMUState(c, state)); break;
    case 16: counted(fmi3SetFMUState(c, state ? *state : NULL)); break;
    case 17: counted(fmi3FreeFMUState(c, state)); break;
    case 18:
        if (!state || counted(fmi3SerializedFMUStateSize(c, *state, rarely() ? NULL : &size)) != fmi3OK) break;
        bytes = (char*)exact(bytes, size, 1);
        byte_count = size;
        counted(fmi3SerializeFMUState(c, *state, (fmi3Byte*)bytes, rarely() ? size / 2 : size));
        if (rarely()) bytes[below(size)] ^= 1;
        break;
    case 19:
        if (state && *state) counted(fmi3FreeFMUState(instances[0] ? instances[0] : c, state));
        if (state && *state) break;
        counted(fmi3DeserializeFMUState(c, (fmi3Byte*)bytes, rarely() ? byte_count / 2 : byte_count, state));
        break;
    case 20: case 21: counted(fmi3GetDirectionalDerivative(c, list, n, others, m, values, rarely() ? m + 1 : m, result, shown)); break;
    case 22: case 23: counted(fmi3GetAdjointDerivative(c, list, n, others, m, values, shown, result, rarely() ? m + 1 : m)); break;
    case 24: counted(fmi3EvaluateDiscreteStates(c)); break;
    case 25: case 26: counted(fmi3UpdateDiscreteStates(c, rarely() ? NULL : &a, &b, &d, &e, &f, &next)); break;
    case 27: counted(fmi3EnterContinuousTimeMode(c)); break;
    case 28: counted(fmi3CompletedIntegratorStep(c, below(2) != 0, rarely() ? NULL : &a, rarely() ? NULL : &b)); break;
    case 29: counted(fmi3SetTime(c, number)); break;
    case 30: case 31: counted(fmi3SetContinuousStates(c, rarely() ? NULL : values, n)); break;
    case 32: counted(fmi3GetContinuousStateDerivatives(c, result, n)); break;
    case 33: counted(fmi3GetEventIndicators(c, result, n)); break;
    case 34: counted(fmi3GetContinuousStates(c, result, n)); break;
    case 35: counted(fmi3GetNominalsOfContinuousStates(c, result, n)); break;
    case 36:
        counted(fmi3GetNumberOfEventIndicators(c, rarely() ? NULL : &size));
        counted(fmi3GetNumberOfContinuousStates(c, rarely() ? NULL : &size));
        break;
    case 37:
        counted(fmi3EnterStepMode(c));
        counted(fmi3GetOutputDerivatives(c, list, n, NULL, result, n));
        break;
    case 38: counted(fmi3DoStep(c, number, below(2) ? 1e-3 : other, true, rarely() ? NULL : &a, &b, &d, &next)); break;
    default:
        if (strcmp(fmi3GetVersion(), "3.0") != 0) exit(1);
        break;
    }
}
