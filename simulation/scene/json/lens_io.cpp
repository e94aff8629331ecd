#include "simulation/scene/json/lens_io.h"

#include <algorithm>
#include <array>
#include <numbers>
#include <vector>

#include <fmt/format.h>

#include "simulation/core/atomic_file.h"
#include "simulation/core/error.h"
#include "simulation/core/input_file.h"
#include "simulation/core/json_text.h"
#include "simulation/core/units.h"
#include "simulation/scene/json/field_json.h"
#include "simulation/scene/json/field_schema.h"
#include "simulation/scene/json/scene_json.h"

namespace arthro {
namespace {

constexpr const char* kLensSchema = "arthroscene.lens/1";

const Choices<LensModel>& Models() {
  static const Choices<LensModel> models{{{LensModel::kEquisolid, "equisolid"},
                                          {LensModel::kKannalaBrandt, "kannala_brandt"},
                                          {LensModel::kDoubleSphere, "double_sphere"},
                                          {LensModel::kPinhole, "pinhole"}}};
  return models;
}

// The fields of a lens file: name, rule, unit, help. `k` has as many numbers as the model.
struct LensInFile {
  Lens& lens;
  std::vector<double> k;
  template <class V>
  void Visit(V&& v) {
    constexpr Range kSize{1, 16384};  // the widest picture that is read
    constexpr Range kPixel{-1e5, 1e5};
    v("model", lens.model, Required{Models()}, "", "Where a ray falls.");
    v("width", lens.width, Required{kSize}, "px", "Width of the raw picture.");
    v("height", lens.height, Required{kSize}, "px", "Height of the raw picture.");
    v("focal_px", lens.focal_px, Required{Range{0, 1e6, true}}, "px", "Focal length f.");
    v("cx", lens.cx, Required{kPixel}, "px", "Column of the axis.");
    v("cy", lens.cy, Required{kPixel}, "px", "Row of the axis.");
    v("aspect", lens.aspect, Range{0.2, 5}, "", "Height of a pixel over its width.");
    v("k", k, NumberList{}, "",
      "Parameters of the model: up to 4 of kannala_brandt, [xi, alpha] of double_sphere, none of "
      "the others.");
    v("fov", lens.field_of_view, LeftOutAt{0.0, Range{0, 2 * std::numbers::pi, true}}, "rad",
      "Full field of view of the circle, or of the picture's diagonal. If not given, it is that of "
      "the model there.");
    v("circle", lens.circle, Any{}, "", "The round window.");
    v("rms_px", lens.rms_px, Range{0, 1e5}, "px", "Residual of the fit; 0: it was not fitted.");
    v("camera", lens.camera, LeftOutAt{LensCamera(), Any{}}, "",
      "What the optics and the sensor add to the picture.");
  }
};

int ParametersOf(LensModel model) {
  return model == LensModel::kKannalaBrandt ? 4 : model == LensModel::kDoubleSphere ? 2 : 0;
}

void ReadSchema(JsonObjectReader& reader) {
  std::string schema = kLensSchema;
  reader.Text("schema", schema);
  if (schema != kLensSchema)
    reader.Fault("schema", fmt::format("is {}; this program reads \"{}\"",
                                       nlohmann::json(schema).dump(), kLensSchema));
}

// Gives the model as many numbers as it has. Missing ones are zeros for Kannala-Brandt only,
// because its short forms are in use.
void SetParameters(JsonObjectReader& reader, std::vector<double> values, Lens& lens) {
  const int wanted = ParametersOf(lens.model);
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

}  // namespace

void ReadCamera(JsonObjectReader& owner, LensCamera& camera) {
  owner.Object("camera", JsonObjectReader::kOptional,
               [&](JsonObjectReader& reader) { camera.Visit(FieldReader(reader)); });
}

std::string_view ToString(LensModel model) {
  for (const auto& [value, word] : Models().words)
    if (value == model) return word;
  return "";
}

Lens LensFromJson(const std::string& text, const std::filesystem::path& file) {
  const nlohmann::json json = ParseJson(text, Code::kBadData, file);
  if (!json.is_object())
    throw Error(Code::kBadData, "a lens must be a JSON object {…}; make it with `arthroscene lens`",
                file);
  std::vector<JsonFault> faults;
  JsonObjectReader reader(json, "", faults);
  Lens lens;
  ReadSchema(reader);
  LensInFile fields{lens, {}};
  fields.Visit(FieldReader(reader));
  if (faults.empty()) SetParameters(reader, fields.k, lens);
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
                                    : fmt::format("schema is {}, not \"{}\"", schema, kLensSchema)),
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
  json["schema"] = kLensSchema;
  Lens copy = lens;
  LensInFile fields{copy, {lens.k.begin(), lens.k.begin() + ParametersOf(lens.model)}};
  fields.Visit(FieldWriter(json));
  return json.dump(2) + "\n";
}

std::string LensSchemaText() {
  Lens lens;
  auto json = FileSchema(
      kLensSchema, "Arthroscene lens, version 1",
      "The lens of an arthroscope: where a ray falls in the raw picture. px; angles in degrees. "
      "equisolid: r = 2 f sin(theta/2); kannala_brandt: r = f theta (1 + k0 theta^2 + k1 theta^4 + "
      "k2 theta^6 + k3 theta^8); double_sphere: k = [xi, alpha]; pinhole: r = f tan theta. r^2 = "
      "(x - cx)^2 + (aspect (y - cy))^2; the origin is the centre of the top-left pixel.",
      SchemaOfFields(LensInFile{lens, {}}));
  json["required"].erase(0);  // a person may leave out the name of the schema
  return PrettyJson(json);
}

void WriteLens(const std::filesystem::path& file, const Lens& lens) {
  WriteAtomically(file, JsonFromLens(lens));
}

}  // namespace arthro
