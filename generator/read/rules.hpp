// SPDX-License-Identifier: GPL-3.0-or-later
// What descriptions do not say about keys: rules between several of them, and values that follow from others. An element is filled by its
// description before.
#pragma once

#include "read/entry.hpp"

namespace dalembert {

void check_rules(const Entry& e, Coordinate& coordinate);
void check_rules(const Entry& e, Curve& curve);
void check_rules(const Entry& e, Attitude& attitude);
void check_rules(const Entry& e, Body& body);
void check_rules(const Entry& e, Torque& torque);
void check_rules(const Entry& e, Cut& cut);
void check_rules(const Entry& e, Solid& solid);
void check_rules(const Entry& e, Load& load);
void check_rules(const Entry& e, Sticking& sticking);
void check_rules(const Entry& e, Medium& medium);
void check_rules(const Entry& e, Volume& volume);
void check_rules(const Entry& e, Flow& flow);
void check_rules(const Entry& e, HeatNode& node);
void check_rules(const Entry& e, Link& link);
void check_rules(const Entry& e, Rod& rod);
void check_rules(const Entry& e, Block& block);
void check_rules(const Entry& e, Enclosure& enclosure);
void check_rules(const Entry& e, Branch& branch);
void check_rules(const Entry& e, ModeGroup& group);
void check_rules(const Entry& e, Event& event);
void check_rules(const Entry& e, Profile& profile);
void check_rules(const Entry& e, PrintedEquation& printed);
void check_rules(const Entry& e, Run& run);
void check_rules(const Entry& e, Use& use);
void check_rules(const Entry& e, Port& port);
void check_rules(const Entry& e, Sampler& sampler);

}  // namespace dalembert
