#include "app/cli/picture_arguments.h"

#include <CLI/App.hpp>
#include <algorithm>
#include <cmath>

#include "app/cli/output.h"

namespace voledit {

namespace {
constexpr int kMostSupersampling = 8, kMostPixels = 16384;  // what OpenGL can draw at once
}

void PictureArguments::check() const {
    pixels();
    checkDrawingNames(renderer, gl);
    if (!std::isnan(step) && !(step >= 0.001 && step <= 1000))
        throw UsageError("--step: give a number from 0.001 to 1000");
    if (supersample < 1 || supersample > kMostSupersampling)
        throw UsageError("--supersample: give a number from 1 to " + std::to_string(kMostSupersampling));
    const Index2 drawn = pixels() * supersample;
    if (std::max(drawn.x, drawn.y) > kMostPixels)
        throw UsageError("--supersample " + std::to_string(supersample) + " of --size " + size + ": draws more than " +
                         std::to_string(kMostPixels) + " pixels along a side; give less of either");
}

void PictureArguments::applyTo(Scene& scene) const {
    if (!camera.empty()) scene.camera = readCamera(camera);
    if (!std::isnan(step)) scene.render.step = step;
}

void addPictureArguments(CLI::App& command, PictureArguments& a) {
    command.add_option("--size", a.size, "Width and height in pixels")->capture_default_str()->type_name("WxH");
    command.add_option("--renderer", a.renderer,
                       "slices (OpenGL, the default), rays (CPU), or reference (CPU, double precision, slow)");
    command.add_option("--step", a.step, "Distance of samples in units of the smallest spacing")->type_name("F");
    command
        .add_option("--supersample", a.supersample,
                    "Draw N times the pixels along each side and average them: smoother edges")
        ->type_name("N");
    command.add_option("--camera", a.camera, "JSON file with eye, target, up, fovY")->type_name("FILE");
    command.add_option("--gl", a.gl, "osmesa, egl or auto")->capture_default_str();
}

}  // namespace voledit
