#include "app/editor/events.h"

#include <algorithm>
#include <array>
#include <fstream>
#include <sstream>
#include <utility>

#include "app/editor/event_words.h"
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

}  // namespace

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
