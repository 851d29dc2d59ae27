// The "algorithms" of a configuration.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "harness/base/json_node.h"
#include "harness/config/config.h"

namespace ml {

// Cases, entries and lists of one configuration are never more than this.
inline constexpr size_t case_limit = 10000;

// "all", or a list of names and objects; a parameter given as a list makes one entry per value.
std::vector<AlgorithmSpec> read_algorithms(const Node& node);
// Every entry with every parameter: what read_algorithms() reads back as the same list.
nlohmann::json write_algorithms(const std::vector<AlgorithmSpec>& algorithms);

// `selector` is a parameter name (every algorithm that has it), or "INDEX.parameter", or "NAME.parameter".
// Throws at the node when no entry is meant.
void set_algorithm_parameter(std::vector<AlgorithmSpec>& algorithms, const std::string& selector,
                             const Node& node);
// The value of the first entry meant; null when there is none.
nlohmann::json algorithm_parameter(const std::vector<AlgorithmSpec>& algorithms, const std::string& selector);

nlohmann::json parameter_json(const ParameterValue& value);

}  // namespace ml
