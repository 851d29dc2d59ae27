#include "examples/frustum_list/frustum_list.h"

#include <cmath>
#include <cstring>

#include "spirv/frustum_list_forward.h"
#include "spirv/frustum_list_forward_counting.h"
#include "spirv/frustum_list_shade.h"
#include "spirv/frustum_list_shade_counting.h"

namespace ml {
namespace {

// How far a light's ball is inside a plane through the line where a side of the picture window lies;
// negative: outside. `p` is the view-space coordinate along the window's axis, `z` the depth, `sign` 1 for
// the low side and -1 for the high one.
double inside(double p, double z, double edge, double sign, bool orthographic) {
  return orthographic ? sign * (p - edge) : sign * (p - edge * z) / std::sqrt(1 + edge * edge);
}

bool reaches_view(const gpu_data::ViewData& view, glm::dvec3 light, double radius, bool sides) {
  const double x = glm::dot(light, glm::dvec3(view.right)), y = glm::dot(light, glm::dvec3(view.up));
  const double z = glm::dot(light, glm::dvec3(view.forward));
  const bool orthographic = view.orthographic != 0;
  // The shading passes decide in single precision who contributes: what they may round is added to the
  // radius.
  const double reach = radius * 1.00001 + 2e-6 * (std::abs(light.x) + std::abs(light.y) + std::abs(light.z));
  if (z + reach < static_cast<double>(view.near)) return false;
  if (!sides) return true;
  return inside(x, z, view.left_edge, 1, orthographic) >= -reach &&
         inside(x, z, view.right_edge, -1, orthographic) >= -reach &&
         inside(y, z, view.bottom_edge, 1, orthographic) >= -reach &&
         inside(y, z, view.top_edge, -1, orthographic) >= -reach;
}

class FrustumList final : public Algorithm {
 public:
  explicit FrustumList(const Parameters& parameters) : sides_(parameters.boolean("sides")) {}

  void prepare(const FrameInput& frame, UploadMemory& memory, Spans& spans) override {
    {
      auto span = spans.span("cull");
      list_.assign(1, 0);  // the first word is the length
      for (uint32_t i = 0; i < frame.lights.count(); ++i) {
        const glm::dvec3 light(frame.lights.x[i], frame.lights.y[i], frame.lights.z[i]);
        if (reaches_view(frame.view, light, frame.lights.radius[i], sides_)) list_.push_back(i);
      }
      list_[0] = static_cast<uint32_t>(list_.size() - 1);
    }
    auto span = spans.span("upload");
    const size_t bytes = list_.size() * sizeof(uint32_t);
    std::memcpy(memory.map(0, bytes).data(), list_.data(), bytes);
    counters_.in_frustum = list_[0];
    counters_.list_bytes = bytes;
  }

  PrepareCounters counters() const override { return counters_; }
  std::vector<std::string> buffers() const override { return {"List"}; }
  ShadeShaders shade_shaders() const override {
    return {frustum_list_shade, frustum_list_shade_counting, frustum_list_forward,
            frustum_list_forward_counting};
  }

 private:
  bool sides_;
  std::vector<uint32_t> list_;
  PrepareCounters counters_;
};

}  // namespace

AlgorithmEntry frustum_list_entry() {
  AlgorithmEntry entry;
  entry.info.name = "frustum_list";
  entry.info.summary = "one list for all pixels: the lights that reach into the view";
  entry.info.cpu_stages = {"cull", "upload"};
  entry.parameters = {ParameterInfo::boolean(
      "sides", true, "cull against the view's sides too; false: only what is behind the camera")};
  entry.create = [](const Parameters& parameters) { return std::make_unique<FrustumList>(parameters); };
  return entry;
}

}  // namespace ml
