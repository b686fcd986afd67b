// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "material/list.h"

// Needs the interop vocabulary before it.
#include "shaders/material_io.h"

#include <glm/glm.hpp>

#include <cstdint>
#include <vector>

namespace tyndall::test {

/// f |cos wi| per channel, and the pdf of wi [1/sr].
struct Scattering {
  glm::dvec3 value{0.0};
  double pdf = 0.0;
};

/// Rough materials in double, from the papers' own formulas and complex Fresnel coefficients; the query's parameters
/// as rounded to float, its directions not looked at.
Scattering oracleScattering(const interop::BsdfQuery& query, const glm::dvec3& wo, const glm::dvec3& wi);

/// Fresnel's reflectance; `index` relative to the near side.
double oracleFresnel(double cosine, double index, double extinction);

/// Counts of samples against the oracle, and its integrals. Cells are in the half vector's slope, logarithmic, and its
/// azimuth, since that is where lobes of any width are smooth: a set for what is reflected and one for refraction.
class ScatteringBins {
public:
  ScatteringBins(const interop::BsdfQuery& query, const glm::dvec3& wo);

  /// Chi-squared of samples against the pdf. Those that are not valid have the probability that the pdf leaves.
  double pValue(const std::vector<interop::BsdfAnswer>& samples) const;
  double pdfIntegral() const { return pdfIntegral_; }
  /// Of the energy: radiance that is refracted counts eta^2 times.
  glm::dvec3 albedo() const { return albedo_; }

private:
  struct Lobe {
    std::vector<std::size_t> ringOf;   ///< by slope cell
    std::vector<double> probabilities; ///< by ring and sector
  };
  Lobe integrate(bool transmitted);
  std::size_t binOf(const Lobe& lobe, const glm::dvec3& half) const;
  /// Half vector that turns wo into wi, z >= 0, in wo's own hemisphere.
  glm::dvec3 halfVector(const glm::dvec3& wi, bool transmitted) const;

  interop::BsdfQuery query_;
  glm::dvec3 wo_;
  double eta_;   ///< beyond over wo's side
  double scale_; ///< of slopes
  Lobe reflection_;
  Lobe refraction_;
  double pdfIntegral_ = 0.0;
  glm::dvec3 albedo_{0.0};
};

} // namespace tyndall::test
