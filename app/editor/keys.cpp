#include "app/editor/keys.h"

#include <array>
#include <cctype>
#include <utility>

namespace voledit {
namespace {

struct Named {
    Key key;
    std::string_view name;
};

constexpr std::array kNamed{
    Named{Key::Space, "Space"},
    Named{Key::Apostrophe, "Apostrophe"},
    Named{Key::Comma, "Comma"},
    Named{Key::Minus, "Minus"},
    Named{Key::Period, "Period"},
    Named{Key::Slash, "Slash"},
    Named{Key::Semicolon, "Semicolon"},
    Named{Key::Equal, "Equal"},
    Named{Key::LeftBracket, "LeftBracket"},
    Named{Key::Backslash, "Backslash"},
    Named{Key::RightBracket, "RightBracket"},
    Named{Key::Backquote, "Backquote"},
    Named{Key::Escape, "Escape"},
    Named{Key::Enter, "Enter"},
    Named{Key::Tab, "Tab"},
    Named{Key::Backspace, "Backspace"},
    Named{Key::Insert, "Insert"},
    Named{Key::Delete, "Delete"},
    Named{Key::Right, "Right"},
    Named{Key::Left, "Left"},
    Named{Key::Down, "Down"},
    Named{Key::Up, "Up"},
    Named{Key::PageUp, "PageUp"},
    Named{Key::PageDown, "PageDown"},
    Named{Key::Home, "Home"},
    Named{Key::End, "End"},
    Named{Key::F1, "F1"},
    Named{Key::F2, "F2"},
    Named{Key::F3, "F3"},
    Named{Key::F4, "F4"},
    Named{Key::F5, "F5"},
    Named{Key::F6, "F6"},
    Named{Key::F7, "F7"},
    Named{Key::F8, "F8"},
    Named{Key::F9, "F9"},
    Named{Key::F10, "F10"},
    Named{Key::F11, "F11"},
    Named{Key::F12, "F12"},
    Named{Key::Keypad0, "Keypad0"},
    Named{Key::Keypad1, "Keypad1"},
    Named{Key::Keypad2, "Keypad2"},
    Named{Key::Keypad3, "Keypad3"},
    Named{Key::Keypad4, "Keypad4"},
    Named{Key::Keypad5, "Keypad5"},
    Named{Key::Keypad6, "Keypad6"},
    Named{Key::Keypad7, "Keypad7"},
    Named{Key::Keypad8, "Keypad8"},
    Named{Key::Keypad9, "Keypad9"},
    Named{Key::KeypadDecimal, "KeypadDecimal"},
    Named{Key::KeypadDivide, "KeypadDivide"},
    Named{Key::KeypadMultiply, "KeypadMultiply"},
    Named{Key::KeypadSubtract, "KeypadSubtract"},
    Named{Key::KeypadAdd, "KeypadAdd"},
    Named{Key::KeypadEnter, "KeypadEnter"},
    Named{Key::Shift, "Shift"},
    Named{Key::Ctrl, "Ctrl"},
    Named{Key::Alt, "Alt"},
    Named{Key::Super, "Super"},
};

constexpr std::string_view kLetters = "ABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789";
constexpr std::string_view kSigns = "',-./;=[\\]`";

bool equalIgnoringCase(std::string_view a, std::string_view b) {
    if (a.size() != b.size()) return false;
    for (std::size_t i = 0; i < a.size(); ++i)
        if (std::tolower(static_cast<unsigned char>(a[i])) != std::tolower(static_cast<unsigned char>(b[i])))
            return false;
    return true;
}

}  // namespace

std::string_view nameOf(Key key) {
    for (const Named& named : kNamed)
        if (named.key == key) return named.name;
    for (std::size_t i = 0; i < kLetters.size(); ++i)
        if (int(key) == kLetters[i]) return kLetters.substr(i, 1);
    return {};
}

std::optional<Key> keyNamed(std::string_view name) {
    if (name.size() == 1) {
        const char c = char(std::toupper(static_cast<unsigned char>(name[0])));
        if (kLetters.find(c) != kLetters.npos || kSigns.find(c) != kSigns.npos) return Key(c);
    }
    for (const Named& named : kNamed)
        if (equalIgnoringCase(named.name, name)) return named.key;
    for (const auto& [other, key] : {std::pair<std::string_view, Key>{"Esc", Key::Escape},
                                     {"Return", Key::Enter},
                                     {"Control", Key::Ctrl},
                                     {"Del", Key::Delete}})
        if (equalIgnoringCase(other, name)) return key;
    return std::nullopt;
}

std::optional<Chord> chordNamed(std::string_view text) {
    Chord chord;
    while (true) {
        const std::size_t plus = text.find('+');
        const std::optional<Key> key = keyNamed(text.substr(0, plus));
        if (!key) return std::nullopt;
        if (plus == text.npos) {
            if (*key >= Key::Shift) return std::nullopt;
            chord.key = *key;
            return chord;
        }
        if (*key != Key::Ctrl && *key != Key::Shift && *key != Key::Alt) return std::nullopt;
        chord.ctrl |= *key == Key::Ctrl;
        chord.shift |= *key == Key::Shift;
        chord.alt |= *key == Key::Alt;
        text = text.substr(plus + 1);
    }
}

std::string nameOf(const Chord& chord) {
    return std::string(chord.ctrl ? "Ctrl+" : "") + (chord.alt ? "Alt+" : "") + (chord.shift ? "Shift+" : "") +
           std::string(nameOf(chord.key));
}

}  // namespace voledit
