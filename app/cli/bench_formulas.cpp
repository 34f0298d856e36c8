#include "app/cli/bench_formulas.h"

#include <algorithm>
#include <cmath>
#include <random>
#include <span>
#include <vector>

#include "app/cli/bench_measure.h"
#include "app/cli/drawing.h"
#include "core/stf/transfer_definition.h"

namespace voledit {

namespace {

const Box3 kBox{{-30, -20, 10}, {50, 40, 130}};

// Written as one would by hand: a loop over points, every constant taken out of it.

void twistByHand(std::span<const Vec3> p, std::span<Vec3> q) {
    const Vec3 centre = kBox.center();
    const double turn = 90 * kPi / 180 / kBox.size().z;
    for (std::size_t i = 0; i < p.size(); ++i) {
        const double phi = -turn * (p[i].z - centre.z), c = std::cos(phi), s = std::sin(phi);
        const double x = p[i].x - centre.x, y = p[i].y - centre.y;
        q[i] = {centre.x + x * c - y * s, centre.y + x * s + y * c, p[i].z};
    }
}

void bendByHand(std::span<const Vec3> p, std::span<Vec3> q) {
    const Vec3 centre = kBox.center();
    const double angle = 90 * kPi / 180, rho = kBox.size().z / angle;
    for (std::size_t i = 0; i < p.size(); ++i) {
        const double x = p[i].z - centre.z, y = p[i].x - centre.x;
        const double around = std::atan2(x, rho - y);
        const double phi = std::min(std::max(around, -angle / 2), angle / 2), c = std::cos(phi), s = std::sin(phi);
        const double along = rho * phi + x * c + (y - rho) * s, across = y * c - x * s + rho * (1 - c);
        const bool hidden = std::abs(around) <= angle / 2 && across >= rho;
        q[i] = hidden ? kUndefined : Vec3(centre.x + across, p[i].y, centre.z + along);
    }
}

void openByHand(std::span<const Vec3> p, std::span<Vec3> q) {
    const Vec3 size = kBox.size();
    for (std::size_t i = 0; i < p.size(); ++i) {
        const double a = (p[i].x - kBox.min.x) / size.x, h = (p[i].y - kBox.min.y) / size.y;
        const double s = 0.2 * (1 - std::min(std::max(h, 0.0), 1.0));
        q[i] = p[i];
        if (a < 0.5 - s)
            q[i].x += s * size.x;
        else if (a > 0.5 + s)
            q[i].x -= s * size.x;
        else
            q[i] = kUndefined;
    }
}

TransferPtr byFormula(const std::string& name, std::map<std::string, TransferArgument> arguments) {
    return libraryTransfer(name)->make({std::move(arguments), frameOf(kBox), Outside::Hide, 1, 0});
}

}  // namespace

nlohmann::ordered_json benchFormulas(int repeats) {
    using Numbers = std::vector<double>;
    using Axes = std::vector<int>;
    struct Case {
        const char* name;
        TransferPtr formula;
        void (*code)(std::span<const Vec3>, std::span<Vec3>);
    };
    const Case cases[] = {
        {"twist", byFormula("twist", {{"axis", Axes{2}}, {"angle", Numbers{90}}}), twistByHand},
        {"bend", byFormula("bend", {{"axis", Axes{2}}, {"toward", Axes{0}}, {"angle", Numbers{90}}}), bendByHand},
        {"open", byFormula("open", {{"axis", Axes{0}}, {"hinge", Axes{1}}}), openByHand},
    };
    std::mt19937_64 random(1);
    std::uniform_real_distribution<double> unit(0, 1);
    std::vector<Vec3> p(std::size_t(1) << 18), q(p.size());
    for (Vec3& v : p) v = kBox.min + kBox.size() * Vec3(unit(random), unit(random), unit(random));
    nlohmann::ordered_json json;
    for (const Case& c : cases) {
        // One after the other, so that both meet the same machine; the first ones warm caches.
        std::vector<double> formula, code, ratio;
        for (int i = 0; i <= repeats; ++i) {
            const double f = millisecondsOf([&] { c.formula->map(p, q); });
            const double d = millisecondsOf([&] { c.code(p, q); });
            if (i == 0) continue;
            formula.push_back(double(p.size()) / f / 1000);
            code.push_back(double(p.size()) / d / 1000);
            ratio.push_back(f / d);
        }
        json[c.name] = {{"formula_mpoints_per_s", medianOf(formula)},
                        {"code_mpoints_per_s", medianOf(code)},
                        {"ratio", medianOf(ratio)}};
    }
    return json;
}

}  // namespace voledit
