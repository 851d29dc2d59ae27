#include "harness/frame/shaded_algorithm.h"

#include <cstring>

#include "harness/base/error.h"
#include "spirv/composite_comp.h"

namespace ml {
namespace {

// Ids shared by every shading program (shaders/light_eval.glsl, shaders/shade.comp); an algorithm's own begin
// at 16.
std::vector<gpu::Constant> constants_of(const gpu::Device& device, const Effects& effects,
                                        const Algorithm& algorithm, bool sampled) {
  std::vector<gpu::Constant> constants = effects.constants();
  constants.push_back({2, sampled});
  constants.push_back({7, algorithm.walks_together() && device.limits().subgroup_exchange});
  constants.push_back({8, effects.forward && !sampled});
  constants.push_back({9, effects.split_targets && !sampled});
  uint32_t id = 16;
  for (uint32_t value : algorithm.shade_constants()) constants.push_back({id++, value});
  return constants;
}

std::unique_ptr<Algorithm> created(gpu::Device& device, const AlgorithmEntry& entry,
                                   const Parameters& parameters, const Effects& effects) {
  bool wants_fp64 = false;
  for (const auto& [name, value] : parameters.values())
    if (const auto* word = std::get_if<std::string>(&value)) wants_fp64 |= *word == "fp64";
  if (wants_fp64 && !device.limits().fp64)
    throw SystemError(entry.info.name + ": '" + device.info().name + "' has no 64-bit floats");
  auto algorithm = entry.create(parameters);
  algorithm->create_gpu(device, effects.constants());
  return algorithm;
}

}  // namespace

ShadedAlgorithm::ShadedAlgorithm(gpu::Device& device, const AlgorithmEntry& entry,
                                 const Parameters& parameters, const Effects& effects)
    : device_(device),
      entry_(entry),
      algorithm_(created(device, entry, parameters, effects)),
      names_(algorithm_->buffers()),
      blocks_(device, entry.info.name + ": sampled blocks"),
      constants_(constants_of(device, effects, *algorithm_, false)),
      timed_(device, algorithm_->shade_shaders().timed, entry.info.name + ": shade", constants_),
      counting_(device, algorithm_->shade_shaders().counting, entry.info.name + ": shade, counting",
                constants_) {
  for (const std::string& name : names_) buffers_.emplace_back(device, entry.info.name + ": " + name);
  // Every buffer exists from the start, so that programs can bind what a frame left empty.
  for (gpu::UploadBuffer& buffer : buffers_) buffer.map(0);
  blocks_.map(0);
  if (effects.split_targets) composite_.emplace(device, composite_comp, "composite");
  if (!effects.forward) return;
  if (!device.limits().fragment_stores)
    throw SystemError("forward materials: '" + device.info().name +
                      "' does not count in fragment shaders (fragmentStoresAndAtomics); "
                      "effects.forward=off lights them deferred");
  const ShadeShaders shaders = algorithm_->shade_shaders();
  // Forward materials have their albedo at hand: their light goes to the result at once.
  std::vector<gpu::Constant> constants = constants_;
  std::erase_if(constants, [](const gpu::Constant& constant) { return constant.id == 9; });
  forward_timed_ = Level::forward_program(device, shaders.forward, entry.info.name + ": forward", constants);
  forward_counting_ = Level::forward_program(device, shaders.forward_counting,
                                             entry.info.name + ": forward, counting", constants);
}

std::span<std::byte> ShadedAlgorithm::map(uint32_t slot, size_t bytes) {
  return buffers_.at(slot).map(bytes);
}

size_t ShadedAlgorithm::limit() const {
  return device_.limits().storage_buffer_range;
}

uint64_t ShadedAlgorithm::upload_bytes() const {
  uint64_t sum = 0;
  for (const gpu::UploadBuffer& buffer : buffers_) sum += buffer.capacity();
  gpu::Bindings own;
  algorithm_->gpu_bindings(own);
  for (const gpu::Binding& binding : own) sum += binding.buffer->bytes();
  return sum;
}

void ShadedAlgorithm::prepare(const FrameInput& input, Spans& spans) {
  algorithm_->prepare(input, *this, spans);
}

gpu::Bindings ShadedAlgorithm::bindings(const DeviceFrame& frame) const {
  gpu::Bindings list = frame.bindings();
  for (size_t slot = 0; slot < names_.size(); ++slot) list.emplace_back(names_[slot], buffers_[slot]);
  list.emplace_back("Blocks", blocks_);
  return list;
}

gpu::Bindings ShadedAlgorithm::cull(gpu::Commands& commands, const DeviceFrame& frame,
                                    const FrameInput& input) {
  gpu::Bindings list = bindings(frame);
  algorithm_->cull(commands, input, list);
  algorithm_->gpu_bindings(list);
  return list;
}

void ShadedAlgorithm::record(gpu::Commands& commands, DeviceFrame& frame, const FrameInput& input,
                             const gpu::ComputeProgram& program, const gpu::RasterProgram* forward) {
  bool twins = false;
  for (const gpu::UploadBuffer& buffer : buffers_) twins |= buffer.has_twin();
  if (twins) {
    auto span = commands.span("transfer");
    for (const gpu::UploadBuffer& buffer : buffers_) commands.transfer(buffer);
  }
  const gpu::Bindings list = cull(commands, frame, input);
  const uint32_t across = (input.view.resolution.x + 7) / 8, down = (input.view.resolution.y + 7) / 8;
  const FrameTargets& targets = frame.targets();
  {
    gpu::Bindings into = list;
    if (targets.diffuse) {
      std::erase_if(into, [](const gpu::Binding& b) { return b.name == "Result"; });
      into.emplace_back("Result", *targets.diffuse);
    }
    auto span = commands.span("shade");
    commands.dispatch(program, into, std::span<const std::byte>{}, across, down);
  }
  if (composite_) {
    auto span = commands.span("composite");
    gpu::Bindings both = frame.bindings();
    both.emplace_back("Diffuse", *targets.diffuse);
    commands.dispatch(*composite_, both, std::span<const std::byte>{}, across, down);
  }
  if (!forward) return;
  auto span = commands.span("forward");
  frame.record_forward(*forward, list);
}

gpu::SubmissionTimes ShadedAlgorithm::shade(DeviceFrame& frame, const FrameInput& input, gpu::Timing timing) {
  gpu::Commands& commands = frame.commands();
  commands.begin(timing);
  record(commands, frame, input, timed_, forward_timed_ ? &*forward_timed_ : nullptr);
  return commands.submit();
}

void ShadedAlgorithm::count(DeviceFrame& frame, const FrameInput& input) {
  frame.counters();  // makes them part of the frame's bindings
  gpu::Commands& commands = frame.commands();
  commands.begin(gpu::Timing::none);
  record(commands, frame, input, counting_, forward_counting_ ? &*forward_counting_ : nullptr);
  commands.submit();
  algorithm_->read_counters(commands);
}

void ShadedAlgorithm::count_blocks(DeviceFrame& frame, const FrameInput& input,
                                   std::span<const glm::uvec2> blocks) {
  frame.counters();
  if (!sampled_)
    sampled_ = std::make_unique<gpu::ComputeProgram>(
        device_, algorithm_->shade_shaders().counting, entry_.info.name + ": shade, sampled",
        constants_of(device_, frame.effects(), *algorithm_, true));
  std::span<std::byte> memory = blocks_.map(blocks.size_bytes());
  if (!blocks.empty()) std::memcpy(memory.data(), blocks.data(), blocks.size_bytes());
  gpu::Commands& commands = frame.commands();
  commands.begin(gpu::Timing::none);
  for (const gpu::UploadBuffer& buffer : buffers_) commands.transfer(buffer);
  commands.transfer(blocks_);
  commands.dispatch(*sampled_, cull(commands, frame, input), std::span<const std::byte>{},
                    static_cast<uint32_t>(blocks.size()));
  commands.submit();
}

uint64_t ShadedAlgorithm::upload_digest() const {
  uint64_t hash = 0xcbf29ce484222325u;  // FNV-1a, 64 bits
  for (const gpu::UploadBuffer& buffer : buffers_)
    for (std::byte byte : buffer.host().mapped().first(buffer.used()))
      hash = (hash ^ static_cast<uint8_t>(byte)) * 0x100000001b3u;
  return hash;
}

}  // namespace ml
