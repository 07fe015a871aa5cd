// SPDX-License-Identifier: GPL-3.0-or-later
#include "elements/every_kind.hpp"

namespace dalembert {

Model::Model() = default;
Model::~Model() = default;
Model::Model(const Model& other) = default;
Model::Model(Model&& other) noexcept = default;
Model& Model::operator=(const Model& other) = default;
Model& Model::operator=(Model&& other) noexcept = default;

}  // namespace dalembert
