#include "harness/scene/scene.h"

#include <fmt/format.h>

#include "harness/base/error.h"

namespace ml {

const CameraPath& Scene::path(const std::string& path_name) const {
  std::vector<std::string> known;
  for (const CameraPath& candidate : paths) {
    if (candidate.name == path_name) return candidate;
    known.push_back(candidate.name);
  }
  if (known.empty())
    throw UsageError(one_line(fmt::format("scene '{}': it has no camera path '{}'", name, path_name)));
  throw UsageError(one_line(fmt::format("scene '{}': it has no camera path '{}'{}", name, path_name,
                                        suggestion(path_name, known))));
}

}  // namespace ml
