#include "harness/scene/light_script.h"

#include <algorithm>
#include <cmath>

#include "harness/scene/light_placement.h"
#include "harness/scene/turn.h"

namespace ml {
namespace {

constexpr double kLitShare = 0.7;  // of a light's period
constexpr double kFadeShare = 0.1;

// A level circle of at most half the radius, so that lights keep their height above the ground.
void drift(uint32_t seed, uint32_t index, double seconds, Light& light) {
  double orbit = light.radius * (0.2 + 0.3 * light_number(seed, index, LightDimension::orbit));
  // 0.05 to 0.2 turns a second, either way round.
  double rate = light_number(seed, index, LightDimension::rate) * 0.3 - 0.15;
  rate += rate < 0 ? -0.05 : 0.05;
  double turns = light_number(seed, index, LightDimension::phase) + rate * seconds;
  light.position.x += orbit * cosine_of_turns(turns);
  light.position.z += orbit * sine_of_turns(turns);
}

// A period of 2 to 6 s: fades in, shines, fades out, pauses.
bool spawn(uint32_t seed, uint32_t index, double seconds, Light& light) {
  double period = 2 + 4 * static_cast<double>(light_number(seed, index, LightDimension::rate));
  double age = light_number(seed, index, LightDimension::phase) + seconds / period;
  age -= std::floor(age);
  if (age >= kLitShare) return false;
  double fade = std::min({age / kFadeShare, (kLitShare - age) / kFadeShare, 1.0});
  light.radius = static_cast<float>(light.radius * fade);
  // Intensity goes with the square of the radius, as in the radius law.
  light.intensity *= static_cast<float>(fade * fade);
  return true;
}

}  // namespace

double script_time(uint32_t frame, uint32_t frames, double duration) {
  if (!(duration > 0)) return frame / 60.0;
  return frames < 2 ? 0 : duration * (static_cast<double>(frame) / static_cast<double>(frames - 1));
}

void run_script(LightScript script, uint32_t seed, double seconds, std::span<const Light> base, std::vector<Light>& out) {
  if (script == LightScript::none) {
    out.assign(base.begin(), base.end());
    return;
  }
  // Overwritten in place: clearing first would make every light anew.
  out.resize(base.size());
  size_t shining = 0;
  for (uint32_t i = 0; i < base.size(); ++i) {
    Light& light = out[shining];
    light = base[i];
    bool shines = true;
    if (script == LightScript::drift) {
      drift(seed, i, seconds, light);
    } else {
      shines = spawn(seed, i, seconds, light);
    }
    if (shines && !rejection_reason(light)) ++shining;
  }
  out.resize(shining);
}

}  // namespace ml
