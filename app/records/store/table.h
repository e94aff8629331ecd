// Rows of tables from plain structs by the one list of fields of each (core/options.h): the name of
// a field is that of its column. A field with LeftOutAt is NULL at that value; so is a number that
// is not there.
#pragma once

#include <cmath>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "app/records/store/database.h"
#include "simulation/core/options.h"

namespace arthro::app {
namespace internal {

template <class T>
inline constexpr bool kIsCell =
    std::is_same_v<T, std::string> || std::is_same_v<T, double> || std::is_same_v<T, int> ||
    std::is_same_v<T, bool> || std::is_same_v<T, std::optional<double>> || std::is_enum_v<T>;

// Lists of rows stand in tables of their own, so they are passed over.
struct RowWriter {
  std::vector<std::string>& names;
  Row& row;

  template <class T, class Rule>
  void operator()(const char* name, T& field, const Rule& rule, const char*, const char*) {
    if constexpr (kIsCell<T>) {
      names.emplace_back(name);
      row.push_back(CellOf(field, rule));
    }
  }

 private:
  template <class T, class V, class Rule>
  static Cell CellOf(const T& field, const LeftOutAt<V, Rule>& rule) {
    return field == rule.value ? Cell() : CellOf(field, rule.rule);
  }
  template <class T, class Rule>
  static Cell CellOf(const T& field, const Required<Rule>& rule) {
    return CellOf(field, rule.rule);
  }
  template <class T, class Rule>
  static Cell CellOf(const T& field, const Rule& rule) {
    if constexpr (std::is_enum_v<T>) {
      for (const auto& [value, word] : rule.words)
        if (value == field) return std::string(word);
      return {};
    } else if constexpr (std::is_same_v<T, std::optional<double>>) {
      return field ? Cell(*field) : Cell();
    } else if constexpr (std::is_same_v<T, int> || std::is_same_v<T, bool>) {
      return static_cast<std::int64_t>(field);
    } else {
      return field;
    }
  }
};

struct RowReader {
  const Row& row;
  std::size_t at = 0;

  template <class T, class Rule>
  void operator()(const char*, T& field, const Rule& rule, const char*, const char*) {
    if constexpr (kIsCell<T>) {
      const Cell& cell = row.at(at++);
      if (!std::holds_alternative<std::monostate>(cell)) Read(field, rule, cell);
    }
  }

 private:
  template <class T, class Rule>
  static void Read(T& field, const Rule& rule, const Cell& cell) {
    if constexpr (requires { rule.rule; }) {
      Read(field, rule.rule, cell);
    } else if constexpr (std::is_enum_v<T>) {
      for (const auto& [value, word] : rule.words)
        if (TextOf(cell) == word) field = value;
    } else if constexpr (std::is_same_v<T, std::string>) {
      field = TextOf(cell);
    } else if constexpr (std::is_same_v<T, int> || std::is_same_v<T, bool>) {
      field = static_cast<T>(WholeOf(cell));
    } else {
      field = NumberOf(cell);
    }
  }
};

}  // namespace internal

template <class T>
std::vector<std::string> ColumnsOf() {
  T value;
  Row ignored;
  std::vector<std::string> names;
  value.Visit(internal::RowWriter{names, ignored});
  return names;
}

// Inserts rows; `owner` names the columns that the struct lacks, such as {"attempt", ID}. With
// `counts` a column seq counts the rows from 0. Rows whose key exists are passed over. Returns the
// number of new rows.
template <class T>
long Insert(Database& database, const std::string& table, const std::vector<T>& values,
            const std::vector<std::pair<std::string, Cell>>& owner = {}, bool counts = false) {
  std::vector<std::string> names;
  std::vector<Row> rows;
  for (const T& value : values) {
    names.clear();
    Row row;
    for (const auto& [name, cell] : owner) {
      names.push_back(name);
      row.push_back(cell);
    }
    if (counts) {
      names.emplace_back("seq");
      row.push_back(static_cast<std::int64_t>(rows.size()));
    }
    T(value).Visit(internal::RowWriter{names, row});
    rows.push_back(std::move(row));
  }
  if (rows.empty()) return 0;
  return database.Do(fmt::format("INSERT INTO {} ({}) VALUES (:{}) ON CONFLICT DO NOTHING", table,
                                 fmt::join(names, ", "), fmt::join(names, ", :")),
                     rows);
}

// Rows of a table; `rest` is what follows its name, such as "WHERE id = :id ORDER BY started".
template <class T>
std::vector<T> Select(Database& database, const std::string& table, const std::string& rest = "",
                      const Row& values = {}) {
  std::vector<T> found;
  for (const Row& row : database.Ask(
           fmt::format("SELECT {} FROM {} {}", fmt::join(ColumnsOf<T>(), ", "), table, rest),
           values))
    found.emplace_back().Visit(internal::RowReader{row});
  return found;
}

}  // namespace arthro::app
