#pragma once
// Keys and chords, the same for a window and for recorded events.

#include <optional>
#include <string>
#include <string_view>

namespace voledit {

/// A key by its place on a US keyboard. Letters, digits and signs have their (capital) ASCII code; the values index
/// ImGui's io.KeysDown (ImGui::IsKeyPressed(int(Key::G))).
enum class Key : int {
    None = 0,
    Space = ' ',
    Apostrophe = '\'',
    Comma = ',',
    Minus = '-',
    Period = '.',
    Slash = '/',
    Semicolon = ';',
    Equal = '=',
    LeftBracket = '[',
    Backslash = '\\',
    RightBracket = ']',
    Backquote = '`',
    // clang-format off
    Num0 = '0', Num1, Num2, Num3, Num4, Num5, Num6, Num7, Num8, Num9,
    A = 'A', B, C, D, E, F, G, H, I, J, K, L, M, N, O, P, Q, R, S, T, U, V, W, X, Y, Z,
    Escape = 256, Enter, Tab, Backspace, Insert, Delete, Right, Left, Down, Up, PageUp, PageDown, Home, End,
    F1 = 290, F2, F3, F4, F5, F6, F7, F8, F9, F10, F11, F12,
    Keypad0 = 320, Keypad1, Keypad2, Keypad3, Keypad4, Keypad5, Keypad6, Keypad7, Keypad8, Keypad9,
    KeypadDecimal, KeypadDivide, KeypadMultiply, KeypadSubtract, KeypadAdd, KeypadEnter,
    Shift = 340, Ctrl, Alt, Super,
    // clang-format on
};
/// Every Key is below this.
inline constexpr int kKeyCount = 344;

/// "Escape", "G", "PageUp", "Minus" …; "" for a number that is no key.
std::string_view nameOf(Key key);
/// Inverse of `nameOf`, letters in either case; also the signs themselves ("-", "."). nullopt for another word.
std::optional<Key> keyNamed(std::string_view name);

/// A key with modifiers.
struct Chord {
    Key key = Key::None;
    bool ctrl = false, shift = false, alt = false;

    bool operator==(const Chord&) const = default;
};

/// "Ctrl+Shift+Z" (modifiers in any order). nullopt where a part is no key, or nothing but modifiers is named.
std::optional<Chord> chordNamed(std::string_view text);
/// Inverse of `chordNamed`: modifiers in the order Ctrl, Alt, Shift.
std::string nameOf(const Chord& chord);

}  // namespace voledit
