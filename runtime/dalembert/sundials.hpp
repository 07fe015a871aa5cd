// SPDX-License-Identifier: BSL-1.0
// The same problems integrated by SUNDIALS (6.x: CVODE and ARKODE), for comparison, and for users who already have it. No other header
// includes this one. Link sundials_cvode, sundials_arkode and sundials_nvecserial, on Debian from libsundials-dev.
#pragma once

#include <arkode/arkode_arkstep.h>
#include <arkode/arkode_erkstep.h>
#include <cvode/cvode.h>
#include <nvector/nvector_serial.h>
#include <sundials/sundials_version.h>
#include <sunlinsol/sunlinsol_band.h>
#include <sunlinsol/sunlinsol_dense.h>
#include <sunmatrix/sunmatrix_band.h>
#include <sunmatrix/sunmatrix_dense.h>
#include <sunnonlinsol/sunnonlinsol_fixedpoint.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <type_traits>

#include "dalembert/integration_options.hpp"
#include "dalembert/linear/jacobian_pattern.hpp"
#include "dalembert/methods/step_control.hpp"
#include "dalembert/methods/stepper.hpp"
#include "dalembert/status.hpp"
#include "dalembert/system_derivatives.hpp"

namespace dalembert {
inline namespace v1 {

enum class SundialsMethod {
    bdf,    ///< CVODE, backward differentiation formulas of orders 1 to 5, Newton's method with the Jacobian
    adams,  ///< CVODE, Adams-Moulton formulas of orders 1 to 12, functional iteration
    erk5,   ///< ARKODE, explicit: Dormand-Prince 5(4)
    erk6,   ///< ARKODE, explicit: Verner 6(5)
    erk8,   ///< ARKODE, explicit: Fehlberg 8(7)
    dirk4,  ///< ARKODE, diagonally implicit, L-stable: QESDIRK 4(3) with 6 stages, with the Jacobian; its default, SDIRK 4(3), takes many
            ///< times the steps where it is stiff
    dirk5,  ///< ARKODE, diagonally implicit, L-stable: ESDIRK 5(4) with 7 stages, with the Jacobian; its default, ARK5(4)8L[2]SA, loses the
            ///< motion of an undamped oscillator
};

namespace detail {

/// What a run owns; everything is freed with it.
struct SundialsHandles {
    SUNContext context = nullptr;
    N_Vector x = nullptr, tolerances = nullptr;
    SUNMatrix matrix = nullptr;
    SUNLinearSolver linear = nullptr;
    SUNNonlinearSolver nonlinear = nullptr;
    void* cvode = nullptr;
    void* erk = nullptr;
    void* ark = nullptr;

    SundialsHandles() = default;
    SundialsHandles(const SundialsHandles&) = delete;
    SundialsHandles& operator=(const SundialsHandles&) = delete;
    ~SundialsHandles() {
        if (cvode != nullptr) CVodeFree(&cvode);
        if (erk != nullptr) ERKStepFree(&erk);
        if (ark != nullptr) ARKStepFree(&ark);
        if (nonlinear != nullptr) SUNNonlinSolFree(nonlinear);
        if (linear != nullptr) SUNLinSolFree(linear);
        if (matrix != nullptr) SUNMatDestroy(matrix);
        if (tolerances != nullptr) N_VDestroy(tolerances);
        if (x != nullptr) N_VDestroy(x);
        if (context != nullptr) SUNContext_Free(&context);
    }
};

/// Errors are returned in Outcome; nothing is printed.
inline void say_nothing_of_sundials(int, const char*, const char*, char*, void*) {}

/// CVODE and ARKODE number these alike.
inline Status status_of_sundials(int flag) noexcept {
    switch (flag) {
        case CV_TOO_MUCH_WORK:
            return Status::too_many_steps;
        case CV_TOO_MUCH_ACC:
        case CV_ERR_FAILURE:
            return Status::step_too_small;
        case CV_CONV_FAILURE:
        case CV_LSETUP_FAIL:
        case CV_LSOLVE_FAIL:
            return Status::not_converged;
        case CV_RHSFUNC_FAIL:
        case CV_FIRST_RHSFUNC_ERR:
        case CV_REPTD_RHSFUNC_ERR:
        case CV_UNREC_RHSFUNC_ERR:
            return Status::not_finite;
        default:
            return flag >= 0 ? Status::success : Status::bad_options;
    }
}

template <class State, class Rhs, class Derivatives>
class SundialsRun : SundialsHandles {
    static_assert(std::is_same<typename State::value_type, realtype>::value, "SUNDIALS computes in one arithmetic, as a rule double");
    static constexpr std::size_t n = std::tuple_size<State>::value;
    static_assert(size_of<typename Derivatives::DifferentiatedState>() == n, "all states are integrated by the same formulas");
    using Matrix = SquareMatrix<realtype, typename Derivatives::Pattern, n>;

public:
    SundialsRun(SundialsMethod method, Rhs& rhs, Derivatives& derivatives, State& start, realtype from, realtype to,
                const IntegrationOptions<State>& options)
        : method_(method), rhs_(rhs), derivatives_(derivatives), start_(start), from_(from), to_(to), options_(options) {}

    template <class Observer>
    Outcome go(Observer& observe) {
        const StepControl<State> control(options_, from_, to_);
        Outcome outcome;
        outcome.t = static_cast<double>(from_);
        outcome.status = control.are_options_good() && !options_.has_fixed_steps() && prepare() ? Status::success : Status::bad_options;
        if (outcome.status != Status::success) return outcome;
        State at = start_;
        observe(from_, at);
        auto kink = control.next_kink(from_);
        if (to_ > from_ && !stop_at(kink.before)) outcome.status = Status::bad_options;
        Outcome before_kink;
        for (std::size_t i = 1; to_ > from_ && outcome.status == Status::success && i <= options_.output_count(); ++i) {
            realtype t = from_;
            culprit_ = n;
            const realtype target = control.output_time(i);
            const auto go_to = [&](realtype end) {
                const std::size_t taken = outcome.steps + outcome.rejected;
                const int flag = taken < options_.max_steps
                                     ? advance(end, t, static_cast<long>(std::min(options_.max_steps - taken, std::size_t(1000000000))))
                                     : CV_TOO_MUCH_WORK;
                count(outcome, before_kink);
                return flag;
            };
            int flag = CV_SUCCESS;
            while (flag >= 0 && kink.before < target && kink.before < to_) {
                flag = go_to(kink.before);
                if (flag < 0) break;
                before_kink = outcome;
                t = kink.behind;
                kink = control.next_kink(t);
                flag = restart(t) && stop_at(kink.before) ? CV_SUCCESS : CV_ILL_INPUT;
            }
            if (flag >= 0 && t < target) flag = go_to(target);
            std::copy_n(N_VGetArrayPointer(x), n, at.begin());
            outcome.status = status_of_sundials(flag);
            outcome.t = flag >= 0 ? target : t;
            if (outcome.status == Status::success && !are_finite(at, at)) outcome.status = Status::not_finite;
            if (outcome.status != Status::success && outcome.status != Status::too_many_steps && culprit_ != n)
                outcome.status = Status::not_finite;  // whatever it led to
            if (outcome.status == Status::not_finite) outcome.state = culprit_;
            if (outcome.status != Status::success) break;
            observe(target, at);
            start_ = at;
        }
        return outcome;
    }

private:
    bool is_implicit() const {
        return method_ == SundialsMethod::bdf || method_ == SundialsMethod::dirk4 || method_ == SundialsMethod::dirk5;
    }

    bool prepare() {
        if (SUNContext_Create(nullptr, &context) != 0) return false;
        x = N_VNew_Serial(static_cast<sunindextype>(n), context);
        tolerances = x != nullptr ? N_VClone(x) : nullptr;
        if (tolerances == nullptr) return false;
        std::copy_n(start_.begin(), n, N_VGetArrayPointer(x));
        for (std::size_t i = 0; i < n; ++i) N_VGetArrayPointer(tolerances)[i] = options_.tolerance * options_.scale[i];
        if (is_implicit() && !prepare_matrix()) return false;
        switch (method_) {
            case SundialsMethod::bdf:
                return prepare_cvode(CV_BDF);
            case SundialsMethod::adams:
                return prepare_cvode(CV_ADAMS);
            case SundialsMethod::erk5:
                return prepare_erk(ARKODE_DORMAND_PRINCE_7_4_5);
            case SundialsMethod::erk6:
                return prepare_erk(ARKODE_VERNER_8_5_6);
            case SundialsMethod::erk8:
                return prepare_erk(ARKODE_FEHLBERG_13_7_8);
            case SundialsMethod::dirk4:
                return prepare_ark(ARKODE_QESDIRK436L2SA_6_3_4);
            case SundialsMethod::dirk5:
                return prepare_ark(ARKODE_ESDIRK547L2SA_7_4_5);
        }
        return false;
    }

    bool prepare_matrix() {
        constexpr auto size = static_cast<sunindextype>(n);
        if constexpr (Matrix::is_band) {
            matrix =
                SUNBandMatrix(size, static_cast<sunindextype>(Matrix::band.upper), static_cast<sunindextype>(Matrix::band.lower), context);
            linear = matrix != nullptr ? SUNLinSol_Band(x, matrix, context) : nullptr;
        } else {
            matrix = SUNDenseMatrix(size, size, context);
            linear = matrix != nullptr ? SUNLinSol_Dense(x, matrix, context) : nullptr;
        }
        return linear != nullptr;
    }

    bool prepare_cvode(int formulas) {
        cvode = CVodeCreate(formulas, context);
        if (cvode == nullptr || CVodeSetErrHandlerFn(cvode, say_nothing_of_sundials, nullptr) != 0) return false;
        if (CVodeInit(cvode, rhs, from_, x) != 0 || CVodeSVtolerances(cvode, options_.tolerance, tolerances) != 0 ||
            CVodeSetUserData(cvode, this) != 0)
            return false;
        if (formulas == CV_BDF) {
            if (CVodeSetLinearSolver(cvode, linear, matrix) != 0 || CVodeSetJacFn(cvode, jacobian) != 0) return false;
        } else {
            nonlinear = SUNNonlinSol_FixedPoint(x, 0, context);
            if (nonlinear == nullptr || CVodeSetNonlinearSolver(cvode, nonlinear) != 0) return false;
        }
        return CVodeSetInitStep(cvode, options_.step) == 0 && CVodeSetMaxStep(cvode, options_.max_step) == 0 &&
               CVodeSetMinStep(cvode, least_) == 0;
    }

    bool prepare_erk(ARKODE_ERKTableID table) {
        erk = ERKStepCreate(rhs, from_, x, context);
        if (erk == nullptr || ERKStepSetErrHandlerFn(erk, say_nothing_of_sundials, nullptr) != 0) return false;
        return ERKStepSVtolerances(erk, options_.tolerance, tolerances) == 0 && ERKStepSetUserData(erk, this) == 0 &&
               ERKStepSetTableNum(erk, table) == 0 && ERKStepSetInitStep(erk, options_.step) == 0 &&
               ERKStepSetMaxStep(erk, options_.max_step) == 0 && ERKStepSetMinStep(erk, least_) == 0;
    }

    bool prepare_ark(ARKODE_DIRKTableID table) {
        ark = ARKStepCreate(nullptr, rhs, from_, x, context);
        if (ark == nullptr || ARKStepSetErrHandlerFn(ark, say_nothing_of_sundials, nullptr) != 0) return false;
        // Polynomials through derivatives would carry errors of fast parts into the outputs.
        return ARKStepSetInterpolantType(ark, ARK_INTERP_LAGRANGE) == 0 && ARKStepSVtolerances(ark, options_.tolerance, tolerances) == 0 &&
               ARKStepSetUserData(ark, this) == 0 && ARKStepSetTableNum(ark, table, ARKODE_ERK_NONE) == 0 &&
               ARKStepSetLinearSolver(ark, linear, matrix) == 0 && ARKStepSetJacFn(ark, jacobian) == 0 &&
               ARKStepSetInitStep(ark, options_.step) == 0 && ARKStepSetMaxStep(ark, options_.max_step) == 0 &&
               ARKStepSetMinStep(ark, least_) == 0;
    }

    /// Up to an output point, by the dense output of the formulas.
    int advance(realtype target, realtype& t, long most_steps) {
        if (cvode != nullptr) return CVodeSetMaxNumSteps(cvode, most_steps) == 0 ? CVode(cvode, target, x, &t, CV_NORMAL) : CV_ILL_INPUT;
        if (erk != nullptr)
            return ERKStepSetMaxNumSteps(erk, most_steps) == 0 ? ERKStepEvolve(erk, target, x, &t, ARK_NORMAL) : ARK_ILL_INPUT;
        return ARKStepSetMaxNumSteps(ark, most_steps) == 0 ? ARKStepEvolve(ark, target, x, &t, ARK_NORMAL) : ARK_ILL_INPUT;
    }

    /// Anew from where x is now. Formulas that remember several steps begin with the first order.
    bool restart(realtype t) {
        if (cvode != nullptr) return CVodeReInit(cvode, t, x) == 0;
        if (erk != nullptr) return ERKStepReInit(erk, rhs, t, x) == 0;
        return ARKStepReInit(ark, nullptr, rhs, t, x) == 0;
    }
    /// No step reaches beyond it.
    bool stop_at(realtype t) {
        if (cvode != nullptr) return CVodeSetStopTime(cvode, t) == 0;
        if (erk != nullptr) return ERKStepSetStopTime(erk, t) == 0;
        return ARKStepSetStopTime(ark, t) == 0;
    }

    /// Counts begin anew behind kinks.
    void count(Outcome& outcome, const Outcome& before) const {
        long steps = 0, errors = 0, calls = 0, implicit_calls = 0;
        if (cvode != nullptr) CVodeGetNumSteps(cvode, &steps), CVodeGetNumErrTestFails(cvode, &errors), CVodeGetNumRhsEvals(cvode, &calls);
        if (erk != nullptr) ERKStepGetNumSteps(erk, &steps), ERKStepGetNumErrTestFails(erk, &errors), ERKStepGetNumRhsEvals(erk, &calls);
        if (ark != nullptr)
            ARKStepGetNumSteps(ark, &steps), ARKStepGetNumErrTestFails(ark, &errors), ARKStepGetNumRhsEvals(ark, &calls, &implicit_calls);
        outcome.steps = before.steps + static_cast<std::size_t>(steps);
        outcome.rejected = before.rejected + static_cast<std::size_t>(errors);
        outcome.rhs_calls = before.rhs_calls + static_cast<std::size_t>(calls + implicit_calls);
    }

    static State state_of(N_Vector vector) {
        State state;
        std::copy_n(N_VGetArrayPointer(vector), n, state.begin());
        return state;
    }

    /// What is not finite may be so because the step was too long.
    static int rhs(realtype t, N_Vector x, N_Vector dxdt, void* data) {
        auto& run = *static_cast<SundialsRun*>(data);
        State rate;
        run.rhs_(state_of(x), t, rate);
        std::copy_n(rate.begin(), n, N_VGetArrayPointer(dxdt));
        const std::size_t culprit = first_not_finite(rate);
        if (culprit == n) return 0;
        run.culprit_ = culprit;
        return 1;
    }

    /// The matrix is zero before.
    static int jacobian(realtype t, N_Vector x, N_Vector, SUNMatrix J, void* data, N_Vector, N_Vector, N_Vector) {
        auto& run = *static_cast<SundialsRun*>(data);
        run.derivatives_.prepare(state_of(x), t);
        run.derivatives_.for_each_entry([J](std::size_t row, std::size_t column, realtype value) {
            if constexpr (Matrix::is_band) {
                if (row <= column + Matrix::band.lower && column <= row + Matrix::band.upper)
                    SUNBandMatrix_Column(
                        J, static_cast<sunindextype>(column))[static_cast<std::ptrdiff_t>(row) - static_cast<std::ptrdiff_t>(column)] +=
                        value;
            } else {
                SUNDenseMatrix_Column(J, static_cast<sunindextype>(column))[row] += value;
            }
        });
        return 0;
    }

    SundialsMethod method_;
    Rhs& rhs_;
    Derivatives& derivatives_;
    State& start_;
    realtype from_, to_;
    const IntegrationOptions<State>& options_;
    realtype least_ =
        StepControl<State>(options_, from_, to_).smallest(to_);  ///< s; shorter steps make no progress, however many there are
    std::size_t culprit_ = n;                                    ///< the state whose derivative was not finite last
};

}  // namespace detail

/// As `integrate` without guards. SUNDIALS takes rhs(x, t, dxdt), derivatives as for Method::rodas5p, and of the options the tolerance
/// with its scales (of state i the allowed error is tolerance (|x_i| + scale_i), in the mean square of all states), output points, the
/// first and the longest step, and the number of steps. Afterwards `x` is the state at the last output point that was reached. After a
/// failure, the time of the outcome is that of the failed step, or of a stage of it. No step reaches beyond `to` or across a kink of the
/// options.
template <class State, class Rhs, class Derivatives, class Observer>
Outcome integrate_with_sundials(SundialsMethod method, Rhs&& rhs, Derivatives&& derivatives, State& x, typename State::value_type from,
                                typename State::value_type to, const IntegrationOptions<State>& options, Observer&& observe) {
    return detail::SundialsRun<State, std::remove_reference_t<Rhs>, std::remove_reference_t<Derivatives>>(method, rhs, derivatives, x, from,
                                                                                                          to, options)
        .go(observe);
}

/// A generated system with inputs(x, t), without guards and constraints: use `simulate` for a run that passes an event of the model, or
/// that needs its constraints.
template <class System, class Inputs, class Observer>
Outcome simulate_with_sundials(SundialsMethod method, const System& system, const Inputs& inputs, typename System::State& x,
                               typename System::scalar_type from, typename System::scalar_type to,
                               const IntegrationOptions<typename System::State>& options, Observer&& observe) {
    using State = typename System::State;
    const auto rhs = [&](const State& at, realtype t, State& dxdt) { system.rhs(at, inputs(at, t), t, dxdt); };
    detail::SystemDerivatives<System, Inputs> derivatives(system, inputs, options.scale);
    return integrate_with_sundials(method, rhs, derivatives, x, from, to, options, observe);
}

}  // namespace v1
}  // namespace dalembert
