// SPDX-License-Identifier: GPL-3.0-or-later
// A model as it was written: plain data, every part with its place. Nothing is chosen, expanded or derived yet. Bodies, forces, fluids and
// what carries heat are only declared here: who works with some of them includes their file, who works with all of them every_kind.hpp.
#pragma once

#include "elements/curves.hpp"
#include "elements/gravity.hpp"
#include "elements/kinds.hpp"
#include "elements/quantities.hpp"
#include "elements/runs.hpp"
#include "elements/samplers.hpp"
#include "elements/switching.hpp"
#include "elements/view.hpp"

namespace dalembert {

struct Model {
    // Defined where all elements are known.
    Model();
    ~Model();
    Model(const Model& other);
    Model(Model&& other) noexcept;
    Model& operator=(const Model& other);
    Model& operator=(Model&& other) noexcept;

    SourcePtr source;
    std::string name;
    Span name_span;
    std::string title;
    std::string doc;
    std::string reference;  ///< the text it comes from, with equation numbers
    std::vector<Size> sizes;
    std::vector<Parameter> parameters;
    std::vector<Definition> definitions;
    std::vector<Coordinate> coordinates;
    std::vector<Input> inputs;
    std::vector<State> states;
    std::vector<Output> outputs;
    std::vector<Curve> curves;
    std::optional<Gravity> gravity;
    std::vector<Attitude> attitudes;
    std::vector<Joint> joints;
    std::vector<Solid> solids;
    std::vector<Body> bodies;
    std::vector<Spring> springs;
    std::vector<Damper> dampers;
    std::vector<Force> forces;
    std::vector<Torque> torques;
    std::vector<Jet> jets;
    std::vector<Cut> cuts;
    std::vector<Load> loads;
    std::vector<Sticking> stickings;
    std::vector<KineticTerm> kinetic;
    std::vector<PotentialTerm> potentials;
    std::vector<GeneralisedForce> generalised_forces;
    std::vector<Medium> media;
    std::vector<Reservoir> reservoirs;
    std::vector<Junction> junctions;
    std::vector<Volume> volumes;
    std::vector<Flow> flows;
    std::vector<HeatNode> nodes;
    std::vector<Link> links;
    std::vector<Rod> rods;
    std::vector<Block> blocks;
    std::vector<Enclosure> enclosures;
    std::vector<Pin> pins;
    std::vector<Branch> branches;
    std::vector<Friction> frictions;
    std::vector<Stop> stops;
    std::vector<Contact> contacts;
    std::vector<Saturation> saturations;
    std::vector<Profile> profiles;
    std::vector<ModeGroup> modes;           ///< with those of the elements above, as the next two
    std::vector<Constraint> constraints;
    std::vector<Event> events;
    std::vector<Effect> effects;
    std::vector<SceneChoice> scenes;
    std::string default_scene;
    std::vector<PrintedEquation> printed;
    std::vector<Run> runs;
    std::optional<View> view;
    std::vector<Measurement> measurements;
    std::optional<ControllerSampling> sampling;  ///< of a controller
    std::vector<Sampler> samplers;
    std::vector<Use> uses;    ///< whose elements are among those above
    std::vector<Port> ports;
};

}  // namespace dalembert
