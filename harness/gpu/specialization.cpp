#include "harness/gpu/specialization.h"

#include <spirv-tools/optimizer.hpp>
#include <stdexcept>
#include <unordered_map>

namespace ml::gpu {

std::vector<uint32_t> specialized(std::span<const uint32_t> spirv, const std::vector<Constant>& constants,
                                  const std::string& program) {
  std::unordered_map<uint32_t, std::vector<uint32_t>> values;
  for (const Constant& constant : constants) values[constant.id] = {constant.value};
  spvtools::Optimizer optimizer(SPV_ENV_VULKAN_1_3);
  std::string message;
  optimizer.SetMessageConsumer(
      [&](spv_message_level_t level, const char*, const spv_position_t&, const char* text) {
        if (level <= SPV_MSG_ERROR && message.empty()) message = text;
      });
  optimizer.RegisterPass(spvtools::CreateSetSpecConstantDefaultValuePass(values))
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
