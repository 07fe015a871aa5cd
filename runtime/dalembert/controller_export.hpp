// SPDX-License-Identifier: BSL-1.0
// A generated controller as the export of a shared library; see controller.h. It computes in its own numbers, float or double.
#pragma once

#include <array>
#include <cstddef>
#include <new>
#include <tuple>

#include "dalembert/controller.h"
#include "dalembert/exported_quantities.hpp"

namespace dalembert {
inline namespace v1 {
namespace detail {

/// `Of` describes the library: name, and set_parameters(parameters, numbers).
template <class Controller, class Of>
class ControllerTable {
    using Scalar = typename Controller::scalar_type;

    static const Controller& of(const void* self) { return *static_cast<const Controller*>(self); }
    template <class To, class From>
    static void copy(const From& from, To& to, std::size_t count) {
        for (std::size_t i = 0; i < count; ++i) to[i] = static_cast<std::decay_t<decltype(to[i])>>(from[i]);
    }
    template <class Array>
    static constexpr std::size_t size = std::tuple_size<Array>::value;

    static void* create() { return new (std::nothrow) Controller(); }
    static void destroy(void* self) { delete static_cast<Controller*>(self); }
    static void set_parameters(void* self, const double* numbers) {
        auto parameters = of(self).parameters();
        Of::set_parameters(parameters, numbers);
        static_cast<Controller*>(self)->update(parameters);
    }
    static void start_state(const void* self, double* x) { copy(of(self).start_state(), x, size<typename Controller::State>); }
    static void sample(const void* self, const double* u, double* x, double* y) {
        typename Controller::Input measured{};
        typename Controller::State state{};
        typename Controller::Output outputs{};
        copy(u, measured, measured.size());
        copy(x, state, state.size());
        of(self).sample(measured, state, outputs);
        copy(state, x, state.size());
        copy(outputs, y, outputs.size());
    }

public:
    static dalembert_controller make() {
        dalembert_controller table{};
        table.version = DALEMBERT_CONTROLLER_VERSION;
        table.size = sizeof(table);
        table.name = Of::name();
        table.states = size<typename Controller::State>;
        table.inputs = size<typename Controller::Input>;
        table.outputs = size<typename Controller::Output>;
        table.parameters = Controller::parameter_table().size();
        table.state_table = exported_quantities<ControllerTable, 0>(Controller::state_table());
        table.input_table = exported_quantities<ControllerTable, 1>(Controller::input_table());
        table.output_table = exported_quantities<ControllerTable, 2>(Controller::output_table());
        table.parameter_table = exported_quantities<ControllerTable, 3>(Controller::parameter_table());
        table.create = create;
        table.destroy = destroy;
        table.set_parameters = set_parameters;
        table.start_state = start_state;
        table.sample = sample;
        return table;
    }
};

}  // namespace detail
}  // namespace v1
}  // namespace dalembert

/// Defines the exported function of a controller.
#define DALEMBERT_EXPORT_CONTROLLER(Controller, Of)                                                          \
    extern "C" const dalembert_controller* dalembert_controller_table(void) {                                \
        static const dalembert_controller table = dalembert::detail::ControllerTable<Controller, Of>::make(); \
        return &table;                                                                                       \
    }
