#include "harness/config/algorithm_list.h"

#include <algorithm>
#include <charconv>
#include <utility>

#include "harness/base/error.h"
#include "harness/base/json_text.h"

namespace ml {

namespace {

using nlohmann::json;

std::vector<std::string> parameter_names(const AlgorithmEntry& entry) {
  std::vector<std::string> names;
  for (const ParameterInfo& info : entry.parameters) names.push_back(info.name);
  return names;
}

bool has_parameter(const AlgorithmEntry& entry, const std::string& name) {
  return std::any_of(entry.parameters.begin(), entry.parameters.end(),
                     [&](const auto& info) { return info.name == name; });
}

void set_parameter(AlgorithmSpec& spec, const AlgorithmEntry& entry, const std::string& name,
                   const Node& node) {
  const json& value = node.json();
  ParameterValue typed;
  if (value.is_boolean()) {
    typed = value.get<bool>();
  } else if (value.is_number_unsigned() && value.get<uint64_t>() > static_cast<uint64_t>(INT64_MAX)) {
    typed = value.get<double>();
  } else if (value.is_number_integer()) {
    typed = value.get<int64_t>();
  } else if (value.is_number()) {
    typed = value.get<double>() + 0.0;
  } else if (value.is_string()) {
    typed = node.text(0, 100);
  } else {
    node.expected("a number, a text, true or false");
  }
  spec.parameters.set(entry.parameters, name, typed, node.where());
}

// One element of the list, expanded over its parameters' lists, the last parameter fastest.
void read_entry(const Node& node, std::vector<AlgorithmSpec>& out) {
  if (node.json().is_string()) {
    const AlgorithmEntry& entry = find_algorithm(node.text(1, 100), node.where());
    out.push_back({entry.info.name, Parameters(entry.parameters)});
    return;
  }
  if (!node.json().is_object())
    node.expected("the name of an algorithm, or an object with its name and parameters");
  if (!node.json().contains("name")) node.fail("the key 'name' is missing");
  Node name = node.member("name");
  const AlgorithmEntry& entry = find_algorithm(name.text(1, 100), name.where());
  std::vector<AlgorithmSpec> expanded{{entry.info.name, Parameters(entry.parameters)}};
  for (const auto& [key, value] : node.json().items()) {
    if (key == "name") continue;
    Node parameter = node.member(key);
    if (!has_parameter(entry, key)) {
      std::vector<std::string> known = parameter_names(entry);
      parameter.fail("unknown key" + (known.empty() ? ", '" + entry.info.name + "' has no parameters"
                                                    : suggestion(key, known)));
    }
    if (!value.is_array()) {
      for (AlgorithmSpec& spec : expanded) set_parameter(spec, entry, key, parameter);
      continue;
    }
    size_t values = parameter.list(1, case_limit);
    if (expanded.size() * values + out.size() > case_limit) parameter.fail("more than 10000 cases");
    std::vector<AlgorithmSpec> wider;
    for (const AlgorithmSpec& spec : expanded) {
      for (size_t i = 0; i < values; ++i) {
        wider.push_back(spec);
        set_parameter(wider.back(), entry, key, parameter.item(i));
      }
    }
    expanded = std::move(wider);
  }
  std::move(expanded.begin(), expanded.end(), std::back_inserter(out));
}

// What a selector means: entry indices and the parameter's name.
struct Selection {
  std::string head, parameter;  // head: "", an index or a name
  std::vector<size_t> entries;
};

Selection select(const std::vector<AlgorithmSpec>& algorithms, const std::string& selector) {
  Selection selection;
  size_t dot = selector.find('.');
  selection.parameter = dot == selector.npos ? selector : selector.substr(dot + 1);
  if (dot != selector.npos) selection.head = selector.substr(0, dot);
  size_t index = algorithms.size();
  const char* end = selection.head.data() + selection.head.size();
  bool is_index = std::from_chars(selection.head.data(), end, index).ptr == end && !selection.head.empty();
  for (size_t i = 0; i < algorithms.size(); ++i) {
    const AlgorithmEntry& entry = find_algorithm(algorithms[i].name, "");
    bool meant = selection.head.empty() || (is_index ? index == i : selection.head == algorithms[i].name);
    if (meant && has_parameter(entry, selection.parameter)) selection.entries.push_back(i);
  }
  return selection;
}

}  // namespace

json parameter_json(const ParameterValue& value) {
  return std::visit([](const auto& typed) { return json(typed); }, value);
}

std::vector<AlgorithmSpec> read_algorithms(const Node& node) {
  std::vector<AlgorithmSpec> algorithms;
  if (node.json().is_string()) {
    if (node.text(1, 100) != "all") node.expected("\"all\" or a list of algorithms");
    for (const AlgorithmEntry& entry : algorithm_registry()) {
      if (!entry.info.reference_only) algorithms.push_back({entry.info.name, Parameters(entry.parameters)});
    }
    return algorithms;
  }
  if (!node.json().is_array()) node.expected("\"all\" or a list of algorithms");
  for (size_t i = 0, count = node.list(1, case_limit); i < count; ++i) read_entry(node.item(i), algorithms);
  if (algorithms.size() > case_limit) node.fail("more than 10000 cases");
  return algorithms;
}

json write_algorithms(const std::vector<AlgorithmSpec>& algorithms) {
  json list = json::array();
  for (const AlgorithmSpec& spec : algorithms) {
    json entry{{"name", spec.name}};
    for (const auto& [name, value] : spec.parameters.values()) entry[name] = parameter_json(value);
    list.push_back(std::move(entry));
  }
  return list;
}

void set_algorithm_parameter(std::vector<AlgorithmSpec>& algorithms, const std::string& selector,
                             const Node& node) {
  Selection selection = select(algorithms, selector);
  if (selection.entries.empty()) {
    std::vector<std::string> known;
    for (const AlgorithmSpec& spec : algorithms) {
      for (const std::string& name : parameter_names(find_algorithm(spec.name, ""))) {
        if (std::find(known.begin(), known.end(), name) == known.end()) known.push_back(name);
      }
    }
    std::string hint = known.empty() ? ", they have no parameters" : suggestion(selection.parameter, known);
    if (std::find(known.begin(), known.end(), selection.parameter) != known.end()) hint = "";
    node.fail("no algorithm of this configuration" +
              (selection.head.empty() ? "" : " at '" + selection.head + "'") + " has the parameter '" +
              selection.parameter + "'" + hint);
  }
  for (size_t i : selection.entries) {
    set_parameter(algorithms[i], find_algorithm(algorithms[i].name, ""), selection.parameter, node);
  }
}

json algorithm_parameter(const std::vector<AlgorithmSpec>& algorithms, const std::string& selector) {
  Selection selection = select(algorithms, selector);
  if (selection.entries.empty()) return nullptr;
  return parameter_json(algorithms[selection.entries[0]].parameters.values().at(selection.parameter));
}

}  // namespace ml
