// OpenEXR in and out of memory, so that files appear whole or not at all and reading never depends on the
// library's file access.
#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfIO.h>
#include <ImfInputFile.h>
#include <ImfOutputFile.h>
#include <ImfStringAttribute.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <stdexcept>

#include "harness/base/check.h"
#include "harness/base/error.h"
#include "harness/base/file.h"
#include "harness/output/picture.h"

namespace ml {
namespace {

constexpr int64_t largest_side = 32768;  // px
constexpr size_t max_channels = 16;

class MemoryOutput : public Imf::OStream {
 public:
  MemoryOutput() : Imf::OStream("memory") {}
  void write(const char bytes[], int count) override {
    auto size = static_cast<size_t>(count);
    if (position_ + size > bytes_.size()) bytes_.resize(position_ + size);
    std::memcpy(bytes_.data() + position_, bytes, size);
    position_ += size;
  }
  uint64_t tellp() override { return position_; }
  void seekp(uint64_t position) override { position_ = position; }
  const std::vector<std::byte>& bytes() const { return bytes_; }

 private:
  std::vector<std::byte> bytes_;
  size_t position_ = 0;
};

class MemoryInput : public Imf::IStream {
 public:
  explicit MemoryInput(const std::vector<std::byte>& bytes) : Imf::IStream("memory"), bytes_(bytes) {}
  bool read(char target[], int count) override {
    if (count < 0 || position_ > bytes_.size() || static_cast<size_t>(count) > bytes_.size() - position_)
      throw std::runtime_error("the file ends too early");
    std::memcpy(target, bytes_.data() + position_, static_cast<size_t>(count));
    position_ += static_cast<size_t>(count);
    return position_ < bytes_.size();
  }
  uint64_t tellg() override { return position_; }
  void seekg(uint64_t position) override { position_ = position; }

 private:
  const std::vector<std::byte>& bytes_;
  size_t position_ = 0;
};

// Slices that point into interleaved data; `base` stands for pixel (0, 0) of the file's coordinates, which
// may lie outside.
Imf::FrameBuffer frame_buffer(Picture& picture, int64_t left, int64_t top) {
  size_t stride = sizeof(float) * picture.channels.size();
  size_t row = stride * picture.width;
  Imf::FrameBuffer buffer;
  for (size_t c = 0; c < picture.channels.size(); ++c) {
    auto first = reinterpret_cast<uintptr_t>(picture.data.data() + c);
    uintptr_t base = first - static_cast<uintptr_t>(left) * stride - static_cast<uintptr_t>(top) * row;
    buffer.insert(picture.channels[c], Imf::Slice(Imf::FLOAT, reinterpret_cast<char*>(base), stride, row));
  }
  return buffer;
}

std::vector<std::string> channel_names(const Imf::Header& header) {
  constexpr std::array<const char*, 4> colours{"R", "G", "B", "A"};
  std::vector<std::string> names;
  for (const char* name : colours)
    if (header.channels().findChannel(name)) names.emplace_back(name);
  for (auto channel = header.channels().begin(); channel != header.channels().end(); ++channel) {
    if (channel.channel().xSampling != 1 || channel.channel().ySampling != 1)
      throw std::runtime_error("channel " + std::string(channel.name()) + " is subsampled");
    if (std::find(colours.begin(), colours.end(), std::string_view(channel.name())) == colours.end())
      names.emplace_back(channel.name());
  }
  return names;
}

Picture read_stream(MemoryInput& stream) {
  Imf::InputFile input(stream);
  const auto& window = input.header().dataWindow();
  int64_t width = int64_t{window.max.x} - window.min.x + 1, height = int64_t{window.max.y} - window.min.y + 1;
  if (width < 1 || height < 1 || width > largest_side || height > largest_side)
    throw std::runtime_error("its size is not within 1 and " + std::to_string(largest_side) +
                             " pixels a side");
  std::vector<std::string> names = channel_names(input.header());
  if (names.empty() || names.size() > max_channels)
    throw std::runtime_error("it has " + std::to_string(names.size()) + " channels, not 1 to " +
                             std::to_string(max_channels));
  Picture picture(static_cast<uint32_t>(width), static_cast<uint32_t>(height), std::move(names));
  input.setFrameBuffer(frame_buffer(picture, window.min.x, window.min.y));
  input.readPixels(window.min.y, window.max.y);
  return picture;
}

}  // namespace

Picture::Picture(uint32_t w, uint32_t h, std::vector<std::string> names)
    : width(w), height(h), channels(std::move(names)) {
  data.resize(static_cast<size_t>(w) * h * channels.size());
}

void write_exr(const Picture& picture, const std::filesystem::path& file,
               const std::vector<std::pair<std::string, std::string>>& attributes) {
  ML_CHECK(picture.width > 0 && picture.height > 0 && !picture.channels.empty());
  ML_CHECK_EQ(picture.data.size(),
              static_cast<size_t>(picture.width) * picture.height * picture.channels.size());
  MemoryOutput stream;
  try {
    Imf::Header header(static_cast<int>(picture.width), static_cast<int>(picture.height));
    header.compression() = Imf::ZIP_COMPRESSION;
    for (const std::string& name : picture.channels) header.channels().insert(name, Imf::Channel(Imf::FLOAT));
    for (const auto& [name, value] : attributes) header.insert(name, Imf::StringAttribute(value));
    Imf::OutputFile output(stream, header);
    // The library takes writable pointers in both directions; it only reads from these.
    output.setFrameBuffer(frame_buffer(const_cast<Picture&>(picture), 0, 0));
    output.writePixels(static_cast<int>(picture.height));
  } catch (const std::exception& problem) {
    throw SystemError("cannot write " + file.string() + ": " + problem.what());
  }
  write_file(file, stream.bytes());
}

Picture read_exr(const std::filesystem::path& file) {
  std::vector<std::byte> bytes = read_file(file);
  MemoryInput stream(bytes);
  try {
    return read_stream(stream);
  } catch (const std::exception& problem) {
    throw UsageError(file.string() + ": expected an OpenEXR picture: " + problem.what());
  }
}

}  // namespace ml
