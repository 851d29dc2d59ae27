// One command buffer, one submission in flight: record, submit, wait, read the times.
//
// A pass is one call: dispatch(program, bindings, push constants, groups). Passes are ordered by full memory
// barriers, so that an algorithm writes no synchronisation of its own. A submission may be forked once: part
// of it then runs on the device's second queue.
#pragma once

#include <cstdint>
#include <functional>
#include <initializer_list>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "harness/gpu/program.h"
#include "harness/gpu/resources.h"
#include "harness/gpu/submission_times.h"

namespace ml::gpu {

// A resource for the shader variable (or block) of that name. An image is all of its levels where the shader
// samples it, its first one where the shader stores to it; with `level` it is that level alone, which the
// shader then knows as 0. A pass may read some levels of an image and write others.
struct Binding {
  std::string_view name;
  const Buffer* buffer = nullptr;
  const Image* image = nullptr;
  std::optional<uint32_t> level;
  std::optional<Sampling> sampling;  // instead of the image's own
  Binding(std::string_view n, const Buffer& b) : name(n), buffer(&b) {}
  Binding(std::string_view n, const UploadBuffer& b) : name(n), buffer(&b.shader()) {}
  Binding(std::string_view n, const Image& i) : name(n), image(&i) {}
  Binding(std::string_view n, const Image& i, uint32_t l) : name(n), image(&i), level(l) {}
  Binding(std::string_view n, const Image& i, const Sampling& s) : name(n), image(&i), sampling(s) {}
};
using Bindings = std::vector<Binding>;

// Where the GPU's time is stamped.
enum class Timing {
  none,  // no stamps
  // Every span stands alone: at its begin and at its end the queue's work runs out (a full barrier), the time
  // is stamped, and only then the next work starts (a second one). So a span inside another one costs the
  // outer one two such stops, which are in its time.
  stages,
  whole,  // only the whole submission is stamped; spans cost nothing
};

struct DrawCall {
  uint32_t first_index = 0, index_count = 0;
  bool double_sided = false;
  bool mirrored = false;  // its vertices are: fronts are clockwise then
  const RasterProgram* program = nullptr;
  Bindings bindings;
  std::vector<std::byte> push;
};

struct RasterTargets {
  std::vector<const Image*> colors;  // cleared to 0
  const Image* depth = nullptr;      // cleared to 0, the farthest
  bool keep = false;                 // nothing is cleared
};

class Commands {
 public:
  explicit Commands(Device& device);
  ~Commands();
  Commands(const Commands&) = delete;
  Commands& operator=(const Commands&) = delete;

  // Passes are recorded between begin() and submit(); out of turn each is a std::logic_error.
  void begin(Timing timing);
  // Submits, waits for the fence and reads the stamps. Throws SystemError when the device is lost.
  SubmissionTimes submit();

  // What `second` records runs on the device's second queue, beside what `beside` records for the main one;
  // both come after what was recorded before, and what is recorded from then on comes after both. The two
  // must not write what the other uses. `second` holds no draws, and no image may be used by both
  // (std::logic_error). A device with one queue runs `second`, then `beside`, through the same submissions
  // and semaphores.
  void fork(const std::function<void()>& second, const std::function<void()>& beside);

  // Compute. `bindings` may name more than the program uses; everything it uses must be there
  // (std::logic_error with the name).
  void dispatch(const ComputeProgram& program, const Bindings& bindings, std::span<const std::byte> push,
                uint32_t groups_x, uint32_t groups_y = 1, uint32_t groups_z = 1);
  template <typename Push>
  void dispatch(const ComputeProgram& program, const Bindings& bindings, const Push& push, uint32_t groups_x,
                uint32_t groups_y = 1, uint32_t groups_z = 1) {
    static_assert(std::is_trivially_copyable_v<Push>);
    dispatch(program, bindings, std::as_bytes(std::span(&push, 1)), groups_x, groups_y, groups_z);
  }

  // Compute, with the three group counts (uint32_t x, y, z) that stand in `groups` from byte `offset` on when
  // the pass begins: a multiple of 4, with the 12 bytes in the buffer, which is no readback memory
  // (std::logic_error). Counts of 0 are no work; what is over DeviceLimits::group_count is for the pass that
  // writes them to avoid.
  void dispatch_indirect(const ComputeProgram& program, const Bindings& bindings,
                         std::span<const std::byte> push, const Buffer& groups, size_t offset = 0);
  template <typename Push>
  void dispatch_indirect(const ComputeProgram& program, const Bindings& bindings, const Push& push,
                         const Buffer& groups, size_t offset = 0) {
    static_assert(std::is_trivially_copyable_v<Push>);
    dispatch_indirect(program, bindings, std::as_bytes(std::span(&push, 1)), groups, offset);
  }

  // Clears the first level of the targets (unless they are kept) and draws into it.
  void raster(const RasterTargets& targets, const Buffer& vertices, const Buffer& indices,
              std::span<const DrawCall> draws);

  void clear(const Image& image);  // all bits of all levels 0
  void fill(const Buffer& buffer, uint32_t word);
  // Copies; what does not fit is a std::logic_error.
  void transfer(const UploadBuffer& buffer);  // to the device-local copy, where there is one
  void read_image(const Image& image, const Buffer& into, uint32_t level = 0);  // tightly packed rows
  void write_image(const Buffer& from, const Image& image);  // all levels, one after the other
  void read_buffer(const Buffer& buffer, size_t bytes, const Buffer& into);  // into any kind of memory

  // Names the passes until the returned object dies, in times, traces and debuggers. Inside another span its
  // name is "outer/inner"; no name has a slash of its own, no span crosses a fork, and all have ended when
  // the submission is (std::logic_error).
  class Span {
   public:
    ~Span() { commands_.end_span(); }
    Span(const Span&) = delete;
    Span& operator=(const Span&) = delete;

   private:
    friend class Commands;
    explicit Span(Commands& commands) : commands_(commands) {}
    Commands& commands_;
  };
  [[nodiscard]] Span span(std::string_view name);

  // Passes until the returned object dies write nothing that another of them touches, though it may lie in
  // the same image or buffer: no barriers stand between them, only one after the last.
  class Unordered {
   public:
    ~Unordered() { commands_.end_unordered(); }
    Unordered(const Unordered&) = delete;
    Unordered& operator=(const Unordered&) = delete;

   private:
    friend class Commands;
    explicit Unordered(Commands& commands) : commands_(commands) {}
    Commands& commands_;
  };
  [[nodiscard]] Unordered unordered();

 private:
  friend class Span;
  void end_span();
  void end_unordered();
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace ml::gpu
