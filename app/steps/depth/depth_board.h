// The depth map of the scene, looked at and corrected over the panorama: where each depth comes
// from, how certain it is, distances, profiles, the scale of the scene and cells that are wrong.
// Plain values; points are pixels of the panorama.
#pragma once

#include <array>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <glm/vec2.hpp>

#include "app/state/editor_state.h"
#include "app/state/settings/picture_zoom.h"
#include "app/steps/depth/depth_brush.h"
#include "authoring/relief/editing/relief_profile.h"
#include "authoring/relief/editing/relief_view.h"

namespace arthro::app {

enum class MapLayer { kOrigin, kSigma, kRange, kShape, kMasks, kPicture };
enum class MapTool { kRead, kLength, kProfile, kBrush };
// Lengths that set the scale.
enum class LengthKind { kTissue, kInstrument };

struct PointPair {
  std::optional<glm::dvec2> from, to;
  bool is_complete() const { return from && to; }
  // The next point: the first one again once both are there.
  void Add(const glm::dvec2& point);
};

struct LengthPick {
  PointPair points;
  double metres = 0.01;
  bool is_given = false;  // it has set the scale, and another length must agree with it
};

// Colours of the map, for its legend.
struct MapLegend {
  struct Entry {
    unsigned colour;  // 0xAABBGGRR
    std::string words;
  };
  std::vector<Entry> entries;  // areas of one colour
  std::vector<unsigned> ramp;  // a continuous scale, from its low to its high end
  std::string low, high, ramp_words;
};

struct DepthBoard {
  bool is_shown = false;
  MapLayer layer = MapLayer::kOrigin;
  MapTool tool = MapTool::kRead;
  PictureZoom zoom;
  std::optional<glm::dvec2> read;
  PointPair profile;
  LengthKind kind = LengthKind::kTissue;
  LengthPick tissue{{}, 0.011, false}, instrument{{}, 0.0045, false};
  DepthBrush brush;
  bool compares = false;  // grey, filtered grey and relief beside the panorama

  LengthPick& length() { return kind == LengthKind::kTissue ? tissue : instrument; }
  const LengthPick& length() const { return kind == LengthKind::kTissue ? tissue : instrument; }

  // Picture of the panorama under the layer, and what it was drawn from.
  struct Drawn {
    std::shared_ptr<const ColourImage> picture;
    MapLegend legend;
    std::shared_ptr<const ColourImage> panorama;
    std::shared_ptr<const DepthMap> depth, sigma;
    std::shared_ptr<const OriginMap> origin;
    MapLayer layer = MapLayer::kPicture;
    double radius = 0;
    authoring::SharedStrokes strokes;
    authoring::DepthOptions options;
  } drawn;

  // The part of the picture that the stroke under way changes, and its place as shares of the
  // panorama's width and height.
  struct Patch {
    std::shared_ptr<const ColourImage> picture;
    glm::dvec2 low{0}, high{0};
    PixelBounds box;  // part of the coarse map
    MapLayer layer = MapLayer::kPicture;
    std::weak_ptr<const authoring::GrowingStroke> stroke;
    long version = 0;  // version of the brush
    int drawn = 0;     // pixels that the last change drew
  } patch;

  // Pictures beside the panorama, smaller than it.
  struct Compared {
    std::shared_ptr<const ColourImage> grey, filtered, relief;
    std::shared_ptr<const ColourImage> panorama;
    std::shared_ptr<const DepthMap> depth;
    authoring::DepthOptions options;
  } compared;
};

bool ShowsDepthBoard(const EditorState& state);

// ---- What the map says. ----
// The relief of the document, by reference.
authoring::ReliefView ReliefViewOf(const authoring::Document& document);
// Whether any depth of the document was measured.
bool HasMeasuredDepth(const authoring::Document& document);
// "41.3 ± 0.2 mm from the portal, measured".
std::string WordsOfReading(const authoring::Document& document,
                           const authoring::ReliefReading& reading);
std::string WordsOfOrigin(ReliefOrigin origin);
// Probability that a depth is within 1 mm of the tissue, from its standard error.
double ShareWithinOneMm(double sigma);
// Distance between two points as it is now, with its standard error: "9.3 ± 0.2 mm".
std::string WordsOfDistance(const authoring::Document& document, const PointPair& points);

// ---- What the author does. ----
void ClickDepth(EditorState& state, const glm::dvec2& pixel);  // uses the tool
bool CanSetScale(const EditorState& state);
// Scales the backdrop and its relief so that the given lengths are true. Throws
// Error(kBadArgument).
void SetScale(EditorState& state);
bool HasLengths(const EditorState& state);  // a point or a length
void ForgetLengths(EditorState& state);

// Redraws the map when its parts changed; points of another panorama are dropped. Once a frame.
void KeepDepthBoardFresh(EditorState& state);

}  // namespace arthro::app
