#include "app/io/byte_order.h"

#include <bit>

#include "core/base/parallel.h"

namespace voledit {

namespace {

constexpr std::size_t kGrain = 1 << 18;

template <class T>
void reverseBytes(std::span<std::byte> bytes) {
    T* values = reinterpret_cast<T*>(bytes.data());
    parallelFor(bytes.size() / sizeof(T), kGrain, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
            if constexpr (sizeof(T) == 2) values[i] = __builtin_bswap16(values[i]);
            if constexpr (sizeof(T) == 4) values[i] = __builtin_bswap32(values[i]);
            if constexpr (sizeof(T) == 8) values[i] = __builtin_bswap64(values[i]);
        }
    });
}

}  // namespace

void toMachineOrder(const StoredVolume& s, std::span<std::byte> bytes) {
    static_assert(std::endian::native == std::endian::little);
    if (!s.bigEndian || s.encoding == Encoding::Ascii) return;
    if (byteSize(s.type) == 2) reverseBytes<std::uint16_t>(bytes);
    if (byteSize(s.type) == 4) reverseBytes<std::uint32_t>(bytes);
    if (byteSize(s.type) == 8) reverseBytes<std::uint64_t>(bytes);
}

}  // namespace voledit
