#include "harness/base/parallel.h"

#include <tbb/global_control.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include "harness/base/check.h"

namespace ml {

struct Threads::Arena {
  // TBB starts no more workers than cores unless it is told that more are wanted.
  tbb::global_control limit;
  tbb::task_arena arena;
  explicit Arena(unsigned count)
      : limit(tbb::global_control::max_allowed_parallelism, count), arena(static_cast<int>(count)) {}
};

Threads::Threads(unsigned count) : count_(count) {
  ML_CHECK_GE(count, 1u);
  ML_CHECK_LE(count, 256u);
  if (count > 1) arena_ = std::make_unique<Arena>(count);
}

Threads::~Threads() = default;

void Threads::run(size_t items, void (*call)(void*, size_t), void* context) {
  arena_->arena.execute([&] { tbb::parallel_for(size_t{0}, items, [&](size_t i) { call(context, i); }); });
}

}  // namespace ml
