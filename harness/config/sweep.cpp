#include "harness/config/sweep.h"

#include <algorithm>
#include <array>
#include <string_view>
#include <utility>

#include "harness/base/json_text.h"
#include "harness/config/algorithm_list.h"
#include "harness/config/sections.h"

namespace ml {

namespace {

using nlohmann::json;

// "tile" of "algorithms.tile", "algorithms.0.tile" and "algorithms[0].tile"; "" for every other key.
std::string_view parameter_of(std::string_view key) {
  if (!key.starts_with("algorithms") || key.size() < 12) return {};
  return key.substr(key.rfind('.') + 1);
}

// Setting `outer` sets `inner` too.
bool inside(std::string_view inner, std::string_view outer) {
  if (inner == outer) return true;
  if (std::string_view parameter = parameter_of(outer); !parameter.empty()) {
    bool for_all = outer.size() == std::string_view("algorithms.").size() + parameter.size();
    return for_all && parameter_of(inner) == parameter;
  }
  return inner.starts_with(outer) && (inner[outer.size()] == '.' || inner[outer.size()] == '[');
}

// Keys of which the later one undoes the other.
bool exclude_each_other(std::string_view a, std::string_view b) {
  static constexpr std::array<std::array<std::string_view, 2>, 4> pairs{
      {{"scene.name", "scene.gltf"},
       {"scene.name", "scene.scene"},
       {"scene.name", "scene.root"},
       {"camera.path", "camera.keyframes"}}};
  return std::any_of(pairs.begin(), pairs.end(), [&](const auto& pair) {
    return (pair[0] == a && pair[1] == b) || (pair[0] == b && pair[1] == a);
  });
}

Node list_node(const SweptKey& swept) {
  return {swept.values, swept.source, swept.path};
}

// The key, once it is known that it may be swept.
Key sweepable_key(const SweptKey& swept) {
  Node node = list_node(swept);
  Key key = find_key(swept.key, node);
  if (!key.sweepable) node.fail("this is the same for the whole run and cannot be swept");
  return key;
}

// The values as they are understood, in the order given.
json understood(const Draft& base, const SweptKey& swept, const Key& key) {
  Node node = list_node(swept);
  json values = json::array();
  for (size_t i = 0, count = node.list(1, case_limit); i < count; ++i) {
    Draft draft = base;
    key.read(node.item(i), draft);
    values.push_back(key.write(draft));
  }
  if (!swept.zipped) {
    std::vector<json> sorted(values.begin(), values.end());
    std::sort(sorted.begin(), sorted.end());
    if (std::adjacent_find(sorted.begin(), sorted.end()) != sorted.end()) node.fail("a value is there twice");
  }
  return values;
}

std::string point_text(const std::vector<std::pair<const SweptKey*, size_t>>& point) {
  std::string text;
  for (const auto& [swept, index] : point) {
    std::string value = swept->values[index].dump(-1, ' ', true, json::error_handler_t::replace);
    if (value.size() > 60) value = "value " + std::to_string(index);
    text += (text.empty() ? "" : ", ") + swept->key + "=" + value;
  }
  return text;
}

}  // namespace

void Sweeps::read(const Node& node, bool zipped) {
  node.object();
  std::erase_if(keys_, [&](const SweptKey& swept) { return swept.zipped == zipped; });
  for (const auto& [key, values] : node.json().items()) {
    Node list = node.member(key);
    for (const SweptKey& other : keys_) {
      if (other.key == key) list.fail("'" + key + "' is swept and zipped");
    }
    read_list(key, list, zipped);
  }
}

void Sweeps::read_list(const std::string& key, const Node& node, bool zipped) {
  std::erase_if(keys_, [&](const SweptKey& swept) { return swept.key == key; });
  auto next =
      std::find_if(keys_.begin(), keys_.end(), [&](const SweptKey& swept) { return swept.key > key; });
  keys_.insert(next, {key, zipped, node.json(), node.source(), node.path()});
}

void Sweeps::forget(const std::string& key, const Node& node) {
  // The algorithms may be exchanged under a sweep of their parameters.
  bool keep_parts = key == "algorithms";
  std::erase_if(keys_, [&](const SweptKey& swept) {
    return swept.key == key || (!keep_parts && inside(swept.key, key)) || exclude_each_other(swept.key, key);
  });
  for (const SweptKey& swept : keys_) {
    if (inside(key, swept.key)) {
      node.fail(std::string("the configuration ") + (swept.zipped ? "zips '" : "sweeps '") + swept.key +
                "', which holds this");
    }
  }
}

void Sweeps::expand(const Draft& base, const Source& source,
                    const std::function<void(const Setup& setup, const PointText& point)>& each) const {
  std::vector<const SweptKey*> swept, zipped;
  std::vector<Key> keys;
  size_t points = 1;
  for (size_t i = 0; i < keys_.size(); ++i) {
    Node node = list_node(keys_[i]);
    keys.push_back(sweepable_key(keys_[i]));
    for (size_t j = 0; j < keys_.size(); ++j) {
      const std::string& other = keys_[j].key;
      if (i != j && (inside(keys_[i].key, other) || exclude_each_other(keys_[i].key, other))) {
        node.fail("'" + other + "' is swept too, and sets this");
      }
    }
    size_t count = node.list(1, case_limit);
    if (keys_[i].zipped && !zipped.empty() && zipped[0]->values.size() != count) {
      node.expected("a list of " + std::to_string(zipped[0]->values.size()) + " like that of '" +
                    zipped[0]->key + "'");
    }
    if (!keys_[i].zipped || zipped.empty()) points *= count;
    if (points > case_limit) node.fail("more than 10000 cases");
    (keys_[i].zipped ? zipped : swept).push_back(&keys_[i]);
  }
  for (size_t i = 0; i < keys_.size(); ++i) understood(base, keys_[i], keys[i]);

  size_t cases = 0;
  for (size_t point = 0; point < points; ++point) {
    std::vector<std::pair<const SweptKey*, size_t>> where;
    size_t rest = point;
    if (!zipped.empty()) {
      for (const SweptKey* key : zipped) where.emplace_back(key, rest % zipped[0]->values.size());
      rest /= zipped[0]->values.size();
    }
    for (auto key = swept.rbegin(); key != swept.rend(); ++key) {
      where.emplace_back(*key, rest % (*key)->values.size());
      rest /= (*key)->values.size();
    }
    std::sort(where.begin(), where.end());  // the order of keys_
    Draft draft = base;
    for (const auto& [key, index] : where) {
      keys[static_cast<size_t>(key - keys_.data())].read(list_node(*key).item(index), draft);
    }
    cases += draft.setup.algorithms.size();
    if (cases > case_limit) Node(json(), source).fail("more than 10000 cases");
    draft.setup.scene_label = scene_label(draft.setup.scene);
    each(draft.setup, [&] { return point_text(where); });
  }
}

void Sweeps::write(const Draft& base, json& out) const {
  for (const SweptKey& swept : keys_) {
    out[swept.zipped ? "zip" : "sweep"][swept.key] = understood(base, swept, sweepable_key(swept));
  }
}

}  // namespace ml
