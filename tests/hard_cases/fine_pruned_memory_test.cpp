// The list buffer of fine_pruned when it is too small, and from frame to frame.
#include <memory>

#include "algorithms/device_algorithm.h"
#include "algorithms/fine_pruned/list_passes.h"
#include "harness/accuracy/image_metrics.h"
#include "tests/hard_cases/pruned_check.h"

namespace ml::test {
namespace {

// fine_pruned that believes its lists to hold nothing, so that its buffer has only the capacity that every
// buffer has: 1024 lights.
class Starved final : public Algorithm {
 public:
  explicit Starved(std::unique_ptr<Algorithm> inner) : inner_(std::move(inner)) {}
  void prepare(const FrameInput& frame, UploadMemory& memory, Spans& spans) override {
    inner_->prepare(frame, memory, spans);
  }
  PrepareCounters counters() const override { return inner_->counters(); }
  std::vector<std::string> buffers() const override { return inner_->buffers(); }
  ShadeShaders shade_shaders() const override { return inner_->shade_shaders(); }
  gpu::Constants shade_constants() const override { return inner_->shade_constants(); }
  bool walks_together() const override { return inner_->walks_together(); }
  std::unique_ptr<DeviceAlgorithm> device_half(const DeviceContext& context) override {
    return std::make_unique<Lists>(*this, context);
  }

 private:
  class Lists final : public DeviceAlgorithm {
   public:
    Lists(const Starved& algorithm, const DeviceContext& context)
        : algorithm_(algorithm), passes_(context.device, context.shared, PruneSettings{}) {}
    void build(gpu::Commands& commands, const FrameInput& frame, FrameResources& resources) override {
      passes_.record(commands, frame.view, resources.bindings(),
                     static_cast<uint32_t>(algorithm_.counters().in_frustum), 0);
      gpu::Bindings made;
      passes_.bindings(made);
      for (const gpu::Binding& binding : made) resources.publish(binding.name, *binding.buffer);
    }

   private:
    const Starved& algorithm_;
    ListPasses passes_;
  };
  std::unique_ptr<Algorithm> inner_;
};

TEST_F(HardCases, FinePruned_TilesWithoutSpaceWalkAllVisibleLights) {
  constexpr uint32_t width = 40, height = 20;
  PrunedCheck check(floor_at({0, 0, 0}, 100), width, height);
  // 300 for every tile, and 80 that are in view and reach nothing.
  std::vector<Light> lights(300, omni({0, 2, 0}, 50));
  for (int i = 0; i < 80; ++i) lights.push_back(omni({0.01 * i, 1, 0}, 0.1f));
  check.load(camera_at({0, 3, 0}, {0, 0, 0}, width, height), lights);
  const AlgorithmEntry& real = find_algorithm("fine_pruned", "test");
  AlgorithmEntry entry = real;
  entry.create = [&](const Parameters& parameters) {
    return std::make_unique<Starved>(real.create(parameters));
  };
  for (const char* walk : {"subgroup", "pixel"}) {
    SCOPED_TRACE(walk);
    Parameters parameters(real.parameters);
    parameters.set(real.parameters, "walk", std::string(walk), "test");
    ShadedAlgorithm starved(device(), entry, parameters, check.frame().options());
    Spans spans;
    starved.prepare(check.input(), spans, check.frame().occupied_blocks().positions());
    ASSERT_EQ(starved.counters().in_frustum, 380u);
    starved.count(check.frame(), check.input());
    const PixelCounts counts = read_counts(check.frame());
    const PixelCounts full = check.run({}).counts;
    EXPECT_EQ(counts.hash, full.hash);
    EXPECT_EQ(counts.contributing, full.contributing);
    // The first tiles get the space, as far as it goes.
    const PixelCounts coarse = check.run({"exact", "coarse", "pixel"}).counts;
    std::vector<uint32_t> demand(check.tiles());
    for (size_t pixel = 0; pixel < width * height; ++pixel)
      demand[check.tile_of(pixel)] = coarse.listed[pixel];
    std::vector<bool> fits(check.tiles());
    uint32_t sum = 0;
    for (uint32_t tile = 0; tile < check.tiles(); ++tile) fits[tile] = (sum += demand[tile]) <= 1024;
    ASSERT_TRUE(fits.front() && !fits.back());
    for (size_t pixel = 0; pixel < width * height; ++pixel)
      ASSERT_EQ(counts.listed[pixel], fits[check.tile_of(pixel)] ? full.listed[pixel] : 380u)
          << "pixel " << pixel;
  }
}

TEST_F(HardCases, FinePruned_FramesAfterAFrameWithMoreLights) {
  constexpr uint32_t width = 80, height = 45;
  PrunedCheck check(yard(), width, height);
  const Camera camera = camera_at({0, 3, 14}, {0, 1, -10}, width, height);
  const std::vector<Light> many = mixed_shapes(3000, {-30, -1, -40}, {30, 12, 14}, 0.2f, 12, 40),
                           few(many.begin(), many.begin() + 5);
  check.load(camera, few);
  check.expect_lossless();
  const PrunedRun before = check.run({});
  check.load(camera, many);
  check.expect_lossless();
  check.load(camera, few);
  const PrunedRun after = check.run({});
  EXPECT_EQ(compare_images(after.image, before.image).differing_bits, 0u);
  EXPECT_EQ(after.counts.listed, before.counts.listed);
  check.load(camera, {});
  const PrunedRun none = check.run({});
  EXPECT_EQ(none.counts.listed, std::vector<uint32_t>(width * height, 0));
  EXPECT_EQ(none.frame.prepare.coarse_lights, 0);
  check.load(camera_at({0, 3, 14}, {0, 1, 40}, width, height), many);
  check.expect_lossless();
}

}  // namespace
}  // namespace ml::test
