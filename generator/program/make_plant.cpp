// SPDX-License-Identifier: GPL-3.0-or-later
#include "program/make_plant.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <sstream>

#include "program/function_bodies.hpp"
#include "elements/bodies.hpp"
#include "program/mode_code.hpp"
#include "program/plant_tables.hpp"

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
        for (FunctionBodies& bodies : bodies_) result.push_back(make(bodies));
        return result;
    }

public:
    PlantMaker(const std::vector<const Code*>& modes, const std::map<Function, std::vector<std::string>>& equations)
        : modes_(modes),
          shared_(modes),
          code_(*modes.front()),
          system_(code_.system),
          switches_(shared_.has_modes()),
          equations_(equations) {
        for (const Code* code : modes_) bodies_.emplace_back(*code, shared_);
    }

    Plant run() {
        set_tables(plant_, modes_, shared_, switches_ ? kinks() : system_.guards);
        parameters();
        if (switches_) plant_.modes = mode_tables(modes_);
        if (shared_.has_projection()) plant_.constraints = constraint_tables(code_, shared_);
        for (const HeaderFunction& row : header_functions())
            if (shared_.has(row)) add(row);
        for (auto* functions : {&plant_.functions, &plant_.constraint_functions})
            for (PlantFunction& f : *functions) f.is_large = f.is_large || length_of(f.equations) > longest_equations;
        for (const FunctionBodies& bodies : bodies_) plant_.helpers.insert(bodies.helpers().begin(), bodies.helpers().end());
        return std::move(plant_);
    }

private:
    using Kind = HeaderFunction::Kind;

    template <class Body>
    Body merged(std::vector<Body> bodies) const { return switches_ ? by_mode(system_.scene, bodies) : std::move(bodies.front()); }

    std::vector<PlantFunction>& list_of(const HeaderFunction& row) {
        return row.in == HeaderFunction::In::constrained ? plant_.constraint_functions : plant_.functions;
    }

    /// What the row says, with these bodies.
    PlantFunction& add(const HeaderFunction& row, const std::string& name, const std::string& doc, std::vector<FunctionBody> bodies) {
        PlantFunction& f = list_of(row).emplace_back();
        f.name = name;
        f.result = row.kind == Kind::number       ? Result::number
                   : row.kind == Kind::conditions ? Result::truth
                                                  : Result::none;
        std::istringstream lines(doc);
        for (std::string line; std::getline(lines, line);) f.doc.push_back(line);
        f.operations = count_text(row.function);
        const auto equations = equations_.find(row.function);
        if (equations != equations_.end()) f.equations = equations->second;
        f.is_large = row.has_equations && equations == equations_.end();
        f.body = merged(std::move(bodies));
        return f;
    }

    /// A function with what stands beside it.
    void add(const HeaderFunction& row) {
        if (row.kind == Kind::resets) return resets(row);
        if (row.function == Function::guards && switches_) return kinks(row);
        if (row.kind == Kind::correction) {
            PlantFunction& back = list_of(row).emplace_back();
            back.name = "move_back";
            back.doc = {"Moves the positions back by a step along the velocities. Quaternions get the norm one."};
            back.body = bodies_.front().move_back();
        }
        add(row, row.header_name(), whole_doc(row), each([&](FunctionBodies& b) { return b.body(row); }));
        if (row.kind != Kind::motion) return;
        if (!row.by) return series();
        PlantFunction& alone = list_of(row).emplace_back();
        alone.name = "jacobian_x";
        alone.doc = {"J = df/dx. " + layout(row)};
        alone.body = bodies_.front().jacobian_x();
    }

    void parameters() {
        std::set<std::string> done;
        const std::vector<FunctionBody> updates = each([&](FunctionBodies& b) { return b.update(done); });
        if (updates.size() == 1) plant_.update = updates.front();
        for (const FunctionBody& one : updates)
            if (updates.size() > 1 && !one.statements.empty()) plant_.update.statements.push_back(Braces{one.statements});
        plant_.update_operations = count_text(Function::update);
        plant_.start_state = bodies_.front().start_state();
    }

    /// With where the entries of its array stand.
    std::string whole_doc(const HeaderFunction& row) const {
        if (row.kind == Kind::motion && row.by) return fmt::format("{}\n{}", row.doc, layout(row));
        if (row.kind == Kind::jacobian && row.by != By::time) return fmt::format("{} {}", row.doc, layout(row));
        if (row.kind == Kind::matrix)
            return fmt::format("{}, entry (i, j) at {}[{}*j + i].", row.doc, row.array, row.names(system_).size());
        return row.doc;
    }

    std::string layout(const HeaderFunction& row) const {
        const PlantPattern& pattern = row.by == By::state   ? plant_.by_state
                                      : row.by == By::input ? plant_.by_input
                                                            : plant_.by_parameter;
        const char* letter = row.by == By::state ? "x" : row.by == By::input ? "u" : "p";
        return pattern.is_sparse ? fmt::format("The entries of jacobian_{}_pattern in its order.", letter)
                                 : fmt::format("{} x {}, entry (i, j) at J[{}*j + i].", pattern.rows, pattern.columns, pattern.rows);
    }

    /// Nothing where no series were asked for.
    void series() {
        if (!code_.series_of) return;
        FunctionBody body = merged(each([](FunctionBodies& b) { return b.series(); }));
        std::size_t rows = 0;
        for (const FunctionBodies& bodies : bodies_) rows = std::max(rows, bodies.series_rows());
        plant_.series = PlantSeries{rows, std::move(body)};
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

    /// What is left of guards where a machine switches.
    void kinks(const HeaderFunction& row) {
        add(row, "kinks",
            "Functions where the right-hand side of a mode has a kink or jump that changes no mode, in the order of guard_table().",
            each([&](FunctionBodies& b) { return b.kinks(kinks()); }));
    }

    /// Two functions: of events, and of events that have happened infinitely often.
    void resets(const HeaderFunction& row) {
        resets(row, row.header_name(), row.doc, &Code::resets);
        resets(row, "settle", "Changes the state as infinitely many of the event do.", &Code::rests);
    }

    void resets(const HeaderFunction& row, const char* name, const char* doc, const std::vector<ResetCode> Code::*which) {
        std::size_t mode = 0;
        PlantFunction& f = add(row, name, doc, each([&](FunctionBodies& b) { return b.resets(modes_[mode++]->*which); }));
        f.operations.reset();
        if (f.body.statements.empty()) f.body.statements.push_back(Unused{"event_number"});
        f.body.arguments.insert(f.body.arguments.begin(), Argument{"EventNumber", "event_number", Argument::Passing::value});
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
    const std::map<Function, std::vector<std::string>>& equations_;
    std::vector<FunctionBodies> bodies_;
    Plant plant_;
};

}  // namespace

Plant make_plant(const std::vector<const Code*>& modes, const std::map<Function, std::vector<std::string>>& equations) {
    return PlantMaker(modes, equations).run();
}

}  // namespace dalembert
