#include "app/io/vtk_values.h"

#include <bit>
#include <charconv>
#include <cstring>
#include <limits>
#include <utility>

#include "app/io/checks.h"
#include "app/io/stored_type.h"
#include "app/io/vtk_cursor.h"
#include "core/base/error.h"

namespace voledit {

namespace {

constexpr std::size_t kBlock = 1 << 16;

[[noreturn]] void throwBadNumber(const VtkFile& file, const VtkArray& array, const std::string& what) {
    throw Error(file.source.name, "array " + inQuotes(array.name) + " holds " + what,
                "correct it, or save the file anew");
}

/// A number of the file as T; indices are checked.
template <class T, class In>
T converted(const VtkFile& file, const VtkArray& array, In value) {
    if constexpr (std::is_same_v<T, std::uint32_t>) {
        if constexpr (std::is_floating_point_v<In>) {
            throwBadNumber(file, array, "real numbers where whole ones are expected");
        } else {
            if (!std::in_range<std::uint32_t>(value) ||
                std::cmp_equal(value, std::numeric_limits<std::uint32_t>::max()))
                throwBadNumber(file, array, std::to_string(value) + ", which can be no index");
            return T(value);
        }
    } else {
        return T(value);
    }
}

template <class In>
In machineOrder(const std::byte* bytes) {
    static_assert(std::endian::native == std::endian::little);
    std::array<std::byte, sizeof(In)> reversed;
    for (std::size_t i = 0; i < sizeof(In); ++i) reversed[i] = bytes[sizeof(In) - 1 - i];
    return std::bit_cast<In>(reversed);
}

class ArrayReader {
public:
    ArrayReader(const VtkFile& file, const VtkArray& array, VolumeSink& sink)
        : file_(file), array_(array), sink_(sink), input_(file.source), cursor_(input_, array.offset) {}

    template <class T>
    std::vector<T> read() {
        std::vector<T> values(array_.count());
        if (file_.text)
            readText(values);
        else
            withStoredType(array_.type, [&](auto in) { readBytes<decltype(in)>(values); });
        return values;
    }

private:
    template <class T>
    void readText(std::vector<T>& values) {
        for (std::size_t i = 0; i < values.size(); ++i) {
            std::string_view word = cursor_.word();
            if (word.starts_with('+')) word.remove_prefix(1);
            std::conditional_t<std::is_integral_v<T>, std::int64_t, double> number{};
            const auto [end, failed] = std::from_chars(word.data(), word.data() + word.size(), number);
            // What is too large or too small for a double is infinite or 0.
            if (failed == std::errc::result_out_of_range && !std::is_integral_v<T>) {
                number = decltype(number)(std::strtod(std::string(word).c_str(), nullptr));
            } else if (failed != std::errc() || end != word.data() + word.size()) {
                throwBadNumber(file_, array_,
                               inQuotes(word) + (std::is_integral_v<T> ? ", no whole number" : ", no number"));
            }
            values[i] = converted<T>(file_, array_, number);
            if (i % kBlock == 0) progress();
        }
    }

    template <class In, class T>
    void readBytes(std::vector<T>& values) {
        std::vector<std::byte> block(kBlock * sizeof(In));
        for (std::size_t first = 0; first < values.size(); first += kBlock) {
            const std::size_t count = std::min(kBlock, values.size() - first);
            if (cursor_.read(std::span(block).first(count * sizeof(In))) < count * sizeof(In))
                throw Error(file_.source.name, "became shorter while it was read", "copy it anew");
            for (std::size_t i = 0; i < count; ++i)
                values[first + i] = converted<T>(file_, array_, machineOrder<In>(block.data() + i * sizeof(In)));
            progress();
        }
    }

    void progress() { sink_.progress(0.5 + 0.5 * double(cursor_.position()) / double(input_.size() + 1)); }

    const VtkFile& file_;
    const VtkArray& array_;
    VolumeSink& sink_;
    InputFile input_;
    VtkCursor cursor_;
};

}  // namespace

std::vector<double> readReals(const VtkFile& file, const VtkArray& array, VolumeSink& sink) {
    return ArrayReader(file, array, sink).read<double>();
}

std::vector<float> readFloats(const VtkFile& file, const VtkArray& array, VolumeSink& sink) {
    return ArrayReader(file, array, sink).read<float>();
}

std::vector<std::uint32_t> readIndices(const VtkFile& file, const VtkArray& array, VolumeSink& sink) {
    return ArrayReader(file, array, sink).read<std::uint32_t>();
}

}  // namespace voledit
