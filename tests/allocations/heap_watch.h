// Counts what a program takes from the heap: operator new and the C library's functions are replaced in the
// program that links heap_watch.cpp.
#pragma once

#include <cstdint>
#include <string>

namespace ml::test {

struct HeapUse {
  uint64_t own = 0;      // by the project's code, or by a library on its behalf
  uint64_t workers = 0;  // by oneTBB for its tasks, and by the C library for threads that it starts
  std::string first;     // where the first of `own` came from, for messages
};

// Watches all threads from its construction to stop(). One at a time.
class HeapWatch {
 public:
  HeapWatch();
  ~HeapWatch() { stop(); }
  HeapWatch(const HeapWatch&) = delete;
  HeapWatch& operator=(const HeapWatch&) = delete;
  HeapUse stop();
};

}  // namespace ml::test
