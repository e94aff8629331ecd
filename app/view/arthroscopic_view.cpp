#include "app/view/arthroscopic_view.h"

#include <algorithm>
#include <chrono>
#include <cmath>

#include <glm/geometric.hpp>
#include <vtkCamera.h>
#include <vtkCullerCollection.h>
#include <vtkLight.h>
#include <vtkNew.h>
#include <vtkOpenGLFramebufferObject.h>
#include <vtkOpenGLState.h>
#include <vtkRenderer.h>
#include <vtkTextureObject.h>
#include <vtk_glew.h>

#include "app/view/backdrop/backdrop_prop.h"
#include "app/view/disturbances/lens_pass.h"
#include "app/view/drawing/lens_model.h"
#include "app/view/drawing/loose_body_model.h"
#include "app/view/drawing/occlusion_pass.h"
#include "app/view/drawing/passes/context_render_window.h"
#include "app/view/drawing/srgb.h"
#include "app/view/drawing/strand_model.h"
#include "app/view/exposure/camera_pass.h"
#include "app/view/instruments/probe_mesh.h"
#include "app/view/instruments/tool_mesh.h"
#include "app/view/instruments/tool_shade.h"
#include "app/view/shaders/constants.h"
#include "simulation/core/error.h"
#include "simulation/scene/medium.h"

namespace arthro::app {
namespace {

// Brightness that the brightest parts of the footage count as: a model of colour 1 is drawn like
// them.
constexpr double kWhite = 0.85;
// Share of the footage's own tint in the models' light.
constexpr double kTint = 0.6;

// Returns the lamp's colour as the footage shows it: that of its brightest parts, partly with their
// tint.
glm::dvec3 LightOf(const glm::dvec3& bright) {
  const double luma = Luma(bright);
  if (!(luma > 0.0)) return glm::dvec3(1.0);
  const double level = std::clamp(luma / kWhite, 0.25, 1.1);
  return level * (kTint * bright / luma + (1.0 - kTint));
}

glm::dvec3 MiddleOf(std::span<const glm::dvec3> points) {
  glm::dvec3 sum{0.0};
  for (const glm::dvec3& x : points) sum += x;
  return points.empty() ? sum : sum / static_cast<double>(points.size());
}

}  // namespace

struct ArthroscopicView::Parts {
  vtkNew<ContextRenderWindow> window;
  vtkNew<vtkRenderer> renderer;
  vtkNew<vtkLight> light;
  vtkNew<BackdropProp> backdrop;
  LensModel tool{LensModel::Look::kSteel}, moving{LensModel::Look::kSteel};
  simulation::ToolKind tool_kind = simulation::ToolKind::kNone;  // kind of these two
  ToolMesh tool_mesh;
  simulation::ToolShape tool_shape;
  std::vector<std::unique_ptr<LensModel>> tissues;  // and, behind them, the loose bodies
  std::vector<Ball> loose;
  std::vector<std::unique_ptr<StrandModel>> strands;  // one per tissue
  std::vector<std::size_t> vertex_counts;
  // Place of each tissue, and the light around it, computed on demand.
  struct Place {
    glm::dvec3 middle{0.0};  // in its own frame
    Pose pose;
    std::optional<FootageLight> about;
  };
  std::vector<Place> places;
  std::optional<std::array<glm::dvec3, 3>> slopes;  // change of the light along the portal's axes
  MeteredModels metered;
  OcclusionPass occlusion_pass;
  LensPass lens_pass;
  CameraPass camera_pass;
  bool is_disturbed = false;  // the last frame passed through lens_pass
  bool has_camera = false;    // and through camera_pass
  std::string notice;
  bool is_timed = false;
  PictureCost cost;        // while it is timed
  int size = 0, rays = 0;  // px of the last frame; rays per side that were drawn

  // Adds the time since `begin` to a stage, and begins the next one.
  void EndStage(double PictureCost::*stage, std::chrono::steady_clock::time_point& begin) {
    if (!is_timed) return;
    glFinish();
    const auto now = std::chrono::steady_clock::now();
    cost.*stage += std::chrono::duration<double>(now - begin).count();
    begin = now;
  }
  void AddTissue(const Tissue& tissue, const SurfaceMesh& surface,
                 const simulation::TissueLook& look);
  void RemoveTissues(std::size_t first);
  void AddLooseBodies();
  // Instruments come last, since they are drawn over what is behind them when close to the lens.
  void PutToolsLast();
  void TakeTool(simulation::ToolKind kind);
  void ShowTool(const Picture& picture, const LensFrame& frame);
  const FootageLight& LightAbout(std::size_t tissue);
  glm::dvec3 LightColourAt(std::size_t tissue);
  void MeterModels(const Picture& picture);
  std::array<glm::dvec3, 3> SlopesIn(const simulation::ScopeView& view);
  void ForgetLight() {
    slopes.reset();
    for (Place& place : places) place.about.reset();
  }
  vtkOpenGLFramebufferObject& drawn() const { return *window->GetRenderFramebuffer(); }
  vtkOpenGLFramebufferObject& finished() { return is_disturbed ? lens_pass.result() : drawn(); }
  vtkOpenGLFramebufferObject& shown() { return has_camera ? camera_pass.result() : finished(); }
};

const FootageLight& ArthroscopicView::Parts::LightAbout(std::size_t tissue) {
  Place& place = places[tissue];
  if (!place.about) {
    const glm::dvec3 middle = place.pose * place.middle;
    const double far = glm::length(middle);
    place.about = backdrop->LightAbout(far > 0 ? middle / far : glm::dvec3(0, 0, 1));
  }
  return *place.about;
}

// Returns the change of the surroundings' colour along the lens' axes, from that along the
// portal's: half the difference between opposite directions.
std::array<glm::dvec3, 3> ArthroscopicView::Parts::SlopesIn(const simulation::ScopeView& view) {
  if (!slopes) {
    slopes.emplace();
    for (int a = 0; a < 3; ++a) {
      glm::dvec3 axis(0.0);
      axis[a] = 1.0;
      (*slopes)[static_cast<std::size_t>(a)] =
          0.5 * (backdrop->LightAbout(axis).mean - backdrop->LightAbout(-axis).mean);
    }
  }
  const auto along = [&](const glm::dvec3& d) {
    return d.x * (*slopes)[0] + d.y * (*slopes)[1] + d.z * (*slopes)[2];
  };
  return {along(view.right), along(view.up), along(-view.view)};
}

// Lights a model half by its own surroundings, so that it does not look pasted on.
glm::dvec3 ArthroscopicView::Parts::LightColourAt(std::size_t tissue) {
  return 0.5 * (LightOf(backdrop->footage_light().bright) + LightOf(LightAbout(tissue).bright));
}

// Meters the models only when there is a gain to compute.
void ArthroscopicView::Parts::MeterModels(const Picture& picture) {
  metered.Begin(picture.view, {picture.field_of_view, picture.lens});
  if (!(backdrop->relight() > 0) || picture.plain) return;
  for (std::size_t i = 0; i < tissues.size(); ++i)
    metered.Draw(tissues[i]->Metered(LightColourAt(i)));
}

void ArthroscopicView::Parts::TakeTool(simulation::ToolKind kind) {
  if (kind == tool_kind) return;
  tool_kind = kind;
  tool_mesh = MakeToolMesh(tool_kind);
  tool_shape = simulation::ShapeOf(tool_kind);
  tool.SetSurface(tool_mesh.body);
  moving.SetSurface(tool_mesh.moving);
  tool.SetEtched(tool_kind == simulation::ToolKind::kProbe);
  moving.SetEtched(false);
}

void ArthroscopicView::Parts::ShowTool(const Picture& picture, const LensFrame& frame) {
  if (!ShowsTool(picture)) {
    tool.Show(false);
    moving.Show(false);
    return;
  }
  const InstrumentView& instrument = *picture.instrument;
  const Pose pose = ProbePose(instrument.portal, instrument.proxy, instrument.roll);
  const Pose part = MovingPart(tool_mesh, instrument.opening, instrument.turn);
  tool.SetPose(pose);
  tool.SetLength(glm::distance(instrument.proxy, instrument.portal));
  // The mesh of a probe begins at the shaft. A hook that points away from the lens comes first.
  const glm::dvec3 hook = pose.quaternion * glm::dvec3(0.0, 1.0, 0.0);
  tool.SetReversed(instrument.kind == simulation::ToolKind::kProbe &&
                   glm::dot(hook, pose.position - picture.view.tip) > 0.0);
  moving.SetPose({pose * part.position, pose.quaternion * part.quaternion, 1.0});
  for (LensModel* model : {&tool, &moving}) {
    model->SetFrame(frame);
    model->Show(true);
  }
}

ArthroscopicView::ArthroscopicView() : parts_(std::make_unique<Parts>()) {
  Parts& p = *parts_;
  p.window->AddRenderer(p.renderer);
  p.window->SetSize(16, 16);
  p.renderer->SetBackground(0.0, 0.0, 0.0);
  p.renderer->SetBackgroundAlpha(1.0);
  // Parts outside a pinhole's view may be inside the lens' view: culling must not remove them.
  p.renderer->GetCullers()->RemoveAllItems();
  p.renderer->AutomaticLightCreationOff();
  p.light->SetLightTypeToHeadlight();
  p.renderer->AddLight(p.light);
  p.renderer->AddViewProp(p.backdrop);
  for (LensModel* model : {&p.tool, &p.moving}) {
    model->SetColour(glm::dvec3(0.72, 0.74, 0.77));
    model->actor()->VisibilityOff();
    p.renderer->AddViewProp(model->actor());
  }
  // The first frame initialises OpenGL, so that textures can be uploaded before the next one.
  p.window->Render();
  if (!p.window->IsReady())
    throw Error(Code::kDisplay,
                "the arthroscope's view needs OpenGL 3.2; update the graphics driver or run with "
                "LIBGL_ALWAYS_SOFTWARE=1");
}

ArthroscopicView::~ArthroscopicView() {
  parts_->camera_pass.ReleaseGraphicsResources(parts_->window);
  parts_->lens_pass.ReleaseGraphicsResources(parts_->window);
  parts_->occlusion_pass.ReleaseGraphicsResources(parts_->window);
  parts_->window->Finalize();
}

void ArthroscopicView::SetBackdrop(const ColourImage& panorama, const DepthMap& depth,
                                   const Backdrop& backdrop, const DepthMap& sigma,
                                   const DrawnRelief* made) {
  parts_->window->GetState()->Reset();
  parts_->notice = parts_->backdrop->Upload(parts_->window, panorama, depth, backdrop, sigma, made);
  parts_->ForgetLight();
}

void ArthroscopicView::SetDepth(const DepthMap& depth, const DepthMap& sigma,
                                const DrawnRelief* made) {
  parts_->window->GetState()->Reset();
  parts_->backdrop->UploadDepth(parts_->window, depth, sigma, made);
}

bool ArthroscopicView::SetGeometry(const Backdrop& backdrop) {
  parts_->ForgetLight();
  return parts_->backdrop->SetGeometry(backdrop);
}

void ArthroscopicView::Parts::AddTissue(const Tissue& tissue, const SurfaceMesh& surface,
                                        const simulation::TissueLook& look) {
  auto model = std::make_unique<LensModel>(LensModel::Look::kTissue);
  model->SetLook(look, surface);
  model->SetSurface(surface);
  model->SetColour(tissue.colour);
  model->SetPose(tissue.pose);
  vertex_counts.push_back(surface.vertices.size());
  places.push_back({MiddleOf(surface.vertices), tissue.pose, {}});
  renderer->AddViewProp(model->actor());
  tissues.push_back(std::move(model));
  strands.push_back(std::make_unique<StrandModel>(look, surface));
  strands.back()->model().SetColour(tissue.colour);
  strands.back()->model().SetPose(tissue.pose);
  renderer->AddViewProp(strands.back()->model().actor());
}

void ArthroscopicView::Parts::RemoveTissues(std::size_t first) {
  for (std::size_t i = first; i < tissues.size(); ++i) {
    renderer->RemoveViewProp(tissues[i]->actor());
    renderer->RemoveViewProp(strands[i]->model().actor());
  }
  tissues.resize(first);
  strands.resize(first);
  vertex_counts.resize(first);
  places.resize(first);
}

void ArthroscopicView::Parts::AddLooseBodies() {
  for (std::size_t i = 0; i < loose.size(); ++i)
    AddTissue(LooseBodyTissue(loose[i]), MakeLooseBody(loose[i].radius, static_cast<int>(i)),
              LooseBodyLook());
}

void ArthroscopicView::Parts::PutToolsLast() {
  for (LensModel* model : {&tool, &moving}) {
    renderer->RemoveViewProp(model->actor());
    renderer->AddViewProp(model->actor());
  }
}

void ArthroscopicView::SetTissues(std::span<const Tissue> tissues,
                                  std::span<const SharedSurface> surfaces,
                                  std::span<const simulation::TissueLook> looks) {
  Parts& p = *parts_;
  p.RemoveTissues(0);
  for (std::size_t i = 0; i < tissues.size(); ++i)
    p.AddTissue(tissues[i], OrEmpty(i < surfaces.size() ? surfaces[i] : nullptr),
                i < looks.size() ? looks[i] : simulation::TissueLook{});
  p.AddLooseBodies();
  p.PutToolsLast();
}

bool ArthroscopicView::SetLooseBodies(std::span<const Ball> bodies) {
  Parts& p = *parts_;
  if (std::ranges::equal(bodies, p.loose)) return false;
  const std::size_t first = p.tissues.size() - p.loose.size();
  const bool are_same = std::ranges::equal(bodies, p.loose, {}, &Ball::radius, &Ball::radius);
  p.loose.assign(bodies.begin(), bodies.end());
  if (!are_same) {
    p.RemoveTissues(first);
    p.AddLooseBodies();
    p.PutToolsLast();
    return true;
  }
  for (std::size_t i = 0; i < bodies.size(); ++i)
    SetTissuePose(static_cast<int>(first + i), LooseBodyTissue(bodies[i]).pose);
  return true;
}

bool ArthroscopicView::SetTissueShape(int index, std::span<const glm::dvec3> positions,
                                      std::span<const glm::dvec3> normals) {
  const auto i = static_cast<std::size_t>(index);
  if (i >= parts_->tissues.size() || positions.size() != parts_->vertex_counts[i] ||
      (!normals.empty() && normals.size() != positions.size()))
    throw Error(Code::kBadArgument, "tissue " + std::to_string(index) + " was given " +
                                        std::to_string(positions.size()) +
                                        " vertices to draw; its surface has another number");
  parts_->strands[i]->SetShape(positions);
  return parts_->tissues[i]->SetShape(positions, normals);
}

void ArthroscopicView::SetTissueSurface(int index, const SurfaceMesh& surface,
                                        std::span<const std::uint8_t> fresh) {
  parts_->tissues.at(static_cast<std::size_t>(index))->SetSurface(surface, fresh);
  parts_->strands[static_cast<std::size_t>(index)]->SetSurface(surface, fresh);
  parts_->vertex_counts[static_cast<std::size_t>(index)] = surface.vertices.size();
}

void ArthroscopicView::SetTissuePose(int index, const Pose& portal_from_tissue) {
  parts_->tissues.at(static_cast<std::size_t>(index))->SetPose(portal_from_tissue);
  parts_->strands[static_cast<std::size_t>(index)]->model().SetPose(portal_from_tissue);
  parts_->places[static_cast<std::size_t>(index)].pose = portal_from_tissue;
  parts_->places[static_cast<std::size_t>(index)].about.reset();
}

void ArthroscopicView::Render(const Picture& picture, int size) {
  Parts& p = *parts_;
  CheckDisturbances(picture.disturbances);
  if (p.is_timed) glFinish();
  auto begin = std::chrono::steady_clock::now();
  p.cost = {};
  p.has_camera = picture.camera && !picture.plain;
  p.size = size;
  p.rays = size * (p.has_camera ? picture.rays : 1);
  p.window->GetState()->Reset();  // other code has drawn in this context
  p.window->SetSize(p.rays, p.rays);

  // Only the camera's position and axes are used; the shaders apply the lens.
  const simulation::ScopeView& view = picture.view;
  const glm::dvec3 focus = view.tip + view.view;
  vtkCamera* camera = p.renderer->GetActiveCamera();
  camera->SetPosition(view.tip.x, view.tip.y, view.tip.z);
  camera->SetFocalPoint(focus.x, focus.y, focus.z);
  camera->SetViewUp(view.up.x, view.up.y, view.up.z);
  camera->SetClippingRange(kNearest, kFarthest);

  LensFrame frame;
  if (ShowsTool(picture)) p.TakeTool(picture.instrument->kind);
  frame.shade = ShadeOf(picture, p.tool_shape);
  p.MeterModels(picture);
  p.backdrop->SetPicture(picture, p.rays, frame.shade, p.metered);
  frame.gain = p.backdrop->gain();
  frame.relit = p.backdrop->relight();
  frame.mirrored_share = MirroredShare(p.backdrop->medium());
  frame.field_of_view = picture.field_of_view;
  frame.lens = picture.lens;
  frame.window_radius = p.rays / 2.0;
  frame.light_reach = p.backdrop->light_reach();
  frame.light_colour = LightOf(p.backdrop->footage_light().bright);
  frame.surround = p.backdrop->footage_light().mean;
  frame.contact = p.backdrop->BeginContact();
  if (ShowsTool(picture)) frame.slope = p.SlopesIn(view);
  p.ShowTool(picture, frame);
  for (std::size_t i = 0; i < p.tissues.size(); ++i) {
    frame.light_colour = p.LightColourAt(i);
    frame.surround = p.LightAbout(i).mean;
    p.tissues[i]->SetFrame(frame);
    p.tissues[i]->Show(!picture.plain);
    p.strands[i]->model().Show(!picture.plain);
    if (p.strands[i]->empty()) continue;
    p.strands[i]->Place(picture.disturbances.time);
    p.strands[i]->model().SetFrame(frame);
  }
  p.window->Render();
  p.backdrop->EndContact();
  p.EndStage(&PictureCost::scene, begin);
  // An error of the depth map that is as high as the occlusion reaches would be drawn as shade.
  const bool is_occluded = p.has_camera && picture.features >= CameraFeatures::kOcclusion &&
                           p.backdrop->least_side() < kOcclusionReach;
  p.is_disturbed = picture.disturbances.is_any() && !picture.plain;
  if (is_occluded) p.occlusion_pass.Draw(p.window, picture, p.rays);
  // Disturbances lie over what is occluded. Otherwise the camera multiplies, which saves a pass.
  if (is_occluded && p.is_disturbed) p.occlusion_pass.Darken(p.window, p.rays);
  vtkTextureObject* occlusion =
      is_occluded && !p.is_disturbed ? &p.occlusion_pass.light() : nullptr;
  p.EndStage(&PictureCost::occlusion, begin);
  // Bits that drift in the fluid do not change the exposure.
  if (p.has_camera)
    p.camera_pass.Meter(p.window, picture, frame.shade,
                        *p.drawn().GetColorAttachmentAsTextureObject(0), occlusion);
  p.EndStage(&PictureCost::camera, begin);
  if (p.is_disturbed)
    p.lens_pass.Draw(p.window, picture, frame.light_reach, p.rays);
  else if (!picture.plain)
    p.lens_pass.DrawFlecks(p.window, picture, frame.light_reach, p.rays);
  p.EndStage(&PictureCost::disturbances, begin);
  if (p.has_camera) {
    Picture seen = picture;
    if (p.backdrop->is_footage()) seen.camera = OverFootage(*picture.camera);
    p.camera_pass.Draw(p.window, seen, *p.finished().GetColorAttachmentAsTextureObject(0),
                       occlusion, size);
  }
  p.EndStage(&PictureCost::camera, begin);
}

void ArthroscopicView::SetTimed(bool is_timed) { parts_->is_timed = is_timed; }

const PictureCost& ArthroscopicView::cost() const { return parts_->cost; }

void ArthroscopicView::Finish() const { glFinish(); }

unsigned int ArthroscopicView::TextureId() const {
  vtkTextureObject& shown = *parts_->shown().GetColorAttachmentAsTextureObject(0);
  // Linear filtering, for a picture that is shown larger than it was drawn.
  if (shown.GetMagnificationFilter() != vtkTextureObject::Linear) {
    shown.SetMagnificationFilter(vtkTextureObject::Linear);
    shown.Activate();
    shown.Deactivate();
  }
  return shown.GetHandle();
}

ColourImage ArthroscopicView::ReadPixels() const {
  return parts_->window->ReadPicture(parts_->shown(), parts_->size);
}

std::vector<float> ArthroscopicView::ReadDistances() const {
  const auto size = static_cast<std::size_t>(parts_->rays);
  std::vector<float> stored(size * size), distances(size * size);
  if (size == 0) return distances;
  vtkOpenGLState* state = parts_->window->GetState();
  state->PushReadFramebufferBinding();
  parts_->drawn().Bind(GL_READ_FRAMEBUFFER);
  glPixelStorei(GL_PACK_ALIGNMENT, 4);
  glReadPixels(0, 0, parts_->rays, parts_->rays, GL_DEPTH_COMPONENT, GL_FLOAT, stored.data());
  state->PopReadFramebufferBinding();
  const double middle = 0.5 * (parts_->rays - 1);
  for (std::size_t y = 0; y < size; ++y)
    for (std::size_t x = 0; x < size; ++x) {
      const float depth = stored[(size - 1 - y) * size + x];
      const bool is_inside = std::hypot(double(x) - middle, double(y) - middle) < middle + 1.0;
      distances[y * size + x] =
          is_inside && depth > 0.0f ? static_cast<float>(DistanceFromStored(depth)) : 0.0f;
    }
  return distances;
}

const CameraExposure& ArthroscopicView::exposure() const { return parts_->camera_pass.exposure(); }

const std::string& ArthroscopicView::notice() const { return parts_->notice; }

}  // namespace arthro::app
