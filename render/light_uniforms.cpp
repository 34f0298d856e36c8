#include "render/light_uniforms.h"

#include "core/base/error.h"

namespace voledit {

namespace {

// Beyond the units that volumes and tables take.
constexpr GLuint kAlphaUnit = 40, kClearanceUnit = 41;

Texture texture3D(GLenum format, GLsizei levels, Index3 size, GLenum minify, GLenum magnify) {
    GLuint name = 0;
    glCreateTextures(GL_TEXTURE_3D, 1, &name);
    Texture texture(name);
    glTextureParameteri(name, GL_TEXTURE_MIN_FILTER, GLint(minify));
    glTextureParameteri(name, GL_TEXTURE_MAG_FILTER, GLint(magnify));
    for (const GLenum wrap : {GL_TEXTURE_WRAP_S, GL_TEXTURE_WRAP_T, GL_TEXTURE_WRAP_R})
        glTextureParameteri(name, wrap, GL_CLAMP_TO_EDGE);
    while (glGetError() != GL_NO_ERROR) {
    }
    glTextureStorage3D(name, levels, format, size.x, size.y, size.z);
    if (glGetError() != GL_NO_ERROR)
        throw Error("shadows and occlusion", "the GPU's memory is too small for the opacity around",
                    "use --renderer rays");
    return texture;
}

}  // namespace

void setLights(Program& p, const RenderSettings& settings, const Lights& lights) {
    p.set("lighting",
          Vec4f(settings.ambient * lights.ambient, settings.diffuse, settings.specular, settings.shininess));
    p.set("lightKind", int(lights.kind));
    p.set("lightCount", int(lights.count));
    for (std::size_t l = 0; l < Lights::kMost; ++l) {
        const std::string index = "[" + std::to_string(l) + "]";
        p.set(("lightsToward" + index).c_str(), Vec3f(lights.light[l].toward));
        p.set(("lightIntensity" + index).c_str(), float(lights.light[l].intensity));
    }
}

void SurroundingsTexture::prepare(const Surroundings& surroundings) {
    radius_ = surroundings.radius();
    if (grid_ == surroundings.grid()) return;
    grid_.reset();
    const OpacityGrid& grid = *surroundings.grid();
    alpha_ = texture3D(GL_R16, OpacityGrid::kLevels, grid.size(), GL_LINEAR_MIPMAP_NEAREST, GL_LINEAR);
    clearance_ = texture3D(GL_R8UI, 1, grid.brickCount(), GL_NEAREST, GL_NEAREST);
    glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
    for (int l = 0; l < OpacityGrid::kLevels; ++l) {
        const OpacityGrid::Level& level = grid.level(l);
        glTextureSubImage3D(alpha_.name(), l, 0, 0, 0, level.size.x, level.size.y, level.size.z, GL_RED,
                            GL_UNSIGNED_SHORT, level.alpha.data());
    }
    const Index3 bricks = grid.brickCount();
    glTextureSubImage3D(clearance_.name(), 0, 0, 0, 0, bricks.x, bricks.y, bricks.z, GL_RED_INTEGER, GL_UNSIGNED_BYTE,
                        grid.clearance().data());
    glPixelStorei(GL_UNPACK_ALIGNMENT, 4);
    grid_ = surroundings.grid();
}

void SurroundingsTexture::setUniforms(Program& p, const RenderSettings& settings, const View& view,
                                      double referenceDepth) const {
    const Mat3 rays = Mat3(view.rayAtOrigin(), view.rayPerPixelX(), view.rayPerPixelY()) / grid_->spacing();
    Mat3 atReference = referenceDepth * rays;
    atReference[0] += (view.eye - grid_->origin()) / grid_->spacing();
    p.set("gridAlpha", int(kAlphaUnit));
    p.set("gridClearance", int(kClearanceUnit));
    p.set("gridSize", Vec3f(grid_->size()));
    p.set("gridAtReference", Mat3f(atReference));
    p.set("gridPerDepth", Mat3f(rays));
    p.set("shadowStrength", float(settings.shadows));
    p.set("occlusionStrength", float(settings.occlusion));
    const auto& directions = light_march::directions();
    for (std::size_t n = 0; n < directions.size(); ++n)
        p.set(("occlusionDirections[" + std::to_string(n) + "]").c_str(), directions[n]);
    const auto stretches = light_march::stretchesTo(radius_);
    for (std::size_t n = 0; n < stretches.size(); ++n) {
        const light_march::Stretch& s = stretches[n];
        p.set(("occlusionStretches[" + std::to_string(n) + "]").c_str(),
              Vec4f(s.middle, s.length, float(s.level), s.counts));
    }
}

void SurroundingsTexture::bind() const {
    if (!grid_) return;
    glBindTextureUnit(kAlphaUnit, alpha_.name());
    glBindTextureUnit(kClearanceUnit, clearance_.name());
}

}  // namespace voledit
