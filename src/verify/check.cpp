// SPDX-License-Identifier: Apache-2.0
#include "verify/check.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>

namespace tyndall::verify {
namespace {

/// Seeds of a run are far from those of another.
constexpr std::uint32_t kSeedStride = 10'000'019;

/// What a test of an image mean sees in half of all runs.
double detectableBy(const Finding& finding, double rate) {
  const double t = film::studentTQuantile(1.0 - 0.5 * rate, finding.verdict.degrees);
  return finding.tolerance + t * finding.verdict.resolution;
}

void judge(Result& result, const Trial& trial, double rate) {
  const auto& findings = trial.findings();
  result.findings = findings;
  result.samples = trial.samples();
  if (!trial.skipped().empty()) {
    result.outcome = Outcome::Skipped;
    result.text = trial.skipped();
    return;
  }
  const double eachRate = film::sidakThreshold(rate, std::max(1.0, double(findings.size())));
  const Finding* worst = nullptr;
  for (const Finding& finding : findings) {
    if (worst == nullptr || !(finding.verdict.familyP >= worst->verdict.familyP)) {
      worst = &finding;
    }
    if (finding.ofMean) {
      result.detectable = std::max(result.detectable.value_or(0.0), detectableBy(finding, eachRate));
    }
  }
  if (worst != nullptr) {
    result.p = film::sidakFamilyP(worst->verdict.familyP, double(findings.size()));
    result.statistic = worst->verdict.worstT;
  }
  if (!(result.p >= rate)) {
    result.outcome = Outcome::Failed;
    result.text = worst->configuration + ": " + worst->verdict.text();
  }
  if (!trial.faults().empty()) {
    result.outcome = Outcome::Failed;
    result.p = 0.0;
    result.text = trial.faults().front();
  }
}

} // namespace

Moments Trial::render(const TestScene& test, MomentOptions options) {
  options.replicates *= conditions_.effort;
  options.firstSeed += conditions_.seed * kSeedStride;
  options.estimator.plantedBug = conditions_.plantedBug;
  Moments moments = renderMoments(device_, test.scene, test.volumes, options);
  const render::Totals& totals = moments.totals;
  samples_ += std::uint64_t(moments.pixels.size()) * options.samples * options.replicates;
  require(totals.nonFinite + totals.majorantExceeded + totals.cut == 0,
          fmt::format("{} samples are not finite, {} lookups above their majorant, {} rays cut off", totals.nonFinite,
                      totals.majorantExceeded, totals.cut));
  return moments;
}

void Trial::mean(const std::string& configuration, const Moments& moments, double reference, int channel,
                 double tolerance) {
  findings_.push_back({configuration, imageTest(moments, reference, channel, tolerance), tolerance, true});
}

void Trial::compare(const std::string& configuration, const Moments& moments, const std::vector<double>& reference,
                    int channel, double tolerance) {
  if (moments.method == render::Method::March) {
    findings_.push_back({configuration + ", pixels", pixelTest(moments, reference, channel, tolerance), tolerance});
  }
  mean(configuration, moments, meanOf(reference), channel, tolerance);
}

void Trial::agree(const std::string& configuration, const Moments& a, const Moments& b) {
  findings_.push_back({configuration + ", tiles", tileTest(a, b, kRounding), kRounding});
  findings_.push_back({configuration + ", mean", channelTest(a, b), 0.0, true});
}

void Trial::require(bool holds, const std::string& fault) {
  if (!holds) {
    faults_.push_back(fault);
  }
}

const char* outcomeName(Outcome outcome) {
  switch (outcome) {
  case Outcome::Passed:
    return "passed";
  case Outcome::Failed:
    return "FAILED";
  case Outcome::Skipped:
    return "skipped";
  }
  return "";
}

Result runCheck(const Check& check, const gpu::Device& device, const Conditions& conditions, double rate) {
  using Clock = std::chrono::steady_clock;
  const Clock::time_point begin = Clock::now();
  Result result;
  result.check = &check;
  Trial trial(device, conditions);
  try {
    check.run(trial);
  } catch (const std::exception& error) {
    trial.require(false, fmt::format("could not run: {}", error.what()));
  }
  judge(result, trial, rate);
  result.seconds = std::chrono::duration<double>(Clock::now() - begin).count();
  return result;
}

} // namespace tyndall::verify
