// SPDX-License-Identifier: GPL-3.0-or-later
#include "emit/plant.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "elements/bodies.hpp"
#include "emit/cpp_bodies.hpp"
#include "emit/header_equations.hpp"
#include "emit/mode_code.hpp"
#include "emit/notation.hpp"
#include "emit/plant_tables.hpp"
#include "prove/constraint_validity.hpp"

namespace dalembert {

namespace {

using Result = PlantFunction::Result;

constexpr std::size_t longest_equations = 8000;  ///< characters; more of them drown the code

std::size_t length_of(const std::vector<std::string>& lines) {
    std::size_t length = 0;
    for (const std::string& line : lines) length += line.size();
    return length;
}

class PlantMaker {
    template <class Make>
    auto each(const Make& make) {
        std::vector<decltype(make(bodies_.front()))> result;
        for (CppBodies& bodies : bodies_) result.push_back(make(bodies));
        return result;
    }

public:
    explicit PlantMaker(const std::vector<const Code*>& modes)
        : modes_(modes),
          shared_(modes),
          code_(*modes.front()),
          system_(code_.system),
          switches_(shared_.has_modes()),
          equations_(header_equations(modes)) {
        for (const Code* code : modes_) bodies_.emplace_back(*code, shared_);
    }

    Plant run() {
        set_tables(plant_, modes_, shared_, switches_ ? kinks() : system_.guards);
        parameters();
        motion();
        outputs();
        energies();
        if (switches_) switching();
        else
            add(Function::guards, "Functions whose sign matters, in the order of guard_table().",
                each([](CppBodies& b) { return b.values(Function::guards, "Guards", "g"); }));
        constraints();
        for (auto* functions : {&plant_.functions, &plant_.constraint_functions})
            for (PlantFunction& f : *functions) f.is_large = f.is_large || length_of(f.equations) > longest_equations;
        for (const CppBodies& bodies : bodies_) plant_.helpers.insert(bodies.helpers().begin(), bodies.helpers().end());
        return std::move(plant_);
    }

private:
    template <class Body>
    Body merged(std::vector<Body> bodies) const { return switches_ ? by_mode(system_.scene, bodies) : std::move(bodies.front()); }

    PlantFunction& add(Function function, std::string doc, std::vector<FunctionBody> bodies, const char* name = nullptr) {
        PlantFunction& f = plant_.functions.emplace_back();
        f = made(function, std::move(doc), std::move(bodies), name);
        return f;
    }

    PlantFunction made(Function function, std::string doc, std::vector<FunctionBody> bodies, const char* name = nullptr) {
        PlantFunction f;
        f.name = name != nullptr ? name : name_of(function);
        f.doc = {std::move(doc)};
        f.operations = count_text(function);
        const auto equations = equations_.find(function);
        if (equations != equations_.end()) f.equations = equations->second;
        f.body = merged(std::move(bodies));
        return f;
    }

    /// One whose equations are left out where there are too many coordinates.
    void add_large(Function function, std::string doc, std::vector<FunctionBody> bodies, Result result = Result::none) {
        PlantFunction& f = add(function, std::move(doc), std::move(bodies));
        f.is_large = !equations_.contains(function);
        f.result = result;
    }

    void parameters() {
        std::set<std::string> done;
        const std::vector<FunctionBody> updates = each([&](CppBodies& b) { return b.update(done); });
        if (updates.size() == 1) plant_.update = updates.front();
        for (const FunctionBody& one : updates)
            if (updates.size() > 1 && !one.statements.empty()) plant_.update.statements.push_back(Braces{one.statements});
        plant_.update_operations = count_text(Function::update);
        plant_.start_state = bodies_.front().start_state();
    }

    void motion() {
        add_large(Function::rhs, "dx/dt = f(x, u, t).", each([](CppBodies& b) { return b.rhs(); }));
        series();
        add(Function::rhs_and_jacobian,
            "dx/dt and its derivative J = df/dx together, by implicit differentiation: M d(qdd)/dx = -dR/dx with R = M qdd + bias - Q.",
            each([](CppBodies& b) { return b.rhs_and_jacobian(); }))
            .doc.push_back(layout(plant_.by_state, "x"));
        PlantFunction& by_state = plant_.functions.emplace_back();
        by_state.name = "jacobian_x";
        by_state.doc = {"J = df/dx. " + layout(plant_.by_state, "x")};
        by_state.body = bodies_.front().jacobian_x();
        together();
        add(Function::jacobian_u, "J = df/du. " + layout(plant_.by_input, "u"),
            each([](CppBodies& b) { return b.jacobian(Function::jacobian_u, By::input); }));
        add(Function::jacobian_p, "J = df/dp, parameters in the order of the table. " + layout(plant_.by_parameter, "p"),
            each([](CppBodies& b) { return b.jacobian(Function::jacobian_p, By::parameter); }));
        add(Function::jacobian_t, "J = df/dt at fixed x and u.",
            each([](CppBodies& b) { return b.jacobian(Function::jacobian_t, By::time); }));
        add_large(Function::mass_matrix, "M(q, t), symmetric.", each([](CppBodies& b) { return b.mass_matrix(); }));
        add_large(Function::bias, "bias in M qdd + bias = Q: Coriolis, gravity, springs, dampers and pressures.",
                  each([](CppBodies& b) { return b.values(Function::bias, "Generalised", "b"); }));
        add_large(Function::generalised_force, "Q in M qdd + bias = Q: forces, torques and inputs.",
                  each([](CppBodies& b) { return b.values(Function::generalised_force, "Generalised", "Q"); }));
    }

    static std::string layout(const PlantPattern& pattern, const char* letter) {
        return pattern.is_sparse ? fmt::format("The entries of jacobian_{}_pattern in its order.", letter)
                                 : fmt::format("{} x {}, entry (i, j) at J[{}*j + i].", pattern.rows, pattern.columns, pattern.rows);
    }

    /// Nothing where no series were asked for.
    void series() {
        if (!code_.series_of) return;
        FunctionBody body = merged(each([](CppBodies& b) { return b.series(); }));
        std::size_t rows = 0;
        for (const CppBodies& bodies : bodies_) rows = std::max(rows, bodies.series_rows());
        plant_.series = PlantSeries{rows, std::move(body)};
    }

    /// Nothing where it was not asked for.
    void together() {
        plant_.has_together = code_.has_together;
        if (code_.has_together)
            add(Function::together,
                "What rhs_and_jacobian, output and the functions of the energies compute, at once: what they have in common is computed "
                "once.",
                each([](CppBodies& b) { return b.together(); }));
    }

    void outputs() {
        add(Function::output, "y = h(x, u, t).", each([](CppBodies& b) { return b.values(Function::output, "Output", "y"); }));
        add(Function::output_jacobian_x, "C = dh/dx.",
            each([](CppBodies& b) { return b.output_jacobian(Function::output_jacobian_x, By::state); }));
        add(Function::output_jacobian_u, "D = dh/du.",
            each([](CppBodies& b) { return b.output_jacobian(Function::output_jacobian_u, By::input); }));
    }

    void energies() {
        const auto of = [&](Function function) { return each([function](CppBodies& b) { return b.scalar(function); }); };
        using enum Function;
        add_large(kinetic_energy, "T in joules.", of(kinetic_energy), Result::number);
        add_large(potential_energy, "V in joules.", of(potential_energy), Result::number);
        add_large(
            supplied_power,
            "Power in watts that forces, torques and inputs supply. d(T + V + E)/dt = supplied - dissipated + prescribed + exchanged.",
            of(supplied_power), Result::number);
        add_large(dissipated_power, "Power in watts that dampers dissipate; not negative for laws that resist.", of(dissipated_power),
                  Result::number);
        add(prescribed_power, "Power in watts of what moves in a prescribed way; zero where kinematics do not depend on time.",
            of(prescribed_power))
            .result = Result::number;
        add_large(internal_energy,
                  "E in joules, what fluids store: internal energy, potential energy of columns, kinetic energy of streams.",
                  of(internal_energy), Result::number);
        add(exchanged_power, "Power in watts over the border of the model: enthalpy flows, heat, shafts.", of(exchanged_power)).result =
            Result::number;
    }

    /// Guards of all modes that end nothing, each once.
    std::vector<Guard> kinks() const {
        std::vector<Guard> result;
        for (const Code* code : modes_)
            for (const Guard& guard : code->system.guards)
                if (!guard.ends && std::none_of(result.begin(), result.end(), [&](const Guard& known) { return known.is_same(guard); }))
                    result.push_back(guard);
        return result;
    }

    void switching() {
        plant_.modes = mode_tables(modes_);
        add(Function::events, "Event e happens where g[e] falls through zero, where it is watched; the others are left as they are.",
            each([](CppBodies& b) { return b.guards(Function::events, "Events", "g"); }), "guards").equations = event_equations(modes_);
        add(Function::event_rates, "dg/dt along the motion in the mode, with inputs held.",
            each([](CppBodies& b) { return b.guards(Function::event_rates, "Events", "rates"); }), "guard_rates");
        add(Function::conditions, "Whether what the mode holds is as it holds it, but for roundings.",
            each([](CppBodies& b) { return b.conditions(); }), "holds")
            .result = Result::truth;
        resets("reset", "What the event changes where it happens.", &Code::resets);
        resets("settle", "What changes where the event has happened infinitely often.", &Code::rests);
        PlantFunction& f =
            add(Function::guards,
                "Functions where the right-hand side of a mode has a kink or jump that changes no mode, in the order of guard_table().",
                each([&](CppBodies& b) { return b.kinks(kinks()); }), "kinks");
        f.equations.clear();
    }

    void resets(const char* name, const char* doc, const std::vector<ResetCode> Code::*which) {
        std::size_t mode = 0;
        PlantFunction& f = add(Function::resets, doc, each([&](CppBodies& b) { return b.resets(modes_[mode++]->*which); }), name);
        f.operations.reset();
        if (f.body.statements.empty()) f.body.statements.push_back(Unused{"event_number"});
        f.body.arguments.insert(f.body.arguments.begin(), Argument{"EventNumber", "event_number", Argument::Passing::value});
    }

    /// Nothing where integration keeps exactly what constraints hold. Of a mode that needs no projection the values are zero.
    void constraints() {
        if (system_.symbols.attitudes().empty() &&
            std::none_of(modes_.begin(), modes_.end(), [](const Code* code) { return code->system.needs_projection(); }))
            return;
        plant_.constraints = constraint_tables(code_, shared_);
        const Notation write(system_.symbols, Style::text);
        std::vector<std::string> positions, rates;
        for (const ConstraintEquation& c : system_.constraints) {
            if (c.position) positions.push_back(fmt::format("{}: {} = 0", c.name, write(*c.position)));
            rates.push_back(fmt::format("{}: {} = 0", c.name, write(c.whole_rate)));
        }
        std::vector<PlantFunction>& functions = plant_.constraint_functions;
        const auto add_one = [&](Function function, std::string doc, std::vector<FunctionBody> bodies) -> PlantFunction& {
            return functions.emplace_back(made(function, std::move(doc), std::move(bodies)));
        };
        add_one(Function::constraint_positions,
                "Positions that constraints hold at zero, in the order of constraint_table(); zero where there is none.",
                each([](CppBodies& b) { return b.values(Function::constraint_positions, "Constraints", "f", false); }))
            .equations = positions;
        add_one(Function::constraint_rates, "Rates that constraints hold at zero.",
                each([](CppBodies& b) { return b.values(Function::constraint_rates, "Constraints", "w", false); }))
            .equations = rates;
        add_one(Function::constraint_jacobian, fmt::format("d(rate)/d(velocity), entry (i, j) at A[{}*j + i].", system_.constraints.size()),
                each([](CppBodies& b) { return b.constraint_jacobian(); }));
        add_one(Function::constraint_forces,
                "Forces of the constraints along their rates, on the machine; of one that follows from those before it, zero.",
                each([](CppBodies& b) { return b.values(Function::constraint_forces, "Constraints", "force"); }));
        PlantFunction& back = functions.emplace_back();
        back.name = "move_back";
        back.doc = {"Moves the positions back by a step along the velocities. Quaternions get the norm one."};
        back.body = bodies_.front().move_back();
        add_one(Function::correction,
                "The least step, measured with M, that takes residuals of positions (move back by it) or rates (subtract it from the "
                "velocities) away:",
                each([](CppBodies& b) { return b.correction(); }))
            .doc.push_back("M^-1 A' (A M^-1 A')^-1 residual.");
    }

    /// Of all modes, where they differ.
    std::string count_text(Function function) const {
        std::string text;
        bool same = true;
        for (std::size_t m = 0; m < modes_.size(); ++m) {
            const std::string one = count_text(*modes_[m], function);
            same = same && one == count_text(code_, function);
            if (switches_) text += fmt::format("{}{}: {}", text.empty() ? "" : "; ", system_.scene.modes[m].name, one);
        }
        return same ? count_text(code_, function) : text.size() <= 300 ? text : text.substr(0, text.rfind(';', 300)) + "; ...";
    }

    static std::string count_text(const Code& code, Function function) {
        const OperationCount c = code.count(function);
        std::string text;
        const auto add = [&](int count, const char* what) {
            if (count > 0) text += fmt::format("{}{} {}", text.empty() ? "" : ", ", count, what);
        };
        add(c.additions, "+ or -");
        add(c.multiplications, "*");
        add(c.divisions, "/");
        add(c.trigonometric, "sin or cos");
        add(c.other, "other functions");
        if (text.empty()) text = "none";
        const bool solves = code[function].by_loops && (function == Function::rhs || code[function].right.columns > 0);
        if (solves) text += fmt::format(", and the factorisation and solve with M ({} x {}) by loops", code.solve.n, code.solve.n);
        return text;
    }

    const std::vector<const Code*>& modes_;
    const SharedMembers shared_;
    const Code& code_;  ///< of the first mode
    const System& system_;
    bool switches_;
    std::map<Function, std::vector<std::string>> equations_;
    std::vector<CppBodies> bodies_;
    Plant plant_;
};

}  // namespace

Plant make_plant(const std::vector<const Code*>& modes) { return PlantMaker(modes).run(); }

}  // namespace dalembert
