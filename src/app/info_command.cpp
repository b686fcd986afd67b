// SPDX-License-Identifier: Apache-2.0
#include "app/commands.h"
#include "app/device_options.h"
#include "app/mesh_input.h"
#include "app/scene_summary.h"
#include "app/volume_summary.h"
#include "base/error.h"
#include "scene/load.h"

#include <nlohmann/json.hpp>
#include <spdlog/spdlog.h>

#include <fstream>
#include <memory>

namespace tyndall::app {
namespace {

struct InfoArguments {
  std::string file;
  bool json = false;
};

/// By its name, or by the VDB magic number for a file of another name.
bool isVolume(const std::string& path) {
  if (path.ends_with(".vdb")) {
    return true;
  }
  std::ifstream stream(path, std::ios::binary);
  std::string magic(4, '\0');
  return stream.read(magic.data(), 4) && magic == " BDV";
}

template <class Summary>
int print(const Summary& summary, bool json) {
  // Names in files may be in any encoding; JSON is UTF-8.
  fmt::print("{}", json ? toJson(summary).dump(2, ' ', false, nlohmann::json::error_handler_t::replace) + "\n"
                        : toText(summary));
  return kDone;
}

int infoCommand(const InfoArguments& arguments) {
  if (isVolume(arguments.file)) {
    return print(summariseVolume(arguments.file), arguments.json);
  }
  if (isMesh(arguments.file)) {
    fail("{}", meshAdvice(arguments.file));
  }
  if (!arguments.file.ends_with(".json")) {
    fail("{}: is neither a volume (.vdb) nor a scene (.json); name one of these", arguments.file);
  }
  return print(summariseScene(scene::loadScene(arguments.file)), arguments.json);
}

} // namespace

void addInfoCommand(CLI::App& app, Action& action) {
  CLI::App* command = app.add_subcommand(
      "info",
      "What a volume (.vdb) or scene (.json) holds: grids, bounds, values, memory on the device, optical depth");
  auto arguments = std::make_shared<InfoArguments>();
  command->add_option("file", arguments->file, "Volume (.vdb) or scene (.json)")->required()->type_name("FILE");
  command->add_flag("--json", arguments->json, "The same as JSON, for scripts; sizes in bytes");
  command->callback([arguments, &action] { action = [arguments] { return infoCommand(*arguments); }; });
}

} // namespace tyndall::app
