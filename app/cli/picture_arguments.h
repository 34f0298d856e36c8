#pragma once
// Flags of the commands that draw pictures: `render` and `animate`.

#include <memory>
#include <string>

#include "app/cli/arguments.h"
#include "app/cli/drawing.h"

namespace voledit {

struct PictureArguments {
    std::string size = "960x720", renderer, gl = "auto", camera;
    double step = kNaN;
    int supersample = 1;  // so many times the pixels along each side are drawn, and averaged

    /// Throws UsageError for a value that cannot be.
    void check() const;
    /// Throws UsageError.
    Index2 pixels() const { return parseSize2(size, "--size"); }
    /// Puts camera and step into the scene. Throws Error for the camera's file.
    void applyTo(Scene& scene) const;
    /// Throws Error where the context cannot be made.
    std::unique_ptr<Drawing> drawing() const { return makeDrawing(renderer, gl); }
};

void addPictureArguments(CLI::App& command, PictureArguments& arguments);

}  // namespace voledit
