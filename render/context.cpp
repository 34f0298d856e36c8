#include "render/context.h"

#include <glad/gl.h>

#include "core/base/error.h"
#include "render/offscreen.h"

namespace voledit {

namespace {
GLADapiproc resolve(void* loader, const char* name) {
    return reinterpret_cast<GLADapiproc>(reinterpret_cast<void* (*)(const char*)>(loader)(name));
}
}  // namespace

void loadGl(void* (*loader)(const char*)) {
    const int version = gladLoadGLUserPtr(resolve, reinterpret_cast<void*>(loader));
    if (version < GLAD_MAKE_VERSION(4, 5))
        throw Error("OpenGL",
                    "version 4.5 is needed, this context has " + std::to_string(GLAD_VERSION_MAJOR(version)) + "." +
                        std::to_string(GLAD_VERSION_MINOR(version)),
                    "update the graphics driver, or use --gl osmesa or --renderer rays");
}

std::unique_ptr<GlContext> createOffscreenContext(GlBackend backend) {
    std::string tried;
    if (backend != GlBackend::Osmesa) {
        try {
            return createEglContext();
        } catch (const Error& e) {
            tried = e.what();
        }
    }
    if (backend != GlBackend::Egl) {
        try {
            return createOsmesaContext();
        } catch (const Error& e) {
            tried += (tried.empty() ? "" : "; ") + std::string(e.what());
        }
    }
    throw Error("OpenGL without a window", tried,
                "install libegl1 and libgl1-mesa-dri, or libosmesa6, or use --renderer rays");
}

}  // namespace voledit
