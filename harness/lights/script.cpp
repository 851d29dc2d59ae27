#include "harness/lights/script.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>

#include "harness/lights/clumps.h"
#include "harness/lights/placement.h"
#include "harness/scene/turn.h"

namespace ml {
namespace {

constexpr double kLitShare = 0.7;  // of a light's period
constexpr double kFadeShare = 0.1;

// The functions below return false for a light that is dark, or that rejection_reason() would refuse now.

// A level circle of at most half the radius, so that lights keep their height above the ground.
bool drift(const LightNumbers& number, double seconds, Light& light) {
  double orbit = light.radius * (0.2 + 0.3 * number(LightDimension::orbit));
  // 0.05 to 0.2 turns a second, either way round.
  double rate = number(LightDimension::rate) * 0.3 - 0.15;
  rate += rate < 0 ? -0.05 : 0.05;
  double turns = number(LightDimension::phase) + rate * seconds;
  light.position.x += orbit * cosine_of_turns(turns);
  light.position.z += orbit * sine_of_turns(turns);
  return std::abs(light.position.x) <= kMaxLightPosition && std::abs(light.position.z) <= kMaxLightPosition;
}

// A period of 2 to 6 s: fades in, shines, fades out, pauses.
bool spawn(const LightNumbers& number, double seconds, Light& light) {
  double period = 2 + 4 * static_cast<double>(number(LightDimension::rate));
  double age = number(LightDimension::phase) + seconds / period;
  age = from_nearest(age);
  if (age < 0) age += 1;
  if (age >= kLitShare) return false;
  double fade = std::min({age * (1 / kFadeShare), (kLitShare - age) * (1 / kFadeShare), 1.0});
  scale_size(light, fade);
  // Intensity goes with the square of the radius, as where radii are chosen.
  light.intensity *= static_cast<float>(fade * fade);
  const glm::vec3& half = light.half_extents;
  const float thinnest = light.shape == LightShape::box ? std::min({half.x, half.y, half.z}) : light.radius;
  return thinnest >= kMinLightRadius;
}

// The lights of a clump circle together, whatever the placement: 2 to 6 m about their positions, 0.02 to 0.06
// turns a second, either way round. The others drift.
bool circle(uint32_t seed_hash, const LightNumbers& number, double seconds, Light& light) {
  std::optional<uint32_t> clump = clump_of(number);
  if (!clump) return drift(number, seconds, light);
  constexpr uint32_t kStream = 45;
  Random random(hash_u32(seed_hash, kStream, *clump));
  double radius = random.uniform(2, 6), rate = random.uniform(0.02f, 0.06f);
  double turns = static_cast<double>(random.uniform()) + (random.below(2) == 0 ? rate : -rate) * seconds;
  light.position.x += radius * cosine_of_turns(turns);
  light.position.z += radius * sine_of_turns(turns);
  return std::abs(light.position.x) <= kMaxLightPosition && std::abs(light.position.z) <= kMaxLightPosition;
}

bool shines(LightScript script, uint32_t seed_hash, uint32_t light_number, double seconds, Light& light) {
  LightNumbers number(seed_hash, light_number);
  switch (script) {
    case LightScript::none:
      return true;
    case LightScript::drift:
      return drift(number, seconds, light);
    case LightScript::spawn:
      return spawn(number, seconds, light);
    case LightScript::orbit:
      return circle(seed_hash, number, seconds, light) && spawn(number, seconds, light);
  }
  return true;
}

}  // namespace

double script_time(uint32_t frame, uint32_t frames, double duration) {
  if (!(duration > 0)) return frame / 60.0;
  return frames < 2 ? 0 : duration * (static_cast<double>(frame) / static_cast<double>(frames - 1));
}

void run_script(LightScript script, uint32_t seed, double seconds, std::span<const Light> base,
                std::vector<Light>& out, std::vector<uint32_t>* identity) {
  if (identity) identity->resize(base.size());
  if (script == LightScript::none) {
    out.assign(base.begin(), base.end());
    if (identity) std::iota(identity->begin(), identity->end(), 0u);
    return;
  }
  // Overwritten in place: clearing first would make every light anew.
  out.resize(base.size());
  size_t shining = 0;
  uint32_t seed_hash = hash_u32(seed);
  for (uint32_t i = 0; i < base.size(); ++i) {
    Light& light = out[shining];
    light = base[i];
    if (identity) (*identity)[shining] = i;
    if (shines(script, seed_hash, i, seconds, light)) ++shining;
  }
  out.resize(shining);
  if (identity) identity->resize(shining);
}

}  // namespace ml
