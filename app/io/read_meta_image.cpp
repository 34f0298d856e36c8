// MetaImage: "Key = Value" lines, then the data or its file's name.
// https://itk.org/Wiki/ITK/MetaIO/Documentation

#include <map>

#include "app/io/checks.h"
#include "app/io/header_text.h"
#include "app/io/readers.h"
#include "core/base/error.h"

namespace voledit {

namespace {

struct Field {
    std::string value;
    int line = 0;
};

class Fields {
public:
    Fields(const Source& source, HeaderLines& lines) : source_(source) {
        while (const auto line = lines.next()) {
            const auto equals = line->find('=');
            if (trimmed(*line).empty() || line->starts_with('#')) continue;
            if (equals == std::string::npos)
                throw Error(placeOf(source, lines.number()), "is no \"Key = Value\" line", "correct the header");
            const std::string key = trimmed(line->substr(0, equals));
            fields_[key] = {trimmed(line->substr(equals + 1)), lines.number()};
            if (key == "ElementDataFile") return;  // by definition the last; the data may follow
        }
        throw Error(source.name, "has no ElementDataFile line", "the header is cut off: copy the file anew");
    }

    /// The first of `names` that is there.
    const Field* find(std::initializer_list<const char*> names) const {
        for (const char* name : names)
            if (const auto found = fields_.find(name); found != fields_.end()) return &found->second;
        return nullptr;
    }
    const Field& need(const char* name) const {
        if (const Field* field = find({name})) return *field;
        throw Error(source_.name, "has no " + std::string(name) + " line", "add it to the header");
    }
    bool isTrue(std::initializer_list<const char*> names, bool otherwise) const {
        const Field* field = find(names);
        return field ? lowered(field->value).starts_with("t") || field->value == "1" : otherwise;
    }
    /// The numbers of a field, `count` of them; `otherwise` where it is not there.
    std::vector<double> reals(std::initializer_list<const char*> names, std::vector<double> otherwise) const {
        const Field* field = find(names);
        if (!field) return otherwise;
        auto values = realsOf(field->value, placeOf(source_, field->line));
        if (values.size() < otherwise.size())
            throw Error(placeOf(source_, field->line),
                        "has " + std::to_string(values.size()) + " numbers where " + std::to_string(otherwise.size()) +
                            " are expected",
                        "correct the header");
        return values;
    }

private:
    const Source& source_;
    std::map<std::string, Field> fields_;
};

StoredType typeOf(const Source& source, const Field& field) {
    static const std::map<std::string, StoredType> types{
        {"MET_CHAR", StoredType::Int8},       {"MET_UCHAR", StoredType::UInt8},       {"MET_SHORT", StoredType::Int16},
        {"MET_USHORT", StoredType::UInt16},   {"MET_INT", StoredType::Int32},         {"MET_UINT", StoredType::UInt32},
        {"MET_LONG", StoredType::Int32},      {"MET_ULONG", StoredType::UInt32},  // 4 bytes by definition
        {"MET_LONG_LONG", StoredType::Int64}, {"MET_ULONG_LONG", StoredType::UInt64}, {"MET_FLOAT", StoredType::Float},
        {"MET_DOUBLE", StoredType::Double}};
    const auto found = types.find(field.value);
    if (found == types.end())
        throw Error(placeOf(source, field.line), "ElementType " + inQuotes(field.value) + " is not known",
                    "it must be one of MET_CHAR … MET_DOUBLE");
    return found->second;
}

/// Size, channels and time steps. Returns the file's number of dimensions.
std::size_t readShape(const Source& source, const Fields& fields, StoredVolume& stored, VolumeSink& sink) {
    const Field& dims = fields.need("NDims");
    const std::uint64_t count = countOf(dims.value, placeOf(source, dims.line));
    if (count < 1 || count > 4)
        throw Error(placeOf(source, dims.line), "has " + dims.value + " dimensions", "there must be 1 to 4");
    const Field& sizes = fields.need("DimSize");
    auto size = countsOf(sizes.value, placeOf(source, sizes.line));
    if (size.size() != count)
        throw Error(placeOf(source, sizes.line), "does not have " + dims.value + " sizes", "correct the header");
    size.resize(4, 1);
    const Field* channels = fields.find({"ElementNumberOfChannels"});
    const std::uint64_t perVoxel = channels ? countOf(channels->value, placeOf(source, channels->line)) : 1;
    checkSizes(placeOf(source, sizes.line), {size[0], size[1], size[2]}, perVoxel);
    checkProduct(placeOf(source, sizes.line), {size[0], size[1], size[2], size[3], perVoxel, 8});
    stored.setInterleaved({size[0], size[1], size[2]}, perVoxel, size[3]);
    if (size[3] > 1) sink.warn(source.name + ": has " + std::to_string(size[3]) + " time steps; the first is shown");
    return std::size_t(count);
}

void readPlacement(const Source& source, const Fields& fields, std::size_t dims, StoredVolume& stored) {
    std::vector<double> identity(dims * dims, 0);
    for (std::size_t a = 0; a < dims; ++a) identity[a * dims + a] = 1;
    const auto spacing = fields.reals({"ElementSpacing", "ElementSize"}, std::vector<double>(dims, 1));
    const auto origin = fields.reals({"Offset", "Origin", "Position"}, std::vector<double>(dims, 0));
    const auto matrix = fields.reals({"TransformMatrix", "Rotation", "Orientation"}, identity);
    const Field* line = fields.find({"ElementSpacing", "ElementSize"});
    const std::size_t spatial = std::min<std::size_t>(dims, 3);
    Vec3 steps(1);
    for (std::size_t a = 0; a < spatial; ++a) steps[int(a)] = spacing[a];
    checkSpacing(line ? placeOf(source, line->line) : source.name, steps);
    for (std::size_t a = 0; a < spatial; ++a) {
        // The matrix's first row is the direction of the first axis.
        for (std::size_t r = 0; r < spatial; ++r)
            stored.worldFromIndex[int(a)][int(r)] = matrix[a * dims + r] * spacing[a];
        stored.worldFromIndex[3][int(a)] = origin[a];
    }
}

void readEncoding(const Source& source, const Fields& fields, StoredVolume& stored) {
    stored.bigEndian = fields.isTrue({"BinaryDataByteOrderMSB", "ElementByteOrderMSB"}, false);
    if (!fields.isTrue({"BinaryData"}, true))
        stored.encoding = Encoding::Ascii;
    else if (fields.isTrue({"CompressedData"}, false))
        stored.encoding = Encoding::Deflated;
    stored.slope = fields.reals({"ElementToIntensityFunctionSlope"}, {1})[0];
    stored.intercept = fields.reals({"ElementToIntensityFunctionOffset"}, {0})[0];
    if (const Field* type = fields.find({"ObjectType"}); type && type->value != "Image")
        throw Error(placeOf(source, type->line), "is a MetaIO " + inQuotes(type->value) + ", not an Image",
                    "give an image");
}

/// Bytes before the data, from HeaderSize: −1 means that the data ends the file.
std::uint64_t headerSize(const Source& source, const Fields& fields, const StoredVolume& stored, const Source& data) {
    const Field* field = fields.find({"HeaderSize"});
    if (!field) return 0;
    if (field->value != "-1") return countOf(field->value, placeOf(source, field->line));
    const std::uint64_t size = InputFile(data).size(), bytes = stored.storedValues * byteSize(stored.type);
    return size - std::min(size, bytes);
}

}  // namespace

StoredVolume parseMetaImage(const Source& source, VolumeSink& sink) {
    HeaderLines lines(source);
    const Fields fields(source, lines);
    StoredVolume stored;
    stored.format = "metaimage";
    stored.type = typeOf(source, fields.need("ElementType"));
    readPlacement(source, fields, readShape(source, fields, stored, sink), stored);
    readEncoding(source, fields, stored);

    const Field& data = fields.need("ElementDataFile");
    if (lowered(data.value) == "local") {
        stored.parts = {{source, lines.offset()}};
        return stored;
    }
    for (const Source& file : dataFilesOf(source, data.value, lines))
        stored.parts.push_back({file, headerSize(source, fields, stored, file)});
    return stored;
}

}  // namespace voledit
