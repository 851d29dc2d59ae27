// The instruction sets that vector code is compiled for (Highway). The best one that the processor has is
// chosen at run time; every one gives the same bits.
#pragma once

#include <string>
#include <vector>

namespace ml::simd {

// Those that this processor has, as Highway names them ("AVX3" is AVX-512), the best first; the last one is
// portable code.
std::vector<std::string> target_names();

// The one that is used.
std::string target_name();

// From now on the named one of target_names() is used, by all threads; "" is the best one again. For tests
// and benchmarks; no vector code may be running. Throws UsageError for any other name.
void use_target(const std::string& name);

}  // namespace ml::simd
