#include "app/editor/theme.h"

#include <imgui_freetype.h>

#include <cmath>
#include <filesystem>
#include <string>

namespace voledit {

namespace {

constexpr const char* kTextFont = "/usr/share/fonts/opentype/inter/Inter-Regular.otf";
constexpr const char* kStrongFont = "/usr/share/fonts/opentype/inter/Inter-SemiBold.otf";
constexpr const char* kMonoFont = "/usr/share/fonts/truetype/dejavu/DejaVuSansMono.ttf";
constexpr const char* kIconFont = "/usr/share/fonts/opentype/font-awesome/FontAwesome.otf";
// Letters of European languages, punctuation, arrows, mathematical signs.
constexpr ImWchar kLetters[] = {0x20, 0x17f, 0x2010, 0x2026, 0x2190, 0x2193, 0x2202, 0x2265, 0x2318, 0x2318, 0};
constexpr ImWchar kGreek[] = {0x391, 0x3c9, 0};
constexpr ImWchar kIcons[] = {0xf000, 0xf2e0, 0};

ImVec4 vec4(const Vec4f& c, float alpha = 1) {
    return {c.x, c.y, c.z, c.w * alpha};
}

void addFont(const char* path, float pixels) {
    ImFontAtlas& atlas = *ImGui::GetIO().Fonts;
    ImFontConfig config;
    config.PixelSnapH = false;
    if (!std::filesystem::exists(path)) {
        config.SizePixels = pixels;
        atlas.AddFontDefault(&config);
    } else {
        atlas.AddFontFromFileTTF(path, pixels, &config, kLetters);
        config.MergeMode = true;
        atlas.AddFontFromFileTTF(path, pixels, &config, kGreek);
    }
    if (!std::filesystem::exists(kIconFont)) return;
    ImFontConfig icons;
    icons.MergeMode = true;
    icons.GlyphMinAdvanceX = pixels * 1.25f;  // so that words after different icons line up
    icons.GlyphOffset.y = pixels * 0.04f;
    atlas.AddFontFromFileTTF(kIconFont, pixels * 0.95f, &icons, kIcons);
}

void setColors(ImGuiStyle& style) {
    using namespace theme;
    ImVec4* c = style.Colors;
    c[ImGuiCol_Text] = vec4(kText);
    c[ImGuiCol_TextDisabled] = vec4(kTextDim, 0.75f);
    c[ImGuiCol_WindowBg] = vec4(kPanel);
    c[ImGuiCol_ChildBg] = {0, 0, 0, 0};
    c[ImGuiCol_PopupBg] = vec4({0.165f, 0.170f, 0.188f, 0.985f});
    c[ImGuiCol_Border] = vec4(kLine);
    c[ImGuiCol_BorderShadow] = {0, 0, 0, 0};
    c[ImGuiCol_FrameBg] = vec4(kField);
    c[ImGuiCol_FrameBgHovered] = vec4({0.130f, 0.136f, 0.152f, 1});
    c[ImGuiCol_FrameBgActive] = vec4({0.150f, 0.160f, 0.185f, 1});
    c[ImGuiCol_TitleBg] = c[ImGuiCol_TitleBgActive] = c[ImGuiCol_TitleBgCollapsed] = vec4(kHeader);
    c[ImGuiCol_MenuBarBg] = vec4(kWindow);
    c[ImGuiCol_ScrollbarBg] = {0, 0, 0, 0};
    c[ImGuiCol_ScrollbarGrab] = vec4(kControl);
    c[ImGuiCol_ScrollbarGrabHovered] = vec4({0.30f, 0.31f, 0.34f, 1});
    c[ImGuiCol_ScrollbarGrabActive] = vec4({0.36f, 0.37f, 0.41f, 1});
    c[ImGuiCol_CheckMark] = vec4(kAccent);
    c[ImGuiCol_SliderGrab] = vec4(kAccent, 0.85f);
    c[ImGuiCol_SliderGrabActive] = vec4(kAccent);
    c[ImGuiCol_Button] = vec4(kControl);
    c[ImGuiCol_ButtonHovered] = vec4({0.290f, 0.300f, 0.332f, 1});
    c[ImGuiCol_ButtonActive] = vec4({0.220f, 0.420f, 0.670f, 1});
    c[ImGuiCol_Header] = vec4({0.204f, 0.330f, 0.490f, 1});
    c[ImGuiCol_HeaderHovered] = vec4({0.255f, 0.265f, 0.295f, 1});
    c[ImGuiCol_HeaderActive] = vec4({0.220f, 0.420f, 0.670f, 1});
    c[ImGuiCol_Separator] = vec4(kLine);
    c[ImGuiCol_SeparatorHovered] = vec4(kAccent, 0.6f);
    c[ImGuiCol_SeparatorActive] = vec4(kAccent);
    c[ImGuiCol_ResizeGrip] = {0, 0, 0, 0};
    c[ImGuiCol_ResizeGripHovered] = vec4(kAccent, 0.5f);
    c[ImGuiCol_ResizeGripActive] = vec4(kAccent);
    c[ImGuiCol_Tab] = vec4(kHeader);
    c[ImGuiCol_TabHovered] = vec4(kControl);
    c[ImGuiCol_TabActive] = vec4(kControl);
    c[ImGuiCol_TextSelectedBg] = vec4(kAccent, 0.40f);
    c[ImGuiCol_DragDropTarget] = vec4(kAccent);
    c[ImGuiCol_NavHighlight] = vec4(kAccent, 0.8f);
    c[ImGuiCol_ModalWindowDimBg] = {0, 0, 0, 0.50f};
    c[ImGuiCol_PlotHistogram] = vec4(kAccent);
}

void setSizes(ImGuiStyle& style) {
    style.WindowPadding = {10, 10};
    style.FramePadding = {8, 4};
    style.ItemSpacing = {8, 6};
    style.ItemInnerSpacing = {6, 4};
    style.IndentSpacing = 14;
    style.ScrollbarSize = 10;
    style.GrabMinSize = 8;
    style.WindowRounding = style.PopupRounding = 6;
    style.FrameRounding = style.GrabRounding = style.TabRounding = 4;
    style.ChildRounding = style.ScrollbarRounding = 4;
    style.WindowBorderSize = 0;
    style.PopupBorderSize = 1;
    style.FrameBorderSize = 0;
    style.DisabledAlpha = 0.40f;
    style.WindowMenuButtonPosition = ImGuiDir_None;
    style.WindowTitleAlign = {0, 0.5f};
}

}  // namespace

ImU32 packed(const Vec4f& color, float alpha) {
    return ImGui::ColorConvertFloat4ToU32(vec4(color, alpha));
}

Vec4f withAlpha(const Vec4f& color, float alpha) {
    return {color.x, color.y, color.z, alpha};
}

ImFont* font(FontRole role) {
    const auto& fonts = ImGui::GetIO().Fonts->Fonts;
    return int(role) < fonts.Size ? fonts[int(role)] : ImGui::GetFont();
}

void applyTheme(float scale) {
    ImGuiStyle style;
    setColors(style);
    setSizes(style);
    style.ScaleAllSizes(scale);
    style.PopupBorderSize = 1;
    ImGui::GetStyle() = style;

    ImGuiIO& io = ImGui::GetIO();
    io.ConfigDragClickToInputText = true;
    io.ConfigWindowsMoveFromTitleBarOnly = true;
    io.Fonts->Clear();
    io.Fonts->FontBuilderIO = ImGuiFreeType::GetBuilderForFreeType();
    io.Fonts->FontBuilderFlags = ImGuiFreeTypeBuilderFlags_LightHinting;
    addFont(kTextFont, std::round(15 * scale));
    addFont(kStrongFont, std::round(15 * scale));
    addFont(kTextFont, std::round(12.5f * scale));
    addFont(kMonoFont, std::round(13 * scale));
    io.Fonts->Build();
}

}  // namespace voledit
