#include "harness/gpu/specialization.h"

#include <fmt/format.h>

#include <set>
#include <spirv-tools/optimizer.hpp>
#include <stdexcept>
#include <unordered_map>

namespace ml::gpu {

std::vector<SpecializationValues> specialization_values(const std::vector<ConstantIds>& modules,
                                                        const Constants& constants,
                                                        const std::string& program) {
  std::map<std::string, const Constant*> given;
  for (const Constant& constant : constants) given[constant.name] = &constant;
  std::set<std::string> missed;
  for (const auto& [name, constant] : given)
    if (!constant->offered) missed.insert(name);
  std::vector<SpecializationValues> all;
  for (const ConstantIds& ids : modules) {
    SpecializationValues& values = all.emplace_back();
    std::set<uint32_t> taken;
    for (const auto& [name, id] : ids) {
      if (!taken.insert(id).second)
        throw std::logic_error(fmt::format("{}: two of its constants have constant_id {}", program, id));
      missed.erase(name);
      if (auto found = given.find(name); found != given.end())
        values[id] = found->second->value;
      else if (id >= first_own_constant)
        throw std::logic_error(fmt::format("{}: its constant {} is given no value", program, name));
    }
  }
  if (!missed.empty())
    throw std::logic_error(fmt::format("{}: it has no constant {}", program, *missed.begin()));
  return all;
}

std::vector<uint32_t> specialized(std::span<const uint32_t> spirv, const SpecializationValues& values,
                                  const std::string& program) {
  std::unordered_map<uint32_t, std::vector<uint32_t>> words;
  for (const auto& [id, value] : values) words[id] = {value};
  spvtools::Optimizer optimizer(SPV_ENV_VULKAN_1_3);
  std::string message;
  optimizer.SetMessageConsumer(
      [&](spv_message_level_t level, const char*, const spv_position_t&, const char* text) {
        if (level <= SPV_MSG_ERROR && message.empty()) message = text;
      });
  optimizer.RegisterPass(spvtools::CreateSetSpecConstantDefaultValuePass(words))
      .RegisterPass(spvtools::CreateFreezeSpecConstantValuePass())
      .RegisterPass(spvtools::CreateFoldSpecConstantOpAndCompositePass())
      .RegisterPass(spvtools::CreateDeadBranchElimPass())
      .RegisterPass(spvtools::CreateBlockMergePass())
      .RegisterPass(spvtools::CreateEliminateDeadFunctionsPass());
  spvtools::OptimizerOptions options;
  options.set_run_validator(false);  // modules are validated when they are built
  std::vector<uint32_t> result;
  if (!optimizer.Run(spirv.data(), spirv.size(), &result, options))
    throw std::logic_error(program + ": its module cannot be specialized: " + message);
  return result;
}

}  // namespace ml::gpu
