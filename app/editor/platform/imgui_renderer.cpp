#include "app/editor/platform/imgui_renderer.h"

#include <imgui.h>

#include <cstddef>
#include <cstdint>

#include "app/editor/editor.h"

namespace voledit {
namespace {

const ProgramVariant kProgram{"imgui.vert", "imgui.frag", {}};

void attribute(const VertexArray& array, GLuint location, GLint count, GLenum type, std::size_t offset) {
    glEnableVertexArrayAttrib(array.name(), location);
    glVertexArrayAttribFormat(array.name(), location, count, type, type == GL_UNSIGNED_BYTE, GLuint(offset));
    glVertexArrayAttribBinding(array.name(), location, 0);
}

}  // namespace

ImGuiRenderer::ImGuiRenderer(ShaderLibrary& shaders)
    : shaders_(shaders), array_(makeVertexArray()), vertices_(makeBuffer()), indices_(makeBuffer()) {
    attribute(array_, 0, 2, GL_FLOAT, offsetof(ImDrawVert, pos));
    attribute(array_, 1, 2, GL_FLOAT, offsetof(ImDrawVert, uv));
    attribute(array_, 2, 4, GL_UNSIGNED_BYTE, offsetof(ImDrawVert, col));
    glVertexArrayVertexBuffer(array_.name(), 0, vertices_.name(), 0, sizeof(ImDrawVert));
    glVertexArrayElementBuffer(array_.name(), indices_.name());
}

void ImGuiRenderer::uploadFonts() {
    unsigned char* pixels = nullptr;
    int width = 0, height = 0;
    ImGui::GetIO().Fonts->GetTexDataAsRGBA32(&pixels, &width, &height);
    fonts_ = makeTexture2D(GL_RGBA8, {width, height});
    glTextureParameteri(fonts_.name(), GL_TEXTURE_MIN_FILTER, GL_LINEAR);
    glTextureParameteri(fonts_.name(), GL_TEXTURE_MAG_FILTER, GL_LINEAR);
    glTextureSubImage2D(fonts_.name(), 0, 0, 0, width, height, GL_RGBA, GL_UNSIGNED_BYTE, pixels);
}

void ImGuiRenderer::draw(const ImDrawData& data) {
    if (data.DisplaySize.x <= 0 || data.DisplaySize.y <= 0) return;
    glViewport(0, 0, GLsizei(data.DisplaySize.x), GLsizei(data.DisplaySize.y));
    glEnable(GL_BLEND);
    glBlendEquation(GL_FUNC_ADD);
    glBlendFuncSeparate(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA, GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
    glDisable(GL_DEPTH_TEST);
    glDisable(GL_STENCIL_TEST);
    glDisable(GL_CULL_FACE);
    glEnable(GL_SCISSOR_TEST);
    Program& program = shaders_.get(kProgram);
    program.set("size", Vec2f(data.DisplaySize.x, data.DisplaySize.y));
    program.set("image", 0);
    program.use();
    glBindVertexArray(array_.name());
    for (int n = 0; n < data.CmdListsCount; ++n) drawList(*data.CmdLists[n], data.DisplaySize.y);
    glBindVertexArray(0);
    glDisable(GL_SCISSOR_TEST);
    glDisable(GL_BLEND);
}

void ImGuiRenderer::drawList(const ImDrawList& list, float height) {
    fill(vertices_, std::span<const ImDrawVert>(list.VtxBuffer.Data, std::size_t(list.VtxBuffer.Size)));
    fill(indices_, std::span<const ImDrawIdx>(list.IdxBuffer.Data, std::size_t(list.IdxBuffer.Size)));
    for (const ImDrawCmd& command : list.CmdBuffer) {
        if (command.UserCallback)
            command.UserCallback(&list, &command);
        else
            drawCommand(command, height);
    }
}

void ImGuiRenderer::drawCommand(const ImDrawCmd& command, float height) {
    const ImVec4& clip = command.ClipRect;
    if (clip.z <= clip.x || clip.w <= clip.y) return;
    const auto id = GLuint(reinterpret_cast<std::uintptr_t>(command.GetTexID()));
    if (id == Editor::kViewTexture) return;
    glScissor(GLint(clip.x), GLint(height - clip.w), GLsizei(clip.z - clip.x), GLsizei(clip.w - clip.y));
    glBindTextureUnit(0, id == 0 ? fonts_.name() : id);
    constexpr GLenum type = sizeof(ImDrawIdx) == 2 ? GL_UNSIGNED_SHORT : GL_UNSIGNED_INT;
    const auto* offset = reinterpret_cast<const void*>(std::uintptr_t(command.IdxOffset) * sizeof(ImDrawIdx));
    glDrawElementsBaseVertex(GL_TRIANGLES, GLsizei(command.ElemCount), type, offset, GLint(command.VtxOffset));
}

}  // namespace voledit
