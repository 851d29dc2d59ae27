// Many lights from a few numbers: radii, placement, sizing and scripts. Pure functions of the
// description, the scene and the frame.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "harness/lights/account.h"
#include "harness/scene/light.h"
#include "harness/scene/scene.h"

namespace ml {

// s(N) shrinks so that overdraw stays | the same s at every N.
enum class Sizing { const_overdraw, fixed_size };

// Names as in a configuration, in the order of the enumerators.
const std::vector<std::string>& placement_names();
const std::vector<std::string>& sizing_names();
const std::vector<std::string>& light_script_names();

struct LightSpec {
  std::optional<Placement> placement;  // none: the scene's own (Scene::light_defaults)
  uint32_t count = 8192;               // [0, 1048576]
  // Nobody gave a count that is meant for the file's lights: placement `gltf` takes all of them. Other
  // placements make `count` lights all the same.
  bool auto_count = false;
  Sizing sizing = Sizing::const_overdraw;
  // m, s0 of the radius distribution at 65,536 lights. 0: the scene's own (scenes.md), or for a glTF level
  // the size that gives about 3 lights per visible point by the overdraw formula of the placement.
  float base_size = 0;
  // Largest radius / smallest, [1, 1000]; 0: the scene's own, and for `clumps`, `stage` and `room` the
  // placement's own.
  float radius_ratio = 0;
  float radius = 0;  // m, > 0: every light has this radius, and no distribution is used
  // m, placements `triangle` and `area`: > 0 puts every light exactly this far along the surface normal.
  float height = 0;
  // [0, 1] each, [0, 1] together: this part of the lights (by hash) have the shape; the rest are omni.
  float spot_fraction = 0, capsule_fraction = 0, wedge_fraction = 0, box_fraction = 0;
  // The share of probe lights, in whatever shape.
  float probe_fraction = 0;
  float intensity = 1;  // factor on all intensities, > 0
  uint32_t seed = 1;
  std::optional<LightScript> script;  // none: the scene's own
};

// `spec` with the placement, the radius ratio and the script of the scene where it names none.
LightSpec completed(LightSpec spec, const LightDefaults& defaults);

// Radii beyond these (m) leave the range of single precision when the shaders square them; positions (m) have
// a limit for the same reason.
inline constexpr float kMinLightRadius = 1e-12f, kMaxLightRadius = 1e12f;
inline constexpr double kMaxLightPosition = 1e12;

// The reason why a light cannot be used, or nullptr when it can: position, radius, intensity, angles, lengths
// and extents finite and within the limits above; radius and half extents > 0, half length >= 0; intensity >=
// 0; direction and side of unit length and at right angles where the shape has them; a box's radius its half
// diagonal; 0 < outer_angle <= pi and inner_angle <= outer_angle (they may be equal).
const char* rejection_reason(const Light& light);

// "", or what is wrong: the shares of the shapes add up to more than 1.
std::string shape_shares_error(const LightSpec& spec);

// The lights of a run. `at(frame)` is a pure function of (spec, scene, frame).
class LightSet {
 public:
  // Throws UsageError when the scene cannot carry the placement (`gltf` without lights, surfaces without
  // triangles, `stage` and `room` without rooms), the count is too large, the shares of the shapes are, or
  // `stage`, which has shapes of its own, is given any. `gltf` takes the file's lights: all of them, or the
  // first `count` where it was given. On the scene `plane` every placement but `gltf` is `area`, of radius 4
  // and height 2 where the spec names none.
  LightSet(const LightSpec& spec, const Scene& scene);

  // The lights that shine in frame `frame` of a path of `frames` frames that lasts `duration` seconds, in
  // ascending order of their stable identity. drift: each light orbits its position within its own radius.
  // spawn: each light has a seeded life and pause, and fades in and out by its size (scale_size); about 70 %
  // shine at once. orbit: the lights of a clump circle together, those of no clump drift, and all come and go
  // as with spawn. A camera that stands still (duration 0) runs at 60 frames a second, so that its lights
  // still move. Never returns a light that rejection_reason() refuses. `identity`: the index of each in
  // base(), which is the same light's in every frame; may be null. Reuses both; allocates nothing once they
  // have their capacity, unless nodes carry lights: those are moved first (a light whose node has scale 0
  // does not shine in that frame).
  void at(uint32_t frame, uint32_t frames, double duration, std::vector<Light>& out,
          std::vector<uint32_t>* identity = nullptr) const;

  const std::vector<Light>& base() const { return lights_; }  // used lights before scripting
  const Rejections& rejected() const { return account_.rejections; }
  const LightAccount& account() const { return account_; }
  float base_size() const { return size_; }  // m, the s that was used

 private:
  // Whether it is used; counts it where not.
  bool accept(const Light& light);
  void take_file_lights(const Scene& scene);
  void place_lights(const Scene& scene);
  void move_lights(double time, std::vector<Light>& moved, std::vector<uint32_t>& numbers) const;

  LightSpec spec_;
  std::vector<Light> lights_;
  LightAccount account_;
  std::shared_ptr<const NodeMotions> motions_;  // null where no light is carried by a node that moves
  std::vector<int> nodes_;                      // of motions_, by light, -1 for those that stand still
  glm::dvec3 center_{0};                        // m, the scene's origin in the nodes' world
  float size_ = 0;
};

// Radius from a uniform number u in [0, 1): bounded Pareto, pdf ~ r^-3 on [s, ratio * s].
float pareto_radius(float u, float s, float ratio);

}  // namespace ml
