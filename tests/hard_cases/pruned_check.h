// The frame in which fine_pruned is looked at: what it owes, beside brute force and the reference's counts.
#pragma once

#include <map>
#include <memory>
#include <string>

#include "tests/hard_cases/hard_cases.h"

namespace ml::test {

struct PrunedSettings {
  std::string caps = "exact", prune = "fine", walk = "subgroup", bounds = "hull";
  bool tile_depths = true;
  uint32_t region_lights = 1024;
  std::string text() const {
    return caps + " " + prune + " " + walk + " " + bounds + (tile_depths ? " by depth " : " ") +
           std::to_string(region_lights);
  }
};

struct PrunedRun {
  PixelCounts counts;
  FrameCounters frame;
  Picture image;
};

class PrunedCheck {
 public:
  PrunedCheck(const Scene& scene, uint32_t width, uint32_t height,
              const FrameOptions& options = all_shapes());

  // Uploads a frame and finds what contributes.
  void load(const Camera& camera, const std::vector<Light>& lights);
  // The counting lap of the loaded frame; programs are compiled once for each of the settings.
  PrunedRun run(const PrunedSettings& settings);
  // Expects the loaded frame without loss, in any way that claims to have none: same lights, same picture as
  // brute force, the same bits the second time and from the timed program.
  void expect_lossless(const std::vector<PrunedSettings>& settings = lossless());
  static std::vector<PrunedSettings> lossless();

  const ContributingLights& truth() const { return truth_; }
  uint64_t contributing() const;  // over all pixels
  uint32_t tiles() const;
  uint32_t tile_of(size_t pixel) const;
  DeviceFrame& frame() { return frame_; }
  const FrameInput& input() const { return input_; }
  ShadedAlgorithm& algorithm(const PrunedSettings& settings);

 private:
  DeviceFrame frame_;
  ShadedAlgorithm brute_;
  std::map<std::string, std::unique_ptr<ShadedAlgorithm>> algorithms_;
  FrameLightStorage storage_;
  Threads threads_;
  FrameInput input_;
  ContributingLights truth_;
  std::vector<uint8_t> lit_;
  Picture reference_;
};

}  // namespace ml::test
