#pragma once
// A scene's light as packets take it.

#include "core/rays/packet_caster.h"
#include "core/scene/compile.h"

namespace voledit {

class Surroundings;

/// `surroundings` are the scene's; the light refers to them where they take any.
PacketLight packetLight(const CompiledScene& scene, const Surroundings& surroundings);

}  // namespace voledit
