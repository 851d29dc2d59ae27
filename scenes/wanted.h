// What makes a scene a fair stand-in: numbers that the tests measure and hold to these ranges. Everything but
// `numbers` is measured of every scene by tests/unit/scenes/every_scene_test.cpp.
#pragma once

#include <cstdint>
#include <limits>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "harness/base/json_node.h"
#include "harness/scene/light_defaults.h"

namespace ml {

// [low, high] in JSON, both ends included; null is an end that is open.
struct Range {
  double low = -std::numeric_limits<double>::infinity(), high = std::numeric_limits<double>::infinity();
  bool holds(double value) const { return value >= low && value <= high; }
};

// One view along a path.
struct WantedView {
  std::string name;  // what is seen, for messages
  std::string path;
  double time = 0;  // s
  Range depth_p95;  // m, the depth below which 95 % of the pixels with something in them lie
};

// The share of a path's frames whose depth_p95 is in a range.
struct WantedFrames {
  std::string path;
  Range depth_p95;  // m
  Range share;      // [0, 1]
};

// How many lights reach a visible point of the default path, and how large they are.
struct WantedLights {
  uint32_t count = 0;
  std::optional<Placement> placement;  // none: the scene's own
  uint32_t seeds = 1;                  // of the lights: 1, 2, ...; the mean is over all of them
  Range mean, max;
  Range base_size;  // m, LightSet::base_size()
  Range radius;     // m, of every light
};

struct Wanted {
  // Of the vertices, triangles and default path of seed 1, the same on every machine and with every compiler:
  // a number that changes with the generator alone.
  uint32_t hash = 0;
  bool differs_by_seed = true;
  Range triangles;
  Range size_x, size_y, size_z;  // m, of the bounds
  Range metals, roughnesses;     // of the materials that are drawn: metals, and different roughnesses
  std::map<std::string, Range> median_depth;  // m, in every frame of the path of that name
  std::vector<WantedView> views;
  std::vector<WantedFrames> frames;
  std::vector<WantedLights> lights;
  std::map<std::string, Range> numbers;  // of this scene alone: its own test measures them

  // Throws UsageError with the nearest known name.
  const Range& number(const std::string& name) const;
};

// Throws UsageError "FILE: PLACE: what".
Wanted read_wanted(const Node& node);

}  // namespace ml
