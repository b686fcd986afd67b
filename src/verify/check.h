// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "verify/test_scene.h"
#include "verify/verdict.h"

#include <optional>
#include <string>
#include <vector>

/// What a check of the program on a device is made of.
namespace tyndall::verify {

/// What all checks of a run have in common.
struct Conditions {
  std::uint32_t effort = 1;                     ///< times as many replicates
  std::uint32_t seed = 0;                       ///< another one: other random numbers everywhere
  std::uint32_t plantedBug = interop::kBugNone; ///< tests only
};

/// One test of a check.
struct Finding {
  std::string configuration; ///< "march, row 3"
  Verdict verdict;
  double tolerance = 0.0; ///< relative error that the test grants
  bool ofMean = false;    ///< a test of the image mean
};

/// Relative error that tests grant: Vulkan lets exp() and log() be off by some units in the last place, each.
inline constexpr double kRounding = 2e-5;

/// One check at work: renders, tests, and keeps what was found.
class Trial {
public:
  Trial(const gpu::Device& device, const Conditions& conditions) : device_(device), conditions_(conditions) {}

  const gpu::Device& device() const { return device_; }
  const Conditions& conditions() const { return conditions_; }

  /// Moments under the trial's conditions. Samples that are not sound are a fault.
  Moments render(const TestScene& test, MomentOptions options);
  /// The image mean of a channel against its exact value.
  void mean(const std::string& configuration, const Moments& moments, double reference, int channel = 0,
            double tolerance = kRounding);
  /// The image mean against the mean of exact values; for the march every pixel too. Elsewhere pixels may rest on a
  /// few rare events, for which Student's t raises false alarms.
  void compare(const std::string& configuration, const Moments& moments, const std::vector<double>& reference,
               int channel = 0, double tolerance = kRounding);
  /// Two ways to the same picture: Welch's t of every tile and channel, and of the image mean.
  void agree(const std::string& configuration, const Moments& a, const Moments& b);
  /// What must hold exactly.
  void require(bool holds, const std::string& fault);
  /// The device lacks something that nothing but this check needs.
  void skip(const std::string& reason) { skipped_ = reason; }
  void countSamples(std::uint64_t samples) { samples_ += samples; }

  const std::vector<Finding>& findings() const { return findings_; }
  const std::vector<std::string>& faults() const { return faults_; }
  const std::string& skipped() const { return skipped_; }
  std::uint64_t samples() const { return samples_; }

private:
  const gpu::Device& device_;
  Conditions conditions_;
  std::vector<Finding> findings_;
  std::vector<std::string> faults_;
  std::string skipped_;
  std::uint64_t samples_ = 0;
};

/// What is checked.
struct Check {
  const char* name;
  const char* what;
  const char* source; ///< where the expectation comes from
  void (*run)(Trial& trial);
};

enum class Outcome { Passed, Failed, Skipped };
const char* outcomeName(Outcome outcome);

/// What a check came to.
struct Result {
  const Check* check = nullptr;
  Outcome outcome = Outcome::Passed;
  double p = 1.0;         ///< of all its tests together
  double statistic = 0.0; ///< of the least likely test, in standard errors
  /// Relative error of an image mean that the check finds in half of all runs: where the largest of its tests of image
  /// means rejects, tolerance included. nullopt: it has none.
  std::optional<double> detectable;
  std::uint64_t samples = 0;
  double seconds = 0.0;
  std::string text; ///< why it failed or was skipped
  std::vector<Finding> findings;
};

/// Runs a check. What it throws is a failure: the program cannot do here what it must.
/// @param rate of false alarms that is granted to the check.
Result runCheck(const Check& check, const gpu::Device& device, const Conditions& conditions, double rate);

} // namespace tyndall::verify
