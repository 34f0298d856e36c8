#include "core/rays/packet_light.h"

#include "core/eval/surroundings.h"

namespace voledit {

PacketLight packetLight(const CompiledScene& scene, const Surroundings& surroundings) {
    const RenderSettings& settings = scene.render;
    const Lights lights = lightsOf(settings, scene.camera);
    PacketLight light;
    light.shading = settings.shading;
    light.ambient = static_cast<float>(settings.ambient * lights.ambient);
    light.diffuse = static_cast<float>(settings.diffuse);
    light.specular = static_cast<float>(settings.specular);
    light.shininess = static_cast<float>(settings.shininess);
    light.kind = lights.kind;
    light.count = lights.count;
    for (std::size_t l = 0; l < lights.count; ++l) {
        for (int a = 0; a < 3; ++a)
            light.lights[l].toward[std::size_t(a)] = static_cast<float>(lights.light[l].toward[a]);
        light.lights[l].intensity = static_cast<float>(lights.light[l].intensity);
    }
    if (!surroundings.none()) light.surroundings = &surroundings;
    light.eye = scene.camera.eye;
    light.step = scene.stepLength();
    return light;
}

}  // namespace voledit
