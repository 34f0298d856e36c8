#pragma once
// The two ways of drawing a compiled scene into a texture, behind one interface.

#include <memory>
#include <string>
#include <vector>

#include "core/base/picture.h"
#include "core/scene/compile.h"
#include "render/gl_objects.h"
#include "render/slice_renderer.h"

namespace voledit {

/// A picture that a source has drawn, of whatever resolution.
struct SourceTexture {
    GLuint name = 0;
    bool flipped = false;  // its first row is the upper one
    bool opaque = false;   // the background is already under it
};

/// How well a picture is drawn, beside its size.
struct PictureEffort {
    double step = 1;      // so many times the scene's step
    bool moving = false;  // it is seen for a moment: what is much faster may be a little wrong
};

/// Draws pictures a little at a time. Needs the same current context for every call and for destruction.
class PictureSource {
public:
    virtual ~PictureSource() = default;

    /// Starts a picture; what was unfinished is dropped. Throws Error where it cannot draw the scene.
    virtual void begin(const CompiledScene& scene, Index2 size, const PictureEffort& effort) = 0;
    /// Works for about `budgetMs` (≤ 0: to the end). True when the picture is complete.
    virtual bool advance(double budgetMs) = 0;
    /// 0…1 of it is drawn.
    virtual double progress() const = 0;
    /// True where `moving` makes another picture.
    virtual bool movingDiffers() const = 0;
    /// What the picture lacks, for the user to know, a line each.
    virtual std::vector<std::string> notices() const { return {}; }
    /// The picture, once complete; valid until the next begin().
    virtual SourceTexture texture() = 0;
    /// The same with the background under it, in the CPU's memory.
    virtual const Picture& picture() = 0;
};

/// OpenGL slices.
std::unique_ptr<PictureSource> makeSliceSource();
/// Rays on the CPU.
std::unique_ptr<PictureSource> makeRaySource();

}  // namespace voledit
