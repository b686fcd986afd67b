// SPDX-License-Identifier: Apache-2.0
#include "app/usage.h"

#include "base/error.h"

#include <filesystem>

namespace tyndall::app {
namespace {

/// The subcommand that was given, or the program.
const CLI::App& chosen(const CLI::App& app) {
  const std::vector<CLI::App*> given = app.get_subcommands();
  return given.empty() ? app : *given.front();
}

std::string nearestPhrase(const std::string& name, const std::vector<std::string>& known) {
  const std::string nearest = nearestName(name, known);
  return nearest.empty() ? "" : fmt::format("; did you mean {}?", nearest);
}

std::string unknownCommand(const CLI::App& app, const std::string& word) {
  std::vector<std::string> commands;
  for (const CLI::App* command : app.get_subcommands([](const CLI::App*) { return true; })) {
    commands.push_back(command->get_name());
  }
  std::error_code ignored;
  if (std::filesystem::exists(word, ignored) || word.ends_with(".vdb") || word.ends_with(".json")) {
    return fmt::format("{} is not a command; did you mean: tyndall render {}?", word, word);
  }
  return fmt::format("unknown command {}{}; the commands are {}", word, nearestPhrase(word, commands),
                     joinNames(commands));
}

std::string unknownOption(const CLI::App& app, const CLI::App& command, const std::string& word) {
  std::vector<std::string> options;
  for (const CLI::App* known : {&command, &app}) {
    for (const CLI::Option* option : known->get_options()) {
      for (const std::string& name : option->get_lnames()) {
        options.push_back("--" + name);
      }
      for (const std::string& name : option->get_snames()) {
        options.push_back("-" + name);
      }
    }
  }
  const std::string flag = word.substr(0, word.find('='));
  return fmt::format("unknown option {}{}; `tyndall {} --help` lists the options", flag, nearestPhrase(flag, options),
                     command.get_name());
}

} // namespace

std::string usageMessage(const CLI::App& app, const CLI::ParseError& error) {
  const CLI::App& command = chosen(app);
  const std::vector<std::string> unknown = app.remaining(true);
  for (const std::string& word : unknown) {
    if (word.starts_with('-') && word.size() > 1) {
      return &command == &app ? fmt::format("{} is not an option of the program itself; name a command first, as in: "
                                            "tyndall render FILE {}",
                                            word, word)
                              : unknownOption(app, command, word);
    }
  }
  if (!unknown.empty()) {
    return &command == &app ? unknownCommand(app, unknown.front())
                            : fmt::format("{} is one argument too many; see `tyndall {} --help`", unknown.front(),
                                          command.get_name());
  }
  if (&command == &app) {
    return "a command is missing, as in: tyndall render FILE; `tyndall --help` lists the commands";
  }
  return fmt::format("{}; see `tyndall {} --help`", error.what(), command.get_name());
}

} // namespace tyndall::app
