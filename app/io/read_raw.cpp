#include "app/io/readers.h"

#include <glm/gtc/matrix_transform.hpp>

#include "app/io/checks.h"

namespace voledit {

StoredVolume parseRaw(const Source& source, const RawFormat& format) {
    StoredVolume stored;
    stored.format = "raw";
    stored.type = StoredType(format.type);
    stored.bigEndian = format.bigEndian;
    std::array<std::uint64_t, 3> size;
    for (int a = 0; a < 3; ++a) size[std::size_t(a)] = std::uint64_t(format.size[a]);
    stored.setInterleaved(size, 1, 1);
    checkSpacing(source.name, format.spacing);
    stored.worldFromIndex = glm::scale(Mat4(1), format.spacing);
    stored.parts = {{source, 0}};
    return stored;
}

}  // namespace voledit
