#include "app/platform/window.h"

#include <algorithm>
#include <cctype>
#include <cmath>

#define GLFW_INCLUDE_NONE
#include <GL/gl.h>
#include <GLFW/glfw3.h>
#include <backends/imgui_impl_opengl3.h>
#include <imgui.h>

#include "app/platform/x_display.h"
#include "simulation/core/error.h"

namespace arthro::app {
namespace {

constexpr double kLongestStep = 0.1;  // s; a longer pause is not a held key

using BindFramebuffer = void (*)(GLenum, GLuint);
constexpr GLenum kFramebuffer = 0x8D40;  // GL_FRAMEBUFFER

// Shortcuts follow what is printed on the key: Ctrl+Z is where Z is on the user's keyboard.
int KeyOfLayout(int key, int scancode) {
  if (key < GLFW_KEY_A || key > GLFW_KEY_Z) return key;
  const char* name = glfwGetKeyName(key, scancode);
  if (name == nullptr || name[1] != '\0') return key;
  const int upper = std::toupper(static_cast<unsigned char>(name[0]));
  return upper >= 'A' && upper <= 'Z' ? upper : key;
}

const char* ClipboardText(void* window) {
  return glfwGetClipboardString(static_cast<GLFWwindow*>(window));
}

void SetClipboardText(void* window, const char* text) {
  glfwSetClipboardString(static_cast<GLFWwindow*>(window), text);
}

void MapKeys(ImGuiIO& io) {
  // Tab walks through all items (app/editor/tab_walk.h), ImGui's through fields only.
  io.KeyMap[ImGuiKey_Tab] = -1;
  io.KeyMap[ImGuiKey_LeftArrow] = GLFW_KEY_LEFT;
  io.KeyMap[ImGuiKey_RightArrow] = GLFW_KEY_RIGHT;
  io.KeyMap[ImGuiKey_UpArrow] = GLFW_KEY_UP;
  io.KeyMap[ImGuiKey_DownArrow] = GLFW_KEY_DOWN;
  io.KeyMap[ImGuiKey_PageUp] = GLFW_KEY_PAGE_UP;
  io.KeyMap[ImGuiKey_PageDown] = GLFW_KEY_PAGE_DOWN;
  io.KeyMap[ImGuiKey_Home] = GLFW_KEY_HOME;
  io.KeyMap[ImGuiKey_End] = GLFW_KEY_END;
  io.KeyMap[ImGuiKey_Insert] = GLFW_KEY_INSERT;
  io.KeyMap[ImGuiKey_Delete] = GLFW_KEY_DELETE;
  io.KeyMap[ImGuiKey_Backspace] = GLFW_KEY_BACKSPACE;
  io.KeyMap[ImGuiKey_Space] = GLFW_KEY_SPACE;
  io.KeyMap[ImGuiKey_Enter] = GLFW_KEY_ENTER;
  io.KeyMap[ImGuiKey_Escape] = GLFW_KEY_ESCAPE;
  io.KeyMap[ImGuiKey_KeyPadEnter] = GLFW_KEY_KP_ENTER;
  io.KeyMap[ImGuiKey_A] = GLFW_KEY_A;
  io.KeyMap[ImGuiKey_C] = GLFW_KEY_C;
  io.KeyMap[ImGuiKey_V] = GLFW_KEY_V;
  io.KeyMap[ImGuiKey_X] = GLFW_KEY_X;
  io.KeyMap[ImGuiKey_Y] = GLFW_KEY_Y;
  io.KeyMap[ImGuiKey_Z] = GLFW_KEY_Z;
}

}  // namespace

// GLFW's callbacks, which find the window through its user pointer.
struct WindowCallbacks {
  static Window& Of(GLFWwindow* window) {
    return *static_cast<Window*>(glfwGetWindowUserPointer(window));
  }
  static void Pointer(GLFWwindow* window, double x, double y) {
    Of(window).input_.Push(PointerMoved{x, y});
  }
  static void Button(GLFWwindow* window, int button, int action, int) {
    if (button < 3) Of(window).input_.Push(ButtonChanged{button, action == GLFW_PRESS});
  }
  static void Wheel(GLFWwindow* window, double x, double y) {
    Of(window).input_.Push(WheelTurned{x, y});
  }
  static void Key(GLFWwindow* window, int key, int scancode, int action, int) {
    if (key >= 0 && action != GLFW_REPEAT)  // ImGui repeats held keys itself
      Of(window).input_.Push(KeyChanged{KeyOfLayout(key, scancode), action == GLFW_PRESS});
  }
  static void Character(GLFWwindow* window, unsigned character) {
    Of(window).input_.Push(CharacterTyped{character});
  }
  static void Drop(GLFWwindow* window, int count, const char** files) {
    Of(window).input_.Push(FilesDropped{{files, files + count}});
  }
  static void Focus(GLFWwindow* window, int focused) {
    if (!focused) Of(window).input_.Push(FocusLost{});
  }
  static void Close(GLFWwindow* window) {
    glfwSetWindowShouldClose(window, GLFW_FALSE);  // the editor decides
    Of(window).input_.Push(CloseRequested{});
  }
  static void Scale(GLFWwindow* window, float x, float) {
    if (!Of(window).options_.scale) Of(window).scale_ = std::max(1.0f, x);
  }
};

Window::Window(const WindowOptions& options) : options_(options) {
  const std::shared_ptr<void> connection = RemoveStaleWindowManagerMark();
  EndWhenDisplayIsLost();
  if (!glfwInit())
    throw Error(
        Code::kDisplay,
        "there is no display to open a window on; `arthroscene demo` and `arthroscene view` "
        "make pictures without one");
  glfwWindowHint(GLFW_CONTEXT_VERSION_MAJOR, 3);
  glfwWindowHint(GLFW_CONTEXT_VERSION_MINOR, 2);
  glfwWindowHint(GLFW_OPENGL_PROFILE, GLFW_OPENGL_CORE_PROFILE);
  glfwWindowHint(GLFW_VISIBLE, options.visible ? GLFW_TRUE : GLFW_FALSE);
  glfwWindowHint(GLFW_SAMPLES, 0);
  glfwWindowHint(GLFW_DEPTH_BITS, 0);
  glfwWindowHint(GLFW_STENCIL_BITS, 0);

  // The window starts at its size times the screen's scale, but never larger than the screen.
  if (options.scale) {
    scale_ = *options.scale;
  } else if (GLFWmonitor* monitor = glfwGetPrimaryMonitor()) {
    float x = 1.0f, y = 1.0f;
    glfwGetMonitorContentScale(monitor, &x, &y);
    scale_ = std::max(1.0f, x);
  }
  int width = static_cast<int>(std::lround(options.width * scale_));
  int height = static_cast<int>(std::lround(options.height * scale_));
  if (GLFWmonitor* monitor = glfwGetPrimaryMonitor()) {
    int x = 0, y = 0, w = 0, h = 0;
    glfwGetMonitorWorkarea(monitor, &x, &y, &w, &h);
    if (w > 0 && h > 0) width = std::min(width, w), height = std::min(height, h);
  }
  window_ = glfwCreateWindow(width, height, options.title.c_str(), nullptr, nullptr);
  if (window_ == nullptr) {
    const char* reason = nullptr;
    glfwGetError(&reason);
    const std::string why = reason ? std::string(" (") + reason + ")" : std::string();
    glfwTerminate();
    throw Error(Code::kDisplay, "this display gives no OpenGL 3.2 window" + why +
                                    "; update the graphics driver, or set LIBGL_ALWAYS_SOFTWARE=1");
  }
  glfwMakeContextCurrent(window_);
  glfwSwapInterval(options.visible ? 1 : 0);
  glfwSetWindowSizeLimits(window_, 640, 480, GLFW_DONT_CARE, GLFW_DONT_CARE);
  glfwSetWindowUserPointer(window_, this);
  glfwSetCursorPosCallback(window_, WindowCallbacks::Pointer);
  glfwSetMouseButtonCallback(window_, WindowCallbacks::Button);
  glfwSetScrollCallback(window_, WindowCallbacks::Wheel);
  glfwSetKeyCallback(window_, WindowCallbacks::Key);
  glfwSetCharCallback(window_, WindowCallbacks::Character);
  glfwSetDropCallback(window_, WindowCallbacks::Drop);
  glfwSetWindowFocusCallback(window_, WindowCallbacks::Focus);
  glfwSetWindowCloseCallback(window_, WindowCallbacks::Close);
  glfwSetWindowContentScaleCallback(window_, WindowCallbacks::Scale);

  ImGui::CreateContext();
  ImGuiIO& io = ImGui::GetIO();
  io.IniFilename = nullptr;  // the layout is fixed
  io.ConfigFlags |= ImGuiConfigFlags_NavEnableKeyboard;
  io.BackendFlags |= ImGuiBackendFlags_HasMouseCursors;
  io.ConfigWindowsMoveFromTitleBarOnly = true;
  io.GetClipboardTextFn = ClipboardText;
  io.SetClipboardTextFn = SetClipboardText;
  io.ClipboardUserData = window_;
  MapKeys(io);
  io.MousePos = {-1e6f, -1e6f};
  cursors_.resize(ImGuiMouseCursor_COUNT, nullptr);
  cursors_[ImGuiMouseCursor_Arrow] = glfwCreateStandardCursor(GLFW_ARROW_CURSOR);
  cursors_[ImGuiMouseCursor_TextInput] = glfwCreateStandardCursor(GLFW_IBEAM_CURSOR);
  cursors_[ImGuiMouseCursor_ResizeEW] = glfwCreateStandardCursor(GLFW_HRESIZE_CURSOR);
  cursors_[ImGuiMouseCursor_ResizeNS] = glfwCreateStandardCursor(GLFW_VRESIZE_CURSOR);
  cursors_[ImGuiMouseCursor_Hand] = glfwCreateStandardCursor(GLFW_HAND_CURSOR);
  ImGui_ImplOpenGL3_Init("#version 150");
  ReadSizes();
  last_time_ = glfwGetTime();
}

Window::~Window() {
  ImGui_ImplOpenGL3_Shutdown();
  ImGui::DestroyContext();
  for (GLFWcursor* cursor : cursors_)
    if (cursor) glfwDestroyCursor(cursor);
  glfwDestroyWindow(window_);
  glfwTerminate();
}

void Window::ReadSizes() {
  glfwGetWindowSize(window_, &width_, &height_);
  glfwGetFramebufferSize(window_, &framebuffer_width_, &framebuffer_height_);
}

void Window::ApplyScale() {
  if (scale_ == applied_scale_ && options_.theme == applied_theme_) return;
  ApplyTheme(scale_, options_.theme);
  applied_theme_ = options_.theme;
  if (scale_ == applied_scale_) return;
  if (applied_scale_ > 0.0) ImGui_ImplOpenGL3_DestroyFontsTexture();
  fonts_ = BuildFonts(scale_);
  if (applied_scale_ > 0.0) ImGui_ImplOpenGL3_CreateFontsTexture();
  applied_scale_ = scale_;
}

void Window::WaitEvents(double seconds) {
  if (seconds > 0.0)
    glfwWaitEventsTimeout(seconds);
  else
    glfwPollEvents();
}

void Window::WakeUp() { glfwPostEmptyEvent(); }

void Window::Feed(const InputEvent& event, FrameNews& news) {
  ImGuiIO& io = ImGui::GetIO();
  const auto release_all = [&] {
    std::fill(std::begin(io.KeysDown), std::end(io.KeysDown), false);
    std::fill(std::begin(io.MouseDown), std::end(io.MouseDown), false);
  };
  if (const auto* move = std::get_if<PointerMoved>(&event)) {
    io.MousePos = {static_cast<float>(move->x), static_cast<float>(move->y)};
  } else if (const auto* button = std::get_if<ButtonChanged>(&event)) {
    io.MouseDown[button->button] = button->down;
  } else if (const auto* wheel = std::get_if<WheelTurned>(&event)) {
    io.MouseWheelH += static_cast<float>(wheel->x);
    io.MouseWheel += static_cast<float>(wheel->y);
  } else if (const auto* key = std::get_if<KeyChanged>(&event)) {
    if (key->key >= 0 && key->key < 512) io.KeysDown[key->key] = key->down;
  } else if (const auto* typed = std::get_if<CharacterTyped>(&event)) {
    io.AddInputCharacter(typed->character);
  } else if (const auto* dropped = std::get_if<FilesDropped>(&event)) {
    news.dropped.insert(news.dropped.end(), dropped->files.begin(), dropped->files.end());
  } else if (const auto* size = std::get_if<SizeAsked>(&event)) {
    glfwSetWindowSize(window_, size->width, size->height);
  } else if (std::holds_alternative<FocusLost>(event)) {
    release_all();
  } else if (std::holds_alternative<CloseRequested>(event)) {
    news.close_requested = true;
  }
  io.KeyCtrl = io.KeysDown[GLFW_KEY_LEFT_CONTROL] || io.KeysDown[GLFW_KEY_RIGHT_CONTROL];
  io.KeyShift = io.KeysDown[GLFW_KEY_LEFT_SHIFT] || io.KeysDown[GLFW_KEY_RIGHT_SHIFT];
  io.KeyAlt = io.KeysDown[GLFW_KEY_LEFT_ALT] || io.KeysDown[GLFW_KEY_RIGHT_ALT];
  io.KeySuper = io.KeysDown[GLFW_KEY_LEFT_SUPER] || io.KeysDown[GLFW_KEY_RIGHT_SUPER];
}

FrameNews Window::BeginFrame() {
  ReadSizes();
  ApplyScale();
  FrameNews news;
  for (const InputEvent& event : input_.TakeFrame()) Feed(event, news);

  ImGuiIO& io = ImGui::GetIO();
  io.DisplaySize = {static_cast<float>(width_), static_cast<float>(height_)};
  if (width_ > 0 && height_ > 0)
    io.DisplayFramebufferScale = {static_cast<float>(framebuffer_width_) / width_,
                                  static_cast<float>(framebuffer_height_) / height_};
  const double now = glfwGetTime();
  io.DeltaTime = static_cast<float>(
      options_.fixed_step.value_or(std::clamp(now - last_time_, 1e-4, kLongestStep)));
  last_time_ = now;
  ImGui_ImplOpenGL3_NewFrame();
  ImGui::NewFrame();

  GLFWcursor* cursor = cursors_[ImGuiMouseCursor_Arrow];
  const ImGuiMouseCursor wanted = ImGui::GetMouseCursor();
  if (wanted >= 0 && cursors_[static_cast<std::size_t>(wanted)])
    cursor = cursors_[static_cast<std::size_t>(wanted)];
  glfwSetCursor(window_, cursor);
  return news;
}

void Window::EndFrame() {
  ImGui::Render();
  static const auto bind_framebuffer =
      reinterpret_cast<BindFramebuffer>(glfwGetProcAddress("glBindFramebuffer"));
  bind_framebuffer(kFramebuffer, 0);
  glDisable(GL_SCISSOR_TEST);
  glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
  glViewport(0, 0, framebuffer_width_, framebuffer_height_);
  const ImVec4 ground = ImGui::GetStyleColorVec4(ImGuiCol_WindowBg);
  glClearColor(ground.x, ground.y, ground.z, 1.0f);
  glClear(GL_COLOR_BUFFER_BIT);
  ImGui_ImplOpenGL3_RenderDrawData(ImGui::GetDrawData());
}

void Window::Present() { glfwSwapBuffers(window_); }

ColourImage Window::ReadPicture() const {
  ColourImage upside_down(framebuffer_width_, framebuffer_height_);
  glPixelStorei(GL_PACK_ALIGNMENT, 1);
  glReadBuffer(GL_BACK);
  glReadPixels(0, 0, framebuffer_width_, framebuffer_height_, GL_RGB, GL_UNSIGNED_BYTE,
               upside_down.rgb.data());
  ColourImage picture(framebuffer_width_, framebuffer_height_);
  const auto row = static_cast<std::ptrdiff_t>(framebuffer_width_) * 3;
  for (int y = 0; y < framebuffer_height_; ++y)
    std::copy_n(upside_down.rgb.begin() + row * (framebuffer_height_ - 1 - y), row,
                picture.rgb.begin() + row * y);
  return picture;
}

bool Window::AnythingHeld() const {
  const ImGuiIO& io = ImGui::GetIO();
  const auto held = [](bool down) { return down; };
  return std::any_of(std::begin(io.KeysDown), std::end(io.KeysDown), held) ||
         std::any_of(std::begin(io.MouseDown), std::end(io.MouseDown), held);
}

void Window::SetTitle(const std::string& title) {
  if (title == options_.title) return;
  options_.title = title;
  glfwSetWindowTitle(window_, title.c_str());
}

void Window::SetLook(std::optional<double> scale, Theme theme) {
  options_.theme = theme;
  options_.scale = scale;
  scale_ = scale.value_or(monitor().content_scale);
}

MonitorSize Window::monitor() const {
  MonitorSize size;
  GLFWmonitor* monitor = window_ ? glfwGetWindowMonitor(window_) : nullptr;
  if (monitor == nullptr) monitor = glfwGetPrimaryMonitor();
  if (monitor == nullptr) return size;
  float x = 1.0f, y = 1.0f;
  if (window_)
    glfwGetWindowContentScale(window_, &x, &y);
  else
    glfwGetMonitorContentScale(monitor, &x, &y);
  size.content_scale = std::max(1.0f, x);
  int height_mm = 0;
  glfwGetMonitorPhysicalSize(monitor, &size.width_mm, &height_mm);
  if (const GLFWvidmode* mode = glfwGetVideoMode(monitor)) size.width_px = mode->width;
  return size;
}

void Window::SetFullScreen(bool full) {
  const bool is_full = glfwGetWindowMonitor(window_) != nullptr;
  if (full == is_full) return;
  if (full) {
    GLFWmonitor* monitor = glfwGetPrimaryMonitor();
    const GLFWvidmode* mode = monitor ? glfwGetVideoMode(monitor) : nullptr;
    if (mode == nullptr) return;
    glfwGetWindowPos(window_, &restore_[0], &restore_[1]);
    glfwGetWindowSize(window_, &restore_[2], &restore_[3]);
    glfwSetWindowMonitor(window_, monitor, 0, 0, mode->width, mode->height, mode->refreshRate);
  } else {
    glfwSetWindowMonitor(window_, nullptr, restore_[0], restore_[1], restore_[2], restore_[3],
                         GLFW_DONT_CARE);
  }
}

}  // namespace arthro::app
