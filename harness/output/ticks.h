// Numbers along a scale that starts at 0.
#pragma once

#include <functional>
#include <string>
#include <vector>

namespace ml {

// A number as a scale up to `end` shows it: no more digits than the scale needs.
std::string tick_label(double value, double end);

// Multiples of 1, 2 or 5 times a power of ten in (0, end), `end` itself left out: as many as fit on `length`
// pixels when each label takes `label_pixels`, with space for the label of `end` kept free. With `integers`,
// whole numbers only. Empty when nothing fits.
std::vector<double> scale_ticks(double end, bool integers, double length,
                                const std::function<double(const std::string&)>& label_pixels);

}  // namespace ml
