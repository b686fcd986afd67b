// SPDX-License-Identifier: Apache-2.0
#include "microbench/frames.h"
#include "microbench/option_values.h"

namespace tyndall::microbench {

std::shared_ptr<FramesOptions> addFramesOptions(CLI::App& command) {
  auto shared = std::make_shared<FramesOptions>();
  FramesOptions& options = *shared;
  addSize(command, options.frame.size);
  command.add_option("--spp", options.frame.samples, "Samples per pixel and frame")->check(CLI::Range(1, 16));
  command.add_option("--seeds", options.frame.seeds, "Sequences side by side")->check(CLI::Range(1, 100));
  command.add_option("--frames", options.frames, "The last one; events come after frame 12")->check(CLI::Range(16, 30));
  command.add_option("--reference-spp", options.referenceSamples, "Samples per pixel of references")
      ->check(CLI::Range(16, 1 << 20));
  command.add_option("--events", options.events, "Of out, moves, teleports and cut; all of them else")
      ->delimiter(',')
      ->check(CLI::IsMember({"out", "moves", "teleports", "cut"}));
  command
      .add_option("--contenders", options.contenders, "Their names, such as \"path,mcpg without velocity\"; all else")
      ->delimiter(',')
      ->type_name("A,B");
  addGuideOverrides(command, options.overrides);
  command.add_option("--device", options.device, "Index or part of the name");
  command.add_option("--json", options.json, "Writes the figures to this file as well");
  command.add_option("--plots", options.plots, "Writes charts (SVG) to this folder as well");
  return shared;
}

} // namespace tyndall::microbench
