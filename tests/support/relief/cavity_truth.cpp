#include "tests/support/relief/cavity_truth.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <memory>
#include <string>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "simulation/core/atomic_file.h"
#include "simulation/core/error.h"
#include "simulation/core/json_text.h"
#include "simulation/core/units.h"
#include "simulation/scene/json/lens_io.h"

namespace arthro::test {
namespace {

namespace fs = std::filesystem;
using Eigen::Vector3d;

// Square array of NumPy's file format, version 1.
struct SquareArray {
  int side = 0;
  std::vector<float> values;

  double Bilinear(double x, double y) const {
    x = std::clamp(x, 0.0, side - 1.001), y = std::clamp(y, 0.0, side - 1.001);
    const int i = static_cast<int>(x), j = static_cast<int>(y);
    const double f = x - i, g = y - j;
    const auto at = [&](int column, int row) {
      return static_cast<double>(
          values[static_cast<std::size_t>(row) * static_cast<std::size_t>(side) +
                 static_cast<std::size_t>(column)]);
    };
    return (1 - g) * ((1 - f) * at(i, j) + f * at(i + 1, j)) +
           g * ((1 - f) * at(i, j + 1) + f * at(i + 1, j + 1));
  }
};

SquareArray ReadSquareArray(const fs::path& file) {
  const std::string bytes = ReadWholeFile(file);
  const auto refuse = [&] {
    throw Error(Code::kBadData, "this is not a square NumPy array of floats; make the clip again",
                file);
  };
  constexpr std::size_t kHead = 10;
  if (bytes.size() < kHead || !bytes.starts_with("\x93NUMPY\x01")) refuse();
  const std::size_t length =
      static_cast<unsigned char>(bytes[8]) + 256u * static_cast<unsigned char>(bytes[9]);
  if (bytes.size() < kHead + length) refuse();
  const std::string head = bytes.substr(kHead, length);
  const bool is_double = head.find("'<f8'") != head.npos;
  if ((!is_double && head.find("'<f4'") == head.npos) || head.find("True") != head.npos) refuse();
  const std::size_t size = is_double ? 8 : 4, count = (bytes.size() - kHead - length) / size;
  SquareArray array;
  array.side = static_cast<int>(std::lround(std::sqrt(static_cast<double>(count))));
  if (array.side < 2 ||
      static_cast<std::size_t>(array.side) * static_cast<std::size_t>(array.side) != count)
    refuse();
  for (std::size_t i = 0; i < count; ++i) {
    const char* from = bytes.data() + kHead + length + i * size;
    double wide = 0;
    float narrow = 0;
    is_double ? std::memcpy(&wide, from, size) : std::memcpy(&narrow, from, size);
    array.values.push_back(is_double ? static_cast<float>(wide) : narrow);
  }
  return array;
}

std::vector<double> Numbers(const nlohmann::json& json) {
  std::vector<double> numbers;
  for (const auto& element : json.flatten()) numbers.push_back(element.get<double>());
  return numbers;
}

}  // namespace

CavityTruth TruthOf(const CavityOptions& options) {
  const auto radius = [fold = options.fold](const Vector3d& direction) {
    return CavityRadius(direction, fold);
  };
  return {radius, CavityPoses(options), CavityLens(), kViewAngle};
}

CavityTruth ReadCavityTruth(const fs::path& folder) {
  constexpr double kPxPerDeg = 6;
  CavityTruth truth;
  truth.lens = ReadLens(folder / "lens.json");
  const auto surface = std::make_shared<const SquareArray>(ReadSquareArray(folder / "radius.npy"));
  truth.radius = [surface](const Vector3d& direction) {
    const double across = std::hypot(direction.x(), direction.y());
    const double angle = DegreesFromRadians(std::atan2(across, direction.z()));
    const double px = across > 0 ? kPxPerDeg * angle / across : 0.0,
                 centre = (surface->side - 1) / 2.0;
    return surface->Bilinear(centre + px * direction.x(), centre + px * direction.y());
  };
  const fs::path file = folder / "gt.json";
  const nlohmann::json json = ParseJson(ReadWholeFile(file), Code::kBadData, file);
  try {
    truth.view_angle = RadiansFromDegrees(json.at("params").at("alpha_deg").get<double>());
    for (const auto& frame : json.at("frames")) {
      const std::vector<double> axes = Numbers(frame.at("R")), centre = Numbers(frame.at("C"));
      authoring::CameraPose pose;
      for (int i = 0; i < 9; ++i)
        pose.world_from_camera(i / 3, i % 3) = axes.at(static_cast<std::size_t>(i));
      pose.centre = {centre.at(0), centre.at(1), centre.at(2)};
      truth.poses.push_back(pose);
      if (!frame.contains("pivot")) continue;
      const std::vector<double> portal = Numbers(frame.at("pivot"));
      truth.portal += Vector3d(portal.at(0), portal.at(1), portal.at(2));
    }
    truth.portal /= std::max(1.0, static_cast<double>(truth.poses.size()));
  } catch (const std::exception&) {
    throw Error(Code::kBadData, "this is not the truth of a cavity clip; make the clip again",
                file);
  }
  return truth;
}

bool Sees(const CavityTruth& truth, std::size_t frame, const Vector3d& direction) {
  const authoring::CameraPose& pose = truth.poses[frame];
  const Vector3d point = truth.radius(direction) * direction;
  const Vector3d local = pose.InCamera(point);
  constexpr double kOfWindow = 0.97;  // the rim is soft
  if (local.z() <= local.norm() * std::cos(kOfWindow * truth.lens.field_of_view / 2)) return false;
  // Not hidden: the way from the tip stays inside the cavity, but for 1 mm before the point.
  constexpr int kSteps = 24;
  constexpr double kBefore = 1e-3;  // m
  const double length = (point - pose.centre).norm();
  for (int i = 1; i < kSteps; ++i) {
    const double share = (length - kBefore) / length * i / kSteps;
    const Vector3d at = pose.centre + share * (point - pose.centre);
    if (at.norm() > truth.radius(at.normalized())) return false;
  }
  return true;
}

}  // namespace arthro::test
