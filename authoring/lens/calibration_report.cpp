#include "authoring/lens/calibration_report.h"

#include <cmath>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "simulation/core/units.h"
#include "simulation/scene/json/lens_io.h"

namespace arthro::authoring {

std::string TableOf(const LensCalibration& calibration, const std::vector<std::string>& names) {
  std::string text;
  for (std::size_t v = 0; v < calibration.views.size(); ++v) {
    const ViewReport& view = calibration.views[v];
    if (view.target.kind == TargetKind::kNone)
      text += fmt::format("{}: not used: {}\n", names[v], view.target.reason);
    else
      text += fmt::format(
          "{}: {}, {} points, {} left out, {:.3f} px, {:.1f} mm away, tilt {:.0f} deg\n", names[v],
          ToString(view.target.kind), view.target.points.size(), view.points_left_out, view.rms_px,
          MmFromMetres(view.distance), DegreesFromRadians(view.tilt));
  }
  if (calibration.lens.focal_px > 0) {
    text += "model            parameters  residual px  held out px\n";
    for (const ModelTrial& trial : calibration.trials)
      text += trial.fitted
                  ? fmt::format("{:<16} {:>10} {:>12.3f} {:>12.3f}{}\n", ToString(trial.model),
                                trial.parameters, trial.rms_px, trial.held_out_px,
                                trial.model == calibration.model ? "  <- taken" : "")
                  : fmt::format("{:<16} could not be fitted\n", ToString(trial.model));
    const Lens& lens = calibration.lens;
    text += fmt::format(
        "focal length     {:.3f} px, sigma {:.3f}\n"
        "centre           {:.2f}, {:.2f} px, sigma {:.2f}\n"
        "field of view    {:.2f} deg\n"
        "residual         {:.3f} px rms\n"
        "covered radius   {:.0f} of {:.0f} px\n"
        "error at the rim {:.2f} px at most, as estimated\n"
        "fit              {:.1f} ms\n",
        lens.focal_px, calibration.focal_sigma_px, lens.cx, lens.cy, calibration.centre_sigma_px,
        DegreesFromRadians(lens.field_of_view), lens.rms_px, calibration.covered_radius_px,
        calibration.rim_radius_px, calibration.rim_error_px, calibration.fit_ms);
  }
  text += fmt::format("verdict          {}\n", ToString(calibration.verdict));
  for (const std::string& sentence : calibration.sentences) text += "  " + sentence + "\n";
  return text;
}

std::string JsonOf(const LensCalibration& calibration, const std::vector<std::string>& names) {
  using nlohmann::ordered_json;
  const auto Known = [](double value) {
    return std::isfinite(value) ? ordered_json(value) : ordered_json(nullptr);
  };
  ordered_json json;
  json["schema"] = "arthroscene.lens_report/1";
  json["verdict"] = ToString(calibration.verdict);
  json["sentences"] = calibration.sentences;
  json["model"] = ToString(calibration.model);
  json["wrong_model"] = calibration.is_paper_model_refuted;
  json["focal_px"] = calibration.lens.focal_px;
  json["focal_sigma_px"] = Known(calibration.focal_sigma_px);
  json["cx"] = calibration.lens.cx;
  json["cy"] = calibration.lens.cy;
  json["centre_sigma_px"] = Known(calibration.centre_sigma_px);
  json["aspect"] = calibration.lens.aspect;
  json["rms_px"] = calibration.lens.rms_px;
  json["covered_radius_px"] = calibration.covered_radius_px;
  json["rim_radius_px"] = calibration.rim_radius_px;
  json["rim_error_px"] = Known(calibration.rim_error_px);
  json["points"] = calibration.points;
  json["points_left_out"] = calibration.points_left_out;
  json["fit_ms"] = calibration.fit_ms;
  json["models"] = ordered_json::array();
  for (const ModelTrial& trial : calibration.trials)
    json["models"].push_back({{"model", ToString(trial.model)},
                              {"fitted", trial.fitted},
                              {"parameters", trial.parameters},
                              {"rms_px", Known(trial.rms_px)},
                              {"held_out_px", Known(trial.held_out_px)}});
  json["views"] = ordered_json::array();
  for (std::size_t v = 0; v < calibration.views.size(); ++v) {
    const ViewReport& view = calibration.views[v];
    json["views"].push_back({{"picture", names[v]},
                             {"target", ToString(view.target.kind)},
                             {"reason", view.target.reason},
                             {"points", view.target.points.size()},
                             {"points_left_out", view.points_left_out},
                             {"rms_px", view.rms_px},
                             {"distance", view.distance},
                             {"tilt_deg", DegreesFromRadians(view.tilt)}});
  }
  return json.dump(2) + "\n";
}

}  // namespace arthro::authoring
