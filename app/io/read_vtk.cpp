// Legacy VTK files of structured points: a text header, then numbers as text or big-endian.
// https://docs.vtk.org/en/latest/design_documents/VTKFileFormats.html

#include <map>

#include "app/io/checks.h"
#include "app/io/header_text.h"
#include "app/io/readers.h"
#include "core/base/error.h"

namespace voledit {

namespace {

StoredType typeOf(const std::string& word, const std::string& where) {
    static const std::map<std::string, StoredType> types{{"char", StoredType::Int8},
                                                         {"unsigned_char", StoredType::UInt8},
                                                         {"signed_char", StoredType::Int8},
                                                         {"short", StoredType::Int16},
                                                         {"unsigned_short", StoredType::UInt16},
                                                         {"int", StoredType::Int32},
                                                         {"unsigned_int", StoredType::UInt32},
                                                         {"long", StoredType::Int64},
                                                         {"unsigned_long", StoredType::UInt64},
                                                         {"vtktypeint64", StoredType::Int64},
                                                         {"vtktypeuint64", StoredType::UInt64},
                                                         {"vtkidtype", StoredType::Int64},
                                                         {"float", StoredType::Float},
                                                         {"double", StoredType::Double}};
    const auto found = types.find(lowered(word));
    if (found == types.end())
        throw Error(where, "type " + inQuotes(word) + " is not read", "save the values as integers, float or double");
    return found->second;
}

class VtkParser {
public:
    explicit VtkParser(const Source& source) : source_(source), lines_(source) {}

    StoredVolume parse() {
        stored_.format = "vtk";
        readStart();
        while (const auto words = nextWords()) {
            const std::string keyword = lowered((*words)[0]);
            if (keyword == "dimensions") readDimensions(*words);
            if (keyword == "origin") origin_ = three(*words);
            if (keyword == "spacing" || keyword == "aspect_ratio") spacing_ = three(*words);
            if (keyword == "cell_data")
                throw Error(place(), "holds values of cells, not of points", "convert them to point data");
            if (keyword == "point_data") {
                readAttribute();
                return finish();
            }
        }
        throw Error(source_.name, "has no POINT_DATA", "the file is cut off, or holds no values");
    }

private:
    std::string place() const { return placeOf(source_, lines_.number()); }

    /// The words of the next line that has some.
    std::optional<std::vector<std::string>> nextWords() {
        while (const auto line = lines_.next())
            if (auto words = wordsOf(*line); !words.empty()) return words;
        return std::nullopt;
    }
    std::vector<std::string> needWords(const char* expected) {
        if (auto words = nextWords()) return std::move(*words);
        throw Error(source_.name, std::string("ends where ") + expected + " was expected", "the file is cut off");
    }

    Vec3 three(const std::vector<std::string>& words) const {
        if (words.size() < 4) throw Error(place(), "needs three numbers", "correct the header");
        return {realOf(words[1], place()), realOf(words[2], place()), realOf(words[3], place())};
    }

    void readStart() {
        lines_.next();  // "# vtk DataFile Version x.y"
        lines_.next();  // a title
        const std::string encoding = lowered(needWords("ASCII or BINARY")[0]);
        if (encoding != "ascii" && encoding != "binary")
            throw Error(place(), "says " + inQuotes(encoding) + " where ASCII or BINARY is expected",
                        "correct the header");
        stored_.encoding = encoding == "ascii" ? Encoding::Ascii : Encoding::Raw;
        stored_.bigEndian = true;
        const auto set = needWords("DATASET");
        const std::string kind = set.size() > 1 ? lowered(set[1]) : "";
        if (lowered(set[0]) != "dataset") throw Error(place(), "is no DATASET line", "correct the header");
        if (kind != "structured_points")
            throw Error(place(),
                        "holds " + inQuotes(kind) +
                            "; this version reads STRUCTURED_POINTS only, structured "
                            "and unstructured grids come with a later version",
                        "resample it to structured points");
    }

    void readDimensions(const std::vector<std::string>& words) {
        if (words.size() < 4) throw Error(place(), "needs three sizes", "correct the header");
        for (std::size_t a = 0; a < 3; ++a) size_[a] = countOf(words[a + 1], place());
        checkSizes(place(), size_, 1);
    }

    /// The first attribute: SCALARS, VECTORS, COLOR_SCALARS or the first array of a FIELD. Its data follow.
    void readAttribute() {
        const auto words = needWords("SCALARS");
        const std::string keyword = lowered(words[0]);
        const auto need = [&](std::size_t count) {
            if (words.size() < count) throw Error(place(), "is not complete", "correct the header");
        };
        if (keyword == "scalars") {
            need(3);
            stored_.type = typeOf(words[2], place());
            channels_ = words.size() > 3 ? countOf(words[3], place()) : 1;
            skipLookupTable();
        } else if (keyword == "vectors" || keyword == "normals") {
            need(3);
            stored_.type = typeOf(words[2], place());
            channels_ = 3;
        } else if (keyword == "color_scalars") {
            need(3);
            stored_.type = stored_.encoding == Encoding::Ascii ? StoredType::Float : StoredType::UInt8;
            channels_ = countOf(words[2], place());
        } else if (keyword == "field") {
            const auto array = needWords("an array");
            if (array.size() < 4) throw Error(place(), "is no array's name, components, count and type", "correct it");
            stored_.type = typeOf(array[3], place());
            channels_ = countOf(array[1], place());
        } else {
            throw Error(place(), inQuotes(words[0]) + " is not read", "save the values as SCALARS, VECTORS or FIELD");
        }
    }

    /// "LOOKUP_TABLE name", which old files leave out.
    void skipLookupTable() {
        HeaderLines ahead = lines_;
        const auto line = ahead.next();
        if (line && lowered(*line).starts_with("lookup_table")) lines_ = ahead;
    }

    StoredVolume finish() {
        checkSizes(source_.name, size_, channels_);
        stored_.setInterleaved(size_, channels_, 1);
        checkSpacing(source_.name + ", SPACING", spacing_);
        for (int a = 0; a < 3; ++a) stored_.worldFromIndex[a][a] = spacing_[a];
        stored_.worldFromIndex[3] = Vec4(origin_, 1);
        stored_.parts = {{source_, lines_.offset()}};
        stored_.moreMayFollow = true;
        return std::move(stored_);
    }

    const Source& source_;
    HeaderLines lines_;
    StoredVolume stored_;
    std::array<std::uint64_t, 3> size_{0, 0, 0};
    std::uint64_t channels_ = 1;
    Vec3 origin_{0}, spacing_{1};
};

}  // namespace

StoredVolume parseVtk(const Source& source) {
    return VtkParser(source).parse();
}

}  // namespace voledit
