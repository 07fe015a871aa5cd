// SPDX-License-Identifier: GPL-3.0-or-later
#include "program/shared_members.hpp"

#include <algorithm>
#include <stdexcept>

#include "graph/notation.hpp"
#include "graph/raise.hpp"

namespace dalembert {

SharedMembers::SharedMembers(std::vector<const Code*> modes) : modes_(std::move(modes)) {
    const Symbols& first = modes_.front()->system.symbols;
    for (std::size_t i = first.model_definitions(); i < first.count(SymbolKind::definition); ++i) only_in_update_.insert(i);
    std::map<std::string, std::size_t> numbers;
    std::size_t count = 0;
    for (const Code* code : modes_) {
        std::set<std::uint32_t> used;
        std::vector<const FunctionCode*> functions;
        for (const FunctionCode& f : code->functions) functions.push_back(&f);
        if (code->series_of) functions.push_back(&*code->series_of);
        for (const FunctionCode* f : functions)
            for (const NodeId id : f->program.in_order(f->roots())) {
                const Node& node = f->program[id];
                if (node.kind == Node::Kind::cached) used.insert(node.index);
                const Variable* variable = node.kind == Node::Kind::symbol ? code->atoms[node.index].variable : nullptr;
                const bool is_definition = variable != nullptr && variable->kind == SymbolKind::definition;
                if (is_definition && f != &(*code)[Function::update]) only_in_update_.erase(variable->position);
            }
        const Notation write(code->system.symbols, Style::text);
        const CachedMeaning meaning = cached_meaning(*code);
        for (const std::uint32_t index : used) {
            if (modes_.size() == 1) {
                cached_[code].emplace(index, count++);
                continue;
            }
            const auto [known, is_new] = numbers.emplace(write(meaning(index)), count);
            if (is_new) ++count;
            cached_[code].emplace(index, known->second);
        }
        cached_[code];
    }
    for (const By by : {By::state, By::input, By::parameter, By::time}) layouts_.emplace_back(modes_, jacobian_by(by), by);
}

bool SharedMembers::has(const HeaderFunction& function) const {
    using In = HeaderFunction::In;
    if (function.in == In::none || !is_made(function, modes_.front()->system, modes_.front()->wished)) return false;
    if (function.in == In::switching) return has_modes();
    return function.in != In::constrained || has_projection();
}

bool SharedMembers::has_projection() const {
    return !modes_.front()->system.symbols.attitudes().empty() ||
           std::any_of(modes_.begin(), modes_.end(), [](const Code* code) { return code->system.needs_projection(); });
}

}  // namespace dalembert
