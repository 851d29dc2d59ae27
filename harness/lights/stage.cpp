#include "harness/lights/stage.h"

#include <fmt/format.h>

#include "harness/base/error.h"
#include "harness/scene/turn.h"

namespace ml {
namespace {

constexpr double kDegree = 3.141592653589793 / 180;

double between(Random& random, double low, double high) {
  return low + (high - low) * static_cast<double>(random.uniform());
}

// `tilt` in degrees from straight down.
void aim(Random& random, double tilt, Light& light) {
  double turns = between(random, 0, 1), level = sine_of_turns(tilt / 360);
  glm::dvec3 along(cosine_of_turns(turns), 0, sine_of_turns(turns));
  light.direction =
      glm::vec3(glm::normalize(level * along - cosine_of_turns(tilt / 360) * glm::dvec3(0, 1, 0)));
  // Level, across the direction.
  light.side = glm::vec3(glm::dvec3(-along.z, 0, along.x));
}

void set_cone(Random& random, double min_degrees, double max_degrees, Light& light) {
  double outer = between(random, min_degrees, max_degrees) * kDegree;
  light.outer_angle = static_cast<float>(outer);
  light.inner_angle = static_cast<float>(0.7 * outer);
}

void make_wide_spot(Random& random, Light& light) {
  light.shape = LightShape::spot;
  light.radius = random.uniform(12, 20);
  aim(random, between(random, 0, 20), light);
  set_cone(random, 40, 55, light);
  light.intensity = glm::vec3(0.5f);
}

void make_fill_point(Random& random, double below_ceiling, Light& light) {
  light.radius = random.uniform(9, 14);
  light.position.y -= 0.4 * below_ceiling;
  light.intensity = glm::vec3(0.2f);
}

// A tube that hangs level, along one of the walls.
void make_tube(Random& random, Light& light) {
  light.shape = LightShape::capsule;
  light.radius = random.uniform(2, 4);
  light.half_length = random.uniform(0.8f, 2);
  light.side = random.below(2) == 0 ? glm::vec3(1, 0, 0) : glm::vec3(0, 0, 1);
  light.position.y -= between(random, 0.3, 1.5);
}

// A spot with the range and the cone of the others, a metre or three wide.
void make_wide_strip(Random& random, Light& light) {
  light.shape = LightShape::wedge;
  light.radius = random.uniform(kShortestStageRange, 14);
  light.half_length = random.uniform(0.5f, 1.5f);
  aim(random, between(random, 25, 65), light);
  set_cone(random, 14, 30, light);
}

// Stands on the floor, as the light of a showcase.
void make_showcase(Random& random, double floor, Light& light) {
  double x = between(random, 1, 2.5), y = between(random, 1, 1.8), z = between(random, 1, 2.5);
  make_box(light, glm::vec3(x, y, z));
  light.direction = {0, 0, 1};
  light.side = {1, 0, 0};
  light.position.y = floor + y - 0.2;
}

void make_stage_spot(Random& random, Light& light) {
  light.shape = LightShape::spot;
  light.radius = random.uniform(kShortestStageRange, 20);
  aim(random, between(random, 25, 65), light);
  set_cone(random, 14, 30, light);
}

}  // namespace

const std::vector<Bounds>& rooms_of(const Scene& scene, Placement placement) {
  if (scene.rooms.empty()) {
    throw UsageError(
        one_line(fmt::format("scene '{}': it has no rooms for placement '{}', expected 'museum' or 'arena'",
                             scene.name, placement_names()[static_cast<size_t>(placement)])));
  }
  return scene.rooms;
}

Light stage_light(const std::vector<Bounds>& rooms, uint32_t seed_hash, uint32_t light_number) {
  constexpr uint32_t kStream = 43, kRounds = 44;
  Random random(hash_u32(seed_hash, kStream, light_number));
  // Once round all rooms, from one to the next; each round begins elsewhere.
  const auto room_count = static_cast<uint32_t>(rooms.size());
  uint32_t first = hash_u32(seed_hash, kRounds, light_number / room_count) % room_count;
  const Bounds& room = rooms[(first + light_number) % room_count];
  glm::dvec3 low(room.min), high(room.max);
  Light light;
  // Not in the outermost twelfth on either side.
  double x = between(random, 1.0 / 12, 11.0 / 12), z = between(random, 1.0 / 12, 11.0 / 12);
  light.position = {low.x + x * (high.x - low.x), high.y - 0.7, low.z + z * (high.z - low.z)};

  uint32_t other = light_number - kWideSpots - kFillPoints;
  if (light_number < kWideSpots) {
    make_wide_spot(random, light);
  } else if (light_number < kWideSpots + kFillPoints) {
    make_fill_point(random, high.y - low.y, light);
  } else if (other % 20 == 3) {
    make_tube(random, light);
  } else if (other % 20 == 9) {
    make_wide_strip(random, light);
  } else if (other % 40 == 16) {
    make_showcase(random, low.y, light);
  } else {
    make_stage_spot(random, light);
  }
  return light;
}

}  // namespace ml
