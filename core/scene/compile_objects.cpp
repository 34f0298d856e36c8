// Objects of a scene → terms.
#include <algorithm>

#include "core/base/error.h"
#include "core/objects/solid_shapes.h"
#include "core/scene/appearance.h"
#include "core/scene/compiler.h"

namespace voledit {

namespace {

/// The shape with its numbers as they are; formulas name their place.
struct ShapeOf {
    std::string where;

    SolidShape operator()(const SolidSphere& s) const { return SphereShape{s.center, s.radius}; }
    SolidShape operator()(const SolidBox& s) const { return BoxShape{s.box.min, s.box.max}; }
    SolidShape operator()(const SolidCylinder& s) const { return CylinderShape{s.from, s.to, s.radius}; }
    SolidShape operator()(const SolidCapsule& s) const { return CapsuleShape{s.from, s.to, s.radius}; }
    SolidShape operator()(const SolidTorus& s) const { return TorusShape{s.center, s.axis, s.major, s.minor}; }
    SolidShape operator()(const SolidText& s) const { return TextShape{s.string, s.height, s.depth}; }
    SolidShape operator()(const SolidFormula& s) const {
        return DistanceShape{{s.d, where + "/shape/expression/d"}, s.bounds};
    }
};

/// The numbers and texts of a shape.
struct AddShape {
    PieceKey& key;

    void operator()(const SolidSphere& s) const { add(s.center, s.radius); }
    void operator()(const SolidBox& s) const { add(s.box.min, s.box.max); }
    void operator()(const SolidCylinder& s) const { add(s.from, s.to, s.radius); }
    void operator()(const SolidCapsule& s) const { add(s.from, s.to, s.radius); }
    void operator()(const SolidTorus& s) const { add(s.center, s.axis, s.major, s.minor); }
    void operator()(const SolidText& s) const { add(s.string, s.height, s.depth); }
    void operator()(const SolidFormula& s) const { add(s.d, s.bounds.min, s.bounds.max); }

private:
    template <class... Input>
    void add(const Input&... inputs) const {
        (key.add(inputs), ...);
    }
};

/// Opacity of a solid over x, y, z, r, d. A number is a parameter, so that dragging it changes no program.
FormulaGraph opacityOf(const SolidObject& object, const std::string& where) {
    FormulaSymbols symbols;
    for (const char* name : {"x", "y", "z", "r", "d"}) symbols.variables.push_back({name});
    const auto* formula = std::get_if<std::string>(&object.opacity);
    symbols.parameters.push_back({formula ? "t" : "opacity"});
    const FormulaText text = formula ? FormulaText{*formula, where + "/opacity"} : FormulaText{"opacity", where};
    return FormulaGraph({}, {{text, FormulaType::Number}}, symbols);
}

}  // namespace

TermPtr Compiler::object(const Object& object) {
    return std::visit([this](const auto& kind) { return compiled(kind); }, object.kind);
}

TermPtr Compiler::compiled(const ObjectUse& use) {
    const auto known = objects_.find(use.name);
    if (known != objects_.end()) {
        if (!known->second) throw Error("object \"" + use.name + "\"", "it uses itself", "break the cycle");
        return known->second;
    }
    const auto found = in_.scene.objects.find(use.name);
    if (found == in_.scene.objects.end())
        throw Error("use of \"" + use.name + "\"", "the scene has no such object", "name one of `objects`");
    const At at(*this, objectPath(use.name));
    objects_[use.name] = nullptr;
    return objects_[use.name] = object(*found->second);
}

TermPtr Compiler::compiled(const VolumeObject& object) {
    const FieldPtr values = assetChannel(object.asset, object.channel);  // checks both
    if (const auto mesh = std::dynamic_pointer_cast<const MeshField>(values))
        return piece<Term>(PieceKey("mesh", mesh, object.appearance), [&] {
            return makeMeshTerm(mesh, resolve(object.appearance, mesh->mesh()->range(object.channel)));
        });
    const auto& volume = in_.assets.volumes.at(object.asset);
    return piece<Term>(PieceKey("volume", volume, object.channel, object.interpolation, object.appearance), [&] {
        return makeVolumeTerm(volume, object.channel, resolve(object.appearance, *volume), object.interpolation);
    });
}

TermPtr Compiler::compiled(const SolidObject& object) {
    const auto* opacity = std::get_if<std::string>(&object.opacity);
    const auto* number = std::get_if<Tracked<double>>(&object.opacity);
    const auto* distance = std::get_if<SolidFormula>(&object.shape);
    const double time = timeFor((opacity && formulaReadsTime(*opacity)) || (distance && formulaReadsTime(distance->d)));
    PieceKey key("solid", object.color, object.opacity, object.falloff, time, object.shape.index());
    std::visit(AddShape{key}, object.shape);
    return piece<Term>(key, [&] {
        const SolidDistance shape = distanceOf(std::visit(ShapeOf{at_}, object.shape), time);
        SolidTerm solid{shape.distance, shape.center,           shape.box,
                        object.color,   opacityOf(object, at_), {opacity ? time : **number},
                        object.falloff};
        return makeSolidTerm(std::move(solid));
    });
}

TermPtr Compiler::compiled(const FieldsObject& object) {
    FieldsTerm fields;
    {
        const At at(*this, "opacity");
        fields.opacity = field(*object.opacity);
    }
    for (std::size_t c = 0; c < 3; ++c) {
        const At at(*this, "color", c);
        fields.color[c] = field(*object.color[c]);
    }
    for (const auto& [name, attribute] : object.attributes) {
        const At at(*this, at_ + "/" + pointerToken(name));
        fields.attributes.emplace(name, field(*attribute));
    }
    fields.box = object.bounds;
    const PieceKey key("fields", fields.opacity, fields.color, fields.box, fields.attributes);
    return piece<Term>(key, [&] { return makeFieldsTerm(fields); });
}

TermPtr Compiler::compiled(const CvgObject& object) {
    std::vector<TermPtr> of;
    for (std::size_t n = 0; n < object.of.size(); ++n) {
        const At at(*this, "of", n);
        of.push_back(this->object(*object.of[n]));
    }
    FieldPtr weight;
    if (object.by == CvgOperator::Blend) {
        const At at(*this, "weight");
        weight = field(*object.weight);
    }
    return piece<Term>(PieceKey("cvg", object.by, of, weight), [&] { return makeCvgTerm(object.by, of, weight); });
}

TermPtr Compiler::compiled(const RecolorObject& object) {
    RecolorTerm recolor;
    {
        const At at(*this, "of");
        recolor.of = this->object(*object.of);
    }
    recolor.from = object.from;
    if (object.color) recolor.color = **object.color;
    if (object.opacity) recolor.opacity = **object.opacity;
    const PieceKey key("recolor", recolor.from, recolor.color, recolor.opacity, recolor.of);
    return piece<Term>(key, [&] { return makeRecolorTerm(recolor); });
}

TermPtr Compiler::compiled(const PlaceObject& object) {
    TermPtr of;
    {
        const At at(*this, "of");
        const Mat4 around = worldFromHere_;
        worldFromHere_ = around * worldFromRest(object.placement);
        of = this->object(*object.of);
        worldFromHere_ = around;
    }
    return transferred(made(AffineTransfer{object.placement}, Transfer{}, nullptr), of,
                       {Combine::Union, "", TransferRole::Place});
}

TermPtr Compiler::compiled(const TransferObject& object) {
    TermPtr term;
    {
        const At at(*this, "of");
        term = this->object(*object.of);
    }
    for (std::size_t n = 0; n < object.by.size(); ++n) {
        const At at(*this, "by", n);
        const Transfer* transfer = &*object.by[n];
        std::string name = transfer->name;
        const Maps parts = mapsFor(term, [&] { return maps(*transfer, &term->bounds); });
        while (const auto* use = std::get_if<TransferUse>(&transfer->kind)) {  // no circle: `maps` went through
            transfer = &*in_.scene.transfers.at(use->name);
            name = transfer->name.empty() ? use->name : transfer->name;
        }
        const bool isLast = n + 1 == object.by.size();
        const Application whole{object.combine, name, isLast ? TransferRole::Outermost : TransferRole::SameList};
        // Every pre-image of every member counts, and slices are cut along the members' cells.
        if (std::any_of(parts.begin(), parts.end(), [](const TransferPtr& part) { return part->cells() != nullptr; })) {
            for (std::size_t k = 0; k + 1 < parts.size(); ++k)
                term = transferred(parts[k], term, {object.combine, "", TransferRole::Part});
            term = transferred(parts.back(), term, whole);
        } else {
            term = transferred(sequence(parts), term, whole);
        }
    }
    return term;
}

TermPtr Compiler::compiled(const DisplaceObject& object) {
    TermPtr of;
    {
        const At at(*this, "of");
        of = this->object(*object.of);
    }
    const At at(*this, "by");
    const TransferPtr by = mapsFor(of, [&] { return displacement(*object.by, &of->bounds); });
    return transferred(by, of, {Combine::Union, "", TransferRole::Displace});
}

TermPtr Compiler::transferred(const TransferPtr& by, const TermPtr& of, const Application& how) {
    return piece<Term>(PieceKey("transfer", by, of, how.combine, how.name, how.role),
                       [&] { return makeTransferTerm(by, of, how.combine, how.name, how.role); });
}

}  // namespace voledit
