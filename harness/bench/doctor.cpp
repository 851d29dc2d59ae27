#include "harness/bench/doctor.h"

#include <fmt/format.h>

#include <vector>

#include "harness/bench/calibration.h"
#include "harness/bench/context.h"
#include "harness/frame/calibration_passes.h"
#include "harness/measure/statistics.h"

namespace ml {
namespace {

constexpr uint32_t noise_samples = 30;

std::string list_devices_text() {
  std::string text = "devices\n";
  for (const gpu::DeviceInfo& info : gpu::list_devices())
    text += fmt::format("  {}: {} ({}), Vulkan {}, {}, UUID {}, second queue: {}{}\n", info.index, info.name,
                        info.type, info.api_version, info.driver, info.uuid, gpu::in_words(info.second_queue),
                        info.missing.empty() ? "" : ", cannot be used: lacks " + info.missing);
  return text;
}

}  // namespace

DoctorReport examine(const std::string& device_selector) {
  DoctorReport report;
  report.text = list_devices_text();
  gpu::Device device({device_selector, false});
  const gpu::DeviceLimits& limits = device.limits();
  const bool software = device.info().is_software();
  Calibration calibration = calibrate(device);
  nlohmann::json context = run_context(device, calibration);
  const nlohmann::json& host = context["host"];
  report.text +=
      fmt::format("host\n  {}, {} cores, {:.1f} GB; {}, kernel {}\n", host["cpu"].get<std::string>(),
                  host["cores"].get<int>(), host["memory_bytes"].get<double>() / 1e9,
                  host["system"].get<std::string>(), host["kernel"].get<std::string>());
  report.text += fmt::format(
      "program\n  version {}, commit {}{}, {} build, {}\n", context["version"].get<std::string>(),
      context["commit"].get<std::string>().substr(0, 12), context["dirty"].get<bool>() ? " (changed)" : "",
      context["build"]["type"].get<std::string>(), context["build"]["compiler"].get<std::string>());
  if (context["build"]["type"] != "Release")
    report.text += "  this is not a release build: its times mean nothing\n";
  report.text += fmt::format("chosen device\n  {}: {} ({})\n", device.info().index, device.info().name,
                             device.info().type);
  report.text +=
      fmt::format("  subgroup {}, storage buffers up to {:.0f} MiB, images up to {} px, 64-bit floats: {}\n",
                  limits.subgroup_size, static_cast<double>(limits.storage_buffer_range) / 1048576.0,
                  limits.image_size, limits.fp64 ? "yes" : "no");
  report.text += fmt::format("  timestamps: {} valid bits, {} ns a tick\n", limits.timestamp_valid_bits,
                             limits.timestamp_period_ns);
  switch (device.info().second_queue) {
    case gpu::SecondQueue::none:
      report.text += "  one queue: lists cannot be built beside other work (shading.list_queue)\n";
      break;
    case gpu::SecondQueue::compute_family:
    case gpu::SecondQueue::main_family:
      report.text += fmt::format(
          "  second queue of the {}, for lists (shading.list_queue); its timestamps: {} valid bits\n",
          gpu::in_words(device.info().second_queue), limits.second_timestamp_valid_bits);
  }
  if (software)
    report.text +=
        "  a software device: its \"GPU\" time is time of these CPU cores, and says nothing about a GPU\n";
  report.text += "calibration (passes of known cost, ms)\n";
  for (const Calibration::Order& order : calibration.orders) {
    std::string spans;
    for (double span : order.spans_ms) spans += fmt::format("{}{:.2f}", spans.empty() ? "" : " + ", span);
    report.text += fmt::format("  {:26} {} | whole {:.2f} | fence {:.2f}\n", order.passes, spans,
                               order.whole_ms, order.fence_ms);
  }
  report.text += fmt::format("  {}\n", calibration.agrees ? "spans, whole frames and fence agree"
                                                          : "NOT TO BE TRUSTED: " + calibration.note);

  CalibrationPasses passes(device);
  std::vector<double> samples;
  for (uint32_t i = 0; i < noise_samples + 2; ++i) {
    double whole = passes.run({CalibrationPasses::Kind::compute}).whole;
    if (i >= 2) samples.push_back(whole);
  }
  double middle = median(samples), spread = quantile(samples, 0.75) - quantile(samples, 0.25);
  report.text += fmt::format(
      "noise\n  the same pass {} times: median {:.2f} ms, quartiles {:.1f} % apart, slowest {:.2f} ms\n",
      noise_samples, middle, 100 * spread / middle, quantile(samples, 1));
  report.healthy = calibration.agrees;
  return report;
}

}  // namespace ml
