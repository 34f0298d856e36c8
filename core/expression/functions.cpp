#include "core/expression/functions.h"

#include <algorithm>

namespace voledit {

namespace {

using Arguments = std::span<const FormulaValue>;

constexpr int kMany = 16;

int widest(Arguments arguments) {
    int width = 1;
    for (const FormulaValue& argument : arguments) width = std::max(width, argument.width);
    return width;
}

/// f(component of each argument) for every component of the widest argument.
template <class F>
FormulaValue each(Arguments arguments, F f) {
    FormulaValue result{.width = widest(arguments)};
    for (int c = 0; c < result.width; ++c) result.node[static_cast<std::size_t>(c)] = f(c);
    return result;
}

template <Op op>
FormulaValue unary(GraphBuilder& g, Arguments a) {
    return each(a, [&](int c) { return g.make(op, a[0].component(c)); });
}

template <Op op>
FormulaValue binary(GraphBuilder& g, Arguments a) {
    return componentwise(g, op, a[0], a[1]);
}

/// op(op(a, b), c) …
template <Op op>
FormulaValue folded(GraphBuilder& g, Arguments a) {
    FormulaValue result = a[0];
    for (const FormulaValue& argument : a.subspan(1)) result = componentwise(g, op, result, argument);
    return result;
}

int clamped(GraphBuilder& g, int x, int low, int high) {
    return g.make(Op::Minimum, g.make(Op::Maximum, x, low), high);
}

FormulaValue clamp(GraphBuilder& g, Arguments a) {
    return each(a, [&](int c) { return clamped(g, a[0].component(c), a[1].component(c), a[2].component(c)); });
}

FormulaValue mix(GraphBuilder& g, Arguments a) {
    return each(a, [&](int c) {
        const int weight = a[2].component(c);
        const int first = g.make(Op::Multiply, a[0].component(c), g.make(Op::Subtract, g.constant(1), weight));
        return g.make(Op::Add, first, g.make(Op::Multiply, a[1].component(c), weight));
    });
}

FormulaValue step(GraphBuilder& g, Arguments a) {
    return each(a, [&](int c) {
        return g.make(Op::Select, g.make(Op::Less, a[1].component(c), a[0].component(c)), g.constant(0), g.constant(1));
    });
}

FormulaValue smoothstep(GraphBuilder& g, Arguments a) {
    return each(a, [&](int c) {
        const int from = a[0].component(c);
        const int length = g.make(Op::Subtract, a[1].component(c), from);
        const int t = g.make(Op::Divide, g.make(Op::Subtract, a[2].component(c), from), length);
        return g.make(Op::Hermite, clamped(g, t, g.constant(0), g.constant(1)));
    });
}

FormulaValue select(GraphBuilder& g, Arguments a) {
    const int condition = g.truth(a[0].node[0]);
    return each(a, [&](int c) { return g.make(Op::Select, condition, a[1].component(c), a[2].component(c)); });
}

int dotProduct(GraphBuilder& g, const FormulaValue& a, const FormulaValue& b) {
    std::array<int, 3> product{};
    for (int c = 0; c < 3; ++c)
        product[static_cast<std::size_t>(c)] = g.make(Op::Multiply, a.component(c), b.component(c));
    return g.make(Op::Add, g.make(Op::Add, product[0], product[1]), product[2]);
}

FormulaValue dot(GraphBuilder& g, Arguments a) {
    return {1, {dotProduct(g, a[0], a[1]), -1, -1}};
}

/// Of a vector, or of two or three numbers.
FormulaValue length(GraphBuilder& g, Arguments a) {
    if (a.size() == 1) return {1, {g.make(Op::SquareRoot, dotProduct(g, a[0], a[0])), -1, -1}};
    int sum = -1;
    for (const FormulaValue& number : a) {
        const int square = g.power(number.node[0], 2);
        sum = sum < 0 ? square : g.make(Op::Add, sum, square);
    }
    return {1, {g.make(Op::SquareRoot, sum), -1, -1}};
}

FormulaValue normalize(GraphBuilder& g, Arguments a) {
    return componentwise(g, Op::Divide, a[0], length(g, a));
}

/// a·b − c·d.
int crossTerm(GraphBuilder& g, std::array<int, 2> plus, std::array<int, 2> minus) {
    return g.make(Op::Subtract, g.make(Op::Multiply, plus[0], plus[1]), g.make(Op::Multiply, minus[0], minus[1]));
}

FormulaValue cross(GraphBuilder& g, Arguments a) {
    const auto& [u, v] = std::pair{a[0].node, a[1].node};
    return {3,
            {crossTerm(g, {u[1], v[2]}, {u[2], v[1]}), crossTerm(g, {u[2], v[0]}, {u[0], v[2]}),
             crossTerm(g, {u[0], v[1]}, {u[1], v[0]})}};
}

/// Sum of what a rotation adds up; terms with a factor that is a constant zero are left out, so that a turn about a
/// coordinate axis costs what it costs by hand.
class TermSum {
public:
    explicit TermSum(GraphBuilder& g) : g_(g) {}
    void add(std::initializer_list<int> factors, bool negative = false) {
        int product = -1;
        for (const int f : factors) {
            if (g_.isConstant(f) && g_.node(f).value() == 0) return;
            product = product < 0 ? f : g_.make(Op::Multiply, product, f);
        }
        if (sum_ < 0)
            sum_ = negative ? g_.make(Op::Negate, product) : product;
        else
            sum_ = g_.make(negative ? Op::Subtract : Op::Add, sum_, product);
    }
    int result() { return sum_ < 0 ? g_.constant(0) : sum_; }

private:
    GraphBuilder& g_;
    int sum_ = -1;
};

/// True where `k`, a unit vector, is a constant along axis `c`.
bool isAxis(const GraphBuilder& g, const FormulaValue& k, int c) {
    return g.isConstant(k.component(c), 1) || g.isConstant(k.component(c), -1);
}

/// Rodrigues: v cos + (k × v) sin + k (k·v)(1 − cos), k the unit axis.
FormulaValue rotate(GraphBuilder& g, Arguments a) {
    const FormulaValue v = a[0], k = normalize(g, a.subspan(1, 1));
    const int cosine = g.make(Op::Cosine, a[2].node[0]), sine = g.make(Op::Sine, a[2].node[0]);
    const int rest = g.make(Op::Subtract, g.constant(1), cosine);
    TermSum along(g);
    for (int c = 0; c < 3; ++c) along.add({k.component(c), v.component(c)});
    const int part = g.make(Op::Multiply, along.result(), rest);
    FormulaValue result{.width = 3};
    for (int c = 0; c < 3; ++c) {
        const int next = (c + 1) % 3, last = (c + 2) % 3;
        if (isAxis(g, k, c)) {
            result.node[static_cast<std::size_t>(c)] = v.component(c);
            continue;
        }
        TermSum crossed(g), sum(g);
        crossed.add({k.component(next), v.component(last)});
        crossed.add({k.component(last), v.component(next)}, true);
        sum.add({v.component(c), cosine});
        sum.add({crossed.result(), sine});
        sum.add({k.component(c), part});
        result.node[static_cast<std::size_t>(c)] = sum.result();
    }
    return result;
}

FormulaValue vector(GraphBuilder&, Arguments a) {
    return {3, {a[0].node[0], a[1].node[0], a[2].node[0]}};
}

FormulaValue noiseValue(GraphBuilder& g, Arguments a) {
    const FormulaValue point = a.size() == 1 ? a[0] : FormulaValue{3, {a[0].node[0], a[1].node[0], a[2].node[0]}};
    return {1, {g.noise(point.node, {0, 0, 0}), -1, -1}};
}

constexpr auto kFunctions = std::to_array<FormulaFunction>({
    {"abs", 1, 1, "abs(x)", "x without its sign", unary<Op::Absolute>, "a"},
    {"acos", 1, 1, "acos(x)", "arc cosine, 0 … pi; NaN beyond [-1, 1]", unary<Op::ArcCosine>, "a"},
    {"asin", 1, 1, "asin(x)", "arc sine, -pi/2 … pi/2; NaN beyond [-1, 1]", unary<Op::ArcSine>, "a"},
    {"atan", 1, 1, "atan(x)", "arc tangent, -pi/2 … pi/2", unary<Op::ArcTangent>, "a"},
    {"atan2", 2, 2, "atan2(y, x)", "angle of the point (x, y), -pi … pi", binary<Op::ArcTangent2>, "a"},
    {"ceil", 1, 1, "ceil(x)", "least whole number not below x", unary<Op::Ceil>, "a"},
    {"clamp", 3, 3, "clamp(x, low, high)", "min(max(x, low), high)", clamp, "a"},
    {"cos", 1, 1, "cos(x)", "cosine", unary<Op::Cosine>, "a"},
    {"cosh", 1, 1, "cosh(x)", "hyperbolic cosine", unary<Op::CosineH>, "a"},
    {"cross", 2, 2, "cross(u, v)", "vector product", cross, "v"},
    {"dot", 2, 2, "dot(u, v)", "scalar product", dot, "v"},
    {"exp", 1, 1, "exp(x)", "e to the power of x", unary<Op::Exponential>, "a"},
    {"floor", 1, 1, "floor(x)", "greatest whole number not above x", unary<Op::Floor>, "a"},
    {"fract", 1, 1, "fract(x)", "x - floor(x)", unary<Op::Fract>, "a"},
    {"length", 1, 3, "length(v)", "length of a vector, or of two or three numbers as components", length, ""},
    {"log", 1, 1, "log(x)", "natural logarithm; NaN below 0", unary<Op::Logarithm>, "a"},
    {"log2", 1, 1, "log2(x)", "logarithm to base 2; NaN below 0", unary<Op::Logarithm2>, "a"},
    {"max", 2, kMany, "max(a, b, …)", "the largest", folded<Op::Maximum>, "a"},
    {"min", 2, kMany, "min(a, b, …)", "the smallest", folded<Op::Minimum>, "a"},
    {"mix", 3, 3, "mix(a, b, w)", "a * (1 - w) + b * w", mix, "a"},
    {"mod", 2, 2, "mod(x, y)", "x - y * floor(x / y)", binary<Op::Modulo>, "a"},
    {"noise", 1, 3, "noise(x, y, z) or noise(v)", "smooth gradient noise, within ±1.05, 0 at whole numbers", noiseValue,
     ""},
    {"normalize", 1, 1, "normalize(v)", "v / length(v); NaN for the zero vector", normalize, "v"},
    {"pow", 2, 2, "pow(x, y)", "x to the power of y, as x ^ y", binary<Op::Power>, "a"},
    {"replace", 3, 3, "replace(v, k, s)", "v with component k (a constant: 0, 1, 2) replaced by s", nullptr, "vnn"},
    {"rotate", 3, 3, "rotate(v, axis, angle)", "v turned about the axis through the origin, right-handed, radians",
     rotate, "vvn"},
    {"select", 3, 3, "select(condition, a, b)", "a where the condition holds, else b", select, "naa"},
    {"sign", 1, 1, "sign(x)", "-1, 0 or 1", unary<Op::Sign>, "a"},
    {"sin", 1, 1, "sin(x)", "sine", unary<Op::Sine>, "a"},
    {"sinh", 1, 1, "sinh(x)", "hyperbolic sine", unary<Op::SineH>, "a"},
    {"smoothstep", 3, 3, "smoothstep(low, high, x)",
     "t * t * (3 - 2 * t) with t = clamp((x - low) / (high - low), 0, 1)", smoothstep, "a"},
    {"sqrt", 1, 1, "sqrt(x)", "square root; NaN below 0", unary<Op::SquareRoot>, "a"},
    {"step", 2, 2, "step(edge, x)", "0 where x < edge, else 1", step, "a"},
    {"tan", 1, 1, "tan(x)", "tangent", unary<Op::Tangent>, "a"},
    {"tanh", 1, 1, "tanh(x)", "hyperbolic tangent", unary<Op::TangentH>, "a"},
    {"vec", 3, 3, "vec(a, b, c)", "the vector [a, b, c]", vector, "n"},
});

}  // namespace

std::span<const FormulaFunction> formulaFunctions() {
    return kFunctions;
}

const FormulaFunction* formulaFunction(std::string_view name) {
    const auto found =
        std::find_if(kFunctions.begin(), kFunctions.end(), [&](const auto& f) { return f.name == name; });
    return found == kFunctions.end() ? nullptr : &*found;
}

FormulaValue componentwise(GraphBuilder& graph, Op op, const FormulaValue& a, const FormulaValue& b) {
    const std::array<FormulaValue, 2> both{a, b};
    return each(both, [&](int c) { return graph.make(op, a.component(c), b.component(c)); });
}

}  // namespace voledit
