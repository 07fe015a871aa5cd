// SPDX-License-Identifier: GPL-3.0-or-later
#include "report/drawing_json.hpp"

namespace dalembert {

namespace {

using Json = nlohmann::ordered_json;

Json place(const std::optional<std::size_t>& one) { return one ? Json(*one) : Json(); }

/// What the view of the model says, with places of measures.
Json view_json(const MachineDrawing& drawing) {
    Json view;
    view = {{"count", drawing.measures.size()}, {"ground", place(drawing.ground)},  {"turn", place(drawing.turn)},
            {"tilt", place(drawing.tilt)},      {"has_trails", drawing.has_trails}, {"looks", Json::array()}};
    for (const MachineDrawing::Look& look : drawing.looks)
        view["looks"].push_back({{"shape", look.shape},
                                 {"colour", look.colour},
                                 {"hidden", look.hidden},
                                 {"radius", place(look.radius)},
                                 {"width", place(look.width)},
                                 {"height", place(look.height)},
                                 {"rotation", place(look.rotation)}});
    return view;
}

/// Parts, links and layouts of the network of fluids, heat and circuits.
Json network_json(const NetworkDrawing& network, const UsualUnit& usual_unit) {
    const auto points = [](const std::vector<GridPoint>& list) {
        Json rows = Json::array();
        for (const GridPoint& one : list) rows.push_back({one.column, one.row});
        return rows;
    };
    Json made;
    for (const NetworkDrawing::Part& part : network.parts)
        made["parts"].push_back({{"name", part.name},
                                 {"kind", part.kind},
                                 {"pressure", place(part.pressure)},
                                 {"temperature", place(part.temperature)},
                                 {"size", place(part.size)},
                                 {"voltage", place(part.voltage)},
                                 {"speed", place(part.speed)},
                                 {"angle", place(part.angle)},
                                 {"cells", place(part.cells)},
                                 {"count", part.cell_count},
                                 {"across", part.cells_across}});
    made["links"] = Json::array();
    for (const NetworkDrawing::Link& link : network.links)
        made["links"].push_back({{"name", link.name},
                                 {"kind", link.kind},
                                 {"from", link.from},
                                 {"to", link.to},
                                 {"carries", link.carries},
                                 {"flow", place(link.flow)},
                                 {"conducts", place(link.conducts)},
                                 {"ratio", place(link.ratio)}});
    for (const LayeredLayout& layout : network.layouts) {
        Json paths = Json::array();
        for (const auto& path : layout.paths) paths.push_back(points(path));
        made["layouts"].push_back({{"columns", layout.columns},
                                   {"rows", layout.rows},
                                   {"parts", points(layout.nodes)},
                                   {"stations", points(layout.stations)},
                                   {"paths", paths},
                                   {"headings", layout.headings}});
    }
    made["count"] = network.values.size();
    for (const auto& [name, si] :
         {std::pair{"pressure", "Pa"}, {"temperature", "K"}, {"size", "m^3"}, {"voltage", "V"}, {"speed", "rad/s"}, {"mass", "kg/s"},
          {"heat", "W"}, {"current", "A"}, {"torque", "N*m"}})
        made["units"][name] = usual_unit(si);
    return made;
}

}  // namespace

Json drawing_json(const MachineDrawing& drawing, const UsualUnit& usual_unit) {
    Json json;
    json["bodies"] = drawing.bodies;
    for (const MachineDrawing::Bar& bar : drawing.bars) json["bars"].push_back({bar.from, bar.to});
    json["connectors"] = Json::array();
    for (const MachineDrawing::Connector& one : drawing.connectors)
        json["connectors"].push_back({{"from", one.from},
                                      {"to", one.to},
                                      {"has_wall", one.has_wall},
                                      {"is_damper", one.is_damper},
                                      {"beside", one.beside},
                                      {"together", one.together}});
    json["forces"] = Json::array();
    for (const MachineDrawing::DrawnForce& force : drawing.forces)
        json["forces"].push_back({{"name", force.name}, {"at", force.at}, {"is_torque", force.is_torque}});
    json["points"] = drawing.coordinates.size() / 3;
    json["framed"] = drawing.framed;
    json["plane"] = drawing.plane;
    json["shapes"] = Json::array();
    for (const MachineDrawing::Shape& shape : drawing.shapes)
        json["shapes"].push_back({{"body", shape.body}, {"kind", shape.kind}, {"first", shape.first}, {"sizes", shape.sizes}});
    json["view"] = view_json(drawing);
    if (!drawing.networks.front().empty()) json["network"] = network_json(drawing.networks.front(), usual_unit);
    return json;
}

}  // namespace dalembert
