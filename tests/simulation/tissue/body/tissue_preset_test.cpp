#include "simulation/tissue/body/tissue_preset.h"

#include <array>
#include <filesystem>
#include <rapidjson/document.h>
#include <rapidjson/schema.h>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "simulation/core/atomic_file.h"
#include "simulation/core/error.h"
#include "tests/support/build_paths.h"
#include "tests/support/temp_folder.h"

namespace arthro::simulation {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

const fs::path kPresets = fs::path(ARTHRO_SOURCE_DIR) / "resources/presets/tissues";

bool IsInSchema(const std::string& text) {
  rapidjson::Document rules, preset;
  rules.Parse(
      ReadWholeFile(fs::path(ARTHRO_SOURCE_DIR) / "resources/schemas/tissue_preset-1.schema.json")
          .c_str());
  EXPECT_FALSE(rules.HasParseError());
  preset.Parse(text.c_str());
  const rapidjson::SchemaDocument schema(rules);
  rapidjson::SchemaValidator validator(schema);
  return preset.Accept(validator);
}

TEST(TissuePreset, MeniscusAndCartilageHaveAProbingAndALiteraturePreset) {
  const std::vector<TissuePreset> presets = ReadTissuePresets(kPresets);
  for (const char* name :
       {"meniscus-probe", "meniscus-literature", "cartilage-probe", "cartilage-literature"})
    ASSERT_NE(FindTissuePreset(presets, name), nullptr) << name;
  // The words used in existing scenes mean the probing presets.
  EXPECT_EQ(FindTissuePreset(kPresets, "meniscus").name, "meniscus-probe");
  EXPECT_EQ(FindTissuePreset(kPresets, "cartilage").name, "cartilage-probe");
  const Material& meniscus = FindTissuePreset(presets, "meniscus")->material;
  EXPECT_EQ(meniscus.young_modulus, 5e5);
  EXPECT_EQ(meniscus.fibre_stiffness, 2e7);
  EXPECT_EQ(meniscus.fibre_axis, FibreAxis::kCircumferentialZ);
  // 140 MPa along the fibres in total.
  const Material& stiff = FindTissuePreset(presets, "meniscus-literature")->material;
  EXPECT_EQ(stiff.young_modulus + stiff.fibre_stiffness, 1.4e8);
}

TEST(TissuePreset, LookIsReadAndMayBeLeftOut) {
  const std::vector<TissuePreset> presets = ReadTissuePresets(kPresets);
  ASSERT_TRUE(FindTissuePreset(presets, "meniscus")->look);
  EXPECT_EQ(FindTissuePreset(presets, "meniscus")->look->structure, TissueStructure::kFibres);
  EXPECT_EQ(FindTissuePreset(presets, "cartilage")->look->structure, TissueStructure::kHyaline);
  Tissue meniscus, other;
  other.material = "none of these";
  const std::vector<TissueLook> looks = LooksOf(std::array{meniscus, other}, presets);
  EXPECT_EQ(looks.at(0), *FindTissuePreset(presets, "meniscus")->look);
  EXPECT_EQ(looks.at(1), TissueLook{});

  const test::TempFolder folder;
  json preset = json::parse(ReadWholeFile(kPresets / "meniscus-probe.json"));
  const auto write = [&] {
    WriteAtomically(folder.path() / "own.json", preset.dump());
    return ReadTissuePreset(folder.path() / "own.json");
  };
  preset["look"] = {{"structure", "velvet"}};
  EXPECT_FALSE(IsInSchema(preset.dump()));
  EXPECT_THROW(write(), Error);
  preset["look"] = {{"fibres", 1.5}};
  EXPECT_FALSE(IsInSchema(preset.dump()));
  EXPECT_THROW(write(), Error);
  preset["look"] = {{"shine", 1}};
  EXPECT_FALSE(IsInSchema(preset.dump()));
  EXPECT_THROW(write(), Error);
  preset.erase("look");
  EXPECT_TRUE(IsInSchema(preset.dump()));
  EXPECT_FALSE(write().look);
}

TEST(TissuePreset, EveryValueHasASource) {
  for (const TissuePreset& preset : ReadTissuePresets(kPresets)) {
    EXPECT_TRUE(IsInSchema(ReadWholeFile(kPresets / (preset.name + ".json")))) << preset.name;
    std::vector<std::string> values = {"young_modulus", "poisson_ratio", "density", "friction"};
    if (preset.material.fibre_stiffness > 0) values.push_back("fibre_stiffness");
    if (preset.is_thin) values.push_back("layer_thickness");
    for (const std::string& value : values) {
      bool is_told = false;
      for (const std::string& line : preset.sources)
        is_told |= line.find(value) != std::string::npos;
      EXPECT_TRUE(is_told) << preset.name << " has no source for " << value;
    }
  }
}

// Compares each field of Material with its property in the schema.
struct SchemaComparison {
  const json& properties;
  int fields = 0;

  template <class T, class R>
  void operator()(const char* name, T&, const R& rule, const char*, const char*) {
    ++fields;
    const json property = properties.value(name, json::object());
    if constexpr (std::is_enum_v<T>) {
      json words = json::array();
      for (const auto& [value, word] : rule.words) words.push_back(word);
      EXPECT_EQ(property["enum"], words) << name;
    } else if constexpr (std::is_same_v<R, Range>) {
      EXPECT_EQ(property["minimum"], rule.min) << name;
      EXPECT_EQ(property["maximum"], rule.max) << name;
    } else {
      EXPECT_EQ(property["type"], "boolean") << name;
    }
  }
};

TEST(TissuePresetSchema, HasTheFieldsAndRangesOfMaterial) {
  const json schema = json::parse(
      ReadWholeFile(fs::path(ARTHRO_SOURCE_DIR) / "resources/schemas/tissue_preset-1.schema.json"));
  const json& properties = schema["properties"]["material"]["properties"];
  SchemaComparison comparison{properties};
  Material material;
  material.Visit(comparison);
  EXPECT_EQ(properties.size(), static_cast<std::size_t>(comparison.fields));
}

TEST(TissuePreset, OnlyCartilageIsAThinLayer) {
  for (const TissuePreset& preset : ReadTissuePresets(kPresets)) {
    EXPECT_EQ(preset.is_thin, preset.name.starts_with("cartilage")) << preset.name;
    EXPECT_EQ(preset.layer_thickness > 0, preset.is_thin) << preset.name;
  }
}

TEST(TissuePreset, UnknownWordIsRefusedWithTheKnownNames) {
  try {
    FindTissuePreset(kPresets, "jelly");
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), Code::kBadData);
    EXPECT_NE(error.sentence().find("cartilage-literature, cartilage-probe, ligament-probe, "),
              std::string::npos)
        << error.sentence();
  }
}

TEST(TissuePreset, SceneOverridesSingleValues) {
  Elasticity own;
  own.young_modulus = 3e5;
  own.fibre_axis = "none";
  const TissuePreset preset = FindTissuePreset(kPresets, "meniscus");
  const TissuePreset changed = WithElasticity(preset, own);
  EXPECT_EQ(changed.material.young_modulus, 3e5);
  EXPECT_EQ(changed.material.fibre_axis, FibreAxis::kNone);
  EXPECT_EQ(changed.material.poisson_ratio, preset.material.poisson_ratio);
  EXPECT_EQ(changed.material.fibre_stiffness, preset.material.fibre_stiffness);
  own = {};
  own.poisson_ratio = 0.3, own.density = 1000, own.fibre_stiffness = 1e6;
  own.fibre_axis = "circumferential_z", own.layer_thickness = 0.001;
  const TissuePreset other = WithElasticity(FindTissuePreset(kPresets, "cartilage"), own);
  EXPECT_EQ(other.material.poisson_ratio, 0.3);
  EXPECT_EQ(other.material.density, 1000);
  EXPECT_EQ(other.material.fibre_stiffness, 1e6);
  EXPECT_EQ(other.material.fibre_axis, FibreAxis::kCircumferentialZ);
  EXPECT_EQ(other.layer_thickness, 0.001);
}

TEST(TissuePreset, BadFilesAreRefusedWithTheWrongKey) {
  const json good = json::parse(ReadWholeFile(kPresets / "cartilage-probe.json"));
  const auto fault_of = [](const std::string& text) -> std::string {
    test::TempFolder folder;
    WriteAtomically(folder / "a.json", text);
    try {
      ReadTissuePreset(folder / "a.json");
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), Code::kBadData);
      return error.sentence();
    }
    return "";
  };
  EXPECT_EQ(fault_of(good.dump()), "");
  const struct {
    const char* pointer;
    json value;
    const char* says;
  } faults[] = {{"/schema", "arthroscene.tissue_preset/9", "schema"},
                {"/material/poisson_ratio", 0.5, "poisson_ratio"},
                {"/material/young_modulus", -1, "young_modulus"},
                {"/material/young_modulus", nullptr, "young_modulus"},
                {"/material/density", "heavy", "density"},
                {"/material/colour", 1, "colour"},
                {"/material", 7, "material"},
                {"/friction", -0.1, "friction"},
                {"/layer_thickness", 0, "layer_thickness"},
                {"/words", {""}, "words"},
                {"/sources", json::array(), "sources"},
                {"/titel", "x", "titel"}};
  for (const auto& fault : faults) {
    json bad = good;
    bad[json::json_pointer(fault.pointer)] = fault.value;
    EXPECT_NE(fault_of(bad.dump()).find(fault.says), std::string::npos) << fault.pointer;
    EXPECT_FALSE(IsInSchema(bad.dump())) << fault.pointer;
  }
  EXPECT_NE(fault_of("{").find("not JSON"), std::string::npos);
  EXPECT_NE(fault_of("[]").find("object"), std::string::npos);
  json thin = good;
  thin.erase("layer_thickness");
  EXPECT_NE(fault_of(thin.dump()).find("a thin layer needs one"), std::string::npos);
}

TEST(TissuePreset, OneWordForTwoPresetsIsRefused) {
  test::TempFolder folder;
  const std::string text = ReadWholeFile(kPresets / "meniscus-probe.json");
  WriteAtomically(folder / "a.json", text);
  WriteAtomically(folder / "b.json", text);
  EXPECT_THROW(ReadTissuePresets(folder.path()), Error);
}

}  // namespace
}  // namespace arthro::simulation
