#include "app/view/instruments/tool_mesh.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>

#include "app/view/instruments/loft_mesh.h"
#include "app/view/instruments/probe_mesh.h"

namespace arthro::app {
namespace {

using simulation::Capsule;
using simulation::ToolKind;
using simulation::ToolShape;

constexpr int kShaftSides = 20;

// ---- Jaws and what holds them ----

// Cross-section of a jaw: flat towards its partner, where its teeth are cut, and round behind
// `back`. For `facing` +1 the flat side faces +y.
Section JawSection(double z, double half_width, double flat, double back, double far, int facing) {
  constexpr int kFlat = 4, kArc = 12;
  Section section;
  const auto add = [&](double x, double y) { section.push_back({facing * x, facing * y, z}); };
  for (int i = 0; i <= kFlat; ++i) add(half_width * (1.0 - 2.0 * i / kFlat), flat);
  for (int i = 1; i < kArc; ++i) {
    const double a = std::numbers::pi * i / kArc;
    add(-half_width * std::cos(a), back - (back + far) * std::sin(a));
  }
  return section;
}
const std::vector<int> kJawCorners = {0, 4};

// Jaw along z from `base` to its rounded tip, with ridges across its flat side every `pitch`.
struct Jaw {
  double base, tip, half_width, far, pitch, tooth, first_tooth;
  int facing;
  double flat = 0.0;  // m in front of the plane of both jaws
};
void AddJaw(SurfaceMesh& mesh, const Jaw& jaw) {
  const double round = 0.9 * jaw.far;  // length of the rounded tip
  std::vector<Section> sections;
  LoftEdges edges{kJawCorners, {}};
  const auto add = [&](double z, double flat) {
    const double t = std::clamp((z - (jaw.tip - round)) / round, 0.0, 0.985);
    const double slim = std::sqrt(1.0 - t * t);
    const double wide = jaw.half_width * (0.35 + 0.65 * slim);
    sections.push_back(
        JawSection(z, wide, flat, std::min(jaw.flat, 0.0), jaw.far * slim, jaw.facing));
  };
  add(jaw.base, jaw.flat);
  const double last_tooth = jaw.tip - 0.35 * round - jaw.pitch;
  double z = jaw.first_tooth;
  for (; z < last_tooth; z += jaw.pitch) {
    edges.creases.push_back(static_cast<int>(sections.size()));
    add(z, jaw.flat);
    edges.creases.push_back(static_cast<int>(sections.size()));
    add(z + 0.65 * jaw.pitch, jaw.flat - jaw.tooth);
  }
  edges.creases.push_back(static_cast<int>(sections.size()));
  constexpr int kTip = 7;
  for (int i = 0; i <= kTip; ++i) {
    const double t = std::sin(0.5 * std::numbers::pi * i / kTip);
    add(z + (jaw.tip - z) * t, jaw.flat);
  }
  AddLoft(mesh, sections, edges);
}

// Plates with round ends on both sides of the jaws, and the pin through them.
void AddHinge(SurfaceMesh& mesh, double hinge, double inner, double outer, double low,
              double high) {
  for (const double side : {-1.0, 1.0}) {
    std::vector<Section> sections;
    const double from = side > 0 ? inner : -outer, to = side > 0 ? outer : -inner;
    const double middle = 0.5 * (low + high), half = 0.5 * (high - low);
    const auto add = [&](double z, double share) {
      const double a = middle - share * half, b = middle + share * half;
      sections.push_back({{from, a, z}, {to, a, z}, {to, b, z}, {from, b, z}});
    };
    add(hinge - 1.7e-3, 1.0);
    constexpr int kRound = 6;
    for (int i = 0; i <= kRound; ++i) {
      const double a = 0.5 * std::numbers::pi * i / kRound;
      add(hinge + half * std::sin(a), std::max(std::cos(a), 0.05));
    }
    AddLoft(mesh, sections, {{0, 1, 2, 3}, {}});
  }
  constexpr double kPin = 0.45e-3;  // m, its radius
  std::vector<Section> pin;
  for (const double x : {-outer - 0.08e-3, outer + 0.08e-3}) {
    Section ring;
    for (int i = 0; i < 12; ++i) {
      const double a = 2.0 * std::numbers::pi * i / 12;
      ring.push_back({x, 0.5 * (low + high) + kPin * std::cos(a), hinge + kPin * std::sin(a)});
    }
    pin.push_back(std::move(ring));
  }
  AddLoft(mesh, pin);
}

// Shaft that ends at z = end with a bevel.
void AddShaft(SurfaceMesh& mesh, double radius, double end, double length, double spacing) {
  constexpr double kBevel = 0.35e-3;
  std::vector<glm::dvec2> stations;
  for (const double z : ShaftStations(end - kBevel, length, spacing))
    stations.push_back({z, radius});
  const int edge = static_cast<int>(stations.size()) - 1;
  stations.push_back({end, radius - kBevel});
  AddRod(mesh, stations, kShaftSides, {edge});
}

void AddGrasper(ToolMesh& tool, const ToolShape& shape, double spacing, double length) {
  const Capsule& lower = shape.capsules.front();
  const double hinge = shape.hinge.z, far = 2.0 * lower.radius - 0.05e-3;
  AddShaft(tool.body, shape.capsules.back().radius, hinge - 1.3e-3, length, spacing);
  // Behind the axis of the jaws, so that it stays within the contact shape.
  AddHinge(tool.body, hinge - 0.9e-3, 0.75e-3, 1.15e-3, -0.85e-3, 0.85e-3);
  Jaw jaw{hinge - 1.4e-3, 0.0, 0.95e-3, far, 0.75e-3, 0.28e-3, hinge + 2.2e-3, 1};
  AddJaw(tool.body, jaw);
  jaw.facing = -1;
  jaw.base = hinge - 0.9e-3;
  jaw.first_tooth += 0.5 * jaw.pitch;
  AddJaw(tool.moving, jaw);
}

// Lower jaw: a frame, open below, bent from one bar along one rail, across in front of the tip, and
// back along the other. Its upper inner edges cut.
void AddFrame(SurfaceMesh& mesh, double base, double half_width, double bar) {
  constexpr double kLow = -1.1e-3, kHigh = -0.1e-3, kCorner = 0.47e-3;
  const double x = half_width - bar, front = -bar;
  std::vector<Section> sections;
  const auto add = [&](double px, double pz, double angle) {
    // Angle from +z towards +x; to its right, seen from above, is the inside.
    const glm::dvec3 across(std::cos(angle), 0.0, -std::sin(angle));
    const glm::dvec3 place(px, 0.0, pz), up(0, 1, 0);
    Section section;
    for (const auto& [s, y] : {std::pair{0.5, kLow},
                               {1.0, 0.7 * kLow + 0.3 * kHigh},
                               {1.0, kHigh},
                               {-1.0, kHigh},
                               {-1.0, 0.7 * kLow + 0.3 * kHigh},
                               {-0.5, kLow}})
      section.push_back(place + s * bar * across + y * up);
    sections.push_back(std::move(section));
  };
  constexpr int kRail = 6, kBend = 6;
  const double bend_z = front - kCorner, bend_x = x - kCorner, right = 0.5 * std::numbers::pi;
  for (int i = 0; i < kRail; ++i) add(-x, base + (bend_z - base) * i / kRail, 0.0);
  for (int i = 0; i <= kBend; ++i) {
    const double a = right * i / kBend;
    add(-bend_x - kCorner * std::cos(a), bend_z + kCorner * std::sin(a), a);
  }
  for (int i = 0; i <= kBend; ++i) {
    const double a = right * i / kBend;
    add(bend_x + kCorner * std::sin(a), bend_z + kCorner * std::cos(a), right + a);
  }
  for (int i = kRail - 1; i >= 0; --i) add(x, base + (bend_z - base) * i / kRail, 2.0 * right);
  AddLoft(mesh, sections, {{2, 3}, {}});
}

void AddPunch(ToolMesh& tool, const ToolShape& shape, double spacing, double length) {
  const double width = shape.capsules.back().radius, bar = 0.45e-3, hinge = shape.hinge.z;
  AddShaft(tool.body, width, hinge - 1.4e-3, length, spacing);
  AddFrame(tool.body, hinge - 1.5e-3, width, bar);
  AddHinge(tool.body, hinge, 0.85e-3, 1.45e-3, -0.9e-3, 0.2e-3);
  // The tooth moves down between the rails, and ends behind the cross bar.
  const Capsule& tooth = shape.capsules[static_cast<std::size_t>(shape.jaw.front())];
  const double tip = tooth.b.z + tooth.radius, top = tooth.b.y + tooth.radius;
  AddJaw(tool.moving,
         {hinge - 0.9e-3, tip, 0.78e-3, top, 0.7e-3, 0.16e-3, hinge + 1.6e-3, -1, 0.08e-3});
}

// ---- The shaver ----

// Opening of a tube towards +y: from `low` to `high` along z, an oval of half width `half`. `teeth`
// is the share of it by which its edges recede on every other ring.
struct Window {
  double low, high, half, teeth;
};

// Tube with a closed, round end, a wall and a window with sharp edges.
void AddTube(SurfaceMesh& mesh, const Capsule& tube, double wall, const Window& window,
             double spacing) {
  constexpr int kAcross = 6, kRest = 12, kAround = kAcross + kRest;
  constexpr double kFine = 0.3e-3, kLeast = 0.25;  // m; rad, at a window's ends
  const double end = tube.b.z, radius = tube.radius;
  std::vector<double> along;
  for (const double z : ShaftStations(window.low - kFine, window.low - kFine - tube.a.z, spacing))
    along.push_back(z);
  for (double z = window.low; z < end; z += kFine) along.push_back(z);
  const int straight = static_cast<int>(along.size());
  constexpr int kDome = 7;
  for (int i = 0; i < kDome; ++i)
    along.push_back(end + radius * std::sin(0.5 * std::numbers::pi * i / kDome));
  const int rings = static_cast<int>(along.size());
  const int hollow =
      static_cast<int>(std::ranges::lower_bound(along, window.low - 1.5e-3) - along.begin());

  const auto is_open = [&](int r) {
    const auto at = static_cast<std::size_t>(r);
    return along[at] >= window.low - 1e-9 && r + 1 < rings && along[at + 1] <= window.high;
  };
  const auto place = [&](int r, int i, double of) {
    const double z = along[static_cast<std::size_t>(r)];
    const double t = std::abs(2.0 * (z - window.low) / (window.high - window.low) - 1.0);
    double half = t < 1.0 ? window.half * std::cbrt(1.0 - t * t * t) : 0.0;
    if (r % 2 == 1) half *= 1.0 - window.teeth;
    half = std::max(half, kLeast);
    const double a = i < kAcross ? half * (2.0 * i / kAcross - 1.0)
                                 : half + 2.0 * (std::numbers::pi - half) * (i - kAcross) / kRest;
    // The dome of the inner wall has the same centre.
    const double share = of / radius, dome = std::max(z - end, 0.0);
    const double out = of * std::sqrt(std::max(1.0 - dome * dome / (radius * radius), 0.0));
    return glm::dvec3(-out * std::sin(a), out * std::cos(a), r < straight ? z : end + share * dome);
  };
  const auto quad = [&](const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c,
                        const glm::dvec3& d) {
    const int first = static_cast<int>(mesh.vertices.size());
    mesh.vertices.insert(mesh.vertices.end(), {a, b, c, d});
    mesh.triangles.push_back({first, first + 1, first + 2});
    mesh.triangles.push_back({first, first + 2, first + 3});
  };
  const double inside = radius - wall;
  for (const bool is_outer : {true, false}) {
    // Hollow as far as one can see.
    const double of = is_outer ? radius : inside;
    const int begin = is_outer ? 0 : hollow;
    const int first = static_cast<int>(mesh.vertices.size()) - begin * kAround;
    for (int r = begin; r < rings; ++r)
      for (int i = 0; i < kAround; ++i) mesh.vertices.push_back(place(r, i, of));
    const auto add = [&](int a, int b, int c) {
      mesh.triangles.push_back(is_outer ? std::array{a, b, c} : std::array{b, a, c});
    };
    for (int r = begin; r + 1 < rings; ++r)
      for (int i = 0; i < kAround; ++i) {
        if (i < kAcross && is_open(r)) continue;
        const int a = first + r * kAround + i, b = first + r * kAround + (i + 1) % kAround;
        add(a, b, b + kAround);
        add(a, b + kAround, a + kAround);
      }
    const int pole = static_cast<int>(mesh.vertices.size());
    mesh.vertices.push_back({0, 0, end + of});
    for (int i = 0; i < kAround; ++i)
      add(first + (rings - 1) * kAround + i, first + (rings - 1) * kAround + (i + 1) % kAround,
          pole);
  }
  // Flat ends, and the wall around the window.
  for (const bool is_outer : {true, false}) {
    const int r = is_outer ? 0 : hollow, first = static_cast<int>(mesh.vertices.size());
    for (int i = 0; i < kAround; ++i)
      mesh.vertices.push_back(place(r, i, is_outer ? radius : inside));
    mesh.vertices.push_back({0, 0, along[static_cast<std::size_t>(r)]});
    for (int i = 0; i < kAround; ++i) {
      const int u = first + i, v = first + (i + 1) % kAround;
      mesh.triangles.push_back({is_outer ? v : u, is_outer ? u : v, first + kAround});
    }
  }
  for (int r = 0; r + 1 < rings; ++r) {
    if (!is_open(r)) continue;
    const auto edge = [&](int ra, int ia, int rb, int ib) {
      quad(place(ra, ia, radius), place(rb, ib, radius), place(rb, ib, inside),
           place(ra, ia, inside));
    };
    edge(r, kAcross, r + 1, kAcross);
    edge(r + 1, 0, r, 0);
    for (int i = 0; i < kAcross; ++i) {
      if (!is_open(r - 1)) edge(r, i, r, i + 1);
      if (!is_open(r + 1)) edge(r + 1, i + 1, r + 1, i);
    }
  }
}

// The window of the outer tube is where the contact shape removes tissue. The blade inside has a
// similar window with teeth, which cut as they pass.
void AddShaver(ToolMesh& tool, const ToolShape& shape, double spacing) {
  constexpr double kWall = 0.25e-3, kGap = 0.05e-3;  // m
  const Capsule& tube = shape.capsules.front();
  const Window window{shape.bite.a.z - 0.5e-3, shape.bite.b.z + 0.8e-3, 1.0, 0.0};
  AddTube(tool.body, tube, kWall, window, spacing);
  Capsule blade = tube;
  blade.radius = tube.radius - kWall - kGap;
  blade.a.z = window.low - 3e-3;  // no more of it is visible
  AddTube(tool.moving, blade, kWall, {window.low, window.high, window.half, 0.14}, spacing);
  tool.axis = {0, 0, 1};
  tool.turns_freely = true;
}

}  // namespace

ToolMesh MakeToolMesh(ToolKind kind, double ring_spacing, double shaft_length) {
  ToolMesh tool;
  if (kind == ToolKind::kNone) return tool;
  if (kind == ToolKind::kProbe) {
    ProbeShape probe;
    probe.ring_spacing = ring_spacing;
    probe.shaft_length = shaft_length;
    tool.body = MakeProbeMesh(probe);
    return tool;
  }
  ToolShape shape = simulation::ShapeOf(kind);
  for (Capsule& capsule : shape.capsules) capsule.a.z = std::max(capsule.a.z, -shaft_length);
  if (kind == ToolKind::kShaver) {
    AddShaver(tool, shape, ring_spacing);
    return tool;
  }
  if (kind == ToolKind::kPunch)
    AddPunch(tool, shape, ring_spacing, shaft_length);
  else
    AddGrasper(tool, shape, ring_spacing, shaft_length);
  tool.hinge = shape.hinge;
  tool.axis = shape.hinge_axis;
  tool.max_opening = shape.max_opening;
  return tool;
}

Pose MovingPart(const ToolMesh& mesh, double opening, double turn) {
  const double angle = mesh.turns_freely ? turn : std::clamp(opening, 0.0, 1.0) * mesh.max_opening;
  Pose pose;
  pose.quaternion = glm::angleAxis(angle, mesh.axis);
  pose.position = mesh.hinge - pose.quaternion * mesh.hinge;
  return pose;
}

}  // namespace arthro::app
