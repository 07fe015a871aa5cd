// SPDX-License-Identifier: GPL-3.0-or-later
#include "export/casadi.hpp"

#include <fmt/format.h>

#include "export/c_library.hpp"
#include "export/derivatives_in_c.hpp"
#include "text/template.hpp"

namespace dalembert {

Exported casadi_files(const ExportSubject& subject, const ExportWish& wish) {
    DerivativesInC derivatives = derivatives_in_c(subject, wish, "CasADi");
    std::map<std::string, std::string> values = derivatives.numbers;
    values["HAS_HESSIAN"] = derivatives.has_hessian ? "1" : "0";
    values["HAS_BY_P"] = derivatives.has_outputs_by_parameter ? "1" : "0";
    values["HAS_BY_T"] = derivatives.has_outputs_by_time ? "1" : "0";
    values["T"] = derivatives.has_time ? ", t" : "";
    const std::string main_file = subject.name + "_casadi.c";
    Exported result{{subject.c_files.front()}, {}};  // the header; nothing here asks for the table
    result.files.push_back(std::move(derivatives.file));
    result.files.emplace_back(main_file, fill_template(embedded_file("casadi.c.in"), values));
    if (!wish.sources_only) result.files.emplace_back(subject.name + ".so", c_library(result.files, main_file));
    if (!wish.mode.empty()) result.notes.push_back(fmt::format("the machine stays in the mode '{}', whatever its events are", wish.mode));
    if (derivatives.has_time) result.notes.push_back("the model depends on time: t is the last argument of f and y");
    return result;
}

}  // namespace dalembert
