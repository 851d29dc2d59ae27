// Puts a GLB together: aligned buffer views and accessors in one binary chunk. Private to the exporter.
#pragma once

#include <cstddef>
#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <vector>

namespace ml::gltf {

// The order of keys is the order of writing, so that the same scene gives the same bytes.
using OrderedJson = nlohmann::ordered_json;

class GlbWriter {
 public:
  enum class Target : int { none = 0, vertices = 34962, indices = 34963 };

  OrderedJson& json() { return json_; }

  // A buffer view of `bytes`, 4-aligned. Returns its index.
  size_t add_view(std::span<const std::byte> bytes, Target target = Target::none);
  // An accessor on floats of `components` each; with `bounds`, its smallest and largest components are
  // written too.
  size_t add_floats(std::span<const float> values, size_t components, Target target, bool bounds);
  size_t add_indices(std::span<const uint32_t> indices, size_t view, size_t first);

  // The whole file; ends the use of this object.
  std::vector<std::byte> finish();

 private:
  OrderedJson json_ = OrderedJson::object();
  std::vector<std::byte> binary_;
};

}  // namespace ml::gltf
