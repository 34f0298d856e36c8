#pragma once
// OpenGL 4.5 contexts without a window, behind one small interface.

#include <memory>
#include <string>

namespace voledit {

enum class GlBackend : unsigned char { Auto, Egl, Osmesa };

/// A current-able OpenGL 4.5 core context. A window's own context implements it in app/.
class GlContext {
public:
    virtual ~GlContext() = default;
    /// Makes it current on the calling thread and loads GL's functions for it.
    virtual void makeCurrent() = 0;
    /// "egl", "osmesa" or "window".
    virtual std::string name() const = 0;
};

/// EGL surfaceless, or OSMesa by dlopen; Auto tries EGL, then OSMesa. Already current. Throws Error that says what was
/// tried and which packages give it.
std::unique_ptr<GlContext> createOffscreenContext(GlBackend backend);

/// Loads GL's functions by `loader`; throws Error if 4.5 is not there. For implementations of GlContext.
void loadGl(void* (*loader)(const char*));

}  // namespace voledit
