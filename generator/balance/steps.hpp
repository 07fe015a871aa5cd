// SPDX-License-Identifier: GPL-3.0-or-later
// Letters for the steps of a computation with the surfaces of an enclosure.
#pragma once

#include "symbolic/symbols.hpp"

namespace dalembert {

class Steps {
public:
    using Slope = std::function<GiNaC::ex(const Symbols&, std::size_t parameter)>;

    /// Without letters, because something depends on more than parameters, values are written out.
    Steps(Symbols& symbols, std::string enclosure, bool with_letters)
        : symbols_(symbols), enclosure_(std::move(enclosure)), with_letters_(with_letters) {}

    /// A letter "what[enclosure, i, j]" for a value, indices counted from 0 here; the value itself where it is as short as a letter.
    GiNaC::ex operator()(const char* what, const std::vector<std::size_t>& indices, const GiNaC::ex& value, Slope slope = {});
    /// One that stays a letter in proofs halfway down, or is `instead` there.
    GiNaC::ex staying(const char* what, const std::vector<std::size_t>& indices, const GiNaC::ex& value, const GiNaC::ex& instead = 0);

    bool with_letters() const { return with_letters_; }
    const Symbols& symbols() const { return symbols_; }

private:
    GiNaC::ex add(const char* what, const std::vector<std::size_t>& indices, Step step);

    Symbols& symbols_;
    std::string enclosure_;
    bool with_letters_;
};

/// Whether an expression is of parameters and definitions alone.
bool is_of_parameters(const GiNaC::ex& e, const Symbols& symbols);

}  // namespace dalembert
