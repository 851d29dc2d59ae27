#include "harness/gpu/program.h"

#include <fmt/format.h>
#include <spirv_cross_c.h>

#include <algorithm>

#include "harness/gpu/debug_names.h"

namespace ml::gpu {
namespace {

// A parsed SPIR-V module; owns what SPIRV-Cross allocates.
class Reflection {
 public:
  Reflection(std::span<const uint32_t> spirv, const std::string& program) {
    if (spvc_context_create(&context_) != SPVC_SUCCESS) throw std::logic_error("SPIRV-Cross has no memory");
    spvc_parsed_ir ir = nullptr;
    if (spvc_context_parse_spirv(context_, spirv.data(), spirv.size(), &ir) != SPVC_SUCCESS ||
        spvc_context_create_compiler(context_, SPVC_BACKEND_NONE, ir, SPVC_CAPTURE_MODE_TAKE_OWNERSHIP,
                                     &compiler_) != SPVC_SUCCESS ||
        spvc_compiler_create_shader_resources(compiler_, &resources_) != SPVC_SUCCESS)
      throw std::logic_error("SPIRV-Cross cannot read " + program);
  }
  ~Reflection() { spvc_context_destroy(context_); }
  Reflection(const Reflection&) = delete;
  Reflection& operator=(const Reflection&) = delete;

  std::span<const spvc_reflected_resource> list(spvc_resource_type type) const {
    const spvc_reflected_resource* first = nullptr;
    size_t count = 0;
    spvc_resources_get_resource_list_for_type(resources_, type, &first, &count);
    return {first, count};
  }
  uint32_t binding(spvc_variable_id id) const {
    return spvc_compiler_get_decoration(compiler_, id, SpvDecorationBinding);
  }
  // The variable's name; for a block without an instance name, the block's.
  std::string name(const spvc_reflected_resource& resource) const {
    const char* variable = spvc_compiler_get_name(compiler_, resource.id);
    return variable && *variable ? variable : resource.name;
  }
  bool is_texel_buffer(const spvc_reflected_resource& resource) const {
    const spvc_type type = spvc_compiler_get_type_handle(compiler_, resource.base_type_id);
    const spvc_basetype base = spvc_type_get_basetype(type);
    return (base == SPVC_BASETYPE_SAMPLED_IMAGE || base == SPVC_BASETYPE_IMAGE) &&
           spvc_type_get_image_dimension(type) == SpvDimBuffer;
  }
  ConstantIds constant_ids() const {
    const spvc_specialization_constant* constants = nullptr;
    size_t count = 0;
    if (spvc_compiler_get_specialization_constants(compiler_, &constants, &count) != SPVC_SUCCESS)
      throw std::logic_error("SPIRV-Cross cannot list specialization constants");
    ConstantIds ids;
    for (const spvc_specialization_constant& constant : std::span(constants, count))
      ids[spvc_compiler_get_name(compiler_, constant.id)] = constant.constant_id;
    return ids;
  }
  uint32_t bytes(const spvc_reflected_resource& resource) const {
    size_t size = 0;
    spvc_compiler_get_declared_struct_size(
        compiler_, spvc_compiler_get_type_handle(compiler_, resource.base_type_id), &size);
    return static_cast<uint32_t>(size);
  }

 private:
  spvc_context context_ = nullptr;
  spvc_compiler compiler_ = nullptr;
  spvc_resources resources_ = nullptr;
};

vk::raii::ShaderModule make_module(const Device::Impl& device, std::span<const uint32_t> spirv,
                                   const SpecializationValues& values, const std::string& program) {
  const std::vector<uint32_t> module = specialized(spirv, values, program);
  return {device.device, vk::ShaderModuleCreateInfo({}, module.size() * sizeof(uint32_t), module.data())};
}

// Makes `Impl` by `make`, once for each key and device; a driver's refusal becomes an error with the
// program's name.
template <typename Impl, typename Make>
std::shared_ptr<Impl> once(ProgramCache<Impl>& cache, const ProgramKey& key, const std::string& name,
                           const Make& make) {
  if (std::shared_ptr<Impl> known = cache.find(key)) return known;
  auto made = std::make_shared<Impl>();
  try {
    make(*made);
  } catch (const vk::Error& error) {
    throw SystemError(fmt::format("the device refuses the program {}: {}", name, error.what()));
  }
  cache.add(key, made);
  return made;
}

}  // namespace

ConstantIds Layout::add_module(std::span<const uint32_t> spirv, vk::ShaderStageFlagBits stage,
                               const std::string& program) {
  Reflection reflection(spirv, program);
  const std::pair<spvc_resource_type, vk::DescriptorType> kinds[] = {
      {SPVC_RESOURCE_TYPE_STORAGE_BUFFER, vk::DescriptorType::eStorageBuffer},
      {SPVC_RESOURCE_TYPE_UNIFORM_BUFFER, vk::DescriptorType::eUniformBuffer},
      {SPVC_RESOURCE_TYPE_STORAGE_IMAGE, vk::DescriptorType::eStorageImage},
      {SPVC_RESOURCE_TYPE_SAMPLED_IMAGE, vk::DescriptorType::eCombinedImageSampler},
      {SPVC_RESOURCE_TYPE_SEPARATE_IMAGE, vk::DescriptorType::eUniformTexelBuffer},
  };
  for (const auto& [kind, type] : kinds)
    for (const spvc_reflected_resource& resource : reflection.list(kind)) {
      BindingSlot& slot = slots[reflection.name(resource)];
      slot.binding = reflection.binding(resource.id);
      slot.type = type;
      slot.resource = reflection.name(resource);
      if (reflection.is_texel_buffer(resource)) {
        constexpr std::string_view quads = "Quads";
        if (!slot.resource.ends_with(quads))
          throw std::logic_error(program + ": no texel buffer is called " + slot.resource);
        slot.type = vk::DescriptorType::eUniformTexelBuffer;
        slot.resource.resize(slot.resource.size() - quads.size());
      }
      slot.stages |= stage;
    }
  for (const spvc_reflected_resource& resource : reflection.list(SPVC_RESOURCE_TYPE_PUSH_CONSTANT)) {
    push_bytes = std::max(push_bytes, (reflection.bytes(resource) + 3) / 4 * 4);
    push_stages |= stage;
  }
  return reflection.constant_ids();
}

void Layout::create(Device::Impl& device) {
  std::vector<vk::DescriptorSetLayoutBinding> bindings;
  for (const auto& [name, slot] : slots) bindings.emplace_back(slot.binding, slot.type, 1, slot.stages);
  set_layout = vk::raii::DescriptorSetLayout(device.device, vk::DescriptorSetLayoutCreateInfo({}, bindings));
  vk::PushConstantRange range(push_stages, 0, push_bytes);
  vk::PipelineLayoutCreateInfo info({}, *set_layout);
  if (push_bytes) info.setPushConstantRanges(range);
  pipeline_layout = vk::raii::PipelineLayout(device.device, info);
}

ComputeProgram::ComputeProgram(Device& owner, std::span<const uint32_t> spirv, const std::string& name,
                               const Constants& constants)
    : name_(name) {
  Device::Impl& device = owner.impl();
  ProgramKey key;
  key.add(spirv);
  key.add(constants);
  impl_ = once(device.compute_programs, key, name, [&](Impl& impl) {
    const ConstantIds ids = impl.layout.add_module(spirv, vk::ShaderStageFlagBits::eCompute, name);
    const auto values = specialization_values({ids}, constants, name);
    impl.layout.create(device);
    vk::raii::ShaderModule module = make_module(device, spirv, values[0], name);
    vk::PipelineShaderStageCreateInfo stage({}, vk::ShaderStageFlagBits::eCompute, *module, "main");
    impl.pipeline = vk::raii::Pipeline(
        device.device, nullptr, vk::ComputePipelineCreateInfo({}, stage, *impl.layout.pipeline_layout));
    set_name(device, impl.pipeline, name);
  });
}

ComputeProgram::~ComputeProgram() = default;
ComputeProgram::ComputeProgram(ComputeProgram&&) noexcept = default;
ComputeProgram& ComputeProgram::operator=(ComputeProgram&&) noexcept = default;

RasterProgram::RasterProgram(Device& owner, std::span<const uint32_t> vertex,
                             std::span<const uint32_t> fragment, const std::string& name,
                             const RasterState& state, const Constants& constants)
    : name_(name) {
  Device::Impl& device = owner.impl();
  ProgramKey key;
  key.add(vertex);
  key.add(fragment);
  key.add(constants);
  key.add(state);
  impl_ = once(device.raster_programs, key, name, [&](Impl& impl) {
    using Stage = vk::ShaderStageFlagBits;
    std::vector ids{impl.layout.add_module(vertex, Stage::eVertex, name)};
    if (!fragment.empty()) ids.push_back(impl.layout.add_module(fragment, Stage::eFragment, name));
    const auto values = specialization_values(ids, constants, name);
    impl.layout.create(device);
    vk::raii::ShaderModule vertex_module = make_module(device, vertex, values[0], name),
                           fragment_module = nullptr;
    std::vector stages{vk::PipelineShaderStageCreateInfo({}, Stage::eVertex, *vertex_module, "main")};
    if (!fragment.empty()) {
      fragment_module = make_module(device, fragment, values[1], name);
      stages.emplace_back(vk::PipelineShaderStageCreateFlags{}, Stage::eFragment, *fragment_module, "main");
    }
    vk::VertexInputBindingDescription vertex_binding(0, state.vertex_stride, vk::VertexInputRate::eVertex);
    std::vector<vk::VertexInputAttributeDescription> attributes;
    for (uint32_t i = 0; i < state.attributes.size(); ++i)
      attributes.emplace_back(
          i, 0,
          state.attributes[i].components == 2 ? vk::Format::eR32G32Sfloat : vk::Format::eR32G32B32Sfloat,
          state.attributes[i].offset);
    vk::PipelineVertexInputStateCreateInfo input({}, vertex_binding, attributes);
    vk::PipelineInputAssemblyStateCreateInfo assembly({}, vk::PrimitiveTopology::eTriangleList);
    vk::PipelineViewportStateCreateInfo viewport({}, 1, nullptr, 1, nullptr);
    // Counter-clockwise in a y-up world is clockwise in Vulkan's y-down pictures; the projection flips y, so
    // the file's order stays.
    vk::PipelineRasterizationStateCreateInfo raster({}, VK_FALSE, VK_FALSE, vk::PolygonMode::eFill,
                                                    vk::CullModeFlagBits::eBack,
                                                    vk::FrontFace::eCounterClockwise, VK_FALSE, 0, 0, 0, 1);
    vk::PipelineMultisampleStateCreateInfo samples({}, vk::SampleCountFlagBits::e1);
    vk::PipelineDepthStencilStateCreateInfo depth(
        {}, VK_TRUE, state.at_equal_depth ? VK_FALSE : VK_TRUE,
        state.at_equal_depth ? vk::CompareOp::eEqual : vk::CompareOp::eGreater);
    using Component = vk::ColorComponentFlagBits;
    vk::PipelineColorBlendAttachmentState opaque;
    opaque.colorWriteMask = Component::eR | Component::eG | Component::eB | Component::eA;
    std::vector<vk::PipelineColorBlendAttachmentState> blends(state.colors.size(), opaque);
    vk::PipelineColorBlendStateCreateInfo blend({}, VK_FALSE, vk::LogicOp::eCopy, blends);
    std::array dynamic{vk::DynamicState::eViewport, vk::DynamicState::eScissor, vk::DynamicState::eCullMode,
                       vk::DynamicState::eFrontFace};
    vk::PipelineDynamicStateCreateInfo dynamic_state({}, dynamic);
    std::vector<vk::Format> colors;
    for (Format format : state.colors) colors.push_back(vulkan_format(format));
    vk::PipelineRenderingCreateInfo rendering(0, colors, vulkan_format(state.depth));
    vk::GraphicsPipelineCreateInfo info({}, stages, &input, &assembly, nullptr, &viewport, &raster, &samples,
                                        &depth, &blend, &dynamic_state, *impl.layout.pipeline_layout);
    info.pNext = &rendering;
    impl.pipeline = vk::raii::Pipeline(device.device, nullptr, info);
    set_name(device, impl.pipeline, name);
  });
}

RasterProgram::~RasterProgram() = default;
RasterProgram::RasterProgram(RasterProgram&&) noexcept = default;
RasterProgram& RasterProgram::operator=(RasterProgram&&) noexcept = default;

}  // namespace ml::gpu
