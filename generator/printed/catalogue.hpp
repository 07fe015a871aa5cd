// SPDX-License-Identifier: GPL-3.0-or-later
// A catalogue: the equations that a text prints, each with what it is checked against.
#pragma once

#include "elements/kinds.hpp"
#include "elements/quantities.hpp"
#include "elements/runs.hpp"
#include "language/lexer.hpp"
#include "printed/latex_reader.hpp"

namespace dalembert {

/// A letter that no model has: real, or positive; a constant, or a function of time with derivatives of its own; or a number.
struct CatalogueLetter : Quantity {
    ExpressionPtr value;      ///< in SI; null for what may have any value
    bool is_positive = false;
    bool moves = false;
};

/// What a printed letter stands for: \varphi, T, m_{1}.
struct LatexMeaning {
    Excerpt letter;
    ExpressionPtr value;
};

/// Of an entry in LaTeX: how many equations it prints, and those of them that are not read.
struct EntryParts {
    std::size_t equations = 0;
    std::vector<RefusedEquation> refused = {};
};

/// The name is the printed number: "2.218".
struct CatalogueEntry : PrintedEquation {
    std::string model;         ///< path, relative to the catalogue; empty: an identity on its own letters
    Span model_span;
    std::string printed;       ///< of an entry without equations: the name of the model's printed equation that it is
    std::string scene;
    Span scene_span;
    std::string mode;
    std::vector<CatalogueLetter> own;
    std::optional<Excerpt> latex;  ///< instead of equations
    std::vector<LatexMeaning> notation;
    std::vector<Excerpt> functions;
    bool is_dimensionless = false;  ///< all its letters are numbers
    std::string not_checkable; ///< why there is nothing to be checked; empty where there is
    std::vector<Diagnostic> unreadable = {};  ///< what is wrong in the entry itself
    EntryParts parts = {};     ///< after with_equations
};

struct Catalogue {
    SourcePtr source;
    std::string title;         ///< of the text
    std::string edition;
    std::vector<CatalogueLetter> letters;
    std::vector<LatexMeaning> notation;
    std::vector<Excerpt> functions;  ///< letters that are functions: "T", or with what of, "T(x)"
    std::vector<std::pair<Excerpt, std::string>> macros;
    std::optional<Excerpt> preamble;  ///< lines that define macros
    char decimal_mark = 0;            ///< '.' or ','; 0 where the text does not say
    std::vector<std::string> coordinates;  ///< Cartesian ones, of \nabla
    std::vector<CatalogueEntry> entries;
};

/// Whether a file says that it is a catalogue: it has a section [catalogue].
bool is_catalogue(const SourcePtr& source);

/// Reads and checks a catalogue, but for what its entries say of models. What is wrong in an entry is kept with it. Throws Failure with
/// everything else that is wrong.
Catalogue read_catalogue(const SourcePtr& source, Diagnostics& diagnostics);

/// The entry with its LaTeX read, if it has any: two of them where it says what letters are with \pm, one for each sign. What cannot be
/// read of several equations stands in its parts. Throws Failure where nothing can be read, or what cannot may be a condition of the rest.
std::vector<CatalogueEntry> with_equations(const Catalogue& catalogue, const CatalogueEntry& entry, const Model* model);

/// A model with the letters of an entry and nothing else; with `base`, that model with those letters that it does not have.
Model with_letters(const Catalogue& catalogue, const CatalogueEntry& entry, const Model* base);

/// The entry as it is checked against names: with the notation that it uses. Reports words that mean nothing.
PrintedEquation checked_entry(const Catalogue& catalogue, const CatalogueEntry& entry, const Model& model, Diagnostics& diagnostics);

}  // namespace dalembert
