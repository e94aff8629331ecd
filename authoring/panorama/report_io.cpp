#include "authoring/panorama/report_io.h"

#include <cmath>
#include <string_view>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include "simulation/core/atomic_file.h"
#include "simulation/core/error.h"
#include "simulation/scene/json/lens_io.h"

namespace arthro::authoring {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

// Three decimals of a pixel are enough to read; homographies keep all of theirs.
double Rounded(double value) { return std::round(value * 1e3) / 1e3; }

Json JsonFromView(const PinholeView& view) {
  return {{"width", view.width},
          {"height", view.height},
          {"focal_px", view.focal_px},
          {"cx", view.cx},
          {"cy", view.cy}};
}

Json JsonFromFrame(const FrameReport& frame, bool is_over_relief) {
  Json json = {
      {"index", frame.index},
      {"source", frame.source},
      {"status", frame.is_placed ? "placed" : "rejected"},
      {"reason", frame.is_placed || frame.is_usable ? frame.reason : "skipped: " + frame.reason},
      {"component", frame.component},
      {"panorama_from_rectified", nullptr},
      {"inliers", frame.inliers},
      {"rms_px", nullptr},
      {"expected_error_px", nullptr}};
  if (frame.component < 0) return json;
  if (!is_over_relief) json["panorama_from_rectified"] = frame.panorama_from_rectified;
  json["rms_px"] = Rounded(frame.rms_px);
  json["expected_error_px"] = Rounded(frame.expected_error_px);
  return json;
}

Json Parsed(const std::string& text) { return text.empty() ? Json::object() : Json::parse(text); }

}  // namespace

std::string JsonFromReport(const PanoramaReport& report) {
  Json json;
  json["schema"] = "arthroscene.panorama/1";
  json["status"] = report.is_partial ? "partial" : "complete";
  json["summary"] = report.summary;
  json["footage"] = report.footage;
  json["lens"] = Parsed(JsonFromLens(report.lens));
  json["lens_is_guessed"] = report.is_lens_guessed;
  json["way"] = report.over_relief ? "relief" : "plane";
  if (report.over_relief) {
    const Projection& projection = *report.over_relief;
    json["panorama"] = {{"width", report.panorama.width},
                        {"height", report.panorama.height},
                        {"radius", report.relief_radius},
                        {"projection",
                         {{"type", "equirectangular"},
                          {"centre_px", {projection.centre_px.x, projection.centre_px.y}},
                          {"px_per_deg", projection.px_per_deg}}}};
  } else {
    json["rectified"] = JsonFromView(report.rectified);
    json["panorama"] = JsonFromView(report.panorama);
  }
  json["mean_error_px"] = Rounded(report.mean_error_px);
  json["max_error_px"] = Rounded(report.max_error_px);
  json["drift_px"] = Rounded(report.drift_px);
  json["detector"] = report.detector;
  json["seed"] = report.seed;
  json["warnings"] = report.warnings;
  json["components"] = Json::array();
  for (const PieceReport& piece : report.pieces) {
    Json row = {{"component", piece.component}, {"frames", piece.frames}, {"file", piece.file}};
    if (piece.panorama.width > 0) row["panorama"] = JsonFromView(piece.panorama);
    json["components"].push_back(std::move(row));
  }
  json["frames"] = Json::array();
  for (const FrameReport& frame : report.frames)
    json["frames"].push_back(JsonFromFrame(frame, report.over_relief.has_value()));
  json["stages_ms"] = Json::object();
  for (const StageCost& stage : report.stages)
    json["stages_ms"][stage.name] = Rounded(stage.cpu_ms);
  json["peak_memory_mb"] = std::round(report.peak_memory_mb);
  json["options"] = Parsed(report.options);
  return json.dump(1) + "\n";
}

void WriteReport(const fs::path& file, const PanoramaReport& report) {
  WriteAtomically(file, JsonFromReport(report));
}

void CheckPanoramaName(const fs::path& file) {
  if (file == "-") return;
  const std::string ending = file.extension().string();
  if (ending != ".png" && ending != ".jpg" && ending != ".jpeg")
    throw Error(Code::kBadArgument,
                "a panorama is written as .png, with the imaged area as alpha, or as .jpg", file);
  std::error_code ignored;
  if (fs::is_directory(file, ignored))
    throw Error(Code::kFile, "this is a folder; give the name of a file", file);
  const fs::path folder = file.has_parent_path() ? file.parent_path() : fs::path(".");
  if (!fs::is_directory(folder, ignored))
    throw Error(Code::kFile,
                fmt::format("the folder {} does not exist; create it first", folder.string()),
                file);
}

void WritePanorama(const fs::path& file, const RgbaPicture& picture) {
  CheckPanoramaName(file);
  if (picture.empty()) throw Error(Code::kBadArgument, "an empty panorama cannot be written", file);
  const cv::Mat rgba(picture.height, picture.width, CV_8UC4,
                     const_cast<std::uint8_t*>(picture.rgba.data()));
  const bool is_png = file == "-" || file.extension() == ".png";
  cv::Mat bgr;
  cv::cvtColor(rgba, bgr, is_png ? cv::COLOR_RGBA2BGRA : cv::COLOR_RGBA2BGR);
  // A viewer that ignores alpha should show black, as beyond the round window of a frame.
  cv::Mat alpha;
  cv::extractChannel(rgba, alpha, 3);
  bgr.setTo(cv::Scalar::all(0), alpha == 0);
  std::vector<unsigned char> bytes;
  bool encoded = false;
  try {
    encoded = cv::imencode(is_png ? ".png" : ".jpg", bgr, bytes, {cv::IMWRITE_JPEG_QUALITY, 95});
  } catch (const cv::Exception&) {
    encoded = false;
  }
  if (!encoded)
    throw Error(Code::kBadArgument,
                fmt::format("a panorama of {} x {} px cannot be packed; lower the most megapixels",
                            picture.width, picture.height),
                file);
  WriteAtomically(file,
                  std::string_view(reinterpret_cast<const char*>(bytes.data()), bytes.size()));
}

}  // namespace arthro::authoring
