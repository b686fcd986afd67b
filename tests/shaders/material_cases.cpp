// SPDX-License-Identifier: Apache-2.0
#include "shaders/material_cases.h"

#include "support/probe.h"

// Needs <cstdint> before it.
#include "kernels/material_probe.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace tyndall::test {

using interop::BsdfAnswer;
using interop::BsdfQuery;

BsdfQuery bsdfQuery(MaterialId model, double roughness, double cosine) {
  BsdfQuery query{};
  query.model = static_cast<std::uint32_t>(model);
  query.colour = glm::vec3(0.9f, 0.6f, 0.2f);
  query.alpha = static_cast<float>(roughness * roughness);
  query.etaRatio = 1.5f;
  query.coatF0 = 0.04f;
  const double sine = std::sqrt(1.0 - cosine * cosine);
  query.wo = glm::vec3(sine * 0.8, sine * -0.6, cosine);
  query.wi = glm::vec3(0.0f, 0.0f, 1.0f);
  return query;
}

std::vector<NamedQuery> roughCases() {
  std::vector<NamedQuery> cases;
  const auto add = [&](MaterialId model, const std::string& name, const BsdfQuery& query) {
    cases.push_back(
        {fmt::format("{} {} alpha {} cos {}", static_cast<unsigned>(model), name, query.alpha, query.wo.z), query});
  };
  for (const double cosine : {0.99, 0.5, 0.05}) {
    add(MaterialId::Diffuse, "front", bsdfQuery(MaterialId::Diffuse, 0.0, cosine));
    add(MaterialId::Diffuse, "back", bsdfQuery(MaterialId::Diffuse, 0.0, -cosine));
    for (const double roughness : {0.02, 0.1, 0.3, 0.7, 1.0}) {
      add(MaterialId::Conductor, "Schlick", bsdfQuery(MaterialId::Conductor, roughness, cosine));
      add(MaterialId::Conductor, "gold", bsdfQuery(MaterialId::Conductor, roughness, cosine));
      cases.back().query.eta = glm::vec3(0.18f, 0.42f, 1.37f);
      cases.back().query.k = glm::vec3(3.4f, 2.3f, 1.77f);
      add(MaterialId::Dielectric, "outside", bsdfQuery(MaterialId::Dielectric, roughness, cosine));
      add(MaterialId::Dielectric, "inside", bsdfQuery(MaterialId::Dielectric, roughness, -cosine));
      add(MaterialId::Dielectric, "bubble", bsdfQuery(MaterialId::Dielectric, roughness, cosine));
      cases.back().query.etaRatio = static_cast<float>(1.0 / 1.5);
      for (const float metallic : {0.0f, 0.5f, 1.0f}) {
        add(MaterialId::MetalRough, fmt::format("metallic {}", metallic),
            bsdfQuery(MaterialId::MetalRough, roughness, cosine));
        cases.back().query.metallic = metallic;
      }
    }
  }
#define X(Name, prefix, id, sceneName)                                                                                 \
  EXPECT_EQ(std::any_of(cases.begin(), cases.end(), [](const NamedQuery& one) { return one.query.model == id; }),      \
            MaterialId::Name != MaterialId::Null)                                                                      \
      << sceneName << " has no test cases";
  TYNDALL_MATERIAL_LIST(X)
#undef X
  return cases;
}

std::vector<BsdfAnswer> askBsdf(const std::vector<BsdfQuery>& queries, std::uint32_t mode, std::uint32_t planted,
                                std::uint32_t count) {
  struct Push {
    interop::Ptr<BsdfQuery> queries;
    interop::Ptr<BsdfAnswer> answers;
    std::uint32_t queryCount;
    std::uint32_t count;
    std::uint32_t seed;
  };
  std::uint32_t mask = 0;
  for (const BsdfQuery& query : queries) {
    mask |= 1u << query.model; // no other model has code
  }
  const ProbeRunner probe(k_material_probe_spirv, {{0, mode}, {1, planted}, {2, mask}});
  const std::uint32_t queryCount = static_cast<std::uint32_t>(queries.size());
  const std::uint32_t answerCount = count > 0 ? count : queryCount;
  const auto in = ProbeRunner::upload(queries);
  const auto out = ProbeRunner::results<BsdfAnswer>(answerCount);
  probe.run(Push{in.ptr(), out.ptr(), queryCount, answerCount, 1u}, answerCount);
  return ProbeRunner::download(out);
}

} // namespace tyndall::test
