// SPDX-License-Identifier: GPL-3.0-or-later
// An equation of a text with a slip mended, in the letters of the text: what is printed stays as it is printed.
#pragma once

#include <map>
#include <optional>
#include <set>

#include "printed/catalogue.hpp"
#include "printed/slips.hpp"

namespace dalembert {

class LatexText {
public:
    /// Of an entry in LaTeX and what was read from it.
    LatexText(const Catalogue& catalogue, const CatalogueEntry& entry, const Model* model, const PrintedEquation& read);

    /// What is printed by its own words; what is not, after the custom of LaTeX.
    std::string spelled(const Expression& e) const;
    /// The equation as it is printed, on one line.
    std::string printed(std::size_t which) const;
    /// The same with the slip mended; nothing where no text is found that reads as just that.
    std::optional<std::string> mended(std::size_t which, const Slip& slip) const;
    /// Whether places in the file are places in the LaTeX: it has no escapes.
    bool is_plain() const { return entry_.latex->whole().text() == entry_.latex->text; }
    /// Of the catalogue and of the entry.
    LatexMacros macros() const;

private:
    bool is_printed(const Expression& e) const { return originals_.contains(&e); }
    std::string text_of(const Expression& e, int least) const;
    std::string made(const Expression& e) const;
    std::string letter(const std::string& name) const;
    /// The brackets directly around a place belong to it.
    Span with_brackets(const Span& place) const;
    bool reads_as(const std::string& latex, std::size_t which, const Equation& meant) const;

    const Catalogue& catalogue_;
    const CatalogueEntry& entry_;
    const Model* model_;
    std::vector<Equation> equations_;
    std::set<const Expression*> originals_;
    std::map<std::string, std::string> letters_;  ///< by name, as the text prints them
};

}  // namespace dalembert
