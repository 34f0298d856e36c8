#include "app/editor/platform/painter.h"

#include <imgui.h>

#include <algorithm>

#include "app/editor/theme.h"
#include "core/base/error.h"
#include "core/base/paths.h"

namespace voledit {

namespace {
// Of a played frame a part is left over, so that one that trembles is not dropped.
constexpr double kPlayedShare = 0.9;
}  // namespace

Painter::Painter(bool headless) : shaders_(shaderFolder()), interface_(shaders_), picture_(shaders_, headless) {}

void Painter::guarded(Editor& editor, const std::function<void()>& draw) {
    try {
        draw();
        problem_.clear();
    } catch (const Error& error) {
        if (problem_ != error.what()) editor.workspace().notify(Notice::Kind::Problem, error.what());
        problem_ = error.what();
    }
}

bool Painter::update(Editor& editor, double restMs) {
    const Workspace& workspace = editor.workspace();
    if (!workspace.open) return false;
    PictureSchedule::Frame frame{.budgetMs = workspace.frameBudgetMs, .restMs = restMs, .refines = true};
    if (const auto played = editor.playedFrame())
        frame = {
            .budgetMs = std::min(frame.budgetMs, kPlayedShare * 1000 * *played), .restMs = restMs, .refines = false};
    bool isNew = false;
    guarded(editor,
            [&] { isNew = picture_.update(workspace.compiled, workspace.viewSize, workspace.renderer, frame); });
    tellNotices(editor);
    return isNew;
}

void Painter::tellNotices(Editor& editor) {
    for (const std::string& notice : picture().notices())
        if (noted_.insert(notice).second) editor.workspace().notify(Notice::Kind::Warning, notice);
}

Picture Painter::screenshot(Editor& editor) {
    const Workspace& workspace = editor.workspace();
    if (workspace.open) picture_.finish(workspace.compiled, workspace.viewSize, workspace.renderer);
    tellNotices(editor);
    const ImVec2 display = editor.drawData().DisplaySize;
    const Index2 size(int(display.x), int(display.y));
    const Texture canvas = makeTexture2D(GL_RGBA8, size);
    const Framebuffer target = makeFramebuffer(canvas.name(), 0, false);
    draw(editor, target.name());
    std::vector<std::uint8_t> bytes(std::size_t(size.x) * std::size_t(size.y) * 4);
    glGetTextureImage(canvas.name(), 0, GL_RGBA, GL_UNSIGNED_BYTE, GLsizei(bytes.size()), bytes.data());
    Picture picture(size);
    for (int y = 0; y < size.y; ++y)
        for (int x = 0; x < size.x; ++x) {
            const std::uint8_t* pixel =
                &bytes[4 * (std::size_t(size.y - 1 - y) * std::size_t(size.x) + std::size_t(x))];
            picture.at(x, y) = Vec4f(Vec3f(pixel[0], pixel[1], pixel[2]) / 255.0f, 1.0f);
        }
    return picture;
}

void Painter::clear() const {
    glClearColor(theme::kWindow.x, theme::kWindow.y, theme::kWindow.z, 1);
    glClear(GL_COLOR_BUFFER_BIT);
}

// Copied, not drawn as a textured rectangle of the interface: without a GPU that takes several times as long.
void Painter::drawPicture(Editor& editor, GLuint framebuffer) {
    const Workspace& workspace = editor.workspace();
    const GLuint from = picture_.framebuffer(editor.overlay(), workspace.compiled.camera);
    const Index2 size = picture().viewSize(),
                 low(workspace.viewOrigin.x, int(editor.drawData().DisplaySize.y) - workspace.viewOrigin.y - size.y);
    glBlitNamedFramebuffer(from, framebuffer, 0, 0, size.x, size.y, low.x, low.y, low.x + size.x, low.y + size.y,
                           GL_COLOR_BUFFER_BIT, GL_NEAREST);
}

void Painter::draw(Editor& editor, GLuint framebuffer) {
    const Workspace& workspace = editor.workspace();
    const ImDrawData& data = editor.drawData();
    if (fontsBuilt_ != editor.fontsBuilt()) interface_.uploadFonts();
    fontsBuilt_ = editor.fontsBuilt();
    glBindFramebuffer(GL_FRAMEBUFFER, framebuffer);
    glViewport(0, 0, GLsizei(data.DisplaySize.x), GLsizei(data.DisplaySize.y));
    glDisable(GL_SCISSOR_TEST);
    // Picture and panels cover the whole window, where there is a picture.
    if (!workspace.open || picture().viewSize() != workspace.viewSize) clear();
    if (workspace.open) guarded(editor, [&] { drawPicture(editor, framebuffer); });
    glBindFramebuffer(GL_FRAMEBUFFER, framebuffer);
    interface_.draw(data);
    if (workspace.open) editor.drawnBy(picture_.rendererName(), picture().slicesProblem());
    editor.picture = {.size = picture().pictureSize(),
                      .of = picture().viewSize(),
                      .progress = picture().progress(),
                      .why = picture().reason()};
}

}  // namespace voledit
