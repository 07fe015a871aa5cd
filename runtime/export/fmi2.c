/* SPDX-License-Identifier: BSL-1.0 */
/* The Functional Mock-up Interface 2.0 over a plant: model exchange and co-simulation. The model is in fmi_identity.h. */
#include "fmi2_interface.h"
#include "fmi_derivatives.h"
#include "fmi_machine.h"
#include "fmi_snapshot.h"
#include "fmi_steps.h"

/* The first lines of most functions: no instance is an error, and so is a call at the wrong time. */
#define ENTER(phases) \
    fmi_machine* m = (fmi_machine*)c; \
    if (!m || !fmi_is_allowed(m, phases, __func__)) return fmi2Error
#define ANSWER(status) return (fmi2Status)(status)

static const unsigned readable = fmi_initialising | fmi_event_mode | fmi_continuous | fmi_stepping | fmi_terminated | fmi_failed;
static const unsigned evaluable = fmi_initialising | fmi_event_mode | fmi_continuous | fmi_terminated;

/* The message goes through the importer's printf: its percent signs are doubled. */
static void tell(const fmi_machine* m, fmi_status status, const char* category, const char* message) {
    char text[600];
    size_t n = 0;
    for (; *message && n + 2 < sizeof text; ++message) {
        if (*message == '%') text[n++] = '%';
        text[n++] = *message;
    }
    text[n] = 0;
    ((fmi2CallbackLogger)m->logger)(m->environment, m->name, (fmi2Status)status, category, text);
}

FMI2(const char*, GetTypesPlatform)(void) { return "default"; }
FMI2(const char*, GetVersion)(void) { return "2.0"; }

FMI2(fmi2Status, SetDebugLogging)(fmi2Component c, fmi2Boolean is_on, size_t count, const fmi2String categories[]) {
    ENTER(fmi_any_phase);
    ANSWER(fmi_set_logging(m, is_on, count, categories, __func__));
}

FMI2(fmi2Component, Instantiate)
(fmi2String name, fmi2Type type, fmi2String guid, fmi2String resources, const fmi2CallbackFunctions* functions, fmi2Boolean visible,
 fmi2Boolean logging) {
    (void)resources, (void)visible;
    const fmi2CallbackLogger logger = functions ? functions->logger : NULL;
    const fmi2ComponentEnvironment environment = functions ? functions->componentEnvironment : NULL;
    const char* wrong = !name || !*name                                             ? "the instance has no name"
                        : !guid || strcmp(guid, FMI_TOKEN) != 0                     ? "the GUID is not that of this FMU"
                        : type != fmi2ModelExchange && type != fmi2CoSimulation ? "the type is neither model exchange nor co-simulation"
                                                                                    : NULL;
    fmi_machine* m = wrong ? NULL : fmi_new(type == fmi2CoSimulation, name);
    if (!m) {
        if (logger)
            logger(environment, name ? name : "", fmi2Error, "logStatusError", "fmi2Instantiate: %s.",
                   wrong ? wrong : "there is no memory");
        return NULL;
    }
    m->environment = environment;
    m->logger = (void (*)(void))logger;
    m->tell = tell;
    m->logged = logging ? (1u << fmi_categories) - 1u : 1u << fmi_log_error;
    return m;
}

FMI2(void, FreeInstance)(fmi2Component c) { fmi_free((fmi_machine*)c); }

FMI2(fmi2Status, SetupExperiment)
(fmi2Component c, fmi2Boolean has_tolerance, fmi2Real tolerance, fmi2Real start, fmi2Boolean has_stop, fmi2Real stop) {
    ENTER(fmi_instantiated);
    ANSWER(fmi_set_experiment(m, has_tolerance, tolerance, start, has_stop, stop, __func__));
}

FMI2(fmi2Status, EnterInitializationMode)(fmi2Component c) {
    ENTER(fmi_instantiated);
    m->phase = fmi_initialising;
    return fmi2OK;
}

FMI2(fmi2Status, ExitInitializationMode)(fmi2Component c) {
    ENTER(fmi_initialising);
    ANSWER(fmi_leave_initialisation(m, __func__));
}

FMI2(fmi2Status, Terminate)(fmi2Component c) {
    ENTER(fmi_event_mode | fmi_continuous | fmi_stepping);
    m->phase = fmi_terminated;
    return fmi2OK;
}

FMI2(fmi2Status, Reset)(fmi2Component c) {
    ENTER(fmi_any_phase);
    fmi_begin_anew(m);
    return fmi2OK;
}

/* --- variables ---------------------------------------------------------------------------------------------------------------------- */

FMI2(fmi2Status, GetReal)(fmi2Component c, const fmi2ValueReference references[], size_t count, fmi2Real values[]) {
    ENTER(readable);
    ANSWER(fmi_get(m, references, count, values, __func__));
}

FMI2(fmi2Status, GetInteger)(fmi2Component c, const fmi2ValueReference references[], size_t count, fmi2Integer values[]) {
    ENTER(readable);
    const fmi_status status =
        count > 0 && !values ? fmi_say_of(m, fmi_error, __func__, "an array is missing") : fmi_get_mode(m, references, count, __func__);
    if (status == fmi_ok)
        for (size_t i = 0; i < count; ++i) values[i] = (fmi2Integer)m->mode;
    ANSWER(status);
}

FMI2(fmi2Status, GetBoolean)(fmi2Component c, const fmi2ValueReference references[], size_t count, fmi2Boolean values[]) {
    ENTER(readable);
    (void)references, (void)values;
    ANSWER(fmi_no_variables(m, count, __func__));
}

FMI2(fmi2Status, GetString)(fmi2Component c, const fmi2ValueReference references[], size_t count, fmi2String values[]) {
    ENTER(readable);
    (void)references, (void)values;
    ANSWER(fmi_no_variables(m, count, __func__));
}

FMI2(fmi2Status, SetReal)(fmi2Component c, const fmi2ValueReference references[], size_t count, const fmi2Real values[]) {
    ENTER(fmi_instantiated | fmi_initialising | fmi_event_mode | fmi_continuous | fmi_stepping);
    ANSWER(fmi_set(m, references, count, values, __func__));
}

FMI2(fmi2Status, SetInteger)(fmi2Component c, const fmi2ValueReference references[], size_t count, const fmi2Integer values[]) {
    ENTER(fmi_instantiated | fmi_initialising | fmi_event_mode | fmi_stepping);
    (void)references, (void)values;
    ANSWER(fmi_no_variables(m, count, __func__));
}

FMI2(fmi2Status, SetBoolean)(fmi2Component c, const fmi2ValueReference references[], size_t count, const fmi2Boolean values[]) {
    ENTER(fmi_instantiated | fmi_initialising | fmi_event_mode | fmi_stepping);
    (void)references, (void)values;
    ANSWER(fmi_no_variables(m, count, __func__));
}

FMI2(fmi2Status, SetString)(fmi2Component c, const fmi2ValueReference references[], size_t count, const fmi2String values[]) {
    ENTER(fmi_instantiated | fmi_initialising | fmi_event_mode | fmi_stepping);
    (void)references, (void)values;
    ANSWER(fmi_no_variables(m, count, __func__));
}

FMI2(fmi2Status, GetFMUstate)(fmi2Component c, fmi2FMUstate* state) {
    ENTER(fmi_any_phase);
    ANSWER(fmi_get_snapshot(m, state, __func__));
}

FMI2(fmi2Status, SetFMUstate)(fmi2Component c, fmi2FMUstate state) {
    ENTER(fmi_any_phase);
    ANSWER(fmi_set_snapshot(m, state, __func__));
}

FMI2(fmi2Status, FreeFMUstate)(fmi2Component c, fmi2FMUstate* state) {
    ENTER(fmi_any_phase);
    if (!state) return fmi2OK;
    free(*state);
    *state = NULL;
    return fmi2OK;
}

FMI2(fmi2Status, SerializedFMUstateSize)(fmi2Component c, fmi2FMUstate state, size_t* size) {
    ENTER(fmi_any_phase);
    if (!state || !size) ANSWER(fmi_say_of(m, fmi_error, __func__, "the state or the place of the result is missing"));
    *size = fmi_snapshot_size(m);
    return fmi2OK;
}

FMI2(fmi2Status, SerializeFMUstate)(fmi2Component c, fmi2FMUstate state, fmi2Byte bytes[], size_t size) {
    ENTER(fmi_any_phase);
    ANSWER(fmi_serialise(m, state, bytes, size, __func__));
}

FMI2(fmi2Status, DeSerializeFMUstate)(fmi2Component c, const fmi2Byte bytes[], size_t size, fmi2FMUstate* state) {
    ENTER(fmi_any_phase);
    ANSWER(fmi_deserialise(m, bytes, size, state, __func__));
}

FMI2(fmi2Status, GetDirectionalDerivative)
(fmi2Component c, const fmi2ValueReference unknowns[], size_t unknown_count, const fmi2ValueReference knowns[], size_t known_count,
 const fmi2Real seed[], fmi2Real sensitivity[]) {
    ENTER(evaluable | fmi_stepping);
    ANSWER(fmi_differentiate(m, 0, unknowns, unknown_count, knowns, known_count, seed, sensitivity, __func__));
}

/* --- model exchange ----------------------------------------------------------------------------------------------------------------- */

/* What only instances of model exchange answer. */
#define ENTER_EXCHANGE(phases) \
    ENTER(phases); \
    if (!m->modes) ANSWER(fmi_say_of(m, fmi_error, __func__, "the instance is one of co-simulation"))

FMI2(fmi2Status, EnterEventMode)(fmi2Component c) {
    ENTER_EXCHANGE(fmi_event_mode | fmi_continuous);
    m->phase = fmi_event_mode;
    m->is_disturbed = 1;
    return fmi2OK;
}

FMI2(fmi2Status, NewDiscreteStates)(fmi2Component c, fmi2EventInfo* info) {
    ENTER_EXCHANGE(fmi_event_mode);
    if (!info) ANSWER(fmi_say_of(m, fmi_error, __func__, "no place for the result is given"));
    memset(info, 0, sizeof *info);
    fmi_news news;
    const fmi_status status = fmi_handle_events(m, &news, __func__);
    info->terminateSimulation = news.is_over;
    info->valuesOfContinuousStatesChanged = news.states_changed;
    info->nextEventTimeDefined = news.has_next;
    info->nextEventTime = news.next;
    ANSWER(status);
}

FMI2(fmi2Status, EnterContinuousTimeMode)(fmi2Component c) {
    ENTER_EXCHANGE(fmi_event_mode);
    m->phase = fmi_continuous;
    return fmi2OK;
}

FMI2(fmi2Status, CompletedIntegratorStep)(fmi2Component c, fmi2Boolean no_return, fmi2Boolean* enter_event_mode, fmi2Boolean* terminate) {
    ENTER_EXCHANGE(fmi_continuous);
    (void)no_return;
    if (!enter_event_mode || !terminate) ANSWER(fmi_say_of(m, fmi_error, __func__, "no place for the result is given"));
    ANSWER(fmi_complete_step(m, enter_event_mode, terminate, __func__));
}

FMI2(fmi2Status, SetTime)(fmi2Component c, fmi2Real t) {
    ENTER_EXCHANGE(fmi_event_mode | fmi_continuous);
    ANSWER(fmi_set_time(m, t, __func__));
}

FMI2(fmi2Status, SetContinuousStates)(fmi2Component c, const fmi2Real x[], size_t count) {
    ENTER_EXCHANGE(fmi_continuous);
    ANSWER(fmi_set_state(m, x, count, __func__));
}

FMI2(fmi2Status, GetDerivatives)(fmi2Component c, fmi2Real values[], size_t count) {
    ENTER_EXCHANGE(evaluable);
    if (fmi_start(m, __func__) != fmi_ok) return fmi2Error;
    ANSWER(fmi_give(m, fmi_rates(m), m->plant->states, values, count, __func__));
}

FMI2(fmi2Status, GetEventIndicators)(fmi2Component c, fmi2Real values[], size_t count) {
    ENTER_EXCHANGE(evaluable);
    if (fmi_start(m, __func__) != fmi_ok) return fmi2Error;
    ANSWER(fmi_give(m, fmi_indicators(m), dalembert_event_values(m->plant), values, count, __func__));
}

FMI2(fmi2Status, GetContinuousStates)(fmi2Component c, fmi2Real values[], size_t count) {
    ENTER_EXCHANGE(evaluable);
    if (fmi_start(m, __func__) != fmi_ok) return fmi2Error;
    ANSWER(fmi_give(m, m->x, m->plant->states, values, count, __func__));
}

FMI2(fmi2Status, GetNominalsOfContinuousStates)(fmi2Component c, fmi2Real values[], size_t count) {
    ENTER_EXCHANGE(evaluable | fmi_instantiated);
    ANSWER(fmi_give_nominals(m, values, count, __func__));
}

/* --- co-simulation ------------------------------------------------------------------------------------------------------------------ */

#define ENTER_STEPS(phases) \
    ENTER(phases); \
    if (!m->run) ANSWER(fmi_say_of(m, fmi_error, __func__, "the instance is one of model exchange"))

/* canInterpolateInputs and maxOutputDerivativeOrder say that there are no such derivatives. */
FMI2(fmi2Status, SetRealInputDerivatives)
(fmi2Component c, const fmi2ValueReference references[], size_t count, const fmi2Integer orders[], const fmi2Real values[]) {
    ENTER_STEPS(fmi_instantiated | fmi_initialising | fmi_stepping);
    (void)references, (void)count, (void)orders, (void)values;
    ANSWER(fmi_say_of(m, fmi_error, __func__, "derivatives of inputs are not supported"));
}

FMI2(fmi2Status, GetRealOutputDerivatives)
(fmi2Component c, const fmi2ValueReference references[], size_t count, const fmi2Integer orders[], fmi2Real values[]) {
    ENTER_STEPS(fmi_stepping | fmi_terminated | fmi_failed);
    (void)references, (void)count, (void)orders, (void)values;
    ANSWER(fmi_say_of(m, fmi_error, __func__, "derivatives of outputs are not supported"));
}

FMI2(fmi2Status, DoStep)(fmi2Component c, fmi2Real from, fmi2Real length, fmi2Boolean no_return) {
    ENTER_STEPS(fmi_stepping);
    (void)no_return;
    double reached;
    int is_over;
    ANSWER(fmi_step(m, from, length, &reached, &is_over, __func__));
}

/* Steps are made at once: none is ever pending. */
FMI2(fmi2Status, CancelStep)(fmi2Component c) {
    ENTER_STEPS(0);
    return fmi2Error;
}

static const unsigned asked = fmi_stepping | fmi_failed | fmi_terminated;

FMI2(fmi2Status, GetStatus)(fmi2Component c, const fmi2StatusKind kind, fmi2Status* value) {
    ENTER_STEPS(asked);
    (void)kind, (void)value;
    ANSWER(fmi_say_of(m, fmi_discard, __func__, "no step is pending"));
}

FMI2(fmi2Status, GetRealStatus)(fmi2Component c, const fmi2StatusKind kind, fmi2Real* value) {
    ENTER_STEPS(asked);
    if (kind != fmi2LastSuccessfulTime || !value) ANSWER(fmi_say_of(m, fmi_discard, __func__, "only the last successful time is known"));
    *value = m->t;
    return fmi2OK;
}

FMI2(fmi2Status, GetIntegerStatus)(fmi2Component c, const fmi2StatusKind kind, fmi2Integer* value) {
    ENTER_STEPS(asked);
    (void)kind, (void)value;
    ANSWER(fmi_say_of(m, fmi_discard, __func__, "there is no such status"));
}

FMI2(fmi2Status, GetBooleanStatus)(fmi2Component c, const fmi2StatusKind kind, fmi2Boolean* value) {
    ENTER_STEPS(asked);
    if (kind != fmi2Terminated || !value) ANSWER(fmi_say_of(m, fmi_discard, __func__, "only whether the model has ended is known"));
    *value = m->is_over;
    return fmi2OK;
}

FMI2(fmi2Status, GetStringStatus)(fmi2Component c, const fmi2StatusKind kind, fmi2String* value) {
    ENTER_STEPS(asked);
    (void)kind, (void)value;
    ANSWER(fmi_say_of(m, fmi_discard, __func__, "no step is pending"));
}
