// The real levels beside the project, where they are.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>

#include "harness/gltf/gltf.h"
#include "harness/scene/scene.h"

namespace ml {
namespace {

struct Level {
  const char* name;
  uint32_t triangles;
  glm::vec3 size;  // m, rounded
};

class GltfLevel : public testing::TestWithParam<Level> {};

TEST_P(GltfLevel, HasItsTrianglesAndSize) {
  const char* shared = std::getenv("MANYLIGHTS_SHARED");
  std::filesystem::path file = std::filesystem::path(shared ? shared : ML_SOURCE_DIR "/../shared") /
                               "scenes" / (std::string(GetParam().name) + ".glb");
  if (!std::filesystem::exists(file)) GTEST_SKIP() << file << " is not here";
  Scene scene = import_gltf(file, -1, 1, glm::dvec3(0));
  EXPECT_EQ(scene.name, GetParam().name);
  EXPECT_EQ(scene.triangle_count(), GetParam().triangles);
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(scene.bounds.size()[c], GetParam().size[c], 1.0f);
  EXPECT_TRUE(scene.lights.empty());
  EXPECT_EQ(scene.paths.at(0).name, "default");

  uint64_t covered = 0;
  for (const Draw& draw : scene.draws) {
    EXPECT_EQ(draw.first_index, covered);
    EXPECT_LT(draw.material, scene.materials.size());
    covered += draw.index_count;
  }
  EXPECT_EQ(covered, scene.indices.size());
  for (uint32_t index : scene.indices) ASSERT_LT(index, scene.vertices.size());
  for (const Vertex& vertex : scene.vertices) {
    ASSERT_NEAR(glm::length(vertex.normal), 1.0f, 1e-4f);
    ASSERT_TRUE(std::isfinite(vertex.uv.x) && std::isfinite(vertex.uv.y));
  }
}

INSTANTIATE_TEST_SUITE_P(All, GltfLevel,
                         testing::Values(Level{"zdm2", 58772, {77, 36, 60}},
                                         Level{"pandora", 60694, {184, 56, 104}},
                                         Level{"oasago2", 41151, {163, 42, 159}},
                                         Level{"islandctf", 14215, {352, 32, 192}}),
                         [](const auto& i) { return i.param.name; });

}  // namespace
}  // namespace ml
