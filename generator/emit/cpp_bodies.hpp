// SPDX-License-Identifier: GPL-3.0-or-later
// Bodies and argument lists of the header's functions.
#pragma once

#include "emit/cpp_function.hpp"
#include "emit/jacobian_layout.hpp"

namespace dalembert {

struct CppBody {
    std::string arguments;  ///< names of what is not used are commented out
    std::string statements;
};

class CppBodies {
public:
    explicit CppBodies(const Code& code);

    CppBody update();
    CppBody start_state();
    CppBody rhs();
    CppBody rhs_and_jacobian();
    CppBody jacobian(Function function, By by);
    CppBody mass_matrix();
    /// A function that fills an array with one value a row.
    CppBody values(Function function, const char* type, const char* result);
    CppBody output_jacobian(Function function, By by);
    CppBody scalar(Function function);

    /// Whether a definition is a member of the header: those of the model, and the steps that some function but update() uses.
    bool is_kept(std::size_t definition) const { return !only_in_update_.contains(definition); }
    /// Cached values that some function uses, in order, with the number in their name.
    const std::map<std::uint32_t, std::size_t>& cached() const { return cached_; }
    const JacobianLayout& layout(By by) const { return layouts_[static_cast<std::size_t>(by)]; }
    /// The header's own functions that its code calls: "ldlt", "sign", ...
    const std::set<std::string>& helpers() const { return helpers_; }

private:
    /// Arguments that are used although no symbol of the program stands for them.
    struct Uses {
        bool state = false;
        bool everything = false;
        bool has_input = true;
    };

    std::vector<std::size_t> needed_definitions() const;
    std::string motion(CppFunction& cpp, const FunctionCode& f);
    std::string filled_jacobian(CppFunction& cpp, const FunctionCode& f, const JacobianLayout& layout, By by, bool has_mass);
    std::string factored_mass(CppFunction& cpp, const FunctionCode& f);
    std::string mass_name() const;
    std::string assigned(CppFunction& cpp, const std::string& target, NodeId value);
    CppBody finish(const CppFunction& cpp, std::string statements, const std::string& result, Uses uses);
    std::string accelerations_by_rhs(CppFunction& cpp);

    const Code& code_;
    std::size_t n_;
    std::size_t m_;
    std::map<std::uint32_t, std::size_t> cached_;
    CachedTexts cached_texts_;
    std::set<std::size_t> only_in_update_;
    std::vector<JacobianLayout> layouts_;
    std::set<std::string> helpers_;
};

}  // namespace dalembert
