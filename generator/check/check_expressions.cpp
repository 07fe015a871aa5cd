// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <map>
#include <set>

#include "check/checks.hpp"
#include "language/vocabulary.hpp"
#include "text/nearest.hpp"

namespace dalembert {

namespace {

/// How functions of other languages are written here; empty for what none has.
std::string foreign_function(std::string_view name) {
    static const std::map<std::string_view, const char*> usual{{"ln", "log(x)"},
                                                               {"lg", "log(x)/log(10)"},
                                                               {"log10", "log(x)/log(10)"},
                                                               {"log2", "log(x)/log(2)"},
                                                               {"arcsin", "asin(x)"},
                                                               {"arccos", "acos(x)"},
                                                               {"arctan", "atan(x)"},
                                                               {"arctan2", "atan2(y, x)"},
                                                               {"tg", "tan(x)"},
                                                               {"cot", "1/tan(x)"},
                                                               {"fabs", "abs(x)"},
                                                               {"sgn", "sign(x)"},
                                                               {"signum", "sign(x)"},
                                                               {"pow", "x^y"},
                                                               {"sqr", "x^2"},
                                                               {"square", "x^2"},
                                                               {"cbrt", "x^(1/3)"},
                                                               {"root", "x^(1/n)"},
                                                               {"der", "dot(x)"}};
    const auto found = usual.find(name);
    return found == usual.end() ? std::string() : found->second;
}

using Kind = Expression::Kind;

/// Words and what they may depend on.
class ExpressionCheck {
public:
    ExpressionCheck(const Names& names, Diagnostics& diagnostics) : names_(names), diagnostics_(diagnostics) {}

    /// Reports what is unknown, and the first part that the site must not depend on.
    void check(const Site& site) {
        site_ = &site;
        bound_ = {site.bound.begin(), site.bound.end()};
        reported_ = false;
        for (const std::string& name : site.bound)
            if (!site.may_shadow && names_.find(name) != nullptr && shadowing_.insert(site.what + name).second)
                error(Id::doubly_defined, site.expression->span,
                      fmt::format("'{}' is defined already, and again as an index or variable in {}", name, site.what));
        visit(*site.expression);
    }

private:
    void error(Id id, const Span& span, std::string message, std::vector<Note> notes = {}) {
        reported_ = true;
        diagnostics_.error(id, span, std::move(message), std::move(notes));
    }

    unsigned visit(const Expression& e) {
        switch (e.kind) {
            case Kind::number: return 0;
            case Kind::name: return name(e);
            case Kind::call: return call(e);
            case Kind::sum: return sum(e);
            default: break;
        }
        unsigned result = 0;
        for (const ExpressionPtr& child : e.children) result |= visit(*child);
        return result;
    }

    /// Where the name at the bottom of an expression such as dot(phi) is defined.
    std::vector<Note> definition_of(const Expression& e) const {
        const Expression* named = &e;
        while (named->kind == Kind::call && !named->children.empty()) named = named->children[0].get();
        const Named* found = named->kind == Kind::name ? names_.find(named->name) : nullptr;
        if (found == nullptr) return {};
        return {{found->item->span, fmt::format("'{}' is defined here", named->name)}};
    }

    /// Reports a dependence that the site does not allow.
    unsigned allow(const Expression& e, unsigned depends, const char* is_a) {
        if ((depends & ~site_->allowed) != 0 && !reported_)
            error(Id::not_allowed_here, e.span, fmt::format("{} must not depend on '{}', which is {}", site_->what, e.written(), is_a),
                  definition_of(e));
        return depends;
    }

    /// A rate as C++ calls it, or a name like it.
    std::string hint(const std::string& name) const {
        for (const char* ending : {"_ddot", "_dot"})
            if (const std::string base = name.substr(0, name.size() - std::min(name.size(), std::string(ending).size()));
                name.ends_with(ending) && names_.find(base) != nullptr)
                return fmt::format("; write {}({})", ending + 1, base);
        return did_you_mean(name, names_.all());
    }

    unsigned name(const Expression& e) {
        if (bound_.contains(e.name)) {
            if (!e.children.empty()) error(Id::not_indexed, e.span, fmt::format("'{}' has no index", e.name));
            return 0;
        }
        if (e.name == "pi" || e.name == "stefan_boltzmann") return 0;
        if (e.name == "infinity") {
            error(Id::not_allowed_here, e.span, "'infinity' is not a number; limits and integrals may go there");
            return 0;
        }
        if (find_quantity(e.name) != nullptr) return quantity(e);
        if (e.name == "t") {
            if (!e.children.empty()) error(Id::not_indexed, e.span, "'t' has no index");
            if (site_->sizes_only) return sizes_only(e);
            return allow(e, on_time, "the time");
        }
        const Named* named = names_.find(e.name);
        if (named == nullptr) {
            const bool is_function = find_function(e.name) != nullptr || is_special_form(e.name) || is_printed_form(e.name);
            error(Id::unknown_name, e.span,
                  is_function ? fmt::format("'{}' is a function and needs its arguments in brackets", e.name)
                              : fmt::format("'{}' is not defined{}", e.name, hint(e.name)));
            return 0;
        }
        index(e, *named->item);
        if (named->kind == Named::Kind::size) return 0;
        if (site_->sizes_only) return sizes_only(e);
        switch (named->kind) {
            case Named::Kind::parameter: return allow(e, on_parameters, "a parameter");
            case Named::Kind::coordinate: return allow(e, on_coordinates, "a coordinate");
            case Named::Kind::input: return allow(e, on_inputs, "an input");
            case Named::Kind::state: return allow(e, on_states, "a state");
            case Named::Kind::output: return allow(e, on_outputs, "an output");
            case Named::Kind::mode: return allow(e, on_modes, "a mode");
            default: break;
        }
        return definition(e, named->definition());
    }

    unsigned sizes_only(const Expression& e) {
        error(Id::not_allowed_here, e.span,
              fmt::format("{} must be a whole number known at generation, but '{}' is not", site_->what, e.written()));
        return 0;
    }

    unsigned definition(const Expression& e, const Definition& item) {
        const unsigned depends = dependence(*item.value, names_);
        if ((depends & ~site_->allowed) != 0 && !reported_)
            error(Id::not_allowed_here, e.span,
                  fmt::format("{} must not depend on '{}', which depends on what is not allowed here", site_->what, e.written()),
                  {{item.span, fmt::format("'{}' is defined here", e.name)}});
        return depends;
    }

    void index(const Expression& e, const Item& item) {
        const std::size_t expected = item.family ? 1 : 0;
        if (expected == 1 && e.children.empty()) {
            error(Id::index_missing, e.span, fmt::format("'{}' is a family and needs an index, as in '{}[1]'", e.name, e.name),
                  {{item.span, "the family is defined here"}});
            return;
        }
        if (expected == 0 && !e.children.empty()) {
            error(Id::not_indexed, e.span, fmt::format("'{}' is not a family and has no index", e.name),
                  {{item.span, "it is defined here"}});
            return;
        }
        if (e.children.size() > 1) error(Id::not_indexed, e.span, fmt::format("'{}' has one index", e.name));
        for (const ExpressionPtr& child : e.children) whole_number(*child);
    }

    /// An index: sizes and bound indices only.
    void whole_number(const Expression& e) {
        for_each(e, [&](const Expression& part) {
            if (part.kind == Kind::call || part.kind == Kind::sum)
                error(Id::not_allowed_here, part.span, "an index is made of whole numbers, sizes, + - and *");
            if (part.kind != Kind::name || bound_.contains(part.name)) return;
            const Named* named = names_.find(part.name);
            if (named == nullptr)
                error(Id::unknown_name, part.span, fmt::format("'{}' is not defined{}", part.name, did_you_mean(part.name, names_.all())));
            else if (named->kind != Named::Kind::size)
                error(Id::not_allowed_here, part.span,
                      fmt::format("an index must be known at generation, but '{}' is {}", part.name, describe(named->kind)));
        });
    }

    unsigned sum(const Expression& e) {
        whole_number(*e.children[0]);
        whole_number(*e.children[1]);
        const bool shadows = bound_.contains(e.name) || names_.find(e.name) != nullptr || e.name == "t" || e.name == "pi";
        if (shadows) error(Id::doubly_defined, e.span, fmt::format("the index '{}' of the sum means something else here already", e.name));
        const auto inserted = bound_.insert(e.name);
        const unsigned result = visit(*e.children[2]);
        if (inserted.second) bound_.erase(inserted.first);
        return result;
    }

    unsigned call(const Expression& e) {
        if (e.name == "dot" || e.name == "ddot") return derivative(e);
        if (e.name == "diff") return partial(e);
        if (e.name == "integral") return integral(e);
        if (e.name == "quantity") return quantity_in_unit(e);
        if (e.name == "limit" || e.name == "at") return at_place(e);
        const FunctionSpec* function = find_function(e.name);
        unsigned result = 0;
        for (const ExpressionPtr& child : e.children) result |= visit(*child);
        static const std::set<std::string, std::less<>> of_matrices{"transpose", "inverse", "det", "trace", "cross", "diag"};
        if (function == nullptr && of_matrices.contains(e.name)) {
            // What is known to be a matrix is gone by now, so that something in it is not.
            if (!diagnostics_.has_errors())
                error(Id::wrong_arguments, e.span,
                      fmt::format("'{}' takes a matrix, and nothing says which one '{}' is; say it by 'with', as in A = \"matrix(row(a, "
                                  "b), row(c, d))\"",
                                  e.name, e.children.empty() ? e.written() : e.children[0]->written()));
        } else if (function == nullptr) {
            std::vector<std::string> known{"dot", "ddot", "sum"};
            for (const FunctionSpec& f : functions()) known.emplace_back(f.name);
            const std::string usual = foreign_function(e.name);
            error(Id::unknown_name, e.span,
                  fmt::format("there is no function '{}'{}", e.name, usual.empty() ? did_you_mean(e.name, known) : "; write " + usual));
        } else if (const std::size_t count = function->count(); e.children.size() != count) {
            error(Id::wrong_arguments, e.span,
                  fmt::format("'{}({})' takes {} argument{}, here it has {}", e.name, function->arguments, count, count == 1 ? "" : "s",
                              e.children.size()));
        }
        return result;
    }

    unsigned derivative(const Expression& e) {
        if (e.children.size() != 1) {
            error(Id::wrong_arguments, e.span, fmt::format("'{}' takes one argument, here it has {}", e.name, e.children.size()));
            return 0;
        }
        // What is differentiated is not what the site depends on; its derivative is. So the site is asked about that alone.
        const Site inner{site_->expression, on_anything, site_->what, {}};
        const Site& outer = *site_;
        site_ = &inner;
        unsigned depends = visit(*e.children[0]);
        site_ = &outer;
        for (int order = e.name == "dot" ? 1 : 2; order > 0; --order) {
            if ((depends & on_inputs) != 0)
                error(Id::not_allowed_here, e.span,
                      fmt::format("'{}' needs the time derivative of an input, which is not known", e.written()));
            depends = derivative_dependence(depends);
        }
        if (site_->sizes_only) return sizes_only(e);
        return allow(e, depends, (depends & on_accelerations) != 0 ? "an acceleration" : "a velocity");
    }

    unsigned partial(const Expression& e) {
        if (!derived_allowed(e)) return 0;
        if (e.children.size() != 2) {
            error(Id::wrong_arguments, e.span,
                  "'diff' takes an expression and what to differentiate by, as in 'diff(kinetic_energy, dot(phi))'");
            return 0;
        }
        return visit(*e.children[0]) | visit(*e.children[1]);
    }

    unsigned integral(const Expression& e) {
        if (!derived_allowed(e)) return 0;
        if (e.children.size() != 4 || e.children[1]->kind != Kind::name || !e.children[1]->children.empty()) {
            error(Id::wrong_arguments, e.span, "'integral' takes a function, its variable and two limits, as in 'integral(x^2, x, 0, l)'");
            return 0;
        }
        const unsigned limits = end(*e.children[2], true) | end(*e.children[3], true);
        const auto inserted = bound_.insert(e.children[1]->name);
        const unsigned result = limits | visit(*e.children[0]);
        if (inserted.second) bound_.erase(inserted.first);
        return result;
    }

    /// quantity(9.81, m/s^2)
    unsigned quantity_in_unit(const Expression& e) {
        if (!derived_allowed(e)) return 0;
        if (e.children.size() != 2) {
            error(Id::wrong_arguments, e.span, "'quantity' takes a number and its unit, as in 'quantity(9.81, m/s^2)'");
            return 0;
        }
        try {
            evaluate_unit(*e.children[1]);
        } catch (const Failure& failure) {
            for (const Diagnostic& d : failure.diagnostics()) error(d.id, d.span, d.message);
        }
        return visit(*e.children[0]);
    }

    unsigned at_place(const Expression& e) {
        if (!derived_allowed(e)) return 0;
        const bool has_side = e.name == "limit" && e.children.size() == 4;
        if (e.children.size() != 3 && !has_side) {
            error(Id::wrong_arguments, e.span,
                  fmt::format("'{0}' takes an expression, its variable and a place, as in '{0}(sin(x)/x, x, 0)'", e.name));
            return 0;
        }
        const Expression& variable = *e.children[1];
        const Expression* side = has_side ? e.children[3].get() : nullptr;
        if (side != nullptr && side->kind == Kind::negate) side = side->children[0].get();
        if (side != nullptr && !(side->kind == Kind::number && side->value == 1))
            error(Id::wrong_arguments, e.children[3]->span, "a limit is from above, 1, or from below, -1");
        if (variable.kind != Kind::name && !(variable.kind == Kind::call && (variable.name == "dot" || variable.name == "ddot")))
            error(Id::wrong_arguments, variable.span,
                  fmt::format("'{}' is not a variable that '{}' could be about", variable.written(), e.name));
        return visit(*e.children[0]) | visit(variable) | end(*e.children[2], e.name == "limit");
    }

    /// A place that may lie at infinity.
    unsigned end(const Expression& e, bool may_be_infinite) {
        const Expression& place = e.kind == Kind::negate ? *e.children[0] : e;
        return may_be_infinite && place.kind == Kind::name && place.name == "infinity" ? 0 : visit(e);
    }

    bool derived_allowed(const Expression& e) {
        if ((site_->allowed & on_quantities) != 0) return true;
        error(Id::not_allowed_here, e.span, fmt::format("'{}' is for outputs and printed equations; {} is neither", e.name, site_->what));
        return false;
    }

    unsigned quantity(const Expression& e) {
        const QuantitySpec& spec = *find_quantity(e.name);
        const std::size_t given = e.children.size();
        const SubscriptSpec& shape = subscript(spec.subscript);
        const bool is_optional = spec.subscript == Subscript::optional_body || spec.subscript == Subscript::optional_store ||
                                 spec.subscript == Subscript::optional_damper;
        if (given != shape.count && !(is_optional && given == 0) && !(spec.subscript == Subscript::fluid_or_medium && given == 3)) {
            error(Id::wrong_arguments, e.span, fmt::format("'{}' takes {} in square brackets", e.name, shape.words));
            return 0;
        }
        if (spec.subscript >= Subscript::fluid) return part_quantity(e, spec);
        if (spec.subscript == Subscript::surface || spec.subscript == Subscript::two_surfaces) return surface_quantity(e, spec);
        if (spec.subscript >= Subscript::solid && spec.subscript <= Subscript::sticking) return statics_quantity(e, spec);
        const bool bodies = spec.subscript == Subscript::body || spec.subscript == Subscript::optional_body ||
                            spec.subscript == Subscript::body_and_axis || spec.subscript == Subscript::body_and_two_axes;
        const bool lines = spec.subscript == Subscript::body_and_line || spec.subscript == Subscript::body_and_three_lines;
        const bool dampers = spec.subscript == Subscript::optional_damper;
        for (std::size_t i = 0; i < given; ++i) {
            const Expression& child = *e.children[i];
            if (dampers) damper(child);
            else if (spec.subscript == Subscript::constraint) constraint(child);
            else if (spec.subscript == Subscript::cut) cut(child);
            else if (lines) i == 0 ? body(child) : coordinate(child);
            else if (bodies && i >= 1) whole_number(child);
            else if (bodies) body(child);
            else coordinate(child);
        }
        return allow(e, dependence(spec),
                     spec.is_place      ? "a place of a body"
                     : spec.is_velocity ? "a velocity of a body"
                                        : "a derived quantity");
    }

    /// A quantity of a solid, a load or of what may stick.
    unsigned statics_quantity(const Expression& e, const QuantitySpec& spec) {
        const Expression& named = *e.children[0];
        const bool is_name = named.kind == Kind::name && named.children.empty();
        const auto unknown = [&](const char* what, const std::vector<std::string>& known) {
            error(Id::unknown_name, named.span, fmt::format("'{}' is not {}{}", named.written(), what, did_you_mean(named.name, known)));
            return 0U;
        };
        if (spec.subscript == Subscript::sticking) {
            if (!is_name || names_.find_sticking(named.name) == nullptr) return unknown("an entry of [sticking]", names_.stickings());
            return allow(e, dependence(spec), "a derived quantity");
        }
        if (spec.subscript <= Subscript::solid_and_axes) {
            if (!is_name || names_.find_solid(named.name) == nullptr) return unknown("a solid", names_.solids());
            for (std::size_t i = 1; i < e.children.size(); ++i) whole_number(*e.children[i]);
            return allow(e, on_parameters, "made of parameters");
        }
        const Load* load = is_name ? names_.find_load(named.name) : nullptr;
        if (load == nullptr) return unknown("a load", names_.loads());
        if (spec.subscript == Subscript::load_and_axis) {
            whole_number(*e.children[1]);
        } else {
            const Expression& asked = *e.children[1];
            if (std::none_of(load->unknowns.begin(), load->unknowns.end(), [&](const Unknown& u) {
                    return asked.kind == Kind::name && asked.children.empty() && u.name == asked.name;
                })) {
                std::vector<std::string> known;
                for (const Unknown& u : load->unknowns) known.push_back(u.name);
                error(Id::unknown_name, asked.span,
                      fmt::format("'{}' is not an unknown of load '{}'{}", asked.written(), load->name,
                                  known.empty() ? "; it has none" : "; they are " + quoted_list(known)),
                      {{load->span, "the load is defined here"}});
                return 0;
            }
        }
        return allow(e, dependence(*load, names_), "what follows from forces that depend on more");
    }

    unsigned surface_quantity(const Expression& e, const QuantitySpec& spec) {
        const Expression& named = *e.children[0];
        const Part* found = named.kind == Kind::name && named.children.empty() ? names_.find_part(named.name) : nullptr;
        if (found == nullptr || found->kind != Part::Kind::enclosure)
            error(Id::unknown_name, named.span,
                  fmt::format("'{}' is not an enclosure{}", named.written(),
                              did_you_mean(named.name, names_.parts(parts_in(spec.subscript)))));
        for (std::size_t i = 1; i < e.children.size(); ++i) whole_number(*e.children[i]);
        return allow(e, dependence(spec), "a derived quantity");
    }

    /// A quantity of a volume, reservoir, medium or flow.
    unsigned part_quantity(const Expression& e, const QuantitySpec& spec) {
        if (!e.children.empty()) {
            const Expression& named = *e.children[0];
            const Part* found = named.kind == Kind::name ? names_.find_part(named.name) : nullptr;
            const std::vector<Part::Kind> kinds = e.children.size() == 3 ? std::vector{Part::Kind::medium} : parts_in(spec.subscript);
            if (found == nullptr || std::find(kinds.begin(), kinds.end(), found->kind) == kinds.end()) {
                std::string described;
                for (std::size_t i = 0; i < kinds.size(); ++i) {
                    const std::string_view kind = describe(kinds[i]);
                    described += fmt::format("{}{}",
                                             i == 0                  ? ""
                                             : i + 1 == kinds.size() ? " or "
                                                                     : ", ",
                                             kind.substr(i == 0 ? 0 : kind.find(' ') + 1));
                }
                error(Id::unknown_name, named.span,
                      fmt::format("'{}' is not {}{}", named.written(), described, did_you_mean(named.name, names_.parts(kinds))));
            } else if (found->kind == Part::Kind::rod || found->kind == Part::Kind::block) {
                if (named.children.size() == 1) whole_number(*named.children[0]);
                else
                    error(Id::index_missing, named.span,
                          fmt::format("'{}' is a {} and needs the index of a cell, as in '{}[1]'", named.name,
                                      found->kind == Part::Kind::rod ? "rod" : "block", named.name));
            } else {
                index(named, *found->item);
            }
        }
        unsigned depends =
            allow(e, spec.is_property ? on_properties : on_quantities, spec.is_property ? "a property of a medium" : "a derived quantity");
        for (std::size_t i = 1; i < e.children.size(); ++i) depends |= visit(*e.children[i]);
        return depends;
    }

    void damper(const Expression& e) {
        if (e.kind == Kind::name && names_.find_friction(e.name) != nullptr && e.children.empty()) return;
        const Damper* item = e.kind == Kind::name ? names_.find_damper(e.name) : nullptr;
        if (item == nullptr) error(Id::unknown_name, e.span, fmt::format("'{}' is neither a damper nor dry friction", e.written()));
        else index(e, *item);
    }

    void constraint(const Expression& e) {
        const Constraint* item = e.kind == Kind::name ? names_.find_constraint(e.name) : nullptr;
        if (item == nullptr) error(Id::unknown_name, e.span, fmt::format("'{}' is not a constraint", e.written()));
        else index(e, *item);
    }

    void cut(const Expression& e) {
        const Cut* item = e.kind == Kind::name ? names_.find_cut(e.name) : nullptr;
        if (item == nullptr) error(Id::unknown_name, e.span, fmt::format("'{}' is not a cut", e.written()));
        else index(e, *item);
    }

    void body(const Expression& e) {
        const Body* item = e.kind == Kind::name ? names_.find_body(e.name) : nullptr;
        if (item == nullptr) error(Id::unknown_name, e.span, fmt::format("'{}' is not a body", e.written()));
        else index(e, *item);
    }

    void coordinate(const Expression& e) {
        const Named* named = e.kind == Kind::name ? names_.find(e.name) : nullptr;
        if (named == nullptr || named->kind != Named::Kind::coordinate)
            error(Id::unknown_name, e.span, fmt::format("'{}' is not a coordinate", e.written()));
        else index(e, *named->item);
    }

    const Names& names_;
    Diagnostics& diagnostics_;
    const Site* site_ = nullptr;
    std::set<std::string, std::less<>> bound_;
    std::set<std::string> shadowing_;
    bool reported_ = false;
};

}  // namespace

void check_expressions(const Model& model, Diagnostics& diagnostics) {
    const Names names(model);
    ExpressionCheck check(names, diagnostics);
    visit(model, [&](const Site& site) { check.check(site); });
}

void check_expressions(const PrintedEquation& printed, const Names& names, Diagnostics& diagnostics) {
    ExpressionCheck check(names, diagnostics);
    visit(printed, [&](const Site& site) { check.check(site); });
}

}  // namespace dalembert
