// Tables of text that line up, whole or folded to the width of a terminal.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace ml {

using TextRow = std::vector<std::string>;

struct TextTable {
  std::vector<TextRow> headings, rows;  // all of the same length
  // Columns at the left that say what a row is. They begin at the left, all others end at the right.
  size_t labels = 1;
  // The last of the labels, so many, may stand above the rows that share them, in a line of their own. At
  // least one label stands with its row.
  size_t grouped = 0;
};

// One line a row. Nothing stands after the last text of a line.
std::string whole_table(const TextTable& table);
// The whole table where no line is longer than `width` (letters, > 0); else one table below the other, each
// with as many columns as fit, in order, and with the labels. A column or a group's line that does not fit
// even alone makes a line that is longer.
std::string folded_table(const TextTable& table, size_t width);

}  // namespace ml
