#include "core/stf/formula_file.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <set>

#include "core/stf/formula_file_text.h"

namespace voledit {

namespace {

using Kind = TransferParameter::Kind;

// Bounds of what a file may ask for; far beyond what anybody writes.
constexpr std::size_t kMostStatements = 1000, kMostParameters = 64, kMostCombinations = 4096;

constexpr std::array<std::pair<const char*, Kind>, 6> kKinds{{{"number", Kind::Number},
                                                              {"pair", Kind::Pair},
                                                              {"vector", Kind::Vector},
                                                              {"line", Kind::Line},
                                                              {"axis", Kind::Axis},
                                                              {"axes", Kind::Axes}}};

/// Members that every STF of a scene has, and names that formulas have already.
const std::set<std::string> kTakenNames{"type", "name", "frame", "outside", "enabled", "amount", "file",
                                        "u",    "p",    "q",     "x",       "y",       "z",      "t",
                                        "size", "hand", "low",   "high",    "pi",      "e"};

std::vector<double> readList(FormulaFileCursor& cursor, std::size_t count) {
    const std::string expected = count == 2 ? "two numbers, [a, b]" : "three numbers, [a, b, c]";
    std::vector<double> values;
    if (!cursor.take('[')) cursor.fail("expected " + expected);
    for (std::size_t i = 0; i < count; ++i) {
        if (i > 0) cursor.require(',', "between " + expected);
        values.push_back(cursor.number(expected));
    }
    cursor.require(']', "after " + expected);
    return values;
}

Vec3 readVector(FormulaFileCursor& cursor) {
    const std::vector<double> v = readList(cursor, 3);
    return {v[0], v[1], v[2]};
}

int readAxis(FormulaFileCursor& cursor) {
    const std::string expected = "an axis: x, y or z";
    const std::size_t axis = std::string("xyz").find(cursor.peekWord());
    if (cursor.peekWord().size() != 1 || axis == std::string::npos) cursor.fail("expected " + expected);
    cursor.word(expected);
    return int(axis);
}

TransferArgument readValue(FormulaFileCursor& cursor, const TransferParameter& parameter) {
    switch (parameter.kind) {
        case Kind::Number:
            return std::vector<double>{cursor.number("a number")};
        case Kind::Pair:
            return readList(cursor, 2);
        case Kind::Vector:
            // One number stands for three where `uniform` is said, perhaps only behind it.
            if (cursor.peek() != '[') return std::vector<double>{cursor.number("three numbers, [a, b, c]")};
            return readList(cursor, 3);
        case Kind::Line: {
            const Vec3 point = readVector(cursor);
            if (cursor.peekWord() != "along") cursor.fail("expected \"along\" and the line's direction");
            cursor.word("along");
            return LineValue{point, readVector(cursor)};
        }
        case Kind::Axis:
            return std::vector<int>{readAxis(cursor)};
        case Kind::Axes:
            break;
    }
    std::vector<int> axes;
    cursor.require('[', "before a list of axes");
    do axes.push_back(readAxis(cursor));
    while (cursor.take(','));
    cursor.require(']', "after a list of axes");
    return axes;
}

/// `[0, 1)`: round brackets leave the end out.
Interval readInterval(FormulaFileCursor& cursor) {
    const std::string form = "an interval such as [0, 1], or (0, inf) without its ends";
    const std::size_t begin = cursor.offset();
    const bool openLow = cursor.take('(');
    if (!openLow && !cursor.take('[')) cursor.fail("expected " + form);
    Interval range;
    range.low = cursor.number(form);
    cursor.require(',', "within " + form);
    range.high = cursor.number(form);
    const bool openHigh = cursor.take(')');
    if (!openHigh && !cursor.take(']')) cursor.fail("expected the end of " + form);
    if (openLow) range.low = std::nextafter(range.low, kInfinity);
    if (openHigh) range.high = std::nextafter(range.high, -kInfinity);
    // The largest finite number stands for what is open towards infinity.
    if (range.low == -std::numeric_limits<double>::max()) range.low = -kInfinity;
    if (range.high == std::numeric_limits<double>::max()) range.high = kInfinity;
    if (!(range.low <= range.high))
        cursor.fail("the interval that ends here is empty (it began at column " + std::to_string(begin) +
                    " of the file)");
    return range;
}

/// Checks a value that the file gives, and makes three numbers of one for a uniform vector.
void complete(FormulaFileCursor& cursor, const TransferParameter& parameter, TransferArgument& value) {
    auto* numbers = std::get_if<std::vector<double>>(&value);
    if (numbers && parameter.kind == Kind::Vector && numbers->size() == 1) {
        if (!parameter.uniform) cursor.fail("\"" + parameter.name + "\" needs three numbers, [a, b, c], or uniform");
        numbers->assign(3, double(numbers->front()));
    }
    if (numbers)
        for (const double v : *numbers)
            if (!std::isfinite(v) || !parameter.allowed.contains(v))
                cursor.fail("\"" + parameter.name + "\" starts with a value that is not allowed");
    if (const auto* line = std::get_if<LineValue>(&value); line && line->direction == Vec3(0))
        cursor.fail("the direction of \"" + parameter.name + "\" is 0");
}

class Reader {
public:
    Reader(const std::string& text, const std::string& name) : text_(text, name) {}

    FormulaFile read() {
        if (text_.statements().size() > kMostStatements)
            text_.fail(text_.statements()[kMostStatements].begin,
                       "more than " + std::to_string(kMostStatements) + " lines; write a shorter file");
        for (const auto& statement : text_.statements()) {
            FormulaFileCursor cursor(text_, statement);
            if (section_.empty())
                readHead(cursor);
            else if (section_ == "map")
                readMap(cursor);
            else
                readImage(cursor);
            cursor.finish();
        }
        requireComplete();
        return std::move(file_);
    }

private:
    bool startsSection(FormulaFileCursor& cursor) {
        if (!cursor.take('[')) return false;
        const std::string name = cursor.peekWord();
        if ((name != "map" && name != "image") || (name == "map") != section_.empty() ||
            (name == "image" && file_.image))
            cursor.fail("expected [map], then at most one [image], here");
        section_ = cursor.word("a section");
        if (name == "image") file_.image.emplace();
        cursor.require(']', "after the section's name");
        return true;
    }

    void readHead(FormulaFileCursor& cursor) {
        if (startsSection(cursor)) return;
        const std::string expected =
            "title:, description:, source:, space:, bounded:, parameter, let, error, warning or [map]";
        const std::size_t begin = cursor.offset();
        const std::string word = cursor.word(expected);
        if (word == "parameter") {
            readParameter(cursor);
        } else if (word == "let") {
            readLet(cursor, file_.lets);
        } else if (word == "error" || word == "warning") {
            readCheck(cursor, word == "error");
        } else if (word == "title" || word == "description" || word == "source") {
            readText(cursor, word == "title" ? file_.title : word == "source" ? file_.source : file_.description);
        } else if (word == "space") {
            file_.world = readChoice(cursor, "frame", "world");
        } else if (word == "bounded") {
            file_.bounded = readChoice(cursor, "no", "yes");
        } else {
            text_.fail(begin, "\"" + word + "\" is not known here; expected " + expected);
        }
    }

    void readText(FormulaFileCursor& cursor, std::string& to) {
        cursor.require(':', "and a text");
        if (!to.empty()) cursor.fail("this was said before");
        to = cursor.line("a text");
    }

    /// False for the first word, true for the second.
    static bool readChoice(FormulaFileCursor& cursor, const std::string& no, const std::string& yes) {
        const std::string expected = "\"" + no + "\" or \"" + yes + "\"";
        cursor.require(':', "and " + expected);
        const std::string found = cursor.peekWord();
        if (found != no && found != yes) cursor.fail("expected " + expected);
        cursor.word(expected);
        return found == yes;
    }

    static std::string readName(FormulaFileCursor& cursor) {
        const char first = cursor.peek();
        if (first >= '0' && first <= '9') cursor.fail("a name begins with a letter");
        return cursor.word("a name");
    }

    /// The name of a parameter or of an `over`, which nothing else has.
    std::string newSymbol(FormulaFileCursor& cursor) {
        const std::size_t begin = cursor.offset();
        const std::string name = readName(cursor);
        if (kTakenNames.contains(name))
            text_.fail(begin, "\"" + name + "\" means something else already; choose another name");
        if (!symbols_.insert(name).second) text_.fail(begin, "there is a \"" + name + "\" already");
        return name;
    }

    void readParameter(FormulaFileCursor& cursor) {
        TransferParameter parameter;
        const std::size_t begin = cursor.offset();
        parameter.name = newSymbol(cursor);
        if (file_.parameters.size() == kMostParameters)
            text_.fail(begin, "more than " + std::to_string(kMostParameters) + " parameters");
        const std::string kind = cursor.peekWord();
        const auto* found = std::find_if(kKinds.begin(), kKinds.end(), [&](const auto& k) { return kind == k.first; });
        if (found == kKinds.end())
            cursor.fail("expected the parameter's kind: number, pair, vector, line, axis or axes");
        cursor.word("a kind");
        parameter.kind = found->second;
        if (parameter.kind == Kind::Line)  // what formulas call it
            for (const char* part : {"_point", "_direction"})
                if (!symbols_.insert(parameter.name + part).second)
                    text_.fail(begin, "there is a \"" + parameter.name + part + "\" already");
        readClauses(cursor, parameter);
        parameter.description = cursor.quoted("the parameter's description");
        file_.parameters.push_back(std::move(parameter));
    }

    static void readClauses(FormulaFileCursor& cursor, TransferParameter& parameter) {
        std::optional<TransferArgument> suggested;
        std::optional<Interval> slider;
        while (cursor.peek() != '"') {
            if (cursor.take(',')) continue;
            if (cursor.take('='))
                parameter.initial = readValue(cursor, parameter);
            else
                readClause(cursor, parameter, suggested, slider);
        }
        if (!parameter.initial && !suggested)
            cursor.fail("give a default (= VALUE), or what the editor is to start with (suggested VALUE)");
        parameter.suggested = suggested ? *suggested : *parameter.initial;
        complete(cursor, parameter, parameter.suggested);
        if (parameter.initial) complete(cursor, parameter, *parameter.initial);
        const bool finite = std::isfinite(parameter.allowed.low) && std::isfinite(parameter.allowed.high);
        parameter.slider = slider                        ? *slider
                           : finite                      ? parameter.allowed
                           : parameter.unit == "degrees" ? Interval{-180, 180}
                                                         : Interval{0, 1};
    }

    static void readClause(FormulaFileCursor& cursor, TransferParameter& parameter,
                           std::optional<TransferArgument>& suggested, std::optional<Interval>& slider) {
        const std::string expected =
            "= VALUE, suggested VALUE, allowed [LOW, HIGH], slider [LOW, HIGH], strength, uniform, a unit (degrees, "
            "length, position) or the description in quotes";
        const std::string word = cursor.peekWord();
        static const std::set<std::string> known{"suggested", "allowed", "slider", "strength",
                                                 "uniform",   "degrees", "length", "position"};
        if (!known.contains(word)) cursor.fail("expected " + expected);
        const bool numbers =
            parameter.kind == Kind::Number || parameter.kind == Kind::Pair || parameter.kind == Kind::Vector;
        if (word != "suggested" && !numbers) cursor.fail("only numbers, pairs and vectors have this");
        if (word == "uniform" && parameter.kind != Kind::Vector) cursor.fail("only a vector may be uniform");
        cursor.word(expected);
        if (word == "suggested") {
            suggested = readValue(cursor, parameter);
        } else if (word == "allowed") {
            parameter.allowed = readInterval(cursor);
        } else if (word == "slider") {
            slider = readInterval(cursor);
            if (!std::isfinite(slider->low) || !std::isfinite(slider->high)) cursor.fail("a slider has two ends");
        } else if (word == "strength") {
            parameter.strength = true;
            if (cursor.peekWord() == "from") {
                cursor.word("from");
                parameter.identity = cursor.number("the value at amount 0");
            }
        } else if (word == "uniform") {
            parameter.uniform = true;
        } else {
            parameter.unit = word;
        }
    }

    void readLet(FormulaFileCursor& cursor, std::vector<FormulaLet>& lets) {
        FormulaLet let;
        let.name = readName(cursor);
        cursor.require('=', "and a formula after the name");
        let.formula = cursor.formula("a formula");
        lets.push_back(std::move(let));
    }

    void readCheck(FormulaFileCursor& cursor, bool isError) {
        FormulaFileCheck check{isError, cursor.quoted("a message"), {}};
        if (cursor.peekWord() != "when") cursor.fail("expected \"when\" and a condition");
        cursor.word("when");
        check.condition = cursor.formula("a condition");
        file_.checks.push_back(std::move(check));
    }

    /// `NAME = FORMULA` for a result that is given once.
    void readResult(FormulaFileCursor& cursor, std::optional<FormulaText>& to) {
        if (to) cursor.fail("this was given before");
        cursor.word("a name");
        cursor.require('=', "and a formula");
        to = cursor.formula("a formula");
    }

    void readMap(FormulaFileCursor& cursor) {
        if (startsSection(cursor)) return;
        const std::string word = cursor.peekWord();
        if (word == "let") {
            cursor.word("let");
            return readLet(cursor, file_.mapLets);
        }
        auto* result = word == "q"           ? &file_.point
                       : word == "x"         ? &file_.x
                       : word == "y"         ? &file_.y
                       : word == "z"         ? &file_.z
                       : word == "undefined" ? &file_.undefined
                                             : nullptr;
        if (!result) cursor.fail("expected let, q =, x =, y =, z =, undefined = or [image]");
        readResult(cursor, *result);
        if (file_.point && (file_.x || file_.y || file_.z))
            text_.fail(mapBegin(cursor), "give q, or x, y and z, not both");
    }

    std::size_t mapBegin(FormulaFileCursor& cursor) const {
        const std::size_t at = cursor.offset();
        for (const auto& statement : text_.statements())
            if (statement.end == at) return statement.begin;
        return at;
    }

    void readImage(FormulaFileCursor& cursor) {
        if (startsSection(cursor)) return;
        FormulaFileImage& image = *file_.image;
        const std::string word = cursor.peekWord();
        if (word == "let") {
            cursor.word("let");
            readLet(cursor, image.overs.empty() ? image.lets : image.laterLets);
        } else if (word == "over") {
            cursor.word("over");
            if (!image.laterLets.empty()) cursor.fail("all \"over\" stand together, before the lets that use them");
            FormulaFileOver over;
            over.name = newSymbol(cursor);
            cursor.require('=', "and formulas with commas between them");
            over.values = cursor.formulas("a formula");
            image.overs.push_back(std::move(over));
            std::size_t combinations = 1;
            for (const FormulaFileOver& o : image.overs)
                if ((combinations *= o.values.size()) > kMostCombinations)
                    cursor.fail("more than " + std::to_string(kMostCombinations) + " combinations of \"over\"");
        } else if (word == "point" || word == "min" || word == "max") {
            readResult(cursor, word == "point" ? image.point : word == "min" ? image.min : image.max);
        } else {
            cursor.fail("expected let, over, point =, min = or max =");
        }
    }

    void requireComplete() const {
        const std::size_t end = text_.text().size();
        if (section_.empty()) text_.fail(end, "the formulas are missing: add [map] and, below it, q = …");
        if (!file_.point && !file_.x && !file_.y && !file_.z)
            text_.fail(end, "[map] gives no point: add q = …, or x = …, y = …, z = …");
        if (!file_.image) return;
        const FormulaFileImage& image = *file_.image;
        if (bool(image.min) != bool(image.max) || bool(image.point) == bool(image.min))
            text_.fail(end, "[image] needs either point, or min and max");
        if (!image.overs.empty() && !image.point) text_.fail(end, "\"over\" goes with point, not with min and max");
    }

    FormulaFileText text_;
    std::set<std::string> symbols_;  // of parameters and overs
    std::string section_;            // "", "map", "image"
    FormulaFile file_;
};

}  // namespace

FormulaFile parseFormulaFile(const std::string& text, const std::string& name) {
    return Reader(text, name).read();
}

}  // namespace voledit
