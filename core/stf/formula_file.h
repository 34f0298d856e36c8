#pragma once
// The text of a formula file (*.stf), read into its statements; formulas stay text. The format stands in
// resources/transfers/README.md.

#include <string>
#include <vector>

#include "core/stf/transfer_definition.h"

namespace voledit {

/// `error "…" when CONDITION` and `warning "…" when CONDITION`.
struct FormulaFileCheck {
    bool isError = true;
    std::string message;
    FormulaText condition;
};

/// `over NAME = F, F, …`: every value of the list is tried.
struct FormulaFileOver {
    std::string name;
    std::vector<FormulaText> values;
};

/// `[image]`: either `point`, for every combination of the `over` lists, or `min` and `max`.
struct FormulaFileImage {
    std::vector<FormulaLet> lets;       // before the first `over`: these may use low and high
    std::vector<FormulaLet> laterLets;  // behind it: these may use the overs' names too
    std::vector<FormulaFileOver> overs;
    std::optional<FormulaText> point, min, max;
};

/// A formula file's statements.
struct FormulaFile {
    std::string title, description, source;
    bool world = false;    // `space: world`
    bool bounded = false;  // `bounded: yes`
    std::vector<TransferParameter> parameters;
    std::vector<FormulaFileCheck> checks;
    std::vector<FormulaLet> lets;               // before [map]: of parameters alone
    std::vector<FormulaLet> mapLets;            // within it: of the point too
    std::optional<FormulaText> point, x, y, z;  // either `q`, or any of x, y, z
    std::optional<FormulaText> undefined;
    std::optional<FormulaFileImage> image;
};

/// Reads the text of a formula file; `name` stands in its errors. Throws FormulaError, with line and column, for what
/// does not follow the format; formulas are not looked into.
FormulaFile parseFormulaFile(const std::string& text, const std::string& name);

}  // namespace voledit
