#pragma once
// The two kinds of context without a window. Include render/context.h to make one.

#include <memory>

#include "render/context.h"

namespace voledit {

/// OpenGL 4.5 core on EGL's surfaceless platform: no display, no config, no surface. Current. Throws Error.
std::unique_ptr<GlContext> createEglContext();

/// OpenGL 4.5 core from libOSMesa, opened at run time. Current. Throws Error.
std::unique_ptr<GlContext> createOsmesaContext();

}  // namespace voledit
