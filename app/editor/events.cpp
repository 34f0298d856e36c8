#include "app/editor/events.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <fstream>
#include <sstream>
#include <utility>

#include "core/base/error.h"

namespace voledit {
namespace {

using Kind = Event::Kind;

struct Verb {
    std::string_view word;
    Kind kind;
};
constexpr std::array kVerbs{
    Verb{"frame", Kind::Frame},
    Verb{"move", Kind::Move},
    Verb{"down", Kind::Down},
    Verb{"up", Kind::Up},
    Verb{"wheel", Kind::Wheel},
    Verb{"click", Kind::Click},
    Verb{"doubleclick", Kind::DoubleClick},
    Verb{"drag", Kind::Drag},
    Verb{"press", Kind::Press},
    Verb{"hold", Kind::Hold},
    Verb{"release", Kind::Release},
    Verb{"text", Kind::Text},
    Verb{"drop", Kind::Drop},
    Verb{"do", Kind::Do},
    Verb{"wait", Kind::Wait},
    Verb{"screenshot", Kind::Screenshot},
    Verb{"state", Kind::State},
};
constexpr std::array<std::pair<std::string_view, MouseButton>, 3> kButtons{
    {{"left", MouseButton::Left}, {"middle", MouseButton::Middle}, {"right", MouseButton::Right}}};

std::string trimmed(const std::string& text) {
    const auto first = text.find_first_not_of(" \t\r");
    if (first == text.npos) return {};
    return text.substr(first, text.find_last_not_of(" \t\r") - first + 1);
}

// Walks over `text` and says of each character whether it stands within quotes.
template <class Visit>
void eachCharacter(const std::string& text, Visit visit) {
    bool quoted = false, escaped = false;
    for (std::size_t i = 0; i < text.size(); ++i) {
        const bool mark = text[i] == '"' && !escaped;
        const bool opens =
            mark && !quoted && (i == 0 || std::string_view(" \t(,").find(text[i - 1]) != std::string_view::npos);
        if (!visit(i, quoted || opens)) return;
        escaped = quoted && text[i] == '\\' && !escaped;
        if (mark) quoted = opens;
    }
}

std::string withoutComment(const std::string& line) {
    std::size_t end = line.size();
    eachCharacter(line, [&](std::size_t i, bool quoted) {
        if (quoted || line[i] != '#' || (i > 0 && line[i - 1] != ' ' && line[i - 1] != '\t')) return true;
        end = i;
        return false;
    });
    return trimmed(line.substr(0, end));
}

// Words apart; blanks within quotes or brackets stay.
std::vector<std::string> wordsOf(const std::string& text) {
    std::vector<std::string> words;
    int depth = 0;
    bool within = false;
    eachCharacter(text, [&](std::size_t i, bool quoted) {
        if (!quoted && text[i] == '(') ++depth;
        if (!quoted && text[i] == ')') --depth;
        const bool blank = !quoted && depth <= 0 && (text[i] == ' ' || text[i] == '\t');
        if (!blank && !within) words.emplace_back();
        if (!blank) words.back() += text[i];
        within = !blank;
        return true;
    });
    return words;
}

std::string quoted(const std::string& text) {
    std::string result = "\"";
    for (const char c : text) {
        if (c == '"' || c == '\\') result += '\\';
        if (c == '\n')
            result += "\\n";
        else if (c == '\t')
            result += "\\t";
        else
            result += c;
    }
    return result + "\"";
}

// A text in quotes as its characters; any other as it is.
std::string unquoted(const std::string& text) {
    if (text.size() < 2 || text.front() != '"' || text.back() != '"') return text;
    std::string result;
    for (std::size_t i = 1; i + 1 < text.size(); ++i) {
        if (text[i] != '\\' || i + 2 >= text.size()) {
            result += text[i];
            continue;
        }
        const char next = text[++i];
        result += next == 'n' ? '\n' : next == 't' ? '\t' : next;
    }
    return result;
}

double numberOf(const std::string& text, const std::string& what) {
    const std::string word = trimmed(text);
    const char* const end = word.data() + word.size();
    double value = 0;
    const auto [at, code] = std::from_chars(word.data() + (word.starts_with('+') ? 1 : 0), end, value);
    if (word.empty() || code != std::errc() || at != end || !std::isfinite(value))
        throw Error(what + ": \"" + word + "\" is no number");
    return value;
}

int wholeNumberOf(const std::string& text, const std::string& what, int least) {
    const double value = numberOf(text, what);
    if (value != std::floor(value) || value < least || value > 1e6)
        throw Error(what + ": \"" + trimmed(text) + "\" is no whole number of " + std::to_string(least) + " or more");
    return int(value);
}

// "3,-4" as two numbers.
Vec2 pairOf(const std::string& text, const std::string& what) {
    const auto comma = text.find(',');
    if (comma == text.npos) throw Error(what + ": expected two numbers X,Y, not \"" + text + "\"");
    return {numberOf(text.substr(0, comma), what), numberOf(text.substr(comma + 1), what)};
}

// The parts of "(a,b,c)" between the commas, quotes taken off.
std::vector<std::string> partsOf(const std::string& inner) {
    std::vector<std::string> parts(1);
    eachCharacter(inner, [&](std::size_t i, bool quoted) {
        if (inner[i] == ',' && !quoted)
            parts.emplace_back();
        else
            parts.back() += inner[i];
        return true;
    });
    for (std::string& part : parts) part = unquoted(trimmed(part));
    return parts;
}

Place namedPlace(const std::string& function, const std::string& inner) {
    const std::vector<std::string> parts = partsOf(inner);
    const auto need = [&](std::size_t count, const char* form) {
        if (parts.size() != count || parts[0].empty())
            throw Error("@" + function + "(" + inner + "): expected " + form);
    };
    Place place;
    if (function == "view") {
        need(2, "@view(u,v), fractions of the viewport");
        place.kind = Place::Kind::View;
        place.at = {numberOf(parts[0], "@view"), numberOf(parts[1], "@view")};
    } else if (function == "point") {
        need(4, "@point(NAME,i,j,k), a lattice's control point");
        place.kind = Place::Kind::Point;
        for (int a = 0; a < 3; ++a) place.point[a] = wholeNumberOf(parts[std::size_t(a) + 1], "@point", 0);
    } else if (function == "joint") {
        need(1, "@joint(NAME)");
        place.kind = Place::Kind::Joint;
    } else if (function == "key") {
        need(2, "@key(TRACK,N)");
        place.kind = Place::Kind::Key;
        place.point.x = wholeNumberOf(parts[1], "@key", 0);
    } else if (function == "widget") {
        place.kind = Place::Kind::Widget;
        place.name = unquoted(trimmed(inner));  // commas belong to the label
        if (place.name.empty()) throw Error("@widget(): expected @widget(\"Panel/Label\")");
        return place;
    } else {
        throw Error("@" + function + " is no place: there are @view, @point, @joint, @key and @widget");
    }
    if (place.kind != Place::Kind::View) place.name = parts[0];
    return place;
}

void expectWords(const std::vector<std::string>& words, std::size_t count, const char* form) {
    if (words.size() != count) throw Error(std::string("expected: ") + form);
}

MouseButton buttonOf(const std::string& word) {
    for (const auto& [name, button] : kButtons)
        if (word == name) return button;
    throw Error("\"" + word + "\" is no button: left, middle or right");
}

Key keyOf(const std::string& word) {
    if (const auto key = keyNamed(word)) return *key;
    throw Error("\"" + word + "\" is no key");
}

void parseDrag(Event& event, const std::vector<std::string>& words) {
    constexpr const char* form = "drag PLACE to PLACE [steps N]";
    if (words.size() != 6) expectWords(words, 4, form);
    if (words[2] != "to" || (words.size() == 6 && words[4] != "steps")) throw Error(std::string("expected: ") + form);
    event.from = parsePlace(words[1]);
    event.to = parsePlace(words[3]);
    event.count = words.size() == 6 ? wholeNumberOf(words[5], "steps", 1) : 10;
}

std::string numberText(double value) {
    std::array<char, 32> buffer;
    const auto result = std::to_chars(buffer.data(), buffer.data() + buffer.size(), value);
    return {buffer.data(), result.ptr};
}

std::string pairText(const Vec2& pair) {
    return numberText(pair.x) + "," + numberText(pair.y);
}

// In quotes where blanks, quotes or a comment's mark would be read otherwise.
std::string argumentText(const std::string& text) {
    return text.find_first_of(" \t\n\"#\\") == text.npos ? text : quoted(text);
}

}  // namespace

Place parsePlace(const std::string& text) {
    Place place;
    std::size_t plus = 0;
    if (text.starts_with('@')) {
        const auto open = text.find('(');
        std::size_t close = text.npos;
        eachCharacter(text, [&](std::size_t i, bool quoted) {
            if (quoted || text[i] != ')') return true;
            close = i;
            return false;
        });
        if (open == text.npos || close == text.npos || close < open)
            throw Error("\"" + text + "\": expected a place as @view(0.5,0.5)");
        place = namedPlace(text.substr(1, open - 1), text.substr(open + 1, close - open - 1));
        plus = close + 1;
        if (plus < text.size() && text[plus] != '+') throw Error("\"" + text + "\": expected +DX,DY after the place");
    } else if (text.starts_with('+')) {
        place.kind = Place::Kind::Here;
    } else {
        plus = text.find('+', 1);
        place.at = pairOf(text.substr(0, plus), "place");
    }
    if (plus < text.size()) place.offset = pairOf(text.substr(plus + 1), "offset");
    return place;
}

std::optional<Event> parseEvent(const std::string& line) {
    const std::string text = withoutComment(line);
    if (text.empty()) return std::nullopt;
    const std::vector<std::string> words = wordsOf(text);
    const std::string rest = trimmed(text.substr(words[0].size()));
    Event event;
    const auto verb = std::find_if(kVerbs.begin(), kVerbs.end(), [&](const Verb& v) { return v.word == words[0]; });
    if (verb == kVerbs.end()) throw Error("\"" + words[0] + "\" is no event");
    event.kind = verb->kind;
    switch (event.kind) {
        case Kind::Frame:
            if (words.size() != 1) expectWords(words, 2, "frame [N]");
            if (words.size() == 2) event.count = wholeNumberOf(words[1], "frame", 1);
            break;
        case Kind::Move:
        case Kind::Click:
        case Kind::DoubleClick:
            expectWords(words, 2, "move, click or doubleclick PLACE");
            event.from = parsePlace(words[1]);
            break;
        case Kind::Drag:
            parseDrag(event, words);
            break;
        case Kind::Down:
        case Kind::Up:
            expectWords(words, 2, "down or up BUTTON");
            event.button = buttonOf(words[1]);
            break;
        case Kind::Wheel:
            expectWords(words, 2, "wheel DY");
            event.wheel = numberOf(words[1], "wheel");
            break;
        case Kind::Press:
            expectWords(words, 2, "press KEYS, a chord as Ctrl+Z");
            if (const auto chord = chordNamed(words[1]))
                event.chord = *chord;
            else
                throw Error("\"" + words[1] + "\" is no chord of keys, as Ctrl+Z");
            break;
        case Kind::Hold:
        case Kind::Release:
            expectWords(words, 2, "hold or release KEY");
            event.key = keyOf(words[1]);
            break;
        case Kind::Text:
            if (rest.size() < 2 || rest.front() != '"' || rest.back() != '"') throw Error("expected: text \"…\"");
            event.text = unquoted(rest);
            break;
        case Kind::Drop:
        case Kind::Screenshot:
        case Kind::State:
            if (rest.empty()) throw Error("expected: " + words[0] + " PATH");
            event.text = unquoted(rest);
            break;
        case Kind::Do:
            if (words.size() < 2) throw Error("expected: do ACTION [ARGUMENT…]");
            event.text = words[1];
            event.argument = unquoted(trimmed(rest.substr(words[1].size())));
            break;
        case Kind::Wait:
            if (words.size() != 2 || words[1] != "idle") throw Error("expected: wait idle");
            break;
    }
    return event;
}

std::vector<Event> parseEvents(const std::string& text, const std::string& file) {
    std::vector<Event> events;
    std::istringstream lines(text);
    std::string line;
    for (int number = 1; std::getline(lines, line); ++number) {
        try {
            if (auto event = parseEvent(line)) {
                event->line = number;
                events.push_back(std::move(*event));
            }
        } catch (const Error& error) {
            throw Error(file + ":" + std::to_string(number) + ": " + error.what());
        }
    }
    return events;
}

std::vector<Event> loadEvents(const std::filesystem::path& path) {
    std::ifstream file(path, std::ios::binary);
    std::ostringstream text;
    if (!std::filesystem::is_regular_file(path) || !file || !(text << file.rdbuf()))
        throw Error(path.string(), "the event file cannot be read", "check the path and its permissions");
    return parseEvents(text.str(), path.string());
}

std::string textOf(const Place& place) {
    std::string text;
    switch (place.kind) {
        case Place::Kind::Pixel:
            text = pairText(place.at);
            break;
        case Place::Kind::View:
            text = "@view(" + pairText(place.at) + ")";
            break;
        case Place::Kind::Point:
            text = "@point(" + argumentText(place.name);
            for (int a = 0; a < 3; ++a) text += "," + std::to_string(place.point[a]);
            text += ")";
            break;
        case Place::Kind::Joint:
            text = "@joint(" + argumentText(place.name) + ")";
            break;
        case Place::Kind::Key:
            text = "@key(" + argumentText(place.name) + "," + std::to_string(place.point.x) + ")";
            break;
        case Place::Kind::Widget:
            text = "@widget(" + quoted(place.name) + ")";
            break;
        case Place::Kind::Here:
            return "+" + pairText(place.offset);
    }
    return place.offset == Vec2(0) ? text : text + "+" + pairText(place.offset);
}

std::string lineOf(const Event& event) {
    const auto verb = std::find_if(kVerbs.begin(), kVerbs.end(), [&](const Verb& v) { return v.kind == event.kind; });
    const std::string word(verb->word);
    switch (event.kind) {
        case Kind::Frame:
            return event.count == 1 ? word : word + " " + std::to_string(event.count);
        case Kind::Move:
        case Kind::Click:
        case Kind::DoubleClick:
            return word + " " + textOf(event.from);
        case Kind::Drag:
            return word + " " + textOf(event.from) + " to " + textOf(event.to) + " steps " +
                   std::to_string(event.count);
        case Kind::Down:
        case Kind::Up:
            for (const auto& [name, button] : kButtons)
                if (button == event.button) return word + " " + std::string(name);
            return word;
        case Kind::Wheel:
            return word + " " + numberText(event.wheel);
        case Kind::Press:
            return word + " " + nameOf(event.chord);
        case Kind::Hold:
        case Kind::Release:
            return word + " " + std::string(nameOf(event.key));
        case Kind::Text:
            return word + " " + quoted(event.text);
        case Kind::Drop:
        case Kind::Screenshot:
        case Kind::State:
            return word + " " + argumentText(event.text);
        case Kind::Do:
            return word + " " + event.text + (event.argument.empty() ? "" : " " + argumentText(event.argument));
        case Kind::Wait:
            return word + " idle";
    }
    return word;
}

}  // namespace voledit
