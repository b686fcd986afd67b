// SPDX-License-Identifier: Apache-2.0
#include "bench/page.h"

#include "bench/html.h"
#include "bench/page_pictures.h"
#include "bench/page_scaling.h"
#include "bench/svg.h"

#include <fmt/format.h>

#include <algorithm>

namespace tyndall::bench {
namespace {

constexpr const char* kStyle = R"(
body { font: 15px/1.45 system-ui, sans-serif; color: #1b1b1b; background: #fff; max-width: 1500px; margin: 2rem auto; padding: 0 1rem }
h1 { font-size: 1.6rem } h2 { font-size: 1.25rem; margin-top: 2.6rem; border-top: 1px solid #ccc; padding-top: 1rem } h3 { font-size: 1rem }
.wide { overflow-x: auto } table { border-collapse: collapse; margin: .6rem 0; font-variant-numeric: tabular-nums }
th, td { padding: .2rem .7rem; text-align: right; border-bottom: 1px solid #e2e2e2; white-space: nowrap } th { background: #f4f4f4; font-weight: 600 }
th:first-child, td:first-child { text-align: left } .note { color: #555; max-width: 75ch } .bad { color: #a00 }
figure { display: inline-block; margin: .5rem 1rem .5rem 0; vertical-align: top } figcaption { font-size: .85rem; color: #444; max-width: 256px }
figure img { image-rendering: pixelated; width: 256px; height: auto; display: block; background: #000 } svg { max-width: 100%; height: auto }
)";

std::string biasText(const ContenderResult& contender) {
  if (contender.levels.empty() || (contender.bias.mean == 0.0 && contender.bias.meanError == 0.0)) {
    return "";
  }
  return fmt::format("{:+.2f} % ± {:.2f}", 100.0 * contender.bias.mean, 100.0 * contender.bias.meanError);
}

std::string figureText(const Figure& figure, std::size_t runs) {
  return runs >= 2 ? rangeText(figure, runs) : shortText(figure.value);
}

std::string targetName(const Target& target) { return fmt::format("{} {:g}", target.measure, target.bound); }

const Target* findTarget(const ContenderResult& contender, const Target& like) {
  const auto found = std::ranges::find_if(
      contender.targets, [&](const Target& each) { return each.measure == like.measure && each.bound == like.bound; });
  return found == contender.targets.end() ? nullptr : &*found;
}

/// Scenes and contenders in rows, seconds to each bound in columns.
std::string summary(const Report& report, Crossing Target::*clock) {
  std::vector<std::vector<std::string>> rows;
  for (const SceneResult& scene : report.scenes) {
    const ContenderResult& first = scene.contenders.front();
    if (rows.empty()) {
      rows.push_back({"scene", "renderer"});
      for (const Target& target : first.targets) {
        rows.front().push_back(targetName(target));
        rows.front().push_back("over ours");
      }
    }
    for (const ContenderResult& contender : scene.contenders) {
      std::vector<std::string> row{&contender == &first ? scene.name : "", contender.title};
      for (const Target& target : contender.targets) {
        row.push_back(crossingText(target.*clock));
        const Target* ours = findTarget(first, target);
        const bool other = &contender != &first && ours != nullptr;
        row.push_back(other ? ratioText(target.*clock, ours->*clock, report.seeds) : "");
      }
      if (!contender.refusal.empty()) {
        row.push_back(contender.refusal);
      }
      rows.push_back(row);
    }
  }
  return table(rows);
}

std::string summaries(const Report& report) {
  std::string html = heading("h2", "CPU seconds to an accuracy");
  html += note("Of whole processes, from start to written picture. ~: beyond what was rendered, noise taken as 1 / "
               "samples. <: the least effort is better already. \"over ours\": beside the first renderer of the scene, "
               "with its 95 % interval; above 1 we are faster. Where a renderer's mean differs from the reference by "
               "more than chance, that difference counts as error.");
  html += summary(report, &Target::cpu);
  html += heading("h2", "Wall seconds to an accuracy");
  html += summary(report, &Target::wall);
  return html;
}

std::string levelTable(const SceneResult& scene) {
  std::vector<std::vector<std::string>> rows{{"renderer", "effort", "relMSE", "rRMSE %", "CPU s", "wall s",
                                              "relMSE × CPU s", "peak host MB", "mean − reference"}};
  for (const ContenderResult& contender : scene.contenders) {
    for (const Level& level : contender.levels) {
      Figure percent = level.errors.rRmse;
      percent.value *= 100.0;
      const bool last = &level == &contender.levels.back();
      const Figure product = level.errors.relMse * level.cpu;
      rows.push_back({contender.title, level.label, figureText(level.errors.relMse, level.runs),
                      figureText(percent, level.runs), shortText(level.cpu.value), shortText(level.wall.value),
                      shortText(product.value), shortText(1e-6 * level.peakBytes), last ? biasText(contender) : ""});
    }
    if (!contender.refusal.empty()) {
      rows.push_back({contender.title, "", contender.refusal});
    }
  }
  return table(rows);
}

/// Where the time of ours goes, at the highest effort.
std::string partsTable(const SceneResult& scene, const std::optional<BareRates>& bare) {
  std::vector<std::vector<std::string>> rows{{"renderer", "start s", "load s", "upload s", "pipeline s",
                                              "first dispatch s", "render s", "write s", "device MB", "kernels kB",
                                              "M samples/s", "M lookups/s", "M segments/s", "M pieces/s", "bare %"}};
  for (const ContenderResult& contender : scene.contenders) {
    if (contender.levels.empty() || !contender.levels.back().parts) {
      continue;
    }
    const Parts& parts = *contender.levels.back().parts;
    const Work& work = *contender.levels.back().work;
    const auto rate = [&](double count) { return shortText(1e-6 * count / parts.render); };
    rows.push_back({contender.title, shortText(parts.start), shortText(parts.load), shortText(parts.upload),
                    shortText(parts.pipeline), shortText(parts.first), shortText(parts.render), shortText(parts.write),
                    shortText(1e-6 * parts.deviceBytes), shortText(1e-3 * parts.kernelBytes), rate(work.samples),
                    rate(work.lookups), rate(work.segments), rate(work.pieces),
                    bare ? shortText(100.0 * bare->share(work.lookups, work.segments, parts.render)) : ""});
  }
  return table(rows);
}

std::string image(const std::string& png, const std::string& caption) {
  return fmt::format(
      "<figure><img alt=\"{0}\" src=\"data:image/png;base64,{1}\"><figcaption>{0}</figcaption></figure>\n",
      escaped(caption), base64(png));
}

std::string pictures(const SceneResult& scene) {
  std::string html;
  for (const ContenderResult& contender : scene.contenders) {
    if (!contender.levels.empty()) {
      const Level& last = contender.levels.back();
      html += image(contender.picture,
                    fmt::format("{}, effort {}, {} CPU s", contender.title, last.label, shortText(last.cpu.value)));
      html += image(contender.map, contender.title + ": error of its pixels");
    }
  }
  return html;
}

std::string sceneSection(const SceneResult& scene, const std::optional<BareRates>& bare) {
  std::string html = heading("h2", scene.name);
  html += note(fmt::format("{} {}x{} pixels. Estimator: {}. Errors: {}.", scene.title, scene.size.x, scene.size.y,
                           scene.estimator, scene.reference));
  html += svgText(errorChart(scene));
  html += levelTable(scene);
  html += heading("h3", "Where the time goes (wall seconds and rates at the highest effort)");
  if (bare) {
    html +=
        note(fmt::format("bare %: of the render seconds, those that as many lookups and segments would take with "
                         "nothing else to do: this device reaches {} M bare density lookups and {} M bare ray casts "
                         "a second, in a cloud and in a box. What is counted as lookups by the march is a cell each.",
                         shortText(1e-6 * bare->lookups), shortText(1e-6 * bare->rays)));
  }
  html += partsTable(scene, bare);
  html += heading("h3", "Pictures of one seed at the highest effort, and relative errors scaled to one CPU second");
  html += note("Maps are logarithmic from black (0.1 %) over red (1 %) and yellow (10 %) to white (100 %).");
  return html + pictures(scene);
}

std::string machineTable(const Report& report) {
  std::vector<std::vector<std::string>> rows{{"", ""}};
  for (const auto& [key, value] : report.machine) {
    rows.push_back({key, value});
  }
  rows.push_back({"command", report.command});
  rows.push_back({"date", report.date});
  rows.push_back({"seeds", std::to_string(report.seeds)});
  return table(rows);
}

} // namespace

std::string crossingText(const Crossing& crossing) {
  switch (crossing.reach) {
  case Reach::Measured:
    return shortText(crossing.seconds.value);
  case Reach::Extrapolated:
    return "~" + shortText(crossing.seconds.value);
  case Reach::Better:
    return "< " + shortText(crossing.seconds.value);
  case Reach::Never:
    break;
  }
  return "never";
}

std::string ratioText(const Crossing& theirs, const Crossing& ours, std::size_t runs) {
  if (theirs.reach == Reach::Never || ours.reach == Reach::Never) {
    return "";
  }
  const bool least = ours.reach == Reach::Better && theirs.reach != Reach::Better;
  const bool both = ours.reach == Reach::Better && theirs.reach == Reach::Better;
  if (both) {
    return ""; // two upper bounds
  }
  const char* mark = least ? "> " : (theirs.reach == Reach::Better ? "< " : "");
  return mark + figureText(theirs.seconds / ours.seconds, runs);
}

LineChart errorChart(const SceneResult& scene) {
  LineChart chart{"Error over CPU time", "CPU seconds of the whole process", "relMSE", {}};
  for (const ContenderResult& contender : scene.contenders) {
    ChartLine line{contender.title, {}, false};
    for (const Level& level : contender.levels) {
      const Interval none{};
      line.points.push_back({level.cpu.value, level.errors.relMse.value,
                             level.runs >= 2 ? interval(level.errors.relMse, level.runs) : none});
    }
    std::ranges::sort(line.points, {}, &ChartPoint::x); // finer settings may take less time
    chart.lines.push_back(line);
  }
  return chart;
}

std::string htmlPage(const Report& report) {
  std::string html = fmt::format("<!doctype html>\n<html lang=\"en\"><head><meta charset=\"utf-8\">"
                                 "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">"
                                 "<title>Tyndall: {}</title>\n<style>{}</style></head>\n<body>\n",
                                 escaped(report.title), kStyle);
  html += heading("h1", "Run time against error: " + report.title);
  html += machineTable(report);
  if (!report.scenes.empty()) {
    html += summaries(report);
  }
  for (const SceneResult& scene : report.scenes) {
    html += sceneSection(scene, report.bare);
  }
  if (!report.scaling.empty()) {
    html += scalingSection(report.scaling);
  }
  if (report.skip) {
    html += skipSection(*report.skip);
  }
  return html + "</body></html>\n";
}

} // namespace tyndall::bench
