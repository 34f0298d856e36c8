#pragma once
// One slice of a map that lies upon itself, before its pre-images are composited as one sample.

#include <array>

#include "core/objects/term.h"
#include "render/gl_objects.h"

namespace voledit {

/// Two 32-bit float textures (what fold.frag samples, and its light) and a depth that chooses between pre-images; its
/// stencil notes which pixels the cells cover at all.
///   union         one pass; the least depth (largest opacity) gives both
///   first         one pass; the first drawn gives both
///   merge         sums, then the light of the largest opacity
///   intersection  the colour of the largest opacity, then light and thickness of the smallest
class FoldTarget {
public:
    static int passes(Combine combine) { return combine == Combine::Union || combine == Combine::First ? 1 : 2; }

    void resize(Index2 size);
    /// Binds pass `pass` of a slice and clears what it needs within the scissor, which the caller sets.
    void start(Combine combine, int pass) const;
    /// Draws that follow are cells (they cover), or lie only where no cell was.
    void drawCells() const;
    void drawUncovered() const;
    /// Binds both textures to units 0 and 1.
    void bindTextures() const;

private:
    Index2 size_{0, 0};
    Texture sampled_, lit_, depth_;
    Framebuffer both_, onlySampled_, onlyLit_;
};

}  // namespace voledit
