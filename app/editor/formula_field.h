#pragma once
// Fields that formulas are typed in: checked while typing, mistakes shown below with a caret.

#include <exception>
#include <functional>
#include <map>
#include <optional>
#include <string>

#include "app/editor/widgets.h"

namespace voledit {

/// A mistake in a formula, as the core tells it.
struct FormulaProblem {
    std::string message;  // for a proportional font
    std::string excerpt;  // source line and caret below it, for a font of one width; may be empty
    int line = 0;         // from 1; 0: not known
    int column = 0;       // in characters, from 1

    bool operator==(const FormulaProblem&) const = default;
};

/// What `error` says, in parts. A FormulaError's last two lines are the excerpt.
FormulaProblem problemOf(const std::exception& error);
FormulaProblem problemOf(const std::string& text);
/// Runs `check`; nullopt where it throws no Error.
std::optional<FormulaProblem> problemIn(const std::function<void()>& check);

/// The formulas that are being typed. A text that is wrong is kept here, not in the scene, until it is mended or Escape
/// drops it.
class FormulaFields {
public:
    /// Draws one in a labelled row. `key` names the field among
    /// all of this object's (node and member); `value` is the scene's text. Edit::changed: `value` is a new right text.
    /// Edit::cancelled: Escape, or left while wrong. `check` throws Error for a wrong text; it is called when the text
    /// changes. Enter leaves the field, Ctrl+Enter begins a new line.
    Edit draw(const char* label, const std::string& key, std::string& value,
              const std::function<void(const std::string& text)>& check, const std::string& help = {});

    /// The mistake of the field `key`; null where it has none.
    const FormulaProblem* problem(const std::string& key) const;
    /// Whether the field that is being typed in is wrong as it stands; nullopt where none is.
    std::optional<bool> typingWrong() const;
    /// Forgets what is wrong in all fields: another node is shown.
    void clear() { drafts_.clear(); }

private:
    struct Draft {
        std::string text;
        std::string scene;  // the scene's text when typing began
        std::optional<FormulaProblem> problem;
        bool active = false;
    };
    std::map<std::string, Draft> drafts_;
};

namespace ui {
/// A mistake: its message in the colour of problems, then the excerpt in a font of one width.
void formulaProblem(const FormulaProblem& problem);
/// A source line and the caret below it, up to `right` of the window; shifted so that the caret is seen.
void excerpt(const std::string& text, float right);
}  // namespace ui

}  // namespace voledit
