// What tissues are made of, by name: one JSON file each in resources/presets/tissues, with where
// every value comes from. A scene names a preset (Tissue::material) and may say single values
// otherwise (Tissue::elasticity). SI.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "simulation/scene/scene.h"
#include "simulation/tissue/fem/material.h"

namespace arthro::simulation {

struct TissuePreset {
  std::string name;                // of the file, without .json
  std::string title;               // for a person
  std::vector<std::string> words;  // other names that scenes use for it
  Material material;
  bool is_thin = false;              // a layer on bone, so thin that it needs no mesh
  double layer_thickness = 0;        // m; of a thin one
  double friction = 0.03;            // Coulomb, of an instrument on it in saline
  std::string probing;               // what a person should know of the forces it gives
  std::vector<std::string> sources;  // a line a value: what, how much, from where
};

// Above this an instrument does harm: "safe maximum" of 19 surgeons' probing (Tuijthof 2011,
// PMC3023859); they push with 2.8 ± 0.8 N. What a force meter marks.
constexpr double kSafeProbingForce = 8.5;  // N

// Throws Error(kBadData) that names the key at fault.
TissuePreset ReadTissuePreset(const std::filesystem::path& file);
// All of a folder, by name. Throws also where one word stands for two presets.
std::vector<TissuePreset> ReadTissuePresets(const std::filesystem::path& folder);

// The one of this name, or the one that has it among its words; nullptr: none.
const TissuePreset* FindTissuePreset(const std::vector<TissuePreset>& presets,
                                     const std::string& word);
// The same of a folder. Throws Error(kBadData) that lists the names that there are.
TissuePreset FindTissuePreset(const std::filesystem::path& folder, const std::string& word);

// Does this tissue give way as a thin layer: no tetrahedra, not implicit, of a thin preset?
bool IsThinLayer(const Tissue& tissue, const std::vector<TissuePreset>& presets);

// The preset with what the scene says otherwise.
TissuePreset WithElasticity(TissuePreset preset, const Elasticity& elasticity);

}  // namespace arthro::simulation
