// The Vulkan device: found, chosen, announced. This room is the only one that creates Vulkan objects; no
// Vulkan header leaves it.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace ml::gpu {

// What can run beside the main queue, which does graphics and compute: a queue of a family that does compute
// and no graphics, or else another one of the main family.
enum class SecondQueue { none, compute_family, main_family };
const char* in_words(SecondQueue queue);  // "none", "compute family", "main family"

// What a user needs to recognise a device, and what the result says of it.
struct DeviceInfo {
  uint32_t index = 0;  // in the order in which the loader lists the devices
  std::string name;
  std::string uuid;         // 32 hex digits
  std::string type;         // cpu, integrated, discrete, virtual, other
  std::string driver;       // driver name and version
  std::string api_version;  // "1.3.230"
  std::string missing;      // what manylights needs and the device lacks; empty when it can be used
  SecondQueue second_queue = SecondQueue::none;
  bool is_software() const { return type == "cpu"; }
};

struct DeviceLimits {
  uint64_t storage_buffer_range = 0;      // bytes one storage buffer can show to a shader
  uint64_t texel_buffer_bytes = 0;        // that a texel buffer of four words a texel can show
  uint32_t image_size = 0;                // px per side
  std::array<uint32_t, 3> group_count{};  // workgroups per dispatch
  uint32_t subgroup_size = 0;             // lanes
  bool one_subgroup_size = false;         // no program has subgroups of another size
  uint32_t subpixel_bits = 0;             // vertices are moved to multiples of 2^-bits px
  uint32_t push_constant_bytes = 0;
  uint32_t timestamp_valid_bits = 0;  // 0: the queue has no timestamps
  // The same of the second queue; the main one's where there is no second. Each queue family has its own.
  uint32_t second_timestamp_valid_bits = 0;
  double timestamp_period_ns = 0;
  // After so many iterations the driver ends all loops of a shader, without a word, those of all lanes of a
  // subgroup counted together; 0: it does not.
  uint64_t loop_iterations = 0;
  bool fp64 = false;
  // Fragment shaders may number the triangles of a draw (gl_PrimitiveID), and write images.
  bool fragment_triangles = false, fragment_stores = false;
  // Storage images may have one or two components of 8 or 16 bits, or two of 32.
  bool small_storage_formats = false;
  uint64_t device_memory = 0;  // bytes of the largest device-local heap
};

struct DeviceOptions {
  // Part of a name (case-insensitive), index or UUID; empty: the environment variable MANYLIGHTS_DEVICE, and
  // without it discrete before integrated before virtual before software.
  std::string selector;
  bool validation = false;  // validation layer with synchronization validation
  // Memory begins as garbage that no program mistakes for anything (poison_word), and what an upload buffer
  // has beyond its used bytes is garbage again each time it is mapped: tests find what is read and never
  // written.
  bool poison = false;
};

constexpr uint32_t poison_word = 0xdeadbeefu;

// All devices that the loader lists, usable or not. Throws SystemError when there is no Vulkan at all.
// VK_ICD_FILENAMES, VK_DRIVER_FILES and VK_LOADER_* are the loader's own and are respected by it.
std::vector<DeviceInfo> list_devices();

class Device {
 public:
  // Throws SystemError: no Vulkan, no such device (with the known ones), device lacks something, validation
  // layer not installed.
  explicit Device(const DeviceOptions& options);
  ~Device();
  Device(const Device&) = delete;
  Device& operator=(const Device&) = delete;

  const DeviceInfo& info() const;
  const DeviceLimits& limits() const;
  bool validation_enabled() const;
  // Every warning and error of the validation layer so far, in order; tests expect none.
  std::vector<std::string> validation_messages() const;

  struct Impl;
  Impl& impl() const { return *impl_; }

 private:
  std::unique_ptr<Impl> impl_;
};

}  // namespace ml::gpu
