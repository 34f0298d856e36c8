#include "render/volume_texture.h"

#include <algorithm>

#include "core/base/error.h"
#include "core/base/parallel.h"
#include "core/fields/voxel_type.h"

namespace voledit {

namespace {

/// How voxels of T are stored. Short integers are counted from the lowest one, the largest being 1 in the shader.
template <class T>
struct Storage {
    static constexpr bool kShort = std::is_integral_v<T> && sizeof(T) <= 2;
    static constexpr bool kByte = kShort && sizeof(T) == 1;
    using Stored = std::conditional_t<kByte, std::uint8_t, std::conditional_t<kShort, std::uint16_t, float>>;
    static constexpr GLenum kFormat = kByte ? GL_R8 : kShort ? GL_R16 : GL_R32F;
    static constexpr GLenum kType = kByte ? GL_UNSIGNED_BYTE : kShort ? GL_UNSIGNED_SHORT : GL_FLOAT;
    static constexpr int kLowest = kShort ? int(std::numeric_limits<T>::lowest()) : 0;
};

/// Calls upload(firstSlice, sliceCount, values) until every slice of `channel` was converted to what is stored.
template <class T, class Upload>
void convert(const Volume& volume, int channel, const Upload& upload) {
    using Stored = typename Storage<T>::Stored;
    const VolumeGrid& grid = volume.grid();
    const T* voxels = reinterpret_cast<const T*>(volume.voxels().data()) + channel;
    const std::size_t slice = std::size_t(grid.size.x) * std::size_t(grid.size.y);
    // A few slices at a time: what is on its way must not count beside the volume and its texture.
    const int block = int(std::clamp<std::size_t>((std::size_t(1) << 20) / slice, 1, std::size_t(grid.size.z)));
    if constexpr (std::is_same_v<T, Stored>)
        if (grid.channels == 1) {  // stored as they are
            for (int k = 0; k < grid.size.z; k += block)
                upload(k, std::min(block, grid.size.z - k), voxels + std::size_t(k) * slice);
            return;
        }
    std::vector<Stored> values(slice * std::size_t(block));
    for (int k = 0; k < grid.size.z; k += block) {
        const int count = std::min(block, grid.size.z - k);
        const T* from = voxels + std::size_t(k) * slice * std::size_t(grid.channels);
        parallelFor(slice * std::size_t(count), 1 << 17, [&](std::size_t begin, std::size_t end) {
            for (std::size_t n = begin; n < end; ++n) {
                const T value = from[n * std::size_t(grid.channels)];
                if constexpr (Storage<T>::kShort)
                    values[n] = Stored(int(value) - Storage<T>::kLowest);
                else
                    values[n] = Stored(value);
            }
        });
        upload(k, count, values.data());
    }
}

void checkSize(Index3 size) {
    GLint largest = 0;
    glGetIntegerv(GL_MAX_3D_TEXTURE_SIZE, &largest);
    if (std::max({size.x, size.y, size.z}) > largest)
        throw Error("volume of " + std::to_string(size.x) + "x" + std::to_string(size.y) + "x" + std::to_string(size.z),
                    "this GPU holds at most " + std::to_string(largest) + " voxels an axis", "use --renderer rays");
}

}  // namespace

VolumeTexture makeVolumeTexture(const Volume& volume, int channel) {
    const Index3 size = volume.grid().size;
    checkSize(size);
    VolumeTexture result{makeTexture(GL_TEXTURE_3D, GL_LINEAR, GL_LINEAR), 1, 0};
    const GLuint name = result.texture.name();
    // As GL_CLAMP_TO_EDGE, within half a sample beyond the volume. llvmpipe filters bytes in 8 bits unless an axis is
    // wrapped in some way that its short cut does not know, and in floats then.
    glTextureParameteri(name, GL_TEXTURE_WRAP_R, GL_MIRROR_CLAMP_TO_EDGE);
    while (glGetError() != GL_NO_ERROR) {
    }
    withVoxelType(volume.type(), [&](auto t) {
        using As = Storage<decltype(t)>;
        glTextureStorage3D(name, 1, As::kFormat, size.x, size.y, size.z);
        if (glGetError() == GL_OUT_OF_MEMORY)
            throw Error("volume", "the GPU's memory is too small for it", "use --renderer rays");
        if constexpr (As::kShort) {
            result.valueScale = std::numeric_limits<typename As::Stored>::max();
            result.valueOffset = As::kLowest;
        }
        glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
        convert<decltype(t)>(volume, channel, [&](int k, int count, const typename As::Stored* values) {
            glTextureSubImage3D(name, 0, 0, 0, k, size.x, size.y, count, GL_RED, As::kType, values);
        });
        glPixelStorei(GL_UNPACK_ALIGNMENT, 4);
    });
    return result;
}

}  // namespace voledit
