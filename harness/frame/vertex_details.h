// What some levels know of their vertices beyond Vertex, packed for shaders (shaders/shared/material.h).
#pragma once

#include <cstdint>
#include <vector>

#include "harness/scene/scene.h"

namespace ml {

struct PackedDetails {
  uint32_t layout = 0;          // for MaterialData::details, without its flags
  std::vector<uint32_t> words;  // of all vertices; at least one word, so that a buffer can hold them
};
PackedDetails packed_details(const VertexDetails& details, size_t vertices);

}  // namespace ml
