// SPDX-License-Identifier: Apache-2.0
#include "app/commands.h"
#include "app/device_options.h"
#include "app/quantities.h"
#include "base/error.h"

#include <algorithm>
#include <memory>
#include <optional>

namespace tyndall::app {
namespace {

struct DevicesArguments {
  std::string select;
};

std::string verdict(const gpu::DeviceInfo& device, std::optional<std::uint32_t> chosen) {
  if (!device.usable()) {
    return "cannot be used: lacks " + joinNames(device.missing);
  }
  return device.index == chosen ? "usable; render takes this one"
                                : fmt::format("usable; --device {} takes it", device.index);
}

void print(const gpu::DeviceInfo& device, std::optional<std::uint32_t> chosen) {
  fmt::print("{}: {}\n", device.index, device.name);
  const auto line = [](const char* name, const std::string& value) { fmt::print("   {:<12}{}\n", name, value); };
  line("kind", device.type);
  line("driver", device.driver);
  line("Vulkan", device.apiVersion);
  line("memory", fmt::format("{}, at most {} in one allocation", inBytes(double(device.memoryBytes)),
                             inBytes(double(device.maxAllocation))));
  line("limits",
       fmt::format("3D images up to {} texels an edge, subgroups of {}", device.maxImage3D, device.subgroupSize));
  line("verdict", verdict(device, chosen));
}

int devicesCommand(const DevicesArguments& arguments) {
  const std::vector<gpu::DeviceInfo> devices = gpu::listDevices();
  std::optional<std::uint32_t> chosen;
  const bool anyUsable =
      std::any_of(devices.begin(), devices.end(), [](const gpu::DeviceInfo& d) { return d.usable(); });
  if (anyUsable) {
    // Opening one is the only sure way to know which one a render gets, and that it opens at all.
    chosen = gpu::Device(deviceOptions(arguments.select)).info().index;
  }
  for (const gpu::DeviceInfo& device : devices) {
    print(device, chosen);
  }
  if (!anyUsable) {
    fail("{}; install a Vulkan 1.3 driver, for the CPU the package mesa-vulkan-drivers",
         devices.empty() ? "no Vulkan device found" : "none of the Vulkan devices can be used");
  }
  return kDone;
}

} // namespace

void addDevicesCommand(CLI::App& app, Action& action) {
  CLI::App* command = app.add_subcommand("devices", "The Vulkan devices, what each can do, and which one renders");
  auto arguments = std::make_shared<DevicesArguments>();
  command
      ->add_option("--device", arguments->select, "Number or part of a name, as for render: says which one that takes")
      ->type_name("NAME");
  command->callback([arguments, &action] { action = [arguments] { return devicesCommand(*arguments); }; });
}

} // namespace tyndall::app
