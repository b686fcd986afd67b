// SPDX-License-Identifier: Apache-2.0
#include "bench/results.h"

#include "base/error.h"

#include <algorithm>
#include <cmath>

namespace tyndall::bench {
namespace {

Json toJson(const Figure& figure) { return {{"value", figure.value}, {"log_error", figure.logError}}; }

Figure figureFrom(const Json& json) { return {json.at("value").get<double>(), json.at("log_error").get<double>()}; }

constexpr const char* kReachNames[] = {"measured", "extrapolated", "better", "never"};

Json toJson(const Crossing& crossing) {
  Json json{{"reach", kReachNames[static_cast<int>(crossing.reach)]}};
  if (crossing.reach != Reach::Never) {
    json["seconds"] = toJson(crossing.seconds);
  }
  return json;
}

Json toJson(const Work& work) {
  return {{"samples", work.samples},
          {"lookups", work.lookups},
          {"segments", work.segments},
          {"pieces", work.pieces},
          {"dispatches", work.dispatches}};
}

Work workFrom(const Json& json) {
  return {json.at("samples").get<double>(), json.at("lookups").get<double>(), json.at("segments").get<double>(),
          json.at("pieces").get<double>(), json.at("dispatches").get<double>()};
}

Json toJson(const Parts& parts) {
  return {{"start", parts.start},
          {"load", parts.load},
          {"upload", parts.upload},
          {"pipeline", parts.pipeline},
          {"first_dispatch", parts.first},
          {"render", parts.render},
          {"write", parts.write},
          {"device_bytes", parts.deviceBytes},
          {"kernel_bytes", parts.kernelBytes}};
}

Json toJson(const Level& level) {
  Json json{{"effort", level.label},
            {"samples", level.samples},
            {"runs", level.runs},
            {"relMSE", toJson(level.errors.relMse)},
            {"rRMSE", toJson(level.errors.rRmse)},
            {"cpu_seconds", toJson(level.cpu)},
            {"wall_seconds", toJson(level.wall)},
            {"peak_host_bytes", level.peakBytes}};
  if (level.work) {
    json["work"] = toJson(*level.work);
  }
  if (level.parts) {
    json["parts"] = toJson(*level.parts);
  }
  return json;
}

Level levelFrom(const Json& json) {
  Level level;
  level.label = json.at("effort").get<std::string>();
  level.samples = json.at("samples").get<double>();
  level.runs = json.at("runs").get<std::size_t>();
  level.errors = {figureFrom(json.at("relMSE")), figureFrom(json.at("rRMSE"))};
  level.cpu = figureFrom(json.at("cpu_seconds"));
  level.wall = figureFrom(json.at("wall_seconds"));
  level.peakBytes = json.at("peak_host_bytes").get<double>();
  if (json.contains("work")) {
    level.work = workFrom(json.at("work"));
  }
  return level;
}

Json toJson(const Bias& bias) {
  return {{"mean", bias.mean},
          {"mean_error", bias.meanError},
          {"relMSE", bias.relMse},
          {"rRMSE", bias.rRmse},
          {"found", bias.found}};
}

Json toJson(const ContenderResult& contender) {
  Json json{{"name", contender.name}, {"title", contender.title}, {"ours", contender.ours}};
  if (!contender.refusal.empty()) {
    json["refusal"] = contender.refusal;
    return json;
  }
  json["bias"] = toJson(contender.bias);
  if (contender.efficiency) {
    json["relMSE_times_cpu_seconds"] = toJson(*contender.efficiency);
  }
  for (const Target& target : contender.targets) {
    json["targets"].push_back({{"measure", target.measure},
                               {"bound", target.bound},
                               {"cpu", toJson(target.cpu)},
                               {"wall", toJson(target.wall)}});
  }
  for (const Level& level : contender.levels) {
    json["levels"].push_back(toJson(level));
  }
  return json;
}

ContenderResult contenderFrom(const Json& json) {
  ContenderResult contender;
  contender.name = json.at("name").get<std::string>();
  contender.title = json.at("title").get<std::string>();
  contender.ours = json.at("ours").get<bool>();
  contender.refusal = json.value("refusal", std::string());
  if (json.contains("levels")) {
    std::ranges::transform(json.at("levels"), std::back_inserter(contender.levels), levelFrom);
  }
  return contender;
}

SceneResult sceneFrom(const Json& json) {
  SceneResult scene;
  scene.name = json.at("name").get<std::string>();
  scene.size = {json.at("size").at(0).get<unsigned>(), json.at("size").at(1).get<unsigned>()};
  std::ranges::transform(json.at("contenders"), std::back_inserter(scene.contenders), contenderFrom);
  return scene;
}

} // namespace

Json toJson(const Report& report) {
  Json json{{"suite", report.suite}, {"command", report.command}, {"date", report.date}, {"seeds", report.seeds}};
  json["machine"] = report.machine;
  json["scenes"] = Json::array();
  for (const SceneResult& scene : report.scenes) {
    Json contenders = Json::array();
    for (const ContenderResult& contender : scene.contenders) {
      contenders.push_back(toJson(contender));
    }
    json["scenes"].push_back({{"name", scene.name},
                              {"title", scene.title},
                              {"size", {scene.size.x, scene.size.y}},
                              {"estimator", scene.estimator},
                              {"reference", scene.reference},
                              {"contenders", contenders}});
  }
  if (report.bare) {
    json["bare_per_second"] = {{"lookups", report.bare->lookups}, {"rays", report.bare->rays}};
  }
  for (const ScalingCurve& curve : report.scaling) {
    json["scaling"].push_back(toJson(curve));
  }
  if (report.skip) {
    json["skip"] = toJson(*report.skip);
  }
  return json;
}

Report reportFromJson(const std::string& text, const std::string& file) {
  try {
    const Json json = Json::parse(text);
    Report report;
    report.suite = json.at("suite").get<std::string>();
    report.date = json.at("date").get<std::string>();
    report.seeds = json.at("seeds").get<std::size_t>();
    report.machine = json.at("machine").get<std::map<std::string, std::string>>();
    std::ranges::transform(json.at("scenes"), std::back_inserter(report.scenes), sceneFrom);
    return report;
  } catch (const Json::exception& error) {
    fail("{}: not a report of tyndall bench ({}); make one with `tyndall bench -o NAME.html`, which writes NAME.json",
         file, error.what());
  }
}

const ContenderResult* findContender(const SceneResult& scene, const std::string& name) {
  const auto found =
      std::ranges::find_if(scene.contenders, [&](const ContenderResult& each) { return each.name == name; });
  return found == scene.contenders.end() ? nullptr : &*found;
}

} // namespace tyndall::bench
