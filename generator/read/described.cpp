// SPDX-License-Identifier: GPL-3.0-or-later
#include "read/described.hpp"

namespace dalembert {

void KeyRules::check(const char* name, const Key& key) const {
    if (!e_.has(name)) return;
    for (const KeyRule& rule : key.needs)
        if (!e_.has(rule.key)) e_.error(Id::missing_key, e_.span_of(name), fmt::format("{} {}", owner_, rule.sentence));
    for (const KeyRule& rule : key.excludes)
        if (e_.has(rule.key))
            e_.error(rule.id, e_.span_of(name), fmt::format("{} {}", owner_, rule.sentence),
                     {{e_.span_of(rule.key), fmt::format("'{}' stands here", rule.key)}});
}

void KeyRules::either(const char* one, const char* other, const char* words) const {
    if (e_.has(one) != e_.has(other)) return;
    const std::string message = fmt::format("{} needs either {}, and not both", owner_, words);
    if (e_.has(one)) e_.error(Id::doubly_defined, e_.span_of(other), message, {{e_.span_of(one), fmt::format("'{}' stands here", one)}});
    else e_.error(Id::missing_key, e_.span(), message);
}

void KeyRules::chosen_keys(const std::string& useless, const std::string& fact, const std::vector<const char*>& needs,
                           const std::vector<const char*>& takes, const std::vector<const char*>& all) const {
    for (const char* key : needs)
        if (!e_.has(key)) e_.error(Id::missing_key, e_.span(), fmt::format("{} and needs the key '{}'", fact, key));
    std::vector<std::string_view> known(needs.begin(), needs.end());
    known.insert(known.end(), takes.begin(), takes.end());
    for (const std::string_view key : all) {
        if (!e_.has(key) || std::find(known.begin(), known.end(), key) != known.end()) continue;
        e_.error(Id::unknown_key, e_.span_of(key), fmt::format("{} '{}'", useless, key));
        known.push_back(key);  // said once
    }
}

void KeyRules::unknown_choice(const char* name, const Key& key, const std::string& word, const std::vector<std::string>& known) const {
    const std::string words = words_of(name, key);
    const bool is_vowel = std::string_view("aeiou").find(words.front()) != std::string_view::npos;
    e_.error(Id::wrong_type, e_.span_of(name),
             fmt::format("'{}' is not {} {} of {}; the {}s are {}{}", word, is_vowel ? "an" : "a", words, owner_, words, quoted_list(known),
                         did_you_mean(word, known)));
}

void KeyRules::law_of(const std::optional<Property>& property, const char* name, const Key& key) const {
    if (!property || property->variables.empty() || property->variables.size() == key.variables.size()) return;
    const bool is_of_one = key.variables.size() == 1;
    e_.error(Id::wrong_type, property->span,
             fmt::format("the {} of {} may be a law of {}, as in \"{} -> ...\", not of {}", words_of(name, key), owner_,
                         is_of_one ? "one variable" : "two variables",
                         is_of_one                      ? "T"
                         : key.type == ValueType::field ? "(x, y)"
                                                        : "(p, T)",
                         is_of_one ? "two" : "one"));
}

}  // namespace dalembert
