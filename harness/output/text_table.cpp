#include "harness/output/text_table.h"

#include <fmt/format.h>

#include <algorithm>

#include "harness/base/check.h"

namespace ml {
namespace {

constexpr size_t gap = 2;

std::vector<size_t> widths_of(const TextTable& table) {
  std::vector<size_t> widths;
  for (const std::vector<TextRow>* rows : {&table.headings, &table.rows}) {
    for (const TextRow& row : *rows) {
      widths.resize(std::max(widths.size(), row.size()));
      for (size_t c = 0; c < row.size(); ++c) widths[c] = std::max(widths[c], row[c].size());
    }
  }
  return widths;
}

// The columns of a row that are named.
std::string line(const TextRow& row, const std::vector<size_t>& columns, const std::vector<size_t>& widths,
                 size_t labels) {
  std::string text;
  for (size_t c : columns) {
    if (c != columns.front()) text.append(gap, ' ');
    text += c < labels ? fmt::format("{:<{}}", row[c], widths[c]) : fmt::format("{:>{}}", row[c], widths[c]);
  }
  text.erase(text.find_last_not_of(' ') + 1);
  return text + "\n";
}

size_t length(const std::vector<size_t>& columns, const std::vector<size_t>& widths) {
  size_t sum = columns.empty() ? 0 : gap * (columns.size() - 1);
  for (size_t c : columns) sum += widths[c];
  return sum;
}

std::string group_line(const TextTable& table, const TextRow& row) {
  std::string text;
  for (size_t c = table.labels - table.grouped; c < table.labels; ++c) {
    text += (text.empty() ? "" : ", ") + table.headings.front()[c] + " " + row[c];
  }
  return text + ":\n";
}

bool same_group(const TextTable& table, const TextRow& a, const TextRow& b) {
  const auto first = static_cast<ptrdiff_t>(table.labels - table.grouped),
             last = static_cast<ptrdiff_t>(table.labels);
  return std::equal(a.begin() + first, a.begin() + last, b.begin() + first);
}

std::string part(const TextTable& table, const std::vector<size_t>& columns,
                 const std::vector<size_t>& widths) {
  std::string text;
  for (const TextRow& row : table.headings) text += line(row, columns, widths, table.labels);
  const TextRow* before = nullptr;
  for (const TextRow& row : table.rows) {
    if (table.grouped > 0 && !(before && same_group(table, *before, row))) text += group_line(table, row);
    text += line(row, columns, widths, table.labels);
    before = &row;
  }
  return text;
}

}  // namespace

std::string whole_table(const TextTable& table) {
  const std::vector<size_t> widths = widths_of(table);
  std::vector<size_t> columns(widths.size());
  for (size_t c = 0; c < columns.size(); ++c) columns[c] = c;
  std::string text;
  for (const std::vector<TextRow>* rows : {&table.headings, &table.rows})
    for (const TextRow& row : *rows) text += line(row, columns, widths, table.labels);
  return text;
}

std::string folded_table(const TextTable& table, size_t width) {
  ML_CHECK(table.grouped < table.labels || table.labels == 0);
  const std::vector<size_t> widths = widths_of(table);
  std::vector<size_t> columns(widths.size());
  for (size_t c = 0; c < columns.size(); ++c) columns[c] = c;
  if (length(columns, widths) <= width) return whole_table(table);
  std::vector<size_t> labels;
  for (size_t c = 0; c < table.labels - table.grouped; ++c) labels.push_back(c);
  std::string text;
  columns = labels;
  for (size_t c = table.labels; c < widths.size(); ++c) {
    columns.push_back(c);
    if (length(columns, widths) <= width || columns.size() == labels.size() + 1) continue;
    columns.pop_back();
    text += part(table, columns, widths) + "\n";
    columns = labels;
    columns.push_back(c);
  }
  return text + part(table, columns, widths);
}

}  // namespace ml
