// SPDX-License-Identifier: Apache-2.0
#include "app/render_options.h"

#include "app/render_parse.h"
#include "base/error.h"
#include "film/picture.h"

namespace tyndall::app {
namespace {

/// An option whose text `take` turns into a value.
template <class Take>
CLI::Option* text(CLI::App& command, const std::string& name, const Take& take, const std::string& help,
                  const std::string& form) {
  return command.add_option_function<std::string>(name, take, help)->type_name(form);
}

/// An option that one of render_parse.h's functions reads into a member of the request.
template <class Value, class Parse>
void parsed(CLI::App& command, const std::string& name, Value& target, const Parse& parse,
            const std::pair<std::string, std::string>& formAndHelp) {
  text(
      command, name, [&target, parse, name](const std::string& value) { target = parse(name, value); },
      formAndHelp.second, formAndHelp.first);
}

constexpr std::uint32_t kMaxSamples = 1u << 30; // as in a scene file
constexpr std::uint32_t kMaxDepth = 1u << 16;   // likewise

/// 0 stands for unlimited, as in a scene file.
std::uint32_t parseDepth(const std::string& option, const std::string& value) {
  if (value == "unlimited") {
    return 0;
  }
  try {
    return parseWhole(option, value, {0, kMaxDepth});
  } catch (const Error& error) {
    fail("{}, or \"unlimited\"", error.what());
  }
}

void addLimits(CLI::App& command, RenderRequest& request) {
  const auto samples = [](const std::string& option, const std::string& value) {
    return parseWhole(option, value, {1, kMaxSamples});
  };
  parsed(command, "--spp", request.samples, samples, {"N", "stop after N samples per pixel"});
  parsed(command, "--time", request.seconds, parseSeconds, {"T", "stop after this time: 60, 60s, 2m or 1h"});
  parsed(command, "--error", request.error, parseShare, {"E", "stop at this estimated relative error: 1% or 0.01"});
  parsed(command, "--depth", request.depth, parseDepth,
         {"N", "scattering events on a path at most, or \"unlimited\" (default: 1 without objects, unlimited with)"});
}

void addFilm(CLI::App& command, RenderRequest& request) {
  parsed(command, "--size", request.size, parseSize, {"WxH", "size in pixels"});
  parsed(command, "--crop", request.crop, parseWindow, {"x0,y0,x1,y1", "render these pixels only"});
  const auto seed = [](const std::string& option, const std::string& value) { return parseWhole(option, value, {}); };
  parsed(command, "--seed", request.seed, seed, {"N", "of the random numbers"});
  command.add_option("--aov", request.aovs, "layers to add to the EXR: " + joinNames(film::aovNames()))
      ->delimiter(',')
      ->type_name("a,b");
  command.add_flag("--guide-views", request.guideViews,
                   "for debugging: layers guide.* in the EXR, what has been learnt of each pixel's first vertex");
  command.add_flag("--moments", request.moments,
                   "for denoisers: layer second_moment.Y in the EXR, the mean square of the samples' luminance; each "
                   "sample is a dispatch of its own");
  command.add_flag("--transparent", request.transparent, "leave the background out of R, G, B (it gets its own layer)");
  text(
      command, "--exposure",
      [&request](const std::string& value) {
        if (value == "auto") {
          request.chooseExposure = true;
        } else {
          request.exposure = parseNumber("--exposure", value);
        }
      },
      "exposure of the PNG in stops, or auto", "STOPS");
}

void addWork(CLI::App& command, RenderRequest& request) {
  text(
      command, "-o,--output", [&request](const std::string& value) { request.output = value; },
      "EXR to write, with a PNG beside it (default: the input's name, in this folder)", "FILE");
  command.add_flag("--resume", request.resume, "go on from the checkpoint, and keep it");
  parsed(command, "--checkpoint-every", request.checkpointSeconds, parseSeconds,
         {"T", "time between checkpoints (20 s)"});
  text(
      command, "--stats", [&request](const std::string& value) { request.statistics = value; }, "statistics as JSON",
      "FILE");
  text(
      command, "--write-scene", [&request](const std::string& value) { request.writeScene = value; },
      "save the scene as it is rendered", "FILE");
  command.add_flag("--mergeable", request.mergeable, "also write FILE.exr.part, which tyndall merge joins");
  command.add_flag("--quiet", request.quiet, "say nothing but warnings and errors");
  text(
      command, "--device", [&request](const std::string& value) { request.device = value; },
      "Vulkan device, by number or part of its name", "NAME");
  parsed(command, "--memory", request.memoryBytes, parseBytes,
         {"SIZE", "device memory to use at most: 800M, 2G (default 80 %)"});
  text(
      command, "--estimator",
      [&request](const std::string& value) {
        if (value != "auto" && value != "march" && value != "tracking" && value != "path") {
          fail("--estimator {}: there are auto (the default), march, tracking and path", value);
        }
        request.method = value == "march"      ? std::optional(render::Method::March)
                         : value == "tracking" ? std::optional(render::Method::Tracking)
                         : value == "path"     ? std::optional(render::Method::Path)
                                               : std::nullopt;
      },
      "how light is computed: march (exact steps, light caches) and tracking (random steps) for one event in media, "
      "path for everything; auto: the first of them that serves",
      "NAME");
  text(
      command, "--integrator",
      [&request](const std::string& value) {
        if (value != "path" && value != "mcpg" && value != "mcpg-paper" && value != "screen-chains") {
          fail("--integrator {}: there are path (the default), mcpg, mcpg-paper and screen-chains", value);
        }
        request.overrides.push_back({"render.integrator", value});
      },
      "how directions of paths are drawn: path (scattering and lights), mcpg (guided by Markov chains), mcpg-paper (as "
      "published), screen-chains (the method before it: direct light at the first surface)",
      "NAME");
  text(
      command, "--light-sampling",
      [&request](const std::string& value) {
        if (value != "on" && value != "off") {
          fail("--light-sampling {}: there are on (the default) and off", value);
        }
        request.overrides.push_back({"render.light_sampling", value == "on" ? "true" : "false"});
      },
      "off: lights that have a size are found by directions alone", "on|off");
  command.add_flag_callback(
      "--deterministic",
      [&request] {
        request.overrides.push_back({"render.deterministic", "true"});
      },
      "the same bits from every run, of guided pictures too (but not with screen-chains or guided distances), whatever "
      "the threads; slower, see docs/guiding.md");
  text(
      command, "--rays",
      [&request](const std::string& value) {
        if (value != "auto" && value != "tree" && value != "query") {
          fail("--rays {}: there are auto (the default), tree and query", value);
        }
        request.rays = value == "tree"    ? render::RayCaster::Tree
                       : value == "query" ? render::RayCaster::Query
                                          : render::RayCaster::Auto;
      },
      "what casts rays at surfaces: tree (our own), query (the device's ray queries); auto: the faster one", "NAME");
  command.add_flag("--preview", request.preview,
                   "BIASED, for a quick look: the march takes its light caches for true instead of correcting them");
  text(
      command, "--tracker",
      [&request](const std::string& value) {
        if (value != "weighted" && value != "delta") {
          fail("--tracker {}: there are weighted (the default) and delta", value);
        }
        request.deltaTracking = value == "delta";
      },
      "how tracking samples distances in grids: weighted (the default) or delta; implies --estimator tracking", "NAME");
}

void addScene(CLI::App& command, RenderRequest& request) {
  addSet(command, request);
  text(
      command, "--frames", [&request](const std::string& value) { request.frames = volume::parseFrames(value); },
      "frames of a scene that moves, or of a sequence such as smoke_%04d.vdb or smoke_####.vdb", "a-b");
}

void addBareVolume(CLI::App& command, RenderRequest& request) {
  const std::string group = "Bare volumes";
  text(
      command, "--grid", [&request](const std::string& value) { request.grid = value; }, "density grid, by name",
      "NAME")
      ->group(group);
  text(
      command, "--density-scale",
      [&request](const std::string& value) { request.densityScale = parsePositive("--density-scale", value); },
      "extinction per unit of density", "X")
      ->group(group);
  text(
      command, "--optical-depth",
      [&request](const std::string& value) { request.opticalDepth = parsePositive("--optical-depth", value); },
      "median optical depth to scale to (5)", "X")
      ->group(group);
  text(
      command, "--up",
      [&request](const std::string& value) {
        if (value != "y" && value != "z") {
          fail("--up {}: give y or z", value);
        }
        request.up = value == "z" ? scene::UpAxis::Z : scene::UpAxis::Y;
      },
      "the volume's axis that points up: y (default) or z", "AXIS")
      ->group(group);
}

} // namespace

void addSet(CLI::App& command, RenderRequest& request) {
  command
      .add_option_function<std::vector<std::string>>(
          "--set",
          [&request](const std::vector<std::string>& values) {
            for (const std::string& value : values) {
              const std::size_t equals = value.find('=');
              if (equals == std::string::npos || equals == 0) {
                fail("--set {}: write a path, = and a value, such as --set film.exposure=1", value);
              }
              request.overrides.push_back({value.substr(0, equals), value.substr(equals + 1)});
            }
          },
          "change a value of the scene; can be repeated")
      ->expected(1)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll)
      ->allow_extra_args(false)
      ->type_name("path=value");
}

std::shared_ptr<RenderRequest> addRenderOptions(CLI::App& app) {
  CLI::App* command = app.add_subcommand("render", "Render a scene (.json) or a volume (.vdb)");
  auto request = std::make_shared<RenderRequest>();
  command->add_option("input", request->input, "scene (.json), volume (.vdb) or sequence (smoke_####.vdb)")
      ->required()
      ->type_name("FILE");
  addWork(*command, *request);
  addLimits(*command, *request);
  addFilm(*command, *request);
  addScene(*command, *request);
  addBareVolume(*command, *request);
  return request;
}

} // namespace tyndall::app
