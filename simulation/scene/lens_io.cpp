#include "simulation/scene/lens_io.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include <fmt/format.h>

#include "simulation/core/atomic_file.h"
#include "simulation/core/error.h"
#include "simulation/core/input_file.h"
#include "simulation/core/json_text.h"
#include "simulation/core/units.h"
#include "simulation/scene/json_object_reader.h"

namespace arthro {
namespace {

using Reader = JsonObjectReader;

constexpr const char* kSchema = "arthroscene.lens/1";
constexpr JsonLimits kSize{1, 16384, "pixels"};  // the widest picture that is read
constexpr JsonLimits kFocal{0, 1e6, "pixels", true};
constexpr JsonLimits kPixel{-1e5, 1e5, "pixels"};
constexpr JsonLimits kRadius{0, 1e5, "pixels"};
constexpr JsonLimits kAspect{0.2, 5};
constexpr JsonLimits kFieldOfView{0, 360, "degrees", true};

constexpr std::array<std::pair<LensModel, std::string_view>, 4> kWords = {{
    {LensModel::kEquisolid, "equisolid"},
    {LensModel::kKannalaBrandt, "kannala_brandt"},
    {LensModel::kDoubleSphere, "double_sphere"},
    {LensModel::kPinhole, "pinhole"},
}};

int ParametersOf(LensModel model) {
  return model == LensModel::kKannalaBrandt ? 4 : model == LensModel::kDoubleSphere ? 2 : 0;
}

void ReadSchema(Reader& reader) {
  std::string schema = kSchema;
  reader.Text("schema", schema);
  if (schema != kSchema)
    reader.Fault("schema", fmt::format("is {}; this program reads \"{}\"",
                                       nlohmann::json(schema).dump(), kSchema));
}

void ReadModel(Reader& reader, Lens& lens) {
  std::string word;
  reader.Text("model", word, Reader::kRequired);
  const auto known =
      std::find_if(kWords.begin(), kWords.end(), [&](const auto& w) { return w.second == word; });
  if (known != kWords.end()) {
    lens.model = known->first;
  } else if (!word.empty()) {
    reader.Fault("model", fmt::format("is {}; it must be \"equisolid\", \"kannala_brandt\", "
                                      "\"double_sphere\" or \"pinhole\"",
                                      nlohmann::json(word).dump()));
  }
}

void ReadSize(Reader& reader, const char* name, int& field) {
  double value = 0;
  reader.Number(name, value, kSize, Reader::kRequired);
  if (value != std::floor(value)) reader.Fault(name, "must be a whole number of pixels");
  field = static_cast<int>(value);
}

// Reads as many numbers as the model has. Missing ones are zeros for Kannala-Brandt only, because
// its short forms are in use.
void ReadParameters(Reader& reader, Lens& lens) {
  const int wanted = ParametersOf(lens.model);
  std::vector<double> values;
  if (reader.Has("k") && !reader.List("k", values)) return;
  const auto rest = values.begin() + std::min<std::ptrdiff_t>(wanted, std::ssize(values));
  if (std::any_of(rest, values.end(), [](double value) { return value != 0; }))
    return reader.Fault(
        "k", fmt::format("has {} numbers; {} has {}", values.size(), ToString(lens.model), wanted));
  values.erase(rest, values.end());
  if (lens.model == LensModel::kDoubleSphere) {
    if (values.size() != 2)
      return reader.Fault("k", "must be the double sphere's two numbers [xi, alpha]");
    if (!(values[0] > -1 && values[0] <= 1 && values[1] >= 0 && values[1] <= 1))
      return reader.Fault("k", fmt::format("is [{}, {}]; xi must be more than -1 and at most 1, "
                                           "alpha between 0 and 1",
                                           values[0], values[1]));
  }
  std::copy(values.begin(), values.end(), lens.k.begin());
}

void ReadCircle(Reader& owner, LensCircle& circle) {
  owner.Object("circle", Reader::kOptional, [&](Reader& reader) {
    reader.Number("cx", circle.cx, kPixel, Reader::kRequired);
    reader.Number("cy", circle.cy, kPixel, Reader::kRequired);
    reader.Number("r", circle.r, kRadius, Reader::kRequired);
  });
}

// Reads the fields that Visit lists, each a number within its range.
struct CameraReader {
  Reader& reader;
  void operator()(const char* name, double& field, const Range& range, const char* unit,
                  const char*) {
    reader.Number(name, field, {range.min, range.max, unit, range.above_min});
  }
};

nlohmann::ordered_json JsonOf(LensCamera camera) {
  nlohmann::ordered_json json;
  camera.Visit([&](const char* name, const double& field, const auto&...) { json[name] = field; });
  return json;
}

}  // namespace

void ReadCamera(JsonObjectReader& owner, LensCamera& camera) {
  owner.Object("camera", Reader::kOptional, [&](Reader& reader) {
    camera.Visit(CameraReader{reader});
    reader.RefuseOtherKeys();
  });
}

std::string_view ToString(LensModel model) {
  for (const auto& [value, word] : kWords)
    if (value == model) return word;
  return "";
}

Lens LensFromJson(const std::string& text, const std::filesystem::path& file) {
  const nlohmann::json json = ParseJson(text, Code::kBadData, file);
  if (!json.is_object())
    throw Error(Code::kBadData, "a lens must be a JSON object {…}; make it with `arthroscene lens`",
                file);
  std::vector<JsonFault> faults;
  Reader reader(json, "", faults);
  Lens lens;
  ReadSchema(reader);
  ReadModel(reader, lens);
  ReadSize(reader, "width", lens.width);
  ReadSize(reader, "height", lens.height);
  reader.Number("focal_px", lens.focal_px, kFocal, Reader::kRequired);
  reader.Number("cx", lens.cx, kPixel, Reader::kRequired);
  reader.Number("cy", lens.cy, kPixel, Reader::kRequired);
  reader.Number("aspect", lens.aspect, kAspect);
  ReadParameters(reader, lens);
  reader.Angle("fov_deg", lens.field_of_view, kFieldOfView);
  ReadCircle(reader, lens.circle);
  reader.Number("rms_px", lens.rms_px, kRadius);
  ReadCamera(reader, lens.camera);
  reader.RefuseOtherKeys(true);
  if (faults.empty() && lens.circle.r == 0) lens.circle = {};
  if (faults.empty() && lens.circle.r > 0 &&
      !(lens.circle.cx >= 0 && lens.circle.cx <= lens.width && lens.circle.cy >= 0 &&
        lens.circle.cy <= lens.height))
    faults.push_back(
        {"circle",
         fmt::format("circle's middle ({}, {}) lies outside of the picture of {} x {}; is "
                     "this lens of footage of another size?",
                     lens.circle.cx, lens.circle.cy, lens.width, lens.height)});
  if (faults.empty() && lens.field_of_view == 0) {
    const auto whole = FieldOfViewOf(lens);
    if (whole)
      lens.field_of_view = *whole;
    else
      faults.push_back({"fov_deg",
                        "fov_deg is missing, and the model ends before the picture does; "
                        "give fov_deg or the circle that the lens shows"});
  }
  if (faults.empty()) return lens;
  // A file of another kind breaks nearly every rule; its kind alone says what to do.
  constexpr std::size_t kMostNamed = 3;
  const std::string schema = json.value("schema", nlohmann::json()).dump();
  const bool is_lens = !json.contains("schema") || schema.starts_with("\"arthroscene.lens/");
  if (!is_lens || !json.contains("model"))
    throw Error(Code::kBadData,
                fmt::format("this is no lens file, since its {}; give a file of `arthroscene lens`",
                            is_lens ? "model is missing"
                                    : fmt::format("schema is {}, not \"{}\"", schema, kSchema)),
                file);
  std::string sentence;
  for (std::size_t i = 0; i < std::min(kMostNamed, faults.size()); ++i)
    sentence += (i == 0 ? "" : "; ") + faults[i].sentence;
  if (faults.size() > kMostNamed)
    sentence += fmt::format(" (and {} more)", faults.size() - kMostNamed);
  throw Error(Code::kBadData, sentence, file);
}

Lens ReadLens(const std::filesystem::path& file) {
  return LensFromJson(ReadWholeFile(file, kMostJsonBytes), file);
}

std::string JsonFromLens(const Lens& lens) {
  nlohmann::ordered_json json;
  json["schema"] = kSchema;
  json["model"] = ToString(lens.model);
  json["width"] = lens.width;
  json["height"] = lens.height;
  json["focal_px"] = lens.focal_px;
  json["cx"] = lens.cx;
  json["cy"] = lens.cy;
  json["aspect"] = lens.aspect;
  json["k"] = std::vector<double>(lens.k.begin(), lens.k.begin() + ParametersOf(lens.model));
  json["fov_deg"] = DegreesFromRadians(lens.field_of_view);
  json["circle"] = {{"cx", lens.circle.cx}, {"cy", lens.circle.cy}, {"r", lens.circle.r}};
  json["rms_px"] = lens.rms_px;
  if (lens.camera != LensCamera()) json["camera"] = JsonOf(lens.camera);
  return json.dump(2) + "\n";
}

void WriteLens(const std::filesystem::path& file, const Lens& lens) {
  WriteAtomically(file, JsonFromLens(lens));
}

}  // namespace arthro
