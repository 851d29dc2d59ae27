// What every exact algorithm owes in every case: nothing lost, nothing twice, nothing infinite, the same bits
// again, and the oracle's answer.
#pragma once

#include <array>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "harness/base/random.h"
#include "harness/bench/frame_proof.h"
#include "harness/frame/frame_input.h"
#include "harness/frame/shaded_algorithm.h"
#include "harness/output/picture.h"
#include "tests/support/test_device.h"

namespace ml::test {

// Of pictures that are not compared point by point: so far apart, relative to the value or to this part of
// the picture's mean, are two sums of the same lights in another order.
inline constexpr double image_tolerance = 1e-4, image_floor = 1e-4;

// Parameters of the algorithms that have a grid, named as in a configuration.
struct GridSettings {
  int64_t tile = 24, slices = 16;
  double zmin = 5, zmax = 0;
  bool refinement = false;
  bool ball_test = false;  // trees then hold chords
  bool duplicated = false;
};

// An algorithm under test with its parameters.
struct Trial {
  std::string algorithm;
  Parameters parameters;
  std::string text() const;
};

// Every algorithm takes its turn with the grids: clustered with each, and one other with each; pixels walk
// alone and together, in every way, by turns.
std::vector<Trial> trials_of(const std::vector<GridSettings>& grids);

// Any exact algorithm with any parameters that `list` names.
Trial random_trial(Random& random, uint32_t width, uint32_t height);

// Both data layouts with and without refinement, odd tiles, 1 to 64 slices.
std::vector<GridSettings> usual_settings();

// What a check saw, for tests that know more about the case.
struct Seen {
  ContributingLights truth;
  std::vector<uint8_t> lit;
  Picture image;                  // brute force
  PixelCounts reference;          // of brute force
  std::vector<Picture> pictures;  // one for each trial
  std::vector<PixelCounts> counts;
  std::vector<PrepareCounters> prepared;
  uint64_t contributing() const;  // over all pixels
  uint64_t lit_pixels() const;
};

// One scene at one resolution on the device, with the algorithms under test. Programs are compiled once;
// parameters change freely.
class Exactness {
 public:
  Exactness(const Scene& scene, uint32_t width, uint32_t height,
            const FrameOptions& options = {.effects = {.spots = true}, .many_lights = false});
  ~Exactness();

  // Expects all invariants of the frame, for brute_force, ideal and each trial.
  // `oracle_points`: pixels that the double-precision oracle answers, spread over the lit ones; the checks
  // need at least one lit pixel unless it is 0.
  Seen expect_exact(const Camera& camera, const std::vector<Light>& lights,
                    const std::vector<GridSettings>& settings = usual_settings(),
                    uint32_t oracle_points = 12) {
    return expect_trials(camera, lights, trials_of(settings), oracle_points);
  }
  Seen expect_trials(const Camera& camera, const std::vector<Light>& lights, const std::vector<Trial>& trials,
                     uint32_t oracle_points);

  // The frame of the last check.
  const FrameInput& input() const { return input_; }
  DeviceFrame& frame() { return frame_; }
  uint32_t width() const { return frame_.targets().width(); }
  uint32_t height() const { return frame_.targets().height(); }

 private:
  class Replaceable;
  struct Slot {
    AlgorithmEntry entry;
    std::shared_ptr<std::unique_ptr<Algorithm>> inner;
    std::unique_ptr<ShadedAlgorithm> shaded;
  };
  Slot& slot_of(const Trial& trial);
  void expect_frame(const FrameProof& proof, const Seen& seen, FrameTruth& truth);
  void expect_oracle(const Seen& seen, FrameTruth& truth, uint32_t points);

  DeviceFrame frame_;
  ShadedAlgorithm brute_;
  std::array<ShadedAlgorithm, 2> ideals_;  // of each walk
  std::map<std::string, Slot> slots_;      // by algorithm and what is compiled into its programs
  FrameLightStorage storage_;
  Threads threads_;
  FrameInput input_;
};

// Every exact algorithm once, with its defaults; but for the references.
std::vector<Trial> every_algorithm();

// Lights for hand-written lists.
Light omni(glm::dvec3 position, float radius, float intensity = 1);
// Angles in degrees, half-angles of the cone.
Light spot(glm::dvec3 position, float radius, glm::vec3 direction, float inner_degrees, float outer_degrees);
Light capsule(glm::dvec3 position, float radius, glm::vec3 side, float half_length);
// `side` is made to stand across the direction.
Light wedge(const Light& spot, glm::vec3 side, float half_length);
Light box(glm::dvec3 position, glm::vec3 direction, glm::vec3 side, glm::vec3 half_extents);

// All shapes are compiled in, and probe lights.
FrameOptions all_shapes(bool long_lists = false);
// `count` lights like those of scattered(), shapes in turn, every seventh a probe light.
std::vector<Light> mixed_shapes(uint32_t count, glm::dvec3 low, glm::dvec3 high, float smallest,
                                float largest, uint32_t seed);
// `count` lights, uniform in the box, radii log-uniform between the two; every `spot_every`-th is a spot (0:
// none).
std::vector<Light> scattered(uint32_t count, glm::dvec3 low, glm::dvec3 high, float smallest, float largest,
                             uint32_t seed, uint32_t spot_every = 3);

constexpr float degrees = 0.017453292519943295f;

// A perspective camera of 60 degrees for a picture of this size.
Camera camera_at(glm::dvec3 position, glm::dvec3 target, uint32_t width, uint32_t height, float near = 0.1f,
                 float far = 200);

}  // namespace ml::test
