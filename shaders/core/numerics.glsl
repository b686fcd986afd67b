// SPDX-License-Identifier: Apache-2.0
// Elementary functions with a stated error. Vulkan allows log, atan, sin and cos far more error than thin media,
// narrow peaks and distant lights can take (lavapipe: log is 2 % off near 1), so these are polynomials.
#ifndef TYNDALL_CORE_NUMERICS_GLSL
#define TYNDALL_CORE_NUMERICS_GLSL

const float kPi = 3.14159265358979;
const float kTwoPi = 6.28318530717959;
const float kFourPi = 12.5663706143592;
const float kInvPi = 0.318309886183791;
const float kInvTwoPi = 0.159154943091895;
const float kInvFourPi = 0.0795774715459477;
/// Distances from here on mean "unbounded".
const float kInfiniteDistance = 1e30;

/// False for NaN and both infinities. By bits: min, max and clamp hide a NaN, and a compiler may assume there is none.
bool isFinite(float x) { return (floatBitsToUint(x) & 0x7f800000u) != 0x7f800000u; }
bool isFinite(vec3 v) { return isFinite(v.x) && isFinite(v.y) && isFinite(v.z); }

/// Square root of the positive part, for arguments that rounding may have pushed below zero.
float safeSqrt(float x) { return sqrt(max(x, 0.0)); }

/// ln(1 + x) for x > -1, relative error <= 1e-6; -infinity at -1, NaN below.
float log1pAccurate(float x) {
  if (x <= -1.0) {
    return uintBitsToFloat(x == -1.0 ? 0xff800000u : 0x7fc00000u);
  }
  // Between sqrt(1/2) and sqrt(2) the argument is its own reduced form. Elsewhere the logarithm is at least 0.34, so
  // the rounding of 1 + x costs no more than 2e-7 of it.
  float reduced = x;
  float exponent = 0.0;
  if (x < -0.29289 || x > 0.41421) {
    const uint bits = floatBitsToUint(1.0 + x);
    const int k = int((bits - 0x3f3504f3u + 0x3f800000u) >> 23) - 127; // 0x3f3504f3 = sqrt(1/2)
    reduced = uintBitsToFloat(bits - (uint(k) << 23)) - 1.0;
    exponent = float(k);
  }
  // ln(1 + f) = 2 artanh(s), s = f / (2 + f), |s| <= 0.172; the first term left out is 4e-9 of the sum.
  const float s = reduced / (2.0 + reduced);
  const float s2 = s * s;
  const float series = 1.0 + s2 * (1.0 / 3.0 + s2 * (1.0 / 5.0 + s2 * (1.0 / 7.0 + s2 * (1.0 / 9.0))));
  return exponent * 0.693147180559945 + 2.0 * s * series;
}

/// exp(x) - 1, relative error <= 1e-6 where it is finite; +infinity above 88.72, NaN for NaN.
float expm1Accurate(float x) {
  if (x < -80.0) {
    return -1.0;
  }
  if (x > 88.722) {
    return uintBitsToFloat(0x7f800000u);
  }
  const float k = clamp(floor(x * 1.44269504088896 + 0.5), -120.0, 128.0);
  // ln 2 in two parts, the first with trailing zero bits, so that k times it is exact.
  const float r = (x - k * 0.693359375) + k * 2.12194440054690e-4;
  // Taylor series of expm1 over |r| <= 0.35; the first term left out is 2e-8 of the sum.
  const float series =
      1.0 +
      r * (1.0 / 2.0 +
           r * (1.0 / 6.0 + r * (1.0 / 24.0 + r * (1.0 / 120.0 + r * (1.0 / 720.0 + r * (1.0 / 5040.0))))));
  // 2^k overflows at k = 128, its half does not.
  const float halfPower = uintBitsToFloat(uint(int(k) + 126) << 23);
  return 2.0 * (halfPower * (r * series) + (halfPower - 0.5));
}

/// 1 - exp(-tau): the probability of a collision within optical depth tau >= 0.
float oneMinusExp(float tau) { return -expm1Accurate(-tau); }

/// (cos, sin) of 2 pi `turns`, |turns| <= 1e4; absolute error <= 2e-7, relative error of the sine near 0 <= 4e-7.
vec2 cosSinTurns(float turns) {
  const float quarter = floor(4.0 * turns + 0.5);
  const float x = (turns - 0.25 * quarter) * kTwoPi; // |x| <= pi / 4, the difference is exact
  const float x2 = x * x;
  const float s =
      x * (1.0 + x2 * (-1.0 / 6.0 + x2 * (1.0 / 120.0 + x2 * (-1.0 / 5040.0 + x2 * (1.0 / 362880.0)))));
  const float c =
      1.0 + x2 * (-0.5 + x2 * (1.0 / 24.0 + x2 * (-1.0 / 720.0 + x2 * (1.0 / 40320.0 - x2 * (1.0 / 3628800.0)))));
  const int quadrant = int(quarter) & 3;
  const vec2 even = vec2(c, s);
  const vec2 odd = vec2(-s, c);
  const vec2 turned = (quadrant & 1) == 0 ? even : odd;
  return (quadrant & 2) == 0 ? turned : -turned;
}

/// (cos, sin) of `angle` in radians, |angle| <= 100; errors as cosSinTurns.
vec2 cosSin(float angle) { return cosSinTurns(angle * kInvTwoPi); }

/// arctan(x) for x in [0, 1], relative error <= 3e-7.
float atanUnit(float x) {
  // arctan x = pi/8 + arctan((x - c) / (1 + c x)), c = tan(pi/8): leaves |z| <= tan(pi/16) or x <= tan(pi/16).
  const bool shifted = x > 0.198912367379658;
  const float c = 0.414213562373095;
  float z = shifted ? (x - c) / (1.0 + c * x) : x;
  float offset = shifted ? 0.392699081698724 : 0.0;
  if (x > 0.668178637919299) { // tan(3 pi / 16): about pi/4 instead
    z = (x - 1.0) / (x + 1.0);
    offset = 0.785398163397448;
  }
  const float z2 = z * z;
  const float series = 1.0 + z2 * (-1.0 / 3.0 + z2 * (1.0 / 5.0 + z2 * (-1.0 / 7.0 + z2 * (1.0 / 9.0))));
  return offset + z * series;
}

/// Angle of the point (x, y) in (-pi, pi]; relative error <= 4e-7. 0 at the origin.
float atan2Accurate(float y, float x) {
  const float ax = abs(x);
  const float ay = abs(y);
  const float larger = max(ax, ay);
  if (!(larger > 0.0)) {
    return 0.0;
  }
  float angle = atanUnit(min(ax, ay) / larger);
  if (ay > ax) {
    angle = 1.5707963267949 - angle;
  }
  if (x < 0.0) {
    angle = kPi - angle;
  }
  return y < 0.0 ? -angle : angle;
}

#endif
