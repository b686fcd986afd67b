// SPDX-License-Identifier: Apache-2.0
#include "app/verify_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace tyndall::app {
namespace {

using verify::Outcome;
using verify::Result;

std::size_t countOf(const std::vector<Result>& results, Outcome outcome) {
  return static_cast<std::size_t>(
      std::count_if(results.begin(), results.end(), [&](const Result& result) { return result.outcome == outcome; }));
}

/// JSON has no infinity.
nlohmann::ordered_json numberOrNull(double value) {
  return std::isfinite(value) ? nlohmann::ordered_json(value) : nlohmann::ordered_json();
}

nlohmann::ordered_json findingJson(const verify::Finding& finding) {
  return {{"configuration", finding.configuration},
          {"p", numberOrNull(finding.verdict.familyP)},
          {"standard_errors", numberOrNull(finding.verdict.worstT)},
          {"relative_difference", numberOrNull(finding.verdict.bias)},
          {"relative_standard_error", numberOrNull(finding.verdict.resolution)},
          {"worst", finding.verdict.worst},
          {"tolerance", finding.tolerance},
          {"of_mean", finding.ofMean}};
}

nlohmann::ordered_json resultJson(const Result& result) {
  nlohmann::ordered_json json{{"name", result.check->name},
                              {"what", result.check->what},
                              {"source", result.check->source},
                              {"outcome", verify::outcomeName(result.outcome)},
                              {"p", nullptr},
                              {"standard_errors", nullptr}};
  if (!result.findings.empty()) {
    json["p"] = numberOrNull(result.p);
    json["standard_errors"] = numberOrNull(result.statistic);
  }
  json["detectable_bias"] = numberOrNull(result.detectable.value_or(NAN));
  json["samples"] = result.samples;
  json["seconds"] = result.seconds;
  json["text"] = result.text;
  for (const verify::Finding& finding : result.findings) {
    json["tests"].push_back(findingJson(finding));
  }
  return json;
}

} // namespace

std::string verifyHeader() {
  return fmt::format("{:<8} {:<16} {:<38} {:>8} {:>9} {:>7}\n", "", "check", "what", "p", "sees", "seconds");
}

std::string verifyLine(const Result& result) {
  const bool tested = result.outcome != Outcome::Skipped && !result.findings.empty();
  const std::string p = tested ? fmt::format("{:.2g}", result.p) : "-";
  const std::string sees = tested && result.detectable ? fmt::format("{:.2g} %", 100.0 * *result.detectable) : "-";
  const std::string line =
      fmt::format("{:<8} {:<16} {:<38} {:>8} {:>9} {:>7.1f}\n", verify::outcomeName(result.outcome), result.check->name,
                  result.check->what, p, sees, result.seconds);
  return result.text.empty() ? line : fmt::format("{}{:9}{}\n", line, "", result.text);
}

bool VerifyRun::passed() const {
  return countOf(results, Outcome::Failed) == 0 && countOf(results, Outcome::Passed) > 0;
}

std::string verifyVerdict(const VerifyRun& run) {
  const std::size_t failed = countOf(run.results, Outcome::Failed);
  const std::size_t skipped = countOf(run.results, Outcome::Skipped);
  const std::string left = skipped > 0 ? fmt::format(", {} skipped", skipped) : "";
  const std::string what = failed > 0 ? fmt::format("{} of {} checks FAILED{}", failed, run.results.size(), left)
                                      : fmt::format("{} of {} checks passed{}", countOf(run.results, Outcome::Passed),
                                                    run.results.size(), left);
  return fmt::format("{} in {:.0f} s on {} ({}); correct code fails in one run of {:.0f}.\n", what, run.seconds,
                     run.device.name, run.device.driver, 1.0 / verify::kFamilyRate);
}

nlohmann::ordered_json verifyJson(const VerifyRun& run) {
  nlohmann::ordered_json json{{"program", "tyndall " TYNDALL_VERSION},
                              {"device", run.device.name},
                              {"driver", run.device.driver},
                              {"vulkan", run.device.apiVersion},
                              {"seed", run.conditions.seed},
                              {"effort", run.conditions.effort},
                              {"family_rate", verify::kFamilyRate},
                              {"check_rate", verify::rateOfEach(run.results.size())},
                              {"passed", run.passed()},
                              {"verdict", verifyVerdict(run)},
                              {"seconds", run.seconds}};
  for (const Result& result : run.results) {
    json["checks"].push_back(resultJson(result));
  }
  return json;
}

} // namespace tyndall::app
