// SPDX-License-Identifier: GPL-3.0-or-later
// Whole numbers of a scene: indices of members and bounds of families.
#include <fmt/format.h>

#include <algorithm>

#include "elements/model.hpp"
#include "scene/scene.hpp"
#include "language/sum_terms.hpp"
#include "text/budgets.hpp"
#include "text/diagnostic.hpp"

namespace dalembert {

namespace {

[[noreturn]] void not_whole(const Expression& e) {
    throw Failure(Diagnostic{Id::index_out_of_range, e.span, fmt::format("'{}' is not a whole number", e.written())});
}

}  // namespace

int index_value(const Expression& e, const Scene& scene, const Indices& indices) {
    const auto value = [&](const auto& self, const Expression& part) -> Rational {
        const auto child = [&](std::size_t i) { return self(self, *part.children[i]); };
        if (part.kind == Expression::Kind::number) return part.value;
        if (part.kind == Expression::Kind::name) {
            if (const auto index = indices.find(part.name); index != indices.end()) return index->second;
            if (const auto size = scene.sizes.find(part.name); size != scene.sizes.end()) return size->second;
        }
        switch (part.kind) {
            case Expression::Kind::negate: return -child(0);
            case Expression::Kind::add: return child(0) + child(1);
            case Expression::Kind::subtract: return child(0) - child(1);
            case Expression::Kind::multiply: return child(0) * child(1);
            case Expression::Kind::divide:
                if (const Rational divisor = child(1); !is_zero(divisor)) return child(0) / divisor;
                break;
            default: break;
        }
        not_whole(e);
    };
    const auto result = to_int(value(value, e));
    if (!result) not_whole(e);
    return *result;
}

std::pair<int, int> bounds(const Family& family, const Scene& scene) {
    const int from = index_value(*family.from, scene, {});
    const int to = index_value(*family.to, scene, {});
    if (static_cast<long long>(to) - from >= budget::sum_terms)
        throw Failure(Diagnostic{Id::too_large, family.span, fmt::format("the family has more than {} members", budget::sum_terms)});
    return {from, to};
}

void SumTerms::add(const Expression& sum, int from, int to) {
    const long long terms = static_cast<long long>(to) - from + 1;
    if (terms > budget::sum_terms)
        throw Failure(Diagnostic{Id::too_large, sum.span, fmt::format("the sum has more than {} terms", budget::sum_terms)});
    all_ += std::max(terms, 0LL);
    if (all_ > budget::all_sum_terms)
        throw Failure(Diagnostic{Id::too_large, sum.span,
                                 fmt::format("with the sums around it, the sum has more than {} terms in all", budget::all_sum_terms)});
}

const ExpressionPtr& value_of(const Member<Parameter>& member, const Scene& scene) {
    const Parameter& parameter = *member.item;
    if (const auto fixed = scene.fixed.find(parameter.name); fixed != scene.fixed.end() && fixed->second) return fixed->second;
    return value_of_member(parameter.values, "value", kind_of<Parameter>.word, parameter, member.index, scene);
}

int index_in_list(const RunEntry::OfList& place, const Span& list, const std::string& what, const Item& item, const Scene& scene) {
    const auto [from, to] = item.family ? bounds(*item.family, scene) : std::pair(0, 0);
    const auto members = static_cast<std::size_t>(std::max(0, to - from + 1));
    if (place.count == members) return from + static_cast<int>(place.place);
    const std::string has = fmt::format("{} is a list of {} value{}", what, place.count, place.count == 1 ? "" : "s");
    if (!item.family)
        throw Failure(Diagnostic{Id::wrong_arguments, list, fmt::format("{}, but '{}' is no family and takes one", has, item.name)});
    std::string named = members > 0 ? fmt::format(", {}[{}]", item.name, from) : "";
    if (members > 1) named += fmt::format(" to {}[{}]", item.name, to);
    throw Failure(Diagnostic{Id::wrong_arguments,
                             list,
                             fmt::format("{}, but the family has {} member{}{}", has, members, members == 1 ? "" : "s", named),
                             {{item.span, "the family is declared here"}}});
}

const ExpressionPtr& value_of_member(const MemberValues& values, const char* key, const char* kind, const Item& item, int index,
                                     const Scene& scene) {
    static const ExpressionPtr none;
    if (values.empty()) return none;
    if (!values.is_list) return values.front();
    const std::string what = fmt::format("the {} of {} '{}'", key, kind, item.name);
    const int first = index_in_list({0, values.size()}, values.span, what, item, scene);
    return values[static_cast<std::size_t>(index - first)];
}

std::vector<Member<Parameter>> members_of(const Parameter& parameter, const Scene& scene) {
    if (!parameter.family) return {{&parameter}};
    std::vector<Member<Parameter>> members;
    const auto [from, to] = bounds(*parameter.family, scene);
    for (int index = from; index <= to; ++index) members.push_back({&parameter, index});
    return members;
}

}  // namespace dalembert
