// Tissue properties by name: one JSON file each in resources/presets/tissues, with the source of
// every value. A scene names a preset (Tissue::material) and may override single values
// (Tissue::elasticity). SI units.
#pragma once

#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "simulation/scene/scene.h"
#include "simulation/tissue/body/tissue_look.h"
#include "simulation/tissue/fem/material.h"

namespace arthro::simulation {

struct TissuePreset {
  std::string name;                // file name without .json
  std::string title;               // for display
  std::vector<std::string> words;  // other names that scenes use for it
  Material material;
  bool is_thin = false;              // layer on bone that is thin enough to need no mesh
  double layer_thickness = 0;        // m; for a thin tissue
  double friction = 0.03;            // Coulomb coefficient of an instrument on it in saline
  std::optional<TissueLook> look;    // absent: drawn without a structure
  std::string probing;               // note about the forces that it gives
  std::vector<std::string> sources;  // one line per value: quantity, value, source
};

// Force above which an instrument does harm: "safe maximum" of 19 surgeons' probing (Tuijthof 2011,
// PMC3023859); they push with 2.8 ± 0.8 N. Marked on force meters.
constexpr double kSafeProbingForce = 8.5;  // N

// Throws Error(kBadData) naming the wrong key.
TissuePreset ReadTissuePreset(const std::filesystem::path& file);
// Reads all presets of a folder, by name. Also throws if one word stands for two presets.
std::vector<TissuePreset> ReadTissuePresets(const std::filesystem::path& folder);

// Finds the preset with this name or this word; nullptr if there is none.
const TissuePreset* FindTissuePreset(const std::vector<TissuePreset>& presets,
                                     const std::string& word);
// Finds it in a folder. Throws Error(kBadData) listing the available names.
TissuePreset FindTissuePreset(const std::filesystem::path& folder, const std::string& word);

// Returns whether the tissue deforms as a thin layer: no tetrahedra, not implicit, and a thin
// preset.
bool IsThinLayer(const Tissue& tissue, const std::vector<TissuePreset>& presets);

// Returns the look of each tissue by its preset; a plain one where there is none.
std::vector<TissueLook> LooksOf(std::span<const Tissue> tissues,
                                const std::vector<TissuePreset>& presets);

// Returns the preset with the overrides of the scene.
TissuePreset WithElasticity(TissuePreset preset, const Elasticity& elasticity);

}  // namespace arthro::simulation
