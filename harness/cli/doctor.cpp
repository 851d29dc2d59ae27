#include "harness/bench/doctor.h"

#include <fmt/format.h>

#include <memory>

#include "harness/cli/commands.h"

namespace ml {

void add_doctor(CLI::App& app, Action& action) {
  auto device = std::make_shared<std::string>();
  CLI::App* command = app.add_subcommand("doctor", "Devices, timers, calibration and noise of this machine");
  command->footer(
      "Exit code 1 when the device's times cannot be trusted. The overhead of a run is in its result "
      "(harness.outside_timed_laps_fraction).");
  command->add_option("--device", *device, "Vulkan device: part of its name, index or UUID");
  command->callback([device, &action] {
    action = [device] {
      DoctorReport report = examine(*device);
      fmt::print("{}", report.text);
      return report.healthy ? ExitCode::done : ExitCode::claim_failed;
    };
  });
}

}  // namespace ml
