#include "core/rays/packet_scene.h"

#include <cmath>
#include <glm/common.hpp>
#include <glm/matrix.hpp>

#include "core/fields/grid_view.h"
#include "core/fields/voxel_type.h"
#include "core/rays/packet_caster.h"
#include "core/rays/volume_look.h"

namespace voledit {

namespace {

constexpr std::size_t kMostBytes = (std::size_t(1) << 31) - 64;

}  // namespace

bool packable(const Volume& volume) {
    const VolumeGrid& grid = volume.grid();
    if (grid.channels != 1 || grid.size.x < 2 || grid.size.y < 2 || grid.size.z < 2) return false;
    if (volume.voxels().size() > kMostBytes) return false;
    return volume.type() != VoxelType::Double && volume.type() != VoxelType::UInt32;
}

VoxelAccess voxelAccess(const Volume& volume) {
    VoxelAccess access;
    access.voxels = volume.voxels().data();
    access.bytes = volume.voxels().size();
    const Index3 size = volume.grid().size;
    access.size = {size.x, size.y, size.z};
    access.row = size.x;
    for (int a = 0; a < 3; ++a) access.beforeLast[std::size_t(a)] = std::nextafter(float(size[a] - 1), 0.0F);
    access.slice = size.x * size.y;
    switch (volume.type()) {
        case VoxelType::Int8:
            access.flip = std::int32_t(0x80808080U);
            access.bias = 128;
            break;
        case VoxelType::Int16:
            access.kind = VoxelKind::Bits16;
            access.flip = std::int32_t(0x80008000U);
            access.bias = 32768;
            break;
        case VoxelType::UInt16:
            access.kind = VoxelKind::Bits16;
            break;
        case VoxelType::Int32:
            access.kind = VoxelKind::Bits32;
            break;
        case VoxelType::Float:
            access.kind = VoxelKind::Float;
            break;
        default:
            break;
    }
    return access;
}

PacketVolume packetVolume(const VolumeLook& look) {
    PacketVolume result;
    result.volume = look.volumeTerm().volume.get();
    result.table = &look.table;
    result.skip = &look.skip();
    if (!look.steepness.factor.empty()) result.steepness = &look.steepness;
    result.ownTurn = gradientTurn(glm::transpose(Mat3(result.volume->indexFromWorld())));
    result.unit = static_cast<float>(look.unit);
    return result;
}

std::array<float, 3> differencesAt(const Volume& volume, const std::array<float, 3>& x) {
    const Vec3 inside = glm::clamp(Vec3(x[0], x[1], x[2]), Vec3(0), Vec3(volume.grid().size - 1));
    const Vec3 d = withVoxelType(volume.type(), [&](auto t) {
        return GridView<decltype(t)>(volume.grid(), volume.voxels(), 0).differences(inside);
    });
    return {static_cast<float>(d.x), static_cast<float>(d.y), static_cast<float>(d.z)};
}

}  // namespace voledit
