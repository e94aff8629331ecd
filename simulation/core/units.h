// Units at the borders. Memory and files hold metre, radian, second, newton; millimetres and
// degrees appear in panels, command-line flags and mesh import only, and are converted here.
#pragma once

#include <numbers>
#include <optional>
#include <string_view>

namespace arthro {

inline constexpr double kMetrePerMillimetre = 1e-3;
inline constexpr double kMm = kMetrePerMillimetre, kMm3 = 1e-9;  // for tables of shapes
inline constexpr double kRadianPerDegree = std::numbers::pi / 180.0;
inline constexpr double kRadianPerTurn = 2.0 * std::numbers::pi;
inline constexpr double kQuarterTurn = 0.5 * std::numbers::pi;

constexpr double MetresFromMm(double mm) { return mm * kMetrePerMillimetre; }
constexpr double MmFromMetres(double metres) { return metres / kMetrePerMillimetre; }
constexpr double RadiansFromDegrees(double degrees) { return degrees * kRadianPerDegree; }
constexpr double DegreesFromRadians(double radians) { return radians / kRadianPerDegree; }

// Metres in one `m`, `cm`, `mm`, `um` or `in`; nothing for any other word.
constexpr std::optional<double> MetresPerUnit(std::string_view unit) {
  if (unit == "m") return 1.0;
  if (unit == "cm") return 1e-2;
  if (unit == "mm") return 1e-3;
  if (unit == "um") return 1e-6;
  if (unit == "in") return 0.0254;
  return std::nullopt;
}

}  // namespace arthro
