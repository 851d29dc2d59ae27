// Random valid configurations.
#pragma once

#include <rapidcheck.h>

#include <nlohmann/json.hpp>

namespace ml {

// Any subset of the keys, any values in their ranges; sweeps and zips too.
nlohmann::json random_config();  // draws from rapidcheck: call it inside a property

}  // namespace ml
