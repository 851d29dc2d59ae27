#include "harness/scene/lathe.h"

#include "harness/scene/turn.h"

namespace ml {

void build_lathe(MeshBuilder& mesh, const glm::dvec3& foot, std::span<const glm::dvec2> profile, int sides,
                 uint32_t material) {
  for (size_t ring = 0; ring + 1 < profile.size(); ++ring) {
    const glm::dvec2 low = profile[ring], high = profile[ring + 1];
    // Outwards, across the profile.
    const glm::dvec2 across(high.y - low.y, low.x - high.x);
    auto vertex = [&](const glm::dvec2& point, double step) {
      double turns = step / sides, c = cosine_of_turns(turns), s = sine_of_turns(turns);
      return mesh.vertex(foot + glm::dvec3(point.x * c, point.y, -point.x * s),
                         {across.x * c, across.y, -across.x * s});
    };
    for (int i = 0; i < sides; ++i) {
      // A pole has a vertex of its own for each side, with that side's normal.
      const bool foot_pole = low.x == 0, top_pole = high.x == 0;
      uint32_t a = vertex(low, foot_pole ? i + 0.5 : i), c = vertex(high, top_pole ? i + 0.5 : i + 1);
      if (!foot_pole) mesh.smooth_triangle(a, vertex(low, i + 1), c, material);
      if (!top_pole) mesh.smooth_triangle(a, c, vertex(high, i), material);
    }
  }
}

}  // namespace ml
