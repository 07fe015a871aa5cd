// SPDX-License-Identifier: GPL-3.0-or-later
// modelDescription.xml and buildDescription.xml, in the words of each version.
#include <fmt/format.h>

#include <pugixml.hpp>
#include <sstream>

#include "export/fmi_model.hpp"
#include "text/version.hpp"

namespace dalembert {

namespace {

using pugi::xml_node;

template <class Number>
std::string written(Number value) {
    return fmt::format("{}", value);
}

void attribute(xml_node node, const char* name, const std::string& text) { node.append_attribute(name) = text.c_str(); }
void attribute(xml_node node, const char* name, const char* text) { node.append_attribute(name) = text; }
void attribute(xml_node node, const char* name, const std::optional<double>& value) {
    if (value) attribute(node, name, written(*value));
}

std::string text_of(const pugi::xml_document& document) {
    std::ostringstream out;
    document.save(out, "  ", pugi::format_default, pugi::encoding_utf8);
    return out.str();
}

void declare(pugi::xml_document& document) {
    xml_node declaration = document.append_child(pugi::node_declaration);
    attribute(declaration, "version", "1.0");
    attribute(declaration, "encoding", "UTF-8");
}

/// Log categories, in the order of fmi_machine.h.
constexpr const char* categories[][2]{{"logEvents", "changes of mode, and where the model ends"},
                                      {"logStatusDiscard", "values that are refused, or that are infinite or not a number"},
                                      {"logStatusError", "calls that are not allowed, and steps that fail"}};

class DescriptionWriter {
public:
    DescriptionWriter(const FmiModel& model, FmiVersion version) : model_(model), is_two_(version == FmiVersion::two) {}

    std::string run(const std::string& token, const std::vector<std::string>& files) {
        pugi::xml_document document;
        declare(document);
        root_ = document.append_child("fmiModelDescription");
        attribute(root_, "fmiVersion", is_two_ ? "2.0" : "3.0");
        attribute(root_, "modelName", model_.name);
        attribute(root_, is_two_ ? "guid" : "instantiationToken", token);
        if (!model_.title.empty()) attribute(root_, "description", model_.title);
        attribute(root_, "license", "BSL-1.0");
        attribute(root_, "generationTool", fmt::format("dalembert {}", program_version));
        attribute(root_, "variableNamingConvention", "flat");
        if (is_two_) attribute(root_, "numberOfEventIndicators", written(model_.indicator_count));
        interfaces(files);
        units();
        types();
        xml_node log = root_.append_child("LogCategories");
        for (const auto& category : categories) {
            xml_node node = log.append_child("Category");
            attribute(node, "name", category[0]);
            attribute(node, "description", category[1]);
        }
        xml_node experiment = root_.append_child("DefaultExperiment");
        attribute(experiment, "startTime", "0");
        attribute(experiment, "stopTime", model_.stop);
        attribute(experiment, "tolerance", "1e-09");
        xml_node variables = root_.append_child("ModelVariables");
        for (const FmiVariable& variable : model_.variables) add(variables, variable);
        structure();
        return text_of(document);
    }

private:
    void interfaces(const std::vector<std::string>& files) {
        const auto common = [&](const char* name) {
            xml_node node = root_.append_child(name);
            attribute(node, "modelIdentifier", model_.identifier);
            attribute(node, is_two_ ? "canGetAndSetFMUstate" : "canGetAndSetFMUState", "true");
            attribute(node, is_two_ ? "canSerializeFMUstate" : "canSerializeFMUState", "true");
            attribute(node, is_two_ ? "providesDirectionalDerivative" : "providesDirectionalDerivatives", "true");
            if (is_two_) attribute(node, "canNotUseMemoryManagementFunctions", "true");
            else attribute(node, "providesAdjointDerivatives", "true");
            if (!is_two_) return node;
            xml_node sources = node.append_child("SourceFiles");
            for (const std::string& file : files) attribute(sources.append_child("File"), "name", file);
            return node;
        };
        xml_node exchange = common("ModelExchange");
        if (is_two_) attribute(exchange, "completedIntegratorStepNotNeeded", model_.is_projected ? "false" : "true");
        else attribute(exchange, "needsCompletedIntegratorStep", model_.is_projected ? "true" : "false");
        xml_node steps = common("CoSimulation");
        attribute(steps, "canHandleVariableCommunicationStepSize", "true");
    }

    void units() {
        if (model_.units.empty()) return;
        xml_node list = root_.append_child("UnitDefinitions");
        for (const FmiUnit& unit : model_.units) {
            xml_node node = list.append_child("Unit");
            attribute(node, "name", unit.name);
            if (!unit.has_exponents) continue;
            xml_node base = node.append_child("BaseUnit");
            for (const auto& [name, exponent] : unit.exponents) attribute(base, name.c_str(), written(exponent));
        }
    }

    /// Version 3 has the modes as an enumeration; integers are read by more tools of version 2.
    void types() {
        if (is_two_ || model_.modes.empty()) return;
        xml_node type = root_.append_child("TypeDefinitions").append_child("EnumerationType");
        attribute(type, "name", "Mode");
        for (std::size_t i = 0; i < model_.modes.size(); ++i) {
            xml_node item = type.append_child("Item");
            attribute(item, "name", model_.modes[i]);
            attribute(item, "value", written(i));
        }
    }

    void add(xml_node list, const FmiVariable& v) {
        const bool is_mode = v.type == FmiVariable::Type::mode;
        xml_node node = list.append_child(is_two_ ? "ScalarVariable" : is_mode ? "Enumeration" : "Float64");
        attribute(node, "name", v.name);
        attribute(node, "valueReference", written(v.reference));
        if (!v.doc.empty()) attribute(node, "description", v.doc);
        attribute(node, "causality", v.causality);
        attribute(node, "variability", v.variability);
        if (!v.initial.empty()) attribute(node, "initial", v.initial);
        xml_node number = is_two_ ? node.append_child(is_mode ? "Integer" : "Real") : node;
        if (is_mode && is_two_) {
            attribute(number, "min", "0");
            attribute(number, "max", written(model_.modes.size() - 1));
        } else if (is_mode) {
            attribute(number, "declaredType", "Mode");
        }
        if (!v.unit.empty()) attribute(number, "unit", v.unit);
        attribute(number, "min", v.low);
        attribute(number, "max", v.high);
        attribute(number, "nominal", v.nominal);
        attribute(number, "start", v.start);
        if (v.derivative_of)
            attribute(number, "derivative",
                      is_two_ ? written(*v.derivative_of + 1) : written(model_.variables[*v.derivative_of].reference));
        if (v.can_jump) attribute(number, "reinit", "true");
    }

    /// Version 2 counts variables from 1, version 3 takes value references.
    std::string name_of(std::size_t variable) const {
        return is_two_ ? written(variable + 1) : written(model_.variables[variable].reference);
    }

    void add(xml_node list, const char* element, const FmiUnknown& unknown) {
        xml_node node = list.append_child(element);
        attribute(node, is_two_ ? "index" : "valueReference", name_of(unknown.variable));
        if (!unknown.dependencies) return;
        std::string dependencies;
        for (const std::size_t variable : *unknown.dependencies) dependencies += (dependencies.empty() ? "" : " ") + name_of(variable);
        attribute(node, "dependencies", dependencies);
    }

    void structure() {
        xml_node node = root_.append_child("ModelStructure");
        const auto group = [&](const char* in_two, const char* in_three, const std::vector<FmiUnknown>& unknowns) {
            if (unknowns.empty()) return;
            xml_node list = is_two_ ? node.append_child(in_two) : node;
            for (const FmiUnknown& unknown : unknowns) add(list, is_two_ ? "Unknown" : in_three, unknown);
        };
        group("Outputs", "Output", model_.outputs);
        group("Derivatives", "ContinuousStateDerivative", model_.derivatives);
        group("InitialUnknowns", "InitialUnknown", model_.initial);
        if (!is_two_) group("", "EventIndicator", model_.indicators);
    }

    const FmiModel& model_;
    bool is_two_;
    xml_node root_;
};

}  // namespace

std::string fmi_description(const FmiModel& model, FmiVersion version, const std::string& token, const std::vector<std::string>& files) {
    return DescriptionWriter(model, version).run(token, files);
}

std::string fmi_build_description(const FmiModel& model, const std::vector<std::string>& files) {
    pugi::xml_document document;
    declare(document);
    xml_node root = document.append_child("fmiBuildDescription");
    attribute(root, "fmiVersion", "3.0");
    xml_node configuration = root.append_child("BuildConfiguration");
    attribute(configuration, "modelIdentifier", model.identifier);
    xml_node set = configuration.append_child("SourceFileSet");
    attribute(set, "language", "C99");
    for (const std::string& file : files) attribute(set.append_child("SourceFile"), "name", file);
    xml_node library = configuration.append_child("Library");
    attribute(library, "name", "m");
    attribute(library, "external", "true");
    return text_of(document);
}

}  // namespace dalembert
