// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "shaders/material_oracle.h"

#include <string>
#include <vector>

namespace tyndall::test {

struct NamedQuery {
  std::string name;
  interop::BsdfQuery query;
};

/// A material seen at an angle, with index ratio 1.5 and colours that differ per channel.
interop::BsdfQuery bsdfQuery(MaterialId model, double roughness, double cosine);

/// Every model of material/list.h but null, over roughness, angles from normal to grazing, both sides, index ratios 1.5
/// and 1 / 1.5. No deltas.
std::vector<NamedQuery> roughCases();

/// The probe's answers, one per query or `count` of them.
std::vector<interop::BsdfAnswer> askBsdf(const std::vector<interop::BsdfQuery>& queries, std::uint32_t mode,
                                         std::uint32_t planted = interop::kPlantNone, std::uint32_t count = 0);

} // namespace tyndall::test
