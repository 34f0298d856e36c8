#include "tests/core/scene/random_scenes.h"

#include <random>

namespace voledit::test {

class RandomScenes::Maker {
public:
    Maker(unsigned seed, bool tracks, bool fitted) : random_(seed), tracks_(tracks), fitted_(fitted) {}

    Scene next() {
        Scene scene;
        scene.assets["a \"é\" /~"] = {AssetKind::Volume, "dir/ü.nrrd"};
        scene.assets["b"] = {AssetKind::Motion, "walk.bvh"};
        scene.assets["c"] = {AssetKind::Images, "c.png"};
        // Names are used by what comes later, so that no circle arises.
        scene.transfers["t"] = transfer(2);
        transferNames_ = {"t"};
        scene.transfers["t/2~"] = transfer(2);
        transferNames_ = {"t", "t/2~"};
        Transfer alias;
        alias.kind = TransferUse{"t"};
        scene.transfers["u"] = alias;
        scene.displacements["d"] = displacement(2);
        displacementNames_ = {"d"};
        scene.objects["o"] = object(3);
        objectNames_ = {"o"};
        scene.objects["o 2"] = object(2);
        objectNames_ = {"o", "o 2"};
        scene.root = object(4);
        transferNames_ = displacementNames_ = objectNames_ = {};
        if (chance()) scene.opacityDistance = tracked(unit() + 1e-3, 1e-3, 1);
        if (chance()) {
            scene.camera = Camera{vector(), {}, {}, 1 + unit() * 170};
            scene.camera->target = tracked(vector() + Vec3(1e4));
            scene.camera->up = tracked(vector() + Vec3(0, 0, 2e4));
        }
        scene.render.step = tracked(unit() + 0.01, 0.01, 1);
        scene.render.background = color();
        scene.render.shading = chance();
        if (chance()) scene.render.light = tracked(vector() + Vec3(0, 0, 2e4));
        scene.timeline = {1 + unit() * 100, below(100), 100 + below(100)};
        return scene;
    }

private:
    double unit() { return std::uniform_real_distribution<double>(0, 1)(random_); }
    int below(int n) { return int(random_() % unsigned(n)); }
    bool chance(int oneIn = 2) { return below(oneIn) == 0; }
    double number() { return chance() ? double(below(200) - 100) : (unit() - 0.5) * 2000; }
    Vec3 vector() { return {number(), number(), number()}; }

    // ---- tracks

    /// `value` with tracks now and then, of values that are `low` … `high` apart from it... (within it, where bounded).
    template <class T>
    Tracked<T> tracked(T value, double low = -kInfinity, double high = kInfinity) {
        Tracked<T> result(value);
        if (!tracks_ || !chance(3)) return result;
        const auto numbers = numbersOf(value);
        const auto changed = [&](double v) { return std::isinf(high) ? v + unit() : low + (high - low) * unit(); };
        const auto keysOf = [&](std::size_t first, std::size_t count) {
            Track track;
            double t = number();
            for (int k = 0; k < 1 + below(4); ++k, t += chance(5) ? 0.0 : unit()) {
                std::vector<double> key(numbers.begin() + long(first), numbers.begin() + long(first + count));
                for (double& v : key) v = changed(v);
                track.keys.push_back({t, key});
                if (chance(4)) track.keys.back().interpolation = Track::Interpolation(below(3));
            }
            track.interpolation = Track::Interpolation(below(3));
            return track;
        };
        std::vector<PartTrack> tracks;
        if (numbers.size() == 1 || chance()) {
            tracks.push_back({PartTrack::kWhole, keysOf(0, numbers.size())});
        } else {
            const std::size_t row = rowOf(value);
            for (std::size_t n = 0; n < numbers.size(); ++n) {
                const bool whole = row > 1 && n % row == 0 && chance(4);
                if (!whole && !chance(4)) continue;
                tracks.push_back({int(n), keysOf(n, whole ? row : 1)});
                if (whole) n += row - 1;
            }
        }
        result.setTracks(std::move(tracks));
        return result;
    }
    /// Numbers of an element, in lists of lists.
    static std::size_t rowOf(const std::vector<Vec3>&) { return 3; }
    template <class T>
    static std::size_t rowOf(const T&) {
        return 1;
    }

    Tracked<double> fraction() { return tracked(unit(), 0, 1); }
    Tracked<double> size() { return tracked(unit() + 1e-3, 1e-3, 1); }
    Tracked<Vec3> color() { return tracked(Vec3(unit(), unit(), unit()), 0, 1); }

    TrackedBox box() {
        TrackedBox result;
        const Vec3 corner = vector();
        result.min = tracked(corner);
        result.max = tracked(corner + Vec3(unit() + 2, unit() + 2, 1e3 * unit() + 2));
        return result;
    }
    TrackedFrame frame() {
        if (chance()) {
            const TrackedBox form = box();
            return TrackedFrame(TrackedFrame::Form(form));
        }
        return TrackedFrame(TrackedFrame::Form(TrackedFrame::Oblique{
            tracked(vector()),
            {tracked(Vec3(5, unit(), 0)), tracked(Vec3(0, -5 - unit(), 0)), tracked(Vec3(0, unit(), 5))}}));
    }
    Placement placement() {
        Placement result;
        if (chance(4)) {
            Mat4 m(1);
            for (int c = 0; c < 4; ++c)
                for (int r = 0; r < 3; ++r) m[c][r] += c == r ? 5 + unit() : unit();
            result.matrix = m;
            return result;
        }
        if (chance()) result.translate = tracked(vector());
        if (chance()) result.rotate = tracked(vector());
        if (chance()) result.scale = chance() ? Tracked<Vec3>(Vec3(unit() + 0.1)) : tracked(Vec3(1, 2, unit() + 0.1));
        if (tracks_ && chance(4)) result.scale.setTracks({{PartTrack::kWhole, {{{0, {1, 1, 1}}, {1, {2, 2, 2}}}, {}}}});
        return result;
    }
    Tracked<PiecewiseLinear> table() {
        const double x = number();
        return tracked(PiecewiseLinear{{{x, unit()}, {x + 2, unit()}, {x + 4, unit()}}});
    }
    Tracked<PiecewiseLinear> opacityTable() {
        const double x = number();
        Tracked<PiecewiseLinear> result(PiecewiseLinear{{{x, unit()}, {x, unit()}, {x + 1, unit()}}});
        if (tracks_ && chance())
            result.setTracks({{1, {{{0, {unit()}}, {1, {unit()}}}, {}}}, {2, {{{0, {x, unit()}}}, {}}}});
        return result;
    }
    Tracked<ColorTable> colorTable() {
        const double x = number();
        Tracked<ColorTable> result(ColorTable{{{x, {unit(), 0, 1}}, {x + 1, {unit(), unit(), unit()}}}});
        if (tracks_ && chance()) result.setTracks({{4, {{{0, {x + 1, 0, 0, 1}}, {1, {x + 2, 1, 0, 1}}}, {}}}});
        return result;
    }

    // ---- fields

    std::string asset() { return "a \"é\" /~"; }

    Field field(int depth) {
        switch (depth > 0 ? below(7) : below(3)) {
            case 0:
                return {NumberField{tracked(number())}};
            case 1:
                return {FormulaField{chance() ? "x + sin(y) * t" : "select(x < 0, abs(x), 1)"}};
            case 2:
                return {AssetField{asset(), below(3)}};
            case 3:
                return {ComponentOf{below(3), TransferRef(transfer(depth - 1))}};
            case 4:
                return {ComponentOf{below(3), DisplacementRef(typedDisplacement(depth - 1))}};
            case 5:
                return {AttributeOf{"heat", object(depth - 1)}};
            default:
                return {MappedField{table(), field(depth - 1)}};
        }
    }
    std::array<FieldRef, 3> fields(int depth) { return {field(depth), field(depth), field(depth)}; }

    // ---- STFs and SD objects

    FfdTransfer ffd() {
        FfdTransfer ffd;
        ffd.basis = chance() ? LatticeBasis::Bezier : LatticeBasis::BSpline;
        const int fewest = ffd.basis == LatticeBasis::Bezier ? 2 : 4;
        for (int a = 0; a < 3; ++a) ffd.points[a] = fewest + below(3);
        for (int a = 0; a < 3; ++a) ffd.cells[a] = 1 + below(20);
        const auto count = std::size_t(ffd.points.x * ffd.points.y * ffd.points.z);
        const int how = below(4);
        for (std::size_t i = 0; i < count; ++i) {
            if (how == 2 || (how == 1 && chance())) ffd.moves[i] = {tracked(vector()), how == 2 || chance()};
            if (how != 3) continue;
            Tracked<Vec3> together = vector();
            if (tracks_) together.setTracks({{PartTrack::kWhole, {{{0, {0, 0, unit()}}, {1, {1, 2, 3}}}, {}}}});
            ffd.moves[i] = {together, true};
        }
        return ffd;
    }
    LibraryTransfer library() {
        using Numbers = Tracked<std::vector<double>>;
        switch (below(5)) {
            case 0:
                return {"twist",
                        false,
                        {{"axis", LibraryTransfer::Axes{{below(3)}, false}},
                         {"angle", Numbers(tracked(std::vector<double>{number()}))}}};
            case 1:
                return {"dissect", false, {{"axes", LibraryTransfer::Axes{{2, 0}, true}}}};
            case 2:
                return {"insideOut",
                        false,
                        {{"line", LibraryTransfer::Line{tracked(vector()), tracked(Vec3(0, unit(), 5))}},
                         {"radius", Numbers(tracked(std::vector<double>{unit() + 1}, 1, 2))}}};
            case 3:
                return {"bend",
                        false,
                        {{"axis", LibraryTransfer::Axes{{0}, false}},
                         {"toward", LibraryTransfer::Axes{{1}, false}},
                         {"angle", Numbers({number()})},
                         {"range", Numbers(tracked(std::vector<double>{unit(), 1 + unit()}))}}};
            default:
                return {"files/ripple.stf",
                        true,
                        {{"height", Numbers(tracked(std::vector<double>{number(), number(), number(), number()}))},
                         {"axes", LibraryTransfer::Axes{{1}, true}}}};
        }
    }
    MappedTransfer mapped() {
        MappedTransfer result;
        std::vector<Vec3> points;
        for (int i = 0; i < 8; ++i) points.push_back(vector());
        result.points = tracked(points);
        result.source = tracked(points);
        result.cells = {{0, 1, 2, 3, 4, 5, 6, 7}, {7, 6, 5, 4, 3, 2, 1, 0}};
        return result;
    }
    Tracked<Rotation> rotation() { return tracked(Rotation{vector()}); }
    std::vector<SceneJoint> joints(bool named) {
        std::vector<SceneJoint> result;
        for (const char* name : {"hip", "knee/~", "foot", "\"ü\""}) {
            SceneJoint joint;
            joint.name = name;
            if (named && !result.empty()) joint.parent = chance() ? result.back().name : "hip";
            if (named) joint.at = tracked(vector());
            if (chance()) joint.rotate = rotation();
            if (chance()) joint.translate = tracked(vector());
            if (chance()) joint.limits = JointLimits{Vec3(-unit()), Vec3(unit(), 0, 180)};
            result.push_back(joint);
        }
        if (named && chance()) std::swap(result.front(), result.back());  // the file's order is kept
        return result;
    }
    SceneLimb limb(const std::string& name, int depth) {
        SceneLimb result;
        result.name = name;
        result.from = "hip";
        result.to = chance() ? "foot" : "knee/~";
        if (!fitted_ || chance()) result.size = tracked(Vec2(unit() + 1e-3, unit() + 1e-3), 1e-3, 1);
        if (chance()) result.offset = tracked(Vec2(number(), unit()));
        if (chance()) result.roll = tracked(number());
        if (chance()) result.pad = tracked(Vec2(number(), unit()));
        if (depth > 0 && chance()) result.of = ObjectRef(object(depth - 1));
        return result;
    }
    ActorRig rig(int depth) {
        ActorRig result;
        const bool ofMotion = chance(3);
        if (ofMotion) result.skeleton.motion = "b";
        if (!ofMotion || chance()) result.skeleton.joints = joints(!ofMotion);
        if (chance()) result.skeleton.fit = placement();
        result.skeleton.limbs = {limb("leg", depth), limb("l/~\"", depth)};
        if (chance()) result.motion = "b";
        if (chance()) result.motionMap = {{"hip", "Hips"}, {"knee/~", ""}};
        if (chance()) result.motionFit = chance() ? Placement{} : placement();
        result.inPlace = chance();
        result.allDisjoint = chance();
        if (chance()) result.disjoint = {"foot", "hip"};
        if (chance()) result.cells = {1 + below(3), 1 + below(3), 1 + below(5)};
        if (chance()) result.miterLimit = 1 + unit();
        result.smooth = chance();
        result.preserveVolume = chance();
        if (chance()) result.poses = {{"run/~", {{"hip", vector()}, {"foot", vector()}}}, {"rest", {}}};
        return result;
    }
    decltype(Transfer::kind) transferKind(int depth) {
        switch (depth > 0 ? below(9) : below(5)) {
            case 0:
                return AffineTransfer{placement()};
            case 1:
                return ffd();
            case 2:
                return library();
            case 3: {
                ExpressionTransfer e{"x + a", "y", "z", "", {{"a", "x*y"}}, chance(), std::nullopt};
                if (chance()) e.undefined = "x < a && y > 0";
                if (chance()) e.image = frame();
                return e;
            }
            case 4:
                return mapped();
            case 5:
                if (chance()) return FieldsTransfer{{}, asset(), chance()};
                return FieldsTransfer{fields(depth - 1), "", chance()};
            case 6: {
                SequenceTransfer sequence;
                for (int n = 1 + below(3); n > 0; --n) sequence.of.emplace_back(transfer(depth - 1));
                return sequence;
            }
            case 7:
                return SkeletonTransfer{rig(depth - 1), "leg"};
            default:
                return TransferredTransfer{transfer(depth - 1), transfer(depth - 1)};
        }
    }
    Transfer transfer(int depth) {
        Transfer result;
        if (!transferNames_.empty() && chance(3)) {
            result.kind = TransferUse{transferNames_[std::size_t(below(int(transferNames_.size())))]};
            return result;
        }
        result.kind = transferKind(depth);
        if (chance()) result.name = "name " + std::to_string(below(100));
        if (chance()) result.frame = frame();
        if (chance()) result.outside = chance() ? Outside::Keep : Outside::Hide;
        result.enabled = chance();
        if (chance()) result.amount = fraction();
        return result;
    }

    Displacement displacement(int depth) {
        if (!displacementNames_.empty() && chance(3)) return {DisplacementUse{displacementNames_[0]}};
        return typedDisplacement(depth);
    }
    /// Of those that a component tells from STFs by their type.
    Displacement typedDisplacement(int depth) {
        switch (depth > 0 ? below(4) : 0) {
            case 0:
                return {OfDisplacement{transfer(depth - 1)}};
            case 1:
                return {ScaleDisplacement{field(depth - 1), displacement(depth - 1)}};
            case 2: {
                CombinedDisplacement combined{CombinedDisplacement::Kind(below(3)), {}};
                for (int n = 1 + below(3); n > 0; --n) combined.of.emplace_back(displacement(depth - 1));
                return {combined};
            }
            default:
                return {BlendDisplacement{field(depth - 1), displacement(depth - 1),
                                          Displacement{FieldsDisplacement{fields(depth - 1)}}}};
        }
    }

    // ---- objects

    Appearance appearance() {
        Appearance result;
        if (chance(3)) {
            result.preset = "ct-bone";
        } else {
            if (chance()) result.opacity = opacityTable();
            if (chance()) result.color = colorTable();
        }
        if (chance()) result.gradientOpacity = PiecewiseLinear{{{0, unit()}, {unit(), 1}}};
        return result;
    }
    SolidObject solid() {
        SolidObject result;
        const Vec3 from = vector(), to = from + Vec3(3, 0, unit());
        switch (below(7)) {
            case 0:
                result.shape = SolidSphere{tracked(from), size()};
                break;
            case 1:
                result.shape = SolidBox{box()};
                break;
            case 2:
                result.shape = SolidCylinder{tracked(from), tracked(to), size()};
                break;
            case 3:
                result.shape = SolidCapsule{tracked(from), tracked(to), size()};
                break;
            case 4:
                result.shape = SolidTorus{tracked(from), tracked(Vec3(0, 5, unit())), size(), size()};
                break;
            case 5:
                result.shape = SolidText{"Ä \"b\"", size(), size()};
                break;
            default:
                result.shape = SolidFormula{"length([x, y, z]) - 1", chance() ? TrackedBox{} : box()};
        }
        result.color = color();
        if (chance())
            result.opacity = fraction();
        else
            result.opacity = std::string("clamp(-d, 0, r)");
        if (chance()) result.falloff = size();
        return result;
    }
    FieldsObject fieldsObject(int depth) {
        FieldsObject result{field(depth), fields(depth), {}, {}};
        if (chance()) result.bounds = box();
        if (chance()) result.attributes["heat"] = field(depth);
        if (chance()) result.attributes["a/b~c \"d\""] = field(depth);
        return result;
    }
    Object object(int depth) {
        if (!objectNames_.empty() && chance(4))
            return {ObjectUse{objectNames_[std::size_t(below(int(objectNames_.size())))]}};
        switch (depth > 0 ? below(10) : below(2)) {
            case 0:
                return {VolumeObject{asset(), below(3), Interpolation(below(3)), appearance()}};
            case 1:
                return {solid()};
            case 2:
                return {PlaceObject{placement(), object(depth - 1)}};
            case 3:
            case 4: {
                TransferObject transfers;
                for (int n = below(4); n > 0; --n) transfers.by.emplace_back(transfer(depth - 1));
                transfers.of = object(depth - 1);
                transfers.combine = Combine(below(4));
                return {transfers};
            }
            case 5: {
                CvgObject cvg{CvgOperator(below(6)), {}, {}};
                for (int n = 2 + below(2); n > 0; --n) cvg.of.emplace_back(object(depth - 1));
                return {cvg};
            }
            case 6:
                return {CvgObject{CvgOperator::Blend, {object(depth - 1), object(depth - 1)}, field(depth - 1)}};
            case 7:
                return {DisplaceObject{displacement(depth - 1), object(depth - 1)}};
            case 8:
                return {ActorObject{chance() ? "walker" : "", rig(depth - 1), object(depth - 1)}};
            default:
                if (chance()) return {fieldsObject(depth - 1)};
                return {RecolorObject{chance() ? "opacity" : "heat", colorTable(),
                                      chance() ? std::optional(opacityTable()) : std::nullopt, object(depth - 1)}};
        }
    }

    std::mt19937 random_;
    bool tracks_, fitted_;
    std::vector<std::string> transferNames_, displacementNames_, objectNames_;  // that may be used
};

RandomScenes::RandomScenes(unsigned seed, bool tracks, bool fitted)
    : maker_(std::make_unique<Maker>(seed, tracks, fitted)) {}
RandomScenes::~RandomScenes() = default;

Scene RandomScenes::next() {
    return maker_->next();
}

}  // namespace voledit::test
