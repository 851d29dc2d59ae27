// A resolved configuration says everything, and means the same as what it was resolved from.
#include <gtest/gtest.h>
#include <rapidcheck.h>

#include "harness/base/json_text.h"
#include "harness/config/config.h"
#include "harness/output/result.h"
#include "random_config.h"

namespace ml {
namespace {

using nlohmann::json;

void expect_same(const Config& a, const Config& b) {
  RC_ASSERT(a.resolved == b.resolved);
  RC_ASSERT(a.name == b.name);
  RC_ASSERT(a.setups.size() == b.setups.size());
  for (size_t i = 0; i < a.setups.size(); ++i) {
    const Setup &x = a.setups[i], &y = b.setups[i];
    RC_ASSERT(x.scene_label == y.scene_label);
    RC_ASSERT(x.scene.gltf == y.scene.gltf);
    RC_ASSERT(x.scene.gltf_scene == y.scene.gltf_scene);
    RC_ASSERT(x.scene.offset == y.scene.offset);
    RC_ASSERT(x.lights.placement.has_value());
    RC_ASSERT(x.lights.placement == y.lights.placement);
    RC_ASSERT(x.lights.count == y.lights.count);
    if (x.lights.placement == Placement::gltf) RC_ASSERT(x.lights.auto_count == y.lights.auto_count);
    RC_ASSERT(x.lights.seed == y.lights.seed);
    RC_ASSERT(x.lights.radius == y.lights.radius);
    RC_ASSERT(x.lights.radius_ratio == y.lights.radius_ratio);
    RC_ASSERT(x.lights.intensity == y.lights.intensity);
    RC_ASSERT(x.lights.spot_fraction == y.lights.spot_fraction);
    RC_ASSERT(x.lights.capsule_fraction == y.lights.capsule_fraction);
    RC_ASSERT(x.lights.wedge_fraction == y.lights.wedge_fraction);
    RC_ASSERT(x.lights.box_fraction == y.lights.box_fraction);
    RC_ASSERT(x.lights.probe_fraction == y.lights.probe_fraction);
    RC_ASSERT(x.camera.keyframes.size() == y.camera.keyframes.size());
    for (size_t k = 0; k < x.camera.keyframes.size(); ++k) {
      RC_ASSERT(x.camera.keyframes[k].time == y.camera.keyframes[k].time);
      RC_ASSERT(x.camera.keyframes[k].position == y.camera.keyframes[k].position);
    }
    RC_ASSERT(x.width == y.width && x.height == y.height);
    RC_ASSERT(x.shading.targets == y.shading.targets);
    RC_ASSERT(x.shading.shadow_maps == y.shading.shadow_maps);
    RC_ASSERT(x.shading.shadow_map_size == y.shading.shadow_map_size);
    RC_ASSERT(x.shading.list_queue == y.shading.list_queue);
    RC_ASSERT(x.shading.light_fetch == y.shading.light_fetch);
    RC_ASSERT(x.shading.test_ahead == y.shading.test_ahead);
    RC_ASSERT(x.effects == y.effects);
    RC_ASSERT(x.algorithms.size() == y.algorithms.size());
    for (size_t k = 0; k < x.algorithms.size(); ++k) {
      RC_ASSERT(x.algorithms[k].name == y.algorithms[k].name);
      RC_ASSERT(x.algorithms[k].parameters.values() == y.algorithms[k].parameters.values());
    }
  }
  std::vector<Case> cases = expand_cases(a), again = expand_cases(b);
  RC_ASSERT(cases.size() == again.size());
  for (size_t i = 0; i < cases.size(); ++i) RC_ASSERT(cases[i].id == again[i].id);
}

TEST(ConfigRoundTrip, ResolvedIsAFixedPointThroughText) {
  EXPECT_TRUE(rc::check([] {
    json document = random_config();
    Config first = parse_config(document, "first.json", "/levels");
    // Elsewhere and under another name: what is resolved does not depend on where it is read.
    Config second = parse_config_text(first.resolved.dump(), "second.json", "/elsewhere");
    expect_same(first, second);
  }));
}

TEST(ConfigRoundTrip, ResolvedHoldsEveryKeyThatWasGiven) {
  EXPECT_TRUE(rc::check([] {
    json document = random_config();
    json resolved = parse_config(document, "first.json", "/levels").resolved;
    for (const char* key : {"name", "scene", "lights", "camera", "resolution", "algorithms", "measure",
                            "outputs", "effects", "shading"}) {
      RC_ASSERT(resolved.contains(key));
    }
    for (const char* section : {"lights", "measure", "outputs"}) {
      if (!document.contains(section)) continue;
      for (const auto& [key, value] : document[section].items()) {
        RC_ASSERT(resolved[section].contains(key));
        // Floats keep the digits that were written, as far as a float has them.
        if (value.is_number_float()) {
          RC_ASSERT(static_cast<float>(resolved[section][key].get<double>()) ==
                    static_cast<float>(value.get<double>()));
        } else {
          RC_ASSERT(resolved[section][key] == value);
        }
      }
    }
  }));
}

TEST(ConfigRoundTrip, ShortNumbersStayShort) {
  json resolved =
      parse_config_text(R"({"lights": {"base_size": 0.6, "radius": 0.1, "spot_fraction": 0.3}})", "x", "")
          .resolved;
  EXPECT_EQ(resolved["lights"]["base_size"].dump(), "0.6");
  EXPECT_EQ(resolved["lights"]["radius"].dump(), "0.1");
  EXPECT_EQ(resolved["lights"]["spot_fraction"].dump(), "0.3");
}

TEST(ConfigRoundTrip, TheSchemaAcceptsWhatIsGivenAndWhatIsResolved) {
  EXPECT_TRUE(rc::check([] {
    json document = random_config();
    Config config = parse_config(document, "first.json", "/levels");
    for (const json& each : {document, config.resolved}) {
      std::vector<std::string> violations = schema_violations(config_schema(), each);
      if (!violations.empty()) RC_FAIL(violations[0] + " in " + each.dump());
    }
  }));
}

}  // namespace
}  // namespace ml
