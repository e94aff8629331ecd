#include "authoring/models/model_library.h"

#include <array>
#include <cmath>
#include <string_view>
#include <type_traits>

namespace arthro::authoring {
namespace {

constexpr std::array<ModelEntry, 10> kModelEntries = {
    {{ModelKind::kMedialMeniscus, "medial-meniscus", "Medial meniscus"},
     {ModelKind::kLateralMeniscus, "lateral-meniscus", "Lateral meniscus"},
     {ModelKind::kMedialCondyle, "medial-condyle", "Medial condyle cartilage"},
     {ModelKind::kLateralCondyle, "lateral-condyle", "Lateral condyle cartilage"},
     {ModelKind::kMedialPlateau, "medial-plateau", "Medial plateau cartilage"},
     {ModelKind::kLateralPlateau, "lateral-plateau", "Lateral plateau cartilage"},
     {ModelKind::kPatella, "patella", "Patellar cartilage"},
     {ModelKind::kLooseBody, "loose-body", "Loose body"},
     {ModelKind::kSynovialTuft, "synovial-tuft", "Synovial tuft"},
     {ModelKind::kLigamentStump, "ligament-stump", "Ligament stump"}}};

// Moves each length by some standard deviations. A range reaches two of them to either side of the
// mean; where its typical value is not in the middle, half of the way to the limit is taken.
struct SizeVisitor {
  double deviations;

  template <class T, class Rule>
  void operator()(const char*, T& field, const Rule& rule, const char* unit, const char*) const {
    if constexpr (std::is_same_v<T, double> && std::is_same_v<Rule, Range>) {
      if (std::string_view(unit) != "m") return;
      const double limit = deviations < 0 ? rule.min : rule.max;
      field += 0.5 * std::abs(deviations) * (limit - field);
    }
  }
};

}  // namespace

std::span<const ModelEntry> ModelEntries() { return kModelEntries; }

ModelOptions DefaultOptionsOf(ModelKind kind) {
  switch (kind) {
    case ModelKind::kMedialMeniscus:
      return MeniscusOptions(Compartment::kMedial);
    case ModelKind::kLateralMeniscus:
      return MeniscusOptions(Compartment::kLateral);
    case ModelKind::kMedialCondyle:
      return CartilageOptions(CartilageSite::kMedialCondyle);
    case ModelKind::kLateralCondyle:
      return CartilageOptions(CartilageSite::kLateralCondyle);
    case ModelKind::kMedialPlateau:
      return CartilageOptions(CartilageSite::kMedialPlateau);
    case ModelKind::kLateralPlateau:
      return CartilageOptions(CartilageSite::kLateralPlateau);
    case ModelKind::kPatella:
      return CartilageOptions(CartilageSite::kPatella);
    case ModelKind::kLooseBody:
      return LooseBodyOptions();
    case ModelKind::kSynovialTuft:
      return SynovialTuftOptions();
    case ModelKind::kLigamentStump:
      break;
  }
  return LigamentStumpOptions();
}

bool IsMeniscus(ModelKind kind) {
  return kind == ModelKind::kMedialMeniscus || kind == ModelKind::kLateralMeniscus;
}

ModelOptions OptionsOfSize(ModelKind kind, KneeSize size) {
  ModelOptions options = DefaultOptionsOf(kind);
  const double deviations = size == KneeSize::kSmall ? -1.0 : size == KneeSize::kLarge ? 1.0 : 0.0;
  std::visit([&](auto& chosen) { chosen.Visit(SizeVisitor{deviations}); }, options);
  return options;
}

LibraryModel MakeModel(const ModelOptions& options, KneeSide side) {
  struct Maker {
    KneeSide side;
    LibraryModel operator()(const MeniscusOptions& o) const { return MakeMeniscusModel(o, side); }
    LibraryModel operator()(const CartilageOptions& o) const { return MakeCartilageModel(o, side); }
    LibraryModel operator()(const LooseBodyOptions& o) const { return MakeLooseBody(o, side); }
    LibraryModel operator()(const SynovialTuftOptions& o) const {
      return MakeSynovialTuft(o, side);
    }
    LibraryModel operator()(const LigamentStumpOptions& o) const {
      return MakeLigamentStump(o, side);
    }
  };
  return std::visit(Maker{side}, options);
}

}  // namespace arthro::authoring
