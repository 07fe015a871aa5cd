// SPDX-License-Identifier: GPL-3.0-or-later
#include "scene/choose_fields.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <limits>

#include "elements/conduction.hpp"
#include "elements/heat.hpp"
#include "elements/model.hpp"
#include "elements/sites.hpp"

namespace dalembert {

namespace {

/// A rod or block with more cells is computed in loops.
constexpr int most_written_out = 40;

bool mentions(const Expression& e, const std::string& name) {
    bool found = false;
    for_each(e, [&](const Expression& part) { found = found || (part.kind == Expression::Kind::name && part.name == name); });
    return found;
}

/// T[k], for a name k.
bool is_cell(const Expression& e, const std::string& index) {
    return e.kind == Expression::Kind::name && e.children.size() == 1 && e.children[0]->kind == Expression::Kind::name &&
           e.children[0]->name == index;
}

/// Loops compute no sides that are nodes or radiate, and nothing that depends on more than the cells themselves.
bool may_loop(const Block& block, const Names& names) {
    for (const auto* side : {&block.left, &block.right, &block.bottom, &block.top})
        if (*side && ((*side)->node || (*side)->emissivity)) return false;
    unsigned depends = 0;
    visit(block, [&](const Site& site) { depends |= dependence(*site.expression, names); });
    return (depends & ~(on_parameters | on_time | on_inputs)) == 0;
}

}  // namespace

const Field* summed_cells(const Expression& sum, const Scene& scene) {
    if (sum.kind != Expression::Kind::sum) return nullptr;
    const Field* result = nullptr;
    bool others = false;
    for_each(*sum.children[2], [&](const Expression& e) {
        const bool counts = e.kind == Expression::Kind::name && std::any_of(e.children.begin(), e.children.end(),
                                                                            [&](const auto& index) { return mentions(*index, sum.name); });
        if (!counts) return;
        const auto field = std::find_if(scene.fields.begin(), scene.fields.end(), [&](const Field& f) { return f.states->name == e.name; });
        others = others || !is_cell(e, sum.name) || field == scene.fields.end() || (result != nullptr && result != &*field);
        if (field != scene.fields.end()) result = &*field;
    });
    return others ? nullptr : result;
}

void FieldChoice::find_all(const Names& names) {
    const auto add = [&]<class Body>(const Body& body, bool may_loop, long long columns) {
        const auto& states = static_cast<const State&>(*names.find(body.temperature.name)->item);
        const auto [from, to] = bounds(*states.family, scene_);
        if (body.loops.value_or(may_loop && to - from + 1 > most_written_out) && to > from)
            scene_.fields.push_back({&body, kind_of<Body>.word, &states, from, to,
                                     static_cast<int>(std::clamp<long long>(columns, 1, to - from + 1)), {from, to}});
    };
    for (const auto& member : scene_.rods) add(*member.item, true, std::numeric_limits<int>::max());
    for (const auto& member : scene_.blocks) {
        long long columns = 0;
        for (const BlockPiece& piece : member.item->columns) columns += index_value(*piece.cells, scene_, {});
        add(*member.item, may_loop(*member.item, names), columns);
    }
}

Field* FieldChoice::find(const std::string& name) {
    const auto found = std::find_if(scene_.fields.begin(), scene_.fields.end(),
                                    [&](const Field& f) { return f.states->name == name || f.body->name == name; });
    return found == scene_.fields.end() ? nullptr : &*found;
}

void FieldChoice::tap(const Expression& name) {
    Field* field = find(name.name);
    if (field == nullptr || name.children.size() != 1) return;
    bool counts = false;
    for_each(*name.children[0], [&](const Expression& part) {
        counts = counts || (part.kind == Expression::Kind::name && !scene_.sizes.contains(part.name));
    });
    if (counts)
        throw Failure(Diagnostic{Id::too_large, name.span,
                                 fmt::format("'{}' needs all {} cells of {}, which a loop computes; name single cells", name.written(),
                                             field->to - field->from + 1, field->written())});
    tap(*field, *name.children[0], {});
}

void FieldChoice::tap_output(const Expression& output) {
    std::set<const Expression*> summed;
    for_each(output, [&](const Expression& e) {
        if (e.kind == Expression::Kind::call && e.name == "dot") tap_neighbours(*e.children[0]);
        const Field* field = summed_cells(e, scene_);
        if (field == nullptr) return;
        for_each(*e.children[2], [&](const Expression& part) {
            if (part.name == field->states->name && is_cell(part, e.name)) summed.insert(&part);
        });
    });
    for_each(output, [&](const Expression& e) {
        if (e.kind == Expression::Kind::name && !summed.contains(&e)) tap(e);
    });
}

/// Those of cells that are asked for by their numbers.
void FieldChoice::tap_neighbours(const Expression& rate) {
    for_each(rate, [&](const Expression& e) {
        Field* field = e.kind == Expression::Kind::name && e.children.size() == 1 ? find(e.name) : nullptr;
        if (field == nullptr) return;
        bool is_single = true;
        for_each(*e.children[0], [&](const Expression& part) {
            is_single = is_single && (part.kind != Expression::Kind::name || scene_.sizes.contains(part.name));
        });
        const int cell = is_single ? index_value(*e.children[0], scene_, {}) : field->from;
        for (const int next : {cell - field->columns, cell - 1, cell + 1, cell + field->columns})
            if (next >= field->from && next <= field->to) field->tapped.insert(next);
    });
}

void FieldChoice::tap(Field& field, const Expression& index, const Indices& indices) {
    const int value = index_value(index, scene_, indices);
    if (value < field.from || value > field.to)
        throw Failure(Diagnostic{Id::index_out_of_range, index.span,
                                 fmt::format("{} has the cells {} to {}, but not {}", field.written(), field.from, field.to, value)});
    field.tapped.insert(value);
}

void FieldChoice::tap(const Reference& reference, const Indices& indices) {
    Field* field = reference.index ? find(reference.name) : nullptr;
    if (field != nullptr) tap(*field, *reference.index, indices);
}

void FieldChoice::tap_ends() {
    for (const auto& member : scene_.links) {
        const Indices indices = member.item->family ? Indices{{member.item->family->index, member.index}} : Indices{};
        tap(member.item->from, indices);
        tap(member.item->to, indices);
    }
    for (const auto& member : scene_.enclosures)
        for (const Reference& surface : member.item->surfaces) tap(surface, {});
}

void FieldChoice::tap_plotted(const std::string& name) {
    const std::size_t bracket = name.find('[');
    Field* field = bracket == std::string::npos ? nullptr : find(name.substr(0, bracket));
    if (field == nullptr) return;
    int index = 0;
    const auto [end, error] = std::from_chars(name.data() + bracket + 1, name.data() + name.size(), index);
    if (error == std::errc() && *end == ']' && index >= field->from && index <= field->to) field->tapped.insert(index);
}

}  // namespace dalembert
