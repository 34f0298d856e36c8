// NRRD: "field: value" lines up to an empty one, then the data or its file's name.
// http://teem.sourceforge.net/nrrd/format.html

#include <algorithm>
#include <limits>
#include <map>
#include <set>

#include "app/io/checks.h"
#include "app/io/header_text.h"
#include "app/io/readers.h"
#include "core/base/error.h"

namespace voledit {

namespace {

constexpr std::size_t kMostDimensions = 8;  // the format allows 16; no volume needs them

struct Field {
    std::string value;
    int line = 0;
};

struct Header {
    std::map<std::string, Field> fields;
    std::vector<Source> dataFiles;  // empty: the data follows
    std::uint64_t dataOffset = 0;
};

/// Fields may be written with or without spaces: "data file", "datafile".
std::string fieldName(std::string_view written) {
    std::string name = lowered(written);
    std::erase(name, ' ');
    if (name == "centerings") return "centers";
    return name;
}

Header readHeader(const Source& source) {
    HeaderLines lines(source);
    Header header;
    if (const auto magic = lines.next(); !magic || !magic->starts_with("NRRD000"))
        throw Error(source.name, "does not begin with NRRD000", "give an NRRD file");
    while (const auto line = lines.next()) {
        if (trimmed(*line).empty()) break;
        const auto colon = line->find(':');
        if (line->front() == '#') continue;
        if (colon == std::string::npos)
            throw Error(placeOf(source, lines.number()), "is no \"field: value\" line", "correct the header");
        if (colon + 1 < line->size() && (*line)[colon + 1] == '=') continue;  // key:=value
        const std::string name = fieldName(trimmed(line->substr(0, colon)));
        const Field field{trimmed(line->substr(colon + 1)), lines.number()};
        if (!header.fields.emplace(name, field).second)
            throw Error(placeOf(source, field.line), "gives " + inQuotes(name) + " a second time",
                        "correct the header");
        if (name != "datafile") continue;
        header.dataFiles = dataFilesOf(source, field.value, lines);
        if (field.value.starts_with("LIST")) break;
    }
    header.dataOffset = lines.offset();
    return header;
}

class NrrdParser {
public:
    NrrdParser(const Source& source, VolumeSink& sink) : source_(source), sink_(sink), header_(readHeader(source)) {}

    StoredVolume parse() {
        stored_.format = "nrrd";
        stored_.type = type();
        readAxes();
        readPlacement();
        readEncoding();
        readParts();
        return std::move(stored_);
    }

private:
    struct Axis {
        std::uint64_t size = 1;
        std::string kind;
        double spacing = 1;
        std::optional<Vec3> direction;
        bool spatial = true;
    };

    const Field* find(const std::string& name) const {
        const auto found = header_.fields.find(name);
        return found == header_.fields.end() ? nullptr : &found->second;
    }
    const Field& need(const std::string& name) const {
        if (const Field* field = find(name)) return *field;
        throw Error(source_.name, "has no \"" + name + "\" field", "add it to the header");
    }
    std::string place(const Field& field) const { return placeOf(source_, field.line); }

    StoredType type() const;
    void readAxes();
    void readKindsAndSpacings();
    void readDirections();
    std::optional<Vec3> vectorOf(std::string text, const Field& field) const;
    std::size_t spaceDimension() const;
    void chooseAxes();
    void readPlacement();
    void readEncoding();
    void readParts();

    const Source& source_;
    VolumeSink& sink_;
    Header header_;
    StoredVolume stored_;
    std::vector<Axis> axes_;
    std::array<std::optional<std::size_t>, 3> spatial_;
};

StoredType NrrdParser::type() const {
    static const std::map<std::string, StoredType> types = [] {
        std::map<std::string, StoredType> all{{"float", StoredType::Float}, {"double", StoredType::Double}};
        const auto add = [&](StoredType type, std::initializer_list<const char*> names) {
            for (const char* name : names) all[name] = type;
        };
        add(StoredType::Int8, {"signed char", "int8", "int8_t"});
        add(StoredType::UInt8, {"uchar", "unsigned char", "uint8", "uint8_t"});
        add(StoredType::Int16, {"short", "short int", "signed short", "signed short int", "int16", "int16_t"});
        add(StoredType::UInt16, {"ushort", "unsigned short", "unsigned short int", "uint16", "uint16_t"});
        add(StoredType::Int32, {"int", "signed int", "int32", "int32_t"});
        add(StoredType::UInt32, {"uint", "unsigned int", "uint32", "uint32_t"});
        add(StoredType::Int64,
            {"longlong", "long long", "long long int", "signed long long", "signed long long int", "int64", "int64_t"});
        add(StoredType::UInt64, {"ulonglong", "unsigned long long", "unsigned long long int", "uint64", "uint64_t"});
        return all;
    }();
    const Field& field = need("type");
    const auto found = types.find(lowered(field.value));
    if (found == types.end())
        throw Error(place(field), "type " + inQuotes(field.value) + " is not known",
                    "it must be an integer of 8 to 64 bits, float or double");
    return found->second;
}

void NrrdParser::readAxes() {
    const Field& dimension = need("dimension");
    const std::uint64_t count = countOf(dimension.value, place(dimension));
    if (count < 1 || count > kMostDimensions)
        throw Error(place(dimension), "has " + dimension.value + " dimensions",
                    "voledit reads up to " + std::to_string(kMostDimensions) + ", of which three are space");
    const Field& sizes = need("sizes");
    const auto values = countsOf(sizes.value, place(sizes));
    if (values.size() != count)
        throw Error(place(sizes),
                    "gives " + std::to_string(values.size()) + " sizes for " + dimension.value + " dimensions",
                    "correct the header");
    std::uint64_t all = 8;
    for (const std::uint64_t n : values) {
        if (n < 1) throw Error(place(sizes), "has a size of 0", "each size must be 1 or more");
        all = checkProduct(place(sizes), {all, n});
        axes_.push_back({n, "", 1, std::nullopt, true});
    }
    stored_.storedValues = all / 8;
    readKindsAndSpacings();
    readDirections();
    chooseAxes();
}

void NrrdParser::readKindsAndSpacings() {
    static const std::set<std::string> spatialKinds{"domain", "space", "???", "none", "unknown", ""};
    if (const Field* kinds = find("kinds")) {
        const auto words = wordsOf(kinds->value);
        for (std::size_t a = 0; a < std::min(words.size(), axes_.size()); ++a) {
            axes_[a].kind = lowered(words[a]);
            axes_[a].spatial = spatialKinds.contains(axes_[a].kind);
        }
    }
    if (const Field* spacings = find("spacings")) {
        const auto values = realsOf(spacings->value, place(*spacings));
        if (values.size() != axes_.size())
            throw Error(place(*spacings), "does not give one spacing for each dimension", "correct the header");
        for (std::size_t a = 0; a < axes_.size(); ++a) axes_[a].spacing = values[a];
    }
}

std::size_t NrrdParser::spaceDimension() const {
    if (const Field* field = find("spacedimension")) return std::size_t(countOf(field->value, place(*field)));
    return find("space") ? 3 : 0;
}

/// "(1,0,0)", or "none".
std::optional<Vec3> NrrdParser::vectorOf(std::string text, const Field& field) const {
    if (lowered(text) == "none") return std::nullopt;
    if (text.size() < 2 || text.front() != '(' || text.back() != ')')
        throw Error(place(field), inQuotes(text) + " is no vector", "write it as (x,y,z)");
    text = text.substr(1, text.size() - 2);
    std::replace(text.begin(), text.end(), ',', ' ');
    auto values = realsOf(text, place(field));
    if (values.empty() || values.size() > 4)
        throw Error(place(field), "has a vector of " + std::to_string(values.size()) + " numbers", "give three");
    values.resize(3, 0.0);
    return Vec3(values[0], values[1], values[2]);
}

/// The vectors of a field, which may have spaces within their parentheses.
std::vector<std::string> vectorTexts(const std::string& text) {
    std::vector<std::string> texts;
    std::string current;
    bool within = false;
    for (const char c : text + " ") {
        within = c == '(' || (within && c != ')');
        if (c != ' ' && c != '\t') {
            current += c;
            if (c == ')') texts.push_back(std::exchange(current, ""));
        } else if (!within && !current.empty()) {
            texts.push_back(std::exchange(current, ""));
        } else if (within) {
            current += c;
        }
    }
    return texts;
}

void NrrdParser::readDirections() {
    const Field* field = find("spacedirections");
    if (!field) return;
    const auto texts = vectorTexts(field->value);
    if (texts.size() != axes_.size())
        throw Error(place(*field), "does not give one direction for each dimension", "write none for those without");
    for (std::size_t a = 0; a < axes_.size(); ++a) {
        axes_[a].direction = vectorOf(texts[a], *field);
        axes_[a].spatial = axes_[a].direction.has_value();
    }
}

/// Which axes are i, j, k, which one the channels; of all others the first element is taken.
void NrrdParser::chooseAxes() {
    const bool unlabelled = !find("kinds") && !find("spacedirections");
    if (unlabelled && axes_.size() == 4 && axes_[0].size <= 4) {
        axes_[0].spatial = false;
        sink_.warn(source_.name + ": does not say what its four dimensions are; the first was taken as channels");
    }
    std::uint64_t stride = 1;
    std::size_t spatial = 0;
    bool haveChannels = false;
    for (std::size_t a = 0; a < axes_.size(); stride *= axes_[a].size, ++a) {
        if (axes_[a].spatial && spatial < 3) {
            spatial_[spatial] = a;
            stored_.size[spatial] = axes_[a].size;
            stored_.stride[spatial++] = stride;
        } else if (!axes_[a].spatial && axes_[a].kind != "time" && !haveChannels) {
            haveChannels = true;
            stored_.channels = axes_[a].size;
            stored_.stride[3] = stride;
        } else if (axes_[a].size > 1) {
            sink_.warn(source_.name + ": its dimension " + std::to_string(a + 1) + " has " +
                       std::to_string(axes_[a].size) + " steps; the first is shown");
        }
    }
    checkSizes(place(need("sizes")), stored_.size, stored_.channels);
}

void NrrdParser::readPlacement() {
    const bool directions = find("spacedirections") != nullptr;
    if (directions && spaceDimension() == 0)
        throw Error(place(*find("spacedirections")), "needs a \"space\" or \"space dimension\"",
                    "add it to the header");
    if (spaceDimension() > 4) throw Error(source_.name, "its space has more than 4 dimensions", "correct the header");
    Mat4 m(1);
    for (int a = 0; a < 3; ++a) {
        if (!spatial_[std::size_t(a)]) continue;
        const Axis& axis = axes_[*spatial_[std::size_t(a)]];
        if (axis.direction) {
            m[a] = Vec4(*axis.direction, 0);
        } else {
            const Field* spacings = find("spacings");
            checkSpacing(spacings ? place(*spacings) : source_.name, Vec3(axis.spacing));
            m[a][a] = axis.spacing;
        }
    }
    if (const Field* origin = find("spaceorigin"))
        if (const auto at = vectorOf(origin->value, *origin)) m[3] = Vec4(*at, 1);

    Vec3 lps(1);
    if (const Field* space = find("space")) {
        const std::string name = lowered(space->value);
        const auto is = [&](const char* longName, const char* shortName) {
            return name.starts_with(longName) || name == shortName || name == std::string(shortName) + "t";
        };
        if (is("right-anterior-superior", "ras")) lps = Vec3(-1, -1, 1);
        if (is("left-anterior-superior", "las")) lps = Vec3(1, -1, 1);
    }
    for (int c = 0; c < 4; ++c)
        for (int r = 0; r < 3; ++r) m[c][r] *= lps[r];
    const Field* field = find("spacedirections");
    checkAffine(field ? place(*field) : source_.name, m);
    stored_.worldFromIndex = m;
}

void NrrdParser::readEncoding() {
    const Field& encoding = need("encoding");
    const std::string name = lowered(encoding.value);
    if (name == "raw")
        stored_.encoding = Encoding::Raw;
    else if (name == "gzip" || name == "gz")
        stored_.encoding = Encoding::Deflated;
    else if (name == "ascii" || name == "text" || name == "txt")
        stored_.encoding = Encoding::Ascii;
    else if (name == "hex")
        stored_.encoding = Encoding::Hex;
    else
        throw Error(place(encoding), "encoding " + inQuotes(name) + " is not read",
                    "save the file with raw or gzip encoding");
    const Field* endian = find("endian");
    if (endian && lowered(endian->value) != "little" && lowered(endian->value) != "big")
        throw Error(place(*endian), inQuotes(endian->value) + " is no byte order", "give little or big");
    if (!endian && byteSize(stored_.type) > 1 && stored_.encoding != Encoding::Ascii)
        sink_.warn(source_.name + ": does not say its byte order; little endian was taken");
    stored_.bigEndian = endian && lowered(endian->value) == "big";
}

/// Byte in `file` behind its first `lines` lines.
std::uint64_t behindLines(const Source& source, std::uint64_t offset, std::uint64_t lines) {
    const InputFile file(source);
    std::string chunk(64 << 10, '\0');
    while (lines > 0) {
        const std::size_t n = file.readAt(offset, std::as_writable_bytes(std::span(chunk)));
        if (n == 0) throw Error(source.name, "has fewer lines than its header skips", "correct \"line skip\"");
        std::size_t at = 0;
        for (; at < n && lines > 0; ++at) lines -= chunk[at] == '\n';
        offset += at;
    }
    return offset;
}

void NrrdParser::readParts() {
    if (header_.dataFiles.empty())
        stored_.parts = {{source_, header_.dataOffset}};
    else
        for (const Source& file : header_.dataFiles) stored_.parts.push_back({file, 0});
    if (const Field* lines = find("lineskip"))
        for (DataPart& part : stored_.parts)
            part.offset = behindLines(part.file, part.offset, countOf(lines->value, place(*lines)));
    const Field* bytes = find("byteskip");
    if (!bytes) return;
    if (bytes->value != "-1") {
        stored_.skip = countOf(bytes->value, place(*bytes));
        return;
    }
    // −1: the data ends the file.
    if (stored_.encoding != Encoding::Raw)
        throw Error(place(*bytes), "a byte skip of -1 needs raw encoding", "correct the header");
    const std::uint64_t share = stored_.storedValues * byteSize(stored_.type) / stored_.parts.size();
    for (DataPart& part : stored_.parts) {
        const std::uint64_t size = InputFile(part.file).size();
        part.offset = std::max(part.offset, size - std::min(size, share));
    }
}

}  // namespace

StoredVolume parseNrrd(const Source& source, VolumeSink& sink) {
    return NrrdParser(source, sink).parse();
}

}  // namespace voledit
