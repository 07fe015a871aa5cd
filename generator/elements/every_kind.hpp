// SPDX-License-Identifier: GPL-3.0-or-later
// A model with all kinds of elements, for what treats them alike.
#pragma once

#include "elements/bodies.hpp"
#include "elements/circuits.hpp"
#include "elements/conduction.hpp"
#include "elements/fluids.hpp"
#include "elements/forces.hpp"
#include "elements/heat.hpp"
#include "elements/joints.hpp"
#include "elements/model.hpp"
#include "elements/parts.hpp"
#include "elements/statics.hpp"

namespace dalembert {

#define DALEMBERT_COMPLETE(section, member, Type) static_assert(sizeof(Type) > 0, "include the file of each kind above");
DALEMBERT_KINDS(DALEMBERT_COMPLETE)
#undef DALEMBERT_COMPLETE

}  // namespace dalembert
