#include "harness/bench/bookkeeping.h"

#include <fmt/format.h>

#include <cstdio>

#include "harness/base/error.h"

namespace ml {
namespace {

// The file, where there is one.
std::string level_name(const Setup& setup) {
  return setup.scene.gltf.empty() ? setup.scene_label : setup.scene.gltf.string();
}

std::string unseen_text(uint32_t unseen, uint32_t frames) {
  return fmt::format("no surface is seen in {} of {} frame{}", unseen, frames, frames == 1 ? "" : "s");
}

}  // namespace

void keep_books(const Workload& workload, CaseResult& result) {
  const LightAccount& account = workload.lights().account();
  result.light_account = {account.of_file, account.total, account.used, account.dark, account.left_out};
  for (const auto& [reason, count] : account.rejections) result.rejected_lights[reason] = count;
  result.notes = workload.scene()->notes;
}

void tell_books(const Setup& setup, const Workload& workload, uint32_t unseen, uint32_t frames) {
  std::vector<std::string> lines = account_lines(workload.lights().account());
  const std::vector<std::string>& notes = workload.scene()->notes;
  lines.insert(lines.end(), notes.begin(), notes.end());
  if (unseen) lines.push_back(unseen_text(unseen, frames));
  for (const std::string& line : lines) fmt::print(stderr, "{}: {}\n", level_name(setup), line);
}

void require_surface(const Setup& setup, uint32_t unseen, uint32_t frames) {
  if (unseen < frames) return;
  throw UsageError(one_line(fmt::format(
      "{}: {}; expected a camera that sees the level (camera.path, camera.keyframes, camera.frames)",
      level_name(setup), unseen_text(unseen, frames))));
}

}  // namespace ml
