#include "core/fields/glyph_outlines.h"

#include <ft2build.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <memory>
#include FT_FREETYPE_H
#include FT_OUTLINE_H
#include FT_TRUETYPE_TABLES_H

#include "core/base/error.h"
#include "core/fields/font_kerning.h"

namespace voledit {

namespace {

namespace fs = std::filesystem;

constexpr std::size_t kMostCharacters = 200;
constexpr double kTolerance = 1e-4;  // of flattened curves, capital heights
constexpr FT_ULong kKerningTable = FT_MAKE_TAG('G', 'P', 'O', 'S');
constexpr const char* kFontFolders[] = {"/usr/share/fonts", "/usr/local/share/fonts"};
constexpr const char* kFontNames[] = {"InterDisplay-Bold", "Inter-Bold", "InterDisplay-SemiBold", "Inter-SemiBold"};

[[noreturn]] void refuse(const std::string& what, const std::string& remedy) {
    throw Error("text solid", what, remedy);
}

/// The first of kFontNames that is installed, wherever the distribution puts it.
fs::path fontFile() {
    std::array<fs::path, std::size(kFontNames)> found;
    for (const char* folder : kFontFolders) {
        std::error_code failed;
        fs::recursive_directory_iterator at(folder, fs::directory_options::skip_permission_denied, failed), end;
        for (; !failed && at != end; at.increment(failed)) {
            const std::string extension = at->path().extension().string(), stem = at->path().stem().string();
            const auto name = std::find(std::begin(kFontNames), std::end(kFontNames), stem);
            if ((extension != ".otf" && extension != ".ttf") || name == std::end(kFontNames)) continue;
            fs::path& place = found[std::size_t(name - std::begin(kFontNames))];
            if (place.empty() || at->path() < place) place = at->path();
        }
    }
    for (const fs::path& path : found)
        if (!path.empty()) return path;
    refuse("the font Inter is not installed", "install the package fonts-inter");
}

/// Code points of UTF-8.
std::vector<char32_t> decoded(const std::string& text) {
    constexpr std::array<char32_t, 4> kSmallest{0, 0x80, 0x800, 0x10000};  // of each length: no longer spelling counts
    std::vector<char32_t> points;
    for (std::size_t i = 0; i < text.size();) {
        const auto lead = static_cast<unsigned char>(text[i++]);
        const std::size_t more = lead < 0x80 ? 0 : lead >> 5 == 6 ? 1 : lead >> 4 == 14 ? 2 : lead >> 3 == 30 ? 3 : 4;
        char32_t point = more == 0 ? lead : lead & (0x3Fu >> more);
        bool valid = more < 4 && i + more <= text.size();
        for (std::size_t n = 0; valid && n < more; ++n) {
            const auto next = static_cast<unsigned char>(text[i++]);
            valid = next >> 6 == 2;
            point = point << 6 | (next & 0x3F);
        }
        if (!valid || point < kSmallest[more] || point > 0x10FFFF) refuse("its string is not UTF-8", "write it anew");
        if (point < 0x20 || point == 0x7F) refuse("its string holds a control character", "write one line of text");
        points.push_back(point);
    }
    if (points.empty()) refuse("its string is empty", "give it letters");
    if (points.size() > kMostCharacters)
        refuse("its string has " + std::to_string(points.size()) + " characters, more than " +
                   std::to_string(kMostCharacters),
               "use several solids");
    return points;
}

struct Closer {
    void operator()(FT_Library library) const { FT_Done_FreeType(library); }
    void operator()(FT_Face face) const { FT_Done_Face(face); }
};

/// A font in its own units.
class Font {
public:
    Font() {
        FT_Library library = nullptr;
        if (FT_Init_FreeType(&library) != 0) refuse("the font library does not start", "reinstall libfreetype6");
        library_.reset(library);
        const fs::path path = fontFile();
        FT_Face face = nullptr;
        if (FT_New_Face(library, path.c_str(), 0, &face) != 0)
            refuse("the font " + path.string() + " cannot be read", "reinstall the package fonts-inter");
        face_.reset(face);
        FT_ULong length = 0;
        if (FT_Load_Sfnt_Table(face, kKerningTable, 0, nullptr, &length) == 0) {
            std::vector<std::uint8_t> table(length);
            if (FT_Load_Sfnt_Table(face, kKerningTable, 0, table.data(), &length) == 0)
                kerning_ = FontKerning(std::move(table));
        }
    }

    FT_UInt glyphOf(char32_t character) const {
        const FT_UInt glyph = FT_Get_Char_Index(face_.get(), character);
        if (glyph == 0) {
            std::array<char, 16> code;
            std::snprintf(code.data(), code.size(), "U+%04X", unsigned(character));
            refuse(std::string("the font Inter has no character ") + code.data(), "use others");
        }
        return glyph;
    }
    const FT_GlyphSlotRec& load(FT_UInt glyph) {
        if (FT_Load_Glyph(face_.get(), glyph, FT_LOAD_NO_SCALE) != 0)
            refuse("a letter of the font cannot be read", "reinstall the package fonts-inter");
        return *face_->glyph;
    }
    double capitalHeight() { return double(load(glyphOf(U'H')).metrics.horiBearingY); }
    double kerning(FT_UInt left, FT_UInt right) const { return kerning_.between(left, right); }

private:
    std::unique_ptr<FT_LibraryRec_, Closer> library_;
    std::unique_ptr<FT_FaceRec_, Closer> face_;
    FontKerning kerning_;
};

/// Takes the curves of a glyph and lays straight pieces.
class Flattener {
public:
    Flattener(double scale, Vec2 offset, double tolerance) : scale_(scale), offset_(offset), tolerance_(tolerance) {}

    GlyphOutline flattened(FT_Outline& outline) {
        FT_Outline_Funcs functions{};
        functions.move_to = [](const FT_Vector* to, void* self) { return as(self).moveTo(as(self).at(to)); };
        functions.line_to = [](const FT_Vector* to, void* self) { return as(self).lineTo(as(self).at(to)); };
        functions.conic_to = [](const FT_Vector* control, const FT_Vector* to, void* self) {
            const Vec2 a = as(self).pen_, b = as(self).at(control), c = as(self).at(to);
            return as(self).cubicTo(a + (b - a) * (2.0 / 3), c + (b - c) * (2.0 / 3), c);
        };
        functions.cubic_to = [](const FT_Vector* b, const FT_Vector* c, const FT_Vector* to, void* self) {
            return as(self).cubicTo(as(self).at(b), as(self).at(c), as(self).at(to));
        };
        if (FT_Outline_Decompose(&outline, &functions, this) != 0)
            refuse("a letter of the font cannot be read", "reinstall the package fonts-inter");
        lineTo(start_);
        return std::move(result_);
    }

private:
    static Flattener& as(void* self) { return *static_cast<Flattener*>(self); }
    Vec2 at(const FT_Vector* v) const { return offset_ + scale_ * Vec2(double(v->x), double(v->y)); }

    int moveTo(const Vec2& to) {
        lineTo(start_);  // closes the contour before
        start_ = pen_ = to;
        return 0;
    }
    int lineTo(const Vec2& to) {
        if (to == pen_) return 0;
        result_.segments.push_back({pen_, to});
        result_.min = glm::min(result_.min, glm::min(pen_, to));
        result_.max = glm::max(result_.max, glm::max(pen_, to));
        pen_ = to;
        return 0;
    }
    /// As many pieces as Wang's bound asks for.
    int cubicTo(const Vec2& b, const Vec2& c, const Vec2& d) {
        const Vec2 a = pen_;
        const double bend = std::max(glm::length(a - 2.0 * b + c), glm::length(b - 2.0 * c + d));
        const int pieces = std::clamp(int(std::ceil(std::sqrt(0.75 * bend / tolerance_))), 1, 1000);
        for (int n = 1; n < pieces; ++n) {
            const double t = double(n) / pieces, s = 1 - t;
            lineTo(s * s * s * a + 3 * s * s * t * b + 3 * s * t * t * c + t * t * t * d);
        }
        return lineTo(d);
    }

    double scale_;
    Vec2 offset_;
    double tolerance_;
    Vec2 start_{0}, pen_{0};
    GlyphOutline result_;
};

}  // namespace

std::vector<GlyphOutline> outlinesOf(const std::string& text, double height) {
    const std::vector<char32_t> characters = decoded(text);
    Font font;
    const double scale = height / font.capitalHeight();
    std::vector<GlyphOutline> result;
    double pen = 0;  // font units
    FT_UInt previous = 0;
    for (const char32_t character : characters) {
        const FT_UInt glyph = font.glyphOf(character);
        if (previous != 0) pen += font.kerning(previous, glyph);
        FT_GlyphSlotRec slot = font.load(glyph);
        GlyphOutline outline = Flattener(scale, {scale * pen, 0}, kTolerance * height).flattened(slot.outline);
        if (!outline.segments.empty()) result.push_back(std::move(outline));
        pen += double(slot.metrics.horiAdvance);
        previous = glyph;
    }
    if (result.empty()) refuse("its string shows nothing", "give it letters");
    return result;
}

}  // namespace voledit
