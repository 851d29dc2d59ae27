#include "harness/gpu/device.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cstdlib>

#include "harness/gpu/vulkan.h"

namespace ml::gpu {
namespace {

constexpr const char* validation_layer = "VK_LAYER_KHRONOS_validation";
constexpr const char* no_device =
    "no Vulkan device found (Debian package mesa-vulkan-drivers brings a software device)";

VKAPI_ATTR VkBool32 VKAPI_CALL on_message(VkDebugUtilsMessageSeverityFlagBitsEXT,
                                          VkDebugUtilsMessageTypeFlagsEXT,
                                          const VkDebugUtilsMessengerCallbackDataEXT* data, void* user) {
  auto* log = static_cast<MessageLog*>(user);
  std::lock_guard lock(log->mutex);
  if (log->writes_apart && data->pMessageIdName &&
      std::string_view(data->pMessageIdName) == "SYNC-HAZARD-WRITE-AFTER-WRITE")
    return VK_FALSE;
  log->messages.emplace_back(data->pMessage ? data->pMessage : "(no text)");
  return VK_FALSE;
}

// With or without VK_EXT_debug_utils, which the validation layer's messages need.
vk::raii::Instance make_instance(vk::raii::Context& context, bool validation, bool debug_utils) {
  vk::ApplicationInfo application("manylights", 1, "manylights", 1, VK_API_VERSION_1_3);
  std::vector<const char*> layers, extensions;
  // Synchronization validation is a feature that has to be asked for.
  std::array enabled{vk::ValidationFeatureEnableEXT::eSynchronizationValidation};
  vk::ValidationFeaturesEXT features(enabled);
  vk::InstanceCreateInfo info({}, &application);
  if (validation) {
    auto available = context.enumerateInstanceLayerProperties();
    bool found = std::any_of(available.begin(), available.end(), [](const vk::LayerProperties& layer) {
      return std::string_view(layer.layerName.data()) == validation_layer;
    });
    if (!found)
      throw SystemError(
          "the Vulkan validation layer is not installed (Debian package vulkan-validationlayers)");
    layers.push_back(validation_layer);
    extensions.push_back(VK_EXT_VALIDATION_FEATURES_EXTENSION_NAME);
    info.pNext = &features;
  }
  if (debug_utils) extensions.push_back(VK_EXT_DEBUG_UTILS_EXTENSION_NAME);
  info.setPEnabledLayerNames(layers).setPEnabledExtensionNames(extensions);
  try {
    return {context, info};
  } catch (const vk::IncompatibleDriverError&) {
    throw SystemError(no_device);  // the loader found no driver at all
  }
}

vk::raii::Context load_vulkan() {
  try {
    return {};
  } catch (const std::exception& error) {
    throw SystemError(std::string("no Vulkan loader on this system (Debian package libvulkan1): ") +
                      error.what());
  }
}

std::string type_name(vk::PhysicalDeviceType type) {
  switch (type) {
    case vk::PhysicalDeviceType::eCpu:
      return "cpu";
    case vk::PhysicalDeviceType::eIntegratedGpu:
      return "integrated";
    case vk::PhysicalDeviceType::eDiscreteGpu:
      return "discrete";
    case vk::PhysicalDeviceType::eVirtualGpu:
      return "virtual";
    default:
      return "other";
  }
}

// The families of the two queues, and their indices in these.
struct QueueChoice {
  uint32_t main = UINT32_MAX;  // UINT32_MAX: there is none that does both graphics and compute
  uint32_t second = UINT32_MAX, second_index = 0;
  SecondQueue kind = SecondQueue::none;
};

QueueChoice choose_queues(const vk::raii::PhysicalDevice& physical) {
  using Flag = vk::QueueFlagBits;
  const std::vector<vk::QueueFamilyProperties> families = physical.getQueueFamilyProperties();
  QueueChoice choice;
  for (uint32_t i = 0; i < families.size() && choice.main == UINT32_MAX; ++i)
    if ((families[i].queueFlags & Flag::eGraphics) && (families[i].queueFlags & Flag::eCompute))
      choice.main = i;
  if (choice.main == UINT32_MAX) return choice;
  // Among families of the kind rather one whose passes can be timed.
  for (uint32_t i = 0; i < families.size(); ++i) {
    const bool fits =
        (families[i].queueFlags & Flag::eCompute) && !(families[i].queueFlags & Flag::eGraphics);
    if (!fits || families[i].queueCount == 0) continue;
    if (choice.kind == SecondQueue::compute_family &&
        (families[choice.second].timestampValidBits || !families[i].timestampValidBits))
      continue;
    choice.second = i;
    choice.kind = SecondQueue::compute_family;
  }
  if (choice.kind != SecondQueue::none) return choice;
  choice.second = choice.main;
  if (families[choice.main].queueCount > 1) {
    choice.second_index = 1;
    choice.kind = SecondQueue::main_family;
  }
  return choice;
}

// What the device lacks, in words; empty when it has all.
std::string missing_features(const vk::raii::PhysicalDevice& physical) {
  vk::PhysicalDeviceProperties properties = physical.getProperties();
  if (properties.apiVersion < VK_API_VERSION_1_3) return "Vulkan 1.3";
  auto chain = physical.getFeatures2<vk::PhysicalDeviceFeatures2, vk::PhysicalDeviceVulkan12Features,
                                     vk::PhysicalDeviceVulkan13Features>();
  const auto& v12 = chain.get<vk::PhysicalDeviceVulkan12Features>();
  const auto& v13 = chain.get<vk::PhysicalDeviceVulkan13Features>();
  if (!v12.scalarBlockLayout) return "scalarBlockLayout";
  if (!v13.synchronization2) return "synchronization2";
  if (!v13.dynamicRendering) return "dynamicRendering";
  const auto subgroups =
      physical.getProperties2<vk::PhysicalDeviceProperties2, vk::PhysicalDeviceSubgroupProperties>()
          .get<vk::PhysicalDeviceSubgroupProperties>();
  const vk::SubgroupFeatureFlags exchange =
      vk::SubgroupFeatureFlagBits::eVote | vk::SubgroupFeatureFlagBits::eBallot |
      vk::SubgroupFeatureFlagBits::eShuffle | vk::SubgroupFeatureFlagBits::eArithmetic;
  if (!(subgroups.supportedStages & vk::ShaderStageFlagBits::eCompute) ||
      (subgroups.supportedOperations & exchange) != exchange)
    return "votes, ballots, shuffles and arithmetic across subgroups in compute shaders";
  if (choose_queues(physical).main == UINT32_MAX) return "a queue for graphics and compute";
  return "";
}

DeviceInfo describe(const vk::raii::PhysicalDevice& physical, uint32_t index) {
  auto chain = physical.getProperties2<vk::PhysicalDeviceProperties2, vk::PhysicalDeviceIDProperties,
                                       vk::PhysicalDeviceDriverProperties>();
  const vk::PhysicalDeviceProperties& properties = chain.get<vk::PhysicalDeviceProperties2>().properties;
  const auto& driver = chain.get<vk::PhysicalDeviceDriverProperties>();
  DeviceInfo info;
  info.index = index;
  info.name = properties.deviceName.data();
  for (uint8_t byte : chain.get<vk::PhysicalDeviceIDProperties>().deviceUUID)
    info.uuid += fmt::format("{:02x}", byte);
  info.type = type_name(properties.deviceType);
  info.driver = fmt::format("{} {}", driver.driverName.data(), driver.driverInfo.data());
  info.api_version =
      fmt::format("{}.{}.{}", VK_API_VERSION_MAJOR(properties.apiVersion),
                  VK_API_VERSION_MINOR(properties.apiVersion), VK_API_VERSION_PATCH(properties.apiVersion));
  info.missing = missing_features(physical);
  info.second_queue = choose_queues(physical).kind;
  return info;
}

std::vector<vk::raii::PhysicalDevice> physical_devices(const vk::raii::Instance& instance) {
  std::vector<vk::raii::PhysicalDevice> devices;
  try {
    for (auto& device : vk::raii::PhysicalDevices(instance)) devices.push_back(std::move(device));
  } catch (const vk::SystemError&) {
    devices.clear();  // the loader answers an empty list of drivers with an error
  }
  if (devices.empty()) throw SystemError(no_device);
  return devices;
}

std::string lower(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(), [](unsigned char c) { return std::tolower(c); });
  return text;
}

std::string known_devices(const std::vector<DeviceInfo>& infos) {
  std::string list;
  for (const DeviceInfo& info : infos)
    list += fmt::format("{}{}: {}", list.empty() ? "" : ", ", info.index, info.name);
  return list;
}

// Index of the device that the selector means.
size_t choose(const std::vector<DeviceInfo>& infos, std::string selector) {
  if (selector.empty())
    if (const char* variable = std::getenv("MANYLIGHTS_DEVICE")) selector = variable;
  if (selector.empty()) {
    const std::array<std::string, 5> order{"discrete", "integrated", "virtual", "other", "cpu"};
    for (const std::string& type : order)
      for (size_t i = 0; i < infos.size(); ++i)
        if (infos[i].type == type && infos[i].missing.empty()) return i;
    throw SystemError(fmt::format("no usable Vulkan device: {} lacks {}", infos[0].name, infos[0].missing));
  }
  std::string wanted = lower(selector);
  std::string wanted_uuid = wanted;
  std::erase(wanted_uuid, '-');
  std::vector<size_t> matches;
  for (size_t i = 0; i < infos.size(); ++i) {
    if (wanted == std::to_string(infos[i].index) || wanted_uuid == infos[i].uuid) {
      matches = {i};
      break;
    }
    if (lower(infos[i].name).find(wanted) != std::string::npos) matches.push_back(i);
  }
  if (matches.empty())
    throw SystemError(
        fmt::format("no Vulkan device matches '{}'; there are {}", selector, known_devices(infos)));
  if (matches.size() > 1)
    throw SystemError(fmt::format("'{}' matches {} Vulkan devices; choose by index or UUID among {}",
                                  selector, matches.size(), known_devices(infos)));
  if (const DeviceInfo& info = infos[matches[0]]; !info.missing.empty())
    throw SystemError(fmt::format("the device '{}' lacks {}", info.name, info.missing));
  return matches[0];
}

// What drivers do that no query tells.
void apply_quirks(const vk::raii::PhysicalDevice& physical, DeviceLimits& limits) {
  const vk::DriverId driver =
      physical.getProperties2<vk::PhysicalDeviceProperties2, vk::PhysicalDeviceDriverProperties>()
          .get<vk::PhysicalDeviceDriverProperties>()
          .driverID;
  // Mesa's gallivm (LP_MAX_TGSI_LOOP_ITERATIONS).
  if (driver == vk::DriverId::eMesaLlvmpipe) limits.loop_iterations = 65535;
}

// By a tool that listens: a debugger or profiler.
bool names_are_read(const vk::raii::PhysicalDevice& physical) {
  const std::vector<vk::PhysicalDeviceToolProperties> tools = physical.getToolProperties();
  return std::any_of(tools.begin(), tools.end(), [](const vk::PhysicalDeviceToolProperties& tool) {
    return static_cast<bool>(tool.purposes & vk::ToolPurposeFlagBits::eDebugMarkersEXT);
  });
}

DeviceLimits read_limits(const vk::raii::PhysicalDevice& physical, const QueueChoice& queues) {
  auto chain = physical.getProperties2<vk::PhysicalDeviceProperties2, vk::PhysicalDeviceSubgroupProperties,
                                       vk::PhysicalDeviceVulkan13Properties>();
  const vk::PhysicalDeviceLimits& limits = chain.get<vk::PhysicalDeviceProperties2>().properties.limits;
  DeviceLimits result;
  result.storage_buffer_range = limits.maxStorageBufferRange;
  result.texel_buffer_bytes = uint64_t{limits.maxTexelBufferElements} * quad_bytes;
  result.image_size =
      std::min(limits.maxImageDimension2D, std::min(limits.maxFramebufferWidth, limits.maxFramebufferHeight));
  result.group_count = {limits.maxComputeWorkGroupCount[0], limits.maxComputeWorkGroupCount[1],
                        limits.maxComputeWorkGroupCount[2]};
  const auto& subgroups = chain.get<vk::PhysicalDeviceSubgroupProperties>();
  result.subgroup_size = subgroups.subgroupSize;
  const auto& sizes = chain.get<vk::PhysicalDeviceVulkan13Properties>();
  result.one_subgroup_size =
      sizes.minSubgroupSize == sizes.maxSubgroupSize && sizes.minSubgroupSize == subgroups.subgroupSize;
  result.push_constant_bytes = limits.maxPushConstantsSize;
  result.subpixel_bits = limits.subPixelPrecisionBits;
  const std::vector<vk::QueueFamilyProperties> families = physical.getQueueFamilyProperties();
  result.timestamp_valid_bits = families[queues.main].timestampValidBits;
  result.second_timestamp_valid_bits = families[queues.second].timestampValidBits;
  result.timestamp_period_ns = static_cast<double>(limits.timestampPeriod);
  const vk::PhysicalDeviceFeatures features = physical.getFeatures();
  result.fp64 = features.shaderFloat64;
  result.fragment_triangles = features.geometryShader;
  result.fragment_stores = features.fragmentStoresAndAtomics;
  result.small_storage_formats = features.shaderStorageImageExtendedFormats;
  vk::PhysicalDeviceMemoryProperties memory = physical.getMemoryProperties();
  for (uint32_t i = 0; i < memory.memoryHeapCount; ++i)
    if (memory.memoryHeaps[i].flags & vk::MemoryHeapFlagBits::eDeviceLocal)
      result.device_memory = std::max<uint64_t>(result.device_memory, memory.memoryHeaps[i].size);
  apply_quirks(physical, result);
  return result;
}

vk::raii::Device make_device(const vk::raii::PhysicalDevice& physical, const QueueChoice& queues,
                             const DeviceLimits& limits) {
  const std::array<float, 2> priorities{1, 1};
  std::vector<vk::DeviceQueueCreateInfo> wanted;
  wanted.emplace_back(vk::DeviceQueueCreateFlags{}, queues.main,
                      queues.kind == SecondQueue::main_family ? 2 : 1, priorities.data());
  if (queues.kind == SecondQueue::compute_family)
    wanted.emplace_back(vk::DeviceQueueCreateFlags{}, queues.second, 1, priorities.data());
  vk::PhysicalDeviceVulkan13Features v13;
  v13.synchronization2 = v13.dynamicRendering = VK_TRUE;
  v13.maintenance4 =
      VK_TRUE;  // the shader compiler writes workgroup sizes in its form; every 1.3 device has it
  vk::PhysicalDeviceVulkan12Features v12;
  v12.scalarBlockLayout = VK_TRUE;
  v12.pNext = &v13;
  vk::PhysicalDeviceFeatures2 features;
  features.features.shaderFloat64 = limits.fp64;
  features.features.geometryShader = limits.fragment_triangles;
  features.features.fragmentStoresAndAtomics = limits.fragment_stores;
  features.features.shaderStorageImageExtendedFormats = limits.small_storage_formats;
  features.pNext = &v12;
  vk::DeviceCreateInfo info({}, wanted);
  info.pNext = &features;
  return {physical, info};
}

}  // namespace

const char* in_words(SecondQueue queue) {
  switch (queue) {
    case SecondQueue::compute_family:
      return "compute family";
    case SecondQueue::main_family:
      return "main family";
    default:
      return "none";
  }
}

std::vector<DeviceInfo> list_devices() {
  vk::raii::Context context = load_vulkan();
  try {
    vk::raii::Instance instance = make_instance(context, false, false);
    std::vector<DeviceInfo> infos;
    for (const auto& physical : physical_devices(instance))
      infos.push_back(describe(physical, static_cast<uint32_t>(infos.size())));
    return infos;
  } catch (const vk::Error& error) {
    throw SystemError(std::string("cannot list the Vulkan devices: ") + error.what());
  }
}

Device::Device(const DeviceOptions& options) : impl_(std::make_unique<Impl>()) {
  Impl& d = *impl_;
  try {
    d.context = load_vulkan();
    bool debug_utils = true;
    try {
      d.instance = make_instance(d.context, options.validation, true);
    } catch (const vk::ExtensionNotPresentError&) {
      if (options.validation) throw;
      d.instance = make_instance(d.context, false, false);
      debug_utils = false;
    }
    if (options.validation) {
      using Severity = vk::DebugUtilsMessageSeverityFlagBitsEXT;
      using Type = vk::DebugUtilsMessageTypeFlagBitsEXT;
      vk::DebugUtilsMessengerCreateInfoEXT info({}, Severity::eWarning | Severity::eError,
                                                Type::eGeneral | Type::eValidation | Type::ePerformance,
                                                on_message, &d.log);
      d.messenger = vk::raii::DebugUtilsMessengerEXT(d.instance, info);
    }
    std::vector<vk::raii::PhysicalDevice> physical = physical_devices(d.instance);
    std::vector<DeviceInfo> infos;
    for (const auto& candidate : physical)
      infos.push_back(describe(candidate, static_cast<uint32_t>(infos.size())));
    size_t chosen = choose(infos, options.selector);
    d.physical = std::move(physical[chosen]);
    d.info = infos[chosen];
    const QueueChoice queues = choose_queues(d.physical);
    d.limits = read_limits(d.physical, queues);
    d.memory = d.physical.getMemoryProperties();
    d.device = make_device(d.physical, queues, d.limits);
    d.main = {vk::raii::Queue(d.device, queues.main, 0), queues.main};
    d.second = {vk::raii::Queue(d.device, queues.second, queues.second_index), queues.second};
    d.validation = options.validation;
    d.names = options.validation || (debug_utils && names_are_read(d.physical));
    d.poison = options.poison;
  } catch (const vk::Error& error) {
    throw SystemError(std::string("cannot open a Vulkan device: ") + error.what());
  }
}

Device::~Device() = default;

const DeviceInfo& Device::info() const {
  return impl_->info;
}
const DeviceLimits& Device::limits() const {
  return impl_->limits;
}
bool Device::validation_enabled() const {
  return impl_->validation;
}
std::vector<std::string> Device::validation_messages() const {
  std::lock_guard lock(impl_->log.mutex);
  return impl_->log.messages;
}

}  // namespace ml::gpu
