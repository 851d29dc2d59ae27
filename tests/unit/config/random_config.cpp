#include "random_config.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <functional>
#include <string>
#include <vector>

#include "harness/scene/effects.h"

namespace ml {
namespace {

using nlohmann::json;

// The same configurations on every run, unless the environment asks for others.
const int fixed_seed = setenv("RC_PARAMS", "seed=20240611 max_success=300", 0);

int64_t integer(int64_t low, int64_t high) {
  return *rc::gen::inRange<int64_t>(low, high + 1);
}

// Round and odd numbers alike.
double real(double low, double high) {
  double part = static_cast<double>(integer(0, 1000000)) / 1000000;
  double value = low + (high - low) * part;
  return integer(0, 1) ? value : std::min(high, std::max(low, std::round(value)));
}

bool now() {
  return integer(0, 1) == 1;
}

json one_of(const std::vector<json>& values) {
  return values[static_cast<size_t>(integer(0, static_cast<int64_t>(values.size()) - 1))];
}

// Of the effects that can be switched off.
std::vector<json> effect_keys() {
  std::vector<json> keys;
  for (const EffectInfo& info : effect_table)
    if (info.key) keys.emplace_back(info.key);
  return keys;
}

json vector() {
  return {real(-1e9, 1e9), real(-1000, 1000), integer(-5, 5)};
}

json seed() {
  return one_of({0, 1, 7, 4294967295u});
}

json length() {
  return one_of({0, 0.1, 1e-6, 1e6, 12, real(1e-6, 50)});
}

json resolution() {
  return {integer(1, 32768), integer(1, 32768)};
}

json light_value(const std::string& key) {
  if (key == "placement") return one_of({"volume", "triangle", "area", "gltf", "clumps", "stage", "room"});
  if (key == "count") return integer(0, 65536);
  if (key == "sizing") return one_of({"const_overdraw", "fixed_size"});
  if (key == "radius_ratio") return real(1, 1000);
  if (key.ends_with("_fraction")) return real(0, 0.25);  // at most 1 together
  if (key == "intensity") return one_of({1e-9, 1e9, 0.3, real(1e-3, 1e3)});
  if (key == "seed") return seed();
  if (key == "animate") return one_of({"static", "drift", "spawn", "orbit"});
  return length();  // base_size, radius, height
}

const std::vector<std::string> light_keys{
    "placement", "count",         "sizing",           "base_size",      "radius_ratio", "radius",
    "height",    "spot_fraction", "capsule_fraction", "wedge_fraction", "box_fraction", "probe_fraction",
    "intensity", "seed",          "animate"};

json keyframes() {
  json keys = json::array();
  double time = real(-10, 10);
  for (int64_t left = integer(1, 4); left > 0; --left, time += real(0.001, 3) + 0.001) {
    keys.push_back({{"time", time}, {"position", vector()}, {"target", vector()}});
  }
  return keys;
}

json scene() {
  if (now()) return one_of({"canyon", "citadel", "grove", "museum", "arena", "plane"});
  json object =
      now() ? json{{"name", one_of({"canyon", "citadel", "grove", "museum", "arena", "plane"})}}
            : json{{"gltf", one_of({"level.glb", "../a b/Ünï.gltf", "/abs/./x.glb", "no-extension"})}};
  if (object.contains("gltf") && now()) object["scene"] = integer(-1, 5);
  if (now()) object["seed"] = seed();
  if (now()) object["offset"] = vector();
  return object;
}

// Large enough for 256 slices of the largest picture: more froxels than a list can number are refused.
json tile() {
  return integer(91, 1024);
}

json algorithm() {
  json name = one_of({"clustered", "clustered", "ideal", "brute_force"});
  if (now()) return name;
  json object{{"name", name}};
  if (name == "brute_force" && now()) object["precision"] = one_of({"fp32", "fp64"});
  if (name != "clustered") return object;
  if (now()) object["tile"] = tile();
  if (now()) object["slices"] = now() ? json(integer(1, 256)) : json{4, 8, 16};
  if (now()) object["zmin"] = real(0.01, 3);
  if (now()) object["refinement"] = one_of({false, true, json{false, true}});
  if (now()) object["light_data"] = one_of({"indexed", "duplicated"});
  return object;
}

json values(int64_t count, bool distinct, const std::function<json()>& value) {
  json list = json::array();
  while (static_cast<int64_t>(list.size()) < count) {
    json next = value();
    bool there = false;
    for (const json& before : list) there = there || before == next;
    if (!(distinct && there)) list.push_back(next);
  }
  return list;
}

}  // namespace

json random_config() {
  (void)fixed_seed;
  json config = json::object();
  if (now()) config["name"] = one_of({"a", "quick-2", "_x.y"});
  if (now()) config["description"] = one_of({"", "Größe \"x\""});
  if (now()) config["scene"] = scene();
  if (now()) {
    config["lights"] = json::object();
    for (const std::string& key : light_keys) {
      if (now()) config["lights"][key] = light_value(key);
    }
  }
  int64_t frames = 16;
  if (now()) {
    config["camera"] = json::object();
    if (now()) config["camera"]["frames"] = frames = integer(1, 100);
    if (now()) config["camera"][now() ? "path" : "keyframes"] = "default";
    if (config["camera"].contains("keyframes")) config["camera"]["keyframes"] = keyframes();
  }
  if (now()) config["resolution"] = resolution();
  bool clustered = true;
  if (now()) {
    config["algorithms"] = values(integer(1, 4), false, algorithm);
    clustered = config["algorithms"].dump().find("clustered") != std::string::npos;
  }
  if (now()) {
    config["measure"] = {
        {"warmup", integer(0, 1000)}, {"repeats", integer(1, 10000)}, {"threads", integer(1, 256)}};
    if (now()) config["measure"]["seed"] = seed();
    if (now()) config["measure"]["mode"] = one_of({"stages", "whole"});
  }
  if (now()) {
    config["outputs"] = {{"images", {frames - 1}}, {"trace", now()}};
    if (now()) config["outputs"]["heatmaps"] = json::array();
  }
  if (now()) config["effects"] = {{one_of(effect_keys()), one_of({"auto", "off"})}};
  if (now()) {
    config["shading"] = {{"targets", one_of({"one", "split"})}};
    if (now()) config["shading"]["shadow_maps"] = integer(0, 16);
    if (now()) config["shading"]["shadow_map_size"] = integer(16, 8192);
    if (now()) config["shading"]["list_queue"] = one_of({"graphics", "compute"});
    if (now()) config["shading"]["light_fetch"] = one_of({"auto", "storage", "texel"});
    if (now()) config["shading"]["test_ahead"] = now();
  }
  if (now()) {
    json sweep = json::object();
    if (now()) sweep["lights.count"] = values(integer(1, 4), true, [] { return light_value("count"); });
    if (now()) sweep["resolution"] = values(integer(1, 2), true, resolution);
    if (now() && clustered) sweep["algorithms.tile"] = values(integer(1, 3), true, tile);
    if (now()) sweep["lights.intensity"] = {1e-5, 0.7, 3};
    if (now()) sweep["effects"] = {{{"spots", "off"}}, {{"spots", "auto"}}};
    if (now()) sweep["shading.targets"] = {"one", "split"};
    if (now()) sweep["shading.list_queue"] = {"graphics", "compute"};
    config["sweep"] = sweep;
  }
  if (now()) {
    json zip = json::object();
    int64_t length = integer(1, 3);
    if (now()) zip["lights.seed"] = values(length, false, seed);
    if (now()) zip["scene"] = values(length, false, scene);
    if (now()) zip["camera.keyframes"] = values(length, false, keyframes);
    config["zip"] = zip;
  }
  return config;
}

}  // namespace ml
