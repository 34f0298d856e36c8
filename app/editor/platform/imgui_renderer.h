#pragma once
// Draws ImGui's triangles with OpenGL objects of ours (its own backend opens libGL, which OSMesa cannot bear).

#include "render/gl_objects.h"
#include "render/shader_library.h"

struct ImDrawData;
struct ImDrawList;
struct ImDrawCmd;

namespace voledit {

/// Needs a current context, the same one for every call and for destruction.
class ImGuiRenderer {
public:
    explicit ImGuiRenderer(ShaderLibrary& shaders);

    /// Uploads the font atlas of the current ImGui context; again after the fonts changed.
    void uploadFonts();

    /// Draws over the bound framebuffer, whose size must be the draw data's. Texture 0 means the fonts, any other
    /// number is a GL texture's name; what has Editor::kViewTexture is there already.
    void draw(const ImDrawData& data);

private:
    void drawList(const ImDrawList& list, float height);
    void drawCommand(const ImDrawCmd& command, float height);

    ShaderLibrary& shaders_;
    VertexArray array_;
    Buffer vertices_, indices_;
    Texture fonts_;
};

}  // namespace voledit
