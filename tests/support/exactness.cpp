#include "tests/support/exactness.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "algorithms/device_algorithm.h"
#include "harness/accuracy/image_metrics.h"
#include "harness/base/random.h"
#include "harness/lights/set.h"

namespace ml::test {

// An algorithm whose inner one can be exchanged, so that programs are compiled once for many parameters.
class Exactness::Replaceable final : public Algorithm {
 public:
  explicit Replaceable(std::shared_ptr<std::unique_ptr<Algorithm>> inner) : inner_(std::move(inner)) {}
  void prepare(const FrameInput& frame, UploadMemory& memory, Spans& spans) override {
    (*inner_)->prepare(frame, memory, spans);
  }
  PrepareCounters counters() const override { return (*inner_)->counters(); }
  std::vector<std::string> buffers() const override { return (*inner_)->buffers(); }
  ShadeShaders shade_shaders() const override { return (*inner_)->shade_shaders(); }
  gpu::Constants shade_constants() const override { return (*inner_)->shade_constants(); }
  bool walks_together() const override { return (*inner_)->walks_together(); }
  LongestWalk longest_walk(const FrameInput& frame) const override { return (*inner_)->longest_walk(frame); }
  TileClasses tile_classes() const override { return (*inner_)->tile_classes(); }
  gpu::Constants class_constants(uint32_t tile_class) const override {
    return (*inner_)->class_constants(tile_class);
  }
  // Its algorithm is not exchanged where it has one of its own (slot_of()).
  std::unique_ptr<DeviceAlgorithm> device_half(const DeviceContext& context) override {
    return (*inner_)->device_half(context);
  }
  std::optional<uint32_t> lights_listed(glm::uvec2 pixel, float depth) const override {
    return (*inner_)->lights_listed(pixel, depth);
  }

 private:
  std::shared_ptr<std::unique_ptr<Algorithm>> inner_;
};

namespace {

const AlgorithmEntry& entry_of(const std::string& name) {
  return find_algorithm(name, "test");
}

// The algorithm's parameters that the grid has a word for, and walk `number` of its walks, counted round; the
// others at their defaults.
Trial trial_of(const std::string& algorithm, const GridSettings& grid, size_t number) {
  const std::vector<ParameterInfo>& infos = entry_of(algorithm).parameters;
  Trial trial{algorithm, Parameters(infos)};
  const std::pair<const char*, ParameterValue> values[] = {
      {"tile", grid.tile},
      {"slices", grid.slices},
      {"zmin", grid.zmin},
      {"zmax", grid.zmax},
      {"refinement", grid.refinement},
      {"ball_test", grid.ball_test},
      {"index_bits", std::string(grid.refinement && !grid.duplicated ? "16" : "32")},
      {"node_depths", std::string(grid.ball_test ? "chord" : "ball")},
      {"light_data", std::string(grid.duplicated ? "duplicated" : "indexed")},
  };
  for (const auto& [name, value] : values)
    if (trial.parameters.values().contains(name)) trial.parameters.set(infos, name, value, "test");
  for (const ParameterInfo& info : infos)
    if (info.name == "walk")
      trial.parameters.set(infos, info.name, info.choices[number % info.choices.size()], "test");
  return trial;
}

// Exact algorithms that are tried beside clustered.
std::vector<std::string> others() {
  std::vector<std::string> names;
  for (const AlgorithmEntry& entry : algorithm_registry())
    if (entry.info.exact && !entry.info.reference_only && !entry.info.needs_contributing_lists &&
        entry.info.name != "clustered")
      names.push_back(entry.info.name);
  return names;
}

ParameterValue random_value(const ParameterInfo& info, Random& random) {
  if (!info.choices.empty()) return info.choices[random.below(static_cast<uint32_t>(info.choices.size()))];
  if (std::holds_alternative<bool>(info.fallback)) return random.below(2) == 0;
  // Small values as often as large ones; the ends of the range, and 0, now and then.
  const double low = std::max(info.minimum, 1e-3), high = info.maximum;
  double value = low * std::pow(high / low, static_cast<double>(random.uniform()));
  if (random.below(10) == 0) value = info.minimum;
  if (random.below(20) == 0) value = info.maximum;
  if (std::holds_alternative<double>(info.fallback)) return std::clamp(value, info.minimum, info.maximum);
  return static_cast<int64_t>(std::clamp(std::round(value), info.minimum, info.maximum));
}

ShadedAlgorithm ideal_with(const char* walk, const FrameOptions& options) {
  const AlgorithmEntry& entry = entry_of("ideal");
  Parameters parameters(entry.parameters);
  parameters.set(entry.parameters, "walk", std::string(walk), "test");
  return ShadedAlgorithm(device(), entry, parameters, options);
}

}  // namespace

std::string Trial::text() const {
  std::string text = algorithm;
  for (const auto& [name, value] : parameters.values())
    std::visit([&, &name = name](const auto& word) { text += fmt::format(" {}={}", name, word); }, value);
  return text;
}

std::vector<Trial> trials_of(const std::vector<GridSettings>& grids) {
  static const std::vector<std::string> other = others();
  std::vector<Trial> trials;
  for (size_t i = 0; i < grids.size(); ++i) {
    trials.push_back(trial_of("clustered", grids[i], i));
    trials.push_back(trial_of(other[i % other.size()], grids[i], i / other.size()));
  }
  return trials;
}

Trial random_trial(Random& random, uint32_t width, uint32_t height) {
  static const std::vector<std::string> other = others();
  const uint32_t pick = random.below(static_cast<uint32_t>(other.size()) + 1);
  Trial trial{pick == other.size() ? "clustered" : other[pick], {}};
  const AlgorithmEntry& entry = entry_of(trial.algorithm);
  do {
    trial.parameters = Parameters(entry.parameters);
    for (const ParameterInfo& info : entry.parameters)
      if (random.below(3) != 0)
        trial.parameters.set(entry.parameters, info.name, random_value(info, random), "test");
    // The chapter's caps lose lights by design.
    if (trial.parameters.values().contains("caps"))
      trial.parameters.set(entry.parameters, "caps", std::string("exact"), "test");
  } while (entry.check && !entry.check(trial.parameters, width, height).empty());
  return trial;
}

std::vector<GridSettings> usual_settings() {
  return {{.refinement = false, .duplicated = false},
          {.tile = 11, .ball_test = true},
          {.tile = 16, .refinement = true},
          {.tile = 7, .slices = 64, .zmin = 0.5, .duplicated = true},
          {.tile = 5, .slices = 1, .refinement = true, .duplicated = true},
          {.tile = 13, .slices = 3, .zmin = 2, .zmax = 20, .refinement = true}};
}

uint64_t Seen::contributing() const {
  return std::accumulate(truth.count.begin(), truth.count.end(), uint64_t{0});
}

uint64_t Seen::lit_pixels() const {
  return std::accumulate(lit.begin(), lit.end(), uint64_t{0});
}

Exactness::Exactness(const Scene& scene, uint32_t width, uint32_t height, const FrameOptions& options)
    : frame_(device(), scene, options, width, height),
      brute_(device(), entry_of("brute_force"), Parameters(entry_of("brute_force").parameters), options),
      ideals_{ideal_with("pixel", options), ideal_with("subgroup", options)} {
  input_.threads = &threads_;
}

Exactness::~Exactness() = default;

Exactness::Slot& Exactness::slot_of(const Trial& trial) {
  const AlgorithmEntry& real = entry_of(trial.algorithm);
  std::unique_ptr<Algorithm> made = real.create(trial.parameters);
  // Passes of its own are compiled for each set of parameters, so those are kept with their programs.
  const bool own_passes = real.info.builds_on_gpu();
  std::string key = own_passes ? trial.text() : trial.algorithm + (made->walks_together() ? " together" : "");
  for (const gpu::Constant& constant : made->shade_constants()) key += fmt::format(" {}", constant.value);
  Slot& slot = slots_[key];
  if (!slot.shaded) {
    slot.inner = std::make_shared<std::unique_ptr<Algorithm>>(std::move(made));
    slot.entry = real;
    slot.entry.create = [inner = slot.inner](const Parameters&) {
      return std::make_unique<Replaceable>(inner);
    };
    slot.shaded = std::make_unique<ShadedAlgorithm>(device(), slot.entry, Parameters(real.parameters),
                                                    frame_.options());
  } else if (!own_passes) {
    *slot.inner = std::move(made);
  }
  return slot;
}

Seen Exactness::expect_trials(const Camera& camera, const std::vector<Light>& lights,
                              const std::vector<Trial>& trials, uint32_t oracle_points) {
  for (const Light& light : lights) EXPECT_EQ(rejection_reason(light), nullptr) << rejection_reason(light);
  // What is kept from frame to frame has to follow any change.
  input_.step = Step::next;
  ++input_.index;
  storage_.fill(lights, camera.position, frame_.options().effects.shapes());
  input_.view = view_data(camera, width(), height(), static_cast<uint32_t>(lights.size()));
  input_.lights = storage_.lights();
  FrameTruth truth(frame_, input_, LightLists::groups);
  Seen seen;
  seen.truth = truth.contributing();
  seen.lit = truth.lit();

  ReferenceProof reference = prove_reference(brute_, truth);
  EXPECT_EQ(reference.mismatched, 0u) << "pixels, brute_force";
  EXPECT_EQ(reference.cut_short, 0u) << "pixels for which brute force did not look at every light";
  seen.image = std::move(reference.picture);
  seen.reference = std::move(reference.counts);
  EXPECT_EQ(compare_images(seen.image, seen.image).not_finite, 0u) << "brute_force";

  for (ShadedAlgorithm& ideal : ideals_) {
    SCOPED_TRACE(ideal.wanted_lists() == LightLists::groups ? "ideal, together" : "ideal");
    expect_frame(prove_frame(ideal, truth), seen, truth);
  }
  for (const Trial& trial : trials) {
    SCOPED_TRACE(trial.text());
    FrameProof proof = prove_frame(*slot_of(trial).shaded, truth);
    expect_frame(proof, seen, truth);
    seen.pictures.push_back(std::move(proof.picture));
    seen.counts.push_back(std::move(proof.counts));
    seen.prepared.push_back(proof.counters.prepare);
  }
  if (oracle_points) expect_oracle(seen, truth, oracle_points);
  return seen;
}

void Exactness::expect_frame(const FrameProof& proof, const Seen& seen, FrameTruth& truth) {
  EXPECT_EQ(proof.counters.lost, 0u);
  EXPECT_EQ(proof.counters.mismatched_pixels, 0u);
  EXPECT_EQ(proof.counters.prepare.overflow_tiles, 0u);
  EXPECT_EQ(proof.counters.prepare.overflow_lights, 0u);
  EXPECT_LE(proof.counters.prepare.in_frustum, input_.lights.count());
  EXPECT_EQ(proof.miscounted, "");
  EXPECT_EQ(proof.unlike, "") << "the same inputs gave other bits";
  // The image of brute force within what rounding makes at each pixel.
  const ImageDifference difference = compare_images(proof.picture, seen.image, 1e-30);
  EXPECT_EQ(difference.not_finite, 0u);
  if (difference.max_relative <= plain_rounding) return;
  PictureProof same;
  for (size_t pixel = 0; pixel < seen.lit.size(); ++pixel)
    truth.judge().against_each_other(proof.picture, seen.image, pixel, seen.lit[pixel] != 0, same);
  EXPECT_EQ(same.wrong, 0u) << same.evidence("pixels");
}

void Exactness::expect_oracle(const Seen& seen, FrameTruth& truth, uint32_t points) {
  std::vector<size_t> lit;
  for (size_t i = 0; i < seen.lit.size(); ++i)
    if (seen.lit[i]) lit.push_back(i);
  ASSERT_FALSE(lit.empty()) << "the camera sees no surface";
  const size_t count = std::min<size_t>(points, lit.size());
  PointProof proof;
  for (size_t n = 0; n < count; ++n)
    prove_point(truth, seen.image, lit[(2 * n + 1) * lit.size() / (2 * count)], proof);
  EXPECT_EQ(proof.wrong, 0u) << "points at which other lights contribute than the oracle has";
  EXPECT_EQ(proof.radiance.wrong, 0u) << proof.radiance.evidence("points");
}

std::vector<Trial> every_algorithm() {
  std::vector<Trial> trials;
  for (const AlgorithmEntry& entry : algorithm_registry())
    if (entry.info.exact && !entry.info.reference_only && !entry.info.needs_contributing_lists)
      trials.push_back({entry.info.name, Parameters(entry.parameters)});
  return trials;
}

Light omni(glm::dvec3 position, float radius, float intensity) {
  Light light;
  light.position = position;
  light.radius = radius;
  light.intensity = glm::vec3(1, 0.8f, 0.6f) * intensity;
  return light;
}

Light spot(glm::dvec3 position, float radius, glm::vec3 direction, float inner_degrees, float outer_degrees) {
  Light light = omni(position, radius);
  light.shape = LightShape::spot;
  light.direction = glm::normalize(direction);
  light.outer_angle = std::min(outer_degrees * degrees, 3.1415925f);
  light.inner_angle = std::min(inner_degrees * degrees, light.outer_angle);
  return light;
}

Light capsule(glm::dvec3 position, float radius, glm::vec3 side, float half_length) {
  Light light = omni(position, radius, radius * radius);
  light.shape = LightShape::capsule;
  light.side = glm::normalize(side);
  light.half_length = half_length;
  return light;
}

Light wedge(const Light& spot, glm::vec3 side, float half_length) {
  Light light = spot;
  light.shape = LightShape::wedge;
  light.side = glm::normalize(side - glm::dot(side, spot.direction) * spot.direction);
  light.half_length = half_length;
  return light;
}

Light box(glm::dvec3 position, glm::vec3 direction, glm::vec3 side, glm::vec3 half_extents) {
  Light light = omni(position, 1, glm::dot(half_extents, half_extents));
  light.direction = glm::normalize(direction);
  light.side = glm::normalize(side - glm::dot(side, light.direction) * light.direction);
  make_box(light, half_extents);
  return light;
}

FrameOptions all_shapes(bool long_lists) {
  return {.effects = {.spots = true, .capsules = true, .wedges = true, .boxes = true, .probes = true},
          .many_lights = long_lists,
          .tests = {.long_walks = long_lists}};
}

std::vector<Light> mixed_shapes(uint32_t count, glm::dvec3 low, glm::dvec3 high, float smallest,
                                float largest, uint32_t seed) {
  std::vector<Light> lights = scattered(count, low, high, smallest, largest, seed, 1);
  Random random(hash_u32(seed, 1));
  auto size = [&](float radius) { return radius * std::pow(100.0f, random.uniform(-1, 0.5f)); };
  for (uint32_t i = 0; i < count; ++i) {
    Light& light = lights[i];
    glm::vec3 side(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1));
    if (glm::length(glm::cross(side, light.direction)) < 0.1f)
      side = glm::vec3(light.direction.y, light.direction.z, -light.direction.x);
    const float length = random.below(8) ? size(light.radius) : 0;
    switch (static_cast<LightShape>(i % 5)) {
      case LightShape::omni:
        light = omni(light.position, light.radius, light.radius * light.radius);
        break;
      case LightShape::spot:
        break;
      case LightShape::capsule:
        light = capsule(light.position, light.radius, side, length);
        break;
      case LightShape::wedge:
        light = wedge(light, side, length);
        break;
      case LightShape::box:
        light = box(light.position, light.direction, side,
                    {size(light.radius), size(light.radius), size(light.radius)});
    }
    light.probe = i % 7 == 3;
    if (light.probe) light.intensity /= light.radius * light.radius;
  }
  return lights;
}

std::vector<Light> scattered(uint32_t count, glm::dvec3 low, glm::dvec3 high, float smallest, float largest,
                             uint32_t seed, uint32_t spot_every) {
  Random random(seed);
  std::vector<Light> lights;
  for (uint32_t i = 0; i < count; ++i) {
    glm::dvec3 at(static_cast<double>(random.uniform()), static_cast<double>(random.uniform()),
                  static_cast<double>(random.uniform()));
    float radius = smallest * std::pow(largest / smallest, random.uniform());
    Light light = omni(low + at * (high - low), radius, radius * radius);
    if (spot_every && i % spot_every == 0) {
      glm::vec3 axis(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1));
      float outer = random.uniform(1, 180);
      light = spot(light.position, radius, glm::length(axis) > 0.1f ? axis : glm::vec3(0, -1, 0),
                   random.uniform(0, outer), outer);
    }
    lights.push_back(light);
  }
  return lights;
}

Camera camera_at(glm::dvec3 position, glm::dvec3 target, uint32_t width, uint32_t height, float near,
                 float far) {
  const float aspect = static_cast<float>(width) / static_cast<float>(height);
  return Camera::look_at(position, target, Projection::perspective(60 * degrees, aspect, near, far));
}

}  // namespace ml::test
