// SPDX-License-Identifier: BSL-1.0
// A plant (plant.h) as a system for integration, equilibria and linearisation: the same code as for generated headers, on arrays whose
// sizes are known when the plant is loaded: note [in use] in plant_arrays.hpp.
#pragma once

#include <cstddef>
#include <limits>
#include <memory>
#include <new>
#include <utility>
#include <vector>

#include "dalembert/linear/run_matrix.hpp"
#include "dalembert/plant_arrays.hpp"
#include "dalembert/simulate.hpp"

namespace dalembert {
inline namespace v1 {

/// What a plant is to the code that runs it.
enum class PlantKind {
    free,                   ///< integration needs nothing but the rates
    normed,                 ///< quaternions are brought back to their norm
    constrained,            ///< and the state to constraints
    choosing,               ///< of which the run chooses those that are solved for
    switching,              ///< modes and events
    switching_constrained,  ///< that are brought back to constraints or norms, too
};
inline PlantKind kind_of(const dalembert_plant& plant) {
    if (plant.modes > 0) return plant.is_projected == 0 ? PlantKind::switching : PlantKind::switching_constrained;
    if (plant.is_projected == 0) return PlantKind::free;
    if (plant.constraints == 0) return PlantKind::normed;
    return plant.constraint_rank > 0 ? PlantKind::choosing : PlantKind::constrained;
}

enum class PlantMode : unsigned {};

namespace detail {

template <PlantKind kind>
struct ConstraintTypesOfPlant {};
template <>
struct ConstraintTypesOfPlant<PlantKind::normed> {
    using Constraints = std::array<double, 0>;
    using ConstraintJacobian = std::array<double, 0>;
    static constexpr OfPlant<of_plant::velocity_place> velocity_place{};
};
template <>
struct ConstraintTypesOfPlant<PlantKind::constrained> {
    using Constraints = PlantArray<of_plant::constraints>;
    using ConstraintJacobian = PlantArray<of_plant::constraint_entries>;
    static constexpr OfPlant<of_plant::velocity_place> velocity_place{};
};
template <>
struct ConstraintTypesOfPlant<PlantKind::choosing> : ConstraintTypesOfPlant<PlantKind::constrained> {
    static constexpr OfPlant<of_plant::rank> constraint_rank{};
    static constexpr ListOfPlant<bool, of_plant::can_be_left_out> can_be_left_out{};
    static constexpr ListOfPlant<bool, of_plant::solved_for_at_start> solved_for_at_start{};
};

/// The series of a plant. What integrates has its states one by one, the plant all in one row.
template <class StateAndWork>
void series_of_plant(const dalembert_plant& plant, const void* self, unsigned mode, double t, std::size_t order, StateAndWork* x,
                     double* rows) {
    const std::size_t length = plant.states + 1;
    std::vector<double> all((order + 1) * length);
    std::copy(x[0].begin(), x[0].end(), all.begin());
    plant.series(self, mode, t, order, all.data(), rows);
    for (std::size_t k = 1; k <= order; ++k) std::copy_n(all.begin() + static_cast<std::ptrdiff_t>(k * length), length, x[k].begin());
}

/// What the plant itself says: types, tables, one instance.
class PlantBase {
public:
    using scalar_type = double;
    using State = PlantArray<of_plant::states>;
    using Input = PlantArray<of_plant::inputs>;
    using Output = PlantArray<of_plant::outputs>;
    using Generalised = PlantArray<of_plant::degrees>;
    using SeparableCoordinates = PlantArray<of_plant::separable>;
    using MassMatrix = PlantArray<of_plant::square>;
    using PatternX = PatternXOfPlant;
    using PatternU = PatternUOfPlant;
    using PatternP = PatternPOfPlant;
    using JacobianX = PlantArray<of_plant::entries_x>;
    using JacobianU = PlantArray<of_plant::entries_u>;
    using JacobianP = PlantArray<of_plant::entries_p>;
    using JacobianT = State;
    using OutputJacobianX = PlantArray<of_plant::outputs_by_states>;
    using OutputJacobianU = PlantArray<of_plant::outputs_by_inputs>;
    static constexpr int api = supported_api;
    static constexpr OfPlant<of_plant::degrees> degrees{};
    static constexpr OfPlant<of_plant::series_rows> series_rows{};
    /// The series of a plant are those with the inputs that it was compiled for: of others it has none.
    static bool has_series_in_run() noexcept { return now().series != nullptr && (now().inputs == 0 || now().inputs_of_run != nullptr); }
    static auto state_table() { return TableOfPlant<dalembert_quantity>{now().state_table, now().states}; }
    static auto input_table() { return TableOfPlant<dalembert_quantity>{now().input_table, now().inputs}; }
    static auto output_table() { return TableOfPlant<dalembert_quantity>{now().output_table, now().outputs}; }
    static auto parameter_table() { return TableOfPlant<dalembert_quantity>{now().parameter_table, now().parameters}; }
    static auto guard_table() { return TableOfPlant<dalembert_guard>{now().guard_table, now().guards}; }
    static auto constraint_table() { return TableOfPlant<dalembert_constraint>{now().constraint_table, now().constraints}; }
    static auto mode_table() { return TableOfPlant<const char*>{now().mode_names, now().modes}; }
    static auto event_table() { return TableOfPlant<const char*>{now().event_names, now().events}; }

    /// Of the plant in use, with these parameters in SI, in the order of its table. Behind them there may stand a delay in s for each
    /// input, by which the machine gets it later where it was measured: see SampledInput.
    explicit PlantBase(std::vector<double> parameters) : parameters_(std::move(parameters)), self_(make(parameters_)) {}
    PlantBase(const PlantBase& other) : parameters_(other.parameters_), self_(make(parameters_)), none_(other.none_) {}
    PlantBase& operator=(const PlantBase&) = delete;

    const std::vector<double>& parameters() const { return parameters_; }
    void update(const std::vector<double>& parameters) {
        parameters_ = parameters;
        now().set_parameters(self_.get(), parameters_.data());
    }
    double delay(std::size_t input) const {
        const std::size_t number = now().parameters + input;
        return number < parameters_.size() ? parameters_[number] : 0;
    }
    const void* self() const { return self_.get(); }
    /// Outputs and energies that nobody asks for are NaN from now on: they take as long as rates.
    void leave_out(bool outputs, bool energies) { none_ = {outputs, energies}; }
    State start_state() const {
        State x;
        now().start_state(self(), x.data());
        return x;
    }

protected:
    using Power = double (*)(const void*, unsigned, const double*, const double*, double);
    static const dalembert_plant& now() noexcept { return *plant_in_use; }
    void output(unsigned mode, const State& x, const Input& u, double t, Output& y) const {
        if (none_.outputs)
            y.fill(std::numeric_limits<double>::quiet_NaN());
        else if (now().output != nullptr)
            now().output(self(), mode, x.data(), u.data(), t, y.data());
    }
    using Energy = double (*)(const void*, unsigned, const double*, double);
    /// In J; what a plant does not have is zero.
    double energy(Energy of, unsigned mode, const State& x, double t) const {
        if (none_.energies) return std::numeric_limits<double>::quiet_NaN();
        return of != nullptr ? of(self(), mode, x.data(), t) : 0;
    }
    /// In W; what a plant does not have is zero.
    double power(Power of, unsigned mode, const double* x, const double* u, double t) const {
        return of != nullptr ? of(self(), mode, x, u, t) : 0;
    }
    /// The rates with the power behind them, of a state that the work may follow. u may be null where the plant has a function for both and
    /// inputs of the run.
    void rates_and_power(unsigned mode, const double* x, const double* u, double t, double* rates) const {
        if (now().rates_and_power != nullptr) return now().rates_and_power(self(), mode, x, u, t, rates);
        now().rhs(self(), mode, x, u, t, rates);
        rates[now().states] = power(now().supplied_power, mode, x, u, t) - power(now().dissipated_power, mode, x, u, t) +
                              power(now().prescribed_power, mode, x, u, t) + power(now().exchanged_power, mode, x, u, t);
    }
    void solve_for_all(const int* chosen) { now().solve_for(self_.get(), chosen); }

private:
    using Instance = std::unique_ptr<void, void (*)(void*)>;
    static Instance make(const std::vector<double>& parameters) {
        Instance self(now().create(), now().destroy);
        if (self == nullptr) throw std::bad_alloc();
        now().set_parameters(self.get(), parameters.data());
        return self;
    }
    std::vector<double> parameters_;
    Instance self_;
    struct LeftOut {
        bool outputs = false, energies = false;
    } none_;
};

}  // namespace detail

/// A plant without modes, or one seen in one of its modes.
template <PlantKind kind>
class PlantSystem : public detail::PlantBase, public detail::ConstraintTypesOfPlant<kind> {
public:
    using Guards = detail::PlantArray<detail::of_plant::guards>;
    static constexpr bool is_separable = kind == PlantKind::free;

    explicit PlantSystem(std::vector<double> parameters, unsigned mode = 0) : PlantBase(std::move(parameters)), mode_(mode) {}

    void rhs(const State& x, const Input& u, double t, State& dxdt) const { now().rhs(self(), mode_, x.data(), u.data(), t, dxdt.data()); }
    void rhs_and_jacobian(const State& x, const Input& u, double t, State& dxdt, JacobianX& J) const {
        now().rhs_and_jacobian(self(), mode_, x.data(), u.data(), t, dxdt.data(), J.data());
    }
    void jacobian_x(const State& x, const Input& u, double t, JacobianX& J) const {
        State dxdt;
        rhs_and_jacobian(x, u, t, dxdt, J);
    }
    /// Of plants that have it.
    void jacobian_p(const State& x, const Input& u, double t, JacobianP& J) const {
        now().jacobian_p(self(), mode_, x.data(), u.data(), t, J.data());
    }
    void jacobian_u(const State& x, const Input& u, double t, JacobianU& J) const {
        if (now().jacobian_u != nullptr) now().jacobian_u(self(), mode_, x.data(), u.data(), t, J.data());
    }
    void jacobian_t(const State& x, const Input& u, double t, JacobianT& dfdt) const {
        if (now().jacobian_t != nullptr)
            now().jacobian_t(self(), mode_, x.data(), u.data(), t, dfdt.data());
        else
            dfdt.fill(0);
    }
    void output(const State& x, const Input& u, double t, Output& y) const { PlantBase::output(mode_, x, u, t, y); }
    void output_jacobian_x(const State& x, const Input& u, double t, OutputJacobianX& C) const {
        if (now().output_jacobian_x != nullptr) now().output_jacobian_x(self(), mode_, x.data(), u.data(), t, C.data());
    }
    void output_jacobian_u(const State& x, const Input& u, double t, OutputJacobianU& D) const {
        if (now().output_jacobian_u != nullptr) now().output_jacobian_u(self(), mode_, x.data(), u.data(), t, D.data());
    }
    void mass_matrix(const State& x, double t, MassMatrix& M) const { now().mass_matrix(self(), mode_, x.data(), t, M.data()); }
    double kinetic_energy(const State& x, double t) const { return energy(now().kinetic_energy, mode_, x, t); }
    double potential_energy(const State& x, double t) const { return energy(now().potential_energy, mode_, x, t); }
    double internal_energy(const State& x, double t) const { return energy(now().internal_energy, mode_, x, t); }
    void rates_and_power(const double* x, const double* u, double t, double* rates) const {
        PlantBase::rates_and_power(mode_, x, u, t, rates);
    }
    double supplied_power(const State& x, const Input& u, double t) const { return power(now().supplied_power, x, u, t); }
    double dissipated_power(const State& x, const Input& u, double t) const { return power(now().dissipated_power, x, u, t); }
    double prescribed_power(const State& x, const Input& u, double t) const { return power(now().prescribed_power, x, u, t); }
    double exchanged_power(const State& x, const Input& u, double t) const { return power(now().exchanged_power, x, u, t); }
    void guards(const State& x, const Input& u, double t, Guards& g) const {
        if (now().guard_values != nullptr) now().guard_values(self(), mode_, x.data(), u.data(), t, g.data());
    }
    template <class Values>
    void constraint_positions(const State& x, double t, Values& f) const {
        now().constraint_positions(self(), mode_, x.data(), t, f.data());
    }
    template <class Values>
    void constraint_rates(const State& x, double t, Values& w) const {
        now().constraint_rates(self(), mode_, x.data(), t, w.data());
    }
    template <class Values>
    void constraint_jacobian(const State& x, double t, Values& A) const {
        now().constraint_jacobian(self(), mode_, x.data(), t, A.data());
    }
    template <class Values>
    void correction(const State& x, double t, const Values& residual, Generalised& step) const {
        now().correction(self(), mode_, x.data(), t, residual.data(), step.data());
    }
    void move_back(State& x, const Generalised& step) const { now().move_back(self(), x.data(), step.data()); }
    template <class Flags>
    void solve_for(const Flags& chosen) {
        const std::vector<int> flags(chosen.begin(), chosen.end());
        solve_for_all(flags.data());
    }
    /// With the inputs that the plant was compiled for.
    template <class Inputs, class StateAndWork>
    void series(const Inputs&, double t, std::size_t order, StateAndWork* x, double* rows) const {
        detail::series_of_plant(now(), self(), mode_, t, order, x, rows);
    }

private:
    double power(Power of, const State& x, const Input& u, double t) const { return PlantBase::power(of, mode_, x.data(), u.data(), t); }
    unsigned mode_;
};

/// A plant that switches.
template <>
class PlantSystem<PlantKind::switching> : public detail::PlantBase {
public:
    using Mode = PlantMode;
    using Events = detail::PlantArray<detail::of_plant::events>;
    using Kinks = detail::PlantArray<detail::of_plant::kinks>;
    using Modes = std::vector<Mode>;

    explicit PlantSystem(std::vector<double> parameters) : PlantBase(std::move(parameters)) {}

    static bool is_watched(Mode mode, std::size_t event) { return now().is_watched(static_cast<unsigned>(mode), event) != 0; }
    static bool happens_at_once(std::size_t event) { return now().happens_at_once != nullptr && now().happens_at_once(event) != 0; }
    static bool happens_at_start(std::size_t event) { return now().happens_at_start != nullptr && now().happens_at_start(event) != 0; }
    static Modes next_modes(std::size_t event, Mode mode) { return transitions(event, mode, dalembert_next); }
    static Modes modes_beside(std::size_t event, Mode mode) { return transitions(event, mode, dalembert_beside); }
    static Modes after_accumulation(std::size_t event, Mode mode) { return transitions(event, mode, dalembert_after_accumulation); }

    void rhs(Mode mode, const State& x, const Input& u, double t, State& dxdt) const {
        now().rhs(self(), number(mode), x.data(), u.data(), t, dxdt.data());
    }
    void rhs_and_jacobian(Mode mode, const State& x, const Input& u, double t, State& dxdt, JacobianX& J) const {
        now().rhs_and_jacobian(self(), number(mode), x.data(), u.data(), t, dxdt.data(), J.data());
    }
    void jacobian_x(Mode mode, const State& x, const Input& u, double t, JacobianX& J) const {
        State dxdt;
        rhs_and_jacobian(mode, x, u, t, dxdt, J);
    }
    /// Of plants that have it.
    void jacobian_p(Mode mode, const State& x, const Input& u, double t, JacobianP& J) const {
        now().jacobian_p(self(), number(mode), x.data(), u.data(), t, J.data());
    }
    void jacobian_u(Mode mode, const State& x, const Input& u, double t, JacobianU& J) const {
        if (now().jacobian_u != nullptr) now().jacobian_u(self(), number(mode), x.data(), u.data(), t, J.data());
    }
    void jacobian_t(Mode mode, const State& x, const Input& u, double t, JacobianT& dfdt) const {
        if (now().jacobian_t != nullptr)
            now().jacobian_t(self(), number(mode), x.data(), u.data(), t, dfdt.data());
        else
            dfdt.fill(0);
    }
    void output(Mode mode, const State& x, const Input& u, double t, Output& y) const { PlantBase::output(number(mode), x, u, t, y); }
    double kinetic_energy(Mode mode, const State& x, double t) const { return energy(now().kinetic_energy, number(mode), x, t); }
    double potential_energy(Mode mode, const State& x, double t) const { return energy(now().potential_energy, number(mode), x, t); }
    double internal_energy(Mode mode, const State& x, double t) const { return energy(now().internal_energy, number(mode), x, t); }
    void rates_and_power(Mode mode, const double* x, const double* u, double t, double* rates) const {
        PlantBase::rates_and_power(number(mode), x, u, t, rates);
    }
    double supplied_power(Mode mode, const State& x, const Input& u, double t) const { return power(now().supplied_power, mode, x, u, t); }
    double dissipated_power(Mode mode, const State& x, const Input& u, double t) const {
        return power(now().dissipated_power, mode, x, u, t);
    }
    double prescribed_power(Mode mode, const State& x, const Input& u, double t) const {
        return power(now().prescribed_power, mode, x, u, t);
    }
    double exchanged_power(Mode mode, const State& x, const Input& u, double t) const {
        return power(now().exchanged_power, mode, x, u, t);
    }
    void guards(Mode mode, const State& x, const Input& u, double t, Events& g) const {
        now().guard_values(self(), number(mode), x.data(), u.data(), t, g.data());
    }
    void guard_rates(Mode mode, const State& x, const Input& u, double t, Events& rates) const {
        now().guard_rates(self(), number(mode), x.data(), u.data(), t, rates.data());
    }
    void kinks(Mode mode, const State& x, const Input& u, double t, Kinks& k) const {
        if (now().kink_values != nullptr) now().kink_values(self(), number(mode), x.data(), u.data(), t, k.data());
    }
    bool holds(Mode mode, const State& x, const Input& u, double t) const {
        return now().holds == nullptr || now().holds(self(), number(mode), x.data(), u.data(), t) != 0;
    }
    void reset(std::size_t event, Mode mode, State& x, const Input& u, double t) const {
        now().reset(self(), event, number(mode), x.data(), u.data(), t);
    }
    void settle(std::size_t event, Mode mode, State& x, const Input& u, double t) const {
        now().settle(self(), event, number(mode), x.data(), u.data(), t);
    }
    template <class Inputs, class StateAndWork>
    void series(Mode mode, const Inputs&, double t, std::size_t order, StateAndWork* x, double* rows) const {
        detail::series_of_plant(now(), self(), number(mode), t, order, x, rows);
    }

protected:
    static unsigned number(Mode mode) { return static_cast<unsigned>(mode); }
private:
    static Modes transitions(std::size_t event, Mode mode, dalembert_transition kind) {
        std::vector<unsigned> numbers(now().most_transitions);
        numbers.resize(now().transitions(event, number(mode), kind, numbers.data()));
        Modes modes;
        for (const unsigned each : numbers) modes.push_back(static_cast<Mode>(each));
        return modes;
    }
    double power(Power of, Mode mode, const State& x, const Input& u, double t) const {
        return PlantBase::power(of, number(mode), x.data(), u.data(), t);
    }
};

/// The same with constraints, or norms alone, in each mode.
template <>
class PlantSystem<PlantKind::switching_constrained> : public PlantSystem<PlantKind::switching>,
                                                      public detail::ConstraintTypesOfPlant<PlantKind::constrained> {
public:
    using PlantSystem<PlantKind::switching>::PlantSystem;

    template <class Values>
    void constraint_positions(Mode mode, const State& x, double t, Values& f) const {
        now().constraint_positions(self(), number(mode), x.data(), t, f.data());
    }
    template <class Values>
    void constraint_rates(Mode mode, const State& x, double t, Values& w) const {
        now().constraint_rates(self(), number(mode), x.data(), t, w.data());
    }
    template <class Values>
    void constraint_jacobian(Mode mode, const State& x, double t, Values& A) const {
        now().constraint_jacobian(self(), number(mode), x.data(), t, A.data());
    }
    template <class Values>
    void correction(Mode mode, const State& x, double t, const Values& residual, Generalised& step) const {
        now().correction(self(), number(mode), x.data(), t, residual.data(), step.data());
    }
    void move_back(State& x, const Generalised& step) const { now().move_back(self(), x.data(), step.data()); }
};

}  // namespace v1
}  // namespace dalembert
