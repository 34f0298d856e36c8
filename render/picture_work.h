#pragma once
// A picture that is drawn piece by piece.

#include "render/slice_renderer.h"

namespace voledit {

/// One picture under way; its pixels gather in the workshop's target.
class PictureWork {
public:
    virtual ~PictureWork() = default;

    /// Pieces of this picture, and those of them that are drawn.
    virtual int pieceCount() const = 0;
    virtual int piecesDone() const = 0;
    bool done() const { return piecesDone() >= pieceCount(); }
    /// Draws up to `count` pieces.
    virtual void draw(int count) = 0;
    /// Pieces that are worth drawing in one call.
    virtual int mostAtOnce() const = 0;

    virtual const SliceStatistics& statistics() const = 0;
};

}  // namespace voledit
