// SPDX-License-Identifier: Apache-2.0
#include "shaders/material_oracle.h"

#include "support/statistics.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>

namespace tyndall::test {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kLeastAlpha = 1e-4; // metal-rough's lower bound

/// [Walter07] eq. (33)
double ggx(const glm::dvec3& h, double alpha) {
  const double cos2 = h.z * h.z;
  const double tan2 = (h.x * h.x + h.y * h.y) / cos2;
  return alpha * alpha / (kPi * cos2 * cos2 * std::pow(alpha * alpha + tan2, 2.0));
}

/// [Heitz14] eq. (72)
double lambda(const glm::dvec3& w, double alpha) {
  const double tan2 = (w.x * w.x + w.y * w.y) / (w.z * w.z);
  return 0.5 * (std::sqrt(1.0 + alpha * alpha * tan2) - 1.0);
}

double schlick(double f0, double cosine) { return f0 + (1.0 - f0) * std::pow(1.0 - cosine, 5.0); }

double mean(const glm::dvec3& v) { return (v.x + v.y + v.z) / 3.0; }

/// Reflection by microfacets of reflectance 1: f |cos wi| and pdf by visible normals [Heitz18].
glm::dvec2 mirrorFacets(const glm::dvec3& wo, const glm::dvec3& wi, const glm::dvec3& h, double alpha) {
  const double density = ggx(h, alpha);
  const double masking = 1.0 / (1.0 + lambda(wo, alpha) + lambda(wi, alpha));
  const double seen = 1.0 / (1.0 + lambda(wo, alpha));
  return {density * masking / (4.0 * std::abs(wo.z)), density * seen / (4.0 * std::abs(wo.z))};
}

Scattering conductor(const interop::BsdfQuery& query, const glm::dvec3& wo, const glm::dvec3& wi) {
  const glm::dvec3 h = glm::normalize(wo + wi);
  const glm::dvec2 facets = mirrorFacets(wo, wi, h, static_cast<double>(query.alpha));
  const bool exact = query.k.x + query.k.y + query.k.z > 0.0f;
  Scattering result{.pdf = facets.y};
  for (int c = 0; c < 3; ++c) {
    const double f =
        exact ? oracleFresnel(glm::dot(wo, h), static_cast<double>(query.eta[c]), static_cast<double>(query.k[c]))
              : schlick(static_cast<double>(query.colour[c]), glm::dot(wo, h));
    result.value[c] = f * facets.x;
  }
  return result;
}

/// [Walter07] eqs. (20), (21), with their ni, no: indices on the sides of wi and wo.
Scattering dielectric(const interop::BsdfQuery& query, const glm::dvec3& wo, const glm::dvec3& wi) {
  const auto indexAt = [&](const glm::dvec3& w) { return w.z > 0.0 ? 1.0 : static_cast<double>(query.etaRatio); };
  const double no = indexAt(wo);
  const double ni = indexAt(wi);
  const double beyond = indexAt(-wo);
  const double alpha = static_cast<double>(query.alpha);
  const bool reflected = wo.z * wi.z > 0.0;
  glm::dvec3 h = glm::normalize(reflected ? wo + wi : -(no * wo + ni * wi));
  h = h.z * wo.z < 0.0 ? -h : h;
  const double ho = glm::dot(h, wo);
  const double hi = glm::dot(h, wi);
  if (ho <= 0.0 || hi * (reflected ? 1.0 : -1.0) <= 0.0) {
    return {};
  }
  const double reflectance = oracleFresnel(ho, beyond / no, 0.0);
  if (reflected) {
    const glm::dvec2 facets = reflectance * mirrorFacets(wo, wi, h, alpha);
    return {glm::dvec3(facets.x), facets.y};
  }
  const double masking = 1.0 / (1.0 + lambda(wo, alpha) + lambda(wi, alpha));
  const double root = ni * hi + no * ho;
  const double common = ho * std::abs(hi) / std::abs(wo.z) * (1.0 - reflectance) * ggx(h, alpha) / (root * root);
  return {common * masking * no * no * glm::dvec3(query.colour), common * ni * ni / (1.0 + lambda(wo, alpha))};
}

Scattering metalRough(const interop::BsdfQuery& query, const glm::dvec3& wo, const glm::dvec3& wi) {
  const double alpha = std::max(static_cast<double>(query.alpha), kLeastAlpha);
  const glm::dvec3 h = glm::normalize(wo + wi);
  const glm::dvec2 facets = mirrorFacets(wo, wi, h, alpha);
  const double metallic = static_cast<double>(query.metallic);
  const double coatF0 = static_cast<double>(query.coatF0);
  const glm::dvec3 colour(query.colour);
  const auto through = [&](double cosine) { return 1.0 - schlick(coatF0, cosine); };
  const double meanThrough = 1.0 - (coatF0 + (1.0 - coatF0) / 21.0); // cosine-weighted
  const double rough = 1.047 / 1.05;                                 // theory (25)
  glm::dvec3 facetAlbedo(0.0);
  glm::dvec3 baseAlbedo(0.0);
  Scattering result;
  for (int c = 0; c < 3; ++c) {
    const auto reflectance = [&](double cosine) {
      return (1.0 - metallic) * schlick(coatF0, cosine) + metallic * schlick(colour[c], cosine);
    };
    const double base = (1.0 - metallic) * colour[c] * through(wo.z) * through(wi.z) / meanThrough * rough / kPi;
    result.value[c] = reflectance(glm::dot(wo, h)) * facets.x + base * wi.z;
    facetAlbedo[c] = reflectance(wo.z);
    baseAlbedo[c] = (1.0 - metallic) * colour[c] * through(wo.z);
  }
  const double share =
      mean(baseAlbedo) > 0.0 ? std::max(0.1, mean(facetAlbedo) / (mean(facetAlbedo) + mean(baseAlbedo))) : 1.0;
  result.pdf = share * facets.y + (1.0 - share) * wi.z / kPi;
  return result;
}

} // namespace

double oracleFresnel(double cosine, double index, double extinction) {
  const std::complex<double> n(index, extinction);
  const std::complex<double> nCosine = std::sqrt(n * n - (1.0 - cosine * cosine)); // n times the refracted cosine
  const std::complex<double> s = (cosine - nCosine) / (cosine + nCosine);
  const std::complex<double> p = (n * n * cosine - nCosine) / (n * n * cosine + nCosine);
  return 0.5 * (std::norm(s) + std::norm(p));
}

Scattering oracleScattering(const interop::BsdfQuery& query, const glm::dvec3& wo, const glm::dvec3& wi) {
  if (query.model == static_cast<std::uint32_t>(MaterialId::Dielectric)) {
    return dielectric(query, wo, wi);
  }
  if (query.model == static_cast<std::uint32_t>(MaterialId::Diffuse)) {
    const double cosine = wo.z * wi.z > 0.0 ? std::abs(wi.z) : 0.0;
    return {cosine / kPi * glm::dvec3(query.colour), cosine / kPi};
  }
  if (wo.z <= 0.0 || wi.z <= 0.0) {
    return {};
  }
  return query.model == static_cast<std::uint32_t>(MaterialId::Conductor) ? conductor(query, wo, wi)
                                                                          : metalRough(query, wo, wi);
}

} // namespace tyndall::test
