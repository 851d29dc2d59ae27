// Typed parameters of algorithms: from one table come validation, `list`, the documentation and the resolved
// configuration.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <variant>
#include <vector>

namespace ml {

using ParameterValue = std::variant<bool, int64_t, double, std::string>;

struct ParameterInfo {
  std::string name;
  std::string help;  // one line: what it does, unit, paper section
  ParameterValue fallback;
  // Integers and reals: the closed range. Choices: the allowed words (the value is a string).
  double minimum = 0, maximum = 0;
  std::vector<std::string> choices;

  static ParameterInfo integer(std::string name, int64_t fallback, int64_t minimum, int64_t maximum,
                               std::string help);
  static ParameterInfo real(std::string name, double fallback, double minimum, double maximum,
                            std::string help);
  static ParameterInfo boolean(std::string name, bool fallback, std::string help);
  static ParameterInfo choice(std::string name, std::string fallback, std::vector<std::string> choices,
                              std::string help);
};

// Values by name, complete: every parameter of the algorithm is there, in range and of the right type.
class Parameters {
 public:
  Parameters() = default;
  // All defaults.
  explicit Parameters(const std::vector<ParameterInfo>& infos);

  // Checks and sets one value; an integer is accepted for a real. Throws UsageError "PLACE: ..." that says
  // what was expected.
  void set(const std::vector<ParameterInfo>& infos, const std::string& name, const ParameterValue& value,
           const std::string& where);

  int64_t integer(const std::string& name) const { return std::get<int64_t>(values_.at(name)); }
  double real(const std::string& name) const { return std::get<double>(values_.at(name)); }
  bool boolean(const std::string& name) const { return std::get<bool>(values_.at(name)); }
  const std::string& choice(const std::string& name) const { return std::get<std::string>(values_.at(name)); }
  const std::map<std::string, ParameterValue>& values() const { return values_; }

 private:
  std::map<std::string, ParameterValue> values_;
};

}  // namespace ml
