#pragma once
// How the editor looks: colours, fonts, spacing.

#include <imgui.h>

#include "core/base/types.h"

namespace voledit {

/// Colours of the interface and of what is drawn over the picture, sRGB with straight alpha. One accent.
namespace theme {
inline constexpr Vec4f kWindow{0.114f, 0.118f, 0.129f, 1};   // behind everything
inline constexpr Vec4f kPanel{0.145f, 0.149f, 0.165f, 1};    // panels
inline constexpr Vec4f kHeader{0.180f, 0.186f, 0.206f, 1};   // section headers, tool bars
inline constexpr Vec4f kField{0.098f, 0.101f, 0.112f, 1};    // what is typed or dragged in
inline constexpr Vec4f kControl{0.235f, 0.243f, 0.270f, 1};  // buttons
inline constexpr Vec4f kLine{0.078f, 0.080f, 0.089f, 1};     // separators
inline constexpr Vec4f kText{0.890f, 0.898f, 0.914f, 1};
inline constexpr Vec4f kTextDim{0.580f, 0.600f, 0.640f, 1};
inline constexpr Vec4f kAccent{0.302f, 0.596f, 0.949f, 1};   // selection, active things
inline constexpr Vec4f kWarning{0.965f, 0.647f, 0.239f, 1};  // folded control points, warnings
inline constexpr Vec4f kProblem{0.925f, 0.365f, 0.349f, 1};
inline constexpr Vec4f kAnimated{0.955f, 0.785f, 0.310f, 1};  // values that change over time
/// World axes x, y, z.
inline constexpr std::array<Vec4f, 3> kAxis{Vec4f{0.925f, 0.373f, 0.376f, 1}, Vec4f{0.541f, 0.780f, 0.353f, 1},
                                            Vec4f{0.353f, 0.576f, 0.937f, 1}};
}  // namespace theme

/// `color` as ImGui packs it, its alpha times `alpha`.
ImU32 packed(const Vec4f& color, float alpha = 1);
/// `color` with another alpha.
Vec4f withAlpha(const Vec4f& color, float alpha);

/// The fonts of the current context's atlas, in the order that `applyTheme` adds them.
enum class FontRole : int { Text, Strong, Small, Mono };
ImFont* font(FontRole role);

/// Sets style and fonts (Inter, and DejaVu Sans Mono for formulas, with Font Awesome's icons merged in; ImGui's own
/// where those files are missing) of the current ImGui context for `scale` pixels a design pixel. The atlas is cleared
/// and built anew: its texture must be uploaded again.
void applyTheme(float scale);

}  // namespace voledit
