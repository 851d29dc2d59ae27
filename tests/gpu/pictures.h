// Images written, read back and looked up, for the tests of this folder.
#pragma once

#include <cstring>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "harness/gpu/commands.h"
#include "tests/support/test_device.h"

namespace ml::test {

// What lookup.comp is asked.
struct Query {
  glm::vec2 at{0};  // 0 to 1, or the texel
  float depth = 0;
  float level = 0;
};

template <typename T>
gpu::Buffer uploaded(std::span<const T> values, const char* name) {
  gpu::Buffer buffer(device(), values.size_bytes(), gpu::MemoryKind::upload, name);
  std::memcpy(buffer.mapped().data(), values.data(), values.size_bytes());
  return buffer;
}

// All levels, one after the other.
template <typename T>
void write(gpu::Commands& commands, const gpu::Image& image, const std::vector<T>& pixels) {
  const gpu::Buffer staging = uploaded(std::span(pixels), "pixels");
  commands.begin(gpu::Timing::none);
  commands.write_image(staging, image);
  commands.submit();
}

template <typename T>
std::vector<T> read(gpu::Commands& commands, const gpu::Image& image, uint32_t level = 0) {
  gpu::Buffer back(device(), image.bytes(level), gpu::MemoryKind::readback, "pixels");
  commands.begin(gpu::Timing::none);
  commands.read_image(image, back, level);
  commands.submit();
  std::vector<T> pixels(image.bytes(level) / sizeof(T));
  std::memcpy(pixels.data(), back.mapped().data(), back.bytes());
  return pixels;
}

// A vec4 or uvec4 for each query.
template <typename Answer>
std::vector<Answer> look_up(gpu::Commands& commands, const gpu::ComputeProgram& program,
                            const gpu::Binding& picture, const std::vector<Query>& queries) {
  const size_t bytes = queries.size() * sizeof(Answer);
  const gpu::Buffer asked = uploaded(std::span(queries), "queries");
  gpu::Buffer answers(device(), bytes, gpu::MemoryKind::device, "answers"),
      back(device(), bytes, gpu::MemoryKind::readback, "answers");
  const auto count = static_cast<uint32_t>(queries.size());
  commands.begin(gpu::Timing::none);
  commands.dispatch(program, {picture, {"Queries", asked}, {"Answers", answers}}, count, (count + 63) / 64);
  commands.read_buffer(answers, bytes, back);
  commands.submit();
  std::vector<Answer> list(queries.size());
  std::memcpy(list.data(), back.mapped().data(), bytes);
  return list;
}

}  // namespace ml::test
