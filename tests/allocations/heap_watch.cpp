#include "heap_watch.h"

#include <cxxabi.h>
#include <dlfcn.h>
#include <fmt/format.h>

#include <atomic>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <new>

// glibc's own allocator under names that nobody replaces; its free() takes all of it back.
extern "C" {
void* __libc_malloc(size_t bytes);
void* __libc_calloc(size_t count, size_t bytes);
void* __libc_realloc(void* old, size_t bytes);
void* __libc_memalign(size_t alignment, size_t bytes);
}

namespace {

std::atomic<bool> watching{false};
std::atomic<uint64_t> own_count{0}, workers_count{0};
std::atomic<void*> first_caller{nullptr};

bool is_of_workers(const char* library) {
  const char* name = std::strrchr(library, '/');
  name = name ? name + 1 : library;
  for (const char* known : {"libtbb", "libc.so", "ld-linux"})
    if (std::strncmp(name, known, std::strlen(known)) == 0) return true;
  return false;
}

// `caller`: an address in the code that asks for memory. Takes nothing from the heap itself.
void note(void* caller) {
  if (!watching.load(std::memory_order_relaxed)) return;
  Dl_info info{};
  if (dladdr(caller, &info) != 0 && info.dli_fname && is_of_workers(info.dli_fname))
    ++workers_count;
  else if (own_count++ == 0)
    first_caller = caller;
}

void* take(size_t bytes, void* caller) {
  note(caller);
  void* memory = __libc_malloc(bytes);
  if (!memory) throw std::bad_alloc();
  return memory;
}

void* take_aligned(size_t alignment, size_t bytes, void* caller) {
  note(caller);
  void* memory = __libc_memalign(alignment, bytes);
  if (!memory) throw std::bad_alloc();
  return memory;
}

std::string describe(void* caller) {
  Dl_info info{};
  if (dladdr(caller, &info) == 0) return fmt::format("{}", caller);
  int status = -1;
  char* name = info.dli_sname ? abi::__cxa_demangle(info.dli_sname, nullptr, nullptr, &status) : nullptr;
  const auto offset = static_cast<char*>(caller) - static_cast<char*>(info.dli_fbase);
  std::string text = fmt::format("{} + {:#x}, in or after {}", info.dli_fname, offset,
                                 status == 0 ? name : "a function without a name");
  std::free(name);
  return text;
}

}  // namespace

#define CALLER __builtin_return_address(0)

void* operator new(size_t bytes) {
  return take(bytes, CALLER);
}
void* operator new[](size_t bytes) {
  return take(bytes, CALLER);
}
void* operator new(size_t bytes, std::align_val_t alignment) {
  return take_aligned(static_cast<size_t>(alignment), bytes, CALLER);
}
void* operator new[](size_t bytes, std::align_val_t alignment) {
  return take_aligned(static_cast<size_t>(alignment), bytes, CALLER);
}
void* operator new(size_t bytes, const std::nothrow_t&) noexcept {
  note(CALLER);
  return __libc_malloc(bytes);
}
void* operator new[](size_t bytes, const std::nothrow_t&) noexcept {
  note(CALLER);
  return __libc_malloc(bytes);
}
void operator delete(void* memory) noexcept {
  std::free(memory);
}
void operator delete[](void* memory) noexcept {
  std::free(memory);
}
void operator delete(void* memory, size_t) noexcept {
  std::free(memory);
}
void operator delete[](void* memory, size_t) noexcept {
  std::free(memory);
}
void operator delete(void* memory, std::align_val_t) noexcept {
  std::free(memory);
}
void operator delete[](void* memory, std::align_val_t) noexcept {
  std::free(memory);
}
void operator delete(void* memory, size_t, std::align_val_t) noexcept {
  std::free(memory);
}
void operator delete[](void* memory, size_t, std::align_val_t) noexcept {
  std::free(memory);
}

extern "C" {
void* malloc(size_t bytes) {
  note(CALLER);
  return __libc_malloc(bytes);
}
void* calloc(size_t count, size_t bytes) {
  note(CALLER);
  return __libc_calloc(count, bytes);
}
void* realloc(void* old, size_t bytes) {
  note(CALLER);
  return __libc_realloc(old, bytes);
}
void* memalign(size_t alignment, size_t bytes) {
  note(CALLER);
  return __libc_memalign(alignment, bytes);
}
void* aligned_alloc(size_t alignment, size_t bytes) {
  note(CALLER);
  return __libc_memalign(alignment, bytes);
}
int posix_memalign(void** to, size_t alignment, size_t bytes) {
  note(CALLER);
  *to = __libc_memalign(alignment, bytes);
  return *to ? 0 : ENOMEM;
}
}

namespace ml::test {

HeapWatch::HeapWatch() {
  own_count = workers_count = 0;
  first_caller = nullptr;
  watching = true;
}

HeapUse HeapWatch::stop() {
  watching = false;
  HeapUse use{own_count, workers_count, {}};
  if (use.own > 0) use.first = describe(first_caller);
  return use;
}

}  // namespace ml::test
