/* SPDX-License-Identifier: BSL-1.0 */
/* Types and functions of the Functional Mock-up Interface 3.0, as far as an FMU needs them, with the names and values of the standard. */
#ifndef DALEMBERT_FMI3_INTERFACE_H
#define DALEMBERT_FMI3_INTERFACE_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* Importers that link sources of several FMUs define FMI3_FUNCTION_PREFIX. */
#ifdef FMI3_FUNCTION_PREFIX
#define FMI3_JOIN(a, b) a##b
#define FMI3_JOINED(a, b) FMI3_JOIN(a, b)
#define FMI3_NAME(name) FMI3_JOINED(FMI3_FUNCTION_PREFIX, name)
#define FMI3_EXPORT
#else
#define FMI3_NAME(name) name
#if defined(_WIN32) || defined(__CYGWIN__)
#define FMI3_EXPORT __declspec(dllexport)
#elif defined(__GNUC__)
#define FMI3_EXPORT __attribute__((visibility("default")))
#else
#define FMI3_EXPORT
#endif
#endif
/* Of a definition and of a declaration: FMI3(fmi3Status, Reset)(fmi3Instance c). */
#define FMI3(type, name) FMI3_EXPORT type FMI3_NAME(fmi3##name)

typedef void* fmi3Instance;
typedef void* fmi3InstanceEnvironment;
typedef void* fmi3FMUState;
typedef uint32_t fmi3ValueReference;
typedef float fmi3Float32;
typedef double fmi3Float64;
typedef int8_t fmi3Int8;
typedef uint8_t fmi3UInt8;
typedef int16_t fmi3Int16;
typedef uint16_t fmi3UInt16;
typedef int32_t fmi3Int32;
typedef uint32_t fmi3UInt32;
typedef int64_t fmi3Int64;
typedef uint64_t fmi3UInt64;
typedef bool fmi3Boolean;
typedef const char* fmi3String;
typedef uint8_t fmi3Byte;
typedef const fmi3Byte* fmi3Binary;
typedef bool fmi3Clock;

typedef enum { fmi3OK, fmi3Warning, fmi3Discard, fmi3Error, fmi3Fatal } fmi3Status;
typedef enum { fmi3Independent, fmi3Constant, fmi3Fixed, fmi3Tunable, fmi3Discrete, fmi3Dependent } fmi3DependencyKind;
typedef enum { fmi3IntervalNotYetKnown, fmi3IntervalUnchanged, fmi3IntervalChanged } fmi3IntervalQualifier;

typedef void (*fmi3LogMessageCallback)(fmi3InstanceEnvironment, fmi3Status, fmi3String category, fmi3String message);
typedef void (*fmi3IntermediateUpdateCallback)(fmi3InstanceEnvironment, fmi3Float64 time, fmi3Boolean set_requested,
                                               fmi3Boolean get_allowed, fmi3Boolean step_finished, fmi3Boolean can_return_early,
                                               fmi3Boolean* early_return, fmi3Float64* early_return_time);
typedef void (*fmi3ClockUpdateCallback)(fmi3InstanceEnvironment);
typedef void (*fmi3LockPreemptionCallback)(void);
typedef void (*fmi3UnlockPreemptionCallback)(void);

FMI3(const char*, GetVersion)(void);
FMI3(fmi3Status, SetDebugLogging)(fmi3Instance, fmi3Boolean is_on, size_t, const fmi3String categories[]);
FMI3(fmi3Instance, InstantiateModelExchange)
(fmi3String name, fmi3String token, fmi3String resources, fmi3Boolean visible, fmi3Boolean logging, fmi3InstanceEnvironment,
 fmi3LogMessageCallback);
FMI3(fmi3Instance, InstantiateCoSimulation)
(fmi3String name, fmi3String token, fmi3String resources, fmi3Boolean visible, fmi3Boolean logging, fmi3Boolean uses_event_mode,
 fmi3Boolean early_return, const fmi3ValueReference intermediate[], size_t, fmi3InstanceEnvironment, fmi3LogMessageCallback,
 fmi3IntermediateUpdateCallback);
FMI3(fmi3Instance, InstantiateScheduledExecution)
(fmi3String name, fmi3String token, fmi3String resources, fmi3Boolean visible, fmi3Boolean logging, fmi3InstanceEnvironment,
 fmi3LogMessageCallback, fmi3ClockUpdateCallback, fmi3LockPreemptionCallback, fmi3UnlockPreemptionCallback);
FMI3(void, FreeInstance)(fmi3Instance);
FMI3(fmi3Status, EnterInitializationMode)
(fmi3Instance, fmi3Boolean has_tolerance, fmi3Float64 tolerance, fmi3Float64 start, fmi3Boolean has_stop, fmi3Float64 stop);
FMI3(fmi3Status, ExitInitializationMode)(fmi3Instance);
FMI3(fmi3Status, EnterEventMode)(fmi3Instance);
FMI3(fmi3Status, Terminate)(fmi3Instance);
FMI3(fmi3Status, Reset)(fmi3Instance);

/* Types of variables whose values are one number each. */
#define FMI3_NUMBERS(of) \
    of(Float32) of(Float64) of(Int8) of(UInt8) of(Int16) of(UInt16) of(Int32) of(UInt32) of(Int64) of(UInt64) of(Boolean) of(String)
#define FMI3_DECLARE(type) \
    FMI3(fmi3Status, Get##type)(fmi3Instance, const fmi3ValueReference[], size_t, fmi3##type[], size_t); \
    FMI3(fmi3Status, Set##type)(fmi3Instance, const fmi3ValueReference[], size_t, const fmi3##type[], size_t);
FMI3_NUMBERS(FMI3_DECLARE)
FMI3(fmi3Status, GetBinary)(fmi3Instance, const fmi3ValueReference[], size_t, size_t sizes[], fmi3Binary[], size_t);
FMI3(fmi3Status, SetBinary)(fmi3Instance, const fmi3ValueReference[], size_t, const size_t sizes[], const fmi3Binary[], size_t);
FMI3(fmi3Status, GetClock)(fmi3Instance, const fmi3ValueReference[], size_t, fmi3Clock[]);
FMI3(fmi3Status, SetClock)(fmi3Instance, const fmi3ValueReference[], size_t, const fmi3Clock[]);

FMI3(fmi3Status, GetNumberOfVariableDependencies)(fmi3Instance, fmi3ValueReference, size_t*);
FMI3(fmi3Status, GetVariableDependencies)
(fmi3Instance, fmi3ValueReference, size_t elements[], fmi3ValueReference independents[], size_t of_independents[], fmi3DependencyKind[],
 size_t);
FMI3(fmi3Status, GetFMUState)(fmi3Instance, fmi3FMUState*);
FMI3(fmi3Status, SetFMUState)(fmi3Instance, fmi3FMUState);
FMI3(fmi3Status, FreeFMUState)(fmi3Instance, fmi3FMUState*);
FMI3(fmi3Status, SerializedFMUStateSize)(fmi3Instance, fmi3FMUState, size_t*);
FMI3(fmi3Status, SerializeFMUState)(fmi3Instance, fmi3FMUState, fmi3Byte[], size_t);
FMI3(fmi3Status, DeserializeFMUState)(fmi3Instance, const fmi3Byte[], size_t, fmi3FMUState*);
FMI3(fmi3Status, GetDirectionalDerivative)
(fmi3Instance, const fmi3ValueReference unknowns[], size_t, const fmi3ValueReference knowns[], size_t, const fmi3Float64 seed[], size_t,
 fmi3Float64 sensitivity[], size_t);
FMI3(fmi3Status, GetAdjointDerivative)(fmi3Instance, const fmi3ValueReference unknowns[], size_t, const fmi3ValueReference knowns[], size_t,
                                       const fmi3Float64 seed[], size_t, fmi3Float64 sensitivity[], size_t);
FMI3(fmi3Status, EnterConfigurationMode)(fmi3Instance);
FMI3(fmi3Status, ExitConfigurationMode)(fmi3Instance);
FMI3(fmi3Status, GetIntervalDecimal)(fmi3Instance, const fmi3ValueReference[], size_t, fmi3Float64[], fmi3IntervalQualifier[]);
FMI3(fmi3Status, GetIntervalFraction)
(fmi3Instance, const fmi3ValueReference[], size_t, fmi3UInt64 counters[], fmi3UInt64 resolutions[], fmi3IntervalQualifier[]);
FMI3(fmi3Status, GetShiftDecimal)(fmi3Instance, const fmi3ValueReference[], size_t, fmi3Float64[]);
FMI3(fmi3Status, GetShiftFraction)(fmi3Instance, const fmi3ValueReference[], size_t, fmi3UInt64 counters[], fmi3UInt64 resolutions[]);
FMI3(fmi3Status, SetIntervalDecimal)(fmi3Instance, const fmi3ValueReference[], size_t, const fmi3Float64[]);
FMI3(fmi3Status, SetIntervalFraction)
(fmi3Instance, const fmi3ValueReference[], size_t, const fmi3UInt64 counters[], const fmi3UInt64 resolutions[]);
FMI3(fmi3Status, SetShiftDecimal)(fmi3Instance, const fmi3ValueReference[], size_t, const fmi3Float64[]);
FMI3(fmi3Status, SetShiftFraction)
(fmi3Instance, const fmi3ValueReference[], size_t, const fmi3UInt64 counters[], const fmi3UInt64 resolutions[]);
FMI3(fmi3Status, EvaluateDiscreteStates)(fmi3Instance);
FMI3(fmi3Status, UpdateDiscreteStates)
(fmi3Instance, fmi3Boolean* needs_update, fmi3Boolean* terminate, fmi3Boolean* nominals_changed, fmi3Boolean* states_changed,
 fmi3Boolean* has_next_event, fmi3Float64* next_event);
/* Model exchange. */
FMI3(fmi3Status, EnterContinuousTimeMode)(fmi3Instance);
FMI3(fmi3Status, CompletedIntegratorStep)(fmi3Instance, fmi3Boolean no_return, fmi3Boolean* enter_event_mode, fmi3Boolean* terminate);
FMI3(fmi3Status, SetTime)(fmi3Instance, fmi3Float64);
FMI3(fmi3Status, SetContinuousStates)(fmi3Instance, const fmi3Float64[], size_t);
FMI3(fmi3Status, GetContinuousStateDerivatives)(fmi3Instance, fmi3Float64[], size_t);
FMI3(fmi3Status, GetEventIndicators)(fmi3Instance, fmi3Float64[], size_t);
FMI3(fmi3Status, GetContinuousStates)(fmi3Instance, fmi3Float64[], size_t);
FMI3(fmi3Status, GetNominalsOfContinuousStates)(fmi3Instance, fmi3Float64[], size_t);
FMI3(fmi3Status, GetNumberOfEventIndicators)(fmi3Instance, size_t*);
FMI3(fmi3Status, GetNumberOfContinuousStates)(fmi3Instance, size_t*);
/* Co-simulation, scheduled execution. */
FMI3(fmi3Status, EnterStepMode)(fmi3Instance);
FMI3(fmi3Status, GetOutputDerivatives)(fmi3Instance, const fmi3ValueReference[], size_t, const fmi3Int32 orders[], fmi3Float64[], size_t);
FMI3(fmi3Status, DoStep)
(fmi3Instance, fmi3Float64 from, fmi3Float64 length, fmi3Boolean no_return, fmi3Boolean* event_handling, fmi3Boolean* terminate,
 fmi3Boolean* early_return, fmi3Float64* last_time);
FMI3(fmi3Status, ActivateModelPartition)(fmi3Instance, fmi3ValueReference clock, fmi3Float64 time);

#endif
