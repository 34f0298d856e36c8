#include "app/io/scan_vtk.h"

#include <algorithm>
#include <map>

#include "app/io/checks.h"
#include "app/io/header_text.h"
#include "app/io/vtk_cursor.h"
#include "core/base/error.h"

namespace voledit {

namespace {

using Words = std::vector<std::string>;
using Role = VtkArray::Role;

std::optional<StoredType> typeOf(const std::string& word) {
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
    return found == types.end() ? std::nullopt : std::optional(found->second);
}

class VtkScanner {
public:
    VtkScanner(const Source& source, VolumeSink& sink) : input_(source), cursor_(input_), sink_(sink) {
        file_.source = source;
    }

    VtkFile scan() {
        readStart();
        while (const auto words = nextWords()) readKeyword(*words);
        return std::move(file_);
    }

private:
    std::string place() const {
        return file_.text ? placeOf(file_.source, int(cursor_.linesPassed()))
                          : input_.name() + ", byte " + std::to_string(cursor_.position());
    }

    /// The words of the next line that has some.
    std::optional<Words> nextWords() {
        while (const auto line = cursor_.line())
            if (auto words = wordsOf(*line); !words.empty()) return words;
        return std::nullopt;
    }
    Words needWords(const char* expected, std::size_t count) {
        auto words = nextWords();
        if (!words)
            throw Error(input_.name(), std::string("ends where ") + expected + " was expected", "the file is cut off");
        return need(std::move(*words), count);
    }
    Words need(Words words, std::size_t count) const {
        if (words.size() < count) throw Error(place(), inQuotes(words[0]) + " is not complete", "correct the line");
        return words;
    }

    void readStart() {
        cursor_.line();  // "# vtk DataFile Version x.y"
        cursor_.line();  // a title
        file_.text = true;
        const std::string encoding = lowered(needWords("ASCII or BINARY", 1)[0]);
        if (encoding != "ascii" && encoding != "binary")
            throw Error(place(), "says " + inQuotes(encoding) + " where ASCII or BINARY is expected",
                        "correct the header");
        const Words set = needWords("DATASET", 1);
        if (lowered(set[0]) != "dataset") throw Error(place(), "is no DATASET line", "correct the header");
        const std::string kind = set.size() > 1 ? lowered(set[1]) : "";
        static const std::map<std::string, VtkDataset> kinds{{"structured_points", VtkDataset::StructuredPoints},
                                                             {"structured_grid", VtkDataset::StructuredGrid},
                                                             {"rectilinear_grid", VtkDataset::RectilinearGrid},
                                                             {"unstructured_grid", VtkDataset::UnstructuredGrid}};
        const auto found = kinds.find(kind);
        if (found == kinds.end())
            throw Error(place(), "holds " + inQuotes(kind) + ", which fills no volume",
                        "save it as STRUCTURED_POINTS, STRUCTURED_GRID, RECTILINEAR_GRID or UNSTRUCTURED_GRID");
        file_.dataset = found->second;
        file_.text = encoding == "ascii";
    }

    void readKeyword(const Words& words) {
        using Reader = void (VtkScanner::*)(const Words&);
        static const std::map<std::string, Reader> readers{
            {"dimensions", &VtkScanner::readDimensions},
            {"origin", &VtkScanner::readOrigin},
            {"spacing", &VtkScanner::readSpacing},
            {"aspect_ratio", &VtkScanner::readSpacing},
            {"points", &VtkScanner::readPoints},
            {"x_coordinates", &VtkScanner::readCoordinates},
            {"y_coordinates", &VtkScanner::readCoordinates},
            {"z_coordinates", &VtkScanner::readCoordinates},
            {"blanking", &VtkScanner::readBlanking},
            {"cells", &VtkScanner::readCells},
            {"cell_types", &VtkScanner::readCellTypes},
            {"metadata", &VtkScanner::skipMetadata},
            {"field", &VtkScanner::readField},
            {"point_data", &VtkScanner::startPointData},
            {"cell_data", &VtkScanner::startCellData},
            {"scalars", &VtkScanner::readScalars},
            {"color_scalars", &VtkScanner::readColors},
            {"lookup_table", &VtkScanner::skipTable},
            {"texture_coordinates", &VtkScanner::readTextureCoordinates}};
        /// Attributes of a fixed number of components.
        static const std::map<std::string, std::pair<std::uint64_t, Role>> plain{
            {"vectors", {3, Role::Values}},  {"normals", {3, Role::Directions}}, {"tensors", {9, Role::Values}},
            {"tensors6", {6, Role::Values}}, {"global_ids", {1, Role::Names}},   {"pedigree_ids", {1, Role::Names}},
            {"edge_flags", {1, Role::Names}}};
        const std::string keyword = lowered(words[0]);
        if (const auto reader = readers.find(keyword); reader != readers.end()) {
            (this->*reader->second)(words);
        } else if (const auto attribute = plain.find(keyword); attribute != plain.end()) {
            need(words, 3);
            keep(words[1], words[2], attribute->second.first, tuples_, attribute->second.second);
        } else {
            throw Error(place(), inQuotes(words[0]) + " is not understood",
                        "the file is damaged, or its sizes are wrong: save it anew");
        }
    }

    void readDimensions(const Words& words) {
        need(words, 4);
        for (std::size_t a = 0; a < 3; ++a) file_.dimensions[a] = countOf(words[a + 1], place());
        checkSizes(place(), file_.dimensions, 1);
    }
    void readOrigin(const Words& words) { file_.origin = three(words); }
    void readSpacing(const Words& words) { file_.spacing = three(words); }
    Vec3 three(const Words& words) const {
        need(words, 4);
        return {realOf(words[1], place()), realOf(words[2], place()), realOf(words[3], place())};
    }

    void readPoints(const Words& words) {
        need(words, 3);
        file_.points = numbers("POINTS", words[2], 3, countOf(words[1], place()));
    }
    void readCoordinates(const Words& words) {
        need(words, 3);
        auto& axis = file_.coordinates[std::size_t(lowered(words[0])[0] - 'x')];
        axis = numbers(words[0], words[2], 1, countOf(words[1], place()));
    }
    void readBlanking(const Words& words) {
        need(words, 3);
        file_.visible = numbers("BLANKING", words[2], 1, countOf(words[1], place()));
    }
    void readCells(const Words& words) {
        need(words, 3);
        const std::uint64_t first = countOf(words[1], place()), second = countOf(words[2], place());
        while (cursor_.ahead("\n") || cursor_.ahead("\r")) cursor_.line();
        if (!cursor_.ahead("offsets")) {
            file_.cellCount = first;
            file_.cells = numbers("CELLS", "int", 1, second);
            return;
        }
        file_.cellCount = first > 0 ? first - 1 : 0;
        file_.offsets = numbers("OFFSETS", needWords("OFFSETS", 2)[1], 1, first);
        const Words connectivity = needWords("CONNECTIVITY", 2);
        if (lowered(connectivity[0]) != "connectivity")
            throw Error(place(), inQuotes(connectivity[0]) + " stands where CONNECTIVITY is expected", "save it anew");
        file_.connectivity = numbers("CONNECTIVITY", connectivity[1], 1, second);
    }
    void readCellTypes(const Words& words) {
        need(words, 2);
        file_.cellTypes = numbers("CELL_TYPES", "int", 1, countOf(words[1], place()));
    }

    void startPointData(const Words& words) { startData(words, &file_.pointData); }
    void startCellData(const Words& words) { startData(words, &file_.cellData); }
    void startData(const Words& words, std::vector<VtkArray>* data) {
        need(words, 2);
        tuples_ = countOf(words[1], place());
        data_ = data;
    }

    void readScalars(const Words& words) {
        need(words, 3);
        const std::uint64_t components = words.size() > 3 ? countOf(words[3], place()) : 1;
        while (cursor_.ahead("\n") || cursor_.ahead("\r\n")) cursor_.line();
        if (cursor_.ahead("lookup_table")) cursor_.line();  // its name; old files leave it out
        keep(words[1], words[2], components, tuples_, Role::Scalars);
    }
    void readColors(const Words& words) {
        need(words, 3);
        keep(words[1], file_.text ? "float" : "unsigned_char", countOf(words[2], place()), tuples_, Role::Values);
    }
    void skipTable(const Words& words) {
        need(words, 3);
        numbers("LOOKUP_TABLE", file_.text ? "float" : "unsigned_char", 4, countOf(words[2], place()));
    }
    void readTextureCoordinates(const Words& words) {
        need(words, 4);
        keep(words[1], words[3], countOf(words[2], place()), tuples_, Role::Directions);
    }

    void readField(const Words& words) {
        need(words, 3);
        for (std::uint64_t left = countOf(words[2], place()); left > 0; --left) {
            Words array = needWords("an array", 1);
            while (lowered(array[0]) == "metadata") {
                skipMetadata(array);
                array = needWords("an array", 1);
            }
            if (array[0] == "NULL_ARRAY") continue;
            if (array.size() < 4)
                throw Error(place(), inQuotes(array[0]) + " is no array's name, components, count and type",
                            "correct it");
            const bool numbering = lowered(array[0]).starts_with("vtk");  // vtkOriginalPointIds, vtkGhostType …
            keep(array[0], array[3], countOf(array[1], place()), countOf(array[2], place()),
                 numbering ? Role::Names : Role::Values);
        }
    }

    /// "METADATA" and the lines up to an empty one.
    void skipMetadata(const Words&) {
        while (const auto line = cursor_.line())
            if (trimmed(*line).empty()) return;
    }

    /// Passes over an array, and remembers one that holds numbers as the data of points or cells.
    void keep(const std::string& name, const std::string& type, std::uint64_t components, std::uint64_t tuples,
              Role role) {
        const std::string low = lowered(type);
        if (low == "string") return skipStrings(checkProduct(place(), {components, tuples}));
        if (low == "bit") return skipBits(checkProduct(place(), {components, tuples}));
        VtkArray array = numbers(name, type, components, tuples);
        array.role = role;
        if (data_ && array.count() > 0) data_->push_back(std::move(array));
    }

    /// An array whose numbers come next, and are passed.
    VtkArray numbers(const std::string& name, const std::string& type, std::uint64_t components, std::uint64_t tuples) {
        const auto stored = typeOf(type);
        if (!stored)
            throw Error(place(), "type " + inQuotes(type) + " is not read",
                        "save the values as integers, float or double");
        VtkArray array{name, *stored, components, tuples, cursor_.position()};
        const std::uint64_t count = checkProduct(place(), {components, tuples});
        if (components > 4096) throw Error(place(), "has more than 4096 values a point", "correct the header");
        if (file_.text)
            skipWords(array);
        else
            skipBytes(name, checkProduct(place(), {count, byteSize(*stored)}));
        return array;
    }

    void skipWords(const VtkArray& array) {
        // A number and the white space behind it take two bytes.
        if (array.count() / 2 > cursor_.left()) throwCutOff(array.name);
        for (std::uint64_t n = 0; n < array.count(); ++n) {
            if (cursor_.word().empty()) throwCutOff(array.name);
            if (n % (1 << 16) == 0) progress();
        }
    }
    void skipBytes(const std::string& name, std::uint64_t bytes) {
        if (bytes > cursor_.left()) throwCutOff(name);
        cursor_.moveTo(cursor_.position() + bytes);
        progress();
    }
    void skipBits(std::uint64_t count) {
        if (file_.text)
            skipWords({"bits", StoredType::UInt8, 1, count});
        else
            skipBytes("bits", count / 8 + (count % 8 > 0));
    }
    /// As text a line each; as bytes their lengths come first, in a number whose first two bits say how long it is.
    void skipStrings(std::uint64_t count) {
        for (; count > 0; --count) {
            if (file_.text) {
                if (!cursor_.line()) throwCutOff("strings");
                continue;
            }
            std::array<std::byte, 8> bytes{};
            if (cursor_.read(std::span(bytes).first(1)) < 1) throwCutOff("strings");
            const std::size_t more = (std::size_t(1) << (3 - (std::to_integer<unsigned>(bytes[0]) >> 6))) - 1;
            if (cursor_.read(std::span(bytes).subspan(1, more)) < more) throwCutOff("strings");
            std::uint64_t length = std::to_integer<std::uint64_t>(bytes[0]) & 0x3f;
            for (std::size_t i = 1; i <= more; ++i) length = length << 8 | std::to_integer<std::uint64_t>(bytes[i]);
            skipBytes("strings", length);
        }
    }

    [[noreturn]] void throwCutOff(const std::string& name) const {
        throw Error(input_.name(), inQuotes(name) + " claims more values than there are in the file",
                    "the file is cut off, or its sizes are wrong: copy or save it anew");
    }

    void progress() {
        sink_.progress(0.5 * double(cursor_.position()) / double(std::max<std::uint64_t>(input_.size(), 1)));
    }

    InputFile input_;
    VtkCursor cursor_;
    VolumeSink& sink_;
    VtkFile file_;
    std::vector<VtkArray>* data_ = nullptr;  // of points or of cells; null: of the whole file, not of interest
    std::uint64_t tuples_ = 0;
};

}  // namespace

VtkFile scanVtk(const Source& source, VolumeSink& sink) {
    return VtkScanner(source, sink).scan();
}

const VtkArray* mainArray(const std::vector<VtkArray>& arrays) {
    const auto found = std::ranges::min_element(arrays, {}, &VtkArray::role);
    return found == arrays.end() ? nullptr : &*found;
}

}  // namespace voledit
