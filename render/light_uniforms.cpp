#include "render/light_uniforms.h"

#include "core/base/error.h"

namespace voledit {

namespace {

// Beyond the units that volumes and tables take.
constexpr GLuint kAlphaUnit = 40, kClearanceUnit = 41, kOpennessUnit = 42, kShadowUnit = 43;

Texture texture3D(GLenum format, GLsizei levels, Index3 size, GLenum minify, GLenum magnify) {
    Texture texture = makeTexture(GL_TEXTURE_3D, minify, magnify);
    while (glGetError() != GL_NO_ERROR) {
    }
    glTextureStorage3D(texture.name(), levels, format, size.x, size.y, size.z);
    if (glGetError() != GL_NO_ERROR)
        throw Error("shadows and occlusion", "the GPU's memory is too small for the opacity around",
                    "use --renderer rays");
    return texture;
}

void upload(const Texture& texture, int level, Index3 size, GLenum channels, const std::vector<std::uint16_t>& texels) {
    glTextureSubImage3D(texture.name(), level, 0, 0, 0, size.x, size.y, size.z, channels, GL_UNSIGNED_SHORT,
                        texels.data());
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
    glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
    if (grid_ != surroundings.grid()) {
        grid_.reset();
        uploadGrid(*surroundings.grid());
        grid_ = surroundings.grid();
    }
    if (surroundings.openness() && openness_ != surroundings.openness()) {
        openness_.reset();
        const Index3 size = surroundings.openness()->size();
        open_ = texture3D(GL_RG16, 1, size, GL_LINEAR, GL_LINEAR);
        upload(open_, 0, size, GL_RG, surroundings.openness()->nodes());
        openness_ = surroundings.openness();
    }
    if (surroundings.shadows() && shadows_ != surroundings.shadows()) {
        // Its size changes as seldom as the grid's, where lights move with the camera.
        const Index3 size = surroundings.shadows()->size();
        if (!shadows_ || shadows_->size() != size) {
            shadows_.reset();
            left_ = texture3D(GL_R16, 1, size, GL_LINEAR, GL_LINEAR);
            glTextureParameteri(left_.name(), GL_TEXTURE_WRAP_S, GL_REPEAT);
            glTextureParameteri(left_.name(), GL_TEXTURE_WRAP_T, GL_REPEAT);
        }
        upload(left_, 0, size, GL_RED, surroundings.shadows()->left());
        shadows_ = surroundings.shadows();
    }
    towardFirst_ = surroundings.towardFirst();
    glPixelStorei(GL_UNPACK_ALIGNMENT, 4);
}

void SurroundingsTexture::uploadGrid(const OpacityGrid& grid) {
    alpha_ = texture3D(GL_R16, OpacityGrid::kLevels, grid.size(), GL_LINEAR_MIPMAP_NEAREST, GL_LINEAR);
    clearance_ = texture3D(GL_R8UI, 1, grid.brickCount(), GL_NEAREST, GL_NEAREST);
    for (int l = 0; l < OpacityGrid::kLevels; ++l) upload(alpha_, l, grid.level(l).size, GL_RED, grid.level(l).alpha);
    const Index3 bricks = grid.brickCount();
    glTextureSubImage3D(clearance_.name(), 0, 0, 0, 0, bricks.x, bricks.y, bricks.z, GL_RED_INTEGER, GL_UNSIGNED_BYTE,
                        grid.clearance().data());
}

void SurroundingsTexture::setUniforms(Program& p, const RenderSettings& settings, const View& view,
                                      double referenceDepth) const {
    const Mat3 rays = Mat3(view.rayAtOrigin(), view.rayPerPixelX(), view.rayPerPixelY()) / grid_->spacing();
    Mat3 atReference = referenceDepth * rays;
    atReference[0] += (view.eye - grid_->origin()) / grid_->spacing();
    p.set("gridAlpha", int(kAlphaUnit));
    p.set("gridClearance", int(kClearanceUnit));
    p.set("gridOpenness", int(kOpennessUnit));
    p.set("lightLeft", int(kShadowUnit));
    p.set("gridSize", Vec3f(grid_->size()));
    p.set("gridAtReference", Mat3f(atReference));
    p.set("gridPerDepth", Mat3f(rays));
    p.set("shadowStrength", float(settings.shadows));
    p.set("occlusionStrength", float(settings.occlusion));
    if (openness_) p.set("opennessTexel", 1.0F / (2.0F * Vec3f(openness_->size())));
    if (!shadows_) return;
    Mat4f texture(1);
    for (int a = 0; a < 3; ++a) texture[a][a] = 1 / float(shadows_->size()[a]);
    Mat4f started(1);
    started[3] = Vec4f(light_march::kStart * towardFirst_, 1);
    p.set("lightFromGrid", texture * shadows_->raysFromGrid() * started);
}

void SurroundingsTexture::bind() const {
    if (!grid_) return;
    glBindTextureUnit(kAlphaUnit, alpha_.name());
    glBindTextureUnit(kClearanceUnit, clearance_.name());
    if (openness_) glBindTextureUnit(kOpennessUnit, open_.name());
    if (shadows_) glBindTextureUnit(kShadowUnit, left_.name());
}

}  // namespace voledit
