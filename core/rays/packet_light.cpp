#include "core/rays/packet_light.h"

#include <glm/geometric.hpp>

namespace voledit {

PacketLight packetLight(const RenderSettings& settings) {
    PacketLight light;
    light.shading = settings.shading;
    light.ambient = static_cast<float>(settings.ambient);
    light.diffuse = static_cast<float>(settings.diffuse);
    light.specular = static_cast<float>(settings.specular);
    light.shininess = static_cast<float>(settings.shininess);
    light.head = !settings.light;
    if (settings.light) {
        const Vec3 to = glm::normalize(*settings.light);
        for (int a = 0; a < 3; ++a) light.toLight[std::size_t(a)] = static_cast<float>(to[a]);
    }
    return light;
}

}  // namespace voledit
