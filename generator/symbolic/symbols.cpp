// SPDX-License-Identifier: GPL-3.0-or-later
#include "symbolic/symbols.hpp"
#include "symbolic/parts.hpp"

#include <fmt/format.h>

#include <set>

namespace dalembert {

using GiNaC::ex;
using GiNaC::ex_to;

namespace {

using Kind = Expression::Kind;

/// Whether an expression of parameters is positive for every value in the declared ranges, as far as its form shows.
bool is_positive(const Expression& e, const Names& names) {
    const auto part = [&](std::size_t i) { return is_positive(*e.children[i], names); };
    switch (e.kind) {
        case Kind::number: return cln::plusp(e.value);
        case Kind::name: {
            if (e.name == "pi" || e.name == "stefan_boltzmann") return true;
            const Named* named = names.find(e.name);
            if (named == nullptr) return false;
            if (named->kind == Named::Kind::definition) return is_positive(*named->definition().value, names);
            if (named->kind != Named::Kind::parameter) return false;
            const auto& range = named->quantity().range;
            return range && range->low && is_positive(*range->low, names);
        }
        case Kind::add:
        case Kind::multiply:
        case Kind::divide: return part(0) && part(1);
        case Kind::power: return part(0);
        case Kind::call: return e.name == "exp" || (e.name == "sqrt" && part(0));
        default: return false;
    }
}

bool is_positive(const Quantity& quantity, const Names& names) {
    return quantity.range && quantity.range->low && is_positive(*quantity.range->low, names);
}

/// Of what moves: an assumption of proofs only, which an end of the range at zero does not spoil.
bool stays_positive(const Quantity& quantity, const Names& names) {
    const bool from_zero =
        quantity.range && quantity.range->low && quantity.range->low->kind == Kind::number && is_zero(quantity.range->low->value);
    return from_zero || is_positive(quantity, names);
}

std::string key(SymbolKind kind, const std::string& base, int index) {
    return std::to_string(static_cast<int>(kind)) + ":" + base + ":" + std::to_string(index);
}

}  // namespace

std::string per_second(const Unit& unit, int times) {
    const std::string si = unit.si(), seconds = times == 1 ? "s" : "s^2";
    if (si == "1") return "1/" + seconds;
    return si.find('/') == std::string::npos ? si + "/" + seconds : (unit.dimension / Dimension::time().raised({times, 1})).in_base_units();
}

Symbols::Symbols(const Scene& scene, const Names& names) {
    for (const auto& member : scene.parameters) {
        const Parameter& item = *member.item;
        add(SymbolKind::parameter, member.name(), is_positive(item, names),
            {item.name, member.index, item.family.has_value(), item.unit.si(), item.doc, &item});
    }
    for (const auto& member : scene.definitions) {
        const Definition& item = *member.item;
        add(SymbolKind::definition, member.name(), is_positive(*item.value, names),
            {item.name, member.index, item.family.has_value(), item.unit ? item.unit->si() : "", item.doc});
    }
    add(SymbolKind::time, "t", false, {"t", 0, false, "s", "time"});
    for (const auto& member : scene.inputs) {
        const Input& item = *member.item;
        add(SymbolKind::input, member.name(), stays_positive(item, names),
            {item.name, member.index, item.family.has_value(), item.unit.si(), item.doc, &item});
    }
    for (const auto& member : scene.coordinates) {
        const Coordinate& item = *member.item;
        const bool is_member = item.family.has_value();
        const std::string rate_unit = per_second(item.unit);
        add(SymbolKind::coordinate, member.name(), stays_positive(item, names),
            {item.name, member.index, is_member, item.unit.si(), item.doc, &item});
        add(SymbolKind::velocity, "dot(" + member.name() + ")", false,
            {item.name, member.index, is_member, rate_unit,
             item.quasi_axis ? std::string("angular velocity about the own ") + "xyz"[*item.quasi_axis] + " axis"
                             : "time derivative of " + member.name()});
        add(SymbolKind::acceleration, "ddot(" + member.name() + ")", false, {item.name, member.index, is_member, "", ""});
        if (!scene.modes.empty())
            add(SymbolKind::jerk, "dot(ddot(" + member.name() + "))", false, {item.name, member.index, is_member, "", ""});
    }
    for (const auto& member : scene.states) {
        const State& item = *member.item;
        const bool is_member = item.family.has_value();
        const std::string name = item.root ? "sqrt(" + member.name() + ")" : member.name();
        const std::string unit = item.root ? item.unit.dimension.raised({1, 2}).in_base_units() : item.unit.si();
        add(SymbolKind::state, name, item.root || stays_positive(item, names),
            {item.name, member.index, is_member, unit, item.root && !item.doc.empty() ? "root of: " + item.doc : item.doc, &item,
             item.root});
        add(SymbolKind::state_rate, "dot(" + name + ")", false, {item.name, member.index, is_member, "", "", nullptr, item.root});
    }
    find_attitudes(scene);
    for (const auto& member : scene.constraints) {
        const std::string name = fmt::format("constraint_force[{}]", member.name());
        const bool is_member = member.item->family.has_value();
        add(SymbolKind::multiplier, name, false, {"constraint_force_" + member.item->name, member.index, is_member});
        if (!scene.modes.empty())
            add(SymbolKind::multiplier_rate, "dot(" + name + ")", false,
                {"constraint_force_" + member.item->name, member.index, is_member});
        add(SymbolKind::residual, fmt::format("residual[{}]", member.name()), false,
            {"residual_" + member.item->name, member.index, is_member});
    }
    for (std::size_t i = 0; i < state_count(); ++i)
        add(SymbolKind::costate, fmt::format("costate[{}]", i), false, {"costate", static_cast<int>(i), true});
    for (std::size_t i = 0; i < degrees() + scene.constraints.size(); ++i)
        add(SymbolKind::adjoint, fmt::format("adjoint[{}]", i), false, {"adjoint", static_cast<int>(i), true});
}

void Symbols::find_attitudes(const Scene& scene) {
    std::size_t next = 0;
    for (std::size_t i = 0; i < scene.coordinates.size(); ++i) {
        const Coordinate& item = *scene.coordinates[i].item;
        places_.push_back(item.quasi_axis ? std::nullopt : std::optional(next++));
        if (item.quasi_axis != 0) continue;
        AttitudeSymbols attitude{{i, i + 1, i + 2}, {}};  // made one after the other
        const std::string first = item.name.substr(0, item.name.size() - 1) + "0";
        for (std::size_t part = 0; part < 4; ++part) attitude.parts[part] = find(SymbolKind::state, first, 0)->position + part;
        attitudes_.push_back(attitude);
    }
}

const Symbols::AttitudeSymbols* Symbols::find_attitude(const std::string& name) const {
    const auto found = std::find_if(attitudes_.begin(), attitudes_.end(), [&](const AttitudeSymbols& attitude) {
        return all(SymbolKind::state)[attitude.parts[0]].base == name + "_0";
    });
    return found == attitudes_.end() ? nullptr : &*found;
}

std::size_t Symbols::place(SymbolKind kind, std::size_t position) const {
    if (kind == SymbolKind::coordinate) return places_[position].value();
    return kind == SymbolKind::velocity ? positions() + position : positions() + degrees() + position;
}

std::vector<const Variable*> Symbols::state_variables() const {
    std::vector<const Variable*> result;
    for (const Variable& q : all(SymbolKind::coordinate))
        if (has_value(q.position)) result.push_back(&q);
    for (const SymbolKind kind : {SymbolKind::velocity, SymbolKind::state})
        for (const Variable& variable : all(kind)) result.push_back(&variable);
    return result;
}

/// de = e*(0, axis)/2
ex Symbols::quaternion_slope(const AttitudeSymbols& attitude, std::size_t part, std::size_t axis) const {
    const auto e = [&](std::size_t i) { return get(SymbolKind::state, attitude.parts[i]); };
    const std::size_t w = axis + 1;
    if (part == 0) return -e(w) / 2;
    if (part == w) return e(0) / 2;
    const bool follows = part % 3 + 1 == w;  // (part, w, other) is cyclic
    const std::size_t other = 6 - part - w;
    return follows ? -e(other) / 2 : e(other) / 2;
}

ex Symbols::along(const ex& e, std::size_t coordinate) const {
    if (has_value(coordinate)) return partial(e, get(SymbolKind::coordinate, coordinate));
    for (const AttitudeSymbols& attitude : attitudes_)
        for (std::size_t axis = 0; axis < 3; ++axis) {
            if (attitude.coordinates[axis] != coordinate) continue;
            GiNaC::exvector terms;
            for (std::size_t part = 0; part < 4; ++part) {
                const ex slope = partial(e, get(SymbolKind::state, attitude.parts[part]));
                if (!slope.is_zero()) terms.push_back(slope * quaternion_slope(attitude, part, axis));
            }
            return GiNaC::add(terms);
        }
    return 0;
}

void Symbols::add(SymbolKind kind, const std::string& name, bool positive, Origin origin) {
    auto& list = variables_[static_cast<std::size_t>(kind)];
    const bool is_constant = kind == SymbolKind::parameter || kind == SymbolKind::definition;
    const ex symbol = positive && is_constant ? ex(GiNaC::possymbol(name)) : ex(GiNaC::realsymbol(name));
    by_name_.emplace(name, std::pair(kind, list.size()));
    by_name_.emplace(key(kind, origin.base, origin.index), std::pair(kind, list.size()));
    list.push_back({kind, list.size(), name, std::move(origin.base), origin.index, origin.is_member, std::move(origin.unit),
                    std::move(origin.doc), origin.declared, positive, origin.is_root, symbol});
}

bool Symbols::is_constant(const ex& e) const {
    for (const SymbolKind kind : {SymbolKind::time, SymbolKind::input, SymbolKind::coordinate, SymbolKind::velocity, SymbolKind::state})
        for (const Variable& variable : all(kind))
            if (e.has(variable.symbol)) return false;
    return true;
}

const Variable* Symbols::find(SymbolKind kind, const std::string& base, int index) const {
    const auto found = by_name_.find(key(kind, base, index));
    return found == by_name_.end() ? nullptr : &all(kind)[found->second.second];
}

const Variable* Symbols::find(const ex& symbol) const {
    const auto found = by_name_.find(ex_to<GiNaC::symbol>(symbol).get_name());
    return found == by_name_.end() ? nullptr : &all(found->second.first)[found->second.second];
}

ex Symbols::letter(const std::string& name) {
    add(SymbolKind::letter, name, false, {name});
    return all(SymbolKind::letter).back().symbol;
}

ex Symbols::grid_letter(const std::string& name) {
    add(SymbolKind::grid, name, false, {name});
    return all(SymbolKind::grid).back().symbol;
}

void Symbols::define(std::vector<ex> values) {
    definition_values_ = std::move(values);
    expanded_definitions_ = definition_values_;
    // Definitions may mention each other in any order but without cycles, so as many rounds as there are definitions suffice.
    for (std::size_t round = 0; round < expanded_definitions_.size(); ++round) {
        bool changed = false;
        for (ex& value : expanded_definitions_) {
            GiNaC::exmap map;
            for (std::size_t i = 0; i < definition_values_.size(); ++i)
                if (value.has(get(SymbolKind::definition, i))) map[get(SymbolKind::definition, i)] = definition_values_[i];
            if (map.empty()) continue;
            value = value.subs(map, GiNaC::subs_options::no_pattern);
            changed = true;
        }
        if (!changed) break;
    }
}

double Symbols::size_of(const ex& e, const std::vector<double>& sizes) const {
    double size = 0;
    for (auto part = e.preorder_begin(); part != e.preorder_end(); ++part) {
        const auto inner = GiNaC::is_a<GiNaC::symbol>(*part) ? step_of(*part) : std::nullopt;
        size += inner ? sizes[*inner] : 1;
    }
    return size;
}

ex Symbols::add_step(Step step) {
    step_sizes_.push_back(size_of(step.value, step_sizes_));
    halfway_sizes_.push_back(!step.stays              ? size_of(step.value, halfway_sizes_)
                             : step.instead.is_zero() ? 1
                                                      : size_of(step.instead, halfway_sizes_));
    add(SymbolKind::definition, step.name, step.value.info(GiNaC::info_flags::positive), {step.identifier, 0, false, "", step.doc});
    definition_values_.push_back(step.value);
    steps_.push_back(std::move(step));
    return all(SymbolKind::definition).back().symbol;
}

std::optional<std::size_t> Symbols::step_of(const ex& symbol) const {
    if (steps_.empty()) return std::nullopt;
    const Variable* variable = find(symbol);
    const bool is_step = variable != nullptr && variable->kind == SymbolKind::definition && variable->position >= model_definitions();
    return is_step ? std::optional(variable->position - model_definitions()) : std::nullopt;
}

std::vector<std::size_t> Symbols::steps_in(const ex& e) const {
    std::vector<std::size_t> result;
    std::set<std::size_t> seen;
    const std::function<void(const ex&)> visit = [&](const ex& whole) {
        if (steps_.empty()) return;
        each_part_once(whole, [&](const ex& part) {
            const auto step = GiNaC::is_a<GiNaC::symbol>(part) ? step_of(part) : std::nullopt;
            if (!step || !seen.insert(*step).second) return;
            visit(steps_[*step].value);
            result.push_back(model_definitions() + *step);
        });
    };
    visit(e);
    return result;
}

/// A step written out. The number of parts of steps made of steps grows exponentially.
ex Symbols::written_out(std::size_t step, Depth depth) const {
    if (const auto known = written_out_.find({step, depth}); known != written_out_.end()) return known->second;
    const Step& s = steps_[step];
    const bool is_halfway = depth == Depth::halfway;
    const double size = is_halfway ? halfway_sizes_[step] : step_sizes_[step];
    const double largest = depth == Depth::shallow ? 100 : is_halfway ? 20'000 : 2'000;
    ex value = s.value;
    if (size > largest || (is_halfway && s.stays && s.instead.is_zero())) value = get(SymbolKind::definition, model_definitions() + step);
    else value = without_definitions(is_halfway && s.stays ? s.instead : s.value, depth);
    return written_out_[{step, depth}] = value;
}

ex Symbols::without_model_definitions(const ex& e) const {
    if (expanded_definitions_.empty()) return e;
    GiNaC::exmap map;
    for (std::size_t i = 0; i < expanded_definitions_.size(); ++i) map[get(SymbolKind::definition, i)] = expanded_definitions_[i];
    return WithLetters(std::move(map))(e);
}

ex Symbols::without_definitions(const ex& e, Depth depth) const {
    if (steps_.empty()) return without_model_definitions(e);
    GiNaC::exmap map;
    for (std::size_t i = 0; i < expanded_definitions_.size(); ++i) map[get(SymbolKind::definition, i)] = expanded_definitions_[i];
    each_part_once(e, [&](const ex& part) {
        if (const auto step = GiNaC::is_a<GiNaC::symbol>(part) ? step_of(part) : std::nullopt) map[part] = written_out(*step, depth);
    });
    return WithLetters(std::move(map))(e);
}

ex Symbols::time_derivative(const ex& e) const {
    return directional_derivative(e, [this](const ex& symbol) { return rate_of(symbol); });
}

ex Symbols::time_derivative_of_kept(const ex& e) const {
    return directional_derivative_of_kept(e, [this](const ex& symbol) { return rate_of(symbol); });
}

ex Symbols::rate_of(const ex& symbol) const {
    const Variable* variable = find(symbol);
    if (variable == nullptr) return 0;
    switch (variable->kind) {
        case SymbolKind::time: return 1;
        case SymbolKind::coordinate: return get(SymbolKind::velocity, variable->position);
        case SymbolKind::velocity: return get(SymbolKind::acceleration, variable->position);
        case SymbolKind::state: {
            for (const AttitudeSymbols& attitude : attitudes_) {
                if (variable->position < attitude.parts[0] || variable->position > attitude.parts[3]) continue;
                ex rate = 0;
                for (std::size_t axis = 0; axis < 3; ++axis)
                    rate += quaternion_slope(attitude, variable->position - attitude.parts[0], axis) *
                            get(SymbolKind::velocity, attitude.coordinates[axis]);
                return rate;
            }
            return get(SymbolKind::state_rate, variable->position);
        }
        case SymbolKind::acceleration: return count(SymbolKind::jerk) == 0 ? ex(0) : get(SymbolKind::jerk, variable->position);
        case SymbolKind::multiplier:
            return count(SymbolKind::multiplier_rate) == 0 ? ex(0) : get(SymbolKind::multiplier_rate, variable->position);
        default: return 0;
    }
}

/// Of a step. Steps stay letters in it.
ex Symbols::slope(std::size_t step, std::size_t parameter) const {
    if (const auto known = slopes_.find({step, parameter}); known != slopes_.end()) return known->second;
    const Step& s = steps_[step];
    return slopes_[{step, parameter}] = s.slope ? s.slope(*this, parameter) : derivative_by_parameter(s.value, parameter);
}

ex Symbols::derivative_by_parameter(const ex& e, std::size_t parameter) const {
    const ex& p = get(SymbolKind::parameter, parameter);
    GiNaC::exvector terms{directional_derivative(e, [&](const ex& symbol) -> ex {
        if (symbol.is_equal(p)) return 1;
        const auto step = step_of(symbol);
        return step ? slope(*step, parameter) : ex(0);
    })};
    for (std::size_t i = 0; i < model_definitions(); ++i) {
        const ex inner = partial(expanded_definitions_[i], p);
        if (inner.is_zero()) continue;
        const ex outer = partial(e, get(SymbolKind::definition, i));
        if (!outer.is_zero()) terms.push_back(outer * inner);
    }
    return GiNaC::add(terms);
}

}  // namespace dalembert
