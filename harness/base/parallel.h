// Parallel loops whose results do not depend on the number of threads.
//
// Work is cut into chunks by size alone, never by thread, and each chunk writes only what is its own; so 1, 2
// and 7 threads give the same bits.
#pragma once

#include <cstddef>
#include <functional>
#include <memory>

namespace ml {

// A fixed number of worker threads (oneTBB's arena; the caller's thread is one of them).
class Threads {
 public:
  // `count` in [1, 256].
  explicit Threads(unsigned count = 1);
  ~Threads();
  Threads(const Threads&) = delete;
  Threads& operator=(const Threads&) = delete;

  unsigned count() const { return count_; }

  // Calls body(i) once for every i in [0, items), on any thread, in any order. With one thread: in order, on
  // the caller.
  template <typename Body>
  void for_each(size_t items, Body&& body) {
    if (count_ == 1 || items < 2) {
      for (size_t i = 0; i < items; ++i) body(i);
    } else {
      run(
          items, [](void* context, size_t i) { (*static_cast<std::remove_reference_t<Body>*>(context))(i); },
          &body);
    }
  }

 private:
  void run(size_t items, void (*call)(void*, size_t), void* context);

  unsigned count_;
  struct Arena;
  std::unique_ptr<Arena> arena_;
};

}  // namespace ml
