// The only file that sees valijson: its headers take seconds to compile.
#include <algorithm>
#include <stdexcept>
#include <valijson/adapters/nlohmann_json_adapter.hpp>
#include <valijson/schema.hpp>
#include <valijson/schema_parser.hpp>
#include <valijson/validation_results.hpp>
#include <valijson/validator.hpp>

#include "harness/output/result.h"

namespace ml {
namespace {

using nlohmann::json;
using Context = std::vector<std::string>;  // "<root>", "[cases]", "[0]", ...

std::string path_of(const Context& context, const json& document, const json*& found) {
  std::string path = "$";
  found = &document;
  for (size_t i = 1; i < context.size(); ++i) {
    std::string step = context[i].substr(1, context[i].size() - 2);
    bool is_index = found && found->is_array();
    path += is_index ? "[" + step + "]" : "." + step;
    if (is_index && std::stoul(step) < found->size())
      found = &(*found)[std::stoul(step)];
    else if (found && found->is_object() && found->contains(step))
      found = &(*found)[step];
    else
      found = nullptr;
  }
  return path;
}

// Scalars are shown, containers only named.
std::string shown(const json* found) {
  if (!found) return "";
  if (found->is_structured()) return std::string(" (found ") + found->type_name() + ")";
  std::string text = found->dump(-1, ' ', true, json::error_handler_t::replace);
  return " (found " + (text.size() > 60 ? text.substr(0, 60) + "..." : text) + ")";
}

// valijson repeats every violation for all the containers around it; only the innermost says what is wrong.
bool is_inside(const Context& inner, const Context& outer) {
  return inner.size() > outer.size() && std::equal(outer.begin(), outer.end(), inner.begin());
}

}  // namespace

std::vector<std::string> schema_violations(const json& schema, const json& document) {
  valijson::Schema compiled;
  valijson::SchemaParser(valijson::SchemaParser::kDraft7)
      .populateSchema(valijson::adapters::NlohmannJsonAdapter(schema), compiled);
  valijson::ValidationResults results;
  valijson::Validator validator;
  if (validator.validate(compiled, valijson::adapters::NlohmannJsonAdapter(document), &results)) return {};
  std::vector<std::string> lines;
  for (const auto& error : results) {
    bool innermost = std::none_of(results.begin(), results.end(),
                                  [&](const auto& other) { return is_inside(other.context, error.context); });
    if (!innermost) continue;
    const json* found = nullptr;
    std::string path = path_of(error.context, document, found);
    std::string line = path + ": " + error.description + shown(found);
    if (std::find(lines.begin(), lines.end(), line) == lines.end()) lines.push_back(line);
  }
  if (lines.empty()) throw std::logic_error("valijson refused a document and did not say why");
  return lines;
}

}  // namespace ml
