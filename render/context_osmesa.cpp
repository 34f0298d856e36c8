#include <dlfcn.h>

#include <array>

#include "core/base/error.h"
#include "render/offscreen.h"

namespace voledit {

namespace {

// OSMesa's header pulls in the system's gl.h, which fights with the generated loader, and linking the library breaks
// its calls where EGL is linked too; so its four functions and six constants are declared here (osmesa.h, Mesa 22.3).
using CreateContextAttribs = void* (*)(const int* attributes, void* share);
using MakeCurrent = unsigned char (*)(void* context, void* buffer, unsigned type, int width, int height);
using DestroyContext = void (*)(void* context);
using GetProcAddress = void* (*)(const char* name);

constexpr int kFormat = 0x22, kRgba = 0x1908, kProfile = 0x33, kCoreProfile = 0x34, kMajor = 0x36, kMinor = 0x37;
constexpr unsigned kUnsignedByte = 0x1401;

struct Library {
    CreateContextAttribs create = nullptr;
    MakeCurrent makeCurrent = nullptr;
    DestroyContext destroy = nullptr;
    GetProcAddress function = nullptr;
};

const Library& library() {
    // Kept open for the process's life: Mesa's threads outlive contexts.
    static const Library opened = [] {
        void* handle = dlopen("libOSMesa.so.8", RTLD_NOW | RTLD_LOCAL);
        if (!handle) throw Error(std::string("OSMesa: ") + dlerror());
        Library l;
        l.create = reinterpret_cast<CreateContextAttribs>(dlsym(handle, "OSMesaCreateContextAttribs"));
        l.makeCurrent = reinterpret_cast<MakeCurrent>(dlsym(handle, "OSMesaMakeCurrent"));
        l.destroy = reinterpret_cast<DestroyContext>(dlsym(handle, "OSMesaDestroyContext"));
        l.function = reinterpret_cast<GetProcAddress>(dlsym(handle, "OSMesaGetProcAddress"));
        if (!l.create || !l.makeCurrent || !l.destroy || !l.function)
            throw Error("OSMesa: libOSMesa.so.8 lacks a function");
        return l;
    }();
    return opened;
}

void* osmesaFunction(const char* name) {
    return library().function(name);
}

class OsmesaContext final : public GlContext {
public:
    OsmesaContext() {
        const int attributes[] = {kFormat, kRgba, kProfile, kCoreProfile, kMajor, 4, kMinor, 5, 0};
        context_ = library().create(attributes, nullptr);
        if (!context_) throw Error("OSMesa: no OpenGL 4.5 core context");
        makeCurrent();
    }
    ~OsmesaContext() override {
        if (context_) library().destroy(context_);
    }

    void makeCurrent() override {
        if (!library().makeCurrent(context_, pixels_.data(), kUnsignedByte, kSide, kSide))
            throw Error("OSMesa: making the context current failed");
        loadGl(osmesaFunction);
    }

    std::string name() const override { return "osmesa"; }

private:
    // The default framebuffer, which nothing draws to: pictures go to framebuffer objects.
    static constexpr int kSide = 16;
    std::array<unsigned char, kSide * kSide * 4> pixels_{};
    void* context_ = nullptr;
};

}  // namespace

std::unique_ptr<GlContext> createOsmesaContext() {
    return std::make_unique<OsmesaContext>();
}

}  // namespace voledit
