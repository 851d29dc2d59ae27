// Cameras of a glTF file: views, lenses, motion and names.
#include <gtest/gtest.h>

#include <cmath>

#include "harness/base/error.h"
#include "harness/base/random.h"
#include "tests/support/gltf_test_file.h"

namespace ml {
namespace {

using glm::dvec3;

TEST(GltfCamera, StillPerspective) {
  GltfTestFile file = triangle_file();
  file.json["cameras"][0]["perspective"] = {{"yfov", 0.75}, {"znear", 0.25}, {"aspectRatio", 2}};
  file.json["nodes"][1] = {{"camera", 0}, {"name", "eye"}, {"translation", {1, 2, 3}}};
  Scene scene = file.load();
  // Under its own name, and as `default`.
  ASSERT_EQ(scene.paths.size(), 2u);
  EXPECT_EQ(scene.paths[0].name, "default");
  EXPECT_EQ(scene.paths[1].name, "eye");
  EXPECT_EQ(scene.near, 0.25f);
  for (const CameraPath& path : scene.paths) {
    EXPECT_EQ(path.vertical_fov, 0.75f);
    EXPECT_FALSE(path.has_projection);
    ASSERT_EQ(path.keys.size(), 1u);
    EXPECT_EQ(path.keys[0].position + scene.origin, dvec3(1, 2, 3));
    EXPECT_EQ(glm::normalize(path.keys[0].target - path.keys[0].position), dvec3(0, 0, -1));
  }
}

TEST(GltfCamera, Orthographic) {
  GltfTestFile file = triangle_file();
  file.json["cameras"][0] = {{"type", "orthographic"},
                             {"orthographic", {{"xmag", 8}, {"ymag", 4}, {"znear", 0}, {"zfar", 90}}}};
  Scene scene = file.load();
  ASSERT_TRUE(scene.paths[0].has_projection);
  const Projection& projection = scene.paths[0].projection;
  EXPECT_EQ(projection.kind, ProjectionKind::orthographic);
  EXPECT_EQ(projection.left, -8.0f);
  EXPECT_EQ(projection.top, 4.0f);
  EXPECT_EQ(projection.far, 90.0f);
  EXPECT_GT(projection.near, 0.0f);
}

TEST(GltfCamera, NamesAreUnique) {
  GltfTestFile file = triangle_file();
  for (int i = 0; i < 3; ++i) {
    file.json["scenes"][0]["nodes"].push_back(file.json["nodes"].size());
    file.json["nodes"].push_back({{"camera", 0}, {"name", i == 2 ? "default" : "twin"}});
  }
  Scene scene = file.load();
  std::vector<std::string> names;
  for (const CameraPath& path : scene.paths) names.push_back(path.name);
  EXPECT_EQ(names, (std::vector<std::string>{"default", "camera-0", "twin", "twin-2", "default-2"}));
}

TEST(GltfCamera, NumbersAfterNamesMakeThemNeitherEqualNorTooLong) {
  GltfTestFile file = triangle_file();
  const std::string longest(100, 'x');
  for (const std::string& name : {std::string("default"), std::string("default-2"), longest, longest}) {
    file.json["scenes"][0]["nodes"].push_back(file.json["nodes"].size());
    file.json["nodes"].push_back({{"camera", 0}, {"name", name}});
  }
  Scene scene = file.load();
  std::vector<std::string> names;
  for (const CameraPath& path : scene.paths) names.push_back(path.name);
  EXPECT_EQ(names, (std::vector<std::string>{"default", "camera-0", "default-2", "default-2-2", longest,
                                             std::string(98, 'x') + "-2"}));
}

// The camera's node moves and turns; `interpolation` with keys at 0, 1 and 2 s.
Scene moving(const std::string& interpolation, const std::vector<float>& translations,
             const std::vector<float>& rotations) {
  GltfTestFile file = triangle_file();
  Json animation = {{"channels", Json::array()}, {"samplers", Json::array()}};
  int input = file.floats({0, 1, 2}, "SCALAR");
  auto add = [&](const char* path, int output) {
    animation["channels"].push_back(
        {{"sampler", animation["samplers"].size()}, {"target", {{"node", 1}, {"path", path}}}});
    animation["samplers"].push_back({{"input", input}, {"output", output}, {"interpolation", interpolation}});
  };
  if (!translations.empty()) add("translation", file.floats(translations, "VEC3"));
  if (!rotations.empty()) add("rotation", file.floats(rotations, "VEC4"));
  file.json["animations"] = Json::array({animation});
  return file.load();
}

// The camera at `time`, of a path that lasts 2 s.
Camera camera_at(const Scene& scene, double time) {
  const CameraPath& path = scene.paths[0];
  const auto frame = static_cast<uint32_t>(std::lround(time / path.duration() * 1000));
  return path.sample(frame, 1001, 160, 90, scene.near, scene.far);
}

dvec3 position_at(const Scene& scene, double time) {
  return dvec3(camera_at(scene, time).position) + scene.origin;
}

TEST(GltfCamera, LinearMotionKeepsToTheLine) {
  Scene scene = moving("LINEAR", {0, 0, 0, 10, 0, 0, 10, 20, 0}, {});
  EXPECT_EQ(position_at(scene, 0), dvec3(0, 0, 0));
  EXPECT_EQ(position_at(scene, 1), dvec3(10, 0, 0));
  EXPECT_EQ(position_at(scene, 1.5), dvec3(10, 10, 0));
  EXPECT_EQ(scene.paths[0].duration(), 2);
}

TEST(GltfCamera, RotationTurnsEvenly) {
  float h = std::sqrt(0.5f);
  Scene scene = moving("LINEAR", {}, {0, 0, 0, 1, 0, h, 0, h, 0, 1, 0, 0});  // 90 degrees about y each second
  for (double time = 0; time <= 2; time += 0.05) {
    const double angle = time * 1.5707963267948966;
    const dvec3 forward(camera_at(scene, time).forward);
    EXPECT_LT(glm::length(forward - dvec3(-std::sin(angle), 0, -std::cos(angle))), 1e-6) << time;
  }
}

TEST(GltfCamera, CubicSplineFollowsItsTangents) {
  // Hermite with tangents 3: halfway between 0 and 1 lies 0.5 + 0.125 * (3 - 3) = 0.5, at a quarter 0.15625 +
  // 3 * (0.140625 - 0.046875).
  std::vector<float> values;
  for (float x : {0.0f, 1.0f, 2.0f}) values.insert(values.end(), {3, 0, 0, x, 0, 0, 3, 0, 0});
  Scene scene = moving("CUBICSPLINE", values, {});
  EXPECT_NEAR(position_at(scene, 0.5).x, 0.5, 1e-6);
  EXPECT_NEAR(position_at(scene, 0.2).x, 0.104 + 3 * (0.128 - 0.032), 1e-6);
}

// Up to the cut the first view, from it on the second: the same bits, nothing between and nothing beyond.
TEST(GltfCamera, StepIsACut) {
  Scene scene = moving("STEP", {0, 0, 0, 5, 0, 0, 9, 0, 0}, {});
  const CameraPath& path = scene.paths[0];
  for (uint32_t frames : {3u, 7u, 121u, 1000u}) {
    uint32_t cuts = 0;
    for (uint32_t frame = 0; frame < frames; ++frame) {
      const float x = path.sample(frame, frames, 16, 9, 0.1f, 10).position.x -
                      path.sample(0, frames, 16, 9, 0.1f, 10).position.x;
      const float expected = frame + 1 == frames ? 9 : 2 * frame < frames - 1 ? 0 : 5;
      EXPECT_EQ(x, expected) << frame << " of " << frames;
      cuts += path.cuts(frame, frames);
    }
    EXPECT_EQ(cuts, 3u) << "the first frame and two jumps, of " << frames;
  }
}

TEST(GltfCamera, SmoothMotionIsNoCut) {
  Scene scene = moving("LINEAR", {0, 0, 0, 10, 0, 0, 10, 20, 0}, {});
  EXPECT_TRUE(scene.paths[0].cuts(0, 10));
  for (uint32_t frame = 1; frame < 10; ++frame) EXPECT_FALSE(scene.paths[0].cuts(frame, 10));
}

TEST(GltfCamera, AMovingParentMovesIt) {
  GltfTestFile file = triangle_file();
  file.json["nodes"].push_back({{"children", {1}}});
  file.json["scenes"][0]["nodes"] = {0, 2};
  int input = file.floats({0, 1}, "SCALAR"), output = file.floats({0, 0, 0, 0, 100, 0}, "VEC3");
  file.json["animations"] = Json::array(
      {{{"channels", Json::array({{{"sampler", 0}, {"target", {{"node", 2}, {"path", "translation"}}}}})},
        {"samplers", Json::array({{{"input", input}, {"output", output}}})}}});
  Scene scene = file.load();
  EXPECT_EQ(position_at(scene, 1), dvec3(0, 105, 0));
}

TEST(GltfCamera, WithoutOneThereIsAnAutomaticPath) {
  GltfTestFile file = triangle_file();
  file.json["nodes"][1].erase("camera");
  Scene scene = file.load();
  ASSERT_EQ(scene.paths.size(), 1u);
  EXPECT_EQ(scene.paths[0].name, "default");
  EXPECT_FALSE(scene.paths[0].keys.empty());
}

// A camera is a rigid transform: whatever its node's rotation, the picture has its roll, and scale changes
// nothing.
TEST(GltfCamera, HasItsRoll) {
  Random random(7);
  auto quaternion_about = [](const dvec3& axis, double degrees) {
    const double half = 0.5 * degrees * 0.017453292519943295;
    return glm::dvec4(std::sin(half) * glm::normalize(axis), std::cos(half));
  };
  std::vector<glm::dvec4> rotations{quaternion_about({1, 0, 0}, -90), quaternion_about({1, 0, 0}, 90),
                                    quaternion_about({0, 0, 1}, 180), quaternion_about({1, 0, 0}, -89.99)};
  for (int i = 0; i < 200; ++i)
    rotations.push_back(glm::normalize(glm::dvec4(random.uniform(-1, 1), random.uniform(-1, 1),
                                                  random.uniform(-1, 1), random.uniform(-1, 1))));
  for (const glm::dvec4& q : rotations) {
    GltfTestFile file = triangle_file();
    const double flip = random.uniform(0, 1) < 0.3 ? -1 : 1;
    file.json["nodes"][1] = {
        {"camera", 0},
        {"rotation", {q.x, q.y, q.z, q.w}},
        {"scale", {flip * random.uniform(0.1f, 9), random.uniform(0.1f, 9), random.uniform(0.1f, 9)}}};
    const Scene scene = file.load();
    const Camera camera = scene.paths[0].sample(0, 1, 16, 9, 0.1f, 10);
    const dvec3 up(2 * (q.x * q.y - q.z * q.w), 1 - 2 * (q.x * q.x + q.z * q.z), 2 * (q.y * q.z + q.x * q.w)),
        back(2 * (q.x * q.z + q.y * q.w), 2 * (q.y * q.z - q.x * q.w), 1 - 2 * (q.x * q.x + q.y * q.y));
    EXPECT_LT(glm::length(dvec3(camera.up) - up), 1e-6);
    EXPECT_LT(glm::length(dvec3(camera.forward) + back), 1e-6);
    EXPECT_LT(glm::length(dvec3(camera.right) - glm::cross(up, back)), 1e-6);
  }
}

TEST(GltfCamera, EachHasItsOwnNearAndFar) {
  GltfTestFile file = triangle_file();
  auto lens = [](double near, double far) {
    return Json{{"type", "perspective"}, {"perspective", {{"yfov", 1.0}, {"znear", near}, {"zfar", far}}}};
  };
  file.json["cameras"] = Json::array({lens(1e-5, 4), lens(200, 900), lens(1e-9, 1e12), lens(2, 1)});
  file.json["nodes"].erase(1);
  for (int i = 0; i < 4; ++i) {
    file.json["scenes"][0]["nodes"].push_back(file.json["nodes"].size());
    file.json["nodes"].push_back(
        {{"camera", i}, {"name", "lens" + std::to_string(i)}, {"translation", {0, 5, 0}}});
  }
  file.json["scenes"][0]["nodes"].erase(1);
  const Scene scene = file.load();
  auto window = [&](const char* name) {
    return scene.path(name).sample(0, 1, 16, 9, scene.near, scene.far).projection;
  };
  EXPECT_EQ(window("lens0").near, 1e-5f);
  EXPECT_EQ(window("lens0").far, 4.0f);
  EXPECT_TRUE(window("lens0").clips_far);
  EXPECT_EQ(window("lens1").near, 200.0f);
  EXPECT_GT(window("lens1").far, 200.0f);
  EXPECT_FALSE(window("lens1").clips_far) << "the level ends long before";
  EXPECT_EQ(window("lens2").near, 1e-6f);
  EXPECT_FALSE(window("lens3").clips_far);
  auto noted = [&](const std::string& part) {
    for (const std::string& note : scene.notes)
      if (note.find(part) != note.npos) return true;
    return false;
  };
  EXPECT_TRUE(noted("camera 'lens2': its znear of 1e-09 m is out of range, 1e-06 m is taken"));
  EXPECT_TRUE(noted("camera 'lens0': what is farther than its zfar of 4 m is not seen"));
  EXPECT_TRUE(noted("camera 'lens3': its zfar of 1 m is not beyond its znear of 2 m"));
}

TEST(GltfCamera, OrthographicDepthEndsWithTheLevel) {
  auto window = [](double far) {
    GltfTestFile file = triangle_file();
    file.json["cameras"][0] = {{"type", "orthographic"},
                               {"orthographic", {{"xmag", 8}, {"ymag", 4}, {"znear", 0}, {"zfar", far}}}};
    const Scene scene = file.load();
    return scene.paths[0].sample(0, 1, 16, 9, scene.near, scene.far).projection;
  };
  const float reach = std::sqrt(25.0f + 32.0f);  // from (0, 5, 0) to (4, 0, 4)
  for (double far : {1e2, 1e3, 1e7, 1e9, 1e15, 3e38}) {
    EXPECT_GE(window(far).far, reach) << far;
    EXPECT_LT(window(far).far, 1.01f * reach) << far;
  }
  EXPECT_EQ(window(6).far, 6.0f) << "the file's own far plane cuts";
}

TEST(GltfCamera, NamesCanBeTyped) {
  GltfTestFile file = triangle_file();
  file.json["nodes"][1]["name"] = "a\tb\n\x7f";
  file.json["scenes"][0]["nodes"].push_back(file.json["nodes"].size());
  std::string letters;
  for (int i = 0; i < 80; ++i) letters += "\u00fc";
  file.json["nodes"].push_back({{"camera", 0}, {"name", letters}});
  const Scene scene = file.load();
  ASSERT_EQ(scene.paths.size(), 3u);
  EXPECT_EQ(scene.paths[1].name, "a_b__");
  EXPECT_EQ(scene.paths[2].name, letters.substr(0, 100));
  EXPECT_NE(scene.notes.back().find("2 cameras have names"), std::string::npos);
}

}  // namespace
}  // namespace ml
