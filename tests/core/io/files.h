#pragma once
// Small files made for tests.

#include <gtest/gtest.h>
#include <zlib.h>

#include <algorithm>
#include <bit>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <numeric>
#include <sstream>
#include <string>
#include <vector>

#include "core/base/error.h"
#include "core/io/io_client.h"
#include "tests/support/fixtures.h"

namespace voledit::test {

/// Writes `bytes` as a file and returns its path.
inline std::filesystem::path writeFile(const std::filesystem::path& path, const std::string& bytes) {
    std::ofstream(path, std::ios::binary).write(bytes.data(), std::streamsize(bytes.size()));
    return path;
}

inline std::string readFile(const std::filesystem::path& path) {
    std::ifstream in(path, std::ios::binary);
    std::ostringstream text;
    text << in.rdbuf();
    return text.str();
}

/// The values' bytes, reversed each where `big`.
template <class T>
std::string bytesOf(const std::vector<T>& values, bool big = false) {
    std::string bytes(values.size() * sizeof(T), '\0');
    std::memcpy(bytes.data(), values.data(), bytes.size());
    if (big)
        for (std::size_t i = 0; i < bytes.size(); i += sizeof(T))
            std::reverse(bytes.begin() + std::ptrdiff_t(i), bytes.begin() + std::ptrdiff_t(i + sizeof(T)));
    return bytes;
}

/// first, first + 1, …
template <class T>
std::vector<T> counting(std::size_t count, T first = T(0)) {
    std::vector<T> values(count);
    std::iota(values.begin(), values.end(), first);
    return values;
}

inline std::string gzipped(const std::string& bytes) {
    z_stream stream{};
    deflateInit2(&stream, 6, Z_DEFLATED, 15 + 16, 8, Z_DEFAULT_STRATEGY);
    std::string packed(deflateBound(&stream, bytes.size()), '\0');
    stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(bytes.data()));
    stream.avail_in = uInt(bytes.size());
    stream.next_out = reinterpret_cast<Bytef*>(packed.data());
    stream.avail_out = uInt(packed.size());
    deflate(&stream, Z_FINISH);
    packed.erase(packed.size() - stream.avail_out);
    deflateEnd(&stream);
    return packed;
}

/// A NIfTI-1 header of 352 bytes, fields set at the offsets of nifti1.h.
class NiftiBytes {
public:
    NiftiBytes(std::vector<std::int16_t> dim, std::int16_t datatype, std::int16_t bits) : bytes_(352, '\0') {
        put(0, std::int32_t(348));
        for (std::size_t d = 0; d < dim.size(); ++d) put(40 + 2 * d, dim[d]);
        put(70, datatype);
        put(72, bits);
        for (std::size_t d = 0; d < 8; ++d) put(76 + 4 * d, 1.0f);
        put(108, 352.0f);
        put(112, 1.0f);
        bytes_[123] = 2;
        std::memcpy(bytes_.data() + 344, "n+1", 4);
    }
    template <class T>
    NiftiBytes& put(std::size_t offset, T value) {
        std::memcpy(bytes_.data() + offset, &value, sizeof value);
        return *this;
    }
    NiftiBytes& sform(const Mat4& ras) {
        put(254, std::int16_t(1));
        for (std::size_t r = 0; r < 3; ++r)
            for (std::size_t c = 0; c < 4; ++c) put(280 + 16 * r + 4 * c, float(ras[int(c)][int(r)]));
        return *this;
    }
    std::string bytes() const { return bytes_; }

private:
    std::string bytes_;
};

/// All values of a volume as doubles, in their order.
inline std::vector<double> valuesOf(const Volume& volume) {
    std::vector<double> values;
    const Index3 n = volume.grid().size;
    for (int k = 0; k < n.z; ++k)
        for (int j = 0; j < n.y; ++j)
            for (int i = 0; i < n.x; ++i)
                for (int c = 0; c < volume.grid().channels; ++c) values.push_back(volume.at({i, j, k}, c));
    return values;
}

inline void expectNear(const Mat4& a, const Mat4& b, double tolerance) {
    for (int c = 0; c < 4; ++c)
        for (int r = 0; r < 4; ++r) EXPECT_NEAR(a[c][r], b[c][r], tolerance) << "column " << c << ", row " << r;
}

/// Reads `path`, expecting an Error that names the file and a remedy; returns its message.
inline std::string rejection(IoClient& io, const std::filesystem::path& path, const ReadOptions& options = {}) {
    try {
        io.readVolume(path, options);
    } catch (const Error& error) {
        const std::string message = error.what();
        EXPECT_NE(message.find(path.filename().string()), std::string::npos) << message;
        EXPECT_NE(message.find("; "), std::string::npos) << "names no remedy: " << message;
        return message;
    }
    ADD_FAILURE() << path << " was read";
    return "";
}

}  // namespace voledit::test
