// The editor in a GLFW window.

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <imgui.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>

#include "app/editor/platform/interaction_clock.h"
#include "app/editor/platform/painter.h"
#include "app/editor/platform/platform.h"
#include "core/base/error.h"
#include "render/context.h"

namespace voledit {

namespace {

constexpr double kSeenSeconds = 0.1;    // a window in which nothing but the progress changes is drawn so often
constexpr double kShortestWait = 1e-3;  // seconds
constexpr double kSettleSeconds = 1.2;  // after input: tooltips, hover
constexpr int kSettleFrames = 3;        // ImGui lays some things out a frame or two later

[[noreturn]] void fail(const std::string& what) {
    const char* description = nullptr;
    glfwGetError(&description);
    throw Error("window", what + (description ? std::string(" (") + description + ")" : ""),
                "use --headless, or another display");
}

Key keyOf(int key, int scancode) {
    // Letters as they stand on this keyboard, so that Ctrl+Z is where its user expects it.
    if (const char* name = glfwGetKeyName(key, scancode);
        name && name[0] && !name[1] && (key < GLFW_KEY_KP_0 || key > GLFW_KEY_KP_EQUAL))
        if (const auto named = keyNamed(name)) return *named;
    if (key >= GLFW_KEY_F1 && key <= GLFW_KEY_F12) return Key(int(Key::F1) + key - GLFW_KEY_F1);
    if (key >= GLFW_KEY_KP_0 && key <= GLFW_KEY_KP_ENTER) return Key(int(Key::Keypad0) + key - GLFW_KEY_KP_0);
    switch (key) {
        case GLFW_KEY_ESCAPE:
            return Key::Escape;
        case GLFW_KEY_ENTER:
            return Key::Enter;
        case GLFW_KEY_TAB:
            return Key::Tab;
        case GLFW_KEY_BACKSPACE:
            return Key::Backspace;
        case GLFW_KEY_INSERT:
            return Key::Insert;
        case GLFW_KEY_DELETE:
            return Key::Delete;
        case GLFW_KEY_RIGHT:
            return Key::Right;
        case GLFW_KEY_LEFT:
            return Key::Left;
        case GLFW_KEY_DOWN:
            return Key::Down;
        case GLFW_KEY_UP:
            return Key::Up;
        case GLFW_KEY_PAGE_UP:
            return Key::PageUp;
        case GLFW_KEY_PAGE_DOWN:
            return Key::PageDown;
        case GLFW_KEY_HOME:
            return Key::Home;
        case GLFW_KEY_END:
            return Key::End;
        case GLFW_KEY_LEFT_SHIFT:
        case GLFW_KEY_RIGHT_SHIFT:
            return Key::Shift;
        case GLFW_KEY_LEFT_CONTROL:
        case GLFW_KEY_RIGHT_CONTROL:
            return Key::Ctrl;
        case GLFW_KEY_LEFT_ALT:
        case GLFW_KEY_RIGHT_ALT:
            return Key::Alt;
        case GLFW_KEY_LEFT_SUPER:
        case GLFW_KEY_RIGHT_SUPER:
            return Key::Super;
        default:
            return key > 0 && key < 128 && !nameOf(Key(key)).empty() ? Key(key) : Key::None;
    }
}

std::string utf8(unsigned code) {
    std::string text;
    if (code < 0x80)
        text += char(code);
    else if (code < 0x800)
        text += {char(0xC0 | code >> 6), char(0x80 | (code & 63))};
    else if (code < 0x10000)
        text += {char(0xE0 | code >> 12), char(0x80 | (code >> 6 & 63)), char(0x80 | (code & 63))};
    else
        text += {char(0xF0 | code >> 18), char(0x80 | (code >> 12 & 63)), char(0x80 | (code >> 6 & 63)),
                 char(0x80 | (code & 63))};
    return text;
}

// GLFW is started once and ended when the window goes.
struct Library {
    Library() {
        if (!glfwInit()) fail("no display can be opened");
    }
    ~Library() { glfwTerminate(); }
};

class Window final : public Platform {
public:
    explicit Window(const EditorOptions& options);
    ~Window() override;

    float displayScale() const override;
    Index2 size() const override;
    FrameInput nextFrame(bool busy, double atMost) override;
    void show(Editor& editor) override;
    bool refining() const override { return painter_ && painter_->picture().busy(); }
    Picture screenshot(Editor& editor) override { return painter_->screenshot(editor); }

private:
    static Window& of(GLFWwindow* window) { return *static_cast<Window*>(glfwGetWindowUserPointer(window)); }
    void listen();
    void push(InputEvent event) { events_.push_back(std::move(event)); }
    void prepareImGui();
    void updateCursor();
    void updateTitle(const Workspace& workspace);

    Library library_;
    GLFWwindow* window_ = nullptr;
    std::unique_ptr<Painter> painter_;
    std::array<GLFWcursor*, ImGuiMouseCursor_COUNT> cursors_{};
    std::vector<InputEvent> events_;
    InteractionClock clock_;
    double lastFrame_ = 0, lastInput_ = 0, lastDrawn_ = 0;
    double restMs_ = 0;  // of the last frame that followed a change, all but the picture
    int settle_ = kSettleFrames;
    bool softwareGl_ = false;
    bool close_ = false;
    bool rescaled_ = false;
    bool prepared_ = false;
    std::string title_;
};

Window::Window(const EditorOptions& options) {
    glfwWindowHint(GLFW_CONTEXT_VERSION_MAJOR, 4);
    glfwWindowHint(GLFW_CONTEXT_VERSION_MINOR, 5);
    glfwWindowHint(GLFW_OPENGL_PROFILE, GLFW_OPENGL_CORE_PROFILE);
    glfwWindowHint(GLFW_DEPTH_BITS, 0);
    glfwWindowHint(GLFW_STENCIL_BITS, 0);
    Index2 size = options.size.value_or(Index2(0));
    if (!options.size) {
        int x = 0, y = 0, w = 1600, h = 1000;
        if (GLFWmonitor* monitor = glfwGetPrimaryMonitor()) glfwGetMonitorWorkarea(monitor, &x, &y, &w, &h);
        size = {std::max(640, 88 * w / 100), std::max(480, 88 * h / 100)};
    }
    window_ = glfwCreateWindow(size.x, size.y, "voledit", nullptr, nullptr);
    if (!window_) fail("a window with OpenGL 4.5 cannot be opened");
    glfwMakeContextCurrent(window_);
    glfwSwapInterval(1);
    loadGl([](const char* name) { return reinterpret_cast<void*>(glfwGetProcAddress(name)); });
    softwareGl_ = voledit::softwareGl();
    painter_ = std::make_unique<Painter>(false);
    listen();
    lastFrame_ = lastInput_ = glfwGetTime();
}

Window::~Window() {
    painter_.reset();
    for (GLFWcursor* cursor : cursors_)
        if (cursor) glfwDestroyCursor(cursor);
    if (window_) glfwDestroyWindow(window_);
}

void Window::listen() {
    glfwSetWindowUserPointer(window_, this);
    glfwSetCursorPosCallback(window_, [](GLFWwindow* w, double x, double y) {
        int width = 1, height = 1;
        glfwGetWindowSize(w, &width, &height);
        // Where a window's units are not pixels, the mouse comes in units.
        const Vec2 pixels = Vec2(of(w).size()) / Vec2(std::max(1, width), std::max(1, height));
        of(w).push(InputEvent::move(Vec2(x, y) * pixels));
    });
    glfwSetMouseButtonCallback(window_, [](GLFWwindow* w, int button, int action, int) {
        if (button <= GLFW_MOUSE_BUTTON_MIDDLE)
            of(w).push(InputEvent::press(MouseButton(button), action == GLFW_PRESS));
    });
    glfwSetScrollCallback(window_, [](GLFWwindow* w, double, double dy) { of(w).push(InputEvent::scroll(dy)); });
    glfwSetKeyCallback(window_, [](GLFWwindow* w, int key, int scancode, int action, int) {
        // Repeats are ImGui's own, from the time that a key is down.
        if (const Key ours = keyOf(key, scancode); ours != Key::None && action != GLFW_REPEAT)
            of(w).push(InputEvent::stroke(ours, action == GLFW_PRESS));
    });
    glfwSetCharCallback(window_, [](GLFWwindow* w, unsigned code) { of(w).push(InputEvent::typed(utf8(code))); });
    glfwSetDropCallback(window_, [](GLFWwindow* w, int count, const char** paths) {
        if (count > 0) of(w).push(InputEvent::dropped(paths[0]));
    });
    glfwSetWindowCloseCallback(window_, [](GLFWwindow* w) {
        of(w).close_ = true;
        glfwSetWindowShouldClose(w, GLFW_FALSE);
    });
    const auto redraw = [](GLFWwindow* w) { of(w).settle_ = kSettleFrames; };
    glfwSetWindowRefreshCallback(window_, redraw);
    glfwSetFramebufferSizeCallback(window_, [](GLFWwindow* w, int, int) { of(w).settle_ = kSettleFrames; });
    glfwSetWindowContentScaleCallback(window_, [](GLFWwindow* w, float, float) { of(w).rescaled_ = true; });
}

float Window::displayScale() const {
    float x = 1, y = 1;
    glfwGetWindowContentScale(window_, &x, &y);
    return std::clamp(std::max(x, y), 0.5f, 4.0f);
}

Index2 Window::size() const {
    Index2 size(1);
    glfwGetFramebufferSize(window_, &size.x, &size.y);
    return glm::max(size, Index2(1));
}

FrameInput Window::nextFrame(bool busy, double atMost) {
    const double patience = std::min(atMost, glfwGetTime() - lastInput_ < kSettleSeconds ? 0.1 : 1.0);
    if (busy || settle_ > 0 || patience < kShortestWait)
        glfwPollEvents();
    else
        glfwWaitEventsTimeout(patience);
    const double now = glfwGetTime();
    FrameInput input;
    input.size = size();
    input.seconds = now - lastFrame_;
    input.events = std::exchange(events_, {});
    input.close = std::exchange(close_, false);
    lastFrame_ = now;
    if (!input.events.empty()) {
        settle_ = kSettleFrames;
        lastInput_ = now;
    } else {
        settle_ = std::max(0, settle_ - 1);
    }
    return input;
}

void Window::show(Editor& editor) {
    if (!prepared_) prepareImGui();
    if (std::exchange(rescaled_, false)) editor.setScale(displayScale());
    const PictureSchedule& picture = painter_->picture();
    const bool worksOn = picture.busy();
    const double start = glfwGetTime();
    const bool isNew = painter_->update(editor, restMs_);
    const double pictureSeconds = glfwGetTime() - start;
    const bool changed = picture.changed();
    // What refines is worth more than drawing the same window again.
    if (worksOn && !isNew && !changed && settle_ == 0 && start - lastDrawn_ < kSeenSeconds) return;
    painter_->draw(editor, 0);
    const double drawn = glfwGetTime();
    glfwSwapBuffers(window_);
    const double now = lastDrawn_ = glfwGetTime();
    // Swapping waits for the screen where a GPU draws, and for the drawing where none does.
    if (changed) restMs_ = 1000 * ((softwareGl_ ? now : drawn) - lastFrame_ - pictureSeconds);
    clock_.note({.start = lastFrame_, .shown = now, .changed = changed, .picture = isNew, .final = picture.finished()});
    editor.times = clock_.times();
    updateCursor();
    updateTitle(editor.workspace());
}

void Window::prepareImGui() {
    prepared_ = true;
    ImGuiIO& io = ImGui::GetIO();
    io.ClipboardUserData = window_;
    io.SetClipboardTextFn = [](void* window, const char* text) {
        glfwSetClipboardString(static_cast<GLFWwindow*>(window), text);
    };
    io.GetClipboardTextFn = [](void* window) { return glfwGetClipboardString(static_cast<GLFWwindow*>(window)); };
    io.ConfigFlags &= ~ImGuiConfigFlags_NoMouseCursorChange;
}

void Window::updateCursor() {
    const int wanted = ImGui::GetMouseCursor();
    if (wanted < 0) return;
    int shape = GLFW_ARROW_CURSOR;
    if (wanted == ImGuiMouseCursor_TextInput) shape = GLFW_IBEAM_CURSOR;
    if (wanted == ImGuiMouseCursor_Hand) shape = GLFW_HAND_CURSOR;
    if (wanted == ImGuiMouseCursor_ResizeEW) shape = GLFW_HRESIZE_CURSOR;
    if (wanted == ImGuiMouseCursor_ResizeNS) shape = GLFW_VRESIZE_CURSOR;
    GLFWcursor*& cursor = cursors_[std::size_t(wanted)];
    if (!cursor) cursor = glfwCreateStandardCursor(shape);
    glfwSetCursor(window_, cursor);
}

void Window::updateTitle(const Workspace& workspace) {
    std::string title = "voledit";
    if (workspace.open) {
        const auto& path = workspace.document.path();
        const std::string name = !path.empty()                      ? path.filename().string()
                                 : workspace.assets.volumes.empty() ? "untitled"
                                                                    : workspace.assets.volumes.begin()->first;
        title = name + (workspace.document.modified() ? "* - voledit" : " - voledit");
    }
    if (title != title_) glfwSetWindowTitle(window_, title.c_str());
    title_ = title;
}

}  // namespace

std::unique_ptr<Platform> makeWindow(const EditorOptions& options) {
    return std::make_unique<Window>(options);
}

}  // namespace voledit
