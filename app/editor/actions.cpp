#include "app/editor/actions.h"

#include <algorithm>

#include "core/base/error.h"

namespace voledit {

void Actions::add(Action action) {
    Chord chord;
    if (!action.shortcut.empty()) {
        const auto named = chordNamed(action.shortcut);
        if (!named) throw Error("action " + action.id, "\"" + action.shortcut + "\" is no chord of keys", {});
        chord = *named;
        if (const Action* other = ofShortcut(chord, action.region))
            throw Error("action " + action.id, "its shortcut " + action.shortcut + " belongs to " + other->id, {});
    }
    if (find(action.id)) throw Error("action " + action.id, "is there already", {});
    actions_.push_back(std::move(action));
    chords_.push_back(chord);
}

const Action* Actions::find(const std::string& id) const {
    const auto at = std::find_if(actions_.begin(), actions_.end(), [&](const Action& a) { return a.id == id; });
    return at == actions_.end() ? nullptr : &*at;
}

void Actions::run(const std::string& id, const std::string& argument) const {
    const Action* action = find(id);
    if (!action) throw Error("there is no action " + id + "; `voledit edit --list-actions` lists them");
    if (!action->isEnabled()) throw Error("the action " + id + " (" + action->title + ") cannot be used now");
    action->run(argument);
}

const Action* Actions::ofShortcut(const Chord& chord, KeyRegion region) const {
    if (chord.key == Key::None) return nullptr;
    for (std::size_t n = 0; n < actions_.size(); ++n)
        if (chords_[n] == chord && actions_[n].region == region) return &actions_[n];
    return nullptr;
}

std::string Actions::tooltip(const std::string& id) const {
    const Action* action = find(id);
    if (!action) return {};
    std::string text = action->title;
    if (!action->shortcut.empty()) text += " (" + action->shortcut + ")";
    if (!action->help.empty()) text += "\n" + action->help;
    return text;
}

std::string listOf(const Actions& actions) {
    std::string text;
    const auto column = [&](const std::string& word, std::size_t width) {
        // Widths count letters, not the bytes of UTF-8.
        const auto letters =
            std::size_t(std::count_if(word.begin(), word.end(), [](char c) { return (c & 0xC0) != 0x80; }));
        text += word + std::string(letters < width ? width - letters : 1, ' ');
    };
    for (const Action& action : actions.all()) {
        column(action.id + (action.argument.empty() ? "" : " " + action.argument), 38);
        column(action.shortcut, 16);
        text += action.title + (action.help.empty() ? "" : ": " + action.help) + "\n";
    }
    return text;
}

bool switchArgument(const std::string& id, const std::string& argument, bool now) {
    if (argument.empty()) return !now;
    if (argument == "on") return true;
    if (argument == "off") return false;
    throw Error(id + " takes on or off, not \"" + argument + "\"");
}

}  // namespace voledit
