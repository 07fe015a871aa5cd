// SPDX-License-Identifier: GPL-3.0-or-later
// The one list of kinds of elements, in the order of sections and walks.
#pragma once

namespace dalembert {

/// Calls visit(section, items) for each kind of which `holder`, a model or a scene, has items.
template <class Holder, class Visit>
void for_each_kind(Holder& holder, const Visit& visit) {
#define DALEMBERT_KIND(section, member) \
    if constexpr (requires { holder.member; }) visit(section, holder.member)
    DALEMBERT_KIND("sizes", sizes);
    DALEMBERT_KIND("parameters", parameters);
    DALEMBERT_KIND("definitions", definitions);
    DALEMBERT_KIND("coordinates", coordinates);
    DALEMBERT_KIND("inputs", inputs);
    DALEMBERT_KIND("states", states);
    DALEMBERT_KIND("outputs", outputs);
    DALEMBERT_KIND("gravity", gravity);
    DALEMBERT_KIND("attitudes", attitudes);
    DALEMBERT_KIND("solids", solids);
    DALEMBERT_KIND("bodies", bodies);
    DALEMBERT_KIND("springs", springs);
    DALEMBERT_KIND("dampers", dampers);
    DALEMBERT_KIND("forces", forces);
    DALEMBERT_KIND("torques", torques);
    DALEMBERT_KIND("jets", jets);
    DALEMBERT_KIND("cuts", cuts);
    DALEMBERT_KIND("loads", loads);
    DALEMBERT_KIND("sticking", stickings);
    DALEMBERT_KIND("kinetic", kinetic);
    DALEMBERT_KIND("potentials", potentials);
    DALEMBERT_KIND("generalised_forces", generalised_forces);
    DALEMBERT_KIND("media", media);
    DALEMBERT_KIND("reservoirs", reservoirs);
    DALEMBERT_KIND("junctions", junctions);
    DALEMBERT_KIND("volumes", volumes);
    DALEMBERT_KIND("flows", flows);
    DALEMBERT_KIND("nodes", nodes);
    DALEMBERT_KIND("links", links);
    DALEMBERT_KIND("rods", rods);
    DALEMBERT_KIND("blocks", blocks);
    DALEMBERT_KIND("enclosures", enclosures);
    DALEMBERT_KIND("frictions", frictions);
    DALEMBERT_KIND("stops", stops);
    DALEMBERT_KIND("contacts", contacts);
    DALEMBERT_KIND("saturations", saturations);
    DALEMBERT_KIND("profiles", profiles);
    DALEMBERT_KIND("modes", modes);
    DALEMBERT_KIND("constraints", constraints);
    DALEMBERT_KIND("events", events);
    DALEMBERT_KIND("printed", printed);
    DALEMBERT_KIND("runs", runs);
#undef DALEMBERT_KIND
}

}  // namespace dalembert
