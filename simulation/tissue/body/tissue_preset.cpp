#include "simulation/tissue/body/tissue_preset.h"

#include <algorithm>
#include <map>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "simulation/core/error.h"
#include "simulation/core/input_file.h"
#include "simulation/core/json_text.h"
#include "simulation/core/options_json.h"
#include "simulation/scene/json/field_json.h"

namespace arthro::simulation {
namespace {

constexpr const char* kSchema = "arthroscene.tissue_preset/1";

struct FibreAxisFinder {
  const std::string& word;
  FibreAxis axis = FibreAxis::kNone;
  template <class T, class R>
  void operator()(const char*, T&, const R& range, const char*, const char*) {
    if constexpr (std::is_same_v<T, FibreAxis>)
      for (const auto& [value, name] : range.words)
        if (word == name) axis = value;
  }
};

}  // namespace

TissuePreset ReadTissuePreset(const std::filesystem::path& file) {
  nlohmann::json json = ParseJson(ReadWholeFile(file, kMostJsonBytes), Code::kBadData, file);
  if (!json.is_object())
    throw Error(Code::kBadData, "a tissue preset must be a JSON object {…}; mend or remove it",
                file);
  std::vector<JsonFault> faults;
  JsonObjectReader reader(json, "", faults);
  TissuePreset preset;
  preset.name = file.stem().string();
  std::string schema;
  reader.Text("schema", schema, JsonObjectReader::kRequired);
  reader.Text("title", preset.title, JsonObjectReader::kRequired);
  reader.Texts("words", preset.words);
  // The material is read through its own list of fields, which also refuses unknown ones.
  reader.Object("material", JsonObjectReader::kRequired, [&](JsonObjectReader& inner) {
    for (const auto& [key, value] : json["material"].items()) inner.Know(key);
  });
  reader.Flag("is_thin", preset.is_thin);
  reader.Number("layer_thickness", preset.layer_thickness, {0, 0.05, "metres", true});
  reader.Number("friction", preset.friction, {0, 2});
  reader.Object("look", JsonObjectReader::kOptional, [&](JsonObjectReader& inner) {
    preset.look.emplace().Visit(FieldReader(inner));
    inner.RefuseOtherKeys();
  });
  reader.Text("probing", preset.probing, JsonObjectReader::kRequired);
  reader.Texts("sources", preset.sources);
  reader.RefuseOtherKeys();
  if (schema != kSchema && !schema.empty())
    reader.Fault("schema", fmt::format("must be \"{}\"", kSchema));
  if (preset.is_thin && !reader.Has("layer_thickness"))
    reader.Fault("layer_thickness", "is missing; a thin layer needs one");
  if (preset.sources.empty() && faults.empty())
    reader.Fault("sources", "is empty; say where the values come from");
  if (!faults.empty()) throw Error(Code::kBadData, faults.front().sentence, file);
  preset.material = OptionsFromJson<Material>(json["material"], file);
  return preset;
}

std::vector<TissuePreset> ReadTissuePresets(const std::filesystem::path& folder) {
  std::vector<TissuePreset> presets;
  std::error_code fault;
  for (const auto& entry : std::filesystem::directory_iterator(folder, fault))
    if (entry.path().extension() == ".json") presets.push_back(ReadTissuePreset(entry.path()));
  if (fault) throw Error(Code::kFile, "this folder of tissue presets cannot be read", folder);
  std::sort(presets.begin(), presets.end(),
            [](const TissuePreset& a, const TissuePreset& b) { return a.name < b.name; });
  std::map<std::string, std::string> taken;
  for (const TissuePreset& preset : presets) taken[preset.name] = preset.name;
  for (const TissuePreset& preset : presets)
    for (const std::string& word : preset.words)
      if (const auto [entry, is_new] = taken.emplace(word, preset.name); !is_new)
        throw Error(Code::kBadData,
                    fmt::format("\"{}\" stands for both {} and {}; take it from one of them", word,
                                entry->second, preset.name),
                    folder);
  return presets;
}

const TissuePreset* FindTissuePreset(const std::vector<TissuePreset>& presets,
                                     const std::string& word) {
  for (const TissuePreset& preset : presets)
    if (preset.name == word || std::count(preset.words.begin(), preset.words.end(), word) > 0)
      return &preset;
  return nullptr;
}

TissuePreset FindTissuePreset(const std::filesystem::path& folder, const std::string& word) {
  const std::vector<TissuePreset> presets = ReadTissuePresets(folder);
  if (const TissuePreset* preset = FindTissuePreset(presets, word)) return *preset;
  std::string names;
  for (const TissuePreset& preset : presets) names += (names.empty() ? "" : ", ") + preset.name;
  throw Error(Code::kBadData,
              fmt::format("there is no tissue preset \"{}\"; there are: {}", word, names), folder);
}

bool IsThinLayer(const Tissue& tissue, const std::vector<TissuePreset>& presets) {
  if (!tissue.mesh.empty() || tissue.is_implicit) return false;
  const TissuePreset* found = FindTissuePreset(presets, tissue.material);
  return found != nullptr && found->is_thin;
}

std::vector<TissueLook> LooksOf(std::span<const Tissue> tissues,
                                const std::vector<TissuePreset>& presets) {
  std::vector<TissueLook> looks;
  for (const Tissue& tissue : tissues) {
    const TissuePreset* found = FindTissuePreset(presets, tissue.material);
    looks.push_back(found != nullptr && found->look ? *found->look : TissueLook{});
  }
  return looks;
}

TissuePreset WithElasticity(TissuePreset preset, const Elasticity& elasticity) {
  Material& material = preset.material;
  material.young_modulus = elasticity.young_modulus.value_or(material.young_modulus);
  material.poisson_ratio = elasticity.poisson_ratio.value_or(material.poisson_ratio);
  material.density = elasticity.density.value_or(material.density);
  material.fibre_stiffness = elasticity.fibre_stiffness.value_or(material.fibre_stiffness);
  if (!elasticity.fibre_axis.empty()) {
    FibreAxisFinder finder{elasticity.fibre_axis};
    Material words;
    words.Visit(finder);
    material.fibre_axis = finder.axis;
  }
  preset.layer_thickness = elasticity.layer_thickness.value_or(preset.layer_thickness);
  return preset;
}

}  // namespace arthro::simulation
