#include "embedded/config_schema_json.h"
#include "harness/config/config.h"

namespace ml {

const nlohmann::json& config_schema() {
  static const nlohmann::json schema = nlohmann::json::parse(::config_schema_json);
  return schema;
}

}  // namespace ml
