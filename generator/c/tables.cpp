// SPDX-License-Identifier: GPL-3.0-or-later
#include "c/tables.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "c/header.hpp"
#include "text/safe_text.hpp"

namespace dalembert {

namespace {

using Places = std::vector<std::pair<std::string, std::size_t>>;

Places numbered(const std::vector<std::string>& identifiers) {
    Places result;
    for (const std::string& identifier : identifiers) result.emplace_back(identifier, result.size());
    return result;
}

Places places_of(const std::vector<PlantQuantity>& list) {
    Places result;
    for (const PlantQuantity& q : list) result.emplace_back(q.identifier, result.size());
    return result;
}

class Tables {
public:
    Tables(const Plant& plant, std::string name) : plant_(plant), name_(std::move(name)) {}

    std::map<std::string, std::string> run(const Places& states) {
        std::vector<std::string> guards;
        for (const PlantGuard& g : plant_.guards)
            guards.push_back(fmt::format("{{{}, {}, {}}}", cpp_string(g.name), cpp_string(g.doc), g.ends));
        std::map<std::string, std::string> texts = sizes();
        texts.merge(std::map<std::string, std::string>{
            {"INDICES", index_list("x", states.empty() ? places_of(plant_.states) : states) + index_list("u", places_of(plant_.inputs)) +
                            index_list("y", places_of(plant_.outputs)) + index_list("p", places_of(plant_.parameters))},
            {"STATE_TABLE", quantities("state", plant_.states)},
            {"INPUT_TABLE", quantities("input", plant_.inputs)},
            {"OUTPUT_TABLE", quantities("output", plant_.outputs)},
            {"PARAMETER_TABLE", quantities("parameter", plant_.parameters)},
            {"GUARD_TABLE", table(name_ + "_guard", "guard_table", guards)},
            {"MODE_TABLES", plant_.modes ? modes(*plant_.modes) : ""},
            {"CONSTRAINT_TABLES", plant_.constraints ? constraints(*plant_.constraints) : ""},
            {"PATTERN_X", pattern(plant_.by_state, 'x')},
            {"PATTERN_U", pattern(plant_.by_input, 'u')},
            {"PATTERN_P", pattern(plant_.by_parameter, 'p')},
            {"MORE_SIZES", more_sizes()}});
        return texts;
    }

private:
    /// A function that returns an array of constants. C has no arrays without entries: there it returns no place.
    std::string table(const std::string& type, const std::string& function, const std::vector<std::string>& rows) const {
        const std::string head = fmt::format("static inline const {}* {}_{}(void) {{", type, name_, function);
        if (rows.empty()) return head + " return NULL; }\n\n";
        return fmt::format("{}\n    static const {} table[{}] = {{\n        {}\n    }};\n    return table;\n}}\n\n", head, type,
                           rows.size(), fmt::join(rows, ",\n        "));
    }

    static std::vector<std::string> lines_of(const std::vector<std::size_t>& numbers) {
        std::vector<std::string> lines;
        for (std::size_t i = 0; i < numbers.size(); i += 24)
            lines.push_back(
                fmt::format("{}", fmt::join(numbers.begin() + static_cast<std::ptrdiff_t>(i),
                                            numbers.begin() + static_cast<std::ptrdiff_t>(std::min(i + 24, numbers.size())), ", ")));
        return lines;
    }

    std::string number_table(const std::string& function, const std::vector<std::size_t>& numbers) const {
        return fmt::format(
            "static inline const size_t* {}_{}(void) {{\n    static const size_t table[{}] = {{\n        {}\n    }};\n    return "
            "table;\n}}\n\n",
            name_, function, std::max<std::size_t>(numbers.size(), 1),
            numbers.empty() ? "0" : fmt::format("{}", fmt::join(lines_of(numbers), ",\n        ")));
    }

    std::string flag_table(const std::string& function, const std::vector<bool>& flags) const {
        return fmt::format("static inline const bool* {}_{}(void) {{\n    static const bool table[{}] = {{{}}};\n    return table;\n}}\n\n",
                           name_, function, flags.size(), fmt::join(flags, ", "));
    }

    std::string quantities(const std::string& vector, const std::vector<PlantQuantity>& list) const {
        std::vector<std::string> rows;
        for (const PlantQuantity& q : list)
            rows.push_back(fmt::format("{{{}, {}, {}, {}, {}}}", cpp_string(q.name), cpp_string(q.unit), cpp_string(q.doc),
                                       q.low ? real(*q.low) : "-" + infinity(), q.high ? real(*q.high) : infinity()));
        return table(name_ + "_quantity", vector + "_table", rows);
    }

    std::string real(double value) const { return fmt::format("{}_R({})", name_, value); }
    std::string infinity() const { return name_ + "_R(INFINITY)"; }

    std::string index_list(const char* letter, const Places& places, const std::string& type = "") const {
        if (places.empty()) return {};
        std::string text = type.empty() ? "enum {" : fmt::format("typedef enum {} {{", type);
        std::size_t width = text.size();
        for (std::size_t i = 0; i < places.size(); ++i) {
            const std::string one =
                fmt::format("{}_{}_{} = {}{}", name_, letter, places[i].first, places[i].second, i + 1 < places.size() ? "," : "");
            if (width + one.size() > 126) text += "\n   ", width = 3;
            text += " " + one;
            width += one.size() + 1;
        }
        return text + (type.empty() ? " };\n" : fmt::format(" }} {};\n", type));
    }

    std::map<std::string, std::string> sizes() const {
        std::map<std::string, std::string> texts;
        const auto number = [&](const char* key, std::size_t value) { texts[key] = std::to_string(value); };
        number("API_VERSION", c_api_version);
        number("DEGREES", plant_.degrees);
        number("PLAIN_STATES", plant_.plain_states);
        number("STATES", plant_.states.size());
        number("INPUTS", plant_.inputs.size());
        number("OUTPUTS", plant_.outputs.size());
        number("PARAMETERS", plant_.parameters.size());
        number("GUARD_COUNT", plant_.guards.size());
        number("SIZE_X", plant_.by_state.size());
        number("SIZE_U", plant_.by_input.size());
        number("SIZE_P", plant_.by_parameter.size());
        return texts;
    }

    std::string more_sizes() const {
        std::string text;
        const auto add = [&](const char* what, std::size_t size) { text += fmt::format("    {}_{} = {},\n", name_, what, size); };
        if (plant_.modes) {
            add("mode_count", plant_.modes->modes.size());
            add("event_count", plant_.modes->events.size());
        }
        if (plant_.constraints) {
            add("constraint_count", plant_.constraints->list.size());
            if (plant_.constraints->choice) add("constraint_rank", plant_.constraints->choice->rank);
        }
        if (plant_.series) add("series_rows", plant_.series->rows);
        return text;
    }

    std::string pattern(const PlantPattern& p, char letter) const {
        if (!p.is_sparse) return {};
        return fmt::format("/// df/d{}: entries that are not zero for every motion, in compressed columns (CSC).\n", letter) +
               number_table(fmt::format("jacobian_{}_column_starts", letter), p.column_starts) +
               number_table(fmt::format("jacobian_{}_row_indices", letter), p.row_indices);
    }

    std::string modes(const PlantModes& m) const {
        std::vector<std::string> identifiers, event_names, mode_names;
        std::vector<bool> at_once, at_start;
        for (const std::string& mode : m.modes) mode_names.push_back(cpp_string(mode));
        for (const PlantEvent& event : m.events) {
            identifiers.push_back(event.identifier);
            event_names.push_back(cpp_string(event.name));
            at_once.push_back(event.at_once);
            at_start.push_back(event.at_start);
        }
        std::string text = "/// The modes of the machine.\n" + index_list("m", numbered(m.modes), name_ + "_mode") +
                           table("char* const", "mode_table", mode_names);
        text += "/// Events: each happens where its guard falls through zero, and changes the mode or the state.\n" +
                index_list("e", numbered(identifiers)) + table("char* const", "event_table", event_names);
        text += fmt::format(
            "/// Modes in order of preference.\ntypedef struct {0}_modes {{\n    {0}_mode modes[{1}];\n    size_t count;\n}} {0}_modes;\n\n"
            "/// For each event in each mode: whether the mode watches it, and the modes that may follow: `next` after one event, `beside` "
            "if\n"
            "/// its reset drives other parts out of their modes, `rest` after infinitely many. None: the run ends.\n"
            "typedef struct {0}_transition {{\n    bool is_watched;\n    {0}_modes next, beside, rest;\n}} {0}_transition;\n\n",
            name_, m.most_modes());
        text += transitions(m);
        if (std::find(at_once.begin(), at_once.end(), true) == at_once.end()) return text;
        return text +
               "/// For each event: whether it happens at once if another event takes its guard below zero, such as friction that cannot "
               "hold "
               "its load.\n" +
               flag_table("at_once", at_once) + "/// For each event: whether a run begins with its reset.\n" +
               flag_table("at_start", at_start);
    }

    std::string transitions(const PlantModes& m) const {
        const std::string head =
            fmt::format("static inline const {0}_transition* {0}_transition_of(size_t event, {0}_mode mode) {{\n", name_);
        if (m.events.empty()) return head + "    (void)event;\n    (void)mode;\n    return NULL;\n}\n\n";
        const auto list = [&](const std::vector<std::size_t>& to) {
            std::vector<std::string> parts;
            for (const std::size_t i : to) parts.push_back(fmt::format("{}_m_{}", name_, m.modes[i]));
            if (parts.empty()) parts.push_back(fmt::format("{}_m_{}", name_, m.modes[0]));
            return fmt::format("{{{{{}}}, {}}}", fmt::join(parts, ", "), to.size());
        };
        std::string rows;
        for (std::size_t e = 0; e < m.events.size(); ++e) {
            rows += fmt::format("        {{  // {}\n", safe_line(m.events[e].name));
            for (const PlantTransition& to : m.transitions[e])
                rows += fmt::format("            {{{}, {}, {}, {}}},\n", to.is_watched, list(to.next), list(to.beside), list(to.rest));
            rows += "        },\n";
        }
        return head +
               fmt::format("    static const {0}_transition table[{1}][{2}] = {{\n{3}    }};\n    return &table[event][mode];\n}}\n\n",
                           name_, m.events.size(), m.modes.size(), rows);
    }

    std::string constraints(const PlantConstraints& c) const {
        std::vector<std::string> identifiers, rows;
        for (const PlantConstraint& one : c.list) {
            identifiers.push_back(one.identifier);
            rows.push_back(
                fmt::format("{{{}, {}, {}, {}}}", cpp_string(one.name), cpp_string(one.unit), cpp_string(one.doc), one.has_position));
        }
        std::string text = fmt::format(
            "/// A constraint: it holds a rate at zero, and the position whose rate it is, if any. Its force acts along the rate: its "
            "power is "
            "force times rate.\n"
            "typedef struct {0}_constraint {{\n    const char* name;\n    const char* unit;  ///< of the position, or of the rate if "
            "there is no position\n"
            "    const char* description;\n    bool has_position;\n}} {0}_constraint;\n\n",
            name_);
        text += index_list("c", numbered(identifiers)) + table(name_ + "_constraint", "constraint_table", rows);
        if (!c.choice) return text;
        return text +
               "/// The constraints that the equations solve for. The other constraints follow from these; their forces are zero.\n" +
               flag_table("can_be_left_out", c.choice->can_be_left_out) + flag_table("solved_for_at_start", c.choice->at_start);
    }

    const Plant& plant_;
    const std::string name_;
};

}  // namespace

std::map<std::string, std::string> c_tables(const Plant& plant, const std::string& name, const Places& states) {
    return Tables(plant, name).run(states);
}

}  // namespace dalembert
