// SPDX-License-Identifier: GPL-3.0-or-later
// What is asked of the code of a function that is made already.
#include "graph/code.hpp"

namespace dalembert {

std::vector<NodeId> FunctionCode::roots() const {
    std::vector<NodeId> all;
    const auto take = [&](const std::vector<NodeId>& part) { all.insert(all.end(), part.begin(), part.end()); };
    if (by_loops) {
        take(mass);
        take(force);
        take(right.entries);
    } else if (whole_output.entries.empty()) {
        take(accelerations);
        take(solved.entries);
    }
    take(results);
    if (second) return results;
    if (loop) take(loop->results);
    take(whole_output.entries);
    if (!whole_output.entries.empty()) return all;
    take(below.entries);
    take(by_output.entries);
    take(by_acceleration.entries);
    return all;
}

void FunctionCode::note_letters(const Atoms& atoms) {
    for (const NodeId id : program.in_order(roots())) {
        const Variable* variable = program[id].kind == Node::Kind::symbol ? atoms[program[id].index].variable : nullptr;
        uses_accelerations = uses_accelerations || (variable != nullptr && variable->kind == SymbolKind::acceleration);
        uses_jerks = uses_jerks || (variable != nullptr && variable->kind == SymbolKind::jerk);
    }
}

std::vector<bool> FunctionCode::varying() const {
    std::vector<bool> result(program.size(), false);
    if (!loop) return result;
    for (const NodeId id : program.in_order(loop->results)) {
        const Node& node = program[id];
        result[id] = node.kind == Node::Kind::function && node.op == Op::in_column;
        for (const NodeId argument : node.arguments) result[id] = result[id] || result[argument];
    }
    return result;
}

OperationCount Code::count(Function f) const {
    const FunctionCode& code = (*this)[f];
    return passes.reciprocals ? code.program.count(code.roots()) : code.program.count_divided(code.roots());
}

}  // namespace dalembert
