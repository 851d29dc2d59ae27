// What the shading loop asks of a subgroup when its pixels walk together, in control flow of the same shape.
#version 460
#extension GL_EXT_scalar_block_layout : require
#extension GL_KHR_shader_subgroup_basic : require
#extension GL_KHR_shader_subgroup_vote : require
#extension GL_KHR_shader_subgroup_arithmetic : require
#extension GL_KHR_shader_subgroup_shuffle : require

layout(local_size_x = 8, local_size_y = 8) in;

struct Answer {
  uint size, subgroup, lane;  // gl_SubgroupSize, number of the subgroup in its workgroup, lane
  uint smallest;              // of the values
  uint shuffled;              // value of lane (7 * lane + 3) modulo size
  uint iterations;            // of the loop over distinct values
  uint own_iteration;         // in which the own value was the smallest left
  uint all_even, any_even;
};
layout(scalar, binding = 0) readonly buffer Values { uint values[]; };
layout(scalar, binding = 1) writeonly buffer Answers { Answer answers[]; };

void main() {
  const uint index = gl_WorkGroupID.x * 64u + gl_LocalInvocationIndex, value = values[index];
  Answer answer;
  answer.size = gl_SubgroupSize;
  answer.subgroup = gl_WorkGroupID.x * gl_NumSubgroups + gl_SubgroupID;
  answer.lane = gl_SubgroupInvocationID;
  answer.smallest = subgroupMin(value);
  answer.shuffled = subgroupShuffle(value, (7u * gl_SubgroupInvocationID + 3u) % gl_SubgroupSize);
  answer.all_even = subgroupAll(value % 2u == 0u) ? 1u : 0u;
  answer.any_even = subgroupAny(value % 2u == 0u) ? 1u : 0u;
  const uint none = 0xffffffffu;
  uint left = value;
  answer.iterations = 0u;
  answer.own_iteration = none;
  while (true) {
    const uint smallest = subgroupMin(left);
    if (smallest == none) break;
    if (left == smallest) {
      answer.own_iteration = answer.iterations;
      left = none;
    }
    answer.iterations++;
  }
  answers[index] = answer;
}
