#include "harness/frame/shaded_algorithm.h"

#include <algorithm>
#include <cstring>
#include <limits>
#include <tuple>
#include <utility>

#include "harness/base/error.h"
#include "spirv/composite_comp.h"

namespace ml {
namespace {

// Workgroups along one axis on the smallest devices.
constexpr uint32_t max_groups = 65535;

void append(gpu::Constants& constants, const gpu::Constants& more) {
  constants.insert(constants.end(), more.begin(), more.end());
}

// shaders/shade.comp: BlockRange.
struct BlockRange {
  uint32_t first_block, first_light, end_light;
};

std::unique_ptr<Algorithm> created(const gpu::Device& device, const AlgorithmEntry& entry,
                                   const Parameters& parameters) {
  bool wants_fp64 = false;
  for (const auto& [name, value] : parameters.values())
    if (const auto* word = std::get_if<std::string>(&value)) wants_fp64 |= *word == "fp64";
  if (wants_fp64 && !device.limits().fp64)
    throw SystemError(entry.info.name + ": '" + device.info().name + "' has no 64-bit floats");
  return entry.create(parameters);
}

std::unique_ptr<DeviceAlgorithm> device_half(Algorithm& algorithm, gpu::Device& device,
                                             const FrameOptions& options) {
  const gpu::Constants shared = options.constants(device);
  return algorithm.device_half({device, shared});
}

}  // namespace

ShadedAlgorithm::ShadedAlgorithm(gpu::Device& device, const AlgorithmEntry& entry,
                                 const Parameters& parameters, const FrameOptions& options)
    : device_(device),
      entry_(entry),
      algorithm_(created(device, entry, parameters)),
      device_half_(ml::device_half(*algorithm_, device, options)),
      own_images_(device_half_->images(), entry.info.counters, entry.info.name),
      names_(algorithm_->buffers()),
      options_(options),
      together_(algorithm_->walks_together()),
      sampled_blocks_(device, entry.info.name + ": sampled blocks"),
      class_blocks_(device, entry.info.name + ": blocks by class") {
  for (const std::string& name : names_) buffers_.emplace_back(device, entry.info.name + ": " + name);
  // Every buffer exists from the start, so that programs can bind what a frame left empty.
  for (gpu::UploadBuffer& buffer : buffers_) buffer.map(0);
  sampled_blocks_.map(0);
  class_blocks_.map(0);
  if (options.shading.split_targets)
    composite_.emplace(device, composite_comp, "composite",
                       gpu::Constants{{"EFFECT_EMISSION", options.effects.emission}});
  if (!options.effects.forward) return;
  if (!device.limits().fragment_stores)
    throw SystemError("forward materials: '" + device.info().name +
                      "' does not count in fragment shaders (fragmentStoresAndAtomics); "
                      "effects.forward=off lights them deferred");
}

const gpu::RasterProgram& ShadedAlgorithm::forward_program(bool counting, bool long_walks) {
  const std::pair key(counting, long_walks);
  if (auto found = forward_programs_.find(key); found != forward_programs_.end()) return found->second;
  const ShadeShaders shaders = algorithm_->shade_shaders();
  // Forward materials have their albedo at hand: their light goes to the result at once. Pixels walk alone.
  gpu::Constants constants = options_.constants(device_);
  append(constants, {{"LONG_LISTS", long_walks}, {"SPLIT_TARGETS", false}});
  append(constants, algorithm_->shade_constants());
  append(constants, algorithm_->class_constants(algorithm_->tile_classes().max));
  return forward_programs_
      .emplace(key,
               Level::forward_program(device_, counting ? shaders.forward_counting : shaders.forward,
                                      entry_.info.name + (counting ? ": forward, counting" : ": forward"),
                                      options_, constants))
      .first->second;
}

const gpu::ComputeProgram& ShadedAlgorithm::program(const Variant& variant) {
  if (auto found = programs_.find(variant); found != programs_.end()) return found->second;
  gpu::Constants constants = options_.constants(device_);
  append(constants, {{"LONG_LISTS", variant.loop.long_walks},
                     {"WALK_TOGETHER", variant.loop.together},
                     {"WALK_RANGES", algorithm_->walks_ranges()},
                     {"EFFECT_FORWARD", options_.effects.forward && !variant.sampled},
                     {"SPLIT_TARGETS", options_.shading.split_targets && !variant.sampled}});
  append(constants, algorithm_->shade_constants());
  append(constants, algorithm_->class_constants(variant.tile_class));
  const ShadeShaders shaders = algorithm_->shade_shaders();
  return programs_
      .emplace(std::piecewise_construct, std::forward_as_tuple(variant),
               std::forward_as_tuple(device_, variant.counting ? shaders.counting : shaders.timed,
                                     entry_.info.name + (variant.counting ? ": shade, counting" : ": shade"),
                                     constants))
      .first->second;
}

ShadingLoop ShadedAlgorithm::loop_of(const DeviceFrame& frame, const FrameInput& input, bool together) const {
  if (options_.tests.long_walks) return {together, true};
  LongestWalk walk = algorithm_->longest_walk(input);
  if (entry_.info.needs_contributing_lists) {
    const std::vector<uint32_t>& counts = together ? frame.contributing().group : frame.contributing().count;
    walk = {counts.empty() ? 0 : std::ranges::max(counts), 0};
  }
  walk.lights = std::min<uint64_t>(walk.lights, range());
  const gpu::DeviceLimits& limits = device_.limits();
  return choose_shading_loop(walk, limits.subgroup_size, together, options_.shading.test_ahead,
                             limits.loop_iterations);
}

uint32_t ShadedAlgorithm::range() const {
  if (!algorithm_->walks_ranges()) return std::numeric_limits<uint32_t>::max();
  return lights_of_range(device_.limits().subgroup_size, device_.limits().loop_iterations);
}

std::span<std::byte> ShadedAlgorithm::map(uint32_t slot, size_t bytes) {
  mapped_.at(slot) = true;
  if (options_.fetches_texels(device_)) require_texels(device_.limits(), buffers_.at(slot).name(), bytes);
  return buffers_.at(slot).map(bytes);
}

bool ShadedAlgorithm::cached(uint32_t slot) const {
  return buffers_.at(slot).host().cached();
}

size_t ShadedAlgorithm::limit() const {
  const gpu::DeviceLimits& limits = device_.limits();
  return options_.fetches_texels(device_) ? std::min(limits.storage_buffer_range, limits.texel_buffer_bytes)
                                          : limits.storage_buffer_range;
}

uint64_t ShadedAlgorithm::upload_bytes() const {
  uint64_t sum = class_blocks_.capacity() + device_half_->bytes() + own_images_.bytes();
  for (const gpu::UploadBuffer& buffer : buffers_) sum += buffer.capacity();
  return sum;
}

FrameInput ShadedAlgorithm::stepped(const FrameInput& input) const {
  FrameInput own = input;
  own.step = step_;
  return own;
}

void ShadedAlgorithm::prepare(const FrameInput& input, Spans& spans, std::span<const glm::u16vec2> blocks) {
  // Algorithms of a run see the same frames, but not each of them equally often.
  if (!last_index_)
    step_ = Step::first;
  else if (input.index == *last_index_)
    step_ = Step::same;
  else
    step_ = input.step == Step::next && input.index == *last_index_ + 1 ? Step::next : Step::first;
  last_index_ = input.index;
  own_images_.follow(step_);
  mapped_.assign(names_.size(), false);
  algorithm_->prepare(stepped(input), *this, spans);
  for (size_t slot = 0; slot < names_.size(); ++slot)
    if (!mapped_[slot])
      throw std::logic_error(entry_.info.name + ": prepare() has not mapped its buffer " + names_[slot]);
  counters_ = algorithm_->counters();
  auto span = spans.span("upload");
  sort_blocks(input, blocks);
}

// Of each block along one axis of so many pixels.
void ShadedAlgorithm::tiles_across(std::vector<TileRange>& tiles, uint32_t pixels, uint32_t tile,
                                   uint32_t count) {
  tiles.resize((pixels + 7) / 8);
  for (uint32_t block = 0; block < tiles.size(); ++block)
    tiles[block] = {block * 8 / tile, std::min((block * 8 + 7) / tile, count - 1)};
}

void ShadedAlgorithm::sort_blocks(const FrameInput& input, std::span<const glm::u16vec2> blocks) {
  const TileClasses classes = algorithm_->tile_classes();
  one_class_ = true;
  only_class_ = classes.max;
  if (classes.of_tile.empty() || blocks.empty()) return;
  const auto [lowest, highest_of_all] = std::ranges::minmax(classes.of_tile);
  only_class_ = highest_of_all;
  if (lowest == highest_of_all) return;
  block_ends_.assign(classes.max + size_t{1}, 0);
  class_of_block_.resize(blocks.size());
  const auto rows = static_cast<uint32_t>(classes.of_tile.size() / classes.columns);
  tiles_across(tiles_of_column_, input.view.resolution.x, classes.tile, classes.columns);
  tiles_across(tiles_of_row_, input.view.resolution.y, classes.tile, rows);
  for (size_t i = 0; i < blocks.size(); ++i) {
    // A block may lie in several tiles: the highest class can do what all need.
    const TileRange across = tiles_of_column_[blocks[i].x], down = tiles_of_row_[blocks[i].y];
    uint8_t highest = 0;
    for (uint32_t row = down.first; row <= down.last; ++row)
      for (uint32_t column = across.first; column <= across.last; ++column)
        highest = std::max(highest, classes.of_tile[row * classes.columns + column]);
    class_of_block_[i] = highest;
    ++block_ends_[highest];
  }
  for (uint32_t c = 0; c <= classes.max; ++c)
    if (block_ends_[c] == blocks.size()) {
      only_class_ = c;
      return;
    }
  one_class_ = false;
  uint32_t begin = 0;
  for (uint32_t& end : block_ends_) begin += std::exchange(end, begin);
  auto* sorted = reinterpret_cast<glm::u16vec2*>(class_blocks_.map(blocks.size_bytes()).data());
  for (size_t i = 0; i < blocks.size(); ++i) sorted[block_ends_[class_of_block_[i]]++] = blocks[i];
}

// What the device half of a frame sees.
class ShadedAlgorithm::Resources final : public FrameResources {
 public:
  Resources(ShadedAlgorithm& algorithm, DeviceFrame& frame, const FrameInput& input, bool counting)
      : algorithm_(algorithm), frame_(frame), input_(input), counting_(counting), list_(frame.bindings()) {
    for (size_t slot = 0; slot < algorithm.names_.size(); ++slot)
      list_.emplace_back(algorithm.names_[slot], algorithm.buffers_[slot]);
    algorithm.own_images_.bind(frame, counting, list_);
  }
  const gpu::Bindings& bindings() const override { return list_; }
  void publish(std::string_view name, const gpu::Buffer& buffer) override {
    list_.emplace_back(names_.emplace_back(name), buffer);
  }
  void shading_loop() override {
    algorithm_.record_loop(frame_.commands(), frame_, input_, counting_, list_);
  }

 private:
  ShadedAlgorithm& algorithm_;
  DeviceFrame& frame_;
  const FrameInput& input_;
  bool counting_;
  gpu::Bindings list_;
  std::deque<std::string> names_;  // that the list refers to
};

void ShadedAlgorithm::shade_blocks(gpu::Commands& commands, const Variant& variant,
                                   const gpu::Bindings& bindings, const FrameInput& input, uint32_t begin,
                                   uint32_t end) {
  const auto lights = static_cast<uint32_t>(input.lights.count());
  uint32_t first_light = 0;
  do {
    const uint32_t end_light = first_light + std::min(range(), lights - first_light);
    // Every pixel is in one block, and every block in one dispatch.
    auto apart = commands.unordered();
    for (uint32_t first = begin; first < end; first += std::min(max_groups, end - first))
      commands.dispatch(program(variant), bindings, BlockRange{first, first_light, end_light},
                        std::min(max_groups, end - first));
    first_light = end_light;
  } while (first_light < lights);
}

void ShadedAlgorithm::record(gpu::Commands& commands, DeviceFrame& frame, const FrameInput& input,
                             bool counting) {
  bool copies = false;
  for (const gpu::UploadBuffer& buffer : buffers_) copies |= buffer.has_device_copy();
  if (copies) {
    auto span = commands.span("transfer");
    for (const gpu::UploadBuffer& buffer : buffers_) commands.transfer(buffer);
    if (!one_class_) commands.transfer(class_blocks_);
  }
  const FrameInput own = stepped(input);
  Resources resources(*this, frame, own, counting);
  const auto build = [&] { device_half_->build(commands, own, resources); };
  const auto other_work = [&] { frame.record_shadow_maps(); };
  if (options_.shading.compute_lists && entry_.info.builds_on_gpu()) {
    commands.fork(build, other_work);
  } else {
    build();
    other_work();
  }
  if (counting) frame.clear_counters();
  device_half_->shade(commands, own, resources, counting ? ShadeVariant::counting : ShadeVariant::timed);
}

void ShadedAlgorithm::record_loop(gpu::Commands& commands, DeviceFrame& frame, const FrameInput& input,
                                  bool counting, const gpu::Bindings& list) {
  const uint32_t across = (input.view.resolution.x + 7) / 8, down = (input.view.resolution.y + 7) / 8;
  const FrameTargets& targets = frame.targets();
  {
    gpu::Bindings into = list;
    if (targets.diffuse) {
      std::erase_if(into, [](const gpu::Binding& b) { return b.name == "Result"; });
      into.emplace_back("Result", *targets.diffuse);
    }
    Variant variant{
        .counting = counting, .loop = loop_of(frame, input, together_), .tile_class = only_class_};
    into.emplace_back("Blocks", one_class_ ? frame.occupied_blocks().list() : class_blocks_);
    auto span = commands.span("shade");
    if (one_class_)
      shade_blocks(commands, variant, into, input, 0,
                   static_cast<uint32_t>(frame.occupied_blocks().positions().size()));
    for (uint32_t c = 0; !one_class_ && c < block_ends_.size(); ++c) {
      variant.tile_class = c;
      shade_blocks(commands, variant, into, input, c == 0 ? 0 : block_ends_[c - 1], block_ends_[c]);
    }
  }
  if (composite_) {
    auto span = commands.span("composite");
    gpu::Bindings both = frame.bindings();
    both.emplace_back("Diffuse", *targets.diffuse);
    commands.dispatch(*composite_, both, std::span<const std::byte>{}, across, down);
  }
  if (!options_.effects.forward) return;
  auto span = commands.span("forward");
  frame.record_forward(forward_program(counting, loop_of(frame, input, false).long_walks), list);
}

gpu::SubmissionTimes ShadedAlgorithm::shade(DeviceFrame& frame, const FrameInput& input, gpu::Timing timing) {
  gpu::Commands& commands = frame.commands();
  commands.begin(timing);
  record(commands, frame, input, false);
  return commands.submit();
}

void ShadedAlgorithm::count(DeviceFrame& frame, const FrameInput& input) {
  frame.counters();  // makes them part of the frame's bindings
  gpu::Commands& commands = frame.commands();
  commands.begin(gpu::Timing::none);
  record(commands, frame, input, true);
  commands.submit();
  own_counters_.clear();
  device_half_->read_counters(commands, counters_, own_counters_);
}

void ShadedAlgorithm::count_blocks(DeviceFrame& frame, const FrameInput& input,
                                   std::span<const glm::u16vec2> blocks) {
  frame.counters();
  std::span<std::byte> memory = sampled_blocks_.map(blocks.size_bytes());
  if (!blocks.empty()) std::memcpy(memory.data(), blocks.data(), blocks.size_bytes());
  gpu::Commands& commands = frame.commands();
  commands.begin(gpu::Timing::none);
  for (const gpu::UploadBuffer& buffer : buffers_) commands.transfer(buffer);
  commands.transfer(sampled_blocks_);
  Resources resources(*this, frame, input, true);
  device_half_->build(commands, input, resources);
  gpu::Bindings list = resources.bindings();
  list.emplace_back("Blocks", sampled_blocks_);
  const Variant variant{.counting = true,
                        .sampled = true,
                        .loop = loop_of(frame, input, together_),
                        .tile_class = algorithm_->tile_classes().max};
  shade_blocks(commands, variant, list, input, 0, static_cast<uint32_t>(blocks.size()));
  commands.submit();
}

uint64_t ShadedAlgorithm::upload_digest() const {
  uint64_t hash = 0xcbf29ce484222325u;  // FNV-1a, 64 bits
  auto add = [&](const gpu::UploadBuffer& buffer) {
    for (std::byte byte : buffer.host().mapped().first(buffer.used()))
      hash = (hash ^ static_cast<uint8_t>(byte)) * 0x100000001b3u;
  };
  for (const gpu::UploadBuffer& buffer : buffers_) add(buffer);
  if (!one_class_) add(class_blocks_);
  return hash;
}

}  // namespace ml
