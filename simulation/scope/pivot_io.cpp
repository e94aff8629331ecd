#include "simulation/scope/pivot_io.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <string_view>

#include <fmt/format.h>
#include <glm/geometric.hpp>
#include <nlohmann/json.hpp>

#include "simulation/core/error.h"
#include "simulation/core/input_file.h"

namespace arthro::simulation {
namespace {

constexpr std::array<std::string_view, 6> kColumns = {"hip_x", "hip_y", "hip_z",
                                                      "tip_x", "tip_y", "tip_z"};

std::string_view Trimmed(std::string_view text) {
  const auto first = text.find_first_not_of(" \t\r");
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(" \t\r") - first + 1);
}

std::vector<std::string_view> Cells(std::string_view line) {
  std::vector<std::string_view> cells;
  for (std::size_t start = 0;;) {
    const std::size_t comma = line.find(',', start);
    cells.push_back(Trimmed(line.substr(start, comma - start)));
    if (comma == std::string_view::npos) return cells;
    start = comma + 1;
  }
}

// Shortens text of a file to 40 characters, so that a binary file does not fill the terminal.
std::string Quoted(std::string_view text) {
  std::string quoted;
  for (const char c : text.substr(0, 40)) quoted += c >= ' ' && c < 127 ? c : '?';
  return "\"" + quoted + (text.size() > 40 ? "…\"" : "\"");
}

class PressTable {
 public:
  explicit PressTable(const std::filesystem::path& file) : file_(file) {}

  std::vector<PivotPress> Read() {
    const std::string text = ReadWholeFile(file_, kMostTableBytes);
    std::string_view rest = text;
    if (rest.starts_with("\xEF\xBB\xBF"))
      rest.remove_prefix(3);  // byte order mark, as spreadsheets write it
    bool has_header = false;
    std::vector<PivotPress> presses;
    while (!rest.empty()) {
      const std::size_t end = rest.find('\n');
      const std::string_view line = Trimmed(rest.substr(0, end));
      rest.remove_prefix(end == std::string_view::npos ? rest.size() : end + 1);
      ++line_;
      if (line.empty()) continue;
      if (has_header)
        presses.push_back(Press(Cells(line)));
      else
        RequireHeader(line);
      has_header = true;
    }
    if (!has_header) throw Error(Code::kBadData, "line 1: is empty; " + Expected(), file_);
    return presses;
  }

 private:
  static std::string Expected() {
    return fmt::format("the first line must be {}, then one press a line, in metres",
                       fmt::join(kColumns, ","));
  }

  [[noreturn]] void Refuse(const std::string& sentence) const {
    throw Error(Code::kBadData, fmt::format("line {}: {}", line_, sentence), file_);
  }

  void RequireHeader(std::string_view line) const {
    const std::vector<std::string_view> cells = Cells(line);
    if (!std::equal(cells.begin(), cells.end(), kColumns.begin(), kColumns.end()))
      Refuse("found " + Quoted(line) + "; " + Expected());
  }

  double Number(std::string_view cell, std::string_view column) const {
    double value = 0.0;
    const auto [end, error] = std::from_chars(cell.data(), cell.data() + cell.size(), value);
    if (error != std::errc() || end != cell.data() + cell.size())
      Refuse(fmt::format("{} is {}, which is not a number", column, Quoted(cell)));
    if (!std::isfinite(value))
      Refuse(fmt::format("{} is {}; it must be finite", column, Quoted(cell)));
    if (std::abs(value) > 100.0)
      Refuse(
          fmt::format("{} is {}; no device reaches that far, so check that the table is in metres",
                      column, Quoted(cell)));
    return value;
  }

  PivotPress Press(const std::vector<std::string_view>& cells) const {
    if (cells.size() != kColumns.size())
      Refuse(fmt::format("has {} values; a press has {}: {}", cells.size(), kColumns.size(),
                         fmt::join(kColumns, ",")));
    std::array<double, 6> values;
    for (std::size_t i = 0; i < values.size(); ++i) values[i] = Number(cells[i], kColumns[i]);
    const PivotPress press{{values[0], values[1], values[2]}, {values[3], values[4], values[5]}};
    if (!(glm::length(press.tip - press.hip) > 1e-6))
      Refuse("hand and tip are the same point, so the press shows no direction; remove it");
    return press;
  }

  std::filesystem::path file_;
  int line_ = 0;
};

}  // namespace

std::vector<PivotPress> ReadPresses(const std::filesystem::path& csv) {
  return PressTable(csv).Read();
}

std::string JsonFromPivot(const PivotCalibration& calibration) {
  nlohmann::ordered_json json;
  json["schema"] = "arthroscene.pivot/1";
  json["status"] = ToString(calibration.status);
  json["reason"] = calibration.reason;
  json["pivot"] = nullptr;
  if (calibration.pivot)
    json["pivot"] = {calibration.pivot->x, calibration.pivot->y, calibration.pivot->z};
  const auto known = [](double value) {
    return std::isfinite(value) ? nlohmann::ordered_json(value) : nlohmann::ordered_json(nullptr);
  };
  json["sigma"] = known(calibration.sigma);
  json["condition"] = known(calibration.condition);
  json["residual"] = known(calibration.residual);
  json["poses_used"] = calibration.poses_used;
  return json.dump(2) + "\n";
}

}  // namespace arthro::simulation
