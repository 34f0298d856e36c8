#pragma once
// Scenes as JSON text, compiled: for the tests of compile().

#include "core/scene/compile.h"
#include "core/scene/scene_json.h"
#include "core/stf/affine.h"

namespace voledit::test {

inline const std::string kBox =
    R"({"type": "solid", "shape": {"box": {"min": [0, 0, 0], "max": [8, 4, 2]}}, "color": [1, 1, 1], "opacity": 1})";

/// `members` are further ones of the scene, each with a comma behind it.
inline Scene sceneOf(const std::string& root, const std::string& members = "") {
    return sceneFromJson(R"({"voledit": 1, )" + members + R"("root": )" + root + "}", "/scene.voledit");
}
inline CompiledScene compiled(const std::string& root, const std::string& members = "",
                              const LoadedAssets& assets = {}) {
    return compile(sceneOf(root, members), assets, 0, nullptr);
}

inline std::string transfer(const std::string& by, const std::string& of = kBox) {
    return R"({"type": "transfer", "by": )" + by + R"(, "of": )" + of + "}";
}
inline std::string displace(const std::string& by, const std::string& of = kBox) {
    return R"({"type": "displace", "by": )" + by + R"(, "of": )" + of + "}";
}
inline std::string shift(double x, double y = 0, double z = 0) {
    return R"({"type": "affine", "translate": [)" + std::to_string(x) + ", " + std::to_string(y) + ", " +
           std::to_string(z) + "]}";
}

inline const TransferTerm& transferOf(const TermPtr& term) {
    return std::get<TransferTerm>(term->node);
}
/// The outermost map of a scene.
inline const SpatialTransferFunction& mapOf(const CompiledScene& scene) {
    return *transferOf(scene.root).by;
}
inline Vec3 at(const SpatialTransferFunction& map, Vec3 p) {
    map.map({&p, 1}, {&p, 1});
    return p;
}
inline ObjectSample at(const CompiledScene& scene, const Vec3& p, const std::string& attribute = "scalar") {
    ObjectSample found;
    sample(*scene.root, {&p, 1}, {&found, 1}, false, attribute);
    return found;
}

/// n³ samples over [0, 1]³, `channels` each, of value(p, channel).
template <class Function>
std::shared_ptr<const Volume> unitVolume(int n, int channels, const Function& value) {
    VolumeGrid grid{Index3(n), channels, placementMatrix(Vec3(0), Vec3(0), Vec3(1.0 / (n - 1)))};
    std::vector<float> values;
    for (int k = 0; k < n; ++k)
        for (int j = 0; j < n; ++j)
            for (int i = 0; i < n; ++i)
                for (int c = 0; c < channels; ++c)
                    values.push_back(float(value(transformPoint(grid.worldFromIndex, {i, j, k}), c)));
    return Volume::fromValues(grid, std::move(values));
}

}  // namespace voledit::test
