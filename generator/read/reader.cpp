// SPDX-License-Identifier: GPL-3.0-or-later
#include "read/reader.hpp"

#include <fmt/format.h>

#include "check/checks.hpp"
#include "read/entry.hpp"
#include "elements/expand_statics.hpp"
#include "elements/expand_switching.hpp"
#include "read/matrices.hpp"
#include "elements/methods.hpp"
#include "read/read_fluids.hpp"
#include "read/read_heat.hpp"
#include "read/read_mechanics.hpp"
#include "read/read_statics.hpp"
#include "read/read_switching.hpp"
#include "elements/verdict.hpp"
#include "check/written_values.hpp"
#include "text/budgets.hpp"
#include "text/files.hpp"
#include "text/nearest.hpp"

namespace dalembert {

namespace {

constexpr int newest_format = 1;

void read(const Entry& e, Size& size) {
    size.value = e.constant("value", {});
    size.range = e.range("range", {});
}

void read_quantity(const Entry& e, Quantity& quantity) {
    quantity.unit = e.unit("unit").value_or(Unit{});
    quantity.range = e.range("range", quantity.unit);
}

void read(const Entry& e, Parameter& parameter) {
    read_quantity(e, parameter);
    parameter.values = e.constants("value", parameter.unit);
}

void read(const Entry& e, Definition& definition) {
    definition.value = e.expression("value");
    definition.unit = e.unit("unit");
}

void read(const Entry& e, Coordinate& coordinate) {
    read_quantity(e, coordinate);
    coordinate.is_guess = e.has("guess");
    coordinate.start = e.constant(coordinate.is_guess ? "guess" : "start", coordinate.unit);
    if (coordinate.is_guess && e.has("start")) e.error(Id::unknown_key, e.span_of("guess"), fmt::format("coordinate '{}' has a start, so that there is nothing to be guessed", e.name()));
    Unit rate = coordinate.unit;
    rate.offset = 0;
    coordinate.start_rate = e.constant("start_rate", rate);
}

void read(const Entry& e, Input& input) { read_quantity(e, input); }

void read(const Entry& e, State& state) {
    read_quantity(e, state);
    state.start = e.constant("start", state.unit);
    state.derivative = e.expression("derivative");
    state.root = e.boolean("root");
}

void read(const Entry& e, Output& output) {
    output.value = e.expression("value");
    output.unit = e.unit("unit");
}

void read(const Entry& e, Effect& effect) {
    effect.excludes = e.names("excludes");
    effect.implies = e.names("implies");
    effect.level_of = e.text("level_of");
}

void read(const Entry& e, PrintedEquation& printed) {
    printed.source = e.text("source");
    printed.equations = e.has("equations") ? e.equations("equations") : e.equations("equation");
    for (const RunEntry& letter : e.by_name("with")) {
        if (letter.variable->kind == Expression::Kind::name && letter.variable->children.empty())
            printed.letters.push_back({letter.variable->name, letter.value, letter.span});
        else
            e.error(Id::bad_name, letter.span, fmt::format("'{}' is not a letter", letter.variable->written()));
    }
    for (const RunEntry& entry : e.by_name("at")) printed.at.push_back({entry.variable, entry.value});
    printed.shown = printed.equations;
    printed.shown_letters = printed.letters;
    try {
        take_matrices_apart(printed);
    } catch (const Failure& failure) {
        for (const Diagnostic& d : failure.diagnostics()) e.error(d.id, d.span, d.message);
    }
    if (e.has("equation") == e.has("equations"))
        e.error(Id::missing_key, e.span(), fmt::format("printed '{}' needs either an equation or a list of equations", e.name()));
    if (e.has("expect")) {
        printed.expected = read_verdict(e.text("expect"));
        if (!printed.expected)
            e.error(Id::wrong_type, e.span_of("expect"),
                    fmt::format("'{}' is not a verdict; the verdicts are {}", e.text("expect"), quoted_list({verdict_names.begin(), verdict_names.end()})));
    }
}

void read(const Entry& e, Run& run) {
    const Unit second{Dimension::time(), 1, 0, 0, "s"};
    run.until = e.constant("until", second);
    run.period = e.constant("period", second);
    run.step = e.constant("step", second);
    run.scene = e.text("scene");
    run.scene_span = e.span_of("scene");
    run.start = e.by_name("start");
    run.inputs = e.by_name("inputs");
    run.parameters = e.by_name("parameters");
    run.exact = e.by_name("exact");
    run.tolerance = e.number("tolerance").value_or(run.tolerance);
    if (!cln::plusp(run.tolerance) || run.tolerance >= 1)
        e.error(Id::value_out_of_range, e.span_of("tolerance"), "the tolerance lies between 0 and 1");
    run.method = e.text("method");
    const std::vector<std::string> methods = method_names();
    if (!run.method.empty() && std::find(methods.begin(), methods.end(), run.method) == methods.end())
        e.error(Id::wrong_type, e.span_of("method"), fmt::format("'{}' is not a method; the methods are {}", run.method, quoted_list(methods)));
    run.samples = e.whole_number("samples", run.samples);
    if (run.samples < 1 || run.samples > budget::samples)
        e.error(Id::value_out_of_range, e.span_of("samples"), fmt::format("the number of samples lies between 1 and {}", budget::samples));
    run.plots = e.plots("plots");
}

class Reader {
public:
    Reader(const SourcePtr& source, Diagnostics& diagnostics) : root_(parse_document(source)), diagnostics_(diagnostics) {
        model_.source = source;
    }

    Model read_all() {
        header();
        std::vector<std::string> known;
        for (const SectionSpec& section : sections()) known.emplace_back(section.name);
        for (const DocumentNode::Member& member : root_.members)
            if (find_section(member.key) == nullptr)
                diagnostics_.error(Id::unknown_key, member.key_span,
                                   fmt::format("a model has no section [{}]{}", member.key, did_you_mean(member.key, known)));
        collection("sizes", model_.sizes);
        collection("parameters", model_.parameters);
        collection("definitions", model_.definitions);
        collection("coordinates", model_.coordinates);
        collection("inputs", model_.inputs);
        collection("states", model_.states);
        collection("outputs", model_.outputs);
        gravity();
        collection("attitudes", model_.attitudes);
        expand_attitudes(model_);
        collection("solids", model_.solids);
        collection("bodies", model_.bodies);
        expand_solids(model_, diagnostics_);
        collection("springs", model_.springs);
        collection("dampers", model_.dampers);
        collection("forces", model_.forces);
        collection("torques", model_.torques);
        collection("jets", model_.jets);
        collection("cuts", model_.cuts);
        collection("loads", model_.loads);
        expand_loads(model_);
        collection("sticking", model_.stickings);
        collection("kinetic", model_.kinetic);
        collection("potentials", model_.potentials);
        collection("generalised_forces", model_.generalised_forces);
        collection("media", model_.media);
        collection("reservoirs", model_.reservoirs);
        collection("junctions", model_.junctions);
        collection("volumes", model_.volumes);
        collection("flows", model_.flows);
        collection("nodes", model_.nodes);
        collection("links", model_.links);
        collection("rods", model_.rods);
        collection("blocks", model_.blocks);
        collection("enclosures", model_.enclosures);
        collection("frictions", model_.frictions);
        collection("stops", model_.stops);
        collection("contacts", model_.contacts);
        collection("saturations", model_.saturations);
        collection("profiles", model_.profiles);
        collection("modes", model_.modes);
        collection("constraints", model_.constraints);
        collection("events", model_.events);
        expand_as_edges(model_, diagnostics_);
        keep_frictions_apart(model_, diagnostics_);
        expand_contacts(model_);
        expand_signals(model_);
        expand_balances(model_);
        collection("effects", model_.effects);
        scenes();
        collection("printed", model_.printed);
        collection("runs", model_.runs);
        return std::move(model_);
    }

private:
    void header() {
        const DocumentNode::Member* member = root_.find("model");
        if (member == nullptr)
            throw Failure(Diagnostic{Id::missing_key, Span{model_.source, 0, 0}, "the file has no [model] section and so is no model"});
        // The format comes first: a file of another format may have other keys, and errors about those would mislead.
        const Entry entry(*member, *find_section("model"), diagnostics_);
        if (const int format = entry.whole_number("format", newest_format); format != newest_format)
            throw Failure(Diagnostic{Id::unknown_format, entry.span_of("format"),
                                     fmt::format("the file has format {}, this program reads format {}", format, newest_format)});
        model_.name = entry.text("name");
        model_.name_span = entry.span_of("name");
        model_.title = entry.text("title");
        model_.reference = entry.text("source");
    }

    template <class T>
    void collection(const char* name, std::vector<T>& items) {
        const DocumentNode* table = section_table(name);
        if (table == nullptr) return;
        for (const DocumentNode::Member& member : table->members) items.push_back(item<T>(member, *find_section(name)));
    }

    template <class T>
    T item(const DocumentNode::Member& member, const SectionSpec& section) {
        const Entry entry(member, section, diagnostics_);
        T result;
        entry.fill(result);
        read(entry, result);
        return result;
    }

    const DocumentNode* section_table(const char* name) {
        const DocumentNode::Member* member = root_.find(name);
        if (member == nullptr) return nullptr;
        if (member->value.kind == DocumentNode::Kind::table) return &member->value;
        diagnostics_.error(Id::wrong_type, member->key_span, fmt::format("[{}] must be a table", name));
        return nullptr;
    }

    void gravity() {
        const DocumentNode::Member* member = root_.find("gravity");
        if (member == nullptr) return;
        const Entry entry(*member, *find_section("gravity"), diagnostics_);
        if (auto acceleration = entry.vector("acceleration"))
            model_.gravity = Gravity{*acceleration, entry.vector("reference"), entry.condition("when"), entry.span()};
    }

    void scenes() {
        const DocumentNode* table = section_table("scenes");
        if (table == nullptr) return;
        for (const DocumentNode::Member& member : table->members) {
            if (member.key != "default") {
                const Entry entry(member, *find_section("scenes"), diagnostics_);
                SceneChoice scene;
                entry.fill(scene);
                scene.effects = entry.names("effects");
                model_.scenes.push_back(std::move(scene));
            } else if (member.value.kind == DocumentNode::Kind::string) {
                model_.default_scene = member.value.string.text;
                default_span_ = member.value.span;
            } else {
                diagnostics_.error(Id::wrong_type, member.value.span, "default is the name of a scene");
            }
        }
        std::vector<std::string> names;
        for (const SceneChoice& scene : model_.scenes) names.push_back(scene.name);
        if (!model_.default_scene.empty() && std::find(names.begin(), names.end(), model_.default_scene) == names.end())
            diagnostics_.error(Id::unknown_scene, default_span_,
                               fmt::format("there is no scene '{}' that could be the default; the scenes are {}", model_.default_scene, quoted_list(names)));
    }

    DocumentNode root_;
    Diagnostics& diagnostics_;
    Model model_;
    Span default_span_;
};

}  // namespace

Model read_model(const SourcePtr& source, Diagnostics& diagnostics) {
    Model model = Reader(source, diagnostics).read_all();
    diagnostics.stop_on_errors();
    check_names(model, diagnostics);
    diagnostics.stop_on_errors();
    check_references(model, diagnostics);
    check_statics(model, diagnostics);
    check_balances(model, diagnostics);
    check_expressions(model, diagnostics);
    diagnostics.stop_on_errors();
    check_written_sizes(model, diagnostics);
    diagnostics.stop_on_errors();
    check_switching(model, diagnostics);
    diagnostics.stop_on_errors();
    convert_numbers(model);
    check_units(model, diagnostics);
    diagnostics.stop_on_errors();
    convert_values(model, diagnostics);
    diagnostics.stop_on_errors();
    return model;
}

Model read_model(const std::filesystem::path& path, Diagnostics& diagnostics) {
    return read_model(read_text_file(path), diagnostics);
}

}  // namespace dalembert
