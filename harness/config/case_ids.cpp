// The names of cases: what tells one from another, in letters that a file name can hold.
#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "harness/config/algorithm_list.h"
#include "harness/config/config.h"
#include "harness/config/keys.h"

namespace ml {

namespace {

using nlohmann::json;

constexpr size_t longest_id = 120;

bool plain(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '.' || c == '_' ||
         c == '-';
}

// `text` with runs of other letters replaced by one '-'.
std::string file_letters(const std::string& text) {
  std::string result;
  for (char c : text) {
    if (plain(c)) {
      result += c;
    } else if (!result.empty() && result.back() != '-') {
      result += '-';
    }
  }
  while (!result.empty() && result.back() == '-') result.pop_back();
  result.erase(0, std::min(result.size(), result.find_first_not_of(".-")));
  return result;
}

// "tile32", "offset1000-0-0", "light_data-duplicated", "refinement", "no-refinement".
std::string setting(const std::string& name, const json& value) {
  if (value.is_boolean()) return value.get<bool>() ? name : "no-" + name;
  if (value.is_string()) return name + "-" + file_letters(value.get<std::string>());
  if (value.is_number_float()) {
    std::string digits = fmt::format("{}", value.get<double>());
    std::erase(digits, '+');  // 1e+06 is 1e06, not 1e-06
    return name + digits;
  }
  std::string text = value.dump(-1, ' ', true);
  return name + (value.is_number() ? text : file_letters(text));
}

// Has every setup what its scene brings anyway?
template <typename Value>
bool all_own(const std::vector<Setup>& setups, Value LightSpec::*member) {
  return std::all_of(setups.begin(), setups.end(), [&](const Setup& setup) {
    LightSpec own = setup.lights;
    own.*member = LightSpec().*member;
    return completed(own, light_defaults(setup.scene)).*member == setup.lights.*member;
  });
}

// Keys that differ between setups and that the id does not show anyway.
std::vector<const Key*> varying_keys(const std::vector<Setup>& setups) {
  std::vector<const Key*> varying;
  if (setups.size() < 2) return varying;
  std::vector<Draft> drafts(2);
  for (const Key& key : config_keys()) {
    static const std::set<std::string> shown{"resolution", "algorithms", "scene.name", "scene.gltf",
                                             "lights.count"};
    if (!key.sweepable || key.section || shown.contains(key.path)) continue;
    if (key.path == "lights.placement" && all_own(setups, &LightSpec::placement)) continue;
    if (key.path == "lights.animate" && all_own(setups, &LightSpec::script)) continue;
    if (key.path == "lights.radius_ratio" && all_own(setups, &LightSpec::radius_ratio)) continue;
    drafts[0].setup = setups[0];
    json first = key.write(drafts[0]);
    for (size_t i = 1; i < setups.size(); ++i) {
      drafts[1].setup = setups[i];
      if (key.write(drafts[1]) == first) continue;
      varying.push_back(&key);
      break;
    }
  }
  return varying;
}

std::string setup_part(const Setup& setup, const std::vector<const Key*>& varying) {
  std::string label = file_letters(setup.scene_label).substr(0, 40);
  std::string lights =
      setup.lights.placement == Placement::gltf ? "gltf" : std::to_string(setup.lights.count);
  std::string part =
      fmt::format("{}-{}-{}x{}", label.empty() ? "scene" : label, lights, setup.width, setup.height);
  Draft draft;
  draft.setup = setup;
  for (const Key* key : varying) {
    json value = key->write(draft);
    // Long lists (camera keys) would say nothing: the suffix tells them apart.
    if (!value.is_null() && value.dump().size() <= 40) part += "-" + setting(key->path, value);
  }
  return part;
}

std::string algorithm_part(const AlgorithmSpec& spec) {
  const AlgorithmEntry& entry = find_algorithm(spec.name, "");
  std::string part = file_letters(spec.name);
  for (const ParameterInfo& info : entry.parameters) {
    const ParameterValue& value = spec.parameters.values().at(info.name);
    if (value != info.fallback) part += "-" + setting(info.name, parameter_json(value));
  }
  return part;
}

}  // namespace

std::vector<Case> expand_cases(const Config& config) {
  std::vector<Case> cases;
  std::set<std::string> taken;
  std::map<std::string, size_t> next_suffix;
  std::vector<const Key*> varying = varying_keys(config.setups);
  for (size_t s = 0; s < config.setups.size(); ++s) {
    const Setup& setup = config.setups[s];
    std::string prefix = setup_part(setup, varying);
    for (size_t a = 0; a < setup.algorithms.size(); ++a) {
      std::string base = (prefix + "-" + algorithm_part(setup.algorithms[a])).substr(0, longest_id);
      std::string id = base;
      for (size_t& suffix = next_suffix.try_emplace(base, 2).first->second; !taken.insert(id).second;
           ++suffix) {
        std::string tail = "-" + std::to_string(suffix);
        id = base.substr(0, longest_id - tail.size()) + tail;
      }
      cases.push_back({id, s, a});
    }
  }
  return cases;
}

}  // namespace ml
