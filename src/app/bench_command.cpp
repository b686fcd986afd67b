// SPDX-License-Identifier: Apache-2.0
#include "app/bench_made.h"
#include "app/commands.h"
#include "app/device_options.h"
#include "app/render_parse.h"
#include "base/error.h"
#include "base/file.h"
#include "bench/baseline.h"
#include "bench/ceilings.h"
#include "bench/machine.h"
#include "bench/measure.h"
#include "bench/page.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <fstream>
#include <memory>
#include <set>
#include <sstream>

namespace tyndall::app {
namespace {

namespace fs = std::filesystem;

struct BenchArguments {
  std::string suite = "quick";
  std::string output = "bench.html";
  std::string keep;
  std::string against;
  std::vector<std::string> scenes;
  std::vector<std::string> peers;
  std::vector<std::string> with;
  std::vector<std::string> programs;
  std::vector<std::uint32_t> samples;
  std::string size;
  std::string device;
  bench::MeasureOptions options;
  bool list = false;
  bool seedsGiven = false;
  std::string commandLine;
};

/// A folder of its own that goes away with this, unless it is the user's.
class WorkFolder {
public:
  explicit WorkFolder(const std::string& keep) : own_(keep.empty()) {
    if (own_) {
      std::string name = (fs::temp_directory_path() / "tyndall-bench-XXXXXX").string();
      if (mkdtemp(name.data()) == nullptr) {
        fail("{}: no folder for pictures can be made there; set TMPDIR to one with room, or name one with --keep",
             fs::temp_directory_path().string());
      }
      path_ = name;
    } else {
      path_ = keep;
      fs::create_directories(path_);
    }
  }
  ~WorkFolder() {
    std::error_code ignored;
    if (own_) {
      fs::remove_all(path_, ignored);
    }
  }
  WorkFolder(const WorkFolder&) = delete;
  WorkFolder& operator=(const WorkFolder&) = delete;
  const fs::path& path() const { return path_; }

private:
  bool own_;
  fs::path path_;
};

/// "NAME=rest" in two. @throws Error naming the option
std::pair<std::string, std::string> namedPart(const std::string& text, const char* option) {
  const std::size_t at = text.find('=');
  if (at == std::string::npos || at == 0) {
    fail("{} {}: write NAME={}", option, text, std::string_view(option) == "--with" ? "ARGUMENTS" : "PROGRAM");
  }
  return {text.substr(0, at), text.substr(at + 1)};
}

std::vector<std::string> wordsOf(const std::string& text) {
  std::vector<std::string> words;
  std::istringstream stream(text);
  for (std::string word; stream >> word;) {
    words.push_back(word);
  }
  return words;
}

std::vector<std::string> deviceWords(const BenchArguments& arguments) {
  return arguments.device.empty() ? std::vector<std::string>{} : std::vector<std::string>{"--device", arguments.device};
}

/// Ours first: its mean is the reference.
std::vector<bench::Contender> contendersOf(const BenchArguments& arguments, const bench::Suite& suite) {
  const fs::path& program = arguments.options.program;
  std::vector<std::string> common = deviceWords(arguments);
  std::vector<bench::Contender> contenders{bench::ownContender("tyndall", program, common, true)};
  const auto add = [&](const std::string& name, const fs::path& binary, std::vector<std::string> more,
                       bool everywhere) {
    more.insert(more.begin(), common.begin(), common.end());
    contenders.push_back(bench::ownContender(name, binary, more, everywhere));
  };
  for (const auto& [name, words] : suite.contenders) {
    add(name, program, words, false);
  }
  for (const std::string& text : arguments.with) {
    const auto [name, words] = namedPart(text, "--with");
    add(name, program, wordsOf(words), true);
  }
  for (const std::string& text : arguments.programs) {
    const auto [name, binary] = namedPart(text, "--program");
    if (!fs::exists(binary)) {
      fail("--program {}: {} is not there", text, binary);
    }
    add(name, fs::absolute(binary), {}, true);
  }
  for (const std::string& peer : arguments.peers) {
    const std::vector<bench::Contender> theirs = bench::peerContenders(peer);
    contenders.insert(contenders.end(), theirs.begin(), theirs.end());
  }
  std::set<std::string> names; // of files, too
  for (const bench::Contender& contender : contenders) {
    if (!names.insert(contender.name).second || contender.name.find('/') != std::string::npos) {
      fail("two contenders are called \"{}\", or it holds a slash; give each a name of its own", contender.name);
    }
  }
  return contenders;
}

/// As it was typed, but for the folder of the program.
std::string commandLine() {
  std::string words = readTextFile("/proc/self/cmdline");
  std::ranges::replace(words, '\0', ' ');
  const std::string program = words.substr(0, words.find(' '));
  return fs::path(program).filename().string() + words.substr(program.size());
}

/// The suite with what the command line changes. @throws Error for a scene that it does not have.
bench::Suite suiteOf(const BenchArguments& arguments) {
  bench::Suite suite = bench::loadSuite(bench::findSuite(arguments.suite));
  std::vector<std::string> names;
  std::ranges::transform(suite.scenes, std::back_inserter(names), &bench::SuiteScene::name);
  for (const std::string& name : arguments.scenes) {
    if (std::ranges::find(names, name) == names.end()) {
      const std::string nearest = nearestName(name, names);
      fail("--scenes: the suite {} has no scene \"{}\"{}; it has {}", suite.name, name,
           nearest.empty() ? "" : fmt::format(" (did you mean \"{}\"?)", nearest), joinNames(names));
    }
  }
  if (!arguments.scenes.empty()) {
    std::erase_if(suite.scenes, [&](const bench::SuiteScene& scene) {
      return std::ranges::find(arguments.scenes, scene.name) == arguments.scenes.end();
    });
  }
  if (!std::ranges::is_sorted(arguments.samples, std::less_equal<>())) {
    fail("--samples {}: they must rise", fmt::join(arguments.samples, ","));
  }
  for (bench::SuiteScene& scene : suite.scenes) {
    if (!arguments.samples.empty()) {
      scene.samples = arguments.samples;
    }
    if (!arguments.size.empty()) {
      scene.size = parseSize("--size", arguments.size);
    }
  }
  return suite;
}

void listSuite(const bench::Suite& suite) {
  fmt::print("{}: {}\n", suite.name, suite.title);
  for (const bench::SuiteScene& scene : suite.scenes) {
    fmt::print("  {:<20}{}x{}, samples {}: {}\n", scene.name, scene.size.x, scene.size.y,
               fmt::join(scene.samples, ", "), scene.title);
  }
}

void say(const std::string& line) {
  fmt::print("{}\n", line);
  std::fflush(stdout);
}

bench::Report measure(const BenchArguments& arguments, const bench::Suite& suite,
                      const std::vector<bench::Contender>& contenders, const fs::path& folder) {
  bench::MeasureOptions options = arguments.options;
  options.folder = folder;
  bench::Report report{suite.name,    suite.title, arguments.commandLine, bench::timeStamp(), bench::machineFacts(),
                       options.seeds, {}};
  for (const bench::Contender& contender : contenders) {
    report.machine["renderer " + contender.name] = contender.title;
  }
  for (const bench::SuiteScene& scene : suite.scenes) {
    report.scenes.push_back(bench::measureScene(scene, contenders, options, say));
  }
  report.machine["device"] = report.scenes.front().device;
  report.bare =
      bench::measureBareRates(gpu::Device({.select = arguments.device, .validation = false, .pipelineCache = {}}));
  return report;
}

/// A benchmark that makes its scenes itself; fewer seeds unless some are asked for, since it has many values.
bench::Report measureMadeOne(const BenchArguments& arguments, const MadeBenchmark& made, const fs::path& folder) {
  constexpr std::uint32_t kSeeds = 4;
  bench::MeasureOptions options = arguments.options;
  options.folder = folder;
  options.seeds = arguments.seedsGiven ? options.seeds : kSeeds;
  bench::Report report{made.name,     made.title, arguments.commandLine, bench::timeStamp(), bench::machineFacts(),
                       options.seeds, {}};
  measureMade(made, {options, arguments.scenes, arguments.device}, say, report);
  return report;
}

/// @throws Error naming what the benchmark does not know
void refuseOthers(const BenchArguments& arguments, const MadeBenchmark& made) {
  const std::pair<const char*, bool> options[] = {
      {"--against", !arguments.against.empty()}, {"--peer", !arguments.peers.empty()},
      {"--with", !arguments.with.empty()},       {"--program", !arguments.programs.empty()},
      {"--samples", !arguments.samples.empty()}, {"--size", !arguments.size.empty()}};
  for (const auto& [name, given] : options) {
    if (given) {
      fail("{}: `tyndall bench {}` makes its own scenes and does not take it", name, made.name);
    }
  }
}

void writeText(const fs::path& path, const std::string& text) {
  writeFileAtomically(path, [&](const fs::path& temporary) {
    std::ofstream stream(temporary, std::ios::binary);
    stream << text;
    if (!stream.flush()) {
      fail("{} could not be written; is the disk full?", path.string());
    }
  });
}

int benchCommand(const BenchArguments& arguments) {
  const MadeBenchmark* made = findMade(arguments.suite);
  const bench::Suite suite = made != nullptr ? bench::Suite{} : suiteOf(arguments);
  if (arguments.list) {
    made != nullptr ? listMade(*made) : listSuite(suite);
    return kDone;
  }
  if (made != nullptr) {
    refuseOthers(arguments, *made);
  }
  const fs::path page = arguments.output;
  const fs::path json = fs::path(page).replace_extension(".json");
  if (json == page) {
    fail("-o {}: name the page, .html; the figures go beside it as .json", page.string());
  }
  checkWritable(page);
  checkWritable(json);
  std::optional<bench::Report> baseline;
  if (!arguments.against.empty()) { // read now, not after an hour
    std::error_code ignored;
    if (fs::equivalent(json, arguments.against, ignored)) {
      fail("--against {}: this report would overwrite it; name another with -o", arguments.against);
    }
    baseline = bench::reportFromJson(readTextFile(arguments.against), arguments.against);
  }
  const WorkFolder folder(arguments.keep);
  const bench::Report report = made != nullptr
                                   ? measureMadeOne(arguments, *made, folder.path())
                                   : measure(arguments, suite, contendersOf(arguments, suite), folder.path());
  writeText(json, bench::toJson(report).dump(1, ' ', false, bench::Json::error_handler_t::replace) + "\n");
  writeText(page, bench::htmlPage(report));
  fmt::print("Report: {} and {}\n", page.string(), json.string());
  if (!baseline) {
    return kDone;
  }
  const std::vector<bench::Change> changes = bench::compareReports(report, *baseline);
  fmt::print("{}", bench::formatChanges(changes));
  const auto worse = std::ranges::count_if(changes, &bench::Change::worse);
  fmt::print("Against {} of {}: {} of {} products of error and work are worse\n", arguments.against, baseline->date,
             worse, changes.size());
  return worse == 0 ? kDone : kFailed;
}

} // namespace

void addBenchCommand(CLI::App& app, Action& action) {
  CLI::App* command = app.add_subcommand(
      "bench", "Run time against error of a suite of scenes, as an HTML page with plots and as JSON");
  auto arguments = std::make_shared<BenchArguments>();
  arguments->options.program = fs::canonical("/proc/self/exe");
  command->add_option("suite", arguments->suite,
                      "Suite by name (quick, standard) or .json file; or scaling, skip (quick)");
  command->add_option("-o,--output", arguments->output, "page to write, with figures in a .json beside it (bench.html)")
      ->type_name("FILE");
  command->add_flag("--list", arguments->list, "say what the suite has, and stop");
  command->add_option("--scenes", arguments->scenes, "scenes of the suite to take (all)")
      ->delimiter(',')
      ->type_name("a,b");
  command->add_option("--seeds", arguments->options.seeds, "pictures of each effort, 4 to 1000 (8)")
      ->check(CLI::Range(4, 1000))
      ->type_name("N");
  command->add_option("--seed", arguments->options.firstSeed, "the first seed (1)")->type_name("N");
  command->add_option("--samples", arguments->samples, "per pixel, rising, instead of the suite's")
      ->delimiter(',')
      ->check(CLI::Range(1, 1 << 24))
      ->type_name("4,16");
  command->add_option("--size", arguments->size, "of the pictures, instead of the suite's")->type_name("WxH");
  command
      ->add_option("--limit", arguments->options.limitSeconds,
                   "CPU seconds: an effort expected to take longer is left out (60)")
      ->check(CLI::PositiveNumber)
      ->type_name("S");
  command->add_option("--threads", arguments->options.threads, "of every renderer that can be told (its own choice)")
      ->type_name("N");
  command->add_option("--peer", arguments->peers, "other renderers that are installed: mitsuba, cycles, vdb_render")
      ->delimiter(',')
      ->type_name("a,b");
  command->add_option("--with", arguments->with, "a contender more: a name and arguments of render; can be repeated")
      ->take_all()
      ->expected(1)
      ->type_name("NAME=ARGUMENTS");
  command->add_option("--program", arguments->programs, "a contender more: another tyndall; can be repeated")
      ->expected(1)
      ->take_all()
      ->type_name("NAME=FILE");
  command
      ->add_option("--against", arguments->against,
                   "an earlier report (.json): error times counted work beside it; exit code 1 if that is worse")
      ->type_name("FILE");
  command->add_option("--keep", arguments->keep, "folder for the pictures, which are thrown away else")
      ->type_name("FOLDER");
  command->add_option("--device", arguments->device, "Vulkan device, by number or part of its name")->type_name("NAME");
  command->callback([command, arguments, &action] {
    arguments->commandLine = commandLine();
    arguments->seedsGiven = command->count("--seeds") > 0;
    action = [arguments] { return benchCommand(*arguments); };
  });
}

} // namespace tyndall::app
