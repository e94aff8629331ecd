#include "authoring/lens/fit/radial_model.h"

#include <cmath>

namespace arthro::authoring {
namespace {

// r = f sin θ / w with w = α d + (1 - α)(ξ + cos θ), d² = 1 + 2 ξ cos θ + ξ².
bool DoubleSphere(double focal, double xi, double alpha, double theta, RadialValue& value) {
  const double s = std::sin(theta), c = std::cos(theta);
  const double d = std::sqrt(1 + 2 * xi * c + xi * xi);
  if (!(d > 1e-9)) return false;
  const double w = alpha * d + (1 - alpha) * (xi + c);
  if (!(w > 1e-6)) return false;
  const double d_theta = -xi * s / d, d_xi = (c + xi) / d;
  const double r = focal * s / w;
  value.r = r;
  value.by_focal = s / w;
  value.by_theta = focal * c / w - r / w * (alpha * d_theta - (1 - alpha) * s);
  value.by_own[0] = -r / w * (alpha * d_xi + 1 - alpha);
  value.by_own[1] = -r / w * (d - xi - c);
  return true;
}

bool KannalaBrandt(double focal, std::span<const double> k, double theta, RadialValue& value) {
  const double t = theta * theta;
  const double poly = 1 + t * (k[0] + t * (k[1] + t * (k[2] + t * k[3])));
  value.r = focal * theta * poly;
  value.by_focal = theta * poly;
  value.by_theta = focal * (1 + t * (3 * k[0] + t * (5 * k[1] + t * (7 * k[2] + t * 9 * k[3]))));
  double power = focal * theta;
  for (int n = 0; n < 4; ++n) value.by_own[n] = power *= t;
  return true;
}

}  // namespace

const char* ToString(FitModel model) {
  switch (model) {
    case FitModel::kEquisolid:
      return "equisolid";
    case FitModel::kEquidistant:
      return "equidistant";
    case FitModel::kDoubleSphere:
      return "double_sphere";
    case FitModel::kKannalaBrandt:
      return "kannala_brandt";
    case FitModel::kStereographic:
      return "stereographic";
    case FitModel::kPinhole:
      return "pinhole";
  }
  return "";
}

int OwnParametersOf(FitModel model) {
  return model == FitModel::kDoubleSphere ? 2 : model == FitModel::kKannalaBrandt ? 4 : 0;
}

bool EvaluateRadius(FitModel model, double focal, std::span<const double> own, double theta,
                    RadialValue& value) {
  switch (model) {
    case FitModel::kEquisolid:
      value.by_focal = 2 * std::sin(theta / 2);
      value.by_theta = focal * std::cos(theta / 2);
      break;
    case FitModel::kEquidistant:
      value.by_focal = theta;
      value.by_theta = focal;
      break;
    case FitModel::kStereographic: {
      const double tangent = std::tan(theta / 2);
      if (theta > 3.0) return false;
      value.by_focal = 2 * tangent;
      value.by_theta = focal * (1 + tangent * tangent);
      break;
    }
    case FitModel::kPinhole: {
      const double tangent = std::tan(theta);
      if (theta > 1.55) return false;  // 89 degrees
      value.by_focal = tangent;
      value.by_theta = focal * (1 + tangent * tangent);
      break;
    }
    case FitModel::kDoubleSphere:
      return DoubleSphere(focal, own[0], own[1], theta, value);
    case FitModel::kKannalaBrandt:
      return KannalaBrandt(focal, own, theta, value);
  }
  value.r = focal * value.by_focal;
  return true;
}

std::array<double, kMostOwnParameters> StartOf(FitModel model, double& focal) {
  switch (model) {
    case FitModel::kDoubleSphere: {
      // Least-squares fit to the equisolid profile up to 60 degrees, to within 0.2 %.
      constexpr double kXi = -0.21, kAlpha = 0.634;
      focal *= 1 + kXi;
      return {kXi, kAlpha, 0, 0};
    }
    case FitModel::kKannalaBrandt:  // 2 sin(θ/2) in powers of θ
      return {-1.0 / 24, 1.0 / 1920, 0, 0};
    default:
      return {};
  }
}

void StoreModel(FitModel model, double focal, std::span<const double> own, Lens& lens) {
  lens.focal_px = focal;
  lens.k = {};
  switch (model) {
    case FitModel::kEquisolid:
      lens.model = LensModel::kEquisolid;
      break;
    case FitModel::kPinhole:
      lens.model = LensModel::kPinhole;
      break;
    case FitModel::kEquidistant:
      lens.model = LensModel::kKannalaBrandt;
      break;
    case FitModel::kStereographic:
      lens.model = LensModel::kDoubleSphere;
      lens.k = {0, 0.5, 0, 0};
      break;
    case FitModel::kDoubleSphere:
      lens.model = LensModel::kDoubleSphere;
      lens.k = {own[0], own[1], 0, 0};
      break;
    case FitModel::kKannalaBrandt:
      lens.model = LensModel::kKannalaBrandt;
      for (int n = 0; n < 4; ++n) lens.k[n] = own[n];
      break;
  }
}

}  // namespace arthro::authoring
