// SPDX-License-Identifier: GPL-3.0-or-later
#include "read/reader.hpp"

#include <fmt/format.h>

#include <map>

#include "check/checks.hpp"
#include "check/written_values.hpp"
#include "elements/bodies.hpp"
#include "elements/every_kind.hpp"
#include "elements/expand_statics.hpp"
#include "elements/expand_switching.hpp"
#include "elements/kinds.hpp"
#include "elements/joints.hpp"
#include "elements/runs.hpp"
#include "read/described.hpp"
#include "read/parts.hpp"
#include "read/rules.hpp"
#include "read/run_lists.hpp"
#include "read/samplers.hpp"
#include "text/budgets.hpp"
#include "text/files.hpp"
#include "text/nearest.hpp"

namespace dalembert {

namespace {

constexpr int newest_format = 1;

/// What elements stand for is written out, and everything is checked.
void complete(Model& model, Diagnostics& diagnostics) {
    expand_joints(model, diagnostics);
    diagnostics.stop_on_errors();
    expand_attitudes(model);
    expand_solids(model, diagnostics);
    expand_loads(model);
    expand_as_edges(model, diagnostics);
    keep_frictions_apart(model, diagnostics);
    expand_contacts(model);
    expand_signals(model);
    expand_balances(model);
    expand_circuits(model);
    expand_samplers(model, diagnostics);
    expand_run_lists(model, diagnostics);
    diagnostics.stop_on_errors();
    check_names(model, diagnostics);
    diagnostics.stop_on_errors();
    check_references(model, diagnostics);
    check_balances(model, diagnostics);
    check_sampling(model, diagnostics);
    check_expressions(model, diagnostics);
    diagnostics.stop_on_errors();
    check_controller_parameters(model, diagnostics);
    check_written_sizes(model, diagnostics);
    diagnostics.stop_on_errors();
    check_switching(model, diagnostics);
    diagnostics.stop_on_errors();
    convert_numbers(model);
    check_units(model, diagnostics);
    diagnostics.stop_on_errors();
    convert_values(model, diagnostics);
    diagnostics.stop_on_errors();
    for (State& state : model.states)
        if (state.next) state.derivative = state.next;
}

class Reader {
public:
    Reader(const SourcePtr& source, Diagnostics& diagnostics) : root_(parse_document(source)), diagnostics_(diagnostics) {
        model_.source = source;
    }

    /// With its parts, as it is written.
    Model read_all() {
        header();
        std::vector<Part> parts = read_parts();
        std::map<std::string, Model> controllers = read_controllers();
        std::vector<std::string> known;
        for (const SectionSpec& section : sections()) known.emplace_back(section.name);
        for (const DocumentNode::Member& member : root_.members)
            if (find_section(member.key) == nullptr)
                diagnostics_.error(Id::unknown_key, member.key_span,
                                   fmt::format("a model has no section [{}]{}", member.key, did_you_mean(member.key, known)));
        for_each_kind(model_, [&](const char* section, auto& items) { collection(section, items); });
        check_default_scene();
        expand_joints(model_, diagnostics_);
        if (model_.uses.empty()) check_jointed_bodies();
        for (Sampler& sampler : model_.samplers)
            if (const auto found = controllers.find(sampler.name); found != controllers.end()) complete_controller(sampler, found->second);
        if (!model_.uses.empty()) {
            diagnostics_.stop_on_errors();
            join_parts(model_, std::move(parts), diagnostics_);
        } else {
            name_pins(model_);
        }
        open_pins_at_ports(model_);
        return std::move(model_);
    }

private:
    /// Each file is checked as a model of its own, so that its errors are those of its own names.
    std::vector<Part> read_parts() {
        std::vector<Part> parts;
        std::vector<std::string> names;
        const DocumentNode* uses = section_table("use");
        if (uses == nullptr) return parts;
        for (const DocumentNode::Member& use : uses->members) {
            const DocumentNode::Member* key = use.value.find("file");
            const DocumentNode& file = key == nullptr ? use.value : key->value;
            if (file.kind != DocumentNode::Kind::string) continue;  // told where it is read
            Diagnostics of_part;
            Part& part = parts.emplace_back();
            part.name = use.key;
            part.model = Reader(source_of_part(use, file), of_part).read_all();
            of_part.stop_on_errors();
            if (part.model.sampling)
                throw Failure(Diagnostic{Id::not_allowed_here, file.span,
                                         fmt::format("part '{}' is a controller that samples; name it in [samplers], not in [use]",
                                                     use.key),
                                         {{part.model.sampling->span, "it samples because of this section"}}});
            if (!part.model.samplers.empty())
                throw Failure(Diagnostic{Id::not_allowed_here, file.span,
                                         fmt::format("part '{}' has [samplers]; controllers belong to the model that uses the part",
                                                     use.key),
                                         {{part.model.samplers.front().span, "they stand here"}}});
            Model alone = part.model;
            complete(alone, of_part);
            const Names of_alone(alone);
            for (const auto& entry : of_alone.table()) part.formulas.insert(entry.first);
            for (const Curve& curve : alone.curves) part.formulas.insert(curve.name);
            names.push_back(part.name);
            for (const Use& inside : part.model.uses) names.push_back(part.name + "_" + inside.name);
            if (names.size() > budget::parts)
                throw Failure(Diagnostic{Id::too_large, use.key_span, fmt::format("the model has more than {} parts", budget::parts)});
        }
        join_names(root_, names);
        return parts;
    }

    /// As their files say, by sampler.
    std::map<std::string, Model> read_controllers() {
        std::map<std::string, Model> controllers;
        const DocumentNode* samplers = section_table("samplers");
        if (samplers == nullptr) return controllers;
        for (const DocumentNode::Member& sampler : samplers->members) {
            const DocumentNode::Member* key = sampler.value.find("file");
            const DocumentNode& file = key == nullptr ? sampler.value : key->value;
            if (file.kind != DocumentNode::Kind::string) continue;  // told where it is read
            Diagnostics of_controller;
            controllers.emplace(sampler.key, Reader(source_of_part(sampler, file, "controller"), of_controller).read_all());
            of_controller.stop_on_errors();
        }
        return controllers;
    }

    void complete_controller(Sampler& sampler, Model& controller) {
        set_controller(controller, sampler, model_.name, diagnostics_);
        diagnostics_.stop_on_errors();
        Diagnostics of_controller;
        complete(controller, of_controller);
        sampler.controller = std::make_shared<const Model>(std::move(controller));
    }

    void header() {
        const DocumentNode::Member* member = root_.find("model");
        if (member == nullptr)
            throw Failure(Diagnostic{Id::missing_key, Span{model_.source, 0, 0}, "the file has no [model] section, so it is not a model"});
        // The format comes first: a file of another format may have other keys, and errors about those would mislead.
        const Entry entry(*member, *find_section("model"), diagnostics_);
        if (const int format = entry.whole_number("format", newest_format); format != newest_format)
            throw Failure(Diagnostic{Id::unknown_format, entry.span_of("format"),
                                     fmt::format("the file has format {}, this program reads format {}", format, newest_format)});
        model_.name = entry.text("name");
        model_.name_span = entry.span_of("name");
        model_.title = entry.text("title");
        model_.doc = entry.text("doc");
        model_.reference = entry.text("source");
    }

    template <class T>
    void collection(const char* name, std::vector<T>& items) {
        const DocumentNode* table = section_table(name);
        if (table == nullptr) return;
        for (const DocumentNode::Member& member : table->members) {
            if (std::is_same_v<T, SceneChoice> && member.key == "default") default_scene(member.value);
            else items.push_back(item<T>(member, name));
        }
    }

    template <class T>
    void collection(const char* name, std::optional<T>& alone) {
        if (const DocumentNode::Member* member = root_.find(name)) alone = item<T>(*member, name);
    }

    template <class T>
    T item(const DocumentNode::Member& member, const char* section) {
        const Entry entry(member, *find_section(section), diagnostics_);
        T result;
        if constexpr (std::derived_from<T, Item>) entry.fill(result);
        else fill(entry, result);
        read_described(entry, result);
        if constexpr (std::is_same_v<T, Body>) result.is_jointed = is_jointed(member.key);
        if constexpr (requires { check_rules(entry, result); }) check_rules(entry, result);
        return result;
    }

    /// Told here, because the body that is meant would lack its place.
    void check_jointed_bodies() {
        std::vector<std::string> names;
        for (const Body& body : model_.bodies) names.push_back(body.name);
        for (const Joint& joint : model_.joints)
            if (joint.body && joint.places_body() && std::find(names.begin(), names.end(), joint.body->name) == names.end())
                diagnostics_.error(Id::unknown_name, joint.body->span,
                                   fmt::format("there is no body '{}' for 'body' of joint '{}'{}", joint.body->name, joint.name,
                                               did_you_mean(joint.body->name, names)));
    }

    bool is_jointed(const std::string& body) const {
        const DocumentNode::Member* joints = root_.find("joints");
        if (joints == nullptr || joints->value.kind != DocumentNode::Kind::table) return false;
        return std::any_of(joints->value.members.begin(), joints->value.members.end(), [&](const DocumentNode::Member& joint) {
            const DocumentNode::Member* placed = joint.value.find("body");
            return placed != nullptr && placed->value.kind == DocumentNode::Kind::string && placed->value.string.text == body;
        });
    }

    template <class T>
    static void fill(const Entry& entry, T& alone) {
        if constexpr (requires { alone.when; }) alone.when = entry.condition("when");
        alone.span = entry.span();
    }

    const DocumentNode* section_table(const char* name) {
        const DocumentNode::Member* member = root_.find(name);
        if (member == nullptr) return nullptr;
        if (member->value.kind == DocumentNode::Kind::table) return &member->value;
        diagnostics_.error(Id::wrong_type, member->key_span, fmt::format("[{}] must be a table", name));
        return nullptr;
    }

    void default_scene(const DocumentNode& value) {
        if (value.kind != DocumentNode::Kind::string)
            return diagnostics_.error(Id::wrong_type, value.span, "default is the name of a scene");
        model_.default_scene = value.string.text;
        default_span_ = value.span;
    }

    void check_default_scene() {
        std::vector<std::string> names;
        for (const SceneChoice& scene : model_.scenes) names.push_back(scene.name);
        if (!model_.default_scene.empty() && std::find(names.begin(), names.end(), model_.default_scene) == names.end())
            diagnostics_.error(
                Id::unknown_scene, default_span_,
                fmt::format("the default scene '{}' does not exist; the scenes are {}", model_.default_scene, quoted_list(names)));
    }

    DocumentNode root_;
    Diagnostics& diagnostics_;
    Model model_;
    Span default_span_;
};

}  // namespace

Model read_model(const SourcePtr& source, Diagnostics& diagnostics) {
    Model model = Reader(source, diagnostics).read_all();
    complete(model, diagnostics);
    return model;
}

Model read_model(const std::filesystem::path& path, Diagnostics& diagnostics) {
    return read_model(read_text_file(path), diagnostics);
}

}  // namespace dalembert
