#include "simulation/device/trace_io.h"

#include <array>
#include <charconv>
#include <cmath>
#include <iterator>

#include <fmt/format.h>

#include "simulation/core/atomic_file.h"
#include "simulation/core/error.h"
#include "simulation/core/input_file.h"

namespace arthro::simulation {
namespace {

constexpr std::string_view kHeader = "t,device,hip_x,hip_y,hip_z,qw,qx,qy,qz,buttons";
constexpr std::array kNames = {"t",  "device", "hip_x", "hip_y", "hip_z",
                               "qw", "qx",     "qy",    "qz",    "buttons"};
constexpr std::size_t kColumns = kNames.size();
constexpr double kUnitTolerance = 1e-3;  // precision of four decimals, in files written by hand

class Parser {
 public:
  Parser(std::string_view text, const std::filesystem::path& file) : text_(text), file_(file) {
    constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";  // written first by spreadsheets
    if (text_.starts_with(kByteOrderMark)) text_.remove_prefix(kByteOrderMark.size());
  }

  std::vector<TraceRow> Parse() {
    std::string_view line;
    if (!NextLine(line) || line != kHeader)
      Refuse(fmt::format("the first line must be \"{}\"", kHeader));
    std::vector<TraceRow> rows;
    while (NextLine(line)) {
      if (line.empty() && text_.empty()) break;
      rows.push_back(ParseRow(line));
      const double t = rows.back().sample.t;
      if (rows.size() < 2) continue;
      const double before = rows[rows.size() - 2].sample.t;
      if (t < before)
        Refuse(fmt::format("time runs backwards, {} after {}; sort the rows by t", t, before));
      if (t - before > kLongestGap)
        Refuse(
            fmt::format("time leaps from {} to {}; t is in seconds, and a recording with a gap "
                        "of more than {} s must be cut in two",
                        before, t, kLongestGap));
    }
    if (rows.empty()) Refuse("there are no rows after the header; record at least one sample");
    return rows;
  }

 private:
  [[noreturn]] void Refuse(const std::string& what) const {
    throw Error(Code::kBadData, fmt::format("line {}: {}", line_number_, what), file_);
  }

  bool NextLine(std::string_view& line) {
    ++line_number_;
    if (text_.empty()) return false;
    const std::size_t end = text_.find('\n');
    line = text_.substr(0, end);
    text_.remove_prefix(end == std::string_view::npos ? text_.size() : end + 1);
    if (line.ends_with('\r')) line.remove_suffix(1);
    return true;
  }

  double Number(std::string_view field, std::size_t column) const {
    double value = 0;
    const auto [end, fault] = std::from_chars(field.data(), field.data() + field.size(), value);
    if (fault != std::errc() || end != field.data() + field.size())
      Refuse(fmt::format("{} is \"{}\", which is not a number", kNames[column], field));
    if (!std::isfinite(value))
      Refuse(fmt::format("{} is {}; every number must be finite", kNames[column], field));
    return value;
  }

  TraceRow ParseRow(std::string_view line) const {
    std::array<std::string_view, kColumns> field;
    std::size_t count = 0;
    for (std::string_view rest = line;; ++count) {
      const std::size_t comma = rest.find(',');
      if (count < kColumns) field[count] = rest.substr(0, comma);
      if (comma == std::string_view::npos) break;
      rest.remove_prefix(comma + 1);
    }
    if (++count != kColumns)
      Refuse(fmt::format("{} columns where there must be {}", count, kColumns));
    TraceRow row;
    row.sample.valid = true;
    row.sample.t = Number(field[0], 0);
    const std::optional<DeviceRole> role = DeviceRoleFromString(field[1]);
    if (!role) Refuse(fmt::format("device is \"{}\"; it must be scope or instrument", field[1]));
    row.device = *role;
    for (int i = 0; i < 3; ++i) {
      const auto column = 2 + static_cast<std::size_t>(i);
      row.sample.hip_in_device[i] = Number(field[column], column);
    }
    glm::dquat& q = row.sample.handle_in_device;
    q = glm::dquat(Number(field[5], 5), Number(field[6], 6), Number(field[7], 7),
                   Number(field[8], 8));
    const double length = std::sqrt(q.w * q.w + q.x * q.x + q.y * q.y + q.z * q.z);
    if (!(std::abs(length - 1.0) <= kUnitTolerance))
      Refuse(fmt::format("the quaternion has length {}; it must be 1", length));
    const std::string_view bits = field[9];
    const auto [end, fault] =
        std::from_chars(bits.data(), bits.data() + bits.size(), row.sample.buttons);
    if (fault != std::errc() || end != bits.data() + bits.size())
      Refuse(
          fmt::format("buttons is \"{}\"; it must be a whole number from 0 to 4294967295", bits));
    return row;
  }

  std::string_view text_;
  const std::filesystem::path& file_;
  int line_number_ = 0;
};

}  // namespace

std::vector<TraceRow> ParseTrace(std::string_view text, const std::filesystem::path& file) {
  return Parser(text, file).Parse();
}

std::vector<TraceRow> ReadTrace(const std::filesystem::path& file) {
  return ParseTrace(ReadWholeFile(file, kMostTableBytes), file);
}

std::string TraceText(std::span<const TraceRow> rows) {
  std::string text = std::string(kHeader) + "\n";
  for (const auto& [device, sample] : rows) {
    const auto& [t, hip, q, buttons, valid] = sample;
    fmt::format_to(std::back_inserter(text), "{},{},{},{},{},{},{},{},{},{}\n", t, ToString(device),
                   hip.x, hip.y, hip.z, q.w, q.x, q.y, q.z, buttons);
  }
  return text;
}

void WriteTrace(const std::filesystem::path& file, std::span<const TraceRow> rows) {
  WriteAtomically(file, TraceText(rows));
}

}  // namespace arthro::simulation
