// SPDX-License-Identifier: GPL-3.0-or-later
// What one scene of a model contains, families counted out. What the scene does not call for is gone: components, and the
// parameters, inputs and states that only they used. Other elements than quantities and what switches are only declared here, so that a
// change of one of them compiles what works with it and no more.
#pragma once

#include <map>
#include <set>

#include "elements/kinds.hpp"
#include "elements/names.hpp"
#include "elements/quantities.hpp"
#include "elements/switching.hpp"
#include "text/diagnostic.hpp"

namespace dalembert {

/// One member of a family, or an item that is none.
template <class T>
struct Member {
    const T* item;
    int index = 0;  ///< of a family

    std::string name() const { return item->family ? item->name + "[" + std::to_string(index) + "]" : item->name; }
};

/// Whether elements of this kind are in a scene where something uses them; the others by their conditions.
template <class Element>
inline constexpr bool is_there_where_used =
    std::is_same_v<Element, Parameter> || std::is_same_v<Element, Definition> || std::is_same_v<Element, Input> ||
    std::is_same_v<Element, State> || std::is_same_v<Element, Solid> || std::is_same_v<Element, Medium>;

/// A family of states that is computed in loops: the cells of a rod or block with many of them. Of its states only those are in the
/// scene that something else needs, and the first and last.
struct Field {
    const Item* body;
    std::string_view kind;  ///< "rod", "block"
    const State* states;
    int from, to;
    int columns;            ///< cells in a row; of a rod, all
    std::set<int> tapped;
    std::string written() const;  ///< "rod 'bar'"
};

/// The value of the index of a family or sum, by name.
using Indices = std::map<std::string, int, std::less<>>;

/// A mode of the whole machine: one of each group.
struct SceneMode {
    std::string name;  ///< "brake_sticks_and_rope_slack"
    std::vector<const Mode*> parts;
    bool is_in(const std::string& part) const;
};

struct Scene {
    const Model* model;
    std::string name;
    std::string base;    ///< the scene of the model that it is, or was made from
    std::string wish;    ///< as one asks for it: "full-drag"
    std::string doc;
    std::vector<const Effect*> effects_in;   ///< in order of declaration
    std::vector<const Effect*> effects_out;
    std::map<std::string, int, std::less<>> sizes;

    std::vector<Member<Parameter>> parameters;
    std::map<std::string, ExpressionPtr, std::less<>> fixed;  ///< parameters that are numbers; null: their defaults
    std::set<std::string, std::less<>> folded;    ///< definitions of these alone, which are inserted
    std::string fix_text;                         ///< how that was asked for
    std::vector<Member<Definition>> definitions;  ///< of parameters alone; the others are inserted where they are used
    std::vector<Member<Coordinate>> coordinates;
    std::vector<Member<Input>> inputs;
    std::vector<Member<State>> states;
    std::vector<Member<Output>> outputs;
    const Gravity* gravity = nullptr;
    std::vector<Member<Body>> bodies;
    std::vector<Member<Spring>> springs;
    std::vector<Member<Damper>> dampers;
    std::vector<Member<Force>> forces;
    std::vector<Member<Torque>> torques;
    std::vector<Member<Jet>> jets;
    std::vector<const Solid*> solids;             ///< that anything uses, and what they are made of; in order of declaration
    std::vector<const Load*> loads;
    std::vector<const Sticking*> stickings;
    std::vector<Member<KineticTerm>> kinetic;
    std::vector<Member<PotentialTerm>> potentials;
    std::vector<Member<GeneralisedForce>> generalised_forces;
    std::vector<Member<Medium>> media;
    std::vector<Member<Reservoir>> reservoirs;
    std::vector<Member<Junction>> junctions;
    std::vector<Member<Volume>> volumes;
    std::vector<Member<Flow>> flows;
    std::vector<Member<HeatNode>> nodes;
    std::vector<Member<Link>> links;
    std::vector<Member<Rod>> rods;
    std::vector<Member<Block>> blocks;
    std::vector<Member<Enclosure>> enclosures;
    std::vector<Member<Pin>> pins;
    std::vector<Member<Branch>> branches;
    const ControllerSampling* sampling = nullptr;           ///< of a controller
    std::vector<const Sampler*> samplers;
    std::vector<Member<Constraint>> constraints;  ///< of all modes, as the next one
    std::vector<Member<Event>> events;
    std::vector<const ModeGroup*> mode_groups;
    std::vector<SceneMode> modes;                 ///< none: the machine does not switch
    std::optional<std::size_t> mode;              ///< the one that this scene is about; else it has what any of them has
    std::vector<Field> fields;
    std::set<std::string> thermal_media;  ///< whose temperature varies, so that it matters

    /// Whether the condition of an item holds, in the mode of the scene or else in any.
    bool holds(const std::optional<Condition>& when) const;
    bool holds(const std::optional<Condition>& when, std::size_t in_mode) const;
    /// The modes that an event leads to, in order of preference. Where the scene lacks one of them, those take its place that have what
    /// the event asks for and differ from it in the fewest other groups: what meets a stop sticks there. None at all: the one it comes
    /// from.
    std::vector<std::size_t> modes_after(const std::vector<Condition>& next, std::size_t from) const;
    /// Further modes that an event with these next ones may lead to, because it drives other parts of the machine out of theirs:
    /// an impact turns a velocity round, so that friction acts the other way; a force that a profile switches on tears loose
    /// what sticks.
    std::vector<std::size_t> modes_beside(const Event& event, const std::vector<Condition>& next, std::size_t from) const;
    /// Whether a volume has a temperature state in this scene.
    bool has_temperature(const Volume& volume, const Names& names) const;
    /// Whether a node stores heat in this scene.
    bool has_capacity(const HeatNode& node, const Names& names) const;
    /// The field of a rod; null where its cells are states one by one.
    const Field* find_field(const Item& body) const;
    /// The number of states, cells of fields included.
    std::size_t state_count() const;
    /// "n_pendulum_N5": the model's name and its sizes.
    std::string sized_name() const;
};

/// The names of the scenes; "full" alone where the model has none.
std::vector<std::string> scene_names(const Model& model);

/// The scene that is meant: the one named, else the default, else the only one, with the effects that are added or left out. Throws
/// Failure (unknown-scene, scene-needed, unknown-name).
std::string resolve_scene(const Model& model, const std::string& wanted);

/// Throws Failure (scene-contradiction, unknown-size, value-out-of-range, needs-absent, nothing-left, too-large).
Scene select_scene(const Model& model, const Names& names, const std::string& scene, const std::map<std::string, int>& sizes);

/// The scene in one of its modes.
Scene in_mode(const Scene& scene, std::size_t mode);

/// A whole number made of sizes and indices. Throws Failure (index-out-of-range) when it is none.
int index_value(const Expression& expression, const Scene& scene, const Indices& indices);

/// The bounds of a family. Throws Failure (too-large) beyond 10000 members.
std::pair<int, int> bounds(const Family& family, const Scene& scene);

/// What a member of a parameter is: the value that it is fixed to, or else its default. Throws Failure (wrong-arguments) when there are not
/// as many defaults as members.
const ExpressionPtr& value_of(const Member<Parameter>& member, const Scene& scene);

/// What `values`, the `key` of an item, say of its member with that index: null where they say nothing. Throws Failure (wrong-arguments)
/// when they are a list that does not have a value for each member.
const ExpressionPtr& value_of_member(const MemberValues& values, const char* key, const char* kind, const Item& item, int index,
                                     const Scene& scene);
template <class Element>
const ExpressionPtr& start_of(const Member<Element>& member, const Scene& scene) {
    const char* key = "start";
    if constexpr (requires { member.item->is_guess; }) key = member.item->is_guess ? "guess" : key;
    return value_of_member(member.item->start, key, kind_of<Element>.word, *member.item, member.index, scene);
}
inline const ExpressionPtr& start_rate_of(const Member<Coordinate>& member, const Scene& scene) {
    return value_of_member(member.item->start_rate, "start_rate", kind_of<Coordinate>.word, *member.item, member.index, scene);
}
/// The index of the member whose value a list gives at a place; throws like value_of_member.
int index_in_list(const RunEntry::OfList& place, const Span& list, const std::string& what, const Item& item, const Scene& scene);

/// A parameter, or all members of a family.
std::vector<Member<Parameter>> members_of(const Parameter& parameter, const Scene& scene);

/// Warns of parameters, definitions and inputs that nothing in the model uses.
void warn_of_unused(const Model& model, Diagnostics& diagnostics);

}  // namespace dalembert
