// NIfTI-1: a header of 348 bytes, parsed here since its affine may shear, which ITK refuses or straightens.
// https://nifti.nimh.nih.gov/pub/dist/src/niftilib/nifti1.h

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <glm/geometric.hpp>
#include <map>

#include "app/io/checks.h"
#include "app/io/inflater.h"
#include "app/io/readers.h"
#include "core/base/error.h"

namespace voledit {

namespace {

constexpr std::size_t kHeaderBytes = 348;

/// Numbers of the header, in the file's byte order, at the offsets that the format gives.
class NiftiHeader {
public:
    NiftiHeader(const Source& source, bool compressed) {
        const InputFile file(source);
        std::size_t n = 0;
        if (compressed) {
            Inflater inflater(file, 0);
            while (n < kHeaderBytes) {
                const std::size_t more = inflater.read(std::span(bytes_).subspan(n));
                if (more == 0) break;
                n += more;
            }
        } else {
            n = file.readAt(0, bytes_);
        }
        if (n < kHeaderBytes) throw Error(source.name, "ends within its header", "copy or download the file anew");
        swapped_ = integer<std::int32_t>(0) != std::int32_t(kHeaderBytes);
        if (integer<std::int32_t>(0) != std::int32_t(kHeaderBytes))
            throw Error(source.name, "has no NIfTI-1 header (which begins with its size, 348)", "give a NIfTI-1 file");
    }

    bool bigEndian() const { return swapped_ == (std::endian::native == std::endian::little); }
    std::string_view magic() const { return {reinterpret_cast<const char*>(bytes_.data()) + 344, 3}; }
    int dim(int n) const { return integer<std::int16_t>(40 + 2 * std::size_t(n)); }
    int intent() const { return integer<std::int16_t>(68); }
    int datatype() const { return integer<std::int16_t>(70); }
    int bitsPerVoxel() const { return integer<std::int16_t>(72); }
    double pixdim(int n) const { return real(76 + 4 * std::size_t(n)); }
    double voxelOffset() const { return real(108); }
    double slope() const { return real(112); }
    double intercept() const { return real(116); }
    int units() const { return std::to_integer<int>(bytes_[123]); }
    int qformCode() const { return integer<std::int16_t>(252); }
    int sformCode() const { return integer<std::int16_t>(254); }
    double quaternion(int n) const { return real(256 + 4 * std::size_t(n)); }
    double qOffset(int n) const { return real(268 + 4 * std::size_t(n)); }
    double sform(int row, int column) const { return real(280 + 16 * std::size_t(row) + 4 * std::size_t(column)); }

private:
    template <class T>
    T integer(std::size_t offset) const {
        std::array<std::byte, sizeof(T)> raw;
        std::memcpy(raw.data(), bytes_.data() + offset, sizeof(T));
        if (swapped_) std::reverse(raw.begin(), raw.end());
        return std::bit_cast<T>(raw);
    }
    double real(std::size_t offset) const { return double(std::bit_cast<float>(integer<std::uint32_t>(offset))); }

    std::array<std::byte, kHeaderBytes> bytes_{};
    bool swapped_ = false;
};

struct Datatype {
    StoredType type;
    std::uint64_t channels;
};

Datatype datatypeOf(const Source& source, int code) {
    static const std::map<int, Datatype> types{
        {2, {StoredType::UInt8, 1}},     {4, {StoredType::Int16, 1}},    {8, {StoredType::Int32, 1}},
        {16, {StoredType::Float, 1}},    {32, {StoredType::Float, 2}},   {64, {StoredType::Double, 1}},
        {128, {StoredType::UInt8, 3}},   {256, {StoredType::Int8, 1}},   {512, {StoredType::UInt16, 1}},
        {768, {StoredType::UInt32, 1}},  {1024, {StoredType::Int64, 1}}, {1280, {StoredType::UInt64, 1}},
        {1792, {StoredType::Double, 2}}, {2304, {StoredType::UInt8, 4}}};
    const auto found = types.find(code);
    if (found == types.end())
        throw Error(source.name + ", datatype", "has the code " + std::to_string(code) + ", which is not read",
                    "save it as integers of 8 to 64 bits, float or double");
    return found->second;
}

constexpr int kDisplacementIntent = 1006, kVectorIntent = 1007;

/// Sizes, channels and their strides: dimensions 1 to 3 are space, 4 time, 5 the components, each slower than the last.
/// Some writers of vectors put the components where time stands.
void readShape(const Source& source, const NiftiHeader& h, StoredVolume& stored, VolumeSink& sink) {
    const std::string where = source.name + ", dim";
    const int dims = h.dim(0);
    if (dims < 1 || dims > 7) throw Error(where, "has " + std::to_string(dims) + " dimensions", "there must be 1 to 7");
    std::array<std::uint64_t, 8> n{1, 1, 1, 1, 1, 1, 1, 1};
    for (int d = 1; d <= dims; ++d) {
        if (h.dim(d) < 1) throw Error(where, "has a size of " + std::to_string(h.dim(d)), "sizes must be 1 or more");
        n[std::size_t(d)] = std::uint64_t(h.dim(d));
    }
    const bool vectors = h.intent() == kDisplacementIntent || h.intent() == kVectorIntent;
    if (vectors && n[5] == 1 && n[4] == 3) std::swap(n[4], n[5]);
    const Datatype kind = datatypeOf(source, h.datatype());
    stored.type = kind.type;
    const std::uint64_t all = checkProduct(where, {kind.channels, n[1], n[2], n[3], n[4], n[5], n[6], n[7], 8}) / 8;
    stored.setInterleaved({n[1], n[2], n[3]}, kind.channels, 1);
    stored.storedValues = all;
    if (n[5] > 1 && kind.channels == 1) {
        stored.channels = n[5];
        stored.stride[3] = n[1] * n[2] * n[3] * n[4];
    }
    if (h.intent() == kDisplacementIntent)
        sink.warn(source.name +
                  ": its intent is displacement vectors, which NIfTI gives in RAS; their components were "
                  "taken as stored, so as a map in LPS x and y need the other sign");
    if (n[4] > 1) sink.warn(source.name + ": has " + std::to_string(n[4]) + " time steps; the first is shown");
    if (n[6] > 1 || n[7] > 1 || (n[5] > 1 && kind.channels > 1))
        sink.warn(source.name + ": has more than five dimensions; of the others the first element is shown");
    if (h.bitsPerVoxel() != int(8 * byteSize(kind.type) * kind.channels))
        sink.warn(source.name + ": its bits per voxel (" + std::to_string(h.bitsPerVoxel()) +
                  ") do not fit its datatype; the datatype was believed");
}

Mat4 sformOf(const NiftiHeader& h) {
    Mat4 m(1);
    for (int r = 0; r < 3; ++r)
        for (int c = 0; c < 4; ++c) m[c][r] = h.sform(r, c);
    return m;
}

/// Method 2 of nifti1.h: a quaternion (a ≥ 0 from b, c, d), qfac = ±1 in pixdim[0], and an offset.
Mat4 qformOf(const NiftiHeader& h, const Vec3& spacing) {
    double b = h.quaternion(0), c = h.quaternion(1), d = h.quaternion(2);
    const double squares = b * b + c * c + d * d;
    double a = 0;
    if (squares > 1) {
        const double scale = 1 / std::sqrt(squares);
        b *= scale, c *= scale, d *= scale;
    } else {
        a = std::sqrt(1 - squares);
    }
    Mat4 m(1);
    m[0] = spacing.x * Vec4(a * a + b * b - c * c - d * d, 2 * (b * c + a * d), 2 * (b * d - a * c), 0);
    m[1] = spacing.y * Vec4(2 * (b * c - a * d), a * a + c * c - b * b - d * d, 2 * (c * d + a * b), 0);
    m[2] = spacing.z * Vec4(2 * (b * d + a * c), 2 * (c * d - a * b), a * a + d * d - c * c - b * b, 0);
    if (h.pixdim(0) < 0) m[2] = -m[2];
    m[3] = Vec4(h.qOffset(0), h.qOffset(1), h.qOffset(2), 1);
    return m;
}

Vec3 spacingOf(const Source& source, const NiftiHeader& h, const StoredVolume& stored) {
    Vec3 spacing(1);
    for (int a = 0; a < 3; ++a) {
        spacing[a] = h.pixdim(a + 1);
        // Files of fewer dimensions leave the rest unset.
        if (spacing[a] == 0 && stored.size[std::size_t(a)] == 1) spacing[a] = 1;
    }
    checkSpacing(source.name + ", pixdim", spacing);
    return spacing;
}

double millimetres(const NiftiHeader& h) {
    switch (h.units() & 7) {
        case 1:
            return 1000;
        case 3:
            return 0.001;
        default:
            return 1;
    }
}

/// The sform where its code is positive, else the qform, else the spacings; RAS to LPS.
void readPlacement(const Source& source, const NiftiHeader& h, StoredVolume& stored, VolumeSink& sink) {
    Mat4 ras(1);
    if (h.sformCode() > 0) {
        ras = sformOf(h);
        checkAffine(source.name + ", sform", ras);
    } else if (h.qformCode() > 0) {
        ras = qformOf(h, spacingOf(source, h, stored));
        checkAffine(source.name + ", qform", ras);
    } else {
        const Vec3 spacing = spacingOf(source, h, stored);
        for (int a = 0; a < 3; ++a) ras[a][a] = spacing[a];
        sink.warn(source.name +
                  ": does not say how it lies in space; its axes were taken as right, anterior, superior");
    }
    const double unit = millimetres(h);
    for (int c = 0; c < 4; ++c) stored.worldFromIndex[c] = ras[c] * Vec4(-unit, -unit, unit, 1);
}

void readRescale(const NiftiHeader& h, StoredVolume& stored) {
    // A slope of 0 means none (nifti1.h), which many writers leave as not-a-number.
    if (h.slope() == 0 || !std::isfinite(h.slope()) || !std::isfinite(h.intercept())) return;
    stored.slope = h.slope();
    stored.intercept = h.intercept();
}

std::uint64_t dataOffset(const Source& source, const NiftiHeader& h, bool single, VolumeSink& sink) {
    const double offset = h.voxelOffset();
    if (!(offset >= 0 && offset < 1e9))
        throw Error(source.name + ", vox_offset", "is " + std::to_string(offset), "it must be 352 or more");
    if (!single || offset >= double(kHeaderBytes)) return std::uint64_t(offset);
    sink.warn(source.name + ": says that its data lies within its header; it was sought behind, at byte 352");
    return 352;
}

}  // namespace

StoredVolume parseNifti(const Source& source, bool compressed, VolumeSink& sink) {
    const NiftiHeader h(source, compressed);
    const bool single = h.magic() == "n+1";
    if (!single && h.magic() != "ni1")
        throw Error(source.name, "is an Analyze file or has a damaged NIfTI magic",
                    "convert it to NIfTI-1, which says how it lies in space");
    StoredVolume stored;
    stored.format = "nifti";
    stored.bigEndian = h.bigEndian();
    readShape(source, h, stored, sink);
    readPlacement(source, h, stored, sink);
    readRescale(h, stored);
    stored.encoding = compressed ? Encoding::Deflated : Encoding::Raw;
    stored.skip = dataOffset(source, h, single, sink);
    if (single) {
        stored.parts = {{source, 0}};
        return stored;
    }
    std::string data = source.path.filename().string();
    if (const auto end = data.rfind(".hdr"); end != std::string::npos) data.replace(end, 4, ".img");
    stored.parts = {{dataFileOf(source, data, 0), 0}};
    return stored;
}

}  // namespace voledit
