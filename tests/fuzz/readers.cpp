// SPDX-License-Identifier: GPL-3.0-or-later
#include <array>
#include <cstdlib>

#include "elements/model.hpp"
#include "fuzz/targets.hpp"
#include "printed/catalogue.hpp"
#include "language/condition.hpp"
#include "language/dimension.hpp"
#include "language/expression_text.hpp"
#include "printed/latex_reader.hpp"
#include "language/parser.hpp"
#include "read/reader.hpp"
#include "text/diagnostic.hpp"
#include "text/files.hpp"

using namespace dalembert;

namespace fuzz {

namespace {

/// A Failure is an answer; that it can be shown is part of it.
template <class Work>
void answered(Work work) {
    try {
        work();
    } catch (const Failure& failure) {
        for (const Diagnostic& d : failure.diagnostics())
            if (render(d).empty()) std::abort();
    }
}

Excerpt excerpt(const std::string& bytes) { return excerpt_of(source_of("fuzz.toml", bytes)); }

void expression(const std::string& bytes) {
    answered([&] { (void)in_model_language(*parse_expression(excerpt(bytes))); });
    answered([&] { (void)parse_property(excerpt(bytes)); });
    answered([&] { (void)parse_law(excerpt(bytes)); });
    answered([&] { (void)parse_equation(excerpt(bytes)); });
    answered([&] { (void)parse_family(excerpt(bytes)); });
    answered([&] { (void)parse_condition(excerpt(bytes)); });
}

void number(const std::string& bytes) {
    answered([&] { (void)parse_unit(excerpt(bytes)); });
    const auto value = read_decimal(bytes);
    if (!value || is_zero(*value)) return;
    for (const int digits : {1, 6, 17}) {
        const auto again = read_decimal(decimal(*value, digits));
        // Half a unit of the last digit at most.
        if (again && cln::abs(*again - *value) * cln::expt(cln::cl_RA(10), cln::cl_I(digits - 1)) > cln::abs(*value)) std::abort();
    }
}

void latex(const std::string& bytes) {
    answered([&] {
        PrintedNotation notation;
        notation.define("\\varphi", "phi");
        notation.define_function("f", {"x"});
        notation.add_word("ab");
        for (const LatexEquation& read : read_latex(excerpt(bytes), notation))
            for (const ExpressionPtr& side : read.equation.sides) (void)in_model_language(*side);
    });
}

void model(const std::string& bytes) {
    answered([&] {
        Diagnostics diagnostics;
        (void)read_model(source_of("fuzz.toml", bytes), diagnostics);
    });
}

void catalogue(const std::string& bytes) {
    answered([&] {
        Diagnostics diagnostics;
        const SourcePtr source = source_of("fuzz.toml", bytes);
        if (!is_catalogue(source)) return;
        const Catalogue read = read_catalogue(source, diagnostics);
        for (const CatalogueEntry& entry : read.entries)
            answered([&] {
                for (const CatalogueEntry& with : with_equations(read, entry, nullptr)) {
                    const Model letters = with_letters(read, with, nullptr);
                    (void)checked_entry(read, with, letters, diagnostics);
                }
            });
    });
}

constexpr std::array targets{Target{"expression", expression}, Target{"number", number}, Target{"latex", latex}, Target{"model", model}, Target{"catalogue", catalogue}};

}  // namespace

std::span<const Target> readers() { return targets; }

const Target* find(std::span<const Target> all, std::string_view name) {
    for (const Target& target : all)
        if (target.name == name) return &target;
    return nullptr;
}

}  // namespace fuzz
