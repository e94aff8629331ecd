#include "simulation/tissue/contact/tool_contact.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <glm/geometric.hpp>

#include "simulation/core/finite.h"
#include "simulation/core/geometry/segment3.h"

namespace arthro::simulation {
namespace {

constexpr double kPieceLength = 1.5e-3;  // m, the diameter of a probe's rod

// Thickness of the tissue layer whose stiffness a contact has: a pressure equal to Young's modulus
// compresses it by this much.
constexpr double kLayer = 6e-5;  // m

// Distance of skin samples relative to the tool's radius. A round end that rests on two samples
// sinks between them by a sixteenth of that distance.
constexpr double kSampling = 0.5;
constexpr int kMostParts = 16;  // per edge of a triangle

// Distance from the held tool beyond which skin cannot reach it within a step. Dented skin follows
// a tool that leaves.
constexpr double kWatched = 3e-4;  // m
// The longest such distance of a tool that moved, at 0.36 m/s. After a jump of 30 mm a search of
// that width took ten times as long as the rest of the step.
constexpr double kLongestWatch = 6e-3;  // m

constexpr int kMaxAdvances = 16;       // per sweep; each goes as far as nothing can be met
constexpr double kSameDepth = 1e-5;    // m
constexpr double kLongestGrip = 0.02;  // m, 10 N; a tool further from its hand has slipped off
constexpr double kSameWay = 0.9;       // cosine; holding normals with a smaller angle count as one

}  // namespace

SkinContact::SkinContact(const EmbeddedSkin& skin, const TetMesh& mesh, const SolidField& field,
                         double modulus)
    : skin_(&skin),
      field_(&field),
      hardness_(modulus / kLayer),
      finder_(mesh),
      positions_(skin.rest.vertices),
      normals_(skin.rest.vertices.size()) {
  DeformSkin(skin, mesh, mesh.rest_positions, positions_, normals_);
  rest_normals_ = normals_;
  std::vector<Box3> boxes(skin.rest.triangles.size());
  for (std::size_t i = 0; i < boxes.size(); ++i) boxes[i] = BoxOf(static_cast<int>(i));
  tree_ = BoxTree(boxes);
  // Neighbouring triangles share corners, so each corner is listed once per leaf.
  for (int leaf = 0; leaf < tree_.leaf_count(); ++leaf) {
    leaf_begin_.push_back(static_cast<int>(leaf_vertex_.size()));
    for (const int t : tree_.LeafItems(leaf))
      for (const int v : skin.rest.triangles[static_cast<std::size_t>(t)])
        if (std::find(leaf_vertex_.begin() + leaf_begin_.back(), leaf_vertex_.end(), v) ==
            leaf_vertex_.end())
          leaf_vertex_.push_back(v);
  }
  leaf_begin_.push_back(static_cast<int>(leaf_vertex_.size()));
}

void SkinContact::Refit(std::span<const glm::dvec3> positions, std::span<const glm::dvec3> normals,
                        std::span<const glm::dvec3> x) noexcept {
  std::copy_n(positions.begin(), std::min(positions.size(), positions_.size()), positions_.begin());
  std::copy_n(normals.begin(), std::min(normals.size(), normals_.size()), normals_.begin());
  tree_.RefitLeaves([this](int leaf) noexcept {
    Box3 box{glm::dvec3(std::numeric_limits<double>::max()),
             glm::dvec3(std::numeric_limits<double>::lowest())};
    for (int k = leaf_begin_[static_cast<std::size_t>(leaf)];
         k < leaf_begin_[static_cast<std::size_t>(leaf) + 1]; ++k) {
      const glm::dvec3& place =
          positions_[static_cast<std::size_t>(leaf_vertex_[static_cast<std::size_t>(k)])];
      box = {glm::min(box.low, place), glm::max(box.high, place)};
    }
    return box;
  });
  finder_.Refit(x);
}

bool SkinContact::IsNear(std::span<const Capsule> capsules, double distance) const noexcept {
  if (tree_.empty()) return false;
  for (const Capsule& capsule : capsules) {
    const Box3 box{glm::min(capsule.a, capsule.b), glm::max(capsule.a, capsule.b)};
    const double reach = capsule.radius + distance;
    if (Distance2(tree_.box(), box) <= reach * reach) return true;
  }
  return false;
}

// Moves the held tool with its hand, but not into what held it and not through any skin. A free
// path is advanced repeatedly by the distance to the nearest skin.
glm::dvec3 SkinContact::Follow(std::span<const Piece> pieces, const glm::dvec3& motion,
                               const ToolGrip& grip) const noexcept {
  const glm::dvec3 start = grip.offset - motion;
  if (!(glm::length(start) < kLongestGrip)) return glm::dvec3(0.0);
  glm::dvec3 way = motion;
  for (int round = 0; round < 2; ++round)
    for (int i = 0; i < grip.count; ++i) {
      const glm::dvec3& normal = grip.normal[static_cast<std::size_t>(i)];
      way -= std::min(0.0, glm::dot(way, normal)) * normal;
    }
  const double length = glm::length(way);
  if (!(length > kSameDepth)) return start + way;
  // A tool inside the tissue is not stopped by skin; it is found from inside.
  for (const Piece& piece : pieces)
    if (IsInside(0.5 * (piece.a + piece.b) + start)) return start + way;
  double gone = 0.0;
  for (int i = 0; i < kMaxAdvances && gone < length; ++i) {
    const double clear = Clearance(pieces, start + gone / length * way, length - gone);
    if (i == 0 && clear <= 0.0) {
      gone = length;
      break;
    }
    if (clear < kSameDepth) break;
    gone = std::min(length, gone + clear);
  }
  // Avoids the wall of the tool's own dent; the solver finds its path from the previous position.
  glm::dvec3 end = start + gone / length * way;
  for (int halving = 0; halving < 2; ++halving) {
    bool is_in = false;
    for (const Piece& piece : pieces)
      for (const glm::dvec3& x : {piece.a, 0.5 * (piece.a + piece.b), piece.b})
        is_in = is_in || IsInside(x + end);
    if (!is_in) return end;
    end = 0.5 * (start + end);
  }
  return start;
}

void SkinContact::AddSamples(const Piece& piece, std::span<const Capsule> capsules, double margin,
                             std::span<Sample> samples, std::size_t& count) const noexcept {
  const Box3 box{glm::min(piece.a, piece.b), glm::max(piece.a, piece.b)};
  const double reach = piece.radius + margin;
  double limit2 = reach * reach;
  tree_.ForNear(box, limit2, [&](int t) noexcept {
    if (Distance2(BoxOf(t), box) > limit2) return;
    const TriangleCorners corner = Corners(t);
    const auto& [i, j, k] = skin_->rest.triangles[static_cast<std::size_t>(t)];
    const glm::dvec3 &a = skin_->rest.vertices[static_cast<std::size_t>(i)],
                     &b = skin_->rest.vertices[static_cast<std::size_t>(j)],
                     &c = skin_->rest.vertices[static_cast<std::size_t>(k)];
    const double longest =
        std::max({glm::distance(a, b), glm::distance(b, c), glm::distance(c, a)});
    const int parts = static_cast<int>(
        std::clamp(std::ceil(longest / (kSampling * piece.radius)), 1.0, double{kMostParts}));
    const double area = 0.5 * glm::length(glm::cross(b - a, c - a)) / (parts * parts);
    // Samples the centres of parts² equal triangles; a grid cell has one or two.
    for (int u = 0; u < parts; ++u)
      for (int v = 0; u + v < parts; ++v)
        for (int second = 0; second < (u + v + 1 < parts ? 2 : 1); ++second) {
          const double third = (1.0 + second) / 3.0;
          Sample sample{t, -1, {0, (u + third) / parts, (v + third) / parts}, margin, area};
          sample.at.x = 1.0 - sample.at.y - sample.at.z;
          const glm::dvec3 x =
              sample.at.x * corner[0] + sample.at.y * corner[1] + sample.at.z * corner[2];
          double where = 0;
          glm::dvec3 away(0.0);
          for (std::size_t n = 0; n < capsules.size(); ++n) {
            const Capsule& capsule = capsules[n];
            const glm::dvec3 way = capsule.b - capsule.a;
            const double length2 = glm::dot(way, way);
            const double along =
                length2 > 0 ? std::clamp(glm::dot(x - capsule.a, way) / length2, 0.0, 1.0) : 0.0;
            const glm::dvec3 from = x - capsule.a - along * way;
            const double gap = glm::length(from) - capsule.radius;
            if (!(gap < sample.gap)) continue;
            sample.gap = gap;
            sample.capsule = static_cast<int>(n);
            where = along;
            away = from;
          }
          const bool is_mine = sample.capsule == piece.capsule && where >= piece.from &&
                               (where < piece.to || piece.to == 1.0);
          // Skips the far skin of a thin tissue, which faces the other way.
          if (!is_mine || !(glm::dot(away, Blend({t, sample.at, 0}, normals_)) < 0.0)) continue;
          if (count < samples.size()) samples[count++] = sample;
        }
  });
}

ContactPoint SkinContact::ContactAt(const Sample& sample) const noexcept {
  const auto& triangle = skin_->rest.triangles[static_cast<std::size_t>(sample.triangle)];
  const std::array<int, 3> beside{skin_->point[static_cast<std::size_t>(triangle[0])].element,
                                  skin_->point[static_cast<std::size_t>(triangle[1])].element,
                                  skin_->point[static_cast<std::size_t>(triangle[2])].element};
  const OnSkin on{sample.triangle, sample.at, 0};
  EmbeddedPoint point;
  if (beside[0] == beside[1] && beside[0] == beside[2]) {
    point.element = beside[0];
    for (std::size_t corner = 0; corner < 3; ++corner)
      for (std::size_t k = 0; k < point.weight.size(); ++k)
        point.weight[k] += sample.at[static_cast<int>(corner)] *
                           skin_->point[static_cast<std::size_t>(triangle[corner])].weight[k];
  } else {
    point = finder_.FindAmong(Blend(on, skin_->rest.vertices), beside);
  }
  ContactPoint contact;
  if (point.element < 0) return contact;
  const std::span<const int> nodes = finder_.NodesOf(point.element);
  contact.count = static_cast<int>(nodes.size());
  std::copy(nodes.begin(), nodes.end(), contact.node.begin());
  contact.weight = point.weight;
  contact.normal = -glm::normalize(Blend(on, normals_));
  contact.is_round = true;
  contact.stiffness = hardness_ * sample.area;
  contact.start = finder_.PlaceNow(point);
  return contact;
}

void SkinContact::Find(std::span<const Capsule> capsules, const glm::dvec3& motion, int owner,
                       const ToolContactOptions& options, std::vector<ContactPoint>& contacts,
                       ToolGrip* grip) const noexcept {
  // Collects the pieces that could touch, at the commanded pose.
  std::array<Piece, kMaxPieces> pieces;
  std::size_t count = 0;
  int next = 0;
  const double held = grip == nullptr ? 0.0 : glm::length(grip->offset) + glm::length(motion);
  if (tree_.empty() || !IsFinite(motion) || !std::isfinite(held)) {
    if (grip != nullptr) *grip = {};
    return;
  }
  for (std::size_t n = 0; n < capsules.size(); ++n) {
    const Capsule& capsule = capsules[n];
    if (!IsFinite(capsule.a) || !IsFinite(capsule.b) || !(capsule.radius > 0.0)) continue;
    const glm::dvec3 way = capsule.b - capsule.a;
    const double parts = std::ceil(glm::length(way) / kPieceLength - 1e-6);
    const int split = static_cast<int>(std::clamp(parts, 1.0, double{kMaxPieces}));
    for (int i = 0; i < split && next < kMaxPieces; ++i, ++next) {
      const double from = static_cast<double>(i) / split, to = static_cast<double>(i + 1) / split;
      const Piece piece{capsule.a + from * way,
                        capsule.a + to * way,
                        capsule.radius,
                        static_cast<int>(n),
                        from,
                        to};
      const Box3 box{glm::min(piece.a, piece.b), glm::max(piece.a, piece.b)};
      const double reach = piece.radius + options.margin + held;
      if (Distance2(tree_.box(), box) <= reach * reach) pieces[count++] = piece;
    }
  }
  const std::span<const Piece> near(pieces.data(), count);
  const glm::dvec3 before = grip == nullptr ? glm::dvec3(0.0) : grip->offset;
  const glm::dvec3 offset = grip == nullptr ? glm::dvec3(0.0) : Follow(near, motion, *grip);
  if (grip != nullptr) *grip = {offset, 0, {}};

  std::array<Capsule, kMaxCapsules> moved;
  const std::span<Capsule> placed(moved.data(), std::min(capsules.size(), moved.size()));
  for (std::size_t n = 0; n < placed.size(); ++n)
    placed[n] = {capsules[n].a + offset, capsules[n].b + offset, capsules[n].radius};
  const auto add = [&](ContactPoint contact) noexcept {
    if (contact.count == 0) return;
    contact.friction = options.friction;
    contact.start += motion - before;
    contact.owner = owner;
    contact.hold = options.stiffness;
    contact.offset = offset;
    contacts.push_back(contact);
  };

  const double gone = grip == nullptr ? 0.0 : glm::length(motion + offset - before);
  const double watched =
      kWatched +
      std::min(std::max(gone, std::min(glm::length(motion), options.margin)), kLongestWatch);
  // A piece inside the tissue is pushed out; others keep the skin out of the capsules.
  std::array<Sample, kMaxSamples> samples;
  std::size_t found = 0;
  for (Piece piece : near) {
    piece.a += offset, piece.b += offset;
    Touch touch;
    if (!TouchFromInside(piece, touch)) {
      AddSamples(piece, placed, watched, samples, found);
      continue;
    }
    ContactPoint contact;
    const std::span<const int> nodes = finder_.NodesOf(touch.point.element);
    contact.count = static_cast<int>(nodes.size());
    std::copy(nodes.begin(), nodes.end(), contact.node.begin());
    contact.weight = touch.point.weight;
    contact.normal = -touch.normal;
    contact.foot = touch.axis - offset - piece.radius * touch.normal;
    contact.stiffness =
        hardness_ * 2.0 * piece.radius * (glm::distance(piece.a, piece.b) + piece.radius);
    contact.start = finder_.PlaceNow(touch.point);
    add(contact);
  }
  // Keeps the nearest contacts if there are more than kMaxToolContacts; ties are broken by triangle
  // index.
  const auto by_gap = [](const Sample& a, const Sample& b) noexcept {
    return a.gap != b.gap ? a.gap < b.gap : a.triangle < b.triangle;
  };
  if (found > kMaxToolContacts) {
    std::nth_element(samples.begin(), samples.begin() + kMaxToolContacts,
                     samples.begin() + static_cast<std::ptrdiff_t>(found), by_gap);
    found = kMaxToolContacts;
  }
  for (std::size_t i = 0; i < found; ++i) {
    const Sample& sample = samples[i];
    const Capsule& capsule = capsules[static_cast<std::size_t>(sample.capsule)];
    ContactPoint contact = ContactAt(sample);
    contact.a = capsule.a;
    contact.b = capsule.b;
    contact.radius = capsule.radius;
    add(contact);
  }
}

namespace {

// Returns the distance of a point to the nearest capsule; negative inside.
double GapTo(std::span<const Capsule> capsules, const glm::dvec3& x) noexcept {
  double gap = std::numeric_limits<double>::infinity();
  for (const Capsule& capsule : capsules)
    gap = std::min(
        gap, std::sqrt(Distance2(Segment3{x, x}, Segment3{capsule.a, capsule.b})) - capsule.radius);
  return gap;
}

}  // namespace

bool HasSlippedOff(std::span<const Capsule> capsules, std::span<const ContactPoint> contacts,
                   std::span<const ContactResult> results, int owner,
                   const ToolGrip& grip) noexcept {
  const std::size_t count = std::min(contacts.size(), results.size());
  double near = 0.0, away = 0.0;  // N
  for (std::size_t i = 0; i < count; ++i) {
    const double push = glm::length(results[i].push);
    if (contacts[i].owner != owner || !(push > 0.0)) continue;
    const double commanded = GapTo(capsules, results[i].point),
                 held = GapTo(capsules, results[i].point - grip.offset);
    (held > std::max(kLongestWatch, commanded) ? away : near) += push;
  }
  return away > near;
}

void UpdateGrip(std::span<const ContactPoint> contacts, std::span<const ContactResult> results,
                int owner, const ToolContactOptions& options, ToolGrip& grip) noexcept {
  const std::size_t count = std::min(contacts.size(), results.size());
  glm::dvec3 force(0.0);
  bool is_led_out = false;
  for (std::size_t i = 0; i < count; ++i) {
    if (contacts[i].owner != owner) continue;
    force -= results[i].force;
    is_led_out = is_led_out || (!contacts[i].is_round && results[i].gap < 0.0);
  }
  grip = {};
  if (!IsFinite(force)) return;
  grip.offset = force / options.stiffness;
  // A tool that is still being pushed out has no holding normals: the next step searches again.
  while (!is_led_out && grip.count < static_cast<int>(grip.normal.size())) {
    double most = 0.0;
    glm::dvec3 normal(0.0);
    for (std::size_t i = 0; i < count; ++i) {
      const double push = glm::length(results[i].push);
      if (contacts[i].owner != owner || !(push > most)) continue;
      const glm::dvec3 way = -results[i].push / push;
      bool is_new = true;
      for (int n = 0; n < grip.count; ++n)
        is_new = is_new && glm::dot(way, grip.normal[static_cast<std::size_t>(n)]) < kSameWay;
      if (!is_new) continue;
      most = push;
      normal = way;
    }
    if (!(most > 0.0)) break;
    grip.normal[static_cast<std::size_t>(grip.count++)] = normal;
  }
}

}  // namespace arthro::simulation
