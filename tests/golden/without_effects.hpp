// SPDX-License-Identifier: GPL-3.0-or-later
// A model file as it would be if what a scene leaves out had never been written. Works on the text alone and shares nothing with the
// program: lines, brackets and quotes are all that it knows of TOML.
#pragma once

#include <algorithm>
#include <cctype>
#include <map>
#include <set>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

namespace golden {

class TextModel {
public:
    explicit TextModel(const std::string& text) {
        std::istringstream lines(text);
        std::string line;
        while (std::getline(lines, line)) {
            if (line.empty() || line[0] == '#') continue;
            if (line[0] == '[') start_section(line);
            else if (!items_.empty() && items_.back().open > 0) append(line);
            else if (is_list(section_)) add({section_, word(line), "", 0, false}, line);
            else if (items_.empty() || items_.back().section != section_ || items_.back().name != name_)
                add({section_, name_, "", 0, is_table_}, line);
            else append(line);
        }
        for (const Item& item : items_) {
            if (item.section == "effects") implies_[item.name] = strings(item.text, "implies");
            if (item.section == "scenes" && item.name != "default")
                scenes_[item.name] = strings(item.text, place_of(item.text, "effects") == std::string::npos ? item.name : "effects");
        }
    }

    std::vector<std::string> scenes() const {
        std::vector<std::string> names;
        for (const auto& [name, effects] : scenes_) names.push_back(name);
        if (names.empty()) names.emplace_back("full");
        return names;
    }

    bool leaves_out_anything() const { return !implies_.empty(); }

    std::string without(const std::string& scene) const {
        const std::set<std::string> effects = effects_of(scene);
        // Modes of groups that are left out are no modes any more.
        no_modes_.clear();
        for (const Item& item : items_) {
            const std::string when = value(item.text, "when");
            if (item.section != "modes" || when.empty() || left_of(when, effects) != "no") continue;
            for (const std::string& mode : strings(item.text, "modes")) no_modes_.insert(mode);
        }
        std::vector<Item> kept;
        std::set<std::string> gone;
        for (Item item : items_) {
            // A view changes nothing of the machine.
            if (item.section == "effects" || item.section == "scenes" || item.section == "printed" || item.section == "view") continue;
            const std::string when = value(item.text, "when");
            const bool is_other_run = item.section == "runs" && !value(item.text, "scene").empty() && value(item.text, "scene") != scene;
            const std::string left = when.empty() ? "yes" : left_of(when, effects);
            if (is_other_run || left == "no") {
                gone.insert(item.name);
                continue;
            }
            if (left == "yes") remove_key(item.text, "when");
            else item.text.replace(item.text.find('"' + when + '"'), when.size() + 2, '"' + left + '"');
            if (item.section == "runs") remove_key(item.text, "scene");
            kept.push_back(std::move(item));
        }
        // A volume or node of which the temperature was left out has none; the energy of such a volume is not balanced.
        for (Item& item : kept) {
            const std::string temperature = value(item.text, "temperature");
            if (!gone.contains(temperature.substr(0, temperature.find('[')))) continue;
            remove_key(item.text, "temperature");
            remove_key(item.text, item.section == "volumes" ? "heat" : "capacity");
        }
        // What only those read that are left out would not have been written.
        const std::set<std::string> were_read = names_read(items_, false), are_read = names_read(kept, true);
        std::erase_if(kept, [&](const Item& item) {
            const bool is_data = item.section == "parameters" || item.section == "inputs";
            const bool is_unread =
                !are_read.contains(item.name) && (item.section == "definitions" || (is_data && were_read.contains(item.name)));
            if (is_unread) gone.insert(item.name);
            return is_unread;
        });
        std::string text;
        std::string header;
        for (Item& item : kept) {
            // Runs speak of what only some scenes have. Of plots nothing is generated.
            if (item.section == "runs")
                for (const char* key : {"inputs", "start", "parameters"})
                    for (const std::string& name : gone) remove_from(item.text, key, name);
            if (item.section == "runs") remove_key(item.text, "plots");
            const std::string own = item.is_table ? "[" + item.section + "." + item.name + "]" : "[" + item.section + "]";
            if (own != header || item.is_table) text += own + "\n";
            header = own;
            text += item.text;
        }
        return scenes_.empty() ? text : text + "[scenes]\n" + scene + " = { effects = [] }\n";
    }

private:
    /// What stands in a section under one name: a line, or a table of its own.
    struct Item {
        std::string section, name, text;
        int open;       ///< brackets that are not closed yet
        bool is_table;  ///< [section.name]
    };

    static bool is_list(const std::string& section) {
        static const std::set<std::string> lists{
            "sizes", "parameters", "definitions", "coordinates", "inputs", "states", "outputs", "nodes", "links", "effects",
            "scenes", "springs", "dampers", "forces", "torques", "kinetic", "potentials", "generalised_forces", "flows",
            "reservoirs", "volumes", "pins", "branches", "frictions", "stops", "contacts", "saturations", "modes",
            "constraints", "events"};
        return lists.contains(section);
    }

    /// Names in expressions: words between quotes, but not in descriptions and units.
    static std::set<std::string> names_in(const Item& item) {
        std::set<std::string> names;
        std::size_t end = 0;
        for (std::size_t begin; (begin = item.text.find('"', end)) != std::string::npos; end = end + 1) {
            end = item.text.find('"', begin + 1);
            if (end == std::string::npos) break;
            const std::size_t key = item.text.find_last_not_of(" =", begin == 0 ? 0 : begin - 1);
            const auto is_of = [&](const std::string& word) {
                return key != std::string::npos && key + 1 >= word.size() &&
                       item.text.compare(key + 1 - word.size(), word.size(), word) == 0;
            };
            if (is_of("doc") || is_of("unit")) continue;
            std::string name;
            for (std::size_t i = begin + 1; i <= end; ++i) {
                if (std::isalnum(static_cast<unsigned char>(item.text[i])) || item.text[i] == '_') name += item.text[i];
                else names.insert(std::exchange(name, ""));
            }
        }
        return names;
    }

    /// What the machine reads. Definitions read for those who read them; printed equations are no part of the machine,
    /// and runs ask for what they read where it is there.
    static std::set<std::string> names_read(const std::vector<Item>& items, bool with_runs) {
        std::set<std::string> read;
        std::vector<std::string> pending;
        const auto note = [&](const Item& item) {
            for (const std::string& name : names_in(item))
                if (read.insert(name).second) pending.push_back(name);
        };
        static const std::set<std::string> silent{"definitions", "printed", "effects", "scenes"};
        for (const Item& item : items)
            if (!silent.contains(item.section) && (with_runs || item.section != "runs")) note(item);
        while (!pending.empty()) {
            const std::string name = pending.back();
            pending.pop_back();
            for (const Item& item : items)
                if (item.section == "definitions" && item.name == name) note(item);
        }
        return read;
    }

    static std::string word(const std::string& line) { return line.substr(0, line.find_first_of(" =")); }

    /// Brackets outside of quotes and comments.
    static int opened(const std::string& line) {
        int open = 0;
        bool quoted = false;
        for (const char c : line) {
            if (c == '"') quoted = !quoted;
            if (quoted) continue;
            if (c == '#') break;
            open += c == '[' || c == '{' ? 1 : c == ']' || c == '}' ? -1 : 0;
        }
        return open;
    }

    void start_section(const std::string& line) {
        const std::string inside = line.substr(1, line.find(']') - 1);
        const std::size_t dot = inside.find('.');
        section_ = inside.substr(0, dot);
        name_ = dot == std::string::npos ? "" : inside.substr(dot + 1);
        // A table of its own in a list, as in [nodes.plate].
        is_table_ = dot != std::string::npos;
        if (is_table_) add({section_, name_, "", 0, true}, "");
    }

    void add(Item item, const std::string& line) {
        // In a section [list.name] the lines belong to the item that the section began.
        if (is_table_ && !items_.empty() && items_.back().section == section_ && items_.back().name == name_ && !line.empty())
            return append(line);
        items_.push_back(std::move(item));
        if (!line.empty()) append(line);
    }

    void append(const std::string& line) {
        items_.back().text += line + "\n";
        items_.back().open += opened(line);
    }

    std::set<std::string> effects_of(const std::string& scene) const {
        std::vector<std::string> pending;
        if (const auto found = scenes_.find(scene); found != scenes_.end()) pending = found->second;
        else
            for (const auto& [name, implied] : implies_) pending.push_back(name);
        std::set<std::string> effects;
        while (!pending.empty()) {
            const std::string name = pending.back();
            pending.pop_back();
            if (!effects.insert(name).second) continue;
            for (const std::string& implied : implies_.at(name)) pending.push_back(implied);
        }
        return effects;
    }

    /// Where a key stands as a word of its own, outside of quotes.
    static std::size_t place_of(const std::string& text, const std::string& key) {
        bool quoted = false;
        for (std::size_t i = 0; i + key.size() < text.size(); ++i) {
            if (text[i] == '"') quoted = !quoted;
            if (quoted || text.compare(i, key.size(), key) != 0) continue;
            const bool starts = i == 0 || std::string(" ,{\n").find(text[i - 1]) != std::string::npos;
            const std::size_t after = text.find_first_not_of(' ', i + key.size());
            if (starts && after != std::string::npos && text[after] == '=') return i;
        }
        return std::string::npos;
    }

    /// The text in quotes behind "key =".
    static std::string value(const std::string& text, const std::string& key) {
        const std::size_t place = place_of(text, key);
        if (place == std::string::npos) return "";
        const std::size_t first = text.find('"', place);
        return text.substr(first + 1, text.find('"', first + 1) - first - 1);
    }

    static std::vector<std::string> strings(const std::string& text, const std::string& key) {
        std::vector<std::string> result;
        const std::size_t place = place_of(text, key);
        if (place == std::string::npos) return result;
        const std::size_t end = text.find(']', place);
        for (std::size_t quote = text.find('"', place); quote < end; quote = text.find('"', quote + 1)) {
            const std::size_t close = text.find('"', quote + 1);
            result.push_back(text.substr(quote + 1, close - quote - 1));
            quote = close;
        }
        return result;
    }

    /// Where the value that begins behind `from` ends: at a comma, a closing bracket or the end of a line that nothing encloses.
    static std::size_t end_of_value(const std::string& text, std::size_t from) {
        int open = 0;
        bool quoted = false;
        for (std::size_t i = from; i < text.size(); ++i) {
            if (text[i] == '"') quoted = !quoted;
            if (quoted) continue;
            if (open == 0 && (text[i] == ',' || text[i] == '\n' || text[i] == '}')) return i;
            open += text[i] == '[' || text[i] == '{' ? 1 : text[i] == ']' || text[i] == '}' ? -1 : 0;
        }
        return text.size();
    }

    static void remove_key(std::string& text, const std::string& key) {
        const std::size_t place = place_of(text, key);
        if (place == std::string::npos) return;
        std::size_t end = end_of_value(text, text.find('=', place) + 1);
        std::size_t begin = place;
        if (end < text.size() && (text[end] == ',' || text[end] == '\n')) ++end;
        else begin = std::min(begin, text.find_last_of(",{", place) + (text[text.find_last_of(",{", place)] == '{' ? 1 : 0));
        text.erase(begin, end - begin);
    }

    /// A key of the table behind another key.
    static void remove_from(std::string& text, const std::string& table, const std::string& key) {
        const std::size_t place = place_of(text, table);
        if (place == std::string::npos) return;
        const std::size_t begin = text.find('=', place) + 1;
        const std::size_t end = end_of_value(text, begin);
        std::string inside = text.substr(begin, end - begin);
        remove_key(inside, key);
        text.replace(begin, end - begin, inside);
    }

    /// What is left of a condition when effects are there or not: "yes", "no", or words about modes.
    std::string left_of(const std::string& condition, const std::set<std::string>& effects) const {
        std::string spaced;
        for (const char c : condition) spaced += c == '(' || c == ')' ? std::string(" ") + c + " " : std::string(1, c);
        std::istringstream words(spaced);
        std::vector<std::string> list;
        for (std::string w; words >> w;) list.push_back(w);
        std::size_t at = 0;
        return any(list, at, effects);
    }
    /// "a and not b or (c)": or binds least.
    std::string any(const std::vector<std::string>& w, std::size_t& at, const std::set<std::string>& effects) const {
        std::string result = all(w, at, effects);
        while (at < w.size() && w[at] == "or") result = joined(result, "or", all(w, ++at, effects), "no", "yes");
        return result;
    }
    std::string all(const std::vector<std::string>& w, std::size_t& at, const std::set<std::string>& effects) const {
        std::string result = one(w, at, effects);
        while (at < w.size() && w[at] == "and") result = joined(result, "and", one(w, ++at, effects), "yes", "no");
        return result;
    }
    std::string one(const std::vector<std::string>& w, std::size_t& at, const std::set<std::string>& effects) const {
        const std::string word = w.at(at++);
        if (word == "not") {
            const std::string inside = one(w, at, effects);
            return inside == "yes" ? "no" : inside == "no" ? "yes" : "not (" + inside + ")";
        }
        if (word != "(") return effects.contains(word) ? "yes" : implies_.contains(word) || no_modes_.contains(word) ? "no" : word;
        const std::string result = any(w, at, effects);
        ++at;
        return result;
    }
    static std::string joined(const std::string& a, const std::string& word, const std::string& b, const std::string& neutral,
                              const std::string& deciding) {
        if (a == deciding || b == deciding) return deciding;
        if (a == neutral) return b;
        return b == neutral ? a : "(" + a + ") " + word + " (" + b + ")";
    }

    std::string section_, name_;
    bool is_table_ = false;
    std::vector<Item> items_;
    mutable std::set<std::string> no_modes_;
    std::map<std::string, std::vector<std::string>> implies_, scenes_;
};

}  // namespace golden
