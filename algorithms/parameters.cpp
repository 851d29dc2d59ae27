#include "algorithms/parameters.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "harness/base/check.h"
#include "harness/base/error.h"

namespace ml {

namespace {

std::string quoted_list(const std::vector<std::string>& words) {
  std::string list;
  for (const std::string& word : words) list += (list.empty() ? "'" : ", '") + word + "'";
  return list;
}

// What a user must write for this parameter.
std::string expectation(const ParameterInfo& info) {
  switch (info.fallback.index()) {
    case 0:
      return "true or false";
    case 1:
      return fmt::format("an integer from {} to {}", static_cast<int64_t>(info.minimum),
                         static_cast<int64_t>(info.maximum));
    case 2:
      return fmt::format("a number from {} to {}", info.minimum, info.maximum);
    default:
      return "one of " + quoted_list(info.choices);
  }
}

std::string shown(const ParameterValue& value) {
  if (const auto* text = std::get_if<std::string>(&value)) return "'" + *text + "'";
  return std::visit(
      [](const auto& v) -> std::string {
        if constexpr (std::is_same_v<std::decay_t<decltype(v)>, std::string>) {
          return v;
        } else {
          return fmt::format("{}", v);
        }
      },
      value);
}

bool fits(const ParameterInfo& info, const ParameterValue& value) {
  if (value.index() != info.fallback.index()) return false;
  if (const auto* integer = std::get_if<int64_t>(&value)) {
    return *integer >= static_cast<int64_t>(info.minimum) && *integer <= static_cast<int64_t>(info.maximum);
  }
  if (const auto* real = std::get_if<double>(&value)) {
    return std::isfinite(*real) && *real >= info.minimum && *real <= info.maximum;
  }
  if (const auto* word = std::get_if<std::string>(&value)) {
    return std::find(info.choices.begin(), info.choices.end(), *word) != info.choices.end();
  }
  return true;
}

ParameterInfo checked(ParameterInfo info) {
  ML_CHECK(fits(info, info.fallback));
  return info;
}

}  // namespace

ParameterInfo ParameterInfo::integer(std::string name, int64_t fallback, int64_t minimum, int64_t maximum,
                                     std::string help) {
  // The range is kept as double: whole numbers beyond 2^53 would not be.
  ML_CHECK_GE(minimum, -(int64_t{1} << 53));
  ML_CHECK_LE(maximum, int64_t{1} << 53);
  return checked({std::move(name),
                  std::move(help),
                  fallback,
                  static_cast<double>(minimum),
                  static_cast<double>(maximum),
                  {}});
}

ParameterInfo ParameterInfo::real(std::string name, double fallback, double minimum, double maximum,
                                  std::string help) {
  return checked({std::move(name), std::move(help), fallback, minimum, maximum, {}});
}

ParameterInfo ParameterInfo::boolean(std::string name, bool fallback, std::string help) {
  return checked({std::move(name), std::move(help), fallback, 0, 0, {}});
}

ParameterInfo ParameterInfo::choice(std::string name, std::string fallback, std::vector<std::string> choices,
                                    std::string help) {
  return checked({std::move(name), std::move(help), std::move(fallback), 0, 0, std::move(choices)});
}

Parameters::Parameters(const std::vector<ParameterInfo>& infos) {
  for (const ParameterInfo& info : infos) values_.emplace(info.name, info.fallback);
}

void Parameters::set(const std::vector<ParameterInfo>& infos, const std::string& name,
                     const ParameterValue& value, const std::string& where) {
  auto info = std::find_if(infos.begin(), infos.end(),
                           [&](const ParameterInfo& known) { return known.name == name; });
  if (info == infos.end()) {
    std::vector<std::string> known;
    for (const ParameterInfo& each : infos) known.push_back(each.name);
    throw UsageError(where + ": unknown parameter '" + name + "'" +
                     (known.empty() ? ", there are none" : suggestion(name, known)));
  }
  ParameterValue typed = value;
  if (const auto* integer = std::get_if<int64_t>(&value);
      integer && std::holds_alternative<double>(info->fallback)) {
    typed = static_cast<double>(*integer);
  }
  if (!fits(*info, typed)) {
    std::string near;
    if (const auto* word = std::get_if<std::string>(&typed); word && !info->choices.empty()) {
      if (std::string best = nearest_name(*word, info->choices); !best.empty())
        near = ", did you mean '" + best + "'?";
    }
    throw UsageError(where + ": expected " + expectation(*info) + ", found " + shown(value) + near);
  }
  values_[name] = typed;
}

}  // namespace ml
