// SPDX-License-Identifier: Apache-2.0
// The normal distribution cut off outside an interval that its mean lies in, and the error function that it needs.
#ifndef TYNDALL_CORE_GAUSSIAN_GLSL
#define TYNDALL_CORE_GAUSSIAN_GLSL

#include "core/numerics.glsl"

const float kRootHalf = 0.707106781186548;
const float kRootTwo = 1.4142135623731;
const float kInvRootTwoPi = 0.398942280401433;

/// erf(x) for x >= 0, infinity included; absolute error <= 3e-7, relative error below 0.5 <= 1e-6.
float erfPositive(float x) {
  if (x < 0.5) {
    const float x2 = x * x; // Taylor series; the first term left out is 2e-8 of the sum
    return 1.12837916709551 * x *
           (1.0 + x2 * (-1.0 / 3.0 + x2 * (1.0 / 10.0 + x2 * (-1.0 / 42.0 + x2 * (1.0 / 216.0 - x2 * (1.0 / 1320.0))))));
  }
  // [Abramowitz64, 7.1.26]
  const float t = 1.0 / (1.0 + 0.3275911 * x);
  const float series =
      t * (0.254829592 + t * (-0.284496736 + t * (1.421413741 + t * (-1.453152027 + t * 1.061405429))));
  return 1.0 - series * exp(-x * x);
}

/// Its inverse for y in [0, 1], 1 standing for the number before it; relative error <= 1e-6 up to 0.999 [Giles12].
float erfInverse(float y) {
  const float below = min(y, 0.99999994);
  float w = -log1pAccurate(-below * below);
  float p;
  if (w < 5.0) {
    w -= 2.5;
    p = 2.81022636e-08;
    p = 3.43273939e-07 + p * w;
    p = -3.5233877e-06 + p * w;
    p = -4.39150654e-06 + p * w;
    p = 0.00021858087 + p * w;
    p = -0.00125372503 + p * w;
    p = -0.00417768164 + p * w;
    p = 0.246640727 + p * w;
    p = 1.50140941 + p * w;
  } else {
    w = sqrt(w) - 3.0;
    p = -0.000200214257;
    p = 0.000100950558 + p * w;
    p = 0.00134934322 + p * w;
    p = -0.00367342844 + p * w;
    p = 0.00573950773 + p * w;
    p = -0.0076224613 + p * w;
    p = 0.00943887047 + p * w;
    p = 1.00167406 + p * w;
    p = 2.83297682 + p * w;
  }
  return p * below;
}

/// Cut off outside [first, last], which the mean lies in: so both sides have mass, and neither is a difference.
struct TruncatedGaussian {
  float mean;
  float sigma;
  float first;
  float last;
  float below; // what of the whole distribution lies between `first` and the mean,
  float above; // ... and between the mean and `last`
};

TruncatedGaussian truncatedGaussian(float mean, float sigma, float first, float last) {
  const float scale = kRootHalf / sigma;
  return TruncatedGaussian(mean, sigma, first, last, 0.5 * erfPositive((mean - first) * scale),
                           0.5 * erfPositive((last - mean) * scale));
}

/// Density at the mean, in [first, last].
float truncatedGaussianPeak(TruncatedGaussian g) { return kInvRootTwoPi / (g.sigma * (g.below + g.above)); }

float truncatedGaussianPdf(TruncatedGaussian g, float t) {
  const float deviations = (t - g.mean) / g.sigma;
  return t >= g.first && t <= g.last ? truncatedGaussianPeak(g) * exp(-0.5 * deviations * deviations) : 0.0;
}

float truncatedGaussianSample(TruncatedGaussian g, float xi) {
  const float fromMean = xi * (g.below + g.above) - g.below;
  const float away = g.sigma * kRootTwo * erfInverse(2.0 * abs(fromMean));
  return clamp(g.mean + (fromMean < 0.0 ? -away : away), g.first, g.last);
}

#endif
