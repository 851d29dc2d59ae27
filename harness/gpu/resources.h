// Buffers and images.
#pragma once

#include <algorithm>
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

// A buffer of bytes: storage, uniform, vertex, index and transfer uses are all allowed; texel buffers show as
// much of it as DeviceLimits::texel_buffer_bytes.
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
// not device-local a twin that is, filled by Commands::transfer. Grows by doubling, never shrinks.
class UploadBuffer {
 public:
  UploadBuffer(Device& device, std::string name) : device_(&device), name_(std::move(name)) {}
  // Makes room and returns exactly `bytes` writable bytes (0 is allowed; a buffer of 16 bytes is kept then).
  std::span<std::byte> map(size_t bytes);
  const Buffer& host() const { return *host_; }
  const Buffer& shader() const { return twin_ ? *twin_ : *host_; }
  bool has_twin() const { return twin_ != nullptr; }
  size_t used() const { return used_; }
  size_t capacity() const { return host_ ? host_->bytes() : 0; }
  const std::string& name() const { return name_; }

 private:
  Device* device_;
  std::string name_;
  std::unique_ptr<Buffer> host_, twin_;
  size_t used_ = 0;
};

enum class Format { r32_uint, rg32_uint, rgba32_float, d32_float, rgba8_srgb, rgba8_unorm };
size_t bytes_per_pixel(Format format);

enum class ImageUse {
  storage,
  attachment,  // also read by compute shaders as a sampled image
  storage_attachment,
  texture
};

// How shaders read a texture between its pixels and beyond its edges.
struct Sampling {
  enum class Edge { repeat, mirrored_repeat, clamp };
  bool magnify_linear = true, minify_linear = true;
  uint32_t levels = 1;  // of the image: the whole picture, then each half as wide and high, at least 1 px
  bool levels_linear = false;  // two levels are mixed; else the nearer one is taken
  Edge u = Edge::repeat, v = Edge::repeat;
};

class Image {
 public:
  // `sampling` counts for textures; others are read pixel by pixel. Throws SystemError when it is larger than
  // the device's images or its memory.
  Image(Device& device, uint32_t width, uint32_t height, Format format, ImageUse use, const std::string& name,
        const Sampling& sampling = {});
  ~Image();
  Image(Image&&) noexcept;
  Image& operator=(Image&&) noexcept;

  uint32_t width() const { return width_; }
  uint32_t height() const { return height_; }
  Format format() const { return format_; }
  uint32_t levels() const { return levels_; }
  uint32_t width(uint32_t level) const { return std::max(width_ >> level, 1u); }
  uint32_t height(uint32_t level) const { return std::max(height_ >> level, 1u); }
  // Of all levels, one behind the other.
  size_t bytes() const;

  struct Impl;
  Impl& impl() const { return *impl_; }

 private:
  uint32_t width_ = 0, height_ = 0, levels_ = 1;
  Format format_ = Format::r32_uint;
  std::unique_ptr<Impl> impl_;
};

}  // namespace ml::gpu
