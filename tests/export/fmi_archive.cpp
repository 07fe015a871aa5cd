// SPDX-License-Identifier: GPL-3.0-or-later
// The archive of an FMU and its modelDescription.xml.
#include <zip.h>

#include <filesystem>
#include <fstream>
#include <map>
#include <pugixml.hpp>
#include <sstream>
#include <stdexcept>

#include "fmi_unit.hpp"

namespace fmi_test {

namespace fs = std::filesystem;

namespace {

[[noreturn]] void fail(const std::string& what) { throw std::runtime_error(what); }

void unzip(const std::string& path, const fs::path& folder) {
    int code = 0;
    zip_t* const archive = zip_open(path.c_str(), ZIP_RDONLY | ZIP_CHECKCONS, &code);
    if (archive == nullptr) fail("'" + path + "' is no archive");
    for (zip_int64_t i = 0; i < zip_get_num_entries(archive, 0); ++i) {
        zip_stat_t about;
        if (zip_stat_index(archive, zip_uint64_t(i), 0, &about) != 0) fail("an entry of the archive cannot be read");
        const fs::path to = folder / about.name;
        fs::create_directories(to.parent_path());
        zip_file_t* const file = zip_fopen_index(archive, zip_uint64_t(i), 0);
        std::string bytes(about.size, '\0');
        if (file == nullptr || zip_fread(file, bytes.data(), about.size) != zip_int64_t(about.size))
            fail("a file of the archive cannot be read");
        zip_fclose(file);
        std::ofstream(to, std::ios::binary) << bytes;
    }
    zip_discard(archive);
}

std::optional<double> number(const pugi::xml_node& node, const char* name) {
    if (!node.attribute(name)) return {};
    return node.attribute(name).as_double();
}

Description read(const fs::path& file) {
    pugi::xml_document document;
    if (!document.load_file(file.c_str())) fail("modelDescription.xml is no XML");
    const pugi::xml_node root = document.child("fmiModelDescription");
    Description d;
    d.version = root.attribute("fmiVersion").value()[0] - '0';
    const bool is_two = d.version == 2;
    d.token = root.attribute(is_two ? "guid" : "instantiationToken").value();
    const pugi::xml_node exchange = root.child("ModelExchange"), steps = root.child("CoSimulation");
    if (!exchange || !steps) fail("model exchange and co-simulation are not both there");
    d.identifier = exchange.attribute("modelIdentifier").value();
    if (d.identifier != steps.attribute("modelIdentifier").value()) fail("the identifiers differ");
    d.needs_completed_step = is_two ? !exchange.attribute("completedIntegratorStepNotNeeded").as_bool()
                                    : exchange.attribute("needsCompletedIntegratorStep").as_bool();
    const pugi::xml_node experiment = root.child("DefaultExperiment");
    d.stop = number(experiment, "stopTime");
    d.tolerance = number(experiment, "tolerance");
    std::map<unsigned, std::size_t> by_reference;
    for (const pugi::xml_node node : root.child("ModelVariables")) {
        const pugi::xml_node typed = is_two ? node.first_child() : node;
        Variable v;
        v.name = node.attribute("name").value();
        v.causality = node.attribute("causality").as_string("local");
        v.variability = node.attribute("variability").as_string("continuous");
        v.initial = node.attribute("initial").value();
        v.reference = node.attribute("valueReference").as_uint();
        v.type = typed.name();
        v.unit = typed.attribute("unit").value();
        v.start = number(typed, "start");
        v.low = number(typed, "min");
        v.high = number(typed, "max");
        if (const auto of = typed.attribute("derivative")) v.derivative_of = of.as_uint();
        if (!by_reference.emplace(v.reference, d.variables.size()).second) fail("two variables have one value reference");
        d.variables.push_back(v);
    }
    const auto place = [&](unsigned named) { return is_two ? std::size_t(named - 1) : by_reference.at(named); };
    for (Variable& v : d.variables)
        if (v.derivative_of) v.derivative_of = place(unsigned(*v.derivative_of));
    const auto unknown = [&](const pugi::xml_node& node) {
        Unknown u;
        u.variable = place(node.attribute(is_two ? "index" : "valueReference").as_uint());
        if (!node.attribute("dependencies")) return u;
        std::istringstream words(node.attribute("dependencies").value());
        u.dependencies.emplace();
        for (unsigned word = 0; words >> word;) u.dependencies->push_back(place(word));
        return u;
    };
    const pugi::xml_node structure = root.child("ModelStructure");
    if (is_two) {
        for (const pugi::xml_node node : structure.child("Outputs")) d.outputs.push_back(unknown(node));
        for (const pugi::xml_node node : structure.child("Derivatives")) d.derivatives.push_back(unknown(node));
        for (const pugi::xml_node node : structure.child("InitialUnknowns")) d.initial.push_back(unknown(node));
        d.indicators = root.attribute("numberOfEventIndicators").as_uint();
    } else {
        for (const pugi::xml_node node : structure.children("Output")) d.outputs.push_back(unknown(node));
        for (const pugi::xml_node node : structure.children("ContinuousStateDerivative")) d.derivatives.push_back(unknown(node));
        for (const pugi::xml_node node : structure.children("InitialUnknown")) d.initial.push_back(unknown(node));
        for (const pugi::xml_node node : structure.children("EventIndicator"))
            d.indicators += unknown(node).variable < d.variables.size() ? 1 : 0;
    }
    return d;
}

}  // namespace

References Description::references(const std::string& causality) const {
    References result;
    for (const Variable& v : variables)
        if (v.causality == causality) result.push_back(v.reference);
    return result;
}
References Description::rates() const {
    References result;
    for (const Unknown& u : derivatives) result.push_back(variables[u.variable].reference);
    return result;
}
References Description::states() const {
    References result;
    for (const Unknown& u : derivatives) result.push_back(variables[*variables[u.variable].derivative_of].reference);
    return result;
}
std::optional<unsigned> Description::mode() const {
    for (const Variable& v : variables)
        if (v.type == "Integer" || v.type == "Enumeration") return v.reference;
    return {};
}

Description unpack(const std::string& path, const std::string& folder) {
    unzip(path, folder);
    return read(fs::path(folder) / "modelDescription.xml");
}

}  // namespace fmi_test
