// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>

#include <map>
#include <array>
#include <ostream>

#include "command/installed_texts.hpp"
#include "run/options.hpp"
#include "report/json_fields.hpp"
#include "printed/catalogue_schema.hpp"
#include "elements/schema.hpp"
#include "language/unit_reference.hpp"
#include "language/vocabulary.hpp"
#include "text/budgets.hpp"
#include "text/nearest.hpp"

namespace dalembert {

namespace {

std::string error_reference() {
    std::string text = "Ids of errors and warnings:\n";
    for (const DiagnosticKind& kind : diagnostic_kinds()) text += fmt::format("  {:<20} {}\n", kind.name, kind.meaning);
    return text;
}

std::string function_reference() {
    std::string text = "Functions:\n";
    for (const FunctionSpec& function : functions())
        text += fmt::format("  {:<48} {}\n", fmt::format("{}({})", function.name, function.arguments), function.doc);
    return text +
           "Kinks and jumps of abs, sign, min, max, step, ramp, pulse, mod and if are located in runs, wherever they stand: at known times "
           "where the time alone decides,\n"
           "  else as guards of the header; unlocated(x) says that those in x are smooth enough. What jumps in its second derivative or "
           "higher, as abs(v)*v, is smooth enough by itself\n"
           "Operations: + - * / ^, dot(x) and ddot(x) (total time derivatives), sum(k, 1, N, term)\n"
           "In outputs and printed equations also: diff(expression, variable), integral(function, x, from, to), limit(expression, x, "
           "place), at(expression, x, place),\n"
           "  quantity(9.81, m/s^2); limits and integrals may go to infinity; limit(e, x, place, 1) is from above, with -1 from below\n"
           "In printed equations also: vector(a, b, c), matrix(row(a, b), row(c, d)), diag(a, b), transpose(A), det(A), trace(A), "
           "inverse(A), cross(v, w); position[BODY] without an axis\n"
           "Names: t is the time, pi the number, stefan_boltzmann the constant of radiation (4.35), 5.670374419e-8 W/(m^2*K^4). Everything "
           "else is defined in the file.\n";
}

std::string quantity_reference() {
    const auto rows = [](bool properties) {
        std::string text;
        for (const QuantitySpec& quantity : quantities())
            if (quantity.is_property == properties)
                text += fmt::format("  {:<22}{:<34} {}\n", quantity.name, subscript(quantity.subscript).reference, quantity.doc);
        return text;
    };
    return "Derived quantities, for outputs and printed equations:\n" + rows(false) +
           "Properties, usable wherever states are; X is a volume, reservoir or junction:\n" + rows(true);
}

std::string catalogue_reference() {
    std::string text = "A catalogue of printed equations:\n\n";
    for (const SectionSpec& section : catalogue_sections()) text += section_reference(section) + "\n";
    return text;
}

std::string json_reference() {
    std::string text =
        "Fields of the JSON results; [] stands for the elements of an array, <NAME> for names of the model. Numbers are SI.\n";
    const auto list = [&](const char* title, std::span<const JsonField> fields) {
        text += fmt::format("\n{}\n", title);
        for (const JsonField& field : fields) text += fmt::format("  {:<42} {}", field.path, field.doc).append("\n");
    };
    list("every result", common_json_fields());
    for (const JsonSchema& schema : json_schemas()) list(schema.verb, schema.fields);
    return text;
}

std::string limit_reference() {
    std::string text = "What each stage may spend at most. Beyond a count, the same input ends at the same place on every machine.\n";
    for (const StageBudget& row : budgets()) text += fmt::format("  {:<18} {:<50} {:>8g}  {}\n", row.stage, row.what, row.most, row.beyond);
    return text + "Cells and sizes of single elements have limits of their own, named where they are passed.\n";
}

}  // namespace

ExitCode help_command(const Options& options, Streams streams) {
    for (const InstalledText& text : installed_texts()) {
        if (options.format != text.format) continue;
        streams.out << text.make();
        return ExitCode::good;
    }
    const std::string& topic = options.topic;
    if (topic.empty()) {
        streams.out << "The model language: sections and their keys.\n\n"
                    << language_reference("") << function_reference() << "\n"
                    << quantity_reference();
        return ExitCode::good;
    }
    static const std::map<std::string, std::string (*)()> references{
        {"errors", error_reference}, {"functions", function_reference}, {"quantities", quantity_reference}, {"json", json_reference},
        {"limits", limit_reference}, {"units", unit_reference},         {"catalogue", catalogue_reference}};
    const auto reference = references.find(topic);
    const std::string text = reference != references.end() ? reference->second() : language_reference(topic);
    if (text.empty()) {
        std::vector<std::string> words = language_words();
        for (const auto& [name, write] : references) words.push_back(name);
        throw Failure(
            Diagnostic{Id::bad_option, {}, fmt::format("the model language has no word '{}'{}", topic, did_you_mean(topic, words))});
    }
    streams.out << text;
    return ExitCode::good;
}

}  // namespace dalembert
