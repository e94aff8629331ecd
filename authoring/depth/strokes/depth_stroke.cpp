#include "authoring/depth/strokes/depth_stroke.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace arthro::authoring {
namespace {

// Word of an enum field as its Visit lists it.
struct WordFinder {
  StrokeKind kind;
  const char* word = "";
  template <class T, class Rule>
  void operator()(const char*, T&, const Rule& rule, const char*, const char*) {
    if constexpr (std::is_same_v<T, StrokeKind>)
      for (const auto& [value, its_word] : rule.words)
        if (value == kind) word = its_word;
  }
};

}  // namespace

double StrokeWeight(const DepthStroke& stroke, double share) {
  if (share <= stroke.hardness) return 1;
  if (share >= 1) return 0;
  const double s = (share - stroke.hardness) / (1 - stroke.hardness);
  switch (stroke.falloff) {
    case StrokeFalloff::kLinear:
      return 1 - s;
    case StrokeFalloff::kRound:
      return std::sqrt(1 - s * s);
    case StrokeFalloff::kSmooth:
      break;
  }
  return 1 - s * s * (3 - 2 * s);
}

SharedStrokes WithStroke(const SharedStrokes& strokes, DepthStroke stroke) {
  DepthStrokes all = strokes ? *strokes : DepthStrokes();
  all.push_back(std::move(stroke));
  return std::make_shared<const DepthStrokes>(std::move(all));
}

bool IsMask(const DepthStroke& stroke) {
  return stroke.kind == StrokeKind::kMask || stroke.kind == StrokeKind::kKeep;
}

const char* ToString(StrokeKind kind) {
  WordFinder finder{kind};
  DepthStroke().Visit(finder);
  return finder.word;
}

}  // namespace arthro::authoring
