#pragma once
// One registry of named actions: menus, shortcuts, tooltips, recorded events and tests all use it.

#include <functional>
#include <string>
#include <vector>

#include "app/editor/keys.h"

namespace voledit {

/// Where the mouse must be for a shortcut to mean an action. One of a part goes before one of everywhere.
enum class KeyRegion : unsigned char { Anywhere, Panels, Timeline };

/// Something that the user can do by name.
struct Action {
    std::string id;        // "edit.undo": group, dot, words joined by hyphens; unique
    std::string title;     // "Undo", as menus show it; "…" at its end where a dialog follows
    std::string shortcut;  // "Ctrl+Z"; empty for none; unique among the actions of a region
    std::string argument;  // what it takes, for the list of actions: "PATH", "on|off"; empty for nothing
    std::string help;      // one line for tooltips and the list of actions
    /// Does it. The argument is empty where none was given; file.open and its like then ask. Throws Error.
    std::function<void(const std::string& argument)> run;
    /// False greys it out; null: always enabled.
    std::function<bool()> enabled = {};
    /// For switches: true shows a tick; null: no switch.
    std::function<bool()> checked = {};
    /// Where the shortcut holds.
    KeyRegion region = KeyRegion::Anywhere;

    bool isEnabled() const { return !enabled || enabled(); }
};

class Actions {
public:
    /// Throws Error where the id or the shortcut is taken, or the shortcut is no chord.
    void add(Action action);

    /// Null where there is none of that id.
    const Action* find(const std::string& id) const;
    /// Runs it. Throws Error where there is none of that id, where it is not enabled, and what it throws itself.
    void run(const std::string& id, const std::string& argument = {}) const;
    /// The action of that shortcut in that very region, enabled or not; null where there is none.
    const Action* ofShortcut(const Chord& chord, KeyRegion region = KeyRegion::Anywhere) const;

    /// In the order they were added.
    const std::vector<Action>& all() const { return actions_; }

    /// "Undo (Ctrl+Z)\nTakes back the last step.": title, shortcut where there is one, help.
    std::string tooltip(const std::string& id) const;

private:
    std::vector<Action> actions_;
    std::vector<Chord> chords_;  // of each action; no key where it has no shortcut
};

/// One line an action: id, argument, shortcut, title, help, in columns. What `voledit edit --list-actions` prints.
std::string listOf(const Actions& actions);

/// "on" or "off" (empty turns `now` round). Throws Error for anything else; `id` names the action in it.
bool switchArgument(const std::string& id, const std::string& argument, bool now);

}  // namespace voledit
