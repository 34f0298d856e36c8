#pragma once
// A scene's light as packets take it.

#include "core/rays/packet_caster.h"
#include "core/scene/camera.h"

namespace voledit {

PacketLight packetLight(const RenderSettings& settings);

}  // namespace voledit
