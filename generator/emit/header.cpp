// SPDX-License-Identifier: GPL-3.0-or-later
#include "emit/header.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cctype>
#include <optional>

#include "emit/banner.hpp"
#include "emit/cpp_bodies.hpp"
#include "emit/cpp_constant.hpp"
#include "emit/field_header.hpp"
#include "emit/header_equations.hpp"
#include "emit/header_tables.hpp"
#include "emit/helpers.hpp"
#include "emit/mode_code.hpp"
#include "emit/notation.hpp"
#include "emit/safe_text.hpp"
#include "emit/template.hpp"
#include "graph/raise.hpp"
#include "prove/constraint_validity.hpp"

namespace dalembert {

using GiNaC::ex;
using GiNaC::ex_to;

namespace {

std::string upper(std::string text) {
    for (char& c : text) c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
    return text;
}

class HeaderWriter {
public:
    explicit HeaderWriter(const std::vector<const Code*>& modes)
        : modes_(modes), shared_(modes), code_(*modes.front()), system_(code_.system), symbols_(system_.symbols), write_(symbols_, Style::text),
          values_(system_.scene, system_.translate), switches_(shared_.has_modes()) {
        for (const Code* code : modes_) bodies_.emplace_back(*code, shared_);
    }

    /// The part of the header in its namespace.
    std::string run(const std::string& name_space) {
        values("NAMESPACE", name_space);
        values("MODE_ARGUMENT", switches_ ? "Mode mode, " : "");
        values("MODE_CALL", switches_ ? "mode, " : "");
        functions();
        for (auto& [name, text] : header_tables(system_, switches_ ? kinks_ : system_.guards)) values(name, std::move(text));
        for (auto& [name, text] : header_equations(modes_)) values(name, std::move(text));
        values("API_VERSION", std::to_string(header_api_version));
        values("NAME", cpp_string(system_.scene.model->name));
        values("SCENE", cpp_string(system_.scene.name));
        values("TITLE", cpp_string(system_.scene.model->title));
        values("CACHED", cached_members());
        values("PARAMETER_MEMBERS", parameter_members());
        values("HELPERS", helpers());
        return fill_template(embedded_file("system.hpp.in"), placeholders_);
    }

private:
    void values(const std::string& name, std::string text) { placeholders_[name] = std::move(text); }

    template <class Make>
    auto each(const Make& make) {
        std::vector<decltype(make(bodies_.front()))> result;
        for (CppBodies& bodies : bodies_) result.push_back(make(bodies));
        return result;
    }

    template <class Body>
    Body merged(std::vector<Body> bodies) const { return switches_ ? by_mode(system_.scene, bodies) : std::move(bodies.front()); }

    template <class Make>
    void body(Function function, const Make& make) {
        const std::string name = upper(name_of(function));
        put(name, merged(each(make)));
        values("COUNT_" + name, count_text(function));
    }

    void put(const std::string& name, const FunctionBody& body) {
        values(name, cpp_body(body.statements));
        values(name + "_ARGUMENTS", cpp_text(body.arguments));
    }

    void functions() {
        std::set<std::string> done;
        const std::vector<FunctionBody> updates = each([&](CppBodies& b) { return b.update(done); });
        Statements update = updates.front().statements;
        if (updates.size() > 1) update.clear();
        for (const FunctionBody& one : updates)
            if (updates.size() > 1 && !one.statements.empty()) update.push_back(Braces{one.statements});
        values("UPDATE", cpp_body(update));
        values("COUNT_UPDATE", count_text(Function::update));
        values("START_STATE", cpp_body(bodies_.front().start_state().statements) + (starts_to_find(system_).empty() ? "" : "        meet_constraints(x);\n"));
        body(Function::rhs, [](CppBodies& b) { return b.rhs(); });
        body(Function::rhs_and_jacobian, [](CppBodies& b) { return b.rhs_and_jacobian(); });
        body(Function::jacobian_u, [](CppBodies& b) { return b.jacobian(Function::jacobian_u, By::input); });
        body(Function::jacobian_p, [](CppBodies& b) { return b.jacobian(Function::jacobian_p, By::parameter); });
        body(Function::jacobian_t, [](CppBodies& b) { return b.jacobian(Function::jacobian_t, By::time); });
        body(Function::mass_matrix, [](CppBodies& b) { return b.mass_matrix(); });
        body(Function::bias, [](CppBodies& b) { return b.values(Function::bias, "Generalised", "b"); });
        body(Function::generalised_force, [](CppBodies& b) { return b.values(Function::generalised_force, "Generalised", "Q"); });
        body(Function::output, [](CppBodies& b) { return b.values(Function::output, "Output", "y"); });
        body(Function::output_jacobian_x, [](CppBodies& b) { return b.output_jacobian(Function::output_jacobian_x, By::state); });
        body(Function::output_jacobian_u, [](CppBodies& b) { return b.output_jacobian(Function::output_jacobian_u, By::input); });
        for (const Function f : {Function::kinetic_energy, Function::potential_energy, Function::supplied_power, Function::dissipated_power, Function::prescribed_power, Function::internal_energy, Function::exchanged_power})
            body(f, [f](CppBodies& b) { return b.scalar(f); });
        series();
        together();
        guards();
        constraints();
        layout(By::state, "X");
        layout(By::input, "U");
        layout(By::parameter, "P");
        values("PATTERNS", patterns_);
    }

    /// Nothing where no series were asked for.
    void series() {
        values("SERIES", "");
        if (!code_.series_of) return;
        const FunctionBody body = merged(each([](CppBodies& b) { return b.series(); }));
        std::size_t rows = 0;
        for (const CppBodies& bodies : bodies_) rows = std::max(rows, bodies.series_rows());
        values("SERIES", fill_template(embedded_file("series.hpp.in"), {{"SERIES_ROWS", std::to_string(rows)}, {"SERIES_ARGUMENTS", cpp_text(body.arguments)}, {"SERIES", cpp_body(body.statements)}}));
    }

    /// Nothing where it was not asked for.
    void together() {
        values("TOGETHER", "");
        if (!code_.has_together) return;
        const FunctionBody body = merged(each([](CppBodies& b) { return b.together(); }));
        values("TOGETHER", fill_template(embedded_file("together.hpp.in"), {{"COUNT", count_text(Function::together)}, {"ARGUMENTS", cpp_text(body.arguments)}, {"TOGETHER", cpp_body(body.statements)}}));
    }

    /// Guards of a machine that does not switch, or what one that does has instead.
    void guards() {
        if (!switches_) {
            const FunctionBody body = bodies_.front().values(Function::guards, "Guards", "g");
            values("GUARD_FUNCTIONS", fill_template(embedded_file("guards.hpp.in"), {{"COUNT_GUARDS", count_text(Function::guards)}, {"GUARDS_ARGUMENTS", cpp_text(body.arguments)}, {"GUARDS", cpp_body(body.statements)}}));
            values("MODE_TABLES", "");
            values("MODE_TYPES", "");
            return;
        }
        for (const Code* code : modes_)
            for (const Guard& guard : code->system.guards)
                if (!guard.ends && std::none_of(kinks_.begin(), kinks_.end(), [&](const Guard& known) { return known.is_same(guard); })) kinks_.push_back(guard);
        std::map<std::string, std::string> v;
        const auto add = [&](const std::string& name, const FunctionBody& body, std::optional<Function> counted = {}) {
            v[name] = cpp_body(body.statements);
            v[name + "_ARGUMENTS"] = cpp_text(body.arguments);
            if (counted) v["COUNT_" + name] = count_text(*counted);
        };
        add("EVENTS", merged(each([](CppBodies& b) { return b.guards(Function::events, "Events", "g"); })), Function::events);
        add("EVENT_RATES", merged(each([](CppBodies& b) { return b.guards(Function::event_rates, "Events", "rates"); })), Function::event_rates);
        add("CONDITIONS", merged(each([](CppBodies& b) { return b.conditions(); })), Function::conditions);
        const auto resets = [&](const std::string& name, const std::vector<ResetCode> Code::*which) {
            std::size_t mode = 0;
            FunctionBody body = merged(each([&](CppBodies& b) { return b.resets(modes_[mode++]->*which); }));
            if (body.statements.empty()) body.statements.push_back(Unused{"event_number"});
            add(name, body);
        };
        resets("RESETS", &Code::resets);
        resets("RESTS", &Code::rests);
        add("KINKS", merged(each([&](CppBodies& b) { return b.kinks(kinks_); })));
        v["COUNT_GUARDS"] = count_text(Function::guards);
        v["EVENT_EQUATIONS"] = comment_lines(event_equations(modes_));
        values("GUARD_FUNCTIONS", fill_template(embedded_file("mode_functions.hpp.in"), v));
        values("MODE_TABLES", mode_tables(modes_));
        values("MODE_TYPES", fill_template(embedded_file("mode_types.hpp.in"), {{"NAMESPACE", placeholders_.at("NAMESPACE")}, {"APART", events_apart(system_)}}));
    }

    /// Nothing where integration keeps exactly what constraints hold. Of a mode that needs no projection the values are zero.
    void constraints() {
        for (const char* name : {"CONSTRAINT_TABLES", "CONSTRAINT_TYPES", "CONSTRAINT_FUNCTIONS"}) values(name, "");
        if (symbols_.attitudes().empty() && std::none_of(modes_.begin(), modes_.end(), [](const Code* code) { return code->system.needs_projection(); })) return;
        std::map<std::string, std::string> v = constraint_tables(system_);
        const auto add = [&](Function function, const std::vector<FunctionBody>& bodies) {
            const std::string name = upper(name_of(function));
            const FunctionBody body = merged(bodies);
            v[name] = cpp_body(body.statements);
            v[name + "_ARGUMENTS"] = cpp_text(body.arguments);
            v["COUNT_" + name] = count_text(function);
        };
        add(Function::constraint_positions, each([](CppBodies& b) { return b.values(Function::constraint_positions, "Constraints", "f", false); }));
        add(Function::constraint_rates, each([](CppBodies& b) { return b.values(Function::constraint_rates, "Constraints", "w", false); }));
        add(Function::constraint_jacobian, each([](CppBodies& b) { return b.constraint_jacobian(); }));
        add(Function::constraint_forces, each([](CppBodies& b) { return b.values(Function::constraint_forces, "Constraints", "force"); }));
        add(Function::correction, each([](CppBodies& b) { return b.correction(); }));
        const FunctionBody moved = bodies_.front().move_back();
        v["MOVE_BACK"] = cpp_body(moved.statements);
        v["MOVE_BACK_ARGUMENTS"] = cpp_text(moved.arguments);
        std::vector<std::string> is_found;
        for (const bool found : starts_to_find(system_)) is_found.emplace_back(found ? "true" : "false");
        v["MEET_CONSTRAINTS"] = is_found.empty() ? "" : fill_template(embedded_file("meet_constraints.hpp.in"), {{"IS_FOUND", fmt::format("{}", fmt::join(is_found, ", "))}});
        std::vector<std::string> positions, rates;
        for (const ConstraintEquation& c : system_.constraints) {
            if (c.position) positions.push_back(fmt::format("{}: {} = 0", c.name, write_(*c.position)));
            rates.push_back(fmt::format("{}: {} = 0", c.name, write_(c.whole_rate)));
        }
        v["POSITION_EQUATIONS"] = comment_lines(positions);
        v["CONSTRAINT_CHOICE"] = constraint_choice();
        v["RATE_EQUATIONS"] = comment_lines(rates);
        values("CONSTRAINT_TABLES", fill_template(embedded_file("constraint_tables.hpp.in"), pick(v, {"CONSTRAINTS", "CONSTRAINT_INDICES", "CONSTRAINT_TABLE"})));
        values("CONSTRAINT_TYPES", std::string(embedded_file("constraint_types.hpp.in")));
        for (const char* name : {"CONSTRAINT_INDICES", "CONSTRAINT_TABLE"}) v.erase(name);
        values("CONSTRAINT_FUNCTIONS", fill_template(embedded_file("constraint_functions.hpp.in"), v));
    }

    /// Which constraints are solved for, see note [choice]; nothing where all are.
    std::string constraint_choice() const {
        const Solve& s = code_.solve;
        if (s.left_out == 0) return {};
        const std::vector<std::size_t>& multipliers = system_.motion.multipliers;
        std::vector<bool> can_be_left_out, at_start;
        for (std::size_t i = 0; i < system_.constraints.size(); ++i) {
            can_be_left_out.push_back(std::find(multipliers.begin(), multipliers.end(), i) != multipliers.end());
            at_start.push_back(system_.constraints[i].holds && !system_.constraints[i].is_redundant);
        }
        std::string assignments;
        for (std::size_t i = 0; i < multipliers.size(); ++i)
            assignments += fmt::format("        c_.{} = chosen[{}] ? Scalar(1) : Scalar(0);\n", cached_name(symbols_, shared_.cached(code_).at(s.first_chosen + static_cast<std::uint32_t>(i))), multipliers[i]);
        return fill_template(embedded_file("constraint_choice.hpp.in"), {{"RANK", std::to_string(system_.constraints.size() - s.left_out)}, {"CAN_BE_LEFT_OUT", fmt::format("{}", fmt::join(can_be_left_out, ", "))},
                                                                       {"SOLVED_FOR_AT_START", fmt::format("{}", fmt::join(at_start, ", "))}, {"SOLVE_FOR", assignments}});
    }

    static std::map<std::string, std::string> pick(const std::map<std::string, std::string>& all, std::initializer_list<const char*> names) {
        std::map<std::string, std::string> result;
        for (const char* name : names) result[name] = all.at(name);
        return result;
    }

    void layout(By by, const char* letter) {
        const JacobianLayout& l = shared_.layout(by);
        const std::string lower_letter(1, static_cast<char>(std::tolower(*letter)));
        values(fmt::format("SIZE_{}", letter), std::to_string(l.size()));
        values(fmt::format("LAYOUT_{}", letter),
               l.is_sparse() ? fmt::format("The entries of jacobian_{}_pattern in its order.", lower_letter)
                             : fmt::format("{} x {}, entry (i, j) at J[{}*j + i].", l.rows(), l.columns(), l.rows()));
        patterns_ += fmt::format("/// df/d{}: {}\nstruct jacobian_{}_pattern {{\n    static constexpr bool is_sparse = {};\n", lower_letter,
                                 l.is_sparse() ? "entries that are not zero for every motion, in compressed columns (CSC)." : "all entries are stored.", lower_letter,
                                 l.is_sparse());
        if (!l.is_sparse()) {
            if (by == By::state) patterns_ += nonzero(l);
            patterns_ += "};\n\n";
            return;
        }
        const auto list = [&](const char* name, const std::vector<std::size_t>& numbers) {
            patterns_ += fmt::format("    static constexpr std::array<std::size_t, {}> {}{{\n", numbers.size(), name);
            for (std::size_t i = 0; i < numbers.size(); i += 24) {
                const std::vector<std::size_t> row(numbers.begin() + static_cast<std::ptrdiff_t>(i), numbers.begin() + static_cast<std::ptrdiff_t>(std::min(i + 24, numbers.size())));
                patterns_ += fmt::format("        {},\n", fmt::join(row, ", "));
            }
            patterns_ += "    };\n";
        };
        list("column_starts", l.column_starts());
        list("row_indices", l.row_indices());
        patterns_ += "};\n\n";
    }

    /// Which of the stored entries matter to who factors the matrix; nothing where all of them do.
    static std::string nonzero(const JacobianLayout& l) {
        if (l.row_indices().size() == l.rows() * l.columns()) return {};
        std::vector<std::string> columns;
        for (std::size_t j = 0; j < l.columns(); ++j) {
            unsigned bits = 0;
            for (std::size_t k = l.column_starts()[j]; k < l.column_starts()[j + 1]; ++k) bits |= 1U << l.row_indices()[k];
            columns.push_back(fmt::format("{:#x}", bits));
        }
        return fmt::format("    /// Bit i of number j: whether entry (i, j) is other than zero for some motion.\n    static constexpr std::array<unsigned, {}> nonzero{{{}}};\n", l.columns(), fmt::join(columns, ", "));
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

    std::string parameter_members() {
        std::string text;
        const auto& parameters = symbols_.all(SymbolKind::parameter);
        for (std::size_t i = 0; i < parameters.size();) {
            const Variable& first = parameters[i];
            std::size_t end = i;
            std::vector<std::string> defaults;
            for (; end < parameters.size() && parameters[end].base == first.base; ++end) defaults.push_back(constant_text(values_.parameter(end), uses_pi_));
            const std::string doc = fmt::format("  ///< {}{}{}", first.unit, first.doc.empty() ? "" : ", ", safe_line(first.doc));
            if (!first.is_member) text += fmt::format("    Scalar {} = {};{}\n", first.base, defaults[0], doc);
            else text += fmt::format("    std::array<Scalar, {}> {}{{{}}};{}\n", defaults.size(), first.base, fmt::join(defaults, ", "), doc);
            i = end;
        }
        return text;
    }

    std::string cached_members() {
        const auto& definitions = symbols_.all(SymbolKind::definition);
        const bool has_mass = code_.solve.is_constant && !code_.solve.unrolled;
        std::map<std::size_t, std::string> members;
        for (const Code* code : modes_) {
            const CachedMeaning meaning = cached_meaning(*code);
            const Notation write(code->system.symbols, Style::text);
            for (const auto& [index, number] : shared_.cached(*code)) {
                const bool is_factor = code->solve.is_constant && code->solve.unrolled && index >= code->solve.first_cached &&
                                       index < code->solve.first_cached + code->solve.is_zero.size();
                members.emplace(number, fmt::format("        Scalar {};  ///< {}\n", cached_name(symbols_, number), is_factor ? "of the factorisation of M" : is_choice(*code, index) ? "whether a constraint is solved for" : shortened(write(meaning(index)))));
            }
        }
        if (definitions.empty() && members.empty() && !has_mass) return {};
        std::string text = "    /// What depends on parameters alone.\n    struct Cached {\n";
        for (std::size_t i = 0; i < definitions.size(); ++i)
            if (shared_.is_kept(i)) text += fmt::format("        Scalar {};  ///< {}\n", cpp_name(definitions[i]), shortened(write_(symbols_.definition_values()[i])));
        for (const auto& [number, member] : members) text += member;
        if (has_mass) text += fmt::format("        std::array<Scalar, {}> mass_factors;  ///< factors of M\n", code_.solve.is_zero.size());
        return text + "    };\n    Cached c_{};\n";
    }

    static bool is_choice(const Code& code, std::uint32_t index) { return code.solve.left_out > 0 && index >= code.solve.first_chosen && index < code.solve.first_chosen + code.solve.multipliers; }

    static std::string shortened(const std::string& text) { return text.size() <= 100 ? text : text.substr(0, text.rfind(' ', 96)) + " ..."; }

    std::string helpers() {
        std::set<std::string> needed;
        for (const CppBodies& bodies : bodies_) needed.insert(bodies.helpers().begin(), bodies.helpers().end());
        if (uses_pi_) needed.insert("pi");
        return helper_source(needed);
    }

    const std::vector<const Code*>& modes_;
    const SharedMembers shared_;
    const Code& code_;  ///< of the first mode
    const System& system_;
    const Symbols& symbols_;
    std::vector<CppBodies> bodies_;
    Notation write_;
    Values values_;
    bool switches_;
    std::vector<Guard> kinks_;
    std::map<std::string, std::string> placeholders_;
    std::string patterns_;
    bool uses_pi_ = false;
};

}  // namespace

std::string header_name(const Scene& scene) { return fmt::format("{}_{}.hpp", scene.sized_name(), scene.name); }
std::string header_namespace(const Scene& scene) { return fmt::format("{}::{}", scene.sized_name(), scene.name); }

Header make_header(const std::vector<const Code*>& modes, const FieldCode* fields, const Proofs& proofs, const std::vector<EffectSize>& effects_out, const std::string& command) {
    const Code& code = *modes.front();
    check_cpp_names(code.system);
    const Scene& scene = code.system.scene;
    const std::string name_space = header_namespace(scene);
    const std::string content = fields == nullptr ? HeaderWriter(modes).run(name_space) : HeaderWriter(modes).run(name_space + "::core") + "\n" + field_content(*fields, name_space);
    const std::string guard = upper(scene.sized_name() + "_" + scene.name) + "_HPP";
    return {header_name(scene), name_space,
            fill_template(embedded_file("header.hpp.in"), {{"BANNER", banner(modes, proofs, effects_out, command)}, {"GUARD", guard}, {"CONTENT", content}})};
}

}  // namespace dalembert
