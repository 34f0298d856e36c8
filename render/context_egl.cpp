#include <EGL/egl.h>
#include <EGL/eglext.h>

#include "core/base/error.h"
#include "render/offscreen.h"

namespace voledit {

namespace {

std::string eglProblem(const char* call) {
    char code[16];
    std::snprintf(code, sizeof code, "0x%04x", unsigned(eglGetError()));
    return std::string("EGL: ") + call + " failed (" + code + ")";
}

void* eglFunction(const char* name) {
    return reinterpret_cast<void*>(eglGetProcAddress(name));
}

class EglContext final : public GlContext {
public:
    EglContext() {
        display_ = eglGetPlatformDisplay(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, nullptr);
        if (display_ == EGL_NO_DISPLAY || !eglInitialize(display_, nullptr, nullptr))
            throw Error(eglProblem("opening the surfaceless platform"));
        if (!eglBindAPI(EGL_OPENGL_API)) throw Error(eglProblem("binding OpenGL"));
        const EGLint attributes[] = {
            EGL_CONTEXT_MAJOR_VERSION,           4,       EGL_CONTEXT_MINOR_VERSION, 5, EGL_CONTEXT_OPENGL_PROFILE_MASK,
            EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT, EGL_NONE};
        context_ = eglCreateContext(display_, EGL_NO_CONFIG_KHR, EGL_NO_CONTEXT, attributes);
        if (context_ == EGL_NO_CONTEXT) throw Error(eglProblem("creating an OpenGL 4.5 context"));
        makeCurrent();
    }

    ~EglContext() override {
        // The display is one for the whole process, so it is left open for other contexts.
        if (eglGetCurrentContext() == context_)
            eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
        if (context_ != EGL_NO_CONTEXT) eglDestroyContext(display_, context_);
    }

    void makeCurrent() override {
        eglBindAPI(EGL_OPENGL_API);
        if (!eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, context_))
            throw Error(eglProblem("making the context current"));
        loadGl(eglFunction);
    }

    std::string name() const override { return "egl"; }

private:
    EGLDisplay display_ = EGL_NO_DISPLAY;
    EGLContext context_ = EGL_NO_CONTEXT;
};

}  // namespace

std::unique_ptr<GlContext> createEglContext() {
    return std::make_unique<EglContext>();
}

}  // namespace voledit
