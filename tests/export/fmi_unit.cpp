// SPDX-License-Identifier: GPL-3.0-or-later
#include "fmi_unit.hpp"

#include <dlfcn.h>

#include <cstdarg>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <stdexcept>

extern "C" {
#include "export/fmi2_interface.h"
#include "export/fmi3_interface.h"
}

namespace fmi_test {

namespace fs = std::filesystem;

namespace {

[[noreturn]] void fail(const std::string& what) { throw std::runtime_error(what); }

// --- the functions of a binary -------------------------------------------------------------------------------------------------------

template <class Function>
Function* find(void* binary, const char* name) {
    void* const found = dlsym(binary, name);
    if (found == nullptr) fail(std::string("the binary has no function ") + name);
    return reinterpret_cast<Function*>(found);
}
#define CALL2(name) find<decltype(fmi2##name)>(binary_, "fmi2" #name)
#define CALL3(name) find<decltype(fmi3##name)>(binary_, "fmi3" #name)

void log_two(void*, fmi2String, fmi2Status, fmi2String category, fmi2String message, ...) {
    char text[1000];
    va_list arguments;
    va_start(arguments, message);
    vsnprintf(text, sizeof text, message, arguments);
    va_end(arguments);
    messages().push_back(std::string(category) + ": " + text);
}
void log_three(void*, fmi3Status, fmi3String category, fmi3String message) { messages().push_back(std::string(category) + ": " + message); }

class InstanceOfTwo : public Instance {
public:
    InstanceOfTwo(void* binary, void* c, std::unique_ptr<fmi2CallbackFunctions> functions)
        : binary_(binary), c_(c), functions_(std::move(functions)) {}
    ~InstanceOfTwo() override { CALL2(FreeInstance)(c_); }
    Status setup(double tolerance, double start, double stop) override {
        const Status status = as(CALL2(SetupExperiment)(c_, tolerance > 0, tolerance, start, stop > start, stop));
        return status == ok ? as(CALL2(EnterInitializationMode)(c_)) : status;
    }
    Status end_setup() override { return as(CALL2(ExitInitializationMode)(c_)); }
    Status get(const References& references, Vector& values) override {
        values.resize(references.size());
        return as(CALL2(GetReal)(c_, references.data(), references.size(), values.data()));
    }
    Status set(const References& references, const Vector& values) override {
        return as(CALL2(SetReal)(c_, references.data(), references.size(), values.data()));
    }
    long mode(unsigned reference) override {
        int value = -1;
        return CALL2(GetInteger)(c_, &reference, 1, &value) == fmi2OK ? value : -1;
    }
    Status enter_events() override { return as(CALL2(EnterEventMode)(c_)); }
    Status update(News& news) override {
        fmi2EventInfo info{};
        const Status status = as(CALL2(NewDiscreteStates)(c_, &info));
        news = {info.newDiscreteStatesNeeded != 0, info.terminateSimulation != 0, info.valuesOfContinuousStatesChanged != 0};
        if (info.nextEventTimeDefined != 0) news.next = info.nextEventTime;
        return status;
    }
    Status enter_continuous() override { return as(CALL2(EnterContinuousTimeMode)(c_)); }
    Status completed(bool& wants_events, bool& over) override {
        fmi2Boolean a = 0, b = 0;
        const Status status = as(CALL2(CompletedIntegratorStep)(c_, 1, &a, &b));
        wants_events = a != 0, over = b != 0;
        return status;
    }
    Status set_time(double t) override { return as(CALL2(SetTime)(c_, t)); }
    Status set_states(const Vector& x) override { return as(CALL2(SetContinuousStates)(c_, x.data(), x.size())); }
    Status rates(Vector& values) override { return as(CALL2(GetDerivatives)(c_, values.data(), values.size())); }
    Status indicators(Vector& values) override { return as(CALL2(GetEventIndicators)(c_, values.data(), values.size())); }
    Status states(Vector& values) override { return as(CALL2(GetContinuousStates)(c_, values.data(), values.size())); }
    Status directional(const References& unknowns, const References& knowns, const Vector& seed, Vector& result) override {
        result.resize(unknowns.size());
        return as(CALL2(GetDirectionalDerivative)(c_, unknowns.data(), unknowns.size(), knowns.data(), knowns.size(), seed.data(),
                                                  result.data()));
    }
    Status adjoint(const References& unknowns, const References& knowns, const Vector& seed, Vector& result) override {
        // Version 2 has none: by columns.
        result.assign(knowns.size(), 0);
        for (std::size_t j = 0; j < knowns.size(); ++j) {
            Vector column;
            if (const Status status = directional(unknowns, {knowns[j]}, {1}, column); status != ok) return status;
            for (std::size_t i = 0; i < unknowns.size(); ++i) result[j] += column[i] * seed[i];
        }
        return ok;
    }
    Status step(double from, double length, bool& over, double& reached) override {
        const Status status = as(CALL2(DoStep)(c_, from, length, 1));
        fmi2Boolean ended = 0;
        reached = from + length;
        if (status == discard) {
            CALL2(GetBooleanStatus)(c_, fmi2Terminated, &ended);
            CALL2(GetRealStatus)(c_, fmi2LastSuccessfulTime, &reached);
        }
        over = ended != 0;
        return status;
    }
    Status terminate() override { return as(CALL2(Terminate)(c_)); }
    Status reset() override { return as(CALL2(Reset)(c_)); }
    Status save(void*& state) override { return as(CALL2(GetFMUstate)(c_, &state)); }
    Status load(void* state) override { return as(CALL2(SetFMUstate)(c_, state)); }
    Status forget(void*& state) override { return as(CALL2(FreeFMUstate)(c_, &state)); }
    Status serialise(void* state, std::string& bytes) override {
        std::size_t size = 0;
        if (const Status status = as(CALL2(SerializedFMUstateSize)(c_, state, &size)); status != ok) return status;
        bytes.resize(size);
        return as(CALL2(SerializeFMUstate)(c_, state, bytes.data(), size));
    }
    Status deserialise(const std::string& bytes, void*& state) override {
        return as(CALL2(DeSerializeFMUstate)(c_, bytes.data(), bytes.size(), &state));
    }

private:
    static Status as(fmi2Status status) { return static_cast<Status>(status); }
    void* binary_;
    void* c_;
    std::unique_ptr<fmi2CallbackFunctions> functions_;
};

class InstanceOfThree : public Instance {
public:
    InstanceOfThree(void* binary, void* c) : binary_(binary), c_(c) {}
    ~InstanceOfThree() override { CALL3(FreeInstance)(c_); }
    Status setup(double tolerance, double start, double stop) override {
        return as(CALL3(EnterInitializationMode)(c_, tolerance > 0, tolerance, start, stop > start, stop));
    }
    Status end_setup() override { return as(CALL3(ExitInitializationMode)(c_)); }
    Status get(const References& references, Vector& values) override {
        values.resize(references.size());
        return as(CALL3(GetFloat64)(c_, references.data(), references.size(), values.data(), values.size()));
    }
    Status set(const References& references, const Vector& values) override {
        return as(CALL3(SetFloat64)(c_, references.data(), references.size(), values.data(), values.size()));
    }
    long mode(unsigned reference) override {
        fmi3Int64 value = -1;
        return CALL3(GetInt64)(c_, &reference, 1, &value, 1) == fmi3OK ? long(value) : -1;
    }
    Status enter_events() override { return as(CALL3(EnterEventMode)(c_)); }
    Status update(News& news) override {
        bool nominals = false, has_next = false;
        double next = 0;
        const Status status =
            as(CALL3(UpdateDiscreteStates)(c_, &news.again, &news.over, &nominals, &news.states_changed, &has_next, &next));
        news.next = has_next ? next : std::numeric_limits<double>::infinity();
        return status;
    }
    Status enter_continuous() override { return as(CALL3(EnterContinuousTimeMode)(c_)); }
    Status completed(bool& wants_events, bool& over) override { return as(CALL3(CompletedIntegratorStep)(c_, true, &wants_events, &over)); }
    Status set_time(double t) override { return as(CALL3(SetTime)(c_, t)); }
    Status set_states(const Vector& x) override { return as(CALL3(SetContinuousStates)(c_, x.data(), x.size())); }
    Status rates(Vector& values) override { return as(CALL3(GetContinuousStateDerivatives)(c_, values.data(), values.size())); }
    Status indicators(Vector& values) override { return as(CALL3(GetEventIndicators)(c_, values.data(), values.size())); }
    Status states(Vector& values) override { return as(CALL3(GetContinuousStates)(c_, values.data(), values.size())); }
    Status directional(const References& unknowns, const References& knowns, const Vector& seed, Vector& result) override {
        result.resize(unknowns.size());
        return as(CALL3(GetDirectionalDerivative)(c_, unknowns.data(), unknowns.size(), knowns.data(), knowns.size(), seed.data(),
                                                  seed.size(), result.data(), result.size()));
    }
    Status adjoint(const References& unknowns, const References& knowns, const Vector& seed, Vector& result) override {
        result.resize(knowns.size());
        return as(CALL3(GetAdjointDerivative)(c_, unknowns.data(), unknowns.size(), knowns.data(), knowns.size(), seed.data(), seed.size(),
                                              result.data(), result.size()));
    }
    Status step(double from, double length, bool& over, double& reached) override {
        bool events = false, early = false;
        return as(CALL3(DoStep)(c_, from, length, true, &events, &over, &early, &reached));
    }
    Status terminate() override { return as(CALL3(Terminate)(c_)); }
    Status reset() override { return as(CALL3(Reset)(c_)); }
    Status save(void*& state) override { return as(CALL3(GetFMUState)(c_, &state)); }
    Status load(void* state) override { return as(CALL3(SetFMUState)(c_, state)); }
    Status forget(void*& state) override { return as(CALL3(FreeFMUState)(c_, &state)); }
    Status serialise(void* state, std::string& bytes) override {
        std::size_t size = 0;
        if (const Status status = as(CALL3(SerializedFMUStateSize)(c_, state, &size)); status != ok) return status;
        bytes.resize(size);
        return as(CALL3(SerializeFMUState)(c_, state, reinterpret_cast<fmi3Byte*>(bytes.data()), size));
    }
    Status deserialise(const std::string& bytes, void*& state) override {
        return as(CALL3(DeserializeFMUState)(c_, reinterpret_cast<const fmi3Byte*>(bytes.data()), bytes.size(), &state));
    }

private:
    static Status as(fmi3Status status) { return static_cast<Status>(status); }
    void* binary_;
    void* c_;
};

}  // namespace

std::vector<std::string>& messages() {
    static std::vector<std::string> list;
    return list;
}

Unit::Unit(const std::string& path) {
    std::string folder = (fs::temp_directory_path() / "fmuXXXXXX").string();
    if (mkdtemp(folder.data()) == nullptr) fail("no folder to unpack into");
    folder_ = folder;
    description_ = unpack(path, folder_);
    const fs::path library =
        fs::path(folder_) / "binaries" / (description_.version == 2 ? "linux64" : "x86_64-linux") / (description_.identifier + ".so");
    binary_ = dlopen(library.c_str(), RTLD_NOW | RTLD_LOCAL);
    if (binary_ == nullptr) fail(std::string("the binary is not loaded: ") + dlerror());
}

Unit::~Unit() {
    if (binary_ != nullptr) dlclose(binary_);
    std::error_code ignored;
    if (!folder_.empty()) fs::remove_all(folder_, ignored);
}

std::unique_ptr<Instance> Unit::instantiate(bool is_co_simulation, const std::string& name, const std::string& token) const {
    const std::string used = token.empty() ? description_.token : token;
    if (description_.version == 2) {
        auto functions = std::make_unique<fmi2CallbackFunctions>(fmi2CallbackFunctions{log_two, calloc, free, nullptr, nullptr});
        void* const c = CALL2(Instantiate)(name.c_str(), is_co_simulation ? fmi2CoSimulation : fmi2ModelExchange, used.c_str(), "",
                                           functions.get(), 0, 0);
        return c == nullptr ? nullptr : std::make_unique<InstanceOfTwo>(binary_, c, std::move(functions));
    }
    void* const c = is_co_simulation
                        ? CALL3(InstantiateCoSimulation)(name.c_str(), used.c_str(), nullptr, false, false, false, false, nullptr, 0,
                                                         nullptr, log_three, nullptr)
                        : CALL3(InstantiateModelExchange)(name.c_str(), used.c_str(), nullptr, false, false, nullptr, log_three);
    return c == nullptr ? nullptr : std::make_unique<InstanceOfThree>(binary_, c);
}

}  // namespace fmi_test
