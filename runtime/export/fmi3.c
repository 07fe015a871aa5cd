/* SPDX-License-Identifier: BSL-1.0 */
/* The Functional Mock-up Interface 3.0 over a plant: model exchange and co-simulation. The model is in fmi_identity.h. */
#include "fmi3_interface.h"
#include "fmi_derivatives.h"
#include "fmi_machine.h"
#include "fmi_snapshot.h"
#include "fmi_steps.h"

/* The first lines of most functions: no instance is an error, and so is a call at the wrong time. */
#define ENTER(phases) \
    fmi_machine* m = (fmi_machine*)c; \
    if (!m || !fmi_is_allowed(m, phases, __func__)) return fmi3Error
#define ANSWER(status) return (fmi3Status)(status)

static const unsigned readable = fmi_instantiated | fmi_initialising | fmi_event_mode | fmi_continuous | fmi_stepping | fmi_terminated;
static const unsigned settable = fmi_instantiated | fmi_initialising | fmi_event_mode | fmi_continuous | fmi_stepping;
static const unsigned evaluable = fmi_initialising | fmi_event_mode | fmi_continuous | fmi_terminated;

static void tell(const fmi_machine* m, fmi_status status, const char* category, const char* message) {
    ((fmi3LogMessageCallback)m->logger)(m->environment, (fmi3Status)status, category, message);
}

static fmi_machine* instantiate(int is_co_simulation, fmi3String name, fmi3String token, fmi3Boolean logging,
                                fmi3InstanceEnvironment environment, fmi3LogMessageCallback logger, const char* wrong) {
    if (!name || !*name) wrong = "The instance has no name.";
    else if (!token || strcmp(token, FMI_TOKEN) != 0) wrong = "The instantiation token is not that of this FMU.";
    fmi_machine* m = wrong ? NULL : fmi_new(is_co_simulation, name);
    if (!m) {
        if (logger) logger(environment, fmi3Error, "logStatusError", wrong ? wrong : "There is no memory.");
        return NULL;
    }
    m->environment = environment;
    m->logger = (void (*)(void))logger;
    m->tell = tell;
    m->logged = logging ? (1u << fmi_categories) - 1u : 1u << fmi_log_error;
    return m;
}

FMI3(const char*, GetVersion)(void) { return "3.0"; }

FMI3(fmi3Status, SetDebugLogging)(fmi3Instance c, fmi3Boolean is_on, size_t count, const fmi3String categories[]) {
    ENTER(fmi_any_phase);
    ANSWER(fmi_set_logging(m, is_on, count, categories, __func__));
}

FMI3(fmi3Instance, InstantiateModelExchange)
(fmi3String name, fmi3String token, fmi3String resources, fmi3Boolean visible, fmi3Boolean logging, fmi3InstanceEnvironment environment,
 fmi3LogMessageCallback logger) {
    (void)resources, (void)visible;
    return instantiate(0, name, token, logging, environment, logger, NULL);
}

FMI3(fmi3Instance, InstantiateCoSimulation)
(fmi3String name, fmi3String token, fmi3String resources, fmi3Boolean visible, fmi3Boolean logging, fmi3Boolean uses_event_mode,
 fmi3Boolean early_return, const fmi3ValueReference intermediate[], size_t count, fmi3InstanceEnvironment environment,
 fmi3LogMessageCallback logger, fmi3IntermediateUpdateCallback update) {
    (void)resources, (void)visible, (void)early_return, (void)intermediate, (void)update;
    const char* wrong = uses_event_mode ? "Co-simulation with event mode is not supported: hasEventMode is false."
                        : count > 0     ? "Intermediate variables are not supported: providesIntermediateUpdate is false."
                                        : NULL;
    return instantiate(1, name, token, logging, environment, logger, wrong);
}

FMI3(fmi3Instance, InstantiateScheduledExecution)
(fmi3String name, fmi3String token, fmi3String resources, fmi3Boolean visible, fmi3Boolean logging, fmi3InstanceEnvironment environment,
 fmi3LogMessageCallback logger, fmi3ClockUpdateCallback clock, fmi3LockPreemptionCallback lock, fmi3UnlockPreemptionCallback unlock) {
    (void)resources, (void)visible, (void)clock, (void)lock, (void)unlock;
    return instantiate(0, name, token, logging, environment, logger, "Scheduled execution is not supported.");
}

FMI3(void, FreeInstance)(fmi3Instance c) { fmi_free((fmi_machine*)c); }

FMI3(fmi3Status, EnterInitializationMode)
(fmi3Instance c, fmi3Boolean has_tolerance, fmi3Float64 tolerance, fmi3Float64 start, fmi3Boolean has_stop, fmi3Float64 stop) {
    ENTER(fmi_instantiated);
    const fmi_status status = fmi_set_experiment(m, has_tolerance, tolerance, start, has_stop, stop, __func__);
    if (status == fmi_ok) m->phase = fmi_initialising;
    ANSWER(status);
}

FMI3(fmi3Status, ExitInitializationMode)(fmi3Instance c) {
    ENTER(fmi_initialising);
    ANSWER(fmi_leave_initialisation(m, __func__));
}

FMI3(fmi3Status, Terminate)(fmi3Instance c) {
    ENTER(fmi_event_mode | fmi_continuous | fmi_stepping);
    m->phase = fmi_terminated;
    return fmi3OK;
}

FMI3(fmi3Status, Reset)(fmi3Instance c) {
    ENTER(fmi_any_phase);
    fmi_begin_anew(m);
    return fmi3OK;
}

/* --- variables ---------------------------------------------------------------------------------------------------------------------- */

static const char different[] = "the numbers of value references and of values differ";

FMI3(fmi3Status, GetFloat64)
(fmi3Instance c, const fmi3ValueReference references[], size_t count, fmi3Float64 values[], size_t value_count) {
    ENTER(readable);
    ANSWER(value_count != count ? fmi_say_of(m, fmi_error, __func__, different) : fmi_get(m, references, count, values, __func__));
}

FMI3(fmi3Status, SetFloat64)
(fmi3Instance c, const fmi3ValueReference references[], size_t count, const fmi3Float64 values[], size_t value_count) {
    ENTER(settable);
    ANSWER(value_count != count ? fmi_say_of(m, fmi_error, __func__, different) : fmi_set(m, references, count, values, __func__));
}

/* The mode is an enumeration; its values are read so. */
FMI3(fmi3Status, GetInt64)(fmi3Instance c, const fmi3ValueReference references[], size_t count, fmi3Int64 values[], size_t value_count) {
    ENTER(readable);
    if (value_count != count || (count > 0 && !values)) ANSWER(fmi_say_of(m, fmi_error, __func__, different));
    const fmi_status status = fmi_get_mode(m, references, count, __func__);
    if (status == fmi_ok)
        for (size_t i = 0; i < count; ++i) values[i] = (fmi3Int64)m->mode;
    ANSWER(status);
}

/* Types of which there are no variables. */
#define NO_GETTER(type)                                                                                              \
    FMI3(fmi3Status, Get##type)                                                                                      \
    (fmi3Instance c, const fmi3ValueReference references[], size_t count, fmi3##type values[], size_t value_count) { \
        ENTER(readable);                                                                                             \
        (void)references, (void)values, (void)value_count;                                                           \
        ANSWER(fmi_no_variables(m, count, __func__));                                                                \
    }
#define NO_SETTER(type)                                                                                                    \
    FMI3(fmi3Status, Set##type)                                                                                            \
    (fmi3Instance c, const fmi3ValueReference references[], size_t count, const fmi3##type values[], size_t value_count) { \
        ENTER(settable);                                                                                                   \
        (void)references, (void)values, (void)value_count;                                                                 \
        ANSWER(fmi_no_variables(m, count, __func__));                                                                      \
    }
#define NO_VARIABLES(type) NO_GETTER(type) NO_SETTER(type)
NO_VARIABLES(Float32)
NO_VARIABLES(Int8)
NO_VARIABLES(UInt8)
NO_VARIABLES(Int16)
NO_VARIABLES(UInt16)
NO_VARIABLES(Int32)
NO_VARIABLES(UInt32)
NO_VARIABLES(UInt64)
NO_VARIABLES(Boolean)
NO_VARIABLES(String)
NO_SETTER(Int64)

FMI3(fmi3Status, GetBinary)
(fmi3Instance c, const fmi3ValueReference references[], size_t count, size_t sizes[], fmi3Binary values[], size_t value_count) {
    ENTER(readable);
    (void)references, (void)sizes, (void)values, (void)value_count;
    ANSWER(fmi_no_variables(m, count, __func__));
}

FMI3(fmi3Status, SetBinary)
(fmi3Instance c, const fmi3ValueReference references[], size_t count, const size_t sizes[], const fmi3Binary values[], size_t value_count) {
    ENTER(settable);
    (void)references, (void)sizes, (void)values, (void)value_count;
    ANSWER(fmi_no_variables(m, count, __func__));
}

FMI3(fmi3Status, GetClock)(fmi3Instance c, const fmi3ValueReference references[], size_t count, fmi3Clock values[]) {
    ENTER(readable);
    (void)references, (void)values;
    ANSWER(fmi_no_variables(m, count, __func__));
}

FMI3(fmi3Status, SetClock)(fmi3Instance c, const fmi3ValueReference references[], size_t count, const fmi3Clock values[]) {
    ENTER(settable);
    (void)references, (void)values;
    ANSWER(fmi_no_variables(m, count, __func__));
}

/* modelDescription.xml tells the dependencies: providesPerElementDependencies is false. */
FMI3(fmi3Status, GetNumberOfVariableDependencies)(fmi3Instance c, fmi3ValueReference reference, size_t* count) {
    ENTER(fmi_any_phase);
    (void)reference, (void)count;
    ANSWER(fmi_say_of(m, fmi_error, __func__, "dependencies stand in modelDescription.xml only"));
}

FMI3(fmi3Status, GetVariableDependencies)
(fmi3Instance c, fmi3ValueReference reference, size_t elements[], fmi3ValueReference independents[], size_t of_independents[],
 fmi3DependencyKind kinds[], size_t count) {
    ENTER(fmi_any_phase);
    (void)reference, (void)elements, (void)independents, (void)of_independents, (void)kinds, (void)count;
    ANSWER(fmi_say_of(m, fmi_error, __func__, "dependencies stand in modelDescription.xml only"));
}

FMI3(fmi3Status, GetFMUState)(fmi3Instance c, fmi3FMUState* state) {
    ENTER(fmi_any_phase);
    ANSWER(fmi_get_snapshot(m, state, __func__));
}

FMI3(fmi3Status, SetFMUState)(fmi3Instance c, fmi3FMUState state) {
    ENTER(fmi_any_phase);
    ANSWER(fmi_set_snapshot(m, state, __func__));
}

FMI3(fmi3Status, FreeFMUState)(fmi3Instance c, fmi3FMUState* state) {
    ENTER(fmi_any_phase);
    if (!state) return fmi3OK;
    free(*state);
    *state = NULL;
    return fmi3OK;
}

FMI3(fmi3Status, SerializedFMUStateSize)(fmi3Instance c, fmi3FMUState state, size_t* size) {
    ENTER(fmi_any_phase);
    if (!state || !size) ANSWER(fmi_say_of(m, fmi_error, __func__, "the state or the place of the result is missing"));
    *size = fmi_snapshot_size(m);
    return fmi3OK;
}

FMI3(fmi3Status, SerializeFMUState)(fmi3Instance c, fmi3FMUState state, fmi3Byte bytes[], size_t size) {
    ENTER(fmi_any_phase);
    ANSWER(fmi_serialise(m, state, bytes, size, __func__));
}

FMI3(fmi3Status, DeserializeFMUState)(fmi3Instance c, const fmi3Byte bytes[], size_t size, fmi3FMUState* state) {
    ENTER(fmi_any_phase);
    ANSWER(fmi_deserialise(m, bytes, size, state, __func__));
}

static const char wrong_lengths[] = "the lengths of the seed or the sensitivity do not belong to the variables";

FMI3(fmi3Status, GetDirectionalDerivative)
(fmi3Instance c, const fmi3ValueReference unknowns[], size_t unknown_count, const fmi3ValueReference knowns[], size_t known_count,
 const fmi3Float64 seed[], size_t seed_count, fmi3Float64 sensitivity[], size_t sensitivity_count) {
    ENTER(evaluable | fmi_stepping);
    if (seed_count != known_count || sensitivity_count != unknown_count) ANSWER(fmi_say_of(m, fmi_error, __func__, wrong_lengths));
    ANSWER(fmi_differentiate(m, 0, unknowns, unknown_count, knowns, known_count, seed, sensitivity, __func__));
}

FMI3(fmi3Status, GetAdjointDerivative)
(fmi3Instance c, const fmi3ValueReference unknowns[], size_t unknown_count, const fmi3ValueReference knowns[], size_t known_count,
 const fmi3Float64 seed[], size_t seed_count, fmi3Float64 sensitivity[], size_t sensitivity_count) {
    ENTER(evaluable | fmi_stepping);
    if (seed_count != unknown_count || sensitivity_count != known_count) ANSWER(fmi_say_of(m, fmi_error, __func__, wrong_lengths));
    ANSWER(fmi_differentiate(m, 1, unknowns, unknown_count, knowns, known_count, seed, sensitivity, __func__));
}

/* --- what needs structural parameters or clocks -------------------------------------------------------------------------------------- */

FMI3(fmi3Status, EnterConfigurationMode)(fmi3Instance c) {
    ENTER(fmi_instantiated | fmi_event_mode | fmi_stepping);
    ANSWER(fmi_say_of(m, fmi_error, __func__, "the FMU has no structural parameters"));
}

FMI3(fmi3Status, ExitConfigurationMode)(fmi3Instance c) {
    ENTER(0);
    return fmi3Error;
}

FMI3(fmi3Status, GetIntervalDecimal)
(fmi3Instance c, const fmi3ValueReference references[], size_t count, fmi3Float64 intervals[], fmi3IntervalQualifier qualifiers[]) {
    ENTER(fmi_any_phase);
    (void)references, (void)intervals, (void)qualifiers;
    ANSWER(fmi_no_variables(m, count, __func__));
}

FMI3(fmi3Status, GetIntervalFraction)
(fmi3Instance c, const fmi3ValueReference references[], size_t count, fmi3UInt64 counters[], fmi3UInt64 resolutions[],
 fmi3IntervalQualifier qualifiers[]) {
    ENTER(fmi_any_phase);
    (void)references, (void)counters, (void)resolutions, (void)qualifiers;
    ANSWER(fmi_no_variables(m, count, __func__));
}

FMI3(fmi3Status, GetShiftDecimal)(fmi3Instance c, const fmi3ValueReference references[], size_t count, fmi3Float64 shifts[]) {
    ENTER(fmi_any_phase);
    (void)references, (void)shifts;
    ANSWER(fmi_no_variables(m, count, __func__));
}

FMI3(fmi3Status, GetShiftFraction)
(fmi3Instance c, const fmi3ValueReference references[], size_t count, fmi3UInt64 counters[], fmi3UInt64 resolutions[]) {
    ENTER(fmi_any_phase);
    (void)references, (void)counters, (void)resolutions;
    ANSWER(fmi_no_variables(m, count, __func__));
}

FMI3(fmi3Status, SetIntervalDecimal)(fmi3Instance c, const fmi3ValueReference references[], size_t count, const fmi3Float64 intervals[]) {
    ENTER(fmi_any_phase);
    (void)references, (void)intervals;
    ANSWER(fmi_no_variables(m, count, __func__));
}

FMI3(fmi3Status, SetIntervalFraction)
(fmi3Instance c, const fmi3ValueReference references[], size_t count, const fmi3UInt64 counters[], const fmi3UInt64 resolutions[]) {
    ENTER(fmi_any_phase);
    (void)references, (void)counters, (void)resolutions;
    ANSWER(fmi_no_variables(m, count, __func__));
}

FMI3(fmi3Status, SetShiftDecimal)(fmi3Instance c, const fmi3ValueReference references[], size_t count, const fmi3Float64 shifts[]) {
    ENTER(fmi_any_phase);
    (void)references, (void)shifts;
    ANSWER(fmi_no_variables(m, count, __func__));
}

FMI3(fmi3Status, SetShiftFraction)
(fmi3Instance c, const fmi3ValueReference references[], size_t count, const fmi3UInt64 counters[], const fmi3UInt64 resolutions[]) {
    ENTER(fmi_any_phase);
    (void)references, (void)counters, (void)resolutions;
    ANSWER(fmi_no_variables(m, count, __func__));
}

FMI3(fmi3Status, ActivateModelPartition)(fmi3Instance c, fmi3ValueReference clock, fmi3Float64 time) {
    ENTER(fmi_any_phase);
    (void)clock, (void)time;
    ANSWER(fmi_say_of(m, fmi_error, __func__, "scheduled execution is not supported"));
}

/* --- model exchange ----------------------------------------------------------------------------------------------------------------- */

/* What only instances of model exchange answer. */
#define ENTER_EXCHANGE(phases) \
    ENTER(phases); \
    if (!m->modes) ANSWER(fmi_say_of(m, fmi_error, __func__, "the instance is one of co-simulation"))

FMI3(fmi3Status, EnterEventMode)(fmi3Instance c) {
    ENTER_EXCHANGE(fmi_continuous);
    m->phase = fmi_event_mode;
    m->is_disturbed = 1;
    return fmi3OK;
}

/* All that an event brings comes with UpdateDiscreteStates. */
FMI3(fmi3Status, EvaluateDiscreteStates)(fmi3Instance c) {
    ENTER(fmi_initialising | fmi_event_mode);
    return fmi3OK;
}

FMI3(fmi3Status, UpdateDiscreteStates)(fmi3Instance c, fmi3Boolean* needs_update, fmi3Boolean* terminate, fmi3Boolean* nominals_changed,
                                       fmi3Boolean* states_changed, fmi3Boolean* has_next_event, fmi3Float64* next_event) {
    ENTER_EXCHANGE(fmi_event_mode);
    if (!needs_update || !terminate || !nominals_changed || !states_changed || !has_next_event || !next_event)
        ANSWER(fmi_say_of(m, fmi_error, __func__, "no place for the result is given"));
    fmi_news news;
    const fmi_status status = fmi_handle_events(m, &news, __func__);
    *needs_update = *nominals_changed = false;
    *has_next_event = news.has_next != 0;
    *next_event = news.next;
    *terminate = news.is_over != 0;
    *states_changed = news.states_changed != 0;
    ANSWER(status);
}

FMI3(fmi3Status, EnterContinuousTimeMode)(fmi3Instance c) {
    ENTER_EXCHANGE(fmi_event_mode);
    m->phase = fmi_continuous;
    return fmi3OK;
}

FMI3(fmi3Status, CompletedIntegratorStep)(fmi3Instance c, fmi3Boolean no_return, fmi3Boolean* enter_event_mode, fmi3Boolean* terminate) {
    ENTER_EXCHANGE(fmi_continuous);
    (void)no_return;
    if (!enter_event_mode || !terminate) ANSWER(fmi_say_of(m, fmi_error, __func__, "no place for the result is given"));
    int wants_event_mode = 0, is_over = 0;
    const fmi_status status = fmi_complete_step(m, &wants_event_mode, &is_over, __func__);
    *enter_event_mode = wants_event_mode != 0;
    *terminate = is_over != 0;
    ANSWER(status);
}

FMI3(fmi3Status, SetTime)(fmi3Instance c, fmi3Float64 t) {
    ENTER_EXCHANGE(fmi_event_mode | fmi_continuous);
    ANSWER(fmi_set_time(m, t, __func__));
}

FMI3(fmi3Status, SetContinuousStates)(fmi3Instance c, const fmi3Float64 x[], size_t count) {
    ENTER_EXCHANGE(fmi_continuous);
    ANSWER(fmi_set_state(m, x, count, __func__));
}

FMI3(fmi3Status, GetContinuousStateDerivatives)(fmi3Instance c, fmi3Float64 values[], size_t count) {
    ENTER_EXCHANGE(evaluable);
    if (fmi_start(m, __func__) != fmi_ok) return fmi3Error;
    ANSWER(fmi_give(m, fmi_rates(m), m->plant->states, values, count, __func__));
}

FMI3(fmi3Status, GetEventIndicators)(fmi3Instance c, fmi3Float64 values[], size_t count) {
    ENTER_EXCHANGE(evaluable);
    if (fmi_start(m, __func__) != fmi_ok) return fmi3Error;
    ANSWER(fmi_give(m, fmi_indicators(m), dalembert_event_values(m->plant), values, count, __func__));
}

FMI3(fmi3Status, GetContinuousStates)(fmi3Instance c, fmi3Float64 values[], size_t count) {
    ENTER_EXCHANGE(evaluable);
    if (fmi_start(m, __func__) != fmi_ok) return fmi3Error;
    ANSWER(fmi_give(m, m->x, m->plant->states, values, count, __func__));
}

FMI3(fmi3Status, GetNominalsOfContinuousStates)(fmi3Instance c, fmi3Float64 values[], size_t count) {
    ENTER_EXCHANGE(evaluable);
    ANSWER(fmi_give_nominals(m, values, count, __func__));
}

FMI3(fmi3Status, GetNumberOfEventIndicators)(fmi3Instance c, size_t* count) {
    ENTER_EXCHANGE(fmi_any_phase);
    if (!count) ANSWER(fmi_say_of(m, fmi_error, __func__, "no place for the result is given"));
    *count = dalembert_event_values(m->plant);
    return fmi3OK;
}

FMI3(fmi3Status, GetNumberOfContinuousStates)(fmi3Instance c, size_t* count) {
    ENTER_EXCHANGE(fmi_any_phase);
    if (!count) ANSWER(fmi_say_of(m, fmi_error, __func__, "no place for the result is given"));
    *count = m->plant->states;
    return fmi3OK;
}

/* --- co-simulation ------------------------------------------------------------------------------------------------------------------ */

#define ENTER_STEPS(phases) \
    ENTER(phases); \
    if (!m->run) ANSWER(fmi_say_of(m, fmi_error, __func__, "the instance is one of model exchange"))

/* Without event mode, an instance is in step mode as soon as it is initialised. */
FMI3(fmi3Status, EnterStepMode)(fmi3Instance c) {
    ENTER_STEPS(fmi_event_mode);
    return fmi3Error;
}

/* maxOutputDerivativeOrder says that there are none. */
FMI3(fmi3Status, GetOutputDerivatives)
(fmi3Instance c, const fmi3ValueReference references[], size_t count, const fmi3Int32 orders[], fmi3Float64 values[], size_t value_count) {
    ENTER_STEPS(fmi_stepping | fmi_terminated);
    (void)references, (void)orders, (void)values, (void)count, (void)value_count;
    ANSWER(fmi_say_of(m, fmi_error, __func__, "derivatives of outputs are not supported"));
}

FMI3(fmi3Status, DoStep)
(fmi3Instance c, fmi3Float64 from, fmi3Float64 length, fmi3Boolean no_return, fmi3Boolean* event_handling, fmi3Boolean* terminate,
 fmi3Boolean* early_return, fmi3Float64* last_time) {
    ENTER_STEPS(fmi_stepping);
    (void)no_return;
    if (!event_handling || !terminate || !early_return || !last_time)
        ANSWER(fmi_say_of(m, fmi_error, __func__, "no place for the result is given"));
    const int was_over = m->is_over;
    int is_over = 0;
    const fmi_status status = fmi_step(m, from, length, last_time, &is_over, __func__);
    *event_handling = *early_return = false;
    *terminate = is_over != 0;
    /* Where the model ends within the step, that is no failure: the flag and the last time say it. */
    if (status == fmi_discard && is_over && !was_over) return fmi3OK;
    ANSWER(status);
}
