/* SPDX-License-Identifier: BSL-1.0 */
/* Types and functions of the Functional Mock-up Interface 2.0, as far as an FMU needs them, with the names and values of the standard. */
#ifndef DALEMBERT_FMI2_INTERFACE_H
#define DALEMBERT_FMI2_INTERFACE_H

#include <stddef.h>

/* Importers that link sources of several FMUs define FMI2_FUNCTION_PREFIX. */
#ifdef FMI2_FUNCTION_PREFIX
#define FMI2_JOIN(a, b) a##b
#define FMI2_JOINED(a, b) FMI2_JOIN(a, b)
#define FMI2_NAME(name) FMI2_JOINED(FMI2_FUNCTION_PREFIX, name)
#define FMI2_EXPORT
#else
#define FMI2_NAME(name) name
#if defined(_WIN32) || defined(__CYGWIN__)
#define FMI2_EXPORT __declspec(dllexport)
#elif defined(__GNUC__)
#define FMI2_EXPORT __attribute__((visibility("default")))
#else
#define FMI2_EXPORT
#endif
#endif
/* Of a definition and of a declaration: FMI2(fmi2Status, Reset)(fmi2Component c). */
#define FMI2(type, name) FMI2_EXPORT type FMI2_NAME(fmi2##name)

typedef void* fmi2Component;
typedef void* fmi2ComponentEnvironment;
typedef void* fmi2FMUstate;
typedef unsigned int fmi2ValueReference;
typedef double fmi2Real;
typedef int fmi2Integer;
typedef int fmi2Boolean;
typedef const char* fmi2String;
typedef char fmi2Byte;

typedef enum { fmi2OK, fmi2Warning, fmi2Discard, fmi2Error, fmi2Fatal, fmi2Pending } fmi2Status;
typedef enum { fmi2ModelExchange, fmi2CoSimulation } fmi2Type;
typedef enum { fmi2DoStepStatus, fmi2PendingStatus, fmi2LastSuccessfulTime, fmi2Terminated } fmi2StatusKind;

typedef void (*fmi2CallbackLogger)(fmi2ComponentEnvironment, fmi2String instance, fmi2Status, fmi2String category, fmi2String message, ...);
typedef struct {
    fmi2CallbackLogger logger;
    void* (*allocateMemory)(size_t count, size_t size);
    void (*freeMemory)(void* memory);
    void (*stepFinished)(fmi2ComponentEnvironment, fmi2Status);
    fmi2ComponentEnvironment componentEnvironment;
} fmi2CallbackFunctions;

typedef struct {
    fmi2Boolean newDiscreteStatesNeeded;
    fmi2Boolean terminateSimulation;
    fmi2Boolean nominalsOfContinuousStatesChanged;
    fmi2Boolean valuesOfContinuousStatesChanged;
    fmi2Boolean nextEventTimeDefined;
    fmi2Real nextEventTime;
} fmi2EventInfo;

FMI2(const char*, GetTypesPlatform)(void);
FMI2(const char*, GetVersion)(void);
FMI2(fmi2Status, SetDebugLogging)(fmi2Component, fmi2Boolean is_on, size_t, const fmi2String categories[]);
FMI2(fmi2Component, Instantiate)
(fmi2String name, fmi2Type, fmi2String guid, fmi2String resources, const fmi2CallbackFunctions*, fmi2Boolean visible, fmi2Boolean logging);
FMI2(void, FreeInstance)(fmi2Component);
FMI2(fmi2Status, SetupExperiment)
(fmi2Component, fmi2Boolean has_tolerance, fmi2Real tolerance, fmi2Real start, fmi2Boolean has_stop, fmi2Real stop);
FMI2(fmi2Status, EnterInitializationMode)(fmi2Component);
FMI2(fmi2Status, ExitInitializationMode)(fmi2Component);
FMI2(fmi2Status, Terminate)(fmi2Component);
FMI2(fmi2Status, Reset)(fmi2Component);
FMI2(fmi2Status, GetReal)(fmi2Component, const fmi2ValueReference[], size_t, fmi2Real[]);
FMI2(fmi2Status, GetInteger)(fmi2Component, const fmi2ValueReference[], size_t, fmi2Integer[]);
FMI2(fmi2Status, GetBoolean)(fmi2Component, const fmi2ValueReference[], size_t, fmi2Boolean[]);
FMI2(fmi2Status, GetString)(fmi2Component, const fmi2ValueReference[], size_t, fmi2String[]);
FMI2(fmi2Status, SetReal)(fmi2Component, const fmi2ValueReference[], size_t, const fmi2Real[]);
FMI2(fmi2Status, SetInteger)(fmi2Component, const fmi2ValueReference[], size_t, const fmi2Integer[]);
FMI2(fmi2Status, SetBoolean)(fmi2Component, const fmi2ValueReference[], size_t, const fmi2Boolean[]);
FMI2(fmi2Status, SetString)(fmi2Component, const fmi2ValueReference[], size_t, const fmi2String[]);
FMI2(fmi2Status, GetFMUstate)(fmi2Component, fmi2FMUstate*);
FMI2(fmi2Status, SetFMUstate)(fmi2Component, fmi2FMUstate);
FMI2(fmi2Status, FreeFMUstate)(fmi2Component, fmi2FMUstate*);
FMI2(fmi2Status, SerializedFMUstateSize)(fmi2Component, fmi2FMUstate, size_t*);
FMI2(fmi2Status, SerializeFMUstate)(fmi2Component, fmi2FMUstate, fmi2Byte[], size_t);
FMI2(fmi2Status, DeSerializeFMUstate)(fmi2Component, const fmi2Byte[], size_t, fmi2FMUstate*);
FMI2(fmi2Status, GetDirectionalDerivative)
(fmi2Component, const fmi2ValueReference unknowns[], size_t, const fmi2ValueReference knowns[], size_t, const fmi2Real[], fmi2Real[]);
/* Model exchange. */
FMI2(fmi2Status, EnterEventMode)(fmi2Component);
FMI2(fmi2Status, NewDiscreteStates)(fmi2Component, fmi2EventInfo*);
FMI2(fmi2Status, EnterContinuousTimeMode)(fmi2Component);
FMI2(fmi2Status, CompletedIntegratorStep)(fmi2Component, fmi2Boolean no_return, fmi2Boolean* enter_event_mode, fmi2Boolean* terminate);
FMI2(fmi2Status, SetTime)(fmi2Component, fmi2Real);
FMI2(fmi2Status, SetContinuousStates)(fmi2Component, const fmi2Real[], size_t);
FMI2(fmi2Status, GetDerivatives)(fmi2Component, fmi2Real[], size_t);
FMI2(fmi2Status, GetEventIndicators)(fmi2Component, fmi2Real[], size_t);
FMI2(fmi2Status, GetContinuousStates)(fmi2Component, fmi2Real[], size_t);
FMI2(fmi2Status, GetNominalsOfContinuousStates)(fmi2Component, fmi2Real[], size_t);
/* Co-simulation. */
FMI2(fmi2Status, SetRealInputDerivatives)(fmi2Component, const fmi2ValueReference[], size_t, const fmi2Integer orders[], const fmi2Real[]);
FMI2(fmi2Status, GetRealOutputDerivatives)(fmi2Component, const fmi2ValueReference[], size_t, const fmi2Integer orders[], fmi2Real[]);
FMI2(fmi2Status, DoStep)(fmi2Component, fmi2Real from, fmi2Real length, fmi2Boolean no_return);
FMI2(fmi2Status, CancelStep)(fmi2Component);
FMI2(fmi2Status, GetStatus)(fmi2Component, const fmi2StatusKind, fmi2Status*);
FMI2(fmi2Status, GetRealStatus)(fmi2Component, const fmi2StatusKind, fmi2Real*);
FMI2(fmi2Status, GetIntegerStatus)(fmi2Component, const fmi2StatusKind, fmi2Integer*);
FMI2(fmi2Status, GetBooleanStatus)(fmi2Component, const fmi2StatusKind, fmi2Boolean*);
FMI2(fmi2Status, GetStringStatus)(fmi2Component, const fmi2StatusKind, fmi2String*);

#endif
