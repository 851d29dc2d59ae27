#include "harness/bench/context.h"

#include <sys/resource.h>
#include <sys/utsname.h>
#include <unistd.h>

#include <cstdlib>
#include <ctime>
#include <fstream>
#include <string>

#include "algorithms/vector_target.h"
#include "build_info.h"

namespace ml {
namespace {

std::string cpu_model() {
  std::ifstream file("/proc/cpuinfo");
  for (std::string line; std::getline(file, line);)
    if (line.starts_with("model name"))
      if (size_t colon = line.find(": "); colon != std::string::npos) return line.substr(colon + 2);
  return "unknown";
}

std::string system_name() {
  std::ifstream file("/etc/os-release");
  for (std::string line; std::getline(file, line);)
    if (line.starts_with("PRETTY_NAME=\"")) return line.substr(13, line.size() - 14);
  return "unknown";
}

std::string now_utc() {
  std::time_t now = std::time(nullptr);
  std::tm parts{};
  gmtime_r(&now, &parts);
  char text[32];
  std::strftime(text, sizeof text, "%Y-%m-%dT%H:%M:%SZ", &parts);
  return text;
}

// Variables that change which device is used or how fast it is; only those that are set.
nlohmann::json environment() {
  nlohmann::json result = nlohmann::json::object();
  for (const char* name :
       {"MANYLIGHTS_DEVICE", "VK_ICD_FILENAMES", "VK_DRIVER_FILES", "VK_LOADER_DRIVERS_SELECT",
        "VK_INSTANCE_LAYERS", "LP_NUM_THREADS", "GALLIVM_PERF", "MESA_VK_DEVICE_SELECT"})
    if (const char* value = std::getenv(name)) result[name] = value;
  return result;
}

}  // namespace

uint64_t peak_memory_bytes() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<uint64_t>(usage.ru_maxrss) * 1024;  // Linux counts KiB
}

nlohmann::json run_context(const gpu::Device& device, const Calibration& calibration) {
  utsname kernel{};
  uname(&kernel);
  const gpu::DeviceInfo& info = device.info();
  const gpu::DeviceLimits& limits = device.limits();
  return {{"program", "manylights"},
          {"version", build_info::version},
          {"commit", build_info::commit},
          {"dirty", build_info::dirty},
          {"time", now_utc()},
          {"build",
           {{"type", build_info::type},
            {"compiler", build_info::compiler},
            {"sanitizers", build_info::sanitizers}}},
          {"host",
           {{"cpu", cpu_model()},
            {"cores", static_cast<int>(sysconf(_SC_NPROCESSORS_ONLN))},
            {"vector_target", simd::target_name()},
            {"memory_bytes",
             static_cast<uint64_t>(sysconf(_SC_PHYS_PAGES)) * static_cast<uint64_t>(sysconf(_SC_PAGESIZE))},
            {"system", system_name()},
            {"kernel", kernel.release}}},
          {"device",
           {{"name", info.name},
            {"type", info.type},
            {"driver", info.driver},
            {"uuid", info.uuid},
            {"api_version", info.api_version},
            {"subgroup_size", limits.subgroup_size},
            {"storage_buffer_range", limits.storage_buffer_range},
            {"timestamp_period_ns", limits.timestamp_period_ns},
            {"timestamp_valid_bits", limits.timestamp_valid_bits},
            {"second_queue", gpu::in_words(info.second_queue)},
            {"second_timestamp_valid_bits",
             info.second_queue == gpu::SecondQueue::none ? 0 : limits.second_timestamp_valid_bits},
            {"validation", device.validation_enabled()}}},
          {"environment", environment()},
          {"calibration", calibration.to_json()}};
}

}  // namespace ml
