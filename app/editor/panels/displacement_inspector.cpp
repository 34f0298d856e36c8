#include <array>

#include "app/editor/panels/inspectors.h"

namespace voledit {

namespace {

const ParameterFormat kAny{};
const ParameterFormat kFactor{{-2, 2, 0, 2}, {}};
const ParameterFormat kShare{{0, 1, 0, 2}, {0, 1}};

void combinedRows(Inspection& in, CombinedDisplacement& combined) {
    static const std::vector<std::string> kinds{"Sum", "Union", "Intersection"};
    int index = int(combined.kind);
    const Edit edit =
        ui::choice("Combine", index, kinds, "Sum of all; union: the largest wins; intersection: the smallest wins");
    if (edit.changed) combined.kind = CombinedDisplacement::Kind(index);
    in.note(edit, "Change combine");
}

}  // namespace

void inspectDisplacement(Inspection& inspection, Displacement& displacement) {
    if (auto* combined = std::get_if<CombinedDisplacement>(&displacement.kind)) combinedRows(inspection, *combined);
    if (auto* scale = std::get_if<ScaleDisplacement>(&displacement.kind))
        inspection.field("Scale", "/by", scale->by, kFactor, "What the displacement is multiplied by");
    if (auto* blend = std::get_if<BlendDisplacement>(&displacement.kind))
        inspection.field("Weight", "/weight", blend->weight, kShare, "0 is the first, 1 the second");
    if (auto* fields = std::get_if<FieldsDisplacement>(&displacement.kind)) {
        ui::note("The displacement by its components, world units.");
        inspection.field("X", "/x", fields->fields[0], kAny);
        inspection.field("Y", "/y", fields->fields[1], kAny);
        inspection.field("Z", "/z", fields->fields[2], kAny);
    }
    if (std::holds_alternative<OfDisplacement>(displacement.kind))
        ui::note("What the deformation below adds to each point.");
}

void inspectField(Inspection& inspection, Field& field) {
    if (auto* component = std::get_if<ComponentOf>(&field.kind)) {
        ui::note("One coordinate of the deformation below, world units.");
        inspection.note(ui::axis("Component", component->axis), "Change component");
    }
    if (auto* attribute = std::get_if<AttributeOf>(&field.kind)) {
        std::string name = attribute->name;
        Edit edit = ui::text("Attribute", name, "opacity, r, g, b, scalar, or one that a fields object names");
        edit.changed &= !name.empty();
        if (edit.changed) attribute->name = name;
        inspection.note(edit, "Change attribute");
    }
    if (auto* mapped = std::get_if<MappedField>(&field.kind)) {
        ui::note("A table over a field, as the file gives it.");
        inspection.field("Of", "/of", mapped->of, kAny);
    }
}

}  // namespace voledit
