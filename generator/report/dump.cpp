// SPDX-License-Identifier: GPL-3.0-or-later
#include "report/dump.hpp"

#include <fmt/format.h>

#include "elements/every_kind.hpp"
#include "emit/equations.hpp"

namespace dalembert {

namespace {

std::string dumped(const Atoms& atoms) {
    std::string text;
    for (Letter letter = 0; letter < atoms.size(); ++letter)
        text += fmt::format("{:>4} {:<7} {} {}\n", letter, name_of(atoms[letter].op), atoms[letter].is_dynamic ? "moves" : "fixed",
                            atoms[letter].variable != nullptr ? atoms[letter].variable->name : atoms[letter].key);
    return text;
}

std::string dumped(const Scene& scene) {
    std::string text = fmt::format("scene {}\n", scene.name);
    const auto name = []<class T>(const T& member) {
        if constexpr (requires { member.name(); }) return member.name();
        else if constexpr (requires { member->name; }) return member->name;
        else return member.name;
    };
    for_each_kind(scene, [&]<class Items>(const char* title, const Items& items) {
        if constexpr (std::is_pointer_v<Items>) {  // gravity
            if (items != nullptr) text += fmt::format("{}\n", title);
        } else if constexpr (requires { items.begin()->first; }) {  // sizes
            for (const auto& [size, value] : items) text += fmt::format("{}: {} = {}\n", title, size, value);
        } else if (!items.empty()) {
            text += fmt::format("{}:", title);
            for (const auto& member : items) text += " " + name(member);
            text += "\n";
        }
    });
    return text;
}

}  // namespace

std::string dumped(const Machine& machine, const std::string& stage, const Header& header) {
    if (stage == "equations") return equations_as_text(*machine.system);
    if (stage == "code") return header.text;
    return stage == "atoms" ? dumped(machine.code->atoms) : dumped(machine.system->scene);
}

}  // namespace dalembert
