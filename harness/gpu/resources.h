// Buffers and images.
#pragma once

#include <algorithm>
#include <compare>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>

#include "harness/gpu/device.h"

namespace ml::gpu {

enum class MemoryKind {
  device,    // not mapped
  upload,    // mapped for writing; device-local too where the device has such memory
  readback,  // mapped for reading, cached where possible
};

// A buffer of bytes: storage, uniform, vertex, index, indirect and transfer uses are all allowed, all but the
// last not for readback; texel buffers show as much of it as DeviceLimits::texel_buffer_bytes.
class Buffer {
 public:
  // `bytes` > 0. Throws SystemError naming `name`, the bytes and the limit when it is over the device's
  // storage range or memory.
  Buffer(Device& device, size_t bytes, MemoryKind kind, const std::string& name);
  ~Buffer();
  Buffer(Buffer&&) noexcept;
  Buffer& operator=(Buffer&&) noexcept;

  size_t bytes() const { return bytes_; }
  std::span<std::byte> mapped() const;  // empty for MemoryKind::device
  bool device_local() const;
  bool cached() const;  // by the CPU

  struct Impl;
  Impl& impl() const { return *impl_; }

 private:
  size_t bytes_ = 0;
  std::unique_ptr<Impl> impl_;
};

// A storage buffer that the CPU writes every frame and shaders read: mapped memory, and where that memory is
// not device-local a copy that is, filled by Commands::transfer. Grows by doubling, never shrinks.
class UploadBuffer {
 public:
  UploadBuffer(Device& device, std::string name) : device_(&device), name_(std::move(name)) {}
  // Makes space and returns exactly `bytes` writable bytes (0 is allowed; a buffer of 16 bytes is kept then).
  std::span<std::byte> map(size_t bytes);
  const Buffer& host() const { return *host_; }
  const Buffer& shader() const { return device_copy_ ? *device_copy_ : *host_; }
  bool has_device_copy() const { return device_copy_ != nullptr; }
  size_t used() const { return used_; }
  size_t capacity() const { return host_ ? host_->bytes() : 0; }
  const std::string& name() const { return name_; }

 private:
  Device* device_;
  std::string name_;
  std::unique_ptr<Buffer> host_, device_copy_;
  size_t used_ = 0;
};

enum class Format {
  r8_unorm,
  rg8_unorm,
  rgba8_unorm,
  rgba8_srgb,
  r16_float,
  rg16_float,
  rgba16_float,
  r32_float,
  rg32_float,
  rgba32_float,
  r32_uint,
  rg32_uint,
  rgba32_uint,
  d16_unorm,
  d32_float,
};
size_t bytes_per_pixel(Format format);
bool is_depth(Format format);
const char* in_words(Format format);  // "rgba16_float"

// Shaders can sample an image of any use.
enum class ImageUse {
  storage,
  attachment,
  storage_attachment,
  texture  // and nothing else
};

// How shaders read an image between its pixels and beyond its edges.
struct Sampling {
  enum class Edge { repeat, mirrored_repeat, clamp };
  // What a sampler2DShadow answers: how many of the depths that it reads the given one compares so to, 0 to
  // 1. With reversed depth `greater_or_equal` is 1 where nothing lies nearer than the given depth.
  enum class Compare { none, greater_or_equal, less_or_equal };
  bool magnify_linear = true, minify_linear = true;
  bool levels_linear = false;  // two levels are mixed; else the nearer one is taken
  Edge u = Edge::repeat, v = Edge::repeat;
  Compare compare = Compare::none;
  auto operator<=>(const Sampling&) const = default;

  // For passes: one pixel, or a mix of four; the pixels at the edge go on beyond it.
  static constexpr Sampling nearest() { return {false, false, false, Edge::clamp, Edge::clamp}; }
  static constexpr Sampling linear() { return {true, true, false, Edge::clamp, Edge::clamp}; }
  // `linear` compares four pixels and mixes the answers. Not every device does (supports()); a shader can
  // mix four answers of its own.
  static constexpr Sampling comparing(Compare compare, bool linear) {
    return {linear, linear, false, Edge::clamp, Edge::clamp, compare};
  }
};

// As many levels as there are down to one pixel.
inline constexpr uint32_t all_levels = UINT32_MAX;

struct ImageDesc {
  uint32_t width = 0, height = 0;  // px
  Format format = Format::r32_uint;
  ImageUse use = ImageUse::storage;
  // The whole picture, then each half as wide and high, rounded down, at least 1 px. Depth formats have one.
  uint32_t levels = 1;
  // Unless a Binding says otherwise. Pixel by pixel where it is not given.
  Sampling sampling{.magnify_linear = false, .minify_linear = false};
};

// Whether the device has images of this format for this use, and samples them so.
bool supports(const Device& device, Format format, ImageUse use,
              const Sampling& sampling = Sampling::nearest());

class Image {
 public:
  // Throws SystemError, naming `name`, when it is larger than the device's images or its memory, and when the
  // device does not support the format for it; std::logic_error for levels that there cannot be.
  Image(Device& device, const ImageDesc& desc, const std::string& name);
  // One level.
  Image(Device& device, uint32_t width, uint32_t height, Format format, ImageUse use, const std::string& name)
      : Image(device, ImageDesc{width, height, format, use}, name) {}
  ~Image();
  Image(Image&&) noexcept;
  Image& operator=(Image&&) noexcept;

  uint32_t width() const { return desc_.width; }
  uint32_t height() const { return desc_.height; }
  Format format() const { return desc_.format; }
  uint32_t levels() const { return desc_.levels; }
  uint32_t width(uint32_t level) const { return std::max(desc_.width >> level, 1u); }
  uint32_t height(uint32_t level) const { return std::max(desc_.height >> level, 1u); }
  // Of all levels, one after the other; of one.
  size_t bytes() const;
  size_t bytes(uint32_t level) const;

  struct Impl;
  Impl& impl() const { return *impl_; }

 private:
  ImageDesc desc_;
  std::unique_ptr<Impl> impl_;
};

}  // namespace ml::gpu
