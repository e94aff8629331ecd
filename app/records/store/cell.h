// Value of one cell of a table: nothing, a whole number, a number or a text.
#pragma once

#include <cstdint>
#include <string>
#include <variant>
#include <vector>

namespace arthro::app {

using Cell = std::variant<std::monostate, std::int64_t, double, std::string>;
using Row = std::vector<Cell>;

// The whole number of a cell that a database gave for a count, however it typed it; 0 for nothing.
std::int64_t WholeOf(const Cell& cell);
// The number of a cell; NaN for nothing.
double NumberOf(const Cell& cell);
// The text of a cell; empty for nothing.
std::string TextOf(const Cell& cell);

}  // namespace arthro::app
