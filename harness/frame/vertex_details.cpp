#include "harness/frame/vertex_details.h"

#include <array>
#include <bit>
#include <glm/gtc/packing.hpp>
#include <utility>

#include "shaders/shared/material.h"

namespace ml {
namespace {

using Words = std::array<uint32_t, 2>;

Words tangent_words(const glm::vec4& tangent) {
  return {glm::packSnorm2x16({tangent.x, tangent.y}), glm::packSnorm2x16({tangent.z, tangent.w})};
}
Words color_words(const glm::vec4& color) {
  constexpr float largest_half = 65504;
  const glm::vec4 held = glm::min(color, glm::vec4(largest_half));
  return {glm::packHalf2x16({held.x, held.y}), glm::packHalf2x16({held.z, held.w})};
}
Words uv_words(const glm::vec2& uv) {
  return {std::bit_cast<uint32_t>(uv.x), std::bit_cast<uint32_t>(uv.y)};
}

}  // namespace

PackedDetails packed_details(const VertexDetails& details, size_t vertices) {
  PackedDetails packed;
  uint32_t stride = 0;
  auto add = [&](bool there, uint32_t bits) {
    if (!there) return;
    packed.layout |= (stride + 1) << bits;
    stride += 2;
  };
  const std::pair<const std::vector<glm::vec2>*, uint32_t> uvs[] = {
      {&details.metallic_roughness_uv, ML_DETAIL_METALLIC_ROUGHNESS_UV},
      {&details.normal_uv, ML_DETAIL_NORMAL_UV},
      {&details.emission_uv, ML_DETAIL_EMISSION_UV}};
  add(!details.tangents.empty(), ML_DETAIL_TANGENT);
  add(!details.colors.empty(), ML_DETAIL_COLOR);
  for (const auto& [list, bits] : uvs) add(!list->empty(), bits);
  packed.layout |= stride;

  packed.words.reserve(vertices * stride + 1);
  auto put = [&](const Words& words) { packed.words.insert(packed.words.end(), words.begin(), words.end()); };
  for (size_t i = 0; i < vertices; ++i) {
    if (!details.tangents.empty()) put(tangent_words(details.tangents[i]));
    if (!details.colors.empty()) put(color_words(details.colors[i]));
    for (const auto& [list, bits] : uvs)
      if (!list->empty()) put(uv_words((*list)[i]));
  }
  if (packed.words.empty()) packed.words.push_back(0);
  return packed;
}

}  // namespace ml
