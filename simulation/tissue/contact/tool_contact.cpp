#include "simulation/tissue/contact/tool_contact.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <Eigen/Eigenvalues>
#include <glm/geometric.hpp>

namespace arthro::simulation {
namespace {

constexpr double kPieceLength = 1.5e-3;  // m, the diameter of a probe's rod

// How far from the nearest touch a piece still bears a part of the force: the resolution of the
// tool's shape as the tissue feels it.
constexpr double kLayer = 2e-4;  // m

// A share goes this part of the way to its new value in a step: at full speed the shares of
// neighbours, which answer to what the tissue did under the last ones, would swing.
constexpr double kShareGain = 0.2;
constexpr double kLeastShare = 1e-3;

// So do the places and normals of pieces, and the offset across them. A tool that goes on takes
// them sooner: what it touches is another place.
constexpr double kTurnGain = 0.2;
constexpr double kTurnsWithin = 2e-3;  // m

constexpr int kMaxAdvances = 16;       // of the sweep; each goes as far as nothing can be met
constexpr double kArrived = 1e-5;      // m
constexpr double kLongestGrip = 0.02;  // m, 10 N; a tool further from its hand has slipped off

bool IsFinite(const glm::dvec3& x) noexcept { return std::isfinite(x.x + x.y + x.z); }

// The stiffness that unit springs along `normal`, times `weight`, have in their stiffest direction.
double Stiffest(std::span<const glm::dvec3> normal, std::span<const double> weight) noexcept {
  Eigen::Matrix3d sum = Eigen::Matrix3d::Zero();
  for (std::size_t i = 0; i < normal.size(); ++i) {
    const Eigen::Vector3d n(normal[i].x, normal[i].y, normal[i].z);
    sum += weight[i] * n * n.transpose();
  }
  Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver;
  solver.computeDirect(sum, Eigen::EigenvaluesOnly);
  return solver.eigenvalues()[2];
}

}  // namespace

SkinContact::SkinContact(const EmbeddedSkin& skin, const TetMesh& mesh, const SolidField& field)
    : skin_(&skin),
      field_(&field),
      finder_(mesh),
      positions_(skin.rest.vertices),
      normals_(skin.rest.vertices.size()) {
  DeformSkin(skin, mesh, mesh.rest_positions, positions_, normals_);
  std::vector<Box3> boxes(skin.rest.triangles.size());
  for (std::size_t i = 0; i < boxes.size(); ++i) boxes[i] = BoxOf(static_cast<int>(i));
  tree_ = BoxTree(boxes);
}

void SkinContact::Refit(std::span<const glm::dvec3> positions, std::span<const glm::dvec3> normals,
                        std::span<const glm::dvec3> x) noexcept {
  std::copy_n(positions.begin(), std::min(positions.size(), positions_.size()), positions_.begin());
  std::copy_n(normals.begin(), std::min(normals.size(), normals_.size()), normals_.begin());
  tree_.Refit([this](int i) noexcept { return BoxOf(i); });
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

// From where it was held the tool goes along with its hand, but not into what held it, and not
// through any skin: on a free stretch as far as the nearest skin is away, again and again.
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
  if (!(length > kArrived)) return start + way;
  // A tool that is in the tissue has no skin to be stopped by; it is found from inside.
  for (const Piece& piece : pieces)
    if (IsInside(0.5 * (piece.a + piece.b) + start)) return start + way;
  double gone = 0.0;
  for (int i = 0; i < kMaxAdvances && gone < length; ++i) {
    const double clear = Clearance(pieces, start + gone / length * way, length - gone);
    if (i == 0 && clear <= 0.0) return start + way;
    if (clear < kArrived) break;
    gone = std::min(length, gone + clear);
  }
  return start + gone / length * way;
}

void SkinContact::Find(std::span<const Capsule> capsules, const glm::dvec3& motion, int owner,
                       const ToolContactOptions& options, std::vector<ContactPoint>& contacts,
                       ToolGrip* grip) const noexcept {
  // The pieces that could touch, as the hand has them. A piece keeps its number whether or not it
  // could.
  std::array<Piece, kMaxPieces> pieces;
  std::array<int, kMaxPieces> number{};
  std::size_t count = 0;
  int next = 0;
  const double held = grip == nullptr ? 0.0 : glm::length(grip->offset) + glm::length(motion);
  if (tree_.empty() || !IsFinite(motion) || !std::isfinite(held)) {
    if (grip != nullptr) *grip = {};
    return;
  }
  for (const Capsule& capsule : capsules) {
    if (!IsFinite(capsule.a) || !IsFinite(capsule.b) || !(capsule.radius > 0.0)) continue;
    const glm::dvec3 way = capsule.b - capsule.a;
    const double parts = std::ceil(glm::length(way) / kPieceLength - 1e-6);
    const int split = static_cast<int>(std::clamp(parts, 1.0, double{kMaxPieces}));
    for (int i = 0; i < split && next < kMaxPieces; ++i, ++next) {
      const Piece piece{capsule.a + static_cast<double>(i) / split * way,
                        capsule.a + static_cast<double>(i + 1) / split * way, capsule.radius};
      const Box3 box{glm::min(piece.a, piece.b), glm::max(piece.a, piece.b)};
      const double reach = piece.radius + options.margin + held;
      if (Distance2(tree_.box(), box) > reach * reach) continue;
      pieces[count] = piece;
      number[count++] = next;
    }
  }
  const std::span<const Piece> near(pieces.data(), count);
  const glm::dvec3 offset = grip == nullptr ? glm::dvec3(0.0) : Follow(near, motion, *grip);

  const double turn = std::min(1.0, kTurnGain + glm::length(motion) / kTurnsWithin);

  // What each touches where the tissue holds it.
  std::array<Touch, kMaxPieces> touches;
  std::size_t touching = 0;
  double least_gap = std::numeric_limits<double>::max();
  for (std::size_t i = 0; i < count; ++i) {
    const Piece moved{pieces[i].a + offset, pieces[i].b + offset, pieces[i].radius};
    Touch touch;
    touch.piece = number[i];
    const auto p = static_cast<std::size_t>(number[i]);
    const bool is_known = grip != nullptr && grip->share[p] > 0.0;
    if (!TouchOf(moved, options.margin, is_known ? &grip->facing[p] : nullptr, turn, touch))
      continue;
    touch.weight = glm::length(moved.b - moved.a) + moved.radius;
    least_gap = std::min(least_gap, touch.gap);
    touches[touching++] = touch;
  }

  // Shares: the deeper, the more; none further off than a layer.
  std::array<double, kMaxPieces> share{};
  const double ground = std::max(least_gap, 0.0);
  std::size_t kept = 0;
  for (std::size_t i = 0; i < touching; ++i) {
    const auto piece = static_cast<std::size_t>(touches[i].piece);
    double& now = share[piece];
    now = touches[i].weight * std::max(0.0, kLayer - (touches[i].gap - ground)) / kLayer;
    if (grip != nullptr && grip->count > 0)
      now = grip->share[piece] + kShareGain * (now - grip->share[piece]);
    if (!(now > kLeastShare * touches[i].weight)) {
      now = 0.0;
      continue;
    }
    touches[kept] = touches[i];
    touches[kept++].weight = now;
  }

  // Neighbours are put together until they are few enough; the one that bears most speaks for them.
  const std::size_t groups = std::min(kept, static_cast<std::size_t>(kMaxToolContacts));
  std::array<glm::dvec3, kMaxToolContacts> normal{};
  std::array<double, kMaxToolContacts> weight{};
  std::array<const Touch*, kMaxToolContacts> speaker{};
  for (std::size_t g = 0; g < groups; ++g)
    for (std::size_t i = g * kept / groups; i < (g + 1) * kept / groups; ++i) {
      weight[g] += touches[i].weight;
      if (speaker[g] == nullptr || touches[i].weight > speaker[g]->weight) speaker[g] = &touches[i];
      normal[g] = speaker[g]->normal;
    }
  const double stiffest =
      groups > 0 ? Stiffest({normal.data(), groups}, {weight.data(), groups}) : 0.0;
  for (std::size_t g = 0; g < groups && stiffest > 0.0; ++g) {
    const Touch& touch = *speaker[g];
    ContactPoint contact;
    const std::span<const int> nodes = finder_.NodesOf(touch.point.element);
    contact.count = static_cast<int>(nodes.size());
    std::copy(nodes.begin(), nodes.end(), contact.node.begin());
    contact.weight = touch.point.weight;
    contact.normal = -touch.normal;
    contact.foot = touch.axis - offset - touch.radius * touch.normal;
    contact.stiffness = options.stiffness * weight[g] / stiffest;
    contact.friction = options.friction;
    contact.start = finder_.PlaceNow(touch.point) + motion;
    contact.owner = owner;
    contacts.push_back(contact);
  }
  if (grip == nullptr) return;
  *grip = {};
  grip->offset = offset;
  // A tool that is still being led out has nothing to hold on to: the next step looks anew.
  const auto is_led_out = [](const Touch& touch) noexcept { return touch.is_inside; };
  if (std::any_of(touches.begin(), touches.begin() + static_cast<std::ptrdiff_t>(kept), is_led_out))
    return;
  grip->share = share;
  for (std::size_t i = 0; i < kept; ++i)
    grip->facing[static_cast<std::size_t>(touches[i].piece)] = {touches[i].along,
                                                                touches[i].normal};
  grip->count = static_cast<int>(groups);
  grip->normal = normal;
}

void UpdateGrip(std::span<const ContactPoint> contacts, std::span<const ContactResult> results,
                int owner, const ToolContactOptions& options, ToolGrip& grip) noexcept {
  glm::dvec3 force(0.0), along(0.0);
  for (std::size_t i = 0; i < std::min(contacts.size(), results.size()); ++i) {
    if (contacts[i].owner != owner) continue;
    force -= results[i].force;
    along -= contacts[i].stiffness * contacts[i].normal;
  }
  const double length = glm::length(along);
  if (!IsFinite(force) || !(length > 0.0)) {
    grip.offset = glm::dvec3(0.0);
    return;
  }
  const glm::dvec3 change = force / options.stiffness - grip.offset;
  const glm::dvec3 up = glm::dot(change, along / length) * along / length;
  grip.offset += up + kTurnGain * (change - up);
}

}  // namespace arthro::simulation
