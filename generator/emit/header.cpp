// SPDX-License-Identifier: GPL-3.0-or-later
#include "emit/header.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cctype>

#include "emit/banner.hpp"
#include "emit/cpp_bodies.hpp"
#include "emit/cpp_constant.hpp"
#include "emit/field_header.hpp"
#include "emit/helpers.hpp"
#include "emit/notation.hpp"
#include "emit/safe_text.hpp"
#include "emit/template.hpp"
#include "graph/raise.hpp"

namespace dalembert {

using GiNaC::ex;
using GiNaC::ex_to;

namespace {

constexpr std::size_t longest_equations = 8000;

std::string upper(std::string text) {
    for (char& c : text) c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
    return text;
}

class HeaderWriter {
public:
    explicit HeaderWriter(const Code& code)
        : code_(code), system_(code.system), symbols_(system_.symbols), bodies_(code), write_(symbols_, Style::text),
          values_(system_.scene, system_.translate) {}

    /// The part of the header in its namespace.
    std::string run(const std::string& name_space) {
        functions();
        tables();
        equations();
        values("API_VERSION", std::to_string(header_api_version));
        values("NAMESPACE", name_space);
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

    void body(Function function, const CppBody& body) {
        const std::string name = upper(name_of(function));
        values(name, body.statements);
        if (function == Function::start_state) return;
        values("COUNT_" + name, count_text(function));
        if (function != Function::update) values(name + "_ARGUMENTS", body.arguments);
    }

    void functions() {
        body(Function::update, bodies_.update());
        body(Function::start_state, bodies_.start_state());
        body(Function::rhs, bodies_.rhs());
        body(Function::rhs_and_jacobian, bodies_.rhs_and_jacobian());
        body(Function::jacobian_u, bodies_.jacobian(Function::jacobian_u, By::input));
        body(Function::jacobian_p, bodies_.jacobian(Function::jacobian_p, By::parameter));
        body(Function::jacobian_t, bodies_.jacobian(Function::jacobian_t, By::time));
        body(Function::mass_matrix, bodies_.mass_matrix());
        body(Function::bias, bodies_.values(Function::bias, "Generalised", "b"));
        body(Function::generalised_force, bodies_.values(Function::generalised_force, "Generalised", "Q"));
        body(Function::output, bodies_.values(Function::output, "Output", "y"));
        body(Function::output_jacobian_x, bodies_.output_jacobian(Function::output_jacobian_x, By::state));
        body(Function::output_jacobian_u, bodies_.output_jacobian(Function::output_jacobian_u, By::input));
        for (const Function f : {Function::kinetic_energy, Function::potential_energy, Function::supplied_power, Function::dissipated_power, Function::prescribed_power, Function::internal_energy, Function::exchanged_power})
            body(f, bodies_.scalar(f));
        body(Function::guards, bodies_.values(Function::guards, "Guards", "g"));
        layout(By::state, "X");
        layout(By::input, "U");
        layout(By::parameter, "P");
        values("PATTERNS", patterns_);
    }

    void layout(By by, const char* letter) {
        const JacobianLayout& l = bodies_.layout(by);
        const std::string lower_letter(1, static_cast<char>(std::tolower(*letter)));
        values(fmt::format("SIZE_{}", letter), std::to_string(l.size()));
        values(fmt::format("LAYOUT_{}", letter),
               l.is_sparse() ? fmt::format("The entries of jacobian_{}_pattern in its order.", lower_letter)
                             : fmt::format("{} x {}, entry (i, j) at J[{}*j + i].", l.rows(), l.columns(), l.rows()));
        patterns_ += fmt::format("/// df/d{}: {}\nstruct jacobian_{}_pattern {{\n    static constexpr bool is_sparse = {};\n", lower_letter,
                                 l.is_sparse() ? "entries that are not zero for every motion, in compressed columns (CSC)." : "all entries are stored.", lower_letter,
                                 l.is_sparse());
        if (!l.is_sparse()) {
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

    std::string count_text(Function function) const {
        const OperationCount c = code_.count(function);
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
        const bool solves = code_[function].by_loops && (function == Function::rhs || code_[function].right.columns > 0);
        if (solves) text += fmt::format(", and the factorisation and solve with M ({} x {}) by loops", code_.solve.n, code_.solve.n);
        return text;
    }

    static std::string quantity_row(const std::string& name, const std::string& unit, const std::string& doc, const std::string& range = "") {
        return fmt::format("    Quantity{{{}, {}, {}{}}},\n", cpp_string(name), cpp_string(unit), cpp_string(doc), range);
    }

    /// ", low, high", as far as they are declared.
    std::string range_text(const Variable& variable) const {
        if (variable.declared == nullptr || !variable.declared->range || variable.kind == SymbolKind::velocity) return {};
        const auto bound = [&](const ExpressionPtr& e) {
            const ex value = system_.translate(*e, {});
            return double_text(variable.is_root ? ex(GiNaC::sqrt(value)) : value);
        };
        const Range& range = *variable.declared->range;
        std::string text = range.low ? ", " + bound(range.low) : ", -std::numeric_limits<double>::infinity()";
        if (range.high) text += ", " + bound(range.high);
        return text;
    }

    void table(const char* name, const std::vector<const Variable*>& variables) {
        std::string indices;
        std::string rows;
        for (std::size_t i = 0; i < variables.size(); ++i) {
            indices += fmt::format("{}{} = {}", i == 0 ? "" : ", ", cpp_name(*variables[i]), i);
            rows += quantity_row(variables[i]->name, variables[i]->unit, variables[i]->doc, range_text(*variables[i]));
        }
        add_table(name, indices, rows);
    }

    void add_table(const std::string& name, const std::string& indices, const std::string& rows) {
        std::string text = wrapped("enum : std::size_t { " + indices + " };", 0);
        text.pop_back();
        // A long list of indices is broken at its commas.
        for (std::size_t at = 100, last = 0; at < text.size(); at = last + 110) {
            const std::size_t comma = text.find(", ", at);
            if (comma == std::string::npos) break;
            text.replace(comma, 2, ",\n    ");
            last = comma;
        }
        values(name + "_INDICES", indices.empty() ? "" : " " + text + " ");
        values(name + "_TABLE", rows.empty() ? "" : "\n" + rows);
    }

    void tables() {
        const auto pointers = [&](std::initializer_list<SymbolKind> kinds) {
            std::vector<const Variable*> result;
            for (const SymbolKind kind : kinds)
                for (const Variable& variable : symbols_.all(kind)) result.push_back(&variable);
            return result;
        };
        const auto states = pointers({SymbolKind::coordinate, SymbolKind::velocity, SymbolKind::state});
        table("STATE", states);
        table("INPUT", pointers({SymbolKind::input}));
        table("PARAMETER", pointers({SymbolKind::parameter}));
        std::string indices;
        std::string rows;
        for (std::size_t i = 0; i < system_.outputs.size(); ++i) {
            const OutputEquation& output = system_.outputs[i];
            indices += fmt::format("{}{} = {}", i == 0 ? "" : ", ", cpp_name(output.base, output.index, output.is_member), i);
            rows += quantity_row(output.name, output.unit, output.doc);
        }
        add_table("OUTPUT", indices, rows);
        std::string guards;
        for (const Guard& guard : system_.fluids.guards) guards += fmt::format("    Guard{{{}, {}, {}}},\n", cpp_string(guard.name), cpp_string(guard.doc), guard.ends);
        values("GUARD_TABLE", guards.empty() ? "" : "\n" + guards);
        values("GUARDS_COUNT", std::to_string(system_.fluids.guards.size()));

        values("DEGREES", std::to_string(symbols_.degrees()));
        values("PLAIN_STATES", std::to_string(symbols_.states()));
        values("STATES", std::to_string(states.size()));
        values("INPUTS", std::to_string(symbols_.count(SymbolKind::input)));
        values("OUTPUTS", std::to_string(system_.outputs.size()));
        values("PARAMETERS", std::to_string(symbols_.count(SymbolKind::parameter)));
        std::vector<std::string> starts;
        for (const ex& value : values_.state()) starts.push_back(double_text(value));
        values("START_VALUES", fmt::format("{}", fmt::join(starts, ", ")));
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
        if (definitions.empty() && bodies_.cached().empty() && !has_mass) return {};
        std::string text = "    /// What depends on parameters alone.\n    struct Cached {\n";
        for (std::size_t i = 0; i < definitions.size(); ++i)
            if (bodies_.is_kept(i)) text += fmt::format("        Scalar {};  ///< {}\n", cpp_name(definitions[i]), shortened(write_(symbols_.definition_values()[i])));
        const CachedMeaning meaning = cached_meaning(code_);
        for (const auto& [index, number] : bodies_.cached()) {
            const bool is_factor = code_.solve.is_constant && code_.solve.unrolled && index >= code_.solve.first_cached &&
                                   index < code_.solve.first_cached + code_.solve.is_zero.size();
            text += fmt::format("        Scalar {};  ///< {}\n", cached_name(symbols_, number), is_factor ? "of the factorisation of M" : shortened(write_(meaning(index))));
        }
        if (has_mass) text += fmt::format("        std::array<Scalar, {}> mass_factors;  ///< factors of M\n", code_.solve.is_zero.size());
        return text + "    };\n    Cached c_{};\n";
    }

    static std::string shortened(const std::string& text) { return text.size() <= 100 ? text : text.substr(0, text.rfind(' ', 96)) + " ..."; }

    std::string helpers() {
        std::set<std::string> needed = bodies_.helpers();
        if (uses_pi_) needed.insert("pi");
        return helper_source(needed);
    }

    /// Comment lines, or a hint where they would drown the code.
    static std::string lines(const std::vector<std::string>& equations) {
        std::size_t length = 0;
        for (const std::string& e : equations) length += e.size();
        if (length > longest_equations) return "    /// (Too long to be printed here; `dalembert derive` prints the equations.)\n";
        std::string text;
        for (const std::string& e : equations) text += cpp_comment("    " + e, 4);
        return text;
    }

    void equations() {
        const std::size_t n = symbols_.degrees();
        const auto& q = symbols_.all(SymbolKind::coordinate);
        const bool is_large = n > 8;
        const std::vector<std::string> too_long{std::string(longest_equations + 1, ' ')};
        std::vector<std::string> motion, mass, bias, force, output;
        for (std::size_t j = 0; !is_large && j < n; ++j) {
            motion.push_back(fmt::format("{} = {}", write_(system_.residual[j] + system_.supplied[j]), write_(system_.supplied[j])));
            for (std::size_t l = 0; l <= j; ++l)
                mass.push_back(fmt::format("M[{}, {}] = {}", q[l].name, q[j].name, write_(system_.mass(static_cast<unsigned>(j), static_cast<unsigned>(l)))));
            bias.push_back(fmt::format("bias[{}] = {}", q[j].name, write_(system_.bias[j])));
            force.push_back(fmt::format("Q[{}] = {}", q[j].name, write_(system_.supplied[j])));
        }
        for (std::size_t i = 0; i < system_.state_rates.size(); ++i)
            motion.push_back(fmt::format("dot({}) = {}", symbols_.all(SymbolKind::state)[i].name, write_(system_.named.state_rates[i])));
        std::vector<std::string> names;
        for (const auto& [letter, value] : system_.named.names) names.push_back(fmt::format("{} = {}", write_(letter), write_(value)));
        motion.insert(motion.begin(), names.begin(), names.end());
        for (const OutputEquation& o : system_.outputs) output.push_back(fmt::format("{} = {}", o.name, write_(o.value)));
        values("EQUATIONS", lines(is_large ? too_long : motion));
        values("MASS_EQUATIONS", lines(is_large ? too_long : mass));
        values("BIAS_EQUATIONS", lines(is_large ? too_long : bias));
        values("FORCE_EQUATIONS", lines(is_large ? too_long : force));
        values("OUTPUT_EQUATIONS", lines(output));
        const auto scalar = [&](const char* name, const char* letter, const ex& value) {
            values(name, lines(is_large ? too_long : std::vector<std::string>{fmt::format("{} = {}", letter, write_(value))}));
        };
        scalar("KINETIC_ENERGY_EQUATIONS", "T", system_.kinetic_energy);
        scalar("POTENTIAL_ENERGY_EQUATIONS", "V", system_.potential_energy);
        scalar("INTERNAL_ENERGY_EQUATIONS", "E", system_.named.internal_energy);
        scalar("SUPPLIED_POWER_EQUATIONS", "supplied", system_.supplied_power);
        scalar("DISSIPATED_POWER_EQUATIONS", "dissipated", system_.dissipated_power);
    }

    const Code& code_;
    const System& system_;
    const Symbols& symbols_;
    CppBodies bodies_;
    Notation write_;
    Values values_;
    std::map<std::string, std::string> placeholders_;
    std::string patterns_;
    bool uses_pi_ = false;
};

}  // namespace

std::string header_name(const Scene& scene) { return fmt::format("{}_{}.hpp", scene.sized_name(), scene.name); }
std::string header_namespace(const Scene& scene) { return fmt::format("{}::{}", scene.sized_name(), scene.name); }

Header make_header(const Code& code, const FieldCode* fields, const Proofs& proofs, const std::vector<EffectSize>& effects_out, const std::string& command) {
    check_cpp_names(code.system);
    const Scene& scene = code.system.scene;
    const std::string name_space = header_namespace(scene);
    const std::string content = fields == nullptr ? HeaderWriter(code).run(name_space) : HeaderWriter(code).run(name_space + "::core") + "\n" + field_content(*fields, name_space);
    const std::string guard = upper(scene.sized_name() + "_" + scene.name) + "_HPP";
    return {header_name(scene), name_space, fill_template(embedded_file("header.hpp.in"), {{"BANNER", banner(code, proofs, effects_out, command)}, {"GUARD", guard}, {"CONTENT", content}})};
}

}  // namespace dalembert
