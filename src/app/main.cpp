// SPDX-License-Identifier: Apache-2.0
#include "app/commands.h"
#include "base/error.h"

#include <spdlog/sinks/stdout_color_sinks.h>
#include <spdlog/spdlog.h>

#include <cstdio>
#include <new>

namespace {

constexpr int kFailure = 1;

/// Messages go to stderr without decoration: "warning: ...".
void setUpLog() {
  auto logger = spdlog::stderr_color_mt("tyndall");
  logger->set_pattern("%^%l%$: %v");
  spdlog::set_default_logger(logger);
}

int run(int argc, char** argv) {
  CLI::App app("Tyndall renders fog, smoke, clouds and fire. Begin with: tyndall render FILE.vdb");
  app.require_subcommand(1);
  app.set_version_flag("--version", TYNDALL_VERSION);
  tyndall::app::Action action;
  tyndall::app::addRenderCommand(app, action);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error);
  }
  return action();
}

} // namespace

int main(int argc, char** argv) {
  setUpLog();
  try {
    return run(argc, argv);
  } catch (const std::bad_alloc&) {
    spdlog::error("out of memory; use a smaller picture, a \"clip\" box or \"storage\": \"unorm8\"");
  } catch (const std::exception& error) {
    spdlog::error("{}", error.what());
  }
  return kFailure;
}
