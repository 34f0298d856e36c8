#include "tests/render/term_probe_fixtures.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <random>

#include "core/base/paths.h"
#include "render/gl_objects.h"
#include "render/shader_library.h"
#include "render/term_resources.h"
#include "tests/render/render_fixtures.h"

namespace voledit::test {

namespace {

constexpr int kWidth = 256;

std::vector<Vec4f> readBack(const Texture& texture, Index2 size) {
    std::vector<Vec4f> pixels(std::size_t(size.x) * std::size_t(size.y));
    glGetTextureImage(texture.name(), 0, GL_RGBA, GL_FLOAT, GLsizei(pixels.size() * sizeof(Vec4f)), pixels.data());
    return pixels;
}

Texture pointTexture(const std::vector<Vec3>& p, const Vec3& origin, Index2 size) {
    std::vector<Vec4f> texels(std::size_t(size.x) * std::size_t(size.y), Vec4f(0));
    for (std::size_t n = 0; n < p.size(); ++n) texels[n] = Vec4f(Vec3f(p[n] - origin), 1);
    Texture texture = makeTexture2D(GL_RGBA32F, size);
    glTextureSubImage2D(texture.name(), 0, 0, 0, size.x, size.y, GL_RGBA, GL_FLOAT, texels.data());
    return texture;
}

}  // namespace

Probed probed(const TermPtr& term, const std::vector<Vec3>& p) {
    offscreen();
    static ShaderLibrary* library = new ShaderLibrary(shaderFolder());
    TermResources resources;
    resources.prepare(makeTermProgram(term));
    const TermProgram& made = resources.program();
    const Index2 size(kWidth, int(p.size() + kWidth - 1) / kWidth);
    const Texture points = pointTexture(p, made.origin, size), seen = makeTexture2D(GL_RGBA32F, size),
                  lit = makeTexture2D(GL_RGBA32F, size);
    const Framebuffer target = makeFramebuffer(seen.name(), 0, false);
    glNamedFramebufferTexture(target.name(), GL_COLOR_ATTACHMENT1, lit.name(), 0);
    const GLenum buffers[2] = {GL_COLOR_ATTACHMENT0, GL_COLOR_ATTACHMENT1};
    glNamedFramebufferDrawBuffers(target.name(), 2, buffers);

    Program& program = library->get({"fullscreen.vert", "term_probe.frag", made.defines(), made.text});
    program.set("tables", 0);
    program.set("points", 15);
    resources.bind();
    glBindTextureUnit(15, points.name());
    glBindFramebuffer(GL_FRAMEBUFFER, target.name());
    glViewport(0, 0, size.x, size.y);
    glDisable(GL_DEPTH_TEST);
    glDisable(GL_BLEND);
    glDisable(GL_SCISSOR_TEST);
    program.use();
    const VertexArray nothing = makeVertexArray();
    glBindVertexArray(nothing.name());
    glDrawArrays(GL_TRIANGLES, 0, 3);
    glBindFramebuffer(GL_FRAMEBUFFER, 0);

    const std::vector<Vec4f> colors = readBack(seen, size), gradients = readBack(lit, size);
    Probed result;
    for (std::size_t n = 0; n < p.size(); ++n) {
        result.plain.push_back({colors[n].a, Vec3(colors[n]), kNaN, Vec3(0)});
        result.lit.push_back({gradients[n].a, Vec3(0), kNaN, Vec3(gradients[n])});
    }
    return result;
}

std::vector<Vec3> pointsIn(const Box3& box, int count, unsigned seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> share(0, 1);
    std::vector<Vec3> p;
    for (int n = 0; n < count; ++n) {
        const Vec3 u(share(random), share(random), share(random));
        p.push_back(box.min + u * box.size());
    }
    return p;
}

void expectParity(const TermPtr& term, const ParityLimits& limits, int count) {
    const Vec3 margin = 0.05 * term->bounds.size();
    const std::vector<Vec3> p =
        pointsIn(limits.box.value_or(Box3{term->bounds.min - margin, term->bounds.max + margin}), count);
    std::vector<ObjectSample> expected(p.size());
    sample(*term, p, expected, true);
    const Probed got = probed(term, p);
    double steepest = 0;
    int visible = 0, outliers = 0;
    for (const ObjectSample& s : expected) {
        steepest = std::max(steepest, glm::length(s.normalGradient));
        visible += s.opacity > 0;
    }
    EXPECT_GE(visible, limits.visible * count)
        << "there is too little to compare in " << term->bounds.min.x << " … " << term->bounds.max.x;
    double worstOpacity = 0, worstColor = 0, worstGradient = 0;
    std::string first;
    for (std::size_t n = 0; n < p.size(); ++n) {
        const ObjectSample& e = expected[n];
        const double opacity =
            std::max(std::abs(got.plain[n].opacity - e.opacity), std::abs(got.lit[n].opacity - e.opacity));
        const double color = e.opacity > 1e-4 ? glm::length(got.plain[n].color - e.color) : 0;
        const double gradient =
            e.opacity > 1e-4 ? glm::length(got.lit[n].normalGradient - e.normalGradient) / std::max(steepest, 1e-30)
                             : 0;
        const bool good = opacity <= limits.opacity && color <= limits.color && gradient <= limits.gradient;
        if (good) {
            worstOpacity = std::max(worstOpacity, opacity);
            worstColor = std::max(worstColor, color);
            worstGradient = std::max(worstGradient, gradient);
            continue;
        }
        if (outliers++ == 0) {
            const auto vector = [](const Vec3& v) {
                return "(" + std::to_string(v.x) + ", " + std::to_string(v.y) + ", " + std::to_string(v.z) + ")";
            };
            first = "at " + vector(p[n]) + ": opacity " + std::to_string(got.plain[n].opacity) + ", lit " +
                    std::to_string(got.lit[n].opacity) + ", expected " + std::to_string(e.opacity) + "; colour " +
                    vector(got.plain[n].color) + ", expected " + vector(e.color) + "; gradient " +
                    vector(got.lit[n].normalGradient) + ", expected " + vector(e.normalGradient);
        }
    }
    EXPECT_LE(outliers, limits.outliers * count) << "of " << count << " points; " << first << "; the others differ by "
                                                 << worstOpacity << ", " << worstColor << ", " << worstGradient;
}

}  // namespace voledit::test
