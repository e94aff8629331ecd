// The library's list: each kind with its word on the command line, its title, and its options.
#pragma once

#include <span>
#include <string>
#include <variant>

#include "authoring/models/cartilage_model.h"
#include "authoring/models/library_model.h"
#include "authoring/models/meniscus_model.h"
#include "authoring/models/soft_parts.h"

namespace arthro::authoring {

enum class ModelKind {
  kMedialMeniscus,
  kLateralMeniscus,
  kMedialCondyle,
  kLateralCondyle,
  kMedialPlateau,
  kLateralPlateau,
  kPatella,
  kLooseBody,
  kSynovialTuft,
  kLigamentStump
};

struct ModelEntry {
  ModelKind kind;
  const char* word;   // "medial-meniscus"
  const char* title;  // "Medial meniscus"
};
std::span<const ModelEntry> ModelEntries();

using ModelOptions = std::variant<MeniscusOptions, CartilageOptions, LooseBodyOptions,
                                  SynovialTuftOptions, LigamentStumpOptions>;
ModelOptions DefaultOptionsOf(ModelKind kind);
bool IsMeniscus(ModelKind kind);

// Sizes of a knee: one standard deviation below the mean, the mean, or one above.
enum class KneeSize { kSmall, kAverage, kLarge };
ModelOptions OptionsOfSize(ModelKind kind, KneeSize size);

LibraryModel MakeModel(const ModelOptions& options, KneeSide side);

}  // namespace arthro::authoring
