#include "core/io/mesh_bytes.h"

#include <cassert>
#include <cstring>

#include "core/base/error.h"

namespace voledit {

MeshCounts countsOf(const MeshData& mesh) {
    return {mesh.points.size(), mesh.hexahedra.size(), mesh.tetrahedra.size(), mesh.channels};
}

std::size_t byteSize(const MeshCounts& counts) {
    constexpr std::uint64_t most = std::uint64_t(1) << 40;
    const std::uint64_t channels = std::uint64_t(counts.channels);
    if (counts.points > most || counts.hexahedra > most || counts.tetrahedra > most || counts.channels < 1 ||
        channels > 4096)
        throw Error("voledit-io returned a mesh that cannot be");
    return counts.points * (sizeof(Vec3) + channels * sizeof(float)) +
           counts.hexahedra * sizeof(std::array<std::uint32_t, 8>) +
           counts.tetrahedra * sizeof(std::array<std::uint32_t, 4>);
}

void writeMesh(const MeshData& mesh, std::span<std::byte> out) {
    assert(out.size() >= byteSize(countsOf(mesh)));
    const auto put = [&](const auto& values) {
        const auto bytes = std::as_bytes(std::span(values));
        if (!bytes.empty()) std::memcpy(out.data(), bytes.data(), bytes.size());
        out = out.subspan(bytes.size());
    };
    put(mesh.points);
    put(mesh.values);
    put(mesh.hexahedra);
    put(mesh.tetrahedra);
}

MeshData readMesh(const MeshCounts& counts, std::span<const std::byte> in) {
    assert(in.size() >= byteSize(counts));
    MeshData mesh;
    mesh.channels = counts.channels;
    const auto take = [&](auto& values, std::size_t count) {
        values.resize(count);
        const auto bytes = std::as_writable_bytes(std::span(values));
        if (!bytes.empty()) std::memcpy(bytes.data(), in.data(), bytes.size());
        in = in.subspan(bytes.size());
    };
    take(mesh.points, counts.points);
    take(mesh.values, counts.points * std::size_t(counts.channels));
    take(mesh.hexahedra, counts.hexahedra);
    take(mesh.tetrahedra, counts.tetrahedra);
    return mesh;
}

}  // namespace voledit
