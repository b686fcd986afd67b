// SPDX-License-Identifier: Apache-2.0
#include "app/commands.h"
#include "app/device_options.h"
#include "app/mesh_input.h"
#include "app/render_options.h"
#include "app/render_parse.h"
#include "app/render_source.h"
#include "base/error.h"
#include "peer_scene/peer_scene.h"

#include <limits>
#include <memory>

namespace tyndall::app {
namespace {

struct ExportArguments {
  RenderRequest request; ///< what chooses and changes the scene
  std::string folder;
};

int exportCommand(const ExportArguments& arguments) {
  if (isMesh(arguments.request.input)) {
    fail("{}", meshAdvice(arguments.request.input));
  }
  const Source source = readSource(arguments.request, std::numeric_limits<double>::infinity(), [](const auto&) {});
  peer_scene::writePeerScene(sceneOfFrame(source, arguments.request, std::nullopt), arguments.folder);
  return kDone;
}

} // namespace

void addExportCommand(CLI::App& app, Action& action) {
  CLI::App* command = app.add_subcommand(
      "export", "Write a scene for other renderers: every value settled, grids as arrays (see peers/README.md)");
  auto arguments = std::make_shared<ExportArguments>();
  RenderRequest& request = arguments->request;
  command->add_option("input", request.input, "scene (.json) or volume (.vdb)")->required()->type_name("FILE");
  command->add_option("folder", arguments->folder, "where scene.json and what it names are put")
      ->required()
      ->type_name("FOLDER");
  addSet(*command, request);
  command
      ->add_option_function<std::string>(
          "--size", [&request](const std::string& value) { request.size = parseSize("--size", value); },
          "size in pixels")
      ->type_name("WxH");
  command->callback([arguments, &action] { action = [arguments] { return exportCommand(*arguments); }; });
}

} // namespace tyndall::app
